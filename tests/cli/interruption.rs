//! Ctrl-C: the run ends with 130, what was finished is kept, nothing half-written stays.

use crate::support::{HEAD, Place, rows, small};
use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

fn interrupt(child: &Child) {
    let done = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(done.success());
}

/// Thousands of small cases: a long run with many places to stop.
fn long() -> String {
    let case = |n: usize| format!("[[case]]\nid = \"a{n}\"\nasks = \"small_p\"\n");
    format!("{}{}", HEAD.replace("mine", "long"), (0..20_000).map(case).collect::<String>())
}

#[test]
fn what_was_finished_is_kept() {
    let place = Place::with_study(small());
    place.write("long.toml", long());
    let mut command = Command::new(env!("CARGO_BIN_EXE_pd-verify"));
    command.current_dir(place.path("")).args(["run", "study.toml", "long.toml"]);
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    // The first study is written when the second has begun.
    while !place.path("reports/mine/manifest.json").exists() {
        assert!(child.try_wait().unwrap().is_none(), "ended before it could be interrupted");
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_millis(100));
    interrupt(&child);
    let said: Vec<String> =
        BufReader::new(child.stderr.take().unwrap()).lines().map(Result::unwrap).collect();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(said.iter().any(|line| line.contains("interrupted")), "{said:?}");
    let verdicts = rows(&place.read("reports/verdicts.csv"));
    let mine = verdicts.iter().filter(|row| row["study"] == "mine").count();
    assert_eq!(mine, 3);
    assert!(verdicts.len() < 20_000, "nothing was left out");
    for folder in ["reports", "reports/mine"] {
        for entry in fs::read_dir(place.path(folder)).unwrap().map(Result::unwrap) {
            let name = entry.file_name().into_string().unwrap();
            assert!(!name.starts_with('.'), "{name} was left behind");
        }
    }
}
