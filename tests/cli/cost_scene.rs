//! `cost` of a scene of one's own: an answer marched, files written, what is inconclusive and what is refused.

use crate::support::{Place, rows, small};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use serde_json::Value;

/// A bar between rollers in its second mode.
const BAR: &str = r#"format = 1
id = "swinging"
kind = "scene"
title = "A bar that swings"
material = { youngs_modulus_gpa = 200, density_kg_m3 = 8000 }
[[case]]
id = "second"
asks = "march"
body = "bar"
size_m = 1.0
dx_mm = 10
duration_us = 250
edges = { left = "roller", right = "roller" }
lattice = { kernel = "constant", m = 3, volume_rule = "linear", calibrated = true }
initial = [{ sets = "displacement", shape = "wave", amplitude = 1e-6, wavenumber_per_m = [6.283185307179586], phase_rad = -1.5707963267948966 }]
probe = [{ name = "quarter", watches = "point", at_m = 0.25 }]
"#;

#[test]
fn an_error_that_is_asked_for_is_met_and_written_down() {
    let place = Place::with_study(BAR);
    place.run(&["cost", "--error", "0.002", "study.toml"]).code(0).stderr("").stdout(
        contains("swinging/second: the coarsest Δx whose error is at most 0.002.")
            .and(contains("Predicted: "))
            .and(contains("as accurate as asked")),
    );
    let data: Value = serde_json::from_str(&place.read("reports/swinging-cost/cost.json")).unwrap();
    assert_eq!(data["met"], true);
    assert!(data["answer"]["error"].as_f64().unwrap() <= 0.002);
    assert!((data["answer"]["order"].as_f64().unwrap() - 2.0).abs() < 0.1);
    let levels = rows(&place.read("reports/swinging-cost/levels.csv"));
    assert!(levels.len() >= 4 && levels.iter().filter(|row| row["answer"] == "true").count() == 1);
    for row in &levels {
        let number = |key: &str| row[key].parse::<f64>().unwrap();
        assert_eq!(number("node_updates"), number("nodes") * number("steps"));
    }
    for file in ["error_by_seconds.svg", "error_by_seconds.csv", "manifest.json"] {
        assert!(!place.read(&format!("reports/swinging-cost/{file}")).is_empty(), "{file}");
    }
}

#[test]
fn a_budget_that_pays_for_nothing_has_no_number() {
    let place = Place::with_study(BAR);
    let said = place.run(&["cost", "--budget", "1e-9", "study.toml", "--json"]).code(1);
    let data: Value = serde_json::from_slice(&said.get_output().stdout).unwrap();
    assert!(data["answer"].is_null() && data["levels"][0]["error"].is_null() && data["met"] == false);
    assert!(data["inconclusive"].as_str().unwrap().contains("a tenth of 0.000000001 s"));
    // The ladder was climbed as far as the tenth allows: one level.
    assert_eq!(data["levels"].as_array().unwrap().len(), 1);
}

#[test]
fn what_cannot_be_asked_is_refused_and_nothing_is_touched() {
    let refuses = |text: &str, arguments: &[&str], words: &[&str]| {
        Place::with_study(text).refuses(&[&["cost"], arguments].concat(), words);
    };
    refuses(BAR, &["study.toml"], &["another kind"]);
    refuses(BAR, &["--json", "study.toml"], &["--error X or --budget"]);
    refuses(BAR, &["--error", "0.1", "study.toml", "study.toml"], &["2 study files", "name one scene"]);
    for (given, word) in
        [("0", "--error 0 is"), ("-1", "--error -1"), ("NaN", "--error NaN"), ("1", "one per cent")]
    {
        refuses(BAR, &["--error", given, "study.toml"], &[word]);
    }
    refuses(BAR, &["--budget", "0", "study.toml"], &["--budget 0", "--budget 60"]);
    refuses(BAR, &["--budget", "1", "--error", "0.1", "study.toml"], &["cannot be used with"]);
    refuses(
        BAR,
        &["--advise", "--error", "0.1", "--wavelength", "1", "study.toml"],
        &["cannot be used with"],
    );
    refuses(BAR, &["--error", "0.1", "--wavelength", "1", "study.toml"], &["cannot be used with"]);
    refuses(BAR, &["--error", "0.1", "none.toml"], &["cannot read none.toml"]);
    refuses(BAR, &["--error", "0.1", "--case", "third", "study.toml"], &["no case third", "second"]);
    refuses(&small(), &["--error", "0.1", "study.toml"], &["no study of kind \"scene\""]);
    let two = format!("{BAR}{}", BAR[BAR.find("[[case]]").unwrap()..].replace("\"second\"", "\"third\""));
    refuses(&two, &["--error", "0.1", "study.toml"], &["has 2 cases", "--case: second, third"]);
    let with = |old: &str, new: &str| {
        assert!(BAR.contains(old));
        BAR.replace(old, new)
    };
    let momentum = with("watches = \"point\", at_m = 0.25", "watches = \"momentum\"");
    refuses(&momentum, &["--error", "0.1", "study.toml"], &["nothing is seen", "add a probe"]);
    refuses(&with("m = 3", "m = [3, 4]"), &["--error", "0.1", "study.toml"], &["2 lattices", "leave one"]);
    let unstable = with("dx_mm = 10", "dx_mm = 10\ntime_step_us = 9\nunstable = true");
    refuses(&unstable, &["--error", "0.1", "study.toml"], &["beyond the limit"]);
    refuses(&with("dx_mm = 10", "dx_mm = 7"), &["--error", "0.1", "study.toml"], &["does not divide"]);
}
