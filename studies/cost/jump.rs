//! `asks = "jump_cost"`: a stretched bar let go: its strain has jumps, at which every method's error falls slowly.

use super::problem::{Facts, Order, Problem};
use super::runs::{Run, Solved, seconds};
use super::settings::{Setting, SettingsAsked, Track};
use super::work_precision::WorkPrecision;
use crate::bar::released::{BarAsked, Released};
use crate::convergence::refined::Bound;
use crate::convergence::whole::{self, SEEN};
use crate::dsif::tips::Tips;
use crate::levels::relative;
use crate::question::Effort;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::scene::{Positive, Scene, Snapshots, StepRule, Time, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JumpCostAsked {
    pub bar: BarAsked,
    /// When the strain is held against the exact one.
    pub duration_s: Positive,
    pub settings: SettingsAsked,
}

/// The bar, and when it is looked at.
struct Jump {
    bar: Released,
    /// In s.
    duration: f64,
}

/// One march of the bar.
struct Marched {
    bar: Released,
    scene: Scene<1>,
    plan: Plan,
}

impl Asked for JumpCostAsked {
    type Question = WorkPrecision;

    fn check(&self, written: &Written<'_>) -> Result<WorkPrecision, Wrong> {
        let settings = self.settings.all(Body::Bar).map_err(|wrong| wrong.inside("settings"))?;
        let spacings = self.settings.spacings().map_err(|wrong| wrong.inside("settings"))?;
        let jump = Jump { bar: self.bar.check(written.material()?)?, duration: self.duration_s.0 };
        WorkPrecision::new(written.title, &jump, settings, &spacings)
    }
}

impl Problem for Jump {
    fn facts(&self) -> Facts {
        Facts {
            what: "the strain of a stretched bar let go".into(),
            equations: "error Σ |ε − ε_exact| / Σ |ε_exact| at the end, ε = (u(x + Δx) − u(x))/Δx between all nodes\n\
                exact: half the initial strain travels each way, turned round at the free end (d'Alembert)",
            source: "d'Alembert's solution; modes of the mirrored lattice in double-double arithmetic",
            error_kind: ErrorKind::L1Relative,
            dimension: 1,
            own: Some(Bound {
                at_most: 1e-10,
                basis: Basis::Rounding,
                because: "leapfrog turns every mode of the lattice by 2 asin(ωΔt/2) exactly: some 1e-16 a step",
            }),
            order: Some(Order {
                expected: 0.5,
                within: 0.1,
                steady: false,
                // Fronts are some horizons wide, and the law is that of fronts far from where they began.
                widest: 0.03 * self.bar.exact.length,
                because: "an Airy front of width Δx^(2/3) with ripples that fall off like (distance)^(-3/4); the next term is smaller by Δx^(1/6) only",
            }),
            readings: vec![String::new()],
            falling: Vec::new(),
            disperses: false,
        }
    }

    fn track(&self, setting: Setting, spacings: &[f64]) -> Result<Track, Wrong> {
        let run = |&spacing: &f64| {
            let time = Time { duration: self.duration, step: StepRule::OfLimit(setting.safety) };
            let bare = self.bar.scene(setting.lattice, spacing, time, Vec::new())?;
            let scene = Scene {
                snapshots: vec![Snapshots { name: SEEN.into(), times: vec![self.duration] }],
                ..bare
            };
            let plan = Plan::of(&scene)?;
            Ok(Box::new(Marched { bar: self.bar, scene, plan }) as Box<dyn Run>)
        };
        Ok(Track { setting, runs: spacings.iter().map(run).collect::<Result<_, Wrong>>()? })
    }
}

impl Run for Marched {
    fn spacing(&self) -> f64 {
        self.scene.spacing
    }

    fn courant(&self) -> f64 {
        self.bar.courant(&self.scene, &self.plan)
    }

    fn plan(&self) -> &Plan {
        &self.plan
    }

    fn effort(&self) -> Effort {
        // The exact modes are summed at every node.
        let reference_evaluations = self.plan.nodes * self.plan.nodes / 1000;
        Effort { reference_evaluations, ..Effort::of_scenes(std::slice::from_ref(&self.plan)) }
    }

    fn solve(&self, subject: &dyn Subject, _: &Tips) -> Result<Solved, String> {
        let record = subject.march_bar(&self.scene).map_err(|failure| failure.to_string())?;
        let [seen] = whole::last(&self.scene, &record)? else { return Err("a bar has one component".into()) };
        let time = self.plan.time_step_s * self.plan.steps as f64;
        let place = |j: usize| (j as f64 + 0.5) * self.scene.spacing;
        let exact: Vec<f64> =
            (0..seen.len()).map(|j| self.bar.exact.displacement_at(place(j), time)).collect();
        let strains = |u: &[f64]| -> Vec<f64> { u.windows(2).map(|pair| pair[1] - pair[0]).collect() };
        let [l1, ..] = relative(strains(seen).into_iter().zip(strains(&exact)));
        let modes = self.bar.modes(&self.scene, Some(self.courant())).ok_or("no stable modes")?;
        let own = modes.displacements(self.bar.cell_times(&self.scene, time));
        let far = seen.iter().zip(own).map(|(u, own)| (u / self.bar.peak() - own).abs());
        Ok(Solved { errors: vec![Some(l1)], own: largest(far) })
    }

    fn seconds(&self, times: usize) -> Result<Vec<f64>, String> {
        seconds(&self.scene, &self.plan, times)
    }
}
