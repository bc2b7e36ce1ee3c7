//! A standing wave let go from rest: every medium carries it, and it keeps its shape for ever.
//!
//! u(x, 0) = a cos(k·x + φ), u̇ = 0. In the medium ü = −c² M u, so u(x, t) = cos(√M ct) a cos(k·x + φ): the parts of a
//! along the two displacements of the medium's waves turn each at its own frequency. Marched by central differences from
//! rest they turn by 2 asin(ωΔt/2) in each step. Nothing is approximated; in a periodic box k is one of its own waves.

use crate::clock::Clock;
use crate::medium::Medium;

/// A standing wave of the plane. Lengths as in the medium, c = √(C11/ρ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StandingWave {
    /// What carries it.
    pub medium: Medium,
    /// k, in 1/length.
    pub wavenumber: [f64; 2],
    /// a, in any unit.
    pub amplitude: [f64; 2],
    /// φ.
    pub phase: f64,
}

impl StandingWave {
    /// cos(k·x + φ).
    pub fn shape(&self, x: [f64; 2]) -> f64 {
        libm::cos(self.wavenumber[0] * x[0] + self.wavenumber[1] * x[1] + self.phase)
    }

    /// What stands before the shape at c times the time. None where the medium has no answer
    /// ([`Medium::plane_waves`]).
    pub fn amplitude_at(&self, ct: f64) -> Option<[f64; 2]> {
        self.turned(Clock::Exact(ct))
    }

    /// The same after `steps` of leapfrog, `c_dt` = cΔt. None also above its limit.
    pub fn amplitude_after(&self, steps: u64, c_dt: f64) -> Option<[f64; 2]> {
        self.turned(Clock::Leapfrog(steps, c_dt))
    }

    fn turned(&self, clock: Clock) -> Option<[f64; 2]> {
        let mut sum = [0.0; 2];
        for (omega, e) in self.medium.plane_waves(self.wavenumber)? {
            let share = (self.amplitude[0] * e[0] + self.amplitude[1] * e[1]) * clock.cosine(omega)?;
            sum = [sum[0] + share * e[0], sum[1] + share * e[1]];
        }
        Some(sum)
    }
}

/// A standing wave of the bar, c = √(E/ρ).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarStandingWave {
    /// What carries it.
    pub medium: Medium,
    /// k, in 1/length.
    pub wavenumber: f64,
    /// a, in any unit.
    pub amplitude: f64,
    /// φ.
    pub phase: f64,
}

impl BarStandingWave {
    /// cos(kx + φ).
    pub fn shape(&self, x: f64) -> f64 {
        libm::cos(self.wavenumber * x + self.phase)
    }

    /// What stands before the shape at c times the time. None where the medium has no answer
    /// ([`Medium::bar_square`]).
    pub fn amplitude_at(&self, ct: f64) -> Option<f64> {
        self.turned(Clock::Exact(ct))
    }

    /// The same after `steps` of leapfrog, `c_dt` = cΔt. None also above its limit.
    pub fn amplitude_after(&self, steps: u64, c_dt: f64) -> Option<f64> {
        self.turned(Clock::Leapfrog(steps, c_dt))
    }

    fn turned(&self, clock: Clock) -> Option<f64> {
        let omega = self.medium.bar_square(self.wavenumber)?.sqrt();
        Some(self.amplitude * clock.cosine(omega).filter(|cosine| cosine.is_finite())?)
    }
}
