//! The micromodulus constant c₀ that gives the nonlocal continuum the elastic energy of the classical one.
//!
//! A homogeneous strain must store the same energy: C₁₁ = ½ ∫ c(ξ) |ξ| cos⁴θ dV (cos θ = ±1 in a bar), so
//! with c = c₀ W(|ξ|/δ) and Mₙ = ∫₀¹ sⁿ W ds
//!
//! | body | c₀ | constant kernel |
//! |---|---|---|
//! | bar, area A | E / (A δ² M₁) | 2E/(Aδ²) |
//! | plane, thickness h | 8 C₁₁ / (3π h δ³ M₂) | 9E/(πhδ³) plane stress, 48E/(5πhδ³) plane strain |
//!
//! Silling & Askari 2005 (Comput. Struct. 83, 1526) for the constant kernel.

use crate::kernel::Kernel;
use crate::material::Body;
use std::f64::consts::PI;

/// c₀ in N/m⁶ for a body of cross-section `section`: the area in m² of a bar, the thickness in m of a plate.
pub fn constant(body: Body, kernel: Kernel, youngs_modulus: f64, section: f64, horizon: f64) -> f64 {
    let stiffness = youngs_modulus * body.stiffness_over_youngs_modulus();
    match body {
        Body::Bar => stiffness / (section * horizon.powi(2) * kernel.moment(1)),
        Body::PlaneStress | Body::PlaneStrain => {
            8.0 * stiffness / (3.0 * PI * section * horizon.powi(3) * kernel.moment(2))
        }
    }
}

/// c(ξ) over the micromodulus constant of the constant kernel: how the kernel moves stiffness inwards.
pub fn normalised(body: Body, kernel: Kernel, s: f64) -> f64 {
    let n = body.dimension() as u32;
    if s > 1.0 { 0.0 } else { kernel.weight(s) * Kernel::Constant.moment(n) / kernel.moment(n) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn constant_kernel_has_the_published_constants() {
        let (e, h, delta) = (72e9, 0.003, 0.0045);
        let of = |body| constant(body, Kernel::Constant, e, h, delta);
        assert_relative_eq!(of(Body::Bar), 2.0 * e / (h * delta * delta), max_relative = 1e-15);
        assert_relative_eq!(of(Body::PlaneStress), 9.0 * e / (PI * h * delta.powi(3)), max_relative = 1e-15);
        assert_relative_eq!(
            of(Body::PlaneStrain),
            48.0 * e / (5.0 * PI * h * delta.powi(3)),
            max_relative = 1e-15
        );
    }

    #[test]
    fn gaussian_factor_is_the_published_one() {
        for p in [0.7, 1.0, 2.0, 3.0] {
            let g = normalised(Body::Bar, Kernel::Gaussian { p }, 0.0);
            assert_relative_eq!(g, p * p / (1.0 - (-p * p).exp()), max_relative = 1e-14);
            let g = normalised(Body::PlaneStress, Kernel::Gaussian { p }, 0.0);
            let printed = 4.0 * p.powi(3) / 3.0 / (PI.sqrt() * libm::erf(p) - 2.0 * p * (-p * p).exp());
            assert_relative_eq!(g, printed, max_relative = 1e-13);
        }
    }
}
