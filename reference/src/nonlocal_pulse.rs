//! A smooth pulse let go in the infinite peridynamic bar: what lattices tend to as m → ∞ at a fixed horizon.
//!
//! u(x, 0) = exp(−a x²), u̇(x, 0) = 0. Each wave keeps its amplitude and turns with its own frequency,
//! u(x, t) = (1/π) ∫₀^∞ √(π/a) e^{−k²/4a} cos kx cos ω(k)t dk, ω(k) of the nonlocal continuum (Weckner and Abeyaratne,
//! J. Mech. Phys. Solids 53 (2005) 705). The integrand is even and analytic, so the trapezoidal rule of step h errs by
//! the pulses of neighbouring periods 2π/h alone: the period is chosen to keep them away, or is that of a ring.

use crate::continuum;
use crate::kernel::Kernel;
use std::f64::consts::{PI, TAU};

/// The pulse; lengths in units of the horizon δ, times in units of δ/v.
#[derive(Clone, Debug)]
pub struct NonlocalPulse {
    /// (k, ω, weight of cos kx cos ωt).
    waves: Vec<(f64, f64, f64)>,
    reach: f64,
}

/// e^{−k²/4a} falls below rounding here, in units of √a.
const LARGEST_K: f64 = 12.6;

impl NonlocalPulse {
    /// A pulse exp(−a (x/δ)²) in the infinite bar, to be asked for |x|/δ + vt/δ up to `reach`. None where its shortest
    /// waves lie beyond the continuum's range.
    pub fn new(kernel: Kernel, sharpness: f64, reach: f64) -> Option<Self> {
        let width = 7.0 / sharpness.sqrt();
        Self::with_step(kernel, sharpness, TAU / (2.0 * (reach + width)), reach)
    }

    /// The same pulse repeated with the period `period`/δ, at any x and t: a ring. A bar of length L, odd about its
    /// left and even about its right end, is a ring of period 4L with the four pulses of [`crate::pulse_bar`].
    pub fn periodic(kernel: Kernel, sharpness: f64, period: f64) -> Option<Self> {
        Self::with_step(kernel, sharpness, TAU / period, f64::INFINITY)
    }

    fn with_step(kernel: Kernel, sharpness: f64, step: f64, reach: f64) -> Option<Self> {
        let count = (LARGEST_K * sharpness.sqrt() / step).ceil() as usize;
        let wave = |n: usize| {
            let k = n as f64 * step;
            let omega = if n == 0 { 0.0 } else { continuum::bar(kernel, k)?.omega };
            let weight = if n == 0 { 0.5 } else { 1.0 } * step / PI * (PI / sharpness).sqrt();
            Some((k, omega, weight * libm::exp(-k * k / (4.0 * sharpness))))
        };
        Some(Self { waves: (0..=count).map(wave).collect::<Option<Vec<_>>>()?, reach })
    }

    /// u at x/δ and vt/δ; None outside the reach asked for.
    pub fn displacement(&self, x: f64, t: f64) -> Option<f64> {
        self.sum(x, t, |k| libm::cos(k * x))
    }

    /// δ ∂u/∂x at x/δ and vt/δ; None outside the reach asked for.
    pub fn strain(&self, x: f64, t: f64) -> Option<f64> {
        self.sum(x, t, |k| -k * libm::sin(k * x))
    }

    fn sum(&self, x: f64, t: f64, shape: impl Fn(f64) -> f64) -> Option<f64> {
        let inside = x.abs() + t.abs() <= self.reach;
        let wave = |(k, omega, weight): &(f64, f64, f64)| weight * shape(*k) * libm::cos(omega * t);
        inside.then(|| self.waves.iter().map(wave).sum())
    }
}
