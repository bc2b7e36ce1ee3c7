//! A run from a scene to what its probes saw: plan, model, march to the next look, look.

use crate::constraints::{Edge, Edges};
use crate::grid::Grid;
use crate::ledger::Ledger;
use crate::march::March;
use crate::model::{Inertia, Model};
use crate::plan::Plan;
use crate::scene::{Probe, Scene, Watch, Wrong};
use thiserror::Error;

/// What the probes of a scene saw.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    pub plan: Plan,
    pub traces: Vec<Trace>,
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
    /// A displacement is no longer a number.
    #[error(
        "\"{scene}\" grew without bound: no longer finite at step {step}, t = {time:e} s, with Δt = {over_limit:.3} of the limit"
    )]
    Diverged { scene: String, step: u64, time: f64, over_limit: f64 },
}

/// Steps between two looks at whether all is finite.
const WATCHED: u64 = 1000;

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
    loop {
        let step = march.step();
        for (probe, trace) in scene.probes.iter().zip(&mut traces) {
            if step.is_multiple_of(probe.every) || step == plan.steps {
                look(probe, &march, trace);
            }
        }
        if step >= plan.steps {
            return Ok(Record { plan, traces });
        }
        let due = scene.probes.iter().map(|probe| (step / probe.every + 1) * probe.every);
        let next = due.chain([plan.steps, step + WATCHED]).min().unwrap_or(plan.steps).min(plan.steps);
        match &mut ledger {
            None => march.advance_to(next),
            Some(ledger) => {
                for _ in step..next {
                    march.advance_booked(ledger);
                    book(&scene.probes, &march, ledger, &mut traces);
                }
            }
        }
        if !march.is_finite() {
            return Err(Failure::Diverged {
                scene: plan.name,
                step: march.step(),
                time: march.time(),
                over_limit: plan.time_step_over_limit,
            });
        }
    }
}

/// Energies of the half step just done, for the probes that asked at its beginning.
fn book<const D: usize>(probes: &[Probe<D>], march: &March<'_, D>, ledger: &Ledger<D>, traces: &mut [Trace]) {
    let began = march.step() - 1;
    for (probe, trace) in probes.iter().zip(traces) {
        if probe.watch == Watch::Energies && began.is_multiple_of(probe.every) {
            let balance = ledger.balance();
            trace.times.push((began as f64 + 0.5) * march.time_step());
            trace.rows.push(vec![
                balance.kinetic,
                balance.elastic,
                balance.loads,
                balance.rates,
                balance.constraints,
            ]);
        }
    }
}

/// An empty trace with its columns.
fn trace<const D: usize>(probe: &Probe<D>, grid: &Grid<D>) -> Trace {
    let components = ["displacement_x", "displacement_y"];
    let displacement = |at: [f64; D]| {
        (0..D).map(move |c| Column {
            quantity: components[c],
            unit: "m",
            at: Some(at.to_vec()),
            removed: false,
        })
    };
    let of_node = |node| {
        displacement(grid.position(node)).map(move |column| Column { removed: !grid.has(node), ..column })
    };
    let whole = |quantity, unit| Column { quantity, unit, at: None, removed: false };
    let columns = match probe.watch {
        Watch::Point { at } => displacement(at).collect(),
        Watch::Strain { at } => vec![Column { at: Some(vec![at]), ..whole("strain", "1") }],
        Watch::Line { along, through } => line(grid, along, through).flat_map(of_node).collect(),
        Watch::Energies => {
            let names = ["kinetic", "elastic", "work_of_loads", "work_of_damping", "work_of_driven_nodes"];
            names.map(|name| whole(name, "J")).to_vec()
        }
        Watch::Momentum => ["momentum_x", "momentum_y"][..D].iter().map(|name| whole(name, "N s")).collect(),
    };
    Trace { probe: probe.name.clone(), columns, times: Vec::new(), rows: Vec::new() }
}

/// Looks at the body now; what belongs to half steps is seen where it is known.
fn look<const D: usize>(probe: &Probe<D>, march: &March<'_, D>, trace: &mut Trace) {
    let (grid, edges, u) = (&march.model().grid, &march.model().edges, march.displacement());
    let half = 0.5 * march.time_step();
    let (time, row) = match probe.watch {
        Watch::Point { at } => (march.time(), point(grid, edges, u, at).to_vec()),
        Watch::Strain { at } => (march.time(), vec![strain(grid, edges, u, at)]),
        Watch::Line { along, through } => {
            let of = |node| if grid.has(node) { displacement_of(grid, u, node) } else { [f64::NAN; D] };
            let row = line(grid, along, through).flat_map(of).collect();
            (march.time(), row)
        }
        Watch::Momentum if march.step() > 0 => (march.time() - half, momentum(march).to_vec()),
        Watch::Momentum | Watch::Energies => return,
    };
    trace.times.push(time);
    trace.rows.push(row);
}

fn displacement_of<const D: usize>(grid: &Grid<D>, u: &[f64], node: [isize; D]) -> [f64; D] {
    let place = grid.place(node);
    std::array::from_fn(|axis| u[place + axis * grid.stride()])
}

/// The cells of a line probe; in a hole they are without nodes.
pub(crate) fn line<const D: usize>(
    grid: &Grid<D>,
    along: usize,
    through: f64,
) -> impl Iterator<Item = [isize; D]> + use<D> {
    let last = |axis: usize| grid.nodes[axis] as isize - 1;
    let other = 1 - along;
    let fixed = if D == 1 { 0 } else { ((through / grid.spacing).floor() as isize).clamp(0, last(other)) };
    (0..grid.nodes[along] as isize).map(move |n| {
        let mut node = [fixed; D];
        node[along] = n;
        node
    })
}

/// The two neighbours on an axis among nodes 0 … count − 1 and the share of the second. Beyond an edge with ghosts one
/// more is known; beyond a free one the line goes on.
fn around(t: f64, count: usize, [below, above]: [Edge; 2]) -> (isize, f64) {
    let ghosts = |edge: Edge| isize::from(edge != Edge::Free);
    let (first, last) = (-ghosts(below), count as isize - 1 + ghosts(above));
    let lower = (t.floor() as isize).clamp(first, (last - 1).max(first));
    (lower, if first == last { 0.0 } else { t - lower as f64 })
}

/// The nodes around a place, ghosts among them, and the share that each has in what is seen there.
pub(crate) fn corners<const D: usize>(
    grid: &Grid<D>,
    edges: &Edges<D>,
    at: [f64; D],
) -> impl Iterator<Item = ([isize; D], f64)> + use<D> {
    let near: [(isize, f64); D] =
        std::array::from_fn(|axis| around(at[axis] / grid.spacing - 0.5, grid.nodes[axis], edges.0[axis]));
    (0..1_usize << D).map(move |corner| {
        let upper = |axis: usize| corner >> axis & 1 == 1;
        let share = (0..D).map(|axis| if upper(axis) { near[axis].1 } else { 1.0 - near[axis].1 }).product();
        (std::array::from_fn(|axis| near[axis].0 + isize::from(upper(axis))), share)
    })
}

/// Displacement at a place, linear between nodes. The share of nodes in a hole is rounding, or the plan refuses it.
fn point<const D: usize>(grid: &Grid<D>, edges: &Edges<D>, u: &[f64], at: [f64; D]) -> [f64; D] {
    let (mut total, mut missing) = ([0.0; D], 0.0);
    for (node, share) in corners(grid, edges, at).filter(|(_, share)| *share != 0.0) {
        if grid.pierced() && edges.image(grid, node).is_none() {
            missing += share;
            continue;
        }
        let values = displacement_of(grid, u, node);
        (0..D).for_each(|axis| total[axis] += share * values[axis]);
    }
    if missing == 0.0 { total } else { total.map(|sum| sum / (1.0 - missing)) }
}

/// Strain of a bar at a place: on a cell face the difference quotient of its two nodes.
fn strain<const D: usize>(grid: &Grid<D>, edges: &Edges<D>, u: &[f64], at: f64) -> f64 {
    let faces = grid.nodes[0] - 1;
    let t = at / grid.spacing - 1.0;
    // A place meant to be a face must not miss it by rounding.
    let t = if (t - t.round()).abs() < 1e-9 { t.round() } else { t };
    let (face, share) = around(t, faces, edges.0[0]);
    let place = |n: isize| {
        let mut node = [0; D];
        node[0] = n;
        u[grid.place(node)]
    };
    let on = |face: isize| (place(face + 1) - place(face)) / grid.spacing;
    if share == 0.0 { on(face) } else { (1.0 - share) * on(face) + share * on(face + 1) }
}

fn momentum<const D: usize>(march: &March<'_, D>) -> [f64; D] {
    let model = march.model();
    let mut total = [0.0; D];
    for node in model.grid.each() {
        for (axis, total) in total.iter_mut().enumerate() {
            let place = model.grid.place(node) + axis * model.grid.stride();
            let density = match &model.inertia {
                Inertia::Uniform(density) => *density,
                Inertia::Diagonal(densities) => densities[place],
            };
            *total += density * march.increment()[place];
        }
    }
    total.map(|sum| sum * model.cell_volume / march.time_step())
}
