//! Displacement extrapolation: the opening at nodes behind the tip over √r, carried on a straight line to r = 0.
//!
//! At distance r along the faces half the opening is (κ+1)/(2µ) √(r/2π) K, so K*(r) = 2µ/(κ+1) √(2π/r) times it; K* is
//! extrapolated linearly in r from two nodes (Bouaraquia 2024, eqs. (62), (63), which take one face; Chan, Tuba, Wilson
//! 1970, Eng. Fract. Mech. 2, 1), or by a least-squares line from more. Where one edge of the plate is loaded, the plate also
//! moves as a whole: then half the opening is right and one face is not. The rows beside the crack stand for its faces,
//! half a spacing off.

use super::{Elastic, Functional, Reading, Tip, Unreadable};
use std::f64::consts::PI;

/// What stands for the displacement of a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Opening {
    /// Half of upper less lower face: free of rigid translation and of the T-stress.
    Half,
    /// The upper face alone, as printed.
    UpperFace,
}

/// Which nodes are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TwoPoint {
    pub opening: Opening,
    /// Columns nearest behind the tip that are left out.
    pub skip: usize,
    /// Columns on the line, at least 2.
    pub points: usize,
}

impl TwoPoint {
    /// The two nearest columns.
    pub fn nearest(opening: Opening) -> Self {
        Self { opening, skip: 0, points: 2 }
    }

    /// Prepares the reading; uniform stress on the faces does not enter it.
    pub fn reading(&self, tip: &Tip, elastic: &Elastic) -> Result<Reading, Unreadable> {
        tip.check()?;
        let columns = self.columns(tip)?;
        let radii: Vec<f64> = columns.iter().map(|&(_, r)| r).collect();
        let shares = intercept(&radii);
        let factor = 2.0 * elastic.shear_modulus / (elastic.kappa + 1.0);
        let (row, above) = (tip.sites.nodes[0], tip.sites.upper_row());
        let mut nodes = Vec::new();
        let mut weights = Vec::new();
        for (&(column, r), share) in columns.iter().zip(shares) {
            let weight = share * factor * (2.0 * PI / r).sqrt();
            let faces: &[(usize, f64)] = match self.opening {
                Opening::Half => &[(above - 1, -0.5), (above, 0.5)],
                Opening::UpperFace => &[(above, 1.0)],
            };
            for (face, part) in faces {
                nodes.push(face * row + column);
                weights.push(part * weight);
            }
        }
        // Mode I is read from u_y, mode II from u_x.
        let modes = [1, 0].map(|axis| {
            let on = |weight: &f64| if axis == 0 { [*weight, 0.0] } else { [0.0, *weight] };
            let displacement = weights.iter().map(on).collect();
            Functional { nodes: nodes.clone(), displacement, ..Functional::default() }
        });
        Ok(Reading { modes })
    }

    /// Columns behind the tip, nearest first, with their distance from it.
    fn columns(&self, tip: &Tip) -> Result<Vec<(usize, f64)>, Unreadable> {
        let behind = (0..tip.sites.nodes[0]).rev().map(|column| (column, -tip.sites.place(column)[0]));
        // A column at the tip itself has no r to divide by.
        let behind = behind.filter(|&(_, r)| r > 1e-6 * tip.sites.spacing);
        let columns: Vec<(usize, f64)> = behind.skip(self.skip).take(self.points).collect();
        if columns.len() < self.points.max(2) {
            return Err(Unreadable::TooFewNodes { nodes: columns.len(), unknowns: 2 });
        }
        match columns.last() {
            Some(&(_, r)) if r > tip.crack => Err(Unreadable::BeyondCrack { outer: r, crack: tip.crack }),
            _ => Ok(columns),
        }
    }
}

/// Weights of values at r on the value at 0 of their least-squares line.
fn intercept(radii: &[f64]) -> Vec<f64> {
    let count = radii.len() as f64;
    let mean = radii.iter().sum::<f64>() / count;
    let spread: f64 = radii.iter().map(|r| (r - mean) * (r - mean)).sum();
    radii.iter().map(|r| 1.0 / count - mean * (r - mean) / spread).collect()
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{Potential, displacement, patch, plus, sampled};
    use super::*;
    use approx::assert_relative_eq;

    const ELASTIC: Elastic = Elastic { shear_modulus: 2.5, kappa: 1.7, density: 3.0 };

    fn tip() -> Tip {
        Tip { sites: patch(8, 0.1), horizon: 0.0, crack: 5.0 }
    }

    /// u given on the faces themselves, so that K* is exactly a line: (K + c r)√r.
    #[test]
    fn a_line_is_extrapolated_exactly_by_two_points_and_by_more() {
        let tip = tip();
        let scale = (ELASTIC.kappa + 1.0) / (2.0 * ELASTIC.shear_modulus * (2.0 * PI).sqrt());
        let field = |[x, y]: [f64; 2]| {
            let r = (-x).max(0.0);
            let shape = |k: f64| y.signum() * scale * r.sqrt() * (k + 0.7 * r);
            plus([0.3, -0.4], 1.0, [shape(-5.0), shape(2.0)])
        };
        let u = sampled(&tip.sites, field);
        for (skip, points) in [(0, 2), (0, 5), (3, 4)] {
            let reading = TwoPoint { opening: Opening::Half, skip, points }.reading(&tip, &ELASTIC).unwrap();
            let [one, two] = reading.at(&u, &[]);
            assert_relative_eq!(one, 2.0, max_relative = 1e-13);
            assert_relative_eq!(two, -5.0, max_relative = 1e-13);
            assert_eq!(reading.nodes().len(), 2 * points);
        }
        // One face sees the translation too.
        let printed = TwoPoint::nearest(Opening::UpperFace).reading(&tip, &ELASTIC).unwrap();
        assert!((printed.at(&u, &[])[0] - 2.0).abs() > 1.0);
    }

    /// By hand: radii 1/2 and 3/2 spacings have the intercept (3 K₁ − K₂)/2.
    #[test]
    fn the_two_nearest_columns_are_taken_and_weighted_as_printed() {
        let tip = tip();
        let reading = TwoPoint::nearest(Opening::UpperFace).reading(&tip, &ELASTIC).unwrap();
        assert_eq!(reading.modes[0].nodes, [8 * 16 + 7, 8 * 16 + 6]);
        let factor = 2.0 * 2.5 / 2.7;
        let weights = [1.5 * factor * (2.0 * PI / 0.05).sqrt(), -0.5 * factor * (2.0 * PI / 0.15).sqrt()];
        for (found, wanted) in reading.modes[0].displacement.iter().zip(weights) {
            assert_eq!(found[0], 0.0);
            assert_relative_eq!(found[1], wanted, max_relative = 1e-14);
        }
        let axis = reading.modes[1].displacement.iter().map(|w| w[1]).collect::<Vec<_>>();
        assert_eq!(axis, [0.0, 0.0]);
    }

    /// On the exact near field, the rows half a spacing off the faces cost what geometry says: √r_true at θ ≠ π, a few
    /// percent at the nearest columns, and an error that falls with the distance from the tip (r/Δx).
    #[test]
    fn rows_beside_the_faces_cost_less_further_out() {
        let tip = tip();
        let u = sampled(&tip.sites, |x| displacement(&ELASTIC, &[Potential::k([2.0, -5.0])], x));
        let error = |skip| {
            let found =
                TwoPoint { skip, ..TwoPoint::nearest(Opening::Half) }.reading(&tip, &ELASTIC).unwrap();
            let [one, two] = found.at(&u, &[]);
            (one / 2.0 - 1.0).abs().max((two / -5.0 - 1.0).abs())
        };
        assert!(error(0) > 0.02 && error(0) < 0.5, "{}", error(0));
        assert!(error(4) < 0.2 * error(0) && error(4) < 0.02, "{} {}", error(0), error(4));
    }

    #[test]
    fn too_few_columns_and_a_crack_that_ends_are_refused() {
        let tip = tip();
        let refused = |skip, points, tip: Tip| {
            TwoPoint { opening: Opening::Half, skip, points }.reading(&tip, &ELASTIC).unwrap_err()
        };
        assert!(matches!(refused(7, 2, tip), Unreadable::TooFewNodes { .. }));
        assert!(matches!(refused(0, 1, tip), Unreadable::TooFewNodes { .. }));
        assert!(matches!(refused(3, 3, Tip { crack: 0.4, ..tip }), Unreadable::BeyondCrack { .. }));
    }
}
