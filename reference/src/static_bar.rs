//! A finite lattice bar pulled at its free ends, at rest: what missing bonds and surface corrections do to its stiffness.
//!
//! Nodes i = 0 … N−1, unit cells. Node i feels the force per volume (E/Δx²) Σ_j f_ij w_ij (u_j − u_i) of the nodes j of the
//! body in its family, w the weights of the infinite lattice, and f_ij the factor of a surface correction (Le and Bobaru,
//! Comput. Mech. 61 (2018) 499: energy method, volume method). The outermost `layer` cells of an end carry the body force
//! ±σ/(layer Δx) each, so that they pull with the traction σ. Displacements are in σΔx/E, forces per volume in σ/Δx.
//!
//! Solved by LDLᵀ of the banded stiffness in double-double arithmetic: displacements are good to the last bit but one.

use crate::bonds::{BarBond, Lattice};
use crate::double_double::Dd;
use crate::lattice;

/// How bonds near an end are made stiffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Correction {
    /// Not at all: f = 1.
    None,
    /// f_ij = ½(λ_i + λ_j), λ_i the local energy density over the node's own under uniform strain ε. The node's own is
    /// ¼(E/Δx²) Σ_j w_ij (rΔxε)², half of each bond; the local one ½Eε² times the lattice's long-wave modulus
    /// Σ_{r>0} w_r r², so that λ = 1 inside every lattice, calibrated or not.
    Energy,
    /// f_ij = 2V₀/(V_i + V_j), V_i the counted volume of the neighbours that exist (the node itself not among them),
    /// V₀ the same inside.
    Volume,
}

/// What stands at the left end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LeftEnd {
    /// No bonds beyond it, pulled like the right end; the mean displacement is zero.
    Free,
    /// N mirrored nodes −1 … −N with u_{−1−i} = −u_i: the right half of a bar of 2N nodes.
    Mirror,
}

/// A bar of N cells with its loads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticBar {
    /// Weights of the bonds, calibrated where it says so.
    pub lattice: Lattice,
    /// N.
    pub nodes: usize,
    /// The left end; the right one is free.
    pub left: LeftEnd,
    /// Surface correction.
    pub correction: Correction,
    /// Loaded cells at an end, at least 1.
    pub layer: usize,
}

/// The bar at rest under its loads.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretched {
    /// u_i over σΔx/E, N of them.
    pub displacements: Vec<f64>,
    left: LeftEnd,
}

impl StaticBar {
    /// The displacements. None where loads overlap (2 `layer` > N, with a mirror `layer` > N), where there are fewer
    /// than 4 nodes, and where the bonds leave a node loose.
    pub fn solve(&self) -> Option<Stretched> {
        let both = if self.left == LeftEnd::Free { 2 } else { 1 };
        if self.layer == 0 || both * self.layer > self.nodes || self.nodes < 4 {
            return None;
        }
        let rows = self.stiffness()?;
        // Loads balance, so that a free bar may be held at its first node and moved afterwards.
        let held = both - 1;
        let free = solve(&rows[held..], &self.loads()[held..])?;
        let mut all = vec![Dd::ZERO; held];
        all.extend(free);
        let mean = all.iter().copied().sum::<Dd>() / Dd::from(self.nodes as f64);
        let shift = if self.left == LeftEnd::Free { mean } else { Dd::ZERO };
        let displacements = all.into_iter().map(|u| (u - shift).to_f64()).collect();
        Some(Stretched { displacements, left: self.left })
    }

    /// Force per volume of the bonds on each node, over σ/Δx, under displacements u_i over σΔx/E. At rest it is the
    /// negative of the load. None where the number of displacements is not N or the lattice has no stiffness.
    pub fn forces(&self, displacements: &[f64]) -> Option<Vec<f64>> {
        let family = Family::of(self)?;
        if displacements.len() != self.nodes {
            return None;
        }
        let at = |i: isize| match i {
            0.. => Dd::from(displacements[i as usize]),
            _ => -Dd::from(displacements[(-1 - i) as usize]),
        };
        let on = |i: isize| -> Dd {
            family.neighbours(i).map(|(j, bond)| family.factor(i, j) * bond.weight * (at(j) - at(i))).sum()
        };
        Some((0..self.nodes as isize).map(|i| on(i).to_f64()).collect())
    }

    /// f of the bond between nodes i and j (mirrored ones are −1 … −N), whether or not they are neighbours. None
    /// where one of them is not in the body or the lattice has no stiffness.
    pub fn bond_factor(&self, i: isize, j: isize) -> Option<f64> {
        let family = Family::of(self)?;
        (family.exists(i) && family.exists(j)).then(|| family.factor(i, j).to_f64())
    }

    /// What [`Stretched::recovered_modulus`] is in a local bar (nearest neighbours, modulus 1) under the same loads:
    /// N/(N − `layer` + 1/`layer`), with 2N for N at a mirror. More than 1, since the stress is built up over the loaded
    /// cells.
    pub fn local_modulus(&self) -> f64 {
        let cells = (if self.left == LeftEnd::Free { 1 } else { 2 } * self.nodes) as f64;
        let layer = self.layer as f64;
        cells / (cells - layer + 1.0 / layer)
    }

    /// Body force on each node over σ/Δx.
    pub fn body_forces(&self) -> Vec<f64> {
        self.loads().into_iter().map(Dd::to_f64).collect()
    }

    fn loads(&self) -> Vec<Dd> {
        let share = Dd::ONE / Dd::from(self.layer as f64);
        let load = |i: usize| {
            if i + self.layer >= self.nodes {
                share
            } else if i < self.layer && self.left == LeftEnd::Free {
                -share
            } else {
                Dd::ZERO
            }
        };
        (0..self.nodes).map(load).collect()
    }

    /// Lower band of the stiffness: row i holds the entries (i, i), (i, i − 1), …
    fn stiffness(&self) -> Option<Vec<Vec<Dd>>> {
        let family = Family::of(self)?;
        let band = family.bonds.iter().map(|bond| bond.offset as usize).max()?;
        let row = |i: usize| {
            let mut row = vec![Dd::ZERO; band + 1];
            for (j, bond) in family.neighbours(i as isize) {
                let stiffness = family.factor(i as isize, j) * bond.weight;
                row[0] = row[0] + stiffness;
                let (column, sign) = if j < 0 { ((-1 - j) as usize, 1.0) } else { (j as usize, -1.0) };
                if column <= i {
                    row[i - column] = row[i - column] + stiffness * sign;
                }
            }
            row
        };
        Some((0..self.nodes).map(row).collect())
    }
}

/// The bonds of a bar and the factors at its nodes.
struct Family {
    bonds: Vec<BarBond>,
    correction: Correction,
    first: isize,
    end: isize,
    /// λ_i or V_i/V₀ of nodes 0 … N−1.
    nodal: Vec<Dd>,
}

impl Family {
    fn of(bar: &StaticBar) -> Option<Self> {
        let bonds = lattice::bar_bonds(&bar.lattice);
        let end = bar.nodes as isize;
        let first = if bar.left == LeftEnd::Mirror { -end } else { 0 };
        let mut family = Self { bonds, correction: bar.correction, first, end, nodal: Vec::new() };
        // Energy per volume over Eε²/4, and counted volume: of a node in the body, and inside, in the same order.
        let energy = |bond: &BarBond| bond.weight * (bond.offset * bond.offset);
        let term = |bond: &BarBond| match bar.correction {
            Correction::Volume => bond.fraction,
            _ => energy(bond),
        };
        let inside: Dd = family.bonds.iter().map(|bond| term(bond) * 2.0).sum();
        let of_node = |i: isize| -> Dd {
            let there = |j: isize| if family.exists(j) { 1.0 } else { 0.0 };
            let sides = |bond: &BarBond| there(i - bond.offset as isize) + there(i + bond.offset as isize);
            family.bonds.iter().map(|bond| term(bond) * sides(bond)).sum()
        };
        let nodal = |i: isize| match bar.correction {
            Correction::None => Dd::ONE,
            Correction::Energy => inside / of_node(i),
            Correction::Volume => of_node(i) / inside,
        };
        let nodal: Vec<Dd> = (0..end).map(nodal).collect();
        family.nodal = nodal;
        let modulus: Dd = family.bonds.iter().map(energy).sum();
        (modulus.hi.is_finite() && modulus.hi > 0.0).then_some(family)
    }

    fn exists(&self, i: isize) -> bool {
        (self.first..self.end).contains(&i)
    }

    /// The neighbours that exist, nearest first.
    fn neighbours(&self, i: isize) -> impl Iterator<Item = (isize, &BarBond)> {
        let both = |bond| [(-1, bond), (1, bond)];
        let all = self.bonds.iter().flat_map(both);
        all.map(move |(side, bond): (isize, &BarBond)| (i + side * bond.offset as isize, bond))
            .filter(|(j, _)| self.exists(*j))
    }

    fn factor(&self, i: isize, j: isize) -> Dd {
        let at = |i: isize| self.nodal[if i < 0 { -1 - i } else { i } as usize];
        match self.correction {
            Correction::None => Dd::ONE,
            Correction::Energy => (at(i) + at(j)) * 0.5,
            Correction::Volume => Dd::from(2.0) / (at(i) + at(j)),
        }
    }
}

/// K u = b for a banded positive K; None where a pivot is not positive. Entries of a row that stand left of column 0
/// belong to a node that is held, and are not read.
fn solve(rows: &[Vec<Dd>], loads: &[Dd]) -> Option<Vec<Dd>> {
    let (count, band) = (rows.len(), rows.first()?.len() - 1);
    // L has ones on its diagonal; its row i holds D_i, then the entries (i, i − 1), (i, i − 2), …
    let mut factor: Vec<Vec<Dd>> = Vec::with_capacity(count);
    for (i, row) in rows.iter().enumerate() {
        let mut line = vec![Dd::ZERO; band + 1];
        let first = i.saturating_sub(band);
        // (LD)_ij for j from left to right, then its share of the pivot.
        let mut scaled = vec![Dd::ZERO; band + 1];
        let mut pivot = row[0];
        for j in first..i {
            let from = first.max(j.saturating_sub(band));
            let before: Dd = (from..j).map(|k| scaled[i - k] * factor[j][j - k]).sum();
            scaled[i - j] = row[i - j] - before;
            line[i - j] = scaled[i - j] / factor[j][0];
            pivot = pivot - scaled[i - j] * line[i - j];
        }
        if pivot.hi <= row[0].hi * 1e-24 || !pivot.hi.is_finite() {
            return None;
        }
        line[0] = pivot;
        factor.push(line);
    }
    let mut u: Vec<Dd> = Vec::with_capacity(count);
    for (i, load) in loads.iter().enumerate() {
        let known: Dd = (i.saturating_sub(band)..i).map(|j| factor[i][i - j] * u[j]).sum();
        u.push(*load - known);
    }
    for i in (0..count).rev() {
        let known: Dd = (i + 1..count.min(i + band + 1)).map(|j| factor[j][j - i] * u[j]).sum();
        u[i] = u[i] / factor[i][0] - known;
    }
    Some(u)
}

impl Stretched {
    /// E_app/E = σL/(E(u(L) − u(0))), the displacements of the ends extrapolated linearly from the two outermost nodes
    /// (u(0) = 0 at a mirror). To be held against [`StaticBar::local_modulus`], not against 1: below it where ends are
    /// soft.
    pub fn recovered_modulus(&self) -> f64 {
        let u = &self.displacements;
        let last = u.len() - 1;
        let right = u[last] + 0.5 * (u[last] - u[last - 1]);
        let left = if self.left == LeftEnd::Free { u[0] - 0.5 * (u[1] - u[0]) } else { 0.0 };
        u.len() as f64 / (right - left)
    }

    /// E_app/E as the stress over the strain of a straight line fitted by least squares to the nodes in the middle
    /// half of the bar; with a mirror, of the whole bar of 2N nodes. Loads must stay outside of it.
    pub fn middle_modulus(&self) -> f64 {
        let length = self.displacements.len() as f64;
        let (centre, half) = if self.left == LeftEnd::Free { (0.5, 0.25) } else { (0.0, 0.5) };
        let places = self.displacements.iter().enumerate();
        let inside = places
            .map(|(i, u)| (i as f64 + 0.5 - centre * length, u))
            .filter(|(x, _)| x.abs() <= half * length);
        let (top, bottom) = inside.fold((0.0, 0.0), |(top, bottom), (x, u)| (top + x * u, bottom + x * x));
        bottom / top
    }
}
