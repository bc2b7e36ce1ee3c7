//! A march that was given up because what it computes is no motion of the body: from when on, why, and what would hold.

use super::{Record, Snapshot};
use std::fmt;

/// What is known of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Diverged {
    /// At which it was given up.
    pub step: u64,
    /// Of that step, in s.
    pub time: f64,
    /// The last step looked at whose motion the time step could carry; `None` where there was none. What was seen after
    /// it belongs to the growth.
    pub sound_step: Option<u64>,
    /// Largest stable time step of the body in s, of small rotations about where it was then; `None` where it was not found.
    pub own_limit: Option<f64>,
    /// The whole body at the last sound look, where the scene asks for snapshots.
    pub sound: Option<Snapshot>,
    /// What was seen until it was given up, with the plan.
    pub record: Record,
}

/// Of the own limit: a step that holds, the limit being known to some digits and lowered by tension.
const HOLDS: f64 = 0.99;

impl Diverged {
    /// Of the last sound step in s.
    pub fn sound_time(&self) -> Option<f64> {
        self.sound_step.map(|step| step as f64 * self.record.plan.time_step_s)
    }

    /// Δt over the body's own limit.
    pub fn over_own_limit(&self) -> Option<f64> {
        self.own_limit.map(|limit| self.record.plan.time_step_s / limit)
    }

    /// The largest time step in s that holds here and that a plan allows; with finite rotations it holds at the strains of
    /// the last sound look, and may have to be lowered again for those to come.
    pub fn holds(&self) -> Option<f64> {
        let plan = &self.record.plan;
        self.own_limit.map(|limit| (HOLDS * limit).min(plan.time_step_s / plan.time_step_over_limit))
    }
}

impl fmt::Display for Diverged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plan = &self.record.plan;
        write!(
            f,
            "\"{}\" grew without bound and was given up at step {}, t = {:e} s: ",
            plan.name, self.step, self.time
        )?;
        match self.sound_step.zip(self.sound_time()) {
            Some((step, time)) => write!(f, "sound until step {step}, t = {time:e} s, ")?,
            None => write!(f, "no look found it sound, ")?,
        }
        write!(
            f,
            "with Δt = {:.4e} s, {:.4} of the lattice's limit",
            plan.time_step_s, plan.time_step_over_limit
        )?;
        match self.over_own_limit().zip(self.holds()) {
            Some((over, holds)) => {
                write!(f, " and {over:.4} of the body's own; take Δt = {holds:.3e} s or less")
            }
            None => write!(f, "; take a smaller Δt"),
        }
    }
}
