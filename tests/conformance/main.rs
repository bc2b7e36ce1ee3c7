//! One suite for every implementation of the bonds: both operators, both laws, bars and plates, many lattices and edges.
//! Each check is shown to fail on a force that is wrong in its own way.

mod bodies;
mod by_hand;
mod checks;
mod corrected;
mod costs;
mod double_loop;
mod face_loads;
mod fields;
mod holed;
mod motion;
mod neutral;
mod notched;
mod passes;
mod patches;
mod probes;
mod refused;
mod running;
mod snapshots;
mod vectors;
mod wrong;

use bodies::{cases, constant, force, model, places, scene};
use checks::{
    Checked, agreement, balance, gradient, objectivity, purity, rotation, same_bits, translation, within,
};
use pd_verify::constraints::Edge;
use pd_verify::forces::surface::Correction;
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::{Operator, Rotations, Scene};
use std::collections::BTreeMap;
use wrong::{Way, spoilt};

type Check<const D: usize> = fn(&Scene<D>, &Model<D>) -> Checked;

/// The checks of any dimension that a scene is fit for.
fn fit<const D: usize>(scene: &Scene<D>) -> Vec<(&'static str, Check<D>)> {
    let mut checks: Vec<(&'static str, Check<D>)> = vec![
        ("gradient", gradient),
        ("purity", purity),
        ("agreement", agrees_with_a_list),
        ("balance", balance),
        ("translation", translation),
    ];
    if !scene.edges.any() && scene.rotations == Rotations::Finite {
        checks.push(("rotation", rotation));
    }
    checks
}

/// The same body with every bond stored.
fn agrees_with_a_list<const D: usize>(scene: &Scene<D>, own: &Model<D>) -> Checked {
    agreement(scene, own, &model(&Scene { operator: Operator::Bonds, ..scene.clone() }))
}

fn conform<const D: usize>(cases: Vec<Scene<D>>) -> BTreeMap<&'static str, f64> {
    let mut worst = BTreeMap::new();
    assert!(cases.len() > 100);
    for scene in cases {
        let model = model(&scene);
        for (name, check) in fit(&scene) {
            let ratio =
                check(&scene, &model).unwrap_or_else(|wrong| panic!("{name}, {}: {wrong}", scene.name));
            let so_far = worst.entry(name).or_insert(0.0_f64);
            *so_far = so_far.max(ratio);
        }
    }
    worst
}

#[test]
fn every_bar_conforms() {
    eprintln!("error over bound: {:?}", conform(cases::<1>(&[1.0, 2.0, 3.0, 3.015, 5.0], [13])));
}

#[test]
fn every_plate_conforms() {
    eprintln!("error over bound: {:?}", conform(cases::<2>(&[2.0, 3.0, 3.015, 5.0], [9, 7])));
}

/// All four combinations of law and operator on a free body.
fn free<const D: usize>(lattice: pd_verify::lattice::Lattice, nodes: [usize; D]) -> Vec<Scene<D>> {
    let mut all = Vec::new();
    for rotations in [Rotations::Small, Rotations::Finite] {
        for operator in [Operator::Stencil, Operator::Bonds] {
            all.push(Scene { rotations, operator, ..scene(lattice, nodes) });
        }
    }
    all
}

#[test]
fn finite_rotations_are_objective() {
    for m in [2.0, 3.015, 5.0] {
        for scene in free(constant(m, VolumeRule::Linear, true), [9, 7]) {
            let checked = objectivity(&scene, &model(&scene));
            assert_eq!(checked.is_ok(), scene.rotations == Rotations::Finite, "{checked:?}");
        }
    }
}

/// The linearised law does not know large rotations; an infinitesimal one it feels only by rounding, below 1e-12 of the
/// displacements.
#[test]
fn small_rotations_are_small() {
    for plate in free(constant(3.0, VolumeRule::Full, false), [9, 7]) {
        if plate.rotations == Rotations::Small {
            let own = model(&plate);
            assert!(rotation(&plate, &own).unwrap_err().contains("turned by 0.01"));
            let u = bodies::field(&own, |x| [-1e-3 * x[1], 1e-3 * x[0]]);
            let f = force(&own, &u);
            let largest = places(&own.grid).iter().map(|&at| f[at].abs()).fold(0.0, f64::max);
            let bound = 1e-3 * 1e-12 * bodies::Sums::of(&plate, &own.grid, &u).largest_stiffness();
            within("force of an infinitesimal rotation", largest, bound).unwrap();
        }
    }
}

/// Near corrected edges a band of nodes is served by a list: the seam between it and the stencil must not show.
#[test]
fn corrected_edges_conform() {
    let mut worst = 0.0_f64;
    for surface in [Correction::Energy, Correction::Volume] {
        for rotations in [Rotations::Small, Rotations::Finite] {
            for m in [2.0, 3.015] {
                let plate = scene::<2>(constant(m, VolumeRule::Linear, false), [21, 19]);
                let plate = Scene { surface, rotations, ..plate };
                let own = model(&plate);
                assert!(own.forces().len() == 2, "a stencil and a band");
                for check in [gradient, balance, translation, purity, agrees_with_a_list] {
                    worst = worst.max(check(&plate, &own).unwrap());
                }
                let bar = scene::<1>(constant(m, VolumeRule::Linear, false), [31]);
                let mut bar = Scene { surface, rotations, ..bar };
                for edges in [[Edge::Free; 2], [Edge::MirrorOdd, Edge::Free]] {
                    bar.edges.0 = [edges];
                    for check in [gradient, purity, agrees_with_a_list] {
                        worst = worst.max(check(&bar, &model(&bar)).unwrap());
                    }
                }
                // Uncorrected, the same plate is another one.
                let plain = model(&Scene { surface: Correction::None, ..plate.clone() });
                agreement(&plate, &own, &plain).unwrap_err();
            }
        }
    }
    eprintln!("error over bound: {worst}");
}

/// What each wrong force must fail, beside what it may fail.
#[test]
fn each_check_fails_on_a_wrong_force() {
    let bar = free(constant(3.0, VolumeRule::Full, true), [13]);
    let plate = free(constant(3.0, VolumeRule::Linear, true), [9, 7]);
    let fails = |checked: Checked, of: &str| {
        let wrong = checked.expect_err(of);
        assert!(wrong.contains(of), "{of}: {wrong}");
    };
    for scene in &bar {
        fails(gradient(scene, &spoilt(scene, Way::Scaled)), "slope of the energy");
        fails(gradient(scene, &spoilt(scene, Way::OneSided)), "slope of the energy");
        fails(balance(scene, &spoilt(scene, Way::OneSided)), "sum of the forces");
        fails(translation(scene, &spoilt(scene, Way::Constant)), "translated");
        fails(purity(scene, &spoilt(scene, Way::Stale)), "same state");
        fails(agrees_with_a_list(scene, &spoilt(scene, Way::Scaled)), "two implementations");
    }
    for scene in &plate {
        fails(gradient(scene, &spoilt(scene, Way::Scaled)), "slope of the energy");
        fails(gradient(scene, &spoilt(scene, Way::OneSided)), "slope of the energy");
        fails(balance(scene, &spoilt(scene, Way::OneSided)), "sum of the forces");
        fails(balance(scene, &spoilt(scene, Way::Sideways)), "sum of the moments");
        fails(translation(scene, &spoilt(scene, Way::Constant)), "translated");
        fails(purity(scene, &spoilt(scene, Way::Stale)), "same state");
        fails(agrees_with_a_list(scene, &spoilt(scene, Way::Scaled)), "two implementations");
        if scene.rotations == Rotations::Finite {
            fails(rotation(scene, &spoilt(scene, Way::Linearised)), "turned");
            fails(objectivity(scene, &spoilt(scene, Way::Linearised)), "deformed and turned");
            fails(balance(scene, &spoilt(scene, Way::Linearised)), "sum of the moments");
        }
    }
    // A check that sees no number, or no slope, does not pass.
    within("not a number", f64::NAN, 1.0).unwrap_err();
    same_bits("zeros of either sign", &[0.0], &[-0.0]).unwrap_err();
    let soft = Scene {
        material: pd_verify::material::Material { youngs_modulus: 0.0, density: 1.0 },
        ..bar[0].clone()
    };
    gradient(&soft, &model(&soft)).unwrap_err();
}
