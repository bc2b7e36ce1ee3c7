//! What is solved to see what accuracy costs: what is known of each problem, and how a setting solves it.

use super::settings::{Setting, Track};
use crate::convergence::refined::Bound;
use pd_verify::claim::ErrorKind;
use pd_verify::scene::Wrong;

/// What is known of a problem before anything is run.
pub struct Facts {
    /// "the displacement of …".
    pub what: String,
    pub equations: &'static str,
    /// Where the exact answer comes from.
    pub source: &'static str,
    pub error_kind: ErrorKind,
    /// Of the body: a node update more in each direction and in time for each cell that is halved.
    pub dimension: u32,
    /// The bound on the difference from the lattice's own exact answer, where it has one.
    pub own: Option<Bound>,
    /// The order in Δx with the intended moduli, where theory knows it.
    pub order: Option<Order>,
    /// Indices of the readings whose error falls at every level where moduli are the intended ones.
    pub falling: Vec<usize>,
    /// Names of the ways in which a result is read; one without a name where there is one.
    pub readings: Vec<String>,
    /// Whether the error of finite differences is that of their dispersion alone.
    pub disperses: bool,
}

/// An order of convergence, how far an observed one may be from it, and why.
pub struct Order {
    pub expected: f64,
    pub within: f64,
    /// Whether pairs of fine levels have it too: else it is that of a line through all of them.
    pub steady: bool,
    /// The largest horizon in m at the coarsest level of settings whose levels show it.
    pub widest: f64,
    /// By theory.
    pub because: &'static str,
}

/// A problem with its settings.
pub trait Problem {
    fn facts(&self) -> Facts;

    /// A setting at each spacing, from coarse to fine.
    fn track(&self, setting: Setting, spacings: &[f64]) -> Result<Track, Wrong>;
}
