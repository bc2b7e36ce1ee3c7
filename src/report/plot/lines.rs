//! Curves over a rectangular frame: series, reference lines, shaded bands, slope triangles.

use super::PlotError;
use super::axis::{Axis, Scale, Span};
use super::canvas::{Align, Canvas, Stroke};
use super::clip::{Point, Rect, clip, simplify};
use super::frame::{self, Names};
use super::left_out::LeftOut;
use super::legend::{Entry, Key};
use super::slope;
use super::style::{Colour, Dash, GREY, INK, Marker, Pen, Rgb, Style};

const BAND: Rgb = (226, 232, 240);
const GUIDE: Rgb = (90, 90, 90);

/// Curves in one frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lines {
    /// May be empty.
    pub title: String,
    pub x: Axis,
    pub y: Axis,
    pub series: Vec<Series>,
    pub guides: Vec<Guide>,
    pub bands: Vec<Band>,
}

/// A curve or a set of markers. A point that is not finite is a gap.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    pub label: String,
    pub points: Vec<(f64, f64)>,
    pub style: Style,
}

impl Series {
    fn new(label: impl Into<String>, points: Vec<(f64, f64)>, line: bool, markers: bool) -> Self {
        let style = Style { colour: Colour::Auto, line, markers, dash: None, marker: None, width: 2.0 };
        Self { label: label.into(), points, style }
    }

    /// A line through the points.
    pub fn line(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, points, true, false)
    }

    /// Markers without a line.
    pub fn markers(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, points, false, true)
    }

    /// Markers joined by a line.
    pub fn both(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::new(label, points, true, true)
    }

    /// The exact or reference curve: a solid black line, wide enough to show under another.
    pub fn reference(label: impl Into<String>, points: Vec<(f64, f64)>) -> Self {
        Self::line(label, points).colour(Colour::Black).dash(Dash::Solid).width(2.8)
    }

    /// With this colour.
    pub fn colour(mut self, colour: Colour) -> Self {
        self.style.colour = colour;
        self
    }

    /// With the look of this slot, so that the same thing looks the same in several panels.
    pub fn slot(self, slot: usize) -> Self {
        self.colour(Colour::Slot(slot))
    }

    /// With these dashes.
    pub fn dash(mut self, dash: Dash) -> Self {
        self.style.dash = Some(dash);
        self
    }

    /// With this marker.
    pub fn marker(mut self, marker: Marker) -> Self {
        self.style.marker = Some(marker);
        self
    }

    /// With a line this many pixels wide.
    pub fn width(mut self, width: f64) -> Self {
        self.style.width = width;
        self
    }
}

/// A line to read the curves against.
#[derive(Debug, Clone, PartialEq)]
pub enum Guide {
    /// Named in the legend.
    Horizontal { at: f64, label: String },
    /// Named above the frame.
    Vertical { at: f64, label: String },
    /// A triangle of the slope y ~ x^order where the curves leave room; both axes must be logarithmic.
    Slope { order: f64, label: String },
}

/// A shaded interval of x, named above the frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    pub from: f64,
    pub to: f64,
    pub label: String,
}

/// The looks of several series, automatic colours handed out in order.
pub(super) fn pens(series: &[Series]) -> Vec<Pen> {
    let mut free = 0;
    let pen = |one: &Series| {
        let pen = one.style.pen(free);
        free += usize::from(one.style.colour == Colour::Auto);
        pen
    };
    series.iter().map(pen).collect()
}

/// Legend entries of several series.
pub(super) fn entries(series: &[Series]) -> Vec<Entry> {
    let named = series.iter().zip(pens(series)).filter(|(one, _)| !one.label.is_empty());
    named.map(|(one, pen)| Entry { name: one.label.clone(), key: Key::Curve(pen) }).collect()
}

/// Draws the visible parts of a curve; returns what was drawn.
pub(super) fn curve(canvas: &mut Canvas, points: &[Point], frame: Rect, pen: Pen) -> Vec<Vec<Point>> {
    let parts = clip(points, frame);
    if let Some(dash) = pen.dash {
        for part in &parts {
            match part[..] {
                // A line through one point would not show.
                [point] if pen.marker.is_none() => canvas.circle(point, pen.width.max(3.0), pen.colour),
                [_] => {}
                _ => canvas.path(simplify(part, 0.05), Stroke { colour: pen.colour, width: pen.width, dash }),
            }
        }
    }
    if pen.marker.is_some() {
        for &point in points.iter().filter(|&&point| frame.holds(point)) {
            canvas.marker(point, pen);
        }
    }
    parts
}

impl Lines {
    /// A frame with these axes and curves.
    pub fn new(x: Axis, y: Axis, series: Vec<Series>) -> Self {
        Self { x, y, series, ..Self::default() }
    }

    /// With a title above the frame.
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// With one more reference line.
    pub fn guide(mut self, guide: Guide) -> Self {
        self.guides.push(guide);
        self
    }

    /// With a shaded interval of x.
    pub fn band(mut self, from: f64, to: f64, label: impl Into<String>) -> Self {
        self.bands.push(Band { from, to, label: label.into() });
        self
    }

    pub(super) fn legend(&self) -> Vec<Entry> {
        let mut all = entries(&self.series);
        let horizontal = self.guides.iter().filter_map(|guide| match guide {
            Guide::Horizontal { label, .. } => Some(label),
            _ => None,
        });
        for (label, stroke) in horizontal.zip(guide_strokes()) {
            if !label.is_empty() {
                all.push(Entry { name: label.clone(), key: Key::Guide(stroke) });
            }
        }
        all
    }

    /// The ranges of both axes.
    fn ranges(&self) -> Result<[(f64, f64); 2], PlotError> {
        let points = || self.series.iter().flat_map(|one| one.points.iter());
        let marked = self.series.iter().any(|one| one.style.markers);
        let at = |vertical: bool| {
            self.guides.iter().filter_map(move |guide| match guide {
                Guide::Horizontal { at, .. } if !vertical => Some(*at),
                Guide::Vertical { at, .. } if vertical => Some(*at),
                _ => None,
            })
        };
        let x = self.x.span(points().map(|p| p.0).chain(at(true)), if marked { 0.03 } else { 0.0 })?;
        // What x leaves out does not stretch y.
        let shown = points().filter(|p| p.0 >= x.0 && p.0 <= x.1).map(|p| p.1);
        Ok([x, self.y.span(shown.chain(at(false)), 0.05)?])
    }

    /// Draws within `width` from the upper left corner; returns the height used and what was left out.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        (left, top): Point,
        width: f64,
    ) -> Result<(f64, LeftOut), PlotError> {
        let [x_range, y_range] = self.ranges()?;
        let height = (0.56 * width).clamp(210.0, 340.0);
        let y_ticks = frame::upright_ticks(&self.y, y_range, height);
        let room = frame::upright_room(&self.y, &y_ticks, height);
        let x_ticks = frame::level_ticks(&self.x, x_range, width - room - 24.0);
        let right = left + width - (0.5 * x_ticks.widest(frame::SIZE) + 2.0).max(12.0);
        let middle = 0.5 * (left + room + right);
        let title_room = 2.0 * (left + width - middle);
        let title = frame::paragraph(canvas, &self.title, middle, top, title_room, true);

        let x = Span { scale: self.x.scale, lo: x_range.0, hi: x_range.1, start: left + room, end: right };
        let names = Names::arrange(self.names(&x), left, left + width);
        let above = top + title + names.height();
        let area = Rect { left: left + room, top: above, right, bottom: above + height };
        let y = Span { scale: self.y.scale, lo: y_range.0, hi: y_range.1, start: area.bottom, end: area.top };
        names.draw(canvas, area.top);

        self.shade(canvas, area, &x);
        frame::grid(canvas, area, Some((&x, &x_ticks)), Some((&y, &y_ticks)));
        self.rule(canvas, area, &x, &y);
        let mut left_out = LeftOut::default();
        let mut drawn: Vec<Vec<Point>> = Vec::new();
        for (one, pen) in self.series.iter().zip(pens(&self.series)) {
            for &(px, py) in &one.points {
                left_out.admit(px, py, &x, &y);
            }
            let places: Vec<Point> = one.points.iter().map(|p| (x.at(p.0), y.at(p.1))).collect();
            drawn.extend(curve(canvas, &places, area, pen));
        }
        self.slopes(canvas, area, (&x, &y), drawn.clone())?;
        if drawn.is_empty() {
            let centre = (0.5 * (area.left + area.right), 0.5 * (area.top + area.bottom));
            canvas.text(frame::words(centre, "no data", Align::Centre));
        }
        canvas.outline(area, Stroke::solid(INK, 1.2));
        frame::upright_axis(canvas, area, &self.y, &y, &y_ticks);
        let below = frame::level_axis(canvas, area, &self.x, &x, &x_ticks);
        Ok((area.bottom + below - top, left_out))
    }

    /// What is named above the frame, with its place.
    fn names(&self, x: &Span) -> Vec<(f64, String)> {
        let verticals = self.guides.iter().filter_map(|guide| match guide {
            Guide::Vertical { at, label } if x.holds(*at) => Some((x.at(*at), label.clone())),
            _ => None,
        });
        let bands = self.bands.iter().filter_map(|band| {
            let (from, to) = shown(band, x)?;
            Some((0.5 * (x.at(from) + x.at(to)), band.label.clone()))
        });
        verticals.chain(bands).collect()
    }

    fn shade(&self, canvas: &mut Canvas, area: Rect, x: &Span) {
        for (from, to) in self.bands.iter().filter_map(|band| shown(band, x)) {
            canvas.rect(Rect { left: x.at(from), right: x.at(to), ..area }, BAND, 1.0);
        }
    }

    fn rule(&self, canvas: &mut Canvas, area: Rect, x: &Span, y: &Span) {
        let mut horizontal = guide_strokes();
        for guide in &self.guides {
            match guide {
                Guide::Horizontal { at, .. } => {
                    let stroke = horizontal.next();
                    if let (Some(stroke), true) = (stroke, y.holds(*at)) {
                        canvas.line((area.left, y.at(*at)), (area.right, y.at(*at)), stroke);
                    }
                }
                Guide::Vertical { at, .. } if x.holds(*at) => {
                    let stroke = Stroke { colour: GUIDE, width: 1.4, dash: Dash::Dashed };
                    canvas.line((x.at(*at), area.top), (x.at(*at), area.bottom), stroke);
                }
                _ => {}
            }
        }
    }

    fn slopes(
        &self,
        canvas: &mut Canvas,
        area: Rect,
        (x, y): (&Span, &Span),
        mut drawn: Vec<Vec<Point>>,
    ) -> Result<(), PlotError> {
        for guide in &self.guides {
            let Guide::Slope { order, label } = guide else { continue };
            if self.x.scale != Scale::Log || self.y.scale != Scale::Log || !order.is_finite() {
                return Err(PlotError::Slope { label: label.clone() });
            }
            drawn.push(slope::triangle(canvas, area, (x, y), *order, label, &drawn));
        }
        Ok(())
    }
}

/// The part of a band on the axis.
fn shown(band: &Band, x: &Span) -> Option<(f64, f64)> {
    let (from, to) = (band.from.min(band.to).max(x.lo), band.from.max(band.to).min(x.hi));
    (from < to).then_some((from, to))
}

/// Looks of horizontal guides, in their order.
fn guide_strokes() -> impl Iterator<Item = Stroke> {
    [Dash::Dashed, Dash::Dotted, Dash::DashDot, Dash::LongDash]
        .into_iter()
        .cycle()
        .enumerate()
        .map(|(i, dash)| Stroke { colour: if i % 2 == 0 { GUIDE } else { GREY }, width: 1.4, dash })
}
