//! The bar at rest: finite differences in closed form, a dense solution in doubles, balance, and a doubled bar.

use pd_verify_reference::static_bar::{Correction, LeftEnd, StaticBar};
use pd_verify_reference::{Kernel, Lattice, VolumeRule, lattice};

const NEAREST: Lattice =
    Lattice { kernel: Kernel::Constant, m: 1.0, rule: VolumeRule::Full, calibrated: true };
const CORRECTIONS: [Correction; 3] = [Correction::None, Correction::Energy, Correction::Volume];

fn bar(lattice: Lattice, nodes: usize, correction: Correction, layer: usize) -> StaticBar {
    StaticBar { lattice, nodes, left: LeftEnd::Free, correction, layer }
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().map(f64::abs).fold(0.0, f64::max)
}

#[test]
fn nearest_neighbours_are_finite_differences() {
    let nodes = 40;
    for layer in [1, 3, 7] {
        let bar = bar(NEAREST, nodes, Correction::None, layer);
        let solved = bar.solve().expect("held together");
        // The stress in the spring between nodes k and k + 1 is what pulls beyond it.
        let stress = |k: usize| ((k + 1).min(nodes - 1 - k) as f64 / layer as f64).min(1.0);
        let from_left: Vec<f64> = (0..nodes).map(|i| (0..i).map(stress).sum()).collect();
        let mean = from_left.iter().sum::<f64>() / nodes as f64;
        let error = largest((0..nodes).map(|i| solved.displacements[i] - (from_left[i] - mean)));
        assert!(error < 1e-13, "{error:e}");
        let mirrored = StaticBar { left: LeftEnd::Mirror, ..bar };
        for (bar, solved) in [(bar, solved), (mirrored, mirrored.solve().expect("held together"))] {
            assert!((solved.recovered_modulus() - bar.local_modulus()).abs() < 1e-14);
            assert!((solved.middle_modulus() - 1.0).abs() < 1e-14);
        }
    }
}

/// K u = b in doubles with pivots, for the full constant kernel: w_r = 2/(m²r).
fn dense(nodes: usize, m: usize, correction: Correction, layer: usize) -> Vec<f64> {
    let weight = |r: usize| 2.0 / ((m * m * r) as f64);
    let near = |i: usize, j: usize| i != j && i.abs_diff(j) <= m;
    let sum = |i: usize, term: &dyn Fn(usize) -> f64| -> f64 {
        (0..nodes).filter(|&j| near(i, j)).map(|j| term(i.abs_diff(j))).sum()
    };
    let modulus: f64 = (1..=m).map(|r| weight(r) * (r * r) as f64).sum();
    let nodal = |i: usize| match correction {
        Correction::None => 1.0,
        Correction::Energy => 0.5 * modulus / (0.25 * sum(i, &|r| weight(r) * (r * r) as f64)),
        Correction::Volume => 2.0 * m as f64 / sum(i, &|_| 1.0),
    };
    let factor = |i: usize, j: usize| match correction {
        Correction::Volume => 2.0 / (1.0 / nodal(i) + 1.0 / nodal(j)),
        _ => 0.5 * (nodal(i) + nodal(j)),
    };
    // Last column: loads. Every row also holds the mean, which makes the stiffness regular.
    let mut rows: Vec<Vec<f64>> = (0..nodes)
        .map(|i| {
            let mut row = vec![1.0; nodes + 1];
            for j in (0..nodes).filter(|&j| near(i, j)) {
                let stiffness = factor(i, j) * weight(i.abs_diff(j));
                row[j] -= stiffness;
                row[i] += stiffness;
            }
            let (left, right) = (i < layer, i + layer >= nodes);
            row[nodes] = (f64::from(right) - f64::from(left)) / layer as f64;
            row
        })
        .collect();
    for column in 0..nodes {
        let best = (column..nodes)
            .max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))
            .expect("a row");
        rows.swap(column, best);
        let pivot = rows[column].clone();
        for row in rows.iter_mut().skip(column + 1) {
            let share = row[column] / pivot[column];
            row.iter_mut().zip(&pivot).for_each(|(value, p)| *value -= share * p);
        }
    }
    let mut u = vec![0.0; nodes];
    for i in (0..nodes).rev() {
        let known: f64 = (i + 1..nodes).map(|j| rows[i][j] * u[j]).sum();
        u[i] = (rows[i][nodes] - known) / rows[i][i];
    }
    u
}

#[test]
fn a_dense_solution_in_doubles_agrees() {
    for (m, nodes, layer) in [(2, 12, 2), (3, 60, 3), (5, 80, 1), (6, 9, 2)] {
        let lattice = Lattice { kernel: Kernel::Constant, m: m as f64, ..NEAREST };
        let lattice = Lattice { calibrated: false, ..lattice };
        for correction in CORRECTIONS {
            let found = bar(lattice, nodes, correction, layer).solve().expect("held together").displacements;
            let expected = dense(nodes, m, correction, layer);
            let error = largest(found.iter().zip(&expected).map(|(a, b)| a - b)) / largest(found.clone());
            assert!(error < 1e-12, "m = {m}, {correction:?}: {error:e}");
        }
    }
}

#[test]
fn at_rest_forces_balance_loads_to_rounding() {
    let kernel = Kernel::Gaussian { p: 2.0 };
    for rule in [VolumeRule::Full, VolumeRule::Linear] {
        for correction in CORRECTIONS {
            for left in [LeftEnd::Free, LeftEnd::Mirror] {
                let lattice = Lattice { kernel, m: 5.3, rule, calibrated: false };
                let bar = StaticBar { lattice, nodes: 200, left, correction, layer: 5 };
                let solved = bar.solve().expect("held together");
                let forces = bar.forces(&solved.displacements).expect("as many as nodes");
                let rest = largest(forces.iter().zip(bar.body_forces()).map(|(force, load)| force + load));
                // Displacements rounded to doubles leave 200 · 1e-16 · Σw.
                assert!(rest < 1e-13, "{rest:e}");
                if left == LeftEnd::Free {
                    assert!(forces.iter().sum::<f64>().abs() < 1e-13);
                    let mirrored = solved.displacements.iter().rev().zip(&solved.displacements);
                    assert!(largest(mirrored.map(|(a, b)| a + b)) < 1e-13 * 200.0);
                }
            }
        }
    }
    let bar = bar(NEAREST, 8, Correction::None, 1);
    assert!(bar.forces(&[0.0; 7]).is_none());
    assert_eq!(bar.forces(&[1.0; 8]), Some(vec![0.0; 8]), "a rigid motion");
}

#[test]
fn corrections_are_one_inside_and_stiffen_the_ends() {
    for (m, calibrated) in [(3.0, false), (4.5, false), (5.0, true)] {
        let lattice =
            Lattice { kernel: Kernel::Gaussian { p: 2.0 }, m, rule: VolumeRule::Linear, calibrated };
        for correction in CORRECTIONS {
            let bar = bar(lattice, 40, correction, 1);
            for i in 6..34 {
                assert_eq!(bar.bond_factor(i, 39 - i), Some(1.0), "{correction:?}, node {i}");
            }
            let end = bar.bond_factor(0, 1).expect("both in the body");
            assert!(correction == Correction::None || (1.4..=2.0).contains(&end), "{correction:?}: {end}");
            assert_eq!((bar.bond_factor(0, 40), bar.bond_factor(-1, 0)), (None, None));
        }
    }
    // By hand, m = 2, constant, full: V = 2, 3, 4, 4, … and Σwr² in units of w₁: 1 + 2, 2 + 2, 2 + 4.
    let lattice = Lattice { kernel: Kernel::Constant, m: 2.0, ..NEAREST };
    let factor = |correction, i, j| bar(lattice, 9, correction, 1).bond_factor(i, j).expect("in the body");
    assert_eq!(factor(Correction::Volume, 0, 1), 8.0 / 5.0);
    assert_eq!(factor(Correction::Volume, 1, 3), 8.0 / 7.0);
    let energy = factor(Correction::Energy, 0, 1);
    assert!((energy - 0.5 * (6.0 / 3.0 + 6.0 / 4.0)).abs() < 1e-15, "{energy}");
}

#[test]
fn a_mirror_is_the_right_half_of_a_doubled_bar() {
    for (m, nodes, layer) in [(3.0, 50, 3), (5.0, 7, 2), (9.0, 5, 1)] {
        for correction in CORRECTIONS {
            let lattice = Lattice {
                kernel: Kernel::Exponential { p: 3.0 },
                m,
                rule: VolumeRule::Full,
                calibrated: true,
            };
            let whole = bar(lattice, 2 * nodes, correction, layer);
            let half = StaticBar { nodes, left: LeftEnd::Mirror, ..whole };
            assert_eq!(half.bond_factor(0, -1), whole.bond_factor(nodes as isize, nodes as isize - 1));
            let (whole, half) = (whole.solve().expect("held together"), half.solve().expect("held together"));
            let difference = whole.displacements[nodes..].iter().zip(&half.displacements).map(|(a, b)| a - b);
            assert!(largest(difference) < 1e-14 * nodes as f64);
            assert!((whole.recovered_modulus() - half.recovered_modulus()).abs() < 1e-14);
            assert!((whole.middle_modulus() - half.middle_modulus()).abs() < 1e-14);
        }
    }
}

// Far from ends a long bar is the infinite lattice: its strain is σ over the lattice's modulus.
#[test]
fn the_middle_of_a_long_bar_has_the_modulus_of_the_lattice() {
    for (kernel, rule) in
        [(Kernel::Constant, VolumeRule::Full), (Kernel::Gaussian { p: 2.0 }, VolumeRule::Linear)]
    {
        let lattice = Lattice { kernel, m: 4.0, rule, calibrated: false };
        for correction in CORRECTIONS {
            let solved = bar(lattice, 400, correction, 4).solve().expect("held together");
            let error = solved.middle_modulus() / lattice::bar_modulus(lattice) - 1.0;
            assert!(error.abs() < 1e-12, "{correction:?}: {error:e}");
        }
    }
}

#[test]
fn what_cannot_be_pulled_has_no_answer() {
    let refused = |bar: StaticBar| bar.solve().is_none();
    let good = bar(NEAREST, 8, Correction::None, 4);
    assert!(!refused(good));
    assert!(refused(StaticBar { layer: 0, ..good }) && refused(StaticBar { layer: 5, ..good }));
    assert!(!refused(StaticBar { layer: 5, left: LeftEnd::Mirror, ..good }));
    assert!(refused(StaticBar { nodes: 3, layer: 1, ..good }));
    // A cone of one spacing has no bonds.
    let loose = Lattice { kernel: Kernel::Conical, calibrated: false, ..NEAREST };
    assert!(refused(StaticBar { lattice: loose, ..good }));
    assert_eq!(StaticBar { lattice: loose, ..good }.bond_factor(0, 1), None);
}
