//! Bodies that are marched to be measured: steel, Gaussian kernel p = 2, calibrated, in a slow smooth wave between planes of
//! symmetry, so that no node lacks a bond.

use pd_verify::constraints::{Edge, Edges};
use pd_verify::forces::{BodyForce, Damping, Traction};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::material::{Body, Material};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::scene::{
    Axis, Effect, HistoryAsked, Hole, Initial, Notch, Positive, Scene, Shape, Side, StepRule, Time, Wrong,
};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Δx in m.
const SPACING: f64 = 1e-3;

/// Largest displacement of a wave over Δx: strains so small that bonds turned by it are as stable as others.
const AMPLITUDE: f64 = 1e-4;

/// Of the row-sum limit.
const SAFETY: f64 = 0.8;

/// A bar of so many nodes.
pub fn bar(nodes: usize, m: f64) -> Scene<1> {
    body(Body::Bar, [nodes], m)
}

/// A plate in plane stress.
pub fn plate(nodes: [usize; 2], m: f64) -> Scene<2> {
    body(Body::PlaneStress, nodes, m)
}

fn body<const D: usize>(body: Body, nodes: [usize; D], m: f64) -> Scene<D> {
    let steel = Material { youngs_modulus: 200e9, density: 7850.0 };
    let kernel = Kernel::Gaussian { p: 2.0 };
    let lattice = Lattice { kernel, m, volume_rule: VolumeRule::Linear, calibrated: true };
    // Longer than any measurement.
    let duration = 1e9 * SPACING / steel.dilatational_speed(body);
    let time = Time { duration, step: StepRule::OfLimit(SAFETY) };
    let size = nodes.map(|nodes| nodes as f64 * SPACING);
    let displacement = (0..D).flat_map(|component| wave(component, size)).collect();
    Scene {
        edges: Edges([[Edge::MirrorOdd; 2]; D]),
        displacement,
        ..Scene::bare(steel, body, lattice, nodes, SPACING, time)
    }
}

/// A wave of few periods on a displacement that keeps it from zero: small numbers would slow a processor down.
fn wave<const D: usize>(component: usize, size: [f64; D]) -> [Initial<D>; 2] {
    let wavenumber = std::array::from_fn(|axis| TAU * (2 + axis + component) as f64 / size[axis]);
    let amplitude = AMPLITUDE * SPACING;
    [
        Initial { component, amplitude, shape: Shape::Wave { wavenumber, phase: 0.3 } },
        Initial { component, amplitude: 2.0 * amplitude, shape: Shape::Uniform },
    ]
}

/// The plan below the row-sum bound on Δt, which takes no search.
pub fn plan<const D: usize>(scene: &Scene<D>) -> Result<Plan, Wrong> {
    let stencil =
        Stencil::<D>::new(scene.lattice).map_err(|wrong| Wrong::new("m", wrong.to_string(), wrong.cure()))?;
    let limit = (2.0 / stencil.row_sum()).sqrt() * scene.spacing / scene.speed();
    Plan::below(scene, limit)
}

/// A cut from the left edge to the middle.
pub fn cut_from_left(scene: Scene<2>) -> Scene<2> {
    let [width, height] = scene.size();
    let notch = Notch { from: [0.0, 0.5 * height], to: [0.5 * width, 0.5 * height] };
    Scene { notches: vec![notch], ..scene }
}

/// A cut from the lower edge to the middle.
pub fn cut_from_below(scene: Scene<2>) -> Scene<2> {
    let [width, height] = scene.size();
    let notch = Notch { from: [0.5 * width, 0.0], to: [0.5 * width, 0.5 * height] };
    Scene { notches: vec![notch], ..scene }
}

/// A hole in the middle, a quarter as wide as the plate.
pub fn hole(scene: Scene<2>) -> Scene<2> {
    let size = scene.size();
    let hole = Hole { centre: size.map(|size| 0.5 * size), radius: size[0] / 8.0 };
    Scene { holes: vec![hole], ..scene }
}

/// A long plate of a million nodes, cut along x so often that every node lacks bonds, those of a row the same ones.
pub fn strips(m: f64) -> Scene<2> {
    let rows = 2 * m as usize;
    let scene = plate([16_384, 11 * rows], m);
    let [width, _] = scene.size();
    let at = |strip: usize| (strip * rows) as f64 * SPACING;
    let cut = |strip| Notch { from: [0.0, at(strip)], to: [width, at(strip)] };
    Scene { edges: Edges::default(), notches: (1..11).map(cut).collect(), ..scene }
}

/// A plate cut aslant so often that every node lacks bonds, neighbours different ones.
pub fn slanted(side: usize, m: f64) -> Scene<2> {
    let scene = plate([side; 2], m);
    let [width, height] = scene.size();
    let (slope, apart) = (0.25, 2.0 * m * SPACING);
    // Lines y = y₀ + x/4, from where they enter the plate to where they leave it.
    let line = |n: usize| {
        let start = n as f64 * apart - slope * width;
        let at = |x: f64| [x, start + slope * x];
        let from = at((-start / slope).max(0.0));
        let to = at(((height - start) / slope).min(width));
        (to[0] - from[0] > SPACING).then_some(Notch { from, to })
    };
    let lines = ((height + slope * width) / apart) as usize;
    Scene { edges: Edges::default(), notches: (0..=lines).filter_map(line).collect(), ..scene }
}

/// Damping that takes nothing to speak of while it is measured.
pub fn damping<const D: usize>() -> Arc<dyn Effect<D>> {
    Arc::new(Damping { rate_per_s: Positive(1.0) })
}

/// A steady pull at the upper edge.
pub fn traction() -> Arc<dyn Effect<2>> {
    Arc::new(Traction { edge: Side::Top, axis: Axis::Y, stress_pa: 1e3, history: HistoryAsked::step() })
}

/// A steady pull at every node.
pub fn body_force<const D: usize>() -> Arc<dyn Effect<D>> {
    Arc::new(BodyForce { axis: Axis::X, density_n_m3: 1.0, region: None, history: HistoryAsked::step() })
}
