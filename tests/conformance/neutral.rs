//! What a plan calls avoidable changes no bit of a march, and what does something is not called so.

use crate::bodies::{constant, effect, rough, scene};
use crate::checks::same_bits;
use crate::holed::hole;
use pd_verify::constraints::{Edge, Edges, HeldFrame};
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{BodyForce, Damping, FaceTraction, ForceField, Traction};
use pd_verify::ledger::Ledger;
use pd_verify::march::March;
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::record;
use pd_verify::scene::{
    Beyond, Effect, History, Initial, Notch, Positive, Probe, Rotations, Running, Scene, Shape, StepRule,
    Time, Watch,
};
use serde_json::{Value, json};
use std::sync::Arc;

/// Steps of every march.
const STEPS: u64 = 40;
const STEP_S: f64 = 2e-7;

/// Fields of no amplitude.
fn nothing<const D: usize>() -> Initial<D> {
    Initial { component: 0, amplitude: 0.0, shape: Shape::Uniform }
}

/// A body that is in motion everywhere, watched at all nodes.
fn moving<const D: usize>(nodes: [usize; D]) -> Scene<D> {
    let still = scene::<D>(constant(3.015, VolumeRule::Linear, false), nodes);
    let to = still.size();
    let wave = |component: usize, amplitude: f64| Initial {
        component,
        amplitude,
        shape: Shape::Wave { wavenumber: [190.0; D], phase: 0.3 + component as f64 },
    };
    Scene {
        displacement: vec![wave(0, 1e-6), wave(D - 1, 3e-7)],
        velocity: vec![wave(D - 1, 0.1)],
        time: Time {
            duration: STEPS as f64 * STEP_S,
            step: StepRule::Given { seconds: STEP_S, beyond_limit: Beyond::Refused },
        },
        probes: vec![Probe { name: "all".into(), watch: Watch::Patch { from: [0.0; D], to }, every: 7 }],
        ..still
    }
}

fn plate() -> Scene<2> {
    moving([70, 66])
}

fn seen<const D: usize>(scene: &Scene<D>) -> Vec<f64> {
    record::run(scene).unwrap().traces[0].known().collect()
}

fn keys<const D: usize>(scene: &Scene<D>) -> Vec<String> {
    Plan::of(scene).unwrap().avoidable.into_iter().map(|one| one.key).collect()
}

/// A scene with something idle, the same without it, and one where it does something: the first marches like the second,
/// bit for bit, and the plan names `idle` of the first and nothing of the third.
fn hold<const D: usize>(idle: &[&str], [with, without, busy]: [Scene<D>; 3]) {
    assert_eq!(keys(&with), idle);
    assert_eq!(keys(&without), Vec::<String>::new(), "without {idle:?}");
    assert_eq!(keys(&busy), Vec::<String>::new(), "what does more than {idle:?}");
    same_bits(idle[0], &seen(&with), &seen(&without)).unwrap();
    // A twin of which nothing is seen would prove nothing.
    same_bits(idle[0], &seen(&busy), &seen(&without)).unwrap_err();
}

fn loaded<const D: usize>(scene: &Scene<D>, effect: Arc<dyn Effect<D>>) -> Scene<D> {
    Scene { effects: vec![effect], ..scene.clone() }
}

fn hold_effect<const D: usize>(scene: &Scene<D>, idle: Arc<dyn Effect<D>>, busy: Arc<dyn Effect<D>>) {
    hold(&["effect[0]"], [loaded(scene, idle), scene.clone(), loaded(scene, busy)]);
}

fn step() -> Value {
    json!({ "shape": "step" })
}

#[test]
fn loads_of_nothing_and_loads_that_come_too_late() {
    // The last step asks for loads at 39 Δt; a snapshot of the end would ask at 40 Δt.
    let after = json!({ "shape": "step", "start_s": 41.5 * STEP_S });
    let last = json!({ "shape": "step", "start_s": 38.0 * STEP_S });
    let zeros = json!({ "shape": "table", "times_s": [0, 1], "values": [0, 0] });
    for (amount, history) in [(0.0, step()), (1e6, after), (1e6, zeros)] {
        let force = |amount: f64, history: &Value| json!({ "axis": "x", "density_n_m3": 1e3 * amount, "history": history });
        let pull = |amount: f64, history: &Value| json!({ "edge": "right", "axis": "x", "stress_pa": amount, "history": history });
        for nodes in [[70, 66], [40, 1]] {
            if nodes[1] > 1 {
                let plate = moving::<2>(nodes);
                let of = |json| effect::<2, BodyForce>(json);
                hold_effect(&plate, of(force(amount, &history)), of(force(1e6, &last)));
                let of = |json| effect::<2, Traction>(json);
                hold_effect(&plate, of(pull(amount, &history)), of(pull(1e6, &last)));
            } else {
                let bar = moving::<1>([nodes[0]]);
                let of = |json| effect::<1, Traction>(json);
                hold_effect(&bar, of(pull(amount, &history)), of(pull(1e6, &last)));
            }
        }
        let cut = notched();
        let open = |amount: f64, history: &Value| {
            effect::<2, FaceTraction>(json!({ "normal_pa": amount, "shear_pa": 0.0, "history": history }))
        };
        hold_effect(&cut, open(amount, &history), open(1e6, &last));
    }
}

#[test]
fn fields_and_frames_and_rates_of_nothing() {
    let plate = plate();
    let uniform = Initial { amplitude: 1e9, ..nothing::<2>() };
    let push = |fields, start| Arc::new(ForceField { fields, history: History::Step { start } });
    hold_effect(&plate, push(vec![nothing()], 0.0), push(vec![nothing(), uniform.clone()], 0.0));
    hold_effect(&plate, push(vec![uniform.clone()], 1.0), push(vec![uniform], 0.0));
    let frame = |layers| Arc::new(HeldFrame { layers, fields: vec![] });
    hold_effect(&plate, frame(0), frame(1));
    let damped = |rate| Arc::new(Damping { rate_per_s: Positive(rate) });
    hold_effect(&plate, damped(0.0), damped(1e3));
    hold_effect(&moving::<1>([40]), damped(0.0), damped(1e3));
    // Held where they are is not nothing.
    let held = json!({ "region": { "edge": "left" }, "axis": "x", "displacement_m": 0.0, "history": step() });
    let held = loaded(&plate, effect::<2, pd_verify::constraints::PrescribedMotion>(held));
    assert!(keys(&held).is_empty());
    for with in [
        Scene { displacement: [plate.displacement.clone(), vec![nothing()]].concat(), ..plate.clone() },
        Scene { velocity: [plate.velocity.clone(), vec![nothing()]].concat(), ..plate.clone() },
    ] {
        let more = Initial { amplitude: 1e-9, ..nothing() };
        let busy = Scene { displacement: vec![plate.displacement[0].clone(), more], ..plate.clone() };
        hold(&["initial"], [with, plate.clone(), busy]);
    }
}

fn notch(from: [f64; 2], to: [f64; 2]) -> Notch {
    let dx = plate().spacing;
    Notch { from: from.map(|x| x * dx), to: to.map(|x| x * dx) }
}

/// A notch from the left edge.
fn notched() -> Scene<2> {
    Scene { notches: vec![notch([0.0, 33.0], [30.0, 33.0])], ..plate() }
}

#[test]
fn notches_that_cut_no_bond_and_holes_that_take_no_node() {
    let own = notched();
    let with = |more: Notch| Scene { notches: [own.notches.clone(), vec![more]].concat(), ..own.clone() };
    let busy = || with(notch([40.0, 10.3], [42.0, 10.3]));
    // The same again, a part of it, one along a free edge.
    for idle in [own.notches[0], notch([3.0, 33.0], [9.0, 33.0]), notch([0.0, 0.0], [70.0, 0.0])] {
        hold(&["notch[1]"], [with(idle), own.clone(), busy()]);
    }
    let pierced = Scene { holes: vec![hole([40.3, 30.1], 8.0)], ..own.clone() };
    let inside = Scene {
        notches: [own.notches.clone(), vec![notch([38.0, 30.0], [42.0, 30.0])]].concat(),
        ..pierced.clone()
    };
    let across = Scene {
        notches: [own.notches.clone(), vec![notch([38.0, 30.0], [52.0, 30.0])]].concat(),
        ..pierced.clone()
    };
    hold(&["notch[1]"], [inside, pierced.clone(), across]);
    let more = |other| Scene { holes: vec![pierced.holes[0], other], ..pierced.clone() };
    hold(&["hole[1]"], [more(hole([41.0, 31.0], 3.0)), pierced.clone(), more(hole([60.0, 31.0], 3.0))]);
    // Of three that are one, the two others, notches and holes, can go together.
    let thrice = Scene { holes: vec![pierced.holes[0]; 3], notches: vec![own.notches[0]; 3], ..own.clone() };
    hold(&["notch[1]", "notch[2]", "hole[1]", "hole[2]"], [thrice, pierced, busy()]);
}

/// Beyond edges that mirror or repeat a plate obstacles have images: what cuts a bond there is not idle.
#[test]
fn images_are_counted() {
    for edges in [[[Edge::Periodic; 2]; 2], [[Edge::MirrorOdd; 2]; 2]] {
        let body = Scene { edges: Edges(edges), ..plate() };
        let cut = Scene { notches: vec![notch([0.0, 0.0], [20.0, 0.0])], ..body.clone() };
        // Along an odd mirror it parts nodes from their own images, and a periodic plate from itself.
        assert!(keys(&cut).is_empty(), "{edges:?}");
        same_bits("images", &seen(&cut), &seen(&body)).unwrap_err();
    }
    // Along the seam of a periodic plate the upper edge is the lower one.
    let body = Scene { edges: Edges([[Edge::Free; 2], [Edge::Periodic; 2]]), ..plate() };
    let own = Scene { notches: vec![notch([0.0, 66.0], [20.0, 66.0])], ..body.clone() };
    let both = Scene { notches: vec![own.notches[0], notch([0.0, 0.0], [20.0, 0.0])], ..body.clone() };
    let more = Scene { notches: vec![own.notches[0], notch([5.0, 0.0], [25.0, 0.0])], ..body };
    hold(&["notch[1]"], [both, own, more]);
}

#[test]
fn notches_that_are_loaded_or_run_stay() {
    let own = notched();
    let twice = Scene { notches: vec![own.notches[0]; 2], ..own.clone() };
    assert_eq!(keys(&twice), ["notch[1]"]);
    let on = |notch: usize| {
        loaded(
            &twice,
            effect::<2, FaceTraction>(json!({ "notch": notch, "normal_pa": 1e6, "history": step() })),
        )
    };
    assert_eq!(keys(&on(0)), ["notch[1]"]);
    assert!(keys(&on(1)).is_empty());
    let dx = own.spacing;
    // Of a notch and the same that runs the former goes.
    let runs = |notch| vec![Running { notch, speed: 1000.0, start: 0.0, by: 3.0 * dx }];
    let (with, without) =
        (Scene { running: runs(1), ..twice.clone() }, Scene { running: runs(0), ..own.clone() });
    assert_eq!((keys(&with), keys(&without)), (vec!["notch[0]".to_owned()], vec![]));
    same_bits("beside a running notch", &seen(&with), &seen(&without)).unwrap();
    assert_eq!(keys(&Scene { running: runs(0), ..twice }), ["notch[1]"]);
    // It sets out after the end: the bonds that it would cut are served one by one, which rounds otherwise.
    let late = vec![Running { start: 1.0, ..runs(0)[0] }];
    assert!(keys(&Scene { running: late, ..own }).is_empty());
}

#[test]
fn corrections_without_surfaces_and_calibrations_without_need() {
    for surface in [Correction::Energy, Correction::Volume] {
        for edges in [[[Edge::Periodic; 2]; 2], [[Edge::MirrorOdd, Edge::MirrorEven], [Edge::Periodic; 2]]] {
            let whole = Scene { edges: Edges(edges), ..plate() };
            let cut = Scene { notches: notched().notches, surface, ..whole.clone() };
            hold(&["surface_correction"], [Scene { surface, ..whole.clone() }, whole, cut]);
        }
    }
    // Half of the neighbours' volumes at δ, and a bar of the constant kernel has the modulus that is intended.
    let of = |rule, calibrated| Scene { lattice: constant(3.0, rule, calibrated), ..moving::<1>([40]) };
    let [with, without] = [true, false].map(|calibrated| of(VolumeRule::Linear, calibrated));
    hold(&["lattice.calibrated"], [with, without, of(VolumeRule::Full, true)]);
}

/// In a bar the exact law is the linear one in real numbers, not in rounded ones.
#[test]
fn finite_rotations_of_a_bar_round_otherwise() {
    let bar = moving::<1>([40]);
    let finite = Scene { rotations: Rotations::Finite, ..bar.clone() };
    assert!(keys(&finite).is_empty());
    let (small, finite) = (seen(&bar), seen(&finite));
    same_bits("finite rotations", &finite, &small).unwrap_err();
    let largest = small.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    assert!(small.iter().zip(&finite).all(|(a, b)| (a - b).abs() < 1e-9 * largest));
}

/// The ledger books what nothing does, and sees the same motion.
#[test]
fn booked_marches_are_the_same_too() {
    let plate = plate();
    let busy = loaded(&plate, Arc::new(Damping { rate_per_s: Positive(0.0) }));
    let run = |scene: &Scene<2>| {
        let model = Model::new(scene).unwrap();
        let [u, v] = [1, 2].map(|seed| rough(&model, seed, 0.01 * scene.spacing));
        let (mut march, mut ledger) = (March::from_fields(&model, u, v, STEP_S), Ledger::new(&model));
        (0..STEPS).for_each(|_| march.advance_booked(&mut ledger));
        (march.displacement().to_vec(), ledger.balance())
    };
    let ((u, with), (v, without)) = (run(&busy), run(&plate));
    same_bits("booked", &u, &v).unwrap();
    assert_eq!((with.kinetic, with.elastic, with.rates), (without.kinetic, without.elastic, 0.0));
}
