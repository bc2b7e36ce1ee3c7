//! The weights of a family that is the same on both sides of each axis and on both axes, folded to one quadrant.
//!
//! The linear law's force on a node, with n = ξ/|ξ|, w_xx = w n_x², w_yy = w n_y², w_xy = w n_x n_y at (i, j) in spacings, is
//! f_x = Σ w_xx η_x + w_xy η_y, f_y = Σ w_xy η_x + w_yy η_y. Each η is split into a step along y in the neighbour's column
//! and one along x in the node's row, both differences, so that digits are lost nowhere. With S_j = (u(j) − u) + (u(−j) − u)
//! and D_j = u(j) − u(−j) in a column, the columns i and −i give P_i = A_i + B_i and M_i = A_i − B_i, A_i = Σ_j w_xx S_j^x,
//! B_i = Σ_j w_xy D_j^y for f_x, and f_x = Σ_i P_i(x+i) + M_i(x−i) + W_i ((u(x+i) − u) + (u(x−i) − u)), W_i the sum of w_xx over
//! the column; f_y likewise with w_yy and the components of S and D exchanged. With E_i(x) = u(x+i) − u(x) the last term is
//! W_i (E_i(x) − E_i(x−i)): it is added to the node's own and taken from the M_i that goes to the node behind. A bond takes one
//! multiplication where it took four, and columns are shared by all nodes of a row.

use crate::forces::FamilyBond;

/// A folded family.
#[derive(Debug, Clone, PartialEq)]
pub struct Quadrant {
    /// How many nodes away bonds reach along an axis.
    pub reach: usize,
    /// By i from 0 to the reach: the largest j of a bond (i, j).
    pub tops: Vec<usize>,
    /// w_xx, w_yy, w_xy by i and j, each from 0 to the reach, in N/m⁴.
    bonds: Vec<[f64; 3]>,
    /// By i: sums over the columns i, of xx and of yy.
    pub row_x: Vec<f64>,
    pub row_y: Vec<f64>,
}

impl Quadrant {
    /// `None` for a family that lacks a symmetry.
    pub fn of<const D: usize>(family: &[FamilyBond<D>]) -> Option<Self> {
        let at = |bond: &FamilyBond<D>| [bond.offset[0], bond.offset.get(1).copied().unwrap_or(0)];
        let reach = super::super::reach_of(family.iter().copied());
        let side = reach + 1;
        let weight = |i: i32, j: i32| {
            // The half family holds one of the two ends.
            let mut ends = family.iter().filter(|bond| at(bond) == [i, j] || at(bond) == [-i, -j]);
            ends.next().map(|bond| bond.weight)
        };
        let mut folded = Self {
            reach,
            tops: vec![0; side],
            bonds: vec![[0.0; 3]; side * side],
            row_x: vec![0.0; side],
            row_y: vec![0.0; side],
        };
        let mut bonds = 0;
        for i in 0..side {
            for j in 0..side {
                let (a, b) = (i32::try_from(i).ok()?, i32::try_from(j).ok()?);
                if weight(a, b) != weight(a, -b) || D > 1 && weight(a, b) != weight(b, a) {
                    return None;
                }
                let Some(weight) = weight(a, b).filter(|_| i + j > 0) else { continue };
                let square = (i * i + j * j) as f64;
                let of = |product: usize| weight * product as f64 / square;
                let [xx, yy, xy] = [of(i * i), of(j * j), of(i * j)];
                folded.bonds[i * side + j] = [xx, yy, xy];
                folded.tops[i] = folded.tops[i].max(j);
                let columns = if j == 0 { 1.0 } else { 2.0 };
                folded.row_x[i] += columns * xx;
                folded.row_y[i] += columns * yy;
                bonds += if i * j == 0 { 1 } else { 2 };
            }
        }
        // Each axis holds half its bonds once; what is left would be a bond beyond the fold.
        (bonds == family.len()).then_some(folded)
    }

    /// w_xx, w_yy, w_xy of the bonds (i, j) of a column, by j from 1 to its top.
    #[inline(always)]
    pub fn column(&self, i: usize) -> &[[f64; 3]] {
        let first = i * (self.reach + 1);
        &self.bonds[first + 1..first + 1 + self.tops[i]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::forces::family;
    use crate::kernel::Kernel;
    use crate::lattice::{Lattice, Stencil};
    use crate::partial_volume::VolumeRule;
    use approx::assert_relative_eq;

    fn bonds(m: f64, volume_rule: VolumeRule) -> Vec<FamilyBond<2>> {
        let lattice = Lattice { kernel: Kernel::Constant, m, volume_rule, calibrated: false };
        family(&Stencil::new(lattice).expect("a usable lattice"), 1e9, 1e-3)
    }

    #[test]
    fn a_fold_keeps_every_bond() {
        for (m, rule, tops) in [
            (3.0, VolumeRule::Linear, vec![3, 3, 2, 1]),
            (3.0, VolumeRule::Full, vec![3, 2, 2, 0]),
            (2.0, VolumeRule::Full, vec![2, 1, 0]),
        ] {
            let bonds = bonds(m, rule);
            let folded = Quadrant::of(&bonds).expect("a lattice is symmetric");
            assert_eq!(folded.tops, tops);
            // Stretched along x by 1: Σ over the half family of w n_x² per component, from the columns and from the bonds.
            let direct: f64 = bonds.iter().map(|bond| bond.weight * bond.direction.unit[0].powi(2)).sum();
            assert_relative_eq!(folded.row_x.iter().sum::<f64>(), direct, max_relative = 1e-14);
        }
    }

    #[test]
    fn a_lopsided_family_is_not_folded() {
        let mut bonds = bonds(3.0, VolumeRule::Linear);
        bonds[7].weight *= 1.0 + 1e-15;
        assert!(Quadrant::of(&bonds).is_none());
    }
}
