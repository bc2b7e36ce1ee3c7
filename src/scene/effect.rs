//! What a scene may call for beside its bonds: each effect is asked for in words and becomes a term of the model.

use super::{Notch, Scene, Wrong};
use crate::constraints::{Constraint, Edges};
use crate::forces::Force;
use crate::grid::Grid;
use std::fmt;

/// The body on which an effect is to act.
#[derive(Debug, Clone, Copy)]
pub struct Setting<'a, const D: usize> {
    pub grid: &'a Grid<D>,
    /// What lies beyond each edge.
    pub edges: &'a Edges<D>,
    /// Cuts through a plate.
    pub notches: &'a [Notch],
    /// ρ in kg/m³.
    pub density: f64,
}

impl<'a, const D: usize> Setting<'a, D> {
    /// The body of a scene.
    pub fn of(scene: &'a Scene<D>, grid: &'a Grid<D>) -> Self {
        Self { grid, edges: &scene.edges, notches: &scene.notches, density: scene.material.density }
    }
}

/// What an effect becomes.
pub enum Acts<const D: usize> {
    Force(Box<dyn Force<D>>),
    Constraint(Box<dyn Constraint<D>>),
}

impl<const D: usize> fmt::Debug for Acts<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Force(force) => write!(f, "Force({})", force.name()),
            Self::Constraint(constraint) => write!(f, "Constraint({})", constraint.name()),
        }
    }
}

/// An effect as asked for: plain data that can be checked against a body and made into what acts.
pub trait Effect<const D: usize>: fmt::Debug + Send + Sync {
    /// For plans and messages.
    fn name(&self) -> String;

    /// The term of the model, or what is wrong with it on this body.
    fn act(&self, setting: &Setting<'_, D>) -> Result<Acts<D>, Wrong>;

    /// Why it changes no bit of any march that ends before `until`, in s; `None` where it may. Said of what is nothing,
    /// never of what is small.
    fn neutral(&self, _until: f64) -> Option<&'static str> {
        None
    }

    /// Which of the scene's notches it acts on, from 0.
    fn on_notch(&self) -> Option<usize> {
        None
    }
}
