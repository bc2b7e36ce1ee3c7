//! Lanes in the vector registers of x86-64: eight of AVX-512, four of AVX2.
//!
//! Each method is one instruction or a few. They are safe to call only inside [`avx512`] and [`avx2`], which are entered
//! only where the processor has them: nothing else makes these types.

use super::{Kernel, Lanes};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Sub};

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
    fn sqrt(self) -> Self {
        unsafe { Self(_mm512_sqrt_pd(self.0)) }
    }

    #[inline(always)]
    fn ahead(self, next: Self, n: usize) -> Self {
        unsafe {
            let (a, b) = (_mm512_castpd_si512(self.0), _mm512_castpd_si512(next.0));
            let both = match n {
                0 => a,
                1 => _mm512_alignr_epi64::<1>(b, a),
                2 => _mm512_alignr_epi64::<2>(b, a),
                3 => _mm512_alignr_epi64::<3>(b, a),
                4 => _mm512_alignr_epi64::<4>(b, a),
                5 => _mm512_alignr_epi64::<5>(b, a),
                6 => _mm512_alignr_epi64::<6>(b, a),
                7 => _mm512_alignr_epi64::<7>(b, a),
                _ => b,
            };
            Self(_mm512_castsi512_pd(both))
        }
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
    fn prefetch(near: &[f64], at: usize) {
        // A hint: an address that is none has no effect.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(near.as_ptr().wrapping_add(at).cast()) }
    }
}
