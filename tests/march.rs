//! The march held against exact motions of the lattice: modes of a bar, plane waves of a plate; edges held against the
//! larger bodies that they stand for, driven nodes against their history, small rotations against finite ones, a pulled
//! bar against its section forces.

#[path = "conformance/bodies.rs"]
#[allow(dead_code)]
mod bodies;

use bodies::{constant, effect, field, force, model, places, rough, scene};
use pd_verify::constraints::Edge::{Free, MirrorEven, MirrorOdd, Periodic};
use pd_verify::constraints::{Edges, PrescribedMotion};
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{Damping, Traction};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::march::March;
use pd_verify::material::{Body, Material};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::record::run;
use pd_verify::scene::{Initial, Operator, Probe, Rotations, Scene, Shape, StepRule, Time, Watch};
use pd_verify::statics;
use pd_verify_reference as reference;
use serde_json::json;
use std::f64::consts::{PI, TAU};

fn bar(operator: Operator) -> Scene<1> {
    Scene {
        name: "released bar".into(),
        material: Material { youngs_modulus: 200e9, density: 7850.0 },
        body: Body::Bar,
        lattice: Lattice {
            kernel: Kernel::Gaussian { p: 2.0 },
            m: 5.0,
            volume_rule: VolumeRule::Full,
            calibrated: true,
        },
        nodes: [80],
        spacing: 1.0 / 80.0,
        section: 1e-6,
        rotations: Rotations::Small,
        operator,
        edges: Edges([[MirrorOdd, MirrorEven]]),
        notches: vec![],
        running: vec![],
        holes: vec![],
        surface: Correction::None,
        displacement: vec![Initial { component: 0, amplitude: 1e-3, shape: Shape::Linear { along: 0 } }],
        velocity: vec![],
        effects: vec![],
        time: Time { duration: 0.8e-3, step: StepRule::OfLimit(0.8) },
        probes: vec![
            Probe { name: "all".into(), watch: Watch::Line { along: 0, through: 0.0 }, every: 7 },
            Probe { name: "energy".into(), watch: Watch::Energies, every: 1 },
        ],
        snapshots: vec![],
    }
}

#[test]
fn a_released_bar_moves_in_the_modes_of_its_lattice() {
    for operator in [Operator::Stencil, Operator::Bonds] {
        let scene = bar(operator);
        let record = run(&scene).unwrap();
        let of = reference::Lattice {
            kernel: reference::Kernel::Gaussian { p: 2.0 },
            m: 5.0,
            rule: reference::VolumeRule::Full,
            calibrated: true,
        };
        let courant = scene.speed() * record.plan.time_step_s / scene.spacing;
        let modes = reference::released_bar::LatticeModes::new(of, 80, Some(courant)).unwrap();
        let trace = record.trace("all").unwrap();
        assert!(trace.times.len() > 30);
        let mut worst = 0.0_f64;
        for (t, row) in trace.times.iter().zip(&trace.rows) {
            for (j, u) in row.iter().enumerate() {
                let exact = 1e-3 * modes.displacement(j, scene.speed() * t / scene.spacing);
                worst = worst.max((u - exact).abs() / 1e-3);
            }
        }
        assert!(worst < 1e-12, "{worst:e}");
        let energy = record.trace("energy").unwrap();
        let closed: Vec<f64> =
            energy.rows.iter().map(|row| row[0] + row[1] - row[2] - row[3] - row[4]).collect();
        let drift = closed.iter().map(|e| (e / closed[0] - 1.0).abs()).fold(0.0, f64::max);
        assert!(drift < 1e-11);
    }
}

/// n⊗n sums of the lattice's own weights at a wave vector: the smaller and the larger ω² with their polarizations.
fn polarizations(lattice: Lattice, theta: [f64; 2]) -> [(f64, [f64; 2]); 2] {
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for bond in Stencil::<2>::new(lattice).unwrap().bonds {
        let [x, y] = bond.offset.map(f64::from);
        let half = libm::sin(0.5 * (x * theta[0] + y * theta[1]));
        let weight = 4.0 * bond.weight * half * half / (x * x + y * y);
        (xx, xy, yy) = (xx + weight * x * x, xy + weight * x * y, yy + weight * y * y);
    }
    let turn = 0.5 * libm::atan2(2.0 * xy, xx - yy);
    let (s, c) = (libm::sin(turn), libm::cos(turn));
    let along = |e: [f64; 2]| (e[0] * e[0] * xx + 2.0 * e[0] * e[1] * xy + e[1] * e[1] * yy, e);
    [along([-s, c]), along([c, s])]
}

/// A wave of one mode: u = A e cos(k·x − ω't) with sin(ω'Δt/2) = ωΔt/2. March starts it from u(0) and from
/// (u(Δt) − u(−Δt))/2 = A e sin(k·x) sin ω'Δt. The frequency is the reference's; e is an eigenvector, whose ω² must be
/// the same. 1e-12: some hundred steps, each good to a few roundings of the amplitude.
#[test]
fn plane_waves_travel_as_the_lattice_says() {
    let steps = 200;
    let mut tried = 0;
    for (m, volume_rule, rule) in [
        (3.0, VolumeRule::Full, reference::VolumeRule::Full),
        (3.015, VolumeRule::Linear, reference::VolumeRule::Linear),
    ] {
        for operator in [Operator::Stencil, Operator::Bonds] {
            for [p, q] in [[1.0, 0.0], [0.0, 2.0], [3.0, 3.0], [2.0, 1.0], [5.0, -3.0]] {
                let of =
                    reference::Lattice { kernel: reference::Kernel::Constant, m, rule, calibrated: true };
                let plate = scene::<2>(constant(m, volume_rule, true), [20, 20]);
                let plate = Scene { operator, edges: Edges([[Periodic; 2]; 2]), ..plate };
                let theta = [p, q].map(|n| TAU * n / 20.0);
                let length = f64::hypot(theta[0], theta[1]);
                let [fast, slow] = reference::lattice::plane(of, length, libm::atan2(q, p));
                let waves = polarizations(plate.lattice, theta);
                for (square, e) in [(fast.omega.powi(2), waves[1]), (slow.omega.powi(2) / 3.0, waves[0])].map(
                    |(square, (own, e))| {
                        assert!((own / square - 1.0).abs() < 1e-12, "{own} {square}");
                        (square, e)
                    },
                ) {
                    let (model, dt) = (model(&plate), Plan::of(&plate).unwrap().time_step_s);
                    let half = 0.5 * square.sqrt() * dt * plate.speed() / plate.spacing;
                    let turn = 2.0 * libm::asin(half);
                    let phase = |x: [f64; 2]| (theta[0] * x[0] + theta[1] * x[1]) / plate.spacing;
                    let wave =
                        |time: f64| field(&model, |x| e.map(|e| 1e-5 * e * libm::cos(phase(x) - time)));
                    let velocity =
                        field(&model, |x| e.map(|e| 1e-5 * e * libm::sin(phase(x)) * libm::sin(turn)));
                    let mut march = March::from_fields(&model, wave(0.0), velocity, dt);
                    march.advance_to(steps);
                    let exact = wave(steps as f64 * turn);
                    let off = |at: &usize| (march.displacement()[*at] - exact[*at]).abs() / 1e-5;
                    let worst = places(&model.grid).iter().map(off).fold(0.0, f64::max);
                    assert!(worst < 1e-12, "m = {m} {p} {q}: {worst:e}");
                    tried += 1;
                }
            }
        }
    }
    assert_eq!(tried, 40);
}

/// Of a field of size a the two laws make forces that differ by terms in a²: ten times smaller, a hundred times less. So
/// do their motions.
#[test]
fn finite_rotations_become_small_ones() {
    let small = scene::<2>(constant(3.0, VolumeRule::Linear, true), [11, 9]);
    let small = Scene { edges: Edges([[MirrorOdd, Free], [Free, Free]]), ..small };
    let models =
        [Rotations::Small, Rotations::Finite].map(|rotations| model(&Scene { rotations, ..small.clone() }));
    let dt = Plan::of(&small).unwrap().time_step_s;
    let differences = [1e-3, 1e-4, 1e-5].map(|share| {
        let u = rough(&models[0], 1, share * small.spacing);
        let moved = models.each_ref().map(|model| {
            let mut march = March::from_fields(model, u.clone(), model.grid.field(), dt);
            march.advance_to(40);
            march.displacement().to_vec()
        });
        let forces = models.each_ref().map(|model| force(model, &u));
        [forces, moved]
            .map(|[a, b]| places(&models[0].grid).iter().map(|&at| (a[at] - b[at]).abs()).fold(0.0, f64::max))
    });
    for kind in 0..2 {
        for pair in differences.windows(2) {
            let fall = pair[0][kind] / pair[1][kind];
            assert!((fall - 100.0).abs() < 3.0, "{fall}");
        }
    }
}

/// A driven node is where its history says at every step, to the rounding of u + (target − u).
#[test]
fn driven_nodes_follow_their_history() {
    let table = json!({ "shape": "table", "times_s": [0.0, 1e-5, 3e-5], "values": [0.25, -1.0, 2.0] });
    let region = json!({ "edge": "top" });
    let motion = json!({ "region": region, "axis": "x", "displacement_m": 1e-4, "history": table });
    let plate = scene::<2>(constant(2.0, VolumeRule::Linear, false), [9, 7]);
    let scene = Scene { effects: vec![effect::<2, PrescribedMotion>(motion)], ..plate };
    let (model, dt) = (model(&scene), Plan::of(&scene).unwrap().time_step_s);
    let mut march = March::from_fields(&model, model.grid.field(), model.grid.field(), dt);
    let history = |t: f64| match t {
        t if t < 1e-5 => 0.25 - 1.25 * t / 1e-5,
        t if t < 3e-5 => -1.0 + 3.0 * (t - 1e-5) / 2e-5,
        _ => 2.0,
    };
    for step in 0..100 {
        march.advance_to(step);
        for x in 0..9 {
            let place = model.grid.place([x, 6]);
            let (u, target) = (march.displacement()[place], 1e-4 * history(march.time()));
            assert!((u - target).abs() <= 8.0 * f64::EPSILON * 2e-4, "{step} {u:e} {target:e}");
            // Only x is driven.
            assert!(step < 10 || x == 4 || march.displacement()[place + model.grid.stride()] != 0.0);
        }
    }
    assert!(march.time() > 3e-5);
}

/// The motion of a body from a rough start, and of one twice as long whose left half is the image of its right half:
/// x → −x, u of the given sign (−1 odd, 1 even) along x, the opposite across.
fn doubled<const D: usize>(half: &Scene<D>, sign: f64, far: pd_verify::constraints::Edge) -> [Vec<f64>; 2] {
    let mut nodes = half.nodes;
    nodes[0] *= 2;
    let mut whole = Scene { nodes, ..half.clone() };
    whole.edges.0[0] = [far, far];
    let (own, dt) = (model(half), Plan::of(half).unwrap().time_step_s);
    let start = [1, 2].map(|seed| rough(&own, seed, 0.02 * half.spacing));
    let model = model(&whole);
    let image = |field: &Vec<f64>| {
        let mut long = model.grid.field();
        for node in model.grid.each() {
            let (mut from, count) = (node, half.nodes[0] as isize);
            from[0] = if node[0] < count { count - 1 - node[0] } else { node[0] - count };
            for axis in 0..D {
                let turned = if node[0] >= count {
                    1.0
                } else if axis == 0 {
                    sign
                } else {
                    -sign
                };
                long[model.grid.place(node) + axis * model.grid.stride()] =
                    turned * field[own.grid.place(from) + axis * own.grid.stride()];
            }
        }
        model.fill_ghosts(&mut long);
        long
    };
    let mut marches = [
        March::from_fields(&own, start[0].clone(), start[1].clone(), dt),
        March::from_fields(&model, image(&start[0]), image(&start[1]), dt),
    ];
    marches.iter_mut().for_each(|march| march.advance_to(150));
    let right = own.grid.each().flat_map(|node| {
        let mut far = node;
        far[0] += half.nodes[0] as isize;
        (0..D).map(move |axis| (node, far, axis))
    });
    let pairs = right.map(|(node, far, axis)| {
        let one = marches[0].displacement()[own.grid.place(node) + axis * own.grid.stride()];
        (one, marches[1].displacement()[model.grid.place(far) + axis * model.grid.stride()])
    });
    let (one, other): (Vec<f64>, Vec<f64>) = pairs.unzip();
    [one, other]
}

/// In a bar without missing bonds the sums are the same sums and so are the bits, but for an even mirror with the exact
/// law, where a bond that opens has an image that closes. Near a free end, and in a plate, a node adds its bonds in the
/// order of the family and its image in another: 1e-12 of the amplitude after 150 steps, each good to a few roundings.
/// With the image's sign turned it is another motion.
#[test]
fn a_mirrored_body_is_half_of_a_larger_one() {
    for (mirror, sign) in [(MirrorOdd, -1.0), (MirrorEven, 1.0)] {
        for rotations in [Rotations::Small, Rotations::Finite] {
            for far in [MirrorOdd, MirrorEven, Free] {
                let bar = scene::<1>(constant(3.0, VolumeRule::Linear, true), [23]);
                let [one, other] =
                    doubled(&Scene { rotations, edges: Edges([[mirror, far]]), ..bar.clone() }, sign, far);
                let exactly = far != Free && (rotations == Rotations::Small || mirror == MirrorOdd);
                assert!(same(&one, &other, exactly), "{mirror:?} {rotations:?} {far:?}");
                let [one, other] =
                    doubled(&Scene { rotations, edges: Edges([[mirror, far]]), ..bar }, -sign, far);
                assert!(!same(&one, &other, false));
                let plate = scene::<2>(constant(2.0, VolumeRule::Linear, true), [9, 8]);
                for across in [[Periodic; 2], [Free, MirrorOdd]] {
                    let edges = Edges([[mirror, far], across]);
                    if rotations == Rotations::Small || !edges.0.as_flattened().contains(&MirrorEven) {
                        let [one, other] = doubled(&Scene { rotations, edges, ..plate.clone() }, sign, far);
                        assert!(same(&one, &other, false));
                    }
                }
            }
        }
    }
}

fn same(one: &[f64], other: &[f64], bits: bool) -> bool {
    let largest = one.iter().fold(0.0, |largest: f64, u| largest.max(u.abs()));
    let near = |(a, b): (&f64, &f64)| if bits { a == b } else { (a - b).abs() <= 1e-12 * largest };
    one.iter().zip(other).all(near)
}

/// A bar held by its plane of symmetry on the left and pulled on the right by σ.
fn pulled(m: f64, volume_rule: VolumeRule) -> Scene<1> {
    let pull = json!({ "edge": "right", "axis": "x", "stress_pa": 1e7, "history": { "shape": "step" } });
    let effects = vec![effect::<1, Traction>(pull)];
    let bar = scene::<1>(constant(m, volume_rule, true), [30]);
    Scene { effects, edges: Edges([[MirrorOdd, Free]]), ..bar }
}

/// At rest a chain of nearest neighbours strains by σ/E everywhere; with any family the bonds that cross a cut carry σ.
/// Let go at once, it swings about that rest, and damping brings it there.
#[test]
fn a_pulled_bar_comes_to_rest() {
    for (m, rule) in [(1.0, VolumeRule::Full), (3.0, VolumeRule::Full), (3.6, VolumeRule::Linear)] {
        let scene = pulled(m, rule);
        let (model, dx, young) = (model(&scene), scene.spacing, scene.material.youngs_modulus);
        let rest = statics::rest(&model, 1e-14, 200).unwrap().displacement;
        let u = |node: isize| rest[model.grid.place([node])];
        let stencil = Stencil::<1>::new(scene.lattice).unwrap();
        for cut in 1..30 {
            let mut carried = 0.0;
            for bond in &stencil.bonds {
                let reach = bond.offset[0] as isize;
                for from in (cut - reach).max(-reach)..cut.min(30 - reach) {
                    carried += bond.weight * young / (dx * dx) * (u(from + reach) - u(from)) * dx;
                }
            }
            // What is left of the force by the recurrences of conjugate gradients, 1e-14, is known to the rounding of a
            // matrix of condition 30²: 1e-12 or less.
            assert!((carried / 1e7 - 1.0).abs() < 1e-12, "m = {m}, cut {cut}: {carried:e}");
            if m == 1.0 {
                assert!(((u(cut) - u(cut - 1)) / dx / (1e7 / young) - 1.0).abs() < 1e-12);
            }
        }
        let mut effects = scene.effects.clone();
        // Beyond the slowest mode's critical damping by a little, all modes decay like e^(−αt/2).
        let slowest = PI * scene.speed() / (2.0 * 30.0 * dx);
        effects.push(effect::<1, Damping>(json!({ "rate_per_s": 1.8 * slowest })));
        let time = Time { duration: 40.0 / (0.9 * slowest), step: StepRule::OfLimit(0.9) };
        let damped = Scene { effects, time, ..scene.clone() };
        let own = self::model(&damped);
        let plan = Plan::of(&damped).unwrap();
        let mut march = March::new(&own, &damped, plan.time_step_s);
        march.advance_to(plan.steps);
        let largest = u(29);
        // e⁻³⁶ of the start is left.
        for node in 0..30 {
            let now = march.displacement()[own.grid.place([node])];
            assert!((now - u(node)).abs() < 1e-13 * largest, "{now:e} {:e}", u(node));
        }
    }
}

/// Undamped and let go, a chain of nearest neighbours swings about its rest: u − u_rest is a sum of modes, whose mean over
/// a long time falls like the slowest period over the time.
#[test]
fn a_suddenly_pulled_bar_strains_on_average_as_at_rest() {
    let scene = pulled(1.0, VolumeRule::Full);
    let length = 30.0 * scene.spacing;
    let period = 4.0 * length / scene.speed();
    let time = Time { duration: 100.0 * period, step: StepRule::OfLimit(0.9) };
    let probes =
        vec![Probe { name: "mid".into(), watch: Watch::Strain { at: 15.0 * scene.spacing }, every: 1 }];
    let record = run(&Scene { time, probes, ..scene.clone() }).unwrap();
    let strains = record.trace("mid").unwrap().column(0);
    let mean = strains.iter().sum::<f64>() / strains.len() as f64;
    let rest = 1e7 / scene.material.youngs_modulus;
    assert!((mean / rest - 1.0).abs() < 0.01, "{}", mean / rest);
    // A wave of strain σ/E runs in, and comes back from the fixed end twice as high.
    let most = strains.iter().copied().fold(0.0, f64::max);
    assert!(most > 1.9 * rest && most < 3.0 * rest, "{}", most / rest);
}

/// Damping does nothing to a body at rest.
#[test]
fn a_damped_body_has_the_same_rest() {
    let scene = pulled(3.0, VolumeRule::Full);
    let mut damped = scene.clone();
    damped.effects.push(effect::<1, Damping>(json!({ "rate_per_s": 1e4 })));
    let [own, other] = [&scene, &damped].map(|scene| statics::rest(&model(scene), 1e-12, 200).unwrap());
    assert_eq!(own, other);
}
