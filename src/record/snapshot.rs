//! The whole body at one time: displacement and velocity of every node.

use crate::grid::Grid;
use crate::march::{March, initial};
use crate::scene::{Scene, Snapshots};

/// Fields of the body at a step.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Of the [`Snapshots`] that asked for it.
    pub name: String,
    /// The nth of its name, from 0.
    pub index: usize,
    pub step: u64,
    /// Of the step, in s.
    pub time: f64,
    /// Along each axis.
    pub nodes: Vec<usize>,
    /// Δx in m; the first node stands at Δx/2 on each axis.
    pub spacing: f64,
    /// One field per component, row by row along x, in m; NaN where there is no material.
    pub displacement: Vec<Vec<f64>>,
    /// In m/s, at the same time.
    pub velocity: Vec<Vec<f64>>,
}

/// Which snapshots are due, in the order of their steps.
pub(super) struct Due<'s> {
    snapshots: &'s [Snapshots],
    /// Step, which of the snapshots, the nth of it; the next is the last of the list.
    left: Vec<(u64, usize, usize)>,
}

impl<'s> Due<'s> {
    pub fn new(snapshots: &'s [Snapshots], time_step: f64, last: u64) -> Self {
        let of = |(which, asked): (usize, &'s Snapshots)| {
            asked.steps(time_step, last).enumerate().map(move |(index, step)| (step, which, index))
        };
        let mut left: Vec<_> = snapshots.iter().enumerate().flat_map(of).collect();
        left.sort_unstable_by_key(|due| std::cmp::Reverse(*due));
        Self { snapshots, left }
    }

    /// The next step at which one is due.
    pub fn next(&self) -> Option<u64> {
        self.left.last().map(|due| due.0)
    }

    /// Those that are due now.
    pub fn take<const D: usize>(&mut self, scene: &Scene<D>, march: &March<'_, D>) -> Vec<Snapshot> {
        let mut taken = Vec::new();
        while let Some((_, which, index)) = self.left.pop_if(|due| due.0 == march.step()) {
            taken.push(self::taken(scene, march, &self.snapshots[which].name, index));
        }
        taken
    }
}

/// The body as it is now.
pub(super) fn taken<const D: usize>(
    scene: &Scene<D>,
    march: &March<'_, D>,
    name: &str,
    index: usize,
) -> Snapshot {
    let grid = &march.model().grid;
    let start = (march.step() == 0).then(|| initial(grid, &scene.velocity, 1.0));
    Snapshot {
        name: name.into(),
        index,
        step: march.step(),
        time: march.time(),
        nodes: grid.nodes.to_vec(),
        spacing: grid.spacing,
        displacement: components(grid, march.displacement()),
        velocity: components(grid, &march.velocity(start)),
    }
}

/// A field of the grid without its halo, component by component.
fn components<const D: usize>(grid: &Grid<D>, field: &[f64]) -> Vec<Vec<f64>> {
    let component = |axis: usize| {
        let mut values = vec![f64::NAN; grid.nodes.iter().product()];
        for node in grid.each() {
            let row = node.get(1).copied().unwrap_or(0) as usize;
            values[row * grid.nodes[0] + node[0] as usize] = field[grid.place(node) + axis * grid.stride()];
        }
        values
    };
    (0..D).map(component).collect()
}
