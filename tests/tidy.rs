//! Rules of the house that a machine can check: the order of the rooms, first lines, no printing in the library.

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn files(folder: &str, ending: &str) -> Vec<PathBuf> {
    let mut found = every_file(folder);
    found.retain(|path| path.extension().is_some_and(|found| found == ending));
    assert!(!found.is_empty(), "{folder} has no .{ending} files: the check would be empty");
    found
}

/// Files below a folder but for what the compiler makes.
fn every_file(folder: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if !entry.is_dir() {
                found.push(entry);
            } else if entry.file_name().is_some_and(|name| name != "target") {
                folders.push(entry);
            }
        }
    }
    found
}

/// Lines of code of a file, without comments.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
}

fn offenders(folder: &str, forbidden: &[&str]) -> Vec<String> {
    let mut found = Vec::new();
    for path in files(folder, "rs") {
        let code = code(&path);
        found.extend(
            forbidden
                .iter()
                .filter(|word| code.contains(**word))
                .map(|word| format!("{}: {word}", path.display())),
        );
    }
    found
}

#[test]
fn the_library_sees_no_answer_no_study_no_file_and_does_not_print() {
    let forbidden = [
        "pd_verify_reference",
        "std::fs",
        "std::env",
        "std::process",
        "println!",
        "eprintln!",
        "dbg!",
        "crate::studies",
    ];
    assert_eq!(offenders("src", &forbidden), Vec::<String>::new());
}

/// What must promise more than the compiler can see says so in few places, each with its reason.
#[test]
fn unsafe_code_stays_where_it_pays() {
    let allowed = [
        "src/simd/",
        "src/forces/sink.rs",
        "src/forces/breakable.rs",
        "src/forces/stencil/",
        "src/march/pass.rs",
        "src/march/shared.rs",
        "studies/allocator.rs",
        "studies/bench/fma.rs",
        "studies/bench/triad.rs",
    ];
    let mut found = 0;
    for path in ["src", "studies", "reference/src"].into_iter().flat_map(|folder| files(folder, "rs")) {
        let within = path.strip_prefix(root()).unwrap().to_string_lossy().into_owned();
        let code = code(&path);
        if code.contains("unsafe ") {
            found += 1;
            assert!(allowed.iter().any(|place| within.starts_with(place)), "{within}: unsafe code");
            let text = fs::read_to_string(&path).unwrap();
            assert!(text.contains("SAFETY") || text.contains("# Safety"), "{within}: no reason given");
        }
    }
    assert!(found > 5, "the check would be empty");
}

#[test]
fn the_reference_cannot_see_the_solver() {
    let manifest = fs::read_to_string(root().join("reference/Cargo.toml")).unwrap();
    let dependencies = manifest.split_once("[dependencies]").expect("a list of dependencies").1;
    let own: Vec<&str> = dependencies.lines().filter(|line| line.contains('=')).collect();
    assert!(
        own.iter().all(|line| line.starts_with("libm")),
        "the reference depends on more than libm: {own:?}"
    );
    assert_eq!(offenders("reference/src", &["pd_verify::", "std::fs", "println!"]), Vec::<String>::new());
}

#[test]
fn rooms_are_entered_in_order() {
    // A body knows no forces of a report; answers to reports come last.
    for (file, forbidden) in [
        ("kernel.rs", vec!["crate::lattice", "crate::dispersion", "crate::report", "crate::claim"]),
        ("material.rs", vec!["crate::lattice", "crate::dispersion", "crate::report", "crate::claim"]),
        ("lattice.rs", vec!["crate::dispersion", "crate::report", "crate::claim"]),
        ("verdict.rs", vec!["crate::report", "crate::dispersion", "crate::lattice"]),
    ] {
        let code = code(&root().join("src").join(file));
        let wrong: Vec<_> = forbidden.iter().filter(|word| code.contains(**word)).collect();
        assert!(wrong.is_empty(), "src/{file} uses {wrong:?}");
    }
    assert_eq!(
        offenders("src/dispersion", &["crate::report", "crate::claim", "crate::verdict"]),
        Vec::<String>::new()
    );
    // Stress intensity factors are functions of data: they know no body that moves.
    let moving =
        ["crate::model", "crate::march", "crate::scene", "crate::record", "crate::report", "crate::claim"];
    assert_eq!(offenders("src/stress_intensity", &moving), Vec::<String>::new());
}

#[test]
fn only_one_file_calls_plotters() {
    let callers: Vec<_> =
        files("src", "rs").into_iter().filter(|path| code(path).contains("plotters::")).collect();
    assert_eq!(callers, [root().join("src/report/plot/canvas.rs")]);
}

#[test]
fn every_file_says_first_what_is_in_it_and_fits_a_head() {
    for folder in ["src", "studies", "reference/src", "reference/tests", "tests"] {
        for path in files(folder, "rs") {
            let text = fs::read_to_string(&path).unwrap();
            let first = text.lines().next().unwrap_or_default();
            assert!(
                first.starts_with("//! ") && first.len() > 12,
                "{}: starts with {first:?}",
                path.display()
            );
            let lines = text.lines().count();
            assert!(lines <= 400, "{} has {lines} lines, at most 400 fit a head", path.display());
        }
    }
}

#[test]
fn nothing_is_left_unfinished_or_switched_off() {
    let marks = [
        concat!("to", "do!("),
        concat!("unimple", "mented!("),
        concat!("#[ig", "nore"),
        concat!("FIX", "ME"),
        concat!("TO", "DO"),
    ];
    for folder in ["src", "studies", "reference", "tests"] {
        assert_eq!(offenders(folder, &marks), Vec::<String>::new());
    }
}

/// Files of the tree whose endings are in use; an editor's left-over has another.
fn belongs(path: &Path) -> bool {
    const ENDINGS: [&str; 10] = ["rs", "toml", "svg", "html", "css", "js", "csv", "md", "py", "txt"];
    const NAMES: [&str; 3] = [".gitignore", "Cargo.lock", "requirements.txt"];
    let ending = path.extension().is_some_and(|found| ENDINGS.iter().any(|ending| found == *ending));
    ending || path.file_name().is_some_and(|found| NAMES.iter().any(|name| found == *name))
}

#[test]
fn nothing_is_left_over() {
    for left in ["surface.rs.orig", "surface.rs~", ".surface.rs.swp", "fix.patch", "notes", "x.rej"] {
        assert!(!belongs(Path::new(left)), "{left}");
    }
    for folder in ["src", "studies", "reference", "tests"] {
        let mut left = every_file(folder);
        left.retain(|path| !belongs(path));
        assert_eq!(left, Vec::<PathBuf>::new());
    }
}

#[test]
fn the_changelog_names_this_version() {
    let changelog = fs::read_to_string(root().join("CHANGELOG.md")).unwrap();
    assert!(
        changelog.contains(&format!("## {}", env!("CARGO_PKG_VERSION"))),
        "CHANGELOG.md lacks this version"
    );
    let citation = fs::read_to_string(root().join("CITATION.cff")).unwrap();
    assert!(
        citation.contains(&format!("version: {}", env!("CARGO_PKG_VERSION"))),
        "CITATION.cff lacks this version"
    );
}
