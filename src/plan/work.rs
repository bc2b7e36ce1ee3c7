//! What one step of a scene does: nodes by kind, floating-point operations, bytes to and from memory.
//!
//! Operations are those of the operators themselves, additions, multiplications, divisions and roots, a fused
//! multiply-add being two. Nodes with all their bonds take, with small rotations, those of a stencil that walks along x
//! and shares what columns have in common: see [`whole_flops`]. Bytes are counted as STREAM counts them, without the
//! read that a processor does to own a line before it writes it: u and d read, u and d written, 32 for each component,
//! by as many steps as one pass over the body takes; and what the terms keep, read once in each step.

use super::counts::Counts;
use crate::lattice::{Bond, Stencil};
use crate::scene::{Rotations, Scene, Watch};
use serde::{Deserialize, Serialize};

/// Nodes by what serves their bonds. An end is a bond seen from one of its nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Kinds {
    /// All bonds there, by the stencil.
    pub whole_nodes: u64,
    /// Some bonds missing, by the stencil.
    pub masked_nodes: u64,
    pub masked_ends: u64,
    /// By a list of bonds.
    pub listed_nodes: u64,
    pub listed_ends: u64,
    /// Bonds that may break.
    pub breaking_nodes: u64,
    pub breaking_ends: u64,
}

/// What a step does.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Work {
    /// Of the body.
    pub dimension: usize,
    /// Pairs ±ξ of the family.
    pub pairs: u64,
    /// Whether bonds turn with the body.
    pub finite_rotations: bool,
    #[serde(flatten)]
    pub kinds: Kinds,
    /// Nodes on which a force depends on the velocity.
    pub damped_nodes: u64,
    /// Components of nodes on which loads act.
    pub loaded_places: u64,
    /// Whether the energy ledger books every step.
    pub booked: bool,
    /// Whether what lies beyond the edges is filled anew after every step, since the body's first rows follow its last.
    pub repeats: bool,
    pub flops_per_step: f64,
    /// u and d read and written.
    pub state_bytes_per_step: f64,
    /// What operators and loads keep.
    pub kept_bytes: f64,
}

/// What the effects of a scene do in each step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Effects {
    pub damped_nodes: u64,
    pub loaded_places: u64,
    pub kept_bytes: usize,
}

impl Work {
    pub(super) fn of<const D: usize>(
        scene: &Scene<D>,
        stencil: &Stencil<D>,
        counts: &Counts,
        effects: Effects,
    ) -> Self {
        let (finite, kinds) = (scene.rotations == Rotations::Finite, counts.kinds);
        let nodes = kinds.nodes() as f64;
        let whole = if finite { finite_whole_flops(D, stencil.bonds.len()) } else { whole_flops(stencil) };
        let ends = kinds.masked_ends + kinds.listed_ends + kinds.breaking_ends;
        let bonds = kinds.whole_nodes as f64 * whole as f64 + ends as f64 * end_flops(D, finite) as f64;
        let rates = (DAMPING_FLOPS * D) as f64 * effects.damped_nodes as f64;
        Self {
            dimension: D,
            pairs: stencil.bonds.len() as u64,
            finite_rotations: finite,
            kinds,
            damped_nodes: effects.damped_nodes,
            loaded_places: effects.loaded_places,
            booked: scene.probes.iter().any(|probe| probe.watch == Watch::Energies),
            repeats: scene.edges.repeats_pieces(),
            flops_per_step: bonds + rates + effects.loaded_places as f64 + nodes * (UPDATE_FLOPS * D) as f64,
            state_bytes_per_step: nodes * (STATE_BYTES * D) as f64,
            kept_bytes: (counts.kept_bytes + effects.kept_bytes) as f64,
        }
    }

    /// Bytes to and from memory in a step, when nothing stays in a cache from one pass to the next.
    pub fn bytes_per_step(&self, steps_per_pass: u64) -> f64 {
        self.state_bytes_per_step / steps_per_pass as f64 + self.kept_bytes
    }

    /// What must be at hand in every step, in bytes: u, d, and what operators and loads keep.
    pub fn working_set_bytes(&self) -> f64 {
        0.5 * self.state_bytes_per_step + self.kept_bytes
    }
}

impl Kinds {
    /// Of all kinds.
    pub fn nodes(&self) -> u64 {
        self.whole_nodes + self.masked_nodes + self.listed_nodes + self.breaking_nodes
    }
}

/// d + Δt²/ρ F and u + d, for each component.
const UPDATE_FLOPS: usize = 3;

/// For each component: 2ρd/Δt² + F, times a share, taken from F.
const DAMPING_FLOPS: usize = 4;

/// For each component: u and d read and written.
const STATE_BYTES: usize = 32;

/// Of a node with all its bonds, by the linear law, without the update. Bonds of no weight cost nothing.
///
/// Let t_i be the number of bonds (i, j), j ≥ 1, i ≥ 0, and R the reach. On its own column a node forms
/// (u₊ − u) + (u₋ − u) and u₊ − u₋ over ±j for both components: 4 additions each, 8R. Column 0 pulls along y alone: 2t_0 − 1.
/// Column i ≥ 1 makes sums of even and odd parts for both components, 4t_i multiply-adds of which the first of each is a
/// product, and adds and subtracts them for its two sides: 8t_i − 4 + 4. The bond along x takes an addition and two
/// multiply-adds, one for the node and one for what goes to the node behind, as does y where t_i > 0; the first for x, and
/// the second where t_i = 0, are products. To gather what columns ±i have made takes 2 additions for each component, 1
/// where t_i = 0. A bar takes 3 additions and a multiply-add for each pair.
pub fn whole_flops<const D: usize>(stencil: &Stencil<D>) -> usize {
    let bonds = || stencil.bonds.iter().filter(|bond| bond.weight != 0.0);
    if D == 1 {
        return 4 * bonds().count();
    }
    let reach = stencil.reach();
    let above = |column: usize| bonds().filter(|bond| is_above(bond, column)).count();
    let own = 8 * reach + (2 * above(0)).saturating_sub(1);
    let column = |i: usize| match above(i) {
        0 => 1 + 2 + 1 + 1,
        t => 8 * t - 4 + 4 + 2 * (1 + 2 + 2) + 4,
    };
    own - 1 + (1..=reach).map(column).sum::<usize>()
}

/// Whether a bond leads to a column and to a row above.
fn is_above<const D: usize>(bond: &Bond<D>, column: usize) -> bool {
    bond.offset[0] == column as i32 && bond.offset.get(1).is_some_and(|&row| row > 0)
}

/// The same by the exact law, whose pairs share nothing: two ends without their sums, their sum, and the product with the
/// weight added.
pub fn finite_whole_flops(dimension: usize, pairs: usize) -> usize {
    pairs * (2 * (end_flops(dimension, true) - 2 * dimension) + dimension + 2 * dimension)
}

/// Of one end of a bond: η, its pull, and the product with the weight added. Small: n·η and n (n·η). Finite: y = ξ + η, |y|,
/// the elongation η·(ξ + y)/(|y| + |ξ|) and e y/|y|.
pub fn end_flops(dimension: usize, finite: bool) -> usize {
    let d = dimension;
    let dot = 2 * d - 1;
    let pull = if finite { d + dot + 1 + d + dot + 2 + 2 * d } else { dot + d };
    d + pull + 2 * d
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Kernel;
    use crate::lattice::Lattice;
    use crate::partial_volume::VolumeRule;

    fn stencil<const D: usize>(kernel: Kernel, m: f64, volume_rule: VolumeRule) -> Stencil<D> {
        Stencil::new(Lattice { kernel, m, volume_rule, calibrated: false }).unwrap()
    }

    /// By hand. m = 3, linear: rows 0 to 3 hold 3, 3, 2, 1 bonds above the axis.
    /// 24 on the own column, 5 along y, 3 columns of 24 + 16 + 8 to make and 14 to gather, one product.
    #[test]
    fn operations_of_whole_nodes_by_hand() {
        let gaussian = Kernel::Gaussian { p: 2.0 };
        let plane = stencil::<2>(gaussian, 3.0, VolumeRule::Linear);
        assert_eq!(whole_flops(&plane), 24 + 5 + 24 + 16 + 8 + 3 * 14 - 1);
        // m = 1.5, full: the eight neighbours around. 8 + 1, and one column of 8 + 14, less one.
        assert_eq!(whole_flops(&stencil::<2>(gaussian, 1.5, VolumeRule::Full)), 9 + 22 - 1);
        // m = 3, full: column 3 holds the bond along x alone.
        let full = whole_flops(&stencil::<2>(gaussian, 3.0, VolumeRule::Full));
        assert_eq!(full, 24 + 5 + 2 * 16 + 2 * 14 + 5 - 1);
        assert_eq!(whole_flops(&stencil::<1>(gaussian, 3.0, VolumeRule::Full)), 12);
        // A conical kernel has no weight at δ.
        assert_eq!(whole_flops(&stencil::<1>(Kernel::Conical, 3.0, VolumeRule::Full)), 8);
    }

    #[test]
    fn operations_of_ends_by_hand() {
        // η 2, n·η 3, n (n·η) 2, weight 4; in a bar 1, 1, 1, 2.
        assert_eq!((end_flops(2, false), end_flops(1, false)), (11, 5));
        // η 2, y 2, |y| 4, ξ + y 2, its product 3, |y| + |ξ| 1, over it 1, e y/|y| 4, weight 4.
        assert_eq!((end_flops(2, true), end_flops(1, true)), (23, 12));
        assert_eq!(finite_whole_flops(2, 18), 18 * (2 * 19 + 2 + 4));
    }
}
