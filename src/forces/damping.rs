//! Damping in proportion to mass: −ρ α u̇, with the velocity at the middle of the step.
//!
//! Leapfrog knows velocities half a step ago, d = u(n) − u(n−1) = Δt v, and makes d' = d + Δt²/ρ (F + f) of the sum F
//! of the other forces. Asking f = −ρα (d + d')/(2Δt) of the damping force and solving for it gives
//! f = −(2ρ d/Δt² + F) a/(1 + a), a = αΔt/2: second order in Δt, stable up to the limit of the undamped body.

use super::{Class, Force, Now};
use crate::grid::{Grid, Run};
use crate::scene::{Acts, Effect, Positive, Setting, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// Damping as asked for.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Damping {
    /// α: a free motion decays like e^(−αt/2).
    pub rate_per_s: Positive,
}

impl<const D: usize> Effect<D> for Damping {
    fn name(&self) -> String {
        "damping".into()
    }

    fn act(&self, setting: &Setting<'_, D>) -> Result<Acts<D>, Wrong> {
        Ok(Acts::Force(Box::new(Damper::new(setting.grid, setting.density, self.rate_per_s.0))))
    }

    fn neutral(&self, _until: f64) -> Option<&'static str> {
        (self.rate_per_s.0 == 0.0).then_some("its rate is 0")
    }
}

/// Damping as it acts.
pub struct Damper {
    density: f64,
    rate: f64,
    start: usize,
    piece: usize,
    stride: usize,
    runs: Vec<Vec<Run>>,
}

impl Damper {
    pub fn new<const D: usize>(grid: &Grid<D>, density: f64, rate: f64) -> Self {
        let runs = grid.runs(|_| true);
        Self { density, rate, start: grid.body().start, piece: grid.piece(), stride: grid.stride(), runs }
    }
}

impl<const D: usize> Force<D> for Damper {
    fn name(&self) -> String {
        "damping".into()
    }

    fn class(&self) -> Class {
        Class::Rate
    }

    fn add(&self, now: &Now<'_>, piece: usize, sum: &mut [f64]) {
        let half = 0.5 * self.rate * now.time_step;
        let (share, momentum) = (half / (1.0 + half), 2.0 * self.density / (now.time_step * now.time_step));
        let start = self.start + piece * self.piece;
        for run in &self.runs[piece] {
            for axis in 0..D {
                let from = run.start + axis * self.stride;
                let sums = &mut sum[from - start..from - start + run.len];
                for (sum, d) in sums.iter_mut().zip(&now.increment[from..from + run.len]) {
                    *sum -= share * (momentum * d + *sum);
                }
            }
        }
    }

    fn bytes(&self) -> usize {
        self.runs.iter().map(|runs| size_of_val(runs.as_slice())).sum()
    }
}
