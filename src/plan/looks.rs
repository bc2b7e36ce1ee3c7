//! What is done beside a march's steps: it stops to be looked at, and some looks ask for forces of their own.

use crate::grid::Grid;
use crate::record::{Patch, corners, line, looks_of_growth};
use crate::scene::{Scene, Watch};
use serde::Serialize;

/// Over the whole march.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Looks {
    /// Steps at which it stops; where two probes look at different steps, the more frequent one counts.
    pub stops: u64,
    /// Looks for growth without bound, each with the body's forces.
    pub growth: u64,
    /// Snapshots of the whole body.
    pub snapshots: u64,
    /// Nodes whose forces are asked for by patch probes.
    pub patch_nodes: u64,
    /// Numbers that probes keep.
    pub values: u64,
}

impl Looks {
    /// Of a march of so many steps.
    pub fn of<const D: usize>(scene: &Scene<D>, grid: &Grid<D>, steps: u64) -> Self {
        if steps == 0 {
            return Self::default();
        }
        let growth = looks_of_growth(steps);
        let mut looks = Self { growth, ..Self::default() };
        let mut often = 0;
        for probe in &scene.probes {
            let times = steps.div_ceil(probe.every.max(1)) + 1;
            often = often.max(times);
            looks.values =
                looks.values.saturating_add(times.saturating_mul(values(grid, scene, &probe.watch)));
            if let Watch::Patch { from, to } = probe.watch {
                let nodes = served(grid, &Patch::of(grid, from, to));
                looks.patch_nodes = looks.patch_nodes.saturating_add(times.saturating_mul(nodes));
            }
        }
        let snapshots = scene.snapshots.iter().map(|one| one.times.len() as u64).sum();
        Self { stops: often.saturating_add(growth).saturating_add(snapshots), snapshots, ..looks }
    }
}

/// Numbers of one look.
fn values<const D: usize>(grid: &Grid<D>, scene: &Scene<D>, watch: &Watch<D>) -> u64 {
    let numbers = match *watch {
        Watch::Point { at } => D * corners(grid, &scene.edges, at).count(),
        Watch::Strain { .. } => 2,
        Watch::Line { along, through } => D * line(grid, along, through).count(),
        Watch::Patch { from, to } => 2 * D * Patch::of(grid, from, to).count(),
        // Every node is asked for its momentum; the ledger's accounts are no look.
        Watch::Momentum => D * grid.count(),
        Watch::Energies => 6,
    };
    numbers as u64
}

/// Nodes of the pieces of work that a patch touches.
fn served<const D: usize>(grid: &Grid<D>, patch: &Patch<D>) -> u64 {
    let piece = |node| (grid.place(node) - grid.body().start) / grid.piece();
    let pieces: std::collections::BTreeSet<usize> = patch.each().map(piece).collect();
    (pieces.len() * grid.nodes.iter().product::<usize>() / grid.pieces()) as u64
}
