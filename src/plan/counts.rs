//! What a scene costs: nodes, bonds, bytes, and how many nodes a list serves beside the stencil.
//!
//! By the sizes alone where the body is a whole rectangle of equal weights; node by node where notches or holes cut it,
//! or weights are corrected.

use super::work::Kinds;
use crate::breaking::RunningNotches;
use crate::connectivity::Connectivity;
use crate::constraints::Edge;
use crate::forces::surface::Factors;
use crate::forces::{BondList, Finite, LatticeStencil, Listed, Masks, Small, family};
use crate::grid::{Grid, Run};
use crate::lattice::Stencil;
use crate::model::surface_factors;
use crate::scene::{Operator, Rotations, Scene, Watch};

/// Counts of a scene.
pub struct Counts {
    /// Bonds, counted once from each of their ends.
    pub ends: u64,
    pub kinds: Kinds,
    /// Nodes whose weights differ from the lattice's, served by a list whatever the operator.
    pub band: u64,
    /// The largest factor of a surface correction.
    pub largest_factor: f64,
    /// State, force, and what the bonds keep.
    pub bytes: usize,
    /// What the bonds keep.
    pub kept_bytes: usize,
}

/// The nodes of the operator that was asked for, and those of the band.
#[derive(Default)]
struct Served {
    nodes: usize,
    ends: u64,
    /// Runs of nodes that have all their bonds, and how many such nodes.
    runs: usize,
    whole: usize,
    /// Runs of nodes that lack some, and the nodes in the blocks of these runs.
    masked_runs: usize,
    padded: usize,
    band_nodes: usize,
    band_ends: u64,
    /// Nodes whose bonds may break.
    breaking_nodes: usize,
    breaking_ends: u64,
}

impl Counts {
    pub fn of<const D: usize>(scene: &Scene<D>, stencil: &Stencil<D>, grid: &Grid<D>) -> Self {
        let connectivity = Connectivity::of(scene);
        let factors = surface_factors(scene, &family(stencil, scene.modulus(), scene.spacing), grid);
        let offsets: Vec<[i32; D]> = stencil.bonds.iter().map(|bond| bond.offset).collect();
        let breaking = RunningNotches::of(scene, &offsets, grid);
        let served = match &factors {
            None if connectivity.intact() => by_sizes(scene, stencil, grid),
            factors => by_nodes(stencil, grid, &connectivity, factors.as_ref(), breaking.as_ref()),
        };
        let kept = operator_bytes(scene, stencil, &served) + breaking.map_or(0, |breaking| breaking.bytes());
        Self {
            ends: served.ends + served.band_ends + served.breaking_ends,
            kinds: served.kinds(scene.operator, stencil.bonds.len()),
            band: served.band_nodes as u64,
            largest_factor: factors.map_or(1.0, |factors| factors.largest(grid)),
            bytes: state_bytes(scene, grid) + kept,
            kept_bytes: kept,
        }
    }
}

impl Served {
    fn kinds(&self, operator: Operator, pairs: usize) -> Kinds {
        let band = Kinds {
            listed_nodes: self.band_nodes as u64,
            listed_ends: self.band_ends,
            breaking_nodes: self.breaking_nodes as u64,
            breaking_ends: self.breaking_ends,
            ..Kinds::default()
        };
        match operator {
            Operator::Stencil => Kinds {
                whole_nodes: self.whole as u64,
                masked_nodes: (self.nodes - self.whole) as u64,
                masked_ends: self.ends - (2 * pairs * self.whole) as u64,
                ..band
            },
            Operator::Bonds => Kinds {
                listed_nodes: band.listed_nodes + self.nodes as u64,
                listed_ends: band.listed_ends + self.ends,
                ..band
            },
        }
    }
}

/// Displacement, increment and force, and what the ledger remembers of each step.
fn state_bytes<const D: usize>(scene: &Scene<D>, grid: &Grid<D>) -> usize {
    let ledger = scene.probes.iter().any(|probe| probe.watch == Watch::Energies);
    let fields = if ledger { 6 } else { 3 };
    fields * size_of::<f64>() * grid.len()
}

fn operator_bytes<const D: usize>(scene: &Scene<D>, stencil: &Stencil<D>, served: &Served) -> usize {
    let list = match scene.rotations {
        Rotations::Small => BondList::<D, Small>::bytes_for,
        Rotations::Finite => BondList::<D, Finite>::bytes_for,
    };
    let own = match scene.operator {
        Operator::Bonds => list(served.nodes, served.ends),
        Operator::Stencil => {
            let Served { runs, masked_runs, padded, .. } = *served;
            LatticeStencil::<D, Small>::bytes_for(stencil.bonds.len(), runs, masked_runs, padded)
        }
    };
    let listed = match scene.rotations {
        Rotations::Small => Listed::<D, Small>::bytes_for,
        Rotations::Finite => Listed::<D, Finite>::bytes_for,
    };
    let breaking = match scene.operator {
        Operator::Bonds => listed(served.breaking_nodes, served.breaking_ends),
        Operator::Stencil => Masks::<D>::bytes_for(stencil.bonds.len(), served.breaking_nodes),
    };
    own + list(served.band_nodes, served.band_ends) + breaking
}

/// Node by node.
fn by_nodes<const D: usize>(
    stencil: &Stencil<D>,
    grid: &Grid<D>,
    connectivity: &Connectivity<D>,
    factors: Option<&Factors<D>>,
    breaking: Option<&RunningNotches>,
) -> Served {
    let mut served = Served::default();
    let (mut whole, mut masked) = (vec![false; grid.cells()], vec![false; grid.cells()]);
    let reach = stencil.reach();
    for node in grid.each() {
        let both = stencil.bonds.iter().flat_map(|bond| [bond.offset, bond.offset.map(|n| -n)]);
        let ends = match connectivity.clear(node, reach) {
            true => 2 * stencil.bonds.len(),
            false => both.filter(|&offset| connectivity.present(node, offset)).count(),
        };
        let may_break =
            |breaking: &RunningNotches| breaking.breakable().first_word(grid.number(node)).is_some();
        if breaking.is_some_and(may_break) {
            served.breaking_nodes += 1;
            served.breaking_ends += ends as u64;
        } else if factors.is_none_or(|factors| factors.neutral(node)) {
            served.nodes += 1;
            served.ends += ends as u64;
            let all = ends == 2 * stencil.bonds.len();
            (whole[grid.number(node)], masked[grid.number(node)]) = (all, !all);
        } else {
            served.band_nodes += 1;
            served.band_ends += ends as u64;
        }
    }
    let runs = grid.runs(|node| whole[grid.number(node)]);
    served.runs = runs.iter().map(Vec::len).sum();
    served.whole = runs.iter().flatten().map(|run| run.len).sum();
    let runs = grid.runs(|node| masked[grid.number(node)]);
    served.masked_runs = runs.iter().map(Vec::len).sum();
    served.padded = runs.into_iter().flatten().map(LatticeStencil::<D, Small>::padded).sum();
    served
}

/// By the sizes alone.
fn by_sizes<const D: usize>(scene: &Scene<D>, stencil: &Stencil<D>, grid: &Grid<D>) -> Served {
    let ends = |offset: [i32; D]| -> u64 {
        let along = |axis: usize| {
            let [below, above] = scene.edges.0[axis];
            let lost = if offset[axis] < 0 { below } else { above } == Edge::Free;
            let shift = offset[axis].unsigned_abs() as usize;
            (scene.nodes[axis] - if lost { shift.min(scene.nodes[axis]) } else { 0 }) as u64
        };
        (0..D).map(along).product()
    };
    let both = stencil.bonds.iter().flat_map(|bond| [bond.offset, bond.offset.map(|n| -n)]);
    let free = |axis: usize, end: usize| if scene.edges.0[axis][end] == Edge::Free { grid.halo } else { 0 };
    let whole: [usize; D] =
        std::array::from_fn(|axis| grid.nodes[axis].saturating_sub(free(axis, 0) + free(axis, 1)));
    let rows = whole.get(1).copied().unwrap_or(1);
    let (below, columns) = (free(0, 0), grid.nodes[0]);
    let masked = |from: usize, until: usize| Run { start: from, len: until - from };
    // Beside the whole nodes of a row, and in rows that have none.
    let beside = match whole[0] {
        0 => vec![masked(0, columns)],
        count => vec![masked(0, below), masked(below + count, columns)],
    };
    let without = if whole[0] == 0 { grid.rows() } else { grid.rows() - rows };
    let counted = |runs: Vec<Run>| {
        let runs: Vec<Run> = runs.into_iter().filter(|run| run.len > 0).collect();
        (runs.len(), runs.into_iter().map(LatticeStencil::<D, Small>::padded).sum::<usize>())
    };
    let (sides, rest) = (counted(beside), counted(vec![masked(0, columns)]));
    let with = grid.rows() - without;
    // A plate has a run in each row, a bar one in each piece that holds whole nodes.
    let pieces = || (below + whole[0]).div_ceil(grid.piece()) - below / grid.piece();
    let runs = if whole.contains(&0) { 0 } else { whole.get(1).copied().unwrap_or_else(pieces) };
    Served {
        nodes: grid.count(),
        ends: both.map(ends).sum(),
        runs,
        whole: whole.iter().product(),
        masked_runs: with * sides.0 + without * rest.0,
        padded: with * sides.1 + without * rest.1,
        ..Served::default()
    }
}
