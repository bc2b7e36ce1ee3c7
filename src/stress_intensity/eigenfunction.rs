//! Williams' eigenfunctions around the tip of a crack with free faces, as sums of r^s (cos kθ, sin kθ).
//!
//! Term n behaves like r^{n/2}: with β = n/2 + (−1)ⁿ in mode I and β = −n/2 + (−1)ⁿ in mode II,
//!
//! 2µ(u_x + iu_y) = a i^m (κ z^{n/2} + β z*^{n/2} ∓ n/2 z z*^{n/2 − 1}),  z = r e^{iθ}, |θ| ≤ π
//!
//! upper sign and m = 0 in mode I, lower sign and m = 1 in mode II (Williams 1957, J. Appl. Mech. 24, 109). n = 0 is a
//! translation, n = 2 the T-stress (I) and a rotation (II), n = −1 the far field of a tip that lies elsewhere: a tip
//! displaced by d adds −d/2 K of term −1.

use super::{Elastic, Mode};
use std::f64::consts::PI;

/// c z^p z*^q.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Monomial {
    pub coefficient: f64,
    /// p.
    pub power: f64,
    /// q.
    pub conjugate_power: f64,
}

/// A displacement field around a tip: Σ c r^{p+q} (cos kθ, sin kθ), k = p − q, in mode I, and its i-fold,
/// (−sin kθ, cos kθ), in mode II. Coefficients in m^{1−p−q} for an amplitude of one.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    pub mode: Mode,
    pub monomials: Vec<Monomial>,
}

impl Field {
    /// Displacement in m at a place in m from the tip. Crossing y = 0 behind the tip crosses the crack; −0 is its lower face.
    pub fn displacement(&self, x: [f64; 2]) -> [f64; 2] {
        self.rotated(sum(&self.monomials, x))
    }

    /// [[∂u_x/∂x, ∂u_x/∂y], [∂u_y/∂x, ∂u_y/∂y]] at a place.
    pub fn gradient(&self, x: [f64; 2]) -> [[f64; 2]; 2] {
        let by = |derive: fn(&Monomial) -> Monomial| {
            let terms: Vec<Monomial> = self.monomials.iter().map(derive).collect();
            self.rotated(sum(&terms, x))
        };
        let [a, b] = by(Monomial::derivative); // ∂w/∂z
        let [c, d] = by(Monomial::conjugate_derivative); // ∂w/∂z*
        // ∂w/∂x = ∂w/∂z + ∂w/∂z*, ∂w/∂y = i (∂w/∂z − ∂w/∂z*).
        [[a + c, d - b], [b + d, a - c]]
    }

    /// The same field times a number.
    pub fn times(mut self, factor: f64) -> Self {
        for monomial in &mut self.monomials {
            monomial.coefficient *= factor;
        }
        self
    }

    fn rotated(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        match self.mode {
            Mode::I => [x, y],
            Mode::II => [-y, x],
        }
    }
}

impl Monomial {
    /// ∂/∂z.
    pub(super) fn derivative(&self) -> Self {
        Self { coefficient: self.coefficient * self.power, power: self.power - 1.0, ..*self }
    }

    /// ∂/∂z*.
    pub(super) fn conjugate_derivative(&self) -> Self {
        let power = self.conjugate_power;
        Self { coefficient: self.coefficient * power, conjugate_power: power - 1.0, ..*self }
    }
}

/// Σ c r^{p+q} (cos kθ, sin kθ); what has no coefficient has no place in it, singular or not.
fn sum(monomials: &[Monomial], [x, y]: [f64; 2]) -> [f64; 2] {
    let (r, theta) = (libm::hypot(x, y), libm::atan2(y, x));
    let mut sum = [0.0; 2];
    for monomial in monomials.iter().filter(|monomial| monomial.coefficient != 0.0) {
        let Monomial { coefficient, power, conjugate_power } = *monomial;
        let size = coefficient * libm::pow(r, power + conjugate_power);
        let angle = (power - conjugate_power) * theta;
        sum[0] += size * libm::cos(angle);
        sum[1] += size * libm::sin(angle);
    }
    sum
}

/// Term n ≥ −1 of a mode, of amplitude one: K = 1 Pa√m for n = 1, σ_xx = 1 Pa for n = 2 in mode I; translations of 1 m
/// along x (I) and y (II) for n = 0; a counter-clockwise rotation of 1 for n = 2 in mode II; φ = z^{n/2}/√(2π) (I) and
/// −i z^{n/2}/√(2π) (II), in Pa m^{1−n/2}, for all others, which continues n = 1.
pub fn term(elastic: &Elastic, n: i32, mode: Mode) -> Field {
    let power = f64::from(n) / 2.0;
    let parity = if n % 2 == 0 { 1.0 } else { -1.0 };
    let sign = if mode == Mode::I { 1.0 } else { -1.0 };
    let each =
        [(elastic.kappa, power, 0.0), (sign * power + parity, 0.0, power), (-sign * power, 1.0, power - 1.0)];
    let monomials =
        each.map(|(coefficient, power, conjugate_power)| Monomial { coefficient, power, conjugate_power });
    let field = Field { mode, monomials: monomials.to_vec() };
    field.times(amplitude(elastic, n, mode) / (2.0 * elastic.shear_modulus))
}

/// The a of a term of amplitude one.
fn amplitude(elastic: &Elastic, n: i32, mode: Mode) -> f64 {
    let rigid = 2.0 * elastic.shear_modulus / (elastic.kappa + 1.0);
    match (n, mode) {
        (0, _) | (2, Mode::II) => rigid,
        (2, Mode::I) => 0.25,
        (_, Mode::I) => 1.0 / (2.0 * PI).sqrt(),
        (_, Mode::II) => -1.0 / (2.0 * PI).sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{self, Potential};
    use super::*;
    use approx::assert_relative_eq;

    const ELASTIC: Elastic = Elastic { shear_modulus: 2.5, kappa: 1.7, density: 3.0 };
    const PLACES: [[f64; 2]; 6] =
        [[0.3, 0.4], [-0.7, 0.2], [-0.5, -0.6], [1.1, -0.1], [-0.9, 1e-9], [-0.9, -1e-9]];

    /// Against Rice's form of the complex potentials, φ and ω with Ω = ±Φ.
    #[test]
    fn terms_are_those_of_the_complex_potentials() {
        for n in -1..=7 {
            for mode in Mode::BOTH {
                let wanted = Potential::of_term(n, mode);
                let Some(wanted) = wanted else { continue };
                let found = term(&ELASTIC, n, mode);
                for x in PLACES {
                    let (found, wanted) =
                        (found.displacement(x), synthetic::displacement(&ELASTIC, &[wanted], x));
                    for axis in 0..2 {
                        let bound = 1e-14 * libm::hypot(wanted[0], wanted[1]).max(1e-3);
                        assert!(
                            (found[axis] - wanted[axis]).abs() < bound,
                            "{n} {mode:?} {found:?} {wanted:?}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn rigid_terms_move_one_metre_and_turn_by_one() {
        for x in PLACES {
            for (n, mode, wanted) in
                [(0, Mode::I, [1.0, 0.0]), (0, Mode::II, [0.0, 1.0]), (2, Mode::II, [-x[1], x[0]])]
            {
                let found = term(&ELASTIC, n, mode).displacement(x);
                assert!(
                    (0..2).all(|axis| (found[axis] - wanted[axis]).abs() < 1e-15),
                    "{n} {mode:?} {found:?}"
                );
            }
        }
    }

    #[test]
    fn ahead_of_the_tip_is_one_over_root_two_pi_x_and_t_is_along_the_crack() {
        let stress = |n, mode, x| ELASTIC.stress(term(&ELASTIC, n, mode).gradient(x));
        let wanted = 1.0 / (2.0 * PI * 0.3).sqrt();
        let [_, opening, shear] = stress(1, Mode::I, [0.3, 0.0]);
        assert_relative_eq!(opening, wanted, max_relative = 1e-14);
        assert_eq!(shear, 0.0);
        assert_relative_eq!(stress(1, Mode::II, [0.3, 0.0])[2], wanted, max_relative = 1e-14);
        for x in PLACES {
            let [along, across, shear] = stress(2, Mode::I, x);
            assert!((along - 1.0).abs() < 1e-14 && across.abs() < 1e-14 && shear.abs() < 1e-14);
        }
        // K_I > 0 opens, K_II > 0 slides the upper face to +x.
        let upper = |mode| term(&ELASTIC, 1, mode).displacement([-1.0, 1e-12]);
        assert!(upper(Mode::I)[1] > 0.0 && upper(Mode::II)[0] > 0.0);
    }

    #[test]
    fn gradients_are_those_of_the_displacement() {
        let h = 1e-5; // differences are good to h²/6 times third derivatives, about 1e-9 here
        for (n, mode) in [(-1, Mode::II), (1, Mode::I), (2, Mode::II), (3, Mode::II), (4, Mode::I)] {
            let field = term(&ELASTIC, n, mode);
            for x in [[0.3, 0.4], [-0.7, 0.2], [-0.5, -0.6]] {
                let found = field.gradient(x);
                for axis in 0..2 {
                    let moved = |way: f64| {
                        let mut at = x;
                        at[axis] += way;
                        field.displacement(at)
                    };
                    let (plus, minus) = (moved(h), moved(-h));
                    for i in 0..2 {
                        let wanted = (plus[i] - minus[i]) / (2.0 * h);
                        assert!((found[i][axis] - wanted).abs() < 1e-8, "{n} {mode:?} {x:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_displaced_tip_is_term_minus_one_from_afar() {
        let (k, d) = (3.0, 1e-4);
        let x = [0.4, -0.8];
        let at = |x| term(&ELASTIC, 1, Mode::I).times(k).displacement(x);
        let far = term(&ELASTIC, -1, Mode::I).times(-0.5 * k * d).displacement(x);
        let (moved, here) = (at([x[0] - d, x[1]]), at(x));
        for axis in 0..2 {
            // The next term of the expansion is d/r ≈ 1e-4 of this one.
            assert_relative_eq!(moved[axis] - here[axis], far[axis], max_relative = 3e-4);
        }
    }
}
