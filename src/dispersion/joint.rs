//! What a joint of two lattices sends back: nodes n < 0 obey one stencil, nodes n ≥ 0 another, at equal Δx and ρ.
//!
//! Three answers. By impedances Z = ρω/k at equal k, as Wildman & Gazonas 2014 (Int. J. Fract. 190, 39), (29),
//! print it; by impedances at equal ω, since a wave keeps its frequency; and exactly. Exactly, each side carries
//! the modes zⁿ of its own stencil that leave the joint or fade from it. A node of reach r feels the other side
//! r nodes deep, so the two fields, each continued by its own modes, agree on nodes −r_right … r_left − 1.

use super::bar::BarDispersion;
use crate::lattice::Stencil;
use nalgebra::{Complex, DMatrix, DVector};
use std::f64::consts::PI;

/// A half-infinite chain.
#[derive(Debug, Clone)]
pub struct Chain {
    relation: BarDispersion,
}

impl Chain {
    /// Finite differences: one spring.
    pub fn finite_differences() -> Self {
        Self { relation: BarDispersion::of_weights(vec![1.0]) }
    }

    /// A peridynamic lattice.
    pub fn peridynamic(stencil: &Stencil<1>) -> Self {
        Self { relation: BarDispersion::new(stencil) }
    }

    /// ωΔx/v at θ = kΔx.
    pub fn frequency(&self, theta: f64) -> f64 {
        self.relation.wave(theta).omega
    }

    fn group(&self, theta: f64) -> f64 {
        self.relation.wave(theta).group
    }

    /// All modes zⁿ of frequency ωΔx/v that leave towards +∞ or fade there.
    fn outgoing(&self, omega: f64) -> Vec<Mode> {
        self.cosines(omega).into_iter().map(|cosine| self.mode(cosine)).collect()
    }

    /// The roots c = cos θ of Σ 2w_j (1 − T_j(c)) = (ωΔx/v)², from the companion matrix, polished by Newton.
    fn cosines(&self, omega: f64) -> Vec<Complex<f64>> {
        let polynomial = self.polynomial(omega);
        let degree = polynomial.len() - 1;
        let companion = DMatrix::from_fn(degree, degree, |row, column| {
            let below = f64::from(row == column + 1);
            if column + 1 == degree { below - polynomial[row] / polynomial[degree] } else { below }
        });
        companion.complex_eigenvalues().iter().map(|&root| polish(&polynomial, root)).collect()
    }

    /// Coefficients in powers of c, lowest first.
    fn polynomial(&self, omega: f64) -> Vec<f64> {
        let weights = self.relation.weights();
        let degree = weights.len();
        let mut total = vec![0.0; degree + 1];
        total[0] = -omega * omega;
        let (mut previous, mut chebyshev) = (vec![1.0], vec![0.0, 1.0]);
        for &weight in weights {
            total[0] += 2.0 * weight;
            for (power, coefficient) in chebyshev.iter().enumerate() {
                total[power] -= 2.0 * weight * coefficient;
            }
            let mut next = vec![0.0; chebyshev.len() + 1];
            for (power, coefficient) in chebyshev.iter().enumerate() {
                next[power + 1] += 2.0 * coefficient;
            }
            for (power, coefficient) in previous.iter().enumerate() {
                next[power] -= coefficient;
            }
            previous = std::mem::replace(&mut chebyshev, next);
        }
        total
    }

    fn mode(&self, cosine: Complex<f64>) -> Mode {
        if cosine.im.abs() < 1e-11 && cosine.re.abs() <= 1.0 {
            let theta = libm::acos(cosine.re);
            let towards = self.group(theta).signum() * theta;
            return Mode { z: Complex::from_polar(1.0, towards), travelling: Some(towards) };
        }
        let root = (cosine * cosine - 1.0).sqrt();
        let z = if (cosine + root).norm() < 1.0 { cosine + root } else { cosine - root };
        Mode { z, travelling: None }
    }
}

/// zⁿ, with its wavenumber if it travels.
#[derive(Debug, Clone, Copy)]
struct Mode {
    z: Complex<f64>,
    travelling: Option<f64>,
}

fn polish(polynomial: &[f64], start: Complex<f64>) -> Complex<f64> {
    let mut root = start;
    for _ in 0..4 {
        let (mut value, mut slope) = (Complex::new(0.0, 0.0), Complex::new(0.0, 0.0));
        for &coefficient in polynomial.iter().rev() {
            slope = slope * root + value;
            value = value * root + coefficient;
        }
        let step = value / slope;
        if !step.norm().is_finite() || step.norm() > 1e-3 {
            break;
        }
        root -= step;
    }
    root
}

/// R as printed: (Z_left − Z_right)/(Z_left + Z_right), both at the same wavenumber θ = kΔx.
pub fn impedances_at_equal_wavenumber(left: &Chain, right: &Chain, theta: f64) -> f64 {
    let (left, right) = (left.frequency(theta), right.frequency(theta));
    (left - right) / (left + right)
}

/// R from impedances at the frequency of the left chain's wave θ; `None` where the right chain carries none.
pub fn impedances_at_equal_frequency(left: &Chain, right: &Chain, theta: f64) -> Option<f64> {
    let omega = left.frequency(theta);
    let other = longest_wave(&right.outgoing(omega))?;
    Some((other - theta) / (other + theta))
}

fn longest_wave(modes: &[Mode]) -> Option<f64> {
    modes.iter().filter_map(|mode| mode.travelling).filter(|&theta| theta > 0.0).min_by(f64::total_cmp)
}

/// R of the left chain's wave θ in (0, π), travelling to the right: what comes back with the same wavenumber, over
/// what was sent, phases counted from node 0.
///
/// `None` where the two fields cannot be matched: at a band edge, or where θ travels to the left.
pub fn exact(left: &Chain, right: &Chain, theta: f64) -> Option<Complex<f64>> {
    if !(theta > 0.0 && theta < PI) || left.group(theta) <= 0.0 {
        return None;
    }
    let omega = left.frequency(theta);
    let (back, forth) = (left.outgoing(omega), right.outgoing(omega));
    let first = -(forth.len() as i32);
    let nodes = back.len() + forth.len();
    let node = |row: usize| first + row as i32;
    let matrix = DMatrix::from_fn(nodes, nodes, |row, column| match back.get(column) {
        Some(mode) => mode.z.powi(-node(row)),
        None => -forth[column - back.len()].z.powi(node(row)),
    });
    let incident = DVector::from_fn(nodes, |row, _| -Complex::from_polar(1.0, theta * f64::from(node(row))));
    let amplitudes = matrix.lu().solve(&incident)?;
    let same = |mode: &Mode| mode.travelling.is_some_and(|other| (other - theta).abs() < 1e-6);
    let coefficient = back.iter().position(same).map(|at| amplitudes[at])?;
    coefficient.norm().is_finite().then_some(coefficient)
}

/// ωΔx/v above which the chain carries no wave: everything comes back.
pub fn cut_off(stencil: &Stencil<1>) -> f64 {
    2.0 / super::timestep::bar(stencil).sharp
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Kernel;
    use crate::lattice::Lattice;
    use crate::partial_volume::VolumeRule;
    use approx::assert_abs_diff_eq;

    fn lattice(m: f64) -> Stencil<1> {
        let volume_rule = VolumeRule::Linear;
        Stencil::new(Lattice { kernel: Kernel::Constant, m, volume_rule, calibrated: false }).unwrap()
    }

    #[test]
    fn equal_chains_send_nothing_back() {
        let chain = Chain::peridynamic(&lattice(3.0));
        for theta in [0.1, 0.5, 0.9] {
            assert!(exact(&chain, &chain, theta).unwrap().norm() < 1e-12);
        }
    }

    #[test]
    fn known_reflections_are_met() {
        let (left, right) = (Chain::finite_differences(), Chain::peridynamic(&lattice(3.0)));
        for (theta, amplitude) in [(0.5, 0.024), (0.8, 0.084), (1.0, 0.224)] {
            assert_abs_diff_eq!(exact(&left, &right, theta).unwrap().norm(), amplitude, epsilon = 5e-4);
        }
        assert_abs_diff_eq!(cut_off(&lattice(3.0)), 1.0184, epsilon = 5e-5);
    }

    #[test]
    fn above_the_cut_off_everything_comes_back() {
        let (left, right) = (Chain::finite_differences(), Chain::peridynamic(&lattice(3.0)));
        for theta in [1.1, 2.0, 3.0] {
            assert_abs_diff_eq!(exact(&left, &right, theta).unwrap().norm(), 1.0, epsilon = 1e-12);
            assert!(impedances_at_equal_frequency(&left, &right, theta).is_none());
        }
    }

    #[test]
    fn two_springs_of_different_stiffness_reflect_by_hand() {
        // Left w = 1, right w = 4: continuity of u₋₁, u₀ continued; solved by hand for θ = 1.
        let spring = |weight| Chain { relation: BarDispersion::of_weights(vec![weight]) };
        let (left, right) = (spring(1.0), spring(4.0));
        let other = 2.0 * (0.5_f64 * (0.5_f64).sin()).asin();
        let i = Complex::new(0.0, 1.0);
        let (a, b) = ((i * 1.0).exp(), (i * other).exp());
        // 1 + R = T at node 0; 1/a + R a = T/b at node −1.
        let expected = ((1.0 / b - 1.0 / a) / (a - 1.0 / b)).norm();
        assert_abs_diff_eq!(exact(&left, &right, 1.0).unwrap().norm(), expected, epsilon = 1e-14);
    }
}
