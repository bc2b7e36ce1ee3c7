//! What acts on the nodes: each force adds its share, and an absent force is not in the list.
//!
//! ρ ü = Σ forces, all per unit volume (N/m³). A force is evaluated at a state and changes nothing but the sum it is
//! given; what has a potential says how much energy it holds, which the conformance suite differentiates.

mod bond_list;
mod breakable;
mod damping;
mod face_traction;
mod law;
mod load;
mod sink;
mod stencil;
pub mod surface;

pub use bond_list::BondList;
pub use breakable::{Breaking, Listed, Masks, Store};
pub use damping::{Damper, Damping};
pub use face_traction::FaceTraction;
pub use law::{Direction, Finite, Law, Small};
pub use load::{BodyForce, ForceField, Load, Traction};
pub use stencil::LatticeStencil;

use crate::breaking::Broken;
use crate::field::Window;
use crate::grid::Grid;
use crate::lattice::Stencil;
pub use sink::Step;

/// The state at which forces are evaluated.
#[derive(Debug, Clone, Copy)]
pub struct Now<'a> {
    /// u at time n in m; ghosts filled. At least the piece and what lies within the reach of a force is seen.
    pub displacement: Window<'a>,
    /// u(n) − u(n−1) in m: Δt times the velocity half a step ago. At least the piece is seen.
    pub increment: Window<'a>,
    /// t(n) in s.
    pub time: f64,
    /// Δt in s.
    pub time_step: f64,
    /// The bonds that have broken so far.
    pub broken: &'a Broken,
}

/// In which order forces are summed, and in which account their work is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// The body's own bonds: has a potential.
    Internal,
    /// Given from outside.
    Load,
    /// Depends on the velocity, and comes last: it sees the sum of the others.
    Rate,
}

/// A term of the equation of motion.
pub trait Force<const D: usize>: Send + Sync {
    /// For plans and messages.
    fn name(&self) -> String;

    fn class(&self) -> Class;

    /// How many nodes away it looks.
    fn reach(&self) -> usize {
        0
    }

    /// Adds the force density in N/m³ on the nodes of a piece; `sum` is that piece of the force field.
    fn add(&self, now: &Now<'_>, piece: usize, sum: &mut [f64]);

    /// Whether it acts on any node of a piece.
    fn acts_on(&self, _piece: usize) -> bool {
        true
    }

    /// Moves the nodes of a piece on which nothing else acts, with no sum between; `false` where it does not know how.
    fn step(&self, _now: &Now<'_>, _piece: usize, _step: &mut Step<'_>) -> bool {
        false
    }

    /// Energy per volume of a node's cell, summed over the nodes of a piece, in J/m³; `None` without a potential.
    fn energy(&self, _now: &Now<'_>, _piece: usize) -> Option<f64> {
        None
    }

    /// What the bonds held per volume that are broken in `to` and not in `from`, the state a step before, summed over the
    /// nodes of a piece, in J/m³: as the ledger counts it half way between the two, ½(e + e') − ¼(f' − f)·(η' − η), e the
    /// energy of a bond and f its pull; for a linear law ½ηᵀkη'.
    fn released(&self, _from: &Now<'_>, _to: &Now<'_>, _piece: usize) -> f64 {
        0.0
    }

    /// Places in a field on which it acts, where these are known beforehand, as those of a load on some nodes are.
    fn loaded(&self, _grid: &Grid<D>) -> Option<Vec<usize>> {
        None
    }

    /// Bytes it keeps for the whole body.
    fn bytes(&self) -> usize {
        0
    }
}

/// A bond of the half family in SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FamilyBond<const D: usize> {
    /// In spacings.
    pub offset: [i32; D],
    pub direction: Direction<D>,
    /// w = c V β/|ξ| in N/m⁴.
    pub weight: f64,
}

/// The half family of a lattice in SI units: `modulus` is the intended C₁₁ in Pa (E in a bar).
pub fn family<const D: usize>(stencil: &Stencil<D>, modulus: f64, spacing: f64) -> Vec<FamilyBond<D>> {
    let unit = modulus / (spacing * spacing);
    let si = |bond: &crate::lattice::Bond<D>| FamilyBond {
        offset: bond.offset,
        direction: Direction::new(bond.offset, spacing),
        weight: bond.weight * unit,
    };
    stencil.bonds.iter().map(si).collect()
}

/// How many nodes away the bonds of a family reach along an axis.
fn reach_of<const D: usize>(family: impl IntoIterator<Item = FamilyBond<D>>) -> usize {
    let offsets = family.into_iter().flat_map(|bond| bond.offset);
    offsets.map(|n| n.unsigned_abs() as usize).max().unwrap_or(0)
}

/// Whether the bond from a node to its neighbour at an offset exists.
pub trait Present<const D: usize>: Fn([isize; D], [i32; D]) -> bool {}
impl<const D: usize, F: Fn([isize; D], [i32; D]) -> bool> Present<D> for F {}

/// η of the bond from one place to another, component by component.
#[inline(always)]
fn apart<const D: usize>(displacement: Window<'_>, from: usize, to: usize, stride: usize) -> [f64; D] {
    std::array::from_fn(|axis| displacement[to + axis * stride] - displacement[from + axis * stride])
}

/// Nodes from which every bond exists, or those from which some are missing.
fn whole<const D: usize>(
    grid: &Grid<D>,
    family: &[FamilyBond<D>],
    present: &impl Present<D>,
) -> impl Fn([isize; D]) -> bool {
    let mut complete = vec![false; grid.cells()];
    for node in grid.each() {
        complete[grid.number(node)] =
            family.iter().all(|bond| present(node, bond.offset) && present(node, bond.offset.map(|n| -n)));
    }
    let grid = grid.clone();
    move |node| complete[grid.number(node)]
}
