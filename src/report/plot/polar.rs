//! Values over a direction: angle around, value outwards, with the radial scale beside the disc.

use super::PlotError;
use super::axis::{Axis, Scale, Span};
use super::canvas::{Align, Canvas, Stroke};
use super::clip::{Point, Rect, clip, simplify};
use super::frame;
use super::left_out::LeftOut;
use super::legend::Entry;
use super::lines::{Series, entries, pens};
use super::style::{BLACK, INK, Rgb};

const RING: Rgb = (200, 200, 200);

/// Series of (angle in degrees, value); angles run anticlockwise from the right. A closed curve repeats its first
/// point at 360. Values may be negative: the centre is the smallest value, and the circle of zero is drawn heavier.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Polar {
    /// May be empty.
    pub title: String,
    /// Linear; a range taken from the data contains zero.
    pub radial: Axis,
    pub series: Vec<Series>,
}

impl Polar {
    /// A polar plot of these series.
    pub fn new(radial: Axis, series: Vec<Series>) -> Self {
        Self { title: String::new(), radial, series }
    }

    /// With a title above the disc.
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    pub(super) fn legend(&self) -> Vec<Entry> {
        entries(&self.series)
    }

    fn range(&self) -> Result<(f64, f64), PlotError> {
        let values = || self.series.iter().flat_map(|one| one.points.iter().map(|p| p.1));
        if self.radial.range.is_some() {
            return self.radial.span([], 0.0);
        }
        let (lo, hi) = self.radial.clone().including(0.0).span(values(), 0.06)?;
        let negative = values().any(|v| v.is_finite() && v < 0.0);
        Ok((if negative { lo } else { 0.0 }, hi))
    }

    /// Draws within `width` from the upper left corner; returns the height used and what was left out.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        (left, top): Point,
        width: f64,
    ) -> Result<(f64, LeftOut), PlotError> {
        if self.radial.scale != Scale::Linear {
            let (lo, hi) = self.radial.range.unwrap_or((f64::NAN, f64::NAN));
            return Err(PlotError::Range { axis: format!("{} (must be linear)", self.radial.label), lo, hi });
        }
        let range = self.range()?;
        let title = frame::paragraph(canvas, &self.title, left + 0.5 * width, top, width, true);
        // The scale stands left of the disc as tall as its radius; 54 and 30 are the room of the angles' names.
        let guess = 150.0;
        let ticks = frame::upright_ticks(&self.radial, range, guess);
        let room = frame::upright_room(&self.radial, &ticks, guess);
        let radius = (0.5 * (width - room - 98.0)).clamp(60.0, 170.0);
        let ticks = frame::upright_ticks(&self.radial, range, radius);
        let room = frame::upright_room(&self.radial, &ticks, radius);
        let used = room + 2.0 * radius + 98.0;
        let x0 = left + (0.5 * (width - used)).max(0.0);
        let centre = (x0 + room + 54.0 + radius, top + title + 30.0 + radius);
        let r = Span { scale: Scale::Linear, lo: range.0, hi: range.1, start: 0.0, end: radius };

        self.disc(canvas, centre, radius, &r, &ticks);
        let up = Span { start: centre.1, end: centre.1 - radius, ..r };
        let scale = Rect { left: x0 + room, top: centre.1 - radius, right: x0 + room, bottom: centre.1 };
        canvas.line((scale.left, scale.top), (scale.left, scale.bottom), Stroke::solid(INK, 1.2));
        frame::upright_axis(canvas, scale, &self.radial, &up, &ticks);

        let mut left_out = LeftOut::default();
        let mut empty = true;
        for (one, pen) in self.series.iter().zip(pens(&self.series)) {
            let turns = Span { scale: Scale::Linear, lo: -1e6, hi: 1e6, start: -1e6, end: 1e6 };
            for &(angle, value) in &one.points {
                left_out.admit(angle, value, &turns, &r);
            }
            // Cut at the rim and at the centre before the plane is bent: there the frame is a rectangle.
            let flat: Vec<Point> = one.points.iter().map(|&(angle, value)| (angle, r.at(value))).collect();
            let strip = Rect { left: -1e6, right: 1e6, top: 0.0, bottom: radius };
            let bend = |&(angle, r): &Point| spot(centre, angle, r);
            for part in clip(&flat, strip) {
                empty = false;
                let bent: Vec<Point> = part.iter().map(bend).collect();
                if let Some(dash) = pen.dash {
                    match bent[..] {
                        [point] => canvas.circle(point, pen.width.max(3.0), pen.colour),
                        _ => canvas.path(
                            simplify(&bent, 0.05),
                            Stroke { colour: pen.colour, width: pen.width, dash },
                        ),
                    }
                }
            }
            if pen.marker.is_some() {
                for point in flat.iter().filter(|&&point| strip.holds(point)) {
                    canvas.marker(bend(point), pen);
                }
            }
        }
        if empty {
            canvas.text(frame::words(centre, "no data", Align::Centre));
        }
        Ok((centre.1 + radius + 30.0 - top, left_out))
    }

    /// Rings at the ticks, spokes, the names of the angles.
    fn disc(&self, canvas: &mut Canvas, centre: Point, radius: f64, r: &Span, ticks: &super::ticks::Ticks) {
        for step in 0..12 {
            let angle = 30.0 * f64::from(step);
            canvas.line(centre, spot(centre, angle, radius), Stroke::solid(RING, 1.0));
            let at = spot(centre, angle, radius + 18.0);
            let cos = libm::cos(angle.to_radians());
            let align = if cos.abs() < 0.3 {
                Align::Centre
            } else if cos > 0.0 {
                Align::Left
            } else {
                Align::Right
            };
            // Names right and left of the disc start close to it, whatever their length.
            let x = if align == Align::Centre { at.0 } else { at.0 - 9.0 * cos.signum() };
            canvas.text(frame::words((x, at.1), format!("{angle:.0}°"), align));
        }
        for (value, _) in ticks.labelled() {
            canvas.ring(centre, r.at(value), Stroke::solid(RING, 1.0));
        }
        if r.holds(0.0) && r.at(0.0) > 0.5 {
            canvas.ring(centre, r.at(0.0), Stroke::solid(BLACK, 1.6));
        }
        canvas.ring(centre, radius, Stroke::solid(INK, 1.0));
    }
}

/// The point at this angle and radius.
fn spot(centre: Point, angle: f64, radius: f64) -> Point {
    let angle = angle.to_radians();
    (centre.0 + radius * libm::cos(angle), centre.1 - radius * libm::sin(angle))
}
