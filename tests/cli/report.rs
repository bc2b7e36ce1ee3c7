//! One report of a whole run, and the same again from its results alone.

use crate::support::{CASE, HEAD, Place, rows, small};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use std::fs;

/// A study of two cases.
fn two() -> String {
    format!("{}{}{}", HEAD.replace("mine", "two"), CASE, CASE.replace("\"a\"", "\"b\""))
}

fn ran() -> Place {
    let place = Place::with_study(small());
    place.write("two.toml", two());
    place.run(&["run", "study.toml", "two.toml", "--out", "out"]).code(0);
    place
}

const PAGES: [&str; 4] = ["out/index.html", "out/summary.md", "out/junit.xml", "out/verdicts.csv"];

#[test]
fn a_report_is_made_again_from_results_byte_for_byte() {
    let place = ran();
    let before = PAGES.map(|page| place.read(page));
    PAGES.iter().for_each(|page| fs::remove_file(place.path(page)).unwrap());
    let all = place.contents();
    place.run(&["report", "--from", "out"]).code(0).stdout(contains("9 claims: 9 pass"));
    assert!(PAGES.map(|page| place.read(page)) == before);
    let mut after = place.contents();
    PAGES.iter().for_each(|page| drop(after.remove(&place.path(page))));
    assert!(after == all, "nothing else is touched");
}

/// `--set` finds its place in one study of two: their folders say other things, and are of one run.
#[test]
fn a_run_with_settings_is_made_again() {
    let place = ran();
    let set = ["run", "study.toml", "two.toml", "--out", "out", "--set", "case.b.curve.0.m=2"];
    place.run(&set).code(0);
    let before = PAGES.map(|page| place.read(page));
    place.run(&["report", "--from", "out"]).code(0);
    assert!(PAGES.map(|page| place.read(page)) == before);
}

#[test]
fn folders_of_other_runs_are_named_and_left_out() {
    let place = ran();
    place.run(&["run", "study.toml", "--out", "out"]).code(0);
    place.run(&["report", "--from", "out"]).code(0).stderr(contains("left out").and(contains("two")));
    assert!(rows(&place.read("out/verdicts.csv")).iter().all(|row| row["study"] == "mine"));
}

/// What is done to the results, and what is said of them.
type Spoilt = (&'static str, fn(&Place), &'static [&'static str]);

#[test]
fn results_that_are_not_whole_are_refused_and_nothing_is_touched() {
    let cases: [Spoilt; 8] = [
        (
            "nothing",
            |place| fs::remove_file(place.path("out/run.json")).unwrap(),
            &["holds no run", "run.json"],
        ),
        ("missing", |place| fs::remove_dir_all(place.path("out/two")).unwrap(), &["two is missing"]),
        (
            "half-written",
            |place| {
                let text = place.read("out/two/results.json");
                place.write("out/two/results.json", &text[..text.len() / 2]);
            },
            &["two/results.json", "is cut off", "run again"],
        ),
        (
            "edited",
            |place| change(place, "out/two/results.json", "\"verdict\": \"pass\"", "\"verdict\": \"fail\""),
            &["two is not what this run wrote"],
        ),
        (
            "edited data",
            |place| change(place, "out/two/b.csv", "1", "2"),
            &["two/b.csv", "not what the run wrote"],
        ),
        ("removed", |place| fs::remove_file(place.path("out/mine/a.svg")).unwrap(), &["mine/a.svg"]),
        (
            "another version",
            |place| change(place, "out/run.json", env!("CARGO_PKG_VERSION"), "9.9.9"),
            &["written by version 9.9.9"],
        ),
        (
            "another format",
            |place| change(place, "out/run.json", "\"format\": 1", "\"format\": 2, \"new\": 0"),
            &["has format 2, this version reads 1"],
        ),
    ];
    for (_, spoil, words) in cases {
        let place = ran();
        spoil(&place);
        place.refuses(&["report", "--from", "out"], words);
    }
    // A folder that another run has written in the meantime.
    let place = ran();
    let run = place.read("out/run.json");
    place.run(&["run", "two.toml", "--out", "out", "--profile", "full"]).code(0);
    place.write("out/run.json", run);
    place.refuses(&["report", "--from", "out"], &["two is not what this run wrote"]);
}

fn change(place: &Place, file: &str, old: &str, new: &str) {
    let text = place.read(file);
    assert!(text.contains(old), "{file} has no {old}");
    place.write(file, text.replacen(old, new, 1));
}

#[test]
fn the_code_of_a_report_is_that_of_its_run() {
    let place = ran();
    // What is expected of a scene and does not come.
    place.write("scene.toml", SCENE);
    place.run(&["run", "scene.toml", "--out", "out"]).code(1);
    let page = place.read("out/index.html");
    place.run(&["report", "--from", "out"]).code(1).stdout(contains("1 fail"));
    assert!(place.read("out/index.html") == page);
    place.refuses(&["report", "--from", "nowhere"], &["nowhere holds no run"]);
    place.run(&["report", "--from", "out", "--profile", "quick"]).code(2);
}

/// A bar at rest of which somebody expects motion.
pub const SCENE: &str = r#"format = 1
id = "still"
kind = "scene"
title = "A bar at rest"
material = { youngs_modulus_gpa = 72, density_kg_m3 = 2440 }
[[case]]
id = "bar"
asks = "march"
body = "bar"
size_m = 1.0
dx_mm = 20
duration_us = 20
edges = { left = "mirror_odd" }
lattice = { kernel = "constant", m = 2, volume_rule = "linear" }
[[case.probe]]
name = "end"
watches = "point"
at_m = 0.9
[[case.expect]]
probe = "end"
quantity = "displacement_x"
at_us = 20
value = 1e-3
tolerance = 1e-6
basis = "theory"
because = "nobody knows why it should move"
"#;

/// Printed formulas that are wrong fail as expected, in every report that is made of them.
#[test]
fn expected_failures_stay_expected() {
    let place = Place::new();
    let misprints = concat!(env!("CARGO_MANIFEST_DIR"), "/studies/dispersion/misprints.toml");
    place.run(&["dispersion", misprints, "--out", "out"]).code(0);
    let words = |place: &Place| -> Vec<String> {
        rows(&place.read("out/verdicts.csv")).iter().map(|row| row["verdict"].clone()).collect()
    };
    let before = words(&place);
    assert!(before.iter().any(|word| word == "xfail"), "{before:?}");
    place.run(&["report", "--from", "out"]).code(0);
    assert_eq!(words(&place), before);
    let again = place.run(&["dispersion", misprints, "--out", "out", "--rerun-failed"]);
    again.code(0).stderr(contains("ran 0"));
    assert_eq!(words(&place), before);
    place.run(&["baseline", "save", "main", "--from", "out"]).code(0);
    place.run(&["compare", "main", "--from", "out"]).code(0);
}

#[test]
fn schemas_of_results_are_printed() {
    let place = ran();
    let printed = |of: &str| -> serde_json::Value {
        let said = place.run(&["schema", of]).code(0);
        serde_json::from_slice(&said.get_output().stdout).unwrap()
    };
    assert!(printed("results")["$defs"]["Evidence"]["properties"]["computed"].is_object());
    assert!(printed("run")["properties"]["folders"].is_object());
    assert_eq!(printed("study")["title"], "pd-verify study file");
    place.run(&["schema", "result"]).code(2).stderr(contains("results"));
}
