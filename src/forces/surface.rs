//! Surface correction: factors for bonds near free edges, notches and holes, where families are cut off and the body is too soft.
//!
//! Energy (Madenci & Oterkus 2014, Peridynamic Theory and Its Applications, ch. 4): λ_i is the energy density of a bulk
//! node over that of node i, both stretched uniformly along an axis; a bond takes the mean of its ends, between the axes
//! along an ellipse, 1/√Σ (n_a/λ_a)². Volume (Le & Bobaru 2018, Comput. Mech. 61, 499): the factor is 2V₀/(V_i + V_j), V
//! the counted volume of a family. Both are 1 in the bulk, exactly.

use super::{FamilyBond, reach_of};
use crate::connectivity::Connectivity;
use crate::grid::Grid;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which correction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Correction {
    #[default]
    None,
    Energy,
    Volume,
}

impl Correction {
    /// In study files and plans.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Energy => "energy",
            Self::Volume => "volume",
        }
    }
}

/// The factors of a body's bonds.
pub struct Factors<const D: usize> {
    correction: Correction,
    connectivity: Connectivity<D>,
    units: Vec<[f64; D]>,
    offsets: Vec<[i32; D]>,
    grid: Grid<D>,
    /// How many nodes away bonds reach along an axis.
    reach: usize,
    /// By cell, row by row: bulk over node, energies along each axis, or the counted volume alone.
    of_node: Vec<[f64; D]>,
}

impl<const D: usize> Factors<D> {
    /// `fractions` are the counted volume fractions of the half family, in its order.
    pub fn new(
        correction: Correction,
        grid: &Grid<D>,
        connectivity: Connectivity<D>,
        family: &[FamilyBond<D>],
        fractions: &[f64],
    ) -> Self {
        let share = |index: usize, axis: usize| match correction {
            Correction::Volume => fractions[index],
            _ => {
                family[index].weight
                    * (family[index].direction.xi[axis] * family[index].direction.unit[axis]).powi(2)
            }
        };
        let total = |exists: &dyn Fn([i32; D]) -> bool| -> [f64; D] {
            let ends = |bond: &FamilyBond<D>| {
                [bond.offset, bond.offset.map(|n| -n)].into_iter().filter(|&offset| exists(offset)).count()
                    as f64
            };
            let ends: Vec<f64> = family.iter().map(ends).collect();
            std::array::from_fn(|axis| {
                ends.iter().enumerate().map(|(index, ends)| share(index, axis) * ends).sum()
            })
        };
        let bulk = total(&|_| true);
        let mut of_node = vec![[1.0; D]; grid.cells()];
        let reach = reach_of(family.iter().copied());
        for node in grid.each().filter(|node| !connectivity.clear(*node, reach)) {
            let own = total(&|offset| connectivity.present(node, offset));
            of_node[grid.number(node)] =
                std::array::from_fn(
                    |axis| if own[axis] == bulk[axis] { 1.0 } else { bulk[axis] / own[axis] },
                );
        }
        Self {
            correction,
            reach,
            grid: grid.clone(),
            of_node,
            units: family.iter().map(|bond| bond.direction.unit).collect(),
            offsets: family.iter().map(|bond| bond.offset).collect(),
            connectivity,
        }
    }

    /// The factor of the bond that `owner` (possibly a ghost) owns.
    pub fn of(&self, owner: [isize; D], bond: usize) -> f64 {
        let far = std::array::from_fn(|axis| owner[axis] + self.offsets[bond][axis] as isize);
        let (near, far) = (self.at(owner), self.at(far));
        match self.correction {
            Correction::None => 1.0,
            // 2V₀/(V_i + V_j) from V₀/V_i.
            Correction::Volume => 2.0 / (1.0 / near[0] + 1.0 / far[0]),
            Correction::Energy => {
                let along = |axis: usize| self.units[bond][axis] / (0.5 * (near[axis] + far[axis]));
                if near == far && near == [1.0; D] {
                    1.0
                } else {
                    1.0 / (0..D).map(|axis| along(axis).powi(2)).sum::<f64>().sqrt()
                }
            }
        }
    }

    /// Whether every bond of a node keeps its weight.
    pub fn neutral(&self, node: [isize; D]) -> bool {
        self.plain(node) || self.around(node).all(|factor| factor == 1.0)
    }

    /// The largest factor of a bond that exists: the frequencies of a body of positive weights grow by at most its root.
    pub fn largest(&self, grid: &Grid<D>) -> f64 {
        let corrected = grid.each().filter(|node| !self.plain(*node));
        corrected.flat_map(|node| self.around(node)).fold(1.0, f64::max)
    }

    /// Whether neither the node nor any that it is bonded to misses a bond, as far as can be said at a glance.
    fn plain(&self, node: [isize; D]) -> bool {
        self.connectivity.clear(node, 2 * self.reach)
    }

    /// The factors of a node's bonds, those that it owns and those that others own, ghosts beyond an edge among them.
    fn around(&self, node: [isize; D]) -> impl Iterator<Item = f64> + '_ {
        self.offsets.iter().enumerate().flat_map(move |(bond, offset)| {
            let backward = std::array::from_fn(|axis| node[axis] - offset[axis] as isize);
            let exists = |sign: i32| self.connectivity.present(node, offset.map(|n| sign * n));
            let own = exists(1).then(|| self.of(node, bond));
            own.into_iter().chain(exists(-1).then(|| self.of(backward, bond)))
        })
    }

    fn at(&self, node: [isize; D]) -> [f64; D] {
        self.connectivity.image(node).map_or([1.0; D], |image| self.of_node[self.grid.number(image)])
    }
}
