//! `pd-verify selftest`: results that are known to be wrong must be rejected, each with its cause, and right ones accepted.

use super::check::case;
use crate::foreign::{Asked, Foreign, Keys, Source, read};
use crate::input::Refusal;
use crate::question::Place;
use pd_verify::table::{Cell, Table};
use pd_verify::verdict::{Verdict, judge};
use std::fmt::Write;

/// Cases whose references are spoiled: one or two of every kind of data.
const CASES: [&str; 9] = [
    "dsif-edges/dsif-published",
    "dsif-edges/dsif-best",
    "bar-release/release-source",
    "bar-pulse/pulse-delta",
    "dispersion-joint/finite-differences",
    "dispersion-bar/kernels",
    "convergence-rest/rest-square",
    "convergence-plates/patch-strain",
    "convergence-plates/patch-bending",
];
/// Kinds of data tried of each case: some have dozens of curves.
const FORMS: usize = 6;

/// What came of one trial.
struct Trial {
    case: String,
    what: String,
    expected: &'static str,
    found: String,
    right: bool,
}

/// The table, and whether all trials went as they should.
pub fn selftest() -> Result<(String, bool), Refusal> {
    let mut trials = Vec::new();
    for id in CASES {
        let study = case(id, &[])?;
        let place = &study.cases[0].place;
        for form in study.cases[0].question.foreign().iter().take(FORMS) {
            try_form(&mut trials, place, &**form)?;
        }
    }
    Ok((table(&trials), trials.iter().all(|trial| trial.right)))
}

fn try_form(trials: &mut Vec<Trial>, place: &Place, form: &dyn Foreign) -> Result<(), Refusal> {
    let name = format!("{}: {}", place.case, form.name());
    let mut add = |what: &str, expected, (verdict, note): (Verdict, String), right: bool| {
        let cause = note.split("; ").skip(1).collect::<Vec<_>>().join("; ");
        let found =
            if cause.is_empty() { verdict.word().to_owned() } else { format!("{}: {cause}", verdict.word()) };
        trials.push(Trial { case: name.clone(), what: what.to_owned(), expected, found, right });
    };
    let good = judged(place, form, form.reference())?;
    let right = good.0 == Verdict::Pass;
    add("the reference itself", "pass", good, right);
    for mistake in form.mistakes() {
        let found = judged(place, form, mistake.columns)?;
        let right = found.0 == Verdict::Fail && found.1.contains(mistake.cause);
        add(mistake.what, "fail, cause named", found, right);
    }
    if let Keys::Growing(key @ ("t_s" | "x_m")) = form.keys() {
        let mut columns = form.reference();
        columns[0].iter_mut().for_each(|key| *key *= 1e3);
        let found = judged(place, form, columns)?;
        let right = found.0 == Verdict::Inconclusive && found.1.contains("another unit");
        add(
            if key == "t_s" { "times in ms" } else { "places in mm" },
            "inconclusive, unit named",
            found,
            right,
        );
    }
    Ok(())
}

/// The worst verdict on columns, with what was said of it; through the reader, as a file would come.
fn judged(place: &Place, form: &dyn Foreign, columns: Vec<Vec<f64>>) -> Result<(Verdict, String), Refusal> {
    let header: Vec<&'static str> = form.wanted().iter().map(|one| one.name).collect();
    let mut table = Table::new("data.csv", &header);
    for row in 0..columns.first().map_or(0, Vec::len) {
        table.push(columns.iter().map(|column| column[row].into()).collect::<Vec<Cell>>());
    }
    let source = Source::of("data.csv", table.csv().as_bytes(), None)?;
    let data = read("data.csv", &source, &form.wanted(), form.keys(), &Asked::default())?;
    let mut answer = form.judge(&data, place);
    let rank = |verdict: Verdict| match verdict {
        Verdict::Fail => 3,
        Verdict::Inconclusive => 2,
        Verdict::Pass => 1,
        _ => 4,
    };
    let verdicts = form.claims(place).into_iter().map(|claim| {
        let name = claim.id.rsplit('/').next().unwrap_or_default().to_owned();
        let at = answer.evidence.iter().position(|(other, _)| *other == name);
        let evidence = at.map(|at| answer.evidence.swap_remove(at).1).unwrap_or_default();
        let judged = judge(claim, evidence);
        let said = judged.evidence.outside.unwrap_or(judged.evidence.note);
        (judged.verdict, said)
    });
    // Of several claims that fail the first one speaks.
    let worst = verdicts.reduce(|worst, one| if rank(one.0) > rank(worst.0) { one } else { worst });
    Ok(worst.unwrap_or((Verdict::Inconclusive, String::new())))
}

fn table(trials: &[Trial]) -> String {
    let mut text = String::new();
    let mut last = "";
    for trial in trials {
        if trial.case != last {
            let _ = writeln!(text, "{}", trial.case);
            last = &trial.case;
        }
        let mark = if trial.right { "ok " } else { "BAD" };
        let _ = writeln!(text, "  {mark} {:<44} {:<25} {}", trial.what, trial.expected, trial.found);
    }
    let wrong = trials.iter().filter(|trial| !trial.right).count();
    let _ = match wrong {
        0 => writeln!(text, "all {} results were judged as they should be", trials.len()),
        _ => writeln!(text, "{wrong} of {} results were not judged as they should be", trials.len()),
    };
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_mistakes_are_rejected_with_their_cause() {
        let (text, right) = selftest().unwrap();
        assert!(right, "{text}");
        assert!(text.matches("  ok ").count() > 40, "{text}");
    }
}
