//! The highest frequency a lattice can carry, which sets the largest stable time step.
//!
//! max over k of ω(k), by brute force: ω² on a dense grid over the Brillouin zone (0 ≤ κ ≤ π in a bar,
//! 0 ≤ κ_y ≤ κ_x ≤ π in the plane, the rest by symmetry), then every grid maximum within 5 % of the best is
//! climbed by a pattern search whose step halves to 1e-10. A local maximum of the larger eigenvalue is smooth
//! (branches cross in minima of it), so ω² is right to about 1e-15. In doubles; weights from the exact family.

use crate::bonds::Lattice;
use crate::double_double::Dd;
use crate::lattice;

/// Grid cells per unit of m over (0, π): some 32 to the shortest ripple cos(mκ).
const CELLS: f64 = 16.0;

/// Largest ωΔx/v of a bar.
pub(crate) fn bar(lattice: Lattice) -> f64 {
    let bonds: Vec<(f64, f64)> =
        lattice::bar_bonds(&lattice).into_iter().map(|bond| (bond.offset, bond.weight.to_f64())).collect();
    let square = |k: [f64; 2]| {
        bonds.iter().map(|(r, weight)| 4.0 * weight * libm::sin(r * k[0] / 2.0).powi(2)).sum::<f64>()
    };
    let cells = (CELLS * lattice.m * 8.0).ceil() as usize;
    let step = std::f64::consts::PI / cells as f64;
    let grid: Vec<([f64; 2], f64)> =
        (0..=cells).map(|i| [i as f64 * step, 0.0]).map(|k| (k, square(k))).collect();
    highest(&grid, step, &[[1.0, 0.0], [-1.0, 0.0]], square)
}

/// Largest ωΔx/c_d of the plane. Bonds at ±r together, and the four mirror images by cosines of one axis each.
pub(crate) fn plane(lattice: Lattice) -> f64 {
    let bonds: Vec<[f64; 5]> = lattice::plane_bonds(&lattice)
        .into_iter()
        .filter(|(bond, _)| bond.x >= 0.0 && bond.y >= 0.0)
        .map(|(bond, weight)| {
            let images = if bond.x == 0.0 || bond.y == 0.0 { 2.0 } else { 4.0 };
            let part = |component: Dd| (weight * component * images).to_f64();
            let product = Dd::from(bond.x * bond.y) / bond.length.squared();
            [bond.x, bond.y, part(bond.cosine_squared()), part(product), part(bond.sine_squared())]
        })
        .collect();
    let square = |k: [f64; 2]| larger_eigenvalue(&bonds, k);
    let cells = (CELLS * lattice.m).ceil() as usize;
    let step = std::f64::consts::PI / cells as f64;
    let points = (0..=cells).flat_map(|i| (0..=i).map(move |j| [i as f64 * step, j as f64 * step]));
    let grid: Vec<([f64; 2], f64)> = points.map(|k| (k, square(k))).collect();
    let around = [
        [1.0, 0.0],
        [-1.0, 0.0],
        [0.0, 1.0],
        [0.0, -1.0],
        [1.0, 1.0],
        [1.0, -1.0],
        [-1.0, 1.0],
        [-1.0, -1.0],
    ];
    highest(&grid, step, &around, square)
}

/// The larger eigenvalue of Σ w n⊗n (1 − cos k·r) over the four mirror images (±x, ±y) of every bond:
/// 1 − cos(κ_x x) cos(κ_y y) on the diagonal, sin(κ_x x) sin(κ_y y) off it.
fn larger_eigenvalue(bonds: &[[f64; 5]], k: [f64; 2]) -> f64 {
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for [x, y, along, product, across] in bonds {
        let ((sin_x, cos_x), (sin_y, cos_y)) = (libm::sincos(k[0] * x), libm::sincos(k[1] * y));
        xx += along * (1.0 - cos_x * cos_y);
        yy += across * (1.0 - cos_x * cos_y);
        xy += product * sin_x * sin_y;
    }
    (xx + yy) / 2.0 + libm::hypot((xx - yy) / 2.0, xy)
}

/// The root of the best value after climbing from every promising grid point.
fn highest(
    grid: &[([f64; 2], f64)],
    step: f64,
    around: &[[f64; 2]],
    square: impl Fn([f64; 2]) -> f64,
) -> f64 {
    let best = grid.iter().fold(f64::NAN, |best, (_, value)| best.max(*value));
    let local_maximum = |k: [f64; 2], value: f64| {
        around.iter().all(|way| square([k[0] + step * way[0], k[1] + step * way[1]]) <= value * (1.0 + 1e-12))
    };
    let peaks = grid.iter().filter(|(k, value)| *value >= 0.95 * best && local_maximum(*k, *value));
    peaks.map(|(k, value)| climb(*k, *value, step, around, &square)).fold(best, f64::max).sqrt()
}

/// Walk to the best neighbour; where there is none, halve the step.
fn climb(
    mut place: [f64; 2],
    mut value: f64,
    mut step: f64,
    around: &[[f64; 2]],
    square: &impl Fn([f64; 2]) -> f64,
) -> f64 {
    while step > 1e-10 {
        let candidates = around.iter().map(|way| [place[0] + step * way[0], place[1] + step * way[1]]);
        let (best, best_value) = candidates
            .map(|k| (k, square(k)))
            .fold((place, value), |best, candidate| if candidate.1 > best.1 { candidate } else { best });
        if best_value > value {
            (place, value) = (best, best_value);
        } else {
            step /= 2.0;
        }
    }
    value
}
