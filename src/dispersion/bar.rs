//! Waves on the lattice of a bar: (ωΔx/v)² = Σ_{j>0} w_j 4 sin²(jθ/2), θ = kΔx.
//!
//! A recurrence replaces the cosine of every bond. D_j = 4 sin²(jθ/2) obeys D_{j+1} − D_j = D_j − D_{j−1} +
//! D₁(2 − D_j), which loses nothing for θ ≤ π/2 (Reinsch's form; Stoer & Bulirsch, Introduction to Numerical
//! Analysis). Beyond, φ = π − θ takes its place, since D_j(θ) is D_j(φ) for even j and 4 − D_j(φ) for odd.

use super::Wave;
use crate::lattice::Stencil;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// π − (the f64 nearest to π).
const PI_REST: f64 = 1.224_646_799_147_353_2e-16;

/// The dispersion relation of one stencil.
#[derive(Debug, Clone)]
pub struct BarDispersion {
    /// w_j for j = 1, 2, …; zero where no bond is.
    weights: Vec<f64>,
    /// (−1)ʲ w_j.
    alternating: Vec<f64>,
    /// 4 Σ w_j over odd j: (ωΔx/v)² at the edge of the Brillouin zone.
    edge: f64,
    /// Long-wave speed over v.
    long_wave: f64,
}

/// Wavenumbers evaluated side by side, so that the recurrence fills SIMD lanes.
const LANES: usize = 16;

impl BarDispersion {
    /// The relation of this stencil.
    pub fn new(stencil: &Stencil<1>) -> Self {
        let mut weights = vec![0.0; stencil.reach()];
        for bond in &stencil.bonds {
            weights[bond.offset[0] as usize - 1] = bond.weight;
        }
        Self::of_weights(weights)
    }

    /// The relation of a chain with these w_j, j = 1, 2, …; bonds of no weight at the far end do not reach.
    pub fn of_weights(mut weights: Vec<f64>) -> Self {
        while weights.last() == Some(&0.0) {
            weights.pop();
        }
        let alternating: Vec<_> =
            weights.iter().enumerate().map(|(n, &w)| if n % 2 == 0 { -w } else { w }).collect();
        let edge = 4.0 * weights.iter().step_by(2).sum::<f64>();
        let long_wave = weights.iter().zip(1..).map(|(w, j)| w * f64::from(j * j)).sum::<f64>().sqrt();
        Self { weights, alternating, edge, long_wave }
    }

    /// w_j for j = 1, 2, …
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// (ωΔx/v)² at θ.
    pub fn square(&self, theta: f64) -> f64 {
        let folded = fold(theta);
        if folded <= FRAC_PI_2 {
            reinsch(&self.weights, [first(folded)])[0]
        } else {
            self.edge + reinsch(&self.alternating, [first(complement(folded))])[0]
        }
    }

    /// ω and group velocity at θ.
    pub fn wave(&self, theta: f64) -> Wave {
        let forward = if theta.rem_euclid(TAU) > PI { -1.0 } else { 1.0 };
        let folded = fold(theta);
        let (square, slope) = if folded <= FRAC_PI_2 {
            sums(&self.weights, folded)
        } else {
            let (square, slope) = sums(&self.alternating, complement(folded));
            (self.edge + square, -slope)
        };
        Wave::from_square(square, forward * slope, self.long_wave)
    }

    /// ωΔx/v at many wavenumbers, in the order given.
    pub fn frequencies(&self, thetas: &[f64]) -> Vec<f64> {
        let mut omegas = Vec::with_capacity(thetas.len());
        for chunk in thetas.chunks(LANES) {
            let mut near = [0.0; LANES];
            let mut beyond = [false; LANES];
            for (lane, &theta) in chunk.iter().enumerate() {
                let folded = fold(theta);
                beyond[lane] = folded > FRAC_PI_2;
                near[lane] = first(if beyond[lane] { complement(folded) } else { folded });
            }
            let plain = reinsch(&self.weights, near);
            let turned = reinsch(&self.alternating, near);
            for lane in 0..chunk.len() {
                let square = if beyond[lane] { self.edge + turned[lane] } else { plain[lane] };
                omegas.push(square.max(0.0).sqrt());
            }
        }
        omegas
    }
}

/// θ brought to 0..=π by periodicity and symmetry.
fn fold(theta: f64) -> f64 {
    let angle = theta.abs() % TAU;
    if angle > PI { (TAU - angle) + 2.0 * PI_REST } else { angle }
}

fn complement(theta: f64) -> f64 {
    (PI - theta) + PI_REST
}

fn first(theta: f64) -> f64 {
    let sine = libm::sin(0.5 * theta);
    4.0 * sine * sine
}

/// Σ_j w_j D_j from D₁, each lane by itself.
fn reinsch<const L: usize>(weights: &[f64], first: [f64; L]) -> [f64; L] {
    let mut value = first;
    let mut step = first;
    let mut sum = [0.0; L];
    for &weight in weights {
        for lane in 0..L {
            sum[lane] += weight * value[lane];
            step[lane] += first[lane] * (2.0 - value[lane]);
            value[lane] += step[lane];
        }
    }
    sum
}

/// Σ_j w_j D_j and its slope Σ_j w_j 2j sin jθ, both by recurrence: sin jθ grows by steps that lose D₁ sin jθ each.
fn sums(weights: &[f64], theta: f64) -> (f64, f64) {
    let (half_sine, half_cosine) = libm::sincos(0.5 * theta);
    let first = 4.0 * half_sine * half_sine;
    let (mut value, mut step) = (first, first);
    let (mut sine, mut sine_step) = (2.0 * half_sine * half_cosine, 2.0 * half_sine * half_cosine);
    let (mut square, mut slope, mut twice_j) = (0.0, 0.0, 2.0);
    for &weight in weights {
        square += weight * value;
        slope += weight * twice_j * sine;
        step += first * (2.0 - value);
        value += step;
        sine_step -= first * sine;
        sine += sine_step;
        twice_j += 2.0;
    }
    (square, slope)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Kernel;
    use crate::lattice::Lattice;
    use crate::partial_volume::VolumeRule;
    use approx::assert_relative_eq;

    fn relation(m: f64) -> BarDispersion {
        let lattice = Lattice {
            kernel: Kernel::Gaussian { p: 1.5 },
            m,
            volume_rule: VolumeRule::Linear,
            calibrated: false,
        };
        BarDispersion::new(&Stencil::new(lattice).unwrap())
    }

    #[test]
    fn one_bond_is_the_spring_chain() {
        let chain = relation(1.0);
        let w = chain.weights[0];
        for theta in [1e-6, 0.4, FRAC_PI_2, 2.0, PI] {
            assert_relative_eq!(
                chain.wave(theta).omega,
                2.0 * w.sqrt() * libm::sin(0.5 * theta),
                max_relative = 1e-15
            );
        }
    }

    #[test]
    fn many_at_once_equal_one_by_one() {
        let lattice = relation(7.3);
        let thetas: Vec<f64> = (0..101).map(|i| f64::from(i) * 0.07 - 1.0).collect();
        let all = lattice.frequencies(&thetas);
        for (theta, omega) in thetas.iter().zip(all) {
            assert_eq!(omega, lattice.wave(*theta).omega);
        }
    }

    #[test]
    fn group_velocity_is_the_slope_of_omega() {
        let lattice = relation(5.0);
        let h = 1e-6;
        for theta in [0.2, 1.5, 1.6, 3.0, 3.5, 7.0] {
            let slope = (lattice.wave(theta + h).omega - lattice.wave(theta - h).omega) / (2.0 * h);
            assert_relative_eq!(lattice.wave(theta).group, slope, epsilon = 1e-8, max_relative = 1e-7);
        }
    }
}
