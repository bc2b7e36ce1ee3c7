//! What is asked to be simulated: plain data, from a study file or written in Rust.
//!
//! A scene says which body, which lattice, which edges, what it starts from, what acts on it, for how long and what is
//! to be seen. [`crate::plan`] decides how that is served and what it costs; [`crate::model`] makes it concrete.

mod effect;
mod history;
mod hole;
mod initial;
mod notch;
mod place;
mod positive;
mod probe;
mod running;
pub(crate) mod snapshot;
mod time;
mod wrong;

pub use effect::{Acts, Effect, Setting};
pub use history::{History, HistoryAsked, HistoryShape};
pub use hole::{Hole, HoleAsked};
pub use initial::{Initial, InitialAsked, Quantity, Shape};
pub(crate) use notch::SLACK;
pub use notch::{Notch, NotchAsked};
pub use place::{Axis, Region, Side};
pub use positive::Positive;
pub use probe::{Probe, Watch};
pub use running::{Running, RunsAsked};
pub use snapshot::Snapshots;
pub use time::{Beyond, StepRule, Time};
pub use wrong::Wrong;

use crate::constraints::Edges;
use crate::forces::surface::Correction;
use crate::grid::Grid;
use crate::lattice::Lattice;
use crate::material::{Body, Material};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// How far bonds may turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Rotations {
    /// The linearised law.
    #[default]
    Small,
    /// The geometrically exact law.
    Finite,
}

/// Which operator serves the bonds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Operator {
    /// One stencil for all nodes.
    #[default]
    Stencil,
    /// Every bond stored: the stencil's oracle.
    Bonds,
}

/// A simulation as asked for.
#[derive(Debug, Clone)]
pub struct Scene<const D: usize> {
    /// In plans and messages.
    pub name: String,
    pub material: Material,
    pub body: Body,
    pub lattice: Lattice,
    /// Cells along each axis.
    pub nodes: [usize; D],
    /// Δx in m.
    pub spacing: f64,
    /// What a cell measures across the simulated axes: the section A in m² of a bar, the thickness h in m of a plate.
    pub section: f64,
    pub rotations: Rotations,
    pub operator: Operator,
    pub edges: Edges<D>,
    /// Cuts through a plate; a bar has none.
    pub notches: Vec<Notch>,
    /// Which of them run, and how.
    pub running: Vec<Running>,
    /// Round holes through a plate; a bar has none.
    pub holes: Vec<Hole>,
    /// For bonds near free edges, notches and holes.
    pub surface: Correction,
    /// Displacements at t = 0, summed.
    pub displacement: Vec<Initial<D>>,
    /// Velocities at t = 0, summed.
    pub velocity: Vec<Initial<D>>,
    /// What acts beside the bonds.
    pub effects: Vec<Arc<dyn Effect<D>>>,
    pub time: Time,
    pub probes: Vec<Probe<D>>,
    /// The whole body at chosen times.
    pub snapshots: Vec<Snapshots>,
}

impl<const D: usize> Scene<D> {
    /// A body at rest with free edges, of section 1: nothing acts on it, nothing is seen. What a scene calls for is added
    /// to it: `Scene { edges, ..Scene::bare(…) }`.
    pub fn bare(
        material: Material,
        body: Body,
        lattice: Lattice,
        nodes: [usize; D],
        spacing: f64,
        time: Time,
    ) -> Self {
        Self {
            name: format!("{lattice}, Δx = {spacing} m"),
            material,
            body,
            lattice,
            nodes,
            spacing,
            section: 1.0,
            rotations: Rotations::Small,
            operator: Operator::Stencil,
            edges: Edges::default(),
            notches: Vec::new(),
            running: Vec::new(),
            holes: Vec::new(),
            surface: Correction::None,
            displacement: Vec::new(),
            velocity: Vec::new(),
            effects: Vec::new(),
            time,
            probes: Vec::new(),
            snapshots: Vec::new(),
        }
    }

    /// Whether its bonds pull in proportion to the displacement.
    pub fn linear(&self) -> bool {
        self.rotations == Rotations::Small
    }

    /// Size of the body in m.
    pub fn size(&self) -> [f64; D] {
        self.nodes.map(|nodes| nodes as f64 * self.spacing)
    }

    /// Its holes with their images beyond its edges.
    pub(crate) fn voids(&self) -> Vec<Hole> {
        Hole::with_images(&self.holes, &self.edges, self.size())
    }

    /// Its block of the lattice, without the nodes that lie in holes; `halo` is the largest reach of any force.
    pub fn grid(&self, halo: usize) -> Grid<D> {
        let grid = Grid::new(self.nodes, self.spacing, halo);
        let voids = self.voids();
        if voids.is_empty() {
            return grid;
        }
        let whole = grid.clone();
        let place = |node| {
            let at = whole.position(node);
            std::array::from_fn(|axis| at.get(axis).copied().unwrap_or(0.0))
        };
        grid.keeping(|node| !voids.iter().any(|hole| hole.holds(place(node), self.spacing)))
    }

    /// Volume of a cell in m³.
    pub fn cell_volume(&self) -> f64 {
        self.section * self.spacing.powi(D as i32)
    }

    /// Speed of long dilatational waves that the material is meant to have, in m/s.
    pub fn speed(&self) -> f64 {
        self.material.dilatational_speed(self.body)
    }

    /// The intended C₁₁ (E in a bar) in Pa.
    pub fn modulus(&self) -> f64 {
        self.material.youngs_modulus * self.body.stiffness_over_youngs_modulus()
    }
}
