//! Tells the program which commit and which compiler it was made with; both go into every manifest.

use std::path::Path;
use std::process::Command;

fn main() {
    let watched = [
        ".git/HEAD",
        ".git/index",
        ".git/logs/HEAD",
        "src",
        "studies",
        "reference",
        "Cargo.toml",
        "Cargo.lock",
    ];
    for path in watched.iter().filter(|path| Path::new(path).exists()) {
        println!("cargo::rerun-if-changed={path}");
    }
    let here = Path::new(".git").exists();
    let commit = if here { output("git", &["rev-parse", "HEAD"]) } else { packaged_commit() };
    let modified = here.then(|| output("git", &["status", "--porcelain", "--untracked-files=no"])).flatten();
    println!("cargo::rustc-env=PD_VERIFY_COMMIT={}", commit.clone().unwrap_or_default());
    let modified = if here && commit.is_some() { (modified.is_some()).to_string() } else { String::new() };
    println!("cargo::rustc-env=PD_VERIFY_MODIFIED={modified}");
    let compiler = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".into());
    println!("cargo::rustc-env=PD_VERIFY_RUSTC={}", output(&compiler, &["--version"]).unwrap_or_default());
    println!("cargo::rustc-env=PD_VERIFY_TARGET={}", std::env::var("TARGET").unwrap_or_default());
}

/// What a command prints, if it succeeds and prints anything.
fn output(program: &str, arguments: &[&str]) -> Option<String> {
    let output =
        Command::new(program).args(arguments).output().ok().filter(|output| output.status.success())?;
    let text = String::from_utf8(output.stdout).ok()?.trim().to_owned();
    (!text.is_empty()).then_some(text)
}

/// The commit that a packaged crate was made from.
fn packaged_commit() -> Option<String> {
    let text = std::fs::read_to_string(".cargo_vcs_info.json").ok()?;
    let (_, rest) = text.split_once("\"sha1\": \"")?;
    rest.split_once('"').map(|(commit, _)| commit.to_owned())
}
