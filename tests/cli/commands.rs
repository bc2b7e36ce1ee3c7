//! Commands that compute nothing, options, and printing into pipes.

use crate::support::{Place, small};
use predicates::prelude::*;
use predicates::str::{contains, is_empty};
use serde_json::Value;

fn printed(arguments: &[&str]) -> String {
    let place = Place::with_study(small());
    let before = place.contents();
    let output = place.run(arguments).code(0).stderr("").get_output().stdout.clone();
    assert_eq!(place.contents(), before, "{arguments:?} writes files");
    String::from_utf8(output).unwrap()
}

#[test]
fn list_names_every_study_and_case() {
    let text = printed(&["list"]);
    let json: Value = serde_json::from_str(&printed(&["list", "--json"])).unwrap();
    let studies = json.as_array().unwrap();
    assert_eq!(studies.len(), crate::studies::shipped().len());
    for study in studies {
        for key in ["id", "title", "claims", "source"] {
            assert!(!study[key].as_str().unwrap().is_empty(), "{key}");
        }
        assert!(text.contains(study["source"].as_str().unwrap()));
        for case in study["cases"].as_array().unwrap() {
            assert!(text.contains(case["id"].as_str().unwrap()));
            assert!(!case["claims"].as_array().unwrap().is_empty());
        }
    }
}

#[test]
fn the_commands_of_all_shipped_kinds_are_named() {
    let text = printed(&["list"]);
    let json: Value = serde_json::from_str(&printed(&["list", "--json"])).unwrap();
    let last = text.lines().last().unwrap();
    for study in json.as_array().unwrap() {
        let command = format!("`pd-verify {}`", study["kind"].as_str().unwrap());
        assert!(last.contains(&command), "{command}: {last}");
        Place::new().refuses(&["run", "none.toml"], &["cannot read none.toml", &command]);
    }
    // Scenes are one's own; no command runs them.
    assert!(!last.contains("pd-verify scene"), "{last}");
}

#[test]
fn explain_takes_a_study_a_case_and_a_claim() {
    for id in ["dispersion-bar", "dispersion-bar/kernels", "dispersion-bar/kernels/grid"] {
        let text = printed(&["explain", id]);
        for word in ["Source: Bouaraquia 2024", "Equations", "bound:", "basis: rounding", "reference:"] {
            assert!(text.contains(word), "{id}: {word}");
        }
    }
    assert!(printed(&["explain", "dispersion-bar", "--bibtex"]).starts_with("@"));
}

#[test]
fn explain_takes_a_file_and_rounds_its_bounds() {
    let text = printed(&["explain", "study.toml"]);
    assert!(text.starts_with("mine: Aluminium") && text.contains("bound:"), "{text}");
    for id in ["dispersion-bar", "dispersion-plane", "bar-release", "bar-pulse", "bar-statics"] {
        let text = printed(&["explain", id]);
        let bounds = text.lines().filter(|line| line.trim().starts_with("bound:"));
        let digits =
            |word: &str| word.split('e').next().unwrap_or_default().matches(char::is_numeric).count();
        for bound in bounds {
            assert!(bound.split(' ').all(|word| digits(word) <= 7), "{bound}");
        }
    }
    Place::new().refuses(&["explain", "none.toml"], &["cannot read none.toml"]);
}

#[test]
fn a_shipped_study_and_each_of_its_cases_can_be_copied() {
    for (_, text) in crate::studies::shipped() {
        let id = text.parse::<toml::Table>().unwrap()["id"].as_str().unwrap().to_owned();
        assert_eq!(printed(&["explain", &id, "--toml"]), text);
    }
    let case = printed(&["explain", "bar-release/release-calibrated-p3", "--toml"]);
    assert!(case.contains("[material]") && case.matches("[[case]]").count() == 1, "{case}");
    let place = Place::with_study(case);
    place.run(&["plan", "study.toml"]).code(0).stdout(contains("release-calibrated-p3"));
    assert_eq!(printed(&["explain", "study.toml", "--toml"]), small());
    Place::new().refuses(&["explain", "bar-release", "--toml", "--bibtex"], &["cannot be used with"]);
}

#[test]
fn explain_suggests_what_was_meant() {
    for (wrong, right) in [
        ("dispersion-bra", "dispersion-bar"),
        ("dispersion-bar/kernls", "dispersion-bar/kernels"),
        ("kernels", "dispersion-bar/kernels"),
        ("kernels/grid", "dispersion-bar/kernels/grid"),
    ] {
        Place::new().refuses(&["explain", wrong], &["nothing is called", &format!("did you mean {right}?")]);
    }
    Place::new().refuses(&["explain", "xyzzy"], &["nothing is called xyzzy", "pd-verify list"]);
}

#[test]
fn plan_takes_an_id_and_a_file() {
    let text = printed(&["plan", "study.toml"]);
    assert!(text.contains("mine: Aluminium") && text.contains("total"), "{text}");
    let json: Value = serde_json::from_str(&printed(&["plan", "dispersion-plane", "--json"])).unwrap();
    assert!(json["total"]["bond_evaluations"].as_u64().unwrap() > 100_000);
    let quick = printed(&["plan", "dispersion-plane", "--profile", "quick"]);
    assert!(quick.contains("skipped: from profile standard"), "{quick}");
    let case = printed(&["plan", "bar-release/release-source"]);
    assert!(case.contains("release-source") && !case.contains("release-calibrated-p2"), "{case}");
    Place::new()
        .refuses(&["plan", "bar-release/release-sorce"], &["did you mean bar-release/release-source?"]);
    Place::new().refuses(&["plan", "dispersion-plan"], &["cannot read", "did you mean dispersion-plane?"]);
}

#[test]
fn schema_mentions_every_key_of_the_shipped_studies() {
    let schema: Value = serde_json::from_str(&printed(&["schema"])).unwrap();
    let mut known = Vec::new();
    properties(&schema, &mut known);
    let mut keys = Vec::new();
    for (_, text) in crate::studies::shipped() {
        table_keys(&text.parse::<toml::Table>().unwrap(), &mut keys);
    }
    assert!(keys.len() > 100);
    for key in keys {
        let si =
            ["_mm", "_gpa", "_ns"].iter().zip(["_m", "_pa", "_s"]).fold(key.clone(), |key, (from, to)| {
                key.strip_suffix(from).map(|stem| format!("{stem}{to}")).unwrap_or(key)
            });
        assert!(known.contains(&si), "the schema has no {si}");
    }
    let asked = schema["properties"]["case"]["items"]["oneOf"].as_array().unwrap();
    assert!(asked.iter().all(|case| case["properties"]["asks"]["const"].is_string()));
}

fn properties(value: &Value, found: &mut Vec<String>) {
    match value {
        Value::Object(table) => {
            let own = table.get("properties").and_then(Value::as_object);
            found.extend(own.into_iter().flat_map(|own| own.keys().cloned()));
            table.values().for_each(|value| properties(value, found));
        }
        Value::Array(items) => items.iter().for_each(|value| properties(value, found)),
        _ => {}
    }
}

fn table_keys(table: &toml::Table, found: &mut Vec<String>) {
    for (key, value) in table {
        found.push(key.clone());
        match value {
            toml::Value::Table(table) => table_keys(table, found),
            toml::Value::Array(items) => {
                items.iter().filter_map(toml::Value::as_table).for_each(|table| table_keys(table, found));
            }
            _ => {}
        }
    }
}

#[test]
fn completions_for_every_shell() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        assert!(printed(&["completions", shell]).contains("pd-verify"), "{shell}");
    }
}

#[test]
fn wrong_options_are_usage_errors() {
    let place = Place::with_study(small());
    for (arguments, word) in [
        (vec!["dispersoin"], "dispersion"),
        (vec!["run"], "<FILES>"),
        (vec!["run", "study.toml", "--threads", "0"], "1..=1024"),
        (vec!["run", "study.toml", "--isa", "nonsense"], "baseline, avx2, avx512"),
        (vec!["run", "study.toml", "--profile", "fast"], "quick, standard, full"),
        (vec!["run", "study.toml", "--out", ""], "--out"),
        (vec!["run", "study.toml", "--nope"], "--nope"),
        (vec!["completions", "tcsh"], "bash"),
    ] {
        place.refuses(&arguments, &[word, "--help"]);
    }
    Place::new().run(&[]).code(2).stderr(contains("Usage"));
    Place::new().run(&["--version"]).code(0).stdout(contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn quiet_prints_what_fails_and_nothing_else() {
    let place = Place::with_study(small());
    place.run(&["run", "study.toml", "--quiet"]).code(0).stdout("").stderr("");
    // Nothing is stable at fifty times the limit: nothing of it can be judged.
    place.write("unstable.toml", small().replace("\"lattice\"", "\"lattice_leapfrog\"\ncourant = 50"));
    place.run(&["run", "unstable.toml", "--quiet"]).code(0).stdout("");
    place.run(&["run", "unstable.toml", "--strict"]).code(1);
    let strict = place.run(&["run", "unstable.toml", "--quiet", "--strict"]).code(1);
    strict.stdout(contains("inconclusive"));
}

#[test]
fn nothing_judged_is_said_and_fails() {
    let place = Place::with_study(small().replace("body = ", "profile = \"full\"\nbody = "));
    place.run(&["run", "study.toml"]).code(1).stdout(contains("skipped"));
    place.run(&["run", "study.toml", "--quiet"]).code(1).stderr(contains("no claim passed"));
    place.run(&["run", "study.toml", "--quiet", "--profile", "full"]).code(0);
}

#[test]
fn pipes_get_neither_colour_nor_progress() {
    let place = Place::with_study(small());
    for colour in ["", "1"] {
        let mut command = place.program(&["run", "study.toml"]);
        let escape = contains("\u{1b}").not();
        command.env("NO_COLOR", colour).assert().code(0).stdout(escape).stderr(is_empty());
    }
}

#[cfg(unix)]
#[test]
fn a_reader_who_leaves_is_no_error() {
    use std::io::{BufRead, BufReader};
    use std::process::{Command, Stdio};
    let place = Place::with_study(small());
    for arguments in [&["list"][..], &["completions", "bash"], &["run", "study.toml"]] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pd-verify"));
        command.current_dir(place.path("")).args(arguments);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::with_capacity(16, child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{arguments:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_no_pass() {
    use std::process::Command;
    let place = Place::with_study(small());
    for arguments in [&["list"][..], &["run", "study.toml"]] {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_pd-verify"));
        let status = command.current_dir(place.path("")).args(arguments).stdout(full).status().unwrap();
        assert_eq!(status.code(), Some(3), "{arguments:?}");
    }
}

#[test]
fn the_summary_of_a_github_job_grows() {
    let place = Place::with_study(small());
    for times in 1..=2 {
        let mut command = place.program(&["run", "study.toml", "--quiet"]);
        command.env("GITHUB_STEP_SUMMARY", place.path("step.md")).assert().code(0);
        assert_eq!(place.read("step.md").matches("3 claims: 3 pass").count() / 2, times);
    }
    assert_eq!(place.read("step.md"), place.read("reports/summary.md").repeat(2));
}
