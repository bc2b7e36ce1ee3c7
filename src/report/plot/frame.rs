//! The frame of a rectangular plot: grid, ticks and axis labels, and names above it for vertical lines and bands.

use super::axis::{Axis, Span};
use super::canvas::{Align, Canvas, Stroke, Text};
use super::clip::Rect;
use super::number::superscript;
use super::style::{INK, Rgb};
use super::text;
use super::ticks::{Ticks, fitting};

pub(super) const SIZE: f64 = 14.0;
pub(super) const LINE: f64 = 19.0;
const TITLE: f64 = 15.0;
const MAJOR: Rgb = (214, 214, 214);
const MINOR: Rgb = (238, 238, 238);

/// A text of the frame's size.
pub(super) fn words(at: (f64, f64), text: impl Into<String>, align: Align) -> Text {
    Text { at, text: text.into(), size: SIZE, colour: INK, align, bold: false, upwards: false }
}

/// Writes lines centred below each other and returns the height used.
pub(super) fn paragraph(
    canvas: &mut Canvas,
    text: &str,
    centre: f64,
    top: f64,
    room: f64,
    bold: bool,
) -> f64 {
    let size = if bold { TITLE } else { SIZE };
    let lines = text::wrap(text, size, bold, room);
    let count = lines.len() as f64;
    for (i, line) in lines.into_iter().enumerate() {
        let at = (centre, top + (i as f64 + 0.5) * LINE);
        canvas.text(Text { size, bold, ..words(at, line, Align::Centre) });
    }
    count * LINE
}

/// The axis' label, with the power of ten that the tick labels leave out.
pub(super) fn full_label(axis: &Axis, ticks: &Ticks) -> String {
    match ticks.exponent {
        0 => axis.label.clone(),
        n => format!("{}, ticks ×10{}", axis.label, superscript(n)),
    }
}

/// Ticks for a vertical axis of this height.
pub(super) fn upright_ticks(axis: &Axis, (lo, hi): (f64, f64), height: f64) -> Ticks {
    fitting(axis.scale, lo, hi, height, false, SIZE)
}

/// Ticks for a horizontal axis of this width.
pub(super) fn level_ticks(axis: &Axis, (lo, hi): (f64, f64), width: f64) -> Ticks {
    fitting(axis.scale, lo, hi, width, true, SIZE)
}

/// Grid lines at the ticks of both axes, minor ones fainter and first.
pub(super) fn grid(
    canvas: &mut Canvas,
    frame: Rect,
    across: Option<(&Span, &Ticks)>,
    up: Option<(&Span, &Ticks)>,
) {
    for minor in [true, false] {
        let stroke = Stroke::solid(if minor { MINOR } else { MAJOR }, 1.0);
        if let Some((span, ticks)) = across {
            for tick in ticks.ticks.iter().filter(|tick| tick.label.is_none() == minor) {
                let x = span.at(tick.value);
                canvas.line((x, frame.top), (x, frame.bottom), stroke);
            }
        }
        if let Some((span, ticks)) = up {
            for tick in ticks.ticks.iter().filter(|tick| tick.label.is_none() == minor) {
                let y = span.at(tick.value);
                canvas.line((frame.left, y), (frame.right, y), stroke);
            }
        }
    }
}

/// Tick marks, tick labels and the label below the frame; returns the height used.
pub(super) fn level_axis(canvas: &mut Canvas, frame: Rect, axis: &Axis, span: &Span, ticks: &Ticks) -> f64 {
    for tick in &ticks.ticks {
        let x = span.at(tick.value);
        let length = if tick.label.is_some() { 6.0 } else { 3.0 };
        canvas.line((x, frame.bottom), (x, frame.bottom + length), Stroke::solid(INK, 1.0));
        if let Some(label) = &tick.label {
            canvas.text(words((x, frame.bottom + 16.0), label, Align::Centre));
        }
    }
    let centre = 0.5 * (frame.left + frame.right);
    28.0 + paragraph(
        canvas,
        &full_label(axis, ticks),
        centre,
        frame.bottom + 28.0,
        frame.width() + 20.0,
        false,
    )
}

/// Width that a vertical axis needs left of its frame.
pub(super) fn upright_room(axis: &Axis, ticks: &Ticks, height: f64) -> f64 {
    let lines = text::wrap(&full_label(axis, ticks), SIZE, false, height + 30.0).len() as f64;
    (ticks.widest(SIZE) + 12.0 + lines * LINE).max(62.0)
}

/// Tick marks, tick labels and the label left of the frame.
pub(super) fn upright_axis(canvas: &mut Canvas, frame: Rect, axis: &Axis, span: &Span, ticks: &Ticks) {
    for tick in &ticks.ticks {
        let y = span.at(tick.value);
        let length = if tick.label.is_some() { 6.0 } else { 3.0 };
        canvas.line((frame.left, y), (frame.left - length, y), Stroke::solid(INK, 1.0));
        if let Some(label) = &tick.label {
            canvas.text(words((frame.left - 9.0, y), label, Align::Right));
        }
    }
    let label = full_label(axis, ticks);
    let lines = text::wrap(&label, SIZE, false, frame.height() + 30.0);
    let mut x = frame.left - upright_room(axis, ticks, frame.height()) + 0.5 * LINE;
    for line in lines {
        let at = (x, 0.5 * (frame.top + frame.bottom));
        canvas.text(Text { upwards: true, ..words(at, line, Align::Centre) });
        x += LINE;
    }
}

/// Names above a frame, each over its own place, in as many rows as keep them apart.
pub(super) struct Names {
    placed: Vec<(f64, usize, String)>,
    rows: usize,
}

impl Names {
    /// Arranges names between `left` and `right`; the place is the middle of the name, where there is room.
    pub fn arrange(mut names: Vec<(f64, String)>, left: f64, right: f64) -> Self {
        names.retain(|(x, name)| x.is_finite() && !name.is_empty());
        names.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut taken: Vec<f64> = Vec::new();
        let mut placed = Vec::new();
        for (x, name) in names {
            let lines = text::wrap(&name, SIZE, false, right - left);
            let half = 0.5 * text::widest(lines.iter().map(String::as_str), SIZE);
            let x = x.max(left + half).min(right - half);
            let free = |row: usize, taken: &[f64]| taken.get(row).is_none_or(|end| end + 12.0 <= x - half);
            let mut row = 0;
            while !(row..row + lines.len()).all(|r| free(r, &taken)) {
                row += 1;
            }
            taken.resize(taken.len().max(row + lines.len()), f64::NEG_INFINITY);
            for (i, line) in lines.iter().rev().enumerate() {
                taken[row + i] = x + half;
                placed.push((x, row + i, line.clone()));
            }
        }
        Self { placed, rows: taken.len() }
    }

    /// Height above the frame.
    pub fn height(&self) -> f64 {
        if self.rows == 0 { 8.0 } else { self.rows as f64 * LINE + 4.0 }
    }

    pub fn draw(self, canvas: &mut Canvas, bottom: f64) {
        for (x, row, name) in self.placed {
            canvas.text(words((x, bottom - 4.0 - (row as f64 + 0.5) * LINE), name, Align::Centre));
        }
    }
}
