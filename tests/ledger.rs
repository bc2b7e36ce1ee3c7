//! The energy ledger and the balance of momentum, held against the laws that leapfrog keeps exactly.
//!
//! The bound on what the ledger may be off. With d' = d + Δt²F/ρ and u' = u + d' rounded, and the force rounded as the
//! conformance suite says, a step changes H less the work by at most V Σ of
//! ½(ρ/Δt²) e₁ (|d| + |d'|), e₁ = u (|d'| + 3Δt²|F|/ρ): the increment;  u |F| (|u| + |u'|): the displacement;
//! (family + 16) u S (|u| + |u'|), S = Σ|w||u_j − u_i|: the force, at n and at n−1;
//! and the accounts are sums of `count + 8` roundings of their terms. All steps add up.

#[path = "conformance/bodies.rs"]
#[allow(dead_code)]
mod bodies;
#[path = "conformance/wrong.rs"]
#[allow(dead_code)]
mod wrong;

use bodies::{Sums, UNIT, constant, effect, force, model, places, rough, scene};
use pd_verify::constraints::Edge::{Free, MirrorEven, MirrorOdd, Periodic};
use pd_verify::constraints::{Edges, PrescribedMotion};
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{BodyForce, Damping};
use pd_verify::ledger::{Balance, Ledger};
use pd_verify::march::March;
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::record;
use pd_verify::scene::{
    Beyond, Effect, Hole, Initial, Notch, Operator, Probe, Rotations, Running, Scene, Shape, StepRule, Time,
    Watch,
};
use serde_json::{Value, json};
use std::sync::Arc;

/// A history of every shape.
fn histories() -> Vec<Value> {
    vec![
        json!({ "shape": "step", "start_s": 3e-6 }),
        json!({ "shape": "ramp", "rise_s": 2e-5 }),
        json!({ "shape": "raised_cosine", "start_s": 1e-6, "rise_s": 3e-5 }),
        json!({ "shape": "sine", "period_s": 1.1e-5 }),
        json!({ "shape": "table", "times_s": [0.0, 1e-5, 4e-5], "values": [0.0, 1.0, -0.5] }),
    ]
}

/// What H less the work was off over its bound, and the bound over the energy at its largest.
struct Closed {
    ratio: f64,
    bound: f64,
    balance: Balance,
}

fn close<const D: usize>(scene: &Scene<D>, model: &Model<D>, steps: u64) -> Closed {
    let dt = Plan::of(scene).unwrap().time_step_s;
    let [start, velocity] = [1, 2].map(|seed| rough(model, seed, 0.01 * scene.spacing));
    let mut march = March::from_fields(model, start, velocity, dt);
    let mut ledger = Ledger::new(model);
    let (places, inertia, volume) =
        (places(&model.grid), scene.material.density / (dt * dt), model.cell_volume);
    let (mut first, mut bound, mut drift, mut energy) = (None, 0.0, 0.0_f64, 0.0_f64);
    for _ in 0..steps {
        let (d, u) = (march.increment().to_vec(), march.displacement().to_vec());
        let (sums, mut f) = (Sums::of(scene, &model.grid, &u), model.grid.field());
        model.force(&march.now(), &mut f);
        march.advance_booked(&mut ledger);
        let (next, after) = (march.increment(), march.displacement());
        for &at in &places {
            let pull = sums.pull[at];
            let (d, next, u) = (d[at].abs(), next[at].abs(), u[at].abs() + after[at].abs());
            // No class of forces is larger than all bonds and all forces together.
            let each = pull + f[at].abs();
            let step = 0.5 * (inertia * next + 3.0 * each) * (d + next)
                + each * u
                + (sums.family + 16) as f64 * pull * u;
            let terms = inertia * (d + next) * (d + next) + 3.0 * each * (d + next) + pull * u;
            bound += UNIT * volume * (step + (places.len() + 8) as f64 * terms);
        }
        let balance = ledger.balance();
        energy = energy.max(balance.kinetic.abs() + balance.elastic.abs());
        drift = drift.max((balance.closed() - *first.get_or_insert(balance.closed())).abs());
        assert!(drift.is_finite());
    }
    Closed { ratio: drift / bound, bound: bound / energy, balance: ledger.balance() }
}

/// Loads on an edge and over the body, along both axes of a plate.
fn loads<const D: usize>(history: &Value) -> Vec<Arc<dyn Effect<D>>> {
    let across = if D == 1 { "x" } else { "y" };
    let layer = json!({ "edge": "right" });
    let pull = json!({ "region": layer, "axis": across, "density_n_m3": 3e11, "history": history });
    let push = json!({ "axis": "x", "density_n_m3": 4e10, "history": history });
    vec![effect::<D, BodyForce>(pull), effect::<D, BodyForce>(push)]
}

fn drive<const D: usize>(history: &Value) -> Arc<dyn Effect<D>> {
    // Two layers of nodes, by a box: at a mirrored or periodic edge no motion may be asked for by name.
    let region = json!({ "from_m": vec![0.0; D], "to_m": &[8e-3, 1.0][..D] });
    let motion = json!({ "region": region, "axis": "x", "displacement_m": 5e-5, "history": history });
    effect::<D, PrescribedMotion>(motion)
}

fn damp<const D: usize>() -> Arc<dyn Effect<D>> {
    effect::<D, Damping>(json!({ "rate_per_s": 5e4 }))
}

/// Every history, damped or not, driven or not.
fn linear<const D: usize>(body: &Scene<D>) -> f64 {
    let mut worst = 0.0_f64;
    for history in histories() {
        for (damped, driven) in [(false, false), (true, false), (false, true), (true, true)] {
            let mut effects = loads::<D>(&history);
            effects.extend(damped.then(damp::<D>));
            effects.extend(driven.then(|| drive::<D>(&history)));
            let scene = Scene { effects, ..body.clone() };
            let closed = close(&scene, &model(&scene), 150);
            // A bound that says nothing is none: the worst case must stay below a millionth of the energy.
            assert!(closed.bound < 1e-6, "{:e}", closed.bound);
            assert!(closed.ratio <= 1.0, "{} {history} {damped} {driven}", closed.ratio);
            let balance = closed.balance;
            assert!(balance.loads != 0.0 && (balance.rates < 0.0) == damped);
            assert!((balance.constraints != 0.0) == driven);
            worst = worst.max(closed.ratio);
        }
    }
    worst
}

#[test]
fn the_ledger_of_a_linear_body_closes() {
    for operator in [Operator::Stencil, Operator::Bonds] {
        for edges in [[Free, Free], [MirrorOdd, Free], [MirrorEven, MirrorOdd], [Periodic, Periodic]] {
            let bar = scene::<1>(constant(3.0, VolumeRule::Full, true), [41]);
            let ratio = linear(&Scene { operator, edges: Edges([edges]), ..bar });
            eprintln!("bar {operator:?} {edges:?}: {ratio} of the bound");
        }
    }
    for edges in [[[Free; 2]; 2], [[MirrorOdd, Free], [Periodic, Periodic]], [[Free, Free], [MirrorEven; 2]]]
    {
        let plate = scene::<2>(constant(2.0, VolumeRule::Linear, false), [11, 9]);
        let ratio = linear(&Scene { edges: Edges(edges), ..plate });
        eprintln!("plate {edges:?}: {ratio} of the bound");
    }
    let corrected = scene::<2>(constant(2.0, VolumeRule::Linear, false), [11, 9]);
    linear(&Scene { surface: Correction::Energy, ..corrected.clone() });
    let dx = corrected.spacing;
    let holes = vec![Hole { centre: [5.2 * dx, 4.6 * dx], radius: 1.7 * dx }];
    let notches = vec![Notch { from: [11.0 * dx, 6.1 * dx], to: [7.4 * dx, 6.3 * dx] }];
    linear(&Scene { holes, notches, surface: Correction::Volume, ..corrected });
}

/// A plate with a slanted notch that runs through most of it within `seconds`.
fn torn(edges: Edges<2>, seconds: f64) -> Scene<2> {
    let plate = scene::<2>(constant(2.0, VolumeRule::Linear, false), [11, 9]);
    let dx = plate.spacing;
    let notches = vec![Notch { from: [0.0, 2.9 * dx], to: [2.4 * dx, 3.5 * dx] }];
    let running = vec![Running { notch: 0, speed: 8.1 * dx / seconds, start: 0.05 * seconds, by: 8.1 * dx }];
    Scene { edges, notches, running, ..plate }
}

/// What bonds held when they were cut is booked: without this account nothing would close.
#[test]
fn the_ledger_of_a_running_notch_closes() {
    for edges in [[[Free; 2]; 2], [[Free, MirrorOdd], [Periodic, Periodic]], [[MirrorEven, Free], [Free; 2]]]
    {
        for operator in [Operator::Stencil, Operator::Bonds] {
            let plate = Scene { operator, ..torn(Edges(edges), 5e-5) };
            let ratio = linear(&plate);
            let closed = close(&plate, &model(&plate), 150);
            let size = closed.balance.cut_bonds / (closed.balance.kinetic + closed.balance.elastic);
            eprintln!(
                "torn plate {operator:?} {edges:?}: {ratio} of the bound, {size} of the energy released"
            );
            assert!(closed.ratio <= 1.0 && size > 0.01 && closed.bound < 1e-6);
        }
    }
}

/// Of a hardly strained body the exact law's ledger closes to what the strain of 1e-6 leaves of its linearity, and the
/// account of cut bonds is that of the linear law.
#[test]
fn the_ledger_of_a_running_notch_closes_with_finite_rotations() {
    let [small, finite] = [Rotations::Small, Rotations::Finite].map(|rotations| {
        let plate = Scene { rotations, ..torn(Edges::default(), 5e-5) };
        let (model, dt) = (model(&plate), Plan::of(&plate).unwrap().time_step_s);
        let start = rough(&model, 1, 1e-6 * plate.spacing);
        let mut march = March::from_fields(&model, start, model.grid.field(), dt);
        let mut ledger = Ledger::new(&model);
        march.advance_booked(&mut ledger);
        let first = ledger.balance().closed();
        let mut far = 0.0_f64;
        for _ in 0..150 {
            march.advance_booked(&mut ledger);
            far = far.max((ledger.balance().closed() / first - 1.0).abs());
        }
        (far, ledger.balance().cut_bonds / first)
    });
    eprintln!("off by {:e}, released {} and by the linear law {}", finite.0, finite.1, small.1);
    assert!(finite.0 < 1e-5 && small.1.abs() > 1e-3 && (finite.1 - small.1).abs() < 1e-5);
}

#[test]
fn a_one_sided_force_does_not_close() {
    let bar = scene::<1>(constant(3.0, VolumeRule::Full, true), [41]);
    assert!(close(&bar, &model(&bar), 150).ratio <= 1.0);
    let closed = close(&bar, &wrong::spoilt(&bar, wrong::Way::OneSided), 150);
    assert!(closed.ratio > 10.0, "{}", closed.ratio);
}

/// The exact law has no quadratic energy: the mean of E(n) and E(n+1) and the mean velocity close to Δt², so that
/// halving Δt quarters what is missing, here to a tenth of it.
#[test]
fn the_ledger_of_finite_rotations_closes_to_second_order() {
    let plate = scene::<2>(constant(2.0, VolumeRule::Linear, true), [21, 17]);
    let (ramp, centre) = (json!({ "shape": "raised_cosine", "rise_s": 4e-5 }), [0.03, 0.04]);
    let hit = |component, amplitude| Initial {
        component,
        amplitude,
        shape: Shape::Gaussian { centre, sharpness: 1.0 / (0.02 * 0.02) },
    };
    let time = |steps: f64| Time {
        duration: 4e-5,
        step: StepRule::Given { seconds: 4e-5 / steps, beyond_limit: Beyond::Refused },
    };
    let effects: [Vec<Arc<dyn Effect<2>>>; 2] =
        [loads::<2>(&ramp), [loads::<2>(&ramp), vec![damp::<2>()]].concat()];
    for effects in effects {
        let scene = Scene {
            rotations: Rotations::Finite,
            velocity: vec![hit(0, 150.0), hit(1, 90.0)],
            effects,
            ..plate.clone()
        };
        let missing = [100.0, 200.0, 400.0].map(|steps| {
            let scene = Scene { time: time(steps), ..scene.clone() };
            let (model, plan) = (model(&scene), Plan::of(&scene).unwrap());
            let (mut march, mut ledger) = (March::new(&model, &scene, plan.time_step_s), Ledger::new(&model));
            let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
            for _ in 0..plan.steps {
                march.advance_booked(&mut ledger);
                least = least.min(ledger.balance().closed());
                most = most.max(ledger.balance().closed());
            }
            (most - least) / most
        });
        let falls = [missing[0] / missing[1], missing[1] / missing[2]];
        eprintln!("missing {missing:?}, falling by {falls:?}");
        assert!(missing[0] < 1e-2 && missing[2] > 1e-10);
        assert!(falls.iter().all(|fall| (fall - 4.0).abs() < 0.4), "{falls:?}");
    }
}

/// Waves a few cells long change their energy much in a step: of a hardly strained body the exact law's ledger closes all
/// the same, to what the strain of 1e-6 leaves of its linearity.
#[test]
fn the_ledger_of_finite_rotations_holds_for_short_waves() {
    let plate = scene::<2>(constant(2.0, VolumeRule::Linear, true), [21, 17]);
    let wave = Shape::Wave { wavenumber: [0.6 / plate.spacing, 0.8 / plate.spacing], phase: 0.3 };
    let velocity = vec![Initial { component: 0, amplitude: 1e-3, shape: wave }];
    let scene = Scene { rotations: Rotations::Finite, velocity, ..plate };
    let (model, plan) = (model(&scene), Plan::of(&scene).unwrap());
    let (mut march, mut ledger) = (March::new(&model, &scene, plan.time_step_s), Ledger::new(&model));
    let closed: Vec<f64> = (0..plan.steps.min(200))
        .map(|_| {
            march.advance_booked(&mut ledger);
            ledger.balance().closed()
        })
        .collect();
    let far = closed.iter().map(|energy| (energy / closed[0] - 1.0).abs()).fold(0.0, f64::max);
    assert!(plan.steps > 20 && far < 1e-5, "{far:e}");
}

/// P(n+½) − P(n−½) = Δt ΣF(n): bonds cancel, damping takes α times the mean momentum. Bound: the roundings of forces and
/// increments and those of the sums.
#[test]
fn momentum_changes_by_the_loads_alone() {
    for rotations in [Rotations::Small, Rotations::Finite] {
        for damped in [false, true] {
            let mut effects = loads::<2>(&histories()[3]);
            effects.extend(damped.then(damp::<2>));
            let plate = scene::<2>(constant(2.0, VolumeRule::Linear, true), [13, 9]);
            let scene = Scene { rotations, effects, ..plate };
            let (model, plan) = (model(&scene), Plan::of(&scene).unwrap());
            let [start, velocity] = [1, 2].map(|seed| rough(&model, seed, 0.01 * scene.spacing));
            let mut march = March::from_fields(&model, start, velocity, plan.time_step_s);
            let (dt, grid) = (plan.time_step_s, &model.grid);
            let momentum = |d: &[f64], axis: usize| -> f64 {
                let places = grid.each().map(|node| grid.place(node) + axis * grid.stride());
                places.map(|at| scene.material.density / dt * d[at]).sum()
            };
            let mut worst = 0.0_f64;
            for step in 1..=200_u64 {
                let (before, u) = (march.increment().to_vec(), march.displacement().to_vec());
                let factor = libm::sin(std::f64::consts::TAU * march.time() / 1.1e-5);
                march.advance_to(step);
                let sums = Sums::of(&scene, grid, &u);
                for axis in 0..2 {
                    let (from, to) = (momentum(&before, axis), momentum(march.increment(), axis));
                    let load = match axis {
                        0 => 4e10 * grid.count() as f64,
                        _ => 3e11 * grid.nodes[1] as f64,
                    } * factor;
                    let lost = if damped { 5e4 * 0.5 * (from + to) } else { 0.0 };
                    let size: f64 = before.iter().chain(march.increment()).map(|d| d.abs()).sum();
                    let roundings = (sums.family + 32 + grid.count()) as f64 * UNIT;
                    let bound = roundings
                        * (sums.all_pull() * dt + (scene.material.density / dt) * size + load.abs() * dt);
                    let error = (to - from - dt * (load - lost)).abs();
                    assert!(error <= bound, "{rotations:?} {damped} {step} {axis}: {error:e} {bound:e}");
                    worst = worst.max(error / bound);
                }
            }
            eprintln!("{rotations:?} {damped}: {worst} of the bound");
        }
    }
}

/// From rest under a constant force F, P(n−½) = Δt (n − ½) F, as a probe sees it.
#[test]
fn a_probe_sees_the_momentum() {
    let push = json!({ "axis": "x", "density_n_m3": 4e10, "history": { "shape": "step" } });
    let bar = scene::<1>(constant(3.0, VolumeRule::Full, false), [31]);
    let probes = vec![Probe { name: "p".into(), watch: Watch::Momentum, every: 2 }];
    let scene = Scene { effects: vec![effect::<1, BodyForce>(push)], probes, ..bar };
    let record = record::run(&scene).unwrap();
    let (trace, volume) = (record.trace("p").unwrap(), 31.0 * scene.cell_volume());
    assert!(trace.times.len() > 10);
    for (n, (t, row)) in trace.times.iter().zip(&trace.rows).enumerate() {
        let step = (2 * (n + 1)) as f64 - 0.5;
        assert!((t / record.plan.time_step_s - step).abs() < 1e-12 * step);
        // Each step and each node rounds a few times.
        assert!((row[0] / (4e10 * volume * t) - 1.0).abs() < 200.0 * f64::EPSILON * step);
    }
    assert_eq!(force(&model(&scene), &model(&scene).grid.field())[model(&scene).grid.place([3])], 4e10);
}
