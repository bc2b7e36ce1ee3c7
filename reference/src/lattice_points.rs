//! How a lattice nears the nonlocal continuum as m = δ/Δx grows at a fixed horizon: the error of ω² by Poisson summation.
//!
//! A lattice's ω² is Σ_r β f(r/m)/m², the continuum's ∫ f dξ, f = W q(θ)(1 − cos(kδ s cos θ))/s (q = cos²θ for P, sin²θ
//! for S, θ from the wave vector, s = |ξ|/δ). The sum is Σ_g of the transform of βf over the reciprocal lattice: g = 0
//! gives a smooth power of 1/m, g ≠ 0 waves cos(2πm|g| − 3π/4) from the rim of the disc, which look irregular in m.
//! With F(s) = W ∮ q(1 − cos) dθ and I = ∫₀¹ F ds, relative to ω²:
//! - `Full`: the rim jumps; waves of m^(−3/2) from every g (Gauss's circle problem: Hardy, Quart. J. Math. 46
//!   (1915) 263), those of integer |g| in step at integer m, and ties on top. No closed form here.
//! - `Linear`: β is the disc averaged over radii m ± ½: F'(1)/(24 I m²), and the waves of `Full` times sin(π|g|)/(π|g|),
//!   which spares no |g|² = 2, 5, 8 …: m^(−3/2), with a small coefficient.
//! - `ExactArea`: β is the disc averaged over a cell, whose transform is zero at every g ≠ 0: (F'(1) − F(1))/(24 I m²) and
//!   waves of m^(−5/2) from the slope of f.
//!
//! Kernels with W(1) = 0 have half the slope at the rim, and their waves are a power lower. A calibrated lattice is
//! rid of the value at kδ = 0. What is left out is below 1.2 m^(−5/2) for kδ ≤ 3 and m ≥ 8 (measured).

use crate::double_double::Dd;
use crate::{Branch, Kernel, VolumeRule, quadrature};
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// Waves with |g| up to this along each axis are summed; those beyond add up to 2e-4 m^(−3/2) (measured).
const FURTHEST: i32 = 60;

/// m² times the smooth part of ω²(lattice)/ω²(continuum) − 1 for large m, in every direction. None for
/// [`VolumeRule::Full`], whose error has no smooth part that could be told from the rest, and for kδ not positive.
pub fn smooth_part(
    kernel: Kernel,
    rule: VolumeRule,
    calibrated: bool,
    branch: Branch,
    k_horizon: f64,
) -> Option<f64> {
    let of = |z: f64| {
        let [value, slope] = rim(kernel, branch, z);
        let less = if rule == VolumeRule::ExactArea { value } else { 0.0 };
        (slope - less) / (24.0 * integral(kernel, branch, z))
    };
    let known = rule != VolumeRule::Full && k_horizon > 0.0;
    known.then(|| of(k_horizon) - if calibrated { of(LONG) } else { 0.0 })
}

/// kδ of a wave so long that its square does not matter, and not so long that 1 − cos is lost to rounding.
const LONG: f64 = 1e-3;

/// The irregular part of ω²(lattice)/ω²(continuum) − 1 for large m, [`VolumeRule::Linear`], not calibrated, a wave that
/// travels at `angle_rad` to the x axis. 0 for kernels with W(1) = 0.
pub fn irregular_part_of_linear(
    kernel: Kernel,
    branch: Branch,
    k_horizon: f64,
    angle_rad: f64,
    m: f64,
) -> f64 {
    let weight = kernel.weight(Dd::ONE).to_f64();
    let places = (-FURTHEST..=FURTHEST).flat_map(|i| (-FURTHEST..=FURTHEST).map(move |j| (i, j)));
    let waves = places.filter(|place| *place != (0, 0)).map(|(i, j)| {
        let length = libm::sqrt(f64::from(i * i + j * j));
        let cosine = (libm::cos(angle_rad) * f64::from(i) + libm::sin(angle_rad) * f64::from(j)) / length;
        let share = if branch == Branch::P { cosine * cosine } else { 1.0 - cosine * cosine };
        let versine = 2.0 * libm::pow(libm::sin(0.5 * k_horizon * cosine), 2.0);
        let phase = TAU * m * length;
        let ramp = libm::sin(PI * length) / (PI * length);
        share * versine * ramp * libm::cos(phase - 3.0 * FRAC_PI_4) / libm::pow(phase, 1.5)
    });
    libm::sqrt(8.0 * PI) * weight * waves.sum::<f64>() / integral(kernel, branch, k_horizon)
}

/// F and its slope at s = 1, the slope halved where the kernel ends in a kink.
fn rim(kernel: Kernel, branch: Branch, z: f64) -> [f64; 2] {
    let (weight, slope) = match kernel {
        Kernel::Constant => (1.0, 0.0),
        Kernel::Gaussian { p } => (libm::exp(-p * p), -2.0 * p * p * libm::exp(-p * p)),
        Kernel::Exponential { p } => (libm::exp(-p), -p * libm::exp(-p)),
        Kernel::Conical => (0.0, -0.5),
        Kernel::Parabolic => (0.0, -1.0),
    };
    let (versine, growth) = around(branch, z);
    [weight * versine, slope * versine + weight * z * growth]
}

/// ∮ q(1 − cos(x cos θ)) dθ and its derivative in x, by Bessel functions.
fn around(branch: Branch, x: f64) -> (f64, f64) {
    let (first, second) = (libm::j1(x), libm::jn(2, x) / x);
    match branch {
        Branch::P => (PI - TAU * (libm::j0(x) - first / x), TAU * (first - second)),
        Branch::S => (PI - TAU * first / x, TAU * second),
    }
}

/// I.
fn integral(kernel: Kernel, branch: Branch, z: f64) -> f64 {
    let nodes =
        quadrature::panels(kernel.panels(z)).map(|(s, weight)| (s.to_f64(), weight * kernel.weight(s)));
    nodes.map(|(s, weight)| weight.to_f64() * around(branch, z * s).0).sum()
}
