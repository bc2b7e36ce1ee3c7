//! Waves on the square lattice of a plate: the eigenvalues of Σ_b w_b n_b⊗n_b 4 sin²(k·ξ_b/2), over C₁₁/Δx².

use super::{Branch, Wave};
use crate::lattice::Stencil;

/// A symmetric 2×2 matrix.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Symmetric {
    pub xx: f64,
    pub xy: f64,
    pub yy: f64,
}

impl Symmetric {
    /// Eigenvalues, larger first, and the unit eigenvector of the larger (LAPACK's DLAEV2).
    pub fn eigen(self) -> ([f64; 2], [f64; 2]) {
        let (sum, difference) = (self.xx + self.yy, self.xx - self.yy);
        let root = difference.hypot(2.0 * self.xy);
        let larger = 0.5 * (sum + root);
        // The determinant over the larger keeps the digits of the smaller.
        let (big, small) =
            if self.xx.abs() > self.yy.abs() { (self.xx, self.yy) } else { (self.yy, self.xx) };
        let smaller = if larger == 0.0 { 0.0 } else { (big / larger) * small - (self.xy / larger) * self.xy };
        let angle = 0.5 * libm::atan2(2.0 * self.xy, difference);
        ([larger, smaller], [libm::cos(angle), libm::sin(angle)])
    }

    fn add(&mut self, factor: f64, other: Self) {
        self.xx += factor * other.xx;
        self.xy += factor * other.xy;
        self.yy += factor * other.yy;
    }

    fn along(self, e: [f64; 2]) -> f64 {
        self.xx * e[0] * e[0] + 2.0 * self.xy * e[0] * e[1] + self.yy * e[1] * e[1]
    }
}

/// Picks the branch: P has the larger |e·k̂|, the larger ω where both are equally inclined.
///
/// Returns the square of ωΔx/c_d and the polarisation.
pub fn pick(matrix: Symmetric, direction: [f64; 2], branch: Branch) -> (f64, [f64; 2]) {
    let ([larger, smaller], e) = matrix.eigen();
    let across = [-e[1], e[0]];
    let inclination = |v: [f64; 2]| (v[0] * direction[0] + v[1] * direction[1]).abs();
    let larger_is_p = inclination(e) >= inclination(across) - 1e-12;
    if larger_is_p == (branch == Branch::P) { (larger, e) } else { (smaller, across) }
}

/// The unit vector at `degrees` from the x axis, exact along axes and diagonals.
pub fn direction(degrees: f64) -> [f64; 2] {
    let turns = (degrees / 90.0).floor();
    let rest = (degrees - 90.0 * turns).to_radians();
    let [cosine, sine] = match degrees - 90.0 * turns {
        0.0 => [1.0, 0.0],
        45.0 => [std::f64::consts::FRAC_1_SQRT_2; 2],
        _ => [libm::cos(rest), libm::sin(rest)],
    };
    match turns.rem_euclid(4.0) as u8 {
        0 => [cosine, sine],
        1 => [-sine, cosine],
        2 => [-cosine, -sine],
        _ => [sine, -cosine],
    }
}

/// Unit of the branch's own speed: c_d² over its c².
pub fn speed_ratio_squared(branch: Branch) -> f64 {
    match branch {
        Branch::P => 1.0,
        Branch::S => 3.0,
    }
}

/// The dispersion relation of one stencil.
#[derive(Debug, Clone)]
pub struct PlaneDispersion {
    bonds: Vec<PairOfBonds>,
    reach: usize,
}

#[derive(Debug, Clone, Copy)]
struct PairOfBonds {
    /// Offset; the row is never negative.
    column: i32,
    row: usize,
    /// w n⊗n.
    stiffness: Symmetric,
}

impl PlaneDispersion {
    /// The relation of this stencil.
    pub fn new(stencil: &Stencil<2>) -> Self {
        let bonds = stencil.bonds.iter().map(|bond| {
            let [i, j] = bond.offset.map(f64::from);
            let weight = bond.weight / (i * i + j * j);
            let stiffness = Symmetric { xx: weight * i * i, xy: weight * i * j, yy: weight * j * j };
            PairOfBonds { column: bond.offset[0], row: bond.offset[1] as usize, stiffness }
        });
        Self { bonds: bonds.collect(), reach: stencil.reach() }
    }

    /// The matrix whose eigenvalues are (ωΔx/c_d)², at θ = (k_x Δx, k_y Δx).
    pub fn matrix(&self, theta: [f64; 2]) -> Symmetric {
        self.matrix_and_slope(theta, [0.0; 2]).0
    }

    /// [`Self::matrix`] and its derivative along `direction`.
    fn matrix_and_slope(&self, theta: [f64; 2], direction: [f64; 2]) -> (Symmetric, Symmetric) {
        let half_x = half_angles(self.reach, theta[0]);
        let half_y = half_angles(self.reach, theta[1]);
        let (mut total, mut slope) = (Symmetric::default(), Symmetric::default());
        for bond in &self.bonds {
            let (sine, cosine) = half_x[bond.column.unsigned_abs() as usize];
            let sine = if bond.column < 0 { -sine } else { sine };
            let (row_sine, row_cosine) = half_y[bond.row];
            let combined = sine * row_cosine + cosine * row_sine;
            let across = cosine * row_cosine - sine * row_sine;
            let along = f64::from(bond.column) * direction[0] + bond.row as f64 * direction[1];
            total.add(4.0 * combined * combined, bond.stiffness);
            slope.add(4.0 * combined * across * along, bond.stiffness);
        }
        (total, slope)
    }

    /// The wave of a branch at |k|Δx along `degrees`, in units of the branch's own speed.
    pub fn wave(&self, k_dx: f64, degrees: f64, branch: Branch) -> Wave {
        let along = direction(degrees);
        let scale = speed_ratio_squared(branch);
        let (matrix, slope) = self.matrix_and_slope(along.map(|n| n * k_dx), along);
        let (square, polarisation) = pick(matrix, along, branch);
        if square == 0.0 {
            return Wave { omega: 0.0, group: self.long_wave(degrees, branch) };
        }
        Wave::from_square(scale * square, scale * slope.along(polarisation), 0.0)
    }

    /// Phase speed over the branch's own as k → 0.
    pub fn long_wave(&self, degrees: f64, branch: Branch) -> f64 {
        let along = direction(degrees);
        let mut christoffel = Symmetric::default();
        for bond in &self.bonds {
            let projected = f64::from(bond.column) * along[0] + bond.row as f64 * along[1];
            let factor = projected * projected;
            christoffel.add(factor, bond.stiffness);
        }
        (speed_ratio_squared(branch) * pick(christoffel, along, branch).0).max(0.0).sqrt()
    }
}

/// sin and cos of nθ/2 for n = 0..=reach.
fn half_angles(reach: usize, theta: f64) -> Vec<(f64, f64)> {
    (0..=reach).map(|n| libm::sincos(0.5 * n as f64 * theta)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Kernel;
    use crate::lattice::Lattice;
    use crate::partial_volume::VolumeRule;
    use approx::assert_relative_eq;

    fn relation(calibrated: bool) -> PlaneDispersion {
        let lattice = Lattice {
            kernel: Kernel::Gaussian { p: 2.0 },
            m: 3.0,
            volume_rule: VolumeRule::Linear,
            calibrated,
        };
        PlaneDispersion::new(&Stencil::new(lattice).unwrap())
    }

    #[test]
    fn eigenvalues_of_a_graded_matrix_keep_their_digits() {
        let ([larger, smaller], e) = Symmetric { xx: 1e-12, xy: 0.0, yy: 1.0 }.eigen();
        assert_eq!((larger, smaller), (1.0, 1e-12));
        assert_relative_eq!(e[1].abs(), 1.0);
        assert_eq!(Symmetric::default().eigen().0, [0.0, 0.0]);
    }

    #[test]
    fn calibrated_long_waves_are_isotropic_and_printed_ones_are_not() {
        for degrees in [0.0, 17.0, 45.0, 80.0] {
            for branch in [Branch::P, Branch::S] {
                assert_relative_eq!(relation(true).long_wave(degrees, branch), 1.0, max_relative = 1e-13);
            }
        }
        assert!(
            (relation(false).long_wave(0.0, Branch::S) - relation(false).long_wave(45.0, Branch::S)).abs()
                > 0.01
        );
    }

    #[test]
    fn group_velocity_is_the_slope_along_the_ray() {
        let lattice = relation(true);
        let h = 1e-6;
        for degrees in [0.0, 26.0, 45.0, 111.0] {
            for branch in [Branch::P, Branch::S] {
                let omega = |k| lattice.wave(k, degrees, branch).omega;
                let slope = (omega(1.2 + h) - omega(1.2 - h)) / (2.0 * h);
                assert_relative_eq!(lattice.wave(1.2, degrees, branch).group, slope, max_relative = 1e-7);
            }
        }
    }

    #[test]
    fn directions_along_axes_and_diagonals_are_exact() {
        let r = std::f64::consts::FRAC_1_SQRT_2;
        assert_eq!(
            [0.0, 90.0, 180.0, 270.0, 360.0].map(direction),
            [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 0.0]]
                .map(|v: [f64; 2]| v.map(|x| x + 0.0))
        );
        assert_eq!([45.0, 135.0, -45.0].map(direction), [[r, r], [-r, r], [r, -r]]);
    }
}
