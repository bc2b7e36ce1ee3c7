//! Every file of the fuzzer's corpus, and every shipped study, read and planned once more.

use super::exercise::{Became, exercise};
use crate::shipped::SHIPPED;
use std::fs;
use std::path::Path;

#[test]
fn every_file_of_the_corpus_is_refused_or_planned() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/corpus/study");
    let (mut refused, mut planned) = (0, 0);
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let became = exercise(&fs::read(&path).unwrap());
        // Names say what must become of a file.
        match became {
            Became::Planned { .. } => planned += 1,
            Became::Refused | Became::NoText => refused += 1,
        }
        let well_meant = name.starts_with("plain-");
        assert_eq!(matches!(became, Became::Planned { .. }), well_meant, "{name} became {became:?}");
    }
    assert!(refused > 30 && planned > 5, "{refused} refused, {planned} planned");
}

#[test]
fn every_shipped_study_is_planned() {
    let scenes = |text: &str| match exercise(text.as_bytes()) {
        Became::Planned { scenes } => scenes,
        other => panic!("a shipped study became {other:?}"),
    };
    let all: usize = SHIPPED.iter().map(|(_, text)| scenes(text)).sum();
    assert!(all > 1000, "{all} scenes");
}
