//! Pulses in periodic boxes: against direct sums, marches written out, d'Alembert, the equation of motion, and
//! Hankel's integrals for the infinite plane.

use pd_verify_reference::periodic_pulse::{PeriodicPulse, RingPulse};
use pd_verify_reference::{Kernel, Lattice, Medium, VolumeRule, lattice};
use std::f64::consts::{PI, TAU};

const CONSTANT: Lattice =
    Lattice { kernel: Kernel::Constant, m: 2.0, rule: VolumeRule::Full, calibrated: false };

fn worst(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    found
        .iter()
        .zip(expected)
        .map(|(a, b)| if a.is_nan() { f64::INFINITY } else { (a - b).abs() })
        .fold(0.0, f64::max)
}

/// Every wave of both signs, as the series is written: k, û, and the medium's two waves.
type Waves = Vec<([f64; 2], f64, [(f64, [f64; 2]); 2])>;

fn every_wave(medium: Medium, a: f64, sides: [f64; 2]) -> Waves {
    let numbers = (-22..=22).flat_map(|n| (-22..=22).map(move |m| [n, m].map(f64::from)));
    let all: Vec<[f64; 2]> = numbers.map(|[n, m]| [TAU * n / sides[0], TAU * m / sides[1]]).collect();
    let found = medium.many_plane_waves(&all).expect("in range");
    let coefficient =
        |k: [f64; 2]| PI / (a * sides[0] * sides[1]) * (-(k[0] * k[0] + k[1] * k[1]) / (4.0 * a)).exp();
    all.iter().zip(found).map(|(k, pair)| (*k, coefficient(*k), pair)).collect()
}

/// Their sum, real part.
fn direct(waves: &Waves, from_centre: [f64; 2], ct: f64) -> [f64; 2] {
    waves.iter().fold([0.0; 2], |mut sum, (k, coefficient, pair)| {
        let shape = (k[0] * from_centre[0] + k[1] * from_centre[1]).cos();
        for (omega, e) in pair {
            let share = coefficient * shape * (omega * ct).cos() * e[0];
            sum = [sum[0] + share * e[0], sum[1] + share * e[1]];
        }
        sum
    })
}

#[test]
fn fields_are_the_sum_over_all_waves() {
    let (sides, centre, a) = ([2.0, 1.5], [0.37, 1.2], 30.0);
    let moduli = Medium::Moduli(lattice::Moduli { c11: 1.2, c12: 0.7, c66: 0.7 });
    let nonlocal = Medium::Nonlocal { kernel: Kernel::Constant, horizon: 0.2 };
    for medium in [Medium::Local, moduli, nonlocal] {
        let pulse = PeriodicPulse::new(medium, a, centre, sides).expect("in range");
        let waves = every_wave(medium, a, sides);
        let (xs, ys) = ([0.1, 0.37, 1.9], [0.0, 0.66]);
        for ct in [0.0, 0.3, 4.1] {
            let [ux, uy] = pulse.fields(&xs, &ys, ct).expect("in range");
            for (row, y) in ys.iter().enumerate() {
                for (column, x) in xs.iter().enumerate() {
                    let expected = direct(&waves, [x - centre[0], y - centre[1]], ct);
                    let found = [ux[row * 3 + column], uy[row * 3 + column]];
                    assert!(worst(&found, &expected) < 5e-15, "{found:?} against {expected:?}");
                }
            }
        }
    }
}

#[test]
fn it_begins_as_a_gaussian() {
    let pulse = PeriodicPulse::new(Medium::Local, 80.0, [0.45, 0.9], [1.0, 2.0]).expect("any");
    let places: Vec<f64> = (0..40).map(|i| f64::from(i) / 40.0).collect();
    let [ux, uy] = pulse.fields(&places, &places, 0.0).expect("any");
    let image = |d: f64, period: f64| {
        (-1..=1).map(|j| (-80.0 * (d + period * f64::from(j)).powi(2)).exp()).sum::<f64>()
    };
    let expected: Vec<f64> = places
        .iter()
        .flat_map(|y| places.iter().map(move |x| (x, y)))
        .map(|(x, y)| image(x - 0.45, 1.0) * image(y - 0.9, 2.0))
        .collect();
    assert!(worst(&ux, &expected) < 3e-15, "{:e}", worst(&ux, &expected));
    assert!(uy.iter().all(|u| u.abs() < 1e-16));
}

/// Central differences of the constant kernel with m = 2 on a torus: the 12 nodes within 2Δx, w = 8/(πm³r).
fn marched(size: [usize; 2], initial: &[f64], c_dt_over_dx: f64, steps: u64) -> [Vec<f64>; 2] {
    let offsets = (-2..=2_i64).flat_map(|i| (-2..=2_i64).map(move |j| (i, j)));
    let family: Vec<(i64, i64, f64)> = offsets
        .filter(|(i, j)| (1..=4).contains(&(i * i + j * j)))
        .map(|(i, j)| (i, j, 1.0 / PI / ((i * i + j * j) as f64).powf(1.5)))
        .collect();
    let [nx, ny] = size.map(|n| n as i64);
    let push = |u: &[Vec<f64>; 2], x: i64, y: i64| {
        let here = (y * nx + x) as usize;
        family.iter().fold([0.0; 2], |sum, &(i, j, weight)| {
            let there = ((y + j).rem_euclid(ny) * nx + (x + i).rem_euclid(nx)) as usize;
            let along = i as f64 * (u[0][there] - u[0][here]) + j as f64 * (u[1][there] - u[1][here]);
            [sum[0] + weight * along * i as f64, sum[1] + weight * along * j as f64]
        })
    };
    let accelerations = |u: &[Vec<f64>; 2]| {
        let mut all = [Vec::new(), Vec::new()];
        for (x, y) in (0..ny).flat_map(|y| (0..nx).map(move |x| (x, y))) {
            let f = push(u, x, y);
            all[0].push(f[0] * c_dt_over_dx.powi(2));
            all[1].push(f[1] * c_dt_over_dx.powi(2));
        }
        all
    };
    let mut now = [initial.to_vec(), vec![0.0; initial.len()]];
    let mut moved = accelerations(&now).map(|f| f.iter().map(|f| -0.5 * f).collect::<Vec<f64>>());
    for _ in 0..steps {
        let push = accelerations(&now);
        for part in 0..2 {
            for i in 0..initial.len() {
                moved[part][i] += push[part][i];
                now[part][i] += moved[part][i];
            }
        }
    }
    now
}

fn nodes(count: usize, spacing: f64) -> Vec<f64> {
    (0..count).map(|i| (i as f64 + 0.5) * spacing).collect()
}

// A pulse of two spacings' width off any symmetry: aliases carry a per cent of it, with phases.
#[test]
fn a_lattice_marches_as_foretold() {
    let (spacing, centre) = (0.25, [2.33, 1.91]);
    let medium = Medium::Lattice { lattice: CONSTANT, spacing };
    let image = |d: f64, period: f64, a: f64| {
        (-3..=3).map(|j| (-a * (d + period * f64::from(j)).powi(2)).exp()).sum::<f64>()
    };
    for (size, a) in [([20, 14], 20.0), ([15, 13], 8.0)] {
        let sides = size.map(|n| n as f64 * spacing);
        let (xs, ys) = (nodes(size[0], spacing), nodes(size[1], spacing));
        let initial: Vec<f64> = ys
            .iter()
            .flat_map(|y| xs.iter().map(move |x| (x, y)))
            .map(|(x, y)| image(x - centre[0], sides[0], a) * image(y - centre[1], sides[1], a))
            .collect();
        let pulse = PeriodicPulse::new(medium, a, centre, sides).expect("fits");
        for steps in [0, 1, 2, 60, 500] {
            let expected = marched(size, &initial, 0.7, steps);
            let found = pulse.fields_after(&xs, &ys, steps, 0.7 * spacing).expect("stable");
            for part in 0..2 {
                let error = worst(&found[part], &expected[part]);
                assert!(error < 1e-13, "{size:?}, {steps} steps: {error:e}");
            }
        }
        assert!(pulse.fields_after(&xs, &ys, 1, 2.0 * spacing).is_none(), "above the limit");
    }
    assert!(PeriodicPulse::new(medium, 20.0, centre, [5.1, 5.0]).is_none(), "cells do not fill 5.1");
}

/// d'Alembert's two halves in a ring.
fn two_halves(a: f64, length: f64, from_centre: f64, ct: f64) -> f64 {
    (-9..=9)
        .flat_map(|j| [ct, -ct].map(|ct| from_centre + ct + length * f64::from(j)))
        .map(|d| 0.5 * (-a * d * d).exp())
        .sum()
}

#[test]
fn a_local_ring_is_dalemberts() {
    let ring = RingPulse::new(Medium::Local, 50.0, 0.3, 2.0).expect("any");
    let xs = nodes(31, 2.0 / 31.0);
    for ct in [0.0, 0.77, 5.3] {
        let expected: Vec<f64> = xs.iter().map(|x| two_halves(50.0, 2.0, x - 0.3, ct)).collect();
        let error = worst(&ring.displacements(&xs, ct).expect("any"), &expected);
        assert!(error < 1e-14, "{error:e}");
    }
}

// The mean across the box is a wave in one dimension: P along x, S along y.
#[test]
fn means_across_a_local_box_are_dalemberts() {
    let (sides, centre, a) = ([2.0, 3.0], [0.8, 1.1], 40.0);
    let pulse = PeriodicPulse::new(Medium::Local, a, centre, sides).expect("any");
    let (xs, ys) = (nodes(64, 2.0 / 64.0), nodes(90, 3.0 / 90.0));
    let ct = 2.9;
    let [ux, uy] = pulse.fields(&xs, &ys, ct).expect("any");
    let height = (PI / a).sqrt();
    for (i, x) in xs.iter().enumerate() {
        let mean = (0..90).map(|row| ux[row * 64 + i]).sum::<f64>() / 90.0;
        assert!((mean - height / 3.0 * two_halves(a, 2.0, x - centre[0], ct)).abs() < 1e-15);
        assert!((0..90).map(|row| uy[row * 64 + i]).sum::<f64>().abs() < 1e-13);
    }
    for (row, y) in ys.iter().enumerate() {
        let mean = ux[row * 64..][..64].iter().sum::<f64>() / 64.0;
        let expected = height / 2.0 * two_halves(a, 3.0, y - centre[1], ct / 3.0_f64.sqrt());
        assert!((mean - expected).abs() < 1e-15);
    }
}

#[test]
fn a_lattice_ring_marches_as_foretold() {
    let (cells, spacing, a, centre) = (41, 0.1, 60.0, 1.234);
    let length = 41.0 * spacing;
    let ring =
        RingPulse::new(Medium::Lattice { lattice: CONSTANT, spacing }, a, centre, length).expect("fits");
    let xs = nodes(cells, spacing);
    let mut now: Vec<f64> = xs.iter().map(|x| two_halves(a, length, x - centre, 0.0)).collect();
    // m = 2: w_r = 1/(2r), r = 1, 2.
    let push = |u: &[f64], i: usize| -> f64 {
        let pair = |r: usize| (u[(i + r) % 41] + u[(i + 41 - r) % 41] - 2.0 * u[i]) / (2 * r) as f64;
        0.64 * (pair(1) + pair(2))
    };
    let mut moved: Vec<f64> = (0..cells).map(|i| -0.5 * push(&now, i)).collect();
    for step in 0..=400 {
        if [0, 1, 399].contains(&step) {
            let error = worst(&ring.displacements_after(&xs, step, 0.08).expect("stable"), &now);
            assert!(error < 1e-13, "{step}: {error:e}");
        }
        let change: Vec<f64> = (0..cells).map(|i| push(&now, i)).collect();
        for i in 0..cells {
            moved[i] += change[i];
            now[i] += moved[i];
        }
    }
}

/// ∂²/∂s² of a function at 0 by central differences of eighth order.
fn second(f: impl Fn(f64) -> f64, h: f64) -> f64 {
    let weights = [-205.0 / 72.0, 8.0 / 5.0, -1.0 / 5.0, 8.0 / 315.0, -1.0 / 560.0];
    (-4..=4_i32).map(|j| weights[j.unsigned_abs() as usize] * f(f64::from(j) * h)).sum::<f64>() / (h * h)
}

// Differences of eighth order err by 3e-4 h⁸ u⁽¹⁰⁾ ~ 1e-7 here (a = 20, h = 0.01), rounding by 1e-14/h² = 1e-10.
#[test]
fn the_equation_of_a_square_lattices_moduli_holds() {
    let (c11, c12, c66) = (1.3, 0.6, 0.9);
    let medium = Medium::Moduli(lattice::Moduli { c11, c12, c66 });
    let pulse = PeriodicPulse::new(medium, 20.0, [1.03, 0.71], [2.1, 1.7]).expect("any");
    let u = |x: f64, y: f64, ct: f64| pulse.fields(&[x], &[y], ct).expect("any").map(|field| field[0]);
    let h = 0.01;
    for (x, y, ct) in [(0.9, 0.6, 0.31), (1.4, 1.3, 0.77), (0.2, 0.1, 1.9)] {
        for part in 0..2 {
            let along_x = second(|s| u(x + s, y, ct)[part], h);
            let along_y = second(|s| u(x, y + s, ct)[part], h);
            let in_time = second(|s| u(x, y, ct + s)[part], h);
            // 4 ∂²/∂x∂y = second differences along one diagonal less those along the other, over s = √2 h.
            let other = 1 - part;
            let mixed =
                (second(|s| u(x + s, y + s, ct)[other], h) - second(|s| u(x + s, y - s, ct)[other], h)) / 4.0;
            let (stretch, shear) = if part == 0 { (along_x, along_y) } else { (along_y, along_x) };
            let expected = c11 * stretch + c66 / 3.0 * shear + (c12 + c66) / 3.0 * mixed;
            assert!((in_time - expected).abs() < 1e-6, "{in_time} against {expected}");
        }
    }
}

/// u of the infinite plane, by Hankel's integrals: û = (π/a) e^{−k²/4a}, and with C = cos kct for P and cos kct/√3 for S
/// u_x = (1/4a) ∫ e^{−k²/4a} ((C_P + C_S) J₀(kr) − (C_P − C_S) J₂(kr) cos 2θ) k dk,
/// u_y = −(1/4a) ∫ e^{−k²/4a} (C_P − C_S) J₂(kr) sin 2θ k dk; Simpson's rule.
fn infinite_plane(a: f64, from_centre: [f64; 2], ct: f64) -> [f64; 2] {
    let (r, theta) = (from_centre[0].hypot(from_centre[1]), from_centre[1].atan2(from_centre[0]));
    let (end, steps) = (12.5 * a.sqrt(), 40_000);
    let h = end / f64::from(steps);
    let mut sum = [0.0; 2];
    for i in 0..=steps {
        let k = h * f64::from(i);
        let simpson = if i == 0 || i == steps { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
        let factor = simpson * h / 3.0 / (4.0 * a) * libm::exp(-k * k / (4.0 * a)) * k;
        let (p, s) = (libm::cos(k * ct), libm::cos(k * ct / 3.0_f64.sqrt()));
        let second = (p - s) * libm::jn(2, k * r);
        sum[0] += factor * ((p + s) * libm::j0(k * r) - second * libm::cos(2.0 * theta));
        sum[1] -= factor * second * libm::sin(2.0 * theta);
    }
    sum
}

#[test]
fn before_images_arrive_it_is_the_infinite_plane() {
    let (a, centre) = (60.0, [2.0, 2.0]);
    let pulse = PeriodicPulse::new(Medium::Local, a, centre, [4.0, 4.0]).expect("any");
    for ([x, y], ct) in [([0.1, 0.2], 0.2), ([0.7, -0.3], 0.8), ([-0.3, 0.55], 0.9), ([0.05, -0.9], 1.1)] {
        let [ux, uy] = pulse.fields(&[2.0 + x], &[2.0 + y], ct).expect("any");
        let error = worst(&[ux[0], uy[0]], &infinite_plane(a, [x, y], ct));
        assert!(error < 1e-13, "{error:e} at {x}, {y}");
    }
}

// ω differs by (kδ)²/48 at most: at kδ < 1e-4 the phases by 1e-8.
#[test]
fn a_small_horizon_is_local() {
    let nonlocal = Medium::Nonlocal { kernel: Kernel::Constant, horizon: 1e-6 };
    let [near, exact] = [nonlocal, Medium::Local].map(|medium| {
        let pulse = PeriodicPulse::new(medium, 30.0, [0.5, 0.4], [1.0, 1.0]).expect("in range");
        pulse.fields(&[0.1, 0.8], &[0.3, 0.6], 1.7).expect("in range")
    });
    assert!(worst(&near[0], &exact[0]) < 1e-8 && worst(&near[1], &exact[1]) < 1e-8);
    assert!(PeriodicPulse::new(Medium::Local, -1.0, [0.0; 2], [1.0; 2]).is_none());
    assert!(RingPulse::new(Medium::Local, 1.0, 0.0, f64::NAN).is_none());
}
