//! What one bond does when its ends move apart: linearised for small rotations, or exact for any.
//!
//! Per unit of weight w = c V β/|ξ|, a bond ξ whose ends move apart by η pulls with
//! small rotations: n (n·η), n = ξ/|ξ|, and stores ½(n·η)²;
//! any rotation: e y/|y|, y = ξ + η, e = |y| − |ξ|, and stores ½e² (Silling & Askari 2005, Comput. Struct. 83, 1526:
//! f = c s y/|y|, s = e/|ξ|). The elongation is computed as η·(2ξ + η)/(|y| + |ξ|), which does not cancel.

use crate::simd::Lanes;

/// A bond as geometry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direction<const D: usize> {
    /// ξ in m.
    pub xi: [f64; D],
    /// |ξ| in m.
    pub length: f64,
    /// ξ/|ξ|.
    pub unit: [f64; D],
}

impl<const D: usize> Direction<D> {
    /// The bond of a lattice: its offset in spacings.
    pub fn new(offset: [i32; D], spacing: f64) -> Self {
        let squares: f64 = offset.iter().map(|&n| f64::from(n) * f64::from(n)).sum();
        let distance = squares.sqrt();
        Self {
            xi: offset.map(|n| f64::from(n) * spacing),
            length: distance * spacing,
            unit: offset.map(|n| f64::from(n) / distance),
        }
    }

    /// The same bond seen from its other end.
    #[inline(always)]
    pub fn reversed(&self) -> Self {
        Self { xi: self.xi.map(|x| -x), length: self.length, unit: self.unit.map(|n| -n) }
    }
}

/// How a bond turns and stretches; chosen once, outside the loops.
pub trait Law: Copy + Send + Sync + 'static {
    /// In study files and plans.
    const NAME: &'static str;
    /// Whether the force is linear in the displacement.
    const LINEAR: bool;

    /// Force per unit weight on the near end, in m, when the far end moves by η against it; of one bond or of some side by
    /// side.
    fn pull<const D: usize, V: Lanes>(bond: &Direction<D>, eta: [V; D]) -> [V; D];

    /// The same from both bonds of a pair ±ξ.
    #[inline(always)]
    fn pair<const D: usize, V: Lanes>(bond: &Direction<D>, forward: [V; D], backward: [V; D]) -> [V; D] {
        let (one, other) = (Self::pull(bond, forward), Self::pull(&bond.reversed(), backward));
        std::array::from_fn(|axis| one[axis] + other[axis])
    }

    /// Energy stored per unit weight, in m².
    fn stored<const D: usize>(bond: &Direction<D>, eta: [f64; D]) -> f64;
}

#[inline(always)]
fn dot<const D: usize, V: Lanes>(a: [V; D], b: [V; D]) -> V {
    let mut sum = a[0] * b[0];
    for axis in 1..D {
        sum = sum + a[axis] * b[axis];
    }
    sum
}

/// The linearised law: bonds keep their direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Small;

impl Law for Small {
    const NAME: &'static str = "small";
    const LINEAR: bool = true;

    #[inline(always)]
    fn pull<const D: usize, V: Lanes>(bond: &Direction<D>, eta: [V; D]) -> [V; D] {
        let along = dot(bond.unit.map(V::splat), eta);
        bond.unit.map(|n| V::splat(n) * along)
    }

    #[inline(always)]
    fn pair<const D: usize, V: Lanes>(bond: &Direction<D>, forward: [V; D], backward: [V; D]) -> [V; D] {
        Self::pull(bond, std::array::from_fn(|axis| forward[axis] + backward[axis]))
    }

    #[inline(always)]
    fn stored<const D: usize>(bond: &Direction<D>, eta: [f64; D]) -> f64 {
        let along = dot(bond.unit, eta);
        0.5 * along * along
    }
}

/// The exact law: bonds turn with the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Finite;

impl Finite {
    /// y and its length, and the elongation.
    #[inline(always)]
    fn stretched<const D: usize, V: Lanes>(bond: &Direction<D>, eta: [V; D]) -> ([V; D], V, V) {
        let xi = bond.xi.map(V::splat);
        let y: [V; D] = std::array::from_fn(|axis| xi[axis] + eta[axis]);
        let length = dot(y, y).sqrt();
        let sum = std::array::from_fn(|axis| xi[axis] + y[axis]);
        (y, length, dot(eta, sum) / (length + V::splat(bond.length)))
    }
}

impl Law for Finite {
    const NAME: &'static str = "finite";
    const LINEAR: bool = false;

    #[inline(always)]
    fn pull<const D: usize, V: Lanes>(bond: &Direction<D>, eta: [V; D]) -> [V; D] {
        let (y, length, elongation) = Self::stretched(bond, eta);
        y.map(|y| elongation * (y / length))
    }

    #[inline(always)]
    fn stored<const D: usize>(bond: &Direction<D>, eta: [f64; D]) -> f64 {
        let (_, _, elongation) = Self::stretched(bond, eta);
        0.5 * elongation * elongation
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::{assert_abs_diff_eq, assert_relative_eq};

    const BOND: [i32; 2] = [3, 4];

    #[test]
    fn one_bond_by_hand() {
        let bond = Direction::new(BOND, 2.0);
        assert_eq!((bond.xi, bond.length, bond.unit), ([6.0, 8.0], 10.0, [0.6, 0.8]));
        // η along the bond by a tenth: both laws agree, 1 m of elongation.
        assert_relative_eq!(Small::pull(&bond, [0.6, 0.8])[0], 0.6, max_relative = 1e-15);
        assert_relative_eq!(Finite::pull(&bond, [0.6, 0.8])[1], 0.8, max_relative = 1e-15);
        // To (0, 13): elongation 3, along y.
        assert_abs_diff_eq!(Finite::pull(&bond, [-6.0, 5.0])[0], 0.0);
        assert_relative_eq!(Finite::pull(&bond, [-6.0, 5.0])[1], 3.0, max_relative = 1e-15);
        assert_relative_eq!(Finite::stored(&bond, [-6.0, 5.0]), 4.5, max_relative = 1e-15);
        // n·η = 0.6·(−6) + 0.8·5 = 0.4.
        assert_relative_eq!(Small::pull(&bond, [-6.0, 5.0])[1], 0.32, max_relative = 1e-14);
        assert_relative_eq!(Small::stored(&bond, [-6.0, 5.0]), 0.08, max_relative = 1e-14);
    }

    #[test]
    fn a_tiny_stretch_keeps_its_digits() {
        let bond = Direction::new([1], 1.0);
        assert_eq!(Finite::pull(&bond, [1e-300])[0], 1e-300);
        let plane = Direction::new(BOND, 1.0);
        let eta = [0.6e-12, 0.8e-12];
        assert_relative_eq!(Finite::pull(&plane, eta)[0], Small::pull(&plane, eta)[0], max_relative = 1e-11);
    }
}
