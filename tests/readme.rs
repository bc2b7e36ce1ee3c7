//! The README is true: its picture is what the program draws, its study runs, its commands exist.

use assert_cmd::Command;
use std::fs;
use std::path::Path;

fn readme() -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).unwrap()
}

fn program() -> Command {
    Command::cargo_bin("pd-verify").unwrap()
}

#[test]
fn the_pictures_are_what_the_program_draws() {
    let folder = tempfile::tempdir().unwrap();
    for (kind, drawn, shown) in [("dispersion", "polar", "polar"), ("bar", "release-source", "release")] {
        let run = [kind, "--quiet", "--profile", "quick", "--out"];
        program().args(run).arg(folder.path()).assert().success();
        let drawn = fs::read_to_string(folder.path().join(kind).join(drawn).with_extension("svg")).unwrap();
        let shown = format!("studies/pictures/{shown}.svg");
        assert!(readme().contains(&format!("({shown})")));
        let kept = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(&shown)).unwrap();
        assert!(kept == drawn, "copy the figure of a run to {shown}");
    }
}

#[test]
fn the_studies_in_it_run() {
    let text = readme();
    let studies: Vec<&str> =
        text.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    let results = [
        "my-aluminium/dispersion_curves.csv",
        "pulled-bar/probes.csv",
        "let-go/bar_strain.csv",
        "my-crack/dsif_history.csv",
    ];
    assert_eq!(studies.len(), results.len());
    let folder = tempfile::tempdir().unwrap();
    for (study, result) in studies.into_iter().zip(results) {
        let file = folder.path().join("study.toml");
        fs::write(&file, study).unwrap();
        program().arg("run").arg(&file).arg("--out").arg(folder.path().join("out")).assert().success();
        assert!(folder.path().join("out").join(result).is_file());
    }
}

#[test]
fn its_commands_for_speed_run() {
    let text = readme();
    let one = text.lines().find(|line| line.starts_with("pd-verify bench --nodes")).unwrap();
    let said = program().args(one.split_whitespace().skip(1)).assert().success();
    let json: serde_json::Value = serde_json::from_slice(&said.get_output().stdout).unwrap();
    assert_eq!(
        (&json["nodes"], &json["operator"], &json["threads"]),
        (&512.into(), &"bonds".into(), &1.into())
    );
    assert!(text.lines().any(|line| line == "pd-verify bench"));
    program().args(["bench", "--help"]).assert().success();
}

#[test]
fn its_commands_for_other_codes_run() {
    let text = readme();
    let (_, section) = text.split_once("## Check your own code\n").unwrap();
    let block = section.split("```sh\n").nth(1).unwrap().split("```").next().unwrap();
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(block.lines().count(), 3);
    for command in block.lines() {
        program().current_dir(folder.path()).args(command.split_whitespace().skip(1)).assert().success();
    }
}

#[test]
fn its_advice_is_what_comes_out() {
    let text = readme();
    let command = text.lines().find(|line| line.starts_with("pd-verify cost --advise")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let said = program()
        .args(command.split_whitespace().skip(1))
        .args(["--json", "--out"])
        .arg(folder.path())
        .assert()
        .success();
    let json: serde_json::Value = serde_json::from_slice(&said.get_output().stdout).unwrap();
    let over = json["settings"][0]["bond_updates_per_m2_s"].as_f64().unwrap()
        / json["unbound"]["bond_updates_per_m2_s"].as_f64().unwrap();
    let row = text.lines().find(|line| line.starts_with("| 1 % |")).unwrap();
    assert!(row.contains(&format!("{over:.1} times")), "{over}: {row}");
}

#[test]
fn its_commands_and_options_exist() {
    let text = readme();
    for command in [
        "dispersion",
        "bar",
        "bench",
        "cost",
        "run",
        "list",
        "explain",
        "report",
        "merge",
        "compare",
        "check",
        "selftest",
        "plan",
        "schema",
        "completions",
    ] {
        assert!(text.contains(command), "the README does not name {command}");
        program().args([command, "--help"]).assert().success();
    }
    let help = program().args(["run", "--help"]).output().unwrap();
    let help = String::from_utf8(help.stdout).unwrap();
    let options = ["--out", "--profile", "--set", "--strict", "--threads", "--quiet", "--no-progress"];
    for option in options.into_iter().chain(["--shard", "--resume", "--rerun-failed"]) {
        assert!(text.contains(option) && help.contains(option), "{option}");
    }
}
