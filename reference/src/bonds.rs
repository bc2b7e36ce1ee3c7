//! Which nodes belong to a family, how much of each counts, and how stiff each bond is.
//!
//! A node at integer offset r (in spacings, |r| > 0) pulls with c₀W(|r|/m) β V/|ξ|, β its volume fraction; it
//! belongs to the family where β > 0. Weights are made dimensionless so that
//! bar (ω Δx/v)² = Σ_r w_r (1 − cos kr), w_r = β W/(m² M₁ |r|);
//! plane (ω Δx/c_d)² = eigenvalue of Σ_r w_r n⊗n (1 − cos k·r), w_r = 8 β W/(3π m³ M₂ |r|), n = r/|r|,
//! M_n = ∫₀¹ W sⁿ ds from c₀. Source: Silling and Askari (2005); Bobaru and Ha, Int. J. Multiscale Comput.
//! Eng. 9 (2011) 635 (volume fractions).

use crate::cell;
use crate::double_double::{Dd, PI};
use crate::kernel::Kernel;

/// How much of a node's volume counts when its cell straddles the horizon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VolumeRule {
    /// All where |r| ≤ m (a tie within 1e-12 counts as inside), else nothing.
    Full,
    /// m + ½ − |r|, between 0 and 1.
    Linear,
    /// The part of the node's square cell inside the circle of radius m; in a bar the same as linear.
    ExactArea,
}

/// A uniform square lattice (or bar) of nodes with its kernel and weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Shape of the micromodulus.
    pub kernel: Kernel,
    /// Horizon over spacing, at least 1.
    pub m: f64,
    /// Volume fraction of the nodes near the horizon.
    pub rule: VolumeRule,
    /// Whether the bonds are multiplied by the factors that make the lattice's moduli exact.
    pub calibrated: bool,
}

/// Bonds to +r and −r of a bar, together.
pub(crate) struct BarBond {
    /// r, at least 1.
    pub(crate) offset: f64,
    /// Share of the node's volume that counts.
    pub(crate) fraction: Dd,
    /// w of one of the two.
    pub(crate) weight: Dd,
}

/// One bond of the plane.
pub(crate) struct PlaneBond {
    /// r along x.
    pub(crate) x: f64,
    /// r along y.
    pub(crate) y: f64,
    /// |r|.
    pub(crate) length: Dd,
    /// w without the calibration's cos 4θ factor.
    pub(crate) weight: Dd,
}

/// The volume fraction of a bar's node.
fn fraction_bar(rule: VolumeRule, m: f64, offset: i32) -> Dd {
    straight_fraction(rule, m, Dd::from(f64::from(offset)))
}

/// `Full` and `Linear` at a distance.
fn straight_fraction(rule: VolumeRule, m: f64, distance: Dd) -> Dd {
    if rule == VolumeRule::Full {
        return if distance.to_f64() <= m * (1.0 + 1e-12) { Dd::ONE } else { Dd::ZERO };
    }
    let fraction = Dd::from(m) + Dd::from(0.5) - distance;
    if fraction.hi <= 0.0 {
        Dd::ZERO
    } else if fraction > Dd::ONE {
        Dd::ONE
    } else {
        fraction
    }
}

/// The volume fraction of the plane's node (i, j).
fn fraction_plane(rule: VolumeRule, m: f64, i: i32, j: i32) -> Dd {
    if rule == VolumeRule::ExactArea {
        cell::area(i, j, m)
    } else {
        straight_fraction(rule, m, distance(i, j))
    }
}

/// √(i² + j²).
fn distance(i: i32, j: i32) -> Dd {
    Dd::from(f64::from(i * i + j * j)).sqrt()
}

/// No node further out can be in the family.
fn reach(m: f64) -> i32 {
    (m + 0.5).ceil() as i32 + 1
}

/// The family of a bar, one entry for the two nodes at ±r.
pub(crate) fn bar(lattice: &Lattice) -> Vec<BarBond> {
    let m = Dd::from(lattice.m);
    let factor = Dd::ONE / (m.squared() * lattice.kernel.moment(1));
    (1..=reach(lattice.m))
        .map(|r| (f64::from(r), fraction_bar(lattice.rule, lattice.m, r)))
        .filter(|(_, fraction)| fraction.hi > 0.0)
        .map(|(offset, fraction)| {
            let r = Dd::from(offset);
            BarBond { offset, fraction, weight: factor * fraction * lattice.kernel.weight(r / m) / r }
        })
        .collect()
}

/// The family of the plane, every node; the volume fraction is worked out in one octant and mirrored.
pub(crate) fn plane(lattice: &Lattice) -> Vec<PlaneBond> {
    let (reach, m) = (reach(lattice.m), Dd::from(lattice.m));
    let factor = Dd::from(8.0) / (PI * 3.0 * m.squared() * m * lattice.kernel.moment(2));
    let octant: Vec<Vec<(Dd, Dd)>> = (0..=reach)
        .map(|i| {
            (0..=i)
                .map(|j| {
                    let (fraction, r) = (fraction_plane(lattice.rule, lattice.m, i, j), distance(i, j));
                    let in_family = (i, j) != (0, 0) && fraction.hi > 0.0;
                    let weight = || factor * fraction * lattice.kernel.weight(r / m) / r;
                    if in_family { (r, weight()) } else { (Dd::ZERO, Dd::ZERO) }
                })
                .collect()
        })
        .collect();
    let nodes = (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| (i, j)));
    nodes
        .map(|(i, j)| (i, j, octant[i.abs().max(j.abs()) as usize][i.abs().min(j.abs()) as usize]))
        .filter(|(_, _, (length, _))| length.hi > 0.0)
        .map(|(i, j, (length, weight))| PlaneBond { x: f64::from(i), y: f64::from(j), length, weight })
        .collect()
}

impl PlaneBond {
    /// cos²θ of the bond's direction.
    pub(crate) fn cosine_squared(&self) -> Dd {
        Dd::from(self.x * self.x) / Dd::from(self.x * self.x + self.y * self.y)
    }

    /// sin²θ.
    pub(crate) fn sine_squared(&self) -> Dd {
        Dd::from(self.y * self.y) / Dd::from(self.x * self.x + self.y * self.y)
    }

    /// cos 4θ = cos⁴θ − 6 cos²θ sin²θ + sin⁴θ.
    pub(crate) fn cosine_of_four(&self) -> Dd {
        let (c, s) = (self.cosine_squared(), self.sine_squared());
        c.squared() - c * s * 6.0 + s.squared()
    }
}
