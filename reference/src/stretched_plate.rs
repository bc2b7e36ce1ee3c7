//! What the bonds of a free plate pull under a uniform displacement gradient, bonds stretching as they are: f = Σ w e y/|y|,
//! y = ξ + Hξ, e = |y| − |ξ| (Silling and Askari, Comput. Struct. 83 (2005) 1526, f = c s y/|y|).
//!
//! Sums in double-double: of an elongation of 1e-12 of a bond the difference of roots keeps twenty digits.

use crate::bonds::Lattice;
use crate::double_double::Dd;
use crate::lattice;

/// Force density over C11/Δx on every node of a plate of so many nodes along x and y, row by row; `gradient` is ∂u_i/∂x_j as
/// \[i\]\[j\]. Rounded from 30 digits less those that a strain of ε takes, 1/ε.
pub fn forces(of: Lattice, nodes: [usize; 2], gradient: [[f64; 2]; 2]) -> Vec<[f64; 2]> {
    let pulls: Vec<([f64; 2], [Dd; 2])> = lattice::plane_bonds(&of)
        .into_iter()
        .map(|(bond, weight)| {
            let xi = [bond.x, bond.y];
            let moved = gradient.map(|row| Dd::from(row[0]) * xi[0] + Dd::from(row[1]) * xi[1]);
            let y = [0, 1].map(|axis| Dd::from(xi[axis]) + moved[axis]);
            let length = (y[0].squared() + y[1].squared()).sqrt();
            let pull =
                weight * (length - (Dd::from(xi[0]).squared() + Dd::from(xi[1]).squared()).sqrt()) / length;
            (xi, y.map(|y| pull * y))
        })
        .collect();
    let inside = |node: [usize; 2], xi: [f64; 2]| {
        (0..2).all(|axis| (0.0..nodes[axis] as f64).contains(&(node[axis] as f64 + xi[axis])))
    };
    let force = |node: [usize; 2]| {
        let mine = pulls.iter().filter(|(xi, _)| inside(node, *xi));
        let sum = mine.fold([Dd::ZERO; 2], |sum, (_, pull)| [sum[0] + pull[0], sum[1] + pull[1]]);
        sum.map(Dd::to_f64)
    };
    (0..nodes[1]).flat_map(|j| (0..nodes[0]).map(move |i| [i, j])).map(force).collect()
}
