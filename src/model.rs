//! The equation of motion made concrete: ρ ü = Σ forces, under constraints, between edges.
//!
//! A model is the list of its terms. What a scene does not call for is not in the list and costs nothing.

use crate::breaking::RunningNotches;
use crate::connectivity::Connectivity;
use crate::constraints::{Constraint, Edges};
use crate::family::half_family;
use crate::forces::surface::{Correction, Factors};
use crate::forces::{
    BondList, Breaking, Class, FamilyBond, Finite, Force, LatticeStencil, Law, Listed, Masks, Now, Small,
    family,
};
use crate::grid::Grid;
use crate::lattice::Stencil;
use crate::scene::{Acts, Operator, Rotations, Scene, Setting, Wrong};
use crate::simd::Isa;
use rayon::prelude::*;
use std::ops::Range;

/// What resists acceleration.
#[derive(Debug, Clone, PartialEq)]
pub enum Inertia {
    /// ρ in kg/m³, everywhere.
    Uniform(f64),
    /// A density for every place of a field; ghosts do not matter.
    Diagonal(Vec<f64>),
}

/// A body ready to move.
pub struct Model<const D: usize> {
    pub grid: Grid<D>,
    pub inertia: Inertia,
    /// In m³.
    pub cell_volume: f64,
    pub edges: Edges<D>,
    /// Ordered by class.
    forces: Vec<Box<dyn Force<D>>>,
    pub constraints: Vec<Box<dyn Constraint<D>>>,
    /// The rule by which bonds break; most bodies have none.
    pub breaking: Option<RunningNotches>,
    /// Whether the forces are linear in u, so that ½uᵀKu is the elastic energy.
    pub linear: bool,
    /// For which the kernels run.
    pub isa: Isa,
}

impl<const D: usize> Model<D> {
    /// The model of a scene that [`crate::plan::Plan::of`] accepts, for the chosen instruction set.
    pub fn new(scene: &Scene<D>) -> Result<Self, Wrong> {
        Self::on(scene, Isa::chosen())
    }

    /// The same for an instruction set.
    pub fn on(scene: &Scene<D>, isa: Isa) -> Result<Self, Wrong> {
        let unusable =
            |wrong: crate::lattice::Unusable| Wrong::new("lattice.m", wrong.to_string(), wrong.cure());
        let stencil = Stencil::<D>::new(scene.lattice).map_err(unusable)?;
        let grid = scene.grid(stencil.reach());
        let offsets: Vec<[i32; D]> = stencil.bonds.iter().map(|bond| bond.offset).collect();
        let breaking = RunningNotches::of(scene, &offsets, &grid);
        let bonds = match scene.rotations {
            Rotations::Small => bonds::<D, Small>(scene, &stencil, &grid, breaking.as_ref(), isa),
            Rotations::Finite => bonds::<D, Finite>(scene, &stencil, &grid, breaking.as_ref(), isa),
        };
        let mut model = Self {
            inertia: Inertia::Uniform(scene.material.density),
            cell_volume: scene.cell_volume(),
            edges: scene.edges,
            forces: bonds,
            constraints: Vec::new(),
            breaking,
            linear: scene.linear(),
            grid,
            isa,
        };
        for (index, effect) in scene.effects.iter().enumerate() {
            let setting = Setting::of(scene, &model.grid);
            match effect.act(&setting).map_err(|wrong| wrong.inside(&format!("effect[{index}]")))? {
                Acts::Force(force) => model.add(force),
                Acts::Constraint(constraint) => model.constraints.push(constraint),
            }
        }
        Ok(model)
    }

    /// Adds a term, after those of its class.
    ///
    /// # Panics
    /// When it looks beyond the halo.
    pub fn add(&mut self, force: Box<dyn Force<D>>) {
        assert!(force.reach() <= self.grid.halo, "{} looks beyond the halo", force.name());
        let at = self.forces.partition_point(|other| other.class() <= force.class());
        self.forces.insert(at, force);
    }

    /// The terms, in the order in which they are summed.
    pub fn forces(&self) -> &[Box<dyn Force<D>>] {
        &self.forces
    }

    /// Which terms are of a class.
    pub fn of_class(&self, class: Class) -> Range<usize> {
        let until = |class| self.forces.partition_point(|force| force.class() <= class);
        let from = self.forces.partition_point(|force| force.class() < class);
        from..until(class)
    }

    /// Adds some of the terms to a force field in N/m³. Threads share the pieces; no sum depends on how.
    pub fn add_forces(&self, terms: Range<usize>, now: &Now<'_>, field: &mut [f64]) {
        let terms = &self.forces[terms];
        self.each_piece(field, |piece, sum| terms.iter().for_each(|force| force.add(now, piece, sum)));
    }

    /// The whole right-hand side ρü, in N/m³, into `field`.
    pub fn force(&self, now: &Now<'_>, field: &mut [f64]) {
        self.each_piece(field, |piece, sum| self.force_on(now, piece, sum));
    }

    /// The same on one piece.
    pub(crate) fn force_on(&self, now: &Now<'_>, piece: usize, sum: &mut [f64]) {
        sum.fill(0.0);
        self.forces.iter().for_each(|force| force.add(now, piece, sum));
    }

    /// Energy held by the forces that have a potential, in J.
    pub fn energy(&self, now: &Now<'_>) -> f64 {
        let of = |piece| self.forces.iter().filter_map(|force| force.energy(now, piece)).sum::<f64>();
        let pieces = self.map_pieces((0..self.grid.pieces()).collect(), of);
        self.cell_volume * pieces.iter().sum::<f64>()
    }

    /// What bonds held in J that are broken in `to` and not in `from`, the state a step before.
    pub(crate) fn released(&self, from: &Now<'_>, to: &Now<'_>) -> f64 {
        let of = |piece| self.forces.iter().map(|force| force.released(from, to, piece)).sum::<f64>();
        let pieces = self.map_pieces((0..self.grid.pieces()).collect(), of);
        self.cell_volume * pieces.iter().sum::<f64>()
    }

    /// Does something with each piece of a field; for a small body no thread is woken.
    pub(crate) fn each_piece(&self, field: &mut [f64], act: impl Fn(usize, &mut [f64]) + Send + Sync) {
        let (body, piece) = (&mut field[self.grid.body()], self.grid.piece());
        if self.worth_threads() < 2 {
            body.chunks_mut(piece).enumerate().for_each(|(index, sum)| act(index, sum));
        } else {
            body.par_chunks_mut(piece).enumerate().for_each(|(index, sum)| act(index, sum));
        }
    }

    /// What pieces give, in their order.
    pub(crate) fn map_pieces<T: Send>(
        &self,
        pieces: Vec<usize>,
        of: impl Fn(usize) -> T + Send + Sync,
    ) -> Vec<T> {
        if self.worth_threads() < 2 {
            pieces.into_iter().map(of).collect()
        } else {
            pieces.into_par_iter().map(of).collect()
        }
    }

    /// How many threads the body is worth waking: fewer than two where it is small.
    pub(crate) fn worth_threads(&self) -> usize {
        self.grid.count() / WORTH_A_THREAD
    }

    /// Fills the ghosts of a displacement field.
    pub fn fill_ghosts(&self, displacement: &mut [f64]) {
        self.edges.fill(&self.grid, displacement);
    }
}

/// Nodes for which it is worth waking another thread.
const WORTH_A_THREAD: usize = 4096;

/// The bonds of a body. Nodes whose bonds all keep the lattice's weights are served by the operator asked for, the
/// others, a band along corrected edges, by a list; those whose bonds may break by an operator of the same kind that looks
/// at what has broken.
fn bonds<const D: usize, L: Law>(
    scene: &Scene<D>,
    stencil: &Stencil<D>,
    grid: &Grid<D>,
    breaking: Option<&RunningNotches>,
    isa: Isa,
) -> Vec<Box<dyn Force<D>>> {
    let family = family(stencil, scene.modulus(), scene.spacing);
    let connectivity = Connectivity::of(scene);
    let present = |node, offset| connectivity.present(node, offset);
    let factors = surface_factors(scene, &family, grid);
    let lasts =
        |node| breaking.is_none_or(|breaking| breaking.breakable().first_word(grid.number(node)).is_none());
    let neutral = |node| lasts(node) && factors.as_ref().is_none_or(|factors| factors.neutral(node));
    let mut forces: Vec<Box<dyn Force<D>>> = vec![match scene.operator {
        Operator::Stencil => Box::new(LatticeStencil::<D, L>::new(grid, &family, neutral, &present, isa)),
        Operator::Bonds => Box::new(BondList::<D, L>::new(grid, &family, neutral, &present, |_, _| 1.0)),
    }];
    if let Some(breakable) = breaking.map(RunningNotches::breakable) {
        forces.push(match scene.operator {
            Operator::Stencil => {
                let masks = Masks::new(grid, &family, breakable, &present, isa);
                Box::new(Breaking::<D, L, _>::new(grid, masks))
            }
            Operator::Bonds => {
                let listed = Listed::<D, L>::new(grid, &family, breakable, &present);
                Box::new(Breaking::<D, L, _>::new(grid, listed))
            }
        });
    }
    if let Some(factors) = &factors {
        let banded = |node| !factors.neutral(node);
        let factor = |owner, bond| factors.of(owner, bond);
        forces.push(Box::new(BondList::<D, L>::new(grid, &family, banded, &present, factor)));
    }
    forces
}

/// The surface correction's factors; `None` when it is off.
pub fn surface_factors<const D: usize>(
    scene: &Scene<D>,
    family: &[FamilyBond<D>],
    grid: &Grid<D>,
) -> Option<Factors<D>> {
    let fractions: Vec<f64> = half_family::<D>(scene.lattice.m, scene.lattice.volume_rule)
        .iter()
        .map(|neighbour| neighbour.fraction)
        .collect();
    (scene.surface != Correction::None)
        .then(|| Factors::new(scene.surface, grid, Connectivity::of(scene), family, &fractions))
}
