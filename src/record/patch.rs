//! The nodes of a box, as a patch probe sees them: row by row along x.

use crate::grid::Grid;

/// Cells whose centres lie in a box.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Patch<const D: usize> {
    /// The one nearest to the origin.
    pub first: [isize; D],
    /// How many along each axis.
    pub nodes: [usize; D],
}

/// A corner meant to stand on a node must not miss it by rounding: in spacings.
const SLACK: f64 = 1e-9;

impl<const D: usize> Patch<D> {
    /// The cells of a body between two corners in m, the box's own edges included; there may be none.
    pub fn of(grid: &Grid<D>, from: [f64; D], to: [f64; D]) -> Self {
        let last = |axis: usize| grid.nodes[axis] as f64 - 1.0;
        let at = |x: f64| x / grid.spacing - 0.5;
        let low: [f64; D] =
            std::array::from_fn(|axis| (at(from[axis]) - SLACK).ceil().clamp(0.0, last(axis) + 1.0));
        let high: [f64; D] =
            std::array::from_fn(|axis| (at(to[axis]) + SLACK).floor().clamp(-1.0, last(axis)));
        Self {
            first: low.map(|n| n as isize),
            nodes: std::array::from_fn(|axis| (high[axis] - low[axis] + 1.0).max(0.0) as usize),
        }
    }

    /// How many cells there are.
    pub fn count(&self) -> usize {
        self.nodes.iter().product()
    }

    /// The cells, row by row along x; in a hole they are without nodes.
    pub fn each(self) -> impl Iterator<Item = [isize; D]> {
        (0..self.count()).map(move |n| {
            let along = [n % self.nodes[0], n / self.nodes[0]];
            std::array::from_fn(|axis| self.first[axis] + along[axis] as isize)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_those_whose_centres_lie_within() {
        let grid = Grid::<2>::new([6, 4], 0.5, 0);
        let patch = Patch::of(&grid, [0.75, 0.8], [1.25 * (1.0 - 1e-12), 2.0]);
        assert_eq!((patch.first, patch.nodes), ([1, 2], [2, 2]));
        assert_eq!(patch.each().collect::<Vec<_>>(), [[1, 2], [2, 2], [1, 3], [2, 3]]);
        assert_eq!(Patch::of(&grid, [0.0; 2], [3.0, 2.0]).count(), 24);
        for (from, to) in [([0.3, 0.3], [0.7, 0.7]), ([2.0, 1.0], [1.0, 2.0]), ([9.0; 2], [9.5; 2])] {
            assert_eq!(Patch::of(&grid, from, to).each().count(), 0, "{from:?} {to:?}");
        }
        let bar = Grid::<1>::new([10], 0.1, 2);
        assert_eq!(Patch::of(&bar, [0.15], [0.449]).each().collect::<Vec<_>>(), [[1], [2], [3]]);
    }
}
