//! The edges of a body: free, mirrored, or periodic. Ghost nodes beyond an edge take their motion from the body.
//!
//! Named after the displacement normal to the edge. `mirror_odd`: u(−x) = −u(x), the plane of the edge does not move, a
//! plane of symmetry. `mirror_even`: u(−x) = u(x), an edge without strain, in a bar the free end of the local theory.
//! The tangential displacement of a plate is of the other parity. At a free edge the bonds beyond are missing.

use crate::grid::Grid;
use crate::scene::{Side, Wrong};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::Range;

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

    /// Of a component beyond an edge across an axis.
    fn sign(self, component: usize, axis: usize) -> f64 {
        match self {
            Self::MirrorOdd if component == axis => -1.0,
            Self::MirrorEven if component != axis => -1.0,
            _ => 1.0,
        }
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
        if D > 1 {
            self.fill_beside(grid, &mut field[grid.body()]);
        }
        for ghost in self.ghosts(grid) {
            let (from, to) = (ghost.sources(), ghost.places());
            let source: Vec<f64> = field[from].to_vec();
            ghost.fill(&source, &mut field[to]);
        }
    }

    /// Fills the ghosts beyond left and right in whole rows of a plate.
    pub fn fill_beside(&self, grid: &Grid<D>, rows: &mut [f64]) {
        let first = grid.place([0; D]) % grid.row();
        for row in rows.chunks_exact_mut(grid.row()) {
            for (end, &edge) in self.0[0].iter().enumerate().filter(|(_, edge)| **edge != Edge::Free) {
                for depth in 0..grid.halo as isize {
                    let (ghost, source) = repeated(edge, end, depth, grid.nodes[0] as isize);
                    for component in 0..D {
                        let at =
                            |column: isize| (first + component * grid.stride()).wrapping_add_signed(column);
                        row[at(ghost)] = edge.sign(component, 0) * row[at(source)];
                    }
                }
            }
        }
    }

    /// Whether the body goes on beyond its last piece of work at its first.
    pub fn repeats_pieces(&self) -> bool {
        self.0[D - 1][0] == Edge::Periodic
    }

    /// The ghosts beyond the ends of the last axis: rows of a plate, nodes of a bar.
    pub fn ghosts(&self, grid: &Grid<D>) -> Vec<Ghost<D>> {
        let axis = D - 1;
        let mut ghosts = Vec::new();
        for (end, &edge) in self.0[axis].iter().enumerate().filter(|(_, edge)| **edge != Edge::Free) {
            for depth in 0..grid.halo as isize {
                let (ghost, source) = repeated(edge, end, depth, grid.nodes[axis] as isize);
                let at = |line: isize| {
                    let mut node = [0; D];
                    node[axis] = line;
                    let place = grid.place(node);
                    if D == 1 { place } else { place - place % grid.row() }
                };
                let signs = std::array::from_fn(|component| edge.sign(component, axis));
                let len = if D == 1 { 1 } else { grid.stride() };
                ghosts.push(Ghost { source: at(source), place: at(ghost), len, signs });
            }
        }
        ghosts
    }
}

/// A ghost beyond an end of an axis with so many nodes, and the node that it repeats.
fn repeated(edge: Edge, end: usize, depth: isize, nodes: isize) -> (isize, isize) {
    let last = nodes - 1;
    let (ghost, mirrored, repeated) = match end {
        0 => (-1 - depth, depth, last - depth),
        _ => (last + 1 + depth, last - depth, depth),
    };
    (ghost, if edge == Edge::Periodic { repeated } else { mirrored })
}

/// A row of ghosts of a plate, or a ghost of a bar, by its places in a field.
#[derive(Debug, Clone, PartialEq)]
pub struct Ghost<const D: usize> {
    source: usize,
    place: usize,
    /// Of one component.
    len: usize,
    signs: [f64; D],
}

impl<const D: usize> Ghost<D> {
    /// Where it lies.
    pub fn places(&self) -> Range<usize> {
        self.place..self.place + D * self.len
    }

    /// What it repeats.
    pub fn sources(&self) -> Range<usize> {
        self.source..self.source + D * self.len
    }

    /// The ghosts of `source`.
    pub fn fill(&self, source: &[f64], ghosts: &mut [f64]) {
        for (component, sign) in self.signs.iter().enumerate() {
            let part = component * self.len..(component + 1) * self.len;
            let pairs = ghosts[part.clone()].iter_mut().zip(&source[part]);
            pairs.for_each(|(ghost, source)| *ghost = sign * source);
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
