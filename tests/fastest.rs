//! The fastest mode of a body, held against the closed form of a ring and against eigenvalues of a matrix made bond by bond.

#[path = "conformance/bodies.rs"]
#[allow(dead_code)]
mod bodies;

use bodies::{constant, scene};
use nalgebra::{DMatrix, SymmetricEigen};
use pd_verify::constraints::{Edge, Edges};
use pd_verify::fastest::{NoMode, fastest};
use pd_verify::forces::family;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::{Initial, Notch, Rotations, Scene, Shape};
use std::f64::consts::PI;

/// With waves of no symmetry in every component.
fn rough<const D: usize>(body: Scene<D>) -> Scene<D> {
    let dx = body.spacing;
    let wave = |component: usize, turn: f64| Initial {
        component,
        amplitude: 1e-3 * dx,
        shape: Shape::Wave {
            wavenumber: std::array::from_fn(|axis| (turn + 0.7 * axis as f64) / dx),
            phase: turn,
        },
    };
    let displacement = (0..D)
        .flat_map(|component| [1.3, 2.4, 3.05].map(|turn| wave(component, turn + 0.2 * component as f64)));
    Scene { displacement: displacement.collect(), ..body }
}

#[test]
fn a_ring_is_as_fast_as_its_fastest_wave() {
    for m in [1.0, 2.0, 3.0, 5.0] {
        let ring = rough(scene::<1>(constant(m, VolumeRule::Full, false), [48]));
        let ring = Scene { edges: Edges([[Edge::Periodic; 2]]), ..ring };
        // ω² = (2v²/(m²Δx²)) Σ_{j≠0} (1 − cos jkΔx)/|j| at the ring's wavenumbers.
        let reach = m as i32;
        let square = |n: i32| {
            let theta = 2.0 * PI * f64::from(n) / 48.0;
            let bonds = (1..=reach).map(|j| (1.0 - (theta * f64::from(j)).cos()) / f64::from(j));
            4.0 / (m * m) * bonds.sum::<f64>()
        };
        let largest = (0..=24).map(square).fold(0.0, f64::max).sqrt() * ring.speed() / ring.spacing;
        let found = fastest(&ring).unwrap();
        assert!((found.omega / largest - 1.0).abs() < 1e-12, "m = {m}: {} and {largest}", found.omega);
    }
}

/// K/ρ of a free plate, from its bonds one by one; a bond is cut by `cut`.
fn matrix(plate: &Scene<2>, cut: impl Fn([f64; 2], [f64; 2]) -> bool) -> DMatrix<f64> {
    let bonds = family(&Stencil::<2>::new(plate.lattice).unwrap(), plate.modulus(), plate.spacing);
    let [columns, rows] = plate.nodes.map(|n| n as i32);
    let size = 2 * (columns * rows) as usize;
    let mut matrix = DMatrix::zeros(size, size);
    for (y, x) in (0..rows).flat_map(|y| (0..columns).map(move |x| (y, x))) {
        for bond in &bonds {
            let [i, j] = [x + bond.offset[0], y + bond.offset[1]];
            let place = |x: i32, y: i32| [x, y].map(|n| (f64::from(n) + 0.5) * plate.spacing);
            if !(0..columns).contains(&i) || !(0..rows).contains(&j) || cut(place(x, y), place(i, j)) {
                continue;
            }
            let [a, b] = [(x, y), (i, j)].map(|(x, y)| 2 * (y * columns + x) as usize);
            let length = f64::from(bond.offset[0]).hypot(f64::from(bond.offset[1]));
            let unit = bond.offset.map(|n| f64::from(n) / length);
            for (p, q) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let stiff = bond.weight * unit[p] * unit[q] / plate.material.density;
                matrix[(a + p, a + q)] += stiff;
                matrix[(b + p, b + q)] += stiff;
                matrix[(a + p, b + q)] -= stiff;
                matrix[(b + p, a + q)] -= stiff;
            }
        }
    }
    matrix
}

#[test]
fn a_free_plate_is_as_fast_as_the_largest_eigenvalue_of_its_matrix() {
    let dx = scene::<2>(constant(2.0, VolumeRule::Linear, true), [11, 8]).spacing;
    let slit = |a: [f64; 2], b: [f64; 2]| {
        // From the left to the middle, between the rows 3 and 4.
        let height = 4.0 * dx;
        if (a[1] < height) == (b[1] < height) {
            return false;
        }
        let share = (height - a[1]) / (b[1] - a[1]);
        a[0] + share * (b[0] - a[0]) <= 5.3 * dx
    };
    let narrow = Lattice { kernel: Kernel::Gaussian { p: 2.0 }, ..constant(3.0, VolumeRule::Linear, false) };
    for lattice in [constant(2.0, VolumeRule::Linear, true), narrow] {
        let plate = rough(scene::<2>(lattice, [11, 8]));
        let notched = Scene {
            notches: vec![Notch { from: [0.0, 4.0 * dx], to: [5.3 * dx, 4.0 * dx] }],
            ..plate.clone()
        };
        for (plate, matrix) in [(&plate, matrix(&plate, |_, _| false)), (&notched, matrix(&notched, slit))] {
            let eigen = SymmetricEigen::new(matrix);
            let top = eigen.eigenvalues.imax();
            let found = fastest(plate).unwrap();
            // Both are exact to some 1e-15 of the largest eigenvalue.
            let square = eigen.eigenvalues[top];
            assert!((found.omega * found.omega / square - 1.0).abs() < 1e-12, "{found:?}");
            let mut squares: Vec<f64> = eigen.eigenvalues.iter().copied().collect();
            squares.sort_by(|a, b| b.total_cmp(a));
            assert!((found.next_omega.powi(2) / squares[1] - 1.0).abs() < 1e-9, "{}", found.next_omega);
            let vector = eigen.eigenvectors.column(top);
            let along: f64 = vector.iter().zip(found.mode.as_flattened()).map(|(a, b)| a * b).sum();
            assert!(1.0 - along.abs() < 1e-9, "{along}");
        }
    }
}

#[test]
fn what_has_no_mode_says_so() {
    let plate = scene::<2>(constant(2.0, VolumeRule::Linear, true), [11, 8]);
    assert_eq!(fastest(&plate), Err(NoMode::NoStart));
    let exact = Scene { rotations: Rotations::Finite, ..rough(plate) };
    assert_eq!(fastest(&exact), Err(NoMode::NotLinear));
}
