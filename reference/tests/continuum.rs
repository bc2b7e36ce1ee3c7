//! Are the continuum's wave speeds right? Against mpmath's 20 digits, closed forms, limits and printed values.

use pd_verify_reference::continuum;
use pd_verify_reference::double_double::{Dd, EULER};
use pd_verify_reference::oracles::{self, ContinuumOracle};
use pd_verify_reference::{Branch, Kernel, Wave};

const KERNELS: [Kernel; 6] = [
    Kernel::Constant,
    Kernel::Gaussian { p: 0.5 },
    Kernel::Gaussian { p: 7.3 },
    Kernel::Exponential { p: 3.0 },
    Kernel::Conical,
    Kernel::Parabolic,
];

fn answer(row: &ContinuumOracle) -> Option<Wave> {
    match (row.dimension, row.branch.as_str()) {
        (1, "P") => continuum::bar(row.kernel, row.k_horizon),
        (2, "P") => continuum::plane(row.kernel, Branch::P, row.k_horizon),
        (2, "S") => continuum::plane(row.kernel, Branch::S, row.k_horizon),
        other => panic!("{other:?} is no branch"),
    }
}

#[test]
fn every_tabulated_speed_is_met_to_rounding() {
    let mut checked = 0;
    for row in oracles::continuum_table() {
        let Some(wave) = answer(&row) else {
            assert!(row.dimension == 2 && row.k_horizon > continuum::PLANE_LIMIT, "{row:?} was not answered");
            continue;
        };
        let phase = (wave.omega / (row.k_horizon * row.phase_speed_ratio) - 1.0).abs();
        let group = (wave.slope / row.group_speed_ratio - 1.0).abs();
        assert!(phase <= 2.0 * f64::EPSILON, "{row:?}: phase speed off by {phase:e}");
        assert!(group <= f64::EPSILON, "{row:?}: group speed off by {group:e}");
        checked += 1;
    }
    assert_eq!(checked, 11 * 18 + 2 * 11 * 15);
}

#[test]
fn printed_speeds_of_the_bar() {
    let rows = oracles::published("continuum_bar_phase_speed");
    assert_eq!(rows.len(), 20);
    for row in rows {
        let (kernel, z) = (row.kernel.expect("a kernel"), row.argument.expect("a wave number"));
        let found = continuum::bar(kernel, z).expect("within the range").omega / z;
        assert!((found - row.value).abs() <= row.half_unit.max(f64::EPSILON), "{found} against {row:?}");
    }
}

#[test]
fn long_waves_are_slow_by_the_printed_share() {
    let z = 1e-3;
    let share = |kernel| (continuum::bar(kernel, z).expect("within the range").omega / z - 1.0) / (z * z);
    for row in oracles::published("continuum_bar_long_wave_coefficient") {
        let found = share(row.kernel.expect("a kernel"));
        assert!((found - row.value).abs() <= row.half_unit + 1e-9, "{found} against {row:?}");
    }
    assert!((share(Kernel::Constant) + 1.0 / 48.0).abs() < 1e-8);
}

/// ∫₀¹ (1 − cos zs)/s ds = Σ (−1)^(n+1) z^(2n)/(2n (2n)!).
fn cin(z: f64) -> Dd {
    let square = Dd::from(z) * z;
    let (mut power, mut sum) = (Dd::ONE, Dd::ZERO);
    for n in 1..60 {
        let twice = 2.0 * f64::from(n);
        power = -(power * square) / Dd::from(twice * (twice - 1.0));
        sum = sum - power / Dd::from(twice);
    }
    sum
}

/// Re Ein(p + iz) − Ein(p), Ein(w) = Σ (−1)^(n+1) wⁿ/(n n!).
fn ein_difference(p: f64, z: f64) -> Dd {
    let (mut re, mut im, mut real) = (Dd::ONE, Dd::ZERO, Dd::ONE);
    let mut sum = Dd::ZERO;
    for n in 1..90 {
        let n = Dd::from(f64::from(n));
        (re, im) = (-(re * p - im * z) / n, -(re * z + im * p) / n);
        real = -(real * p) / n;
        sum = sum - (re - real) / n;
    }
    sum
}

#[test]
fn closed_forms_of_the_bar() {
    for z in [0.5, 3.7, 9.0] {
        let (sine, cosine) = Dd::from(z).sin_cos();
        let sinc = sine / Dd::from(z);
        let ramp = Dd::from(0.5) - sinc - (cosine - Dd::ONE) / Dd::from(z * z);
        let cases = [
            (Kernel::Constant, cin(z) * 4.0),
            (Kernel::Conical, (cin(z) - Dd::ONE + sinc) * 12.0),
            (Kernel::Parabolic, (cin(z) - ramp) * 8.0),
            (Kernel::Exponential { p: 1.7 }, {
                let edge = Dd::from(-1.7).exp();
                let moment = (Dd::ONE - edge * 2.7) / (Dd::from(1.7) * 1.7);
                ein_difference(1.7, z) * 2.0 / moment
            }),
        ];
        for (kernel, square) in cases {
            let found = continuum::bar(kernel, z).expect("within the range").omega;
            let expected = square.sqrt().to_f64();
            assert!(
                (found / expected - 1.0).abs() < 1e-15,
                "{kernel:?}, z = {z}: {found} against {expected}"
            );
        }
    }
}

#[test]
fn short_waves_of_the_constant_kernel_grow_like_the_logarithm() {
    let z = 15_000.0_f64;
    let found = continuum::bar(Kernel::Constant, z).expect("within the range").omega;
    let (sine, cosine) = (z.sin(), z.cos());
    let ci = sine / z * (1.0 - 2.0 / (z * z)) - cosine / (z * z);
    let expected = 2.0 * (EULER.to_f64() + z.ln() - ci).sqrt();
    assert!((found / expected - 1.0).abs() < 1e-14, "{found} against {expected}");
}

#[test]
fn shapes_meet_where_they_should() {
    for z in [0.3, 12.0] {
        let bar = |kernel| continuum::bar(kernel, z).expect("within the range").omega;
        let plane = |kernel| continuum::plane(kernel, Branch::S, z).expect("within the range").omega;
        for flat in [Kernel::Gaussian { p: 0.0 }, Kernel::Exponential { p: 0.0 }] {
            assert_eq!(bar(flat), bar(Kernel::Constant));
            assert_eq!(plane(flat), plane(Kernel::Constant));
        }
        assert!(bar(Kernel::Gaussian { p: 3.0 }) > bar(Kernel::Constant), "narrow kernels disperse less");
    }
}

#[test]
fn group_speed_is_the_slope_of_the_frequency() {
    let step = 1e-4;
    let slope = |omega: &dyn Fn(f64) -> f64, z: f64| {
        (8.0 * (omega(z + step) - omega(z - step)) - (omega(z + 2.0 * step) - omega(z - 2.0 * step)))
            / (12.0 * step)
    };
    for kernel in KERNELS {
        for z in [0.7, 6.0] {
            let bar = |z| continuum::bar(kernel, z).expect("within the range");
            assert!((slope(&|z| bar(z).omega, z) - bar(z).slope).abs() < 1e-10, "{kernel:?}, bar, {z}");
            for branch in [Branch::P, Branch::S] {
                let plane = |z| continuum::plane(kernel, branch, z).expect("within the range");
                let error = slope(&|z| plane(z).omega, z) - plane(z).slope;
                assert!(error.abs() < 1e-10, "{kernel:?}, {branch:?}, {z}: {error:e}");
            }
        }
    }
}

#[test]
fn outside_its_range_there_is_no_answer() {
    for z in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(continuum::bar(Kernel::Constant, z), None);
        assert_eq!(continuum::plane(Kernel::Constant, Branch::P, z), None);
    }
    assert_eq!(continuum::bar(Kernel::Constant, 1.01 * continuum::BAR_LIMIT), None);
    assert_eq!(continuum::plane(Kernel::Constant, Branch::S, 1.01 * continuum::PLANE_LIMIT), None);
}
