//! How fast waves of a given length travel in the peridynamic continuum: the lattice of infinitely fine spacing.
//!
//! With z = kδ and M_n = ∫₀¹ W sⁿ ds, from inserting a plane wave into ρü = ∫ c (ξ⊗ξ/|ξ|³)(u' − u) dV':
//! bar (ωδ/v)² = (2/M₁) ∫₀¹ W(s) (1 − cos zs)/s ds;
//! plane (ωδ/c)² = (a/M₂) ∫₀¹ W(s) ∫₀^2π q(θ) (1 − cos(z s cos θ)) dθ ds, with q = cos²θ, a = 8/(3π) for P
//! (c = c_d) and q = sin²θ, a = 8/π for S (c = c_s), θ measured from the wave vector.
//! Source: Silling (2000); Zimmermann, PhD thesis, MIT (2005). The integrals are evaluated as
//! they stand, 1 − cos written 2 sin²: Gauss–Legendre panels in s, the periodic trapezoidal rule in θ.

use crate::double_double::{Dd, PI};
use crate::kernel::Kernel;
use crate::quadrature;
use crate::{Branch, Wave};

/// Largest kδ of [`bar`]: some 30 ms there.
pub const BAR_LIMIT: f64 = 2e4;
/// Largest kδ of [`plane`]: some 100 ms there, the cost growing like (kδ)².
pub const PLANE_LIMIT: f64 = 400.0;

/// The wave in a bar: ωδ/v and group speed over v, relative error below 2e-15 in both (in the group speed
/// relative to the largest, 1, where it passes near zero). None for k ≤ 0 and beyond [`BAR_LIMIT`].
/// Some 0.1 ms at kδ = 50, growing in proportion.
pub fn bar(kernel: Kernel, k_horizon: f64) -> Option<Wave> {
    if !(k_horizon > 0.0 && k_horizon <= BAR_LIMIT) {
        return None;
    }
    let (mut square, mut derivative) = (Dd::ZERO, Dd::ZERO);
    for (s, weight) in quadrature::panels(kernel.panels(k_horizon)) {
        let (one_minus_cosine, sine) = versine_and_sine(s * k_horizon);
        let weight = weight * kernel.weight(s);
        square = square + weight * one_minus_cosine / s;
        derivative = derivative + weight * sine;
    }
    let factor = Dd::from(2.0) / kernel.moment(1);
    Some(wave(square * factor, derivative * factor))
}

/// A plane wave in the plane: ωδ/c and group speed over c, c the classical speed of the branch; accuracy as
/// in [`bar`]. None for k ≤ 0 and beyond [`PLANE_LIMIT`].
pub fn plane(kernel: Kernel, branch: Branch, k_horizon: f64) -> Option<Wave> {
    let [p, s] = plane_pair(kernel, k_horizon)?;
    Some(if branch == Branch::P { p } else { s })
}

/// [`plane`] for P and S at the price of one.
pub fn plane_pair(kernel: Kernel, k_horizon: f64) -> Option<[Wave; 2]> {
    if !(k_horizon > 0.0 && k_horizon <= PLANE_LIMIT) {
        return None;
    }
    let nodes: Vec<(Dd, Dd)> = quadrature::panels(kernel.panels(k_horizon))
        .map(|(s, weight)| (s * k_horizon, weight * kernel.weight(s)))
        .collect();
    let quarter = directions_in_a_quarter(k_horizon);
    let step = PI / Dd::from(2.0 * quarter as f64);
    let mut sums = [(Dd::ZERO, Dd::ZERO); 2];
    for j in 0..quarter {
        let (sine, cosine) = (step * (j as f64 + 0.5)).sin_cos();
        let (along, along_derivative) = radial(&nodes, cosine);
        for ((square, derivative), share) in sums.iter_mut().zip([cosine.squared(), sine.squared()]) {
            *square = *square + share * along;
            *derivative = *derivative + share * along_derivative;
        }
    }
    let of = |(square, derivative): (Dd, Dd), long_wave: f64| {
        let factor = Dd::from(8.0) * step * 4.0 / (PI * kernel.moment(2) * long_wave);
        wave(square * factor, derivative * factor / Dd::from(k_horizon))
    };
    Some([of(sums[0], 3.0), of(sums[1], 1.0)])
}

/// ∫ W (1 − cos(z s c)) ds and z times its derivative in z, along the direction with cos θ = c.
fn radial(nodes: &[(Dd, Dd)], cosine: Dd) -> (Dd, Dd) {
    nodes.iter().fold((Dd::ZERO, Dd::ZERO), |(value, derivative), (distance, weight)| {
        let phase = *distance * cosine;
        let (one_minus_cosine, sine) = versine_and_sine(phase);
        (value + *weight * one_minus_cosine, derivative + *weight * phase * sine)
    })
}

/// The trapezoidal rule with N directions errs by about J_N(z), below 1e-31 for N ≥ z + 19 z^(1/3) + 40;
/// by symmetry a quarter of them, at mid-points, does the work.
fn directions_in_a_quarter(z: f64) -> usize {
    ((z + 19.0 * libm::cbrt(z) + 40.0) / 4.0).ceil() as usize
}

/// (1 − cos x, sin x) without cancellation.
fn versine_and_sine(x: Dd) -> (Dd, Dd) {
    let (sine, cosine) = (x * 0.5).sin_cos();
    (sine.squared() * 2.0, sine * cosine * 2.0)
}

/// ω and dω/dk from ω² and dω²/dk.
fn wave(square: Dd, derivative: Dd) -> Wave {
    let omega = square.sqrt();
    Wave { omega: omega.to_f64(), slope: (derivative / (omega * 2.0)).to_f64() }
}
