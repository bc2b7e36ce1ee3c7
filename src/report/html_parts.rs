//! The parts of the page that look across studies: overview, stability, ledger of the sources, misprints, traceability.

use super::number::readable;
use super::row::{Row, counts_line};
use super::survey::{Surveyed, misprints, share};
use super::{Outcome, RunSummary, StudyReport};
use crate::verdict::Judged;
use minijinja::{Value, context};

/// One row for each study.
pub(super) fn overview(run: &RunSummary) -> Vec<Value> {
    let of = |study: &StudyReport| {
        context! {
            id => &study.id,
            title => &study.title,
            kind => &study.kind,
            ..surveyed(&study.judged)
        }
    };
    run.studies.iter().map(of).collect()
}

/// One row for each case of the studies of stability.
pub(super) fn stability(run: &RunSummary) -> Vec<Value> {
    let mut rows = Vec::new();
    for study in run.studies.iter().filter(|study| study.kind == "stability") {
        for case in study.judged.chunk_by(|a, b| a.claim.case == b.claim.case) {
            let name = case.first().map_or("", |one| &one.claim.case);
            rows.push(context! { case => name, study => &study.title, ..surveyed(case) });
        }
    }
    rows
}

/// Verdicts, and the claim that holds by the least.
fn surveyed(judged: &[Judged]) -> Value {
    let survey = Surveyed::of(judged.iter());
    let tightest = survey.tightest.map(|(used, one)| {
        let row = Row::new(one);
        context! {
            anchor => row.anchor,
            quantity => row.quantity,
            error => row.weighed,
            bound => row.bound,
            used => format!("{:.0} %", 100.0 * used),
        }
    });
    let seconds: f64 = judged.iter().filter_map(|one| one.evidence.seconds).fold(0.0, f64::max);
    context! {
        word => survey.word(),
        counts => counts_line(judged),
        seconds => if seconds > 0.0 { readable(Some(seconds)) } else { String::new() },
        tightest,
    }
}

/// What the sources show, and how much of it was met, in words.
pub(super) fn ledger(run: &RunSummary) -> Value {
    let rows: Vec<Value> = run
        .ledger
        .iter()
        .map(|entry| {
            let claims: Vec<Value> = run
                .judged()
                .filter(|one| entry.claims.contains(&one.claim.id))
                .map(Row::new)
                .map(|row| context! { anchor => row.anchor, claim => row.claim, verdict => row.verdict, error => row.error })
                .collect();
            let class = match entry.outcome {
                Outcome::Reproduced => "pass",
                Outcome::Differs => "xfail",
                Outcome::InDoubt => "fail",
                Outcome::NotReproducible | Outcome::NotRun => "skipped",
            };
            context! {
                source => &entry.source,
                what => &entry.what,
                outcome => entry.outcome.word(),
                class,
                why => &entry.why,
                claims,
            }
        })
        .collect();
    let count = |outcome: Outcome| run.ledger.iter().filter(|entry| entry.outcome == outcome).count();
    let counted = Outcome::ALL.into_iter().filter(|outcome| count(*outcome) > 0);
    let said: Vec<String> = counted.map(|outcome| format!("{} {}", count(outcome), outcome.word())).collect();
    context! { rows, said => said.join(", ") }
}

/// Each printed formula beside its right form.
pub(super) fn misprinted(run: &RunSummary) -> Vec<Value> {
    let studies = run.studies.iter().flat_map(|study| &study.judged);
    let form = |row: &Row| {
        context! {
            verdict => row.verdict,
            anchor => &row.anchor,
            error => &row.weighed,
            bound => &row.bound,
            source => &row.source,
        }
    };
    misprints(studies)
        .iter()
        .map(|pair| {
            context! {
                wrong => pair.wrong,
                quantity => &pair.printed.quantity,
                printed => form(&pair.printed),
                right => pair.right.as_ref().map(form),
            }
        })
        .collect()
}

/// One row for each claim: where it comes from, where it is tested, and how it came out.
pub(super) fn matrix(run: &RunSummary) -> Vec<Value> {
    let of = |one: &Judged| {
        let row = Row::new(one);
        context! {
            verdict => row.verdict,
            claim => row.claim,
            anchor => row.anchor,
            study => &one.claim.study,
            case => &one.claim.case,
            source => row.source,
            basis => row.basis,
            used => share(one).map_or(String::new(), |used| readable(Some(used))),
        }
    };
    run.judged().map(of).collect()
}
