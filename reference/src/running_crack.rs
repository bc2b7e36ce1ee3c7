//! A long crack that runs: its stress intensity factors are those of the crack at rest times a function of its speed.
//!
//! A half-infinite crack under a uniform stress on its faces, those just made included (or under a plane wave along its
//! line): K does not ask where the tip is, and K(t) = k(v) K_rest(t) with the speed v of the moment, however the tip
//! came there (Freund, Dynamic Fracture Mechanics (1990), 6.4).
//!
//! Derived here: in coordinates that run with the tip, Laplace's transform turns time's s into s(1 − vζ), and the crack
//! line's −(µ/b²)R(p)/α(p) at rest (p a slowness along the crack; R of Rayleigh, a = 1/c_d, b = 1/c_s, c = 1/c_R,
//! R = 2(b² − a²)(c² − p²)S₊(p)S₊(−p)) is taken at p = ζ/(1 − vζ), times 1 − vζ. Its factor that is regular on the right is
//! (c + ζ(1 − cv)) S₊(p)/√(a + ζ(1 − av)) in mode I and with b for a in mode II. K is its growth with √ζ over its value at
//! ζ = 0, where v does not appear; p → −1/v for ζ → ∞. So
//!
//! k_I(v) = (1 − v/c_R)/√(1 − v/c_d) · S₊(−1/v), k_II(v) = (1 − v/c_R)/√(1 − v/c_s) · S₊(−1/v),
//! S₊(ζ) = exp(−(1/π)∫_a^b atan[4η²√((η² − a²)(b² − η²))/(b² − 2η²)²] dη/(η + ζ)).
//!
//! S₊(−1/v) > 1 is often left out; at ν' = ¼ k_I is then 8 % small at 0.4 c_s and 22 % at 0.6 c_s. The energy release rate
//! is g(v) = A(v)k(v)² times that at rest, A_I = v²α_d/((1 − ν')c_s²D), A_II = v²α_s/((1 − ν')c_s²D); g_I is near 1 − v/c_R.

use crate::elastic::{Mode, Plane};
use crate::freund::{Load, StationaryCrack};
use crate::quadrature;
use crate::running_tip::RunningTip;

/// A long crack running at a speed, loaded in one mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunningCrack {
    /// The body.
    pub plane: Plane,
    /// How it is loaded.
    pub mode: Mode,
    /// v in m/s.
    pub speed: f64,
}

impl RunningCrack {
    /// k(v): 1 at rest, 0 at c_R, to about 1e-14. None outside 0 ≤ v ≤ c_R and for NaN.
    pub fn universal(&self) -> Option<f64> {
        let rayleigh = self.plane.rayleigh_speed();
        let fits = 0.0 <= self.speed && self.speed <= rayleigh;
        let wave = self.plane.wave_speed(self.mode);
        let split = split(&self.plane, self.speed);
        fits.then(|| (1.0 - self.speed / rayleigh) / (1.0 - self.speed / wave).sqrt() * split)
    }

    /// K/σ₀ in √m at `since` s after the load has reached the crack's line, for the speed at that moment. None where
    /// [`Self::universal`] is; NaN where [`StationaryCrack::at`] is.
    pub fn at(&self, load: &Load, since: f64) -> Option<f64> {
        let rest = StationaryCrack { plane: self.plane, mode: self.mode };
        Some(self.universal()? * rest.at(load, since))
    }

    /// A(v): E' times the energy release rate over K², 1 at rest, without limit towards c_R. None outside 0 ≤ v < c_R.
    pub fn release(&self) -> Option<f64> {
        if self.speed == 0.0 {
            return Some(1.0);
        }
        let tip = RunningTip { plane: self.plane, speed: self.speed }.slowness();
        let alpha = match self.mode {
            Mode::One => tip.dilatational,
            Mode::Two => tip.shear,
        };
        let square = (self.speed / self.plane.shear_speed()).powi(2);
        let value = square * alpha / ((1.0 - self.plane.poisson_ratio) * tip.rayleigh);
        (self.speed > 0.0 && tip.rayleigh > 0.0).then_some(value)
    }
}

/// S₊(−1/v). In φ with η = a + (b − a) sin²φ the roots at the ends are gone; panels halve towards a, beside which the
/// angle may turn from 0 to π/2 within any small distance (ν' near 0).
fn split(plane: &Plane, speed: f64) -> f64 {
    if speed == 0.0 {
        return 1.0;
    }
    // Slownesses over b.
    let (a, tip) = (plane.speed_ratio_squared().sqrt(), plane.shear_speed() / speed);
    let value = |phi: f64| {
        let (sin, cos) = libm::sincos(phi);
        let eta = a + (1.0 - a) * sin * sin;
        let square = eta * eta;
        // (η − a)(1 − η) = (1 − a)² sin²φ cos²φ.
        let root = (1.0 - a) * sin * cos;
        let numerator = 4.0 * square * root * ((eta + a) * (1.0 + eta)).sqrt();
        let angle = libm::atan2(numerator, (1.0 - 2.0 * square).powi(2));
        angle * 2.0 * root / (tip - eta)
    };
    let over = |start: f64, end: f64| {
        quadrature::panel_f64(start, end).map(|(phi, weight)| weight * value(phi)).sum::<f64>()
    };
    let mut end = std::f64::consts::FRAC_PI_2;
    let mut sum = 0.0;
    for _ in 0..26 {
        sum += over(0.5 * end, end);
        end *= 0.5;
    }
    libm::exp((sum + over(0.0, end)) / std::f64::consts::PI)
}
