//! `bench` and the times that `plan` takes from it: keys, counts, files, refusals.

use crate::support::{Place, small};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use serde_json::{Value, json};

/// One plate, measured in no time.
fn measured(more: &[&str]) -> Value {
    let place = Place::new();
    let arguments = [&["bench", "--nodes", "32", "--steps", "20", "--json"], more].concat();
    let said = place.run(&arguments).code(0).stderr("");
    assert!(place.contents().is_empty(), "one case is only printed");
    serde_json::from_slice(&said.get_output().stdout).unwrap()
}

#[test]
fn one_plate_has_every_number() {
    let json = measured(&["--threads", "2"]);
    let numbers = [
        "node_updates_per_s",
        "bond_updates_per_s",
        "gflop_per_s",
        "gbyte_per_s",
        "triad_gbyte_per_s",
        "fma_gflop_per_s",
        "of_limit",
    ];
    for key in numbers {
        assert!(json[key].as_f64().is_some_and(|number| number > 0.0), "{key}: {json}");
    }
    for (key, value) in [("threads", 2), ("nodes", 32), ("steps", 20), ("node_count", 1024)] {
        assert_eq!(json[key], value, "{key}");
    }
    assert_eq!((&json["operator"], &json["m"]), (&json!("stencil"), &json!(3.0)));
    assert!(["baseline", "avx2", "avx512"].contains(&json["isa"].as_str().unwrap()));
}

/// Every node of the plate has all its bonds: 18 pairs at m = 3, 10 at m = 2. A listed bond is seen from both ends, 11
/// operations each, and a node is moved by 6.
#[test]
fn rates_count_what_a_step_does() {
    let over_nodes =
        |json: &Value, key: &str| json[key].as_f64().unwrap() / json["node_updates_per_s"].as_f64().unwrap();
    for (m, pairs) in [("3", 18.0), ("2", 10.0)] {
        let json = measured(&["--operator", "bonds", "--m", m]);
        assert_eq!(json["operator"], "bonds");
        let [bonds, gflop] = ["bond_updates_per_s", "gflop_per_s"].map(|key| over_nodes(&json, key));
        assert!((bonds / pairs - 1.0).abs() < 1e-12, "{bonds}");
        assert!((1e9 * gflop / (22.0 * pairs + 6.0) - 1.0).abs() < 1e-12, "{gflop}");
    }
    // 24 + 5 operations on a node's own column, 24 + 16 + 8 on the others, 3 · 14 to gather, 6 to move, one saved.
    let gflop = over_nodes(&measured(&["--isa", "baseline"]), "gflop_per_s");
    assert!((1e9 * gflop / 124.0 - 1.0).abs() < 1e-12, "{gflop}");
}

#[test]
fn a_plate_in_words_names_its_limit() {
    let said = Place::new().run(&["bench", "--nodes", "16", "--steps", "4", "--threads", "1"]).code(0);
    said.stdout(
        contains("limits of 1 thread")
            .and(contains("16² nodes, stencil, m = 3"))
            .and(contains("% of the limit")),
    );
}

#[test]
fn plates_that_cannot_be_are_refused() {
    let place = Place::new();
    for (arguments, words) in [
        (vec!["--nodes", "0"], vec!["--nodes", "1..=16384"]),
        (vec!["--steps", "0"], vec!["--steps", "1.."]),
        (vec!["--threads", "0"], vec!["--threads", "1..=1024"]),
        (vec!["--operator", "sparse"], vec!["stencil, bonds"]),
        (vec!["--isa", "mmx"], vec!["baseline, avx2, avx512"]),
        (vec!["--m", "three"], vec!["--m"]),
        (vec!["--m", "0.5"], vec!["m = 0.5 is below 1", "take m >= 1"]),
        (vec!["--m", "-3"], vec!["m = -3 is below 1"]),
        (vec!["--m", "NaN"], vec!["m = NaN is below 1"]),
        (vec!["--m", "inf"], vec!["m = inf", "--m 200"]),
        (vec!["--nodes", "10", "--m", "11"], vec!["the horizon of 11 spacings", "10²", "--nodes"]),
        (vec!["--nodes", "2"], vec!["the horizon of 3 spacings"]),
    ] {
        place.refuses(&[&["bench"], &arguments[..]].concat(), &words);
    }
}

/// 2²⁸ nodes with 100 neighbours each, 24 bytes to a neighbour: more than half a terabyte.
#[cfg(target_os = "linux")]
#[test]
fn plates_beyond_the_memory_are_refused() {
    let huge = ["bench", "--nodes", "16384", "--m", "5", "--operator", "bonds"];
    Place::new().refuses(&huge, &["16384² nodes", "GB are free", "--operator stencil"]);
}

#[test]
fn the_suite_writes_nowhere_else() {
    let place = Place::new();
    place.write("reports/bench/thesis.tex", "years of work");
    place.refuses(&["bench"], &["reports/bench", "not a folder of results", "--out DIR"]);
    let place = Place::with_study(small().replace("id = \"mine\"", "id = \"bench\""));
    place.refuses(&["run", "study.toml"], &["the folder of a shipped command"]);
}

/// Ctrl-C while limits or cases are measured: 130, and nothing is written.
#[cfg(unix)]
#[test]
fn a_suite_that_is_interrupted_leaves_nothing() {
    use std::process::{Command, Stdio};
    let place = Place::new();
    let mut command = Command::new(env!("CARGO_BIN_EXE_pd-verify"));
    command.current_dir(place.path("")).arg("bench").stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().unwrap();
    // The folder is made when the program listens and before anything is measured.
    while !place.path("reports").exists() {
        assert!(child.try_wait().unwrap().is_none(), "ended before it could be interrupted");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let interrupted = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(interrupted.success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(place.contents().keys().all(|path| path.ends_with("reports")), "{:?}", place.contents().keys());
}

/// A bar of a hundred nodes, 300 bonds of it, whose plan says how many steps there are.
const BAR: &str = r#"format = 1
id = "mine"
kind = "scene"
title = "Steel"
material = { youngs_modulus_gpa = 200, density_kg_m3 = 7850 }
[[case]]
id = "ring"
asks = "march"
body = "bar"
size_m = 1
dx_mm = 10
duration_ms = 1
edges = { left = "periodic", right = "periodic" }
lattice = { kernel = "gaussian", p = 2, m = 3, volume_rule = "linear", calibrated = true }
[[case.initial]]
sets = "displacement"
shape = "wave"
wavenumber_per_m = [6.283185307179586]
amplitude = 1e-4
[[case.probe]]
name = "all"
watches = "momentum"
"#;

/// What a machine left on which a step takes 1 ms, and each node of a bar 10 µs.
fn left() -> Value {
    let bar = json!({
        "step_s": 1e-3, "whole_by_pairs": [[3.0, 1e-5]], "by_nodes": [[1000.0, 1.0]], "finite_pair_s": 0.0,
        "masked_end_s": 0.0, "listed_end_s": 0.0, "damped_node_s": 0.0, "loaded_place_s": 0.0, "booked_node_s": 0.0,
        "begin": [], "growth": [], "stop": [], "snapshot": [], "repeat": [], "patch_node_s": 0.0, "value_s": 0.0,
    });
    json!({ "isa": "avx2", "threads": 4, "cpu": "a machine", "costs": { "bar": bar, "plate": bar } })
}

#[test]
fn plan_predicts_from_what_bench_left() {
    let place = Place::with_study(BAR);
    let plan = |arguments: &[&str]| -> Value {
        let said = place.run(&[&["plan", "study.toml", "--json"], arguments].concat()).code(0);
        serde_json::from_slice(&said.get_output().stdout).unwrap()
    };
    let scene = |plan: &Value| plan["cases"][0]["scenes"][0].clone();
    assert!(plan(&[])["predicted_seconds"].is_null() && scene(&plan(&[]))["predicted_seconds"].is_null());
    place.run(&["plan", "study.toml"]).code(0).stdout(contains("unknown: run pd-verify bench"));
    place.write("measured/bench/bench.json", left().to_string());
    let predicted = plan(&["--out", "measured"]);
    let (seconds, steps) = (&scene(&predicted)["predicted_seconds"], scene(&predicted)["steps"].as_f64());
    let growth = scene(&predicted)["looks"]["growth"].as_f64().unwrap();
    // 1 ms and 100 nodes of 10 µs for every step, for the first forces, and for those of every look for growth.
    let expected = 2e-3 * (steps.unwrap() + 1.0 + growth);
    assert!((seconds.as_f64().unwrap() / expected - 1.0).abs() < 1e-12, "{seconds}, {expected}");
    let scenes = predicted["cases"][0]["scenes"].as_array().unwrap();
    let sum: f64 = scenes.iter().map(|scene| scene["predicted_seconds"].as_f64().unwrap()).sum();
    assert!(scenes.len() > 1 && (predicted["predicted_seconds"].as_f64().unwrap() / sum - 1.0).abs() < 1e-12);
    assert_eq!(predicted["predicted_with"]["threads"], 4);
    let said = place.run(&["plan", "study.toml", "--out", "measured"]).code(0);
    said.stdout(contains("as measured with avx2 on 4 threads of a machine"));
}

#[test]
fn plan_refuses_what_bench_did_not_leave() {
    let place = Place::with_study(BAR);
    for foreign in ["", "no JSON", "{\"isa\": \"avx2\"}"] {
        place.write("reports/bench/bench.json", foreign);
        place.refuses(&["plan", "study.toml"], &["reports/bench/bench.json", "pd-verify bench", "--out DIR"]);
    }
}
