//! Free plates worked out from coordinates alone, by a plain double loop over the centres of cells and formulas of their
//! own: which nodes and bonds there are, the weights of the constant kernel with linear volumes as printed, the factors
//! of surface corrections, and the force.

use pd_verify::forces::surface::Correction;
use pd_verify::scene::{Hole, Notch, Rotations, Scene};

/// A plate as a list of points and of bonds.
pub struct Plain {
    /// Cell of each node, and its centre in m.
    pub nodes: Vec<([isize; 2], [f64; 2])>,
    /// Both ends and the weight in N/m⁴, corrected.
    pub bonds: Vec<(usize, usize, f64)>,
}

impl Plain {
    /// The plate of a scene; `across` says whether bonds whose ends stand may be cut by a hole between them.
    pub fn of(scene: &Scene<2>, across: bool) -> Self {
        let dx = scene.spacing;
        let mut nodes = Vec::new();
        for row in 0..scene.nodes[1] {
            for column in 0..scene.nodes[0] {
                let at = [(column as f64 + 0.5) * dx, (row as f64 + 0.5) * dx];
                let inside =
                    |hole: &Hole| (at[0] - hole.centre[0]).hypot(at[1] - hole.centre[1]) < hole.radius;
                if !scene.holes.iter().any(inside) {
                    nodes.push(([column as isize, row as isize], at));
                }
            }
        }
        let mut bonds = Vec::new();
        for i in 0..nodes.len() {
            for j in i + 1..nodes.len() {
                let (a, b) = (nodes[i].1, nodes[j].1);
                let fraction = fraction(scene, a, b);
                let cut = scene.notches.iter().any(|notch| meets(notch, a, b))
                    || (across && scene.holes.iter().any(|hole| enters(hole, a, b)));
                if fraction > 0.0 && !cut {
                    bonds.push((i, j, weight(scene, a, b)));
                }
            }
        }
        let mut plain = Self { nodes, bonds };
        let factors: Vec<f64> = plain.factors(scene);
        plain.bonds.iter_mut().zip(factors).for_each(|(bond, factor)| bond.2 *= factor);
        plain
    }

    /// Factors of all bonds, in their order.
    fn factors(&self, scene: &Scene<2>) -> Vec<f64> {
        let share = |a: [f64; 2], b: [f64; 2]| -> [f64; 2] {
            match scene.surface {
                Correction::Volume => [fraction(scene, a, b); 2],
                _ => [0, 1]
                    .map(|axis| weight(scene, a, b) * (b[axis] - a[axis]).powi(4) / length(a, b).powi(2)),
            }
        };
        let mut bulk = [0.0; 2];
        let reach = scene.lattice.m.ceil() as i32 + 1;
        for row in -reach..=reach {
            for column in -reach..=reach {
                let to = [f64::from(column) * scene.spacing, f64::from(row) * scene.spacing];
                if (row, column) != (0, 0) && fraction(scene, [0.0; 2], to) > 0.0 {
                    let more = share([0.0; 2], to);
                    bulk = [bulk[0] + more[0], bulk[1] + more[1]];
                }
            }
        }
        let mut own = vec![[0.0; 2]; self.nodes.len()];
        for &(i, j, _) in &self.bonds {
            let more = share(self.nodes[i].1, self.nodes[j].1);
            for end in [i, j] {
                own[end] = [own[end][0] + more[0], own[end][1] + more[1]];
            }
        }
        let of = |&(i, j, _): &(usize, usize, f64)| match scene.surface {
            Correction::None => 1.0,
            Correction::Volume => 2.0 * bulk[0] / (own[i][0] + own[j][0]),
            Correction::Energy => {
                let (a, b) = (self.nodes[i].1, self.nodes[j].1);
                let square = |axis: usize| {
                    let mean = 0.5 * (bulk[axis] / own[i][axis] + bulk[axis] / own[j][axis]);
                    ((b[axis] - a[axis]) / length(a, b) / mean).powi(2)
                };
                1.0 / (square(0) + square(1)).sqrt()
            }
        };
        self.bonds.iter().map(of).collect()
    }

    /// The force on each node in N/m³ from its displacement, and Σ|w||u_j − u_i|.
    pub fn force(&self, scene: &Scene<2>, u: &[[f64; 2]]) -> Vec<([f64; 2], f64)> {
        let mut all = vec![([0.0; 2], 0.0); self.nodes.len()];
        for &(i, j, weight) in &self.bonds {
            let (a, b) = (self.nodes[i].1, self.nodes[j].1);
            let xi = [b[0] - a[0], b[1] - a[1]];
            let eta = [u[j][0] - u[i][0], u[j][1] - u[i][1]];
            let size = length(a, b);
            let pull = match scene.rotations {
                Rotations::Small => {
                    let along = (xi[0] * eta[0] + xi[1] * eta[1]) / (size * size);
                    xi.map(|x| x * along)
                }
                Rotations::Finite => {
                    let y = [xi[0] + eta[0], xi[1] + eta[1]];
                    let stretched = y[0].hypot(y[1]);
                    y.map(|y| (stretched - size) * y / stretched)
                }
            };
            for (end, sign) in [(i, 1.0), (j, -1.0)] {
                (0..2).for_each(|axis| all[end].0[axis] += sign * weight * pull[axis]);
                all[end].1 += weight * eta[0].hypot(eta[1]);
            }
        }
        all
    }
}

fn length(a: [f64; 2], b: [f64; 2]) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// The linear volume rule; a tie at its end is no bond.
fn fraction(scene: &Scene<2>, a: [f64; 2], b: [f64; 2]) -> f64 {
    let left = scene.lattice.m + 0.5 - length(a, b) / scene.spacing;
    if left < 1e-9 { 0.0 } else { left.min(1.0) }
}

/// c V β/|ξ| with c = 9E/(πhδ³), V = hΔx².
fn weight(scene: &Scene<2>, a: [f64; 2], b: [f64; 2]) -> f64 {
    let horizon = scene.lattice.m * scene.spacing;
    let c = 9.0 * scene.material.youngs_modulus / (std::f64::consts::PI * horizon.powi(3));
    c * scene.spacing.powi(2) * fraction(scene, a, b) / length(a, b)
}

/// Twice the area of a triangle, with its sign.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether two segments cross; none of the notches tried passes through a node or ends on a bond.
fn meets(notch: &Notch, a: [f64; 2], b: [f64; 2]) -> bool {
    let apart = |p, q, one, other| turn(p, q, one) * turn(p, q, other) < 0.0;
    apart(notch.from, notch.to, a, b) && apart(a, b, notch.from, notch.to)
}

/// Whether a segment has points within a circle: the roots of |a + s(b − a) − c|² = r² enclose a part of 0 … 1.
fn enters(hole: &Hole, a: [f64; 2], b: [f64; 2]) -> bool {
    let (d, e) = ([b[0] - a[0], b[1] - a[1]], [a[0] - hole.centre[0], a[1] - hole.centre[1]]);
    let (square, half) = (d[0] * d[0] + d[1] * d[1], d[0] * e[0] + d[1] * e[1]);
    let under = half * half - square * (e[0] * e[0] + e[1] * e[1] - hole.radius * hole.radius);
    under > 0.0 && -half - under.sqrt() < square && -half + under.sqrt() > 0.0
}
