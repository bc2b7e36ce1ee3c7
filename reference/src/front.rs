//! How a step of strain spreads in a lattice, and how much of it has passed when its front is due.
//!
//! Long waves have ω = ck(1 − βk² + γk⁴ …). At x/c after it left, the part of a unit step that has passed x is
//! ½ + (1/π)∫₀^∞ sin(ωt − kx) dk/k, for which γ = 0 gives ½ − (1/π)∫₀^∞ sin(βxk³) dk/k = 1/3 at every x: the front has the
//! shape of the Airy function's integral, ∫_z^∞ Ai with z = (x − ct)/(3βx)^{1/3}, and ∫₀^∞ Ai = 1/3 (Abramowitz and Stegun
//! 10.4.82). The next term of the phase and, on a lattice, the step between two nodes of the sampled strain,
//! ½cot(k/2) = 1/k − k/12 … in place of 1/k, add (√3 Γ(2/3)/9π)(βx)^{-2/3}(⅛ − γ/β).

use crate::bonds::Lattice;
use crate::double_double::Dd;
use crate::lattice;

/// Long waves of a lattice, lengths in Δx.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Front {
    /// c over v = √(E/ρ).
    pub speed: f64,
    /// β in Δx².
    pub beta: f64,
    /// γ in Δx⁴.
    pub gamma: f64,
}

/// Γ(2/3) (Abramowitz and Stegun 6.1.13).
const GAMMA_TWO_THIRDS: f64 = 1.354_117_939_426_400_5;
/// Ai(0) = 3^{-2/3}/Γ(2/3) (Abramowitz and Stegun 10.4.4).
const AIRY_AT_ZERO: f64 = 0.355_028_053_887_817_2;

impl Front {
    /// The long waves of a lattice bar in exact time, or marched by leapfrog at `courant` = vΔt/Δx. None where the
    /// long waves are not slower the shorter they are (β ≤ 0: the front has another shape), as leapfrog near its limit
    /// can make them, and where there is no stiffness.
    pub fn of(lattice: Lattice, courant: Option<f64>) -> Option<Self> {
        // (ωΔx/v)² = M₂k² − M₄k⁴/12 + M₆k⁶/360 …, M_n = Σ_{r>0} w_r rⁿ.
        let bonds = lattice::bar_bonds(&lattice);
        let moment = |n: i32| -> Dd { bonds.iter().map(|bond| bond.weight * bond.offset.powi(n)).sum() };
        let square = moment(2).to_f64();
        let (a, b) = (moment(4).to_f64() / (12.0 * square), moment(6).to_f64() / (360.0 * square));
        let (beta, gamma) = (a / 2.0, b / 2.0 - a * a / 8.0);
        // ω' = ω(1 + q/24 + 3q²/640 …), q = (ωΔt)².
        let q = courant.map_or(0.0, |courant| courant * courant * square);
        let (beta, gamma) = (beta - q / 24.0, gamma - beta * q / 8.0 + 3.0 * q * q / 640.0);
        (square > 0.0 && beta > 0.0).then(|| Self { speed: square.sqrt(), beta, gamma })
    }

    /// (3βx)^{1/3}: the width of the front in Δx after the way x in Δx. Its leading oscillation is behind it.
    pub fn width(&self, x: f64) -> f64 {
        libm::cbrt(3.0 * self.beta * x)
    }

    /// The part of a sampled unit step that has passed at x/c, x in Δx: 1/3 and the first correction, which falls with
    /// x^{-2/3}. What is left out falls with x^{-4/3}.
    pub fn fraction_at_arrival(&self, x: f64) -> f64 {
        let scale = 3.0_f64.sqrt() * GAMMA_TWO_THIRDS / (9.0 * std::f64::consts::PI);
        let way = libm::cbrt(self.beta * x);
        1.0 / 3.0 + scale / (way * way) * (0.125 - self.gamma / self.beta)
    }

    /// The time in Δx/v by which the level 1/3 of the step is early (negative: late) after the way x in Δx: the
    /// correction of [`Self::fraction_at_arrival`] over the steepness Ai(0) c/(3βx)^{1/3} of the front.
    pub fn earliness_of_a_third(&self, x: f64) -> f64 {
        (self.fraction_at_arrival(x) - 1.0 / 3.0) * self.width(x) / (AIRY_AT_ZERO * self.speed)
    }
}
