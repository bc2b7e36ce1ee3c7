//! The edges of a body: free, mirrored, or periodic. Ghost nodes beyond an edge take their motion from the body.
//!
//! Named after the displacement normal to the edge. `mirror_odd`: u(−x) = −u(x), the plane of the edge does not move, a
//! plane of symmetry. `mirror_even`: u(−x) = u(x), an edge without strain, in a bar the free end of the local theory.
//! The tangential displacement of a plate is of the other parity. At a free edge the bonds beyond are missing.

use crate::grid::Grid;
use crate::scene::{Side, Wrong};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What lies beyond one edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Edge {
    /// Bonds beyond the edge are missing.
    #[default]
    Free,
    /// The displacement normal to the edge is odd, 0 there, the tangential one even: a plane of symmetry, a roller.
    MirrorOdd,
    /// The displacement normal to the edge is even, without strain across it, the tangential one odd.
    MirrorEven,
    /// The body repeats; the opposite edge must be periodic too.
    Periodic,
}

impl Edge {
    /// In study files and plans.
    pub fn name(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::MirrorOdd => "mirror_odd",
            Self::MirrorEven => "mirror_even",
            Self::Periodic => "periodic",
        }
    }

    /// The same in messages, with its other name.
    pub fn described(self) -> &'static str {
        if self == Self::MirrorOdd { "mirror_odd (a roller)" } else { self.name() }
    }
}

/// Lower and upper edge of each axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edges<const D: usize>(pub [[Edge; 2]; D]);

impl<const D: usize> Default for Edges<D> {
    fn default() -> Self {
        Self([[Edge::Free; 2]; D])
    }
}

impl<const D: usize> Edges<D> {
    /// Whether there are ghosts to fill.
    pub fn any(&self) -> bool {
        self.0.as_flattened().iter().any(|edge| *edge != Edge::Free)
    }

    /// Whether the bond from a node to its neighbour at `offset` exists.
    pub fn present(&self, nodes: [usize; D], node: [isize; D], offset: [i32; D]) -> bool {
        (0..D).all(|axis| {
            let to = node[axis] + offset[axis] as isize;
            let [below, above] = self.0[axis];
            (to >= 0 || below != Edge::Free) && (to < nodes[axis] as isize || above != Edge::Free)
        })
    }

    /// The node of the body that a node repeats, itself if it belongs to the body; `None` beyond a free edge and where
    /// no node stands.
    pub fn image(&self, grid: &Grid<D>, node: [isize; D]) -> Option<[isize; D]> {
        let mut image = node;
        for axis in 0..D {
            let count = grid.nodes[axis] as isize;
            let below = node[axis] < 0;
            if below || node[axis] >= count {
                image[axis] = match self.0[axis][usize::from(!below)] {
                    Edge::Free => return None,
                    Edge::Periodic => node[axis].rem_euclid(count),
                    Edge::MirrorOdd | Edge::MirrorEven if below => -1 - node[axis],
                    Edge::MirrorOdd | Edge::MirrorEven => 2 * count - 1 - node[axis],
                };
            }
        }
        grid.has(image).then_some(image)
    }

    /// Refuses to drive the nodes along an edge where the body goes on, or where its mirror holds them already.
    pub fn may_drive(&self, side: Side, axis: usize) -> Result<(), Wrong> {
        let (normal, upper) = side.end::<D>()?;
        let edge = self.0[normal][usize::from(upper)];
        let (name, described) = (side.name(), edge.described());
        let held = match edge {
            Edge::Free => false,
            Edge::Periodic => {
                let message =
                    format!("the {name} edge is periodic: the body goes on there, no edge can be driven");
                let help = "make the edge free, or drive nodes in a box by from_m and to_m";
                return Err(Wrong::new("region.edge", message, help));
            }
            Edge::MirrorOdd => axis == normal,
            Edge::MirrorEven => axis != normal,
        };
        if !held {
            return Ok(());
        }
        let message =
            format!("the {name} edge is {described}: its mirror holds it along {} already", ["x", "y"][axis]);
        Err(Wrong::new("axis", message, "leave this motion out, or make the edge free"))
    }

    /// Fills the ghosts of a field: the columns beyond left and right first, then whole rows below and above.
    pub fn fill(&self, grid: &Grid<D>, field: &mut [f64]) {
        if !self.any() {
            return;
        }
        for axis in 0..D {
            for (end, &edge) in self.0[axis].iter().enumerate().filter(|(_, edge)| **edge != Edge::Free) {
                for depth in 0..grid.halo as isize {
                    let last = grid.nodes[axis] as isize - 1;
                    let (ghost, mirrored, repeated) = match end {
                        0 => (-1 - depth, depth, last - depth),
                        _ => (last + 1 + depth, last - depth, depth),
                    };
                    let source = if edge == Edge::Periodic { repeated } else { mirrored };
                    copy(grid, field, axis, source, ghost, edge);
                }
            }
        }
    }
}

/// Copies a line of nodes (a column, or a row with its halo) to a ghost line, with the signs of the edge.
fn copy<const D: usize>(
    grid: &Grid<D>,
    field: &mut [f64],
    axis: usize,
    source: isize,
    ghost: isize,
    edge: Edge,
) {
    let at = |line: isize, along: isize| {
        let mut node = [along; D];
        node[axis] = line;
        grid.place(node)
    };
    let along = match (D, axis) {
        (1, _) => 0..1,
        (_, 0) => 0..grid.rows() as isize,
        _ => -(grid.halo as isize)..(grid.nodes[0] + grid.halo) as isize,
    };
    for along in along {
        for component in 0..D {
            let sign = match edge {
                Edge::MirrorOdd if component == axis => -1.0,
                Edge::MirrorEven if component != axis => -1.0,
                _ => 1.0,
            };
            let shift = component * grid.stride();
            field[at(ghost, along) + shift] = sign * field[at(source, along) + shift];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ghosts_repeat_the_body() {
        let grid = Grid::<2>::new([4, 3], 1.0, 2);
        let edges = Edges([[Edge::MirrorOdd, Edge::MirrorEven], [Edge::Periodic, Edge::Periodic]]);
        let mut field = grid.field();
        for (number, node) in grid.each().enumerate() {
            let place = grid.place(node);
            field[place] = number as f64 + 1.0;
            field[place + grid.stride()] = -(number as f64) - 1.0;
        }
        edges.fill(&grid, &mut field);
        let u = |node| [field[grid.place(node)], field[grid.place(node) + grid.stride()]];
        assert_eq!(u([-1, 0]), [-1.0, -1.0]);
        assert_eq!(u([-2, 0]), [-2.0, -2.0]);
        assert_eq!(u([4, 0]), [4.0, 4.0]);
        assert_eq!(u([1, 3]), u([1, 0]));
        assert_eq!(u([-2, -1]), u([-2, 2]));
        assert!(edges.present([4, 3], [0, 0], [-2, -2]));
        let free = Edges::<2>::default();
        assert!(!free.present([4, 3], [0, 0], [-1, 0]) && free.present([4, 3], [1, 1], [2, 1]));
    }
}
