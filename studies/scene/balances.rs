//! What a march must keep whatever its loads do: the energy ledger, and momentum against the impulse of the loads.

use super::either::Either;
use pd_verify::breaking::Broken;
use pd_verify::constraints::Edge;
use pd_verify::field::Window;
use pd_verify::forces::{Class, Force, Now};
use pd_verify::grid::Grid;
use pd_verify::plan::Plan;
use pd_verify::record::Record;
use pd_verify::scene::{Acts, Scene, Setting};

/// Names of the probes that are put beside the author's; no probe of a study can have such a name.
pub const BALANCE: &str = "(energy balance)";
pub const MOMENTUM: &str = "(momentum)";

/// Whether a probe was asked for by the study.
pub fn asked_for(probe: &str) -> bool {
    !probe.starts_with('(')
}

/// Largest change of kinetic + elastic − works + energy of cut bonds over the largest account. Without motion there is none.
pub fn energy_change(record: &Record) -> Option<f64> {
    let rows = &record.trace(BALANCE)?.rows;
    let closed = |row: &Vec<f64>| row[0] + row[1] - row[2] - row[3] - row[4] + row[5];
    let first = closed(rows.first()?);
    let largest = largest(rows.iter().flatten().copied());
    let change = largest_of(rows.iter().map(|row| closed(row) - first));
    (largest > 0.0).then(|| change / largest)
}

/// The largest size among numbers; NaN if one of them is.
fn largest_of(values: impl Iterator<Item = f64>) -> f64 {
    values.map(f64::abs).fold(0.0, |most, value| if value > most || value.is_nan() { value } else { most })
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.map(f64::abs).fold(0.0, f64::max)
}

impl Either {
    /// Whether leapfrog keeps the ledger exactly.
    pub fn linear(&self) -> bool {
        match self {
            Self::Bar(scene) => scene.linear(),
            Self::Plate(scene) => scene.linear(),
        }
    }

    /// Whether energy and momentum are booked.
    pub fn booked(&self) -> bool {
        match self {
            Self::Bar(scene) => scene.probes.iter().any(|probe| probe.name == BALANCE),
            Self::Plate(scene) => scene.probes.iter().any(|probe| probe.name == BALANCE),
        }
    }

    /// Whether loads alone change the momentum: no edge mirrors, no node is driven, nothing depends on the velocity.
    pub fn loads_alone_push(&self) -> bool {
        match self {
            Self::Bar(scene) => loads(scene).is_some(),
            Self::Plate(scene) => loads(scene).is_some(),
        }
    }

    /// Largest |momentum − (momentum at the start + impulse)| over √(2 M E), E the largest energy of the march.
    pub fn momentum_error(&self, record: &Record) -> Option<f64> {
        match self {
            Self::Bar(scene) => momentum_error(scene, record),
            Self::Plate(scene) => momentum_error(scene, record),
        }
    }
}

/// The forces of a scene where each is a load, else `None`.
fn loads<const D: usize>(scene: &Scene<D>) -> Option<Vec<Box<dyn Force<D>>>> {
    let open = |edge: &Edge| matches!(edge, Edge::Free | Edge::Periodic);
    if !scene.edges.0.as_flattened().iter().all(open) {
        return None;
    }
    let grid = scene.grid(0);
    let setting = Setting::of(scene, &grid);
    let load = |acts| match acts {
        Ok(Acts::Force(force)) if force.class() == Class::Load => Some(force),
        _ => None,
    };
    scene.effects.iter().map(|effect| load(effect.act(&setting))).collect()
}

fn momentum_error<const D: usize>(scene: &Scene<D>, record: &Record) -> Option<f64> {
    let trace = record.trace(MOMENTUM)?;
    let steps: Vec<u64> =
        trace.times.iter().map(|t| (t / record.plan.time_step_s + 0.5).round() as u64).collect();
    let expected = momentum(scene, &record.plan, &steps)?;
    let energies = record.trace(BALANCE)?.rows.iter().map(|row| row[0].abs().max(row[1].abs()));
    let mass = scene.material.density * scene.cell_volume() * record.plan.nodes as f64;
    let scale = (2.0 * mass * energies.fold(0.0, f64::max)).sqrt();
    let errors =
        trace.rows.iter().zip(&expected).flat_map(|(row, expected)| {
            row.iter().zip(expected).map(|(computed, expected)| computed - expected)
        });
    (scale > 0.0 && !expected.is_empty()).then(|| largest_of(errors) / scale)
}

/// The momentum half a step before each of the steps, from the initial velocities and the loads alone; no bond is
/// visited. Leapfrog gives it by v(½) = v₀ + ½Δt a₀ and v(n + ½) = v(n − ½) + Δt a(n).
fn momentum<const D: usize>(scene: &Scene<D>, plan: &Plan, steps: &[u64]) -> Option<Vec<[f64; D]>> {
    let loads = loads(scene)?;
    let grid = scene.grid(0);
    let mut total = [0.0; D];
    for field in &scene.velocity {
        let sum: f64 = grid.each().map(|node| field.at(grid.position(node))).sum();
        total[field.component] += scene.material.density * sum;
    }
    let mut found = Vec::new();
    let mut step = 0;
    for &until in steps {
        while step < until {
            let share = if step == 0 { 0.5 } else { 1.0 } * plan.time_step_s;
            let push = push(&loads, &grid, step as f64 * plan.time_step_s, plan.time_step_s);
            total.iter_mut().zip(push).for_each(|(total, push)| *total += share * push);
            step += 1;
        }
        found.push(total.map(|total| total * scene.cell_volume()));
    }
    Some(found)
}

/// The sum of the loads over all nodes at a time, in N/m³.
fn push<const D: usize>(loads: &[Box<dyn Force<D>>], grid: &Grid<D>, time: f64, time_step: f64) -> [f64; D] {
    let mut total = [0.0; D];
    if loads.is_empty() {
        return total;
    }
    let still = grid.field();
    let at_rest = Window::from(&still);
    let now = Now { displacement: at_rest, increment: at_rest, time, time_step, broken: Broken::none() };
    let mut field = grid.field();
    for (piece, sum) in field[grid.body()].chunks_mut(grid.piece()).enumerate() {
        loads.iter().for_each(|load| load.add(&now, piece, sum));
        for (index, part) in sum.chunks(grid.stride()).enumerate() {
            total[index % D] += part.iter().sum::<f64>();
        }
    }
    total
}
