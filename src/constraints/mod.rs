//! What nodes must do whatever the forces: move as prescribed, or repeat the body beyond its edges.

mod edges;
mod prescribed;

pub use edges::{Edge, Edges};
pub use prescribed::{HeldFrame, PrescribedMotion};

/// A condition on the motion of some nodes.
pub trait Constraint<const D: usize>: Send + Sync {
    /// For plans and messages.
    fn name(&self) -> String;

    /// Places in a field that it governs.
    fn places(&self) -> &[usize];

    /// Makes u(n) + increment at `next` = t(n+1) meet the condition.
    fn hold(&self, next: f64, displacement: &[f64], increment: &mut [f64]);
}
