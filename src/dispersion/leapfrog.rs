//! What leapfrog makes of a frequency: sin(ωΔt/2) = ΩΔt/2, Ω the lattice's own (von Neumann).

use super::Wave;

/// A time step this much above the limit is the limit, rounded.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The wave as leapfrog carries it at `courant` = cΔt/Δx, or `None` where it grows.
///
/// `rest` is 1 − (ΩΔt/2)² where the caller knows it better than by subtraction.
pub fn wave(space: Wave, courant: f64, rest: Option<f64>) -> Option<Wave> {
    let half = 0.5 * courant * space.omega;
    let rest = rest.unwrap_or((1.0 - half) * (1.0 + half));
    if rest < -ROUNDING {
        return None;
    }
    let root = rest.max(0.0).sqrt();
    let omega = 2.0 / courant * libm::atan2(half, root);
    // At the limit itself the slope is 0/0; nothing is said of it.
    let group = if root == 0.0 { f64::NAN } else { space.group / root };
    Some(Wave { omega, group })
}

/// Finite differences of a bar with leapfrog: at courant 1 every wave travels at its own speed.
pub fn finite_differences_bar(theta: f64, courant: f64) -> Option<Wave> {
    let cosine = libm::cos(0.5 * theta);
    let rest = (1.0 - courant) * (1.0 + courant) + courant * courant * cosine * cosine;
    wave(super::finite_differences::bar(theta), courant, Some(rest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::PI;

    #[test]
    fn finite_differences_at_courant_one_are_exact() {
        for theta in [1e-9, 0.5, 3.0, PI - 1e-9] {
            assert_relative_eq!(
                finite_differences_bar(theta, 1.0).unwrap().omega,
                theta,
                max_relative = 1e-15
            );
        }
    }

    #[test]
    fn above_the_limit_there_is_no_frequency() {
        assert!(finite_differences_bar(PI, 1.0).is_some());
        assert!(finite_differences_bar(PI, 1.000_001).is_none());
        assert!(finite_differences_bar(1.0, 1.000_001).is_some());
    }
}
