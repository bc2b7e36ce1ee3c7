//! A plate bent in its plane to an even curvature: a displacement that every square lattice answers exactly.
//!
//! u_x = −κxy, u_y = κx²/2 + ν'κy²/2. With the moduli C11, C12, C66 of a square lattice the stress is
//! σ_xx = κy(ν'C12 − C11), σ_yy = κy(ν'C11 − C12), σ_xy = 0, and the force per volume f_x = 0,
//! f_y = C66 u_y,xx + C11 u_y,yy + (C12 + C66) u_x,xy = κ(ν'C11 − C12). With ν' = C12/C11 nothing is left: pure bending by
//! the moment −∫σ_xx y dy per thickness, E' = C11 − C12²/C11. Third derivatives vanish, so a lattice (and the nonlocal
//! continuum) feels exactly the force of its long-wave moduli at every node whose family is full.

use crate::lattice::Moduli;

/// The bent plate. Lengths in any one unit, κ and forces per C11 in its inverse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BentPlate {
    /// κ of the plate's axis y = 0.
    pub curvature: f64,
    /// ν', how much the plate swells across it per strain along it.
    pub swelling: f64,
}

impl BentPlate {
    /// Bent without body force in a body of the intended moduli: ν' = 1/3.
    pub fn intended(curvature: f64) -> Self {
        Self { curvature, swelling: 1.0 / 3.0 }
    }

    /// Bent without body force in a body of other moduli, each over its intended value: ν' = C12/C11.
    pub fn of(curvature: f64, moduli: Moduli) -> Self {
        Self { curvature, swelling: moduli.c12 / (3.0 * moduli.c11) }
    }

    /// (u_x, u_y).
    pub fn displacement(&self, x: f64, y: f64) -> [f64; 2] {
        let square = x * x + self.swelling * y * y;
        [-self.curvature * x * y, 0.5 * self.curvature * square]
    }

    /// (σ_xx, σ_yy) over the intended C11 where a body with these moduli is full; σ_xy = 0.
    pub fn stress(&self, moduli: Moduli, y: f64) -> [f64; 2] {
        let c12 = moduli.c12 / 3.0;
        let strain = self.curvature * y;
        [strain * (self.swelling * c12 - moduli.c11), strain * (self.swelling * moduli.c11 - c12)]
    }

    /// f_y over the intended C11, the force per volume that a body with these moduli feels where its family is full;
    /// f_x = 0.
    pub fn residual(&self, moduli: Moduli) -> f64 {
        self.curvature * (self.swelling * moduli.c11 - moduli.c12 / 3.0)
    }
}

/// The moduli intended.
pub const INTENDED: Moduli = Moduli { c11: 1.0, c12: 1.0, c66: 1.0 };
