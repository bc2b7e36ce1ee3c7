//! `plan` names what a scene calls for in vain, with its place and reason, in text and as data.

use crate::support::Place;
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use serde_json::{Value, json};

const BAR: &str = r#"format = 1
id = "mine"
kind = "scene"
title = "A bar"
material = { youngs_modulus_gpa = 200, density_kg_m3 = 7850 }
[[case]]
id = "pull"
asks = "march"
body = "bar"
size_m = 1.0
dx_mm = 10
duration_us = 100
lattice = { kernel = "constant", m = 3, volume_rule = "linear" }
effect = [
    { acts = "traction", edge = "left", axis = "x", stress_mpa = 0, history = { shape = "step" } },
    { acts = "traction", edge = "right", axis = "x", stress_mpa = 1, history = { shape = "step" } },
    { acts = "body_force", axis = "x", density_n_m3 = 1, history = { shape = "ramp", start_us = 110, rise_us = 1 } },
]
initial = [{ sets = "velocity", shape = "uniform", amplitude = 0 }]
probe = [{ name = "p", watches = "point", at_m = 0.5 }]
"#;

#[test]
fn what_does_nothing_is_named_and_what_does_something_is_not() {
    let place = Place::with_study(BAR);
    place.run(&["plan", "study.toml"]).code(0).stderr("").stdout(
        contains("avoidable:   effect[0] (traction: its stress is 0); effect[2] (body force")
            .and(contains("initial velocity: its amplitude is 0)"))
            .and(contains("effect[1]").not()),
    );
    let said = place.run(&["plan", "study.toml", "--json"]).code(0);
    let plan: Value = serde_json::from_slice(&said.get_output().stdout).unwrap();
    let named = plan["cases"][0]["scenes"][0]["avoidable"].as_array().unwrap();
    assert_eq!(named.len(), 3);
    let first = json!({ "key": "effect[0]", "effect": "traction", "because": "its stress is 0" });
    assert_eq!(named[0], first);
    // Earlier the ramp begins before the last step.
    let place = Place::with_study(
        BAR.replace("start_us = 110", "start_us = 95").replace("stress_mpa = 0", "stress_mpa = 2"),
    );
    place
        .run(&["plan", "study.toml"])
        .code(0)
        .stdout(contains("avoidable:   initial (initial velocity").and(contains("effect[").not()));
}
