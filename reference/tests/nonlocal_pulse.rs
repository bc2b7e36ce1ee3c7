//! The nonlocal pulse: does it begin as given, keep its mean, split like d'Alembert when long, and bound the lattices?

use pd_verify_reference::nonlocal_pulse::NonlocalPulse;
use pd_verify_reference::{Kernel, Lattice, VolumeRule, lattice};
use std::f64::consts::{PI, TAU};

#[test]
fn it_begins_as_given_and_ends_outside_its_reach() {
    let pulse = NonlocalPulse::new(Kernel::Constant, 2.0, 8.0).expect("within the continuum's range");
    for x in [0.0, 0.3, 1.7, 5.0] {
        let found = pulse.displacement(x, 0.0).expect("within reach");
        assert!((found - (-2.0 * x * x).exp()).abs() < 1e-14, "{x}");
    }
    assert!(pulse.displacement(5.0, 4.0).is_none());
}

#[test]
fn the_mean_displacement_is_kept() {
    let pulse =
        NonlocalPulse::new(Kernel::Gaussian { p: 2.0 }, 3.0, 30.0).expect("within the continuum's range");
    let area = |t: f64| -> f64 {
        (-2000..=2000).map(|n| pulse.displacement(f64::from(n) * 0.01, t).expect("within reach") * 0.01).sum()
    };
    assert!((area(0.0) - (PI / 3.0).sqrt()).abs() < 1e-12);
    assert!((area(7.0) - (PI / 3.0).sqrt()).abs() < 1e-12, "{}", area(7.0));
}

#[test]
fn long_pulses_split_in_two_halves() {
    let sharpness = 1e-4;
    let pulse = NonlocalPulse::new(Kernel::Constant, sharpness, 900.0).expect("within the continuum's range");
    let half = |x: f64| 0.5 * (-sharpness * x * x).exp();
    for (x, t) in [(0.0, 300.0), (300.0, 300.0), (-340.0, 300.0), (120.0, 200.0)] {
        let found = pulse.displacement(x, t).expect("within reach");
        assert!((found - half(x - t) - half(x + t)).abs() < 1e-3, "{x} {t} {found}");
    }
}

/// The same pulse on a periodic lattice, summed over its own waves.
fn on_lattice(kernel: Kernel, m: f64, sharpness: f64, x: f64, t: f64) -> f64 {
    let of = Lattice { kernel, m, rule: VolumeRule::Linear, calibrated: false };
    let period = 40.0;
    let step = TAU / period;
    let weight = |k: f64| step / PI * (PI / sharpness).sqrt() * (-k * k / (4.0 * sharpness)).exp();
    let wave = |n: usize| {
        let k = n as f64 * step;
        weight(k) * (k * x).cos() * (lattice::bar(of, k / m).omega * m * t).cos()
    };
    0.5 * weight(0.0) + (1..=160).map(wave).sum::<f64>()
}

#[test]
fn lattices_converge_to_it_at_second_order_in_one_over_m() {
    for kernel in [Kernel::Constant, Kernel::Gaussian { p: 2.0 }] {
        let pulse = NonlocalPulse::new(kernel, 3.0, 12.0).expect("within the continuum's range");
        let exact = pulse.displacement(2.5, 3.0).expect("within reach");
        let error = |m: f64| (on_lattice(kernel, m, 3.0, 2.5, 3.0) - exact).abs();
        let order = (error(20.0) / error(40.0)).log2();
        assert!((order - 2.0).abs() < 0.05, "{order}");
    }
}

#[test]
fn strain_is_the_slope_of_displacement() {
    let pulse = NonlocalPulse::new(Kernel::Conical, 2.0, 12.0).expect("within the continuum's range");
    for (x, t) in [(0.0, 0.0), (0.4, 0.0), (-1.1, 2.3), (3.0, 4.0)] {
        let at = |x: f64| pulse.displacement(x, t).expect("within reach");
        let slope = |h: f64| (at(x + h) - at(x - h)) / (2.0 * h);
        let found = (4.0 * slope(1e-3) - slope(2e-3)) / 3.0;
        assert!((found - pulse.strain(x, t).expect("within reach")).abs() < 1e-10, "{x} {t}");
    }
    let given = -4.0 * 0.4 * (-2.0_f64 * 0.16).exp();
    assert!((pulse.strain(0.4, 0.0).expect("within reach") - given).abs() < 1e-14);
    assert!(pulse.strain(12.0, 1.0).is_none());
}

#[test]
fn a_ring_repeats_the_pulse_of_the_infinite_bar() {
    let (sharpness, period) = (2.0, 30.0);
    let kernel = Kernel::Gaussian { p: 2.0 };
    let ring = NonlocalPulse::periodic(kernel, sharpness, period).expect("within the continuum's range");
    let one = NonlocalPulse::new(kernel, sharpness, 120.0).expect("within the continuum's range");
    for (x, t) in [(0.3, 0.0), (2.0, 4.0), (14.0, 13.0), (29.0, 20.0)] {
        let copies: f64 =
            (-2..=2).map(|n| one.displacement(x + f64::from(n) * period, t).expect("within reach")).sum();
        let found = ring.displacement(x, t).expect("a ring has no end");
        assert!((found - copies).abs() < 1e-13, "{x} {t}: {found} {copies}");
        assert!((ring.displacement(x + 5.0 * period, t).expect("no end") - found).abs() < 1e-12);
    }
}
