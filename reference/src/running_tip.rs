//! Fields around a tip that runs at a constant speed, steady as seen from the tip: of any order, both modes.
//!
//! u = f(x − vt, y), so ρü = ρv² ∂²u/∂x². Dilatation and rotation are harmonic in z_d = x + iα_d y and z_s = x + iα_s y,
//! α² = 1 − v²/c²: u_x = Re(F + α_s G), u_y = −Im(α_d F + G) with F = A z_d^{n/2}, G = B z_s^{n/2} (Freund, Dynamic
//! Fracture Mechanics (1990), 4.3), σ_yy/µ = −Re((1 + α_s²)F' + 2α_s G'), σ_xy/µ = −Im(2α_d F' + (1 + α_s²)G'),
//! σ_xx/µ = Re((1 + 2α_d² − α_s²)F' + 2α_s G'). No traction on the faces: one of the two vanishes there by itself, the
//! other where
//!
//! | | n odd | n even |
//! |---|---|---|
//! | mode I (A, B real) | (1 + α_s²)B = −2α_d A | 2α_s B = −(1 + α_s²)A |
//! | mode II (imaginary) | 2α_s B = −(1 + α_s²)A | (1 + α_s²)B = −2α_d A |
//!
//! Strengths as in [`crate::near_tip`]. For n = 1: A = 2(1 + α_s²)/(µD√(2π)) in mode I and −4iα_s/(µD√(2π)) in mode II,
//! D = 4α_dα_s − (1 + α_s²)², the fields of Freund's section 4.3.

use crate::complex::Complex;
use crate::elastic::{Mode, Plane};
use crate::near_tip::{Field, Term};

/// A tip running at a speed towards +x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunningTip {
    /// The body.
    pub plane: Plane,
    /// v in m/s, 0 < v < c_R.
    pub speed: f64,
}

/// α_d, α_s and D of a speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Slowness {
    pub dilatational: f64,
    pub shear: f64,
    pub rayleigh: f64,
}

impl RunningTip {
    /// D is written without the difference of nearly equal numbers, so that it keeps its digits as v → 0, where it is
    /// 2(1 − k²)(v/c_s)², k = c_s/c_d.
    pub(crate) fn slowness(&self) -> Slowness {
        let q = (self.speed / self.plane.shear_speed()).powi(2);
        let p = q * self.plane.speed_ratio_squared();
        // α_dα_s = √(1 − x).
        let x = p + q - p * q;
        let rayleigh = 4.0 * (q - x / (1.0 + (1.0 - x).sqrt())) - q * q;
        Slowness { dilatational: (1.0 - p).sqrt(), shear: (1.0 - q).sqrt(), rayleigh }
    }

    /// The field of a term at `place` = (x, y) in m from the tip where it is now; its acceleration is
    /// v² ∂²u/∂x². Faces as in [`Term::at`]. NaN outside 0 < v < c_R and for n = 0. The field is a difference of parts
    /// of the size (c_s/v)² and loses as many digits at low speeds: 10⁻¹⁶(c_s/v)².
    pub fn at(&self, term: Term, place: [f64; 2]) -> Field {
        let Slowness { dilatational: d, shear: s, .. } = self.slowness();
        let [a, b] = self.amplitudes(term);
        let [x, y] = place;
        let [z_d, z_s] = [d * y, s * y].map(|y| Complex::new(x, y));
        let half = 0.5 * f64::from(term.n);
        let (f, g) = (a * z_d.half_power(term.n), b * z_s.half_power(term.n));
        let f_1 = a * z_d.half_power(term.n - 2) * half;
        let g_1 = b * z_s.half_power(term.n - 2) * half;
        let (shear, mu) = (1.0 + s * s, self.plane.shear_modulus);
        Field {
            displacement: [f.re + s * g.re, -(d * f.im + g.im)],
            gradient: [
                [f_1.re + s * g_1.re, -(d * f_1.im + s * s * g_1.im)],
                [-(d * f_1.im + g_1.im), -(d * d * f_1.re + s * g_1.re)],
            ],
            stress: [
                mu * ((1.0 + 2.0 * d * d - s * s) * f_1.re + 2.0 * s * g_1.re),
                -mu * (shear * f_1.re + 2.0 * s * g_1.re),
                -mu * (2.0 * d * f_1.im + shear * g_1.im),
            ],
        }
    }

    /// A and B.
    fn amplitudes(&self, term: Term) -> [Complex; 2] {
        let Slowness { dilatational: d, shear: s, rayleigh } = self.slowness();
        let (shear, mu, n) = (1.0 + s * s, self.plane.shear_modulus, f64::from(term.n));
        let root = std::f64::consts::TAU.sqrt();
        let odd = term.n % 2 != 0;
        // α_d² − α_s² and 1 − α_s², from the speed itself.
        let q = (self.speed / self.plane.shear_speed()).powi(2);
        let apart = q * (1.0 - self.plane.speed_ratio_squared());
        let a = match (term.mode, odd) {
            (Mode::One, true) => 2.0 * shear / (mu * rayleigh * n * root),
            (Mode::One, false) => 1.0 / (mu * n * apart),
            (Mode::Two, true) => -4.0 * s / (mu * rayleigh * n * root),
            (Mode::Two, false) => -2.0 * shear / (n * d * q * self.plane.effective_modulus()),
        };
        let ratio = match (term.mode, odd) {
            (Mode::One, true) | (Mode::Two, false) => -2.0 * d / shear,
            (Mode::One, false) | (Mode::Two, true) => -shear / (2.0 * s),
        };
        let runs = self.speed > 0.0 && rayleigh > 0.0 && term.n != 0;
        let a = if runs { a } else { f64::NAN };
        [a, a * ratio].map(|size| match term.mode {
            Mode::One => Complex::new(size, 0.0),
            Mode::Two => Complex::new(0.0, size),
        })
    }
}
