//! What is written comes back whole: pages made from what was read are those made from what was found.

use super::page::{Kept, summary};
use super::read::{Source, earlier};
use super::write::Writer;
use super::*;
use crate::attachment::Attachment;
use crate::manifest::StudyHash;
use crate::output::Output;
use crate::run::Ran;
use pd_verify::claim::{Basis, Claim, ErrorKind, Expectation, Relation};
use pd_verify::report::plot::{Axis, Figure, Lines, Series};
use pd_verify::report::{index_html, junit_xml, summary_markdown, verdicts_csv};
use pd_verify::table;
use pd_verify::verdict::{Evidence, ObservedOrder, Verdict, judge};
use std::path::Path;

fn claim(name: &str, relation: Relation, expectation: Expectation) -> Claim {
    Claim {
        id: format!("mine/a/{name}"),
        study: "mine".into(),
        case: "a".into(),
        quantity: "speed, \"as <b>seen</b>\"\nin ω".into(),
        unit: "m/s".into(),
        error_kind: ErrorKind::Relative,
        relation,
        tolerance: 0.1 + 0.2,
        basis: Basis::Theory,
        because: "because".into(),
        expected_order: Some(f64::NAN),
        expectation,
        source: "by hand".into(),
    }
}

/// One claim for each verdict, and numbers that JSON does not have.
fn judged() -> Vec<Judged> {
    let text = |text: &str| Some(text.to_owned());
    let error = |error| Evidence { error: Some(error), seconds: Some(0.1), ..Evidence::default() };
    let broken = || Expectation::Broken("a factor is missing".into());
    let order = ObservedOrder { value: f64::NAN, interval: Some((f64::NEG_INFINITY, -0.0)), levels: 4 };
    let at_most = |name, expectation| claim(name, Relation::AtMost, expectation);
    vec![
        judge(at_most("p", Expectation::Holds), Evidence { order: Some(order), ..error(5e-324) }),
        judge(at_most("f", Expectation::Holds), error(f64::INFINITY)),
        judge(at_most("i", Expectation::Holds), Evidence { computed: Some(f64::NAN), ..error(f64::NAN) }),
        judge(at_most("xf", broken()), error(1.0 / 3.0)),
        judge(at_most("xp", broken()), error(-0.0)),
        judge(
            claim("e", Relation::Within, Expectation::Holds),
            Evidence { failed: text("broke"), ..error(1.0) },
        ),
        judge(claim("s", Relation::Equal, Expectation::Holds), Evidence { skipped: text("m"), ..error(1.0) }),
        judge(
            claim("o", Relation::AtLeast, Expectation::Holds),
            Evidence { outside: text("o"), ..error(1.0) },
        ),
    ]
}

fn ran() -> Ran {
    let series = Series::line("lattice", vec![(0.0, 0.0), (1.0, 0.9)]);
    let panel = Lines::new(Axis::linear("k"), Axis::linear("ω"), vec![series]);
    let mut rows = table::Table::new("rows.csv", &["a", "b"]);
    rows.push(vec![1.0.into(), "two\nlines".into()]);
    Ran {
        judged: judged(),
        tables: vec![rows],
        figures: vec![Figure::new("a", "A figure", "With <b> & caption.", panel)],
        files: vec![Attachment::text("a.note.txt", "note")],
        seconds: 0.25,
        failed: true,
    }
}

fn manifest() -> Manifest {
    let studies = vec![StudyHash::new("mine", "mine.toml", "x")];
    Manifest::of_this_run("quick".into(), vec!["a=1".into()], None, studies)
}

/// Writes a folder and its run; returns what was in memory.
fn written(root: &Path) -> (Run, Kept) {
    let output = Output::open(root, &["mine".into()]).unwrap();
    let mut writer = Writer::new(&output, "mine", manifest(), None);
    let [id, kind, title, text, source] = ["mine", "scene", "T <i>", "One.\n\nTwo.", "S"].map(str::to_owned);
    let order = vec!["a".into(), "never-run".into()];
    writer.study(StudyResults { id, kind, title, text, source, order, cases: Vec::new() });
    writer.case("a", "hash".into(), ran());
    let (folder, placed) = writer.finish();
    let (place, sha256) = placed.unwrap();
    let run = Run {
        format: FORMAT,
        program: "pd-verify".into(),
        manifest: manifest(),
        shard: None,
        complete: true,
        order: vec!["mine".into()],
        folders: vec![File { name: "mine".into(), sha256 }],
    };
    output.replace_file(RUN, &run.json()).unwrap();
    (run, Kept { folder, place: Some(place) })
}

#[test]
fn what_is_read_gives_the_pages_of_what_was_found() {
    let root = tempfile::tempdir().unwrap();
    let (run, kept) = written(root.path());
    let back = earlier(root.path()).unwrap();
    let verdicts: Vec<Verdict> = back.folders[0].folder.judged().map(|one| one.verdict).collect();
    assert!(Verdict::ALL.iter().all(|verdict| verdicts.contains(verdict)), "{verdicts:?}");
    let Source { place, folder, .. } = back.folders.into_iter().next().unwrap();
    assert_eq!(
        format!("{folder:?}"),
        format!("{:?}", kept.folder),
        "NaN is printed, and not equal to itself"
    );
    let pages = |run: &Run, kept: Kept| {
        let summary = summary(run, vec![kept]);
        let judged: Vec<Judged> = summary.judged().cloned().collect();
        [index_html(&summary), summary_markdown(&summary), junit_xml(&summary), verdicts_csv(&judged)]
    };
    let found = pages(&run, kept);
    assert!(found[0].contains("<svg") && found[0].contains("not a number"));
    assert_eq!(pages(&back.run, Kept { folder, place: Some(place) }), found);
}

#[test]
fn rows_and_files_are_found_again_and_changed_ones_are_noticed() {
    let root = tempfile::tempdir().unwrap();
    written(root.path());
    let source = Source::read(&root.path().join("mine")).unwrap().unwrap();
    assert_eq!(source.columns("rows.csv").unwrap(), "a,b");
    assert_eq!(source.rows("mine", "a", "rows.csv").unwrap(), b"1,\"two\nlines\"\n");
    let note = &source.case("mine", "a").unwrap().files[0];
    assert_eq!(source.file(note).unwrap(), b"note");
    std::fs::write(root.path().join("mine/a.note.txt"), "nota").unwrap();
    assert!(source.file(note).is_err() && earlier(root.path()).is_err());
}

/// Every key that is written is in the schema, and what the schema requires is written.
#[test]
fn the_schema_is_that_of_what_is_written() {
    let root = tempfile::tempdir().unwrap();
    let (run, kept) = written(root.path());
    for (schema, value) in
        [(results_schema(), serde_json::to_value(&kept.folder).unwrap()), (run_schema(), json!(run))]
    {
        assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
        fits(&schema, &schema, &value, "");
    }
}

/// A small part of JSON Schema: properties, required ones, items, references and choices.
fn fits(root: &Value, schema: &Value, value: &Value, at: &str) {
    if let Some(name) = schema["$ref"].as_str() {
        let name = name.strip_prefix("#/$defs/").unwrap();
        return fits(root, &root["$defs"][name], value, at);
    }
    if let Some(choices) = schema["anyOf"].as_array() {
        let plain = |choice: &&Value| !(choice["type"] == "null");
        return if value.is_null() {
            assert!(choices.iter().any(|choice| choice["type"] == "null"), "{at} may not be null")
        } else if value.is_object() {
            fits(root, choices.iter().find(plain).unwrap(), value, at)
        };
    }
    match value {
        Value::Object(table) if schema.get("properties").is_some() => {
            for (key, inner) in table {
                let known = &schema["properties"][key];
                assert!(!known.is_null(), "{at}.{key} is not in the schema");
                fits(root, known, inner, &format!("{at}.{key}"));
            }
            let required = schema["required"].as_array().cloned().unwrap_or_default();
            assert!(
                required.iter().all(|key| table.contains_key(key.as_str().unwrap())),
                "{at}: {required:?}"
            );
            assert_eq!(schema["additionalProperties"], false, "{at}");
        }
        Value::Array(items) if schema.get("items").is_some() => {
            items.iter().for_each(|item| fits(root, &schema["items"], item, at));
        }
        _ => {}
    }
}
