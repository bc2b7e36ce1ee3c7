//! A march that is watched for divergence: the same bits as one that is not, s² of a known motion, and bodies whose limit
//! depends on how they are strained.

#[path = "conformance/bodies.rs"]
#[allow(dead_code)]
mod bodies;

use bodies::{constant, effect, model, rough, scene};
use pd_verify::constraints::{Edge, Edges, PrescribedMotion};
use pd_verify::fastest::fastest;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::march::March;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::record::{Diverged, Failure, Record, run};
use pd_verify::scene::{Beyond, Initial, Probe, Rotations, Scene, Shape, Snapshots, StepRule, Time, Watch};
use serde_json::json;
use std::f64::consts::PI;

fn limit<const D: usize>(body: &Scene<D>) -> f64 {
    let share =
        Plan::of(&Scene { time: Time { duration: 1e-3, step: StepRule::OfLimit(1.0) }, ..body.clone() });
    let plan = share.unwrap();
    plan.time_step_s / plan.time_step_over_limit
}

/// So many steps at a share of the lattice's limit.
fn at<const D: usize>(body: &Scene<D>, share: f64, steps: u64, beyond_limit: Beyond) -> Scene<D> {
    let seconds = share * limit(body);
    let step = StepRule::Given { seconds, beyond_limit };
    Scene { time: Time { duration: seconds * steps as f64, step }, ..body.clone() }
}

/// Waves of no symmetry in every component, up to a displacement of `size` spacings.
fn waves<const D: usize>(body: &Scene<D>, size: f64) -> Vec<Initial<D>> {
    let wave = |component: usize, turn: f64| Initial {
        component,
        amplitude: size / 3.0 * body.spacing,
        shape: Shape::Wave {
            wavenumber: std::array::from_fn(|axis| (turn + 0.7 * axis as f64) / body.spacing),
            phase: turn,
        },
    };
    (0..D).flat_map(|c| [1.3, 2.4, 3.05].map(|turn| wave(c, turn + 0.2 * c as f64))).collect()
}

fn plate() -> Scene<2> {
    let narrow = Lattice { kernel: Kernel::Gaussian { p: 2.0 }, ..constant(3.0, VolumeRule::Linear, true) };
    let plate = scene::<2>(narrow, [13, 10]);
    let watch = Watch::Patch { from: [0.0; 2], to: plate.size() };
    Scene {
        displacement: waves(&plate, 1e-6),
        probes: vec![Probe { name: "all".into(), watch, every: 50 }],
        ..plate
    }
}

fn diverged(run: Result<Record, Failure>) -> Diverged {
    match run {
        Err(Failure::Diverged(diverged)) => *diverged,
        other => panic!("it did not diverge: {other:?}"),
    }
}

#[test]
fn being_watched_changes_no_bit() {
    for rotations in [Rotations::Small, Rotations::Finite] {
        for booked in [false, true] {
            let mut body = Scene { rotations, ..plate() };
            if booked {
                body.probes.push(Probe { name: "e".into(), watch: Watch::Energies, every: 10 });
            }
            let [one, other] = [Beyond::UntilItShows, Beyond::UntilItOverflows]
                .map(|beyond| run(&at(&body, 0.8, 300, beyond)).unwrap());
            assert_eq!(one.traces, other.traces);
        }
    }
}

/// A standing wave of a ring moves with its own s², and its kinetic energy is that of its velocities.
#[test]
fn the_motion_of_one_mode_has_its_frequency() {
    let ring = scene::<1>(constant(3.0, VolumeRule::Full, false), [48]);
    let ring = Scene { edges: Edges([[Edge::Periodic; 2]]), ..ring };
    for number in [5, 19, 24] {
        let theta = 2.0 * PI * f64::from(number) / 48.0;
        let shape = Shape::Wave { wavenumber: [theta / ring.spacing], phase: -0.5 * theta + 0.3 };
        let displacement = vec![Initial { component: 0, amplitude: 1e-6 * ring.spacing, shape }];
        let body = Scene { displacement, ..ring.clone() };
        let own = model(&body);
        let seconds = 0.7 * limit(&body);
        let mut march = March::new(&own, &body, seconds);
        march.advance_to(7);
        let motion = march.motion();
        // (ωΔx/v)² = (4/m²) Σ_{j=1..m} (1 − cos jθ)/j.
        let square: f64 =
            (1..=3).map(|j| 4.0 / 9.0 * (1.0 - (theta * f64::from(j)).cos()) / f64::from(j)).sum();
        let courant = body.speed() * seconds / body.spacing;
        assert!((motion.square / (0.25 * courant * courant * square) - 1.0).abs() < 1e-12, "{motion:?}");
        let squares: f64 = march.increment().iter().map(|d| (d / seconds).powi(2)).sum();
        let kinetic = 0.5 * body.material.density * body.cell_volume() * squares;
        assert!((motion.kinetic / kinetic - 1.0).abs() < 1e-12, "{motion:?} {kinetic}");
    }
}

/// A driven end may jump to and fro in every step: that is no motion of the body's own.
#[test]
fn what_is_driven_is_not_counted() {
    let bar = scene::<1>(constant(3.0, VolumeRule::Full, false), [40]);
    let seconds = limit(&bar);
    let jump = json!({
        "region": { "edge": "left" }, "axis": "x", "displacement_m": 1e-6,
        "history": { "shape": "table", "times_s": (0..200).map(|n| f64::from(n) * seconds).collect::<Vec<_>>(),
                     "values": (0..200).map(|n| f64::from(n % 2)).collect::<Vec<_>>() }
    });
    let bar = Scene { effects: vec![effect::<1, PrescribedMotion>(jump)], ..bar };
    let own = model(&bar);
    let mut march = March::new(&own, &bar, seconds);
    for step in 1..150 {
        march.advance_to(step);
        let square = march.motion().square;
        assert!(square <= 1.0 + 1e-12, "{step}: {square}");
    }
}

/// At rest or displaced as a whole nothing moves; what is no number is no motion.
#[test]
fn nothing_and_no_number() {
    let bar = scene::<1>(constant(3.0, VolumeRule::Full, false), [40]);
    let own = model(&bar);
    let mut still = March::from_fields(&own, own.grid.field(), own.grid.field(), 1e-9);
    let motion = still.motion();
    assert_eq!((motion.kinetic, motion.square), (0.0, 0.0));
    let wild = rough(&own, 3, f64::MAX);
    let mut wild = March::from_fields(&own, wild, own.grid.field(), 1e-3);
    wild.advance_to(4);
    assert!(!wild.is_finite() && wild.motion().square.is_nan());
}

#[test]
fn a_plate_above_its_limit_is_given_up_with_what_was_seen() {
    let snapshots = vec![Snapshots { name: "late".into(), times: vec![1e-3] }];
    let wild = at(&plate(), 1.1, 5000, Beyond::UntilItShows);
    let snapshots =
        snapshots.into_iter().map(|one| Snapshots { times: vec![wild.time.duration], ..one }).collect();
    let found = diverged(run(&Scene { snapshots, ..wild.clone() }));
    let own = fastest(&wild).unwrap().stable_time_step();
    assert!((found.own_limit.unwrap() / own - 1.0).abs() < 1e-6, "{found}");
    assert!(found.step <= 256 && found.sound_step.unwrap() < found.step, "{found}");
    // The whole body as it was at the last sound look, and all rows until the end.
    let sound = found.sound.as_ref().unwrap();
    assert_eq!((Some(sound.step), sound.displacement[0].len()), (found.sound_step, 130));
    let last = found.record.traces[0].times.last().unwrap() / found.record.plan.time_step_s;
    assert!(last.round() as u64 + 50 > found.step && found.record.snapshots.is_empty());
    let said = found.to_string();
    for words in
        ["grew without bound", "sound until", "of the lattice's limit", "of the body's own", "or less"]
    {
        assert!(said.contains(words), "{words}: {said}");
    }
    // Who studies the growth sees it to the end.
    let to_the_end = diverged(run(&at(&plate(), 1.1, 5000, Beyond::UntilItOverflows)));
    assert!(to_the_end.step > 500 && to_the_end.sound_step.is_none());
}

/// Tension adds transverse stiffness: a plate that is stretched has a lower limit, which the lattice's does not know.
#[test]
fn finite_rotations_are_recognised_and_their_own_limit_is_found() {
    let exact = Scene { rotations: Rotations::Finite, ..plate() };
    let small = diverged(run(&at(&exact, 1.05, 3000, Beyond::UntilItShows)));
    let own = fastest(&plate()).unwrap().stable_time_step();
    // At strains of 1e-6 the law is the linear one but for 1e-6; differences of forces have nine digits.
    assert!((small.own_limit.unwrap() / own - 1.0).abs() < 1e-4, "{small}");
    let stretch =
        |component: usize| Initial { component, amplitude: 0.4, shape: Shape::Linear { along: component } };
    let mut displacement = waves(&exact, 1e-3);
    displacement.extend([stretch(0), stretch(1)]);
    let stretched = Scene { displacement, ..exact };
    let mut share = 1.0;
    // What holds at the strains of the last sound look need not hold at those to come: the advice is taken until it does.
    for attempt in 0..8 {
        let Err(Failure::Diverged(found)) = run(&at(&stretched, share, 400, Beyond::UntilItShows)) else {
            assert!(attempt > 0 && share < 0.95, "{attempt}: {share}");
            return;
        };
        assert!(found.over_own_limit().unwrap() > 1.0 && found.sound_step.unwrap() >= 4, "{found}");
        share = found.holds().unwrap() / limit(&stretched);
    }
    panic!("no step holds, not even {share} of the lattice's limit");
}

/// Every calibrated lattice has positive weights, so that the lattice's limit holds in all its free bodies. The factors of bonds along
/// axes and diagonals have the signs of Σ w r² q(q − ½) and Σ w r² (1 − q)(½ − q), q = sin² 2θ: an eighth of Σ w r² each in a
/// family without direction, since the means of q and q² are 1/2 and 3/8.
#[test]
fn no_calibrated_lattice_has_negative_weights() {
    let mut kernels = vec![Kernel::Constant, Kernel::Conical, Kernel::Parabolic];
    kernels.extend([0.5, 1.0, 2.0, 3.0, 5.0].map(|p| Kernel::Gaussian { p }));
    kernels.extend([1.0, 3.0, 8.0].map(|p| Kernel::Exponential { p }));
    let (mut seen, mut least) = (0, f64::INFINITY);
    for step in 0..170 {
        let m = 1.5 + 0.05 * f64::from(step);
        for volume_rule in [VolumeRule::Full, VolumeRule::Linear] {
            for &kernel in &kernels {
                let lattice = |calibrated| Lattice { kernel, m, volume_rule, calibrated };
                let Ok(printed) = Stencil::<2>::new(lattice(false)) else { continue };
                let sum = |of: fn(f64) -> f64| -> f64 {
                    let part = |bond: &pd_verify::lattice::Bond<2>| {
                        let [x, y] = bond.offset.map(|n| f64::from(n).powi(2));
                        bond.weight * (x + y) * of(4.0 * x * y / (x + y).powi(2))
                    };
                    printed.bonds.iter().map(part).sum()
                };
                let axes = sum(|q| q * (q - 0.5)) / sum(|q| q);
                let diagonals = sum(|q| (1.0 - q) * (0.5 - q)) / sum(|q| 1.0 - q);
                least = least.min(axes).min(diagonals);
                let calibrated = Stencil::<2>::new(lattice(true)).unwrap();
                assert_eq!(calibrated.negative_bonds(), 0, "{}", lattice(true));
                seen += 1;
            }
        }
    }
    assert!(seen > 3000 && least > 0.2, "{seen} {least}");
}
