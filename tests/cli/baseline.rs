//! A baseline notices what moves, what is judged otherwise and what is gone, and nothing else.

use crate::report::SCENE;
use crate::support::{CASE, HEAD, Place, small};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;

fn kept() -> Place {
    let place = Place::with_study(small());
    place.run(&["run", "study.toml"]).code(0);
    place.run(&["baseline", "save", "main"]).code(0).stdout(contains("kept 3 claims"));
    place
}

const FILE: &str = "reports/baselines/main.json";

/// The line of a claim's baseline with a key, whose number is given to `change`.
fn spoil(place: &Place, key: &str, change: impl Fn(f64) -> f64) {
    let text = place.read(FILE);
    let key = format!("\"{key}\":");
    let begin = text.find(&key).unwrap_or_else(|| panic!("no {key} in {text}")) + key.len();
    let end = begin + text[begin..].find([',', '}']).unwrap();
    let number: f64 = text[begin..end].parse().unwrap();
    place.write(FILE, format!("{}{:e}{}", &text[..begin], change(number), &text[end..]));
}

#[test]
fn the_same_run_has_not_moved_and_the_file_is_small_sorted_and_steady() {
    let place = kept();
    let text = place.read(FILE);
    let claims: Vec<&str> = text.lines().filter(|line| line.contains("{\"claim\":")).collect();
    assert!(claims.len() == 3 && claims.is_sorted() && text.len() < 2000, "{text}");
    place.run(&["compare", "main"]).code(0).stdout(contains("0 quantities moved"));
    // Another run, other threads: other seconds, same file.
    place.run(&["run", "study.toml", "--threads", "1"]).code(0);
    place.run(&["baseline", "save", "main"]).code(0);
    assert_eq!(place.read(FILE), text);
    place.run(&["baseline", "save", "kept/here.json"]).code(0);
    place.run(&["compare", "kept/here.json", "--from", "reports"]).code(0);
}

/// A part in 10⁹ is more than another order of sums leaves; a part in 10¹³ is less.
#[test]
fn a_drift_of_one_digit_is_caught_and_said_beside_the_tolerance() {
    let place = Place::with_study(SCENE);
    place.run(&["run", "study.toml"]).code(1);
    place.run(&["baseline", "save", "main"]).code(0);
    place.run(&["compare", "main"]).code(0);
    let text = place.read(FILE);
    assert!(text.contains("\"reference\":0.001"), "{text}");
    spoil_reference(&place, "0.001", "0.0010000000000000002");
    place.run(&["compare", "main"]).code(0);
    place.write(FILE, &text);
    spoil_reference(&place, "0.001", "0.001000001");
    let said = place.run(&["compare", "main"]).code(1);
    said.stdout(
        contains("moved    still/bar/")
            .and(contains("reference 0.001000001 then, 0.001 now, by -1.000e-9"))
            .and(contains("tolerance 1e-6"))
            .and(contains("1 quantities moved")),
    );
}

fn spoil_reference(place: &Place, old: &str, new: &str) {
    let (old, new) = (format!("\"reference\":{old}"), format!("\"reference\":{new}"));
    place.write(FILE, place.read(FILE).replacen(&old, &new, 1));
}

#[test]
fn a_bound_that_moved_and_a_verdict_that_changed_are_failures() {
    let place = kept();
    spoil(&place, "tolerance", |x| 0.5 * x);
    place.run(&["compare", "main"]).code(1).stdout(contains("tolerance"));
    let place = kept();
    place.write(FILE, place.read(FILE).replacen("\"pass\"", "\"fail\"", 1));
    place
        .run(&["compare", "main"])
        .code(1)
        .stdout(contains("fail then, pass now").and(contains("1 verdicts changed")));
}

#[test]
fn claims_that_are_gone_fail_and_new_ones_are_named() {
    let place = kept();
    place.write("study.toml", format!("{HEAD}{CASE}{}", CASE.replace("\"a\"", "\"b\"")));
    place.run(&["run", "study.toml", "--profile", "full"]).code(0);
    let said = place.run(&["compare", "main"]).code(0);
    said.stdout(contains("new      mine/b/").and(contains("another profile: standard then, full now")));
    place.run(&["baseline", "save", "main"]).code(0);
    place.write("study.toml", small());
    place.run(&["run", "study.toml", "--profile", "full"]).code(0);
    place
        .run(&["compare", "main"])
        .code(1)
        .stdout(contains("missing  mine/b/").and(contains("3 claims missing")));
}

#[test]
fn seconds_count_only_when_asked() {
    let place = kept();
    place.refuses(&["compare", "main", "--slower", "2"], &["has no seconds", "--seconds"]);
    place.run(&["baseline", "save", "main", "--seconds"]).code(0);
    place.run(&["compare", "main", "--slower", "2"]).code(0);
    // As if it had taken an hour where the baseline took nothing.
    let text = place.read("reports/mine/results.json");
    assert!(text.contains("\"seconds\""));
    spoil(&place, "seconds", |_| 1e-9);
    place.run(&["compare", "main"]).code(0);
    place.refuses(&["compare", "main", "--slower", "0.5"], &["--slower 0.5"]);
}

#[test]
fn what_is_no_baseline_is_refused() {
    let place = kept();
    place.refuses(&["compare", "mian"], &["mian.json", "there are: main"]);
    place.refuses(&["compare", "a/b"], &["cannot name a baseline", "ends in .json"]);
    place.refuses(&["compare", "main", "--from", "nowhere"], &["nowhere"]);
    place.write("other.json", "{}");
    place.refuses(&["compare", "other.json"], &["other.json is no baseline"]);
    place.refuses(&["baseline", "save", "other.json"], &["other.json is no baseline"]);
    let text = place.read(FILE);
    place.write(FILE, &text[..text.len() / 2]);
    place.refuses(&["compare", "main"], &["main.json is no baseline"]);
    place.write(FILE, text.replace("\"format\": 1", "\"format\": 7"));
    place.refuses(&["compare", "main"], &["has format 7"]);
}
