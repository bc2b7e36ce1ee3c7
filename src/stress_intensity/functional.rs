//! A number read from a motion by a sum of weights, and the pair of them that K_I and K_II are.

use super::Faces;

/// Σ w·u + Σ w·ü + what a unit of stress on the faces adds. Its unit is that of what it reads.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Functional {
    /// The nodes it looks at.
    pub nodes: Vec<usize>,
    /// Per node, on u_x and u_y in m.
    pub displacement: Vec<[f64; 2]>,
    /// Per node, on ü_x and ü_y in m/s²; empty where it does not look at the acceleration.
    pub acceleration: Vec<[f64; 2]>,
    /// On σ_yy and σ_xy of the faces, in Pa.
    pub faces: [f64; 2],
}

impl Functional {
    /// Its value, for fields over all sites; a functional without weights on the acceleration takes an empty one.
    ///
    /// # Panics
    /// When a field is shorter than the nodes it looks at.
    pub fn at(&self, displacement: &[[f64; 2]], acceleration: &[[f64; 2]], faces: Faces) -> f64 {
        self.sum(&self.displacement, displacement)
            + self.sum(&self.acceleration, acceleration)
            + self.faces[0] * faces.normal
            + self.faces[1] * faces.shear
    }

    fn sum(&self, weights: &[[f64; 2]], field: &[[f64; 2]]) -> f64 {
        let each = self.nodes.iter().zip(weights);
        each.map(|(&node, w)| w[0] * field[node][0] + w[1] * field[node][1]).sum()
    }

    /// Whether it looks at the acceleration.
    pub fn needs_acceleration(&self) -> bool {
        !self.acceleration.is_empty()
    }

    /// Keeps only nodes with a weight from weights over all sites.
    pub(super) fn from_fields(displacement: &[[f64; 2]], acceleration: &[[f64; 2]], faces: [f64; 2]) -> Self {
        let has = |field: &[[f64; 2]], node: usize| field.get(node).is_some_and(|w| *w != [0.0; 2]);
        let used = |&node: &usize| has(displacement, node) || has(acceleration, node);
        let nodes: Vec<usize> = (0..displacement.len()).filter(used).collect();
        let keep = |field: &[[f64; 2]]| -> Vec<[f64; 2]> {
            if field.is_empty() { Vec::new() } else { nodes.iter().map(|&node| field[node]).collect() }
        };
        let (displacement, acceleration) = (keep(displacement), keep(acceleration));
        Self { nodes, displacement, acceleration, faces }
    }
}

/// K_I and K_II in Pa√m.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    pub modes: [Functional; 2],
}

impl Reading {
    /// [K_I, K_II] in Pa√m where the faces are free.
    pub fn at(&self, displacement: &[[f64; 2]], acceleration: &[[f64; 2]]) -> [f64; 2] {
        self.at_loaded(displacement, acceleration, Faces::default())
    }

    /// [K_I, K_II] in Pa√m where the faces bear a uniform stress at the moment of the look.
    pub fn at_loaded(&self, displacement: &[[f64; 2]], acceleration: &[[f64; 2]], faces: Faces) -> [f64; 2] {
        [0, 1].map(|mode| self.modes[mode].at(displacement, acceleration, faces))
    }

    /// Nodes that either mode looks at, in the order of the sites.
    pub fn nodes(&self) -> Vec<usize> {
        let mut nodes: Vec<usize> = self.modes.iter().flat_map(|mode| mode.nodes.iter().copied()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// Whether a look must bring accelerations.
    pub fn needs_acceleration(&self) -> bool {
        self.modes.iter().any(Functional::needs_acceleration)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_by_hand() {
        let u = [[1.0, 2.0], [f64::NAN, 0.0], [3.0, 4.0]];
        let a = [[5.0, 6.0]; 3];
        let opening = Functional::from_fields(&[[2.0, 0.0], [0.0; 2], [0.0, 1.0]], &[], [0.0, 7.0]);
        let sliding = Functional::from_fields(&[[0.0; 2]; 3], &[[0.0, 1.0], [0.0; 2], [0.0; 2]], [0.0; 2]);
        let reading = Reading { modes: [opening, sliding] };
        assert_eq!(reading.at(&u, &a), [6.0, 6.0]);
        assert_eq!(reading.at_loaded(&u, &a, Faces { normal: 10.0, shear: 1.0 }), [13.0, 6.0]);
        assert_eq!((reading.nodes(), reading.needs_acceleration()), (vec![0, 2], true));
        assert!(!reading.modes[0].needs_acceleration());
    }
}
