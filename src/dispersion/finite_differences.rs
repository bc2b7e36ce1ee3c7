//! Waves of classical elasticity by second-order central differences on the same lattice.
//!
//! Bar: (ωΔx/v)² = 4 sin²(θ/2). Plane: Navier's equations with the mixed derivative from the four diagonal
//! neighbours over 4Δx², and C₁₂ + C₆₆ = C₁₁ − C₆₆ = 2C₁₁/3, the elasticity that the bond-based law imposes.

use super::plane::{Symmetric, direction, pick, speed_ratio_squared};
use super::{Branch, Wave};

/// A wave of the bar at θ = kΔx.
pub fn bar(theta: f64) -> Wave {
    let sine = 2.0 * libm::sin(0.5 * theta);
    Wave { omega: sine.abs(), group: libm::cos(0.5 * theta) * sine.signum() }
}

/// The matrix whose eigenvalues are (ωΔx/c_d)²; `mixed` is the factor of the mixed derivative, ¼ where it is right.
pub fn matrix(theta: [f64; 2], mixed: f64) -> Symmetric {
    let [x, y] = theta.map(|angle| 4.0 * libm::sin(0.5 * angle).powi(2));
    let coupling = 4.0 * mixed * (2.0 / 3.0) * libm::sin(theta[0]) * libm::sin(theta[1]);
    Symmetric { xx: x + y / 3.0, xy: coupling, yy: x / 3.0 + y }
}

/// The factor of the mixed derivative's four diagonal neighbours: 1/(4ΔxΔy).
pub const QUARTER: f64 = 0.25;

/// The wave of a branch at |k|Δx along `degrees`, in units of the branch's own speed.
pub fn plane(k_dx: f64, degrees: f64, branch: Branch, mixed: f64) -> Wave {
    let along = direction(degrees);
    let theta = along.map(|n| n * k_dx);
    let scale = speed_ratio_squared(branch);
    let (square, e) = pick(matrix(theta, mixed), along, branch);
    let [x, y] = [0, 1].map(|axis| 2.0 * libm::sin(theta[axis]) * along[axis]);
    let coupling = 4.0
        * mixed
        * (2.0 / 3.0)
        * (libm::cos(theta[0]) * libm::sin(theta[1]) * along[0]
            + libm::sin(theta[0]) * libm::cos(theta[1]) * along[1]);
    let slope = (x + y / 3.0) * e[0] * e[0] + 2.0 * coupling * e[0] * e[1] + (x / 3.0 + y) * e[1] * e[1];
    Wave::from_square(scale * square, scale * slope, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn long_waves_travel_at_the_classical_speeds_in_every_direction() {
        for degrees in [0.0, 30.0, 45.0, 71.0] {
            for branch in [Branch::P, Branch::S] {
                assert_relative_eq!(plane(1e-4, degrees, branch, QUARTER).omega, 1e-4, max_relative = 1e-8);
            }
        }
    }

    #[test]
    fn group_velocity_is_the_slope_along_the_ray() {
        let h = 1e-6;
        for degrees in [0.0, 30.0, 45.0] {
            for branch in [Branch::P, Branch::S] {
                let omega = |k| plane(k, degrees, branch, QUARTER).omega;
                let slope = (omega(1.1 + h) - omega(1.1 - h)) / (2.0 * h);
                assert_relative_eq!(plane(1.1, degrees, branch, QUARTER).group, slope, max_relative = 1e-7);
            }
        }
    }
}
