//! The plane stencil of families of any reach: the sums of a column pass through the first cache.
//!
//! The same sums as in [`super::few`], with loops over the family in place of registers: two i at a time, so that enough
//! sums grow side by side, and neighbours gathered by loads that are not aligned.

use super::bondwise::{Masked, stretches};
use super::quadrant::Quadrant;
use crate::field::Window;
use crate::forces::sink::Sink;
use crate::simd::{Kernel, Lanes};

/// Numbers of the scratch: the columns of a strip.
const SCRATCH: usize = 8192;

/// The largest reach whose columns are kept between two passes.
const MOST: usize = 64;

/// On a line of the cache.
#[repr(align(64))]
struct Scratch([f64; SCRATCH]);

/// S and D of a column: x and y of the sums, x and y of the differences, by j.
#[repr(align(64))]
struct Column([[f64; 8]; 4 * (MOST + 1)]);

/// The bonds of nodes that have them all, in some rows.
pub struct Many<'a, S> {
    pub quadrant: &'a Quadrant,
    pub runs: &'a [Masked],
    pub displacement: Window<'a>,
    pub stride: usize,
    pub row: usize,
    pub sink: S,
}

/// Vectors of a block of columns.
fn planes(quadrant: &Quadrant) -> usize {
    1 + 4 * quadrant.reach
}

/// Whether the scratch holds a strip as wide as a border beside its two borders, or nearly.
pub fn serves(quadrant: &Quadrant) -> bool {
    let border = quadrant.reach.next_multiple_of(8);
    quadrant.reach <= MOST && SCRATCH / planes(quadrant) >= 3 * border
}

/// Columns of a strip with its borders, and one of these, in blocks of so many lanes.
fn widths(quadrant: &Quadrant, lanes: usize) -> [usize; 2] {
    [SCRATCH / planes(quadrant) / lanes * lanes, quadrant.reach.next_multiple_of(lanes)]
}

impl<S: Sink> Kernel for Many<'_, S> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(mut self) {
        let mut scratch = Scratch([0.0; SCRATCH]);
        let mut column = Column([[0.0; 8]; 4 * (MOST + 1)]);
        let [width, border] = widths(self.quadrant, V::N);
        let strip = width - 2 * border;
        for stretch in stretches(self.runs, self.row, strip) {
            self.stretch::<V>(stretch, border, width, (&mut scratch.0, &mut column));
        }
    }
}

impl<S: Sink> Many<'_, S> {
    /// Nodes of one row, at most a strip.
    #[inline(always)]
    fn stretch<V: Lanes>(
        &mut self,
        [from, until]: [usize; 2],
        border: usize,
        width: usize,
        (scratch, column): (&mut [f64; SCRATCH], &mut Column),
    ) {
        let aligned = from - from % V::N;
        let count = (until - aligned).next_multiple_of(V::N);
        let (u, start) = (self.displacement.values(), self.displacement.start());
        let rows = self.quadrant.reach * self.row;
        assert!(start + rows + border <= aligned, "rows below are seen");
        assert!(aligned + self.stride + rows + count + border <= start + u.len(), "rows above are seen");
        assert!(count + 2 * border <= width && width * planes(self.quadrant) <= SCRATCH, "a strip fits");
        // SAFETY: the loads of both stay in the range just asserted, those of the scratch in its planes.
        unsafe {
            for to in (0..count + 2 * border).step_by(V::N) {
                self.sums::<V>(aligned - border + to - start, [to, width], scratch, column);
            }
            for at in (0..count).step_by(V::N) {
                let lanes = from.saturating_sub(aligned + at)..(until - aligned - at).min(V::N);
                self.gather::<V>(aligned + at, border + at, width, lanes, scratch);
            }
        }
    }

    /// P_i and M_i of a block of columns, to place `to` of each plane.
    ///
    /// # Safety
    /// As in [`Self::stretch`].
    #[inline(always)]
    unsafe fn sums<V: Lanes>(
        &self,
        at: usize,
        [to, width]: [usize; 2],
        scratch: &mut [f64; SCRATCH],
        column: &mut Column,
    ) {
        let reach = self.quadrant.reach;
        // SAFETY: the caller's; a column holds the largest reach.
        unsafe {
            let u = self.displacement.values();
            for axis in 0..2 {
                let at = at + axis * self.stride;
                let here = V::load(u, at);
                V::prefetch(u, at + (reach + 1) * self.row);
                for j in 1..=reach {
                    let (above, below) = (V::load(u, at + j * self.row), V::load(u, at - j * self.row));
                    ((above - here) + (below - here)).store(&mut column.0[4 * j + axis], 0);
                    (above - below).store(&mut column.0[4 * j + 2 + axis], 0);
                }
            }
            let lines = column.0.as_chunks::<4>().0;
            let mut own = V::splat(0.0);
            for ([_, yy, _], line) in self.quadrant.column(0).iter().zip(&lines[1..]) {
                own = V::splat(*yy).mul_add(V::load(&line[1], 0), own);
            }
            own.store(scratch, to);
            for i in (1..=reach).step_by(2) {
                // Two columns, the second of which is no longer than the first.
                let long = self.quadrant.column(i);
                let short = if i < reach { self.quadrant.column(i + 1) } else { &[] };
                let (both, rest) = long.split_at(short.len());
                let mut sums = [[V::splat(0.0); 4]; 2];
                for ((one, other), line) in both.iter().zip(short).zip(&lines[1..]) {
                    add(one, line, &mut sums[0]);
                    add(other, line, &mut sums[1]);
                }
                for (one, line) in rest.iter().zip(&lines[1 + short.len()..]) {
                    add(one, line, &mut sums[0]);
                }
                for (i, [a, b, c, d]) in (i..=reach).zip(sums) {
                    let to = to + (1 + 4 * (i - 1)) * width;
                    (a + b).store(scratch, to);
                    (a - b).store(scratch, to + width);
                    (c + d).store(scratch, to + 2 * width);
                    (c - d).store(scratch, to + 3 * width);
                }
            }
        }
    }

    /// The force on a block of nodes from the columns around place `at` of each plane.
    ///
    /// # Safety
    /// As in [`Self::stretch`].
    #[inline(always)]
    unsafe fn gather<V: Lanes>(
        &mut self,
        place: usize,
        at: usize,
        width: usize,
        lanes: std::ops::Range<usize>,
        scratch: &[f64; SCRATCH],
    ) {
        let quadrant = self.quadrant;
        // SAFETY: the caller's.
        unsafe {
            for axis in 0..2 {
                let (u, here_at) =
                    (self.displacement.values(), place + axis * self.stride - self.displacement.start());
                let here = V::load(u, here_at);
                let row = if axis == 0 { &quadrant.row_x } else { &quadrant.row_y };
                let mut force = if axis == 1 { V::load(scratch, at) } else { V::splat(0.0) };
                for (i, weight) in row.iter().enumerate().skip(1) {
                    let (forward, backward) = (V::load(u, here_at + i), V::load(u, here_at - i));
                    force = V::splat(*weight).mul_add((forward - here) + (backward - here), force);
                    if quadrant.tops[i] > 0 {
                        let plane = (1 + 4 * (i - 1) + 2 * axis) * width;
                        let plus = V::load(scratch, plane + at + i);
                        let minus = V::load(scratch, plane + width + at - i);
                        force = force + (plus + minus);
                    }
                }
                let place = place + axis * self.stride;
                self.sink.expect::<V>(place + self.row);
                self.sink.put_lanes(place, here, force, lanes.clone());
            }
        }
    }
}

/// A bond (i, j) to A, B of x and A, B of y, from the j-th line of a column.
#[inline(always)]
fn add<V: Lanes>(weights: &[f64; 3], line: &[[f64; 8]; 4], sums: &mut [V; 4]) {
    let [xx, yy, xy] = weights.map(V::splat);
    // SAFETY: eight numbers each.
    let [sx, sy, dx, dy] = unsafe { [0, 1, 2, 3].map(|of| V::load(&line[of], 0)) };
    sums[0] = xx.mul_add(sx, sums[0]);
    sums[1] = xy.mul_add(dy, sums[1]);
    sums[2] = yy.mul_add(sy, sums[2]);
    sums[3] = xy.mul_add(dx, sums[3]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::forces::{Direction, FamilyBond};

    /// A family along the axes that reaches so many nodes.
    fn cross(reach: usize) -> Quadrant {
        let reach = i32::try_from(reach).expect("a short family");
        let bond = |offset| FamilyBond { offset, direction: Direction::new(offset, 1.0), weight: 1.0 };
        let family: Vec<_> = (1..=reach).flat_map(|n| [[n, 0], [0, n]]).map(bond).collect();
        Quadrant::of(&family).expect("a symmetric family")
    }

    #[test]
    fn whoever_is_served_has_a_strip() {
        let served: Vec<usize> = (1..=2 * MOST).filter(|&reach| serves(&cross(reach))).collect();
        assert!(served.contains(&10) && served.contains(&20) && !served.contains(&31));
        for reach in served {
            for lanes in [4, 8] {
                let [width, border] = widths(&cross(reach), lanes);
                assert!(width >= 2 * border + lanes, "{reach} nodes, {lanes} lanes");
            }
        }
    }
}
