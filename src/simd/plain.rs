//! Lanes in plain code: for processors without vector instructions of their own here, and the mirror that the others are
//! tested against, every access checked.
//!
//! # Safety
//! Nothing is promised here: loads and stores look at the length of the slice.

use super::Lanes;
use std::ops::{Add, Div, Mul, Sub};

/// `N` numbers; `FUSED` rounds a multiplication with its addition once, as fused multiply-add does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plain<const N: usize, const FUSED: bool>([f64; N]);

impl<const N: usize, const FUSED: bool> Plain<N, FUSED> {
    #[inline(always)]
    fn with(self, other: Self, act: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|lane| act(self.0[lane], other.0[lane])))
    }
}

impl<const N: usize, const FUSED: bool> Add for Plain<N, FUSED> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(other, |a, b| a + b)
    }
}

impl<const N: usize, const FUSED: bool> Sub for Plain<N, FUSED> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(other, |a, b| a - b)
    }
}

impl<const N: usize, const FUSED: bool> Mul for Plain<N, FUSED> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, |a, b| a * b)
    }
}

impl<const N: usize, const FUSED: bool> Div for Plain<N, FUSED> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.with(other, |a, b| a / b)
    }
}

impl<const N: usize, const FUSED: bool> Lanes for Plain<N, FUSED> {
    const N: usize = N;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; N])
    }

    #[inline(always)]
    unsafe fn load(from: &[f64], at: usize) -> Self {
        Self(*from[at..].first_chunk().expect("a block lies in its field"))
    }

    #[inline(always)]
    unsafe fn store(self, to: &mut [f64], at: usize) {
        to[at..at + N].copy_from_slice(&self.0);
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        let one = |lane: usize| match FUSED {
            true => self.0[lane].mul_add(factor.0[lane], term.0[lane]),
            false => self.0[lane] * factor.0[lane] + term.0[lane],
        };
        Self(std::array::from_fn(one))
    }

    #[inline(always)]
    fn sub_mul(self, factor: Self, term: Self) -> Self {
        Self(self.0.map(|value| -value)).mul_add(factor, term)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(f64::sqrt))
    }

    #[inline(always)]
    fn ahead(self, next: Self, n: usize) -> Self {
        let of = |lane: usize| if lane + n < N { self.0[lane + n] } else { next.0[lane + n - N] };
        Self(std::array::from_fn(of))
    }

    #[inline(always)]
    unsafe fn kept(self, words: &[u64], at: usize, bit: u32) -> Self {
        let words = &words[at..at + N];
        Self(std::array::from_fn(|lane| if words[lane] >> bit & 1 == 1 { self.0[lane] } else { 0.0 }))
    }
}
