//! Why no stress intensity factor can be read: the cause with its numbers, and the cure.

use thiserror::Error;

/// A reading that would not mean what it says.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Unreadable {
    /// The tip is not inside the nodes.
    #[error("no nodes on every side of the tip: {} x {} nodes from ({}, {}) m", nodes[0], nodes[1], first[0], first[1])]
    NoPatch { first: [f64; 2], nodes: [usize; 2] },
    /// A crack on nodes, or closer to one row.
    #[error("the crack passes {above} spacings below the row above it, not midway between two rows")]
    NotBetweenRows { above: f64 },
    /// Radii in the wrong order.
    #[error("no annulus lies between {inner} and {outer} m")]
    NoAnnulus { inner: f64, outer: f64 },
    /// r_min < 2δ.
    #[error("the annulus begins at {inner} m, inside the nonlocal zone of the tip: 2 delta = {} m", 2.0 * horizon)]
    InsideHorizon { inner: f64, horizon: f64 },
    /// r_max > a.
    #[error("the annulus ends at {outer} m, beyond the other end of the crack at {crack} m")]
    BeyondCrack { outer: f64, crack: f64 },
    /// r_max beyond the nodes.
    #[error("the annulus ends at {outer} m, beyond the nodes, which reach {reach} m from the tip")]
    BeyondPatch { outer: f64, reach: f64 },
    /// Fewer equations than twice the unknowns.
    #[error("{nodes} nodes are too few for {unknowns} unknowns")]
    TooFewNodes { nodes: usize, unknowns: usize },
    /// Unknowns that these nodes cannot tell apart.
    #[error("the nodes cannot tell the {unknowns} unknowns apart: condition number {condition:.1e}")]
    RankDeficient { unknowns: usize, condition: f64 },
    /// A tip as fast as Rayleigh waves, or a negative or unknown speed.
    #[error("a tip that runs at {speed} m/s has no such field: Rayleigh waves travel at {rayleigh:.1} m/s")]
    TooFast { speed: f64, rayleigh: f64 },
}

impl Unreadable {
    /// What to change.
    pub fn cure(&self) -> &'static str {
        match self {
            Self::NoPatch { .. } => "place the tip inside the body, with nodes around it",
            Self::NotBetweenRows { .. } => "an even number of rows, with the crack midway between two",
            Self::NoAnnulus { .. } => "an inner radius above 0 and below the outer one",
            Self::InsideHorizon { .. } => "begin at 2 delta or further out, or refine",
            Self::BeyondCrack { .. } => "an outer radius below the length of the crack",
            Self::BeyondPatch { .. } => "a smaller outer radius, or more nodes around the tip",
            Self::TooFewNodes { .. } => "a wider annulus, a finer lattice, or fewer terms",
            Self::RankDeficient { .. } => "a wider annulus or fewer terms",
            Self::TooFast { .. } => "a speed from 0 to below that of Rayleigh waves",
        }
    }
}
