//! Round holes through a plate.
//!
//! No material lies in the open disc |x − c| < r, and the rule has two parts. A node is removed when its centre lies in
//! the disc: it has no bonds, no mass, no load, does not move and belongs to no region. A bond is cut when it passes
//! through the disc, though both of its ends are outside: it would pull across the void. (Removing nodes alone, as is
//! often done, leaves such bonds where the rim bends within the horizon.) What touches the circle stays, to 1e-9 of
//! the spacing, so that a circle drawn through nodes does not depend on rounding. Beyond an edge that mirrors or repeats
//! the body there are images of the hole.

use super::{Positive, Wrong};
use crate::constraints::{Edge, Edges};
use schemars::JsonSchema;
use serde::Deserialize;

/// A hole as written.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HoleAsked {
    /// Its centre, in m.
    pub centre_m: [f64; 2],
    /// Its radius, in m.
    pub radius_m: Positive,
}

/// A hole, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hole {
    pub centre: [f64; 2],
    pub radius: f64,
}

/// What is taken for nothing, in spacings.
const SLACK: f64 = 1e-9;

impl HoleAsked {
    /// The hole, refused where it does not reach a plate of this size.
    pub fn check(&self, size: [f64; 2]) -> Result<Hole, Wrong> {
        let hole = Hole { centre: self.centre_m, radius: self.radius_m.0 };
        let nearest: [f64; 2] = std::array::from_fn(|axis| hole.centre[axis].clamp(0.0, size[axis]));
        let away = distance(nearest, hole.centre);
        if away >= hole.radius {
            let message = format!(
                "the hole lies outside the plate: its centre is {away} m away from it, and its radius is {} m",
                hole.radius
            );
            let help = format!(
                "move it: the plate reaches from (0, 0) to ({}, {}) m, or leave it out",
                size[0], size[1]
            );
            return Err(Wrong::new("centre_m", message, help));
        }
        Ok(hole)
    }
}

impl Hole {
    /// The corners of its box, in m.
    pub(crate) fn bounds(&self) -> [[f64; 2]; 2] {
        [self.centre.map(|x| x - self.radius), self.centre.map(|x| x + self.radius)]
    }

    /// Whether a node at this place is removed.
    pub fn holds(&self, x: [f64; 2], spacing: f64) -> bool {
        // Squares: this is asked of every bond.
        let (away, reach) = ([x[0] - self.centre[0], x[1] - self.centre[1]], self.radius - SLACK * spacing);
        reach > 0.0 && away[0] * away[0] + away[1] * away[1] < reach * reach
    }

    /// Whether it cuts the bond from a to b, in m: some point between them, ends included, lies in it.
    pub fn cuts(&self, a: [f64; 2], b: [f64; 2], spacing: f64) -> bool {
        let (along, to) = ([b[0] - a[0], b[1] - a[1]], [self.centre[0] - a[0], self.centre[1] - a[1]]);
        let square = along[0] * along[0] + along[1] * along[1];
        let share = ((along[0] * to[0] + along[1] * to[1]) / square).clamp(0.0, 1.0);
        self.holds([a[0] + share * along[0], a[1] + share * along[1]], spacing)
    }

    /// The holes of a body and their images in and around it, as far as a body away: two periods to each side, since a
    /// hole may reach over a periodic edge, and one reflection, since one whose centre lies in the body does not reach
    /// further into its image than that image's own.
    pub(crate) fn with_images<const D: usize>(holes: &[Self], edges: &Edges<D>, size: [f64; D]) -> Vec<Self> {
        let mut all = holes.to_vec();
        for (axis, [below, above]) in edges.0.into_iter().enumerate() {
            let length = size[axis];
            let mirrors = |edge: Edge| matches!(edge, Edge::MirrorOdd | Edge::MirrorEven);
            let image = |hole: &Self| {
                let at = hole.centre[axis];
                let mut places = Vec::new();
                if mirrors(below) {
                    places.push(-at);
                }
                if mirrors(above) {
                    places.push(2.0 * length - at);
                }
                if below == Edge::Periodic {
                    places.extend([-2.0, -1.0, 1.0, 2.0].map(|periods| at + periods * length));
                }
                let near = |place: &f64| place + hole.radius > -length && place - hole.radius < 2.0 * length;
                places.into_iter().filter(near).map(|place| hole.moved(axis, place)).collect::<Vec<_>>()
            };
            let more: Vec<Self> = all.iter().flat_map(image).collect();
            all.extend(more);
        }
        all
    }

    /// The same hole with its centre elsewhere along an axis.
    fn moved(&self, axis: usize, to: f64) -> Self {
        let mut centre = self.centre;
        centre[axis] = to;
        Self { centre, ..*self }
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROUND: Hole = Hole { centre: [3.0, 2.0], radius: 1.0 };

    #[test]
    fn nodes_within_are_removed_and_those_on_the_circle_stay() {
        for (x, within) in [([3.0, 2.0], true), ([3.9, 2.0], true), ([4.0, 2.0], false), ([3.0, 3.1], false)]
        {
            assert_eq!(ROUND.holds(x, 1.0), within, "{x:?}");
        }
        // 3-4-5: on the circle of radius 5 whatever the rounding.
        let scale = 0.1 + 0.2;
        let through = Hole { centre: [0.0; 2], radius: 5.0 * scale };
        assert!(!through.holds([3.0 * scale, 4.0 * scale], scale));
        assert!(!through.holds([3.0 * scale * (1.0 - 1e-11), 4.0 * scale], scale));
        assert!(through.holds([3.0 * scale * (1.0 - 1e-8), 4.0 * scale], scale));
    }

    #[test]
    fn bonds_that_pass_through_are_cut_and_those_that_touch_or_miss_are_not() {
        let cut = |a, b| {
            assert_eq!(ROUND.cuts(a, b, 1.0), ROUND.cuts(b, a, 1.0));
            ROUND.cuts(a, b, 1.0)
        };
        assert!(cut([1.0, 2.0], [5.0, 2.0]) && cut([2.0, 1.5], [3.0, 0.9]) && cut([1.0, 2.0], [3.0, 2.0]));
        assert!(!cut([2.0, 1.0], [4.0, 1.0]), "along the tangent");
        assert!(!cut([0.0, 2.0], [2.0, 2.0]), "up to the circle");
        assert!(!cut([0.0, 2.0], [1.9, 2.0]), "its line meets the disc beyond its end");
        assert!(!cut([2.0, 1.2], [2.9, 0.7]));
    }

    #[test]
    fn images_lie_beyond_the_edges_that_have_them() {
        let centres = |edges| {
            let all = Hole::with_images(&[ROUND], &Edges(edges), [10.0, 4.0]);
            let mut centres: Vec<_> = all.iter().map(|hole| hole.centre.map(|x| x as i64)).collect();
            centres.sort_unstable();
            centres
        };
        use Edge::{Free, MirrorEven, MirrorOdd, Periodic};
        assert_eq!(centres([[Free; 2]; 2]), [[3, 2]]);
        assert_eq!(centres([[MirrorOdd, Free], [Free; 2]]), [[-3, 2], [3, 2]]);
        assert_eq!(centres([[Free, MirrorEven], [MirrorOdd, Free]]), [[3, -2], [3, 2], [17, -2], [17, 2]]);
        // Two periods away it reaches neither the body nor its neighbours.
        assert_eq!(centres([[Periodic; 2], [Free; 2]]), [[-7, 2], [3, 2], [13, 2]]);
    }

    #[test]
    fn holes_outside_are_refused() {
        let asked = |centre_m, radius| HoleAsked { centre_m, radius_m: Positive(radius) }.check([4.0, 3.0]);
        assert_eq!(asked([6.0, 1.0], 1.0).unwrap_err().key, "centre_m");
        assert!(asked([-3.0, -4.0], 5.0).unwrap_err().message.contains("is 5 m away"));
        assert_eq!(asked([4.5, 1.0], 1.0), Ok(Hole { centre: [4.5, 1.0], radius: 1.0 }));
    }
}
