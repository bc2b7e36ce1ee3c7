//! A bar stretched by a force, held at the left end and let go at the right: exact motion and its Fourier series.
//!
//! ρü = E u'', u(0, t) = 0, u'(L, t) = 0, u(x, 0) = ε₀x, u̇(x, 0) = 0, ε₀ = F/(EA). D'Alembert: the initial strain, even
//! about x = 0 and odd about x = L, travels half to the left and half to the right. The lattices of this bar are in
//! [`LatticeModes`].

use crate::double_double::{self as dd, Dd};
pub use crate::lattice_modes::LatticeModes;
use std::f64::consts::PI;

/// Length in m, wave speed √(E/ρ) in m/s and strain ε₀ at the release.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReleasedBar {
    /// L in m.
    pub length: f64,
    /// v in m/s.
    pub speed: f64,
    /// ε₀.
    pub strain: f64,
}

impl ReleasedBar {
    /// The strain at x in m and t in s: a wave of steps between ε₀, 0 and −ε₀. At a step, the mean of its two sides.
    pub fn strain_at(&self, x: f64, t: f64) -> f64 {
        let way = self.speed * t;
        0.5 * self.strain * (self.initial(x - way) + self.initial(x + way))
    }

    /// Initial strain over ε₀, continued to all x: 1 for |x| < L, −1 up to 3L, period 4L.
    fn initial(&self, x: f64) -> f64 {
        let folded = (x / self.length + 1.0).rem_euclid(4.0) - 1.0;
        match folded {
            f if f == -1.0 || f == 1.0 => 0.0,
            f if f < 1.0 => 1.0,
            _ => -1.0,
        }
    }

    /// The displacement in m at x and t.
    pub fn displacement_at(&self, x: f64, t: f64) -> f64 {
        let way = self.speed * t;
        0.5 * self.strain * (self.stretched(x - way) + self.stretched(x + way))
    }

    /// ∫₀ˣ of the continued initial strain over ε₀: a triangle of height L and period 4L.
    fn stretched(&self, x: f64) -> f64 {
        let folded = (x / self.length + 1.0).rem_euclid(4.0) - 1.0;
        self.length * if folded <= 1.0 { folded } else { 2.0 - folded }
    }

    /// The first `terms` of the Fourier series of the strain, Σ (−1)ⁿ 4/(π(2n+1)) cos((2n+1)πx/2L) cos((2n+1)πvt/2L) ε₀.
    /// At a step it converges to the mean, beside one it overshoots by 9 % of the step however many terms are taken.
    pub fn fourier_strain(&self, x: f64, t: f64, terms: usize) -> f64 {
        let term = |n: usize| {
            let wave = (2 * n + 1) as f64 * PI / 2.0;
            let sign = if n.is_multiple_of(2) { 2.0 } else { -2.0 };
            sign / wave * libm::cos(wave * x / self.length) * libm::cos(wave * self.speed * t / self.length)
        };
        self.strain * (0..terms).map(term).sum::<f64>()
    }

    /// [`Self::fourier_strain`] summed in double-double arithmetic, at exactly these x, t, L and v.
    pub fn fourier_strain_in_full(&self, x: f64, t: f64, terms: usize) -> f64 {
        let (place, way) =
            (Dd::from(x) / Dd::from(self.length), Dd::from(self.speed) * t / Dd::from(self.length));
        let term = |n: usize| {
            let wave = dd::PI * (n as f64 + 0.5);
            let sign = if n.is_multiple_of(2) { 2.0 } else { -2.0 };
            Dd::from(sign) / wave * (wave * place).cos() * (wave * way).cos()
        };
        ((0..terms).map(term).sum::<Dd>() * self.strain).to_f64()
    }

    /// The first `terms` of the Fourier series of the displacement; the rest is below 2ε₀L/(π² `terms`).
    pub fn fourier_displacement(&self, x: f64, t: f64, terms: usize) -> f64 {
        let term = |n: usize| {
            let wave = (2 * n + 1) as f64 * PI / 2.0;
            let sign = if n.is_multiple_of(2) { 2.0 } else { -2.0 };
            sign / (wave * wave)
                * libm::sin(wave * x / self.length)
                * libm::cos(wave * self.speed * t / self.length)
        };
        self.strain * self.length * (0..terms).map(term).sum::<f64>()
    }
}
