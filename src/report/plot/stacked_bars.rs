//! Signed contributions stacked on both sides of zero, with their sum: error budgets.

use super::PlotError;
use super::axis::{Axis, Scale, Span};
use super::canvas::{Align, Canvas, Stroke};
use super::clip::{Point, Rect};
use super::fill::Fill;
use super::frame::{self, words};
use super::left_out::LeftOut;
use super::legend::{Entry, Key};
use super::style::{BLACK, Colour, INK, Marker, Pen, Style, WHITE};
use super::text;

/// Least and greatest height of a row but for long names, and the share of it that the bar takes.
const LOW: f64 = 34.0;
const HIGH: f64 = 62.0;
const SHARE: f64 = 0.62;
/// Of a name.
const LINE: f64 = 17.0;
/// Height that few bars share.
const TOGETHER: f64 = 250.0;

/// Bars along one horizontal axis, the first at the top. Each is a stack of the same contributions: those above zero
/// to the right, those below zero to the left, in their order from zero outwards, and a mark at the sum of all.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StackedBars {
    /// May be empty.
    pub title: String,
    /// What is stacked, with its unit; linear. A range taken from the data contains zero.
    pub value: Axis,
    /// Names of the contributions, for the legend; the same one looks the same in every bar and figure with this order.
    pub contributions: Vec<String>,
    /// Name of the sum, for the legend.
    pub sum: String,
    pub stacks: Vec<Stack>,
}

/// A named bar.
#[derive(Debug, Clone, PartialEq)]
pub struct Stack {
    pub label: String,
    /// One per contribution; `None` where the bar has no such contribution. What is not finite is not known: it is left
    /// out, said so, and the bar has no sum.
    pub parts: Vec<Option<f64>>,
}

/// Where a part lies: it begins where the last one of its sign ended.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Segment {
    slot: usize,
    from: f64,
    to: f64,
}

impl Stack {
    /// A bar with a value for each contribution.
    pub fn new(label: impl Into<String>, parts: impl IntoIterator<Item = f64>) -> Self {
        Self { label: label.into(), parts: parts.into_iter().map(Some).collect() }
    }

    /// Of all parts, added in their order; `None` where there are none or one is not finite.
    pub fn sum(&self) -> Option<f64> {
        let known = self.parts.iter().flatten().all(|part| part.is_finite());
        let any = self.parts.iter().any(Option::is_some);
        (any && known).then(|| self.parts.iter().flatten().sum())
    }

    fn segments(&self) -> Vec<Segment> {
        let (mut above, mut below) = (0.0, 0.0);
        let mut segments = Vec::new();
        for (slot, part) in self.parts.iter().enumerate() {
            let Some(part) = part.filter(|part| part.is_finite()) else { continue };
            let end = if part < 0.0 { &mut below } else { &mut above };
            let from = *end;
            *end += part;
            segments.push(Segment { slot, from, to: *end });
        }
        segments
    }
}

impl StackedBars {
    /// Bars of these contributions; `sum` names the mark at their sum.
    pub fn new(value: Axis, contributions: Vec<String>, sum: impl Into<String>, stacks: Vec<Stack>) -> Self {
        Self { title: String::new(), value, contributions, sum: sum.into(), stacks }
    }

    /// With a title above the frame.
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    pub(super) fn legend(&self) -> Vec<Entry> {
        let parts = self.contributions.iter().enumerate();
        let parts = parts.map(|(slot, name)| (name, Key::Area(Fill::slot(slot))));
        let all = parts.chain([(&self.sum, Key::Curve(sum_pen()))]);
        all.filter(|(name, _)| !name.is_empty())
            .map(|(name, key)| Entry { name: name.clone(), key })
            .collect()
    }

    fn check(&self) -> Result<(), PlotError> {
        if self.value.scale != Scale::Linear {
            let (lo, hi) = self.value.range.unwrap_or((f64::NAN, f64::NAN));
            return Err(PlotError::Range { axis: format!("{} (must be linear)", self.value.label), lo, hi });
        }
        let expected = self.contributions.len();
        match self.stacks.iter().find(|stack| stack.parts.len() != expected) {
            Some(stack) => {
                Err(PlotError::Shape { what: stack.label.clone(), found: stack.parts.len(), expected })
            }
            None => Ok(()),
        }
    }

    /// Contains zero and, where bars end beyond it, a margin.
    fn range(&self) -> Result<(f64, f64), PlotError> {
        if self.value.range.is_some() {
            return self.value.span([], 0.0);
        }
        let ends = self.stacks.iter().flat_map(|stack| stack.segments()).map(|segment| segment.to);
        let (lo, hi) = self.value.clone().including(0.0).span(ends, 0.0)?;
        let margin = 0.05 * (hi - lo);
        Ok((if lo < 0.0 { lo - margin } else { lo }, if hi > 0.0 { hi + margin } else { hi }))
    }

    /// Draws within `width` from the upper left corner; returns the height used and what was left out.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        (left, top): Point,
        width: f64,
    ) -> Result<(f64, LeftOut), PlotError> {
        self.check()?;
        let range = self.range()?;
        let names = self.stacks.iter().map(|stack| stack.label.as_str());
        let room = text::widest(names, frame::SIZE).min(0.36 * width);
        let ticks = frame::level_ticks(&self.value, range, width - room - 36.0);
        let right = left + width - (0.5 * ticks.widest(frame::SIZE) + 2.0).max(12.0);
        let x =
            Span { scale: Scale::Linear, lo: range.0, hi: range.1, start: left + room + 12.0, end: right };
        let middle = 0.5 * (x.start + x.end);
        let title_room = 2.0 * (left + width - middle);
        let title = frame::paragraph(canvas, &self.title, middle, top, title_room, true);

        let labels: Vec<Vec<String>> =
            self.stacks.iter().map(|s| text::wrap(&s.label, frame::SIZE, false, room + 1.0)).collect();
        let lines = labels.iter().map(Vec::len).max().unwrap_or(1);
        let count = self.stacks.len().max(1) as f64;
        let row = (TOGETHER / count).clamp(LOW, HIGH).max(LINE * lines as f64 + 10.0);
        let upper = top + title + 8.0;
        let area = Rect { left: x.start, top: upper, right, bottom: upper + row * count };

        frame::grid(canvas, area, Some((&x, &ticks)), None);
        let left_out = self.bars(canvas, area, row, &x);
        if self.stacks.iter().all(|stack| stack.segments().is_empty()) {
            let centre = (middle, 0.5 * (area.top + area.bottom));
            canvas.text(words(centre, "no data", Align::Centre));
        }
        write_names(canvas, &labels, area, row);
        canvas.outline(area, Stroke::solid(INK, 1.2));
        let below = frame::level_axis(canvas, area, &self.value, &x, &ticks);
        Ok((area.bottom + below - top, left_out))
    }

    /// Bars, the line of zero over them, and the marks of the sums over both.
    fn bars(&self, canvas: &mut Canvas, area: Rect, row: f64, x: &Span) -> LeftOut {
        let mut left_out = LeftOut::default();
        for (i, stack) in self.stacks.iter().enumerate() {
            let (middle, half) = (area.top + (i as f64 + 0.5) * row, 0.5 * SHARE * row.min(HIGH));
            let bar = Rect { top: middle - half, bottom: middle + half, ..area };
            left_out.not_finite += stack.parts.iter().flatten().filter(|part| !part.is_finite()).count();
            for segment in stack.segments() {
                left_out.outside += usize::from(!(x.holds(segment.from) && x.holds(segment.to)));
                segment.draw(canvas, bar, x);
            }
        }
        if x.holds(0.0) {
            canvas.line((x.at(0.0), area.top), (x.at(0.0), area.bottom), Stroke::solid(BLACK, 1.6));
        }
        for (i, stack) in self.stacks.iter().enumerate() {
            match stack.sum() {
                Some(sum) if x.holds(sum) => {
                    sum_mark(canvas, (x.at(sum), area.top + (i as f64 + 0.5) * row));
                }
                Some(_) => left_out.outside += 1,
                None => left_out.sums += usize::from(stack.parts.iter().any(Option::is_some)),
            }
        }
        left_out
    }
}

impl Segment {
    /// The part of it on the axis.
    fn draw(self, canvas: &mut Canvas, bar: Rect, x: &Span) {
        let (lo, hi) = (self.from.min(self.to).max(x.lo), self.from.max(self.to).min(x.hi));
        if lo < hi {
            Fill::slot(self.slot).draw(canvas, Rect { left: x.at(lo), right: x.at(hi), ..bar });
        }
    }
}

/// Names left of the frame, each in its lines, at the middle of its row.
fn write_names(canvas: &mut Canvas, labels: &[Vec<String>], area: Rect, row: f64) {
    for (i, label) in labels.iter().enumerate() {
        let middle = area.top + (i as f64 + 0.5) * row;
        for (k, line) in label.iter().enumerate() {
            let y = middle + (k as f64 - 0.5 * (label.len() - 1) as f64) * LINE;
            canvas.text(words((area.left - 9.0, y), line, Align::Right));
        }
    }
}

fn sum_pen() -> Pen {
    let marker = Some(Marker::Diamond);
    Style { colour: Colour::Black, line: false, markers: true, dash: None, marker, width: 2.0 }.pen(0)
}

/// A black diamond with a white rim, to be seen on any colour.
fn sum_mark(canvas: &mut Canvas, (x, y): Point) {
    let r = 8.4;
    canvas.polygon(vec![(x, y - r), (x + r, y), (x, y + r), (x - r, y)], WHITE, 1.0);
    canvas.marker((x, y), sum_pen());
}
