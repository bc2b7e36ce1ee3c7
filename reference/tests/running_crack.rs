//! Universal functions of running cracks: another way to the factor, its limits, an approximation, the energy released.

use std::f64::consts::PI;

use pd_verify_reference::freund::{Load, StationaryCrack};
use pd_verify_reference::running_crack::RunningCrack;
use pd_verify_reference::{Mode, Plane};

const RATIOS: [f64; 6] = [-0.2, 0.0, 0.1, 0.25, 0.3, 0.45];
const SHARES: [f64; 6] = [0.01, 0.2, 0.5, 0.8, 0.95, 0.999];

fn crack(poisson_ratio: f64, mode: Mode, share_of_rayleigh: f64) -> RunningCrack {
    let plane = Plane { shear_modulus: 3.0, poisson_ratio, density: 0.7 };
    RunningCrack { plane, mode, speed: share_of_rayleigh * plane.rayleigh_speed() }
}

fn universal(poisson_ratio: f64, mode: Mode, share: f64) -> f64 {
    crack(poisson_ratio, mode, share).universal().expect("slower than Rayleigh waves")
}

/// S₊ right of the imaginary axis by Cauchy's integral along it, where Rayleigh's function has neither branch nor zero:
/// ln S₊(p) = (p/π)∫₀^∞ ln[R(iω)/(2(b² − a²)(c² + ω²))] dω/(p² + ω²), b = 1. With ω = p tan φ and the midpoint rule.
fn split_right(a: f64, c: f64, p: f64) -> f64 {
    let count = 20_000;
    let value = |i: i32| {
        let omega = p * libm::tan(PI / 2.0 * (f64::from(i) + 0.5) / f64::from(count));
        let (w, a2) = (omega * omega, a * a);
        // (1 + 2w)² − 4w√((a² + w)(1 + w)), times and over the sum.
        let product = ((24.0 - 16.0 * a2 + 16.0 * (1.0 - a2) * w) * w + 8.0) * w + 1.0;
        let sum = (1.0 + 2.0 * w).powi(2) + 4.0 * w * ((a2 + w) * (1.0 + w)).sqrt();
        libm::log(product / sum / (2.0 * (1.0 - a2) * (c * c + w)))
    };
    libm::exp((0..count).map(value).sum::<f64>() / (2.0 * f64::from(count)))
}

// S₊(−p) = R(p)/(2(b² − a²)(c² − p²)S₊(p)).
#[test]
fn the_factor_by_an_integral_along_the_imaginary_axis() {
    for ratio in RATIOS {
        for share in SHARES {
            let RunningCrack { plane, speed, .. } = crack(ratio, Mode::One, share);
            let b = 1.0 / plane.shear_speed();
            let [a, c] = [plane.dilatational_speed(), plane.rayleigh_speed()].map(|v| 1.0 / (v * b));
            let p = 1.0 / (speed * b);
            let (p2, a2) = (p * p, a * a);
            let rayleigh = (1.0 - 2.0 * p2).powi(2) - 4.0 * p2 * ((p2 - a2) * (p2 - 1.0)).sqrt();
            let split = rayleigh / (2.0 * (1.0 - a2) * (c * c - p2) * split_right(a, c, p));
            for (mode, slowness) in [(Mode::One, a), (Mode::Two, 1.0)] {
                let expected = (1.0 - share) / (1.0 - slowness / p).sqrt() * split;
                let found = universal(ratio, mode, share);
                // R(p) loses p⁴ of rounding against p² at slow tips, and as much against 1 − share at fast ones.
                let bound = 1e-14 * (p2 + 1.0 / (1.0 - share)) + 1e-8 / f64::from(20_000);
                assert!(
                    (found / expected - 1.0).abs() < bound,
                    "{ratio} {mode:?} {share}: {:e}",
                    found / expected - 1.0
                );
            }
        }
    }
}

#[test]
fn between_rest_and_rayleigh_waves() {
    for (ratio, mode) in RATIOS.into_iter().flat_map(|ratio| [(ratio, Mode::One), (ratio, Mode::Two)]) {
        assert_eq!(universal(ratio, mode, 0.0), 1.0);
        assert_eq!(universal(ratio, mode, 1.0), 0.0);
        assert_eq!(crack(ratio, mode, 1.001).universal(), None);
        assert_eq!(crack(ratio, mode, -0.001).universal(), None);
        assert_eq!(crack(ratio, mode, f64::NAN).universal(), None);
        let values: Vec<f64> = (0..=40).map(|i| universal(ratio, mode, f64::from(i) / 40.0)).collect();
        assert!(values.windows(2).all(|pair| pair[1] < pair[0]), "{ratio} {mode:?}: {values:?}");
    }
}

// Rose, Proc. R. Soc. Lond. A 349 (1976) 497: in mode I √(a + ζ)/S₊ replaced by √(h + ζ) with the right value at ζ = 0,
// h = a/S₊(0)² = 2a(c/b)²(1 − a²/b²), so k_I ≈ (1 − v/c_R)/√(1 − hv): an approximation whose
// error, largest at ν = 0.3, was measured as 0.3, 0.8, 1.9 and 4.8 %.
#[test]
fn near_roses_approximation() {
    for ratio in [0.1, 0.25, 0.3] {
        for (share, bound) in [(0.2, 0.003), (0.4, 0.01), (0.6, 0.02), (0.8, 0.05)] {
            let RunningCrack { plane, speed, .. } = crack(ratio, Mode::One, share);
            let [slow, fast] = [plane.shear_speed(), plane.dilatational_speed()];
            let h = 2.0 / fast * (slow / plane.rayleigh_speed()).powi(2) * (1.0 - (slow / fast).powi(2));
            let near = (1.0 - share) / (1.0 - h * speed).sqrt();
            let found = universal(ratio, Mode::One, share);
            assert!((found / near - 1.0).abs() < bound, "{ratio} {share}: {found} {near}");
        }
    }
}

// g_I ≈ 1 − v/c_R is Freund's approximation; it is off by up to 0.06 (measured).
#[test]
fn energy_released() {
    for ratio in [0.1, 0.25, 0.3] {
        for (mode, share) in SHARES.into_iter().flat_map(|share| [(Mode::One, share), (Mode::Two, share)]) {
            let crack = crack(ratio, mode, share);
            let found = crack.release().expect("slower than Rayleigh waves");
            let q = (crack.speed / crack.plane.shear_speed()).powi(2);
            let (d, s) = ((1.0 - q * crack.plane.speed_ratio_squared()).sqrt(), (1.0 - q).sqrt());
            let alpha = if mode == Mode::One { d } else { s };
            let printed = q * alpha / ((1.0 - ratio) * (4.0 * d * s - (1.0 + s * s).powi(2)));
            // Rounding of D as printed: against q at slow tips, against 1 − share at fast ones.
            let bound = 1e-14 * (1.0 / q + 1.0 / (1.0 - share));
            assert!((found / printed - 1.0).abs() < bound, "{ratio} {mode:?} {share}: {found} {printed}");
            if mode == Mode::One {
                let g = found * universal(ratio, mode, share).powi(2);
                assert!((g - (1.0 - share)).abs() < 0.07, "{ratio} {share}: {g}");
            }
        }
        let at = |share| crack(ratio, Mode::Two, share).release();
        assert_eq!((at(0.0), at(1.01), at(-0.1), at(f64::NAN)), (Some(1.0), None, None, None));
    }
}

// At ν = ¼ and v = 0.5 c_s, 20-digit quadrature: S₊ = 1.152125195, k_I = 0.6231470675, k_II = 0.7432579251.
#[test]
fn values_by_another_program() {
    for (mode, expected) in [(Mode::One, 0.623_147_067_5), (Mode::Two, 0.743_257_925_1)] {
        let plane = Plane { shear_modulus: 1.0, poisson_ratio: 0.25, density: 1.0 };
        let found = RunningCrack { plane, mode, speed: 0.5 }.universal().expect("slow enough");
        assert!((found - expected).abs() < 6e-11, "{mode:?}: {found}");
    }
}

#[test]
fn a_running_crack_is_a_crack_at_rest_times_the_function() {
    let crack = crack(0.3, Mode::Two, 0.6);
    let load = Load::Ramp { start: 0.1, rise: 0.5 };
    let rest = StationaryCrack { plane: crack.plane, mode: crack.mode }.at(&load, 2.0);
    let found = crack.at(&load, 2.0).expect("slow enough");
    assert!((found / rest / universal(0.3, Mode::Two, 0.6) - 1.0).abs() < 1e-15);
    assert_eq!(RunningCrack { speed: 9.0, ..crack }.at(&load, 2.0), None);
}
