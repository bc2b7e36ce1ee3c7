//! `cost`: tables of work and precision; `cost --advise`: what it finds, what it writes, what it refuses.

use crate::support::{Place, rows};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use serde_json::Value;

const ASKS: [&str; 6] = ["cost", "--advise", "--error", "0.01", "--wavelength", "0.02"];

fn asked(more: &[&str]) -> Value {
    let said = Place::new().run(&[&ASKS, more, &["--json"]].concat()).code(0).stderr("");
    serde_json::from_slice(&said.get_output().stdout).unwrap()
}

fn number(setting: &Value, key: &str) -> f64 {
    setting[key].as_f64().unwrap()
}

#[test]
fn ten_settings_a_box_and_the_winner_without_the_bound() {
    let place = Place::new();
    let said = place.run(&[&ASKS[..], &["--min-m", "3"]].concat()).code(0).stderr("");
    said.stdout(
        contains("972 lattices")
            .and(contains("Searched: constant, conical, parabolic, gaussian p = 1"))
            .and(contains("\n  10 "))
            .and(contains("\n  11 ").not())
            .and(contains("Without the bound: ")),
    );
    let table = place.read("reports/advice/advice.csv");
    assert!(table.starts_with("rank,kernel,p,m,volume_rule,calibrated,dx_m,horizon_m,dt_s,courant,pairs,"));
    assert!(table.lines().count() > 100);
    for file in ["advice.json", "advice_by_m.svg", "advice_by_m.csv", "manifest.json"] {
        assert!(!place.read(&format!("reports/advice/{file}")).is_empty(), "{file}");
    }
}

/// A plate is as fast as its material, and a wave twice as long asks for an eighth of the bond updates.
#[test]
fn costs_scale_with_speed_and_wavelength() {
    let cheapest = |json: Value| number(&json["settings"][0], "bond_updates_per_m2_s");
    let plain = cheapest(asked(&[]));
    assert!((cheapest(asked(&["--speed", "10708"])) / plain - 2.0).abs() < 1e-9);
    let long = ["cost", "--advise", "--error", "0.01", "--wavelength", "0.04", "--json"];
    let said = Place::new().run(&long).code(0);
    let long: Value = serde_json::from_slice(&said.get_output().stdout).unwrap();
    assert!((cheapest(long) / plain - 0.125).abs() < 1e-9);
}

#[test]
fn a_horizon_is_kept() {
    let json = asked(&["--horizon", "0.004"]);
    let settings = json["settings"].as_array().unwrap();
    assert!(!settings.is_empty());
    for setting in settings {
        assert!((number(setting, "horizon_m") / 0.004 - 1.0).abs() < 1e-12);
        assert!(number(setting, "error").abs() <= 0.01);
    }
    assert!(
        number(&json["unbound"], "bond_updates_per_m2_s") <= number(&settings[0], "bond_updates_per_m2_s")
    );
}

#[test]
fn nothing_found_is_no_success() {
    let said = Place::new().run(&[&ASKS[..], &["--horizon", "1"]].concat());
    said.code(1).stdout(contains("None does what is asked.").and(contains("Without the bound: ")));
}

#[test]
fn what_cannot_be_is_refused_and_nothing_is_touched() {
    let place = Place::new();
    for (arguments, words) in [
        (vec!["cost", "--error", "0.01"], vec!["--advise"]),
        (vec!["cost", "--advise", "--error", "0.01"], vec!["--wavelength"]),
        (vec!["cost", "--advise", "--error", "0", "--wavelength", "1"], vec!["--error 0", "--error 0.01"]),
        (vec!["cost", "--advise", "--error", "1", "--wavelength", "1"], vec!["one per cent"]),
        (vec!["cost", "--advise", "--error", "NaN", "--wavelength", "1"], vec!["--error NaN"]),
        (vec!["cost", "--advise", "--error", "0.1", "--wavelength", "-1"], vec!["--wavelength -1"]),
        (
            vec!["cost", "--advise", "--error", "0.1", "--wavelength", "1", "--speed", "inf"],
            vec!["--speed inf"],
        ),
        (
            vec!["cost", "--advise", "--error", "0.1", "--wavelength", "1", "--min-m", "11"],
            vec!["from 1.5 to 10"],
        ),
        (
            vec!["cost", "--advise", "--error", "0.1", "--wavelength", "1", "--horizon", "0"],
            vec!["--horizon 0"],
        ),
        (
            vec!["cost", "--advise", "--error", "0.1", "--wavelength", "1", "--horizon", "1", "--min-m", "3"],
            vec!["cannot be used with"],
        ),
    ] {
        place.refuses(&arguments, &words);
    }
}

const PULSE: &str = r#"format = 1
id = "my-pulse"
kind = "cost"
title = "A pulse in aluminium"
material = { youngs_modulus_gpa = 70, density_kg_m3 = 2700 }
[[case]]
id = "pulse"
asks = "pulse_cost"
body = "bar"
side_m = 2
width_m = 0.1
travel = 0.21
[case.settings]
m = [2, 3.4]
dx_mm = [25, 12.5, 6.25]
safety = [0.4, 0.8]
finite_differences = true
weights = { kernel = "gaussian", p = 1.7, volume_rule = "linear", calibrated = true }
"#;

/// What `bench` would have left below `out`, so that nothing has to be measured first.
fn leave_costs(place: &Place, out: &str, threads: u32) {
    let body = serde_json::json!({
        "step_s": 1e-7, "whole_by_pairs": [[3.0, 1e-9]], "by_nodes": [[1e3, 1.0]], "finite_pair_s": 1e-9,
        "masked_end_s": 1e-9, "listed_end_s": 1e-9, "damped_node_s": 1e-9, "loaded_place_s": 1e-9, "booked_node_s": 1e-9,
        "begin": [], "growth": [], "stop": [], "snapshot": [], "repeat": [], "patch_node_s": 0.0, "value_s": 0.0,
    });
    let costs = serde_json::json!({ "bar": body, "plate": body });
    let kept = serde_json::json!({ "isa": "baseline", "threads": threads, "cpu": "any", "costs": costs });
    place.write(&format!("{out}/bench/bench.json"), kept.to_string());
}

/// Times differ from run to run, nothing else does; counts are cells times steps; on the frontier nothing is beaten.
#[test]
fn work_and_precision_of_a_study_of_ones_own() {
    let place = Place::with_study(PULSE);
    let tables: Vec<String> = [1, 2]
        .map(|threads| {
            let out = format!("out-{threads}");
            leave_costs(&place, &out, threads);
            let count = threads.to_string();
            place
                .run(&[
                    "cost",
                    "study.toml",
                    "--strict",
                    "--isa",
                    "baseline",
                    "--threads",
                    &count,
                    "--out",
                    &out,
                ])
                .code(0);
            place.read(&format!("{out}/my-pulse/work_precision.csv"))
        })
        .to_vec();
    assert!(tables[0].starts_with(
        "case,method,kernel,p,m,dx_m,volume_rule,calibrated,courant,error,error_kind,seconds,node_updates,bond_updates,bytes_peak,on_frontier,"
    ));
    let [one, two] = [&tables[0], &tables[1]].map(|table| rows(table));
    assert_eq!(one.len(), 3 * 2 * 3);
    let number =
        |row: &std::collections::BTreeMap<String, String>, key: &str| row[key].parse::<f64>().unwrap();
    for (a, b) in one.iter().zip(&two) {
        for key in
            ["method", "m", "dx_m", "error", "node_updates", "bond_updates", "bytes_peak", "on_frontier"]
        {
            assert_eq!(a[key], b[key], "{key}");
        }
        assert!(number(a, "seconds") > 0.0 && number(a, "seconds_predicted") > 0.0);
        let cells = 2.0 / number(a, "dx_m");
        assert_eq!(number(a, "node_updates") % cells.round(), 0.0);
        let beaten = one.iter().any(|other| {
            number(other, "bond_updates") < number(a, "bond_updates")
                && number(other, "error") < number(a, "error")
        });
        assert_eq!(a["on_frontier"] == "true", !beaten, "{a:?}");
    }
    let plain = one.iter().find(|row| row["method"] == "finite_differences").unwrap();
    assert_eq!((plain["kernel"].as_str(), plain["m"].as_str()), ("", ""));
    assert_eq!(plain["node_updates"], plain["bond_updates"]);
    let cheapest = rows(&place.read("out-1/my-pulse/work_cheapest.csv"));
    assert!(
        cheapest
            .iter()
            .any(|row| row["error"] == "0.01" && row["by"] == "bond_updates" && !row["dx_m"].is_empty())
    );
}

#[test]
fn settings_that_cannot_be_are_refused_with_their_place() {
    for (old, new, words) in [
        (
            "safety = [0.4, 0.8]",
            "safety = [0.4, 1.0]",
            vec!["study.toml:16", "no stable time step", "[0.1, 0.5, 0.95]"],
        ),
        ("dx_mm = [25, 12.5, 6.25]", "dx_mm = [25, 12.5]", vec!["study.toml:15", "three levels"]),
        ("width_m = 0.1", "width_m = 0.4", vec!["study.toml:11", "twelfth of side_m"]),
        ("body = \"bar\"", "body = \"plane_stress\"", vec!["finite differences are run in bars"]),
        ("finite_differences", "finite_diferences", vec!["study.toml:17", "finite_differences"]),
        ("m = [2, 3.4]", "m = [2, 0.3]", vec!["study.toml:13"]),
    ] {
        assert!(PULSE.contains(old));
        Place::with_study(PULSE.replacen(old, new, 1)).refuses(&["cost", "study.toml"], &words);
    }
}
