//! How a scene is served and what it costs, decided before anything is computed: effects, operator, Δt, work.

mod avoidable;
mod checks;
mod counts;
mod looks;
mod running;
mod step;
pub mod time;
pub mod work;

pub use avoidable::Avoidable;
pub use looks::Looks;
pub use step::stable_time_step;

use crate::constraints::Edge;
use crate::forces::surface::Correction;
use crate::forces::{Class, Finite, Law, Small};
use crate::grid::Grid;
use crate::lattice::Stencil;
use crate::scene::{Acts, Operator, Rotations, Scene, Setting, Watch, Wrong, snapshot};
use counts::Counts;
use serde::Serialize;
use std::collections::HashSet;
use work::{Effects, Work};

/// What will be done.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Plan {
    pub name: String,
    pub effects_on: Vec<String>,
    pub effects_off: Vec<String>,
    /// Those that are on and change no bit of the march.
    pub avoidable: Vec<Avoidable>,
    pub operator: String,
    pub nodes: u64,
    /// Nodes served by a list of bonds beside the operator: near corrected edges their weights are their own.
    pub band_nodes: u64,
    /// Each once; a bond to a mirrored node, which ends twice at its owner, counts half.
    pub bonds: u64,
    /// State, force and what operators and loads keep.
    pub bytes_per_node: f64,
    /// What the snapshots of the whole body hold.
    pub snapshot_bytes: u64,
    /// What patch probes hold of all their looks.
    pub patch_bytes: u64,
    pub time_step_s: f64,
    /// Above 1 leapfrog is unstable.
    pub time_step_over_limit: f64,
    pub steps: u64,
    pub node_updates: u64,
    /// Each bond once per step.
    pub bond_updates: u64,
    /// Steps in which the fastest running notch passes a cell, Δx/(vΔt).
    pub steps_per_cell: Option<f64>,
    /// What each step does.
    pub work: Work,
    /// What is done beside the steps.
    pub looks: Looks,
}

impl Plan {
    /// Checks a scene and says how it will be run.
    pub fn of<const D: usize>(scene: &Scene<D>) -> Result<Self, Wrong> {
        Self::with_steps(scene, |stencil, factor| {
            step::time_step(scene, stable_time_step(scene, stencil) / factor.sqrt())
        })
    }

    /// The same where the lattice's limit on Δt is known, in s: it takes a search, and is the same over Δx for all Δx.
    pub fn below<const D: usize>(scene: &Scene<D>, limit: f64) -> Result<Self, Wrong> {
        Self::with_steps(scene, |_, factor| step::time_step(scene, limit / factor.sqrt()))
    }

    /// The same for a scene that is to be found at rest: no time step, no steps.
    pub fn at_rest<const D: usize>(scene: &Scene<D>) -> Result<Self, Wrong> {
        if let Some(running) = scene.running.first() {
            let message = "a body whose notch runs does not come to rest";
            let help = "leave runs out, or give the notch the length at which rest is sought";
            return Err(Wrong::new(format!("notch[{}].runs", running.notch), message, help));
        }
        Self::with_steps(scene, |_, _| Ok((0.0, 0.0, 0)))
    }

    /// `steps` gives Δt, Δt over its limit and the number of steps, from the lattice and the largest factor of a bond.
    fn with_steps<const D: usize>(
        scene: &Scene<D>,
        steps: impl Fn(&Stencil<D>, f64) -> Result<(f64, f64, u64), Wrong>,
    ) -> Result<Self, Wrong> {
        let stencil = checks::body(scene)?;
        checks::holes(scene)?;
        running::check(scene)?;
        let grid = scene.grid(stencil.reach());
        checks::left(scene, &grid)?;
        checks::probes(scene, &grid)?;
        let setting = Setting::of(scene, &grid);
        let mut terms = Terms::default();
        for (index, effect) in scene.effects.iter().enumerate() {
            let acts = effect.act(&setting).and_then(|acts| terms.join(acts, index, &grid));
            acts.map_err(|wrong| wrong.inside(&format!("effect[{index}]")))?;
        }
        terms.all_loads_act()?;
        let counts = Counts::of(scene, &stencil, &grid);
        checks::bonded(scene, &counts)?;
        let (time_step, over_limit, steps) = steps(&stencil, counts.largest_factor)?;
        // A snapshot of the end tries one step more. What is at rest knows no time.
        let until = if steps == 0 { f64::INFINITY } else { (steps + 1) as f64 * time_step };
        let nodes = grid.count() as u64;
        let (effects_on, effects_off) = effects(scene);
        Ok(Self {
            name: scene.name.clone(),
            effects_on,
            effects_off,
            avoidable: avoidable::of(scene, &stencil, counts.band, until),
            operator: operator(scene, counts.band, nodes),
            nodes,
            band_nodes: counts.band,
            bonds: counts.ends / 2,
            snapshot_bytes: snapshot::bytes(scene, time_step, steps)?,
            patch_bytes: checks::patches(scene, &grid, steps)?,
            bytes_per_node: (counts.bytes + terms.bytes) as f64 / nodes as f64,
            time_step_s: time_step,
            time_step_over_limit: over_limit,
            steps,
            node_updates: nodes.saturating_mul(steps),
            bond_updates: (counts.ends / 2).saturating_mul(steps),
            steps_per_cell: running::steps_per_cell(scene, time_step),
            work: Work::of(scene, &stencil, &counts, terms.effects::<D>(nodes)),
            looks: Looks::of(scene, &grid, steps),
        })
    }

    /// The same plan for the same scene where only the pace of its probes has changed.
    pub fn paced<const D: usize>(mut self, scene: &Scene<D>) -> Result<Self, Wrong> {
        let grid = scene.grid(0);
        self.patch_bytes = checks::patches(scene, &grid, self.steps)?;
        self.looks = Looks::of(scene, &grid, self.steps);
        Ok(self)
    }

    /// The part of the nodes that a list serves beside the operator.
    pub fn band_share(&self) -> f64 {
        self.band_nodes as f64 / self.nodes as f64
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
    /// Loads on some nodes: which effect, its name, its places.
    loads: Vec<(usize, String, Vec<usize>)>,
    rates: usize,
    /// Loads on every component of every node.
    fields: usize,
}

impl Terms {
    /// Counts a term, refused where it contradicts another.
    fn join<const D: usize>(&mut self, acts: Acts<D>, index: usize, grid: &Grid<D>) -> Result<(), Wrong> {
        match acts {
            Acts::Force(force) => {
                self.bytes += force.bytes();
                let loaded = force.loaded(grid);
                self.fields += usize::from(force.class() == Class::Load && loaded.is_none());
                self.loads.extend(loaded.map(|places| (index, force.name(), places)));
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

    /// What they do in each step on so many nodes.
    fn effects<const D: usize>(&self, nodes: u64) -> Effects {
        let places: usize = self.loads.iter().map(|(_, _, places)| places.len()).sum();
        Effects {
            damped_nodes: self.rates as u64 * nodes,
            loaded_places: places as u64 + (D * self.fields) as u64 * nodes,
            kept_bytes: self.bytes,
        }
    }

    /// Refuses a load none of whose nodes is free to follow it. Said once all effects are known: motions may come later.
    fn all_loads_act(&self) -> Result<(), Wrong> {
        let idle = |places: &[usize]| places.iter().all(|place| self.driven.contains(place));
        let Some((index, name, _)) = self.loads.iter().find(|(_, _, places)| idle(places)) else {
            return Ok(());
        };
        let message = format!("the {name} does nothing: all its nodes are driven along its axis by a motion");
        let help = "leave the load or the motion out, or let one of them act on other nodes";
        Err(Wrong::new(format!("effect[{index}].axis"), message, help))
    }
}

fn operator<const D: usize>(scene: &Scene<D>, band: u64, nodes: u64) -> String {
    let (name, how) = match scene.operator {
        Operator::Stencil => ("stencil", "as a list"),
        Operator::Bonds => ("bonds", "with weights of their own"),
    };
    let share = 100.0 * band as f64 / nodes as f64;
    if band == 0 { name.into() } else { format!("{name}; {band} of {nodes} nodes ({share:.1} %) {how}") }
}

fn effects<const D: usize>(scene: &Scene<D>) -> (Vec<String>, Vec<String>) {
    let mut on: Vec<String> = scene.effects.iter().map(|effect| effect.name()).collect();
    let mut off = Vec::new();
    let mut say = |is_on: bool, name: &str| if is_on { on.push(name.into()) } else { off.push(name.into()) };
    let law = if scene.rotations == Rotations::Finite { Finite::NAME } else { Small::NAME };
    say(true, &format!("{law} rotations"));
    say(scene.lattice.calibrated, "lattice calibration");
    say(!scene.notches.is_empty(), "notch");
    say(!scene.holes.is_empty(), "hole");
    say(!scene.running.is_empty(), "running notch");
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
