//! A verdict: what the evidence says of a claim. Missing, NaN or outside validity is `inconclusive`, never a pass.

use crate::claim::{Claim, Expectation, Relation};
use crate::exact::{self, Exact};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An observed order of convergence with its 95 % interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ObservedOrder {
    #[serde(with = "exact::number")]
    #[schemars(with = "Exact")]
    pub value: f64,
    /// Ends of the 95 % interval; `None` with fewer than three levels.
    #[serde(with = "exact::interval")]
    #[schemars(with = "Option<(Exact, Exact)>")]
    pub interval: Option<(f64, f64)>,
    pub levels: usize,
}

/// What was found out about a claim.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Evidence {
    #[serde(with = "exact::option")]
    #[schemars(with = "Option<Exact>")]
    pub computed: Option<f64>,
    #[serde(with = "exact::option")]
    #[schemars(with = "Option<Exact>")]
    pub reference: Option<f64>,
    #[serde(with = "exact::option")]
    #[schemars(with = "Option<Exact>")]
    pub error: Option<f64>,
    pub order: Option<ObservedOrder>,
    /// Set where the reference does not hold: the reason. The verdict is then `inconclusive`.
    pub outside: Option<String>,
    /// Set where the level was not run: the reason. The verdict is then `skipped`.
    pub skipped: Option<String>,
    /// Set where the computation failed: what happened. The verdict is then `error`.
    pub failed: Option<String>,
    pub note: String,
    #[serde(with = "exact::option")]
    #[schemars(with = "Option<Exact>")]
    pub seconds: Option<f64>,
}

/// The seven words of `verdicts.csv`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    Pass,
    Fail,
    Xfail,
    Xpass,
    Inconclusive,
    Error,
    Skipped,
}

impl Verdict {
    /// All seven, in the order in which they are counted.
    pub const ALL: [Self; 7] =
        [Self::Pass, Self::Fail, Self::Xfail, Self::Xpass, Self::Inconclusive, Self::Error, Self::Skipped];

    /// The word in `verdicts.csv`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::Xfail => "xfail",
            Self::Xpass => "xpass",
            Self::Inconclusive => "inconclusive",
            Self::Error => "error",
            Self::Skipped => "skipped",
        }
    }
}

/// A claim, what was found, and what follows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Judged {
    pub claim: Claim,
    pub evidence: Evidence,
    pub verdict: Verdict,
}

/// Holds the evidence against the claim.
pub fn judge(claim: Claim, evidence: Evidence) -> Judged {
    let verdict = decide(&claim, &evidence);
    Judged { claim, evidence, verdict }
}

fn decide(claim: &Claim, evidence: &Evidence) -> Verdict {
    if evidence.failed.is_some() {
        return Verdict::Error;
    }
    if evidence.skipped.is_some() {
        return Verdict::Skipped;
    }
    if evidence.outside.is_some() {
        return Verdict::Inconclusive;
    }
    match (holds(claim, evidence), &claim.expectation) {
        (None, _) => Verdict::Inconclusive,
        (Some(true), Expectation::Holds) => Verdict::Pass,
        (Some(false), Expectation::Holds) => Verdict::Fail,
        (Some(true), Expectation::Broken(_)) => Verdict::Xpass,
        (Some(false), Expectation::Broken(_)) => Verdict::Xfail,
    }
}

/// Whether the bound holds; `None` where a number it needs is missing or NaN.
fn holds(claim: &Claim, evidence: &Evidence) -> Option<bool> {
    let known = |value: Option<f64>| value.filter(|x| !x.is_nan());
    if claim.tolerance.is_nan() {
        return None;
    }
    match claim.relation {
        Relation::AtMost => Some(known(evidence.error)?.abs() <= claim.tolerance),
        Relation::AtLeast => Some(known(evidence.computed)? >= claim.tolerance),
        Relation::Within => {
            Some((known(evidence.computed)? - known(evidence.reference)?).abs() <= claim.tolerance)
        }
        Relation::Equal => Some(known(evidence.computed)? == known(evidence.reference)?),
    }
}
