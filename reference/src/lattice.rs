//! What the discrete model does to waves and stiffness: plane waves, moduli, families and time steps of a lattice.
//!
//! With the bond weights w_r of the family (dimensionless, offsets r in spacings, κ = kΔx, n = r/|r|):
//! bar (ωΔx/v)² = Σ w_r (1 − cos κr); plane (ωΔx/c_d)² = eigenvalue of Σ w_r n⊗n (1 − cos κk̂·r).
//! Long waves: bar modulus over E = ½ Σ w_r r²; C11 = ½ Σ w_r |r|² cos⁴θ, C12 and C66 = 3·½ Σ w_r |r|² cos²θ sin²θ over
//! the intended values (the intended C12 = C66 = C11/3). Plain sums in double-double, rounded at the end.

use crate::Wave;
use crate::bonds::{self, BarBond, PlaneBond};
pub use crate::bonds::{Lattice, VolumeRule};
use crate::double_double::Dd;
use crate::kernel::Kernel;

/// Lattice moduli over the intended ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moduli {
    /// Along an axis.
    pub c11: f64,
    /// Coupling of the axes.
    pub c12: f64,
    /// Shear; equal to `c12` in a lattice of central forces, summed on its own.
    pub c66: f64,
}

/// At k = 0 the limits of the slopes are taken from a wave this long, 1e20 times longer than matters.
const LONG: f64 = 1e-10;

/// The wave in a bar: ωΔx/v and group speed over v, both to 1e-15.
pub fn bar(lattice: Lattice, k_dx: f64) -> Wave {
    if k_dx == 0.0 {
        return Wave { omega: 0.0, ..bar(lattice, LONG) };
    }
    let (mut square, mut derivative) = (Dd::ZERO, Dd::ZERO);
    for bond in bar_bonds(&lattice) {
        let (sine, cosine) = (Dd::from(k_dx) * bond.offset * 0.5).sin_cos();
        square = square + bond.weight * sine.squared() * 4.0;
        derivative = derivative + bond.weight * sine * cosine * (4.0 * bond.offset);
    }
    let omega = square.sqrt();
    Wave { omega: omega.to_f64(), slope: (derivative / (omega * 2.0)).to_f64() }
}

/// The two plane waves that travel at `angle_rad` to the x axis: P, the one whose displacement is nearer to
/// the direction of travel (at a tie the faster), and S. Each ωΔx/c and radial derivative dω/dk over c, c the
/// classical speed of its own branch; both to 1e-14. Not numbers where the calibration is singular and where a
/// calibrated lattice is unstable (ω² < 0).
pub fn plane(lattice: Lattice, k_dx: f64, angle_rad: f64) -> [Wave; 2] {
    if k_dx == 0.0 {
        return plane(lattice, LONG, angle_rad).map(|wave| Wave { omega: 0.0, ..wave });
    }
    let (sine, cosine) = Dd::from(angle_rad).sin_cos();
    let (mut matrix, mut derivative) = (Symmetric::default(), Symmetric::default());
    for (bond, weight) in plane_bonds(&lattice) {
        let along = cosine * bond.x + sine * bond.y;
        let (half_sine, half_cosine) = (along * k_dx * 0.5).sin_cos();
        matrix.add(&bond, weight * half_sine.squared() * 2.0);
        derivative.add(&bond, weight * half_sine * half_cosine * along * 2.0);
    }
    matrix.branches([cosine, sine]).map(|(square, vector, speed)| {
        let omega = square.sqrt();
        let slope = derivative.along(vector) / (omega * 2.0);
        Wave { omega: (omega * speed).to_f64(), slope: (slope * speed).to_f64() }
    })
}

/// Σ w n⊗n.
#[derive(Clone, Copy, Default)]
pub(crate) struct Symmetric {
    pub(crate) xx: Dd,
    pub(crate) xy: Dd,
    pub(crate) yy: Dd,
}

impl Symmetric {
    fn add(&mut self, bond: &PlaneBond, weight: Dd) {
        self.xx = self.xx + weight * bond.cosine_squared();
        self.yy = self.yy + weight * bond.sine_squared();
        let square = bond.x * bond.x + bond.y * bond.y;
        self.xy = self.xy + weight * (bond.x * bond.y) / Dd::from(square);
    }

    /// e·D·e.
    pub(crate) fn along(&self, e: [Dd; 2]) -> Dd {
        self.xx * e[0].squared() + self.xy * e[0] * e[1] * 2.0 + self.yy * e[1].squared()
    }

    /// (eigenvalue, eigenvector, c_d over the branch's speed) of P and S for a wave along `k`.
    pub(crate) fn branches(&self, k: [Dd; 2]) -> [(Dd, [Dd; 2], Dd); 2] {
        let (middle, half) = ((self.xx + self.yy) * 0.5, (self.xx - self.yy) * 0.5);
        let radius = (half.squared() + self.xy.squared()).sqrt();
        let upper = if radius.hi == 0.0 {
            k
        } else if half.hi >= 0.0 {
            unit([half + radius, self.xy])
        } else {
            unit([self.xy, radius - half])
        };
        let lower = [-upper[1], upper[0]];
        let share = |e: [Dd; 2]| (e[0] * k[0] + e[1] * k[1]).abs();
        let tie = Dd::from(1e-24);
        let (root_3, fast, slow) = (Dd::from(3.0).sqrt(), middle + radius, middle - radius);
        if share(upper) + tie >= share(lower) {
            [(fast, upper, Dd::ONE), (slow, lower, root_3)]
        } else {
            [(slow, lower, Dd::ONE), (fast, upper, root_3)]
        }
    }
}

/// The vector scaled to length 1.
fn unit(vector: [Dd; 2]) -> [Dd; 2] {
    let length = (vector[0].squared() + vector[1].squared()).sqrt();
    vector.map(|component| component / length)
}

/// The bonds of the plane with their weights, calibrated where the lattice says so.
pub(crate) fn plane_bonds(lattice: &Lattice) -> Vec<(PlaneBond, Dd)> {
    let bonds = bonds::plane(lattice);
    let none = (Dd::from(f64::NAN), Dd::ZERO);
    let (alpha, beta) =
        if lattice.calibrated { calibration_of(&bonds).unwrap_or(none) } else { (Dd::ONE, Dd::ZERO) };
    bonds
        .into_iter()
        .map(|bond| {
            let weight = bond.weight * (alpha + beta * bond.cosine_of_four());
            (bond, weight)
        })
        .collect()
}

/// The bonds of the bar with their weights, calibrated where the lattice says so.
pub(crate) fn bar_bonds(lattice: &Lattice) -> Vec<BarBond> {
    let bonds = bonds::bar(lattice);
    let factor = if lattice.calibrated { Dd::ONE / bar_modulus_of(&bonds) } else { Dd::ONE };
    bonds.into_iter().map(|bond| BarBond { weight: bond.weight * factor, ..bond }).collect()
}

/// ½ Σ w r² over both sides.
fn bar_modulus_of(bonds: &[BarBond]) -> Dd {
    bonds.iter().map(|bond| bond.weight * (bond.offset * bond.offset)).sum()
}

/// Long-wave modulus of the bar over E.
pub fn bar_modulus(lattice: Lattice) -> f64 {
    bar_modulus_of(&bar_bonds(&lattice)).to_f64()
}

/// Long-wave moduli of the plane over the intended ones.
pub fn plane_moduli(lattice: Lattice) -> Moduli {
    let (mut c11, mut c12, mut c66) = (Dd::ZERO, Dd::ZERO, Dd::ZERO);
    for (bond, weight) in plane_bonds(&lattice) {
        let stiffness = weight * bond.length.squared() * 0.5;
        let (cosine, sine) = (Dd::from(bond.x) / bond.length, Dd::from(bond.y) / bond.length);
        c11 = c11 + stiffness * cosine.squared().squared();
        c12 = c12 + stiffness * 3.0 * bond.cosine_squared() * bond.sine_squared();
        c66 = c66 + stiffness * 3.0 * (cosine * sine).squared();
    }
    Moduli { c11: c11.to_f64(), c12: c12.to_f64(), c66: c66.to_f64() }
}

/// α and β of the factor α + β cos 4θ, θ the bond's direction, that makes the plane's C11 and C12 exact; None
/// where the 2×2 system is singular (`Full` with m < √2: the four axis bonds alone).
pub fn calibration(lattice: Lattice) -> Option<(f64, f64)> {
    calibration_of(&bonds::plane(&lattice)).map(|(alpha, beta)| (alpha.to_f64(), beta.to_f64()))
}

/// α A + β A' = 1 and α B + β B' = 1, A and B the lattice's C11 and C12, A' and B' the same sums with cos 4θ.
fn calibration_of(bonds: &[PlaneBond]) -> Option<(Dd, Dd)> {
    let sum = |term: &dyn Fn(&PlaneBond) -> Dd| -> Dd {
        bonds.iter().map(|bond| bond.weight * bond.length.squared() * 0.5 * term(bond)).sum()
    };
    let c11 = |bond: &PlaneBond| bond.cosine_squared().squared();
    let c12 = |bond: &PlaneBond| bond.cosine_squared() * bond.sine_squared() * 3.0;
    let (a, b) = (sum(&c11), sum(&c12));
    let a_four = sum(&|bond| c11(bond) * bond.cosine_of_four());
    let b_four = sum(&|bond| c12(bond) * bond.cosine_of_four());
    let determinant = a * b_four - a_four * b;
    let size = (a * b_four).abs() + (a_four * b).abs() + a.squared() * 1e-200;
    if determinant.abs() <= size * 1e-20 {
        return None;
    }
    Some(((b_four - a_four) / determinant, (a - b) / determinant))
}

/// Number of nodes in a bar's family.
pub fn neighbours_bar(m: f64, rule: VolumeRule) -> usize {
    2 * bonds::bar(&plain(m, rule)).len()
}

/// Number of nodes in a family of the plane.
pub fn neighbours_plane(m: f64, rule: VolumeRule) -> usize {
    bonds::plane(&plain(m, rule)).len()
}

fn plain(m: f64, rule: VolumeRule) -> Lattice {
    Lattice { kernel: Kernel::Constant, m, rule, calibrated: false }
}

/// Largest ωΔx/v of a bar, to 1e-10 or better.
pub fn bar_highest(lattice: Lattice) -> f64 {
    crate::band_edge::bar(lattice)
}

/// Largest ωΔx/c_d of the plane over the Brillouin zone, both branches, to 1e-10 or better.
pub fn plane_highest(lattice: Lattice) -> f64 {
    crate::band_edge::plane(lattice)
}

/// The usual bound on the time step of a bar, v Δt/Δx with Δt = √(2ρ/Σ cV/|ξ|).
pub fn bar_row_sum(lattice: Lattice) -> f64 {
    let sum: Dd = bar_bonds(&lattice).iter().map(|bond| bond.weight * 2.0).sum();
    (Dd::from(2.0) / sum).sqrt().to_f64()
}

/// The same in the plane, c_d Δt/Δx.
pub fn plane_row_sum(lattice: Lattice) -> f64 {
    let sum: Dd = plane_bonds(&lattice).into_iter().map(|(_, weight)| weight).sum();
    (Dd::from(2.0) / sum).sqrt().to_f64()
}
