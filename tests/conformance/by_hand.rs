//! Bodies of two nodes, small enough to be worked out by hand.

use crate::bodies::{constant, field, force, model, scene, still};
use pd_verify::material::{Body, Material};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::{Operator, Rotations, Scene};

/// Both laws by both operators.
fn both<const D: usize>(scene: Scene<D>) -> Vec<Scene<D>> {
    let of = |(rotations, operator)| Scene { rotations, operator, ..scene.clone() };
    let (small, finite) = (Rotations::Small, Rotations::Finite);
    let (stencil, bonds) = (Operator::Stencil, Operator::Bonds);
    [(small, stencil), (small, bonds), (finite, stencil), (finite, bonds)].map(of).to_vec()
}

/// m = 1, c = 2E/δ² per section: f = c V η/Δx = 2Eη/Δx² per volume, energy ½ V (2E/Δx²) η². With half the cell counted
/// (linear) or calibrated, half of that: a spring of stiffness EA/Δx. All numbers are powers of two: no rounding.
#[test]
fn a_bar_of_two_nodes() {
    let two = 2.0_f64;
    let material = Material { youngs_modulus: two.powi(36), density: 4096.0 };
    let own = |lattice| Scene { material, spacing: 0.5, section: 0.25, ..scene::<1>(lattice, [2]) };
    for (rule, calibrated, factor) in
        [(VolumeRule::Full, false, 2.0), (VolumeRule::Linear, false, 1.0), (VolumeRule::Full, true, 1.0)]
    {
        for scene in both(own(constant(1.0, rule, calibrated))) {
            let (model, eta) = (model(&scene), two.powi(-10));
            let u = field(&model, |[x]| [if x < 0.5 { 3.0 } else { 3.0 + eta }]);
            let f = force(&model, &u);
            let nodes = [0, 1].map(|n| f[model.grid.place([n])]);
            let weight = factor * two.powi(36) / 0.25;
            assert_eq!(nodes, [weight * eta, -weight * eta], "{:?} {:?}", scene.rotations, scene.operator);
            // Twice the root's own rounding in the elongation of the finite law, squared.
            let energy = 0.5 * 0.125 * weight * eta * eta;
            assert_eq!(model.energy(&still(&u)), energy);
        }
    }
}

/// Two nodes side by side in a plate: w = 8C₁₁/(3πm³M₂Δx²) with M₂ = 1/3. The second goes to where it stands a spacing
/// above the first: to the exact law nothing happened. Twice as high, it pulls the first upwards by wΔx.
#[test]
fn a_plate_of_two_nodes() {
    let m = 1.5;
    let own = scene::<2>(constant(m, VolumeRule::Full, false), [2, 1]);
    let dx = own.spacing;
    let modulus = own.material.youngs_modulus * Body::PlaneStress.stiffness_over_youngs_modulus();
    let weight = 8.0 * modulus / (std::f64::consts::PI * m.powi(3) * dx * dx);
    for scene in both(own) {
        let model = model(&scene);
        for height in [1.0, 2.0] {
            let u = field(&model, |[x, _]| if x < dx { [0.0, 0.0] } else { [-dx, height * dx] });
            let f = force(&model, &u);
            let (left, right) = (model.grid.place([0, 0]), model.grid.place([1, 0]));
            let y = model.grid.stride();
            let expected = match scene.rotations {
                // n·η = −Δx, along x.
                Rotations::Small => ([-weight * dx, 0.0], 0.5 * weight * dx * dx),
                Rotations::Finite => {
                    let longer = (height - 1.0) * dx;
                    ([0.0, weight * longer], 0.5 * weight * longer * longer)
                }
            };
            // A handful of roundings.
            let near = |a: f64, b: f64, scale: f64| (a - b).abs() <= 8.0 * f64::EPSILON * scale;
            for axis in 0..2 {
                assert!(near(f[left + axis * y], expected.0[axis], weight * dx), "{height} {axis}");
                assert_eq!(f[right + axis * y], -f[left + axis * y]);
            }
            let energy = model.energy(&still(&u)) / model.cell_volume;
            assert!(near(energy, expected.1, weight * dx * dx), "{energy:e} {:e}", expected.1);
        }
    }
}
