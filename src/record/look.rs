//! What a probe sees of a body: displacements and strains between nodes, patches of nodes, momentum, the ledger's accounts.

use super::{Column, Patch, Trace};
use crate::constraints::{Edge, Edges};
use crate::grid::Grid;
use crate::ledger::Ledger;
use crate::march::March;
use crate::model::Inertia;
use crate::scene::{Probe, Watch};

/// Energies of the half step just done, for the probes that asked at its beginning.
pub(super) fn book<const D: usize>(
    probes: &[Probe<D>],
    march: &March<'_, D>,
    ledger: &Ledger<D>,
    traces: &mut [Trace],
) {
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
                balance.cut_bonds,
            ]);
        }
    }
}

/// An empty trace with its columns.
pub(super) fn trace<const D: usize>(probe: &Probe<D>, grid: &Grid<D>) -> Trace {
    let vector = |at: [f64; D], names: [&'static str; 2], unit| {
        let at = Some(at.to_vec());
        (0..D).map(move |c| Column { quantity: names[c], unit, at: at.clone(), removed: false })
    };
    let displacement = |at| vector(at, ["displacement_x", "displacement_y"], "m");
    let acceleration = |at| vector(at, ["acceleration_x", "acceleration_y"], "m/s²");
    let missing = |node| move |column| Column { removed: !grid.has(node), ..column };
    let of_node = |node| displacement(grid.position(node)).map(missing(node));
    let of_both = |node| of_node(node).chain(acceleration(grid.position(node)).map(missing(node)));
    let whole = |quantity, unit| Column { quantity, unit, at: None, removed: false };
    let columns = match probe.watch {
        Watch::Point { at } => displacement(at).collect(),
        Watch::Strain { at } => vec![Column { at: Some(vec![at]), ..whole("strain", "1") }],
        Watch::Line { along, through } => line(grid, along, through).flat_map(of_node).collect(),
        Watch::Patch { from, to } => Patch::of(grid, from, to).each().flat_map(of_both).collect(),
        Watch::Energies => {
            let names = [
                "kinetic",
                "elastic",
                "work_of_loads",
                "work_of_damping",
                "work_of_driven_nodes",
                "energy_of_cut_bonds",
            ];
            names.map(|name| whole(name, "J")).to_vec()
        }
        Watch::Momentum => ["momentum_x", "momentum_y"][..D].iter().map(|name| whole(name, "N s")).collect(),
    };
    Trace { probe: probe.name.clone(), columns, times: Vec::new(), rows: Vec::new() }
}

/// Looks at the body now; what belongs to half steps is seen where it is known.
pub(super) fn look<const D: usize>(probe: &Probe<D>, march: &March<'_, D>, trace: &mut Trace) {
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
        Watch::Patch { from, to } => (march.time(), patch(march, Patch::of(grid, from, to))),
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

/// Displacement and acceleration of each cell of a patch; NaN where no node stands.
fn patch<const D: usize>(march: &March<'_, D>, patch: Patch<D>) -> Vec<f64> {
    let grid = &march.model().grid;
    let nodes = || patch.each().filter(|node| grid.has(*node));
    let places: Vec<usize> = nodes().map(|node| grid.place(node)).collect();
    let mut accelerations = march.accelerations(&places).into_iter();
    let mut row = Vec::with_capacity(2 * D * patch.count());
    for node in patch.each() {
        let seen = grid.has(node).then(|| accelerations.next()).flatten();
        let acceleration = seen.unwrap_or([f64::NAN; D]);
        let displacement = seen.map_or([f64::NAN; D], |_| displacement_of(grid, march.displacement(), node));
        row.extend(displacement.into_iter().chain(acceleration));
    }
    row
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
