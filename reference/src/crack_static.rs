//! Cracks in bodies at rest: closed-form stress intensity factors, and the whole field of a crack in an infinite plane.
//!
//! Y = K/(σ√(πa)) throughout, σ the remote stress (σ_yy in mode I, σ_xy in mode II), a the half length of a central crack
//! or the depth of an edge crack. A half-infinite crack is `near_tip`'s term n = 1; a plate of any size with a central
//! crack is [`crate::cracked_rectangle`].
//!
//! The field: with s = √(z² − a²), z from the crack's middle, the crack's faces are free for φ = (σ_yy − iσ_xy)s/2 and
//! what a uniform stress adds (Muskhelishvili (1963), 124; Westergaard, J. Appl. Mech. 6 (1939) A49 for biaxial tension).

use std::f64::consts::PI;

use crate::complex::Complex;
use crate::elastic::Plane;
use crate::near_tip::{Field, Potentials, from_potentials};

/// Y of an edge crack across a half plane in tension. Handbooks have 1.1215 (Tada, Paris and Irwin, The Stress Analysis
/// of Cracks Handbook (2000), 8.1); the other digits are those of its integral equation, extrapolated (`tests`).
pub const EDGE_CRACK: f64 = 1.121_522_255_2;

/// Y of a central crack in a strip in tension (mode I), `ratio` = crack length over width, below 1:
/// (1 − 0.025x² + 0.06x⁴)√sec(πx/2) (Tada, Paris and Irwin (2000), 2.1), within 0.1 % of the truth for any ratio.
/// NaN outside 0 ≤ x < 1.
pub fn strip(ratio: f64) -> f64 {
    let square = ratio * ratio;
    let secant = 1.0 / libm::cos(PI * ratio / 2.0);
    let inside = (0.0..1.0).contains(&ratio);
    if inside { (1.0 - 0.025 * square + 0.06 * square * square) * secant.sqrt() } else { f64::NAN }
}

/// √sec(πx/2), Feddersen's form of the same: within 0.3 % up to a ratio of 0.7. NaN outside 0 ≤ x < 1.
pub fn strip_feddersen(ratio: f64) -> f64 {
    let inside = (0.0..1.0).contains(&ratio);
    if inside { (1.0 / libm::cos(PI * ratio / 2.0)).sqrt() } else { f64::NAN }
}

/// A crack in an infinite plane under a uniform remote stress; its right tip is the origin, the other at x = −2a.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CentralCrack {
    /// a in m.
    pub half_length: f64,
    /// (σ_xx, σ_yy, σ_xy) far from the crack in Pa.
    pub remote: [f64; 3],
}

impl CentralCrack {
    /// (K_I, K_II) of the right tip in Pa√m: σ_yy√(πa), σ_xy√(πa). A negative K_I means faces that overlap.
    pub fn factors(&self) -> [f64; 2] {
        let root = (PI * self.half_length).sqrt();
        [self.remote[1] * root, self.remote[2] * root]
    }

    /// T = σ_xx − σ_yy in Pa, of either tip.
    pub fn t_stress(&self) -> f64 {
        self.remote[0] - self.remote[1]
    }

    /// The field at `place` = (x, y) in m from the right tip; faces as in [`crate::near_tip::Term::at`]. The middle of
    /// the crack does not move on average, nothing turns far away.
    pub fn at(&self, plane: &Plane, place: [f64; 2]) -> Field {
        let [xx, yy, xy] = self.remote;
        let a = self.half_length;
        let [near, far] = [place[0], place[0] + 2.0 * a].map(|x| Complex::new(x, place[1]));
        let z = Complex::new(place[0] + a, place[1]);
        let s = near.half_power(1) * far.half_power(1);
        let cubed = near.half_power(-3) * far.half_power(-3);
        // φ = Ls/2 + Mz and ω̄ = L̄s/2 − M̄z, the faces free; Im M keeps what is far from turning.
        let load = Complex::new(0.5 * yy, -0.5 * xy);
        let uniform = Complex::new(0.25 * (xx - yy), 0.5 * xy);
        let phi = load * s + uniform * z;
        let phi_1 = load * (z / s) + uniform;
        let phi_2 = -(load * cubed) * (a * a);
        let omega = load.conj() * s - uniform.conj() * z;
        let omega_1 = load.conj() * (z / s) - uniform.conj();
        let of =
            Potentials { phi: [phi, phi_1, phi_2], psi: [omega - z * phi_1, omega_1 - phi_1 - z * phi_2] };
        from_potentials(plane, z, of)
    }
}
