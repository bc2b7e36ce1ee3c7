//! The whole body at the end of a march: how studies look at it, and its nodes in the order in which it is seen.

use super::path::{Level, PathAsked, Refine, Sequence, WeightsAsked};
use super::space::{In, Space};
use crate::bar::names;
use crate::dispersion::curve::reference_lattice;
use crate::question::Effort;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::record::Record;
use pd_verify::scene::{Beyond, Scene, StepRule, Wrong};
use pd_verify_reference::medium::Medium;

/// Name of the snapshot.
pub const SEEN: &str = "end";

/// All nodes, row by row along x.
pub fn nodes<const D: usize>(scene: &Scene<D>) -> impl Iterator<Item = [usize; D]> + use<D> {
    let counts = scene.nodes;
    (0..counts.iter().product()).map(move |n: usize| {
        std::array::from_fn(|axis| if axis == 0 { n % counts[0] } else { n / counts[0] })
    })
}

/// Displacements of the last snapshot of a scene in m, a field for each component.
pub fn last<'r, const D: usize>(scene: &Scene<D>, record: &'r Record) -> Result<&'r [Vec<f64>], String> {
    let count = scene.nodes.iter().product::<usize>();
    match record.snapshots.last() {
        Some(snapshot)
            if snapshot.step == record.plan.steps
                && snapshot.displacement.len() == D
                && snapshot.displacement.iter().all(|field| field.len() == count) =>
        {
            Ok(&snapshot.displacement)
        }
        _ => Err("the whole body was not seen at the end".into()),
    }
}

/// The scenes of all levels with their plans: at `safety` of the limit where the path begins, and the same cΔt/Δx all
/// along it; `known` is the limit of the coarsest level in s, if it need not be searched for. (At fixed δ the limit tends to a constant, and so would the error of the time step.)
pub fn stepped<const D: usize>(
    sequence: &Sequence,
    safety: f64,
    known: Option<f64>,
    scene: impl Fn(Level, StepRule) -> Result<Scene<D>, Wrong>,
) -> Result<Vec<(Scene<D>, Plan)>, Wrong> {
    let coarsest = sequence.levels[0];
    let coarse = scene(coarsest, StepRule::OfLimit(safety))?;
    let coarse = known.map_or_else(|| Plan::of(&coarse), |limit| Plan::below(&coarse, limit))?;
    let limit = coarse.time_step_s / coarse.time_step_over_limit;
    let level = |&level: &Level| {
        let mut made = scene(level, StepRule::OfLimit(safety))?;
        let finer = coarsest.spacing / level.spacing;
        let steps = (coarse.steps as f64 * finer - 1e-9).ceil();
        made.time.step =
            StepRule::Given { seconds: made.time.duration / steps, beyond_limit: Beyond::Refused };
        let plan = match level.m == coarsest.m {
            true => Plan::below(&made, limit / finer)?,
            false => Plan::of(&made)?,
        };
        Ok((made, plan))
    };
    sequence.levels.iter().map(level).collect()
}

/// Whether a node lies within a frame of so many held layers.
pub fn inside<const D: usize>(node: [usize; D], held: usize, nodes: [usize; D]) -> bool {
    (0..D).all(|axis| node[axis] >= held && node[axis] + held < nodes[axis])
}

/// Refinements of plates in δ with their names, where the moduli are the intended ones: else their error does not fall.
pub fn falling(
    path: &PathAsked,
    body: Body,
    weights: &WeightsAsked,
) -> Result<Vec<(Sequence, String)>, Wrong> {
    if path.refine != Refine::Delta {
        let message = "what is free at its edges is refined in δ at fixed m";
        return Err(Wrong::new("path.refine", message, "take refine = \"delta\""));
    }
    let sequences = path.sequences(body, weights)?;
    let finest: Vec<_> = sequences.iter().map(|one| one.lattice(one.finest())).collect();
    let named: Vec<(Sequence, String)> = sequences.into_iter().zip(names::names(&finest)).collect();
    let intended = |one: &Sequence| <In as Space<2>>::intended(one.lattice(one.finest()));
    match named.iter().find(|(sequence, _)| !intended(sequence)) {
        None => Ok(named),
        Some((_, name)) => {
            let message =
                format!("{name}: its moduli are not the intended ones, so that its error does not fall");
            Err(Wrong::new("weights.calibrated", message, "take calibrated = true"))
        }
    }
}

/// The work of finding a body at rest: some six iterations of conjugate gradients for each node of a side.
pub fn resting(plan: &Plan, side: usize) -> Effort {
    let times = 6 * side as u64;
    Effort {
        curves: 1,
        node_updates: plan.nodes * times,
        bond_evaluations: plan.bonds * times,
        reference_evaluations: plan.nodes / 100,
        ..Effort::default()
    }
}

/// The lattice of a scene as a medium.
pub fn lattice<const D: usize>(scene: &Scene<D>) -> Medium {
    Medium::Lattice { lattice: reference_lattice(scene.lattice), spacing: scene.spacing }
}
