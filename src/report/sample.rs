//! A run with every verdict and with text that needs escaping, for tests.

use super::{Drawn, Outcome, RunSummary, Shown, StudyReport, Traced, plot};
use crate::claim::{Basis, Claim, ErrorKind, Expectation, Relation};
use crate::verdict::{Evidence, Judged, ObservedOrder, judge};

fn claim(name: &str, study: &str) -> Claim {
    Claim {
        id: format!("{study}/constant-m3/{name}"),
        study: study.to_owned(),
        case: "constant-m3".to_owned(),
        quantity: "phase velocity at kΔx < 0.5 & below".to_owned(),
        unit: "m/s".to_owned(),
        error_kind: ErrorKind::L2Relative,
        relation: Relation::AtMost,
        tolerance: 1e-3,
        basis: Basis::Theory,
        because: "the truncation error is (kΔx)²/24 | at most 1 %".to_owned(),
        expected_order: Some(2.0),
        expectation: Expectation::Holds,
        source: "Silling & Askari 2005, eq. (12)".to_owned(),
    }
}

/// One claim for each of the seven verdicts.
pub(super) fn judged() -> Vec<Judged> {
    let broken = || Expectation::Broken("the printed formula lacks a factor".to_owned());
    let error = |e: f64| Evidence {
        computed: Some(4996.25),
        reference: Some(5000.0),
        error: Some(e),
        ..Evidence::default()
    };
    let order = ObservedOrder { value: 1.98, interval: Some((1.9, 2.06)), levels: 5 };
    let text = |text: &str| Some(text.to_owned());
    let noted = |e, note: &str| Evidence { note: note.to_owned(), ..error(e) };
    vec![
        judge(
            claim("passes", "dispersion"),
            Evidence { order: Some(order), seconds: Some(0.25), ..error(7.5e-4) },
        ),
        judge(claim("fails", "dispersion"), noted(0.02, "twenty times <b>too large</b>")),
        judge(
            Claim { expectation: broken(), ..claim("xfails", "dispersion") },
            noted(0.5, "off by a factor 2"),
        ),
        judge(Claim { expectation: broken(), ..claim("xpasses", "dispersion") }, error(1e-5)),
        judge(
            claim("outside", "bar"),
            Evidence { outside: text("Poisson ratio 0.3 is outside"), ..error(0.1) },
        ),
        judge(
            claim("errors", "bar"),
            Evidence { failed: text("not finite after step 12"), ..Evidence::default() },
        ),
        judge(
            claim("skipped", "bar"),
            Evidence { skipped: text("needs four levels"), ..Evidence::default() },
        ),
    ]
}

/// Two studies with a figure.
pub(super) fn run() -> RunSummary {
    let (bar, dispersion): (Vec<_>, Vec<_>) = judged().into_iter().partition(|one| one.claim.study == "bar");
    let series = plot::Series::line("lattice", vec![(0.0, 0.0), (1.0, 0.9)]);
    let panel = plot::Lines::new(plot::Axis::linear("k (1/m)"), plot::Axis::linear("ω (1/s)"), vec![series]);
    let figure = plot::Figure::new("curves", "Curves <of> ω", "Frequency & wavenumber.", panel);
    let study = |id: &str, judged, figures| StudyReport {
        id: id.to_owned(),
        kind: id.to_owned(),
        title: format!("The {id} study"),
        text: "Waves are slower in a lattice.\n\nBy how much is known exactly.".to_owned(),
        source: "Silling & Askari 2005".to_owned(),
        figures,
        judged,
    };
    RunSummary {
        title: "Validation report".to_owned(),
        command: "pd-verify report --out reports".to_owned(),
        manifest: vec![("version".into(), "0.1.0".into()), ("processor".into(), "A < B".into())],
        studies: vec![
            study("dispersion", dispersion, vec![Drawn::new(&figure).unwrap()]),
            study("bar", bar, Vec::new()),
        ],
        ledger: vec![Traced {
            source: "Silling & Askari 2005".into(),
            what: "the speed is 0.02 m/s".into(),
            outcome: Outcome::Reproduced,
            why: "to all digits".into(),
            claims: vec!["dispersion/constant-m3/passes".into()],
        }],
        tables: vec![Shown {
            id: "cheapest".into(),
            title: "The cheapest way".into(),
            caption: "By bond updates.".into(),
            columns: vec!["method".into(), "seconds".into()],
            rows: vec![vec!["gaussian".into(), "0.5".into()]],
        }],
    }
}
