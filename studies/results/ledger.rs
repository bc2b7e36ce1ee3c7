//! The ledger of the sources: what became of their figures, numbers and formulas, said by the claims of a run.

use pd_verify::report::{Outcome, Traced};
use pd_verify::verdict::{Judged, Verdict};
use serde::Deserialize;

const LEDGER: &str = include_str!("ledger.toml");

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Ledger {
    entry: Vec<Entry>,
}

/// One thing that a source shows.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    source: String,
    what: String,
    /// Beginnings of ids.
    #[serde(default)]
    claims: Vec<String>,
    #[serde(flatten)]
    said: Said,
}

/// What there is to say of it, and with that what its claims say when all come out as expected.
#[derive(Deserialize)]
enum Said {
    #[serde(rename = "why")]
    Reproduced(String),
    #[serde(rename = "differs")]
    Differs(String),
    #[serde(rename = "missing")]
    Missing(String),
}

fn entries() -> Vec<Entry> {
    toml::from_str::<Ledger>(LEDGER).expect("the ledger is well-formed").entry
}

/// The ledger beside the claims of a run; entries none of whose claims belong to the run's studies are left out.
pub fn ledger(judged: &[&Judged]) -> Vec<Traced> {
    entries().into_iter().filter_map(|entry| traced(entry, judged)).collect()
}

fn traced(entry: Entry, judged: &[&Judged]) -> Option<Traced> {
    let begins = |one: &&&Judged| entry.claims.iter().any(|prefix| one.claim.id.starts_with(prefix.as_str()));
    let mine: Vec<&&Judged> = judged.iter().filter(begins).collect();
    let (outcome, why) = match entry.said {
        Said::Missing(why) => (Outcome::NotReproducible, why),
        _ if mine.is_empty() => return None,
        Said::Reproduced(why) => (came_out(&mine).unwrap_or(Outcome::Reproduced), why),
        Said::Differs(why) => (came_out(&mine).unwrap_or(Outcome::Differs), why),
    };
    let claims = mine.iter().map(|one| one.claim.id.clone()).collect();
    Some(Traced { source: entry.source, what: entry.what, outcome, why, claims })
}

/// What keeps claims from saying anything; `None` where all that ran came out as expected, and most ran.
fn came_out(claims: &[&&Judged]) -> Option<Outcome> {
    let any = |wanted: &[Verdict]| claims.iter().any(|one| wanted.contains(&one.verdict));
    if any(&[Verdict::Fail, Verdict::Xpass, Verdict::Error, Verdict::Inconclusive]) {
        return Some(Outcome::InDoubt);
    }
    let ran = claims.iter().filter(|one| one.verdict != Verdict::Skipped).count();
    (2 * ran <= claims.len()).then_some(Outcome::NotRun)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shipped::shipped;
    use pd_verify::claim::Claim;
    use pd_verify::verdict::{Evidence, judge};

    fn claims() -> Vec<Claim> {
        let studies = shipped(None, &[]).unwrap();
        studies.iter().flat_map(|study| &study.cases).flat_map(|case| case.claims()).collect()
    }

    fn all(verdict: Verdict) -> Vec<Judged> {
        let one = |claim| Judged { verdict, ..judge(claim, Evidence::default()) };
        claims().into_iter().map(one).collect()
    }

    #[test]
    fn every_entry_names_claims_that_are_made() {
        let claims = claims();
        for entry in entries() {
            assert_eq!(entry.claims.is_empty(), matches!(entry.said, Said::Missing(_)), "{}", entry.what);
            for prefix in &entry.claims {
                assert!(
                    claims.iter().any(|claim| claim.id.starts_with(prefix)),
                    "{prefix} is no claim's beginning"
                );
            }
        }
    }

    #[test]
    fn one_claim_that_fails_puts_its_entry_in_doubt() {
        let mut judged = all(Verdict::Pass);
        let of = |judged: &[Judged]| ledger(&judged.iter().collect::<Vec<_>>());
        let outcome = |judged: &[Judged], what: &str| {
            of(judged).into_iter().find(|entry| entry.what.starts_with(what)).map(|entry| entry.outcome)
        };
        assert_eq!(outcome(&judged, "the mixed"), Some(Outcome::Differs));
        assert_eq!(outcome(&judged, "strain over time"), Some(Outcome::Reproduced));
        assert_eq!(of(&judged).len(), entries().len());
        for verdict in [Verdict::Fail, Verdict::Xpass, Verdict::Error, Verdict::Inconclusive] {
            let one = judged.iter_mut().find(|one| one.claim.id.contains("mixed_derivative_right")).unwrap();
            one.verdict = verdict;
            assert_eq!(outcome(&judged, "the mixed"), Some(Outcome::InDoubt), "{verdict:?}");
        }
        assert_eq!(outcome(&all(Verdict::Skipped), "strain over time"), Some(Outcome::NotRun));
        // A run of other studies says nothing of it; what is missing is missing.
        let missing = entries().iter().filter(|entry| matches!(entry.said, Said::Missing(_))).count();
        assert_eq!(of(&[]).len(), missing);
    }
}
