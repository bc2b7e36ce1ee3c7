//! Forces and held displacements that differ from node to node equal uniform ones where they are uniform, and hold what
//! they say where they are not.

use crate::bodies::{constant, effect, model, scene};
use pd_verify::constraints::{HeldFrame, PrescribedMotion};
use pd_verify::forces::{BodyForce, ForceField};
use pd_verify::march::March;
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::{Effect, History, Initial, Scene, Shape};
use serde_json::json;
use std::sync::Arc;

fn plate(effects: Vec<Arc<dyn Effect<2>>>) -> Scene<2> {
    Scene { effects, ..scene(constant(2.0, VolumeRule::Linear, true), [14, 11]) }
}

fn moved(scene: &Scene<2>, model: &Model<2>) -> Vec<f64> {
    let mut march = March::new(model, scene, 1e-7);
    march.advance_to(40);
    march.displacement().to_vec()
}

/// Whether two scenes move alike, to the last bit.
fn alike(one: &Scene<2>, other: &Scene<2>) -> bool {
    moved(one, &model(one)) == moved(other, &model(other))
}

fn uniform(component: usize, amplitude: f64) -> Initial<2> {
    Initial { component, amplitude, shape: Shape::Uniform }
}

#[test]
fn a_uniform_force_field_is_a_body_force() {
    let history = || History::Ramp { start: 0.0, rise: 1e-6 };
    let field = |fields| Arc::new(ForceField { fields, history: history() }) as Arc<dyn Effect<2>>;
    let push = json!({ "axis": "y", "density_n_m3": 3e8, "history": { "shape": "ramp", "rise_s": 1e-6 } });
    let plain = plate(vec![effect::<2, BodyForce>(push)]);
    assert!(alike(&plain, &plate(vec![field(vec![uniform(1, 1e8), uniform(1, 2e8)])])));
    assert!(!alike(&plain, &plate(vec![field(vec![uniform(1, 3.000_001e8)])])));
    assert!(!alike(&plain, &plate(vec![field(vec![uniform(0, 3e8)])])));
}

#[test]
fn a_frame_is_four_boxes() {
    let dx = plate(Vec::new()).spacing;
    let frame = |layers| {
        let fields = vec![uniform(0, 2e-6), uniform(1, -1e-6)];
        plate(vec![Arc::new(HeldFrame { layers, fields }) as Arc<dyn Effect<2>>])
    };
    let box_of = |axis: &str, displacement: f64, from: [f64; 2], to: [f64; 2]| {
        let corner = |at: [f64; 2]| [at[0] * dx, at[1] * dx];
        effect::<2, PrescribedMotion>(json!({
            "region": { "from_m": corner(from), "to_m": corner(to) },
            "axis": axis, "displacement_m": displacement, "history": { "shape": "step" },
        }))
    };
    let boxes = [
        ([0.0, 0.0], [14.0, 2.0]),
        ([0.0, 9.0], [14.0, 11.0]),
        ([0.0, 2.1], [2.0, 8.9]),
        ([12.0, 2.1], [14.0, 8.9]),
    ];
    let both =
        boxes.iter().flat_map(|&(from, to)| [box_of("x", 2e-6, from, to), box_of("y", -1e-6, from, to)]);
    let four = plate(both.collect());
    assert!(alike(&four, &frame(2)));
    assert!(!alike(&four, &frame(1)));
}

#[test]
fn a_frame_holds_a_field_of_any_shape() {
    let shape = Shape::Monomial { about: [0.01, -0.02], powers: [1, 2] };
    let field = Initial { component: 1, amplitude: 0.3, shape };
    let held = plate(vec![Arc::new(HeldFrame { layers: 3, fields: vec![field] })]);
    let (model, dx) = (model(&held), held.spacing);
    let u = moved(&held, &model);
    for node in [[0, 0], [13, 10], [2, 5], [7, 8]] {
        let place = model.grid.place(node);
        let [x, y] = node.map(|n| (n as f64 + 0.5) * dx);
        let expected = 0.3 * (x - 0.01) * (y + 0.02) * (y + 0.02);
        assert!((u[place + model.grid.stride()] - expected).abs() <= 1e-15 * expected.abs(), "{node:?}");
        assert_eq!(u[place], 0.0);
    }
    assert!(u[model.grid.place([5, 5]) + model.grid.stride()] != 0.0, "the middle follows");
}
