//! How plane waves travel: ω(k) of the nonlocal continuum, of its lattices and of finite differences.
//!
//! A wave e^{i(k·x − ωt)} in ρü = Σ forces gives ρω² as a sum of 1 − cos(k·ξ) over bonds. All frequencies here
//! are dimensionless: ωΔx/c on a lattice at θ = kΔx, ωδ/c in the continuum at kδ, c the branch's own speed.

pub mod accuracy;
pub mod bar;
pub mod continuum;
pub mod finite_differences;
pub mod joint;
pub mod leapfrog;
pub mod plane;
pub mod timestep;

/// A point of a dispersion curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// ωL/c, L the unit of length of its wavenumber.
    pub omega: f64,
    /// Group velocity over c: d(ωL/c)/d(kL) along the direction of the wave.
    pub group: f64,
}

impl Wave {
    /// Phase speed over c at the dimensionless wavenumber, the group velocity standing in at k = 0.
    pub fn phase(self, wavenumber: f64) -> f64 {
        if wavenumber == 0.0 { self.group } else { self.omega / wavenumber }
    }

    /// From ω² and dω²/dk; at k = 0, where both vanish, `long_wave` is the speed.
    fn from_square(square: f64, slope: f64, long_wave: f64) -> Self {
        let omega = square.max(0.0).sqrt();
        Self { omega, group: if omega == 0.0 { long_wave } else { slope / (2.0 * omega) } }
    }
}

/// Polarisation of a plane wave.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Branch {
    /// The displacement lies nearer to the direction of travel.
    P,
    /// The other one.
    S,
}

impl Branch {
    /// The word used in study files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::P => "P",
            Self::S => "S",
        }
    }
}
