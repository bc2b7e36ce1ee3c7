//! How much of a wave comes back from a joint between two different discretisations of the same bar.
//!
//! Two half-chains of equal spacing and density, u_i at x = iΔx: rows i < 0 use the left stencil, rows i ≥ 0 the
//! right one, whatever side the neighbours lie on. Physically there is no joint: all that returns is error.
//! Source of the question: Wildman and Gazonas, Int. J. Fract. 190 (2014) 39, sections 2 and 3.2.

use crate::bonds::Lattice;
use crate::{absorbing, lattice, pulse};

/// The stencil of a half-chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Half {
    /// Second-order central differences.
    Fd,
    /// A peridynamic lattice.
    Pd(Lattice),
}

impl Half {
    /// Reach in spacings and weight of each pair of neighbours: (ωΔx/v)² = Σ 2w(1 − cos κr).
    pub(crate) fn stencil(self) -> Vec<(usize, f64)> {
        let Self::Pd(lattice) = self else { return vec![(1, 1.0)] };
        let bonds = lattice::bar_bonds(&lattice);
        bonds.into_iter().map(|bond| (bond.offset as usize, bond.weight.to_f64())).collect()
    }
}

/// |R| of a harmonic wave of frequency ωΔx/v that comes along the left half-chain: amplitude returned over
/// amplitude sent. Found from the driven chain between absorbing layers, which are doubled until |R| holds to
/// 2e-8; good to 1e-6, mostly 1e-8. None where the left half-chain carries no wave or several of this frequency,
/// and where the layers never absorb well enough: close to a frequency at which a wave of either half stands
/// still (m = 3, constant kernel, linear volumes: 1 and 1.0184). About 1 ms, longer for long waves: 20 ms at 0.01.
pub fn reflection(left: Half, right: Half, omega_dx_over_v: f64) -> Option<f64> {
    absorbing::reflection(&left.stencil(), &right.stencil(), omega_dx_over_v)
}

/// Peak |u| returned over peak |u| sent, of a pulse exp(−a(x − x₀)²) travelling right in the left half-chain,
/// a = `sharpness_per_m2`, marched by leapfrog at `courant` = vΔt/Δx. The pulse starts nine of its widths 1/√a
/// from the joint with peak 1; the echo, the difference from the march without a joint, is read from 4.5 widths
/// off the joint outwards until its centre is back at the start. What is left to choice is which peak is meant:
/// distance changes it by the dispersion of the chain, sampling at nodes by some 2 % for pulses two nodes wide.
pub fn pulse_reflection(left: Half, right: Half, sharpness_per_m2: f64, dx_m: f64, courant: f64) -> f64 {
    pulse::reflection(&left.stencil(), &right.stencil(), sharpness_per_m2 * dx_m * dx_m, courant)
}
