//! Snapshots, held against probes of every step, against initial fields and prescribed motions; the march must not notice
//! them.

use crate::bodies::{constant, effect, scene};
use pd_verify::constraints::{Edge, Edges, PrescribedMotion};
use pd_verify::forces::{BodyForce, Damping, Traction};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::record::{Record, run};
use pd_verify::scene::{Beyond, Initial, Probe, Rotations, Scene, Shape, Snapshots, StepRule, Time, Watch};
use serde_json::json;
use std::f64::consts::TAU;

const STEP: f64 = 1e-7;
const STEPS: u64 = 90;

fn asked(name: &str, times: &[f64]) -> Snapshots {
    Snapshots { name: name.into(), times: times.to_vec() }
}

fn gaussian<const D: usize>(component: usize, amplitude: f64, at: f64) -> Initial<D> {
    Initial { component, amplitude, shape: Shape::Gaussian { centre: [at; D], sharpness: 1.0 / 4e-4 } }
}

/// A body on which everything acts: damping, a load that comes late, a driven edge, a start in motion.
fn busy<const D: usize>(nodes: [usize; D], rotations: Rotations) -> Scene<D> {
    let sine = json!({ "shape": "sine", "period_s": 2e-5 });
    let region = json!({ "edge": "left" });
    let drive = json!({ "region": region, "axis": "x", "displacement_m": 1e-6, "history": sine });
    let late = json!({ "shape": "step", "start_s": 2.15e-6 });
    let pull = json!({ "edge": "right", "axis": "x", "stress_pa": 1e7, "history": late });
    let body = scene::<D>(constant(3.0, VolumeRule::Linear, true), nodes);
    let mut edges = Edges::default();
    if D == 2 {
        edges.0[D - 1] = [Edge::MirrorOdd, Edge::Free];
    }
    Scene {
        rotations,
        edges,
        displacement: vec![gaussian(0, 1e-6, 0.02)],
        velocity: vec![gaussian(D - 1, 0.5, 0.03)],
        effects: vec![
            effect::<D, PrescribedMotion>(drive),
            effect::<D, Traction>(pull),
            effect::<D, Damping>(json!({ "rate_per_s": 2e5 })),
        ],
        time: Time {
            duration: STEP * STEPS as f64,
            step: StepRule::Given { seconds: STEP, beyond_limit: Beyond::Refused },
        },
        ..body
    }
}

/// A line probe for each row, looking at every step.
fn rows<const D: usize>(scene: &Scene<D>) -> Vec<Probe<D>> {
    let count = if D == 1 { 1 } else { scene.nodes[D - 1] };
    let of = |row: usize| Probe {
        name: format!("row {row}"),
        watch: Watch::Line { along: 0, through: (row as f64 + 0.5) * scene.spacing },
        every: 1,
    };
    (0..count).map(of).collect()
}

/// u(n) of a component as the probes of `rows` saw it, row by row.
fn seen<const D: usize>(record: &Record, rows: &[Probe<D>], component: usize, step: u64) -> Vec<f64> {
    let of = |probe: &Probe<D>| {
        let row = record.trace(&probe.name).unwrap().rows[step as usize].clone();
        row.into_iter().skip(component).step_by(D)
    };
    rows.iter().flat_map(of).collect()
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// Displacements are the probes' own bits. Velocities are (u(n+1) − u(n−1))/2Δt of displacements that were rounded when
/// they were summed: each by half a unit of at most 1e-5 m.
fn agrees_with_probes<const D: usize>(scene: &Scene<D>) {
    let probes = rows(scene);
    let alone = run(&Scene { probes: probes.clone(), ..scene.clone() }).unwrap();
    let both = [asked("few", &[1e-7, 3.04e-6, 8.96e-6]), asked("one", &[3.0e-6])];
    let record = run(&Scene { probes: probes.clone(), snapshots: both.to_vec(), ..scene.clone() }).unwrap();
    assert_eq!(record.traces, alone.traces, "the march noticed");
    let taken: Vec<_> = record.snapshots.iter().map(|one| (one.name.as_str(), one.index, one.step)).collect();
    // 8.96e-6 s is nearest to the last step but none.
    assert_eq!(taken, [("few", 0, 1), ("few", 1, 30), ("one", 0, 30), ("few", 2, STEPS)]);
    let mut moving = 0;
    for snapshot in record.snapshots.iter().filter(|one| one.step < STEPS) {
        assert_eq!((snapshot.time, snapshot.spacing), (snapshot.step as f64 * STEP, scene.spacing));
        assert_eq!(snapshot.nodes, scene.nodes);
        for component in 0..D {
            let u = seen(&record, &probes, component, snapshot.step);
            assert_eq!(bits(&snapshot.displacement[component]), bits(&u));
            let (before, after) = (snapshot.step - 1, snapshot.step + 1);
            let pairs = [after, before].map(|step| seen(&record, &probes, component, step));
            for ((after, before), v) in pairs[0].iter().zip(&pairs[1]).zip(&snapshot.velocity[component]) {
                assert!(after.abs() < 1e-5);
                let expected = (after - before) / (2.0 * STEP);
                assert!((v - expected).abs() <= 4.0 * f64::EPSILON * 1e-5 / STEP, "{v:e} {expected:e}");
                moving += usize::from(v.abs() > 1e-3);
            }
        }
    }
    assert!(moving > 40, "{moving} moving nodes try nothing");
}

#[test]
fn snapshots_are_what_probes_see_and_change_no_bit() {
    for rotations in [Rotations::Small, Rotations::Finite] {
        agrees_with_probes(&busy::<1>([30], rotations));
        agrees_with_probes(&busy::<2>([14, 11], rotations));
    }
    // More than one piece of work.
    agrees_with_probes(&busy::<2>([130, 90], Rotations::Small));
}

/// The velocity at the last step is that of a longer run there, and the ledger sees nothing either.
#[test]
fn the_last_step_has_its_velocity_too() {
    let plate = busy::<2>([14, 11], Rotations::Small);
    let energies = vec![Probe { name: "energies".into(), watch: Watch::Energies, every: 1 }];
    let snapshots = vec![asked("last", &[STEP * STEPS as f64])];
    let time = Time { duration: 2.0 * plate.time.duration, ..plate.time };
    let short = run(&Scene { snapshots: snapshots.clone(), ..plate.clone() }).unwrap();
    let long = Scene { time, probes: energies, ..plate };
    let unseen = run(&long).unwrap();
    let long = run(&Scene { snapshots, ..long }).unwrap();
    assert_eq!(short.snapshots, long.snapshots);
    assert_eq!(unseen.traces, long.traces);
    assert_eq!(short.snapshots[0].step, STEPS);
}

/// At t = 0 the velocity is the one given, damped or not; of driven nodes it is the slope of their history, as the first
/// step sees it.
#[test]
fn a_run_starts_with_the_velocity_it_was_given() {
    let plate = busy::<2>([14, 11], Rotations::Small);
    let snapshots = vec![asked("start", &[0.0])];
    let record = run(&Scene { snapshots, ..plate.clone() }).unwrap();
    let start = &record.snapshots[0];
    assert_eq!((start.step, start.time), (0, 0.0));
    for (n, (vx, vy)) in start.velocity[0].iter().zip(&start.velocity[1]).enumerate() {
        let at = [n % 14, n / 14].map(|k| (k as f64 + 0.5) * plate.spacing);
        let squares: f64 = at.iter().map(|x| (x - 0.03).powi(2)).sum();
        assert!((vy - 0.5 * (-squares / 4e-4).exp()).abs() <= 1e-15);
        let slope = 1e-6 * (TAU * STEP / 2e-5).sin() / STEP;
        let expected = if n % 14 == 0 { slope } else { 0.0 };
        assert!((vx - expected).abs() <= 1e-14 * slope, "{n} {vx:e}");
    }
}

/// A free bar under a uniform force falls: v = g t at every step, to the rounding of as many sums.
#[test]
fn a_falling_bar_has_the_velocity_of_its_own_time() {
    let push = json!({ "axis": "x", "density_n_m3": 2700.0 * 1e6, "history": { "shape": "step" } });
    let bar = scene::<1>(constant(2.0, VolumeRule::Linear, false), [20]);
    let times: Vec<f64> = (0..=4).map(|n| f64::from(n) * 1e-6).collect();
    let scene = Scene {
        effects: vec![effect::<1, BodyForce>(push)],
        time: Time { duration: 4e-6, step: StepRule::Given { seconds: STEP, beyond_limit: Beyond::Refused } },
        snapshots: vec![asked("falling", &times)],
        ..bar
    };
    for (snapshot, t) in run(&scene).unwrap().snapshots.iter().zip(times) {
        assert!(snapshot.velocity[0].iter().all(|v| (v - 1e6 * t).abs() <= 1e-12), "{snapshot:?}");
        assert!(snapshot.displacement[0].iter().all(|u| (u - 5e5 * t * t).abs() <= 1e-17));
    }
}

#[test]
fn times_that_cannot_be_are_refused() {
    let plate = || busy::<2>([14, 11], Rotations::Small);
    let refuse = |snapshots: Vec<Snapshots>, key: &str, words: &str| {
        let wrong = Plan::of(&Scene { snapshots, ..plate() }).unwrap_err();
        assert!(wrong.key == key && wrong.message.contains(words) && !wrong.help.is_empty(), "{wrong:?}");
    };
    for bad in [-1e-9, 9.01e-6, f64::NAN, f64::INFINITY] {
        let snapshots = vec![asked("good", &[0.0, 9e-6]), asked("bad", &[1e-6, bad])];
        refuse(snapshots, "snapshot[1].at_s", "the run goes from 0 to");
    }
    refuse(vec![asked("a", &[])], "snapshot[0].at_s", "needs a time");
    refuse(vec![asked("a", &[2e-6, 1e-6])], "snapshot[0].at_s", "out of order");
    refuse(vec![asked("a", &[2e-6, 2.04e-6])], "snapshot[0].at_s", "same step");
    refuse(vec![asked("a", &[1e-6]), asked("a", &[2e-6])], "snapshot[1].name", "called \"a\"");
    let two = vec![asked("a", &[0.0, 1e-6]), asked("b", &[9e-6])];
    let plan = Plan::of(&Scene { snapshots: two.clone(), ..plate() }).unwrap();
    assert_eq!(plan.snapshot_bytes, 3 * 14 * 11 * 4 * 8);
    assert_eq!(Plan::of(&plate()).unwrap().snapshot_bytes, 0);
    let large = Scene { nodes: [1 << 13, 1 << 13], snapshots: two, edges: Edges::default(), ..plate() };
    let wrong = Plan::of(&large).unwrap_err();
    assert!(wrong.key == "snapshot[1].at_s" && wrong.message.contains("at most 4 GiB"), "{wrong:?}");
}
