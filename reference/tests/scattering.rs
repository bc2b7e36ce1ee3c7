//! Are the echoes of joints right? Against printed values, a limit in closed form and reciprocity.

use pd_verify_reference::scattering::{Half, pulse_reflection, reflection};
use pd_verify_reference::{Kernel, Lattice, VolumeRule, oracles};

const LINEAR: Lattice =
    Lattice { kernel: Kernel::Constant, m: 3.0, rule: VolumeRule::Linear, calibrated: false };

fn of_differences(k_dx: f64) -> f64 {
    2.0 * (k_dx / 2.0).sin()
}

#[test]
fn printed_reflections() {
    let rows = oracles::published("reflection_fd_lattice");
    assert_eq!(rows.len(), 3);
    for row in rows {
        let omega = of_differences(row.argument.expect("a wave number"));
        let found = reflection(Half::Fd, Half::Pd(LINEAR), omega).expect("one wave comes in");
        assert!((found - row.value).abs() <= row.half_unit, "{found} against {row:?}");
    }
}

#[test]
fn everything_returns_above_the_lattices_highest_frequency() {
    let limit = oracles::published("total_reflection_omega")[0].value;
    let right = Half::Pd(LINEAR);
    let above = reflection(Half::Fd, right, limit + 1e-3).expect("one wave comes in");
    assert!((above - 1.0).abs() < 1e-9, "{above}");
    assert!(reflection(Half::Fd, right, limit - 1e-3).expect("one wave comes in") < 0.95);
}

#[test]
fn nothing_returns_where_there_is_no_joint() {
    for half in [
        Half::Fd,
        Half::Pd(LINEAR),
        Half::Pd(Lattice { calibrated: true, kernel: Kernel::Conical, ..LINEAR }),
    ] {
        assert!(reflection(half, half, 0.5).expect("one wave comes in") < 1e-7);
        assert_eq!(pulse_reflection(half, half, 7.5e4, 1e-3, 0.5), 0.0);
    }
}

// Both sides have the same long-wave speed; what is left at long waves is k²/12 for this pair.
#[test]
fn long_waves_hardly_return_and_the_direction_does_not_matter() {
    let (fd, pd) = (Half::Fd, Half::Pd(LINEAR));
    let small = reflection(fd, pd, 0.02).expect("one wave comes in");
    assert!((small / (0.02_f64.powi(2) / 12.0) - 1.0).abs() < 1e-3, "{small:e}");
    for omega in [0.3, 0.7, 0.95] {
        let (one, other) = (reflection(fd, pd, omega), reflection(pd, fd, omega));
        let error = one.expect("one wave comes in") - other.expect("one wave comes in");
        assert!(error.abs() < 1e-7, "{omega}: {error:e}");
    }
}

// Full volumes make the lattice faster by √(4/3): an impedance jump of 2/√3 to 1 for long waves.
#[test]
fn a_stiffer_lattice_reflects_long_waves_by_its_impedance() {
    let full = Half::Pd(Lattice { rule: VolumeRule::Full, ..LINEAR });
    let ratio = (4.0_f64 / 3.0).sqrt();
    let found = reflection(Half::Fd, full, 0.01).expect("one wave comes in");
    assert!((found - (ratio - 1.0) / (ratio + 1.0)).abs() < 1e-4, "{found}");
}

#[test]
fn there_must_be_one_wave_coming_in() {
    assert_eq!(reflection(Half::Fd, Half::Pd(LINEAR), 2.1), None);
    assert_eq!(reflection(Half::Fd, Half::Pd(LINEAR), 0.0), None);
    let several = Half::Pd(Lattice { rule: VolumeRule::Full, ..LINEAR });
    assert_eq!(reflection(several, Half::Fd, 1.0), None, "two waves of the full lattice have this frequency");
}

// The printed pulse (7.5e4) returns 1.5 %, not the printed 12 %, which takes a pulse about 2.5e5 sharp.
#[test]
fn pulses_of_the_published_example() {
    let echo =
        |sharpness: f64, courant: f64| pulse_reflection(Half::Fd, Half::Pd(LINEAR), sharpness, 1e-3, courant);
    for courant in [0.1, 0.5] {
        assert!((0.0145..0.0160).contains(&echo(7.5e4, courant)), "{}", echo(7.5e4, courant));
        assert!((0.12..0.14).contains(&echo(2.5e5, courant)), "{}", echo(2.5e5, courant));
    }
}

// A pulse echoes by the harmonic |R| of its wave numbers: the long one much less than the short one.
#[test]
fn a_long_pulse_echoes_by_the_impedance() {
    let full = Half::Pd(Lattice { rule: VolumeRule::Full, ..LINEAR });
    let ratio = (4.0_f64 / 3.0).sqrt();
    let found = pulse_reflection(Half::Fd, full, 500.0, 1e-3, 0.5);
    assert!((found - (ratio - 1.0) / (ratio + 1.0)).abs() < 1e-3, "{found}");
}
