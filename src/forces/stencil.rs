//! The bonds of a uniform lattice without storing any: one family, its weights shared by all nodes.
//!
//! f_i = Σ_b w_b (pull(u₊ − u_i) + pull(u₋ − u_i)) over the half family, plain loops over a few neighbouring nodes at
//! once that the compiler turns into vector code. Nodes from which bonds are missing, at a free edge, carry a bit for
//! each bond of their family. Differences are taken before they are summed: a translation gives exactly zero.

use super::{Class, FamilyBond, Force, Law, Now, Present, apart, reach_of, whole};
use crate::grid::{Grid, Run};

/// Nodes side by side in the inner loop.
const LANES: usize = 8;

/// The operator, over the nodes it was given.
pub struct LatticeStencil<const D: usize, L> {
    bonds: Vec<(FamilyBond<D>, isize)>,
    stride: usize,
    /// Start of the body and length of a piece in memory.
    start: usize,
    piece: usize,
    whole: Vec<Vec<Run>>,
    partial: Vec<Vec<Partial>>,
    law: std::marker::PhantomData<L>,
}

/// A node from which bonds are missing.
struct Partial {
    place: usize,
    mask: Vec<u64>,
}

/// Bits of the bonds of a node that exist, two for each of the half family: forward, then backward.
pub(super) fn mask<const D: usize>(
    family: &[FamilyBond<D>],
    node: [isize; D],
    present: &impl Present<D>,
) -> Vec<u64> {
    let mut mask = vec![0_u64; (2 * family.len()).div_ceil(64)];
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
    ) -> Self {
        let complete = whole(grid, family, present);
        let mut partial: Vec<Vec<Partial>> = (0..grid.pieces()).map(|_| Vec::new()).collect();
        for node in grid.each().filter(|&node| nodes(node) && !complete(node)) {
            let place = grid.place(node);
            let mask = mask(family, node, present);
            partial[(place - grid.body().start) / grid.piece()].push(Partial { place, mask });
        }
        Self {
            bonds: family.iter().map(|bond| (*bond, grid.shift(bond.offset))).collect(),
            stride: grid.stride(),
            start: grid.body().start,
            piece: grid.piece(),
            whole: grid.runs(|node| nodes(node) && complete(node)),
            partial,
            law: std::marker::PhantomData,
        }
    }

    /// What it keeps for so many runs of whole nodes and so many nodes with missing bonds.
    pub fn bytes_for(pairs: usize, runs: usize, partial: usize) -> usize {
        runs * size_of::<Run>() + partial * (size_of::<Partial>() + 8 * (2 * pairs).div_ceil(64))
    }

    /// The force on `W` nodes side by side that have all their bonds; `sum` begins at `start` of the field.
    #[inline(always)]
    fn tile<const W: usize>(&self, u: &[f64], place: usize, start: usize, sum: &mut [f64]) {
        let lanes = |at: usize| -> [&[f64; W]; D] {
            std::array::from_fn(|axis| {
                u[at + axis * self.stride..].first_chunk().expect("a halo ends the row")
            })
        };
        let here = lanes(place);
        let mut total = [[0.0; W]; D];
        for (bond, shift) in &self.bonds {
            let forward = lanes(place.wrapping_add_signed(*shift));
            let backward = lanes(place.wrapping_add_signed(-shift));
            for lane in 0..W {
                let to =
                    |far: &[&[f64; W]; D]| std::array::from_fn(|axis| far[axis][lane] - here[axis][lane]);
                let pull = L::pair(&bond.direction, to(&forward), to(&backward));
                for axis in 0..D {
                    total[axis][lane] += bond.weight * pull[axis];
                }
            }
        }
        for (axis, total) in total.iter().enumerate() {
            let at = place - start + axis * self.stride;
            for (sum, total) in sum[at..at + W].iter_mut().zip(total) {
                *sum += total;
            }
        }
    }

    /// The bonds of a node that exist: weight, direction, η.
    fn existing<'a>(
        &'a self,
        u: &'a [f64],
        node: &'a Partial,
    ) -> impl Iterator<Item = (f64, super::Direction<D>, [f64; D])> + 'a {
        let each = self.bonds.iter().enumerate().flat_map(move |(index, (bond, shift))| {
            let has = move |bit: usize| node.mask[bit / 64] >> (bit % 64) & 1 == 1;
            let far = |shift: isize| node.place.wrapping_add_signed(shift);
            let forward =
                has(2 * index).then(|| (bond.direction, apart(u, node.place, far(*shift), self.stride)));
            let backward = has(2 * index + 1)
                .then(|| (bond.direction.reversed(), apart(u, node.place, far(-shift), self.stride)));
            [forward, backward].map(|bond_of| (bond.weight, bond_of))
        });
        each.filter_map(|(weight, bond)| bond.map(|(direction, eta)| (weight, direction, eta)))
    }

    fn stored(&self, u: &[f64], place: usize) -> f64 {
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
        let u = now.displacement;
        for run in &self.whole[piece] {
            let mut done = 0;
            while done + LANES <= run.len {
                self.tile::<LANES>(u, run.start + done, start, sum);
                done += LANES;
            }
            for rest in done..run.len {
                self.tile::<1>(u, run.start + rest, start, sum);
            }
        }
        for node in &self.partial[piece] {
            let mut total = [0.0; D];
            for (weight, direction, eta) in self.existing(u, node) {
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

    fn energy(&self, now: &Now<'_>, piece: usize) -> Option<f64> {
        let u = now.displacement;
        let places = self.whole[piece].iter().flat_map(|run| run.start..run.start + run.len);
        let whole: f64 = places.map(|place| self.stored(u, place)).sum();
        let of = |node: &Partial| -> f64 {
            self.existing(u, node).map(|(weight, direction, eta)| weight * L::stored(&direction, eta)).sum()
        };
        let partial: f64 = self.partial[piece].iter().map(of).sum();
        Some(0.5 * (whole + partial))
    }

    fn bytes(&self) -> usize {
        let count = |pieces: &mut dyn Iterator<Item = usize>| pieces.sum::<usize>();
        let runs = count(&mut self.whole.iter().map(Vec::len));
        Self::bytes_for(self.bonds.len(), runs, count(&mut self.partial.iter().map(Vec::len)))
    }
}
