//! Dots beside a reference line: one row per category and group, with a range where there is one.

use super::PlotError;
use super::axis::{Axis, Scale, Span};
use super::canvas::{Align, Canvas, Stroke};
use super::clip::{Point, Rect};
use super::frame::{self, Names, words};
use super::left_out::LeftOut;
use super::legend::{Entry, Key};
use super::style::{BLACK, Colour, Dash, INK, Pen, Rgb, Style};
use super::text;

const STRIPE: Rgb = (244, 245, 247);
const STEP: f64 = 15.0;

/// Values of several groups in several categories along one horizontal axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Dots {
    /// May be empty.
    pub title: String,
    pub value: Axis,
    /// Where the values should be, with a name.
    pub reference: Option<(f64, String)>,
    /// Names of the groups, for the legend.
    pub groups: Vec<String>,
    pub categories: Vec<Category>,
}

/// A named row of dots, one per group.
#[derive(Debug, Clone, PartialEq)]
pub struct Category {
    pub label: String,
    /// One per group; `None` where there is no value.
    pub dots: Vec<Option<Dot>>,
}

impl Category {
    /// A category with one plain value per group.
    pub fn new(label: impl Into<String>, values: impl IntoIterator<Item = f64>) -> Self {
        let dots = values.into_iter().map(|value| Some(Dot { value, range: None })).collect();
        Self { label: label.into(), dots }
    }
}

/// A value, with the range it stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dot {
    pub value: f64,
    pub range: Option<(f64, f64)>,
}

impl Dots {
    /// A chart of these categories.
    pub fn new(value: Axis, groups: Vec<String>, categories: Vec<Category>) -> Self {
        Self { title: String::new(), value, reference: None, groups, categories }
    }

    /// With a title above the frame.
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// With a line where the values should be.
    pub fn reference(mut self, at: f64, label: impl Into<String>) -> Self {
        self.reference = Some((at, label.into()));
        self
    }

    fn pen(group: usize) -> Pen {
        let colour = Colour::Slot(group);
        Style { colour, line: false, markers: true, dash: None, marker: None, width: 2.0 }.pen(0)
    }

    pub(super) fn legend(&self) -> Vec<Entry> {
        let named = self.groups.iter().enumerate().filter(|(_, name)| !name.is_empty());
        named.map(|(i, name)| Entry { name: name.clone(), key: Key::Curve(Self::pen(i)) }).collect()
    }

    fn range(&self) -> Result<(f64, f64), PlotError> {
        for category in &self.categories {
            let (found, expected) = (category.dots.len(), self.groups.len());
            if found != expected {
                return Err(PlotError::Shape { what: category.label.clone(), found, expected });
            }
        }
        let dots = self.categories.iter().flat_map(|category| category.dots.iter().flatten());
        let values = dots.flat_map(|dot| {
            let (lo, hi) = dot.range.unwrap_or((dot.value, dot.value));
            [dot.value, lo, hi]
        });
        self.value.span(values.chain(self.reference.iter().map(|(at, _)| *at)), 0.05)
    }

    /// Draws within `width` from the upper left corner; returns the height used and what was left out.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        (left, top): Point,
        width: f64,
    ) -> Result<(f64, LeftOut), PlotError> {
        let range = self.range()?;
        let most = 0.4 * width;
        let room = text::widest(self.categories.iter().map(|c| c.label.as_str()), frame::SIZE).min(most);
        let ticks = frame::level_ticks(&self.value, range, width - room - 36.0);
        let right = left + width - (0.5 * ticks.widest(frame::SIZE) + 2.0).max(12.0);
        let title = frame::paragraph(canvas, &self.title, left + 0.5 * width, top, width, true);
        let x =
            Span { scale: self.value.scale, lo: range.0, hi: range.1, start: left + room + 12.0, end: right };
        let shown = self.reference.iter().filter(|(at, _)| x.holds(*at));
        let names =
            Names::arrange(shown.map(|(at, name)| (x.at(*at), name.clone())).collect(), left, left + width);
        let above = top + title + names.height();

        let labels: Vec<Vec<String>> =
            self.categories.iter().map(|c| text::wrap(&c.label, frame::SIZE, false, room + 1.0)).collect();
        let lines = labels.iter().map(Vec::len).max().unwrap_or(1);
        let row = (STEP * self.groups.len() as f64 + 10.0).max(17.0 * lines as f64 + 8.0).max(28.0);
        let bottom = above + row * self.categories.len().max(1) as f64;
        let area = Rect { left: x.start, top: above, right, bottom };
        names.draw(canvas, area.top);

        for (i, label) in labels.iter().enumerate() {
            let (upper, middle) = (above + i as f64 * row, above + (i as f64 + 0.5) * row);
            if i % 2 == 1 {
                canvas.rect(Rect { top: upper, bottom: upper + row, ..area }, STRIPE, 1.0);
            }
            for (k, line) in label.iter().enumerate() {
                let y = middle + (k as f64 - 0.5 * (label.len() - 1) as f64) * 17.0;
                canvas.text(words((area.left - 9.0, y), line, Align::Right));
            }
        }
        frame::grid(canvas, area, Some((&x, &ticks)), None);
        if let Some((at, _)) = self.reference.as_ref().filter(|(at, _)| x.holds(*at)) {
            let stroke = Stroke { colour: BLACK, width: 1.6, dash: Dash::Dashed };
            canvas.line((x.at(*at), area.top), (x.at(*at), area.bottom), stroke);
        }
        let left_out = self.marks(canvas, area, row, &x);
        canvas.outline(area, Stroke::solid(INK, 1.2));
        let below = frame::level_axis(canvas, area, &self.value, &x, &ticks);
        Ok((area.bottom + below - top, left_out))
    }

    fn marks(&self, canvas: &mut Canvas, area: Rect, row: f64, x: &Span) -> LeftOut {
        let mut left_out = LeftOut::default();
        let anywhere = Span { scale: Scale::Linear, lo: 0.0, hi: 1.0, start: 0.0, end: 1.0 };
        for (i, category) in self.categories.iter().enumerate() {
            let middle = area.top + (i as f64 + 0.5) * row;
            for (group, dot) in category.dots.iter().enumerate() {
                let Some(dot) = dot else { continue };
                let y = middle + (group as f64 - 0.5 * (self.groups.len() - 1) as f64) * STEP;
                let pen = Self::pen(group);
                if let Some((lo, hi)) = dot.range {
                    whisker(canvas, x, (lo.min(hi), lo.max(hi)), y, pen.colour);
                }
                if left_out.admit(dot.value, 0.5, x, &anywhere) {
                    canvas.marker((x.at(dot.value), y), pen);
                }
            }
        }
        left_out
    }
}

/// A horizontal line over the part of the range on the axis, with a bar at each end that is shown.
fn whisker(canvas: &mut Canvas, x: &Span, (lo, hi): (f64, f64), y: f64, colour: Rgb) {
    let (from, to) = (lo.max(x.lo), hi.min(x.hi));
    let stroke = Stroke::solid(colour, 1.6);
    if from < to {
        canvas.line((x.at(from), y), (x.at(to), y), stroke);
    }
    for end in [lo, hi].into_iter().filter(|end| x.holds(*end)) {
        canvas.line((x.at(end), y - 4.0), (x.at(end), y + 4.0), stroke);
    }
}
