//! Moduli and speeds of an elastic plane against closed forms and the equations they solve.

use pd_verify_reference::{Mode, Plane};

/// −0.9 to 0.49.
const RATIOS: [f64; 7] = [-0.9, -0.3, 0.0, 0.1, 0.25, 0.37, 0.49];

// Each formula is a handful of roundings; 8 of them is the tolerance.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

fn near(found: f64, expected: f64) -> bool {
    (found / expected - 1.0).abs() <= ROUNDING
}

#[test]
fn moduli_of_both_plane_states() {
    let (young, density) = (210e9, 8000.0);
    for ratio in RATIOS {
        let strain = Plane::plane_strain(young, ratio, density);
        assert!(near(strain.effective_modulus(), young / (1.0 - ratio * ratio)));
        assert!(near(strain.kolosov(), 3.0 - 4.0 * ratio));
        let bulk = (1.0 - ratio) / ((1.0 + ratio) * (1.0 - 2.0 * ratio));
        assert!(near(strain.dilatational_speed(), (young / density * bulk).sqrt()), "{ratio}");
        let stress = Plane::plane_stress(young, ratio, density);
        assert!(near(stress.effective_modulus(), young));
        assert!(near(stress.kolosov(), (3.0 - ratio) / (1.0 + ratio)));
        assert!(near(stress.dilatational_speed(), (young / (density * (1.0 - ratio * ratio))).sqrt()));
        for plane in [strain, stress] {
            assert!(near(plane.shear_speed(), (young / (2.0 * (1.0 + ratio) * density)).sqrt()));
            assert!(near(plane.effective_modulus(), 8.0 * plane.shear_modulus / (plane.kolosov() + 1.0)));
            assert_eq!(plane.wave_speed(Mode::One), plane.dilatational_speed());
            assert_eq!(plane.wave_speed(Mode::Two), plane.shear_speed());
        }
    }
}

#[test]
fn the_bodies_of_a_published_comparison() {
    let stress = Plane::plane_stress(210e9, 1.0 / 3.0, 8000.0);
    let strain = Plane::plane_strain(210e9, 0.3, 8000.0);
    assert_eq!((stress.dilatational_speed().round(), strain.dilatational_speed().round()), (5434.0, 5944.0));
    assert!((stress.poisson_ratio - 0.25).abs() < 1e-16);
}

// ν = 0: x² − 6x + 4 = 0 (a factor x − 2 apart); ν = ¼: 3x² − 12x + 8 = 0 (x − 4 apart).
#[test]
fn rayleigh_waves() {
    let square = |ratio: f64| {
        let plane = Plane { shear_modulus: 3.0, poisson_ratio: ratio, density: 2.0 };
        (plane.rayleigh_speed() / plane.shear_speed()).powi(2)
    };
    assert!((square(0.0) - (3.0 - 5.0_f64.sqrt())).abs() < 1e-15);
    assert!((square(0.25) - (2.0 - 2.0 / 3.0_f64.sqrt())).abs() < 1e-15);
    for ratio in RATIOS {
        let x = square(ratio);
        let k2 = (1.0 - 2.0 * ratio) / (2.0 - 2.0 * ratio);
        let value = |x: f64| (2.0 - x).powi(2) - 4.0 * ((1.0 - x) * (1.0 - k2 * x)).sqrt();
        // A handful of roundings of numbers of the size 4.
        assert!(value(x).abs() < 4e-15, "{ratio}: {:e}", value(x));
        assert!(value(0.99 * x) < 0.0 && value(1.01 * x) > 0.0);
    }
}

#[test]
fn no_speed_where_there_is_no_modulus() {
    let liquid = Plane { shear_modulus: 1.0, poisson_ratio: 0.5, density: 1.0 };
    assert!(liquid.dilatational_speed().is_nan());
}
