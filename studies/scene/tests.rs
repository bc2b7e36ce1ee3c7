//! Every effect is known by its name, and every claim of a march is lost to some fault.

use super::effects::{EFFECTS, names};
use crate::question::Profile;
use crate::run;
use crate::study::Study;
use crate::subject::{PdVerify, Subject};
use pd_verify::record::{self, Diverged, Failure, Record};
use pd_verify::scene::{Operator, Scene};
use pd_verify::verdict::Verdict;
use std::collections::BTreeMap;

const HEAD: &str = r#"format = 1
id = "mine"
kind = "scene"
title = "Steel"
[material]
youngs_modulus_gpa = 200
density_kg_m3 = 7850
"#;

/// A free bar, pulled.
const BAR: &str = r#"
[[case]]
id = "free"
asks = "march"
body = "bar"
size_m = 1
dx_mm = 20
section_m2 = 1e-6
duration_us = 200
lattice = { kernel = "constant", m = 3, volume_rule = "linear", calibrated = true }
[[case.effect]]
acts = "traction"
edge = "right"
axis = "x"
stress_mpa = 1
history = { shape = "step" }
[[case.probe]]
name = "p"
watches = "momentum"
[[case.expect]]
probe = "p"
quantity = "momentum_x"
at_us = 100
value = 1e-4
tolerance = 1e-9
basis = "theory"
because = "a pressure of 1 MPa pushes 1e-6 m² for 1e-4 s"
"#;

/// A plate on which every effect acts.
const ALL: &str = r#"
[[case]]
id = "all"
asks = "march"
body = "plane_stress"
size_m = [0.1, 0.05]
dx_mm = 5
duration_us = 20
notch = [{ from_m = [0, 0.025], to_m = [0.03, 0.025] }]
lattice = { kernel = "constant", m = 3, volume_rule = "linear" }
[[case.effect]]
acts = "face_traction"
normal_mpa = 1
history = { shape = "step" }
[[case.effect]]
acts = "traction"
edge = "right"
axis = "x"
stress_mpa = 1
history = { shape = "step" }
[[case.effect]]
acts = "body_force"
axis = "y"
density_n_m3 = 1e5
history = { shape = "step" }
[[case.effect]]
acts = "prescribed_motion"
region = { edge = "left" }
axis = "x"
displacement_m = 0
history = { shape = "step" }
[[case.effect]]
acts = "damping"
rate_per_s = 1e3
[[case.probe]]
name = "p"
watches = "energies"
"#;

fn study(case: &str) -> Study {
    Study::read("mine.toml", &format!("{HEAD}{case}"), &[]).unwrap().0
}

#[test]
fn a_plan_knows_every_effect_by_the_name_of_its_word() {
    for effect in EFFECTS {
        assert!(ALL.contains(&format!("acts = \"{}\"", effect.word)), "add {} to this scene", effect.word);
    }
    let plan = |case| study(case).cases[0].question.scenes().remove(0).beside(names());
    let (all, bar) = (plan(ALL), plan(BAR));
    for name in names() {
        assert!(all.effects_on.contains(&name) && !all.effects_off.contains(&name), "{name}: {all:?}");
        assert_eq!(bar.effects_off.contains(&name), name != "traction", "{name}: {bar:?}");
    }
}

/// What is done to the record of a scene.
type Fault = fn(&Scene<1>, &mut Record);

/// The library with its records falsified.
struct Falsified(Fault);

impl Subject for Falsified {
    fn march_bar(&self, scene: &Scene<1>) -> Result<Record, Failure> {
        let mut record = record::run(scene)?;
        (self.0)(scene, &mut record);
        Ok(record)
    }
}

/// Multiplies what is seen of a quantity, from the second look on.
fn scale(record: &mut Record, quantity: &str, factor: f64) {
    for trace in &mut record.traces {
        let columns: Vec<bool> = trace.columns.iter().map(|column| column.quantity == quantity).collect();
        for row in trace.rows.iter_mut().skip(1) {
            row.iter_mut().zip(&columns).filter(|(_, is)| **is).for_each(|(value, _)| *value *= factor);
        }
    }
}

fn verdicts(subject: &dyn Subject) -> BTreeMap<String, Verdict> {
    let judged = run::judged(&study(BAR), Profile::Full, subject);
    judged.into_iter().map(|one| (one.claim.id.rsplit('/').next().unwrap().to_owned(), one.verdict)).collect()
}

#[test]
fn every_claim_of_a_march_is_lost_to_some_fault() {
    let sound = verdicts(&PdVerify);
    assert_eq!(sound.len(), 5, "{sound:?}");
    assert!(sound.values().all(|verdict| *verdict == Verdict::Pass), "{sound:?}");
    let faults: [(&str, Fault); 5] = [
        ("finite", |_, record| scale(record, "momentum_x", f64::NAN)),
        ("energy_balance", |_, record| scale(record, "kinetic", 1.0 + 1e-7)),
        ("operators_agree", |scene, record| {
            if scene.operator == Operator::Bonds {
                scale(record, "displacement_x", 1.0 + 1e-7);
            }
        }),
        ("momentum", |_, record| scale(record, "momentum_x", 1.0 + 1e-7)),
        ("expect_1", |_, record| scale(record, "momentum_x", 1.0 + 1e-4)),
    ];
    for (claim, fault) in faults {
        let found = verdicts(&Falsified(fault));
        assert_ne!(found[claim], Verdict::Pass, "{claim} does not notice its fault: {found:?}");
    }
}

#[test]
fn what_finite_rotations_lose_is_said_with_its_cure() {
    let turned = study(&BAR.replace("lattice =", "rotations = \"finite\"\nlattice ="));
    let drifting = Falsified(|_, record| scale(record, "kinetic", 1.5));
    let judged = run::judged(&turned, Profile::Full, &drifting);
    let energy = judged.iter().find(|one| one.claim.id.ends_with("energy_balance")).unwrap();
    assert_eq!(energy.verdict, Verdict::Fail);
    assert!(energy.evidence.note.contains("take a smaller Δt"), "{}", energy.evidence.note);
    let grown = |scene: &Scene<1>| {
        let record = record::run(scene).unwrap();
        let (sound_step, own_limit, sound) = (None, None, None);
        Failure::Diverged(Box::new(Diverged { step: 1, time: 1.0, sound_step, own_limit, sound, record }))
    };
    let said = |case: &str| {
        let judged = run::judged(&study(case), Profile::Full, &Growing(grown));
        judged[0].evidence.failed.clone().unwrap()
    };
    assert!(!said(BAR).contains("tension"), "{}", said(BAR));
    let turned = BAR.replace("lattice =", "rotations = \"finite\"\nlattice =");
    assert!(said(&turned).contains("tension lowers"), "{}", said(&turned));
}

/// The library where every march fails.
struct Growing(fn(&Scene<1>) -> Failure);

impl Subject for Growing {
    fn march_bar(&self, scene: &Scene<1>) -> Result<Record, Failure> {
        Err((self.0)(scene))
    }
}

#[test]
fn claims_give_their_reasons() {
    for case in [BAR, ALL] {
        for claim in study(case).cases[0].claims() {
            assert!(claim.because.len() > 15 && claim.source.len() > 10, "{}", claim.id);
            assert!(claim.tolerance.is_finite() && claim.tolerance >= 0.0, "{}", claim.id);
        }
    }
}
