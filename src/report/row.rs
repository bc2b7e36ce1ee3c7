//! A judged claim in words, shared by all tables, and how verdicts are counted.

use super::number::{precise, readable};
use crate::claim::{Claim, Expectation, Relation};
use crate::verdict::{Judged, ObservedOrder, Verdict};

/// A judged claim as text for readers.
#[derive(Debug, Clone)]
pub(super) struct Row {
    pub verdict: &'static str,
    pub failing: bool,
    pub claim: String,
    /// The claim as the name of a place in a page.
    pub anchor: String,
    pub quantity: String,
    pub unit: String,
    pub computed: String,
    pub reference: String,
    pub error: String,
    /// What the bound is about: the error, or the value itself where the bound is a least value.
    pub weighed: String,
    pub error_kind: String,
    pub bound: String,
    pub basis: &'static str,
    pub because: String,
    pub order: String,
    pub note: String,
    pub source: String,
}

impl Row {
    pub fn new(judged: &Judged) -> Self {
        let (claim, evidence) = (&judged.claim, &judged.evidence);
        let anchor = claim.id.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
        Self {
            verdict: judged.verdict.word(),
            failing: failing(judged.verdict),
            claim: claim.id.clone(),
            anchor,
            quantity: claim.quantity.clone(),
            unit: if claim.unit == "1" { String::new() } else { claim.unit.clone() },
            computed: precise(evidence.computed),
            reference: precise(evidence.reference),
            error: readable(evidence.error),
            weighed: readable(if claim.relation == Relation::AtLeast {
                evidence.computed
            } else {
                evidence.error
            }),
            error_kind: claim.error_kind.word().replace('_', " "),
            bound: bound(claim),
            basis: claim.basis.word(),
            because: claim.because.clone(),
            order: evidence.order.map(|order| observed(order, claim.expected_order)).unwrap_or_default(),
            note: note(judged),
            source: claim.source.clone(),
        }
    }
}

/// Whether the verdict makes a run fail.
pub(super) fn failing(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Fail | Verdict::Xpass | Verdict::Error)
}

/// What is asked of the claim, in signs.
pub(super) fn bound(claim: &Claim) -> String {
    let tolerance = readable(Some(claim.tolerance));
    match claim.relation {
        Relation::AtMost => format!("error ≤ {tolerance}"),
        Relation::AtLeast => format!("computed ≥ {tolerance}"),
        Relation::Within => format!("reference ± {tolerance}"),
        Relation::Equal => "equal".to_owned(),
    }
}

fn observed(order: ObservedOrder, expected: Option<f64>) -> String {
    let mut text = format!("order {}", readable(Some(order.value)));
    if let Some((low, high)) = order.interval {
        text += &format!(", 95 %: {} to {}", readable(Some(low)), readable(Some(high)));
    }
    text += &format!(", {} levels", order.levels);
    if let Some(expected) = expected {
        text += &format!(", expected {}", readable(Some(expected)));
    }
    text
}

/// What there is to say about a verdict: the note, why it was not judged, why a failure was expected.
pub(super) fn note(judged: &Judged) -> String {
    let evidence = &judged.evidence;
    let mut parts = vec![evidence.note.as_str()];
    parts.extend(
        [&evidence.failed, &evidence.skipped, &evidence.outside].into_iter().flatten().map(String::as_str),
    );
    if let (Verdict::Xfail | Verdict::Xpass, Expectation::Broken(reason)) =
        (judged.verdict, &judged.claim.expectation)
    {
        parts.push(reason);
    }
    parts.retain(|part| !part.trim().is_empty());
    parts.join("; ")
}

/// How many claims have each verdict, in the order of [`Verdict::ALL`].
pub(super) fn counts<'a>(judged: impl IntoIterator<Item = &'a Judged>) -> [(Verdict, usize); 7] {
    let mut counts = Verdict::ALL.map(|verdict| (verdict, 0));
    for one in judged {
        for (verdict, count) in &mut counts {
            *count += usize::from(*verdict == one.verdict);
        }
    }
    counts
}

/// The counts in one line: `12 claims: 10 pass, 1 fail, 1 skipped`.
pub fn counts_line<'a>(judged: impl IntoIterator<Item = &'a Judged>) -> String {
    let counts = counts(judged);
    let total: usize = counts.iter().map(|(_, count)| count).sum();
    let some = counts.iter().filter(|(verdict, count)| *count > 0 || *verdict == Verdict::Pass);
    let words: Vec<String> = some.map(|(verdict, count)| format!("{count} {}", verdict.word())).collect();
    format!("{total} claim{}: {}", if total == 1 { "" } else { "s" }, words.join(", "))
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;

    #[test]
    fn the_note_joins_every_reason() {
        let run = sample::run();
        let find = |verdict| run.judged().find(|one| one.verdict == verdict).unwrap();
        assert_eq!(note(find(Verdict::Skipped)), "needs four levels");
        assert_eq!(note(find(Verdict::Xfail)), "off by a factor 2; the printed formula lacks a factor");
        assert_eq!(note(find(Verdict::Pass)), "");
    }

    #[test]
    fn counts_name_what_there_is() {
        let run = sample::run();
        assert_eq!(
            counts_line(run.judged()),
            "7 claims: 1 pass, 1 fail, 1 xfail, 1 xpass, 1 inconclusive, 1 error, 1 skipped"
        );
        assert_eq!(counts_line([]), "0 claims: 0 pass");
    }
}
