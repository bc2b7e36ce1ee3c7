//! How an area looks: a colour of the palette, and lines over it that tell it from its neighbours in grey print.

use super::canvas::{Canvas, Stroke};
use super::clip::{Rect, clip};
use super::style::{BLACK, Rgb, WHITE, slot_colour};

/// Lines across an area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Hatch {
    Plain,
    Rising,
    Falling,
    Crossed,
    Upright,
    Level,
}

/// In the order of the palette: slots of like grey differ in their lines.
const HATCHES: [Hatch; 8] = [
    Hatch::Plain,
    Hatch::Rising,
    Hatch::Level,
    Hatch::Falling,
    Hatch::Plain,
    Hatch::Upright,
    Hatch::Plain,
    Hatch::Crossed,
];
/// Between the lines, in pixels along an edge.
const PITCH: f64 = 8.0;

/// Colour and lines of an area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fill {
    colour: Rgb,
    hatch: Hatch,
}

impl Fill {
    /// The look of a slot, counted from 0. Where the colours begin anew the lines move on by one: 16 looks.
    pub fn slot(slot: usize) -> Self {
        let count = HATCHES.len();
        Self { colour: slot_colour(slot), hatch: HATCHES[(slot + slot / count) % count] }
    }

    /// Fills a rectangle and draws its edges.
    pub fn draw(self, canvas: &mut Canvas, place: Rect) {
        canvas.rect(place, self.colour, 1.0);
        let (rising, falling, upright, level) = match self.hatch {
            Hatch::Plain => (false, false, false, false),
            Hatch::Rising => (true, false, false, false),
            Hatch::Falling => (false, true, false, false),
            Hatch::Crossed => (true, true, false, false),
            Hatch::Upright => (false, false, true, false),
            Hatch::Level => (false, false, false, true),
        };
        let Rect { left, top, right, bottom } = place;
        let (wide, high) = (place.width(), place.height());
        if rising {
            rule(canvas, place, wide + high, |s| [(left + s - high, bottom), (left + s, top)]);
        }
        if falling {
            rule(canvas, place, wide + high, |s| [(left + s - high, top), (left + s, bottom)]);
        }
        if upright {
            rule(canvas, place, wide, |s| [(left + s, top), (left + s, bottom)]);
        }
        if level {
            rule(canvas, place, high, |s| [(left, top + s), (right, top + s)]);
        }
        canvas.outline(place, Stroke::solid(BLACK, 0.8));
    }
}

/// Lines at equal distances, cut at the area's edges.
fn rule(canvas: &mut Canvas, place: Rect, length: f64, line: impl Fn(f64) -> [(f64, f64); 2]) {
    let mut s = 0.5 * PITCH;
    while s < length {
        for part in clip(&line(s), place) {
            canvas.path(part, Stroke::solid(WHITE, 1.4));
        }
        s += PITCH;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_do_not_repeat_within_two_palettes() {
        let fills: Vec<Fill> = (0..16).map(Fill::slot).collect();
        for (i, a) in fills.iter().enumerate() {
            assert!(fills[i + 1..].iter().all(|b| a != b), "{i}: {a:?}");
        }
    }

    #[test]
    fn neighbours_and_colours_of_like_grey_differ_in_their_lines() {
        // Rec. 709.
        let grey = |fill: Fill| {
            let (r, g, b) = fill.colour;
            0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
        };
        for i in 0..8 {
            for j in 0..i {
                let (a, b) = (Fill::slot(i), Fill::slot(j));
                // A tenth of black to white is seen without lines.
                let apart = (grey(a) - grey(b)).abs() > 25.5;
                assert!(apart || a.hatch != b.hatch, "{i} and {j}");
            }
            assert_ne!(Fill::slot(i).hatch, Fill::slot(i + 1).hatch, "{i}");
        }
    }
}
