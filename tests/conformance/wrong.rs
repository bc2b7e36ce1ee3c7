//! Forces that are wrong in one way each, added to a sound model: the check that owns this way must fail.

use crate::bodies::model;
use pd_verify::forces::{Class, Force, LatticeStencil, Now, Small, family};
use pd_verify::grid::Grid;
use pd_verify::lattice::Stencil;
use pd_verify::model::Model;
use pd_verify::scene::Scene;
use std::sync::Mutex;

/// In which way it is wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// The last component is a millionth too large.
    Scaled,
    /// One node feels a millionth more of its bonds than its neighbours do.
    OneSided,
    /// Pairs push each other sideways: balanced forces, an unbalanced moment.
    Sideways,
    /// A constant, 1e-12 of the first force seen.
    Constant,
    /// A millionth of the linearised law, whatever the law: it does not turn with the body.
    Linearised,
    /// A millionth of the force of the state seen before.
    Stale,
    /// A trifle for each thread.
    Threads,
    /// Says that it keeps eight bytes.
    Heavy,
}

/// The force.
pub struct Wrong<const D: usize> {
    way: Way,
    grid: Grid<D>,
    own: LatticeStencil<D, Small>,
    memory: Mutex<Vec<f64>>,
}

/// A sound model and, added to it, a wrong force.
pub fn spoilt<const D: usize>(scene: &Scene<D>, way: Way) -> Model<D> {
    let mut model = model(scene);
    let stencil = Stencil::<D>::new(scene.lattice).expect("a usable lattice");
    let half = family(&stencil, scene.modulus(), scene.spacing);
    let present = |node, offset| scene.edges.present(scene.nodes, node, offset);
    let own = LatticeStencil::new(&model.grid, &half, |_| true, &present, model.isa);
    let grid = model.grid.clone();
    model.add(Box::new(Wrong { way, grid, own, memory: Mutex::new(Vec::new()) }));
    model
}

impl<const D: usize> Force<D> for Wrong<D> {
    fn name(&self) -> String {
        format!("{:?}", self.way)
    }

    fn class(&self) -> Class {
        Class::Internal
    }

    fn add(&self, now: &Now<'_>, piece: usize, sum: &mut [f64]) {
        let mut own = vec![0.0; sum.len()];
        self.own.add(now, piece, &mut own);
        let largest = own.iter().fold(0.0, |largest: f64, f| largest.max(f.abs()));
        let stride = self.grid.stride();
        let first = self.grid.place([0; D]) - self.grid.body().start;
        let middle = first + self.grid.nodes[0] / 2;
        let component = |at: usize| (at / stride) % D;
        let mut memory = self.memory.lock().expect("no thread died");
        for (at, (sum, f)) in sum.iter_mut().zip(&own).enumerate() {
            *sum += match self.way {
                Way::Scaled if D == 1 || component(at) == 1 => 1e-6 * f,
                Way::OneSided if at % stride == middle && at / self.grid.row() == 2 % self.grid.rows() => {
                    1e-6 * f
                }
                Way::Sideways if D == 2 && component(at) == 0 => 1e-6 * own[at + stride],
                Way::Sideways if D == 2 => -1e-6 * own[at - stride],
                Way::Constant if *f != 0.0 || largest == 0.0 => 1e-12 * largest + f64::MIN_POSITIVE,
                Way::Linearised => 1e-6 * f,
                Way::Stale => 1e-6 * memory.get(at).copied().unwrap_or(0.0),
                Way::Threads => 1e-9 * rayon::current_num_threads() as f64 * f,
                _ => 0.0,
            };
        }
        *memory = own;
    }

    fn bytes(&self) -> usize {
        if self.way == Way::Heavy { 8 } else { 0 }
    }
}
