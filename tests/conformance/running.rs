//! Notches that run: on their way they are notches of their length, at its end the longer notch to the last bit, and a march
//! is what leapfrog by hand makes of the bodies before and after.

use crate::bodies::{Sums, constant, effect, field, force, model, places, rough, scene, still};
use crate::checks::{same_bits, within};
use crate::costs::bytes;
use pd_verify::breaking::Broken;
use pd_verify::constraints::Edge::{Free, MirrorOdd, Periodic};
use pd_verify::constraints::Edges;
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{Now, Traction};
use pd_verify::march::March;
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::record::run;
use pd_verify::scene::{
    Beyond, Hole, Notch, Operator, Probe, Rotations, Running, Scene, StepRule, Time, Watch,
};
use serde_json::json;

const STEP: f64 = 2e-7;

/// A plate with a notch that runs, in spacings; the tip sets out at once and passes a cell in ten steps.
fn plate(from: [f64; 2], to: [f64; 2], by: f64) -> Scene<2> {
    let plate = scene::<2>(constant(3.015, VolumeRule::Linear, false), [21, 18]);
    let of = |end: [f64; 2]| end.map(|x| x * plate.spacing);
    let running =
        Running { notch: 0, speed: plate.spacing / (10.0 * STEP), start: 0.0, by: by * plate.spacing };
    Scene { notches: vec![Notch { from: of(from), to: of(to) }], running: vec![running], ..plate }
}

/// Between rows, through nodes, backwards, slanted, and across a hole.
fn plates() -> Vec<Scene<2>> {
    let slanted = plate([4.3, 3.1], [8.2, 5.9], 7.6);
    let dx = slanted.spacing;
    let hole = Hole { centre: [10.1 * dx, 7.7 * dx], radius: 2.2 * dx };
    vec![
        plate([0.0, 9.0], [5.0, 9.0], 11.0),
        plate([0.0, 8.5], [5.5, 8.5], 15.5),
        plate([21.0, 7.0], [17.25, 7.0], 17.25),
        plate([6.0, 18.0], [6.0, 14.0], 9.3),
        Scene { holes: vec![hole], ..slanted.clone() },
        slanted,
    ]
}

/// The same plate with a notch that stands, longer by a way in m.
fn standing(scene: &Scene<2>, by: f64) -> Scene<2> {
    let notch = scene.notches[0];
    let to = Running { by, ..scene.running[0] }.end(&notch);
    Scene { notches: vec![Notch { to, ..notch }], running: vec![], ..scene.clone() }
}

/// What has broken at a time.
fn broken(own: &Model<2>, time: f64) -> Broken {
    let rule = own.breaking.as_ref().expect("a notch runs");
    let mut broken = rule.intact();
    // A step from before the beginning.
    rule.commit(&Now { time, time_step: 1.0, ..still(&[]) }, &mut broken);
    broken
}

fn force_of(own: &Model<2>, u: &[f64], broken: &Broken) -> Vec<f64> {
    let mut f = vec![f64::NAN; u.len()];
    own.force(&Now { broken, ..still(u) }, &mut f);
    f
}

/// Every edge, law and operator.
fn variants(plate: &Scene<2>) -> Vec<Scene<2>> {
    let mut all = Vec::new();
    for edges in [
        [[Free; 2]; 2],
        [[MirrorOdd, Free], [Free, Free]],
        [[Free, MirrorOdd], [MirrorOdd, Free]],
        [[Periodic; 2], [Free, MirrorOdd]],
    ] {
        for rotations in [Rotations::Small, Rotations::Finite] {
            for operator in [Operator::Stencil, Operator::Bonds] {
                all.push(Scene { edges: Edges(edges), rotations, operator, ..plate.clone() });
            }
        }
    }
    all
}

/// To the bound of two implementations, at odd places of the tip and where it stands on a crossing.
#[test]
fn on_its_way_it_is_a_notch_of_its_length() {
    let mut worst = 0.0_f64;
    for plate in plates() {
        for plate in variants(&plate) {
            let own = model(&plate);
            let u = rough(&own, 4, 0.1 * plate.spacing);
            for share in [0.0, 0.13, 0.5, 0.77, 0.999, 1.0] {
                let by = share * plate.running[0].by;
                let short = standing(&plate, by);
                let (other, broken) = (model(&short), broken(&own, by / plate.running[0].speed));
                let (f, g) = (force_of(&own, &u, &broken), force(&other, &u));
                let sums = Sums::of(&short, &own.grid, &u);
                for at in places(&own.grid) {
                    let what = format!("{:?} {:?} at {share}", plate.notches, plate.edges);
                    worst = worst.max(within(&what, (f[at] - g[at]).abs(), 1e-13 * sums.pull[at]).unwrap());
                }
                let (e, h) = (own.energy(&Now { broken: &broken, ..still(&u) }), other.energy(&still(&u)));
                worst = worst.max(within("energies", (e - h).abs(), 1e-13 * sums.energy).unwrap());
                let lost = Plan::of(&plate).unwrap().bonds - Plan::of(&short).unwrap().bonds;
                assert_eq!(u64::from(broken.ends()), 2 * lost, "{:?} at {share}", plate.edges);
                assert_eq!(lost == 0, share == 0.0);
            }
        }
    }
    eprintln!("error over bound: {worst}");
}

#[test]
fn at_the_end_it_is_the_longer_notch_to_the_last_bit() {
    for plate in plates() {
        for plate in variants(&plate) {
            let own = model(&plate);
            let u = rough(&own, 4, 0.1 * plate.spacing);
            let Running { by, speed, .. } = plate.running[0];
            let f = force_of(&own, &u, &broken(&own, 1.001 * by / speed));
            same_bits("the longer notch", &f, &force(&model(&standing(&plate, by)), &u)).unwrap();
            same_bits("before", &force_of(&own, &u, &broken(&own, 0.0)), &force(&own, &u)).unwrap();
        }
    }
}

/// A strip under tension through which the notch runs is two: nothing holds its halves together.
#[test]
fn a_strip_cut_through_is_two() {
    let pull = |edge: &str, stress: f64| {
        let history = json!({ "shape": "step" });
        effect::<2, Traction>(json!({ "edge": edge, "axis": "y", "stress_pa": stress, "history": history }))
    };
    for operator in [Operator::Stencil, Operator::Bonds] {
        let strip = Scene {
            operator,
            effects: vec![pull("top", 1e7), pull("bottom", -1e7)],
            ..plate([0.0, 9.0], [3.0, 9.0], 18.0)
        };
        let own = model(&strip);
        let mut march = March::new(&own, &strip, STEP);
        let dx = strip.spacing;
        let apart = field(&own, |x| if x[1] > 9.0 * dx { [0.3 * dx, 0.2 * dx] } else { [0.0; 2] });
        let holds = |broken: &Broken| {
            let bonds = Model::new(&Scene { effects: vec![], ..strip.clone() }).unwrap();
            let f = force_of(&bonds, &apart, broken);
            places(&own.grid).iter().any(|&at| f[at] != 0.0)
        };
        // The last bonds cross where the last column stands, 17.5 cells from where the tip set out.
        march.advance_to(174);
        assert!(holds(march.broken()));
        march.advance_to(175);
        assert!(!holds(march.broken()));
        let through = Plan::of(&standing(&strip, strip.running[0].by)).unwrap().bonds;
        let lost = Plan::of(&strip).unwrap().bonds - through;
        assert_eq!(u64::from(march.broken().ends()), 2 * lost);
        // From then on each half falls freely: σ on one side of nine rows.
        let apart: Vec<f64> = [200, 400, 600]
            .into_iter()
            .map(|step| {
                march.advance_to(step);
                let u = |node| march.displacement()[own.grid.place(node) + own.grid.stride()];
                let nodes = || own.grid.each();
                let sum = |upper: bool| nodes().filter(|node| (node[1] >= 9) == upper).map(u).sum::<f64>();
                (sum(true) - sum(false)) / 189.0
            })
            .collect();
        let fall = 2.0 * 1e7 / (9.0 * dx * strip.material.density) * (200.0 * STEP).powi(2);
        let seen = apart[2] - 2.0 * apart[1] + apart[0];
        assert!((seen / fall - 1.0).abs() < 1e-9 && apart[0] > 0.0, "{seen:e} {fall:e}");
    }
}

/// So fast that all is cut in one step, it is the longer notch from this step on: leapfrog by hand with the forces of the
/// two bodies. Each of n steps rounds the sum of a family in another order: 2ε·bonds·n² of the displacements, as a study
/// says it.
#[test]
fn infinitely_fast_it_is_there_from_one_step_to_the_next() {
    let cut = 40;
    for plate in plates() {
        for plate in variants(&plate) {
            let start = (cut as f64 - 0.5) * STEP;
            let fast = Running { speed: 1e12, start, ..plate.running[0] };
            let plate = Scene { running: vec![fast], ..plate };
            let own = model(&plate);
            let bodies = [model(&standing(&plate, 0.0)), model(&standing(&plate, fast.by))];
            let u = rough(&own, 4, 1e-3 * plate.spacing);
            let mut march = March::from_fields(&own, u.clone(), own.grid.field(), STEP);
            let (mut u, mut d) = (u, own.grid.field());
            let factor = STEP * STEP / plate.material.density;
            for step in 0..80_u64 {
                let f = force(&bodies[usize::from(step >= cut)], &u);
                let share = if step == 0 { 0.5 } else { 1.0 };
                for at in places(&own.grid) {
                    d[at] += share * factor * f[at];
                    u[at] += d[at];
                }
                own.fill_ghosts(&mut u);
                march.advance_to(step + 1);
                assert_eq!(march.broken().ends() > 0, step + 1 >= cut);
            }
            let largest = u.iter().map(|u| u.abs()).fold(0.0, f64::max);
            let v = march.displacement();
            let worst = places(&own.grid).iter().map(|&at| (u[at] - v[at]).abs()).fold(0.0, f64::max);
            let bound = 2.0 * f64::EPSILON * 36.0 * 80.0 * 80.0;
            within("the longer notch", worst / largest, bound).unwrap();
        }
    }
}

fn seen(scene: &Scene<2>, threads: usize) -> Vec<Vec<f64>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let record = pool.install(|| run(scene)).unwrap();
    record.traces.into_iter().flat_map(|trace| trace.rows).collect()
}

/// A plate of several pieces of work, and the account of its bonds.
#[test]
fn threads_change_no_bit() {
    let large = plate([0.0, 60.0], [30.0, 60.0], 100.0);
    let spacing = large.spacing;
    let probe = |name: &str, watch| Probe { name: name.into(), watch, every: 20 };
    let pull = json!({ "edge": "top", "axis": "y", "stress_pa": 1e7, "history": { "shape": "step" } });
    let large = Scene {
        nodes: [150, 130],
        effects: vec![effect::<2, Traction>(pull)],
        running: vec![Running { speed: 4.0 * large.running[0].speed, ..large.running[0] }],
        probes: vec![
            probe("row", Watch::Line { along: 0, through: 61.0 * spacing }),
            probe("energies", Watch::Energies),
        ],
        time: Time {
            duration: 200.0 * STEP,
            step: StepRule::Given { seconds: STEP, beyond_limit: Beyond::Refused },
        },
        ..large
    };
    for operator in [Operator::Stencil, Operator::Bonds] {
        let large = Scene { operator, ..large.clone() };
        let one = seen(&large, 1);
        assert!(one.iter().any(|row| row.len() == 6 && row[5] > 0.0), "bonds hold energy when they are cut");
        assert!([2, 5].into_iter().all(|threads| seen(&large, threads) == one));
    }
}

#[test]
fn a_plan_says_what_running_costs() {
    for plate in plates() {
        for plate in variants(&plate) {
            let (plan, own) = (Plan::of(&plate).unwrap(), model(&plate));
            let kept = bytes(&own) + own.breaking.as_ref().unwrap().bytes();
            assert_eq!((plan.bytes_per_node * plan.nodes as f64).round() as usize, kept);
            assert!(plan.effects_on.contains(&"running notch".into()));
            let steps = plate.spacing / (plate.running[0].speed * plan.time_step_s);
            assert_eq!(plan.steps_per_cell, Some(steps));
            let short = Plan::of(&standing(&plate, 0.0)).unwrap();
            assert_eq!((plan.bonds, short.steps_per_cell), (short.bonds, None));
            assert!(short.effects_off.contains(&"running notch".into()));
        }
    }
}

#[test]
fn ways_that_cannot_be_run() {
    let plate = plate([0.0, 9.0], [5.0, 9.0], 11.0);
    let (dx, running) = (plate.spacing, plate.running[0]);
    let with = |running| Scene { running: vec![running], ..plate.clone() };
    let refuse = |scene: Scene<2>, key: &str, words: &str| {
        let wrong = Plan::of(&scene).unwrap_err();
        assert!(wrong.key == key && wrong.message.contains(words) && !wrong.help.is_empty(), "{wrong:?}");
    };
    for speed in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refuse(with(Running { speed, ..running }), "notch[0].runs.speed_m_s", "does not run at");
    }
    for start in [-1e-9, f64::NAN, f64::INFINITY] {
        refuse(with(Running { start, ..running }), "notch[0].runs.start_s", "cannot set out");
    }
    for by in [0.0, 0.5 * dx, -dx, f64::NAN] {
        refuse(with(Running { by, ..running }), "notch[0].runs.by_m", "shorter than a cell");
    }
    let far = with(Running { by: 16.5 * dx, ..running });
    let wrong = Plan::of(&far).unwrap_err();
    assert!(
        wrong.message.contains("out of the body: to 0.079") && wrong.help.contains("by 0.0592"),
        "{wrong:?}"
    );
    assert!(Plan::of(&with(Running { by: 16.0 * dx, ..running })).is_ok());
    refuse(with(Running { notch: 1, ..running }), "notch[1].runs", "no notch 1");
    refuse(Scene { running: vec![running; 2], ..plate.clone() }, "notch[0].runs", "runs already");
    let corrected = Scene { surface: Correction::Volume, ..plate.clone() };
    refuse(corrected, "surface_correction", "for the bonds at t = 0");
    let rest = Plan::at_rest(&plate).unwrap_err();
    assert!(rest.key == "notch[0].runs" && rest.message.contains("come to rest"), "{rest:?}");
    let bar = scene::<1>(constant(2.0, VolumeRule::Linear, false), [20]);
    let wrong = Plan::of(&Scene { running: vec![running], ..bar }).unwrap_err();
    assert_eq!(wrong.key, "notch[0].runs");
}

#[test]
fn a_march_put_back_goes_the_same_way_again() {
    let scene = &plates()[0];
    let own = model(scene);
    let mut march = March::new(&own, scene, STEP);
    march.advance_to(30);
    let kept = march.keep();
    march.advance_to(80);
    let end = march.keep();
    assert_ne!(march.broken(), &broken(&own, 30.0 * STEP));
    march.put_back(kept.clone());
    assert!(march.keep() == kept && kept != end);
    march.advance_to(80);
    assert!(march.keep() == end);
}
