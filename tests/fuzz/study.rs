//! Any bytes are a study or a refusal that can be printed; nothing panics, nothing loops.

#![no_main]

#[path = "../../studies/input/mod.rs"]
#[allow(dead_code, unused_imports)]
mod input;

use input::{Document, OneOrMany, Setting};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let mut document = match Document::parse("study.toml", text) {
        Ok(document) => document,
        Err(refusal) => return drop(format!("{:?}", miette::Report::new(refusal))),
    };
    // The first line once more, as a change from the command line.
    if let Ok(setting) = Setting::parse(text.lines().next().unwrap_or_default()) {
        let _ = document.set(&setting);
    }
    let cases = document.get("case").cloned().unwrap_or_default();
    if let Err(refusal) = document.read::<OneOrMany<f64>>("case", &cases, &["id"]) {
        drop(format!("{:?}", miette::Report::new(refusal)));
    }
});
