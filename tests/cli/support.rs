//! A folder of one's own, the program run in it, and small studies to give it.

use assert_cmd::Command;
use assert_cmd::assert::Assert;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Head of a study of aluminium called `mine`.
pub const HEAD: &str = r#"format = 1
id = "mine"
kind = "dispersion"
title = "Aluminium"

[material]
youngs_modulus_gpa = 70
density_kg_m3 = 2700
"#;

/// A case of one curve on a bar's lattice.
pub const CASE: &str = r#"
[[case]]
id = "a"
asks = "curves"
body = "bar"
wavenumbers = { to_per_m = 1500, count = 20 }
[[case.curve]]
scheme = "lattice"
kernel = "gaussian"
p = 1.5
m = 3
dx_mm = 1
volume_rule = "linear"
"#;

/// A study of one small case.
pub fn small() -> String {
    format!("{HEAD}{CASE}")
}

/// The small study with one piece of text replaced, which must be there.
pub fn small_with(old: &str, new: &str) -> String {
    let text = small();
    assert!(text.contains(old), "the study has no {old}");
    text.replacen(old, new, 1)
}

/// A folder to run the program in.
pub struct Place {
    folder: TempDir,
}

impl Place {
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    /// A folder that holds `study.toml`.
    pub fn with_study(text: impl AsRef<[u8]>) -> Self {
        let place = Self::new();
        place.write("study.toml", text);
        place
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The program, here, with these arguments.
    pub fn program(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pd-verify"));
        command.current_dir(self.folder.path()).args(arguments);
        command.env_remove("GITHUB_STEP_SUMMARY").env_remove("NO_COLOR");
        command.timeout(std::time::Duration::from_secs(60));
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Assert {
        self.program(arguments).assert()
    }

    /// Everything below this folder, hidden files too, and what is in it.
    pub fn contents(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        below(self.folder.path())
    }

    /// Runs, expects a refusal that says all of `words`, and that nothing was touched.
    pub fn refuses(&self, arguments: &[&str], words: &[&str]) {
        let before = self.contents();
        let assert = self.run(arguments).code(2).stdout("");
        let said = String::from_utf8_lossy(&assert.get_output().stderr).into_owned();
        let unwrapped = unwrap(&said);
        for word in words {
            assert!(unwrapped.contains(word), "{arguments:?}: no \"{word}\" in\n{said}");
        }
        assert!(!said.contains("panicked"), "{said}");
        assert!(said.len() < 4000, "{} characters are no message", said.len());
        assert_eq!(self.contents(), before, "a refusal touched files");
    }
}

/// A message without its line breaks.
fn unwrap(message: &str) -> String {
    let lines = message.lines().map(|line| line.trim().trim_start_matches("│ ").trim());
    lines.collect::<Vec<_>>().join(" ")
}

fn below(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if path.is_dir() {
            found.extend(below(&path));
            found.insert(path, Vec::new());
        } else {
            let bytes = fs::read(&path).unwrap();
            found.insert(path, bytes);
        }
    }
    found
}

/// Rows of a CSV by column name.
pub fn rows(text: &str) -> Vec<BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    reader.deserialize().map(Result::unwrap).collect()
}
