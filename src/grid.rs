//! A block of the lattice: where its nodes stand, the halo around them, and how a field of vectors lies in memory.
//!
//! Nodes stand at the centres of cells of size Δx. A [`Field`] lies row after row; within a row one component after the
//! other, each with a halo on both sides that is filled up to whole cache lines, so that the first node of every row begins
//! one. A bar has one row; a plate has halo rows below and above too. So a bond is one distance in memory for every node,
//! rows are contiguous for the vector units, and whole rows are contiguous for threads. Work is cut into fixed pieces that
//! know nothing of threads: results do not depend on them.

use crate::field::Field;
use std::ops::Range;
use std::sync::Arc;

/// Nodes of a piece of work, about: small enough that some steps of neighbouring pieces fit a core's cache.
const PIECE: usize = 4096;

/// Rows of a piece, at least: a strip of so many rows passes through the first cache once.
const ROWS: usize = 4;

/// Numbers in a cache line, and nodes in the widest vector.
const LINE: usize = 8;

/// A block of nodes with its halo.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid<const D: usize> {
    /// Nodes along each axis, without halo.
    pub nodes: [usize; D],
    /// Δx in m.
    pub spacing: f64,
    /// Ghost nodes on each side: the largest reach of any force.
    pub halo: usize,
    /// Global index of the block's first node; a body in one block starts at 0.
    pub first: [usize; D],
    /// Which cells hold a node, row by row; `None` where all do.
    held: Option<Arc<[bool]>>,
}

/// Consecutive nodes of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// Place of the first node's first component in a field.
    pub start: usize,
    pub len: usize,
}

impl<const D: usize> Grid<D> {
    /// A whole body in one block, a node in each cell.
    pub fn new(nodes: [usize; D], spacing: f64, halo: usize) -> Self {
        Self { nodes, spacing, halo, first: [0; D], held: None }
    }

    /// The same block without the nodes that are not kept.
    pub fn keeping(self, keeps: impl Fn([isize; D]) -> bool) -> Self {
        let mut held: Vec<bool> = self.held.as_ref().map_or(vec![true; self.cells()], |held| held.to_vec());
        for node in self.each() {
            held[self.number(node)] = keeps(node);
        }
        let all = held.iter().all(|held| *held);
        Self { held: (!all).then(|| held.into()), ..self }
    }

    /// Whether nodes are missing.
    pub fn pierced(&self) -> bool {
        self.held.is_some()
    }

    /// Whether a cell of the block holds a node; beyond the block there is none of its own.
    pub fn has(&self, node: [isize; D]) -> bool {
        let inside = (0..D).all(|axis| (0..self.nodes[axis] as isize).contains(&node[axis]));
        inside && self.held.as_ref().is_none_or(|held| held[self.number(node)])
    }

    /// How many cells, without halo.
    pub fn cells(&self) -> usize {
        self.nodes.iter().product()
    }

    /// How many nodes, without halo.
    pub fn count(&self) -> usize {
        self.held.as_ref().map_or(self.cells(), |held| held.iter().filter(|held| **held).count())
    }

    /// Number of a cell, row by row; cells without a node count too.
    pub fn number(&self, node: [isize; D]) -> usize {
        node.get(1).copied().unwrap_or(0) as usize * self.nodes[0] + node[0] as usize
    }

    /// From one component of a node to the next; also the length of a row of one component. In a plate that is an odd
    /// multiple of four lines: the rows that a node sees then spread over all sets of a first cache.
    pub fn stride(&self) -> usize {
        let lines = (2 * self.before() + self.nodes[0]).div_ceil(LINE);
        LINE * if D == 1 { lines } else { (lines + 4).next_multiple_of(8) - 4 }
    }

    /// Numbers before the first node of a row, and as many behind the line of the last.
    fn before(&self) -> usize {
        self.halo.max(1).next_multiple_of(LINE)
    }

    /// From one row to the next.
    pub fn row(&self) -> usize {
        D * self.stride()
    }

    /// Rows of nodes, without halo.
    pub fn rows(&self) -> usize {
        self.nodes.get(1).copied().unwrap_or(1)
    }

    /// Halo rows below, and as many above.
    fn halo_rows(&self) -> usize {
        if D == 1 { 0 } else { self.halo }
    }

    /// Numbers of a field.
    pub fn len(&self) -> usize {
        self.row() * (self.rows() + 2 * self.halo_rows())
    }

    /// Whether a field holds nothing; it never does.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A field of zeros.
    pub fn field(&self) -> Field {
        Field::zeros(self.len())
    }

    /// Place of a node's first component; indices may reach into the halo.
    pub fn place(&self, node: [isize; D]) -> usize {
        let row = node.get(1).copied().unwrap_or(0) + self.halo_rows() as isize;
        let place = row * self.row() as isize + node[0] + self.before() as isize;
        debug_assert!(place >= 0);
        place as usize
    }

    /// The node whose first component has a place.
    pub fn node(&self, place: usize) -> [isize; D] {
        let mut node = [(place % self.row()) as isize - self.before() as isize; D];
        if let Some(row) = node.get_mut(1) {
            *row = (place / self.row()) as isize - self.halo_rows() as isize;
        }
        node
    }

    /// Distance in memory from a node to its neighbour at `offset`.
    pub fn shift(&self, offset: [i32; D]) -> isize {
        let rows = offset.get(1).copied().unwrap_or(0);
        offset[0] as isize + rows as isize * self.row() as isize
    }

    /// Centre of a node's cell in m; the body's lower corner is the origin.
    pub fn position(&self, node: [isize; D]) -> [f64; D] {
        std::array::from_fn(|axis| (self.first[axis] as f64 + node[axis] as f64 + 0.5) * self.spacing)
    }

    /// All nodes, row by row.
    pub fn each(&self) -> impl Iterator<Item = [isize; D]> + use<D> {
        let (columns, held) = (self.nodes[0], self.held.clone());
        (0..self.cells()).filter(move |&n| held.as_ref().is_none_or(|held| held[n])).map(move |n| {
            let mut node = [(n % columns) as isize; D];
            if let Some(row) = node.get_mut(1) {
                *row = (n / columns) as isize;
            }
            node
        })
    }

    /// Where the nodes lie in a field: whole rows of a plate, whole lines of a bar.
    pub fn body(&self) -> Range<usize> {
        if D == 1 {
            return self.before()..self.before() + self.nodes[0].next_multiple_of(LINE);
        }
        let first = self.halo_rows() * self.row();
        first..first + self.rows() * self.row()
    }

    /// Length in memory of a piece of work; the last may be shorter. That of a bar is longer than the halo.
    pub fn piece(&self) -> usize {
        if D > 1 {
            return self.row() * (PIECE / self.nodes[0]).max(ROWS);
        }
        let (all, least) = (self.body().len(), self.before() + LINE);
        let long = |piece: &usize| all <= *piece || all % piece == 0 || all % piece >= least;
        (PIECE.max(least)..).step_by(LINE).find(long).unwrap_or(all)
    }

    /// Where a piece lies in a field.
    pub fn range(&self, piece: usize) -> Range<usize> {
        let start = self.body().start + piece * self.piece();
        start..(start + self.piece()).min(self.body().end)
    }

    /// How many pieces away a piece is seen by the nodes of another.
    pub fn lag(&self) -> usize {
        let reach = if D == 1 { self.halo } else { self.halo * self.row() };
        reach.div_ceil(self.piece()).max(1)
    }

    /// What the nodes of a piece see of a field: the piece, and the halo around it.
    pub fn seen(&self, piece: usize) -> Range<usize> {
        let range = self.range(piece);
        let around = if D == 1 { self.before() } else { self.halo * self.row() };
        range.start.saturating_sub(around)..(range.end + around).min(self.len())
    }

    /// Number of pieces.
    pub fn pieces(&self) -> usize {
        self.body().len().div_ceil(self.piece())
    }

    /// Nodes that belong to a set, as runs by piece.
    pub fn runs(&self, belongs: impl Fn([isize; D]) -> bool) -> Vec<Vec<Run>> {
        let mut pieces: Vec<Vec<Run>> = vec![Vec::new(); self.pieces()];
        for node in self.each().filter(|node| belongs(*node)) {
            let place = self.place(node);
            let piece = &mut pieces[(place - self.body().start) / self.piece()];
            match piece.last_mut() {
                Some(run) if run.start + run.len == place => run.len += 1,
                _ => piece.push(Run { start: place, len: 1 }),
            }
        }
        pieces
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_one_shift_away() {
        let grid = Grid::<2>::new([7, 5], 0.5, 3);
        assert_eq!((grid.stride(), grid.field().len()), (32, 2 * 32 * 11));
        let lines: Vec<usize> =
            [100, 1024, 1040, 4096].map(|nodes| Grid::<2>::new([nodes, 5], 0.5, 3).stride() / LINE).into();
        assert_eq!(lines, [20, 132, 132, 516]);
        for node in grid.each() {
            let to = [node[0] - 2, node[1] + 3];
            assert_eq!(grid.place(node).wrapping_add_signed(grid.shift([-2, 3])), grid.place(to));
            assert!(grid.body().contains(&grid.place(node)));
            assert_eq!(grid.node(grid.place(node)), node);
            assert_eq!((grid.place([0, node[1]]) * size_of::<f64>()) % 64, 0);
        }
        assert_eq!(grid.position([0, 4]), [0.25, 2.25]);
        assert_eq!(grid.place([-8, -3]), 0);
    }

    #[test]
    fn nodes_that_are_not_kept_are_none() {
        let whole = Grid::<2>::new([4, 3], 1.0, 2);
        assert_eq!(whole.clone().keeping(|_| true), whole);
        let pierced = whole.clone().keeping(|node| node != [1, 1]).keeping(|node| node != [3, 2]);
        assert_eq!((pierced.count(), pierced.cells(), pierced.each().count()), (10, 12, 10));
        assert!(pierced.pierced() && !pierced.has([1, 1]) && !pierced.has([3, 2]) && pierced.has([2, 1]));
        assert!(!pierced.has([-1, 0]) && !whole.has([0, 3]));
        assert_eq!((pierced.number([1, 1]), pierced.place([2, 1])), (5, whole.place([2, 1])));
        let lengths: Vec<usize> = pierced.runs(|_| true).iter().flatten().map(|run| run.len).collect();
        assert_eq!(lengths, [4, 1, 2, 3]);
    }

    #[test]
    fn runs_hold_each_node_once_and_keep_to_their_piece() {
        let bar = Grid::<1>::new([20_000], 1.0, 5);
        let runs = bar.runs(|node| node[0] % 1000 != 7);
        assert_eq!(runs.len(), bar.pieces());
        assert_eq!(runs.iter().flatten().map(|run| run.len).sum::<usize>(), 20_000 - 20);
        for (piece, runs) in runs.iter().enumerate() {
            let range = bar.range(piece);
            assert!(runs.iter().all(|run| range.contains(&run.start) && run.start + run.len <= range.end));
        }
        let plate = Grid::<2>::new([300, 100], 1.0, 2);
        assert_eq!(plate.runs(|_| true).iter().flatten().map(|run| run.len).sum::<usize>(), 30_000);
    }
}
