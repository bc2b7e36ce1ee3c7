//! What nodes must do whatever the forces: move as prescribed, or repeat the body beyond its edges.

mod edges;
mod prescribed;

pub use edges::{Edge, Edges, Ghost};
pub use prescribed::{HeldFrame, PrescribedMotion};

use crate::field::Window;

/// A condition on the motion of some nodes.
pub trait Constraint<const D: usize>: Send + Sync {
    /// For plans and messages.
    fn name(&self) -> String;

    /// Places in a field that it governs, rising.
    fn places(&self) -> &[usize];

    /// Makes u(n) + increment at `next` = t(n+1) meet the condition, where a stretch of the increments reaches that begins
    /// at the place `start`.
    fn hold(&self, next: f64, displacement: Window<'_>, increment: &mut [f64], start: usize);
}
