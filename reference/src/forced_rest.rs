//! Rest under a wave of body force: the displacement that a force holds, and the force that holds a displacement.
//!
//! ρü = −C11 M(k) u + b = 0 for u = a cos(k·x + φ): b = C11 M(k) a cos(k·x + φ), force per volume, C11 = ρc² (in a bar E).
//! Whatever field is a sum of waves is held by the sum of their forces, in any medium ([`Medium::plane_matrix`]).
//! On an edge local elasticity also asks for the traction t = σn, with σ_xx = C11 (u_x,x + u_y,y/3), σ_yy likewise,
//! σ_xy = C11 (u_x,y + u_y,x)/3.

use crate::medium::Medium;

/// b/C11, in the unit of `a` over length², that holds u = `a` cos(k·x + φ). None where the medium has no answer.
pub fn force_amplitude(medium: &Medium, k: [f64; 2], a: [f64; 2]) -> Option<[f64; 2]> {
    let [xx, xy, yy] = medium.plane_matrix(k)?;
    Some([xx * a[0] + xy * a[1], xy * a[0] + yy * a[1]])
}

/// The a of u = a cos(k·x + φ) that `b` = force per volume over C11 holds. None where the medium has no answer and where
/// it does not resist: at k = 0, and for the waves of zero energy of a lattice (an eigenvalue of M below 1e-12 of the
/// other).
pub fn displacement_amplitude(medium: &Medium, k: [f64; 2], b: [f64; 2]) -> Option<[f64; 2]> {
    let waves = medium.plane_waves(k)?;
    let least = 1e-6 * waves.iter().map(|(omega, _)| *omega).fold(0.0, f64::max);
    let resists = waves.iter().all(|(omega, _)| *omega > least);
    let along = |part: usize| {
        waves.iter().map(|(omega, e)| (e[0] * b[0] + e[1] * b[1]) / (omega * omega) * e[part]).sum()
    };
    resists.then(|| [along(0), along(1)])
}

/// b/E that holds u = `a` cos(kx + φ) in a bar. None where the medium has no answer.
pub fn bar_force_amplitude(medium: &Medium, k: f64, a: f64) -> Option<f64> {
    Some(medium.bar_square(k)? * a)
}

/// The a of u = a cos(kx + φ) that `b` = force per volume over E holds in a bar. None where the medium has no answer or
/// does not resist.
pub fn bar_displacement_amplitude(medium: &Medium, k: f64, b: f64) -> Option<f64> {
    let square = medium.bar_square(k)?;
    (square > 0.0).then_some(b / square)
}

/// T of the traction t = C11 T sin(k·x + φ) that local elasticity with C12 = C66 = C11/3 asks for on an edge with this
/// outward unit `normal`, for u = `a` cos(k·x + φ). In the unit of `a` over length.
pub fn traction_amplitude(k: [f64; 2], a: [f64; 2], normal: [f64; 2]) -> [f64; 2] {
    let xx = a[0] * k[0] + a[1] * k[1] / 3.0;
    let yy = a[0] * k[0] / 3.0 + a[1] * k[1];
    let xy = (a[0] * k[1] + a[1] * k[0]) / 3.0;
    [-(xx * normal[0] + xy * normal[1]), -(xy * normal[0] + yy * normal[1])]
}

/// T of the stress σ = E T sin(kx + φ) in a bar with u = `a` cos(kx + φ).
pub fn bar_stress_amplitude(k: f64, a: f64) -> f64 {
    -k * a
}
