//! Tractions on the faces of notches, held against coordinates, sums that must vanish, and plates pulled at their edges.

use crate::bodies::{constant, effect, model, scene};
use pd_verify::breaking::Broken;
use pd_verify::constraints::PrescribedMotion;
use pd_verify::field::Window;
use pd_verify::forces::{FaceTraction, Now, Traction};
use pd_verify::march::March;
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::scene::{Effect, Hole, Notch, Rotations, Scene};
use serde_json::{Value, json};
use std::sync::Arc;

fn plate(notch: Notch, effects: Vec<Arc<dyn Effect<2>>>) -> Scene<2> {
    let plate = scene::<2>(constant(3.0, VolumeRule::Linear, false), [21, 18]);
    let of = |end: [f64; 2]| end.map(|x| x * plate.spacing);
    Scene { notches: vec![Notch { from: of(notch.from), to: of(notch.to) }], effects, ..plate }
}

/// In spacings.
fn notch(from: [f64; 2], to: [f64; 2]) -> Notch {
    Notch { from, to }
}

fn faces(normal: f64, shear: f64) -> Arc<dyn Effect<2>> {
    effect::<2, FaceTraction>(
        json!({ "normal_pa": normal, "shear_pa": shear, "history": { "shape": "step" } }),
    )
}

/// The force of a body that has not moved, each node with its place in spacings.
fn loads(scene: &Scene<2>, own: &Model<2>) -> Vec<([f64; 2], [f64; 2])> {
    let still = own.grid.field();
    let at_rest = Window::from(&still);
    let mut field = own.grid.field();
    let now =
        Now { displacement: at_rest, increment: at_rest, time: 0.0, time_step: 1e-7, broken: Broken::none() };
    own.force(&now, &mut field);
    let of = |node| {
        let place = own.grid.place(node);
        (own.grid.position(node).map(|x| x / scene.spacing), [field[place], field[place + own.grid.stride()]])
    };
    own.grid.each().map(of).collect()
}

/// Each of four directions, by coordinates: x along the notch from where it starts, y to its left.
#[test]
fn cells_beside_the_notch_are_loaded_and_no_others() {
    let (normal, shear) = (7.0, 3.0);
    for (notch, ahead) in [
        (notch([0.0, 9.0], [8.25, 9.0]), [1.0, 0.0]),
        (notch([12.5, 4.5], [2.0, 4.5]), [-1.0, 0.0]),
        (notch([5.0, 3.0], [5.0, 12.0]), [0.0, 1.0]),
        (notch([7.3, 17.0], [7.3, 6.4]), [0.0, -1.0]),
    ] {
        let plate = plate(notch, vec![faces(normal, shear)]);
        let length = (notch.to[0] - notch.from[0]).hypot(notch.to[1] - notch.from[1]);
        let (mut total, mut moment, mut loaded) = ([0.0; 2], 0.0, 0.0);
        for (at, force) in loads(&plate, &model(&plate)) {
            let from = [at[0] - notch.from[0], at[1] - notch.from[1]];
            let x = from[0] * ahead[0] + from[1] * ahead[1];
            let y = ahead[0] * from[1] - ahead[1] * from[0];
            // A cell of one spacing about x, of which the notch covers a part; a node on the line is on the left.
            let part = ((x + 0.5).min(length) - (x - 0.5).max(0.0)).max(0.0);
            let side = if (-1e-9..1.0 - 1e-9).contains(&y) {
                1.0
            } else if (-1.0 - 1e-9..-1e-9).contains(&y) {
                -1.0
            } else {
                0.0
            };
            let scale = side * part / plate.spacing;
            let expected = [
                scale * (shear * ahead[0] - normal * ahead[1]),
                scale * (shear * ahead[1] + normal * ahead[0]),
            ];
            for axis in 0..2 {
                let bound = 1e-12 * (normal + shear) / plate.spacing;
                assert!((force[axis] - expected[axis]).abs() <= bound, "{notch:?} {at:?}: {force:?}");
                total[axis] += force[axis];
            }
            moment += at[0] * force[1] - at[1] * force[0];
            loaded += part * f64::from(side != 0.0);
        }
        assert!((loaded - 2.0 * length).abs() < 1e-9);
        assert!(total.iter().all(|sum| sum.abs() <= 1e-13 * normal * length / plate.spacing), "{total:?}");
        let expected = -shear * length / plate.spacing;
        assert!((moment / expected - 1.0).abs() < 1e-11, "{moment:e} {expected:e}");
    }
}

#[test]
fn pairs_cancel_to_the_last_bit() {
    let plate = plate(notch([0.0, 9.0], [8.3, 9.0]), vec![faces(1e6 / 3.0, -1e5 / 7.0)]);
    let loads = loads(&plate, &model(&plate));
    let near = |x: f64, y: f64| loads.iter().find(|(at, _)| (at[0] - x).hypot(at[1] - y) < 1e-9).unwrap().1;
    for column in 0..9 {
        let (upper, lower) = (near(column as f64 + 0.5, 9.5), near(column as f64 + 0.5, 8.5));
        assert!(upper[0] != 0.0 && upper[1] > 0.0 && upper.map(|f| -f) == lower, "{column}");
    }
    assert_eq!(near(9.5, 9.5), [0.0; 2]);
}

fn moved(scene: &Scene<2>, model: &Model<2>, steps: u64) -> Vec<f64> {
    let mut march = March::new(model, scene, 2e-7);
    march.advance_to(steps);
    march.displacement().to_vec()
}

/// Above a cut from edge to edge lies a plate of its own, pulled at its bottom.
#[test]
fn a_face_is_an_edge() {
    for rotations in [Rotations::Small, Rotations::Finite] {
        let through = notch([0.0, 8.0], [21.0, 8.0]);
        let cut = Scene { rotations, ..plate(through, vec![faces(2e6, -1e6)]) };
        let history = json!({ "shape": "step" });
        let pull = |axis: &str, stress: f64| {
            let asked = json!({ "edge": "bottom", "axis": axis, "stress_pa": stress, "history": history });
            effect::<2, Traction>(asked)
        };
        let upper = Scene {
            nodes: [21, 10],
            notches: vec![],
            effects: vec![pull("y", 2e6), pull("x", -1e6)],
            ..cut.clone()
        };
        let (whole, half) = (model(&cut), model(&upper));
        let (u, v) = (moved(&cut, &whole, 50), moved(&upper, &half, 50));
        let largest = v.iter().map(|v| v.abs()).fold(0.0, f64::max);
        assert!(largest > 1e-9);
        for node in half.grid.each() {
            for axis in 0..2 {
                let a = u[whole.grid.place([node[0], node[1] + 8]) + axis * whole.grid.stride()];
                let b = v[half.grid.place(node) + axis * half.grid.stride()];
                assert!((a - b).abs() <= 1e-12 * largest, "{node:?}: {a:e} {b:e}");
            }
        }
    }
}

/// What is positive opens the notch, and makes its left go forwards.
#[test]
fn signs_are_those_that_are_said() {
    let opens = |notch: Notch, left: [isize; 2], right: [isize; 2], normal: f64, shear: f64| -> [f64; 2] {
        let plate = plate(notch, vec![faces(normal, shear)]);
        let own = model(&plate);
        let u = moved(&plate, &own, 30);
        [0, 1].map(|axis| {
            let at = |node| u[own.grid.place(node) + axis * own.grid.stride()];
            at(left) - at(right)
        })
    };
    let along_x = notch([0.0, 9.0], [8.0, 9.0]);
    let opening = opens(along_x, [2, 9], [2, 8], 1e6, 0.0);
    assert!(opening[1] > 1e-9 && opening[0].abs() < opening[1]);
    let sliding = opens(along_x, [2, 9], [2, 8], 0.0, 1e6);
    assert!(sliding[0] > 1e-9 && sliding[1].abs() < 1e-9 * sliding[0], "{sliding:?}");
    // Downwards, the left lies towards +x.
    let down = notch([10.0, 18.0], [10.0, 9.0]);
    assert!(opens(down, [10, 15], [9, 15], 1e6, 0.0)[0] > 1e-9);
    assert!(opens(down, [10, 15], [9, 15], 0.0, 1e6)[1] < -1e-9);
}

#[test]
fn no_traction_is_none_and_a_late_one_comes_late() {
    let at = notch([0.0, 9.0], [8.0, 9.0]);
    let start = vec![pd_verify::scene::Initial {
        component: 0,
        amplitude: 1e-6,
        shape: pd_verify::scene::Shape::Gaussian { centre: [0.03, 0.03], sharpness: 1e4 },
    }];
    let with = |effects| Scene { displacement: start.clone(), ..plate(at, effects) };
    let run = |scene: &Scene<2>, steps| moved(scene, &model(scene), steps);
    let (nothing, zero) = (with(vec![]), with(vec![faces(0.0, 0.0)]));
    assert_eq!(run(&nothing, 40), run(&zero, 40));
    let late = json!({ "normal_pa": 1e6, "history": { "shape": "step", "start_s": 4.1e-6 } });
    let late = with(vec![effect::<2, FaceTraction>(late)]);
    assert_eq!(run(&nothing, 20), run(&late, 20));
    assert_ne!(run(&nothing, 23), run(&late, 23));
}

#[test]
fn faces_that_cannot_be_loaded() {
    let refuse = |scene: Scene<2>, key: &str, words: &str| {
        let wrong = Plan::of(&scene).unwrap_err();
        assert!(wrong.key == key && wrong.message.contains(words) && !wrong.help.is_empty(), "{wrong:?}");
    };
    let asked = |more: Value| {
        let mut asked = json!({ "history": { "shape": "step" } });
        more.as_object().unwrap().iter().for_each(|(key, value)| asked[key] = value.clone());
        vec![effect::<2, FaceTraction>(asked)]
    };
    let at = notch([0.0, 9.0], [8.0, 9.0]);
    let pull = || asked(json!({ "normal_pa": 1e6 }));
    assert!(Plan::of(&plate(at, pull())).unwrap().effects_on.contains(&"face traction".to_owned()));
    refuse(Scene { notches: vec![], ..plate(at, pull()) }, "effect[0].notch", "there is no notch whose");
    let second = asked(json!({ "normal_pa": 1e6, "notch": 1 }));
    refuse(plate(at, second), "effect[0].notch", "there is no notch 1");
    refuse(plate(notch([0.0, 9.0], [8.0, 9.1]), pull()), "effect[0].notch", "at an angle");
    for y in [0.0, 0.4, 17.6, 18.0] {
        refuse(plate(notch([0.0, y], [8.0, y]), pull()), "effect[0].notch", "one face only");
    }
    refuse(plate(at, asked(json!({}))), "effect[0]", "loads nothing");
    let bar = scene::<1>(constant(2.0, VolumeRule::Linear, false), [20]);
    let step = json!({ "shape": "step" });
    let asked_of_bar = effect::<1, FaceTraction>(json!({ "normal_pa": 1.0, "history": step }));
    let wrong = Plan::of(&Scene { effects: vec![asked_of_bar], ..bar }).unwrap_err();
    assert_eq!(wrong.key, "effect[0].notch");
    let dx = plate(at, vec![]).spacing;
    let hole = |x: f64, y: f64, radius: f64| Hole { centre: [x * dx, y * dx], radius: radius * dx };
    let swallowed = Scene { holes: vec![hole(2.0, 9.0, 7.5)], ..plate(at, pull()) };
    refuse(swallowed, "effect[0].notch", "holes have removed");
    // A hole above takes the load of what it removes and of what lies across.
    let above = Scene { holes: vec![hole(3.0, 11.0, 2.0)], ..plate(at, pull()) };
    let loads = loads(&above, &model(&above));
    let loaded = loads.iter().filter(|(_, force)| force[1] != 0.0).count();
    let total: f64 = loads.iter().map(|(_, force)| force[1]).sum();
    assert!(loaded == 2 * (8 - 2) && total.abs() <= 1e-14 * 1e6 / dx, "{loaded} {total}");
    let region = json!({ "from_m": [0.0, 8.0 * dx], "to_m": [8.0 * dx, 10.0 * dx] });
    let hold =
        json!({ "region": region, "axis": "y", "displacement_m": 0.0, "history": { "shape": "step" } });
    let held = vec![pull().remove(0), effect::<2, PrescribedMotion>(hold)];
    refuse(plate(at, held), "effect[0].axis", "the face traction does nothing");
}
