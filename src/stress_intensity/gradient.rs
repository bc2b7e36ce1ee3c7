//! Displacement gradients at lattice nodes by differences that never reach across the crack.
//!
//! Behind the tip the rows above and below the crack are two pieces: beside it differences across turn one-sided, of the
//! same order. Ahead of the tip, and along x, they are central; at the rim of the nodes they turn one-sided too.

use super::{Sites, Unreadable};

/// Order of the differences.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Differences {
    /// Three nodes, error of h².
    Second,
    /// Five nodes, error of h⁴.
    Fourth,
}

impl Differences {
    /// The nodes of a difference.
    pub fn points(self) -> usize {
        match self {
            Self::Second => 3,
            Self::Fourth => 5,
        }
    }

    /// Refuses sites with fewer rows on one side of the crack, or fewer columns, than a difference needs.
    pub(super) fn check(self, sites: &Sites) -> Result<(), Unreadable> {
        let rows = sites.upper_row().min(sites.nodes[1] - sites.upper_row());
        let nodes = rows.min(sites.nodes[0]);
        if nodes < self.points() {
            return Err(Unreadable::TooFewNodes { nodes, unknowns: self.points() });
        }
        Ok(())
    }

    /// Nodes and weights, in 1/m, of ∂/∂x (axis 0) or ∂/∂y (axis 1) at a node.
    pub(super) fn derivative(self, sites: &Sites, node: usize, axis: usize) -> Vec<(usize, f64)> {
        let stride = [1, sites.nodes[0]][axis];
        let centre = [node % sites.nodes[0], node / sites.nodes[0]];
        let behind = sites.place(node)[0] <= BESIDE * sites.spacing;
        let (from, to) = match (axis, behind) {
            (1, true) if centre[1] >= sites.upper_row() => (sites.upper_row(), sites.nodes[1]),
            (1, true) => (0, sites.upper_row()),
            _ => (0, sites.nodes[axis]),
        };
        let points = self.points();
        let first = (centre[axis].max(from + points / 2) - points / 2).min(to - points);
        let offsets: Vec<f64> =
            (first..first + points).map(|place| place as f64 - centre[axis] as f64).collect();
        let weights = slope_at_zero(&offsets);
        let nodes = (first..first + points).map(|place| node + place * stride - centre[axis] * stride);
        nodes.zip(weights).map(|(node, w)| (node, w / sites.spacing)).filter(|(_, w)| *w != 0.0).collect()
    }
}

/// A column this close to the tip, in spacings, counts as behind it.
const BESIDE: f64 = 1e-6;

/// Weights on values at some offsets, 0 among them, of the slope at 0 of the polynomial through them.
fn slope_at_zero(offsets: &[f64]) -> Vec<f64> {
    let others = |skip: f64| offsets.iter().filter(move |&&o| o != 0.0 && o != skip);
    let weight = |&at: &f64| {
        if at == 0.0 {
            return -others(0.0).map(|o| 1.0 / o).sum::<f64>();
        }
        others(at).map(|o| -o / (at - o)).product::<f64>() / at
    };
    offsets.iter().map(weight).collect()
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{patch, sampled};
    use super::*;

    #[test]
    fn weights_are_the_textbook_ones() {
        for (offsets, wanted) in [
            (vec![-1.0, 0.0, 1.0], vec![-0.5, 0.0, 0.5]),
            (vec![0.0, 1.0, 2.0], vec![-1.5, 2.0, -0.5]),
            (vec![-2.0, -1.0, 0.0, 1.0, 2.0], [1.0, -8.0, 0.0, 8.0, -1.0].map(|w| w / 12.0).to_vec()),
            (vec![-1.0, 0.0, 1.0, 2.0, 3.0], [-3.0, -10.0, 18.0, -6.0, 1.0].map(|w| w / 12.0).to_vec()),
            (vec![0.0, 1.0, 2.0, 3.0, 4.0], [-25.0, 48.0, -36.0, 16.0, -3.0].map(|w| w / 12.0).to_vec()),
        ] {
            let found = slope_at_zero(&offsets);
            assert!(found.iter().zip(&wanted).all(|(a, b)| (a - b).abs() < 1e-15), "{found:?} {wanted:?}");
        }
    }

    /// A field that jumps by 7 across the crack and is otherwise a polynomial of the degree that differences carry.
    #[test]
    fn polynomials_are_differentiated_exactly_on_either_side_of_the_crack() {
        let sites = patch(6, 0.5);
        for (differences, degree) in [(Differences::Second, 2), (Differences::Fourth, 4)] {
            let field = |[x, y]: [f64; 2]| {
                let jump = if x < 0.0 && y > 0.0 { 7.0 } else { 0.0 };
                [jump + (x + 0.5 * y).powi(degree), 0.0]
            };
            let u = sampled(&sites, field);
            for node in 0..sites.count() {
                let [x, y] = sites.place(node);
                let slope = f64::from(degree) * (x + 0.5 * y).powi(degree - 1);
                for (axis, wanted) in [(0, slope), (1, 0.5 * slope)] {
                    // Along x the polynomial runs through the jump only above the crack's line.
                    let crosses = axis == 0 && y > 0.0 && x.abs() < 1.5;
                    let weights = differences.derivative(&sites, node, axis);
                    let found: f64 = weights.iter().map(|&(node, w)| w * u[node][0]).sum();
                    assert!(
                        crosses || (found - wanted).abs() < 1e-11,
                        "{differences:?} {x} {y} {axis}: {found} {wanted}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_strip_too_thin_is_refused() {
        let sites = patch(4, 1.0);
        assert_eq!(Differences::Second.check(&sites), Ok(()));
        assert!(matches!(Differences::Fourth.check(&sites), Err(Unreadable::TooFewNodes { .. })));
    }
}
