//! What the body is made of, and the state it is in: bar, plane stress or plane strain.
//!
//! The bond-based law has one constant, so Poisson's ratio is not free: 1/3 in plane stress, 1/4 in plane
//! strain (Silling 2000, J. Mech. Phys. Solids 48, 175, reduced to the plane).

/// Young's modulus and density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// E in Pa.
    pub youngs_modulus: f64,
    /// ρ in kg/m³.
    pub density: f64,
}

/// The state of the body; thickness and area scale forces, not waves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Body {
    /// One dimension, uniaxial stress.
    Bar,
    /// Two dimensions, a thin plate.
    PlaneStress,
    /// Two dimensions, a slice of a thick body.
    PlaneStrain,
}

impl Body {
    /// All three.
    pub const ALL: [Self; 3] = [Self::Bar, Self::PlaneStress, Self::PlaneStrain];

    /// The word used in study files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bar => "bar",
            Self::PlaneStress => "plane_stress",
            Self::PlaneStrain => "plane_strain",
        }
    }

    /// 1 or 2.
    pub fn dimension(self) -> usize {
        match self {
            Self::Bar => 1,
            Self::PlaneStress | Self::PlaneStrain => 2,
        }
    }

    /// The Poisson ratio that the bond-based law imposes; `None` for a bar, which has none.
    pub fn poisson_ratio(self) -> Option<f64> {
        match self {
            Self::Bar => None,
            Self::PlaneStress => Some(1.0 / 3.0),
            Self::PlaneStrain => Some(0.25),
        }
    }

    /// C₁₁/E, the stiffness that carries a dilatational wave: 1, 9/8, 6/5.
    pub fn stiffness_over_youngs_modulus(self) -> f64 {
        match self {
            Self::Bar => 1.0,
            Self::PlaneStress => 9.0 / 8.0,
            Self::PlaneStrain => 6.0 / 5.0,
        }
    }
}

impl Material {
    /// Speed of dilatational waves in m/s: √(E/ρ) in a bar, √(C₁₁/ρ) in the plane.
    pub fn dilatational_speed(self, body: Body) -> f64 {
        (body.stiffness_over_youngs_modulus() * self.youngs_modulus / self.density).sqrt()
    }

    /// Speed of shear waves in m/s, `None` in a bar. C₁₂ = C₆₆ = C₁₁/3 in both plane states.
    pub fn shear_speed(self, body: Body) -> Option<f64> {
        (body != Body::Bar).then(|| self.dilatational_speed(body) / 3.0_f64.sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn speeds_are_those_of_the_classical_body_with_the_imposed_poisson_ratio() {
        let steel = Material { youngs_modulus: 210e9, density: 8000.0 };
        let (e, rho) = (steel.youngs_modulus, steel.density);
        let nu = Body::PlaneStress.poisson_ratio().unwrap();
        assert_relative_eq!(
            steel.dilatational_speed(Body::PlaneStress),
            (e / (rho * (1.0 - nu * nu))).sqrt(),
            max_relative = 1e-15
        );
        assert_relative_eq!(
            steel.shear_speed(Body::PlaneStress).unwrap(),
            (e / (2.0 * rho * (1.0 + nu))).sqrt(),
            max_relative = 1e-15
        );
        let nu = Body::PlaneStrain.poisson_ratio().unwrap();
        let stiffness = e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
        assert_relative_eq!(
            steel.dilatational_speed(Body::PlaneStrain),
            (stiffness / rho).sqrt(),
            max_relative = 1e-15
        );
        assert_relative_eq!(
            steel.shear_speed(Body::PlaneStrain).unwrap(),
            (e / (2.0 * rho * (1.0 + nu))).sqrt(),
            max_relative = 1e-15
        );
        assert!(steel.shear_speed(Body::Bar).is_none());
    }
}
