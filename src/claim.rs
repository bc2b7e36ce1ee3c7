//! A claim: one quantity held against one bound, with the reason for the bound, written before anything is computed.

use crate::exact::{self, Exact};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the computed value and its bound are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Relation {
    /// error ≤ tolerance.
    #[serde(rename = "<=")]
    AtMost,
    /// computed ≥ tolerance.
    #[serde(rename = ">=")]
    AtLeast,
    /// |computed − reference| ≤ tolerance.
    #[serde(rename = "within")]
    Within,
    /// computed equals the reference exactly.
    #[serde(rename = "==")]
    Equal,
}

impl Relation {
    /// The word in `verdicts.csv`.
    pub fn word(self) -> &'static str {
        match self {
            Self::AtMost => "<=",
            Self::AtLeast => ">=",
            Self::Within => "within",
            Self::Equal => "==",
        }
    }
}

/// What kind of number the error is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ErrorKind {
    /// |computed − reference|, in the unit of the quantity.
    Absolute,
    /// |computed − reference|/|reference|.
    Relative,
    /// Root mean square over the largest |reference|.
    RmsOfPeak,
    /// Largest error over the largest |reference|.
    MaxOfPeak,
    /// ‖error‖₁/‖reference‖₁.
    L1Relative,
    /// ‖error‖₂/‖reference‖₂.
    L2Relative,
    /// Largest error over a scale of the reference that the quantity names.
    LinfRelative,
    /// Observed minus expected order of convergence.
    Order,
    /// A number of things.
    Count,
    /// Bits that differ.
    Bits,
}

impl ErrorKind {
    /// The word in `verdicts.csv`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Absolute => "absolute",
            Self::Relative => "relative",
            Self::RmsOfPeak => "rms_of_peak",
            Self::MaxOfPeak => "max_of_peak",
            Self::L1Relative => "l1_relative",
            Self::L2Relative => "l2_relative",
            Self::LinfRelative => "linf_relative",
            Self::Order => "order",
            Self::Count => "count",
            Self::Bits => "bits",
        }
    }
}

/// Where a tolerance comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Basis {
    /// Follows from the mathematics of the method.
    Theory,
    /// What floating-point arithmetic leaves.
    Rounding,
    /// What a publication reports.
    Literature,
    /// At most twice what was measured; never a case's only claim.
    Measured,
    /// What a user can live with.
    Engineering,
}

impl Basis {
    /// The word in `verdicts.csv`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Theory => "theory",
            Self::Rounding => "rounding",
            Self::Literature => "literature",
            Self::Measured => "measured",
            Self::Engineering => "engineering",
        }
    }
}

/// What the claim's author expects of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Expectation {
    /// The bound holds.
    Holds,
    /// The bound is broken, for this reason: a printed formula shown wrong, a known limit.
    Broken(String),
}

/// One quantity against one bound.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// Unique over all studies: `study/case/name`.
    pub id: String,
    pub study: String,
    pub case: String,
    /// What is measured, in words.
    pub quantity: String,
    /// Unit of `computed` and `reference`; `1` where there is none.
    pub unit: String,
    pub error_kind: ErrorKind,
    pub relation: Relation,
    #[serde(with = "exact::number")]
    #[schemars(with = "Exact")]
    pub tolerance: f64,
    pub basis: Basis,
    /// Why the tolerance is what it is, in a sentence.
    pub because: String,
    /// Expected order of convergence, for claims about orders.
    #[serde(with = "exact::option")]
    #[schemars(with = "Option<Exact>")]
    pub expected_order: Option<f64>,
    pub expectation: Expectation,
    /// Where the reference comes from: publication and equation, or the method.
    pub source: String,
}
