//! Patches, held against line probes of every step, forces evaluated apart and motions known in closed form; the march
//! must not notice them.

use crate::bodies::{constant, effect, force, model, scene};
use pd_verify::constraints::{Edge, Edges, PrescribedMotion};
use pd_verify::forces::{BodyForce, Damping, Traction};
use pd_verify::march::March;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::record::{Record, run};
use pd_verify::scene::{Beyond, Hole, Initial, Probe, Rotations, Scene, Shape, StepRule, Time, Watch};
use serde_json::json;
use std::f64::consts::TAU;

const STEP: f64 = 1e-7;
const STEPS: u64 = 60;

fn time(steps: u64) -> Time {
    Time {
        duration: STEP * steps as f64,
        step: StepRule::Given { seconds: STEP, beyond_limit: Beyond::Refused },
    }
}

fn probe<const D: usize>(name: impl Into<String>, watch: Watch<D>, every: u64) -> Probe<D> {
    Probe { name: name.into(), watch, every }
}

fn gaussian<const D: usize>(component: usize, amplitude: f64, at: f64) -> Initial<D> {
    Initial { component, amplitude, shape: Shape::Gaussian { centre: [at; D], sharpness: 1.0 / 4e-4 } }
}

/// A body that is loaded, damped if so asked, driven along its left edge and starts in motion.
fn busy<const D: usize>(nodes: [usize; D], rotations: Rotations, damped: bool) -> Scene<D> {
    let sine = json!({ "shape": "sine", "period_s": 2e-5 });
    let region = json!({ "edge": "left" });
    let drive = json!({ "region": region, "axis": "x", "displacement_m": 1e-6, "history": sine });
    let late = json!({ "shape": "step", "start_s": 2.15e-6 });
    let pull = json!({ "edge": "right", "axis": "x", "stress_pa": 1e7, "history": late });
    let mut effects = vec![effect::<D, PrescribedMotion>(drive), effect::<D, Traction>(pull)];
    effects.extend(damped.then(|| effect::<D, Damping>(json!({ "rate_per_s": 2e5 }))));
    let mut edges = Edges::default();
    if D == 2 {
        edges.0[D - 1] = [Edge::MirrorOdd, Edge::Free];
    }
    Scene {
        rotations,
        edges,
        displacement: vec![gaussian(0, 1e-6, 0.02)],
        velocity: vec![gaussian(D - 1, 0.5, 0.03)],
        effects,
        time: time(STEPS),
        ..scene::<D>(constant(3.0, VolumeRule::Linear, true), nodes)
    }
}

/// A patch over the middle of a body and a line probe for each row, looking at every step.
fn probes<const D: usize>(scene: &Scene<D>) -> (Probe<D>, Vec<Probe<D>>) {
    let patch = Watch::Patch { from: [0.0; D], to: scene.size().map(|length| 0.8 * length) };
    let rows = if D == 1 { 1 } else { scene.nodes[D - 1] };
    let row = |row: usize| {
        let through = (row as f64 + 0.5) * scene.spacing;
        probe(format!("row {row}"), Watch::Line { along: 0, through }, 1)
    };
    (probe("patch", patch, 1), (0..rows).map(row).collect())
}

/// u(n) of a component at a cell, as the line of its row saw it.
fn seen<const D: usize>(record: &Record, at: &[f64], spacing: f64, component: usize, step: usize) -> f64 {
    let cell = |axis: usize| (at.get(axis).copied().unwrap_or(0.0) / spacing) as usize;
    record.trace(&format!("row {}", cell(1))).unwrap().rows[step][D * cell(0) + component]
}

/// Displacements are the lines' own bits, accelerations their second differences: displacements of at most 1e-5 m were
/// rounded to half a unit each time they were summed.
fn agrees_with_lines<const D: usize>(scene: &Scene<D>) {
    let (patch, lines) = probes(scene);
    let alone = run(&Scene { probes: lines.clone(), ..scene.clone() }).unwrap();
    let mut both = lines;
    both.push(patch);
    let record = run(&Scene { probes: both, ..scene.clone() }).unwrap();
    assert_eq!(record.traces[..alone.traces.len()], alone.traces, "the march noticed");
    let trace = record.trace("patch").unwrap();
    assert_eq!(trace.rows.len() as u64, STEPS + 1);
    let (names, axes) = (["displacement", "acceleration"], ["x", "y"]);
    let mut moving = 0;
    for (index, column) in trace.columns.iter().enumerate() {
        let (kind, axis) = ((index / D) % 2, index % D);
        assert_eq!(column.quantity, format!("{}_{}", names[kind], axes[axis]));
        let at = column.at.as_deref().unwrap();
        let u = |step: usize| seen::<D>(&record, at, scene.spacing, axis, step);
        for step in 1..STEPS as usize {
            let value = trace.rows[step][index];
            if kind == 0 {
                assert_eq!(value.to_bits(), u(step).to_bits());
                continue;
            }
            let expected = (u(step + 1) - 2.0 * u(step) + u(step - 1)) / (STEP * STEP);
            assert!(u(step).abs() < 1e-5);
            let bound = 4.0 * f64::EPSILON * 1e-5 / (STEP * STEP);
            assert!((value - expected).abs() <= bound, "{column:?} {step}: {value:e} {expected:e}");
            moving += usize::from(value.abs() > 100.0 * bound);
        }
    }
    assert!(moving > 40, "{moving} accelerations try nothing");
}

#[test]
fn patches_are_what_lines_see_and_change_no_bit() {
    for rotations in [Rotations::Small, Rotations::Finite] {
        for damped in [false, true] {
            agrees_with_lines(&busy::<1>([30], rotations, damped));
            agrees_with_lines(&busy::<2>([14, 11], rotations, damped));
        }
    }
    // More than one piece of work, of which the patch holds some.
    agrees_with_lines(&busy::<2>([130, 90], Rotations::Small, true));
}

/// At t = 0 nodes that are free have the acceleration F/ρ of the initial displacement, damping and velocities aside;
/// driven ones that of their history, at the end of the first step.
#[test]
fn a_run_starts_with_the_acceleration_of_its_force() {
    let plate = busy::<2>([14, 11], Rotations::Small, false);
    let (patch, _) = probes(&plate);
    let record = run(&Scene { probes: vec![patch], ..plate.clone() }).unwrap();
    let trace = record.trace("patch").unwrap();
    let own = model(&plate);
    let f = force(&own, March::new(&own, &plate, STEP).displacement());
    let sine = |n: f64| 1e-6 * libm::sin(TAU * n * STEP / 2e-5);
    for (index, column) in trace.columns.iter().enumerate().filter(|(index, _)| (index / 2) % 2 == 1) {
        let at = column.at.as_deref().unwrap();
        let node = [at[0], at[1]].map(|x| (x / plate.spacing) as isize);
        let place = own.grid.place(node) + (index % 2) * own.grid.stride();
        let (seen, expected) = (trace.rows[0][index], f[place] / plate.material.density);
        if node[0] == 0 && index % 2 == 0 {
            let driven = (sine(2.0) - 2.0 * sine(1.0)) / (STEP * STEP);
            assert!((seen - driven).abs() <= 8.0 * f64::EPSILON * 1e-6 / (STEP * STEP), "{seen:e}");
        } else {
            assert!((seen - expected).abs() <= 2.0 * f64::EPSILON * expected.abs(), "{node:?} {seen:e}");
        }
    }
    assert!(trace.rows[0].iter().any(|value| value.abs() > 1e4));
}

/// A free bar under a uniform force falls with the same acceleration at every step.
#[test]
fn a_falling_bar_is_accelerated_alike_at_all_times() {
    let push = json!({ "axis": "x", "density_n_m3": 2700.0 * 1e6, "history": { "shape": "step" } });
    let bar = scene::<1>(constant(2.0, VolumeRule::Linear, false), [20]);
    let patch = Watch::Patch { from: [2.0 * bar.spacing], to: [5.0 * bar.spacing] };
    let falling = Scene {
        effects: vec![effect::<1, BodyForce>(push)],
        time: time(40),
        probes: vec![probe("p", patch, 7)],
        ..bar
    };
    let record = run(&falling).unwrap();
    let trace = record.trace("p").unwrap();
    assert_eq!((trace.columns.len(), trace.rows.len(), trace.times.len()), (6, 7, 7));
    for (t, row) in trace.times.iter().zip(&trace.rows) {
        for pair in row.chunks(2) {
            assert!((pair[0] - 5e5 * t * t).abs() <= 1e-17 && (pair[1] / 1e6 - 1.0).abs() < 1e-9, "{pair:?}");
        }
    }
}

#[test]
fn nodes_that_a_hole_has_removed_are_told() {
    let plate = scene::<2>(constant(2.0, VolumeRule::Linear, false), [20, 16]);
    let dx = plate.spacing;
    let patch = Watch::Patch { from: [6.0 * dx, 6.0 * dx], to: [14.0 * dx, 10.0 * dx] };
    let holed = Scene {
        holes: vec![Hole { centre: [10.0 * dx, 8.0 * dx], radius: 3.0 * dx }],
        displacement: vec![Initial { component: 0, amplitude: 1e-3, shape: Shape::Linear { along: 0 } }],
        probes: vec![probe("p", patch, 9)],
        time: time(20),
        ..plate
    };
    let record = run(&holed).unwrap();
    let trace = record.trace("p").unwrap();
    assert_eq!(trace.columns.len(), 4 * 8 * 4);
    for (index, column) in trace.columns.iter().enumerate() {
        let at = column.at.as_deref().unwrap();
        let gone = (at[0] / dx - 10.0).hypot(at[1] / dx - 8.0) < 3.0;
        assert!(column.removed == gone && trace.rows.iter().all(|row| row[index].is_nan() == gone));
        if index % 4 == 0 && !gone {
            assert!((trace.rows[0][index] - 1e-3 * at[0]).abs() < 1e-18);
        }
    }
}

#[test]
fn boxes_that_cannot_be_are_refused_and_bytes_counted() {
    let plate = || busy::<2>([14, 11], Rotations::Small, false);
    let dx = plate().spacing;
    let with = |from: [f64; 2], to: [f64; 2], every| {
        let watch = Watch::Patch { from: from.map(|x| x * dx), to: to.map(|x| x * dx) };
        Scene { probes: vec![probe("p", watch, every)], ..plate() }
    };
    let refuse = |scene: Scene<2>, key: &str, words: &str| {
        let wrong = Plan::of(&scene).unwrap_err();
        assert!(wrong.key == key && wrong.message.contains(words) && !wrong.help.is_empty(), "{wrong:?}");
    };
    refuse(with([-0.1, 1.0], [4.0, 4.0], 1), "probe[0].from_m", "outside the body");
    refuse(with([1.0, 1.0], [4.0, 11.1], 1), "probe[0].to_m", "outside the body");
    refuse(with([1.0, f64::NAN], [4.0, 4.0], 1), "probe[0].from_m", "outside the body");
    refuse(with([4.6, 1.0], [5.4, 4.0], 1), "probe[0].to_m", "holds no node");
    refuse(with([4.0, 1.0], [2.0, 4.0], 1), "probe[0].to_m", "holds no node");
    let hole = Hole { centre: [7.0 * dx, 5.5 * dx], radius: 3.0 * dx };
    refuse(Scene { holes: vec![hole], ..with([6.0, 5.0], [8.0, 6.0], 1) }, "probe[0].to_m", "holds no node");
    // 3 × 2 nodes, two vectors of each; looks at steps 0, 7, …, 56 and 60.
    let plan = Plan::of(&with([1.0, 2.0], [4.0, 4.0], 7)).unwrap();
    assert_eq!((plan.patch_bytes, Plan::of(&plate()).unwrap().patch_bytes), (3 * 2 * 4 * 8 * 10, 0));
    assert_eq!(plan.paced(&with([1.0, 2.0], [4.0, 4.0], 60)).unwrap().patch_bytes, 3 * 2 * 4 * 8 * 2);
    let long = Scene { time: time(50_000_000), ..with([1.0, 2.0], [4.0, 4.0], 1) };
    refuse(long, "probe[0].every_steps", "at most 4 GiB");
}
