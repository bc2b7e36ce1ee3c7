//! The beginning of a scene marched twice, by the stencil and by the list of bonds, which share no loop over bonds.

use super::either::Either;
use crate::subject::Subject;
use pd_verify::plan::Plan;
use pd_verify::record::Record;
use pd_verify::scene::{Operator, Wrong};

/// Steps that are compared.
const MOST_STEPS: u64 = 200;

/// Visits of bonds that each of the two may cost: seconds.
const MAX_VISITS: u64 = 400_000_000;

/// A list of more bonds takes gigabytes.
const MAX_BONDS: u64 = 10_000_000;

/// The two marches, with their plans.
#[derive(Debug, Clone)]
pub struct Twice {
    pub scenes: [Either; 2],
    pub plans: [Plan; 2],
}

impl Twice {
    /// As many of the scene's first steps as the cost allows; `None` where it allows none.
    pub fn of(scene: &Either, plan: &Plan) -> Result<Option<Self>, Wrong> {
        let steps = MOST_STEPS.min(plan.steps).min(MAX_VISITS / plan.bonds.max(1));
        if steps == 0 || plan.bonds > MAX_BONDS {
            return Ok(None);
        }
        let scenes =
            [Operator::Stencil, Operator::Bonds].map(|operator| scene.beginning(operator, steps, plan));
        let plans = [scenes[0].plan()?, scenes[1].plan()?];
        Ok(Some(Self { scenes, plans }))
    }

    /// Steps of each.
    pub fn steps(&self) -> u64 {
        self.plans[0].steps
    }

    /// Largest difference of a displacement over the largest displacement; `None` where nothing moved.
    pub fn difference(&self, subject: &dyn Subject) -> Result<Option<f64>, String> {
        let march = |scene: &Either| scene.march(subject).map_err(|failure| failure.to_string());
        let [stencil, bonds] = [march(&self.scenes[0])?, march(&self.scenes[1])?];
        let values =
            |record: &Record| -> Vec<f64> { record.traces.iter().flat_map(|trace| trace.known()).collect() };
        let (a, b) = (values(&stencil), values(&bonds));
        if a.len() != b.len() {
            return Err("the two operators were not seen at the same places and times".to_owned());
        }
        let largest = a.iter().chain(&b).map(|u| u.abs()).fold(0.0, f64::max);
        let apart = a.iter().zip(&b).map(|(a, b)| (a - b).abs());
        let apart = apart.fold(0.0, |most, d| if d > most || d.is_nan() { d } else { most });
        Ok((largest > 0.0).then(|| apart / largest))
    }
}

/// What rounding may do to `steps` steps of a body whose nodes have `bonds` bonds.
///
/// A force is a sum of `bonds` terms, so the operators differ by ε·bonds times Σw|η| ≤ 2|u|Σw; Δt²Σw/ρ ≤ 2 below the
/// limit, hence increments by 4ε·bonds·|u| a step; after n steps the n²/2 sums of such increments are in u.
pub fn rounding(bonds: usize, steps: u64) -> f64 {
    2.0 * f64::EPSILON * bonds as f64 * (steps as f64).powi(2)
}
