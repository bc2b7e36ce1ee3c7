//! What must not change a motion, to the last bit: the number of threads, an effect of size zero, a look at the body.

use crate::bodies::{constant, effect, model, rough, scene};
use crate::checks::{Checked, same_bits};
use crate::wrong::{Way, spoilt};
use pd_verify::constraints::Edge::{Free, MirrorOdd, Periodic};
use pd_verify::constraints::Edges;
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{BodyForce, Damper, Damping};
use pd_verify::ledger::Ledger;
use pd_verify::march::March;
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::record;
use pd_verify::scene::{Effect, Operator, Probe, Rotations, Scene, Watch};
use serde_json::json;
use std::sync::Arc;

/// Displacements after some steps from a rough start, 0.9 of the limit.
fn moved<const D: usize>(scene: &Scene<D>, model: &Model<D>, steps: u64) -> Vec<f64> {
    let mut march = started(scene, model);
    march.advance_to(steps);
    march.displacement().to_vec()
}

fn started<'m, const D: usize>(scene: &Scene<D>, model: &'m Model<D>) -> March<'m, D> {
    let start = [5, 6].map(|seed| rough(model, seed, 0.02 * scene.spacing));
    let time_step = Plan::of(scene).expect("a sound scene").time_step_s;
    let [displacement, velocity_step] = start;
    March::from_fields(model, displacement, velocity_step, time_step)
}

/// One thread and several give the same motion.
fn threads<const D: usize>(scene: &Scene<D>, model: &Model<D>, steps: u64) -> Checked {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| moved(scene, model, steps))
    };
    let alone = with(1);
    for threads in [2, 3, 5] {
        same_bits(&format!("motions with 1 and {threads} threads"), &alone, &with(threads))?;
    }
    Ok(0.0)
}

/// Two models of a scene move alike.
fn alike<const D: usize>(what: &str, scene: &Scene<D>, one: &Model<D>, other: &Model<D>) -> Checked {
    same_bits(what, &moved(scene, one, 30), &moved(scene, other, 30))
}

fn long_bar() -> Scene<1> {
    let damped = effect::<1, Damping>(json!({ "rate_per_s": 1e4 }));
    Scene { effects: vec![damped], ..scene(constant(3.015, VolumeRule::Linear, true), [20_011]) }
}

fn wide_plate(rotations: Rotations, operator: Operator) -> Scene<2> {
    let edges = Edges([[MirrorOdd, Free], [Periodic, Periodic]]);
    let push = json!({ "axis": "y", "density_n_m3": 1e9, "history": { "shape": "ramp", "rise_s": 1e-6 } });
    let effects = vec![effect::<2, BodyForce>(push)];
    let scene = scene(constant(2.0, VolumeRule::ExactArea, true), [151, 131]);
    Scene { rotations, operator, edges, effects, ..scene }
}

#[test]
fn threads_change_nothing() {
    let bar = long_bar();
    assert!(model(&bar).grid.pieces() > 2);
    threads(&bar, &model(&bar), 12).unwrap();
    for rotations in [Rotations::Small, Rotations::Finite] {
        for operator in [Operator::Stencil, Operator::Bonds] {
            let plate = wide_plate(rotations, operator);
            assert!(model(&plate).grid.pieces() > 2);
            threads(&plate, &model(&plate), 4).unwrap();
            if operator == Operator::Bonds {
                continue;
            }
            // Beside the stencil there is a band.
            let dx = plate.spacing;
            let holes = vec![pd_verify::scene::Hole { centre: [75.0 * dx, 2.0 * dx], radius: 20.3 * dx }];
            let notches =
                vec![pd_verify::scene::Notch { from: [0.0, 70.0 * dx], to: [60.0 * dx, 75.0 * dx] }];
            let pierced = Scene { holes, notches, surface: Correction::Energy, ..plate };
            threads(&pierced, &model(&pierced), 4).unwrap();
        }
    }
}

#[test]
fn a_force_that_knows_its_threads_is_noticed() {
    let plate = wide_plate(Rotations::Small, Operator::Stencil);
    assert!(threads(&plate, &spoilt(&plate, Way::Threads), 2).unwrap_err().contains("1 and 2 threads"));
}

/// Loads of size zero, and one that never comes.
fn nothing<const D: usize>() -> Vec<Arc<dyn Effect<D>>> {
    let (step, late) = (json!({ "shape": "step" }), json!({ "shape": "step", "start_s": 1e9 }));
    vec![
        effect::<D, BodyForce>(
            json!({ "region": { "edge": "right" }, "axis": "x", "density_n_m3": 0.0, "history": step }),
        ),
        effect::<D, BodyForce>(json!({ "axis": "x", "density_n_m3": 0.0, "history": step })),
        effect::<D, BodyForce>(json!({ "axis": "x", "density_n_m3": 1e9, "history": late })),
    ]
}

/// A body with and without what has no effect; damping at rate 0 can only be had below the words of a scene.
fn neutral<const D: usize>(plain: &Scene<D>) {
    let sound = model(plain);
    for index in 0..3 {
        let with = Scene { effects: vec![nothing::<D>().remove(index)], ..plain.clone() };
        alike("motions with and without a zero load", plain, &sound, &model(&with)).unwrap();
    }
    let mut damped = model(plain);
    damped.add(Box::new(Damper::new(&damped.grid, plain.material.density, 0.0)));
    alike("motions with and without damping at rate 0", plain, &sound, &damped).unwrap();
    let mut damped = model(plain);
    damped.add(Box::new(Damper::new(&damped.grid, plain.material.density, 1e-3)));
    alike("damping at rate 1e-3", plain, &sound, &damped).unwrap_err();
    alike("a constant", plain, &sound, &spoilt(plain, Way::Constant)).unwrap_err();
    looks(plain, &sound);
}

/// A march that is booked, and one that is looked at now and then, move like one left alone.
fn looks<const D: usize>(plain: &Scene<D>, model: &Model<D>) {
    let mut booked = started(plain, model);
    let mut ledger = Ledger::new(model);
    (0..30).for_each(|_| booked.advance_booked(&mut ledger));
    same_bits("motions with and without a ledger", booked.displacement(), &moved(plain, model, 30)).unwrap();
    let probe = |name: &str, watch, every| Probe { name: name.into(), watch, every };
    let line = Watch::Line { along: 0, through: 2.5 * plain.spacing };
    let at = [1.3 * plain.spacing; D];
    let alone = Scene { probes: vec![probe("line", line.clone(), 1)], ..moving(plain) };
    let others = [
        vec![probe("energies", Watch::Energies, 3)],
        vec![probe("momentum", Watch::Momentum, 5), probe("point", Watch::Point { at }, 7)],
    ];
    let seen = record::run(&alone).unwrap();
    for mut probes in others {
        probes.push(probe("line", line.clone(), 4));
        let record = record::run(&Scene { probes, ..alone.clone() }).unwrap();
        let (all, some) = (seen.trace("line").unwrap(), record.trace("line").unwrap());
        assert!(some.rows.len() > 5);
        for (n, row) in some.rows.iter().enumerate() {
            // The last step is looked at in any case.
            let step = (4 * n).min(all.rows.len() - 1);
            assert_eq!(some.times[n], all.times[step]);
            same_bits("what a line probe saw", row, &all.rows[step]).unwrap();
        }
    }
}

/// With an initial velocity, for some thirty steps.
fn moving<const D: usize>(plain: &Scene<D>) -> Scene<D> {
    let sharp = pd_verify::scene::Shape::Gaussian { centre: [0.02; D], sharpness: 1e4 };
    let velocity = vec![pd_verify::scene::Initial { component: D - 1, amplitude: 3.0, shape: sharp }];
    Scene { velocity, ..plain.clone() }
}

#[test]
fn what_has_no_effect_changes_nothing() {
    let time = pd_verify::scene::Time { duration: 5e-5, step: pd_verify::scene::StepRule::OfLimit(0.9) };
    for operator in [Operator::Stencil, Operator::Bonds] {
        for rotations in [Rotations::Small, Rotations::Finite] {
            let bar = scene::<1>(constant(3.0, VolumeRule::Full, true), [43]);
            neutral(&Scene { operator, rotations, edges: Edges([[MirrorOdd, Free]]), time, ..bar });
            let plate = scene::<2>(constant(3.0, VolumeRule::Linear, false), [17, 13]);
            let edges = Edges([[Free, MirrorOdd], [Periodic, Periodic]]);
            neutral(&Scene { operator, rotations, edges, time, ..plate });
        }
    }
}
