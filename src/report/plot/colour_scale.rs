//! Colours for the cells of a heat map.

use super::style::{BLACK, Rgb, WHITE};

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

/// Black or white, whichever reads better on this colour (relative luminance of WCAG 2).
pub(super) fn ink_on((r, g, b): Rgb) -> Rgb {
    let linear = |c: u8| libm::pow((f64::from(c) / 255.0 + 0.055) / 1.055, 2.4);
    let light = 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
    if light > 0.179 { BLACK } else { WHITE }
}
