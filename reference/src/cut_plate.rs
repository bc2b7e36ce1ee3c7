//! The bonds that straight cuts and round holes leave of a free plate's lattice, decided in whole numbers; what they pull, and
//! the pieces they hold together.
//!
//! Nodes stand at the centres of square cells; a place is a whole number of hundredths of a cell along each axis, so that
//! products of places decide on which side of a line a node lies without rounding. A straight cut takes a bond whose ends
//! lie on different sides of its line, a node on the line counting to its left, where the bond crosses the line between the
//! cut's ends, these included. A hole is the open disc: it takes the nodes in it, and the bonds of which a point lies in it.

use crate::bonds::Lattice;
use crate::lattice::plane_bonds;

/// Parts of a cell in which places are counted.
pub const UNIT: i64 = 100;

/// A free plate of cells, with cuts from place to place and holes about a place with a radius, all in [`UNIT`]s of a cell
/// from the lower left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct CutPlate {
    /// Along x and y.
    pub nodes: [i64; 2],
    /// Straight cuts.
    pub cuts: Vec<[[i64; 2]; 2]>,
    /// Centres and radii.
    pub holes: Vec<([i64; 2], i64)>,
}

/// One bond as an end sees it: the other end, the direction of the bond, and its weight over C₁₁/Δx².
struct Pull {
    to: [i64; 2],
    direction: [f64; 2],
    weight: f64,
}

impl CutPlate {
    /// The nodes that holes leave, row by row.
    pub fn standing(&self) -> Vec<[i64; 2]> {
        let [columns, rows] = self.nodes;
        let all = (0..rows).flat_map(|y| (0..columns).map(move |x| [x, y]));
        all.filter(|node| self.stands(*node)).collect()
    }

    /// Whether a node is in the plate and in no hole.
    pub fn stands(&self, node: [i64; 2]) -> bool {
        let inside = (0..2).all(|axis| (0..self.nodes[axis]).contains(&node[axis]));
        let centre = middle(node);
        inside && self.holes.iter().all(|(hole, radius)| square(minus(centre, *hole)) >= sq(*radius))
    }

    /// Whether no cut and no hole lies between two nodes.
    pub fn joined(&self, a: [i64; 2], b: [i64; 2]) -> bool {
        let (a, b) = (middle(a), middle(b));
        !self.cuts.iter().any(|cut| parts(*cut, a, b)) && !self.holes.iter().any(|hole| pierces(*hole, a, b))
    }

    /// How many bonds there are.
    pub fn bonds(&self, lattice: Lattice) -> usize {
        self.pulls(lattice).iter().map(Vec::len).sum::<usize>() / 2
    }

    /// How many bonds each node has lost that it would have in a plate without cuts and holes, node by node as they stand.
    pub fn lost(&self, lattice: Lattice) -> Vec<usize> {
        let whole = Self { nodes: self.nodes, cuts: Vec::new(), holes: Vec::new() };
        let had: Vec<usize> = whole.pulls(lattice).iter().map(Vec::len).collect();
        let number = |node: &[i64; 2]| (node[1] * self.nodes[0] + node[0]) as usize;
        let nodes = self.standing();
        nodes.iter().zip(self.pulls(lattice)).map(|(node, pulls)| had[number(node)] - pulls.len()).collect()
    }

    /// The pieces that bonds hold together, as the number of each node's piece, from 0 in the order of their first nodes.
    pub fn pieces(&self, lattice: Lattice) -> Vec<usize> {
        let (nodes, pulls) = (self.standing(), self.pulls(lattice));
        let mut piece = vec![usize::MAX; nodes.len()];
        let mut count = 0;
        for first in 0..nodes.len() {
            if piece[first] != usize::MAX {
                continue;
            }
            let mut open = vec![first];
            while let Some(one) = open.pop() {
                if piece[one] == usize::MAX {
                    piece[one] = count;
                    open.extend(pulls[one].iter().filter_map(|pull| place_in(&nodes, pull.to)));
                }
            }
            count += 1;
        }
        piece
    }

    /// What the bonds pull on each node, Σ w n (n·(u' − u)), over C₁₁/Δx² times the unit of the displacements, which stand
    /// node by node as they do. None where there are not as many displacements as nodes.
    pub fn forces(&self, lattice: Lattice, displacements: &[[f64; 2]]) -> Option<Vec<[f64; 2]>> {
        let nodes = self.standing();
        if nodes.len() != displacements.len() {
            return None;
        }
        let at = |node: [i64; 2]| place_in(&nodes, node).map(|index| displacements[index]);
        let on = |(here, pulls): (&[f64; 2], &Vec<Pull>)| {
            let mut sum = [0.0; 2];
            for pull in pulls {
                let there = at(pull.to)?;
                let along: f64 = (0..2).map(|axis| pull.direction[axis] * (there[axis] - here[axis])).sum();
                (0..2).for_each(|axis| sum[axis] += pull.weight * pull.direction[axis] * along);
            }
            Some(sum)
        };
        displacements.iter().zip(&self.pulls(lattice)).map(on).collect()
    }

    /// The bonds of every node.
    fn pulls(&self, lattice: Lattice) -> Vec<Vec<Pull>> {
        let family: Vec<([i64; 2], f64)> = plane_bonds(&lattice)
            .iter()
            .map(|(bond, weight)| ([bond.x as i64, bond.y as i64], weight.to_f64()))
            .collect();
        let of = |node: &[i64; 2]| {
            let pull = |(offset, weight): &([i64; 2], f64)| {
                let to = [node[0] + offset[0], node[1] + offset[1]];
                let length = libm::hypot(offset[0] as f64, offset[1] as f64);
                let direction = offset.map(|x| x as f64 / length);
                let there = self.stands(to) && self.joined(*node, to);
                there.then_some(Pull { to, direction, weight: *weight })
            };
            family.iter().filter_map(pull).collect()
        };
        self.standing().iter().map(of).collect()
    }
}

/// Place of a node among those that stand, which are ordered by row, then along x.
fn place_in(nodes: &[[i64; 2]], node: [i64; 2]) -> Option<usize> {
    nodes.binary_search_by_key(&(node[1], node[0]), |&[x, y]| (y, x)).ok()
}

/// Centre of a node's cell.
fn middle(node: [i64; 2]) -> [i64; 2] {
    node.map(|n| n * UNIT + UNIT / 2)
}

fn minus(a: [i64; 2], b: [i64; 2]) -> [i64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: [i64; 2], b: [i64; 2]) -> i128 {
    i128::from(a[0]) * i128::from(b[0]) + i128::from(a[1]) * i128::from(b[1])
}

fn cross(a: [i64; 2], b: [i64; 2]) -> i128 {
    i128::from(a[0]) * i128::from(b[1]) - i128::from(a[1]) * i128::from(b[0])
}

fn square(a: [i64; 2]) -> i128 {
    dot(a, a)
}

fn sq(x: i64) -> i128 {
    i128::from(x) * i128::from(x)
}

/// Whether a straight cut lies between a and b.
fn parts([from, to]: [[i64; 2]; 2], a: [i64; 2], b: [i64; 2]) -> bool {
    let along = minus(to, from);
    let (left_a, left_b) = (cross(along, minus(a, from)), cross(along, minus(b, from)));
    if (left_a >= 0) == (left_b >= 0) {
        return false;
    }
    // The crossing a + (b − a) left_a/(left_a − left_b), along the cut and times that difference, made positive.
    let apart = left_a - left_b;
    let way = apart * dot(along, minus(a, from)) + left_a * dot(along, minus(b, a));
    let (way, apart) = if apart < 0 { (-way, -apart) } else { (way, apart) };
    (0..=apart * square(along)).contains(&way)
}

/// Whether a point between a and b, these included, lies in a hole.
fn pierces((centre, radius): ([i64; 2], i64), a: [i64; 2], b: [i64; 2]) -> bool {
    let (along, to) = (minus(b, a), minus(centre, a));
    let way = dot(along, to);
    if way <= 0 {
        return square(to) < sq(radius);
    }
    if way >= square(along) {
        return square(minus(centre, b)) < sq(radius);
    }
    let beside = cross(along, to);
    beside * beside < sq(radius) * square(along)
}
