//! The bonds of a uniform lattice without storing any: one family, its weights shared by all nodes.
//!
//! Nodes that have all their bonds lie in runs along a row. Small rotations fold the family by the lattice's symmetries
//! (`quadrant`; `few` and `many` in the plane, `line` in a bar), finite ones go bond by bond (`bondwise`), as do
//! the nodes from which bonds are missing, at a free edge, a notch or a hole, with a bit for each bond of their family.
//! Everywhere differences are taken before they are summed: a translation gives exactly zero.

mod bondwise;
mod few;
mod folded;
mod line;
mod many;
mod quadrant;

use super::sink::{Sink, Step, Sum};
use super::{Class, Direction, FamilyBond, Force, Law, Now, Present, apart, reach_of, whole};
use crate::field::Window;
use crate::grid::{Grid, Run};
use crate::simd::Isa;
use bondwise::{Bonds, Flat, Masked, words};
use folded::Folded;
use quadrant::Quadrant;
use std::marker::PhantomData;

/// Some nodes of a piece and the way in which their bonds are served.
pub enum Part<'a> {
    Folded(Folded<'a>),
    Bonds(Bonds<'a>),
}

impl Part<'_> {
    /// Leaves the force on the nodes in a sink.
    pub fn serve(&self, sink: &mut impl Sink) {
        match self {
            Self::Folded(folded) => folded.serve(sink),
            Self::Bonds(bonds) => bonds.serve(sink),
        }
    }
}

/// The operator, over the nodes it was given.
pub struct LatticeStencil<const D: usize, L> {
    bonds: Vec<(FamilyBond<D>, isize)>,
    /// The same for kernels.
    flat: Vec<Flat>,
    folded: Option<Quadrant>,
    stride: usize,
    row: usize,
    /// Start of the body and length of a piece in memory.
    start: usize,
    piece: usize,
    /// By piece, nodes that have all their bonds.
    whole: Vec<Vec<Masked>>,
    /// By piece, nodes that lack some.
    masked: Vec<Vec<Masked>>,
    /// Bits of the latter.
    words: Vec<u64>,
    isa: Isa,
    law: PhantomData<L>,
}

/// Bits of the bonds of a node that exist, two for each of the half family: forward, then backward.
pub(super) fn mask<const D: usize>(
    family: &[FamilyBond<D>],
    node: [isize; D],
    present: &impl Present<D>,
) -> Vec<u64> {
    let mut mask = vec![0_u64; words(family.len())];
    for (index, bond) in family.iter().enumerate() {
        for (bit, offset) in [bond.offset, bond.offset.map(|n| -n)].into_iter().enumerate() {
            let bit = 2 * index + bit;
            mask[bit / 64] |= u64::from(present(node, offset)) << (bit % 64);
        }
    }
    mask
}

impl<const D: usize, L: Law> LatticeStencil<D, L> {
    /// The bonds among `nodes`; `present` says which exist.
    pub fn new(
        grid: &Grid<D>,
        family: &[FamilyBond<D>],
        nodes: impl Fn([isize; D]) -> bool,
        present: &impl Present<D>,
        isa: Isa,
    ) -> Self {
        let complete = whole(grid, family, present);
        let masked_runs = grid.runs(|node| nodes(node) && !complete(node));
        let mut words = Vec::new();
        let mut of_run = |run: Run| {
            let masked = Masked { run, words: words.len() };
            words.resize(masked.words + bondwise::words(family.len()) * masked.padded(), 0);
            for place in run.start..run.start + run.len {
                for (word, bits) in mask(family, grid.node(place), present).into_iter().enumerate() {
                    words[masked.word(place, word)] = bits;
                }
            }
            masked
        };
        let masked =
            masked_runs.into_iter().map(|runs| runs.into_iter().map(&mut of_run).collect()).collect();
        let whole = grid.runs(|node| nodes(node) && complete(node)).into_iter();
        let folded = Quadrant::of(family).filter(|folded| L::LINEAR && (D == 1 || many::serves(folded)));
        Self {
            flat: family.iter().map(|bond| Flat::new(bond, grid.shift(bond.offset))).collect(),
            bonds: family.iter().map(|bond| (*bond, grid.shift(bond.offset))).collect(),
            folded,
            stride: grid.stride(),
            row: grid.row(),
            start: grid.body().start,
            piece: grid.piece(),
            whole: whole.map(|runs| runs.into_iter().map(|run| Masked { run, words: 0 }).collect()).collect(),
            masked,
            words,
            isa,
            law: PhantomData,
        }
    }

    /// What it keeps for so many runs of whole nodes, runs of nodes with missing bonds, and nodes in these, each run
    /// filled up to whole blocks.
    pub fn bytes_for(pairs: usize, runs: usize, masked_runs: usize, padded: usize) -> usize {
        (runs + masked_runs) * size_of::<Masked>() + 8 * padded * words(pairs)
    }

    /// How many nodes a run of masked ones is filled up to.
    pub fn padded(run: Run) -> usize {
        Masked { run, words: 0 }.padded()
    }

    /// Leaves the force on all nodes of a piece in a sink.
    fn serve(&self, displacement: Window<'_>, piece: usize, sink: &mut impl Sink) {
        let Self { isa, stride, row, .. } = *self;
        let (whole, masked) = (&self.whole[piece], &self.masked[piece]);
        let bonds = |runs, masked| {
            let (plane, finite) = (D > 1, !L::LINEAR);
            let (bonds, words) = (&self.flat, &self.words);
            Part::Bonds(Bonds { isa, bonds, runs, words, displacement, stride, plane, finite, masked })
        };
        sink.take(&match &self.folded {
            Some(quadrant) => {
                Part::Folded(Folded { isa, quadrant, runs: whole, displacement, stride, row, plane: D > 1 })
            }
            None => bonds(whole, false),
        });
        sink.take(&bonds(masked, true));
    }

    /// The bonds of a node in a run of masked ones that exist: weight, direction, η.
    fn existing<'a>(
        &'a self,
        u: Window<'a>,
        masked: &'a Masked,
        place: usize,
    ) -> impl Iterator<Item = (f64, Direction<D>, [f64; D])> + 'a {
        let has = move |bit: usize| self.words[masked.word(place, bit / 64)] >> (bit % 64) & 1 == 1;
        let each = self.bonds.iter().enumerate().flat_map(move |(index, (bond, shift))| {
            let seen = |bit: usize, direction: Direction<D>, shift: isize| {
                has(bit).then(|| {
                    let far = place.wrapping_add_signed(shift);
                    (bond.weight, direction, apart(u, place, far, self.stride))
                })
            };
            [seen(2 * index, bond.direction, *shift), seen(2 * index + 1, bond.direction.reversed(), -shift)]
        });
        each.flatten()
    }

    fn stored(&self, u: Window<'_>, place: usize) -> f64 {
        let of = |(bond, shift): &(FamilyBond<D>, isize)| {
            let to = |shift: isize| apart(u, place, place.wrapping_add_signed(shift), self.stride);
            bond.weight
                * (L::stored(&bond.direction, to(*shift)) + L::stored(&bond.direction.reversed(), to(-shift)))
        };
        self.bonds.iter().map(of).sum()
    }
}

impl<const D: usize, L: Law> Force<D> for LatticeStencil<D, L> {
    fn name(&self) -> String {
        format!("bonds as a stencil, {} rotations", L::NAME)
    }

    fn class(&self) -> Class {
        Class::Internal
    }

    fn reach(&self) -> usize {
        reach_of(self.bonds.iter().map(|(bond, _)| *bond))
    }

    fn add(&self, now: &Now<'_>, piece: usize, sum: &mut [f64]) {
        let start = self.start + piece * self.piece;
        self.serve(now.displacement, piece, &mut Sum { sum, start });
    }

    fn step(&self, now: &Now<'_>, piece: usize, step: &mut Step<'_>) -> bool {
        self.serve(now.displacement, piece, step);
        true
    }

    fn energy(&self, now: &Now<'_>, piece: usize) -> Option<f64> {
        let u = now.displacement;
        let places = |run: Run| run.start..run.start + run.len;
        let whole = self.whole[piece].iter().flat_map(|whole| places(whole.run));
        let whole: f64 = whole.map(|place| self.stored(u, place)).sum();
        let nodes =
            self.masked[piece].iter().flat_map(|masked| places(masked.run).map(move |place| (masked, place)));
        let of = |(masked, place): (&Masked, usize)| -> f64 {
            self.existing(u, masked, place)
                .map(|(weight, direction, eta)| weight * L::stored(&direction, eta))
                .sum()
        };
        let masked: f64 = nodes.map(of).sum();
        Some(0.5 * (whole + masked))
    }

    fn bytes(&self) -> usize {
        let count = |runs: &[Vec<Masked>]| runs.iter().map(Vec::len).sum();
        let padded = self.masked.iter().flatten().map(Masked::padded).sum();
        Self::bytes_for(self.bonds.len(), count(&self.whole), count(&self.masked), padded)
    }
}
