//! What a run says at a glance: of each study or case the verdicts and the claim that holds by the least.

use super::row::{Row, counts, failing};
use crate::claim::{Expectation, Relation};
use crate::verdict::{Judged, Verdict};

/// A group of claims.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Surveyed<'a> {
    pub counts: [(Verdict, usize); 7],
    /// Of those that pass: error over tolerance, or the least value over what was computed.
    pub tightest: Option<(f64, &'a Judged)>,
}

impl<'a> Surveyed<'a> {
    pub fn of(judged: impl Iterator<Item = &'a Judged> + Clone) -> Self {
        let passing = judged.clone().filter(|one| one.verdict == Verdict::Pass);
        let used = passing.filter_map(|one| share(one).map(|share| (share, one)));
        Self { counts: counts(judged), tightest: used.max_by(|a, b| a.0.total_cmp(&b.0)) }
    }

    /// The worst word, for colour.
    pub fn word(&self) -> &'static str {
        let has = |wanted: &dyn Fn(Verdict) -> bool| {
            self.counts.iter().find(|(verdict, count)| *count > 0 && wanted(*verdict)).map(|found| found.0)
        };
        let worst = has(&failing)
            .or_else(|| has(&|verdict| verdict == Verdict::Inconclusive))
            .or_else(|| has(&|verdict| verdict == Verdict::Pass || verdict == Verdict::Xfail));
        worst.unwrap_or(Verdict::Skipped).word()
    }
}

/// How much of a bound is used, 1 being all of it; `None` where the bound is exact.
pub(super) fn share(judged: &Judged) -> Option<f64> {
    let (claim, evidence) = (&judged.claim, &judged.evidence);
    let share = match claim.relation {
        Relation::AtMost => evidence.error? / claim.tolerance,
        Relation::AtLeast => claim.tolerance / evidence.computed?,
        Relation::Within => match (evidence.order, claim.expected_order) {
            (Some(order), Some(expected)) => (order.value - expected).abs() / claim.tolerance,
            _ => evidence.error? / claim.tolerance,
        },
        Relation::Equal => return None,
    };
    share.is_finite().then_some(share)
}

/// A printed formula and its right form, held to the same bound.
pub(super) struct Misprint<'a> {
    pub printed: Row,
    pub right: Option<Row>,
    pub wrong: &'a str,
}

/// What marks the reason of a claim that a printed formula is expected to break.
const MARK: &str = "misprint: ";

/// The printed formulas among some claims, each beside the claim of its right form, which has the same name but for its end.
pub(super) fn misprints<'a>(judged: impl Iterator<Item = &'a Judged> + Clone) -> Vec<Misprint<'a>> {
    let right = |printed: &str| {
        let name = format!("{}right", printed.strip_suffix("printed")?);
        judged.clone().find(|one| one.claim.id == name).map(Row::new)
    };
    let of = |one: &'a Judged| match &one.claim.expectation {
        Expectation::Broken(reason) => Some(Misprint {
            printed: Row::new(one),
            right: right(&one.claim.id),
            wrong: reason.strip_prefix(MARK)?,
        }),
        Expectation::Holds => None,
    };
    judged.clone().filter_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;
    use crate::claim::Claim;
    use crate::verdict::judge;

    #[test]
    fn the_tightest_claim_is_the_one_that_uses_most_of_its_bound() {
        let judged = sample::judged();
        let survey = Surveyed::of(judged.iter());
        let (used, tightest) = survey.tightest.unwrap();
        assert_eq!((used, tightest.claim.id.as_str()), (0.75, "dispersion/constant-m3/passes"));
        assert_eq!(survey.word(), "fail");
        assert_eq!(Surveyed::of(judged[..1].iter()).word(), "pass");
        assert_eq!(Surveyed::of(judged[4..5].iter()).word(), "inconclusive");
        assert_eq!(Surveyed::of([].iter()).word(), "skipped");
    }

    #[test]
    fn a_least_value_is_used_by_what_it_leaves() {
        let one = sample::judged().remove(0);
        let claim = Claim { relation: Relation::AtLeast, tolerance: 10.0, expected_order: None, ..one.claim };
        let mut evidence = one.evidence;
        evidence.computed = Some(40.0);
        assert_eq!(share(&judge(claim, evidence)), Some(0.25));
    }

    #[test]
    fn a_misprint_stands_beside_its_right_form() {
        let mut judged = sample::judged();
        let reason = Expectation::Broken("misprint: a factor 2".into());
        let mut printed = judged[2].clone();
        printed.claim = Claim { id: "d/c/bar_printed".into(), expectation: reason, ..printed.claim };
        let mut right = judged[0].clone();
        right.claim.id = "d/c/bar_right".into();
        judged.extend([printed, right]);
        let found = misprints(judged.iter());
        assert_eq!(found.len(), 1, "other expected failures are no misprints");
        assert_eq!((found[0].wrong, found[0].printed.verdict), ("a factor 2", "xfail"));
        assert_eq!(found[0].right.as_ref().unwrap().claim, "d/c/bar_right");
    }
}
