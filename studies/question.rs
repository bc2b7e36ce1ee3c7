//! What every study is made of: cases that ask a question, claim an answer beforehand, and bring evidence.

use crate::attachment::Attachment;
use crate::foreign::Foreign;
use crate::subject::Subject;
use pd_verify::claim::{Basis, Claim, ErrorKind, Expectation, Relation};
use pd_verify::report::plot::Figure;
use pd_verify::table::Table;
use pd_verify::verdict::Evidence;
use std::fmt;

/// What a case marches in time: one scene, planned.
pub type Planned = pd_verify::plan::Plan;

/// How much of a study is run. Chooses levels and cases, never a bound.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Default,
    serde::Deserialize,
    schemars::JsonSchema,
    clap::ValueEnum,
)]
#[serde(rename_all = "lowercase")]
pub enum Profile {
    Quick,
    #[default]
    Standard,
    Full,
}

impl fmt::Display for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Quick => "quick",
            Self::Standard => "standard",
            Self::Full => "full",
        })
    }
}

/// Where a claim stands: its study and its case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    pub study: String,
    pub case: String,
}

/// The work a case will do.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct Effort {
    /// Curves or parameter sets.
    pub curves: u64,
    /// Frequencies evaluated by the code under judgement.
    pub evaluations: u64,
    /// Bonds visited by those evaluations and by marching; quadrature points in the continuum.
    pub bond_evaluations: u64,
    /// Frequencies evaluated by the reference.
    pub reference_evaluations: u64,
    /// Nodes moved by one step, over all steps of what is marched in time.
    pub node_updates: u64,
}

impl Effort {
    /// The work of marching scenes.
    pub fn of_scenes(scenes: &[Planned]) -> Self {
        let mut total = Self::default();
        for scene in scenes {
            total += Self {
                curves: 1,
                bond_evaluations: scene.bond_updates,
                node_updates: scene.node_updates,
                ..Self::default()
            };
        }
        total
    }
}

impl std::ops::AddAssign for Effort {
    fn add_assign(&mut self, other: Self) {
        self.curves = self.curves.saturating_add(other.curves);
        self.evaluations = self.evaluations.saturating_add(other.evaluations);
        self.bond_evaluations = self.bond_evaluations.saturating_add(other.bond_evaluations);
        self.reference_evaluations = self.reference_evaluations.saturating_add(other.reference_evaluations);
        self.node_updates = self.node_updates.saturating_add(other.node_updates);
    }
}

/// What a case found: evidence by claim name, rows for the tables, figures, files.
#[derive(Debug, Default)]
pub struct Answer {
    pub evidence: Vec<(String, Evidence)>,
    pub tables: Vec<Table>,
    pub figures: Vec<Figure>,
    /// Further files; each name begins with the case's.
    pub files: Vec<Attachment>,
}

impl Answer {
    /// Where the computation failed: every claim is an error, for this reason.
    pub fn failed(claims: &[Claim], reason: &str) -> Self {
        let name = |claim: &Claim| claim.id.rsplit('/').next().unwrap_or_default().to_owned();
        let error = Evidence { failed: Some(reason.to_owned()), ..Evidence::default() };
        Self {
            evidence: claims.iter().map(|claim| (name(claim), error.clone())).collect(),
            ..Self::default()
        }
    }
}

/// A case's question, ready to be asked.
pub trait Question: Send + Sync {
    /// What is claimed, with every bound and its reason; computes nothing.
    fn claims(&self, place: &Place) -> Vec<Claim>;
    /// What the case marches in time; computes nothing but sizes and time steps.
    fn scenes(&self) -> Vec<Planned> {
        Vec::new()
    }
    /// What answering costs; computes nothing. Left out where marching the scenes is all there is to do.
    fn effort(&self) -> Effort {
        Effort::of_scenes(&self.scenes())
    }
    /// The equations the claims are about, one per line.
    fn equations(&self) -> &'static str;
    /// Asks `subject`, holds its answers against the reference.
    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer;
    /// The kinds of results of another code that the case judges; none if left out.
    fn foreign(&self) -> Vec<Box<dyn Foreign + '_>> {
        Vec::new()
    }
}

impl Question for Box<dyn Question> {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        (**self).claims(place)
    }
    fn scenes(&self) -> Vec<Planned> {
        (**self).scenes()
    }
    fn effort(&self) -> Effort {
        (**self).effort()
    }
    fn equations(&self) -> &'static str {
        (**self).equations()
    }
    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        (**self).answer(subject, place)
    }
    fn foreign(&self) -> Vec<Box<dyn Foreign + '_>> {
        (**self).foreign()
    }
}

/// Starts a claim; the name is unique within the case.
pub fn claim(place: &Place, name: &str, quantity: impl Into<String>) -> Claim {
    Claim {
        id: format!("{}/{}/{name}", place.study, place.case),
        study: place.study.clone(),
        case: place.case.clone(),
        quantity: quantity.into(),
        unit: "1".into(),
        error_kind: ErrorKind::Relative,
        relation: Relation::AtMost,
        tolerance: f64::NAN,
        basis: Basis::Engineering,
        because: String::new(),
        expected_order: None,
        expectation: Expectation::Holds,
        source: String::new(),
    }
}

/// The parts of a claim, in the order in which one says them.
pub trait Claiming {
    fn at_most(self, kind: ErrorKind, tolerance: f64) -> Self;
    fn at_least(self, bound: f64) -> Self;
    fn within(self, kind: ErrorKind, tolerance: f64) -> Self;
    fn exactly(self) -> Self;
    fn order(self, expected: f64, within: f64) -> Self;
    fn because(self, basis: Basis, why: impl Into<String>) -> Self;
    fn source(self, source: impl Into<String>) -> Self;
    fn broken(self, why: impl Into<String>) -> Self;
}

impl Claiming for Claim {
    fn at_most(self, error_kind: ErrorKind, tolerance: f64) -> Self {
        Self { error_kind, relation: Relation::AtMost, tolerance, ..self }
    }

    fn at_least(self, tolerance: f64) -> Self {
        Self { error_kind: ErrorKind::Absolute, relation: Relation::AtLeast, tolerance, ..self }
    }

    fn within(self, error_kind: ErrorKind, tolerance: f64) -> Self {
        Self { error_kind, relation: Relation::Within, tolerance, ..self }
    }

    fn exactly(self) -> Self {
        Self { error_kind: ErrorKind::Count, relation: Relation::Equal, tolerance: 0.0, ..self }
    }

    fn order(self, expected: f64, within: f64) -> Self {
        Self { expected_order: Some(expected), ..self.within(ErrorKind::Order, within) }
    }

    fn because(self, basis: Basis, why: impl Into<String>) -> Self {
        Self { basis, because: why.into(), ..self }
    }

    fn source(self, source: impl Into<String>) -> Self {
        Self { source: source.into(), ..self }
    }

    fn broken(self, why: impl Into<String>) -> Self {
        Self { expectation: Expectation::Broken(why.into()), ..self }
    }
}

/// Evidence for a claim about the size of an error.
pub fn error_of(error: Option<f64>, note: impl Into<String>) -> Evidence {
    Evidence { error, note: note.into(), ..Evidence::default() }
}

/// Evidence for a claim that a value meets a reference.
pub fn value_of(computed: Option<f64>, reference: Option<f64>, note: impl Into<String>) -> Evidence {
    let error = computed.zip(reference).map(|(a, b)| (a - b).abs());
    Evidence { computed, reference, error, note: note.into(), ..Evidence::default() }
}
