//! Every claim of an ablation passes, and is lost to a fault of its own.

use super::ablation::AblationAsked;
use crate::input::Document;
use crate::question::{Answer, Place, Question};
use crate::subject::{PdVerify, Subject};
use crate::written::{Asked, COMMON_KEYS, Written};
use pd_verify::forces::Damping;
use pd_verify::material::Material;
use pd_verify::record::{self, Failure, Record};
use pd_verify::scene::{Positive, Scene, Wrong};
use pd_verify::verdict::{Verdict, judge};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The case as shipped, on a plate that takes no time.
fn case() -> String {
    let mut text = include_str!("ablation.toml").to_owned();
    for (from, to) in
        [("[128, 96]", "[48, 40]"), ("steps = 60", "steps = 30"), ("repeats = 3", "repeats = 1")]
    {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    text
}

fn asked(text: &str) -> Result<super::ablation::Ablation, Wrong> {
    let document = Document::parse("mine", text).unwrap();
    let value = &document.get("case").unwrap()[0];
    let material = Some(Material { youngs_modulus: 72e9, density: 2440.0 });
    let written = Written { document: &document, path: "case[0]".into(), value, title: "Plate", material };
    document.read::<AblationAsked>("case[0]", value, &COMMON_KEYS).unwrap().check(&written)
}

fn answered(subject: &dyn Subject) -> (BTreeMap<String, Verdict>, Answer) {
    let place = Place { study: "mine".into(), case: "ablation-plate".into() };
    let question = asked(&case()).unwrap();
    let answer = question.answer(subject, &place);
    let verdict = |(name, evidence): &(String, _)| {
        let claims = question.claims(&place);
        let claim = claims.into_iter().find(|claim| claim.id.ends_with(&format!("/{name}"))).unwrap();
        (name.clone(), judge(claim, Clone::clone(evidence)).verdict)
    };
    (answer.evidence.iter().map(verdict).collect(), answer)
}

/// The library with one thing changed in what is marched and in what is seen.
struct Fault(fn(&mut Scene<2>), fn(&mut Record));

impl Subject for Fault {
    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        let mut scene = scene.clone();
        (self.0)(&mut scene);
        let mut record = record::run(&scene)?;
        (self.1)(&mut record);
        Ok(record)
    }
}

/// Damping of rate 0 damps a little.
fn drag(scene: &mut Scene<2>) {
    for effect in &mut scene.effects {
        if effect.name() == "damping" && effect.neutral(f64::INFINITY).is_some() {
            *effect = Arc::new(Damping { rate_per_s: Positive(1.0) });
        }
    }
}

/// Who takes snapshots shakes the plate.
fn shake(scene: &mut Scene<2>) {
    let part = if scene.snapshots.is_empty() { 0.0 } else { 1e-14 };
    scene.displacement[0].amplitude *= 1.0 + part;
}

#[test]
fn every_claim_passes_and_is_lost_to_its_fault() {
    let (sound, _) = answered(&PdVerify);
    assert_eq!(sound.keys().collect::<Vec<_>>(), ["bytes", "named", "neutral", "watched"]);
    assert!(sound.values().all(|verdict| *verdict == Verdict::Pass), "{sound:?}");
    let faults: [(&str, Fault); 5] = [
        ("neutral", Fault(drag, |_| ())),
        ("watched", Fault(shake, |_| ())),
        ("named", Fault(|_| (), |record| record.plan.avoidable.clear())),
        ("bytes", Fault(|_| (), |record| record.plan.bytes_per_node += 0.1)),
        ("neutral", Fault(|_| (), |record| record.traces.clear())),
    ];
    for (claim, fault) in faults {
        let (found, _) = answered(&fault);
        assert_ne!(found[claim], Verdict::Pass, "{claim} does not notice its fault: {found:?}");
    }
}

#[test]
fn the_table_has_a_row_for_every_effect_with_what_it_changes() {
    let (_, answer) = answered(&PdVerify);
    let table = &answer.tables[0];
    let csv = table.csv();
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let rows: Vec<BTreeMap<String, String>> = reader.deserialize().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 16);
    let number = |row: &BTreeMap<String, String>, key: &str| row[key].parse::<f64>().unwrap();
    for row in &rows {
        // Who watches and the plain plate itself change nothing, all else something.
        let still = ["plain: free edges", "a probe at every step", "snapshots", "energy ledger"];
        assert_eq!(number(row, "change_l2") == 0.0, still.contains(&row["effect"].as_str()), "{row:?}");
        assert!(number(row, "change_l2") < 10.0 && number(row, "node_updates_per_s") > 0.0, "{row:?}");
        let removed = if row["effect"] == "hole" { 40.0 * 48.0 - number(row, "nodes") } else { 0.0 };
        assert_eq!(number(row, "node_updates"), 30.0 * (1920.0 - removed));
    }
    let of = |name: &str, key: &str| number(rows.iter().find(|row| row["effect"] == name).unwrap(), key);
    // The ledger keeps displacement, increment and force once more; a hole takes nodes and leaves rows; corrected bonds are listed.
    assert!(of("energy ledger", "bytes_over_plain") > 1.5 && of("notch", "bytes_over_plain") > 1.0);
    assert!(
        of("energy correction", "bytes_over_plain") > 2.0 && of("periodic edges", "bytes_over_plain") < 1.0
    );
    assert!(of("energy correction", "limit_over_plain") < 0.99 && of("damping", "limit_over_plain") == 1.0);
    assert_eq!(answer.figures.len(), 1);
    pd_verify::report::Drawn::new(&answer.figures[0]).unwrap();
}

#[test]
fn what_cannot_be_looked_at_is_refused() {
    for (from, to, key) in [
        ("plane_stress", "bar", "body"),
        ("[48, 40]", "[48, 20]", "nodes"),
        ("steps = 30", "steps = 0", "steps"),
        ("repeats = 1", "repeats = 1000", "repeats"),
        ("m = 3", "m = [3, 4]", "lattice"),
        ("volume_rule = \"linear\"", "volume_rule = \"linear\", calibrated = true", "lattice.calibrated"),
    ] {
        assert!(case().contains(from));
        assert_eq!(asked(&case().replace(from, to)).err().unwrap().key, key);
    }
}
