//! Probes, held against fields that they must reproduce and against the pace that they were given.

use crate::bodies::{constant, effect, scene};
use pd_verify::constraints::{Edge, Edges, PrescribedMotion};
use pd_verify::forces::BodyForce;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::record::run;
use pd_verify::scene::{Initial, Probe, Scene, Shape, Watch};
use serde_json::json;

/// Points see linear fields exactly, between nodes and beyond the outermost; strains too; each at its own pace.
#[test]
fn probes_see_linear_fields_exactly() {
    let linear =
        |component, along, amplitude| Initial { component, amplitude, shape: Shape::Linear { along } };
    let plate = scene::<2>(constant(2.0, VolumeRule::Linear, false), [12, 10]);
    let dx = plate.spacing;
    let points = [[0.0, 0.0], [3.3, 4.7], [12.0, 10.0], [0.5, 9.9], [6.0, 2.5]].map(|at| at.map(|n| n * dx));
    let mut probes: Vec<_> =
        points.iter().enumerate().map(|(n, &at)| probe(n.to_string(), Watch::Point { at }, 3)).collect();
    probes.push(probe("line".into(), Watch::Line { along: 1, through: 3.2 * dx }, 5));
    let displacement = vec![linear(0, 0, 1e-3), linear(0, 1, -2e-3), linear(1, 0, 5e-4)];
    let record = run(&Scene { displacement, probes, ..plate.clone() }).unwrap();
    let near = |a: f64, b: f64| (a - b).abs() <= 8.0 * f64::EPSILON * 3e-3 * 12.0 * dx;
    for (n, at) in points.iter().enumerate() {
        let trace = record.trace(&n.to_string()).unwrap();
        assert!(near(trace.rows[0][0], 1e-3 * at[0] - 2e-3 * at[1]) && near(trace.rows[0][1], 5e-4 * at[0]));
        assert_eq!(trace.rows.len() as u64, record.plan.steps.div_ceil(3) + 1);
        for (k, t) in trace.times.iter().enumerate() {
            assert_eq!(*t, (3 * k as u64).min(record.plan.steps) as f64 * record.plan.time_step_s);
        }
    }
    let line = record.trace("line").unwrap();
    assert_eq!((line.columns.len(), line.rows.len() as u64), (20, record.plan.steps.div_ceil(5) + 1));
    // The column through 3.2 Δx has its nodes at 3.5 Δx.
    assert!(near(line.rows[0][6], 1e-3 * 3.5 * dx - 2e-3 * 3.5 * dx));
    assert_eq!(line.columns[6].at, Some(vec![3.5 * dx, 3.5 * dx]));

    let bar = scene::<1>(constant(2.0, VolumeRule::Linear, false), [12]);
    let displacement = vec![Initial { component: 0, amplitude: 1e-3, shape: Shape::Linear { along: 0 } }];
    let ats = [0.0, 1.0, 4.0, 4.3, 12.0];
    let probes = ats.map(|n| probe(n.to_string(), Watch::Strain { at: n * dx }, 1)).to_vec();
    let record = run(&Scene { displacement, probes, ..bar.clone() }).unwrap();
    for n in ats {
        let seen = record.trace(&n.to_string()).unwrap().rows[0][0];
        assert!((seen / 1e-3 - 1.0).abs() < 100.0 * f64::EPSILON, "{n} {seen:e}");
    }
    // A jump: the face that holds it sees all of it, three quarters of a cell away a quarter is seen.
    let push = json!({ "axis": "x", "density_n_m3": 1e9, "history": { "shape": "step" } });
    let region = json!({ "from_m": [0.0], "to_m": [4.0 * dx] });
    let motion =
        json!({ "region": region, "axis": "x", "displacement_m": 1e-5, "history": { "shape": "step" } });
    let held = vec![effect::<1, PrescribedMotion>(motion), effect::<1, BodyForce>(push)];
    let probes =
        [3.0, 3.25, 4.0, 5.0].map(|n| probe(n.to_string(), Watch::Strain { at: n * dx }, 1)).to_vec();
    let record = run(&Scene { effects: held, probes, ..bar }).unwrap();
    // Nodes 0 to 3 are displaced by 1e-5, the rest by nothing: all strain is on the face at 4 Δx.
    let seen = ["3", "3.25", "4", "5"].map(|n| record.trace(n).unwrap().rows[0][0] / (-1e-5 / dx));
    for (seen, expected) in seen.iter().zip([0.0, 0.25, 1.0, 0.0]) {
        assert!((seen - expected).abs() < 1e-12, "{seen}");
    }
}

fn probe<const D: usize>(name: String, watch: Watch<D>, every: u64) -> Probe<D> {
    Probe { name, watch, every }
}

/// Across an edge that mirrors or repeats the body probes see its ghosts.
#[test]
fn probes_see_across_edges() {
    let bar = scene::<1>(constant(2.0, VolumeRule::Linear, false), [10]);
    let dx = bar.spacing;
    let displacement = vec![Initial { component: 0, amplitude: 1e-3, shape: Shape::Linear { along: 0 } }];
    let probes = vec![
        probe("held".into(), Watch::Point { at: [0.0] }, 1),
        probe("end".into(), Watch::Point { at: [10.0 * dx] }, 1),
        probe("strain".into(), Watch::Strain { at: 10.0 * dx }, 1),
        probe("first".into(), Watch::Strain { at: 0.0 }, 1),
    ];
    let mirrored = Scene {
        edges: Edges([[Edge::MirrorOdd, Edge::MirrorEven]]),
        displacement: displacement.clone(),
        probes: probes.clone(),
        ..bar.clone()
    };
    let record = run(&mirrored).unwrap();
    let seen = |name: &str| record.trace(name).unwrap().column(0);
    assert!(seen("held").iter().all(|u| *u == 0.0) && seen("strain").iter().all(|strain| *strain == 0.0));
    assert!(
        (seen("end")[0] / (9.5e-3 * dx) - 1.0).abs() < 1e-14 && (seen("first")[0] / 1e-3 - 1.0).abs() < 1e-13
    );
    let ring = Scene { edges: Edges([[Edge::Periodic, Edge::Periodic]]), displacement, probes, ..bar };
    let record = run(&ring).unwrap();
    let seen = |name: &str| record.trace(name).unwrap().column(0);
    let near = |a: Vec<f64>, b: Vec<f64>, slack: f64| a.iter().zip(&b).all(|(a, b)| (a - b).abs() <= slack);
    assert!(near(seen("held"), seen("end"), 1e-15 * dx) && seen("held").len() > 10);
    assert!(near(seen("first"), seen("strain"), 1e-15));
}
