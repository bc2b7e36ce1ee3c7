//! Rest under body force and pure bending: against hand values, bonds summed directly, and derivatives of the fields.

use pd_verify_reference::bent_plate::{BentPlate, INTENDED};
use pd_verify_reference::{Kernel, Lattice, Medium, VolumeRule, forced_rest, lattice};
use std::f64::consts::PI;

/// The 20 nodes within √5 spacings, constant kernel, m = √5: (i, j, w/r²), w = 8/(πm³r); force per volume over C11 is
/// Σ (w/r²) r (r·Δu) over Δx².
fn family() -> Vec<(f64, f64, f64)> {
    let offsets = (-2..=2_i32).flat_map(|i| (-2..=2_i32).map(move |j| (i, j)));
    let weight = |square: f64| 8.0 / (PI * 5.0_f64.powf(1.5)) / square.powf(1.5);
    offsets
        .map(|(i, j)| (f64::from(i), f64::from(j)))
        .filter(|(i, j)| (1.0..=5.0).contains(&(i * i + j * j)))
        .map(|(i, j)| (i, j, weight(i * i + j * j)))
        .collect()
}

fn lattice_of_twenty() -> Lattice {
    Lattice { kernel: Kernel::Constant, m: 5.0_f64.sqrt(), rule: VolumeRule::Full, calibrated: false }
}

/// Force per volume over C11 on the node at x, y.
fn summed(u: impl Fn(f64, f64) -> [f64; 2], x: f64, y: f64, dx: f64) -> [f64; 2] {
    let here = u(x, y);
    family().iter().fold([0.0; 2], |sum, (i, j, weight)| {
        let there = u(x + i * dx, y + j * dx);
        let along = weight * (i * (there[0] - here[0]) + j * (there[1] - here[1])) / (dx * dx);
        [sum[0] + along * i, sum[1] + along * j]
    })
}

#[test]
fn bonds_of_a_lattice_are_held_by_the_force() {
    let (dx, k, phase) = (0.2, [3.1, -1.7], 0.4);
    let medium = Medium::Lattice { lattice: lattice_of_twenty(), spacing: dx };
    let a = [0.6, -1.1];
    let b = forced_rest::force_amplitude(&medium, k, a).expect("a lattice");
    for (x, y) in [(0.0, 0.0), (0.37, 1.9), (-2.2, 0.45)] {
        let shape = |x: f64, y: f64| libm::cos(k[0] * x + k[1] * y + phase);
        let inner = summed(|x, y| a.map(|a| a * shape(x, y)), x, y, dx);
        for part in 0..2 {
            assert!((inner[part] + b[part] * shape(x, y)).abs() < 1e-13, "at {x}, {y}");
        }
    }
}

#[test]
fn force_and_displacement_are_inverse() {
    let nonlocal = Medium::Nonlocal { kernel: Kernel::Conical, horizon: 0.7 };
    let media = [Medium::Local, nonlocal, Medium::Lattice { lattice: lattice_of_twenty(), spacing: 0.2 }];
    for medium in media {
        for k in [[1.0, 0.0], [-2.0, 5.0], [4.0, 4.0]] {
            let b = forced_rest::force_amplitude(&medium, k, [0.3, -0.8]).expect("in range");
            let [x, y] = forced_rest::displacement_amplitude(&medium, k, b).expect("stiff");
            assert!((x - 0.3).abs() + (y + 0.8).abs() < 2e-15, "{medium:?} {k:?}: {x}, {y}");
        }
        assert_eq!(forced_rest::displacement_amplitude(&medium, [0.0; 2], [1.0, 0.0]), None);
        let held = forced_rest::bar_force_amplitude(&medium, 2.0, 0.5).expect("in range");
        let back = forced_rest::bar_displacement_amplitude(&medium, 2.0, held).expect("stiff");
        assert!((back - 0.5).abs() < 1e-15);
        assert_eq!(forced_rest::bar_displacement_amplitude(&medium, 0.0, 1.0), None);
    }
    // Four axis bonds do not resist a wave of shear along x.
    let axes = Lattice { m: 1.0, ..lattice_of_twenty() };
    let limp = Medium::Lattice { lattice: axes, spacing: 1.0 };
    assert_eq!(forced_rest::displacement_amplitude(&limp, [0.5, 0.0], [0.0, 1.0]), None);
}

#[test]
fn local_forces_by_hand() {
    assert_eq!(forced_rest::force_amplitude(&Medium::Local, [2.0, 0.0], [1.0, 0.0]), Some([4.0, 0.0]));
    let shear = forced_rest::displacement_amplitude(&Medium::Local, [0.0, 2.0], [1.0, 0.0]).expect("stiff");
    assert!((shear[0] - 0.75).abs() < 1e-15 && shear[1].abs() < 1e-16);
    assert_eq!(forced_rest::bar_force_amplitude(&Medium::Local, 3.0, 2.0), Some(18.0));
    // Stretch along x pulls C11 on an edge across x and C11/3 on one across y; u = −sin at φ = π/2.
    assert_eq!(forced_rest::traction_amplitude([2.0, 0.0], [1.0, 0.0], [1.0, 0.0]), [-2.0, 0.0]);
    assert_eq!(forced_rest::traction_amplitude([3.0, 0.0], [1.0, 0.0], [0.0, 1.0]), [0.0, -1.0]);
    assert_eq!(forced_rest::traction_amplitude([0.0, 3.0], [1.0, 0.0], [0.0, -1.0]), [1.0, 0.0]);
    assert_eq!(forced_rest::bar_stress_amplitude(3.0, 2.0), -6.0);
}

// What leaves through the edges of a square is what the body force puts in: ∮ t ds + ∫ b dA = 0, Simpson's rule.
#[test]
fn tractions_balance_the_body_force() {
    let (k, a, phase) = ([1.3, 0.8], [0.5, -0.9], 0.2);
    let b = forced_rest::force_amplitude(&Medium::Local, k, a).expect("any k");
    let at = |x: f64, y: f64| k[0] * x + k[1] * y + phase;
    let steps = 400;
    let h = 1.0 / f64::from(steps);
    let nodes: Vec<(f64, f64)> = (0..=steps)
        .map(|i| {
            (
                f64::from(i) * h,
                if i == 0 || i == steps { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) } * h / 3.0,
            )
        })
        .collect();
    for (part, b) in b.iter().enumerate() {
        let traction = |normal: [f64; 2]| forced_rest::traction_amplitude(k, a, normal)[part];
        let edges: f64 = nodes
            .iter()
            .map(|(s, weight)| {
                let along_x = traction([0.0, 1.0]) * libm::sin(at(*s, 1.0))
                    + traction([0.0, -1.0]) * libm::sin(at(*s, 0.0));
                let along_y = traction([1.0, 0.0]) * libm::sin(at(1.0, *s))
                    + traction([-1.0, 0.0]) * libm::sin(at(0.0, *s));
                weight * (along_x + along_y)
            })
            .sum();
        let inside: f64 =
            nodes.iter().flat_map(|x| nodes.iter().map(move |y| x.1 * y.1 * libm::cos(at(x.0, y.0)))).sum();
        // Simpson's rule errs by (kh)⁴/180 = 1e-12.
        assert!((edges + b * inside).abs() < 1e-11, "{edges} and {inside}");
    }
}

#[test]
fn bonds_of_a_bent_lattice() {
    let (dx, moduli) = (0.1, lattice::plane_moduli(lattice_of_twenty()));
    for plate in
        [BentPlate::intended(0.3), BentPlate::of(0.3, moduli), BentPlate { curvature: -0.7, swelling: 0.9 }]
    {
        for (x, y) in [(0.0, 0.0), (1.3, -0.4), (-0.2, 2.0)] {
            let found = summed(|x, y| plate.displacement(x, y), x, y, dx);
            assert!(found[0].abs() < 1e-12, "at {x}, {y}: {found:?}");
            assert!((found[1] - plate.residual(moduli)).abs() < 1e-12, "at {x}, {y}: {found:?}");
        }
    }
    assert!(BentPlate::intended(0.3).residual(moduli).abs() > 1e-3, "this lattice is not the intended body");
    assert!(BentPlate::of(0.3, moduli).residual(moduli).abs() < 1e-16);
}

#[test]
fn stresses_are_those_of_the_strains() {
    let moduli = lattice::Moduli { c11: 1.2, c12: 0.9, c66: 0.8 };
    let plate = BentPlate { curvature: 0.4, swelling: 0.25 };
    let (x, y, h) = (0.7, -0.6, 0.125);
    let slope = |f: &dyn Fn(f64) -> f64| (f(h) - f(-h)) / (2.0 * h);
    let along_x = slope(&|s| plate.displacement(x + s, y)[0]);
    let along_y = slope(&|s| plate.displacement(x, y + s)[1]);
    let shear = slope(&|s| plate.displacement(x, y + s)[0]) + slope(&|s| plate.displacement(x + s, y)[1]);
    let expected = [1.2 * along_x + 0.3 * along_y, 0.3 * along_x + 1.2 * along_y];
    let found = plate.stress(moduli, y);
    assert!((found[0] - expected[0]).abs() + (found[1] - expected[1]).abs() + shear.abs() < 1e-15);
    let [xx, yy] = BentPlate::intended(2.0).stress(INTENDED, 1.5);
    assert!((xx + 8.0 / 3.0).abs() < 1e-15 && yy == 0.0);
}
