//! Motions that grow for good reasons, at the limit itself: no divergence, and none may be taken for one.

use super::body::FreeBody;
use crate::subject::Subject;
use pd_verify::compare::largest;
use pd_verify::forces::{ForceField, Traction};
use pd_verify::plan::Plan;
use pd_verify::record::{Failure, Record};
use pd_verify::scene::{
    Axis, Effect, History, HistoryAsked, HistoryShape, Initial, Probe, Rotations, Scene, Shape, Side,
    StepRule, Time, Watch, Wrong,
};
use std::sync::Arc;

/// Looks at the energies.
const LOOKS: u64 = 2000;
/// What a load that grows ends with, over what it begins with.
const LOUDER: f64 = 1e6;
/// Strains under the loads, about: of small rotations any would do.
const STRAIN: f64 = 1e-3;
const ENERGIES: &str = "energies";

/// What a body does, and whether it was taken for a divergence.
pub struct Grown {
    pub name: &'static str,
    pub alarm: bool,
    /// Largest kinetic energy over that of the first of the looks.
    pub growth: Option<f64>,
    /// Steps and kinetic energies in J.
    pub kinetic: Vec<(u64, f64)>,
}

impl FreeBody {
    /// Plans of its motions that grow, by name.
    pub fn sound_plans(&self, steps: u64) -> Result<Vec<Plan>, Wrong> {
        match self {
            Self::Bar(scene) => motions(scene, steps).iter().map(|(_, scene)| Plan::of(scene)).collect(),
            Self::Plate(scene) => motions(scene, steps).iter().map(|(_, scene)| Plan::of(scene)).collect(),
        }
    }

    /// Marches them.
    pub fn grow_soundly(&self, subject: &dyn Subject, steps: u64) -> Result<Vec<Grown>, String> {
        match self {
            Self::Bar(scene) => {
                let each = motions(scene, steps);
                each.iter().map(|(name, scene)| grown(name, subject.march_bar(scene))).collect()
            }
            Self::Plate(scene) => {
                let each = motions(scene, steps);
                each.iter().map(|(name, scene)| grown(name, subject.march_plate(scene))).collect()
            }
        }
    }
}

/// The body under loads, from rest, each for so many steps at the lattice's limit; with finite rotations, which tension
/// makes faster, a tenth below it.
fn motions<const D: usize>(body: &Scene<D>, steps: u64) -> Vec<(&'static str, Scene<D>)> {
    // About so many steps: the limit of a lattice is one to three Δx/c.
    let duration = 2.0 * steps as f64 * body.spacing / body.speed();
    let length = body.size()[0];
    let stress = STRAIN * body.material.youngs_modulus;
    let pulled = |stress_pa: f64, history: HistoryAsked| -> Arc<dyn Effect<D>> {
        Arc::new(Traction { edge: Side::Right, axis: Axis::X, stress_pa, history })
    };
    let points = 40;
    let share = |n: i32| f64::from(n) / f64::from(points);
    let louder = HistoryAsked {
        shape: HistoryShape::Table,
        times_s: Some((0..=points).map(|n| duration * share(n)).collect()),
        values: Some((0..=points).map(|n| libm::pow(LOUDER, share(n) - 1.0)).collect()),
        ..HistoryAsked::step()
    };
    let mut wavenumber = [0.0; D];
    wavenumber[0] = std::f64::consts::PI / length;
    let swing =
        Initial { component: 0, amplitude: stress / length, shape: Shape::Wave { wavenumber, phase: 0.0 } };
    let history = History::Sine { start: 0.0, period: 2.0 * length / body.speed() };
    let resonance: Arc<dyn Effect<D>> = Arc::new(ForceField { fields: vec![swing], history });
    let made = |effect, share: f64, rotations| Scene {
        time: Time { duration, step: StepRule::OfLimit(share) },
        probes: vec![Probe { name: ENERGIES.into(), watch: Watch::Energies, every: (steps / LOOKS).max(1) }],
        displacement: Vec::new(),
        effects: vec![effect],
        rotations,
        ..body.clone()
    };
    vec![
        ("shaken near resonance", made(resonance, 1.0, Rotations::Small)),
        ("pulled for ever", made(pulled(stress, HistoryAsked::step()), 1.0, Rotations::Small)),
        ("pulled ever more", made(pulled(stress, louder.clone()), 1.0, Rotations::Small)),
        ("pulled ever more, finite rotations", made(pulled(stress, louder), 0.9, Rotations::Finite)),
    ]
}

fn grown(name: &'static str, run: Result<Record, Failure>) -> Result<Grown, String> {
    let (record, alarm) = match run {
        Ok(record) => (record, false),
        Err(Failure::Diverged(diverged)) => (diverged.record, true),
        Err(wrong) => return Err(wrong.to_string()),
    };
    let trace = record.trace(ENERGIES).ok_or("the energies were not seen")?;
    let step = |time: f64| (time / record.plan.time_step_s).round() as u64;
    let kinetic: Vec<(u64, f64)> =
        trace.times.iter().zip(&trace.rows).map(|(time, row)| (step(*time), row[0])).collect();
    let first = kinetic.get(1).map_or(f64::NAN, |look| look.1);
    let growth = largest(kinetic.iter().skip(1).map(|look| look.1 / first));
    Ok(Grown { name, alarm, growth, kinetic })
}
