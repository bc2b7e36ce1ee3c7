//! The bonds of nodes that may lose some as the body moves, beside the operator that serves all others.
//!
//! What may change is kept apart from what cannot: a body of which nothing breaks has no such force, and the loops over
//! the bonds of other nodes ask nothing. A bond acts when the body had it at first and its bit in [`Now::broken`] is not
//! set. Each operator keeps such bonds in its own way: masks over the shared family, or a list.

use super::stencil::mask;
use super::{BondList, Class, Direction, FamilyBond, Force, Law, Now, Present, apart, reach_of};
use crate::breaking::{Breakable, Broken};
use crate::field::Window;
use crate::grid::Grid;
use crate::simd::{Isa, Kernel, Lanes};
use std::marker::PhantomData;

/// A node whose bonds may break.
#[derive(Debug, Clone, Copy)]
pub struct Node {
    place: usize,
    /// The first of its words in [`Broken`].
    word: usize,
}

/// A bond seen from one of its ends.
#[derive(Debug, Clone, Copy)]
pub struct Seen<const D: usize> {
    /// Of this end, among those of the node.
    bit: usize,
    /// In N/m⁴.
    weight: f64,
    direction: Direction<D>,
    /// Place of the node at the other end.
    far: usize,
}

/// Where the bonds are kept that a node had at first.
pub trait Store<const D: usize>: Send + Sync {
    /// As in [`crate::scene::Operator`].
    const NAME: &'static str;

    fn family(&self) -> impl Iterator<Item = FamilyBond<D>>;

    /// The nodes of a piece.
    fn nodes(&self, piece: usize) -> impl Iterator<Item = (usize, Node)>;

    /// The bonds of a node, by its index in its piece, in a fixed order.
    fn bonds(&self, piece: usize, index: usize) -> impl Iterator<Item = Seen<D>>;

    /// The force on a node of the bonds whose bits in `broken` are not set, to the last bit as the operator for bonds that
    /// last would sum them; `of` is the piece and the node's index in it.
    fn force<L: Law>(&self, u: Window<'_>, broken: &Broken, of: [usize; 2], stride: usize) -> [f64; D];

    fn bytes(&self) -> usize;
}

/// The force of such bonds.
pub struct Breaking<const D: usize, L, S> {
    store: S,
    stride: usize,
    /// Start of the body and length of a piece in memory.
    start: usize,
    piece: usize,
    law: PhantomData<L>,
}

impl<const D: usize, L: Law, S: Store<D>> Breaking<D, L, S> {
    pub fn new(grid: &Grid<D>, store: S) -> Self {
        let (start, piece) = (grid.body().start, grid.piece());
        Self { store, stride: grid.stride(), start, piece, law: PhantomData }
    }

    /// The bonds of a node whose bits are as asked.
    fn bonds<'a>(
        &'a self,
        piece: usize,
        index: usize,
        acts: impl Fn(usize) -> bool + 'a,
    ) -> impl Iterator<Item = Seen<D>> + 'a {
        self.store.bonds(piece, index).filter(move |seen| acts(seen.bit))
    }

    fn eta(&self, u: Window<'_>, node: Node, seen: &Seen<D>) -> [f64; D] {
        apart(u, node.place, seen.far, self.stride)
    }
}

/// Whether a node's bit is set.
fn is_set(broken: &Broken, node: Node, bit: usize) -> bool {
    broken.word(node.word + bit / 64) >> (bit % 64) & 1 == 1
}

impl<const D: usize, L: Law, S: Store<D>> Force<D> for Breaking<D, L, S> {
    fn name(&self) -> String {
        format!("bonds that may break as {}, {} rotations", S::NAME, L::NAME)
    }

    fn class(&self) -> Class {
        Class::Internal
    }

    fn reach(&self) -> usize {
        reach_of(self.store.family())
    }

    fn add(&self, now: &Now<'_>, piece: usize, sum: &mut [f64]) {
        let start = self.start + piece * self.piece;
        for (index, node) in self.store.nodes(piece) {
            let total = self.store.force::<L>(now.displacement, now.broken, [piece, index], self.stride);
            for (axis, total) in total.iter().enumerate() {
                sum[node.place - start + axis * self.stride] += total;
            }
        }
    }

    fn acts_on(&self, piece: usize) -> bool {
        self.store.nodes(piece).next().is_some()
    }

    fn energy(&self, now: &Now<'_>, piece: usize) -> Option<f64> {
        let of = |(index, node): (usize, Node)| -> f64 {
            let bonds = self.bonds(piece, index, |bit| !is_set(now.broken, node, bit));
            bonds
                .map(|seen| seen.weight * L::stored(&seen.direction, self.eta(now.displacement, node, &seen)))
                .sum()
        };
        Some(0.5 * self.store.nodes(piece).map(of).sum::<f64>())
    }

    fn released(&self, from: &Now<'_>, to: &Now<'_>, piece: usize) -> f64 {
        let of = |(index, node): (usize, Node)| -> f64 {
            let cut = |bit| is_set(to.broken, node, bit) && !is_set(from.broken, node, bit);
            let one = |seen: Seen<D>| {
                let [a, b] = [from, to].map(|now| self.eta(now.displacement, node, &seen));
                let [pull_a, pull_b] = [a, b].map(|eta| L::pull(&seen.direction, eta));
                let bend: f64 = (0..D).map(|axis| (pull_b[axis] - pull_a[axis]) * (b[axis] - a[axis])).sum();
                let stored = L::stored(&seen.direction, a) + L::stored(&seen.direction, b);
                seen.weight * (0.5 * stored - 0.25 * bend)
            };
            self.bonds(piece, index, cut).map(one).sum()
        };
        0.5 * self.store.nodes(piece).map(of).sum::<f64>()
    }

    fn bytes(&self) -> usize {
        self.store.bytes()
    }
}

/// Masks over a shared family, as in the stencil.
pub struct Masks<const D: usize> {
    bonds: Vec<(FamilyBond<D>, isize)>,
    /// By piece.
    nodes: Vec<Vec<Node>>,
    /// Words of the bonds that exist at first, in the order of those in [`Broken`].
    words: Vec<u64>,
    isa: Isa,
}

impl<const D: usize> Masks<D> {
    pub fn new(
        grid: &Grid<D>,
        family: &[FamilyBond<D>],
        breakable: &Breakable,
        present: &impl Present<D>,
        isa: Isa,
    ) -> Self {
        let mut nodes: Vec<Vec<Node>> = vec![Vec::new(); grid.pieces()];
        let mut words = Vec::new();
        for node in grid.each() {
            let Some(word) = breakable.first_word(grid.number(node)) else { continue };
            let place = grid.place(node);
            nodes[(place - grid.body().start) / grid.piece()].push(Node { place, word });
            words.extend(mask(family, node, present));
        }
        let bonds = family.iter().map(|bond| (*bond, grid.shift(bond.offset))).collect();
        Self { bonds, nodes, words, isa }
    }

    /// What it keeps of so many nodes.
    pub fn bytes_for(pairs: usize, nodes: usize) -> usize {
        nodes * (size_of::<Node>() + 8 * (2 * pairs).div_ceil(64))
    }
}

impl<const D: usize> Store<D> for Masks<D> {
    const NAME: &'static str = "a stencil";

    fn family(&self) -> impl Iterator<Item = FamilyBond<D>> {
        self.bonds.iter().map(|(bond, _)| *bond)
    }

    fn nodes(&self, piece: usize) -> impl Iterator<Item = (usize, Node)> {
        self.nodes[piece].iter().copied().enumerate()
    }

    fn bonds(&self, piece: usize, index: usize) -> impl Iterator<Item = Seen<D>> {
        let node = self.nodes[piece][index];
        let both = self.bonds.iter().enumerate().flat_map(move |(index, (bond, shift))| {
            let seen = |bit, direction, shift| Seen {
                bit,
                weight: bond.weight,
                direction,
                far: node.place.wrapping_add_signed(shift),
            };
            [seen(2 * index, bond.direction, *shift), seen(2 * index + 1, bond.direction.reversed(), -shift)]
        });
        both.filter(move |seen| self.words[node.word + seen.bit / 64] >> (seen.bit % 64) & 1 == 1)
    }

    fn force<L: Law>(
        &self,
        u: Window<'_>,
        broken: &Broken,
        [piece, index]: [usize; 2],
        stride: usize,
    ) -> [f64; D] {
        let node = self.nodes[piece][index];
        self.isa.run(OneNode::<D, L> { masks: self, node, u, broken, stride, law: PhantomData })
    }

    fn bytes(&self) -> usize {
        let nodes = self.nodes.iter().map(Vec::len).sum();
        Self::bytes_for(self.bonds.len(), nodes)
    }
}

/// The bonds of one node pair by pair, as [`super::stencil`] sums those of many side by side.
struct OneNode<'a, const D: usize, L> {
    masks: &'a Masks<D>,
    node: Node,
    u: Window<'a>,
    broken: &'a Broken,
    stride: usize,
    law: PhantomData<L>,
}

impl<const D: usize, L: Law> Kernel for OneNode<'_, D, L> {
    type Output = [f64; D];

    #[inline(always)]
    fn run<V: Lanes>(self) -> [f64; D] {
        let Self { masks, node, u, stride, .. } = self;
        let mut force = [V::splat(0.0); D];
        for (index, (bond, shift)) in masks.bonds.iter().enumerate() {
            let eta = |bit: usize, shift: isize| -> [V; D] {
                let kept = masks.words[node.word + bit / 64] >> (bit % 64) & 1 == 1;
                let acts = kept && !is_set(self.broken, node, bit);
                let eta = apart(u, node.place, node.place.wrapping_add_signed(shift), stride);
                if acts { eta.map(V::splat) } else { [V::splat(0.0); D] }
            };
            let pull = L::pair(&bond.direction, eta(2 * index, *shift), eta(2 * index + 1, -shift));
            for axis in 0..D {
                force[axis] = V::splat(bond.weight).mul_add(pull[axis], force[axis]);
            }
        }
        force.map(|component| {
            let mut lanes = [0.0; 8];
            // SAFETY: at most eight lanes.
            unsafe { component.store(&mut lanes, 0) };
            lanes[0]
        })
    }
}

/// A list of bonds, each with its own weight.
pub struct Listed<const D: usize, L> {
    list: BondList<D, L>,
    /// By piece, the first word of each of the list's nodes.
    words: Vec<Vec<usize>>,
}

impl<const D: usize, L: Law> Listed<D, L> {
    pub fn new(
        grid: &Grid<D>,
        family: &[FamilyBond<D>],
        breakable: &Breakable,
        present: &impl Present<D>,
    ) -> Self {
        let word = |node| breakable.first_word(grid.number(node));
        let list = BondList::new(grid, family, |node| word(node).is_some(), present, |_, _| 1.0);
        let mut words = vec![Vec::new(); grid.pieces()];
        for node in grid.each() {
            words[(grid.place(node) - grid.body().start) / grid.piece()].extend(word(node));
        }
        Self { list, words }
    }

    /// What it keeps of so many nodes with so many ends of bonds.
    pub fn bytes_for(nodes: usize, ends: u64) -> usize {
        BondList::<D, L>::bytes_for(nodes, ends) + nodes * size_of::<usize>()
    }
}

impl<const D: usize, L: Law> Store<D> for Listed<D, L> {
    const NAME: &'static str = "a list";

    fn family(&self) -> impl Iterator<Item = FamilyBond<D>> {
        self.list.family.iter().copied()
    }

    fn nodes(&self, piece: usize) -> impl Iterator<Item = (usize, Node)> {
        let nodes = self.list.nodes[piece].iter().zip(&self.words[piece]);
        nodes.map(|(node, &word)| Node { place: node.place, word }).enumerate()
    }

    fn bonds(&self, piece: usize, index: usize) -> impl Iterator<Item = Seen<D>> {
        let node = &self.list.nodes[piece][index];
        self.list.ends[node.first..node.last].iter().map(|end| {
            let (bond, direction) = (usize::from(end.bond), self.list.direction(end));
            let (bit, far) = (2 * bond + usize::from(!end.owner), end.far as usize);
            Seen { bit, weight: end.weight, direction, far }
        })
    }

    fn force<O: Law>(
        &self,
        u: Window<'_>,
        broken: &Broken,
        [piece, index]: [usize; 2],
        stride: usize,
    ) -> [f64; D] {
        let node = Node { place: self.list.nodes[piece][index].place, word: self.words[piece][index] };
        let mut total = [0.0; D];
        for seen in self.bonds(piece, index).filter(|seen| !is_set(broken, node, seen.bit)) {
            let pull = O::pull(&seen.direction, apart(u, node.place, seen.far, stride));
            for axis in 0..D {
                total[axis] += seen.weight * pull[axis];
            }
        }
        total
    }

    fn bytes(&self) -> usize {
        Force::bytes(&self.list) + self.words.iter().map(|words| size_of_val(words.as_slice())).sum::<usize>()
    }
}
