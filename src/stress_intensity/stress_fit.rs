//! Stress ahead of the tip by differences, fitted by K and higher terms: the published way of a hybrid code.
//!
//! Ahead of the tip (θ = 0) only odd terms of Williams' series have σ_yy (mode I) or σ_xy (mode II), so σ√(2πr) = K + c₁ r +
//! c₂ r² + …, less the uniform stress of loaded faces; K is its least-squares value at r = 0 (Wildman, Gazonas 2014, Int. J.
//! Fract. 190, 39, with K alone). The rows above and below the crack's line are averaged, half a spacing off it.

use super::fit::least_squares;
use super::gradient::Differences;
use super::{Annulus, Elastic, Functional, Mode, Reading, Tip, Unreadable};
use nalgebra::DMatrix;
use std::f64::consts::PI;

/// A fit of the stress ahead of the tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressFit {
    /// The x that are fitted.
    pub annulus: Annulus,
    /// Terms c_k r^k beside K; 0 for K alone.
    pub terms: usize,
    pub differences: Differences,
}

impl StressFit {
    /// Prepares K_I and K_II. All columns weigh the same.
    pub fn reading(&self, tip: &Tip, elastic: &Elastic) -> Result<Reading, Unreadable> {
        tip.check_annulus(self.annulus)?;
        let sites = &tip.sites;
        self.differences.check(sites)?;
        let ahead = |column: &usize| {
            let x = sites.place(*column)[0];
            x >= self.annulus.inner && x <= self.annulus.outer
        };
        let columns: Vec<usize> = (0..sites.nodes[0]).filter(ahead).collect();
        let radii: Vec<f64> = columns.iter().map(|&column| sites.place(column)[0]).collect();
        let unknowns = self.terms + 1;
        if columns.len() < unknowns {
            return Err(Unreadable::TooFewNodes { nodes: columns.len(), unknowns });
        }
        let powers = DMatrix::from_fn(columns.len(), unknowns, |row, term| {
            (radii[row] / self.annulus.outer).powi(term as i32)
        });
        let (inverse, _) = least_squares(powers)?;
        let modes = Mode::BOTH.map(|mode| {
            let mut weights = vec![[0.0; 2]; sites.count()];
            let mut face = 0.0;
            for (place, (&column, r)) in columns.iter().zip(&radii).enumerate() {
                let share = inverse[(0, place)] * (2.0 * PI * r).sqrt();
                face -= share;
                for row in [sites.upper_row() - 1, sites.upper_row()] {
                    self.add_stress(
                        tip,
                        elastic,
                        mode,
                        row * sites.nodes[0] + column,
                        0.5 * share,
                        &mut weights,
                    );
                }
            }
            let faces = if mode == Mode::I { [face, 0.0] } else { [0.0, face] };
            Functional::from_fields(&weights, &[], faces)
        });
        Ok(Reading { modes })
    }

    /// Adds the weights of `share` times σ_yy (I) or σ_xy (II) at a node.
    fn add_stress(
        &self,
        tip: &Tip,
        elastic: &Elastic,
        mode: Mode,
        node: usize,
        share: f64,
        weights: &mut [[f64; 2]],
    ) {
        let mu = elastic.shear_modulus;
        // On ∂u_x/∂x, ∂u_y/∂x (axis 0) and ∂u_x/∂y, ∂u_y/∂y (axis 1).
        let parts = match mode {
            Mode::I => [[elastic.lambda(), 0.0], [0.0, elastic.lambda() + 2.0 * mu]],
            Mode::II => [[0.0, mu], [mu, 0.0]],
        };
        for (axis, parts) in parts.iter().enumerate() {
            for (other, w) in self.differences.derivative(&tip.sites, node, axis) {
                weights[other][0] += share * w * parts[0];
                weights[other][1] += share * w * parts[1];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Faces;
    use super::super::synthetic::{Potential, displacement, patch, plus, sampled};
    use super::*;

    /// Steel: µ = 72 GPa, κ = 2.
    const ELASTIC: Elastic = Elastic { shear_modulus: 72e9, kappa: 2.0, density: 8000.0 };
    const K: [f64; 2] = [2e6, -3e6];
    const FACES: Faces = Faces { normal: -30e6, shear: 20e6 };

    fn field(x: [f64; 2]) -> [f64; 2] {
        let potentials = [
            Potential::k(K),
            Potential::t(5e6),
            Potential::new(3, 4e6, 1e6),
            Potential::new(4, -2e6, 3e6),
            Potential::new(5, 1e7, 2e7),
        ];
        let strained = plus(displacement(&ELASTIC, &potentials, x), 1.0, FACES.displacement(&ELASTIC, x));
        plus(strained, 2e-4, [1.0 - x[1], -3.0 + x[0]])
    }

    fn errors(half: usize, terms: usize) -> [f64; 2] {
        let tip = Tip { sites: patch(half, 0.21 / half as f64), horizon: 0.0, crack: 1.0 };
        let annulus = Annulus { inner: 0.06, outer: 0.2 };
        let fit = StressFit { annulus, terms, differences: Differences::Second };
        let u = sampled(&tip.sites, field);
        let found = fit.reading(&tip, &ELASTIC).unwrap().at_loaded(&u, &[], FACES);
        [0, 1].map(|mode| (found[mode] / K[mode] - 1.0).abs())
    }

    /// With the terms that the field has, what is left is of second order: differences and rows off the line.
    #[test]
    fn the_stress_ahead_is_read_with_second_order() {
        let (coarse, fine) = (errors(42, 2), errors(84, 2));
        for (coarse, fine) in coarse.into_iter().zip(fine) {
            assert!(((coarse / fine).log2() - 2.0).abs() < 0.2, "{coarse:e} {fine:e}");
            // (h/r)² of 5 mm at 60 mm is 7e-3; extrapolation to r = 0 may double it.
            assert!(coarse < 1.5e-2, "{coarse:e}");
        }
    }

    #[test]
    fn k_alone_takes_the_higher_terms_for_its_own() {
        assert!(errors(42, 0).iter().all(|error| *error > 0.05));
    }

    #[test]
    fn too_few_columns_are_refused() {
        let tip = Tip { sites: patch(42, 0.005), horizon: 0.0, crack: 1.0 };
        let annulus = Annulus { inner: 0.06, outer: 0.071 };
        let refused = |terms| {
            StressFit { annulus, terms, differences: Differences::Second }.reading(&tip, &ELASTIC).err()
        };
        assert!(matches!(refused(3), Some(Unreadable::TooFewNodes { nodes: 2, unknowns: 4 })));
        assert_eq!(refused(1), None);
    }
}
