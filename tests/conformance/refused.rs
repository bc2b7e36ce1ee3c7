//! What a plan refuses by name, and what it must not refuse: contradictions, corners on nodes, odd durations.

use crate::bodies::{constant, effect, scene};
use pd_verify::constraints::{Edge, Edges, PrescribedMotion};
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{BodyForce, Damping, Traction};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::record::run;
use pd_verify::scene::{Beyond, Effect, Hole, Initial, Probe, Region, Scene, Shape, StepRule, Time, Watch};
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

/// Nodes that move as prescribed feel no load along that axis: one that acts on no others does nothing.
#[test]
fn loads_on_nodes_that_are_all_driven() {
    let plate = scene::<2>(constant(2.0, VolumeRule::Linear, false), [200, 100]);
    let with = |effects: [Arc<dyn Effect<2>>; 2]| Scene { effects: effects.to_vec(), ..plate.clone() };
    let drive = |edge: &str, layers: f64, axis: &str| {
        let region = json!({ "edge": edge, "depth_m": layers * plate.spacing });
        let asked = json!({ "region": region, "axis": axis, "displacement_m": 1e-3, "history": step() });
        effect::<2, PrescribedMotion>(asked)
    };
    let pull = |edge: &str| {
        effect::<2, Traction>(json!({ "edge": edge, "axis": "y", "stress_pa": 1e6, "history": step() }))
    };
    let push = |edge: &str, layers: f64| {
        let region = json!({ "edge": edge, "depth_m": layers * plate.spacing });
        let asked = json!({ "region": region, "axis": "y", "density_n_m3": 1e6, "history": step() });
        effect::<2, BodyForce>(asked)
    };
    for edge in ["left", "right", "bottom", "top"] {
        refuses(with([drive(edge, 1.0, "y"), pull(edge)]), "effect[1].axis", "the traction does nothing");
        refuses(with([pull(edge), drive(edge, 3.0, "y")]), "effect[0].axis", "the traction does nothing");
        refuses(with([push(edge, 2.0), drive(edge, 2.0, "y")]), "effect[0].axis", "the body force does");
        assert!(Plan::of(&with([drive(edge, 1.0, "x"), pull(edge)])).is_ok(), "{edge}, across");
        assert!(
            Plan::of(&with([drive(edge, 1.0, "y"), push(edge, 2.0)])).is_ok(),
            "{edge}, one layer is free"
        );
    }
    assert!(Plan::of(&with([drive("bottom", 1.0, "y"), pull("top")])).is_ok());
}

#[test]
fn a_depth_without_an_edge() {
    let push = |region: Value| {
        let asked = json!({ "region": region, "axis": "x", "density_n_m3": 1.0, "history": step() });
        Scene { effects: vec![effect::<1, BodyForce>(asked)], ..bar() }
    };
    refuses(push(json!({ "depth_m": 0.01 })), "effect[0].region", "edge is missing");
    let both = json!({ "depth_m": 0.01, "from_m": [0.0], "to_m": [0.01] });
    refuses(push(both), "effect[0].region", "an edge or a box, not both");
}

#[test]
fn motions_against_mirrors_and_periods() {
    let plate = scene::<2>(constant(2.0, VolumeRule::Linear, false), [20, 16]);
    let with = |left: Edge, axis: &str| {
        let region = json!({ "edge": "left" });
        let asked = json!({ "region": region, "axis": axis, "displacement_m": 1e-3, "history": step() });
        let right = if left == Edge::Periodic { left } else { Edge::Free };
        let edges = Edges([[left, right], [Edge::Free; 2]]);
        Scene { edges, effects: vec![effect::<2, PrescribedMotion>(asked)], ..plate.clone() }
    };
    refuses(with(Edge::Periodic, "x"), "effect[0].region.edge", "the left edge is periodic");
    refuses(
        with(Edge::MirrorOdd, "x"),
        "effect[0].axis",
        "mirror_odd (a roller): its mirror holds it along x",
    );
    refuses(with(Edge::MirrorEven, "y"), "effect[0].axis", "its mirror holds it along y");
    for (edge, axis) in [(Edge::MirrorOdd, "y"), (Edge::MirrorEven, "x"), (Edge::Free, "x")] {
        assert!(Plan::of(&with(edge, axis)).is_ok(), "{edge:?} {axis}");
    }
    let thin = json!({ "edge": "left", "depth_m": 0.5 * plate.spacing });
    let push = json!({ "region": thin, "axis": "x", "density_n_m3": 1.0, "history": step() });
    let thin = Scene { effects: vec![effect::<2, BodyForce>(push)], ..plate };
    refuses(thin, "effect[0].region.depth_m", "thinner than a cell");
}

#[test]
fn holes_that_take_nothing_or_too_much() {
    let plate = scene::<2>(constant(2.0, VolumeRule::Linear, false), [20, 16]);
    let dx = plate.spacing;
    let hole = |x: f64, y: f64, radius: f64| Hole { centre: [x * dx, y * dx], radius: radius * dx };
    let with = |holes: Vec<Hole>| Scene { holes, ..plate.clone() };
    refuses(with(vec![hole(5.0, 5.0, 2.0), hole(9.0, 9.0, 0.7)]), "hole[1].radius_m", "removes no node");
    refuses(with(vec![hole(5.0, 5.0, f64::NAN)]), "hole[0].radius_m", "is no hole");
    refuses(with(vec![hole(10.0, 8.0, 13.0)]), "hole[0].radius_m", "the hole swallows the plate: no node");
    // The corners are left, and each is alone.
    refuses(with(vec![hole(10.0, 8.0, 12.1)]), "hole[0].radius_m", "swallows the plate: no two nodes");
    assert!(Plan::of(&with(vec![hole(10.0, -10.0, 12.0)])).is_ok());
    let held = Edges([[Edge::Free; 2], [Edge::MirrorOdd, Edge::Free]]);
    let beyond = Scene { edges: held, ..with(vec![hole(10.0, -10.0, 12.0)]) };
    refuses(beyond, "hole[0].centre_m", "beyond an edge that is mirror_odd");
    let bar_with_a_hole = Scene { holes: vec![hole(5.0, 0.0, 2.0)], ..bar() };
    refuses(bar_with_a_hole, "hole", "a bar has no holes");
    // A row of nodes may be gone, but not the one that a traction pulls.
    let mown = with(vec![Hole { centre: [10.0 * dx, 1000.0 * dx], radius: 984.6 * dx }]);
    assert!(Plan::of(&mown).is_ok_and(|plan| plan.nodes == 320 - 20));
    let pull = json!({ "edge": "top", "axis": "y", "stress_pa": 1e6, "history": step() });
    let pulled = Scene { effects: vec![effect::<2, Traction>(pull)], ..mown };
    refuses(pulled, "effect[0].edge", "removed every node along the top edge");
}

/// A point is seen where the nodes around it are there; on a node, only that one must be.
#[test]
fn probes_in_holes() {
    let plate = scene::<2>(constant(2.0, VolumeRule::Linear, false), [20, 16]);
    let dx = plate.spacing;
    let holes = vec![Hole { centre: [10.0 * dx, 8.0 * dx], radius: 3.0 * dx }];
    let displacement = vec![Initial { component: 0, amplitude: 1e-3, shape: Shape::Linear { along: 0 } }];
    let plate = Scene { holes, displacement, ..plate };
    let with = |watch| Scene { probes: vec![Probe { name: "p".into(), watch, every: 1 }], ..plate.clone() };
    let point = |x: f64, y: f64| with(Watch::Point { at: [x * dx, y * dx] });
    for at in [[10.0, 8.0], [7.2, 8.0], [12.9, 8.5]] {
        refuses(point(at[0], at[1]), "probe[0].at_m", "nodes that a hole has removed");
    }
    assert!(Plan::of(&point(7.2, 7.9)).unwrap_err().help.contains("[0.02405, 0.02775] m"));
    // Rounding in where a node stands does not count, nor does it blur what is seen there.
    for x in [6.5, 6.5 * (1.0 + 1e-12)] {
        let seen = run(&point(x, 8.5)).unwrap().trace("p").unwrap().column(0)[0];
        assert!((seen / (6.5e-3 * dx) - 1.0).abs() < 1e-11, "{seen:e}");
    }
    let line = run(&with(Watch::Line { along: 0, through: 8.0 * dx })).unwrap();
    let line = line.trace("p").unwrap();
    let gone: Vec<bool> = line.rows[3].iter().map(|value| value.is_nan()).collect();
    let said: Vec<bool> = line.columns.iter().map(|column| column.removed).collect();
    assert_eq!(gone, said);
    // Six nodes of two components, from 7.5 to 12.5.
    assert_eq!(gone, (0..40).map(|n| (14..26).contains(&n)).collect::<Vec<_>>());
    assert_eq!(line.known().count(), 28 * line.rows.len());
    let wide = Hole { centre: [10.0 * dx, 8.0 * dx], radius: 7.9 * dx };
    let cut = Scene { holes: vec![wide], ..with(Watch::Line { along: 1, through: 10.0 * dx }) };
    refuses(cut, "probe[0].through_m", "from end to end");
}

#[test]
fn durations_are_covered_and_endless_ones_refused() {
    let time = |duration: f64, seconds: f64| Time {
        duration,
        step: StepRule::Given { seconds, beyond_limit: Beyond::UntilItShows },
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
                step: StepRule::Given { seconds: 2e-5 / steps, beyond_limit: Beyond::UntilItShows },
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
