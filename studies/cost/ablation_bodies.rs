//! The plate of an ablation with each effect, and pairs of plates of which the first calls for something that does nothing.

use pd_verify::constraints::{Edge, Edges, HeldFrame, PrescribedMotion};
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{BodyForce, Damping, Traction};
use pd_verify::lattice::Lattice;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::{
    Axis, Effect, HistoryAsked, Hole, Initial, Notch, Positive, Probe, Region, Rotations, Scene, Shape, Side,
    Snapshots, Watch,
};
use std::sync::Arc;

/// A plate with one effect.
#[derive(Debug, Clone)]
pub struct Variant {
    pub name: &'static str,
    pub scene: Scene<2>,
}

/// Two plates that must move alike, bit for bit.
#[derive(Debug, Clone)]
pub struct Twin {
    pub name: &'static str,
    pub with: Scene<2>,
    pub without: Scene<2>,
    /// Whether a plan names it as avoidable; what only watches is what was asked for.
    pub avoidable: bool,
}

/// The probe that sees all nodes at the end.
pub const WHOLE: &str = "whole";

/// The part of a spacing by which nodes are out of place at first.
const AMPLITUDE: f64 = 1e-2;

/// Stress of loads over the modulus.
const STRAIN: f64 = 1e-4;

/// How often bodies are watched where this is what is on.
const TIMES: u64 = 20;

/// The plain plate: free edges, waves in both components, seen whole at its beginning and its end.
pub fn plain(bare: Scene<2>) -> Scene<2> {
    let size = bare.size();
    let wave = |component: usize| Initial {
        component,
        amplitude: AMPLITUDE * bare.spacing,
        shape: Shape::Wave { wavenumber: [5.0 / size[0], 4.0 / size[1]], phase: 0.4 + component as f64 },
    };
    let watch = Watch::Patch { from: [0.0; 2], to: size };
    let probes = vec![Probe { name: WHOLE.into(), watch, every: u64::MAX }];
    Scene { displacement: vec![wave(0), wave(1)], probes, ..bare }
}

/// The plate with each effect on, itself first.
pub fn variants(plain: &Scene<2>) -> Vec<Variant> {
    let one = |name, scene| Variant { name, scene };
    let acted = |effect: Arc<dyn Effect<2>>| Scene { effects: vec![effect], ..plain.clone() };
    let of_lattice = |lattice| Scene { lattice, ..plain.clone() };
    let own = plain.lattice;
    vec![
        one("plain: free edges", plain.clone()),
        one("periodic edges", periodic(plain)),
        one("notch", Scene { notches: vec![notch(plain)], ..plain.clone() }),
        one("hole", Scene { holes: vec![hole(plain, 0.15)], ..plain.clone() }),
        one("finite rotations", Scene { rotations: Rotations::Finite, ..plain.clone() }),
        one("damping", acted(damping(plain.speed() / plain.size()[0]))),
        one("body force", acted(body_force(STRAIN * plain.modulus() / plain.size()[0]))),
        one("traction", acted(traction(STRAIN * plain.modulus(), HistoryAsked::step()))),
        one("prescribed edge", acted(held_edge())),
        one("energy correction", Scene { surface: Correction::Energy, ..plain.clone() }),
        one("volume correction", Scene { surface: Correction::Volume, ..plain.clone() }),
        one("exact areas", of_lattice(Lattice { volume_rule: VolumeRule::ExactArea, ..own })),
        one("calibration", of_lattice(Lattice { calibrated: true, ..own })),
        one("a probe at every step", probed(plain)),
        one("snapshots", snapped(plain)),
        one("energy ledger", booked(plain)),
    ]
}

/// Everything that does nothing.
pub fn twins(plain: &Scene<2>) -> Vec<Twin> {
    let idle =
        |name, with, without: &Scene<2>| Twin { name, with, without: without.clone(), avoidable: true };
    let watched = |name, with| Twin { name, with, without: plain.clone(), avoidable: false };
    let acted = |effect: Arc<dyn Effect<2>>| Scene { effects: vec![effect], ..plain.clone() };
    let still = Initial { component: 0, amplitude: 0.0, shape: Shape::Uniform };
    let pierced = Scene { holes: vec![hole(plain, 0.15)], ..plain.clone() };
    let twice = Scene { holes: vec![hole(plain, 0.15), hole(plain, 0.1)], ..plain.clone() };
    let around = periodic(plain);
    let along = Notch { from: [0.0; 2], to: [plain.size()[0], 0.0] };
    let late = HistoryAsked { start_s: Some(1e3 * plain.time.duration), ..HistoryAsked::step() };
    vec![
        idle("a notch along a free edge", Scene { notches: vec![along], ..plain.clone() }, plain),
        idle("a hole within a hole", twice, &pierced),
        idle("damping of rate 0", acted(damping(0.0)), plain),
        idle("a body force of 0", acted(body_force(0.0)), plain),
        idle("a traction of 0", acted(traction(0.0, HistoryAsked::step())), plain),
        idle("a traction after the end", acted(traction(STRAIN * plain.modulus(), late)), plain),
        idle("a held frame of no layer", acted(Arc::new(HeldFrame { layers: 0, fields: Vec::new() })), plain),
        idle("a velocity of 0", Scene { velocity: vec![still], ..plain.clone() }, plain),
        idle(
            "a correction without surfaces",
            Scene { surface: Correction::Energy, ..around.clone() },
            &around,
        ),
        watched("a probe at every step", probed(plain)),
        watched("snapshots", snapped(plain)),
        watched("energy ledger", booked(plain)),
    ]
}

fn periodic(plain: &Scene<2>) -> Scene<2> {
    Scene { edges: Edges([[Edge::Periodic; 2]; 2]), ..plain.clone() }
}

/// From the left edge half across, between rows or along one.
fn notch(plain: &Scene<2>) -> Notch {
    let [width, height] = plain.size();
    Notch { from: [0.0, 0.5 * height], to: [0.5 * width, 0.5 * height] }
}

/// In the middle, of a radius that is a part of the width.
fn hole(plain: &Scene<2>, part: f64) -> Hole {
    let [width, height] = plain.size();
    Hole { centre: [0.5 * width, 0.5 * height], radius: part * width.min(height) }
}

fn damping(rate: f64) -> Arc<dyn Effect<2>> {
    Arc::new(Damping { rate_per_s: Positive(rate) })
}

fn body_force(density: f64) -> Arc<dyn Effect<2>> {
    let history = HistoryAsked::step();
    Arc::new(BodyForce { axis: Axis::Y, density_n_m3: density, region: None, history })
}

fn traction(stress: f64, history: HistoryAsked) -> Arc<dyn Effect<2>> {
    Arc::new(Traction { edge: Side::Right, axis: Axis::X, stress_pa: stress, history })
}

fn held_edge() -> Arc<dyn Effect<2>> {
    let region = Region { edge: Some(Side::Left), ..Region::default() };
    let history = HistoryAsked::step();
    Arc::new(PrescribedMotion { region, axis: Axis::X, displacement_m: 0.0, history })
}

fn probed(plain: &Scene<2>) -> Scene<2> {
    let at = plain.size().map(|length| 0.5 * length);
    with_probe(plain, Probe { name: "middle".into(), watch: Watch::Point { at }, every: 1 })
}

fn booked(plain: &Scene<2>) -> Scene<2> {
    with_probe(plain, Probe { name: "energies".into(), watch: Watch::Energies, every: 1 })
}

fn with_probe(plain: &Scene<2>, probe: Probe<2>) -> Scene<2> {
    let mut scene = plain.clone();
    scene.probes.push(probe);
    scene
}

fn snapped(plain: &Scene<2>) -> Scene<2> {
    let times = (1..=TIMES).map(|n| plain.time.duration * n as f64 / TIMES as f64).collect();
    Scene { snapshots: vec![Snapshots { name: "all".into(), times }], ..plain.clone() }
}
