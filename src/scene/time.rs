//! How long a scene lasts and how its time step is chosen.

/// Duration and step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Time {
    /// In s.
    pub duration: f64,
    pub step: StepRule,
}

/// How Δt is chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepRule {
    /// At most this fraction of the lattice's sharp limit; made a little smaller so that whole steps fill the duration.
    OfLimit(f64),
    /// As given, in s, and what becomes of a step above the lattice's limit.
    Given { seconds: f64, beyond_limit: Beyond },
}

/// What is done with a step above the lattice's limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Beyond {
    /// The plan refuses it.
    Refused,
    /// It is marched until its growth shows that it diverges.
    UntilItShows,
    /// It is marched until its numbers are no longer finite: for those who study how it grows.
    UntilItOverflows,
}

impl StepRule {
    /// Δt in s and the number of steps that cover the duration, for a limit in s.
    pub fn steps(self, duration: f64, limit: f64) -> (f64, u64) {
        match self {
            Self::OfLimit(fraction) => {
                let steps = (duration / (fraction * limit) - 1e-9).ceil().max(1.0);
                (duration / steps, steps as u64)
            }
            // A duration of whole steps must not gain one by rounding.
            Self::Given { seconds, .. } => {
                (seconds, (duration / seconds * (1.0 - 1e-12) - 1e-9).ceil().max(1.0) as u64)
            }
        }
    }
}
