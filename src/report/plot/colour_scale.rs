//! Colours for cells: how values become colours, and the scale drawn beside the cells.

use super::PlotError;
use super::axis::{Axis, Scale, Span};
use super::canvas::{Align, Canvas, Stroke, Text};
use super::clip::Rect;
use super::frame::{self, words};
use super::style::{BLACK, GREY, INK, Rgb, WHITE};
use super::text;
use super::ticks::{Ticks, fitting};

/// Viridis: lighter is larger for every eye and on a grey printer.
const SEQUENTIAL: [Rgb; 9] = [
    (68, 1, 84),
    (72, 40, 120),
    (62, 74, 137),
    (49, 104, 142),
    (38, 130, 142),
    (31, 158, 137),
    (53, 183, 121),
    (109, 205, 89),
    (253, 231, 37),
];
/// Blue below, white at the centre, red above; both ends dark.
const DIVERGING: [Rgb; 9] = [
    (33, 102, 172),
    (67, 147, 195),
    (146, 197, 222),
    (209, 229, 240),
    (247, 247, 247),
    (253, 219, 199),
    (244, 165, 130),
    (214, 96, 77),
    (178, 24, 43),
];

/// How values become colours.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Colours {
    /// From dark to light.
    #[default]
    Sequential,
    /// Two colours away from a centre, which is white.
    Diverging { centre: f64 },
}

impl Colours {
    /// The colour at a share of the scale, 0 to 1.
    pub(super) fn at(self, share: f64) -> Rgb {
        let stops = match self {
            Self::Sequential => SEQUENTIAL,
            Self::Diverging { .. } => DIVERGING,
        };
        let place = share.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
        let first = (place as usize).min(stops.len() - 2);
        let t = place - first as f64;
        let mix = |a: u8, b: u8| (f64::from(a) + t * (f64::from(b) - f64::from(a))).round() as u8;
        let (a, b) = (stops[first], stops[first + 1]);
        (mix(a.0, b.0), mix(a.1, b.1), mix(a.2, b.2))
    }
}

/// Between cells and bar, across the bar, and between the bar and its label beside the tick labels.
const GAP: f64 = 16.0;
const BAR: f64 = 16.0;
const BESIDE: f64 = 14.0;

/// The colours of an axis over the range that is shown.
#[derive(Debug)]
pub(super) struct ColourScale<'a> {
    axis: &'a Axis,
    colours: Colours,
    /// From 0 to 1.
    share: Span,
}

impl<'a> ColourScale<'a> {
    /// A scale for these values; about its centre it is symmetric.
    pub fn new(axis: &'a Axis, colours: Colours, values: &[Vec<Option<f64>>]) -> Result<Self, PlotError> {
        let (mut lo, mut hi) = axis.span(values.iter().flatten().flatten().copied(), 0.0)?;
        if let Colours::Diverging { centre } = colours {
            let of = |v| axis.scale.of(v);
            if !of(centre).is_finite() {
                return Err(PlotError::Range { axis: axis.label.clone(), lo: centre, hi: centre });
            }
            let far = (of(hi) - of(centre)).abs().max((of(centre) - of(lo)).abs());
            (lo, hi) = match axis.scale {
                Scale::Linear => (centre - far, centre + far),
                Scale::Log => (centre / libm::pow(10.0, far), centre * libm::pow(10.0, far)),
            };
        }
        Ok(Self { axis, colours, share: Span { scale: axis.scale, lo, hi, start: 0.0, end: 1.0 } })
    }

    /// Where the value stands on the scale, 0 to 1 and beyond; None where it has no place.
    pub fn share(&self, value: f64) -> Option<f64> {
        let share = self.share.at(value);
        (value.is_finite() && share.is_finite()).then_some(share)
    }

    /// The colour at a share of the scale.
    pub fn colour(&self, share: f64) -> Rgb {
        self.colours.at(share)
    }

    fn ticks(&self, height: f64) -> Ticks {
        fitting(self.share.scale, self.share.lo, self.share.hi, height, false, frame::SIZE)
    }

    fn label(&self, ticks: &Ticks, height: f64) -> Vec<String> {
        text::wrap(&frame::full_label(self.axis, ticks), frame::SIZE, false, height + 40.0)
    }

    /// Width needed right of cells of this height: a gap, the bar, its tick labels and its label; at least so much that
    /// the cells of most panels are equally wide.
    pub fn room(&self, height: f64) -> f64 {
        self.room_from(height, 112.0)
    }

    /// The same from another least width on.
    pub fn room_from(&self, height: f64, least: f64) -> f64 {
        let ticks = self.ticks(height);
        let lines = self.label(&ticks, height).len() as f64;
        (GAP + BAR + BESIDE + ticks.widest(frame::SIZE) + lines * frame::LINE).max(least)
    }

    /// Draws the scale right of the cells.
    pub fn draw(&self, canvas: &mut Canvas, area: Rect) {
        let strip = Rect { left: area.right + GAP, right: area.right + GAP + BAR, ..area };
        let steps = 64;
        let high = strip.height() / f64::from(steps);
        for i in 0..steps {
            let bottom = strip.bottom - f64::from(i) * high;
            // Half a pixel of overlap hides seams between the steps.
            let piece = Rect { top: (bottom - high - 0.5).max(strip.top), bottom, ..strip };
            canvas.rect(piece, self.colours.at((f64::from(i) + 0.5) / f64::from(steps)), 1.0);
        }
        canvas.outline(strip, Stroke::solid(GREY, 1.0));
        let ticks = self.ticks(strip.height());
        let up = Span { start: strip.bottom, end: strip.top, ..self.share };
        for (value, label) in ticks.labelled() {
            let y = up.at(value);
            canvas.line((strip.right, y), (strip.right + 5.0, y), Stroke::solid(INK, 1.0));
            canvas.text(words((strip.right + 8.0, y), label, Align::Left));
        }
        let mut x = strip.right + BESIDE + ticks.widest(frame::SIZE) + 0.5 * frame::LINE;
        for line in self.label(&ticks, strip.height()) {
            let at = (x, 0.5 * (strip.top + strip.bottom));
            canvas.text(Text { upwards: true, ..words(at, line, Align::Centre) });
            x += frame::LINE;
        }
    }
}

/// Black or white, whichever reads better on this colour (relative luminance of WCAG 2).
pub(super) fn ink_on((r, g, b): Rgb) -> Rgb {
    let linear = |c: u8| libm::pow((f64::from(c) / 255.0 + 0.055) / 1.055, 2.4);
    let light = 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
    if light > 0.179 { BLACK } else { WHITE }
}
