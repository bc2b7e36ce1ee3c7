//! Exact answers for peridynamics verification, written without sight of the solver.
//!
//! Plane waves, moduli, time steps and reflections of the linearised bond-based model
//! ρü = ∫ c(ξ) (ξ⊗ξ/|ξ|³)(u' − u) dV', c = c₀W(|ξ|/δ) (Silling, J. Mech. Phys. Solids 48 (2000) 175), of its
//! meshfree lattice (Silling and Askari, Comput. Struct. 83 (2005) 1526) and of second-order central
//! differences. Every answer comes straight from its defining sum or integral in double-double arithmetic
//! (31 digits), rounded to a double at the end; where that is not so, the function says how good it is.
//!
//! Everything is dimensionless unless a name carries a unit. v = √(E/ρ) is the speed in a bar, c_d and c_s are
//! the dilatational and shear speeds of the plane; a bond-based plane has C12 = C66 = C11/3 in plane stress
//! (ν = 1/3) and in plane strain (ν = 1/4) alike, so the same dimensionless answers serve both.
//!
//! ```
//! use pd_verify_reference::{Kernel, Lattice, VolumeRule, continuum, lattice};
//!
//! // A wave of the constant kernel at kδ = 1, in the continuum and on the lattice with m = 3.
//! let wave = continuum::bar(Kernel::Constant, 1.0).expect("within the range of the answer");
//! assert_eq!(wave.omega, 0.97941154169340832);
//! let m3 = Lattice { kernel: Kernel::Constant, m: 3.0, rule: VolumeRule::Linear, calibrated: false };
//! let on_lattice = 3.0 * lattice::bar(m3, 1.0 / 3.0).omega;
//! assert!((on_lattice / (1.0 - (1.0 + 1.0 / 9.0) / 48.0) - 1.0).abs() < 1e-3);
//! ```
#![warn(missing_docs)]

pub mod bent_plate;
pub mod cell;
pub mod continuum;
pub mod crack_static;
pub mod cracked_plate;
pub mod cracked_rectangle;
pub mod cut_plate;
pub mod double_double;
pub mod elastic;
pub mod finite_differences;
pub mod finite_elements;
pub mod forced_rest;
pub mod freund;
pub mod front;
pub mod lattice;
pub mod lattice_modes;
pub mod lattice_points;
pub mod leapfrog;
pub mod medium;
pub mod micromodulus;
pub mod near_tip;
pub mod nonlocal_pulse;
pub mod oracles;
pub mod periodic_pulse;
pub mod pulse_bar;
pub mod released_bar;
pub mod running_crack;
pub mod running_tip;
pub mod scattering;
pub mod standing_wave;
pub mod static_bar;
pub mod stretched_plate;

mod absorbing;
mod band_edge;
mod bonds;
mod clock;
mod complex;
mod kernel;
mod least_squares;
mod pulse;
mod quadrature;

pub use bonds::{Lattice, VolumeRule};
pub use elastic::{Mode, Plane};
pub use kernel::Kernel;
pub use medium::Medium;

/// Which of the two plane waves of the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Branch {
    /// Dilatational: the displacement nearer to the direction of travel.
    P,
    /// Shear: the displacement nearer to the direction across it.
    S,
}

/// Frequency and group speed of a plane wave, both over the classical speed of its branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// ω times a length (the horizon or the spacing, as the function says) over the classical speed.
    pub omega: f64,
    /// Group speed dω/dk over the classical speed.
    pub slope: f64,
}

/// The version of these answers.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
