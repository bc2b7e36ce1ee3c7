//! How a curve looks: colour, dashes and marker, chosen so that curves differ for every eye and on a grey printer.

/// Red, green and blue, 0 to 255.
pub(super) type Rgb = (u8, u8, u8);

pub(super) const BLACK: Rgb = (0, 0, 0);
pub(super) const INK: Rgb = (40, 40, 40);
pub(super) const GREY: Rgb = (128, 128, 128);
pub(super) const WHITE: Rgb = (255, 255, 255);

/// Okabe and Ito's colours for every kind of colour vision, without yellow (too light on white) and black (kept for
/// references), and two dark ones of Tol's that differ from them.
const SLOTS: [Rgb; 8] = [
    (0, 114, 178),
    (213, 94, 0),
    (0, 158, 115),
    (204, 121, 167),
    (86, 180, 233),
    (230, 159, 0),
    (136, 34, 85),
    (102, 102, 0),
];
const DASHES: [Dash; 6] =
    [Dash::Solid, Dash::Dashed, Dash::DashDot, Dash::Dotted, Dash::LongDash, Dash::DashDotDot];
const MARKERS: [Marker; 8] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Cross,
    Marker::Plus,
    Marker::TriangleDown,
    Marker::Ring,
];

/// What colours a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Colour {
    /// The next free slot of the panel.
    #[default]
    Auto,
    /// This slot of the palette, counted from 0; the same slot looks the same in every figure.
    Slot(usize),
    /// For the exact or reference curve.
    Black,
    /// For a second, weaker reference.
    Grey,
}

/// Dashes of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    Solid,
    Dashed,
    Dotted,
    DashDot,
    LongDash,
    DashDotDot,
}

impl Dash {
    /// Lengths of dashes and gaps in line widths.
    pub(super) fn lengths(self) -> &'static [f64] {
        match self {
            Self::Solid => &[],
            Self::Dashed => &[4.0, 2.2],
            Self::Dotted => &[1.1, 1.7],
            Self::DashDot => &[5.0, 1.8, 1.1, 1.8],
            Self::LongDash => &[8.0, 2.4],
            Self::DashDotDot => &[5.0, 1.6, 1.1, 1.6, 1.1, 1.6],
        }
    }
}

/// Shape of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    Cross,
    Plus,
    TriangleDown,
    Ring,
}

/// Look of one series; what is left open follows from the colour's slot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Style {
    pub colour: Colour,
    /// Whether a line joins the points.
    pub line: bool,
    /// Whether each point has a marker.
    pub markers: bool,
    /// `None`: the slot's own.
    pub dash: Option<Dash>,
    /// `None`: the slot's own.
    pub marker: Option<Marker>,
    /// Width of the line in pixels.
    pub width: f64,
}

impl Style {
    /// The look once the slot is known: `free` is used where the colour is automatic.
    pub(super) fn pen(&self, free: usize) -> Pen {
        let (colour, slot) = match self.colour {
            Colour::Auto => (slot_colour(free), free),
            Colour::Slot(slot) => (slot_colour(slot), slot),
            Colour::Black => (BLACK, 0),
            Colour::Grey => (GREY, 0),
        };
        Pen {
            colour,
            width: if self.width.is_finite() { self.width.clamp(0.2, 12.0) } else { 2.0 },
            dash: self.line.then(|| self.dash.unwrap_or(DASHES[slot % DASHES.len()])),
            marker: self.markers.then(|| self.marker.unwrap_or(MARKERS[slot % MARKERS.len()])),
        }
    }
}

pub(super) fn slot_colour(slot: usize) -> Rgb {
    SLOTS[slot % SLOTS.len()]
}

/// A style with every choice made; no dash: no line, no marker: no markers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pen {
    pub colour: Rgb,
    pub width: f64,
    pub dash: Option<Dash>,
    pub marker: Option<Marker>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_eight_slots_differ_in_colour_and_marker_and_neighbours_in_dash() {
        let style =
            Style { colour: Colour::Auto, line: true, markers: true, dash: None, marker: None, width: 2.0 };
        let pens: Vec<Pen> = (0..8).map(|slot| style.pen(slot)).collect();
        for (i, a) in pens.iter().enumerate() {
            for b in &pens[i + 1..] {
                assert_ne!(a.colour, b.colour);
                assert_ne!(a.marker, b.marker);
            }
        }
        assert!(pens.windows(2).all(|pair| pair[0].dash != pair[1].dash));
    }
}
