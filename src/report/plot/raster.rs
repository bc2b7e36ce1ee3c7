//! A field over two numeric axes as coloured cells, with the colour scale beside it: space-time plots.

use super::PlotError;
use super::axis::{Axis, Span};
use super::canvas::{Canvas, Stroke};
use super::clip::{Point, Rect};
use super::colour_scale::{ColourScale, Colours};
use super::frame;
use super::left_out::LeftOut;
use super::style::{INK, Rgb};
use std::collections::BTreeMap;

/// Steps between the ends of the scale; cells of one shade are drawn together. Even, so that a centre is a shade.
const STEPS: f64 = 64.0;
/// Of a raster to scale.
const TALLEST: f64 = 400.0;
/// Least room for the colours of a raster to scale, which takes what is left.
const NARROW: f64 = 94.0;
/// In neither scale of colours.
const MISSING: Rgb = (176, 176, 176);

/// Values on a grid of equal cells.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Raster {
    /// May be empty.
    pub title: String,
    /// Its range is shared by the columns, equally on the axis' scale; without a range the axis counts columns.
    pub x: Axis,
    /// The same for the rows.
    pub y: Axis,
    /// Rows from low to high y, in each values from low to high x, all of one length; `None` is grey, as is what is
    /// not finite.
    pub values: Vec<Vec<Option<f64>>>,
    /// What the values are, with unit, their scale and the range of the colours; values beyond it have the colour of
    /// its end.
    pub value: Axis,
    pub colours: Colours,
    /// Whether a length is as long along x as along y.
    pub to_scale: bool,
}

impl Raster {
    /// A field; the ranges of `x` and `y` run from the first cell's outer edge to the last one's.
    pub fn new(x: Axis, y: Axis, value: Axis, values: Vec<Vec<Option<f64>>>) -> Self {
        Self { title: String::new(), x, y, values, value, colours: Colours::Sequential, to_scale: false }
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

    /// With the same scale along both axes, which then are places in one unit.
    pub fn to_scale(mut self) -> Self {
        self.to_scale = true;
        self
    }

    /// Every cell as (x, y, value), x and y of its middle, row by row; nothing where an axis is impossible.
    pub(in crate::report) fn points(&self) -> Vec<(f64, f64, Option<f64>)> {
        let Ok([x, y]) = self.ranges() else { return Vec::new() };
        let middles = |axis: &Axis, (lo, hi): (f64, f64), count: usize| -> Vec<f64> {
            let (lo, hi) = (axis.scale.of(lo), axis.scale.of(hi));
            let share = |i: usize| (i as f64 + 0.5) / count as f64;
            (0..count).map(|i| axis.scale.back(lo + share(i) * (hi - lo))).collect()
        };
        let (across, up) = (middles(&self.x, x, self.columns()), middles(&self.y, y, self.values.len()));
        let rows = up.iter().zip(&self.values);
        rows.flat_map(|(&y, row)| across.iter().zip(row).map(move |(&x, &value)| (x, y, value))).collect()
    }

    /// As high as the room beside the axis and the colours allows, up to a limit.
    fn height_to_scale(&self, width: f64, scale: &ColourScale, [x, y]: [(f64, f64); 2]) -> f64 {
        let slope = (y.1 - y.0) / (x.1 - x.0);
        let fitting = |height: f64| {
            let ticks = frame::upright_ticks(&self.y, y, height);
            let room = width - frame::upright_room(&self.y, &ticks, height) - scale.room_from(height, NARROW);
            (slope * room).min(TALLEST)
        };
        // The rooms depend little on the height: twice is enough.
        fitting(fitting(TALLEST))
    }

    fn columns(&self) -> usize {
        self.values.first().map_or(0, Vec::len)
    }

    fn check(&self) -> Result<(), PlotError> {
        let expected = self.columns();
        if expected == 0 {
            return Err(PlotError::Empty);
        }
        match self.values.iter().find(|row| row.len() != expected) {
            Some(row) => Err(PlotError::Shape { what: "raster, columns".into(), found: row.len(), expected }),
            None => Ok(()),
        }
    }

    /// The ranges of both axes.
    fn ranges(&self) -> Result<[(f64, f64); 2], PlotError> {
        let range = |axis: &Axis, count: usize| axis.span([0.0, count as f64], 0.0);
        Ok([range(&self.x, self.columns())?, range(&self.y, self.values.len())?])
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
        let [x_range, y_range] = self.ranges()?;
        let height = match self.to_scale {
            true => self.height_to_scale(width, &scale, [x_range, y_range]),
            false => (0.56 * width).clamp(210.0, 400.0),
        };
        let y_ticks = frame::upright_ticks(&self.y, y_range, height);
        let room = frame::upright_room(&self.y, &y_ticks, height);
        let right = match self.to_scale {
            true => left + room + height * (x_range.1 - x_range.0) / (y_range.1 - y_range.0),
            false => left + width - scale.room(height),
        };
        let first = left + room;
        let x_ticks = frame::level_ticks(&self.x, x_range, right - first);
        let title = frame::paragraph(canvas, &self.title, 0.5 * (first + right), top, width - room, true);
        let above = top + title + 8.0;
        let area = Rect { left: first, top: above, right, bottom: above + height };
        let left_out = self.cells(canvas, area, &scale);
        canvas.outline(area, Stroke::solid(INK, 1.2));
        let y = Span { scale: self.y.scale, lo: y_range.0, hi: y_range.1, start: area.bottom, end: area.top };
        frame::upright_axis(canvas, area, &self.y, &y, &y_ticks);
        let x = Span { scale: self.x.scale, lo: x_range.0, hi: x_range.1, start: area.left, end: area.right };
        let below = frame::level_axis(canvas, area, &self.x, &x, &x_ticks);
        scale.draw(canvas, area);
        Ok((area.bottom + below - top, left_out))
    }

    fn cells(&self, canvas: &mut Canvas, area: Rect, scale: &ColourScale) -> LeftOut {
        let mut left_out = LeftOut::default();
        let mut shade = |value: Option<f64>| {
            let share = value.and_then(|v| scale.share(v));
            if share.is_none() {
                left_out.miss(value);
                left_out.grey_cells += 1;
            }
            share.map(|share| (share.clamp(0.0, 1.0) * STEPS).round() as usize)
        };
        let shades: Vec<Vec<Option<usize>>> =
            self.values.iter().map(|row| row.iter().map(|&value| shade(value)).collect()).collect();
        let (columns, rows) = (self.columns() as f64, shades.len() as f64);
        for (shade, blocks) in blocks(&shades) {
            let place = |block: &Block| Rect {
                left: area.left + block.from as f64 / columns * area.width(),
                right: area.left + block.to as f64 / columns * area.width(),
                top: area.bottom - block.above as f64 / rows * area.height(),
                bottom: area.bottom - block.below as f64 / rows * area.height(),
            };
            let colour = |shade: usize| scale.colour(shade as f64 / STEPS);
            canvas.cells(blocks.iter().map(place).collect(), shade.map_or(MISSING, colour));
        }
        left_out
    }
}

/// Cells of one shade: columns `from` up to `to`, rows `below` up to `above`, the ends not included.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Block {
    from: usize,
    to: usize,
    below: usize,
    above: usize,
}

/// The cells of each shade: runs of equal shade in a row, and equal runs of adjacent rows in one.
fn blocks(rows: &[Vec<Option<usize>>]) -> BTreeMap<Option<usize>, Vec<Block>> {
    let mut all: BTreeMap<Option<usize>, Vec<Block>> = BTreeMap::new();
    // Where a run of the row below stands among the blocks of its shade, by its columns.
    let mut beneath: BTreeMap<(usize, usize, Option<usize>), usize> = BTreeMap::new();
    for (row, shades) in rows.iter().enumerate() {
        let mut here = BTreeMap::new();
        let mut from = 0;
        for run in shades.chunk_by(|a, b| a == b) {
            let (shade, to) = (run[0], from + run.len());
            let blocks = all.entry(shade).or_default();
            let index = match beneath.get(&(from, to, shade)) {
                Some(&index) => {
                    blocks[index].above = row + 1;
                    index
                }
                None => {
                    blocks.push(Block { from, to, below: row, above: row + 1 });
                    blocks.len() - 1
                }
            };
            here.insert((from, to, shade), index);
            from = to;
        }
        beneath = here;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cell_is_in_one_block_of_its_shade() {
        let shade = |i: usize, j: usize| (i * j % 5 != 4).then_some(i * i * j % 7 / 3);
        let rows: Vec<Vec<Option<usize>>> = (0..9).map(|j| (0..13).map(|i| shade(i, j)).collect()).collect();
        let mut covered = vec![vec![0; 13]; 9];
        for (shade, blocks) in blocks(&rows) {
            for block in blocks {
                for j in block.below..block.above {
                    for i in block.from..block.to {
                        assert_eq!(rows[j][i], shade);
                        covered[j][i] += 1;
                    }
                }
            }
        }
        assert!(covered.iter().flatten().all(|&count| count == 1));
    }

    #[test]
    fn equal_runs_of_adjacent_rows_are_one_block() {
        let rows = vec![vec![Some(1), Some(1), None], vec![Some(1), Some(1), None], vec![Some(1); 3]];
        let found = blocks(&rows);
        let lower = Block { from: 0, to: 2, below: 0, above: 2 };
        let upper = Block { from: 0, to: 3, below: 2, above: 3 };
        assert_eq!(found[&Some(1)], vec![lower, upper]);
        assert_eq!(found[&None], vec![Block { from: 2, ..Block { to: 3, ..lower } }]);
    }

    #[test]
    fn points_are_the_middles_of_the_cells() {
        let (x, y) = (Axis::linear("x (m)").range(0.0, 1.0), Axis::log("t (s)").range(1.0, 1e4));
        let raster =
            Raster::new(x, y, Axis::linear("u (m)"), vec![vec![Some(1.0), None], vec![Some(2.0); 2]]);
        let points = raster.points();
        assert_eq!(points.iter().map(|point| point.0).collect::<Vec<_>>(), [0.25, 0.75, 0.25, 0.75]);
        assert!((points[0].1 - 10.0).abs() < 1e-12 && (points[3].1 - 1e3).abs() < 1e-9);
        assert_eq!(
            points.iter().map(|point| point.2).collect::<Vec<_>>(),
            [Some(1.0), None, Some(2.0), Some(2.0)]
        );
    }
}
