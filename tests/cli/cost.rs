//! `cost --advise`: what it finds, what it writes, what it refuses.

use crate::support::Place;
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
        (vec!["cost"], vec!["--advise"]),
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
