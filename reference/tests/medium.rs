//! What media set against waves: against hand values, direct integrals, the waves at angles, and limits.

use pd_verify_reference::medium::leapfrog_turn;
use pd_verify_reference::{Kernel, Lattice, Medium, VolumeRule, lattice};

const LINEAR: Lattice =
    Lattice { kernel: Kernel::Constant, m: 3.0, rule: VolumeRule::Linear, calibrated: false };

fn assert_close(found: &[f64], expected: &[f64], tolerance: f64) {
    let size = expected.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= tolerance * size, "{found:?} against {expected:?}");
    }
}

/// M e = ω² e and |e| = 1, as they are written.
fn assert_eigen([xx, xy, yy]: [f64; 3], (omega, e): (f64, [f64; 2])) {
    let size = xx.abs() + yy.abs();
    let rest = [xx * e[0] + xy * e[1], xy * e[0] + yy * e[1]];
    for (rest, e) in rest.iter().zip(e) {
        assert!((rest - omega * omega * e).abs() < 4e-15 * size);
    }
    assert!((e[0].hypot(e[1]) - 1.0).abs() < 1e-15);
}

#[test]
fn local_elasticity_by_hand() {
    assert_eq!(Medium::Local.bar_square(-3.0), Some(9.0));
    assert_close(&Medium::Local.plane_matrix([3.0, 4.0]).expect("any k"), &[43.0 / 3.0, 8.0, 19.0], 1e-15);
    let [p, s] = Medium::Local.plane_waves([3.0, 4.0]).expect("any k");
    assert!((p.0 - 5.0).abs() < 1e-15 && (s.0 - 5.0 / 3.0_f64.sqrt()).abs() < 1e-15);
    assert_close(&p.1, &[0.6, 0.8], 1e-15);
    let moduli = Medium::Moduli(lattice::Moduli { c11: 1.5, c12: 0.9, c66: 0.6 });
    assert_close(&moduli.plane_matrix([2.0, -1.0]).expect("any k"), &[6.2, -1.0, 2.3], 1e-15);
}

#[test]
fn nothing_moves_at_k_zero() {
    let nonlocal = Medium::Nonlocal { kernel: Kernel::Conical, horizon: 2.0 };
    let media = [Medium::Local, nonlocal, Medium::Lattice { lattice: LINEAR, spacing: 0.1 }];
    for medium in media {
        assert_eq!(medium.bar_square(0.0), Some(0.0));
        assert_eq!(medium.plane_matrix([0.0, 0.0]), Some([0.0; 3]));
        assert_eq!(medium.plane_waves([0.0, 0.0]), Some([(0.0, [1.0, 0.0]), (0.0, [0.0, 1.0])]));
    }
}

// m = √2, constant kernel: eight bonds with w = 8/(π m³ r), written out.
#[test]
fn eight_bonds_by_hand() {
    let m = 2.0_f64.sqrt();
    let lattice = Lattice { m, rule: VolumeRule::Full, ..LINEAR };
    let (spacing, k) = (0.3, [1.7, -0.6]);
    let weight = 8.0 / (std::f64::consts::PI * m.powi(3) * spacing * spacing);
    let [x, y] = k.map(|k| k * spacing);
    let diagonal = |angle: f64| (1.0 - angle.cos()) / m;
    let both = diagonal(x + y) + diagonal(x - y);
    let expected = [
        weight * (2.0 * (1.0 - x.cos()) + both),
        weight * (diagonal(x + y) - diagonal(x - y)),
        weight * (2.0 * (1.0 - y.cos()) + both),
    ];
    let medium = Medium::Lattice { lattice, spacing };
    assert_close(&medium.plane_matrix(k).expect("a lattice"), &expected, 1e-14);
    let bar = Medium::Lattice { lattice: Lattice { m: 1.0, ..lattice }, spacing };
    // m = 1: w = 1/(M₁ m² r) = 2 on each side.
    assert!(
        (bar.bar_square(1.7).expect("a lattice") - 4.0 * (1.0 - x.cos()) / spacing.powi(2)).abs() < 1e-13
    );
}

#[test]
fn lattices_carry_the_waves_known_by_angle() {
    for rule in [VolumeRule::Full, VolumeRule::Linear, VolumeRule::ExactArea] {
        for (calibrated, m, angle) in
            [(false, 3.0, 0.0), (true, 3.015, 0.4), (false, 4.3, 2.1), (true, 2.5, -1.0)]
        {
            let lattice = Lattice { kernel: Kernel::Gaussian { p: 1.0 }, m, rule, calibrated };
            let (spacing, k) = (0.02, 60.0);
            let medium = Medium::Lattice { lattice, spacing };
            let wave = [k * f64::cos(angle), k * f64::sin(angle)];
            let [p, s] = medium.plane_waves(wave).expect("stable");
            let expected = lattice::plane(lattice, k * spacing, angle);
            assert!((p.0 * spacing / expected[0].omega - 1.0).abs() < 1e-14, "{rule:?} {m}");
            assert!((s.0 * spacing * 3.0_f64.sqrt() / expected[1].omega - 1.0).abs() < 1e-14, "{rule:?} {m}");
            let matrix = medium.plane_matrix(wave).expect("a lattice");
            assert_eigen(matrix, p);
            assert_eigen(matrix, s);
            let bar = medium.bar_square(k).expect("a lattice").sqrt() * spacing;
            assert!((bar / lattice::bar(lattice, k * spacing).omega - 1.0).abs() < 1e-15);
        }
    }
}

// The next term of the expansion is m²κ²/12 relative, 1e-13 here.
#[test]
fn long_waves_of_a_lattice_feel_its_moduli() {
    let k = [3e-7, -2e-7];
    for rule in [VolumeRule::Full, VolumeRule::Linear, VolumeRule::ExactArea] {
        let lattice = Lattice { rule, ..LINEAR };
        let found = Medium::Lattice { lattice, spacing: 1.0 }.plane_matrix(k).expect("a lattice");
        let moduli = Medium::Moduli(lattice::plane_moduli(lattice));
        assert_close(&found, &moduli.plane_matrix(k).expect("any k"), 1e-12);
    }
}

/// ∫ c (ξ⊗ξ/|ξ|³)(1 − cos k·ξ) dA over c_d², W = 1: the trapezoidal rule around the circle and Simpson's along the radius.
fn disc_integral(horizon: f64, k: [f64; 2]) -> [f64; 3] {
    let (turns, steps) = (400, 400);
    let mut sum = [0.0; 3];
    for i in 0..turns {
        let (sine, cosine) = (std::f64::consts::TAU * i as f64 / turns as f64).sin_cos();
        for j in 0..=steps {
            let r = horizon * j as f64 / steps as f64;
            let simpson = if j == 0 || j == steps { 1.0 } else { 2.0 + 2.0 * (j % 2) as f64 };
            let versine = 1.0 - (r * (k[0] * cosine + k[1] * sine)).cos();
            let factor =
                simpson * versine * horizon / (3 * steps) as f64 * std::f64::consts::TAU / turns as f64;
            for (sum, share) in sum.iter_mut().zip([cosine * cosine, cosine * sine, sine * sine]) {
                *sum += factor * share;
            }
        }
    }
    // M_xx → kx² for long waves: ½ ∫ r² cos⁴θ dr dθ.
    let c11 = 0.5 * horizon.powi(3) / 3.0 * 3.0 * std::f64::consts::PI / 4.0;
    sum.map(|value| value / c11)
}

#[test]
fn the_nonlocal_plane_is_its_integral() {
    for (horizon, k) in [(1.0, [2.0, 1.0]), (0.5, [-7.0, 11.0]), (2.0, [0.0, 0.4])] {
        let medium = Medium::Nonlocal { kernel: Kernel::Constant, horizon };
        let found = medium.plane_matrix(k).expect("in range");
        // Simpson's rule errs by (k h)⁴/180, h = δ/400.
        assert_close(&found, &disc_integral(horizon, k), 1e-9);
        for wave in medium.plane_waves(k).expect("in range") {
            assert_eigen(found, wave);
        }
    }
}

#[test]
fn a_small_horizon_is_local_elasticity() {
    let (k, horizon) = ([30.0, -20.0], 1e-8);
    let medium = Medium::Nonlocal { kernel: Kernel::Parabolic, horizon };
    assert_close(
        &medium.plane_matrix(k).expect("in range"),
        &Medium::Local.plane_matrix(k).expect("any"),
        1e-13,
    );
    assert!((medium.bar_square(30.0).expect("in range") / 900.0 - 1.0).abs() < 1e-13);
    assert_eq!(medium.plane_matrix([1e11, 0.0]), None);
    assert_eq!(medium.bar_square(1e13), None);
    let singular = Lattice { m: 1.0, rule: VolumeRule::Full, calibrated: true, ..LINEAR };
    assert_eq!(Medium::Lattice { lattice: singular, spacing: 1.0 }.plane_matrix([1.0, 0.0]), None);
}

#[test]
fn steps_turn_by_twice_the_arc_sine() {
    assert_eq!(leapfrog_turn(2.0, 1.0), Some(std::f64::consts::PI));
    assert_eq!(leapfrog_turn(1.0, 1.0), Some(std::f64::consts::FRAC_PI_3));
    assert_eq!(leapfrog_turn(2.01, 1.0), None);
    assert_eq!(leapfrog_turn(f64::NAN, 1.0), None);
    assert!((leapfrog_turn(3e-5, 1e-3).expect("stable") / 3e-8 - 1.0).abs() < 1e-15);
}
