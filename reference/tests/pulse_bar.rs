//! The pulse in a bar: the wave equation, its ends, its energy, its echoes, and a series.

use pd_verify_reference::Kernel;
use pd_verify_reference::nonlocal_pulse::NonlocalPulse;
use pd_verify_reference::pulse_bar::PulseBar;
use std::f64::consts::PI;

const BAR: PulseBar = PulseBar { length: 1.3, speed: 5047.5, sharpness: 250.0, centre: 0.55 };

#[test]
fn it_begins_as_the_pulse_and_returns_after_four_lengths() {
    let period = 4.0 * BAR.length / BAR.speed;
    for x in [0.0, 0.2, 0.55, 0.61, 1.3] {
        let given = (-BAR.sharpness * (x - BAR.centre).powi(2)).exp();
        assert!((BAR.displacement_at(x, 0.0) - given).abs() <= BAR.tail() + 1e-15);
        assert!((BAR.displacement_at(x, 7.0 * period) - given).abs() < 1e-13);
        assert!((BAR.displacement_at(x, 0.5 * period) + given).abs() < 1e-13, "upside down half-way");
    }
    assert!(BAR.tail() < 1e-30);
}

#[test]
fn halves_travel_and_return_as_the_ends_say() {
    let at = |x: f64, way: f64| BAR.displacement_at(x, way / BAR.speed);
    assert!((at(0.85, 0.3) - 0.5).abs() < 1e-14 && (at(0.25, 0.3) - 0.5).abs() < 1e-14);
    // The left half comes back upside down from the held end, the right half upright from the free one.
    assert!((at(0.25, 0.8) + 0.5).abs() < 1e-14, "{}", at(0.25, 0.8));
    assert!((at(1.0, 1.05) - 0.5).abs() < 1e-13, "{}", at(1.0, 1.05));
    assert!((at(1.3, 0.75) - 1.0).abs() < 1e-14, "at the free end it is doubled");
}

#[test]
fn the_ends_and_the_slope_are_exact_even_where_the_pulse_is_wide() {
    let wide = PulseBar { sharpness: 0.7, ..BAR };
    for bar in [BAR, wide] {
        for t in [0.0, 1.1e-4, 7.3e-4, 2.9e-3] {
            assert!(bar.displacement_at(0.0, t).abs() < 1e-13);
            assert!(bar.strain_at(bar.length, t).abs() < 1e-12);
            for x in [0.3, 0.9] {
                let h = 1e-4;
                let slope =
                    |h: f64| (bar.displacement_at(x + h, t) - bar.displacement_at(x - h, t)) / (2.0 * h);
                let found = (4.0 * slope(h) - slope(2.0 * h)) / 3.0;
                assert!((found - bar.strain_at(x, t)).abs() < 1e-8, "{x} {t}");
            }
        }
    }
}

#[test]
fn it_is_the_series_of_its_modes() {
    let terms = 120;
    let wave = |n: usize| (2 * n + 1) as f64 * PI / (2.0 * BAR.length);
    // (2/L)∫ of the image sum against sin over the bar is the whole line's integral of the pulse.
    let amplitude = |n: usize| {
        let k = wave(n);
        2.0 / BAR.length
            * (PI / BAR.sharpness).sqrt()
            * (-k * k / (4.0 * BAR.sharpness)).exp()
            * (k * BAR.centre).sin()
    };
    for (x, t) in [(0.2, 0.0), (0.71, 3.3e-4), (1.28, 2.1e-3)] {
        let series: f64 =
            (0..terms).map(|n| amplitude(n) * (wave(n) * x).sin() * (wave(n) * BAR.speed * t).cos()).sum();
        assert!((series - BAR.displacement_at(x, t)).abs() < 1e-13, "{x} {t}");
    }
}

#[test]
fn nonlocal_bars_tend_to_it_as_the_horizon_shrinks() {
    // Four pulses on a ring of 4L: the bar's images.
    let (x, way) = (0.2, 1.9);
    let error = |horizon: f64| {
        let sharpness = BAR.sharpness * horizon * horizon;
        let ring = NonlocalPulse::periodic(Kernel::Constant, sharpness, 4.0 * BAR.length / horizon)
            .expect("within the continuum's range");
        let at = |s: f64| ring.displacement(s / horizon, way / horizon).expect("a ring has no end");
        let (c, l) = (BAR.centre, BAR.length);
        let bar = at(x - c) - at(x + c) - at(x - c - 2.0 * l) + at(x + c - 2.0 * l);
        (bar - BAR.displacement_at(x, way / BAR.speed)).abs()
    };
    let order = (error(0.004) / error(0.002)).log2();
    assert!((order - 2.0).abs() < 0.05, "{order}");
}
