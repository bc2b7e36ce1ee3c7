//! From the words of a case to the scene of a bar or a plate: size, cells, edges, initial fields, effects, probes.

use super::balances::{BALANCE, MOMENTUM};
use super::march::MarchAsked;
use super::size::cells;
use super::snapshots;
use super::time::time;
use pd_verify::lattice::Lattice;
use pd_verify::material::{Body, Material};
use pd_verify::plan::Plan;
use pd_verify::scene::{
    Effect, Hole, HoleAsked, Initial, InitialAsked, Notch, NotchAsked, Positive, Probe, Quantity, Running,
    Scene, Watch, Wrong,
};
use std::sync::Arc;

/// Nodes times steps up to which the ledger is kept though no probe asks for it: seconds.
const MAX_BOOKED: u64 = 300_000_000;

/// The notches of a plate.
fn notches<const D: usize>(asked: &MarchAsked, nodes: [usize; D], spacing: f64) -> Result<Vec<Notch>, Wrong> {
    let written = asked.notch.as_deref().unwrap_or_default();
    if D == 1 && !written.is_empty() {
        return Err(Wrong::new("notch", "a bar has no notches", "leave them out, or take a plate"));
    }
    let size = plate_size(nodes, spacing);
    let one = |(index, notch): (usize, &NotchAsked)| {
        notch.check(size, spacing).map_err(|wrong| wrong.inside(&format!("notch[{index}]")))
    };
    written.iter().enumerate().map(one).collect()
}

/// Those of them that run.
fn running(asked: &MarchAsked) -> Vec<Running> {
    let written = asked.notch.iter().flatten().enumerate();
    written.filter_map(|(index, notch)| Some(notch.runs.as_ref()?.of(index))).collect()
}

/// The holes of a plate.
fn holes<const D: usize>(asked: &MarchAsked, nodes: [usize; D], spacing: f64) -> Result<Vec<Hole>, Wrong> {
    let written = asked.hole.as_deref().unwrap_or_default();
    if D == 1 && !written.is_empty() {
        return Err(Wrong::new("hole", "a bar has no holes", "leave them out, or take a plate"));
    }
    let size = plate_size(nodes, spacing);
    let one = |(index, hole): (usize, &HoleAsked)| {
        hole.check(size).map_err(|wrong| wrong.inside(&format!("hole[{index}]")))
    };
    written.iter().enumerate().map(one).collect()
}

fn plate_size<const D: usize>(nodes: [usize; D], spacing: f64) -> [f64; 2] {
    std::array::from_fn(|axis| nodes.get(axis).map_or(0.0, |&count| count as f64 * spacing))
}

/// The scene on one lattice with its plan, and whether energy and momentum are booked.
pub fn scene<const D: usize>(
    asked: &MarchAsked,
    name: String,
    material: Material,
    lattice: Lattice,
    effects: &[Arc<dyn Effect<D>>],
) -> Result<(Scene<D>, Plan), Wrong> {
    let (nodes, spacing) = cells(size(asked)?, asked.dx_m.0)?;
    let section = section::<D>(asked)?;
    let edges = asked.edges.unwrap_or_default().check().map_err(|wrong| wrong.inside("edges"))?;
    let mut scene = Scene {
        name,
        material,
        body: Body::from(asked.body),
        lattice,
        nodes,
        spacing,
        section,
        rotations: asked.rotations.unwrap_or_default(),
        operator: asked.operator.unwrap_or_default(),
        edges,
        notches: notches::<D>(asked, nodes, spacing)?,
        running: running(asked),
        holes: holes::<D>(asked, nodes, spacing)?,
        surface: asked.surface_correction.unwrap_or_default(),
        displacement: initial(asked, Quantity::Displacement)?,
        velocity: initial(asked, Quantity::Velocity)?,
        effects: effects.to_vec(),
        time: time(asked.duration_s, asked.safety, asked.time_step_s, asked.unstable)?,
        probes: Vec::new(),
        snapshots: snapshots::asked::<D>(asked)?,
    };
    for (index, probe) in asked.probe.iter().enumerate() {
        let probe = probe.check(scene.size()).map_err(|wrong| wrong.inside(&format!("probe[{index}]")));
        scene.probes.push(probe?);
    }
    let own = scene.probes.len();
    scene.probes.extend(
        [(BALANCE, Watch::Energies), (MOMENTUM, Watch::Momentum)].map(|(name, watch)| Probe {
            name: name.into(),
            watch,
            every: 1,
        }),
    );
    let mut plan = planned(&scene)?;
    let energies = scene.probes[..own].iter().any(|probe| probe.watch == Watch::Energies);
    if plan.node_updates > MAX_BOOKED && !energies {
        scene.probes.truncate(own);
        plan = planned(&scene)?;
    }
    for (index, probe) in scene.probes.iter_mut().enumerate() {
        let booked = plan.steps.div_ceil(1000).max(1);
        probe.every = asked.probe.get(index).map_or(booked, |asked| asked.every(plan.steps));
    }
    let plan = plan.paced(&scene)?;
    Ok((scene, plan))
}

/// The plan of a scene; only a study file can ask for a step above the limit, so only here that is said.
fn planned<const D: usize>(scene: &Scene<D>) -> Result<Plan, Wrong> {
    Plan::of(scene).map_err(|wrong| match wrong.key == "time_step_s" && wrong.message.contains("above") {
        true => Wrong { help: wrong.help + ", or say unstable = true to watch it happen", ..wrong },
        false => wrong,
    })
}

fn size<const D: usize>(asked: &MarchAsked) -> Result<[f64; D], Wrong> {
    let given: Vec<f64> = asked.size_m.0.iter().map(|length| length.0).collect();
    given.as_slice().try_into().map_err(|_| {
        let body = Body::from(asked.body).name();
        let message = format!("{} number(s) are no size of a {body} body", given.len());
        let help = if D == 1 { "give the length of the bar" } else { "give [length, height]" };
        Wrong::new("size_m", message, help)
    })
}

fn section<const D: usize>(asked: &MarchAsked) -> Result<f64, Wrong> {
    let (own, other) = (("section_m2", asked.section_m2), ("thickness_m", asked.thickness_m));
    let (own, other) = if D == 1 { (own, other) } else { (other, own) };
    match other {
        (key, Some(_)) => {
            let body = Body::from(asked.body).name();
            let message = format!("{key} says nothing about a {body} body");
            Err(Wrong::new(key, message, format!("give {} instead", own.0)))
        }
        (_, None) => Ok(own.1.map_or(1.0, |Positive(value)| value)),
    }
}

/// The initial fields that set a quantity.
fn initial<const D: usize>(asked: &MarchAsked, sets: Quantity) -> Result<Vec<Initial<D>>, Wrong> {
    let all: &[InitialAsked] = asked.initial.as_deref().unwrap_or(&[]);
    let here = all.iter().enumerate().filter(|(_, field)| field.sets == sets);
    here.map(|(index, field)| field.check().map_err(|wrong| wrong.inside(&format!("initial[{index}]"))))
        .collect()
}
