//! Are the lattice's waves, moduli and time steps right? Against printed values, closed forms and limits.

use pd_verify_reference::oracles::{self, PublishedOracle};
use pd_verify_reference::{
    Branch, Kernel, Lattice, VolumeRule, Wave, continuum, finite_differences, lattice, leapfrog,
};

const CONSTANT: Lattice =
    Lattice { kernel: Kernel::Constant, m: 3.0, rule: VolumeRule::Linear, calibrated: false };
const NARROW: Lattice = Lattice { kernel: Kernel::Gaussian { p: 2.0 }, ..CONSTANT };

fn lattice_of(row: &PublishedOracle) -> Lattice {
    Lattice {
        kernel: row.kernel.unwrap_or(Kernel::Constant),
        m: row.m.expect("a lattice"),
        rule: row.rule.expect("a volume rule"),
        calibrated: row.calibrated.unwrap_or(false),
    }
}

/// Every printed number of that name, within half a unit of its last digit and the allowance.
fn check(quantity: &str, rows: usize, allowance: f64, answer: impl Fn(Lattice) -> f64) {
    let published = oracles::published(quantity);
    assert_eq!(published.len(), rows, "{quantity}");
    for row in published {
        let found = answer(lattice_of(&row));
        assert!((found - row.value).abs() <= row.half_unit + allowance, "{found} against {row:?}");
    }
}

#[test]
fn printed_values() {
    check("lattice_bar_omega_over_v", 9, 6e-14, |lattice| lattice::bar(lattice, 500.0 * 0.002).omega / 0.002);
    check("lattice_bar_long_wave_speed", 13, 0.0, |lattice| lattice::bar_modulus(lattice).sqrt());
    check("lattice_plane_c11", 20, 0.0, |lattice| lattice::plane_moduli(lattice).c11);
    check("lattice_plane_c12", 20, 0.0, |lattice| lattice::plane_moduli(lattice).c12);
    check("calibration_alpha", 1, 0.0, |lattice| lattice::calibration(lattice).expect("regular").0);
    check("calibration_beta", 1, 0.0, |lattice| lattice::calibration(lattice).expect("regular").1);
    check("neighbours_plane", 3, 0.0, |lattice| lattice::neighbours_plane(lattice.m, lattice.rule) as f64);
}

#[test]
fn printed_time_steps() {
    check("bar_sharp_over_row_sum", 2, 0.0, |lattice| {
        2.0 / lattice::bar_highest(lattice) / lattice::bar_row_sum(lattice)
    });
    check("plane_sharp_over_row_sum", 3, 0.0, |lattice| {
        2.0 / lattice::plane_highest(lattice) / lattice::plane_row_sum(lattice)
    });
}

#[test]
fn full_volumes_make_the_bar_too_stiff_by_one_part_in_m() {
    for m in [1.0, 2.0, 3.0, 7.0] {
        let full = Lattice { m, rule: VolumeRule::Full, ..CONSTANT };
        assert!((lattice::bar_modulus(full) - (m + 1.0) / m).abs() < 1e-15);
        assert_eq!(lattice::bar_modulus(Lattice { m, ..CONSTANT }), 1.0);
        assert_eq!(lattice::neighbours_bar(m, VolumeRule::Full), 2 * m as usize);
    }
    assert_eq!(lattice::neighbours_bar(3.0 * (1.0 - 1e-13), VolumeRule::Full), 6, "a tie counts as inside");
    assert_eq!(lattice::neighbours_bar(3.0 * (1.0 - 1e-11), VolumeRule::Full), 4);
}

#[test]
fn shear_modulus_equals_the_coupling_and_calibration_repairs_both() {
    for rule in [VolumeRule::Full, VolumeRule::Linear, VolumeRule::ExactArea] {
        for (kernel, m) in
            [(Kernel::Gaussian { p: 2.0 }, 3.0), (Kernel::Conical, 2.6), (Kernel::Parabolic, 4.2)]
        {
            let printed = Lattice { kernel, m, rule, calibrated: false };
            let moduli = lattice::plane_moduli(printed);
            assert!((moduli.c12 / moduli.c66 - 1.0).abs() < 1e-15);
            assert!((moduli.c12 - 1.0).abs() > 1e-4, "nothing to repair in {printed:?}");
            let calibrated = Lattice { calibrated: true, ..printed };
            let moduli = lattice::plane_moduli(calibrated);
            for modulus in [moduli.c11, moduli.c12, moduli.c66, lattice::bar_modulus(calibrated)] {
                assert!((modulus - 1.0).abs() < 1e-15, "{moduli:?}");
            }
            for angle in [0.0, 0.3, 0.7] {
                for wave in lattice::plane(calibrated, 0.0, angle) {
                    assert!((wave.slope - 1.0).abs() < 1e-14, "long waves at {angle}: {wave:?}");
                }
            }
        }
    }
    let axis_bonds = Lattice { m: 1.2, rule: VolumeRule::Full, ..CONSTANT };
    assert_eq!(lattice::calibration(axis_bonds), None);
    assert!(lattice::plane(Lattice { calibrated: true, ..axis_bonds }, 0.3, 0.0)[0].omega.is_nan());
}

// Without calibration the narrow kernel's moduli make long shear waves slow along the axes and more so across.
#[test]
fn long_waves_have_the_speeds_of_the_moduli() {
    let moduli = lattice::plane_moduli(NARROW);
    let [p, s] = lattice::plane(NARROW, 0.0, 0.0);
    assert!((p.slope - moduli.c11.sqrt()).abs() < 1e-15 && (s.slope - moduli.c66.sqrt()).abs() < 1e-15);
    let [p, s] = lattice::plane(NARROW, 0.0, std::f64::consts::FRAC_PI_4);
    let (shear, along) = ((3.0 * moduli.c11 - moduli.c12) / 2.0, (moduli.c11 + moduli.c12) / 2.0);
    assert!((s.slope - shear.sqrt()).abs() < 1e-15, "{s:?}");
    assert!((p.slope - along.sqrt()).abs() < 1e-15, "{p:?}");
}

#[test]
fn printed_leapfrog_relations() {
    for (k, courant) in [(0.4, 0.3), (1.7, 0.8), (3.0, 0.9)] {
        let cosine = |n: f64| (n * k).cos();
        let square = courant * courant;
        let two = square * (cosine(1.0) / 2.0 + cosine(2.0) / 8.0 - 5.0 / 8.0) + 1.0;
        let three =
            square * (2.0 * cosine(1.0) / 9.0 + cosine(2.0) / 9.0 + cosine(3.0) / 27.0 - 10.0 / 27.0) + 1.0;
        for (m, expected) in [(2.0, two), (3.0, three)] {
            let space = lattice::bar(Lattice { m, ..CONSTANT }, k);
            let marched = leapfrog::wave(space, courant).expect("stable").omega;
            assert!(((marched * courant).cos() - expected).abs() < 1e-15, "m = {m}, k = {k}");
        }
    }
}

#[test]
fn marching_bends_the_slope_with_the_frequency() {
    let (step, courant) = (1e-4, 0.7);
    let marched = |k: f64| leapfrog::wave(lattice::bar(NARROW, k), courant).expect("stable");
    for k in [0.4, 1.3, 2.2] {
        let slope = (marched(k + step).omega - marched(k - step).omega) / (2.0 * step);
        assert!((slope - marched(k).slope).abs() < 1e-7, "k = {k}: {slope} against {:?}", marched(k));
    }
    let still = Wave { omega: 2.0, slope: 0.1 };
    assert!(leapfrog::wave(still, 1.0).is_some() && leapfrog::wave(still, 1.0 + 1e-15).is_none());
    assert_eq!(leapfrog::wave(still, 0.0), None);
}

// m = 2.6: the third node is in the family by a tenth, but there 1 − s < 0 counts as nothing.
#[test]
fn a_kernel_beyond_its_zero_does_not_push() {
    let conical = Lattice { kernel: Kernel::Conical, m: 2.6, ..CONSTANT };
    let inside = 6.0 / (2.6 * 2.6) * ((1.0 - 1.0 / 2.6) + 2.0 * (1.0 - 2.0 / 2.6));
    assert_eq!(lattice::neighbours_bar(2.6, VolumeRule::Linear), 6);
    assert!((lattice::bar_modulus(conical) - inside).abs() < 1e-15);
}

#[test]
fn stability_ends_where_the_highest_frequency_says() {
    for lattice in [CONSTANT, NARROW, Lattice { rule: VolumeRule::Full, m: 2.0, ..CONSTANT }] {
        let limit = 2.0 / lattice::bar_highest(lattice);
        let stable = |courant: f64| {
            (0..=1000)
                .all(|i| leapfrog::wave(lattice::bar(lattice, f64::from(i) * 3.1416e-3), courant).is_some())
        };
        assert!(stable(limit * (1.0 - 1e-9)) && !stable(limit * 1.001), "{lattice:?}: {limit}");
        assert!(lattice::bar_row_sum(lattice) <= limit);
    }
}

#[test]
fn no_wave_of_the_plane_is_above_the_highest() {
    let families = [
        (1.0, VolumeRule::Linear),
        (3.0, VolumeRule::Full),
        (3.015, VolumeRule::ExactArea),
        (4.4, VolumeRule::Linear),
    ];
    for (m, rule) in families {
        for kernel in [Kernel::Constant, Kernel::Gaussian { p: 3.0 }] {
            let lattice = Lattice { kernel, m, rule, calibrated: true };
            let highest = lattice::plane_highest(lattice);
            let mut best = 0.0_f64;
            for i in 0..300 {
                let (x, y) = (f64::from(i) * 0.618_034 % 1.0, f64::from(i) * 0.754_878 % 1.0);
                let (x, y) = (std::f64::consts::PI * x, std::f64::consts::PI * y);
                let [p, s] = lattice::plane(lattice, x.hypot(y), y.atan2(x));
                best = best.max(p.omega).max(s.omega / 3.0_f64.sqrt());
            }
            assert!(best <= highest * (1.0 + 1e-12), "{lattice:?}: {best} above {highest}");
            assert!(best > 0.9 * highest, "{lattice:?}: nothing near {highest}, the best is {best}");
            assert!(lattice::plane_row_sum(lattice) <= 2.0 / highest, "{lattice:?}");
        }
    }
}

// With the four axis bonds only, ω² = a (1 − cos κ_x) for motion along x: largest 2a at the zone's edge.
#[test]
fn highest_frequencies_in_closed_form() {
    let nearest = Lattice { m: 1.0, rule: VolumeRule::Full, ..CONSTANT };
    let expected = (2.0 * 2.0 * 8.0 / std::f64::consts::PI).sqrt();
    assert!((lattice::plane_highest(nearest) / expected - 1.0).abs() < 1e-14);
    assert!((lattice::bar_highest(CONSTANT) - (28.0_f64 / 27.0).sqrt()).abs() < 1e-14);
}

#[test]
fn slopes_are_derivatives() {
    let step = 1e-4;
    let five_points = |omega: &dyn Fn(f64) -> f64, k: f64| {
        (8.0 * (omega(k + step) - omega(k - step)) - (omega(k + 2.0 * step) - omega(k - 2.0 * step)))
            / (12.0 * step)
    };
    for lattice in [CONSTANT, Lattice { calibrated: true, m: 2.7, rule: VolumeRule::ExactArea, ..NARROW }] {
        for k in [0.3, 1.1, 2.4] {
            let error = five_points(&|k| lattice::bar(lattice, k).omega, k) - lattice::bar(lattice, k).slope;
            assert!(error.abs() < 1e-10, "bar, {k}: {error:e}");
            for branch in [0, 1] {
                let plane = |k| lattice::plane(lattice, k, 0.4)[branch];
                let error = five_points(&|k| plane(k).omega, k) - plane(k).slope;
                assert!(error.abs() < 1e-10, "plane, {branch}, {k}: {error:e}");
                let grid = |k| finite_differences::plane(k, 0.4, Some(0.5))[branch].expect("stable");
                let error = five_points(&|k| grid(k).omega, k) - grid(k).slope;
                assert!(error.abs() < 1e-10, "differences, {branch}, {k}: {error:e}");
            }
        }
    }
}

#[test]
fn fine_lattices_approach_the_continuum() {
    let z = 4.0;
    let error = |m: f64| {
        let fine = Lattice {
            kernel: Kernel::Gaussian { p: 1.0 },
            m,
            rule: VolumeRule::ExactArea,
            calibrated: false,
        };
        let [p, s] = lattice::plane(fine, z / m, 0.2);
        let exact = |branch| continuum::plane(fine.kernel, branch, z).expect("within the range").omega;
        let bar =
            lattice::bar(fine, z / m).omega * m / continuum::bar(fine.kernel, z).expect("in range").omega;
        [p.omega * m / exact(Branch::P), s.omega * m / exact(Branch::S), bar].map(|ratio| (ratio - 1.0).abs())
    };
    for (coarse, fine) in error(5.0).into_iter().zip(error(20.0)) {
        assert!(fine < 2e-3 && fine < coarse / 6.0, "{coarse:e} to {fine:e}");
    }
}

#[test]
fn differences_along_the_axis_and_the_diagonal() {
    for k in [1e-6, 0.5, 2.0, 3.1] {
        let half = (k / 2.0_f64).sin();
        let [p, s] = finite_differences::plane(k, 0.0, None).map(|wave| wave.expect("exact in time"));
        assert!((p.omega / (2.0 * half) - 1.0).abs() < 1e-15 && (s.omega / (2.0 * half) - 1.0).abs() < 1e-15);
        assert!((finite_differences::bar(k, Some(1.0)).expect("stable").omega / k - 1.0).abs() < 1e-15);
        let q = k / 2.0_f64.sqrt();
        let (square, cross) = (16.0 / 3.0 * (q / 2.0).sin().powi(2), 2.0 / 3.0 * q.sin().powi(2));
        let [p, s] =
            finite_differences::plane(k, std::f64::consts::FRAC_PI_4, None).map(|wave| wave.expect("exact"));
        assert!((p.omega / (square + cross).sqrt() - 1.0).abs() < 1e-14, "{k}");
        assert!((s.omega / (3.0 * (square - cross)).sqrt() - 1.0).abs() < 1e-13, "{k}");
    }
}

#[test]
fn differences_lose_the_printed_share_and_their_stability() {
    let (k, courant) = (1e-3, 0.6);
    let share = |wave: Wave| (wave.omega / k - 1.0) / (k * k);
    let marched = finite_differences::bar(k, Some(courant)).expect("stable");
    assert!((share(finite_differences::bar(k, None).expect("exact")) + 1.0 / 24.0).abs() < 1e-8);
    assert!((share(marched) + (1.0 - courant * courant) / 24.0).abs() < 1e-8);
    let half_end = lattice::bar(CONSTANT, k);
    assert!(((half_end.omega / k - 1.0) / (9.0 * k * k) + (1.0 + 1.0 / 9.0) / 48.0).abs() < 1e-8);
    assert!(
        finite_differences::bar(3.0, Some(1.01)).is_none()
            && finite_differences::bar(0.1, Some(1.01)).is_some()
    );
    assert_eq!(finite_differences::plane(2.5, 0.0, Some(1.2)).map(|wave| wave.is_some()), [false, true]);
}
