//! The plane stencil of families of any reach: the sums of a column pass through the first cache.
//!
//! The same sums as in [`super::few`] in the same order, so with the same bits, with loops over the family in place of
//! registers: two i at a time, so that enough sums grow side by side, and neighbours gathered by loads that are not aligned.

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

/// −S and −D of a column: x and y of the sums, x and y of the differences, by j.
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
    2 + 4 * quadrant.reach
}

/// Where what the columns do to the nodes i behind begins, along x; then along y, then what they do to those before.
fn plane(i: usize, width: usize) -> usize {
    (2 + 4 * (i - 1)) * width
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

    /// What a block of columns does, to place `to` of each plane.
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
        let quadrant = self.quadrant;
        let reach = quadrant.reach;
        // SAFETY: the caller's; a column holds the largest reach; the row itself is seen further, since it begins below.
        unsafe {
            let u = self.displacement.values();
            for axis in 0..2 {
                let at = at + axis * self.stride;
                let here = V::load(u, at);
                V::prefetch(u, at + (reach + 1) * self.row);
                for j in 1..=reach {
                    let (above, below) = (V::load(u, at + j * self.row), V::load(u, at - j * self.row));
                    ((here - above) + (here - below)).store(&mut column.0[4 * j + axis], 0);
                    (below - above).store(&mut column.0[4 * j + 2 + axis], 0);
                }
            }
            let lines = column.0.as_chunks::<4>().0;
            let mut own_y = V::splat(0.0);
            for (j, [_, yy, _]) in quadrant.column(0).iter().enumerate() {
                let (weight, sum) = (V::splat(-yy), V::load(&lines[1 + j][1], 0));
                own_y = if j == 0 { weight * sum } else { weight.mul_add(sum, own_y) };
            }
            let here = [V::load(u, at), V::load(u, at + self.stride)];
            let mut own = [V::splat(0.0), own_y];
            for i in (1..=reach).step_by(2) {
                // Two columns, the second of which is no longer than the first.
                let long = quadrant.column(i);
                let short = if i < reach { quadrant.column(i + 1) } else { &[] };
                let (both, rest) = long.split_at(short.len());
                let mut sums = [[V::splat(0.0); 4]; 2];
                for (j, ((one, other), line)) in both.iter().zip(short).zip(&lines[1..]).enumerate() {
                    add(one, line, j == 0, &mut sums[0]);
                    add(other, line, j == 0, &mut sums[1]);
                }
                for (j, (one, line)) in rest.iter().zip(&lines[1 + short.len()..]).enumerate() {
                    add(one, line, short.len() + j == 0, &mut sums[0]);
                }
                for (i, [even_x, odd_x, even_y, odd_y]) in (i..=reach).zip(sums) {
                    let (to, off) = (to + plane(i, width), quadrant.tops[i] > 0);
                    let rows = [quadrant.row_x[i], quadrant.row_y[i]].map(V::splat);
                    let along = |axis: usize| V::load(u, at + axis * self.stride + i) - here[axis];
                    let along_x = along(0);
                    own[0] = if i == 1 { rows[0] * along_x } else { rows[0].mul_add(along_x, own[0]) };
                    if off {
                        let along_y = along(1);
                        own[1] = rows[1].mul_add(along_y, own[1]);
                        rows[0].sub_mul(along_x, even_x - odd_x).store(scratch, to);
                        rows[1].sub_mul(along_y, even_y - odd_y).store(scratch, to + width);
                        (even_x + odd_x).store(scratch, to + 2 * width);
                        (even_y + odd_y).store(scratch, to + 3 * width);
                    } else {
                        rows[0].sub_mul(along_x, V::splat(0.0)).store(scratch, to);
                    }
                }
            }
            own[0].store(scratch, to);
            own[1].store(scratch, to + width);
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
                let acts = |i: &usize| axis == 0 || quadrant.tops[*i] > 0;
                let mut force = V::load(scratch, axis * width + at);
                for i in (1..=quadrant.reach).filter(acts) {
                    force = force + V::load(scratch, plane(i, width) + axis * width + at - i);
                }
                for i in (1..=quadrant.reach).filter(|&i| quadrant.tops[i] > 0) {
                    force = force + V::load(scratch, plane(i, width) + (2 + axis) * width + at + i);
                }
                let place = place + axis * self.stride;
                let here = V::load(self.displacement.values(), place - self.displacement.start());
                self.sink.expect::<V>(place + self.row);
                self.sink.put_lanes(place, here, force, lanes.clone());
            }
        }
    }
}

/// A bond (i, j) to the even and odd parts of x and y, from the j-th line of a column; the first is a product.
#[inline(always)]
fn add<V: Lanes>(weights: &[f64; 3], line: &[[f64; 8]; 4], first: bool, sums: &mut [V; 4]) {
    let [xx, yy, xy] = weights.map(|weight| V::splat(-weight));
    // SAFETY: eight numbers each.
    let [sx, sy, dx, dy] = unsafe { [0, 1, 2, 3].map(|of| V::load(&line[of], 0)) };
    let terms = [(xx, sx), (xy, dy), (yy, sy), (xy, dx)];
    for (sum, (weight, value)) in sums.iter_mut().zip(terms) {
        *sum = if first { weight * value } else { weight.mul_add(value, *sum) };
    }
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
