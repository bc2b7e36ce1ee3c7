//! Leapfrog, velocity Verlet and central differences are one scheme in three sets of variables: same loads, same start,
//! same motion but for rounding. With damping the scheme is central differences with the velocity (u₊ − u₋)/2Δt.
//!
//! The bound. A stable linear body moves in modes of frequency ω, sin(θ/2) = ωΔt/2. A slip δ of an increment k steps ago
//! has grown to δ sin kθ/sin θ ≤ kδ, a slip of a displacement to δ cos((k − ½)θ)/cos(θ/2) ≤ (2k + 1)δ, so that roundings
//! e(n) of the steps leave two schemes at most Σ (2(N − n) + 1) e(n) apart, in the norm √Σu² in which the modes are
//! orthogonal. Each step of each scheme rounds a displacement, an increment or a velocity a few times (8 are allowed) and
//! a force as the conformance suite says: e = u ‖8(|u(n)| + |u(n+1)|) + 8 (family + 16) Δt²/ρ Σ|w||u_j − u_i|‖. Loads are
//! the same numbers in all three. Damping only shrinks slips.

#[path = "conformance/bodies.rs"]
#[allow(dead_code)]
mod bodies;

use bodies::{Sums, UNIT, constant, effect, model, places, rough, scene};
use pd_verify::breaking::Broken;
use pd_verify::constraints::Edge::{Free, MirrorEven, MirrorOdd, Periodic};
use pd_verify::constraints::Edges;
use pd_verify::field::Window;
use pd_verify::forces::{BodyForce, Damper, Now, Traction};
use pd_verify::march::March;
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::scene::{Operator, Scene};
use pd_verify_reference as reference;
use serde_json::json;

/// Displacement fields, one for each step.
type Motion = Vec<Vec<f64>>;

fn leapfrog<const D: usize>(march: &mut March<'_, D>, steps: u64) -> Motion {
    let mut motion = vec![march.displacement().to_vec()];
    for step in 1..=steps {
        march.advance_to(step);
        motion.push(march.displacement().to_vec());
    }
    motion
}

/// Δt²F/ρ at a step.
fn kick<const D: usize>(scene: &Scene<D>, model: &Model<D>, u: &mut [f64], step: usize, dt: f64) -> Vec<f64> {
    model.fill_ghosts(u);
    let mut force = model.grid.field();
    let state = Window::from(&*u);
    let now = Now {
        displacement: state,
        increment: state,
        time: step as f64 * dt,
        time_step: dt,
        broken: Broken::none(),
    };
    model.force(&now, &mut force);
    force.iter().map(|f| dt * dt / scene.material.density * f).collect()
}

/// u(n+1) = u(n) + Δt v(n) + ½Δt² a(n), v(n+1) = v(n) + ½Δt (a(n) + a(n+1)).
fn verlet<const D: usize>(
    scene: &Scene<D>,
    model: &Model<D>,
    start: [&[f64]; 2],
    dt: f64,
    steps: u64,
) -> Motion {
    let [mut u, mut v] = start.map(<[f64]>::to_vec);
    v.iter_mut().for_each(|v| *v /= dt);
    let mut a = kick(scene, model, &mut u, 0, dt);
    let mut motion = vec![u.clone()];
    for step in 1..=steps as usize {
        for ((u, v), a) in u.iter_mut().zip(&v).zip(&a) {
            *u += dt * v + 0.5 * a;
        }
        let next = kick(scene, model, &mut u, step, dt);
        for ((v, a), next) in v.iter_mut().zip(&a).zip(&next) {
            *v += 0.5 * (a + next) / dt;
        }
        a = next;
        motion.push(u.clone());
    }
    motion
}

/// (1 + α½Δt) u(n+1) = 2u(n) − (1 − α½Δt) u(n−1) + Δt² a(n).
fn central<const D: usize>(
    scene: &Scene<D>,
    model: &Model<D>,
    start: [&[f64]; 2],
    [dt, rate]: [f64; 2],
    steps: u64,
) -> Motion {
    let ([mut before, mut u], half) = (start.map(<[f64]>::to_vec), 0.5 * rate * dt);
    let mut motion = vec![u.clone()];
    for step in 0..steps as usize {
        let a = kick(scene, model, &mut u, step, dt);
        let next =
            |((u, before), a): ((&f64, &f64), &f64)| (2.0 * u - (1.0 - half) * before + a) / (1.0 + half);
        let next: Vec<f64> = u.iter().zip(&before).zip(&a).map(next).collect();
        before = std::mem::replace(&mut u, next);
        model.fill_ghosts(&mut u);
        motion.push(u.clone());
    }
    motion
}

/// The largest distance of two motions over its bound, over all steps.
fn apart<const D: usize>(scene: &Scene<D>, model: &Model<D>, dt: f64, one: &Motion, other: &Motion) -> f64 {
    let at = places(&model.grid);
    let (mut slips, mut bound, mut worst) = (0.0, 0.0, 0.0_f64);
    for n in 1..one.len() {
        let sums = Sums::of(scene, &model.grid, &one[n - 1]);
        let force = (sums.family + 16) as f64 * dt * dt / scene.material.density;
        let squares = at.iter().map(|&at| {
            (8.0 * (one[n - 1][at].abs() + one[n][at].abs()) + 8.0 * force * sums.pull[at]).powi(2)
        });
        let slip = UNIT * squares.sum::<f64>().sqrt();
        bound += 2.0 * slips + slip;
        slips += slip;
        let distance = at.iter().map(|&at| (one[n][at] - other[n][at]).powi(2)).sum::<f64>().sqrt();
        worst = worst.max(if distance.is_finite() { distance / bound } else { f64::INFINITY });
    }
    worst
}

/// Everything linear at once: an initial velocity, a traction, a body force, on a rough start.
fn compare<const D: usize>(scene: &Scene<D>) {
    let (model, dt, steps) = (model(scene), Plan::of(scene).unwrap().time_step_s, 300);
    let start = [1, 2].map(|seed| rough(&model, seed, 0.01 * scene.spacing));
    let mut march = March::from_fields(&model, start[0].clone(), start[1].clone(), dt);
    let before: Vec<f64> = start[0].iter().zip(march.increment()).map(|(u, d)| u - d).collect();
    let own = leapfrog(&mut march, steps);
    let verlet = verlet(scene, &model, [&start[0], &start[1]], dt, steps);
    let central = central(scene, &model, [&before, &start[0]], [dt, 0.0], steps);
    let ratios = [&verlet, &central].map(|other| apart(scene, &model, dt, &own, other));
    eprintln!("{D}D: velocity Verlet and central differences at {ratios:?} of the bound");
    assert!(ratios.iter().all(|ratio| *ratio <= 1.0), "{ratios:?}");
    // Begun a half step's acceleration off, it is another motion.
    let off: Vec<f64> = start[0].iter().zip(&start[1]).map(|(u, v)| u - v).collect();
    let off = self::central(scene, &model, [&off, &start[0]], [dt, 0.0], steps);
    assert!(apart(scene, &model, dt, &own, &off) > 1e4);
}

#[test]
fn three_schemes_are_one() {
    let sine = json!({ "shape": "sine", "period_s": 2.3e-5, "start_s": 3e-6 });
    let ramp = json!({ "shape": "ramp", "rise_s": 1.7e-5 });
    for operator in [Operator::Stencil, Operator::Bonds] {
        for edges in [[Free, Free], [MirrorOdd, Free], [Periodic, Periodic]] {
            let layer = json!({ "edge": "right" });
            let pull = json!({ "region": layer, "axis": "x", "density_n_m3": 2e11, "history": sine });
            let push = json!({ "axis": "x", "density_n_m3": 3e10, "history": ramp });
            let effects = vec![effect::<1, BodyForce>(pull), effect::<1, BodyForce>(push)];
            let bar = scene::<1>(constant(3.0, VolumeRule::Full, true), [37]);
            compare(&Scene { operator, effects, edges: Edges([edges]), ..bar });
        }
        let pull = json!({ "edge": "top", "axis": "x", "stress_pa": 2e9, "history": sine });
        let push = json!({ "axis": "y", "density_n_m3": 3e10, "history": ramp });
        let effects = vec![effect::<2, Traction>(pull), effect::<2, BodyForce>(push)];
        let plate = scene::<2>(constant(2.0, VolumeRule::Linear, false), [11, 9]);
        compare(&Scene { operator, effects, edges: Edges([[MirrorOdd, MirrorEven], [Free, Free]]), ..plate });
    }
}

#[test]
fn damped_leapfrog_is_damped_central_differences() {
    for share in [1e-3, 0.3, 1.5] {
        let edges = Edges([[MirrorEven, Free]]);
        let scene = Scene { edges, ..scene::<1>(constant(3.0, VolumeRule::Full, true), [37]) };
        let (plain, mut damped) = (model(&scene), model(&scene));
        let dt = Plan::of(&scene).unwrap().time_step_s;
        let rate = share / dt;
        damped.add(Box::new(Damper::new(&damped.grid, scene.material.density, rate)));
        let start = [1, 2].map(|seed| rough(&plain, seed, 0.01 * scene.spacing));
        let mut march = March::from_fields(&damped, start[0].clone(), start[1].clone(), dt);
        let before: Vec<f64> = start[0].iter().zip(march.increment()).map(|(u, d)| u - d).collect();
        let own = leapfrog(&mut march, 300);
        let other = central(&scene, &plain, [&before, &start[0]], [dt, rate], 300);
        let ratio = apart(&scene, &plain, dt, &own, &other);
        eprintln!("damped by {share} per step: central differences at {ratio} of the bound");
        assert!(ratio <= 1.0);
        let other = central(&scene, &plain, [&before, &start[0]], [dt, 1.001 * rate], 300);
        assert!(apart(&scene, &plain, dt, &own, &other) > 1e4);
    }
}

/// A mode that starts with the velocity −½α of its displacement moves as e^(−αt/2) cos(√(ω² − α²/4) t). Halving Δt
/// quarters the error, to the 5 % that terms of fourth order may still be worth.
#[test]
fn damping_is_of_second_order() {
    let lattice = reference::Lattice {
        kernel: reference::Kernel::Constant,
        m: 3.0,
        rule: reference::VolumeRule::Full,
        calibrated: true,
    };
    for (edges, k_dx) in
        [(Periodic, 6.0), (MirrorEven, 5.0)].map(|(edge, k)| ([edge; 2], k * std::f64::consts::PI / 40.0))
    {
        let edges = Edges([edges]);
        let scene = Scene { edges, ..scene::<1>(constant(3.0, VolumeRule::Full, true), [40]) };
        let omega = reference::lattice::bar(lattice, k_dx).omega * scene.speed() / scene.spacing;
        let rate = 0.4 * omega;
        let duration = 9.0 / omega;
        let of_damped = (omega * omega - 0.25 * rate * rate).sqrt();
        let exact = libm::exp(-0.5 * rate * duration) * libm::cos(of_damped * duration);
        let error = |steps: u64| {
            let (mut model, dt) = (model(&scene), duration / steps as f64);
            model.add(Box::new(Damper::new(&model.grid, scene.material.density, rate)));
            let wave =
                |factor: f64| bodies::field(&model, |[x]| [factor * libm::cos(k_dx * x / scene.spacing)]);
            let mut march = March::from_fields(&model, wave(1e-4), wave(-0.5e-4 * rate * dt), dt);
            march.advance_to(steps);
            let first = model.grid.place([0]);
            march.displacement()[first] / (1e-4 * libm::cos(0.5 * k_dx)) - exact
        };
        let errors = [100, 200, 400].map(error);
        let falls = [errors[0] / errors[1], errors[1] / errors[2]];
        eprintln!("errors of a damped mode {errors:?}, falling by {falls:?}");
        assert!(errors[0].abs() < 1e-2 && errors[2] != 0.0);
        assert!(falls.iter().all(|fall| (fall - 4.0).abs() < 0.2), "{falls:?}");
    }
}
