//! Studies that ask for more than anybody means are refused at once, not computed for hours.

use crate::support::{CASE, HEAD, Place, small, small_with};

fn list(count: usize, step: f64) -> String {
    let values: Vec<String> = (0..count).map(|n| (1.0 + n as f64 * step).to_string()).collect();
    format!("[{}]", values.join(", "))
}

/// A continuum in place of the lattice.
fn continuum() -> String {
    small_with("\"lattice\"", "\"continuum\"")
        .replace("m = 3\ndx_mm = 1\nvolume_rule = \"linear\"", "horizon_mm = 3")
}

#[test]
fn a_thousand_million_curves() {
    let long =
        small_with("m = 3\ndx_mm = 1", &format!("m = {}\ndx_mm = {}", list(1000, 0.01), list(1000, 0.01)))
            .replace("p = 1.5", &format!("p = {}", list(1000, 0.001)));
    Place::with_study(long).refuses(&["run", "study.toml"], &["1000000000 combinations", "at most 100000"]);
}

#[test]
fn rows_without_end() {
    for count in ["999999999999", "9223372036854775807"] {
        let text = small_with("count = 20", &format!("count = {count}"));
        Place::with_study(text)
            .refuses(&["run", "study.toml"], &["study.toml:14:", "rows are asked for", "fewer"]);
    }
}

#[test]
fn kernels_and_waves_that_no_quadrature_resolves() {
    let narrow = continuum().replace("p = 1.5", "p = 1e9");
    Place::with_study(narrow)
        .refuses(&["run", "study.toml"], &["study.toml:18:", "p = 1000000000", "at most 100"]);
    let narrow =
        format!("{HEAD}\n[[case]]\nid = \"a\"\nasks = \"micromodulus\"\nkernel = \"gaussian\"\np = 1e9\n");
    Place::with_study(narrow).refuses(&["run", "study.toml"], &["p = 1000000000", "at most 100"]);
    let short = continuum().replace("to_per_m = 1500", "to_per_m = 1e12");
    Place::with_study(short)
        .refuses(&["run", "study.toml"], &["study.toml:14:", "wavelengths in the horizon", "smaller"]);
}

#[test]
fn a_file_beyond_four_mebibytes() {
    let long = format!("{}# {}", small(), "x".repeat(4 << 20));
    Place::with_study(long).refuses(&["run", "study.toml"], &["study.toml", "4194304", "split"]);
}

#[cfg(unix)]
#[test]
fn a_file_without_end() {
    Place::new().refuses(&["run", "/dev/zero"], &["/dev/zero", "4194304"]);
}

#[test]
fn a_hundred_thousand_cases_are_read() {
    let case = |n: usize| format!("[[case]]\nid = \"a{n}\"\nasks = \"small_p\"\n");
    let cases: String = (0..90_000).map(case).collect();
    // The last one is wrong, so that all are read.
    let text = format!("{HEAD}{cases}{CASE}{CASE}");
    Place::with_study(text).refuses(&["run", "study.toml"], &["two cases are called \"a\""]);
}

#[test]
fn twenty_thousand_curves_are_planned() {
    let text = continuum().replace("horizon_mm = 3", &format!("horizon_mm = {}", list(20_000, 0.001)));
    Place::with_study(text).run(&["plan", "study.toml"]).success();
}
