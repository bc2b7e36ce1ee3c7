//! What is to be seen of a run, and how often.

/// A probe.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe<const D: usize> {
    /// Unique in its scene.
    pub name: String,
    pub watch: Watch<D>,
    /// Steps from one look to the next; the first is at t = 0, and the last step is looked at in any case.
    pub every: u64,
}

/// What a probe looks at.
#[derive(Debug, Clone, PartialEq)]
pub enum Watch<const D: usize> {
    /// Displacement at a place in m, linear between the nodes around it, ghosts among them; less than half a cell from
    /// a free edge the line through the two outermost nodes goes on.
    Point { at: [f64; D] },
    /// Strain of a bar at a place in m: the difference quotient of the two nodes beside it, linear between cell faces.
    Strain { at: f64 },
    /// Displacements of all nodes along an axis: a bar's nodes, or the row or column of a plate nearest to `through` in m.
    Line { along: usize, through: f64 },
    /// Displacement and acceleration of all nodes whose centres lie in a box, in m and m/s²: row by row along x, for each
    /// node first the displacement along each axis, then the acceleration.
    Patch { from: [f64; D], to: [f64; D] },
    /// Kinetic and elastic energy and the work done on the body, half a step after each look.
    Energies,
    /// Momentum, half a step before each look.
    Momentum,
}
