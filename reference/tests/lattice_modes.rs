//! The modes of a held and free lattice bar: against a march written out, against whole fields, and against limits.

use pd_verify_reference::lattice_modes::LatticeModes;
use pd_verify_reference::pulse_bar::PulseBar;
use pd_verify_reference::{Kernel, Lattice, VolumeRule};

const CONSTANT: Lattice =
    Lattice { kernel: Kernel::Constant, m: 3.0, rule: VolumeRule::Full, calibrated: false };

/// Steps of central differences from rest, w_r = 2/(9r) for r = 1, 2, 3, the ends as mirrors.
fn marched(initial: &[f64], courant: f64, steps: usize) -> Vec<f64> {
    let nodes = initial.len() as i64;
    let at = |u: &[f64], j: i64| match j {
        j if j < 0 => -u[(-1 - j) as usize],
        j if j >= nodes => u[(2 * nodes - 1 - j) as usize],
        j => u[j as usize],
    };
    let force = |u: &[f64], i: i64| -> f64 {
        (1..=3).map(|r| 2.0 / (9.0 * r as f64) * (at(u, i - r) + at(u, i + r) - 2.0 * at(u, i))).sum()
    };
    let mut now = initial.to_vec();
    let mut before: Vec<f64> = (0..nodes).map(|i| force(&now, i) * 0.5 * courant * courant).collect();
    before.iter_mut().zip(&now).for_each(|(change, u)| *change += u);
    for _ in 0..steps {
        let step = |i: i64| 2.0 * now[i as usize] - before[i as usize] + courant * courant * force(&now, i);
        let next = (0..nodes).map(step).collect();
        before = std::mem::replace(&mut now, next);
    }
    now
}

#[test]
fn a_march_written_out_gives_the_same_motion() {
    let nodes = 60;
    let initial = |j: usize| (-0.02 * (j as f64 - 22.3).powi(2)).exp() + 0.003 * ((j * j) % 7) as f64;
    let courant = 0.6;
    let modes = LatticeModes::of_displacement(CONSTANT, nodes, Some(courant), initial).expect("stable");
    let start: Vec<f64> = (0..nodes).map(initial).collect();
    for steps in [0, 1, 2, 57, 400] {
        let (found, expected) =
            (modes.displacements(courant * steps as f64), marched(&start, courant, steps));
        let worst = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-12, "{steps} steps: {worst:e}");
    }
}

#[test]
fn fields_and_histories_are_the_single_values() {
    let (nodes, times) = (37, [0.0, 1.7, 93.25]);
    let modes =
        LatticeModes::of_displacement(CONSTANT, nodes, None, |j| (j as f64).sin()).expect("exact time");
    for &time in &times {
        let (u, strain) = (modes.displacements(time), modes.strains(time));
        assert_eq!((u.len(), strain.len()), (nodes, nodes - 1));
        for (j, u) in u.iter().enumerate() {
            assert!((u - modes.displacement(j, time)).abs() < 1e-13);
        }
        for j in 1..nodes {
            assert!((strain[j - 1] - modes.strain(j, time)).abs() < 1e-12 * nodes as f64);
            assert!((strain[j - 1] - nodes as f64 * (u[j] - u[j - 1])).abs() < 1e-12 * nodes as f64);
        }
    }
    assert_eq!(modes.displacement_history(5, &times), times.map(|t| modes.displacement(5, t)));
    assert_eq!(modes.strain_history(5, &times), times.map(|t| modes.strain(5, t)));
}

#[test]
fn any_displacement_begins_as_given() {
    for nodes in [1, 2, 83, 800] {
        let initial = |j: usize| ((j * 7919) % 1000) as f64 / 1000.0 - 0.3;
        let modes = LatticeModes::of_displacement(CONSTANT, nodes, None, initial).expect("exact time");
        let found = modes.displacements(0.0);
        let worst = (0..nodes).map(|j| (found[j] - initial(j)).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-15 * (nodes as f64).max(10.0), "{nodes} nodes: {worst:e}");
    }
    assert!(LatticeModes::of_displacement(CONSTANT, 50, Some(3.0), |_| 1.0).is_none());
}

#[test]
fn pulses_converge_to_dalembert_at_second_order() {
    let bar = PulseBar { length: 1.0, speed: 1.0, sharpness: 400.0, centre: 0.4 };
    let of = Lattice { rule: VolumeRule::Linear, ..CONSTANT };
    let error = |nodes: usize| {
        let dx = 1.0 / nodes as f64;
        let place = |j: usize| (j as f64 + 0.5) * dx;
        let initial = |j: usize| bar.displacement_at(place(j), 0.0);
        let modes = LatticeModes::of_displacement(of, nodes, None, initial).expect("exact time");
        let worst = |t: f64| {
            let u = modes.displacements(t / dx);
            (0..nodes).map(|j| (u[j] - bar.displacement_at(place(j), t)).abs()).fold(0.0, f64::max)
        };
        [0.31, 0.9, 1.7].map(worst)
    };
    let (coarse, fine) = (error(400), error(800));
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        let order = (coarse / fine).log2();
        assert!((order - 2.0).abs() < 0.1, "{order}: {coarse:e} and {fine:e}");
    }
}

/// Steps of central differences from rest under a load whose factor depends on the step, the bar and its ends as above.
fn driven(load: &[f64], courant: f64, steps: usize, factor: fn(usize) -> f64) -> Vec<f64> {
    let nodes = load.len() as i64;
    let at = |u: &[f64], j: i64| match j {
        j if j < 0 => -u[(-1 - j) as usize],
        j if j >= nodes => u[(2 * nodes - 1 - j) as usize],
        j => u[j as usize],
    };
    let force = |u: &[f64], i: i64, step: usize| -> f64 {
        let bonds = (1..=3).map(|r| 2.0 / (9.0 * r as f64) * (at(u, i - r) + at(u, i + r) - 2.0 * at(u, i)));
        bonds.sum::<f64>() + factor(step) * load[i as usize]
    };
    let mut now = vec![0.0; load.len()];
    let mut before: Vec<f64> = (0..nodes).map(|i| force(&now, i, 0) * 0.5 * courant * courant).collect();
    for step in 0..steps {
        let next =
            |i: i64| 2.0 * now[i as usize] - before[i as usize] + courant * courant * force(&now, i, step);
        let next = (0..nodes).map(next).collect();
        before = std::mem::replace(&mut now, next);
    }
    now
}

#[test]
fn loads_put_on_at_once_and_of_alternating_sign_move_a_bar_as_a_march_written_out() {
    let (nodes, courant) = (40, 0.7);
    let load: Vec<f64> = (0..nodes).map(|j| if j > 33 { 1.0 } else { 0.1 * ((j * j) % 5) as f64 }).collect();
    let steady = LatticeModes::of_steady_load(CONSTANT, nodes, Some(courant), |j| load[j]).expect("stable");
    let alternating =
        LatticeModes::of_alternating_load(CONSTANT, nodes, courant, |j| load[j]).expect("stable");
    for steps in [0, 1, 2, 33, 400] {
        let time = steps as f64 * courant;
        let sign = if steps % 2 == 0 { 1.0 } else { -1.0 };
        let of = |modes: &LatticeModes, sign: f64| -> Vec<f64> {
            let pairs = modes.displacements(0.0).into_iter().zip(modes.displacements(time));
            pairs.map(|(start, now)| sign * start - now).collect()
        };
        let switch = |step: usize| if step.is_multiple_of(2) { 1.0 } else { -1.0 };
        for (found, expected) in [
            (of(&steady, 1.0), driven(&load, courant, steps, |_| 1.0)),
            (of(&alternating, sign), driven(&load, courant, steps, switch)),
        ] {
            assert!(found.iter().all(|u| u.abs() <= 2.0 * steady.most().max(alternating.most())));
            let most = expected.iter().fold(1e-3_f64, |most, u| most.max(u.abs()));
            for (found, expected) in found.iter().zip(&expected) {
                // Roundings of the march, 1e-16 a step, and of frequencies over the time.
                assert!((found - expected).abs() < 1e-11 * most, "{steps}: {found} {expected}");
            }
        }
    }
}
