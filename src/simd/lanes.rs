//! What kernels ask of numbers side by side.

use std::ops::{Add, Div, Mul, Sub};

/// Some f64 side by side; each operation acts on each lane.
///
/// Loads and stores do not look at the length of a slice where debug assertions are off: with a look at each, the stencil
/// has half its speed. Kernels assert the range that they read once, before their loops; with debug assertions, and so in
/// all tests, every single access is checked.
pub trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// How many: a power of two, at most 8.
    const N: usize;

    fn splat(value: f64) -> Self;

    /// # Safety
    /// `at + N <= from.len()`.
    unsafe fn load(from: &[f64], at: usize) -> Self;

    /// # Safety
    /// `at + N <= to.len()`.
    unsafe fn store(self, to: &mut [f64], at: usize);

    /// self × factor + term, rounded once where the instruction set can.
    fn mul_add(self, factor: Self, term: Self) -> Self;

    /// term − self × factor, rounded as [`Self::mul_add`].
    fn sub_mul(self, factor: Self, term: Self) -> Self;

    fn sqrt(self) -> Self;

    /// What lies `n` lanes further: the lanes from `n` on, then the first `n` of `next`.
    fn ahead(self, next: Self, n: usize) -> Self;

    /// Zero where a node's bit is not set; `words` has a word for each lane from `at` on.
    ///
    /// # Safety
    /// `at + N <= words.len()`.
    unsafe fn kept(self, words: &[u64], at: usize, bit: u32) -> Self;

    /// What lies from a place on, of which the compiler knows nothing more: it then keeps one pointer and some distances
    /// where it would step one pointer for each row that a loop reads.
    ///
    /// # Safety
    /// `at <= from.len()`.
    #[inline(always)]
    unsafe fn anew(from: &[f64], at: usize) -> &[f64] {
        &from[at..]
    }

    /// Says that a place will be needed soon; any place may be named.
    #[inline(always)]
    fn prefetch(_near: &[f64], _at: usize) {}

    /// Stores the lanes of a range only.
    ///
    /// # Safety
    /// `at + lanes.end <= to.len()` and `lanes.end <= N`.
    #[inline(always)]
    unsafe fn store_some(self, to: &mut [f64], at: usize, lanes: std::ops::Range<usize>) {
        let mut all = [0.0; 8];
        // SAFETY: N is at most 8.
        unsafe { self.store(&mut all, 0) };
        to[at + lanes.start..at + lanes.end].copy_from_slice(&all[lanes]);
    }
}

impl Lanes for f64 {
    const N: usize = 1;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    unsafe fn load(from: &[f64], at: usize) -> Self {
        from[at]
    }

    #[inline(always)]
    unsafe fn store(self, to: &mut [f64], at: usize) {
        to[at] = self;
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    #[inline(always)]
    fn sub_mul(self, factor: Self, term: Self) -> Self {
        term - self * factor
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn ahead(self, next: Self, n: usize) -> Self {
        if n == 0 { self } else { next }
    }

    #[inline(always)]
    unsafe fn kept(self, words: &[u64], at: usize, bit: u32) -> Self {
        if words[at] >> bit & 1 == 1 { self } else { 0.0 }
    }
}
