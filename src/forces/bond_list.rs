//! Bonds stored one by one: the oracle of the stencil, and the operator where weights differ from node to node.
//!
//! A bond is known by its owner and its index in the half family; each of its ends lists it, so that a node's force is
//! a sum over its own list in a fixed order, and what one end feels is exactly minus what the other does.

use super::{Class, FamilyBond, Force, Law, Now, Present, apart, reach_of};
use crate::field::Window;
use crate::grid::Grid;

/// The operator, over the nodes it was given.
pub struct BondList<const D: usize, L> {
    pub(super) family: Vec<FamilyBond<D>>,
    /// By piece.
    pub(super) nodes: Vec<Vec<Node>>,
    pub(super) ends: Vec<End>,
    stride: usize,
    start: usize,
    piece: usize,
    law: std::marker::PhantomData<L>,
}

/// A node and where its bonds are listed.
pub(super) struct Node {
    pub place: usize,
    pub first: usize,
    pub last: usize,
}

/// One end of a bond.
pub(super) struct End {
    /// Place of the node at the other end.
    pub far: u32,
    /// Index in the half family.
    pub bond: u16,
    /// Whether this end is the owner's; the other end sees the bond reversed.
    pub owner: bool,
    /// In N/m⁴.
    pub weight: f64,
}

impl<const D: usize, L: Law> BondList<D, L> {
    /// The bonds among `nodes`; `present` says which exist, `factor` multiplies the weight of the bond that the first
    /// node owns, given by its index in the half family.
    pub fn new(
        grid: &Grid<D>,
        family: &[FamilyBond<D>],
        nodes: impl Fn([isize; D]) -> bool,
        present: &impl Present<D>,
        factor: impl Fn([isize; D], usize) -> f64,
    ) -> Self {
        let mut list = Self {
            family: family.to_vec(),
            nodes: (0..grid.pieces()).map(|_| Vec::new()).collect(),
            ends: Vec::new(),
            stride: grid.stride(),
            start: grid.body().start,
            piece: grid.piece(),
            law: std::marker::PhantomData,
        };
        for node in grid.each().filter(|node| nodes(*node)) {
            let first = list.ends.len();
            for (index, bond) in family.iter().enumerate() {
                for (owner, offset) in [(true, bond.offset), (false, bond.offset.map(|n| -n))] {
                    if !present(node, offset) {
                        continue;
                    }
                    let far = std::array::from_fn(|axis| node[axis] + offset[axis] as isize);
                    let weight = bond.weight * factor(if owner { node } else { far }, index);
                    let far = u32::try_from(grid.place(far)).expect("a block has fewer than 2³² places");
                    let bond = u16::try_from(index).expect("a half family has fewer than 2¹⁶ bonds");
                    list.ends.push(End { far, bond, owner, weight });
                }
            }
            let place = grid.place(node);
            let piece = (place - list.start) / list.piece;
            list.nodes[piece].push(Node { place, first, last: list.ends.len() });
        }
        list
    }

    /// What a list of so many nodes and ends keeps.
    pub fn bytes_for(nodes: usize, ends: u64) -> usize {
        nodes * size_of::<Node>() + ends as usize * size_of::<End>()
    }

    /// The bond as this end sees it.
    pub(super) fn direction(&self, end: &End) -> super::Direction<D> {
        let direction = self.family[usize::from(end.bond)].direction;
        if end.owner { direction } else { direction.reversed() }
    }

    /// Weight, direction and η of each bond of a node, seen from it.
    fn bonds<'a>(
        &'a self,
        u: Window<'a>,
        node: &'a Node,
    ) -> impl Iterator<Item = (f64, super::Direction<D>, [f64; D])> + 'a {
        self.ends[node.first..node.last].iter().map(move |end| {
            (end.weight, self.direction(end), apart(u, node.place, end.far as usize, self.stride))
        })
    }
}

impl<const D: usize, L: Law> Force<D> for BondList<D, L> {
    fn name(&self) -> String {
        format!("bonds as a list, {} rotations", L::NAME)
    }

    fn class(&self) -> Class {
        Class::Internal
    }

    fn reach(&self) -> usize {
        reach_of(self.family.iter().copied())
    }

    fn add(&self, now: &Now<'_>, piece: usize, sum: &mut [f64]) {
        let start = self.start + piece * self.piece;
        for node in &self.nodes[piece] {
            let mut total = [0.0; D];
            for (weight, direction, eta) in self.bonds(now.displacement, node) {
                let pull = L::pull(&direction, eta);
                for axis in 0..D {
                    total[axis] += weight * pull[axis];
                }
            }
            for (axis, total) in total.iter().enumerate() {
                sum[node.place - start + axis * self.stride] += total;
            }
        }
    }

    fn acts_on(&self, piece: usize) -> bool {
        !self.nodes[piece].is_empty()
    }

    fn energy(&self, now: &Now<'_>, piece: usize) -> Option<f64> {
        let of = |node: &Node| -> f64 {
            let bonds = self.bonds(now.displacement, node);
            bonds.map(|(weight, direction, eta)| weight * L::stored(&direction, eta)).sum()
        };
        Some(0.5 * self.nodes[piece].iter().map(of).sum::<f64>())
    }

    fn bytes(&self) -> usize {
        Self::bytes_for(self.nodes.iter().map(Vec::len).sum(), self.ends.len() as u64)
    }
}
