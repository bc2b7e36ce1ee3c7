//! Several steps in one pass, on several threads, are the steps one by one, to the last bit; and so is the pace at which
//! effects that do nothing make a body march.

use crate::bodies::{constant, effect, model, rough, scene};
use crate::checks::same_bits;
use pd_verify::constraints::{Edge, Edges, PrescribedMotion};
use pd_verify::forces::{BodyForce, Damping, Traction};
use pd_verify::ledger::Ledger;
use pd_verify::march::March;
use pd_verify::model::{Inertia, Model};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::{Hole, Notch, Operator, Scene};
use rayon::ThreadPoolBuilder;
use serde_json::json;

/// Not a multiple of the steps in a pass.
const STEPS: u64 = 23;

fn plates() -> Vec<Scene<2>> {
    let bare = scene::<2>(constant(3.0, VolumeRule::Linear, true), [100, 330]);
    let dx = bare.spacing;
    let mirrors = Edges([[Edge::MirrorOdd, Edge::MirrorEven], [Edge::MirrorOdd, Edge::Free]]);
    let around = Edges([[Edge::Free; 2], [Edge::Periodic; 2]]);
    let ramp = json!({ "shape": "ramp", "rise_s": 1e-6 });
    let pull = json!({ "edge": "top", "axis": "y", "stress_pa": 1e6, "history": ramp });
    let held = json!({ "region": { "edge": "left" }, "axis": "x", "displacement_m": 1e-6, "history": ramp });
    let notches = vec![Notch { from: [0.0, 165.0 * dx], to: [40.0 * dx, 165.0 * dx] }];
    let holes = vec![Hole { centre: [70.0 * dx, 100.0 * dx], radius: 7.0 * dx }];
    let busy = vec![
        effect::<2, Traction>(pull),
        effect::<2, PrescribedMotion>(held),
        effect::<2, Damping>(json!({ "rate_per_s": 1e4 })),
    ];
    let cut = Scene { notches, holes, ..bare.clone() };
    vec![
        Scene { edges: mirrors, ..bare.clone() },
        Scene { edges: mirrors, ..cut.clone() },
        Scene { edges: around, ..bare.clone() },
        Scene { effects: busy[..2].to_vec(), ..cut.clone() },
        Scene { effects: busy, operator: Operator::Bonds, ..cut },
        Scene { lattice: constant(9.0, VolumeRule::Linear, true), ..bare },
    ]
}

fn bars() -> Vec<Scene<1>> {
    let long = scene::<1>(constant(3.0, VolumeRule::Linear, true), [40_003]);
    [[Edge::Free; 2], [Edge::MirrorOdd, Edge::MirrorEven], [Edge::Periodic; 2]]
        .map(|edges| Scene { edges: Edges([edges]), ..long.clone() })
        .into()
}

/// The displacements and increments after some steps on so many threads, looked at after every `stride`.
fn after<const D: usize>(scene: &Scene<D>, model: &Model<D>, threads: usize, stride: u64) -> [Vec<f64>; 2] {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let dt = 0.3 * scene.spacing / scene.speed();
    let [u, v] = [1, 2].map(|seed| rough(model, seed, 0.01 * scene.spacing));
    pool.install(|| {
        let mut march = March::from_fields(model, u, v, dt);
        while march.step() < STEPS {
            march.advance_to((march.step() + stride).min(STEPS));
        }
        [march.displacement().to_vec(), march.increment().to_vec()]
    })
}

fn hold<const D: usize>(scenes: Vec<Scene<D>>) {
    for scene in scenes {
        let model = model(&scene);
        let expected = after(&scene, &model, 1, 1);
        for (threads, stride) in [(1, STEPS), (2, 1), (2, STEPS), (3, 5), (7, STEPS)] {
            let what = format!("{:?}, {threads} threads, {stride} steps at once", scene.edges);
            for (own, expected) in after(&scene, &model, threads, stride).iter().zip(&expected) {
                same_bits(&what, own, expected).unwrap();
            }
        }
    }
}

#[test]
fn steps_at_once_are_steps_one_by_one() {
    hold(plates());
    hold(bars());
}

/// Bonds that move the nodes themselves, and bonds whose forces are summed first: a load of nothing, densities written out
/// node by node, and the ledger ask for the second way.
#[test]
fn moving_at_once_is_summing_first() {
    for scene in plates().into_iter().take(2) {
        let own = model(&scene);
        let expected = after(&scene, &own, 1, STEPS);
        let nothing = json!({ "axis": "x", "density_n_m3": 0.0, "history": { "shape": "step" } });
        let loaded = Scene { effects: vec![effect::<2, BodyForce>(nothing)], ..scene.clone() };
        let mut heavy = model(&scene);
        heavy.inertia = Inertia::Diagonal(vec![scene.material.density; heavy.grid.len()]);
        for other in [model(&loaded), heavy] {
            for (own, expected) in after(&scene, &other, 2, STEPS).iter().zip(&expected) {
                same_bits("summed first", own, expected).unwrap();
            }
        }
        let dt = 0.3 * scene.spacing / scene.speed();
        let [u, v] = [1, 2].map(|seed| rough(&own, seed, 0.01 * scene.spacing));
        let (mut march, mut ledger) = (March::from_fields(&own, u, v, dt), Ledger::new(&own));
        (0..STEPS).for_each(|_| march.advance_booked(&mut ledger));
        same_bits("booked", march.displacement(), &expected[0]).unwrap();
    }
}
