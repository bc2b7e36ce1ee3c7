//! The stencil of a bar: Σ_i w_i ((u(x+i) − u) + (u(x−i) − u)), a few blocks of nodes at a time.

use super::bondwise::Masked;
use super::quadrant::Quadrant;
use crate::field::Window;
use crate::forces::sink::Sink;
use crate::grid::Run;
use crate::simd::{Kernel, Lanes};

/// The largest reach whose neighbours come from shifted registers.
pub const SHIFTED: usize = 4;

/// The bonds of nodes that have them all. `R` is the reach where that is at most [`SHIFTED`], else 0.
pub struct Line<'a, S, const R: usize> {
    pub quadrant: &'a Quadrant,
    pub runs: &'a [Masked],
    pub displacement: Window<'a>,
    pub sink: S,
}

impl<S: Sink, const R: usize> Kernel for Line<'_, S, R> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(mut self) {
        let (u, start) = (self.displacement.values(), self.displacement.start());
        let border = self.quadrant.reach.max(V::N);
        for Masked { run, .. } in self.runs {
            let aligned = run.start - run.start % V::N;
            let count = (run.start + run.len - aligned).next_multiple_of(V::N);
            assert!(
                start + border <= aligned && aligned + count + border <= start + u.len(),
                "neighbours are seen"
            );
            // SAFETY: loads reach a border beyond the blocks, as just asserted.
            unsafe {
                if R > 0 {
                    self.shifted::<V>(run, aligned, count);
                } else {
                    self.loaded::<V>(run, aligned, count);
                }
            }
        }
    }
}

impl<S: Sink, const R: usize> Line<'_, S, R> {
    /// Leaves the force on the block at `at`, or on what belongs to the run.
    ///
    /// # Safety
    /// The run lies within the piece.
    #[inline(always)]
    unsafe fn put<V: Lanes>(&mut self, run: &Run, at: usize, here: V, force: V) {
        // SAFETY: the caller's.
        unsafe {
            if run.start <= at && at + V::N <= run.start + run.len {
                self.sink.put(at, here, force);
            } else {
                let lanes = run.start.saturating_sub(at)..(run.start + run.len - at).min(V::N);
                self.sink.put_some(at, here, force, lanes);
            }
        }
    }

    /// Neighbours from registers: (u(x+i) − u) − (u − u(x−i)), the second as the nodes i before had it.
    ///
    /// # Safety
    /// A block on each side is seen.
    #[inline(always)]
    unsafe fn shifted<V: Lanes>(&mut self, run: &Run, aligned: usize, count: usize) {
        let (u, start) = (self.displacement.values(), self.displacement.start());
        let mut weights = [0.0; SHIFTED + 1];
        weights[..=R].copy_from_slice(&self.quadrant.row_x);
        // SAFETY: the caller's.
        unsafe {
            let before = V::load(u, aligned - V::N - start);
            let mut here = V::load(u, aligned - start);
            let mut last = along::<V, R>(before, here);
            for at in (aligned..aligned + count).step_by(V::N) {
                let after = V::load(u, at + V::N - start);
                let now = along::<V, R>(here, after);
                let mut force = V::splat(0.0);
                for (i, weight) in weights.iter().enumerate().skip(1) {
                    if i <= R {
                        let both = now[i] - last[i].ahead(now[i], V::N - i);
                        force = V::splat(*weight).mul_add(both, force);
                    }
                }
                self.put(run, at, here, force);
                (here, last) = (after, now);
            }
        }
    }

    /// Neighbours from memory.
    ///
    /// # Safety
    /// The reach on each side is seen.
    #[inline(always)]
    unsafe fn loaded<V: Lanes>(&mut self, run: &Run, aligned: usize, count: usize) {
        let (u, start) = (self.displacement.values(), self.displacement.start());
        // SAFETY: the caller's.
        unsafe {
            for at in (aligned..aligned + count).step_by(V::N) {
                let here = V::load(u, at - start);
                let mut force = V::splat(0.0);
                for i in 1..=self.quadrant.reach {
                    let (forward, backward) = (V::load(u, at + i - start), V::load(u, at - i - start));
                    force =
                        V::splat(self.quadrant.row_x[i]).mul_add((forward - here) + (backward - here), force);
                }
                self.put(run, at, here, force);
            }
        }
    }
}

/// u(x+i) − u on the nodes of a block, by i.
#[inline(always)]
fn along<V: Lanes, const R: usize>(here: V, after: V) -> [V; SHIFTED + 1] {
    let mut along = [V::splat(0.0); SHIFTED + 1];
    for (i, along) in along.iter_mut().enumerate().skip(1) {
        if i <= R {
            *along = here.ahead(after, i) - here;
        }
    }
    along
}
