//! Where results go: what is ours is replaced whole, what is somebody else's is left alone.

use crate::support::{Place, small};
use predicates::str::contains;
use std::fs;

#[test]
fn inputs_that_are_no_files() {
    let place = Place::new();
    place.refuses(&["run", "nowhere.toml"], &["cannot read nowhere.toml", "path of a study file"]);
    fs::create_dir(place.path("folder")).unwrap();
    place.refuses(&["run", "folder"], &["cannot read folder", "directory"]);
    place.refuses(&["dispersion", "nowhere.toml"], &["cannot read nowhere.toml"]);
    place.refuses(&["plan", "nowhere.toml"], &["cannot read nowhere.toml", "pd-verify list"]);
    // `run` takes no ids; the cure must not send one round in a circle.
    place.refuses(&["run", "dispersion-bar"], &["cannot read dispersion-bar", "pd-verify dispersion"]);
}

#[test]
fn two_studies_of_one_id() {
    let place = Place::with_study(small());
    place.write("other.toml", small());
    place.refuses(
        &["run", "study.toml", "other.toml"],
        &["other.toml:2:", "id of another study", "another id"],
    );
    place.refuses(&["run", "study.toml", "study.toml"], &["id of another study"]);
}

#[test]
fn places_that_cannot_be_written() {
    let place = Place::with_study(small());
    place.write("file", "");
    for out in ["file", "file/below", "/proc/x"] {
        place.refuses(&["run", "study.toml", "--out", out], &[out, "cannot write", "--out DIR"]);
    }
}

#[test]
fn folders_of_somebody_else() {
    let place = Place::with_study(small());
    place.write("out/mine/thesis.tex", "years of work");
    place.refuses(
        &["run", "study.toml", "--out", "out"],
        &["out/mine", "not a folder of results", "--out DIR"],
    );
    place.write("file/mine", "a file in the way");
    place.refuses(&["run", "study.toml", "--out", "file"], &["file/mine", "not a folder of results"]);
    // Web applications have a manifest.json too.
    place.write("web/mine/manifest.json", "{\"name\": \"An app\", \"version\": \"2\"}");
    place.write("web/mine/app.js", "code");
    place.refuses(&["run", "study.toml", "--out", "web"], &["web/mine", "not a folder of results"]);
}

#[test]
fn files_of_somebody_else() {
    for name in ["index.html", "summary.md", "junit.xml", "verdicts.csv"] {
        let place = Place::with_study(small());
        place.write(&format!("site/{name}"), "my own");
        place.refuses(&["run", "study.toml", "--out", "site"], &[name, "not of a run", "--out DIR"]);
    }
}

#[test]
fn results_replace_those_of_an_earlier_run() {
    let place = Place::with_study(small());
    place.run(&["run", "study.toml"]).code(0);
    let fresh: Vec<_> = place.contents().into_keys().collect();
    place.write("reports/mine/leftover.csv", "old");
    place.run(&["run", "study.toml"]).code(0);
    assert_eq!(place.contents().into_keys().collect::<Vec<_>>(), fresh);
}

#[test]
fn stale_folders_are_kept_but_not_counted() {
    let place = Place::with_study(small());
    place.write("other.toml", small().replace("\"mine\"", "\"elsewhere\""));
    place.run(&["run", "other.toml"]).code(0);
    place.run(&["run", "study.toml"]).code(0);
    assert!(place.path("reports/elsewhere/verdicts.csv").is_file());
    for file in ["index.html", "summary.md", "junit.xml", "verdicts.csv"] {
        assert!(
            !place.read(&format!("reports/{file}")).contains("elsewhere"),
            "{file} counts a stale folder"
        );
    }
}

#[cfg(unix)]
#[test]
fn a_folder_that_may_not_be_written_to_run_from() {
    use std::os::unix::fs::PermissionsExt;
    let place = Place::with_study(small());
    fs::create_dir(place.path("locked")).unwrap();
    place.write("locked/study.toml", small());
    fs::set_permissions(place.path("locked"), fs::Permissions::from_mode(0o555)).unwrap();
    let mut command = place.program(&["run", "study.toml", "--out", "../out"]);
    command.current_dir(place.path("locked")).assert().code(0);
    // The superuser may write anywhere; for everybody else the default folder is refused.
    let mut command = place.program(&["run", "study.toml"]);
    let assert = command.current_dir(place.path("locked")).assert();
    if !place.path("locked/reports").exists() {
        assert.code(2).stderr(contains("cannot write to reports"));
    }
    fs::set_permissions(place.path("locked"), fs::Permissions::from_mode(0o755)).unwrap();
}
