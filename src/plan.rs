//! How a scene is served and what it costs, decided before anything is computed: effects, operator, Δt, work.

use crate::connectivity::Connectivity;
use crate::constraints::Edge;
use crate::dispersion::timestep;
use crate::forces::surface::Correction;
use crate::forces::{BondList, Class, Finite, LatticeStencil, Law, Small, family};
use crate::grid::Grid;
use crate::lattice::{Stencil, Unusable};
use crate::model::surface_factors;
use crate::scene::{Acts, Operator, Rotations, Scene, Setting, StepRule, Watch, Wrong, snapshot};
use serde::Serialize;
use std::collections::HashSet;

/// What will be done.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    pub name: String,
    pub effects_on: Vec<String>,
    pub effects_off: Vec<String>,
    pub operator: String,
    pub nodes: u64,
    /// Each once; a bond to a mirrored node, which ends twice at its owner, counts half.
    pub bonds: u64,
    /// State, force and what operators and loads keep.
    pub bytes_per_node: f64,
    /// What the snapshots of the whole body hold.
    pub snapshot_bytes: u64,
    pub time_step_s: f64,
    /// Above 1 leapfrog is unstable.
    pub time_step_over_limit: f64,
    pub steps: u64,
    pub node_updates: u64,
    /// Each bond once per step.
    pub bond_updates: u64,
}

/// A block larger than this is a slip of the pen.
const MAX_NODES: usize = 1 << 28;

/// A march of more steps takes weeks on the smallest body.
const MAX_STEPS: u64 = 1_000_000_000_000;

/// From here on the search for the sharp limit in the plane takes minutes, and the row-sum bound stands in for it.
const LARGEST_SEARCHED_M: f64 = 20.0;

impl Plan {
    /// Checks a scene and says how it will be run.
    pub fn of<const D: usize>(scene: &Scene<D>) -> Result<Self, Wrong> {
        let stencil = check_body(scene)?;
        check_probes(scene)?;
        let grid = Grid::new(scene.nodes, scene.spacing, stencil.reach());
        let setting = Setting::of(scene, &grid);
        let mut bytes = state_bytes(scene, &grid);
        let mut terms = Terms::default();
        for (index, effect) in scene.effects.iter().enumerate() {
            let acts = effect.act(&setting).and_then(|acts| terms.join(acts));
            acts.map_err(|wrong| wrong.inside(&format!("effect[{index}]")))?;
        }
        bytes += terms.bytes;
        let connectivity = Connectivity::of(scene);
        let ends = bond_ends(scene, &stencil, &connectivity, &grid);
        bytes += operator_bytes(scene, &grid, &stencil, &connectivity, ends);
        let band = band(scene, &stencil, &grid);
        bytes += BondList::<D, Small>::bytes_for(band.nodes, (2 * band.nodes * stencil.bonds.len()) as u64);
        let limit = stable_time_step(scene, &stencil) / band.largest_factor.sqrt();
        let (time_step, over_limit, steps) = time_step(scene, limit)?;
        let nodes = grid.count() as u64;
        let (effects_on, effects_off) = effects(scene);
        Ok(Self {
            name: scene.name.clone(),
            effects_on,
            effects_off,
            operator: operator(scene, band.nodes),
            nodes,
            bonds: ends / 2,
            bytes_per_node: bytes as f64 / nodes as f64,
            snapshot_bytes: snapshot::bytes(scene, time_step, steps)?,
            time_step_s: time_step,
            time_step_over_limit: over_limit,
            steps,
            node_updates: nodes.saturating_mul(steps),
            bond_updates: (ends / 2).saturating_mul(steps),
        })
    }

    /// The same plan, which also says which of these effects are off. Only who reads scenes knows all that there are.
    pub fn beside(mut self, effects: impl IntoIterator<Item = String>) -> Self {
        let off = effects.into_iter().filter(|name| !self.effects_on.contains(name));
        self.effects_off.extend(off);
        self
    }
}

/// What the effects of a scene become, together.
#[derive(Default)]
struct Terms {
    bytes: usize,
    driven: HashSet<usize>,
    rates: usize,
}

impl Terms {
    /// Counts a term, refused where it contradicts another.
    fn join<const D: usize>(&mut self, acts: Acts<D>) -> Result<(), Wrong> {
        match acts {
            Acts::Force(force) => {
                self.bytes += force.bytes();
                self.rates += usize::from(force.class() == Class::Rate);
                if self.rates > 1 {
                    let message = "two effects depend on the velocity; the step is solved for one of them";
                    return Err(Wrong::new("", message, "leave one out, or add their rates"));
                }
            }
            Acts::Constraint(constraint) => {
                self.bytes += size_of_val(constraint.places());
                if !constraint.places().iter().all(|&place| self.driven.insert(place)) {
                    let message = "some of these nodes are driven along this axis by another motion too";
                    return Err(Wrong::new(
                        "region",
                        message,
                        "let the regions keep apart, or leave one motion out",
                    ));
                }
            }
        }
        Ok(())
    }
}

fn operator<const D: usize>(scene: &Scene<D>, band: usize) -> String {
    let name = match scene.operator {
        Operator::Stencil => "stencil",
        Operator::Bonds => "bonds",
    };
    if band == 0 { name.into() } else { format!("{name}, {band} nodes as a list") }
}

/// Nodes along corrected edges, served by a list of bonds.
struct Band {
    nodes: usize,
    largest_factor: f64,
}

fn band<const D: usize>(scene: &Scene<D>, stencil: &Stencil<D>, grid: &Grid<D>) -> Band {
    let family = family(stencil, scene.modulus(), scene.spacing);
    match surface_factors(scene, &family, grid) {
        None => Band { nodes: 0, largest_factor: 1.0 },
        Some(factors) => Band {
            nodes: grid.each().filter(|node| !factors.neutral(*node)).count(),
            largest_factor: factors.largest(grid),
        },
    }
}

/// Displacement, increment and force, and what the ledger remembers of each step.
fn state_bytes<const D: usize>(scene: &Scene<D>, grid: &Grid<D>) -> usize {
    let ledger = scene.probes.iter().any(|probe| probe.watch == Watch::Energies);
    let fields = if ledger { 6 } else { 3 };
    fields * size_of::<f64>() * grid.field().len()
}

/// Bonds counted once from each of their ends: by the sizes alone where no notch cuts.
fn bond_ends<const D: usize>(
    scene: &Scene<D>,
    stencil: &Stencil<D>,
    connectivity: &Connectivity<D>,
    grid: &Grid<D>,
) -> u64 {
    let both = stencil.bonds.iter().flat_map(|bond| [bond.offset, bond.offset.map(|n| -n)]);
    if connectivity.notched() {
        return both
            .map(|offset| grid.each().filter(|node| connectivity.present(*node, offset)).count() as u64)
            .sum();
    }
    let ends = |offset: [i32; D]| -> u64 {
        let along = |axis: usize| {
            let [below, above] = scene.edges.0[axis];
            let lost = if offset[axis] < 0 { below } else { above } == Edge::Free;
            let shift = offset[axis].unsigned_abs() as usize;
            (scene.nodes[axis] - if lost { shift.min(scene.nodes[axis]) } else { 0 }) as u64
        };
        (0..D).map(along).product()
    };
    both.map(ends).sum()
}

/// What the operator keeps, from counts alone.
fn operator_bytes<const D: usize>(
    scene: &Scene<D>,
    grid: &Grid<D>,
    stencil: &Stencil<D>,
    connectivity: &Connectivity<D>,
    ends: u64,
) -> usize {
    match (scene.operator, scene.rotations) {
        (Operator::Bonds, Rotations::Small) => BondList::<D, Small>::bytes_for(grid.count(), ends),
        (Operator::Bonds, Rotations::Finite) => BondList::<D, Finite>::bytes_for(grid.count(), ends),
        (Operator::Stencil, _) => {
            let (runs, whole) = whole_nodes(scene, grid, stencil, connectivity);
            LatticeStencil::<D, Small>::bytes_for(stencil.bonds.len(), runs, grid.count() - whole)
        }
    }
}

/// Runs of nodes that have all their bonds, and how many nodes: by the sizes alone where no notch cuts.
fn whole_nodes<const D: usize>(
    scene: &Scene<D>,
    grid: &Grid<D>,
    stencil: &Stencil<D>,
    connectivity: &Connectivity<D>,
) -> (usize, usize) {
    if connectivity.notched() {
        let has = |node, offset: [i32; D]| {
            connectivity.present(node, offset) && connectivity.present(node, offset.map(|n| -n))
        };
        let runs = grid.runs(|node| stencil.bonds.iter().all(|bond| has(node, bond.offset)));
        return (runs.iter().map(Vec::len).sum(), runs.iter().flatten().map(|run| run.len).sum());
    }
    let whole: [usize; D] = std::array::from_fn(|axis| {
        let free = scene.edges.0[axis].iter().filter(|edge| **edge == Edge::Free).count();
        grid.nodes[axis].saturating_sub(free * grid.halo)
    });
    let count: usize = whole.iter().product();
    // A plate has a run in each row, a bar one in each piece that holds whole nodes.
    let first = grid.halo * (1 + usize::from(scene.edges.0[0][0] == Edge::Free));
    let pieces = || (first + count).div_ceil(grid.piece()) - first / grid.piece();
    let runs = if count == 0 { 0 } else { whole.get(1).copied().unwrap_or_else(pieces) };
    (runs, count)
}

fn effects<const D: usize>(scene: &Scene<D>) -> (Vec<String>, Vec<String>) {
    let mut on: Vec<String> = scene.effects.iter().map(|effect| effect.name()).collect();
    let mut off = Vec::new();
    let mut say = |is_on: bool, name: &str| if is_on { on.push(name.into()) } else { off.push(name.into()) };
    let law = if scene.rotations == Rotations::Finite { Finite::NAME } else { Small::NAME };
    say(true, &format!("{law} rotations"));
    say(scene.lattice.calibrated, "lattice calibration");
    say(!scene.notches.is_empty(), "notch");
    say(scene.surface != Correction::None, "surface correction");
    say(!scene.displacement.is_empty(), "initial displacement");
    say(!scene.velocity.is_empty(), "initial velocity");
    for edge in [Edge::MirrorOdd, Edge::MirrorEven, Edge::Periodic] {
        let here = scene.edges.0.as_flattened().contains(&edge);
        say(here, &format!("{} edge", edge.name()));
    }
    say(scene.probes.iter().any(|probe| probe.watch == Watch::Energies), "energy ledger");
    (on, off)
}

fn check_body<const D: usize>(scene: &Scene<D>) -> Result<Stencil<D>, Wrong> {
    let unusable = |wrong: Unusable| Wrong::new("lattice.m", wrong.to_string(), wrong.cure());
    let stencil = Stencil::<D>::new(scene.lattice).map_err(unusable)?;
    let horizon = scene.lattice.m * scene.spacing;
    let smallest = scene.size().into_iter().fold(f64::INFINITY, f64::min);
    if horizon > smallest * (1.0 + 1e-12) {
        let message = format!("the horizon of {horizon} m is larger than the body of {smallest} m");
        return Err(Wrong::new("lattice.m", message, "take a smaller m or spacing, or a larger body"));
    }
    if scene.nodes.iter().try_fold(1_usize, |count, &n| count.checked_mul(n)).is_none_or(|n| n > MAX_NODES) {
        let message = format!("{:?} nodes do not fit a block of {MAX_NODES}", scene.nodes);
        return Err(Wrong::new("dx_m", message, "take a larger spacing or a smaller body"));
    }
    for (axis, [below, above]) in scene.edges.0.into_iter().enumerate() {
        let key = ["edges.left", "edges.bottom"][axis];
        if (below == Edge::Periodic) != (above == Edge::Periodic) {
            let message = "a periodic edge needs a periodic edge on the other side";
            return Err(Wrong::new(key, message, "make both edges of the axis periodic"));
        }
        let ghosts = below != Edge::Free || above != Edge::Free;
        if ghosts && stencil.reach() > scene.nodes[axis] {
            let message =
                format!("the family reaches {} nodes, the body has {}", stencil.reach(), scene.nodes[axis]);
            return Err(Wrong::new(key, message, "take a smaller horizon, a larger body, or free edges"));
        }
        let even = below == Edge::MirrorEven || above == Edge::MirrorEven;
        if D == 2 && even && scene.rotations == Rotations::Finite {
            let message = "mirror_even is no symmetry of a plate with finite rotations";
            return Err(Wrong::new(key, message, "take rotations = \"small\", or mirror_odd"));
        }
    }
    Ok(stencil)
}

fn check_probes<const D: usize>(scene: &Scene<D>) -> Result<(), Wrong> {
    let size = scene.size();
    for (index, probe) in scene.probes.iter().enumerate() {
        let path = format!("probe[{index}]");
        let outside = |axis: usize, at: f64| !(0.0..=size[axis]).contains(&at);
        let refuse = |key: &str, at: f64, axis: usize| {
            let message = format!(
                "the probe \"{}\" stands outside the body: {at} m, and the body reaches from 0 to {} m",
                probe.name, size[axis]
            );
            Err(Wrong::new(format!("{path}.{key}"), message, "move it into the body"))
        };
        match probe.watch {
            Watch::Point { at } => {
                if let Some(axis) = (0..D).find(|&axis| outside(axis, at[axis])) {
                    return refuse("at_m", at[axis], axis);
                }
            }
            Watch::Strain { at } if outside(0, at) => return refuse("at_m", at, 0),
            Watch::Line { along, through } if D == 2 && outside(1 - along, through) => {
                return refuse("through_m", through, 1 - along);
            }
            _ => {}
        }
        if matches!(probe.watch, Watch::Strain { .. }) && (D != 1 || scene.nodes[0] < 2) {
            let message = "a strain probe needs a bar of two nodes or more";
            return Err(Wrong::new(path, message, "watch displacements of points instead"));
        }
        if scene.probes[..index].iter().any(|other| other.name == probe.name) {
            let message = format!("two probes are called \"{}\"", probe.name);
            return Err(Wrong::new(format!("{path}.name"), message, "give each probe its own name"));
        }
        if probe.every == 0 {
            let message = "a probe cannot look every 0 steps";
            return Err(Wrong::new(format!("{path}.every_steps"), message, "take 1 or more"));
        }
    }
    Ok(())
}

/// The largest stable Δt in s of a lattice: sharp, or in the plane beyond m = 20 the row-sum bound.
pub fn stable_time_step<const D: usize>(scene: &Scene<D>, stencil: &Stencil<D>) -> f64 {
    let unit = scene.spacing / scene.speed();
    let bonds =
        |limit: fn(&Stencil<1>) -> timestep::TimeStep| Stencil::<1>::new(scene.lattice).map(|s| limit(&s));
    let courant = match D {
        1 => bonds(timestep::bar).map(|limits| limits.sharp),
        _ if scene.lattice.m > LARGEST_SEARCHED_M => Ok((2.0 / stencil.row_sum()).sqrt()),
        _ => Stencil::<2>::new(scene.lattice).map(|s| timestep::plane(&s).sharp),
    };
    courant.unwrap_or(f64::NAN) * unit
}

/// Δt in s, over its limit, and the number of steps.
fn time_step<const D: usize>(scene: &Scene<D>, limit: f64) -> Result<(f64, f64, u64), Wrong> {
    let duration = scene.time.duration;
    if !(duration.is_finite() && duration > 0.0) {
        let message = format!("a duration of {duration} s leaves nothing to simulate");
        return Err(Wrong::new("duration_s", message, "give a positive number of seconds"));
    }
    if !(limit.is_finite() && limit > 0.0) {
        let message = format!("no time step is stable on this body: the limit is {limit} s");
        return Err(Wrong::new("surface_correction", message, "take another correction, kernel or m"));
    }
    match scene.time.step {
        StepRule::OfLimit(fraction) if !(fraction > 0.0 && fraction <= 1.0) => {
            let message = format!("{fraction} is no fraction of the limit that keeps leapfrog stable");
            return Err(Wrong::new("safety", message, "take a number above 0 and up to 1, for example 0.8"));
        }
        StepRule::Given { seconds, .. } if !(seconds > 0.0 && seconds.is_finite()) => {
            let message = format!("a time step of {seconds} s does not advance");
            return Err(Wrong::new("time_step_s", message, "give a positive number of seconds"));
        }
        StepRule::Given { seconds, beyond_limit: false } if seconds > limit => {
            let message = format!(
                "Δt = {seconds:e} s is above this lattice's limit of {limit:.4e} s: leapfrog would grow without bound"
            );
            let help = "take a smaller step, or safety = 0.8 in place of time_step_s";
            return Err(Wrong::new("time_step_s", message, help));
        }
        StepRule::Given { seconds, .. } if seconds > duration => {
            let message = format!("Δt = {seconds:e} s is longer than the duration of {duration:e} s");
            return Err(Wrong::new("time_step_s", message, "take a smaller step or a longer duration"));
        }
        _ => {}
    }
    let (seconds, steps) = scene.time.step.steps(duration, limit);
    if steps > MAX_STEPS {
        let message =
            format!("{steps:e} steps of {seconds:.4e} s are asked for, at most {MAX_STEPS:e} are marched");
        return Err(Wrong::new(
            "duration_s",
            message,
            "take a shorter duration, or a larger time step or spacing",
        ));
    }
    Ok((seconds, seconds / limit, steps))
}
