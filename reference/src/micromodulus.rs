//! The stiffness constant c₀ that gives a body of bonds the strain energy of an elastic body.
//!
//! Energy density of the bonds under a uniform strain, bond stretch s = n·ε·n:
//! w = ½ ∫ ½ c₀W(ξ/δ) s² ξ dV'. Set equal to ½ E ε² in a bar and ½ C11 ε² in a plane strained along x alone
//! (s = ε cos²θ), with C11 = E/(1 − ν²) = 9E/8 in plane stress (ν = 1/3) and
//! C11 = E(1 − ν)/((1 + ν)(1 − 2ν)) = 6E/5 in plane strain (ν = 1/4).
//! Source: Silling and Askari (2005); Gerstle, Sau and Silling, SMiRT 18 (2005). Integrals by quadrature, no closed form.

use crate::double_double::{Dd, PI};
use crate::kernel::Kernel;
use crate::quadrature;

/// c₀ of a bar of the given cross-section, in N/m⁶ for SI arguments.
pub fn bar(kernel: Kernel, youngs_modulus: f64, area: f64, horizon: f64) -> f64 {
    let horizon = Dd::from(horizon);
    let energy = radial(kernel, horizon, |_| Dd::from(2.0) * area);
    (Dd::from(youngs_modulus) * 0.5 / energy).to_f64()
}

/// c₀ of a plate in plane stress, ν = 1/3.
pub fn plane_stress(kernel: Kernel, youngs_modulus: f64, thickness: f64, horizon: f64) -> f64 {
    plane(kernel, Dd::from(youngs_modulus) * 9.0 / Dd::from(8.0), thickness, horizon)
}

/// c₀ of a slice of the given thickness in plane strain, ν = 1/4.
pub fn plane_strain(kernel: Kernel, youngs_modulus: f64, thickness: f64, horizon: f64) -> f64 {
    plane(kernel, Dd::from(youngs_modulus) * 6.0 / Dd::from(5.0), thickness, horizon)
}

/// Sixteen directions integrate cos⁴θ over the turn exactly.
fn plane(kernel: Kernel, c11: Dd, thickness: f64, horizon: f64) -> f64 {
    let step = PI * 2.0 / Dd::from(16.0);
    let turn: Dd = (0..16).map(|j| (step * f64::from(j)).cos().squared().squared() * step).sum();
    let energy = radial(kernel, Dd::from(horizon), |distance| turn * thickness * distance);
    (c11 * 0.5 / energy).to_f64()
}

/// ½ ∫₀^δ ½ W(ξ/δ) ξ · measure(ξ) dξ: the energy for c₀ = 1 and a stretch of 1.
fn radial(kernel: Kernel, horizon: Dd, measure: impl Fn(Dd) -> Dd) -> Dd {
    quadrature::panels(kernel.panels(0.0))
        .map(|(s, weight)| {
            let distance = s * horizon;
            weight * horizon * kernel.weight(s) * distance * measure(distance) * 0.25
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: f64 = 200e9;

    fn assert_close(found: f64, expected: f64) {
        assert!((found / expected - 1.0).abs() < 4e-16, "{found:e} against {expected:e}");
    }

    #[test]
    fn constant_kernel_gives_the_published_constants() {
        let (horizon, size) = (3e-3, 0.7);
        let pi = std::f64::consts::PI;
        assert_close(bar(Kernel::Constant, STEEL, size, horizon), 2.0 * STEEL / (size * horizon * horizon));
        let cubed = horizon * horizon * horizon;
        assert_close(plane_stress(Kernel::Constant, STEEL, size, horizon), 9.0 * STEEL / (pi * size * cubed));
        assert_close(
            plane_strain(Kernel::Constant, STEEL, size, horizon),
            48.0 * STEEL / (5.0 * pi * size * cubed),
        );
    }

    // p²/(1 − e^(−p²)) and (4p³/3)/(√π erf p − 2p e^(−p²)) by mpmath at 60 digits.
    #[test]
    fn gaussian_factors() {
        for (p, in_bar, in_plane) in GAUSSIAN_FACTORS {
            let kernel = Kernel::Gaussian { p };
            assert_close(bar(kernel, STEEL, 1.0, 1.0), in_bar * bar(Kernel::Constant, STEEL, 1.0, 1.0));
            let constant = plane_stress(Kernel::Constant, STEEL, 1.0, 1.0);
            assert_close(plane_stress(kernel, STEEL, 1.0, 1.0), in_plane * constant);
        }
    }

    const GAUSSIAN_FACTORS: [(f64, f64, f64); 6] = [
        (1e-06, 1.0000000000005, 1.0000000000006),
        (0.5, 1.1302029160469496, 1.1593297229834014),
        (1.0, 1.5819767068693265, 1.7592716862709668),
        (2.0, 4.074629441455096, 6.3082768000390015),
        (3.0, 9.001110825323515, 20.319762648265833),
        (7.3, 53.29, 292.6391189639967),
    ];
}
