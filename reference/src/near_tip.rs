//! Fields around the tip of a crack at rest, free of traction on its faces: Williams's terms from complex potentials.
//!
//! 2µ(u_x + iu_y) = κφ − z φ̄' − ψ̄, σ_xx + σ_yy = 4 Re φ', σ_yy − σ_xx + 2iσ_xy = 2(z̄φ'' + ψ') (Muskhelishvili, Some
//! Basic Problems of the Mathematical Theory of Elasticity (1963), section 32). With φ = A z^{n/2}, ψ = B z^{n/2} and the
//! crack along the negative x axis the force φ + zφ̄' + ψ̄ is constant along both faces (0) when
//! B = −(n/2)A − (−1)ⁿĀ: for every n ≠ 0 a term with a real A (mode I) and one with an imaginary A (mode II).
//! Their strength is set ahead of the tip, at y = 0, x = r:
//!
//! | | n odd | n even |
//! |---|---|---|
//! | mode I | σ_yy = r^{n/2−1}/√(2π), A = 1/(n√(2π)) | σ_xx = r^{n/2−1}, A = 1/(2n) |
//! | mode II | σ_xy = r^{n/2−1}/√(2π), A = −i/(n√(2π)) | ∂u_y/∂x = −r^{n/2−1}/E', A = −i/(2n) |
//!
//! So n = 1 has K = 1 Pa√m, n = 2 a T-stress of 1 Pa (mode I) or only turns the body by −1/E' (mode II), and negative n
//! are what a zone of any kind at the tip looks like from afar (n = −1: a displaced tip). The terms are statics: around a
//! tip at rest in a moving body they are the leading parts of the field, n = 1 always.

use crate::complex::Complex;
use crate::elastic::{Mode, Plane};

/// Displacement, its gradient and the stress at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// (u_x, u_y) in m.
    pub displacement: [f64; 2],
    /// ∂u_i/∂x_j as \[i\]\[j\].
    pub gradient: [[f64; 2]; 2],
    /// (σ_xx, σ_yy, σ_xy) in Pa.
    pub stress: [f64; 3],
}

/// A term of the series around a tip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Term {
    /// Mode I is symmetric about the crack's line, mode II antisymmetric.
    pub mode: Mode,
    /// Displacement grows with r^{n/2}; not 0 (see [`translation`]).
    pub n: i32,
}

impl Term {
    /// The term's field at `place` = (x, y) in m from the tip. At y = 0 behind the tip the sign of zero is the face: 0.0
    /// the upper, −0.0 the lower. Not finite at the tip where the field is not; NaN for n = 0.
    pub fn at(&self, plane: &Plane, place: [f64; 2]) -> Field {
        let z = Complex::new(place[0], place[1]);
        let (half, a) = (0.5 * f64::from(self.n), self.amplitude());
        let sign = if self.n % 2 == 0 { 1.0 } else { -1.0 };
        let b = a * -half - a.conj() * sign;
        let power = |derivative: i32| z.half_power(self.n - 2 * derivative);
        let slopes = [half, half * (half - 1.0)];
        from_potentials(
            plane,
            z,
            Potentials {
                phi: [a * power(0), a * power(1) * slopes[0], a * power(2) * slopes[1]],
                psi: [b * power(0), b * power(1) * slopes[0]],
            },
        )
    }

    /// A, as in the table of the module.
    fn amplitude(&self) -> Complex {
        let n = f64::from(self.n);
        let size = if self.n % 2 == 0 { 0.5 / n } else { 1.0 / (n * std::f64::consts::TAU.sqrt()) };
        match self.mode {
            _ if self.n == 0 => Complex::new(f64::NAN, f64::NAN),
            Mode::One => Complex::new(size, 0.0),
            Mode::Two => Complex::new(0.0, -size),
        }
    }
}

/// The whole plane with a half-infinite crack and nothing else: K_I and K_II in Pa√m.
pub fn singular(plane: &Plane, [k_one, k_two]: [f64; 2], place: [f64; 2]) -> Field {
    let [one, two] = [Mode::One, Mode::Two].map(|mode| Term { mode, n: 1 }.at(plane, place));
    sum(&[(k_one, one), (k_two, two)])
}

/// Σ factor · field.
pub fn sum(parts: &[(f64, Field)]) -> Field {
    let add = |read: &dyn Fn(&Field) -> f64| parts.iter().map(|(factor, field)| factor * read(field)).sum();
    Field {
        displacement: [0, 1].map(|i| add(&|f| f.displacement[i])),
        gradient: [0, 1].map(|i| [0, 1].map(|j| add(&|f| f.gradient[i][j]))),
        stress: [0, 1, 2].map(|i| add(&|f| f.stress[i])),
    }
}

/// The body displaced by `by` m.
pub fn translation(by: [f64; 2]) -> Field {
    Field { displacement: by, gradient: [[0.0; 2]; 2], stress: [0.0; 3] }
}

/// The body turned about the tip by a small `angle` (rad, from x to y): u = angle (−y, x).
pub fn rotation(angle: f64, [x, y]: [f64; 2]) -> Field {
    Field { displacement: [-angle * y, angle * x], gradient: [[0.0, -angle], [angle, 0.0]], stress: [0.0; 3] }
}

/// φ, φ', φ'' and ψ, ψ' at a place.
pub(crate) struct Potentials {
    pub phi: [Complex; 3],
    pub psi: [Complex; 2],
}

/// The field of Muskhelishvili's potentials at z.
pub(crate) fn from_potentials(plane: &Plane, z: Complex, of: Potentials) -> Field {
    let Potentials { phi: [phi, phi_1, phi_2], psi: [psi, psi_1] } = of;
    let (kappa, over) = (plane.kolosov(), 0.5 / plane.shear_modulus);
    let displacement = (phi * kappa - z * phi_1.conj() - psi.conj()) * over;
    // ∂/∂x and ∂/∂y of the line above; ∂z/∂y = i, ∂z̄/∂y = −i.
    let turned = z * phi_2.conj() + psi_1.conj();
    let along = (phi_1 * kappa - phi_1.conj() - turned) * over;
    let across = Complex::I * (phi_1 * kappa - phi_1.conj() + turned) * over;
    let half_sum = 2.0 * phi_1.re;
    let deviator = z.conj() * phi_2 + psi_1;
    Field {
        displacement: [displacement.re, displacement.im],
        gradient: [[along.re, across.re], [along.im, across.im]],
        stress: [half_sum - deviator.re, half_sum + deviator.re, deviator.im],
    }
}
