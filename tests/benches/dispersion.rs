//! How long waves take: frequencies of a bar against a cosine for each bond, plates, continua, and making weights.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::dispersion::plane::PlaneDispersion;
use pd_verify::dispersion::{Branch, continuum};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::partial_volume::VolumeRule;
use std::f64::consts::PI;
use std::hint::black_box;

const KERNEL: Kernel = Kernel::Gaussian { p: 2.0 };

fn lattice(m: f64) -> Lattice {
    Lattice { kernel: KERNEL, m, volume_rule: VolumeRule::Linear, calibrated: true }
}

/// `count` wavenumbers over the Brillouin zone.
fn zone(count: u32) -> Vec<f64> {
    (0..count).map(|n| PI * (f64::from(n) + 0.5) / f64::from(count)).collect()
}

/// ω²Δx²/v² as the sum is printed: a cosine for each bond.
fn by_cosines(stencil: &Stencil<1>, theta: f64) -> f64 {
    let square: f64 = stencil
        .bonds
        .iter()
        .map(|bond| 2.0 * bond.weight * (1.0 - (f64::from(bond.offset[0]) * theta).cos()))
        .sum();
    square.max(0.0).sqrt()
}

fn bar(criterion: &mut Criterion) {
    let stencil = Stencil::new(lattice(10.0)).expect("a usable lattice");
    let relation = BarDispersion::new(&stencil);
    let thetas = zone(1_000_000);
    let mut group = criterion.benchmark_group("bar, m = 10, a million wavenumbers");
    group.throughput(Throughput::Elements(thetas.len() as u64)).sample_size(10);
    group.bench_function("recurrence, side by side", |bencher| {
        bencher.iter(|| relation.frequencies(black_box(&thetas)));
    });
    group.bench_function("recurrence, one by one", |bencher| {
        bencher.iter(|| {
            black_box(&thetas).iter().map(|&theta| relation.square(theta).sqrt()).collect::<Vec<_>>()
        });
    });
    group.bench_function("a cosine for each bond", |bencher| {
        bencher
            .iter(|| black_box(&thetas).iter().map(|&theta| by_cosines(&stencil, theta)).collect::<Vec<_>>());
    });
    group.finish();
}

fn plate(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("plate, a wave of each branch");
    for m in [3.0, 10.0] {
        let relation = PlaneDispersion::new(&Stencil::new(lattice(m)).expect("a usable lattice"));
        group.bench_function(format!("m = {m}"), |bencher| {
            bencher.iter(|| {
                [Branch::P, Branch::S].map(|branch| relation.wave(black_box(1.1), 26.0, branch).omega)
            });
        });
    }
    group.finish();
}

fn nonlocal_continuum(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("continuum, a wave");
    for z in [1.0, 100.0] {
        group.bench_function(format!("bar, kδ = {z}"), |bencher| {
            bencher.iter(|| continuum::bar(KERNEL, black_box(z)).0.omega);
        });
        group.bench_function(format!("plate, kδ = {z}"), |bencher| {
            bencher.iter(|| continuum::plane(KERNEL, Branch::P, black_box(z)).0.omega);
        });
    }
    group.finish();
}

fn weights(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("weights, calibrated");
    for m in [3.0, 10.0] {
        group.bench_function(format!("plate, m = {m}"), |bencher| {
            bencher.iter(|| Stencil::<2>::new(black_box(lattice(m))).expect("a usable lattice"));
        });
    }
    group.finish();
}

criterion_group!(benches, bar, plate, nonlocal_continuum, weights);
criterion_main!(benches);
