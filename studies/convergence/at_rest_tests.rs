//! Plates at rest: every claim of patch tests, of surface effects and of grids holds for the library and is lost to a fault.

use crate::question::Profile;
use crate::run::judged;
use crate::study::Study;
use crate::subject::{PdVerify, Subject};
use pd_verify::forces::BodyForce;
use pd_verify::forces::surface::Correction;
use pd_verify::scene::{Axis, HistoryAsked, Initial, Operator, Scene, Shape};
use pd_verify::verdict::Verdict;
use std::collections::BTreeMap;
use std::sync::Arc;

const HEAD: &str = r#"format = 1
id = "mine"
kind = "convergence"
title = "Steel"
[material]
youngs_modulus_gpa = 200
density_kg_m3 = 7850
[[case]]
id = "case"
title = "Case"
body = "plane_stress"
side_m = 1
"#;

/// An answer, changed.
type Seen = fn(&Scene<2>, Vec<[f64; 2]>) -> Vec<[f64; 2]>;

/// Another scene than the one asked for, and something else seen of it.
struct Faulty(fn(&mut Scene<2>), Seen);

impl Faulty {
    fn changed(&self, scene: &Scene<2>) -> Scene<2> {
        let mut other = scene.clone();
        (self.0)(&mut other);
        other
    }
}

impl Subject for Faulty {
    fn rest_plate(&self, scene: &Scene<2>) -> Result<Vec<[f64; 2]>, String> {
        Ok((self.1)(scene, PdVerify.rest_plate(&self.changed(scene))?))
    }

    fn bond_force_plate(&self, scene: &Scene<2>) -> Result<Vec<[f64; 2]>, String> {
        PdVerify.bond_force_plate(&self.changed(scene))
    }
}

fn as_it_is(_: &Scene<2>, seen: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    seen
}

/// Every node's displacement is that of the node to its right.
fn one_node_aside(scene: &Scene<2>, seen: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let columns = scene.nodes[0];
    (0..seen.len()).map(|n| seen[if (n + 1) % columns == 0 { n } else { n + 1 }]).collect()
}

fn heavy(scene: &mut Scene<2>) {
    let gravity =
        BodyForce { axis: Axis::Y, density_n_m3: 7.7e4, region: None, history: HistoryAsked::step() };
    scene.effects.push(Arc::new(gravity));
}

/// A cubic term beside a field: no lattice is without force in it.
fn cubic(scene: &mut Scene<2>) {
    let Shape::Monomial { about, .. } = scene.displacement[0].shape else { return };
    let shape = Shape::Monomial { about, powers: [3, 0] };
    scene.displacement.push(Initial { component: 0, amplitude: 1e-9, shape });
}

/// What is added falls with the root of the spacing.
fn growing(scene: &Scene<2>, seen: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let more = 1.0 + scene.spacing.sqrt();
    seen.into_iter().map(|u| u.map(|u| more * u)).collect()
}

/// A modulus that is wrong on fine grids alone.
fn soft_when_fine(scene: &mut Scene<2>) {
    if scene.nodes[0] > 64 {
        scene.material.youngs_modulus *= 0.9;
    }
}

fn verdicts(case: &str, subject: &dyn Subject) -> BTreeMap<String, Verdict> {
    let study = Study::read("mine.toml", &format!("{HEAD}{case}"), &[]).unwrap().0;
    let judged = judged(&study, Profile::Full, subject);
    let name = |id: &str| id.rsplit('/').next().unwrap_or_default().to_owned();
    judged.into_iter().map(|judged| (name(&judged.claim.id), judged.verdict)).collect()
}

/// All claims pass; the fault fails those named, at least.
fn loses(case: &str, fault: &Faulty, lost: &[&str]) {
    let found = verdicts(case, fault);
    for name in lost {
        assert_eq!(found[*name], Verdict::Fail, "{name}: {found:?}");
    }
}

fn passes(case: &str, claims: &[&str]) {
    let found = verdicts(case, &PdVerify);
    assert!(found.values().all(|verdict| *verdict == Verdict::Pass), "{found:?}");
    assert_eq!(found.keys().map(String::as_str).collect::<Vec<_>>(), claims);
}

fn refusal(case: &str) -> String {
    match Study::read("mine.toml", &format!("{HEAD}{case}"), &[]) {
        Ok(_) => "nothing is refused".into(),
        Err(refusal) => refusal.to_string(),
    }
}

const STRAIN: &str = r#"
asks = "patch"
field = "strain"
path = { refine = "delta", m = [2, 3], dx_m = [0.2, 0.1, 0.0625] }
weights = { kernel = "conical", volume_rule = ["full", "linear"], calibrated = [true, false] }
"#;

const BENDING: &str = r#"
asks = "patch"
field = "bending"
path = { refine = "delta", m = 2, dx_m = [0.0625, 0.03125, 0.015625] }
weights = { kernel = "constant", volume_rule = "linear", calibrated = [true, false] }
"#;

const SURFACE: &str = r#"
asks = "surface"
correction = ["none", "energy", "volume"]
path = { refine = "delta", m = 2, dx_m = [0.03125, 0.02, 0.0125, 0.01] }
weights = { kernel = "constant", volume_rule = "linear", calibrated = true }
"#;

const NOTCHED: &str = r#"
asks = "grid_convergence"
notch_m = 0.375
path = { refine = "delta", m = 2, dx_m = [0.0625, 0.03125, 0.015625, 0.0078125] }
weights = { kernel = "constant", volume_rule = "linear", calibrated = true }
"#;

const WHOLE: &str = r#"
asks = "grid_convergence"
path = { refine = "delta", m = 2, dx_m = [0.0625, 0.03125, 0.015625, 0.0078125] }
weights = { kernel = "constant", volume_rule = "linear", calibrated = true }
"#;

#[test]
fn every_lattice_keeps_uniform_strain() {
    passes(STRAIN, &["force", "kept"]);
    loses(STRAIN, &Faulty(cubic, as_it_is), &["force"]);
    loses(STRAIN, &Faulty(heavy, as_it_is), &["kept"]);
}

#[test]
fn lattices_of_the_intended_moduli_keep_bending_and_no_others() {
    passes(BENDING, &["force", "kept", "stays"]);
    loses(BENDING, &Faulty(|scene| scene.lattice.calibrated = true, as_it_is), &["force"]);
    loses(BENDING, &Faulty(|scene| scene.lattice.calibrated = false, as_it_is), &["force", "kept"]);
    loses(BENDING, &Faulty(|_| (), one_node_aside), &["kept", "stays"]);
}

#[test]
fn free_edges_cost_an_order_and_their_corners_a_logarithm() {
    let all = [
        "corner_energy",
        "corner_none",
        "corner_volume",
        "order_l1_energy",
        "order_l1_none",
        "order_l1_volume",
        "order_l2_energy",
        "order_l2_none",
        "order_l2_volume",
    ];
    passes(SURFACE, &all);
    let soft: fn(&mut Scene<2>) = |scene| scene.material.youngs_modulus *= 0.9;
    loses(SURFACE, &Faulty(soft, as_it_is), &all);
    let mirrored = format!("top = \"mirror\"\n{}", SURFACE.replace(r#", "energy", "volume""#, ""));
    let orders = ["order_l1_none", "order_l2_none", "order_linf_none"];
    passes(&mirrored, &orders);
    loses(&mirrored, &Faulty(soft, as_it_is), &orders);
}

#[test]
fn grids_tell_of_a_notch_what_the_next_grid_shows() {
    let notched = [
        "band_elongation",
        "band_opening",
        "change_elongation",
        "change_opening",
        "operators",
        "order_elongation",
        "order_opening",
    ];
    passes(NOTCHED, &notched);
    loses(NOTCHED, &Faulty(soft_when_fine, as_it_is), &notched[..4]);
    loses(NOTCHED, &Faulty(|_| (), growing), &notched[5..]);
    loses(NOTCHED, &Faulty(|scene| scene.surface = Correction::Volume, as_it_is), &["order_opening"]);
    let forgotten = |scene: &mut Scene<2>| {
        if scene.operator == Operator::Bonds {
            scene.notches.clear();
        }
    };
    loses(NOTCHED, &Faulty(forgotten, as_it_is), &["operators"]);
}

#[test]
fn extrapolation_finds_the_exact_answer_of_the_whole_plate() {
    let whole = [
        "band_contraction",
        "band_elongation",
        "change_contraction",
        "change_elongation",
        "exact_contraction",
        "exact_elongation",
        "operators",
    ];
    passes(WHOLE, &whole);
    let stiff = |scene: &mut Scene<2>| scene.material.youngs_modulus *= 1.1;
    loses(WHOLE, &Faulty(stiff, as_it_is), &["exact_contraction", "exact_elongation"]);
}

#[test]
fn what_cannot_be_asked_is_refused() {
    for (case, said) in [
        (SURFACE.replace("true", "false"), "its moduli are not the intended ones"),
        (WHOLE.replace("true", "false"), "its moduli are not the intended ones"),
        (WHOLE.replace(", 0.0078125", ""), "three predict a fourth"),
        (NOTCHED.replace("0.375", "0.3"), "ends within a cell"),
        (NOTCHED.replace("0.375", "1.5"), "leaves nothing"),
        (
            BENDING
                .replace("m = 2, dx_m = [0.0625, 0.03125, 0.015625]", "m = [2, 4, 8], horizon_m = 0.5")
                .replace("\"delta\"", "\"m\""),
            "its moduli change along the path",
        ),
    ] {
        let found = refusal(&case);
        assert!(found.contains(said), "{found}");
    }
}
