//! A driven chain between two absorbing layers, solved for one frequency at a time.
//!
//! (ω²(1 + iσ_i) + L) u = f in units Δx = v = 1, L the chain's stencils, f a unit force at one node of the left
//! half, time factor e^(−iωt). σ rises from 0 as a cubic ramp at both far ends, so waves leave and hardly return.
//! Banded Gaussian elimination with row exchanges, then u = A e^{ikx} + B e^{−ikx} fitted by least squares between
//! force and joint: |R| = |B/A|. In doubles.

use crate::complex::Complex;

/// Neighbour distance and weight of each pair.
type Stencil = [(usize, f64)];

/// Lengths of the parts of the left half, in nodes; the right half is `layer` + `clear` long.
struct Chain {
    layer: usize,
    clear: usize,
    window: usize,
}

/// |R| of the wave of frequency ω from the left; see [`crate::scattering::reflection`].
pub(crate) fn reflection(left: &Stencil, right: &Stencil, omega: f64) -> Option<f64> {
    let k = only_wave(left, omega)?;
    let mut chain = Chain {
        layer: (200.0 / k).ceil().max(500.0) as usize,
        clear: (10.0 / k).ceil().max(60.0) as usize,
        window: (20.0 / k).ceil().max(60.0) as usize,
    };
    let mut before = one_chain(left, right, omega, k, &chain);
    for _ in 0..6 {
        chain = Chain { layer: 2 * chain.layer, clear: 2 * chain.clear, window: chain.window };
        let now = one_chain(left, right, omega, k, &chain);
        if (now - before).abs() < 2e-8 {
            return Some(now);
        }
        before = now;
    }
    None
}

/// ω² of the stencil.
fn square(stencil: &Stencil, k: f64) -> f64 {
    stencil.iter().map(|(r, weight)| 4.0 * weight * libm::sin(k * *r as f64 / 2.0).powi(2)).sum()
}

/// The wave number in (0, π) where the stencil has the frequency ω; None if there is none or more than one.
fn only_wave(stencil: &Stencil, omega: f64) -> Option<f64> {
    let cells = 4000;
    let place = |i: usize| std::f64::consts::PI * i as f64 / f64::from(cells);
    let below = |k: f64| square(stencil, k) < omega * omega;
    let mut crossings = (0..cells as usize).filter(|i| below(place(*i)) != below(place(*i + 1)));
    let first = crossings.next()?;
    if crossings.next().is_some() || omega <= 0.0 {
        return None;
    }
    let (mut low, mut high) = (place(first), place(first + 1));
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if below(middle) { low = middle } else { high = middle }
    }
    Some((low + high) / 2.0)
}

/// |R| from one chain: layer, clear, force, clear, window, clear, joint, clear, layer.
fn one_chain(left: &Stencil, right: &Stencil, omega: f64, k: f64, chain: &Chain) -> f64 {
    let force = chain.layer + chain.clear;
    let joint = force + 2 * chain.clear + chain.window;
    let count = joint + chain.clear + chain.layer;
    let strength = 120.0 / (k * chain.layer as f64);
    let damping = |i: usize| {
        let depth = chain.layer.saturating_sub(i).max((i + chain.layer + 1).saturating_sub(count));
        strength * (depth as f64 / chain.layer as f64).powi(3)
    };
    let reach = left.iter().chain(right).map(|(r, _)| *r).max().unwrap_or(1);
    let mut band = Band::new(count, reach);
    for i in 0..count {
        let stencil = if i < joint { left } else { right };
        let whole: f64 = stencil.iter().map(|(_, weight)| 2.0 * weight).sum();
        *band.at(i, i) = Complex { re: omega * omega - whole, im: omega * omega * damping(i) };
        for (r, weight) in stencil {
            for j in [i.checked_sub(*r), Some(i + r)].into_iter().flatten().filter(|j| *j < count) {
                band.at(i, j).re = *weight;
            }
        }
    }
    let mut u = vec![Complex::default(); count];
    u[force].re = 1.0;
    band.solve(&mut u);
    let start = force + chain.clear;
    returned_over_sent(&u[start..start + chain.window], k)
}

/// |B/A| of the least-squares fit of A e^{ikx} + B e^{−ikx}: two normal equations.
fn returned_over_sent(u: &[Complex], k: f64) -> f64 {
    let (mut onward, mut back, mut overlap) = (Complex::default(), Complex::default(), Complex::default());
    for (i, value) in u.iter().enumerate() {
        let wave = Complex::turned(k * i as f64);
        onward = onward + wave.conj() * *value;
        back = back + wave * *value;
        overlap = overlap + wave * wave;
    }
    let count = Complex { re: u.len() as f64, im: 0.0 };
    let (sent, returned) = (count * onward - overlap.conj() * back, count * back - overlap * onward);
    returned.size() / sent.size()
}

/// A square matrix with `reach` diagonals on either side, and room for `reach` more that row exchanges fill.
struct Band {
    reach: usize,
    rows: Vec<Vec<Complex>>,
}

impl Band {
    fn new(count: usize, reach: usize) -> Self {
        Self { reach, rows: vec![vec![Complex::default(); 3 * reach + 1]; count] }
    }

    /// Entry (i, j); column j of row i sits at j − i + reach.
    fn at(&mut self, i: usize, j: usize) -> &mut Complex {
        &mut self.rows[i][j + self.reach - i]
    }

    /// Solves in place; `u` holds the right side and then the solution.
    fn solve(&mut self, u: &mut [Complex]) {
        let (count, reach) = (u.len(), self.reach);
        for pivot in 0..count {
            let last = (pivot + reach).min(count - 1);
            let best = (pivot..=last)
                .max_by(|a, b| self.at(*a, pivot).size().total_cmp(&self.at(*b, pivot).size()))
                .unwrap_or(pivot);
            let end = (pivot + 2 * reach).min(count - 1);
            if best != pivot {
                u.swap(best, pivot);
                for j in pivot..=end {
                    let (one, other) = (*self.at(pivot, j), self.entry(best, j));
                    *self.at(pivot, j) = other;
                    if j + reach >= best && j <= best + 2 * reach {
                        *self.at(best, j) = one;
                    }
                }
            }
            for i in pivot + 1..=last {
                let factor = *self.at(i, pivot) / *self.at(pivot, pivot);
                for j in pivot..=end {
                    let change = factor * *self.at(pivot, j);
                    let entry = self.at(i, j);
                    *entry = *entry - change;
                }
                u[i] = u[i] - factor * u[pivot];
            }
        }
        for i in (0..count).rev() {
            let end = (i + 2 * reach).min(count - 1);
            let known = (i + 1..=end).fold(u[i], |rest, j| rest - *self.at(i, j) * u[j]);
            u[i] = known / *self.at(i, i);
        }
    }

    /// Entry (i, j), 0 outside the band.
    fn entry(&self, i: usize, j: usize) -> Complex {
        (j + self.reach)
            .checked_sub(i)
            .and_then(|column| self.rows[i].get(column))
            .copied()
            .unwrap_or_default()
    }
}
