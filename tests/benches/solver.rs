//! How long a step takes: plain and masked plates, lists, finite rotations and bars, by horizon.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use pd_verify::constraints::{Edge, Edges};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Lattice;
use pd_verify::march::March;
use pd_verify::material::{Body, Material};
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::scene::{Initial, Notch, Operator, Rotations, Scene, Shape, StepRule, Time};

const SPACING: f64 = 1e-3;

/// Steps of one measurement.
const STEPS: u64 = 8;

const STEEL: Material = Material { youngs_modulus: 200e9, density: 7850.0 };

/// A body between planes of symmetry in a slow smooth wave, on a displacement that keeps it from zero.
fn scene<const D: usize>(nodes: [usize; D], m: f64) -> Scene<D> {
    let lattice =
        Lattice { kernel: Kernel::Gaussian { p: 2.0 }, m, volume_rule: VolumeRule::Linear, calibrated: true };
    let body = if D == 1 { Body::Bar } else { Body::PlaneStress };
    let wavenumber = nodes.map(|nodes| std::f64::consts::TAU / (nodes as f64 * SPACING));
    let amplitude = 1e-4 * SPACING;
    let displacement = (0..D).flat_map(|component| {
        [
            Initial { component, amplitude, shape: Shape::Wave { wavenumber, phase: 0.3 } },
            Initial { component, amplitude: 2.0 * amplitude, shape: Shape::Uniform },
        ]
    });
    let time = Time { duration: 1e3, step: StepRule::OfLimit(0.5) };
    Scene {
        edges: Edges([[Edge::MirrorOdd; 2]; D]),
        displacement: displacement.collect(),
        ..Scene::bare(STEEL, body, lattice, nodes, SPACING, time)
    }
}

/// A plate cut along x so often that every node lacks bonds.
fn masked(m: f64) -> Scene<2> {
    let rows = 2 * m as usize;
    let plate = scene([4096, 16 * rows], m);
    let [width, _] = plate.size();
    let at = |strip: usize| (strip * rows) as f64 * SPACING;
    let cut = |strip| Notch { from: [0.0, at(strip)], to: [width, at(strip)] };
    Scene { edges: Edges::default(), notches: (1..16).map(cut).collect(), ..plate }
}

fn steps<const D: usize>(group: &mut BenchmarkGroup<'_, WallTime>, name: &str, scene: &Scene<D>) {
    let plan = Plan::of(scene).expect("a scene that can be run");
    let model = Model::new(scene).expect("a scene that can be run");
    let mut march = March::new(&model, scene, plan.time_step_s);
    group.throughput(Throughput::Elements(STEPS * plan.nodes)).sample_size(10);
    group.bench_function(name, |bencher| bencher.iter(|| march.advance_to(march.step() + STEPS)));
}

fn plates(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("plate of 512² nodes");
    for m in [2.0, 3.0, 5.0, 10.0] {
        let plain = scene([512; 2], m);
        steps(&mut group, &format!("plain, m = {m}"), &plain);
        steps(
            &mut group,
            &format!("finite rotations, m = {m}"),
            &Scene { rotations: Rotations::Finite, ..plain },
        );
    }
    for m in [2.0, 3.0, 5.0] {
        let listed = Scene { operator: Operator::Bonds, ..scene([512; 2], m) };
        steps(&mut group, &format!("bonds as a list, m = {m}"), &listed);
    }
    group.finish();
}

fn cut(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("every node masked");
    for m in [2.0, 3.0, 5.0] {
        steps(&mut group, &format!("m = {m}"), &masked(m));
    }
    group.finish();
}

fn bars(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("bar of a million nodes");
    for m in [2.0, 3.0, 5.0, 10.0] {
        steps(&mut group, &format!("plain, m = {m}"), &scene([1_000_000], m));
    }
    let plain = || scene([1_000_000], 3.0);
    steps(&mut group, "finite rotations, m = 3", &Scene { rotations: Rotations::Finite, ..plain() });
    steps(&mut group, "bonds as a list, m = 3", &Scene { operator: Operator::Bonds, ..plain() });
    group.finish();
}

criterion_group!(benches, plates, cut, bars);
criterion_main!(benches);
