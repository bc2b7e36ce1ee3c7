//! A triangle that shows the slope of an order of convergence, put where the curves leave the most room.

use super::axis::Span;
use super::canvas::{Align, Canvas, Stroke};
use super::clip::{Point, Rect};
use super::frame;
use super::style::INK;
use super::text;

/// Draws the triangle for y ~ x^order and returns its outline.
pub(super) fn triangle(
    canvas: &mut Canvas,
    area: Rect,
    (x, y): (&Span, &Span),
    order: f64,
    label: &str,
    drawn: &[Vec<Point>],
) -> Vec<Point> {
    let per_decade =
        |span: &Span| (span.end - span.start).abs() / (span.scale.of(span.hi) - span.scale.of(span.lo));
    let steep = order * per_decade(y) / per_decade(x);
    let wide = (0.15 * area.width()).min(0.28 * area.height() / steep.abs().max(1e-6));
    let high = wide * steep;
    let room = text::width(label, frame::SIZE, false) + 8.0;
    let size = (wide + room, high.abs().max(frame::LINE));
    let (left, bottom) = roomiest(area, size, &samples(drawn));
    // The corner on the line's lower end for positive orders, on its upper end for negative ones.
    let base = if high >= 0.0 { bottom } else { bottom - size.1 };
    let corners = vec![(left, base), (left + wide, base), (left + wide, base - high), (left, base)];
    canvas.path(corners.clone(), Stroke::solid(INK, 1.4));
    canvas.text(frame::words((left + wide + 6.0, base - 0.5 * high), label, Align::Left));
    let end = left + size.0;
    let label_box = [(end, base), (end, base - high)];
    corners.into_iter().chain(label_box).collect()
}

/// Points every few pixels along the drawn curves.
fn samples(drawn: &[Vec<Point>]) -> Vec<Point> {
    let mut points = Vec::new();
    for part in drawn {
        points.extend(part.first());
        for pair in part.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let steps = (((b.0 - a.0).abs() + (b.1 - a.1).abs()) / 6.0).ceil().max(1.0);
            let on = |i: f64| (a.0 + (b.0 - a.0) * i / steps, a.1 + (b.1 - a.1) * i / steps);
            points.extend((1..=steps as usize).map(|i| on(i as f64)));
        }
    }
    points
}

/// Lower left corner of a box of this size in the area, farthest from all points.
fn roomiest(area: Rect, (wide, high): (f64, f64), points: &[Point]) -> Point {
    let margin = 14.0;
    let (free_x, free_y) = (area.width() - wide - 2.0 * margin, area.height() - high - 2.0 * margin);
    let mut best = ((area.left + margin, area.bottom - margin), f64::NEG_INFINITY);
    for row in 0..=12 {
        for column in 0..=12 {
            let left = area.left + margin + free_x.max(0.0) * f64::from(column) / 12.0;
            let bottom = area.bottom - margin - free_y.max(0.0) * f64::from(row) / 12.0;
            let distance = |p: &Point| {
                let dx = (left - p.0).max(p.0 - left - wide).max(0.0);
                let dy = (bottom - high - p.1).max(p.1 - bottom).max(0.0);
                dx * dx + dy * dy
            };
            // Beyond 40 pixels it is clear enough, and the first such place, at the bottom, is as good as any.
            let clear = points.iter().map(distance).fold(1600.0, f64::min);
            if clear > best.1 {
                best = ((left, bottom), clear);
            }
        }
    }
    best.0
}
