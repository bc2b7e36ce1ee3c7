//! A run from a scene to what was seen of it: plan, model, march to the next look, look.

mod diverged;
mod look;
mod patch;
mod snapshot;
mod watching;

pub use diverged::Diverged;
pub use patch::Patch;
pub use snapshot::Snapshot;
pub use watching::LAST_SOUND;
pub(crate) use watching::looks_of_growth;

use crate::ledger::Ledger;
use crate::march::March;
use crate::model::Model;
use crate::plan::Plan;
use crate::scene::{Scene, Watch, Wrong};
use look::{book, look, trace};
pub(crate) use look::{corners, line};
use snapshot::Due;
use thiserror::Error;
use watching::Watching;

/// What was seen of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    pub plan: Plan,
    pub traces: Vec<Trace>,
    /// In the order in which they were taken.
    pub snapshots: Vec<Snapshot>,
}

impl Record {
    /// The trace of a probe.
    pub fn trace(&self, probe: &str) -> Option<&Trace> {
        self.traces.iter().find(|trace| trace.probe == probe)
    }
}

/// What one probe saw.
#[derive(Debug, Clone, PartialEq)]
pub struct Trace {
    pub probe: String,
    pub columns: Vec<Column>,
    /// In s.
    pub times: Vec<f64>,
    /// One row for each time, one value for each column.
    pub rows: Vec<Vec<f64>>,
}

impl Trace {
    /// All values, look by look, without those of places where no node stands.
    pub fn known(&self) -> impl Iterator<Item = f64> {
        let values = self.rows.iter().flat_map(|row| row.iter().zip(&self.columns));
        values.filter(|(_, column)| !column.removed).map(|(value, _)| *value)
    }

    /// One column over time.
    pub fn column(&self, index: usize) -> Vec<f64> {
        self.rows.iter().map(|row| row[index]).collect()
    }
}

/// A quantity at a place.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    pub quantity: &'static str,
    pub unit: &'static str,
    /// In m; `None` for quantities of the whole body.
    pub at: Option<Vec<f64>>,
    /// Whether no node stands there, since it lies in a hole: then there is no value, all are NaN.
    pub removed: bool,
}

/// Why a run has no record.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Failure {
    /// The scene cannot be run.
    #[error("{}", .0.message)]
    Wrong(Wrong),
    /// It grows without bound, or a displacement is no longer a number.
    #[error("{0}")]
    Diverged(Box<Diverged>),
}

/// Runs a scene from beginning to end.
pub fn run<const D: usize>(scene: &Scene<D>) -> Result<Record, Failure> {
    let plan = Plan::of(scene).map_err(Failure::Wrong)?;
    let model = Model::new(scene).map_err(Failure::Wrong)?;
    march(scene, plan, &model)
}

/// Runs a scene on a model made for it.
pub fn march<const D: usize>(scene: &Scene<D>, plan: Plan, model: &Model<D>) -> Result<Record, Failure> {
    let mut march = March::new(model, scene, plan.time_step_s);
    let booked = scene.probes.iter().any(|probe| probe.watch == Watch::Energies);
    let mut ledger = booked.then(|| Ledger::new(model));
    let mut traces: Vec<Trace> = scene.probes.iter().map(|probe| trace(probe, &model.grid)).collect();
    let mut due = Due::new(&scene.snapshots, plan.time_step_s, plan.steps);
    let mut snapshots = Vec::new();
    let mut watching = Watching::new(scene);
    loop {
        let step = march.step();
        for (probe, trace) in scene.probes.iter().zip(&mut traces) {
            if step.is_multiple_of(probe.every) || step == plan.steps {
                look(probe, &march, trace);
            }
        }
        snapshots.extend(due.take(scene, &march));
        if step >= plan.steps {
            return Ok(Record { plan, traces, snapshots });
        }
        let looks = scene.probes.iter().map(|probe| (step / probe.every + 1) * probe.every);
        let events = looks.chain(due.next()).chain([plan.steps, watching.next(step)]);
        let next = events.min().unwrap_or(plan.steps).min(plan.steps);
        match &mut ledger {
            None => march.advance_to(next),
            Some(ledger) => {
                for _ in step..next {
                    march.advance_booked(ledger);
                    book(&scene.probes, &march, ledger, &mut traces);
                }
            }
        }
        if watching.diverges(scene, &mut march, plan.steps) {
            let diverged = watching.given_up(scene, march, Record { plan, traces, snapshots });
            return Err(Failure::Diverged(Box::new(diverged)));
        }
    }
}
