//! What is run to see what accuracy costs: one problem with one setting at one level, its errors, its work, its seconds.

use crate::dsif::setup::Setup;
use crate::dsif::tips::Tips;
use crate::question::Effort;
use crate::subject::Subject;
use pd_verify::model::Model;
use pd_verify::plan::Plan;
use pd_verify::record;
use pd_verify::scene::Scene;
use std::time::Instant;

/// What one run showed.
#[derive(Debug, Clone, PartialEq)]
pub struct Solved {
    /// One for each reading of the result.
    pub errors: Vec<Option<f64>>,
    /// Largest difference from the lattice's own exact answer, over the peak, where it has one.
    pub own: Option<f64>,
}

/// One problem, setting and level, ready to run.
pub trait Run: Send + Sync {
    /// Δx in m.
    fn spacing(&self) -> f64;
    /// cΔt/Δx, c the dilatational speed.
    fn courant(&self) -> f64;
    fn plan(&self) -> &Plan;
    fn effort(&self) -> Effort;
    /// The plate whose tip must be found at rest before a result is read, if one must.
    fn tip(&self) -> Option<&Setup> {
        None
    }
    /// `tips` are those of all runs.
    fn solve(&self, subject: &dyn Subject, tips: &Tips) -> Result<Solved, String>;
    /// Seconds of marching alone, so many times.
    fn seconds(&self, times: usize) -> Result<Vec<f64>, String>;
}

/// Marches a scene so often, and says what each march took in s: its model is made before.
pub fn seconds<const D: usize>(scene: &Scene<D>, plan: &Plan, times: usize) -> Result<Vec<f64>, String> {
    let model = Model::new(scene).map_err(|wrong| wrong.message)?;
    let mut taken = Vec::new();
    for _ in 0..times {
        let plan = plan.clone();
        let start = Instant::now();
        record::march(scene, plan, &model).map_err(|failure| failure.to_string())?;
        taken.push(start.elapsed().as_secs_f64());
    }
    Ok(taken)
}

/// What a run holds in memory, in bytes.
pub fn bytes(plan: &Plan) -> f64 {
    plan.bytes_per_node * plan.nodes as f64 + (plan.snapshot_bytes + plan.patch_bytes) as f64
}
