//! Leapfrog keeps H = ½ρV Σ v(n+½)² + ½ u(n)ᵀK u(n+1), exactly, for any linear body: a million steps of a bar.
//!
//! Only rounding moves it. Let d = u(n) − u(n−1), F = −Ku(n) + δ the computed force, and
//! d' = d + Δt²F/ρ + e₁, |e₁| ≤ u (|d'| + 3Δt²|F|/ρ): one product, one sum, and Δt²/ρ itself;
//! u' = u(n) + d' + e₂, |e₂| ≤ u |u'|;
//! |δ_i| ≤ γ Σ_j w |u_j − u_i|, γ = (family + 16) u, as in the conformance suite.
//! With H of the computed fields, H = V Σ [½(ρ/Δt²) d'² − ½ F·u'], and K symmetric,
//! H(n) − H(n−1) = V Σ [½(ρ/Δt²) e₁·(d' + d) − ½ F·(e₂ + e₂') + ½ (δ(n−1)·u(n) − δ(n)·u(n−1))],
//! e₂' being the slip of the step before: the terms in F·(u(n+1) − u(n−1)) cancel, and nothing else is left.
//!
//! Worst case: with every slip at its largest and of the same sign, N steps move H by at most N times the sum of the
//! sizes of these terms over the nodes. Rounding errors that are independent with mean zero add like a random walk: their
//! sum exceeds λ times the root of the sum of the squares of their bounds with a probability below 2 exp(−λ²/2) (Hoeffding;
//! Higham & Mary 2019, SIAM J. Sci. Comput. 41, A2815). λ = 5: 7e-6. Both bounds are taken from the fields at sampled
//! steps: the largest sample stands for the worst case, the mean square for the walk. H itself is a sum of 2N terms
//! of a bar of N nodes: that it is rounded too adds (2N + 4) u of the sizes of its terms, twice.

#[path = "conformance/bodies.rs"]
#[allow(dead_code)]
mod bodies;
#[path = "conformance/wrong.rs"]
#[allow(dead_code)]
mod wrong;

use bodies::{Sums, UNIT, constant, force, model, places, rough, scene};
use pd_verify::constraints::Edge::{Free, MirrorEven, MirrorOdd, Periodic};
use pd_verify::constraints::Edges;
use pd_verify::march::March;
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::scene::{Operator, Scene};

/// Independent slips exceed this many standard bounds once in a hundred thousand runs.
const LAMBDA: f64 = 5.0;

/// H of one step, the size of what it is a sum of, and what one step may move it by.
struct Sample {
    h: f64,
    terms: f64,
    /// All slips at their largest.
    worst: f64,
    /// The squares of their sizes.
    square: f64,
}

/// Takes the next step of a march and looks at it.
fn sample(scene: &Scene<1>, model: &Model<1>, march: &mut March<'_, 1>) -> Sample {
    let (u, d) = (march.displacement().to_vec(), march.increment().to_vec());
    let (f, sums) = (force(model, &u), Sums::of(scene, &model.grid, &u));
    march.advance_to(march.step() + 1);
    let (after, next) = (march.displacement(), march.increment());
    let (dt, volume) = (march.time_step(), model.cell_volume);
    let inertia = scene.material.density / (dt * dt);
    let mut sample = Sample { h: 0.0, terms: 0.0, worst: 0.0, square: 0.0 };
    for at in places(&model.grid) {
        let (kinetic, elastic) = (0.5 * inertia * next[at] * next[at], -0.5 * f[at] * after[at]);
        sample.h += volume * (kinetic + elastic);
        sample.terms += volume * (kinetic.abs() + elastic.abs());
        let before = u[at] - d[at];
        let slips = [
            0.5 * (inertia * next[at].abs() + 3.0 * f[at].abs()) * (next[at] + d[at]).abs(),
            0.5 * f[at].abs() * after[at].abs(),
            0.5 * f[at].abs() * u[at].abs(),
            0.5 * (sums.family + 16) as f64 * sums.pull[at] * before.abs(),
            // The force of step n against the displacement of n + 1: this node's part in the next difference.
            0.5 * (sums.family + 16) as f64 * sums.pull[at] * after[at].abs(),
        ];
        for slip in slips.map(|slip| UNIT * volume * slip) {
            sample.worst += slip;
            sample.square += slip * slip;
        }
    }
    sample
}

/// What was measured of H over a run, all over its first value.
#[derive(Debug)]
struct Drift {
    measured: f64,
    walk: f64,
    worst: f64,
}

/// Steps in blocks, one sample at the end of each.
fn drift(scene: &Scene<1>, model: &Model<1>, [blocks, block]: [u64; 2]) -> Drift {
    let dt = Plan::of(scene).unwrap().time_step_s;
    let [start, mut velocity] = [1, 2].map(|seed| rough(model, seed, 0.01 * scene.spacing));
    // A body that flies away loses digits of its displacements: it is to swing about its place.
    let places = places(&model.grid);
    let mean = places.iter().map(|&at| velocity[at]).sum::<f64>() / places.len() as f64;
    places.iter().for_each(|&at| velocity[at] -= mean);
    let mut march = March::from_fields(model, start, velocity, dt);
    let first = sample(scene, model, &mut march);
    let (mut measured, mut worst, mut square) = (0.0_f64, first.worst, first.square);
    for number in 1..=blocks {
        march.advance_to(number * block - 1);
        let now = sample(scene, model, &mut march);
        assert!(now.h.is_finite());
        measured = measured.max((now.h - first.h).abs());
        worst = worst.max(now.worst);
        square += now.square;
    }
    let steps = (blocks * block) as f64;
    let own = 2.0 * (2 * places.len() + 4) as f64 * UNIT * first.terms;
    let walk = LAMBDA * (steps * square / (blocks + 1) as f64).sqrt() + own;
    Drift { measured: measured / first.h, walk: walk / first.h, worst: (steps * worst + own) / first.h }
}

/// A bar of 80 nodes, m = 3, at 0.9 of its limit.
fn bar(edges: [pd_verify::constraints::Edge; 2]) -> Scene<1> {
    Scene { edges: Edges([edges]), ..scene::<1>(constant(3.0, VolumeRule::Full, true), [80]) }
}

/// A million steps.
fn stays(edges: [pd_verify::constraints::Edge; 2]) {
    let scene = bar(edges);
    let drift = drift(&scene, &model(&scene), [1000, 1000]);
    eprintln!("H after a million steps, edges {edges:?}: {drift:?}");
    assert!(drift.measured <= drift.worst, "{drift:?}");
    assert!(drift.measured <= drift.walk, "{drift:?}");
    // The walk must say something: H is known to ten digits after a million steps.
    assert!(drift.walk < 1e-10, "{drift:?}");
}

#[test]
fn a_free_bar_keeps_it() {
    stays([Free, Free]);
}

#[test]
fn a_mirrored_bar_keeps_it() {
    stays([MirrorOdd, MirrorEven]);
}

#[test]
fn a_ring_keeps_it() {
    stays([Periodic, Periodic]);
}

#[test]
fn bonds_stored_one_by_one_keep_it() {
    let scene = Scene { operator: Operator::Bonds, ..bar([MirrorOdd, Free]) };
    let drift = drift(&scene, &model(&scene), [100, 1000]);
    assert!(drift.measured <= drift.walk, "{drift:?}");
}

/// One node that feels a millionth more than it gives: K is no longer symmetric, and both bounds are broken soon.
#[test]
fn a_one_sided_force_does_not_keep_it() {
    let scene = bar([Free, Free]);
    let sound = drift(&scene, &model(&scene), [100, 100]);
    assert!(sound.measured <= sound.walk, "{sound:?}");
    let spoilt = drift(&scene, &wrong::spoilt(&scene, wrong::Way::OneSided), [100, 100]);
    eprintln!("a one-sided force, ten thousand steps: {spoilt:?}");
    assert!(spoilt.measured > 10.0 * spoilt.worst, "{spoilt:?}");
}
