//! The elastic constants by which displacements are read, and the uniform stress on the faces of a crack.

use crate::material::{Body, Material};

/// Plane elasticity: 2µ(u + iv) = κφ − z φ'* − ψ* (Kolosov, Muskhelishvili).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// µ in Pa.
    pub shear_modulus: f64,
    /// κ, above 1: 3 − 4ν in plane strain, (3 − ν)/(1 + ν) in plane stress.
    pub kappa: f64,
    /// ρ in kg/m³.
    pub density: f64,
}

impl Elastic {
    /// From µ in Pa, κ and ρ in kg/m³.
    pub fn new(shear_modulus: f64, kappa: f64, density: f64) -> Self {
        Self { shear_modulus, kappa, density }
    }

    /// Of a bond-based plate: C₁₂ = C₆₆, so κ = 2 in both plane states. `None` for a bar.
    pub fn of(material: Material, body: Body) -> Option<Self> {
        let speed = material.shear_speed(body)?;
        Some(Self::new(material.density * speed * speed, 2.0, material.density))
    }

    /// E' = 8µ/(κ + 1) in Pa: E in plane stress, E/(1 − ν²) in plane strain.
    pub fn plane_modulus(&self) -> f64 {
        8.0 * self.shear_modulus / (self.kappa + 1.0)
    }

    /// λ of the plane, C₁₂, in Pa.
    pub fn lambda(&self) -> f64 {
        self.shear_modulus * (3.0 - self.kappa) / (self.kappa - 1.0)
    }

    /// c_d in m/s.
    pub fn dilatational_speed(&self) -> f64 {
        self.shear_speed() * ((self.kappa + 1.0) / (self.kappa - 1.0)).sqrt()
    }

    /// c_s in m/s.
    pub fn shear_speed(&self) -> f64 {
        (self.shear_modulus / self.density).sqrt()
    }

    /// [σ_xx, σ_yy, σ_xy] in Pa of a displacement gradient [[∂u_x/∂x, ∂u_x/∂y], [∂u_y/∂x, ∂u_y/∂y]].
    pub fn stress(&self, gradient: [[f64; 2]; 2]) -> [f64; 3] {
        let [[xx, xy], [yx, yy]] = gradient;
        let mean = self.lambda() * (xx + yy);
        [
            mean + 2.0 * self.shear_modulus * xx,
            mean + 2.0 * self.shear_modulus * yy,
            self.shear_modulus * (xy + yx),
        ]
    }
}

/// Uniform stress on both faces of the crack, in Pa: what a uniform load on the faces leaves there. Free faces by default.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Faces {
    /// σ_yy; −p under a pressure p.
    pub normal: f64,
    /// σ_xy.
    pub shear: f64,
}

impl Faces {
    /// Displacement in m at x of the uniform field of σ_yy, σ_xy (σ_xx = 0, no rotation), which the series of a free
    /// crack lacks.
    pub fn displacement(&self, elastic: &Elastic, x: [f64; 2]) -> [f64; 2] {
        let (mu, kappa) = (elastic.shear_modulus, elastic.kappa);
        let along = -(3.0 - kappa) / (8.0 * mu) * self.normal;
        let across = (kappa + 1.0) / (8.0 * mu) * self.normal;
        let slide = self.shear / (2.0 * mu);
        [along * x[0] + slide * x[1], slide * x[0] + across * x[1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn constants_of_a_bond_based_plate_are_those_of_its_poisson_ratio() {
        let steel = Material { youngs_modulus: 192e9, density: 8000.0 };
        let stress = Elastic::of(steel, Body::PlaneStress).unwrap();
        assert_relative_eq!(stress.shear_modulus, 72e9, max_relative = 1e-14);
        assert_relative_eq!(stress.plane_modulus(), 192e9, max_relative = 1e-14);
        let strain = Elastic::of(steel, Body::PlaneStrain).unwrap();
        assert_relative_eq!(strain.shear_modulus, 192e9 / 2.5, max_relative = 1e-14);
        assert_relative_eq!(strain.plane_modulus(), 192e9 / (1.0 - 0.0625), max_relative = 1e-14);
        for (elastic, body) in [(stress, Body::PlaneStress), (strain, Body::PlaneStrain)] {
            assert_relative_eq!(
                elastic.dilatational_speed(),
                steel.dilatational_speed(body),
                max_relative = 1e-14
            );
        }
        assert_eq!(Elastic::of(steel, Body::Bar), None);
    }

    #[test]
    fn the_uniform_field_has_the_stress_of_the_faces_and_none_along_the_crack() {
        let elastic = Elastic::new(3.0, 1.8, 1.0);
        let at = |x| Faces { normal: 5.0, shear: -2.0 }.displacement(&elastic, x);
        let ([a, b], [c, d]) = (at([1.0, 0.0]), at([0.0, 1.0]));
        let stress = elastic.stress([[a, c], [b, d]]);
        for (found, wanted) in stress.into_iter().zip([0.0, 5.0, -2.0]) {
            assert!((found - wanted).abs() < 1e-14, "{stress:?}");
        }
    }
}
