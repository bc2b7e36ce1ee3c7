//! The stencil bond by bond: any law, and nodes from which bonds are missing, as bits of a word for each node.
//!
//! A node has two bits for each bond of the half family, forward and backward, in as many words as that takes (36 bits at
//! m = 3). The words of nodes side by side lie side by side: a bit masks a lane. The η of a missing bond is zero, and zero
//! η pulls at nothing in either law.

use crate::field::Window;
use crate::forces::sink::Sink;
use crate::forces::{Direction, FamilyBond, Finite, Law, Small};
use crate::grid::Run;
use crate::simd::{Isa, Kernel, Lanes};
use std::marker::PhantomData;

/// Words are filled up to whole blocks of the widest lanes.
const BLOCK: usize = 8;

/// Consecutive nodes of a row and where the bits of their bonds begin.
#[derive(Debug, Clone, Copy)]
pub struct Masked {
    pub run: Run,
    /// Place of the first word in the list of all.
    pub words: usize,
}

impl Masked {
    /// Place of the block in which its nodes begin.
    pub fn first(&self) -> usize {
        self.run.start - self.run.start % BLOCK
    }

    /// Nodes with those that fill up its blocks: from the first words to the second words of the nodes.
    pub fn padded(&self) -> usize {
        (self.run.start + self.run.len).next_multiple_of(BLOCK) - self.first()
    }

    /// Where a word of the node at a place is.
    pub fn word(&self, place: usize, word: usize) -> usize {
        self.words + word * self.padded() + place - self.first()
    }
}

/// The runs cut into strips of so many columns, strip by strip: where each part begins and ends.
pub fn stretches(runs: &[Masked], row: usize, strip: usize) -> impl Iterator<Item = [usize; 2]> {
    let column = move |masked: &Masked| masked.run.start % row;
    let first = runs.iter().map(column).min().unwrap_or(0) / BLOCK * BLOCK;
    let last = runs.iter().map(|masked| column(masked) + masked.run.len).max().unwrap_or(0);
    (first..last).step_by(strip).flat_map(move |start| {
        let within = move |Masked { run, .. }: &Masked| {
            let start = run.start - run.start % row + start;
            [run.start.max(start), (run.start + run.len).min(start + strip)]
        };
        runs.iter().map(within).filter(|[from, until]| from < until)
    })
}

/// Words of a node for a half family of so many bonds.
pub fn words(pairs: usize) -> usize {
    (2 * pairs).div_ceil(64)
}

/// A bond of the half family of a bar or a plate; a bar has no second axis.
#[derive(Debug, Clone, Copy)]
pub struct Flat {
    weight: f64,
    direction: Direction<2>,
    /// In memory.
    shift: isize,
}

impl Flat {
    pub fn new<const D: usize>(bond: &FamilyBond<D>, shift: isize) -> Self {
        let of = |vector: [f64; D]| std::array::from_fn(|axis| vector.get(axis).copied().unwrap_or(0.0));
        let Direction { xi, length, unit } = bond.direction;
        Self { weight: bond.weight, direction: Direction { xi: of(xi), length, unit: of(unit) }, shift }
    }

    #[inline(always)]
    fn direction<const D: usize>(&self) -> Direction<D> {
        let Direction { xi, length, unit } = self.direction;
        Direction {
            xi: std::array::from_fn(|axis| xi[axis]),
            length,
            unit: std::array::from_fn(|axis| unit[axis]),
        }
    }
}

/// Bonds of nodes side by side, of whatever law and body.
pub struct Bonds<'a> {
    pub isa: Isa,
    pub bonds: &'a [Flat],
    pub runs: &'a [Masked],
    pub words: &'a [u64],
    pub displacement: Window<'a>,
    pub stride: usize,
    pub plane: bool,
    pub finite: bool,
    /// Whether nodes lack bonds.
    pub masked: bool,
}

impl Bonds<'_> {
    /// Leaves the force on the nodes in a sink.
    pub fn serve(&self, sink: &mut impl Sink) {
        match (self.plane, self.finite) {
            (false, false) => self.by_law::<Small, 1>(sink),
            (false, true) => self.by_law::<Finite, 1>(sink),
            (true, false) => self.by_law::<Small, 2>(sink),
            (true, true) => self.by_law::<Finite, 2>(sink),
        }
    }

    fn by_law<L: Law, const D: usize>(&self, sink: &mut impl Sink) {
        let Self { bonds, runs, words, displacement, stride, .. } = *self;
        let law = PhantomData::<L>;
        if self.masked {
            self.isa.run(Bondwise::<_, L, D, true> {
                bonds,
                runs,
                words,
                displacement,
                stride,
                sink: sink.lend(),
                law,
            });
        } else {
            self.isa.run(Bondwise::<_, L, D, false> {
                bonds,
                runs,
                words,
                displacement,
                stride,
                sink: sink.lend(),
                law,
            });
        }
    }
}

/// With `MASKED` the bonds whose bits are set, else all.
struct Bondwise<'a, S, L, const D: usize, const MASKED: bool> {
    bonds: &'a [Flat],
    runs: &'a [Masked],
    words: &'a [u64],
    displacement: Window<'a>,
    stride: usize,
    sink: S,
    law: PhantomData<L>,
}

impl<S: Sink, L: Law, const D: usize, const MASKED: bool> Kernel for Bondwise<'_, S, L, D, MASKED> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(mut self) {
        let (len, start) = (self.displacement.values().len(), self.displacement.start());
        let reach = self.bonds.iter().map(|bond| bond.shift.unsigned_abs()).max().unwrap_or(0);
        let pairs = self.bonds.len();
        for masked in self.runs {
            let (first, count) = (masked.first(), masked.padded());
            assert!(start + reach <= first, "neighbours before are seen");
            assert!(
                first + count + (D - 1) * self.stride + reach <= start + len,
                "neighbours behind are seen"
            );
            assert!(
                !MASKED || masked.words + words(pairs) * masked.padded() <= self.words.len(),
                "bits are there"
            );
            for place in (first..first + count).step_by(V::N) {
                // SAFETY: as just asserted.
                unsafe { self.block::<V>(masked, place) };
            }
        }
    }
}

impl<S: Sink, L: Law, const D: usize, const MASKED: bool> Bondwise<'_, S, L, D, MASKED> {
    /// # Safety
    /// Neighbours and bits of the block are there.
    #[inline(always)]
    unsafe fn block<V: Lanes>(&mut self, masked: &Masked, place: usize) {
        let end = masked.run.start + masked.run.len;
        let lanes = masked.run.start.saturating_sub(place)..end.saturating_sub(place).min(V::N);
        if lanes.is_empty() {
            return;
        }
        let (u, at) = (self.displacement.values(), place - self.displacement.start());
        // SAFETY: the caller's.
        unsafe {
            let load =
                |at: usize| -> [V; D] { std::array::from_fn(|axis| V::load(u, at + axis * self.stride)) };
            let here = load(at);
            let eta = |shift: isize, bit: usize| -> [V; D] {
                let far = load(at.wrapping_add_signed(shift));
                std::array::from_fn(|axis| {
                    let apart = far[axis] - here[axis];
                    if !MASKED {
                        return apart;
                    }
                    apart.kept(self.words, masked.word(place, bit / 64), (bit % 64) as u32)
                })
            };
            let mut force = [V::splat(0.0); D];
            for (index, bond) in self.bonds.iter().enumerate() {
                let pull =
                    L::pair(&bond.direction(), eta(bond.shift, 2 * index), eta(-bond.shift, 2 * index + 1));
                for axis in 0..D {
                    force[axis] = V::splat(bond.weight).mul_add(pull[axis], force[axis]);
                }
            }
            for axis in 0..D {
                self.sink.put_lanes(place + axis * self.stride, here[axis], force[axis], lanes.clone());
            }
        }
    }
}
