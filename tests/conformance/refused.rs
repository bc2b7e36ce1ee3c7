//! What a plan refuses by name, and what it must not refuse: contradictions, corners on nodes, odd durations.

use crate::bodies::{constant, effect, scene};
use pd_verify::constraints::{Edge, Edges, PrescribedMotion};
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{BodyForce, Damping, Traction};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::record::run;
use pd_verify::scene::{Effect, Initial, Probe, Region, Scene, Shape, StepRule, Time, Watch};
use serde_json::{Value, json};
use std::sync::Arc;

fn bar() -> Scene<1> {
    scene::<1>(constant(2.0, VolumeRule::Linear, false), [20])
}

fn step() -> Value {
    json!({ "shape": "step" })
}

/// The key and the message with which a plan refuses.
fn refused<const D: usize>(scene: Scene<D>) -> (String, String) {
    let wrong = Plan::of(&scene).unwrap_err();
    assert!(!wrong.help.is_empty());
    (wrong.key, wrong.message)
}

fn refuses<const D: usize>(scene: Scene<D>, key: &str, words: &str) {
    let found = refused(scene);
    assert!(found.0 == key && found.1.contains(words), "{found:?}");
}

#[test]
fn effects_that_contradict_each_other_or_their_edge() {
    let with = |effects: Vec<Arc<dyn Effect<1>>>| Scene { effects, ..bar() };
    let drive = |displacement: f64, from: f64| {
        let region = json!({ "from_m": [from], "to_m": [from + 0.01] });
        let asked =
            json!({ "region": region, "axis": "x", "displacement_m": displacement, "history": step() });
        effect::<1, PrescribedMotion>(asked)
    };
    refuses(with(vec![drive(1e-3, 0.0), drive(-1e-3, 0.005)]), "effect[1].region", "driven");
    assert!(Plan::of(&with(vec![drive(1e-3, 0.0), drive(-1e-3, 0.03)])).is_ok());
    let damp = || effect::<1, Damping>(json!({ "rate_per_s": 1e3 }));
    refuses(with(vec![damp(), damp()]), "effect[1]", "depend on the velocity");
    let pull = |edge: &str| {
        effect::<1, Traction>(json!({ "edge": edge, "axis": "x", "stress_pa": 1e6, "history": step() }))
    };
    let held = Edges([[Edge::MirrorOdd, Edge::Free]]);
    refuses(Scene { edges: held, ..with(vec![pull("left")]) }, "effect[0].edge", "mirror_odd");
    assert!(Plan::of(&Scene { edges: held, ..with(vec![pull("right")]) }).is_ok());
    let ring = Edges([[Edge::Periodic; 2]]);
    refuses(Scene { edges: ring, ..with(vec![pull("right")]) }, "effect[0].edge", "periodic");
    let deep = json!({ "edge": "left", "depth_m": 1e20 });
    let push = json!({ "region": deep, "axis": "x", "density_n_m3": 1.0, "history": step() });
    refuses(with(vec![effect::<1, BodyForce>(push)]), "effect[0].region.depth_m", "larger than the body");
}

#[test]
fn durations_are_covered_and_endless_ones_refused() {
    let time = |duration: f64, seconds: f64| Time {
        duration,
        step: StepRule::Given { seconds, beyond_limit: true },
    };
    let steps =
        |duration, seconds| Plan::of(&Scene { time: time(duration, seconds), ..bar() }).unwrap().steps;
    assert_eq!([steps(2e-5, 1e-7), steps(2.005e-5, 1e-7), steps(1e-5, 6e-6)], [200, 201, 2]);
    assert_eq!(steps(0.8e-3, 10e-9), 80_000);
    refuses(Scene { time: time(1e30, 1e-7), ..bar() }, "duration_s", "steps");
    refuses(Scene { time: time(0.0, 1e-7), ..bar() }, "duration_s", "nothing to simulate");
}

#[test]
fn a_corner_on_a_node_holds_it() {
    let grid = pd_verify::grid::Grid::<1>::new([20], 0.1, 2);
    for (from, to, count) in [(0.05, 0.35, 4), (0.15, 0.35, 3), (0.25, 0.65, 5), (0.06, 0.34, 2)] {
        let region = Region { from_m: Some(vec![from]), to_m: Some(vec![to]), ..Region::default() };
        assert_eq!(region.nodes(&grid).unwrap().len(), count, "{from} to {to}");
    }
}

#[test]
fn a_plate_of_one_row_bears_an_energy_correction() {
    let row = scene::<2>(constant(1.0, VolumeRule::Linear, false), [10, 1]);
    let plan = Plan::of(&Scene { surface: Correction::Energy, ..row }).unwrap();
    assert!(plan.time_step_s > 0.0 && plan.time_step_s.is_finite());
}

/// A step of load that begins between two steps is of second order in Δt: under a uniform force a free bar moves as one
/// point, ½(f/ρ)(t − t₀)².
#[test]
fn a_late_step_of_load_is_of_second_order() {
    let late = 3.3e-6;
    let push = json!({ "axis": "x", "density_n_m3": 1e9, "history": { "shape": "step", "start_s": late } });
    let error = |steps: f64| {
        let scene = Scene {
            effects: vec![effect::<1, BodyForce>(push.clone())],
            time: Time {
                duration: 2e-5,
                step: StepRule::Given { seconds: 2e-5 / steps, beyond_limit: true },
            },
            probes: vec![Probe { name: "u".into(), watch: Watch::Point { at: [0.02] }, every: 1 }],
            displacement: vec![Initial { component: 0, amplitude: 0.0, shape: Shape::Uniform }],
            ..bar()
        };
        let seen = run(&scene).unwrap().trace("u").unwrap().column(0);
        let exact = 0.5 * 1e9 / scene.material.density * (2e-5_f64 - late).powi(2);
        (seen.last().unwrap() / exact - 1.0).abs()
    };
    let [coarse, fine] = [error(40.0), error(400.0)];
    assert!(coarse < 2e-3 && fine < 2e-5, "{coarse:e} {fine:e}");
}
