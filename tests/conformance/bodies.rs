//! Small bodies, lattices, edges and rough fields on which every implementation is tried, and sums over their bonds.

use pd_verify::breaking::Broken;
use pd_verify::connectivity::Connectivity;
use pd_verify::constraints::{Edge, Edges};
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{FamilyBond, Now, family};
use pd_verify::grid::Grid;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::material::{Body, Material};
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::{Effect, Operator, Rotations, Scene, StepRule, Time};
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::sync::Arc;

/// Which components of a translation no edge resists: across a mirror the odd ones are held.
pub fn kept<const D: usize>(edges: &Edges<D>) -> [bool; D] {
    std::array::from_fn(|component| {
        edges.0.iter().enumerate().all(|(axis, pair)| {
            pair.iter().all(|edge| match edge {
                Edge::Free | Edge::Periodic => true,
                Edge::MirrorOdd => component != axis,
                Edge::MirrorEven => component == axis,
            })
        })
    })
}

/// u of rounding to nearest: a result differs from the exact one by at most u of its size.
pub const UNIT: f64 = 0.5 * f64::EPSILON;

/// Numbers without pattern: Knuth's linear congruential generator.
pub struct Rough(u64);

impl Rough {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(1))
    }

    /// The next number, between −1 and 1.
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A lattice of the constant kernel.
pub fn constant(m: f64, volume_rule: VolumeRule, calibrated: bool) -> Lattice {
    Lattice { kernel: Kernel::Constant, m, volume_rule, calibrated }
}

/// A free body at rest under nothing.
pub fn scene<const D: usize>(lattice: Lattice, nodes: [usize; D]) -> Scene<D> {
    Scene {
        name: String::new(),
        material: Material { youngs_modulus: 70e9, density: 2700.0 },
        body: if D == 1 { Body::Bar } else { Body::PlaneStress },
        lattice,
        nodes,
        spacing: 3.7e-3,
        section: 1e-4,
        rotations: Rotations::Small,
        operator: Operator::Stencil,
        edges: Edges::default(),
        notches: vec![],
        running: vec![],
        holes: vec![],
        surface: Correction::None,
        displacement: vec![],
        velocity: vec![],
        effects: vec![],
        time: Time { duration: 1e-4, step: StepRule::OfLimit(0.9) },
        probes: vec![],
        snapshots: vec![],
    }
}

/// An effect as it stands in a study file.
pub fn effect<const D: usize, E: Effect<D> + DeserializeOwned + 'static>(asked: Value) -> Arc<dyn Effect<D>> {
    Arc::new(serde_json::from_value::<E>(asked).expect("an effect"))
}

/// Both kernels, all volume rules, calibrated or not, for each horizon.
fn lattices(horizons: &[f64]) -> Vec<Lattice> {
    let mut all = Vec::new();
    for &m in horizons {
        for kernel in [Kernel::Constant, Kernel::Gaussian { p: 2.0 }] {
            for volume_rule in VolumeRule::ALL {
                for calibrated in [false, true] {
                    all.push(Lattice { kernel, m, volume_rule, calibrated });
                }
            }
        }
    }
    all
}

/// Edges alone and mixed.
fn edges<const D: usize>() -> Vec<Edges<D>> {
    use Edge::{Free, MirrorEven, MirrorOdd, Periodic};
    let pairs = [
        [Free, Free],
        [MirrorOdd, MirrorOdd],
        [MirrorEven, MirrorEven],
        [Periodic, Periodic],
        [MirrorOdd, MirrorEven],
        [Free, MirrorOdd],
        [MirrorEven, Free],
    ];
    let others = [0, 1, 2, 3, 5, 3, 4].map(|n| pairs[n]);
    let of = |n: usize| {
        let mut edges = [pairs[n]; D];
        if let Some(other) = edges.get_mut(1) {
            *other = others[n];
        }
        Edges(edges)
    };
    (0..pairs.len()).map(of).collect()
}

/// Whether the finite law has this symmetry.
fn lawful<const D: usize>(rotations: Rotations, edges: &Edges<D>) -> bool {
    let even = edges.0.as_flattened().contains(&Edge::MirrorEven);
    D == 1 || rotations == Rotations::Small || !even
}

/// Every operator, law, lattice and kind of edge. The sizes are no multiples of the vector length, and as small as the
/// largest family allows beside a few nodes with all their bonds.
pub fn cases<const D: usize>(horizons: &[f64], nodes: [usize; D]) -> Vec<Scene<D>> {
    let mut all = Vec::new();
    for lattice in lattices(horizons) {
        for edges in edges::<D>() {
            for rotations in [Rotations::Small, Rotations::Finite] {
                for operator in [Operator::Stencil, Operator::Bonds] {
                    if !lawful(rotations, &edges) || Stencil::<D>::new(lattice).is_err() {
                        continue;
                    }
                    let name = format!("{lattice}, {rotations:?}, {operator:?}, {:?}", edges.0);
                    all.push(Scene { name, rotations, operator, edges, ..scene(lattice, nodes) });
                }
            }
        }
    }
    all
}

/// A model of a scene that must have one.
pub fn model<const D: usize>(scene: &Scene<D>) -> Model<D> {
    Model::new(scene).unwrap_or_else(|wrong| panic!("{}: {}", scene.name, wrong.message))
}

/// Where the components of all nodes lie in a field.
pub fn places<const D: usize>(grid: &Grid<D>) -> Vec<usize> {
    let of = |node| (0..D).map(move |axis| (node, axis));
    grid.each().flat_map(of).map(|(node, axis)| grid.place(node) + axis * grid.stride()).collect()
}

/// A field from the displacement of each node, ghosts filled.
pub fn field<const D: usize>(model: &Model<D>, mut at: impl FnMut([f64; D]) -> [f64; D]) -> Vec<f64> {
    let grid = &model.grid;
    let mut field = grid.field();
    for node in grid.each() {
        for (axis, value) in at(grid.position(node)).into_iter().enumerate() {
            field[grid.place(node) + axis * grid.stride()] = value;
        }
    }
    model.fill_ghosts(&mut field);
    field.to_vec()
}

/// Displacements without pattern, each component below `size`.
pub fn rough<const D: usize>(model: &Model<D>, seed: u64, size: f64) -> Vec<f64> {
    let mut numbers = Rough::new(seed);
    field(model, |_| std::array::from_fn(|_| size * numbers.next()))
}

/// A state at rest.
pub fn still(displacement: &[f64]) -> Now<'_> {
    let displacement = displacement.into();
    Now { displacement, increment: displacement, time: 0.0, time_step: 1.0, broken: Broken::none() }
}

/// The force of a model at rest; what no force reaches is not a number.
pub fn force<const D: usize>(model: &Model<D>, displacement: &[f64]) -> Vec<f64> {
    let mut field = vec![f64::NAN; displacement.len()];
    model.force(&still(displacement), &mut field);
    field
}

/// η of a bond.
pub fn apart<const D: usize>(grid: &Grid<D>, field: &[f64], near: usize, far: usize) -> [f64; D] {
    std::array::from_fn(|axis| field[far + axis * grid.stride()] - field[near + axis * grid.stride()])
}

/// |v|.
pub fn size<const D: usize>(vector: [f64; D]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// Goes over the bonds of each node: its place, the place at the other end, the bond seen from it.
pub fn each_bond<const D: usize>(
    scene: &Scene<D>,
    grid: &Grid<D>,
    mut act: impl FnMut(usize, usize, &FamilyBond<D>),
) {
    let stencil = Stencil::<D>::new(scene.lattice).expect("a usable lattice");
    let half = family(&stencil, scene.modulus(), scene.spacing);
    let connectivity = Connectivity::of(scene);
    for node in grid.each() {
        for bond in &half {
            for seen in [*bond, reversed(bond)] {
                if connectivity.present(node, seen.offset) {
                    let far = std::array::from_fn(|axis| node[axis] + seen.offset[axis] as isize);
                    act(grid.place(node), grid.place(far), &seen);
                }
            }
        }
    }
}

fn reversed<const D: usize>(bond: &FamilyBond<D>) -> FamilyBond<D> {
    FamilyBond { offset: bond.offset.map(|n| -n), direction: bond.direction.reversed(), weight: bond.weight }
}

/// What rounding is measured by.
pub struct Sums {
    /// Σ|w||u_j − u_i| for each node, at the place of each of its components, in N/m³.
    pub pull: Vec<f64>,
    /// Σ|w||ξ|, likewise.
    pub stiffness: Vec<f64>,
    /// ½VΣΣ|w||u_j − u_i|²/2 in J.
    pub energy: f64,
    /// Bonds of a whole family.
    pub family: usize,
}

impl Sums {
    pub fn of<const D: usize>(scene: &Scene<D>, grid: &Grid<D>, displacement: &[f64]) -> Self {
        let family = 2 * Stencil::<D>::new(scene.lattice).expect("a usable lattice").bonds.len();
        let mut sums =
            Self { pull: grid.field().to_vec(), stiffness: grid.field().to_vec(), energy: 0.0, family };
        each_bond(scene, grid, |near, far, bond| {
            let (weight, eta) = (bond.weight.abs(), size(apart(grid, displacement, near, far)));
            for axis in 0..D {
                sums.pull[near + axis * grid.stride()] += weight * eta;
                sums.stiffness[near + axis * grid.stride()] += weight * bond.direction.length;
            }
            sums.energy += 0.25 * scene.cell_volume() * weight * eta * eta;
        });
        sums
    }

    /// Σ over all nodes and components.
    pub fn all_pull(&self) -> f64 {
        self.pull.iter().sum()
    }

    /// The largest over the nodes.
    pub fn largest_stiffness(&self) -> f64 {
        self.stiffness.iter().copied().fold(0.0, f64::max)
    }
}
