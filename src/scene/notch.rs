//! Notches: straight cuts through a plate, which part the bonds that cross them and remove no material.
//!
//! A node on the line of a notch belongs to its left, seen along the notch. A bond is cut when its ends lie on different
//! sides and it crosses the line between the tips, the tips included. Both are decided to 1e-9 of the spacing, so that
//! a notch drawn through nodes does not depend on rounding.

use super::{RunsAsked, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// A notch as written.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NotchAsked {
    /// One end, in m.
    pub from_m: [f64; 2],
    /// The other end: the tip, where the notch runs.
    pub to_m: [f64; 2],
    /// Whether its tip goes on, cutting bonds as it passes them.
    pub runs: Option<RunsAsked>,
}

/// A notch from one end to the other, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Notch {
    pub from: [f64; 2],
    pub to: [f64; 2],
}

/// What is taken for nothing, in spacings.
pub(crate) const SLACK: f64 = 1e-9;

impl NotchAsked {
    /// The notch, refused where it leaves a plate of this size or is shorter than a cell.
    pub fn check(&self, size: [f64; 2], spacing: f64) -> Result<Notch, Wrong> {
        for (key, end) in [("from_m", self.from_m), ("to_m", self.to_m)] {
            let slack = SLACK * spacing;
            if let Some(axis) = (0..2).find(|&axis| !(-slack..=size[axis] + slack).contains(&end[axis])) {
                let message = format!(
                    "the notch leaves the body: {} m along {}, and the body reaches from 0 to {} m",
                    end[axis],
                    ["x", "y"][axis],
                    size[axis]
                );
                return Err(Wrong::new(key, message, "let it end at the edge or inside"));
            }
        }
        let notch = Notch { from: self.from_m, to: self.to_m };
        if notch.length() < (1.0 - SLACK) * spacing {
            let message = format!("a notch of {} m is shorter than a cell of {spacing} m", notch.length());
            return Err(Wrong::new("to_m", message, "let it pass between nodes, over a cell or more"));
        }
        Ok(notch)
    }
}

impl Notch {
    pub(crate) fn length(&self) -> f64 {
        libm::hypot(self.to[0] - self.from[0], self.to[1] - self.from[1])
    }

    /// The corners of its box, in m.
    pub(crate) fn bounds(&self) -> [[f64; 2]; 2] {
        let Self { from, to } = self;
        [[0, 1].map(|axis| from[axis].min(to[axis])), [0, 1].map(|axis| from[axis].max(to[axis]))]
    }

    /// Whether it cuts the bond from a to b, in m.
    pub fn cuts(&self, a: [f64; 2], b: [f64; 2], spacing: f64) -> bool {
        let (slack, length) = (SLACK * spacing, self.length());
        self.crossing(a, b, spacing).is_some_and(|way| (-slack..=length + slack).contains(&way))
    }

    /// Where the bond from a to b crosses its line, in m from its beginning; `None` where both ends are on one side.
    pub(crate) fn crossing(&self, a: [f64; 2], b: [f64; 2], spacing: f64) -> Option<f64> {
        let (slack, length) = (SLACK * spacing, self.length());
        let along = [self.to[0] - self.from[0], self.to[1] - self.from[1]];
        // How far a point lies to the left of the line of the notch, in m.
        let left =
            |x: [f64; 2]| (along[0] * (x[1] - self.from[1]) - along[1] * (x[0] - self.from[0])) / length;
        let (left_a, left_b) = (left(a), left(b));
        if (left_a >= -slack) == (left_b >= -slack) {
            return None;
        }
        let share = (left_a / (left_a - left_b)).clamp(0.0, 1.0);
        let crossing = [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
        let unit = along.map(|x| x / length);
        Some(unit[0] * (crossing[0] - self.from[0]) + unit[1] * (crossing[1] - self.from[1]))
    }

    /// The same notch with a coordinate mirrored about a place.
    pub(crate) fn mirrored(self, axis: usize, about: f64) -> Self {
        let mirror = |mut x: [f64; 2]| {
            x[axis] = 2.0 * about - x[axis];
            x
        };
        // The sides change with the mirror; turning the notch around keeps a node on it on the mirrored side.
        Self { from: mirror(self.to), to: mirror(self.from) }
    }

    /// The same notch moved along an axis.
    pub(crate) fn moved(self, axis: usize, way: f64) -> Self {
        let by = |mut x: [f64; 2]| {
            x[axis] += way;
            x
        };
        Self { from: by(self.from), to: by(self.to) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ACROSS: Notch = Notch { from: [0.0, 2.0], to: [3.0, 2.0] };

    #[test]
    fn bonds_that_cross_are_cut_tips_included_and_no_others() {
        let cut = |a, b| ACROSS.cuts(a, b, 1.0) && ACROSS.cuts(b, a, 1.0);
        assert!(cut([1.5, 1.5], [1.5, 2.5]) && cut([0.5, 0.5], [2.5, 3.5]));
        assert!(cut([2.5, 1.5], [3.5, 2.5]), "through the tip");
        assert!(!cut([2.6, 1.5], [3.6, 2.5]), "beside the tip");
        assert!(!cut([0.5, 2.5], [2.5, 3.5]) && !cut([4.5, 1.5], [4.5, 2.5]));
        // A node on the notch belongs to its left, which is above.
        assert!(cut([1.0, 2.0], [1.0, 1.0]) && !cut([1.0, 2.0], [1.0, 3.0]));
        assert!(cut([1.0, 2.0 + 1e-12], [1.0, 1.0]) && cut([1.0, 2.0 - 1e-12], [1.0, 1.0]));
    }

    #[test]
    fn images_cut_the_images_of_bonds() {
        let slanted = Notch { from: [0.3, 0.4], to: [2.0, 1.7] };
        let (a, b) = ([1.0, 0.5], [1.0, 1.5]);
        assert!(slanted.cuts(a, b, 1.0));
        let mirror = |x: [f64; 2]| [-x[0], x[1]];
        assert!(slanted.mirrored(0, 0.0).cuts(mirror(a), mirror(b), 1.0));
        assert!(slanted.moved(1, 5.0).cuts([1.0, 5.5], [1.0, 6.5], 1.0));
    }

    #[test]
    fn notches_outside_and_tiny_ones_are_refused() {
        let asked = |from_m, to_m| {
            NotchAsked { from_m, to_m, runs: None }.check([4.0, 3.0], 1.0).map_err(|wrong| wrong.key)
        };
        assert_eq!(asked([0.0, 1.0], [5.0, 1.0]), Err("to_m".into()));
        assert_eq!(asked([0.0, -1.0], [2.0, 1.0]), Err("from_m".into()));
        assert_eq!(asked([1.0, 1.0], [1.5, 1.0]), Err("to_m".into()));
        assert!(asked([0.0, 1.0], [4.0, 3.0]).is_ok());
    }
}
