//! The released bar: do series, modes and d'Alembert agree, and do the lattices err by what was found elsewhere?

use pd_verify_reference::released_bar::{LatticeModes, ReleasedBar};
use pd_verify_reference::{Kernel, Lattice, VolumeRule};

/// E = 200 GPa, ρ = 7850 kg/m³, 200 N on 1 mm².
fn bar() -> ReleasedBar {
    ReleasedBar { length: 1.0, speed: (200e9_f64 / 7850.0).sqrt(), strain: 1e-3 }
}

#[test]
fn strain_steps_from_stretched_through_zero_to_compressed() {
    let bar = bar();
    let at = |t: f64| bar.strain_at(0.5, t * bar.length / bar.speed) / bar.strain;
    assert_eq!([0.1, 1.0, 2.0, 3.0, 4.0].map(at), [1.0, 0.0, -1.0, 0.0, 1.0]);
}

#[test]
fn strain_is_the_slope_of_displacement_and_both_obey_the_ends() {
    let bar = bar();
    for t in [0.0, 3.1e-5, 1.7e-4, 6.3e-4] {
        for x in [0.11, 0.47, 0.83] {
            let h = 1e-6;
            let slope = (bar.displacement_at(x + h, t) - bar.displacement_at(x - h, t)) / (2.0 * h);
            assert!((slope - bar.strain_at(x, t)).abs() < 1e-11, "{x} {t}");
        }
        assert!(bar.displacement_at(0.0, t).abs() < 1e-18);
        assert!(t == 0.0 || bar.strain_at(1.0 - 1e-9, t).abs() < 1e-12);
    }
}

#[test]
fn the_series_converge_to_dalembert_away_from_steps() {
    let bar = bar();
    for (x, t) in [(0.3, 5e-5), (0.5, 4e-4), (0.9, 7.2e-4)] {
        let strain = |terms| (bar.fourier_strain(x, t, terms) - bar.strain_at(x, t)).abs() / bar.strain;
        assert!(strain(20_000) < 2e-4, "{}", strain(20_000));
        for terms in [10, 100, 1000] {
            let rest = (bar.fourier_displacement(x, t, terms) - bar.displacement_at(x, t)).abs();
            assert!(rest <= 2.0 * bar.strain * bar.length / (std::f64::consts::PI.powi(2) * terms as f64));
        }
    }
}

/// Away from steps the two sums differ by the rounding of phases: 1e-16 of a phase in each of `terms` terms.
#[test]
fn the_sum_in_full_is_the_same_sum() {
    let bar = bar();
    for (x, t) in [(0.3, 5e-5), (0.5, 4e-4), (0.999, 0.0)] {
        for terms in [1, 10, 1000] {
            let (full, plain) = (bar.fourier_strain_in_full(x, t, terms), bar.fourier_strain(x, t, terms));
            assert!((full - plain).abs() <= 1e-15 * terms as f64 * bar.strain, "{full} {plain}");
        }
    }
    // One term by hand: (4/π) cos(πx/2L) at t = 0.
    let one = 4.0 / std::f64::consts::PI * (0.15 * std::f64::consts::PI).cos() * bar.strain;
    assert!((bar.fourier_strain_in_full(0.3, 0.0, 1) / one - 1.0).abs() < 1e-15);
}

#[test]
fn modes_begin_at_the_stretched_bar() {
    let of =
        Lattice { kernel: Kernel::Gaussian { p: 2.0 }, m: 5.0, rule: VolumeRule::Full, calibrated: true };
    let modes = LatticeModes::new(of, 80, None).expect("exact time is stable");
    for j in [0, 17, 79] {
        assert!((modes.displacement(j, 0.0) - (j as f64 + 0.5) / 80.0).abs() < 1e-13);
    }
    assert!((modes.strain(40, 0.0) - 1.0).abs() < 1e-12);
    assert!(LatticeModes::new(of, 80, Some(3.0)).is_none());
}

/// (1/T)∫|ε − ε_exact| dt/ε₀ at 0.5 m over 0.8 ms.
fn mean_error(of: Lattice, nodes: usize) -> f64 {
    let (bar, dx) = (bar(), 1.0 / nodes as f64);
    let modes = LatticeModes::new(of, nodes, None).expect("exact time is stable");
    let samples = 10 * nodes;
    let error = |n: usize| {
        let t = 0.8e-3 * (n as f64 + 0.5) / samples as f64;
        (modes.strain(nodes / 2, bar.speed * t / dx) - bar.strain_at(0.5, t) / bar.strain).abs()
    };
    (0..samples).map(error).sum::<f64>() / samples as f64
}

#[test]
fn mean_strain_errors_are_those_of_an_independent_march() {
    let lattice = |kernel, rule, calibrated| Lattice { kernel, m: 5.0, rule, calibrated };
    let (p2, p3) = (Kernel::Gaussian { p: 2.0 }, Kernel::Gaussian { p: 3.0 });
    let coarse = [
        (lattice(Kernel::Constant, VolumeRule::Full, false), 0.196, 0.001),
        (lattice(p2, VolumeRule::Linear, false), 0.068, 0.001),
        (lattice(p2, VolumeRule::Full, true), 0.0432, 0.0003),
        (lattice(p3, VolumeRule::Full, true), 0.0353, 0.0003),
    ];
    for (of, printed, allowance) in coarse {
        let found = mean_error(of, 800);
        assert!((found - printed).abs() <= allowance, "{of:?}: {found}");
    }
}

#[test]
fn refined_lattices_err_as_found_and_the_wrong_speed_sets_the_plateau() {
    let lattice = |kernel, calibrated| Lattice { kernel, m: 5.0, rule: VolumeRule::Full, calibrated };
    let fine = [
        (lattice(Kernel::Constant, false), 0.190, 0.001),
        (lattice(Kernel::Gaussian { p: 2.0 }, true), 0.0312, 0.0003),
        (lattice(Kernel::Gaussian { p: 3.0 }, true), 0.0256, 0.0003),
    ];
    for (of, printed, allowance) in fine {
        let found = mean_error(of, 1600);
        assert!((found - printed).abs() <= allowance, "{of:?}: {found}");
    }
    // Full volumes with the constant kernel travel √((m + 1)/m) too fast, however fine the lattice.
    let (bar, samples) = (bar(), 400_000);
    let fast = ReleasedBar { speed: bar.speed * 1.2_f64.sqrt(), ..bar };
    let error = |n: usize| {
        let t = 0.8e-3 * (n as f64 + 0.5) / samples as f64;
        (fast.strain_at(0.5, t) - bar.strain_at(0.5, t)).abs() / bar.strain
    };
    let plateau = (0..samples).map(error).sum::<f64>() / samples as f64;
    assert!((plateau - 0.173).abs() < 0.001, "{plateau}");
}
