//! Scenes that diverge: given up early, with what was seen, since when it is growth, and a time step that holds.

use crate::support::{Place, rows};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use std::collections::BTreeMap;

const PLATE: &str = r#"format = 1
id = "my-plate"
kind = "scene"
title = "Glass"

[material]
youngs_modulus_gpa = 72
density_kg_m3 = 2440

[[case]]
id = "shaken"
asks = "march"
body = "plane_stress"
size_m = [0.02, 0.015]
dx_mm = 1
duration_ms = 1
time_step_us = 0.24
unstable = true
lattice = { kernel = "gaussian", p = 2, m = 3, volume_rule = "linear", calibrated = true }

[[case.initial]]
sets = "displacement"
shape = "gaussian"
amplitude = 1e-6
centre_mm = [7, 8]
width_mm = 2

[[case.probe]]
name = "corner"
watches = "point"
at_m = [0.0, 0.0]
every_steps = 1

[[case.snapshot]]
name = "field"
at_us = [0.6, 900]
"#;

fn number(row: &BTreeMap<String, String>, key: &str) -> f64 {
    row[key].parse().unwrap_or_else(|_| panic!("{key}: {row:?}"))
}

#[test]
fn a_march_that_diverges_is_given_up_with_what_was_seen_and_the_step_that_holds() {
    let place = Place::with_study(PLATE);
    let said = place.run(&["run", "study.toml"]).code(3);
    said.stdout(contains("grew without bound").and(contains("of the body's own")).and(contains("or less")));
    let diverged = rows(&place.read("reports/my-plate/diverged.csv"));
    assert_eq!((diverged.len(), diverged[0]["case"].as_str()), (1, "shaken"));
    let one = &diverged[0];
    let (sound, end) = (number(one, "sound_t_s"), number(one, "given_up_t_s"));
    assert!(0.0 < sound && sound < end && number(one, "given_up_step") <= 256.0, "{one:?}");
    assert!(number(one, "over_lattice_limit") > 1.0 && number(one, "over_own_limit") > 1.0, "{one:?}");
    // Every step until then was seen.
    let probes = rows(&place.read("reports/my-plate/probes.csv"));
    let last = probes.iter().map(|row| number(row, "t_s")).fold(0.0, f64::max);
    assert!((last / end - 1.0).abs() < 0.02, "{last} {end}");
    // Of snapshots those until then, and the body when it was sound last.
    let exists = |name: &str| place.path(&format!("reports/my-plate/shaken.{name}")).exists();
    assert!(exists("field.000.vti") && !exists("field.001.vti") && exists("last-sound.000.vti"));
    assert!(place.read("reports/my-plate/shaken.last-sound.pvd").contains(&one["sound_t_s"]));
    // With the step that is said to hold it goes on to the end.
    let calm = format!("time_step_s = {}\n", one["time_step_that_holds_s"]);
    let place = Place::with_study(PLATE.replace("time_step_us = 0.24\nunstable = true\n", &calm));
    place.run(&["run", "study.toml"]).code(0);
    assert!(!place.path("reports/my-plate/diverged.csv").exists());
    let reserved = PLATE.replace("name = \"field\"", "name = \"last-sound\"");
    Place::with_study(reserved).refuses(&["run", "study.toml"], &["last sound look", "another name"]);
}
