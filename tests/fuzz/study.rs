//! Any bytes are a study that can be planned or a refusal that can be printed; nothing panics, nothing loops.
//!
//! The program's modules that read and plan stand here as they stand in `studies/main.rs`: what runs, prints and writes is
//! left out.

#![no_main]
#![allow(dead_code, unused_imports)]

#[path = "../../studies/afford.rs"]
mod afford;
#[path = "../../studies/attachment.rs"]
mod attachment;
#[path = "../../studies/bar/mod.rs"]
mod bar;
#[path = "../../studies/convergence/mod.rs"]
mod convergence;
#[path = "../../studies/cost/mod.rs"]
mod cost;
#[path = "../../studies/dispersion/mod.rs"]
mod dispersion;
#[path = "../../studies/dsif/mod.rs"]
mod dsif;
mod exercise;
#[path = "../../studies/foreign/mod.rs"]
mod foreign;
#[path = "../../studies/input/mod.rs"]
mod input;
#[path = "../../studies/kind.rs"]
mod kind;
#[path = "../../studies/levels.rs"]
mod levels;
#[path = "../../studies/machine.rs"]
mod machine;
#[path = "../../studies/median.rs"]
mod median;
#[path = "../../studies/question.rs"]
mod question;
#[path = "../../studies/rounded.rs"]
mod rounded;
#[path = "../../studies/scene/mod.rs"]
mod scene;
#[path = "../../studies/stability/mod.rs"]
mod stability;
#[path = "../../studies/study.rs"]
mod study;
#[path = "../../studies/subject.rs"]
mod subject;
#[path = "../../studies/written.rs"]
mod written;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    exercise::exercise(bytes);
});
