//! The lattice as a stencil: one weight per pair of bonds, its long-wave moduli, and their calibration.
//!
//! Node i feels Σ_b w_b n_b⊗n_b (u₊ + u₋ − 2u_i) over the half family, n_b the bond's direction and
//! w = c₀ W(|ξ|/δ) β V/|ξ|. Weights are kept dimensionless, w Δx²/C₁₁: one stencil serves every E, ρ and Δx.
//! Summed over the lattice, c₀ does not return the moduli it was made from; [`Moduli`] says by how much, and
//! calibration (bonds scaled by α + β cos 4θ; one factor α in a bar) makes C₁₁ and C₁₂ right, hence isotropic.

use crate::family::{Neighbour, half_family};
use crate::kernel::Kernel;
use crate::partial_volume::VolumeRule;
use std::f64::consts::PI;
use thiserror::Error;

/// What a peridynamic lattice is made with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    pub kernel: Kernel,
    /// m = δ/Δx ≥ 1, any real number.
    pub m: f64,
    pub volume_rule: VolumeRule,
    pub calibrated: bool,
}

impl std::fmt::Display for Lattice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let calibrated = if self.calibrated { ", calibrated" } else { "" };
        write!(f, "{}, m = {}, {}{calibrated}", self.kernel, self.m, self.volume_rule.name())
    }
}

/// Lattice moduli over intended ones. In a bar only C₁₁ (= E) means something; C₁₂ = C₆₆ by central forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moduli {
    /// C₁₁ over the intended one.
    pub c11: f64,
    /// C₁₂ = C₆₆ over the intended one; 0 in a bar.
    pub c12: f64,
}

impl Moduli {
    /// Zener's ratio 2C₆₆/(C₁₁ − C₁₂): 1 when isotropic. Intended C₁₂ = C₆₆ = C₁₁/3.
    pub fn zener_ratio(self) -> f64 {
        2.0 * self.c12 / (3.0 * self.c11 - self.c12)
    }
}

/// Bonds are multiplied by alpha + beta cos 4θ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Calibration {
    pub alpha: f64,
    pub beta: f64,
}

/// A lattice that no computation should be run with.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Unusable {
    /// m < 1 or NaN.
    #[error("m = {m} is below 1: the horizon does not reach the nearest node")]
    HorizonBelowSpacing { m: f64 },
    /// A family of more bonds than any body is given.
    #[error("m = {m} makes {pairs:.1e} pairs of bonds, at most {MOST_PAIRS:.0e} are made")]
    TooLarge { m: f64, pairs: f64 },
    /// C₆₆ = 0.
    #[error("{lattice} has no shear stiffness: all its bonds lie along the axes, so C66 = 0")]
    NoShear { lattice: Lattice },
    /// A modulus below rounding of the intended one.
    #[error(
        "{lattice} has lost its weights: of the intended modulus {modulus} the lattice keeps {kept:e}, less than rounding"
    )]
    LostWeights { lattice: Lattice, modulus: &'static str, kept: f64 },
}

impl Unusable {
    /// What to change.
    pub fn cure(&self) -> &'static str {
        match self {
            Self::HorizonBelowSpacing { .. } => "take m >= 1, or a smaller spacing for the same horizon",
            Self::TooLarge { .. } => "take a smaller m, or a larger spacing for the same horizon",
            Self::NoShear { .. } => {
                "take m >= 1.5, or volume_rule \"linear\" or \"exact_area\", which reach the diagonal neighbours"
            }
            Self::LostWeights { .. } => {
                "resolve the kernel: a larger m, a smaller p, or a kernel that is positive at the nearest nodes"
            }
        }
    }
}

/// A larger family is a slip of the pen: it takes a tenth of a second to make, and one step of it an hour.
const MOST_PAIRS: f64 = 1e6;

/// One pair of bonds ±ξ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bond<const D: usize> {
    /// ξ/Δx.
    pub offset: [i32; D],
    /// w Δx²/C₁₁.
    pub weight: f64,
}

/// The weights of a lattice, ready to use.
#[derive(Debug, Clone, PartialEq)]
pub struct Stencil<const D: usize> {
    /// One of each pair ±ξ, by row, then along x.
    pub bonds: Vec<Bond<D>>,
    /// Moduli of the weights as printed.
    pub before: Moduli,
    /// Moduli of the weights in use.
    pub after: Moduli,
    /// `None` when the weights are used as printed.
    pub calibration: Option<Calibration>,
}

impl<const D: usize> Stencil<D> {
    /// Builds the weights, or says why this lattice cannot be used.
    pub fn new(lattice: Lattice) -> Result<Self, Unusable> {
        let printed = printed_weights::<D>(lattice)?;
        let before = moduli(&printed);
        resolved::<D>(lattice, before)?;
        if !lattice.calibrated {
            return Ok(Self { bonds: printed, before, after: before, calibration: None });
        }
        let factors = calibrate(&printed, before);
        let bonds: Vec<_> = printed.iter().map(|bond| factors.scale(bond)).collect();
        let after = moduli(&bonds);
        let calibration = Calibration {
            alpha: 0.5 * (factors.axes + factors.diagonals),
            beta: 0.5 * (factors.axes - factors.diagonals),
        };
        Ok(Self { bonds, before, after, calibration: Some(calibration) })
    }

    /// Bonds of both directions with a negative weight.
    pub fn negative_bonds(&self) -> usize {
        2 * self.bonds.iter().filter(|bond| bond.weight < 0.0).count()
    }

    /// The largest offset along an axis.
    pub fn reach(&self) -> usize {
        self.bonds.iter().flat_map(|bond| bond.offset).map(|n| n.unsigned_abs() as usize).max().unwrap_or(0)
    }

    /// Σ w over the whole family, in units of C₁₁/Δx²: what the usual time-step bound looks at.
    pub fn row_sum(&self) -> f64 {
        2.0 * self.bonds.iter().map(|bond| bond.weight).sum::<f64>()
    }
}

/// w Δx²/C₁₁ from c₀ of energy equivalence: W β/(m² M₁ |r|) in a bar, 8 W β/(3π m³ M₂ |r|) in the plane.
fn printed_weights<const D: usize>(lattice: Lattice) -> Result<Vec<Bond<D>>, Unusable> {
    let Lattice { kernel, m, volume_rule, .. } = lattice;
    if m.is_nan() || m < 1.0 {
        return Err(Unusable::HorizonBelowSpacing { m });
    }
    let pairs = if D == 1 { m } else { 0.5 * PI * m * m };
    if pairs > MOST_PAIRS {
        return Err(Unusable::TooLarge { m, pairs });
    }
    let constant = match D {
        1 => 1.0 / (m * m * kernel.moment(1)),
        _ => 8.0 / (3.0 * PI * m * m * m * kernel.moment(2)),
    };
    let weigh = |neighbour: Neighbour<D>| {
        let distance = neighbour.distance();
        let weight = constant * kernel.weight(distance / m) * neighbour.fraction / distance;
        Bond { offset: neighbour.offset, weight }
    };
    Ok(half_family(m, volume_rule).into_iter().map(weigh).collect())
}

/// sin² 2θ = (1 − cos 4θ)/2 of a bond: 0 along the axes, 1 along the diagonals, both exactly.
fn diagonality<const D: usize>(offset: [i32; D]) -> f64 {
    match offset[..] {
        [i, j] => {
            let (x, y) = (f64::from(i).powi(2), f64::from(j).powi(2));
            4.0 * x * y / (x + y).powi(2)
        }
        _ => 0.0,
    }
}

/// What a unit of weight adds to (C₁₁, C₁₂), both over their intended values.
fn stiffness<const D: usize>(offset: [i32; D]) -> (f64, f64) {
    match offset[..] {
        [i, j] => {
            let (x, y) = (f64::from(i).powi(2), f64::from(j).powi(2));
            (x * x / (x + y), 3.0 * x * y / (x + y))
        }
        _ => (f64::from(offset[0]).powi(2), 0.0),
    }
}

fn moduli<const D: usize>(bonds: &[Bond<D>]) -> Moduli {
    let mut total = Moduli { c11: 0.0, c12: 0.0 };
    for bond in bonds {
        let (c11, c12) = stiffness(bond.offset);
        total.c11 += bond.weight * c11;
        total.c12 += bond.weight * c12;
    }
    total
}

/// A modulus below rounding of the intended one carries nothing of the kernel any more.
fn resolved<const D: usize>(lattice: Lattice, before: Moduli) -> Result<(), Unusable> {
    let lost = |modulus, kept| Err(Unusable::LostWeights { lattice, modulus, kept });
    if before.c11 < f64::EPSILON {
        return lost(if D == 1 { "E" } else { "C11" }, before.c11);
    }
    if D == 2 && before.c12 == 0.0 {
        return Err(Unusable::NoShear { lattice });
    }
    if D == 2 && before.c12 < f64::EPSILON {
        return lost("C66", before.c12);
    }
    Ok(())
}

/// α, β of (α + β cos 4θ) from C₁₁ = C₁₂ = 1, both over intended.
///
/// Solved for the factors α + β of bonds along the axes and α − β along the diagonals: their sums have positive
/// terms only, while α and β may be huge and opposite when a narrow kernel leaves the diagonals next to nothing.
fn calibrate<const D: usize>(bonds: &[Bond<D>], before: Moduli) -> Factors {
    if D == 1 {
        return Factors { axes: 1.0 / before.c11, diagonals: 1.0 / before.c11 };
    }
    let part = |share: fn(f64) -> f64| {
        let of = |bond: &Bond<D>| Bond { weight: bond.weight * share(diagonality(bond.offset)), ..*bond };
        moduli(&bonds.iter().map(of).collect::<Vec<_>>())
    };
    let (axes, diagonals) = (part(|q| 1.0 - q), part(|q| q));
    let determinant = axes.c11 * diagonals.c12 - axes.c12 * diagonals.c11;
    Factors {
        axes: (diagonals.c12 - diagonals.c11) / determinant,
        diagonals: (axes.c11 - axes.c12) / determinant,
    }
}

/// The factor of a bond goes from `axes` to `diagonals` with sin² 2θ.
#[derive(Debug, Clone, Copy)]
struct Factors {
    axes: f64,
    diagonals: f64,
}

impl Factors {
    fn scale<const D: usize>(self, bond: &Bond<D>) -> Bond<D> {
        let q = diagonality(bond.offset);
        Bond { weight: bond.weight * (self.axes * (1.0 - q) + self.diagonals * q), ..*bond }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    fn lattice(kernel: Kernel, m: f64, volume_rule: VolumeRule, calibrated: bool) -> Lattice {
        Lattice { kernel, m, volume_rule, calibrated }
    }

    #[test]
    fn calibration_returns_the_intended_moduli() {
        for m in [1.5, 2.0, 3.0, 3.015, 5.0, 7.3] {
            for volume_rule in VolumeRule::ALL {
                for kernel in [Kernel::Constant, Kernel::Gaussian { p: 3.0 }, Kernel::Conical] {
                    let plane = Stencil::<2>::new(lattice(kernel, m, volume_rule, true)).unwrap();
                    assert_abs_diff_eq!(plane.after.c11, 1.0, epsilon = 1e-13);
                    assert_abs_diff_eq!(plane.after.c12, 1.0, epsilon = 1e-13);
                    let bar = Stencil::<1>::new(lattice(kernel, m, volume_rule, true)).unwrap();
                    assert_abs_diff_eq!(bar.after.c11, 1.0, epsilon = 1e-14);
                }
            }
        }
    }

    #[test]
    fn unusable_lattices_are_refused_by_name() {
        let refused = |kernel, m, rule| Stencil::<2>::new(lattice(kernel, m, rule, true)).unwrap_err();
        assert!(matches!(
            refused(Kernel::Constant, 0.99, VolumeRule::Full),
            Unusable::HorizonBelowSpacing { .. }
        ));
        assert!(matches!(refused(Kernel::Constant, 1.0, VolumeRule::Full), Unusable::NoShear { .. }));
        assert!(matches!(
            refused(Kernel::Constant, f64::NAN, VolumeRule::Full),
            Unusable::HorizonBelowSpacing { .. }
        ));
        let narrow = Kernel::Gaussian { p: 30.0 };
        assert!(matches!(refused(narrow, 3.0, VolumeRule::Linear), Unusable::LostWeights { .. }));
        assert!(Stencil::<1>::new(lattice(narrow, 3.0, VolumeRule::Linear, false)).is_err());
        assert!(Stencil::<1>::new(lattice(Kernel::Constant, 1.0, VolumeRule::Full, false)).is_ok());
    }
}
