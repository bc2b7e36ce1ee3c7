//! How many floating-point operations a processor does when nothing holds it up: chains of x ← x·a + b in registers.
//!
//! A chain waits for itself, so there are enough of them to keep every unit busy; what they come to is bounded, since
//! |a| < 1. Without a fused instruction a product and a sum are two operations just the same.

use crate::cli::Isa;
use std::hint::black_box;

/// Numbers that go on side by side: 16 registers of 8 with AVX-512, 12 of 4 with AVX2, 12 of 2 in the baseline.
const WIDE: usize = 128;
const MIDDLE: usize = 48;
const NARROW: usize = 24;

/// Links of each chain in one call of [`flops`].
const LINKS: usize = 1 << 16;

/// Runs the chains; returns how many operations that were.
pub fn flops(isa: Isa) -> f64 {
    let count = match isa {
        #[cfg(target_arch = "x86_64")]
        Isa::Avx512 if isa.is_here() => {
            // SAFETY: the processor has the instructions, which was just asked.
            black_box(unsafe { x86::avx512(black_box(START)) });
            WIDE
        }
        #[cfg(target_arch = "x86_64")]
        Isa::Avx2 if isa.is_here() => {
            // SAFETY: the processor has the instructions, which was just asked.
            black_box(unsafe { x86::avx2(black_box(START)) });
            MIDDLE
        }
        _ => {
            #[cfg(target_arch = "x86_64")]
            black_box(x86::baseline(black_box(START)));
            #[cfg(not(target_arch = "x86_64"))]
            black_box(baseline(black_box(START)));
            NARROW
        }
    };
    (2 * LINKS * count) as f64
}

/// x at first, a and b: x tends to b/(1 − a) = 1.
const START: [f64; 3] = [0.5, 0.75, 0.25];

/// In code that any processor of the target has.
#[cfg(not(target_arch = "x86_64"))]
fn baseline([x, a, b]: [f64; 3]) -> f64 {
    let mut chains: [f64; NARROW] = std::array::from_fn(|n| x + n as f64);
    for _ in 0..LINKS {
        for chain in &mut chains {
            // Fused where the target has an instruction for it: elsewhere `mul_add` is a slow function.
            *chain = if cfg!(target_arch = "aarch64") { chain.mul_add(a, b) } else { *chain * a + b };
        }
    }
    chains.iter().sum()
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::{LINKS, MIDDLE, NARROW, WIDE};
    use std::arch::x86_64::*;

    /// A product and a sum in place of a fused instruction, which the baseline lacks.
    pub fn baseline([x, a, b]: [f64; 3]) -> f64 {
        // SAFETY: every processor of this target has SSE2.
        unsafe {
            let mut chains = [_mm_set1_pd(x); NARROW / 2];
            for (n, chain) in chains.iter_mut().enumerate() {
                *chain = _mm_set1_pd(x + n as f64);
            }
            let (a, b) = (_mm_set1_pd(a), _mm_set1_pd(b));
            for _ in 0..LINKS {
                for chain in &mut chains {
                    *chain = _mm_add_pd(_mm_mul_pd(*chain, a), b);
                }
            }
            let mut sum = 0.0;
            for chain in chains {
                sum += _mm_cvtsd_f64(chain);
            }
            sum
        }
    }

    #[target_feature(enable = "avx512f")]
    pub fn avx512([x, a, b]: [f64; 3]) -> f64 {
        let mut chains = [_mm512_set1_pd(x); WIDE / 8];
        // Chains that began alike would be one.
        for (n, chain) in chains.iter_mut().enumerate() {
            *chain = _mm512_set1_pd(x + n as f64);
        }
        let (a, b) = (_mm512_set1_pd(a), _mm512_set1_pd(b));
        for _ in 0..LINKS {
            for chain in &mut chains {
                *chain = _mm512_fmadd_pd(*chain, a, b);
            }
        }
        let mut sum = 0.0;
        for chain in chains {
            sum += _mm512_cvtsd_f64(chain);
        }
        sum
    }

    #[target_feature(enable = "avx2,fma")]
    pub fn avx2([x, a, b]: [f64; 3]) -> f64 {
        let mut chains = [_mm256_set1_pd(x); MIDDLE / 4];
        for (n, chain) in chains.iter_mut().enumerate() {
            *chain = _mm256_set1_pd(x + n as f64);
        }
        let (a, b) = (_mm256_set1_pd(a), _mm256_set1_pd(b));
        for _ in 0..LINKS {
            for chain in &mut chains {
                *chain = _mm256_fmadd_pd(*chain, a, b);
            }
        }
        let mut sum = 0.0;
        for chain in chains {
            sum += _mm256_cvtsd_f64(chain);
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// After so many links every chain has come to b/(1 − a) = 1, to rounding: links were not left out.
    #[test]
    fn every_chain_is_run_to_its_end() {
        let near =
            |sum: f64, chains: usize| assert!((sum - chains as f64).abs() < 1e-12 * chains as f64, "{sum}");
        #[cfg(not(target_arch = "x86_64"))]
        near(baseline(START), NARROW);
        #[cfg(target_arch = "x86_64")]
        {
            near(x86::baseline(START), NARROW / 2);
            if Isa::Avx2.is_here() {
                // SAFETY: asked just now.
                near(unsafe { x86::avx2(START) }, MIDDLE / 4);
            }
            if Isa::Avx512.is_here() {
                // SAFETY: asked just now.
                near(unsafe { x86::avx512(START) }, WIDE / 8);
            }
        }
        assert_eq!(flops(Isa::Baseline), (2 * LINKS * NARROW) as f64);
    }
}
