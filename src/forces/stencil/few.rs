//! The plane stencil of families that reach at most seven nodes: all sums of a column stay in registers.
//!
//! Rows are taken in strips that fit the first cache, one component of the force after the other, block by block. What the
//! columns of a block do to the nodes before and behind ([`Quadrant`]) reaches them by shifting registers, so that every
//! load and store is a whole cache line. What the next row needs is asked for while this one is worked on. Loads bound
//! these loops: one component at a time leaves registers for weights, those that both axes share are read once, and rows
//! are subtracted from a register straight from memory.

use super::bondwise::{Masked, stretches};
use super::quadrant::Quadrant;
use crate::field::Window;
use crate::forces::sink::Sink;
use crate::simd::{Kernel, Lanes};
use std::cmp::Ordering;

/// The largest reach of these families.
pub const REACH: usize = 7;

/// Nodes of a strip: for common families its rows fit a first cache of 32 KiB.
const STRIP: usize = 192;

/// Repeats a block with `$i` a constant from 1 to [`REACH`]: loops over arrays of registers must not be left as loops.
macro_rules! unrolled {
    ($i:ident => $block:block) => {
        unrolled!($i = 1 => $block);
        unrolled!($i = 2 => $block);
        unrolled!($i = 3 => $block);
        unrolled!($i = 4 => $block);
        unrolled!($i = 5 => $block);
        unrolled!($i = 6 => $block);
        unrolled!($i = 7 => $block);
    };
    ($i:ident = $value:literal => $block:block) => {{
        const $i: usize = $value;
        $block
    }};
}

/// Hands the largest j by i of families, four bits each, to a macro: every family of a horizon that reaches at most four
/// nodes, whatever the volume rule; beyond, the most common one of each reach and one that covers the others.
macro_rules! profiles {
    ($with:ident) => {
        $with!(0x1 0x11 0x12 0x122 0x222 0x223 0x1233 0x2333 0x2334 0x12344 0x13344 0x23444 0x34444
            0x234555 0x345555 0x2455666 0x3556666 0x24566777 0x45677777)
    };
}
pub(super) use profiles;

macro_rules! list {
    ($($tops:literal)*) => { [$($tops),*] };
}

/// The profile that serves a family on so many lanes: its own, or one of its reach with more bonds, whose weights are zero.
/// `None` where shifts of registers do not reach as far.
pub fn profile(quadrant: &Quadrant, lanes: usize) -> Option<u32> {
    let serves = |tops: &u32| {
        let mut all = quadrant.tops.iter().enumerate();
        top(*tops, 0) == quadrant.reach && all.all(|(i, &own)| own <= top(*tops, i))
    };
    profiles!(list).into_iter().find(serves).filter(|_| quadrant.reach <= lanes)
}

/// The weights in places that the compiler knows, on a line of the cache: where registers are spilled the stack frame is too.
#[repr(align(64))]
struct Weights {
    /// −w_xx, −w_yy, −w_xy by i and j.
    bonds: [[[f64; 3]; REACH + 1]; REACH + 1],
    /// Σ w_xx, Σ w_yy of the columns i.
    row: [[f64; 2]; REACH + 1],
}

impl Weights {
    fn of(quadrant: &Quadrant) -> Self {
        let mut weights = Self { bonds: [[[0.0; 3]; REACH + 1]; REACH + 1], row: [[0.0; 2]; REACH + 1] };
        for i in 0..=quadrant.reach {
            let column = quadrant.column(i);
            for (to, bond) in weights.bonds[i][1..].iter_mut().zip(column) {
                *to = bond.map(|weight| -weight);
            }
            weights.row[i] = [quadrant.row_x[i], quadrant.row_y[i]];
        }
        weights
    }

    /// −w_xx or −w_yy: the axes may be exchanged, and all weights are one on the diagonal.
    #[inline(always)]
    fn direct<V: Lanes>(&self, i: usize, j: usize, axis: usize) -> V {
        V::splat(match i.cmp(&j) {
            Ordering::Less => self.bonds[i][j][axis],
            Ordering::Equal => self.bonds[i][j][2],
            Ordering::Greater => self.bonds[j][i][1 - axis],
        })
    }

    /// −w_xy.
    #[inline(always)]
    fn mixed<V: Lanes>(&self, i: usize, j: usize) -> V {
        V::splat(self.bonds[i.min(j)][i.max(j)][2])
    }
}

/// The bonds of nodes that have them all, in some rows; `TOPS` is one of [`profiles`].
pub struct Few<'a, S, const TOPS: u32> {
    pub quadrant: &'a Quadrant,
    pub runs: &'a [Masked],
    pub displacement: Window<'a>,
    /// From one component to the next, and from one row to the next.
    pub stride: usize,
    pub row: usize,
    pub sink: S,
}

/// The largest j of a bond (i, j).
const fn top(tops: u32, i: usize) -> usize {
    (tops >> (4 * i) & 15) as usize
}

/// What a block of columns does along an axis.
#[derive(Clone, Copy)]
struct Columns<V> {
    /// The displacements of its nodes, and of those of the next block.
    here: V,
    next: V,
    /// To its nodes.
    own: V,
    /// To the nodes i before, by i.
    before: [V; REACH + 1],
    /// To those i behind.
    behind: [V; REACH + 1],
}

impl<S: Sink, const TOPS: u32> Kernel for Few<'_, S, TOPS> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        // What lies further than a block is not seen by a shift; such families go elsewhere, and nothing is compiled here.
        if V::N >= Self::R {
            self.rows::<V>();
        } else {
            unreachable!("a family that reaches beyond a block of lanes");
        }
    }
}

impl<S: Sink, const TOPS: u32> Few<'_, S, TOPS> {
    const R: usize = top(TOPS, 0);

    #[inline(always)]
    fn rows<V: Lanes>(mut self) {
        let weights = Weights::of(self.quadrant);
        for stretch in stretches(self.runs, self.row, STRIP) {
            self.stretch::<V, 0>(&weights, stretch);
            self.stretch::<V, 1>(&weights, stretch);
        }
    }

    /// A component of the force on nodes of one row, at most a strip.
    #[inline(always)]
    fn stretch<V: Lanes, const AXIS: usize>(&mut self, weights: &Weights, [from, until]: [usize; 2]) {
        let aligned = from - from % V::N;
        let blocks = (until - aligned).div_ceil(V::N);
        let (u, start) = (self.displacement.values(), self.displacement.start());
        let rows = Self::R * self.row;
        // One block of columns on each side, reach rows below and above, both components.
        assert!(start + rows + V::N <= aligned, "rows below are seen");
        assert!(aligned + self.stride + rows + (blocks + 1) * V::N <= start + u.len(), "rows above are seen");
        // SAFETY: loads stay in the range just asserted; the row itself is seen a block further, since it begins below.
        unsafe {
            let first = aligned - V::N - start;
            let here = V::load(u, first + AXIS * self.stride);
            let last = self.columns::<V, AXIS>(weights, first, here);
            let mut now = self.columns::<V, AXIS>(weights, first + V::N, last.next);
            let mut force = now.with::<AXIS, TOPS>(&last);
            for index in 0..blocks {
                let at = aligned + index * V::N;
                let next = self.columns::<V, AXIS>(weights, at + V::N - start, now.next);
                unrolled!(I => {
                    if top(TOPS, I) > 0 {
                        force = force + now.before[I].ahead(next.before[I], I);
                    }
                });
                let place = at + AXIS * self.stride;
                self.sink.expect::<V>(place + self.row);
                if 0 < index && index + 1 < blocks {
                    self.sink.put(place, now.here, force);
                } else {
                    let lanes = from.saturating_sub(at)..(until - at).min(V::N);
                    self.sink.put_lanes(place, now.here, force, lanes);
                }
                force = next.with::<AXIS, TOPS>(&now);
                now = next;
            }
        }
    }

    /// The columns of the block at `at`, where the displacements along the axis are `here`.
    ///
    /// # Safety
    /// As in [`Self::stretch`].
    #[inline(always)]
    unsafe fn columns<V: Lanes, const AXIS: usize>(
        &self,
        weights: &Weights,
        at: usize,
        here: V,
    ) -> Columns<V> {
        let (zero, row) = (V::splat(0.0), self.row);
        let (mut sum, mut difference) = ([zero; REACH + 1], [zero; REACH + 1]);
        // SAFETY: the caller's.
        let next = unsafe {
            let [along, across] = [AXIS, 1 - AXIS]
                .map(|axis| V::anew(self.displacement.values(), at - Self::R * row + axis * self.stride));
            V::prefetch(along, (2 * Self::R + 1) * row);
            // −S_j along the force's axis and −D_j across: what is subtracted need not be loaded first.
            unrolled!(J => {
                if J <= Self::R {
                    let (above, below) = ((Self::R + J) * row, (Self::R - J) * row);
                    sum[J] = (here - V::load(along, above)) + (here - V::load(along, below));
                    difference[J] = V::load(across, below) - V::load(across, above);
                }
            });
            V::load(along, Self::R * row + V::N)
        };
        let mut own = zero;
        if AXIS == 1 {
            own = V::splat(weights.bonds[0][1][1]) * sum[1];
            unrolled!(J => {
                if J > 1 && J <= Self::R {
                    own = V::splat(weights.bonds[0][J][1]).mul_add(sum[J], own);
                }
            });
        }
        let (mut before, mut behind) = ([zero; REACH + 1], [zero; REACH + 1]);
        unrolled!(I => {
            // A column of the bond along x alone does nothing along y.
            if I <= Self::R && (AXIS == 0 || top(TOPS, I) > 0) {
                let row = V::splat(weights.row[I][AXIS]);
                let along = here.ahead(next, I) - here;
                own = if AXIS == 0 && I == 1 { row * along } else { row.mul_add(along, own) };
                if top(TOPS, I) > 0 {
                    let mut even = weights.direct::<V>(I, 1, AXIS) * sum[1];
                    let mut odd = weights.mixed::<V>(I, 1) * difference[1];
                    unrolled!(J => {
                        if J > 1 && J <= top(TOPS, I) {
                            even = weights.direct::<V>(I, J, AXIS).mul_add(sum[J], even);
                            odd = weights.mixed::<V>(I, J).mul_add(difference[J], odd);
                        }
                    });
                    before[I] = even + odd;
                    behind[I] = row.sub_mul(along, even - odd);
                } else {
                    behind[I] = row.sub_mul(along, zero);
                }
            }
        });
        Columns { here, next, own, before, behind }
    }
}

impl<V: Lanes> Columns<V> {
    /// What its nodes get from it and from the block before.
    #[inline(always)]
    fn with<const AXIS: usize, const TOPS: u32>(&self, last: &Self) -> V {
        let mut force = self.own;
        unrolled!(I => {
            if I <= top(TOPS, 0) && (AXIS == 0 || top(TOPS, I) > 0) {
                force = force + last.behind[I].ahead(self.behind[I], V::N - I);
            }
        });
        force
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::forces::family;
    use crate::kernel::Kernel;
    use crate::lattice::{Lattice, Stencil};
    use crate::partial_volume::VolumeRule;

    /// `None` where the lattice resists no shear.
    fn folded(m: f64, volume_rule: VolumeRule) -> Option<Quadrant> {
        let lattice = Lattice { kernel: Kernel::Constant, m, volume_rule, calibrated: false };
        let stencil = Stencil::<2>::new(lattice).ok()?;
        Some(Quadrant::of(&family(&stencil, 1e9, 1e-3)).expect("a lattice is symmetric"))
    }

    fn tops(profile: u32) -> Vec<usize> {
        (0..=top(profile, 0)).map(|i| top(profile, i)).collect()
    }

    #[test]
    fn short_families_have_their_own_profile_and_longer_ones_one_that_covers_them() {
        let mut seen = 0;
        for rule in VolumeRule::ALL {
            for m in (10..80).map(|tenths| f64::from(tenths) / 10.0) {
                let Some(folded) = folded(m, rule) else { continue };
                seen += 1;
                assert_eq!(profile(&folded, 4).is_some(), folded.reach <= 4);
                let profile = profile(&folded, 8).map(tops);
                if folded.reach <= 4 {
                    assert_eq!(profile, Some(folded.tops), "m = {m}, {rule:?}");
                } else if folded.reach <= REACH {
                    let profile = profile.unwrap_or_default();
                    assert_eq!(profile.len(), folded.tops.len(), "m = {m}, {rule:?}");
                    assert!(
                        profile.iter().zip(&folded.tops).all(|(all, own)| all >= own),
                        "m = {m}, {rule:?}"
                    );
                } else {
                    assert_eq!(profile, None);
                }
            }
        }
        assert!(seen > 150);
    }
}
