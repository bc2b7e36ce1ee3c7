//! Legends, always outside the plot: entries in columns, long names broken into lines.

use super::canvas::{Align, Canvas, Stroke, Text};
use super::clip::Rect;
use super::fill::Fill;
use super::style::{INK, Pen};
use super::text;

pub(super) const SIZE: f64 = 14.0;
const LINE: f64 = 18.0;
const KEY: f64 = 40.0;
const GAP: f64 = 8.0;
const BETWEEN: f64 = 24.0;

/// What stands beside a name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Key {
    Curve(Pen),
    Guide(Stroke),
    Area(Fill),
}

/// A key with its name.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub name: String,
    pub key: Key,
}

impl PartialEq for Stroke {
    fn eq(&self, other: &Self) -> bool {
        (self.colour, self.width, self.dash) == (other.colour, other.width, other.dash)
    }
}

/// Width of the legend as one column, names unbroken.
pub(super) fn full_width(entries: &[Entry]) -> f64 {
    // One pixel more, or rounding would break a name that just fits.
    KEY + GAP + 1.0 + text::widest(entries.iter().map(|entry| entry.name.as_str()), SIZE)
}

/// Draws the entries within `width` in as many columns as fit, and returns the height used.
pub(super) fn draw(canvas: &mut Canvas, entries: &[Entry], left: f64, top: f64, width: f64) -> f64 {
    if entries.is_empty() {
        return 0.0;
    }
    let wanted = full_width(entries);
    let columns = (((width + BETWEEN) / (wanted + BETWEEN)) as usize).clamp(1, entries.len());
    let column_width = wanted.min(width);
    let rows = entries.len().div_ceil(columns);
    let mut height: f64 = 0.0;
    // Down the columns: neighbours in the list stay neighbours.
    for (column, part) in entries.chunks(rows).enumerate() {
        let x = left + column as f64 * (column_width + BETWEEN);
        let mut y = top;
        for entry in part {
            let lines = text::wrap(&entry.name, SIZE, false, column_width - KEY - GAP);
            key(canvas, entry.key, x, y + 0.5 * LINE);
            for (i, line) in lines.iter().enumerate() {
                let at = (x + KEY + GAP, y + (i as f64 + 0.5) * LINE);
                let (text, align) = (line.clone(), Align::Left);
                canvas.text(Text { at, text, size: SIZE, colour: INK, align, bold: false, upwards: false });
            }
            y += LINE * lines.len().max(1) as f64 + 3.0;
        }
        height = height.max(y - top);
    }
    height
}

/// Height that `draw` will use.
pub(super) fn height(entries: &[Entry], width: f64) -> f64 {
    draw(&mut Canvas::default(), entries, 0.0, 0.0, width)
}

fn key(canvas: &mut Canvas, key: Key, x: f64, y: f64) {
    match key {
        Key::Curve(pen) => {
            if let Some(dash) = pen.dash {
                let stroke = Stroke { colour: pen.colour, width: pen.width, dash };
                canvas.line((x, y), (x + KEY, y), stroke);
            }
            canvas.marker((x + 0.5 * KEY, y), pen);
        }
        Key::Guide(stroke) => canvas.line((x, y), (x + KEY, y), stroke),
        Key::Area(fill) => {
            fill.draw(canvas, Rect { left: x + 6.0, top: y - 7.0, right: x + KEY - 6.0, bottom: y + 7.0 });
        }
    }
}
