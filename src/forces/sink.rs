//! Where a kernel leaves the force on a block of nodes: added to a sum, or spent at once on the step of the nodes.
//!
//! A step is u(n+1) = u(n) + d, d ← d + Δt²/ρ F. Where bonds alone act on a piece of work no sum is written and read
//! again; the arithmetic is that of [`crate::march`] to the last bit: the sum starts from zero there.

use super::stencil::Part;
use crate::simd::Lanes;
use std::ops::Range;

/// Takes the force on nodes side by side.
pub trait Sink {
    /// The same sink for a kernel to own: what it points at then stays in registers.
    type Lent<'a>: Sink
    where
        Self: 'a;

    fn lend(&mut self) -> Self::Lent<'_>;

    /// `place` is that of the first lane in the field, `here` the displacement there, of which component does not matter.
    ///
    /// # Safety
    /// The block lies within the piece.
    unsafe fn put<V: Lanes>(&mut self, place: usize, here: V, force: V);

    /// The same for some lanes.
    ///
    /// # Safety
    /// They lie within the piece.
    unsafe fn put_some<V: Lanes>(&mut self, place: usize, here: V, force: V, lanes: Range<usize>);

    /// The same for some lanes or all.
    ///
    /// # Safety
    /// They lie within the piece.
    #[inline(always)]
    unsafe fn put_lanes<V: Lanes>(&mut self, place: usize, here: V, force: V, lanes: Range<usize>) {
        // SAFETY: the caller's.
        unsafe {
            if lanes.len() == V::N {
                self.put(place, here, force);
            } else {
                self.put_some(place, here, force, lanes);
            }
        }
    }

    /// Says that a place will be taken soon.
    fn expect<V: Lanes>(&self, place: usize);

    /// Takes what a part of a stencil leaves: said for each sink, so that the kernels are compiled here and nowhere else.
    fn take(&mut self, part: &Part<'_>);
}

/// Adds to the sum of a piece.
pub struct Sum<'a> {
    pub sum: &'a mut [f64],
    /// Place of its first number.
    pub start: usize,
}

impl Sink for Sum<'_> {
    type Lent<'b>
        = Sum<'b>
    where
        Self: 'b;

    fn lend(&mut self) -> Sum<'_> {
        Sum { sum: self.sum, start: self.start }
    }

    #[inline(always)]
    unsafe fn put<V: Lanes>(&mut self, place: usize, _here: V, force: V) {
        let at = place - self.start;
        // SAFETY: the caller's.
        unsafe { (V::load(self.sum, at) + force).store(self.sum, at) };
    }

    #[inline(always)]
    unsafe fn put_some<V: Lanes>(&mut self, place: usize, _here: V, force: V, lanes: Range<usize>) {
        let at = place - self.start;
        // SAFETY: the caller's.
        unsafe { (V::load(self.sum, at) + force).store_some(self.sum, at, lanes) };
    }

    #[inline(always)]
    fn expect<V: Lanes>(&self, _place: usize) {}

    fn take(&mut self, part: &Part<'_>) {
        part.serve(self);
    }
}

/// Moves the nodes of a piece.
pub struct Step<'a> {
    /// u(n) − u(n−1), becomes u(n+1) − u(n).
    pub increment: &'a mut [f64],
    /// Becomes u(n+1).
    pub next: &'a mut [f64],
    /// Place of their first number.
    pub start: usize,
    /// Δt²/ρ.
    pub factor: f64,
}

impl Step<'_> {
    /// u(n+1) − u(n).
    ///
    /// # Safety
    /// The block lies within the piece.
    #[inline(always)]
    unsafe fn moved<V: Lanes>(&self, at: usize, force: V) -> V {
        // SAFETY: the caller's.
        unsafe { V::load(self.increment, at) + V::splat(self.factor) * force }
    }
}

impl Sink for Step<'_> {
    type Lent<'b>
        = Step<'b>
    where
        Self: 'b;

    fn lend(&mut self) -> Step<'_> {
        Step { increment: self.increment, next: self.next, start: self.start, factor: self.factor }
    }

    #[inline(always)]
    unsafe fn put<V: Lanes>(&mut self, place: usize, here: V, force: V) {
        let at = place - self.start;
        // SAFETY: the caller's; `next` is as long as `increment`.
        unsafe {
            let moved = self.moved(at, force);
            moved.store(self.increment, at);
            (here + moved).store(self.next, at);
        }
    }

    #[inline(always)]
    unsafe fn put_some<V: Lanes>(&mut self, place: usize, here: V, force: V, lanes: Range<usize>) {
        let at = place - self.start;
        // SAFETY: as above.
        unsafe {
            let moved = self.moved(at, force);
            moved.store_some(self.increment, at, lanes.clone());
            (here + moved).store_some(self.next, at, lanes);
        }
    }

    #[inline(always)]
    fn expect<V: Lanes>(&self, place: usize) {
        V::prefetch(self.increment, place.wrapping_sub(self.start));
        V::prefetch(self.next, place.wrapping_sub(self.start));
    }

    fn take(&mut self, part: &Part<'_>) {
        part.serve(self);
    }
}
