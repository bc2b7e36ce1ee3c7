//! The machine's own limits, measured on the threads that march: how many operations a second, how many bytes.
//!
//! A limit is the best of several tries: what others take of the machine makes it look slower, never faster.

use super::fma;
use super::triad::Arrays;
use crate::cli::Isa;
use pd_verify::plan::work::Work;
use serde::Serialize;
use std::time::Instant;

/// What a machine can do with some instruction set on some threads.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Limits {
    pub threads: usize,
    /// Of arrays far larger than the last cache.
    pub triad_gbyte_per_s: f64,
    /// Of arrays in the caches next to the cores.
    pub triad_cache_gbyte_per_s: f64,
    /// Bytes of all arrays, and GB/s; by growing arrays.
    pub triad_by_bytes: Vec<(f64, f64)>,
    pub fma_gflop_per_s: f64,
}

/// Arrays of one thread in the caches next to its core.
const NEAR: usize = 256 << 10;

/// Of all threads together: sizes between, and one far larger than the last cache.
const BETWEEN: [usize; 4] = [2 << 20, 8 << 20, 32 << 20, 128 << 20];
const FAR: usize = 512 << 20;
/// The last cache grows with the threads.
const FAR_OF_THREAD: usize = 32 << 20;

/// Many short tries: on a machine that is shared some of them find it free.
const TRIES: usize = 20;

/// Least time of a try in s.
const LEAST: f64 = 0.004;

impl Limits {
    /// Of a machine that was not asked.
    pub fn unknown(threads: usize) -> Self {
        Self {
            threads,
            triad_gbyte_per_s: f64::NAN,
            triad_cache_gbyte_per_s: f64::NAN,
            triad_by_bytes: Vec::new(),
            fma_gflop_per_s: f64::NAN,
        }
    }

    /// Measures them on the threads of the present pool.
    pub fn measure(isa: Isa) -> Self {
        let threads = rayon::current_num_threads();
        let near = NEAR * threads;
        let far = FAR.max(FAR_OF_THREAD * threads);
        let sizes = std::iter::once(near).chain(BETWEEN.into_iter().filter(|&size| near < size)).chain([far]);
        let triad_by_bytes: Vec<(f64, f64)> = sizes.map(|bytes| triad(isa, bytes)).collect();
        let rate = |at: usize| triad_by_bytes[at].1;
        Self {
            threads,
            triad_gbyte_per_s: rate(triad_by_bytes.len() - 1),
            triad_cache_gbyte_per_s: rate(0),
            fma_gflop_per_s: fma_rate(isa),
            triad_by_bytes,
        }
    }

    /// The better of two measurements, for a machine that is shared with others.
    pub fn or_better(self, other: &Self) -> Self {
        let pairs = self.triad_by_bytes.iter().zip(&other.triad_by_bytes);
        Self {
            threads: self.threads,
            triad_gbyte_per_s: self.triad_gbyte_per_s.max(other.triad_gbyte_per_s),
            triad_cache_gbyte_per_s: self.triad_cache_gbyte_per_s.max(other.triad_cache_gbyte_per_s),
            triad_by_bytes: pairs.map(|(one, other)| (one.0, one.1.max(other.1))).collect(),
            fma_gflop_per_s: self.fma_gflop_per_s.max(other.fma_gflop_per_s),
        }
    }

    /// The rate of triads over as many bytes as a body needs in each step, in GB/s.
    pub fn triad_at(&self, bytes: f64) -> f64 {
        let after = self.triad_by_bytes.partition_point(|(size, _)| *size <= bytes);
        let (before, next) =
            (after.checked_sub(1).map(|n| self.triad_by_bytes[n]), self.triad_by_bytes.get(after));
        match (before, next) {
            (Some((x0, y0)), Some(&(x1, y1))) => y0 + (y1 - y0) * (bytes / x0).ln() / (x1 / x0).ln(),
            (Some((_, rate)), None) | (None, Some(&(_, rate))) => rate,
            (None, None) => f64::NAN,
        }
    }

    /// Steps per second that they allow, and whether it is the bytes that count: those that a pass brings from where the body
    /// lies, or those that every step moves between a core and the caches next to it.
    pub fn steps_per_s(&self, work: &Work, steps_per_pass: u64) -> (f64, bool) {
        let by_flops = 1e9 * self.fma_gflop_per_s / work.flops_per_step;
        let far = 1e9 * self.triad_at(work.working_set_bytes()) / work.bytes_per_step(steps_per_pass);
        let near = 1e9 * self.triad_cache_gbyte_per_s / work.bytes_per_step(1);
        let by_bytes = far.min(near);
        (by_flops.min(by_bytes), by_bytes < by_flops)
    }
}

/// Bytes of the arrays and GB/s.
fn triad(isa: Isa, bytes: usize) -> (f64, f64) {
    let arrays = Arrays::new(bytes);
    let warm = arrays.rate(isa, 1);
    let times = (LEAST * warm / arrays.bytes()).ceil().max(1.0) as usize;
    (arrays.bytes(), best(|| arrays.rate(isa, times)) / 1e9)
}

/// GF/s of all threads.
fn fma_rate(isa: Isa) -> f64 {
    let once = || {
        let start = Instant::now();
        let flops: f64 = rayon::broadcast(|_| (0..CALLS).map(|_| fma::flops(isa)).sum::<f64>()).iter().sum();
        flops / start.elapsed().as_secs_f64()
    };
    best(once) / 1e9
}

/// Calls of the chains in a try: some 4 ms with the widest vectors.
const CALLS: usize = 32;

fn best(rate: impl Fn() -> f64) -> f64 {
    (0..TRIES).map(|_| rate()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn limits() -> Limits {
        Limits {
            threads: 1,
            triad_gbyte_per_s: 10.0,
            triad_cache_gbyte_per_s: 100.0,
            triad_by_bytes: vec![(1e3, 100.0), (1e5, 50.0), (1e9, 10.0)],
            fma_gflop_per_s: 200.0,
        }
    }

    #[test]
    fn bytes_are_held_against_arrays_of_their_size() {
        let at = |bytes| limits().triad_at(bytes);
        assert_eq!([1.0, 1e3, 1e5, 1e9, 1e12].map(at), [100.0, 100.0, 50.0, 10.0, 10.0]);
        assert!((at(1e4) - 75.0).abs() < 1e-12);
    }

    /// A million operations: 2·10⁵ steps by these. 2 GB: 5 by memory, 50 by caches, however many steps a pass makes; 2 kB: more
    /// by either than by operations.
    #[test]
    fn the_lower_limit_counts() {
        let work = |bytes| Work {
            flops_per_step: 1e6,
            state_bytes_per_step: bytes,
            kept_bytes: 0.0,
            ..Work::default()
        };
        assert_eq!(limits().steps_per_s(&work(2e9), 1), (5.0, true));
        assert_eq!(limits().steps_per_s(&work(2e3), 1), (2e5, false));
        assert_eq!(limits().steps_per_s(&work(2e9), 100_000), (50.0, true));
    }
}
