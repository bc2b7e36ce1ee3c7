//! What goes wrong around a run: no memory, no room on the disk, folders that vanish, readers that leave, runs that are
//! killed. Each ends with a message and its code, leaves no half file, and keeps what was finished.

use crate::support::{CASE, HEAD, Place, rows, small};
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

/// A plate of 16 million nodes, whose march takes a gigabyte.
const LARGE: &str = r#"format = 1
id = "large"
kind = "scene"
title = "A large plate"
material = { youngs_modulus_gpa = 72, density_kg_m3 = 2440 }
[[case]]
id = "plate"
asks = "march"
body = "plane_stress"
size_m = [4, 4]
dx_mm = 1
duration_us = 1
lattice = { kernel = "constant", m = 2, volume_rule = "linear" }
[[case.probe]]
name = "middle"
watches = "point"
at_m = [2, 2]
"#;

/// The program under limits of the shell.
fn limited(place: &Place, limits: &str, arguments: &[&str]) -> Output {
    let script = format!("{limits} && exec \"$0\" \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &script, env!("CARGO_BIN_EXE_pd-verify")]).args(arguments);
    command.current_dir(place.path("")).env_remove("GITHUB_STEP_SUMMARY").output().unwrap()
}

fn said(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr).replace("│", " ");
    assert!(!text.contains("panicked"), "{text}");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Names below a folder that begin with a dot: what is half written.
fn half_written(folder: &Path) -> Vec<String> {
    let entries =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    entries.filter(|name| name.starts_with('.')).collect()
}

#[test]
fn what_takes_more_memory_than_there_is_is_refused_and_planned() {
    let place = Place::with_study(LARGE);
    let before = place.contents();
    let output = limited(&place, "ulimit -v 700000", &["run", "study.toml"]);
    let text = said(&output);
    assert_eq!(output.status.code(), Some(2), "{text}");
    for word in [
        "16000000 nodes takes 2.",
        "GB are left of the address space",
        "ulimit -v",
        "larger spacing",
        "study.toml:",
    ] {
        assert!(text.contains(word), "no {word}: {text}");
    }
    assert_eq!(place.contents(), before);
    let output = limited(&place, "ulimit -v 700000", &["plan", "study.toml"]);
    let plan = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(plan.contains("not run here: ") && plan.contains("16000000"), "{plan}");
}

/// A table of half a million rows, of which no plan speaks.
#[test]
fn memory_that_is_not_given_ends_a_run_with_a_message() {
    let place = Place::with_study(small().replace("count = 20", "count = 500000"));
    let output = limited(&place, "ulimit -v 150000", &["run", "study.toml", "--threads", "1"]);
    let text = said(&output);
    assert_eq!(output.status.code(), Some(3), "{text}");
    assert!(text.contains("error: the system gives no more memory") && text.contains("help: "), "{text}");
    assert_eq!(half_written(&place.path("reports")), Vec::<String>::new());
    assert!(!place.path("reports/mine").exists());
}

#[test]
fn every_hostile_file_is_refused_in_little_memory_and_time() {
    let place = Place::new();
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/corpus/study");
    let mut count = 0;
    for path in fs::read_dir(corpus).unwrap().map(|entry| entry.unwrap().path()) {
        if path.file_name().unwrap().to_string_lossy().starts_with("plain-") {
            continue;
        }
        for command in ["run", "plan"] {
            let limits = "ulimit -v 600000 && ulimit -t 5";
            let output = limited(&place, limits, &[command, path.to_str().unwrap()]);
            let text = said(&output);
            assert_eq!(output.status.code(), Some(2), "{command} {}: {text}", path.display());
            assert!(text.contains("help:") || text.contains(".toml:"), "{}: {text}", path.display());
        }
        count += 1;
    }
    assert!(count > 40 && place.contents().is_empty(), "{count} files");
}

/// A disk without room: no file may grow beyond two kilobytes.
#[test]
fn a_full_disk_leaves_the_results_that_were_there() {
    let place = Place::with_study(small());
    place.run(&["run", "study.toml"]).code(0);
    let mine = |place: &Place| {
        let mut all = place.contents();
        all.retain(|path, _| path.starts_with(place.path("reports/mine")));
        all
    };
    let before = mine(&place);
    let output = limited(&place, "trap '' XFSZ && ulimit -f 4", &["run", "study.toml"]);
    let text = said(&output);
    assert_eq!(output.status.code(), Some(3), "{text}");
    assert!(text.contains("cannot write the results of mine") && text.contains("too large"), "{text}");
    assert!(before.len() > 5 && mine(&place) == before);
    assert_eq!(half_written(&place.path("reports")), Vec::<String>::new());
    place.run(&["run", "study.toml"]).code(0);
}

#[cfg(target_os = "linux")]
#[test]
fn what_cannot_be_printed_or_appended_is_said() {
    let place = Place::with_study(small());
    let full = || Stdio::from(fs::OpenOptions::new().write(true).open("/dev/full").unwrap());
    for arguments in [&["run", "study.toml"][..], &["list"], &["schema"]] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pd-verify"));
        let output = command.current_dir(place.path("")).args(arguments).stdout(full()).output().unwrap();
        assert_eq!(output.status.code(), Some(3), "{arguments:?}");
        assert!(said(&output).contains("error: cannot print: No space left"), "{}", said(&output));
    }
    let mut command = place.program(&["run", "study.toml"]);
    command.env("GITHUB_STEP_SUMMARY", "/dev/full").assert().code(3);
}

#[test]
fn a_reader_who_leaves_is_no_error() {
    let place = Place::with_study(small());
    // More than a pipe holds.
    let mut command = Command::new(env!("CARGO_BIN_EXE_pd-verify"));
    command.current_dir(place.path("")).arg("schema").stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdout.take().unwrap().read_exact(&mut [0; 10]).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), said(&output).as_str()), (Some(0), ""));
    // A reader who was never there.
    let mut command = Command::new(env!("CARGO_BIN_EXE_pd-verify"));
    command.current_dir(place.path("")).args(["run", "study.toml"]).stdout(Stdio::piped());
    let mut child = command.spawn().unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
}

#[test]
fn any_number_of_threads_writes_the_same_bytes() {
    let place = Place::with_study(small());
    let bar = LARGE
        .replace("[4, 4]", "[0.06, 0.05]")
        .replace("[2, 2]", "[0.03, 0.02]")
        .replace("= 1\nlattice", "= 20\nlattice");
    place.write("bar.toml", bar);
    let mut found = ["1", "2", "64"].map(|threads| {
        place.run(&["run", "study.toml", "bar.toml", "--threads", threads]).code(0);
        let mut all = place.contents();
        // Manifests and verdicts speak of times and threads.
        all.retain(|path, _| {
            let data = path.extension().is_some_and(|ending| ending == "csv" || ending == "svg");
            data && !path.ends_with("verdicts.csv")
        });
        all
    });
    assert!(found[0].len() > 5);
    for (path, bytes) in found[0].clone() {
        assert!(
            found[1..].iter_mut().all(|other| other.remove(&path) == Some(bytes.clone())),
            "{}",
            path.display()
        );
    }
    assert!(found[1].is_empty() && found[2].is_empty());
}

/// A quick study, and one of thousands of cases behind it, begun.
fn begun(place: &Place, out: &str) -> Child {
    let case = |n: usize| CASE.replace("\"a\"", &format!("\"b{n}\""));
    place.write("long.toml", HEAD.replace("mine", "long") + &(0..4000).map(case).collect::<String>());
    let mut command = Command::new(env!("CARGO_BIN_EXE_pd-verify"));
    command.current_dir(place.path("")).args(["run", "study.toml", "long.toml", "--out", out]);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    while !place.path(out).join("run.json").exists() {
        assert!(child.try_wait().unwrap().is_none(), "ended before anything could happen to it");
        std::thread::sleep(Duration::from_millis(2));
    }
    child
}

fn signal(child: &Child, which: &str) {
    let done = Command::new("kill").args([which, &child.id().to_string()]).status().unwrap();
    assert!(done.success());
}

fn last_words(child: &mut Child) -> String {
    let lines = BufReader::new(child.stderr.take().unwrap()).lines();
    lines.map(Result::unwrap).collect::<Vec<_>>().join("\n")
}

#[test]
fn a_job_that_is_asked_to_end_keeps_what_was_finished() {
    let place = Place::with_study(small());
    let mut child = begun(&place, "out");
    signal(&child, "-TERM");
    let words = last_words(&mut child);
    assert_eq!(child.wait().unwrap().code(), Some(130), "{words}");
    assert!(words.contains("interrupted"), "{words}");
    let verdicts = rows(&place.read("out/verdicts.csv"));
    assert_eq!(verdicts.iter().filter(|row| row["study"] == "mine").count(), 3);
    assert_eq!(half_written(&place.path("out")), Vec::<String>::new());
}

#[test]
fn what_was_finished_survives_a_kill_and_the_next_run_clears_up() {
    let place = Place::with_study(small());
    let mut child = begun(&place, "out");
    let process = child.id();
    signal(&child, "-KILL");
    assert_eq!(child.wait().unwrap().code(), None);
    assert_eq!(rows(&place.read("out/mine/verdicts.csv")).len(), 3);
    assert!(!place.path("out/long").exists());
    // What was finished makes a report, which says that it is not all.
    place.run(&["report", "--from", "out"]).code(1).stderr(predicates::str::contains("was interrupted"));
    assert!(place.read("out/index.html").contains("Verification of peridynamics, interrupted"));
    assert_eq!(rows(&place.read("out/verdicts.csv")).len(), 3);
    // As if it had been killed while it wrote.
    place.write(&format!("out/.mine.partial-{process}/half.csv"), "k,");
    place.write(&format!("out/.index.html.partial-{process}"), "<!doc");
    place.run(&["run", "study.toml", "--out", "out"]).code(0);
    if cfg!(target_os = "linux") {
        assert_eq!(half_written(&place.path("out")), Vec::<String>::new());
    }
}

/// Removes a folder that somebody is writing to.
fn remove(folder: &Path) {
    while folder.exists() {
        let _ = fs::remove_dir_all(folder);
    }
}

#[test]
fn a_folder_that_vanishes_is_made_again_and_a_file_in_its_place_is_said() {
    let place = Place::with_study(small());
    let mut child = begun(&place, "out");
    remove(&place.path("out"));
    signal(&child, "-INT");
    let words = last_words(&mut child);
    assert_eq!(child.wait().unwrap().code(), Some(130), "{words}");
    assert_eq!(rows(&place.read("out/verdicts.csv")).iter().filter(|row| row["study"] == "mine").count(), 3);

    let mut child = begun(&place, "other");
    remove(&place.path("other"));
    place.write("other", "a file");
    signal(&child, "-INT");
    let words = last_words(&mut child);
    assert_eq!(child.wait().unwrap().code(), Some(130), "{words}");
    assert!(words.contains("cannot write index.html") && !words.contains("panicked"), "{words}");
    assert_eq!(place.read("other"), "a file");
}
