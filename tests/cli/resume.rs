//! What was found is taken over byte for byte where nothing changed, and found anew where something did.

use crate::report::SCENE;
use crate::support::{CASE, HEAD, Place, small};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Duration;

/// Cases `a`, `b`, `c`, in this order.
fn three() -> String {
    let cases: String = ["a", "b", "c"].map(|id| CASE.replace("\"a\"", &format!("\"{id}\""))).concat();
    format!("{HEAD}{cases}")
}

fn ran() -> Place {
    let place = Place::with_study(three());
    place.run(&["run", "study.toml"]).code(0);
    place
}

/// The folder of the study but for its manifest, which says when and how.
fn found(place: &Place) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = place.contents();
    let folder = place.path("reports/mine");
    all.retain(|path, _| path.starts_with(&folder) && !path.ends_with("manifest.json"));
    all.remove(&folder.join("results.json"));
    all
}

/// Cases as they stand in the results: seconds, hashes and all.
fn cases(place: &Place) -> Vec<serde_json::Value> {
    let results: serde_json::Value = serde_json::from_str(&place.read("reports/mine/results.json")).unwrap();
    results["studies"][0]["cases"].as_array().unwrap().clone()
}

#[test]
fn what_has_not_changed_is_taken_over_byte_for_byte() {
    let place = ran();
    let (files, before) = (found(&place), cases(&place));
    let again = place.run(&["run", "study.toml", "--resume", "--threads", "1", "--profile", "full"]);
    again.code(0).stderr(contains("took over 3 of 3 cases from reports, ran 0"));
    assert!(found(&place) == files && files.len() > 10);
    assert_eq!(cases(&place), before, "seconds too");
    place.run(&["report", "--from", "reports"]).code(0);
    // Without the option everything is run.
    place.run(&["run", "study.toml"]).code(0).stderr("");
    assert_ne!(cases(&place), before);
}

#[test]
fn a_changed_input_is_run_again_and_only_it() {
    let place = ran();
    let before = cases(&place);
    // The second case, by the file.
    let changed = three().replacen("id = \"b\"", "id = \"b\"\ntitle = \"another\"", 1);
    place.write("study.toml", &changed);
    place.run(&["run", "study.toml", "--resume"]).code(0).stderr(contains("took over 2 of 3 cases"));
    let after = cases(&place);
    assert_eq!([&after[0], &after[2]], [&before[0], &before[2]]);
    assert_ne!(after[1]["inputs"], before[1]["inputs"]);
    // The third, by --set; the head, which is everybody's; a remark, which is nobody's.
    let set = ["run", "study.toml", "--resume", "--set", "case.c.curve.0.m=4"];
    place.run(&set).code(0).stderr(contains("took over 2 of 3 cases"));
    place.run(&["run", "study.toml", "--resume"]).code(0).stderr(contains("took over 2 of 3 cases"));
    place.write("study.toml", changed.replace("2700", "2710"));
    place.run(&["run", "study.toml", "--resume"]).code(0).stderr(contains("took over 0 of 3 cases"));
    place.write("study.toml", format!("# a remark\n{}", changed.replace("2700", "2710")));
    place.run(&["run", "study.toml", "--resume"]).code(0).stderr(contains("took over 3 of 3 cases"));
    if !place.read("reports/run.json").contains("\"instruction_set\": \"baseline\"") {
        let baseline = ["run", "study.toml", "--resume", "--isa", "baseline"];
        place.run(&baseline).code(0).stderr(contains("took over 0 of 3 cases"));
    }
}

/// Results of a resumed run are those of a run that never knew an earlier one.
#[test]
fn a_resumed_run_is_a_run() {
    let place = ran();
    let data = |place: &Place| {
        let mut all = found(place);
        all.remove(&place.path("reports/mine/verdicts.csv"));
        all
    };
    let changed = three().replacen("m = 3", "m = 5", 1).replace("id = \"c\"", "id = \"d\"");
    place.write("study.toml", &changed);
    place.run(&["run", "study.toml", "--resume"]).code(0).stderr(contains("took over 1 of 3 cases"));
    let resumed = data(&place);
    place.run(&["run", "study.toml"]).code(0);
    assert!(data(&place) == resumed);
}

#[test]
fn failures_are_run_again_and_the_rest_is_not() {
    let place = Place::with_study(SCENE);
    place.write("fine.toml", small());
    place.run(&["run", "study.toml", "fine.toml"]).code(1);
    let resumed = place.run(&["run", "study.toml", "fine.toml", "--resume"]);
    resumed.code(1).stderr(contains("took over 2 of 2 cases"));
    let rerun = place.run(&["run", "study.toml", "fine.toml", "--rerun-failed"]);
    rerun.code(1).stderr(contains("took over 1 of 2 cases from reports, ran 1"));
    // Somebody finds out that it does not move.
    place.write("study.toml", SCENE.replace("value = 1e-3", "value = 0"));
    place.run(&["run", "study.toml", "fine.toml", "--rerun-failed"]).code(0).stderr(contains("took over 1"));
    // Where nothing moves energy cannot be judged: that is asked again, and only that.
    assert!(place.read("reports/verdicts.csv").contains("inconclusive"));
    place.run(&["run", "study.toml", "fine.toml", "--rerun-failed"]).code(0).stderr(contains("took over 1"));
    place.run(&["run", "study.toml", "fine.toml", "--resume"]).code(0).stderr(contains("took over 2"));
}

#[test]
fn spoilt_results_are_refused_or_found_anew() {
    let place = ran();
    let files = found(&place);
    place.write("reports/mine/b.csv", "k,");
    let again = place.run(&["run", "study.toml", "--resume"]);
    again
        .code(0)
        .stderr(contains("mine/b is run again, its files have changed").and(contains("took over 2")));
    let mut after = found(&place);
    let verdicts = place.path("reports/mine/verdicts.csv");
    assert_eq!(after.remove(&verdicts).map(|_| ()), Some(()));
    assert!(after.iter().all(|(path, bytes)| files[path] == *bytes));
    let text = place.read("reports/mine/results.json");
    place.write(
        "reports/mine/results.json",
        text.replacen("\"verdict\": \"pass\"", "\"verdict\": \"fail\"", 1),
    );
    let again = place.run(&["run", "study.toml", "--resume"]);
    again.code(0).stderr(contains("nothing is taken from mine").and(contains("took over 0 of 3 cases")));
    let text = place.read("reports/mine/results.json");
    place.write("reports/mine/results.json", &text[..text.len() / 2]);
    place.refuses(&["run", "study.toml", "--resume"], &["mine/results.json is cut off", "run again"]);
    place.run(&["run", "study.toml"]).code(0);
    let place = Place::with_study(three());
    place.run(&["run", "study.toml", "--resume"]).code(0).stderr(contains("everything is run"));
}

/// A run that is asked to end twice over, and the rest of it.
#[cfg(unix)]
#[test]
fn an_interrupted_run_goes_on_where_it_stopped() {
    let place = Place::new();
    let cases: String = (0..3000).map(|n| CASE.replace("\"a\"", &format!("\"a{n}\""))).collect();
    place.write("study.toml", format!("{HEAD}{cases}"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_pd-verify"));
    command.current_dir(place.path("")).args(["run", "study.toml", "--quiet"]);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let partial = place.path(&format!("reports/.mine.partial-{}", child.id()));
    while !partial.join("a3.csv").exists() {
        assert!(child.try_wait().unwrap().is_none(), "ended before it could be interrupted");
        std::thread::sleep(Duration::from_millis(2));
    }
    let done = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(done.success());
    let said: Vec<String> =
        BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap).collect();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{said:?}");
    let ran = self::cases(&place).len();
    assert!(ran > 3 && ran < 3000, "{ran}");
    // The report of an interrupted run says so, and is not whole.
    place.run(&["report", "--from", "reports", "--quiet"]).code(1).stderr(contains("was interrupted"));
    place.refuses(&["baseline", "save", "x"], &["interrupted", "--resume"]);
    let rest = place.run(&["run", "study.toml", "--resume"]);
    rest.code(0).stderr(contains(format!("took over {ran} of 3000 cases")));
    assert_eq!(self::cases(&place).len(), 3000);
    place.run(&["report", "--from", "reports", "--quiet"]).code(0);
}
