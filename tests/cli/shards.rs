//! Parts of a run, made one by one as a cluster would, are the run when they are put together.

use crate::support::{CASE, HEAD, Place, small};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

const PARTS: usize = 3;

/// Two studies, one of seven cases that share tables.
fn place() -> Place {
    let place = Place::with_study(small());
    let cases: String = (0..7).map(|n| CASE.replace("\"a\"", &format!("\"b{n}\""))).collect();
    place.write("seven.toml", HEAD.replace("mine", "seven") + &cases);
    place
}

fn run_part(place: &Place, part: usize, of: usize) {
    let (shard, out) = (format!("{part}/{of}"), format!("part-{part}"));
    place.run(&["run", "study.toml", "seven.toml", "--shard", &shard, "--out", &out]).code(0);
}

fn parts() -> Place {
    let place = place();
    (1..=PARTS).for_each(|part| run_part(&place, part, PARTS));
    place
}

const MERGE: [&str; 6] = ["merge", "part-1", "part-2", "part-3", "--out", "whole"];

/// Files of a folder without what speaks of times.
fn timeless(place: &Place, folder: &str) -> BTreeMap<PathBuf, String> {
    let root = place.path(folder);
    let files = place.contents().into_iter().filter(|(path, _)| path.starts_with(&root) && path.is_file());
    files
        .map(|(path, bytes)| {
            let text = String::from_utf8(bytes).unwrap();
            let text = match path.file_name().unwrap().to_str().unwrap() {
                "results.json" | "run.json" | "manifest.json" => without_times(&text),
                "verdicts.csv" => {
                    text.lines().map(|line| line.rsplit_once(',').unwrap().0.to_owned() + "\n").collect()
                }
                "junit.xml" => without_attribute(&text, " time=\""),
                "index.html" => without_start(&text),
                _ => text,
            };
            (path.strip_prefix(&root).unwrap().to_owned(), text)
        })
        .collect()
}

fn without_times(text: &str) -> String {
    fn strip(value: &mut Value, of_run: bool) {
        match value {
            Value::Object(table) => {
                table.remove("seconds");
                table.remove("start");
                if of_run {
                    table.remove("sha256");
                }
                table.values_mut().for_each(|value| strip(value, of_run));
            }
            Value::Array(items) => items.iter_mut().for_each(|value| strip(value, of_run)),
            _ => {}
        }
    }
    let mut value: Value = serde_json::from_str(text).unwrap();
    // The hashes of folders in a run are of files that hold times.
    let of_run = value["program"].is_string();
    strip(&mut value, of_run);
    value.to_string()
}

fn without_attribute(text: &str, name: &str) -> String {
    let mut parts = text.split(name);
    let first = parts.next().unwrap().to_owned();
    first + &parts.map(|part| part.split_once('"').unwrap().1).collect::<String>()
}

fn without_start(page: &str) -> String {
    let (before, after) = page.split_once("<dt>start</dt>").expect("the page says when the run started");
    before.to_owned() + after.split_once("</dd>").unwrap().1
}

#[test]
fn parts_make_one_run_byte_for_byte_but_for_times() {
    let place = parts();
    place.run(&MERGE).code(0);
    let merged = timeless(&place, "whole");
    fs::remove_dir_all(place.path("whole")).unwrap();
    place.run(&["run", "study.toml", "seven.toml", "--out", "whole"]).code(0);
    let single = timeless(&place, "whole");
    assert_eq!(merged.keys().collect::<Vec<_>>(), single.keys().collect::<Vec<_>>());
    for (path, text) in &merged {
        assert!(*text == single[path], "{} differs:\n{text}\n{}", path.display(), single[path]);
    }
    assert!(merged.len() > 30, "{}", merged.len());
    // What was merged is a run like any other.
    place.run(&["report", "--from", "whole"]).code(0);
    place.run(&["baseline", "save", "main", "--from", "whole"]).code(0);
}

#[test]
fn parts_are_stable_when_studies_are_added() {
    let place = place();
    let cases = |out: &str| -> Vec<String> {
        let mut found = Vec::new();
        for study in ["mine", "seven"] {
            if !place.path(&format!("{out}/{study}")).exists() {
                continue;
            }
            let results: Value =
                serde_json::from_str(&place.read(&format!("{out}/{study}/results.json"))).unwrap();
            let cases = results["studies"][0]["cases"].as_array().unwrap();
            found.extend(cases.iter().map(|case| format!("{study}/{}", case["id"])));
        }
        found
    };
    place.run(&["run", "seven.toml", "--shard", "2/3", "--out", "before"]).code(0);
    place.run(&["run", "study.toml", "seven.toml", "--shard", "2/3", "--out", "after"]).code(0);
    let (before, mut after) = (cases("before"), cases("after"));
    after.retain(|case| case.starts_with("seven"));
    assert_eq!(before, after);
}

/// More parts than cases: some are empty, which is no failure, and the whole is still one.
#[test]
fn empty_parts_count() {
    let place = Place::with_study(small());
    let mut merge = vec!["merge".to_owned()];
    for part in 1..=4 {
        let (shard, out) = (format!("{part}/4"), format!("part-{part}"));
        place.run(&["run", "study.toml", "--shard", &shard, "--out", &out]).code(0);
        merge.push(out);
    }
    let merge: Vec<&str> = merge.iter().map(String::as_str).collect();
    place.run(&merge).code(0);
    assert!(place.path("reports/mine/a.svg").is_file());
    place.refuses(&merge[..4], &["1 of 4 parts are missing: 4/4"]);
}

#[test]
fn what_does_not_make_one_run_is_refused_and_named() {
    let place = parts();
    place.refuses(&["merge", "part-1", "part-3", "--out", "whole"], &["1 of 3 parts are missing: 2/3"]);
    place.refuses(&["merge", "part-1", "part-1", "--out", "whole"], &["2 of 3 parts are missing: 2/3, 3/3"]);
    place.refuses(&["merge", "part-1", "part-2", "part-3", "--out", "part-1"], &["part-1", "--out as well"]);
    place.refuses(&["merge", "part-1", "nowhere", "--out", "whole"], &["nowhere holds no run"]);
    place.run(&["run", "study.toml", "--out", "plain"]).code(0);
    place.refuses(&["merge", "plain", "part-1"], &["plain is no part of a run"]);
    place.run(&["run", "study.toml", "--shard", "1/2", "--out", "half"]).code(0);
    place.refuses(&["merge", "part-1", "half"], &["part-1 is part 1/3", "half is part 1/2"]);
    let three = |extra: &[&str], words: &[&str]| {
        let all = ["run", "study.toml", "seven.toml", "--shard", "3/3", "--out", "other"];
        place.run(&[&all, extra].concat()).code(0);
        place.refuses(&["merge", "part-1", "part-2", "other"], words);
    };
    three(&["--profile", "full"], &["part-1 and other differ in their profile"]);
    three(&["--set", "case.b1.curve.0.m=2"], &["differ in their --set"]);
    if cfg!(target_arch = "x86_64") {
        let best = place.read("part-1/run.json").contains("\"instruction_set\": \"baseline\"");
        if !best {
            three(&["--isa", "baseline"], &["differ in their instruction set"]);
        }
    }
    place.run(&["run", "seven.toml", "--shard", "3/3", "--out", "other"]).code(0);
    place.refuses(&["merge", "part-1", "part-2", "other"], &["differ in their list of folders"]);
}

#[test]
fn a_part_that_was_edited_is_refused() {
    for file in ["b3.csv", "results.json", "dispersion_curves.csv", "b3.svg"] {
        let place = parts();
        let holder =
            (1..=PARTS).find(|part| place.path(&format!("part-{part}/seven/b3.csv")).exists()).unwrap();
        let path = format!("part-{holder}/seven/{file}");
        place.write(&path, place.read(&path).replacen('1', "2", 1));
        place.refuses(&MERGE, &["seven"]);
    }
}

/// The same part twice is no harm where it found the same, and refused where it did not.
#[test]
fn a_part_that_is_there_twice_must_be_the_same() {
    let place = parts();
    place.run(&["run", "study.toml", "seven.toml", "--shard", "2/3", "--out", "again"]).code(0);
    place.run(&["merge", "part-1", "part-2", "again", "part-3", "--out", "whole"]).code(0);
    // As if another machine had found another number: results that agree with their own run, not with the other.
    let folder = ["mine", "seven"].into_iter().find(|folder| place.path(&format!("again/{folder}")).exists());
    let path = format!("again/{}/results.json", folder.unwrap());
    let text = place.read(&path);
    let changed = text.replacen("\"verdict\": \"pass\"", "\"verdict\": \"fail\"", 1);
    assert!(text != changed);
    let hash = |text: &str| -> String {
        use sha2::{Digest, Sha256};
        Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect()
    };
    place.write("again/run.json", place.read("again/run.json").replace(&hash(&text), &hash(&changed)));
    place.write(&path, &changed);
    let merge = ["merge", "part-1", "part-2", "again", "part-3", "--out", "other"];
    place.refuses(&merge, &["is in part-2 and in again, with different results"]);
}

#[test]
fn what_is_no_part_is_a_usage_error() {
    let place = place();
    for shard in ["0/3", "4/3", "3", "a/b", "1/0"] {
        place.refuses(&["run", "study.toml", "--shard", shard], &["write k/n with 1 ≤ k ≤ n"]);
    }
    place.refuses(
        &["cost", "--advise", "--error", "0.1", "--wavelength", "1", "--shard", "1/2"],
        &["--shard"],
    );
}

/// The block of the README that follows a line which contains `heading`.
fn block(heading: &str) -> String {
    let readme = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md")).unwrap();
    let after = readme.split_once(heading).unwrap_or_else(|| panic!("the README has no {heading}")).1;
    let block = after.split("```").nth(1).unwrap();
    block.split_once('\n').unwrap().1.to_owned()
}

/// The job array of the README in a plain shell: its script for each task, then the merge.
#[cfg(unix)]
#[test]
fn the_job_array_of_the_readme_works_as_plain_commands() {
    let place = place();
    let script = block("job array:").replace("pd-verify report", "pd-verify run study.toml seven.toml");
    assert!(script.contains("#SBATCH --array=1-8") && script.contains("--shard"), "{script}");
    place.write("array.sh", &script);
    let binary = PathBuf::from(env!("CARGO_BIN_EXE_pd-verify"));
    let path = format!("{}:{}", binary.parent().unwrap().display(), std::env::var("PATH").unwrap());
    for task in 1..=8 {
        let mut shell = Command::new("sh");
        shell.current_dir(place.path("")).env("PATH", &path).arg("array.sh");
        shell.env("SLURM_ARRAY_TASK_ID", task.to_string()).env("SLURM_ARRAY_TASK_COUNT", "8");
        shell.env("SLURM_CPUS_PER_TASK", "1").env_remove("GITHUB_STEP_SUMMARY");
        let output = shell.output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    let merge = script.lines().find(|line| line.contains("pd-verify merge")).unwrap();
    let merge = &merge[merge.find("pd-verify").unwrap()..];
    let output = Command::new("sh")
        .current_dir(place.path(""))
        .env("PATH", &path)
        .args(["-c", merge])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(place.path("reports/seven/results.json").is_file() && place.path("reports/index.html").is_file());
}

/// The commands of the matrix of GitHub, for two of its parts.
#[cfg(unix)]
#[test]
fn the_matrix_of_the_readme_works_as_plain_commands() {
    let place = place();
    let workflow = block("matrix on GitHub:");
    let commands: Vec<&str> = workflow
        .lines()
        .filter_map(|line| line.trim().strip_prefix("- run: "))
        .filter(|line| line.starts_with("pd-verify"))
        .collect();
    let [run, merge] = commands[..] else { panic!("{workflow}") };
    let binary = PathBuf::from(env!("CARGO_BIN_EXE_pd-verify"));
    let path = format!("{}:{}", binary.parent().unwrap().display(), std::env::var("PATH").unwrap());
    let count = workflow.split("part: [").nth(1).unwrap().split(']').next().unwrap().split(',').count();
    let shell = |line: String| {
        let mut shell = Command::new("sh");
        shell.current_dir(place.path("")).env("PATH", &path).args(["-c", &line]);
        let output = shell.env_remove("GITHUB_STEP_SUMMARY").output().unwrap();
        assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    };
    for part in 1..=count {
        let line = run.replace("${{ matrix.part }}", &part.to_string());
        assert!(!line.contains("${{"), "{line}");
        // Not every machine that tests has these instructions.
        shell(
            line.replace(" --isa avx2", "")
                .replace("pd-verify report", "pd-verify run study.toml seven.toml"),
        );
    }
    shell(merge.to_owned());
    assert!(place.path("reports/index.html").is_file());
}
