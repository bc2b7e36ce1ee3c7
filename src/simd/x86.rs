//! Lanes in the vector registers of x86-64: eight of AVX-512, four of AVX2.
//!
//! Each method is one instruction or a few. They are safe to call only inside [`avx512`] and [`avx2`], which are entered
//! only where the processor has them: nothing else makes these types.

use super::{Kernel, Lanes};
use std::arch::asm;
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Range, Sub};

/// A kernel for AVX-512.
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
pub fn avx512<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Eight>()
}

/// A kernel for AVX2.
#[target_feature(enable = "avx2,fma")]
pub fn avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Four>()
}

/// A register of AVX-512.
#[derive(Clone, Copy)]
pub struct Eight(__m512d);

/// A register of AVX2.
#[derive(Clone, Copy)]
pub struct Four(__m256d);

/// The lanes of `low` from `N` on, then those of `high`, by the one instruction that does just that: the intrinsic becomes a
/// permutation, which takes a table from memory and a copy of its operand, and a tenth of the stencil's time.
#[inline]
#[target_feature(enable = "avx512f")]
fn align<const N: i32>(low: __m512d, high: __m512d) -> __m512d {
    let both;
    // SAFETY: registers only.
    unsafe {
        asm!(
            "valignq {}, {}, {}, {}",
            lateout(zmm_reg) both,
            in(zmm_reg) high,
            in(zmm_reg) low,
            const N,
            options(pure, nomem, nostack, preserves_flags),
        );
    }
    both
}

/// The same number, of which the compiler knows nothing.
#[inline(always)]
fn unseen(mut number: usize) -> usize {
    // SAFETY: nothing is done.
    unsafe { asm!("/* {} */", inout(reg) number, options(pure, nomem, nostack, preserves_flags)) };
    number
}

macro_rules! arithmetic {
    ($type:ident, $($trait:ident $method:ident $intrinsic:ident;)*) => {$(
        impl $trait for $type {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: see the head of the file.
                unsafe { Self($intrinsic(self.0, other.0)) }
            }
        }
    )*};
}

arithmetic! { Eight,
    Add add _mm512_add_pd; Sub sub _mm512_sub_pd; Mul mul _mm512_mul_pd; Div div _mm512_div_pd;
}
arithmetic! { Four,
    Add add _mm256_add_pd; Sub sub _mm256_sub_pd; Mul mul _mm256_mul_pd; Div div _mm256_div_pd;
}

// SAFETY of all blocks below: see the head of the file; of loads and stores also their own condition, asserted.
impl Lanes for Eight {
    const N: usize = 8;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        unsafe { Self(_mm512_set1_pd(value)) }
    }

    #[inline(always)]
    unsafe fn load(from: &[f64], at: usize) -> Self {
        debug_assert!(at + 8 <= from.len());
        unsafe { Self(_mm512_loadu_pd(from.as_ptr().add(at))) }
    }

    #[inline(always)]
    unsafe fn store(self, to: &mut [f64], at: usize) {
        debug_assert!(at + 8 <= to.len());
        unsafe { _mm512_storeu_pd(to.as_mut_ptr().add(at), self.0) }
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        unsafe { Self(_mm512_fmadd_pd(self.0, factor.0, term.0)) }
    }

    #[inline(always)]
    fn sub_mul(self, factor: Self, term: Self) -> Self {
        unsafe { Self(_mm512_fnmadd_pd(self.0, factor.0, term.0)) }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        unsafe { Self(_mm512_sqrt_pd(self.0)) }
    }

    #[inline(always)]
    fn ahead(self, next: Self, n: usize) -> Self {
        match n {
            0 => self,
            1 => Self(unsafe { align::<1>(self.0, next.0) }),
            2 => Self(unsafe { align::<2>(self.0, next.0) }),
            3 => Self(unsafe { align::<3>(self.0, next.0) }),
            4 => Self(unsafe { align::<4>(self.0, next.0) }),
            5 => Self(unsafe { align::<5>(self.0, next.0) }),
            6 => Self(unsafe { align::<6>(self.0, next.0) }),
            7 => Self(unsafe { align::<7>(self.0, next.0) }),
            _ => next,
        }
    }

    #[inline(always)]
    unsafe fn store_some(self, to: &mut [f64], at: usize, lanes: Range<usize>) {
        debug_assert!(at + lanes.end <= to.len() && lanes.end <= 8);
        let mask = (0xff_u32 << lanes.start) & !(0xff_u32 << lanes.end);
        // The address may lie before the slice, in lanes that are not stored.
        unsafe { _mm512_mask_storeu_pd(to.as_mut_ptr().wrapping_add(at), mask as u8, self.0) }
    }

    #[inline(always)]
    unsafe fn kept(self, words: &[u64], at: usize, bit: u32) -> Self {
        debug_assert!(at + 8 <= words.len());
        unsafe {
            let words = _mm512_loadu_si512(words.as_ptr().add(at).cast());
            let set = _mm512_test_epi64_mask(words, _mm512_set1_epi64((1_u64 << bit).cast_signed()));
            Self(_mm512_maskz_mov_pd(set, self.0))
        }
    }

    #[inline(always)]
    unsafe fn anew(from: &[f64], at: usize) -> &[f64] {
        debug_assert!(at <= from.len());
        unsafe { from.get_unchecked(unseen(at)..) }
    }

    #[inline(always)]
    fn prefetch(near: &[f64], at: usize) {
        // A hint: an address that is none has no effect.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(near.as_ptr().wrapping_add(at).cast()) }
    }
}

impl Lanes for Four {
    const N: usize = 4;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        unsafe { Self(_mm256_set1_pd(value)) }
    }

    #[inline(always)]
    unsafe fn load(from: &[f64], at: usize) -> Self {
        debug_assert!(at + 4 <= from.len());
        unsafe { Self(_mm256_loadu_pd(from.as_ptr().add(at))) }
    }

    #[inline(always)]
    unsafe fn store(self, to: &mut [f64], at: usize) {
        debug_assert!(at + 4 <= to.len());
        unsafe { _mm256_storeu_pd(to.as_mut_ptr().add(at), self.0) }
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        unsafe { Self(_mm256_fmadd_pd(self.0, factor.0, term.0)) }
    }

    #[inline(always)]
    fn sub_mul(self, factor: Self, term: Self) -> Self {
        unsafe { Self(_mm256_fnmadd_pd(self.0, factor.0, term.0)) }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        unsafe { Self(_mm256_sqrt_pd(self.0)) }
    }

    #[inline(always)]
    fn ahead(self, next: Self, n: usize) -> Self {
        unsafe {
            // The upper half of this block and the lower one of the next.
            let middle = _mm256_permute2f128_pd::<0x21>(self.0, next.0);
            Self(match n {
                0 => self.0,
                1 => _mm256_shuffle_pd::<0b0101>(self.0, middle),
                2 => middle,
                3 => _mm256_shuffle_pd::<0b0101>(middle, next.0),
                _ => next.0,
            })
        }
    }

    #[inline(always)]
    unsafe fn store_some(self, to: &mut [f64], at: usize, lanes: Range<usize>) {
        debug_assert!(at + lanes.end <= to.len() && lanes.end <= 4);
        unsafe {
            let lane = _mm256_set_epi64x(3, 2, 1, 0);
            let from = _mm256_cmpgt_epi64(_mm256_set1_epi64x(lanes.start as i64), lane);
            let until = _mm256_cmpgt_epi64(_mm256_set1_epi64x(lanes.end as i64), lane);
            _mm256_maskstore_pd(to.as_mut_ptr().wrapping_add(at), _mm256_andnot_si256(from, until), self.0);
        }
    }

    #[inline(always)]
    unsafe fn kept(self, words: &[u64], at: usize, bit: u32) -> Self {
        debug_assert!(at + 4 <= words.len());
        unsafe {
            let words = _mm256_loadu_si256(words.as_ptr().add(at).cast());
            let bit = _mm256_set1_epi64x((1_u64 << bit).cast_signed());
            let set = _mm256_cmpeq_epi64(_mm256_and_si256(words, bit), bit);
            Self(_mm256_and_pd(self.0, _mm256_castsi256_pd(set)))
        }
    }

    #[inline(always)]
    unsafe fn anew(from: &[f64], at: usize) -> &[f64] {
        debug_assert!(at <= from.len());
        unsafe { from.get_unchecked(unseen(at)..) }
    }

    #[inline(always)]
    fn prefetch(near: &[f64], at: usize) {
        // A hint: an address that is none has no effect.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(near.as_ptr().wrapping_add(at).cast()) }
    }
}
