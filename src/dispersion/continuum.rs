//! Waves in the nonlocal continuum: what a lattice tends to as m → ∞ at fixed δ.
//!
//! With z = kδ and Mₙ the kernel's moments,
//! - bar: (ωδ/v)² = (2/M₁) ∫₀¹ W (1 − cos zs)/s ds   (Silling 2000, J. Mech. Phys. Solids 48, 175, sec. 8);
//! - plane: (ωδ/c_d)² = (8/(3M₂)) ∫₀¹ W (1 − 2J₀ + 2J₁/x) ds and (ωδ/c_s)² = (8/M₂) ∫₀¹ W (1 − 2J₁/x) ds with
//!   Bessel functions of x = zs, the angular integrals of cos²θ and sin²θ times 1 − cos(x cos θ).

use super::{Branch, Wave};
use crate::kernel::Kernel;
use crate::quadrature::{Integral, composite};

/// A wave of the bar at z = kδ ≥ 0, and the estimated relative error of its ω.
pub fn bar(kernel: Kernel, z: f64) -> (Wave, f64) {
    let half_sine = |s: f64| libm::sin(0.5 * z * s);
    let square = integrate(kernel, z, |s| 2.0 * half_sine(s).powi(2) / s);
    let slope = integrate(kernel, z, |s| libm::sin(z * s));
    finish(2.0 / kernel.moment(1), square, slope)
}

/// A wave of the plane at z = kδ ≥ 0, and the estimated relative error of its ω.
pub fn plane(kernel: Kernel, branch: Branch, z: f64) -> (Wave, f64) {
    let m2 = kernel.moment(2);
    match branch {
        Branch::P => {
            let square = integrate(kernel, z, |s| longitudinal(z * s));
            let slope = integrate(kernel, z, |s| s * longitudinal_slope(z * s));
            finish(8.0 / (3.0 * m2), square, slope)
        }
        Branch::S => {
            let square = integrate(kernel, z, |s| transverse(z * s));
            let slope = integrate(kernel, z, |s| s * transverse_slope(z * s));
            finish(8.0 / m2, square, slope)
        }
    }
}

fn finish(factor: f64, square: Integral, slope: Integral) -> (Wave, f64) {
    let wave = Wave::from_square(factor * square.value, factor * slope.value, 1.0);
    (wave, if square.value > 0.0 { 0.5 * square.error / square.value } else { 0.0 })
}

/// Panels of the quadrature: none wider than a period of the wave or than the kernel.
pub fn panels(kernel: Kernel, z: f64) -> usize {
    let periods = z / std::f64::consts::TAU;
    periods.max(kernel.p().unwrap_or(0.0)).max(1.0).ceil() as usize
}

/// ∫₀¹ W f ds.
fn integrate(kernel: Kernel, z: f64, f: impl Fn(f64) -> f64) -> Integral {
    composite(0.0, 1.0, panels(kernel, z), |s| kernel.weight(s) * f(s))
}

/// Below this the Bessel forms cancel and their power series take over.
const SERIES_BELOW: f64 = 2.0;

/// Σ_{n≥1} (−1)ⁿ⁺¹ (x²/4)ⁿ aₙ/(n!)².
fn alternating(x: f64, a: impl Fn(f64) -> f64) -> f64 {
    let q = 0.25 * x * x;
    let mut power = 1.0;
    let mut sum = 0.0;
    for n in 1..=16 {
        let n = f64::from(n);
        power *= -q / (n * n);
        sum -= power * a(n);
    }
    sum
}

/// 1 − 2J₀(x) + 2J₁(x)/x.
fn longitudinal(x: f64) -> f64 {
    if x < SERIES_BELOW {
        return alternating(x, |n| 2.0 - 1.0 / (n + 1.0));
    }
    1.0 - 2.0 * libm::j0(x) + 2.0 * libm::j1(x) / x
}

/// 1 − 2J₁(x)/x.
fn transverse(x: f64) -> f64 {
    if x < SERIES_BELOW {
        return alternating(x, |n| 1.0 / (n + 1.0));
    }
    1.0 - 2.0 * libm::j1(x) / x
}

/// d/dx of [`longitudinal`]: 2J₁ − 2J₂/x.
fn longitudinal_slope(x: f64) -> f64 {
    if x < SERIES_BELOW {
        return if x == 0.0 { 0.0 } else { alternating(x, |n| 2.0 * n * (2.0 - 1.0 / (n + 1.0))) / x };
    }
    2.0 * libm::j1(x) - 2.0 * libm::jn(2, x) / x
}

/// d/dx of [`transverse`]: 2J₂/x.
fn transverse_slope(x: f64) -> f64 {
    if x < SERIES_BELOW {
        return if x == 0.0 { 0.0 } else { alternating(x, |n| 2.0 * n / (n + 1.0)) / x };
    }
    2.0 * libm::jn(2, x) / x
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn series_and_bessel_forms_meet() {
        let x = SERIES_BELOW;
        let below = x * (1.0 - 1e-15);
        for f in [longitudinal, transverse, longitudinal_slope, transverse_slope] {
            assert_relative_eq!(f(below), f(x), max_relative = 1e-14);
        }
    }

    #[test]
    fn group_velocity_is_the_slope_of_omega() {
        let h = 1e-5;
        for kernel in
            [Kernel::Constant, Kernel::Gaussian { p: 2.0 }, Kernel::Exponential { p: 3.0 }, Kernel::Parabolic]
        {
            for z in [0.3, 4.0, 19.0] {
                let slope = (bar(kernel, z + h).0.omega - bar(kernel, z - h).0.omega) / (2.0 * h);
                assert_relative_eq!(bar(kernel, z).0.group, slope, epsilon = 1e-9, max_relative = 1e-8);
                for branch in [Branch::P, Branch::S] {
                    let omega = |z| plane(kernel, branch, z).0.omega;
                    let slope = (omega(z + h) - omega(z - h)) / (2.0 * h);
                    assert_relative_eq!(
                        plane(kernel, branch, z).0.group,
                        slope,
                        epsilon = 1e-9,
                        max_relative = 1e-8
                    );
                }
            }
        }
    }

    #[test]
    fn stated_error_is_small_up_to_ten_thousand() {
        for z in [1e-8, 1.0, 1e4] {
            assert!(bar(Kernel::Gaussian { p: 2.0 }, z).1 < 1e-13);
            assert!(plane(Kernel::Constant, Branch::P, z).1 < 1e-13);
        }
    }
}
