//! The plane stencil of families that reach at most four nodes: all sums of a column stay in registers.
//!
//! Rows are taken in strips that fit the first cache. For each block of a strip the columns' P_i and M_i ([`Quadrant`])
//! are written side by side; then each node gathers those of its neighbours by shifting registers, so that every load and
//! store is a whole cache line. What the next row needs is asked for while this one is worked on.

use super::bondwise::{Masked, stretches};
use super::quadrant::Quadrant;
use crate::field::Window;
use crate::forces::sink::Sink;
use crate::simd::{Kernel, Lanes};

/// The largest reach of these families.
pub const REACH: usize = 4;

/// Nodes of a strip: its rows and columns fit a first cache of 32 KiB.
const STRIP: usize = 128;

/// Columns of a strip and of one block on each side, for the largest reach, in the widest lanes.
const SCRATCH: usize = (1 + 4 * REACH) * (STRIP + 16);

/// Repeats a block with `$i` a constant from 1 to [`REACH`]: loops over arrays of registers must not be left as loops.
macro_rules! unrolled {
    ($i:ident => $block:block) => {
        unrolled!($i = 1 => $block);
        unrolled!($i = 2 => $block);
        unrolled!($i = 3 => $block);
        unrolled!($i = 4 => $block);
    };
    ($i:ident = $value:literal => $block:block) => {{
        const $i: usize = $value;
        $block
    }};
}

/// On a line of the cache; where registers are spilled the stack frame is too.
#[repr(align(64))]
struct Scratch([f64; SCRATCH]);

/// The weights in places that the compiler knows.
struct Weights {
    /// w_xx, w_yy, w_xy by i and j.
    bonds: [[[f64; 3]; REACH + 1]; REACH + 1],
    row: [[f64; 2]; REACH + 1],
}

/// The bonds of nodes that have them all, in some rows; `TOPS` as in [`Quadrant::profile`].
pub struct Few<'a, S, const TOPS: u32> {
    pub quadrant: &'a Quadrant,
    pub runs: &'a [Masked],
    pub displacement: Window<'a>,
    /// From one component to the next, and from one row to the next.
    pub stride: usize,
    pub row: usize,
    pub sink: &'a mut S,
}

/// The largest j of a bond (i, j).
const fn top(tops: u32, i: usize) -> usize {
    (tops >> (4 * i) & 15) as usize
}

/// Vectors that a block of columns writes: one for the node's own column, four for each i with bonds off the row.
const fn planes(tops: u32) -> usize {
    let (mut count, mut i) = (1, 1);
    while i <= REACH {
        if top(tops, i) > 0 {
            count += 4;
        }
        i += 1;
    }
    count
}

impl<S: Sink, const TOPS: u32> Kernel for Few<'_, S, TOPS> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(mut self) {
        let weights = self.weights();
        let mut scratch = Scratch([0.0; SCRATCH]);
        for [from, until] in stretches(self.runs, self.row, STRIP) {
            self.stretch::<V>(&weights, from, until, &mut scratch.0);
        }
    }
}

impl<S: Sink, const TOPS: u32> Few<'_, S, TOPS> {
    const R: usize = top(TOPS, 0);

    fn weights(&self) -> Weights {
        let mut weights = Weights { bonds: [[[0.0; 3]; REACH + 1]; REACH + 1], row: [[0.0; 2]; REACH + 1] };
        for i in 0..=Self::R {
            let column = self.quadrant.column(i);
            weights.bonds[i][1..=column.len()].copy_from_slice(column);
            weights.row[i] = [self.quadrant.row_x[i], self.quadrant.row_y[i]];
        }
        weights
    }

    /// Nodes of one row, at most a strip.
    #[inline(always)]
    fn stretch<V: Lanes>(
        &mut self,
        weights: &Weights,
        from: usize,
        until: usize,
        scratch: &mut [f64; SCRATCH],
    ) {
        let aligned = from - from % V::N;
        let blocks = (until - aligned).div_ceil(V::N);
        let (u, start) = (self.displacement.values(), self.displacement.start());
        let rows = Self::R * self.row;
        // One block of columns on each side, reach rows below and above, both components.
        assert!(start + rows + V::N <= aligned, "rows below are seen");
        assert!(aligned + self.stride + rows + (blocks + 1) * V::N <= start + u.len(), "rows above are seen");
        assert!((blocks + 2) * V::N * planes(TOPS) <= SCRATCH, "a strip fits");
        // SAFETY: the loads of both stay in the range just asserted, those of the scratch in the strip.
        unsafe {
            columns::<V, TOPS>(
                weights,
                u,
                aligned - V::N - start,
                [self.stride, self.row],
                blocks + 2,
                scratch,
            );
            let lanes = [from - aligned, until - aligned];
            self.gather::<V, 0>(weights, aligned, blocks, lanes, scratch);
            self.gather::<V, 1>(weights, aligned, blocks, lanes, scratch);
        }
    }

    /// A component of the force on the nodes of `blocks` blocks from their columns; `lanes` are the first and the end of the
    /// stretch.
    ///
    /// # Safety
    /// As in [`Self::stretch`].
    #[inline(always)]
    unsafe fn gather<V: Lanes, const AXIS: usize>(
        &mut self,
        weights: &Weights,
        aligned: usize,
        blocks: usize,
        [first, last]: [usize; 2],
        scratch: &[f64; SCRATCH],
    ) {
        let zero = V::splat(0.0);
        let (u, start) = (self.displacement.values(), self.displacement.start());
        let block = planes(TOPS) * V::N;
        let plane = |i: usize| (1 + 4 * (i - 1) + 2 * AXIS) * V::N;
        let (mut plus, mut minus, mut now) = ([zero; REACH + 1], [zero; REACH + 1], [zero; REACH + 1]);
        let mut own = zero;
        // SAFETY: the caller's.
        unsafe {
            unrolled!(I => {
                if top(TOPS, I) > 0 {
                    minus[I] = V::load(scratch, plane(I) + V::N);
                    plus[I] = V::load(scratch, plane(I) + block);
                    now[I] = V::load(scratch, plane(I) + V::N + block);
                }
            });
            if AXIS == 1 {
                own = V::load(scratch, block);
            }
            let place = aligned + AXIS * self.stride;
            let mut before = V::load(u, place - V::N - start);
            let mut here = V::load(u, place - start);
            for index in 0..blocks {
                let at = place + index * V::N;
                let next = (index + 2) * block;
                let after = V::load(u, at + V::N - start);
                let mut force = own;
                if AXIS == 1 {
                    own = V::load(scratch, next);
                }
                unrolled!(I => {
                    if I <= top(TOPS, 0) && (AXIS == 0 || top(TOPS, I) > 0) {
                        let along = (here.ahead(after, I) - here) + (before.ahead(here, V::N - I) - here);
                        force = V::splat(weights.row[I][AXIS]).mul_add(along, force);
                    }
                    if top(TOPS, I) > 0 {
                        let p = V::load(scratch, next + plane(I));
                        let m = V::load(scratch, next + plane(I) + V::N);
                        force = force + (plus[I].ahead(p, I) + minus[I].ahead(now[I], V::N - I));
                        (plus[I], minus[I], now[I]) = (p, now[I], m);
                    }
                });
                self.sink.expect::<V>(at + self.row);
                let until = (last - index * V::N).min(V::N);
                let from = if index == 0 { first } else { 0 };
                self.sink.put(at, here, force, from..until);
                before = here;
                here = after;
            }
        }
    }
}

/// P_i and M_i of both components of each block of columns, and the node's own column.
///
/// # Safety
/// `at` and what lies `blocks` blocks, a component and the reach in rows from it are in `u`.
#[inline(always)]
unsafe fn columns<V: Lanes, const TOPS: u32>(
    weights: &Weights,
    u: &[f64],
    at: usize,
    [stride, row]: [usize; 2],
    blocks: usize,
    scratch: &mut [f64; SCRATCH],
) {
    let zero = V::splat(0.0);
    let reach = top(TOPS, 0);
    for index in 0..blocks {
        let (at, to) = (at + index * V::N, index * planes(TOPS) * V::N);
        let (mut sum, mut difference) = ([[zero; 2]; REACH + 1], [[zero; 2]; REACH + 1]);
        // SAFETY: the caller's.
        unsafe {
            let here = [V::load(u, at), V::load(u, at + stride)];
            V::prefetch(u, at + (reach + 1) * row);
            V::prefetch(u, at + stride + (reach + 1) * row);
            unrolled!(J => {
                if J <= reach {
                    let (up, down) = (at + J * row, at - J * row);
                    let above = [V::load(u, up), V::load(u, up + stride)];
                    let below = [V::load(u, down), V::load(u, down + stride)];
                    sum[J] = [0, 1].map(|axis| (above[axis] - here[axis]) + (below[axis] - here[axis]));
                    difference[J] = [0, 1].map(|axis| above[axis] - below[axis]);
                }
            });
            let mut own = V::splat(weights.bonds[0][1][1]) * sum[1][1];
            unrolled!(J => {
                if J > 1 && J <= reach {
                    own = V::splat(weights.bonds[0][J][1]).mul_add(sum[J][1], own);
                }
            });
            own.store(scratch, to);
            unrolled!(I => {
                if top(TOPS, I) > 0 {
                    let [xx, yy, xy] = weights.bonds[I][1].map(V::splat);
                    let (mut a, mut c) = (xx * sum[1][0], yy * sum[1][1]);
                    let (mut b, mut d) = (xy * difference[1][1], xy * difference[1][0]);
                    unrolled!(J => {
                        if J > 1 && J <= top(TOPS, I) {
                            let [xx, yy, xy] = weights.bonds[I][J].map(V::splat);
                            a = xx.mul_add(sum[J][0], a);
                            c = yy.mul_add(sum[J][1], c);
                            b = xy.mul_add(difference[J][1], b);
                            d = xy.mul_add(difference[J][0], d);
                        }
                    });
                    let to = to + (1 + 4 * (I - 1)) * V::N;
                    (a + b).store(scratch, to);
                    (a - b).store(scratch, to + V::N);
                    (c + d).store(scratch, to + 2 * V::N);
                    (c - d).store(scratch, to + 3 * V::N);
                }
            });
        }
    }
}
