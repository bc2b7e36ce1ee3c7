//! A table of numbers on coloured cells, with the colour scale beside it.

use super::PlotError;
use super::axis::Axis;
use super::canvas::{Align, Canvas, Stroke, Text};
use super::clip::{Point, Rect};
use super::colour_scale::{ColourScale, Colours, ink_on};
use super::frame::{self, words};
use super::left_out::LeftOut;
use super::number::together;
use super::style::{INK, Rgb, WHITE};
use super::text;

const HATCH: Rgb = (190, 190, 190);
/// Least and greatest height of a row.
const LOW: f64 = 34.0;
const HIGH: f64 = 44.0;

/// Values over two lists of names; the first row stands at the top.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HeatMap {
    /// May be empty.
    pub title: String,
    pub x_label: String,
    pub y_label: String,
    /// Names of the columns.
    pub x: Vec<String>,
    /// Names of the rows.
    pub y: Vec<String>,
    /// One row per name in `y`, one value per name in `x`; `None` is hatched, as is what is not finite.
    pub values: Vec<Vec<Option<f64>>>,
    /// What the values are, with unit, their scale and the range of the colours.
    pub value: Axis,
    pub colours: Colours,
}

impl HeatMap {
    /// A heat map; `x` and `y` are (label, names).
    pub fn new(
        x: (impl Into<String>, Vec<String>),
        y: (impl Into<String>, Vec<String>),
        value: Axis,
        values: Vec<Vec<Option<f64>>>,
    ) -> Self {
        let (x_label, x) = (x.0.into(), x.1);
        let (y_label, y) = (y.0.into(), y.1);
        Self { title: String::new(), x_label, y_label, x, y, values, value, colours: Colours::Sequential }
    }

    /// With a title above.
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// With two colours away from this value.
    pub fn diverging(mut self, centre: f64) -> Self {
        self.colours = Colours::Diverging { centre };
        self
    }

    fn check(&self) -> Result<(), PlotError> {
        let shape = |what: &str, found, expected| {
            Err(PlotError::Shape { what: format!("heat map, {what}"), found, expected })
        };
        if self.values.len() != self.y.len() {
            return shape("rows", self.values.len(), self.y.len());
        }
        if let Some(row) = self.values.iter().find(|row| row.len() != self.x.len()) {
            return shape("columns", row.len(), self.x.len());
        }
        if self.x.is_empty() || self.y.is_empty() { Err(PlotError::Empty) } else { Ok(()) }
    }

    /// Draws within `width` from the upper left corner; returns the height used and what was left out.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        (left, top): Point,
        width: f64,
    ) -> Result<(f64, LeftOut), PlotError> {
        self.check()?;
        let scale = ColourScale::new(&self.value, self.colours, &self.values)?;
        let title = frame::paragraph(canvas, &self.title, left + 0.5 * width, top, width, true);
        let name_room = text::widest(self.y.iter().map(String::as_str), frame::SIZE).min(0.36 * width);
        let grid_left = left + name_room + 10.0 + if self.y_label.is_empty() { 0.0 } else { frame::LINE };
        // The scale is as high as the rows, which are as high as the cells leave them.
        let scale_room = scale.room(LOW * self.y.len() as f64).max(scale.room(HIGH * self.y.len() as f64));
        let cell = ((left + width - scale_room - grid_left) / self.x.len() as f64).clamp(6.0, 110.0);
        let row = (0.5 * cell).clamp(LOW, HIGH);
        let area = Rect {
            left: grid_left,
            top: top + title + 8.0,
            right: grid_left + cell * self.x.len() as f64,
            bottom: top + title + 8.0 + row * self.y.len() as f64,
        };
        let left_out = self.cells(canvas, area, (cell, row), &scale);
        canvas.outline(area, Stroke::solid(INK, 1.2));
        let below = self.names(canvas, area, (cell, row), name_room);
        scale.draw(canvas, area);
        Ok((area.bottom + below - top, left_out))
    }

    fn cells(&self, canvas: &mut Canvas, area: Rect, (cell, row): Point, scale: &ColourScale) -> LeftOut {
        let mut left_out = LeftOut::default();
        let texts = together(&self.values);
        let per_size = text::widest(texts.iter().flatten().map(String::as_str), 1.0);
        let size = frame::SIZE.min((cell - 6.0) / per_size.max(0.1));
        for (j, values) in self.values.iter().enumerate() {
            for (i, value) in values.iter().enumerate() {
                let (x, y) = (area.left + i as f64 * cell, area.top + j as f64 * row);
                let place = Rect { left: x, top: y, right: x + cell, bottom: y + row };
                let Some(share) = value.and_then(|v| scale.share(v)) else {
                    left_out.miss(*value);
                    left_out.blank_cells += 1;
                    hatch(canvas, place);
                    continue;
                };
                let fill = scale.colour(share);
                canvas.rect(place, fill, 1.0);
                let at = (x + 0.5 * cell, y + 0.5 * row);
                if size >= 8.0 {
                    let text = words(at, texts[j][i].clone(), Align::Centre);
                    canvas.text(Text { size, colour: ink_on(fill), ..text });
                }
            }
        }
        for i in 1..self.x.len() {
            let x = area.left + i as f64 * cell;
            canvas.line((x, area.top), (x, area.bottom), Stroke::solid(WHITE, 1.0));
        }
        for j in 1..self.y.len() {
            let y = area.top + j as f64 * row;
            canvas.line((area.left, y), (area.right, y), Stroke::solid(WHITE, 1.0));
        }
        left_out
    }

    /// Names of rows and columns and both labels; returns the height used below the cells.
    fn names(&self, canvas: &mut Canvas, area: Rect, (cell, row): Point, room: f64) -> f64 {
        for (j, name) in self.y.iter().enumerate() {
            let lines = text::wrap(name, frame::SIZE, false, room + 1.0);
            let middle = area.top + (j as f64 + 0.5) * row;
            for (k, line) in lines.iter().enumerate() {
                let y = middle + (k as f64 - 0.5 * (lines.len() - 1) as f64) * 16.0;
                canvas.text(words((area.left - 8.0, y), line, Align::Right));
            }
        }
        let per_size = text::widest(self.x.iter().map(String::as_str), 1.0);
        let size = ((cell - 4.0) / per_size.max(0.1)).clamp(11.0, frame::SIZE);
        let mut below: f64 = 0.0;
        for (i, name) in self.x.iter().enumerate() {
            let x = area.left + (i as f64 + 0.5) * cell;
            let lines = text::wrap(name, size, false, cell - 3.0);
            below = below.max(lines.len() as f64 * frame::LINE);
            for (k, line) in lines.into_iter().enumerate() {
                let at = (x, area.bottom + 5.0 + (k as f64 + 0.5) * frame::LINE);
                canvas.text(Text { size, ..words(at, line, Align::Centre) });
            }
        }
        let middle = 0.5 * (area.top + area.bottom);
        let at = (area.left - room - 10.0 - 0.5 * frame::LINE, middle);
        canvas.text(Text { upwards: true, ..words(at, self.y_label.clone(), Align::Centre) });
        let centre = 0.5 * (area.left + area.right);
        8.0 + below
            + frame::paragraph(canvas, &self.x_label, centre, area.bottom + 8.0 + below, area.width(), false)
    }
}

/// Slanted lines: no value.
fn hatch(canvas: &mut Canvas, place: Rect) {
    let stroke = Stroke::solid(HATCH, 1.0);
    let mut start = place.left - place.height();
    while start < place.right {
        // From the lower edge up to the right, cut at the cell's sides.
        let (x0, x1) = (start.max(place.left), (start + place.height()).min(place.right));
        if x1 > x0 {
            canvas.line((x0, place.bottom - (x0 - start)), (x1, place.bottom - (x1 - start)), stroke);
        }
        start += 9.0;
    }
}
