//! The exact motion of a periodic lattice from a pulse in its middle, as leapfrog carries it: wave by wave.
//!
//! N nodes at (j + ½)Δx, the pulse even about x = L/2: u_j = Σ_n a_n cos(2πn(j + ½ − N/2)/N) cos ω_n t. Every angle is a
//! multiple of π/N, so that the cosines come from one table.

use pd_verify_reference::{Lattice, lattice, leapfrog};
use std::f64::consts::PI;

/// The waves of a ring.
pub struct Ring {
    /// a_n and ω_nΔx/v, n from 0 to N/2.
    waves: Vec<(f64, f64)>,
    /// cos(πq/N), q = 0 … 2N − 1.
    cosines: Vec<f64>,
}

impl Ring {
    /// From displacements that are even about the middle; `None` where leapfrog is unstable at vΔt/Δx = `courant`.
    pub fn new(of: Lattice, start: &[f64], courant: f64) -> Option<Self> {
        let nodes = start.len();
        let cosines = (0..2 * nodes).map(|q| libm::cos(PI * q as f64 / nodes as f64)).collect();
        let mut ring = Self { waves: Vec::new(), cosines };
        let wave = |n: usize| {
            let sum: f64 = start.iter().enumerate().map(|(j, u)| u * ring.cosine(n, j)).sum();
            let twice = if n == 0 || 2 * n == nodes { 1.0 } else { 2.0 };
            let omega = match n {
                0 => 0.0,
                _ => leapfrog::wave(lattice::bar(of, 2.0 * PI * n as f64 / nodes as f64), courant)?.omega,
            };
            Some((twice / nodes as f64 * sum, omega))
        };
        ring.waves = (0..=nodes / 2).map(wave).collect::<Option<_>>()?;
        Some(ring)
    }

    /// Displacements of all nodes at vt/Δx.
    pub fn displacements(&self, time: f64) -> Vec<f64> {
        let turned: Vec<f64> = self.waves.iter().map(|(a, omega)| a * libm::cos(omega * time)).collect();
        let at = |j: usize| turned.iter().enumerate().map(|(n, a)| a * self.cosine(n, j)).sum();
        (0..self.cosines.len() / 2).map(at).collect()
    }

    /// cos(2πn(j + ½ − N/2)/N).
    fn cosine(&self, n: usize, j: usize) -> f64 {
        let turn = self.cosines.len();
        // 2j + 1 − N, made positive.
        self.cosines[n * (2 * j + 1 + turn / 2) % turn]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pd_verify_reference::{Kernel, VolumeRule};

    #[test]
    fn the_waves_make_up_what_they_came_from() {
        let of = Lattice { kernel: Kernel::Constant, m: 3.0, rule: VolumeRule::Linear, calibrated: false };
        for nodes in [12_usize, 13] {
            let start: Vec<f64> =
                (0..nodes).map(|j| libm::exp(-(j as f64 + 0.5 - nodes as f64 / 2.0).powi(2))).collect();
            let ring = Ring::new(of, &start, 0.5).unwrap();
            let again = ring.displacements(0.0);
            assert!(start.iter().zip(&again).all(|(a, b)| (a - b).abs() < 1e-15), "{again:?}");
        }
    }
}
