//! A figure's parts put together: title, panels in columns, legends, and the line about what was left out.

use super::canvas::{Align, Canvas, Text};
use super::clip::Point;
use super::left_out::LeftOut;
use super::legend::{self, Entry};
use super::style::{INK, Rgb};
use super::{Figure, Panel, PlotError, text};

const WIDTH: f64 = 760.0;
/// Least width of a panel among several.
const PANEL: f64 = 360.0;
const MARGIN: f64 = 14.0;
const BETWEEN: f64 = 22.0;
const TITLE: f64 = 17.0;
const SMALL: f64 = 13.0;
const FAINT: Rgb = (90, 90, 90);
/// Widest legend that still stands beside a plot.
const BESIDE: f64 = 225.0;

/// The figure as SVG text.
///
/// # Errors
/// [`PlotError`] where there is no panel, a range is impossible, a table does not match its names, or a slope
/// triangle stands in a plot that is not doubly logarithmic. Missing data is no error: it is left out and said so.
pub fn svg(figure: &Figure) -> Result<String, PlotError> {
    if figure.panels.is_empty() {
        return Err(PlotError::Empty);
    }
    let columns = figure.columns.clamp(1, figure.panels.len());
    let total = WIDTH.max(columns as f64 * (PANEL + BETWEEN) + 2.0 * MARGIN - BETWEEN);
    let mut canvas = Canvas::default();
    let mut y = MARGIN + heading(&mut canvas, &figure.title, total);

    let inner = total - 2.0 * MARGIN;
    let legends: Vec<Vec<Entry>> = figure.panels.iter().map(Panel::legend).collect();
    let shared = common(&legends);
    let mut left_out = LeftOut::default();
    let beside = shared.as_deref().filter(|entries| figure.panels.len() == 1 && stands_beside(entries));
    if let Some(entries) = beside {
        let room = legend::full_width(entries).min(BESIDE) + 1.0;
        let (height, out) = figure.panels[0].draw(&mut canvas, (MARGIN, y), inner - room - BETWEEN)?;
        let used = legend::draw(&mut canvas, entries, total - MARGIN - room, y + 12.0, room);
        left_out.add(out);
        y += height.max(used + 12.0);
    } else {
        let width = (inner - (columns - 1) as f64 * BETWEEN) / columns as f64;
        for (row, panels) in figure.panels.chunks(columns).enumerate() {
            let mut tallest: f64 = 0.0;
            for (i, panel) in panels.iter().enumerate() {
                let x = MARGIN + i as f64 * (width + BETWEEN);
                let (mut height, out) = panel.draw(&mut canvas, (x, y), width)?;
                left_out.add(out);
                if shared.is_none() {
                    let entries = &legends[row * columns + i];
                    height += 8.0 + legend::draw(&mut canvas, entries, x, y + height + 8.0, width);
                }
                tallest = tallest.max(height);
            }
            y += tallest + 16.0;
        }
        y -= 8.0;
        if let Some(entries) = &shared {
            y += legend::draw(&mut canvas, entries, MARGIN + 8.0, y, inner - 8.0);
        }
    }
    y += small_print(&mut canvas, &left_out.note(), y + 4.0, inner);
    let id = format!("figure-{}", figure.id);
    canvas.finish(total, y + MARGIN, &id, &figure.title, &figure.caption)
}

impl Panel {
    fn legend(&self) -> Vec<Entry> {
        match self {
            Self::Lines(lines) => lines.legend(),
            Self::Polar(polar) => polar.legend(),
            Self::HeatMap(_) | Self::Raster(_) => Vec::new(),
            Self::Dots(dots) => dots.legend(),
            Self::StackedBars(bars) => bars.legend(),
        }
    }

    fn draw(&self, canvas: &mut Canvas, corner: Point, width: f64) -> Result<(f64, LeftOut), PlotError> {
        match self {
            Self::Lines(lines) => lines.draw(canvas, corner, width),
            Self::Polar(polar) => polar.draw(canvas, corner, width),
            Self::HeatMap(map) => map.draw(canvas, corner, width),
            Self::Raster(raster) => raster.draw(canvas, corner, width),
            Self::Dots(dots) => dots.draw(canvas, corner, width),
            Self::StackedBars(bars) => bars.draw(canvas, corner, width),
        }
    }
}

/// One legend for all panels, unless the same look or the same name means different things in two of them.
fn common(legends: &[Vec<Entry>]) -> Option<Vec<Entry>> {
    let mut all: Vec<Entry> = Vec::new();
    for entry in legends.iter().flatten() {
        if all.contains(entry) {
            continue;
        }
        let clash = all.iter().any(|other| other.name == entry.name || other.key == entry.key);
        if clash && legends.len() > 1 {
            return None;
        }
        all.push(entry.clone());
    }
    Some(all)
}

/// Whether a legend is small enough to stand right of its plot.
fn stands_beside(entries: &[Entry]) -> bool {
    let room = legend::full_width(entries).min(BESIDE) + 1.0;
    !entries.is_empty() && legend::full_width(entries) < 1.6 * BESIDE && legend::height(entries, room) < 330.0
}

fn heading(canvas: &mut Canvas, title: &str, total: f64) -> f64 {
    let lines = text::wrap(title, TITLE, true, total - 2.0 * MARGIN);
    let height = lines.len() as f64 * 22.0 + 8.0;
    for (i, text) in lines.into_iter().enumerate() {
        let at = (MARGIN, MARGIN + (i as f64 + 0.5) * 22.0);
        canvas.text(Text {
            at,
            text,
            size: TITLE,
            colour: INK,
            align: Align::Left,
            bold: true,
            upwards: false,
        });
    }
    height
}

fn small_print(canvas: &mut Canvas, note: &str, top: f64, room: f64) -> f64 {
    let lines = text::wrap(note, SMALL, false, room);
    let height = lines.len() as f64 * 17.0;
    for (i, text) in lines.into_iter().enumerate() {
        let at = (MARGIN, top + (i as f64 + 0.5) * 17.0);
        canvas.text(Text {
            at,
            text,
            size: SMALL,
            colour: FAINT,
            align: Align::Left,
            bold: false,
            upwards: false,
        });
    }
    height
}
