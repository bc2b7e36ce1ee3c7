//! How fast memory and caches are: a = b + s·c over arrays, 24 bytes for each element, as STREAM counts
//! (McCalpin 1995, IEEE TCCA Newsletter, December, 19).

use crate::cli::Isa;
use std::hint::black_box;
use std::sync::Mutex;
use std::time::Instant;

/// a, b and c of each thread of a pool: each allocates and first writes its own.
pub struct Arrays {
    of_thread: Vec<Mutex<[Vec<f64>; 3]>>,
    elements: usize,
}

/// Bytes that are read and written for an element.
const BYTES: f64 = 24.0;

impl Arrays {
    /// Arrays of about so many bytes together, shared by the threads of the present pool.
    pub fn new(bytes: usize) -> Self {
        let threads = rayon::current_num_threads();
        let elements = (bytes / (BYTES as usize * threads)).next_multiple_of(8);
        let of_thread: Vec<_> = (0..threads).map(|_| Mutex::default()).collect();
        let arrays = Self { of_thread, elements };
        rayon::broadcast(|context| {
            *arrays.lock(context.index()) = [0.0, 1.0, 2.0].map(|value| vec![value; elements]);
        });
        arrays
    }

    fn lock(&self, thread: usize) -> std::sync::MutexGuard<'_, [Vec<f64>; 3]> {
        self.of_thread[thread].lock().expect("no thread panics")
    }

    /// Bytes of all arrays.
    pub fn bytes(&self) -> f64 {
        BYTES * (self.elements * self.of_thread.len()) as f64
    }

    /// Runs over the arrays so many times on all threads at once; returns bytes per second.
    pub fn rate(&self, isa: Isa, times: usize) -> f64 {
        let start = Instant::now();
        rayon::broadcast(|context| {
            let [a, b, c] = &mut *self.lock(context.index());
            for _ in 0..times {
                triad(isa, black_box(a), b, black_box(3.0), c);
            }
        });
        self.bytes() * times as f64 / start.elapsed().as_secs_f64()
    }
}

fn triad(isa: Isa, a: &mut [f64], b: &[f64], s: f64, c: &[f64]) {
    match isa {
        #[cfg(target_arch = "x86_64")]
        // SAFETY: the processor has the instructions, which was just asked.
        Isa::Avx512 if isa.is_here() => unsafe { avx512(a, b, s, c) },
        #[cfg(target_arch = "x86_64")]
        // SAFETY: the processor has the instructions, which was just asked.
        Isa::Avx2 if isa.is_here() => unsafe { avx2(a, b, s, c) },
        _ => plain(a, b, s, c),
    }
}

#[inline(always)]
fn plain(a: &mut [f64], b: &[f64], s: f64, c: &[f64]) {
    for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
        *a = b + s * c;
    }
}

/// The same code, which the compiler makes into wider vectors.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f")]
fn avx512(a: &mut [f64], b: &[f64], s: f64, c: &[f64]) {
    plain(a, b, s, c);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn avx2(a: &mut [f64], b: &[f64], s: f64, c: &[f64]) {
    plain(a, b, s, c);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_element_of_every_thread_is_made() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
        pool.install(|| {
            for isa in [Isa::Baseline, Isa::Avx2, Isa::Avx512] {
                let arrays = Arrays::new(2 * 3 * 8 * 1000);
                assert_eq!((arrays.elements, arrays.bytes()), (1000, 48_000.0));
                assert!(arrays.rate(isa, 2) > 0.0);
                for thread in 0..2 {
                    assert!(arrays.lock(thread)[0].iter().all(|a| *a == 1.0 + 3.0 * 2.0));
                }
            }
        });
    }
}
