//! How far a wave has turned since it was let go: exact in time, or marched by central differences.

use crate::medium::leapfrog_turn;

/// When to look.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Clock {
    /// At c times the time.
    Exact(f64),
    /// After so many steps of cΔt; the first, from rest, is half a step's acceleration, so that the wave turns by the
    /// same angle in every step.
    Leapfrog(u64, f64),
}

impl Clock {
    /// The cosine of the angle turned by a wave of ω/c; None above leapfrog's limit.
    pub(crate) fn cosine(self, omega_over_c: f64) -> Option<f64> {
        match self {
            Self::Exact(ct) => Some(libm::cos(omega_over_c * ct)),
            Self::Leapfrog(steps, c_dt) => Some(libm::cos(steps as f64 * leapfrog_turn(omega_over_c, c_dt)?)),
        }
    }
}
