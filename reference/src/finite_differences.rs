//! Waves on the grid of second-order central differences, the usual rival of a lattice.
//!
//! Bar, κ = kΔx: ωΔx/v = 2 sin(κ/2), with leapfrog at C = vΔt/Δx (2/C) asin(C sin(κ/2)).
//! Plane, Navier's equations ρü = C11 u_xx + C66 u_yy + (C12 + C66) v_xy with C66 = C12 = C11/3: with S = 4 sin²(κ/2),
//! D11 = S_x + S_y/3, D22 = S_y + S_x/3, D12 = (2/3) sin κ_x sin κ_y, the mixed derivative from the four diagonal
//! neighbours over 4ΔxΔy. Source: Wildman and Gazonas, Int. J. Fract. 190 (2014) 39, with the factor ¼ restored.

use crate::Wave;
use crate::double_double::Dd;
use crate::lattice::Symmetric;

/// The wave in a bar, ωΔx/v; exact in time without a Courant number vΔt/Δx. None where the march is unstable
/// at this wave number.
pub fn bar(k_dx: f64, courant: Option<f64>) -> Option<Wave> {
    let (sine, cosine) = (Dd::from(k_dx) * 0.5).sin_cos();
    let courant = courant.unwrap_or(0.0);
    if courant == 0.0 {
        return Some(Wave { omega: (sine * 2.0).to_f64(), slope: cosine.to_f64() });
    }
    let half = sine * courant;
    if !(courant > 0.0 && half.abs() <= Dd::ONE) {
        return None;
    }
    let omega = half.asin() * 2.0 / Dd::from(courant);
    let room = (Dd::ONE - Dd::from(courant)) * (Dd::ONE + Dd::from(courant));
    let slope = cosine / (cosine.squared() + room * sine.squared()).sqrt();
    Some(Wave { omega: omega.to_f64(), slope: slope.to_f64() })
}

/// The two plane waves [P, S] at `angle_rad` to the x axis, each ωΔx/c and radial slope over its own speed c;
/// `courant` = c_d Δt/Δx. None where the march is unstable for that wave.
pub fn plane(k_dx: f64, angle_rad: f64, courant: Option<f64>) -> [Option<Wave>; 2] {
    if k_dx == 0.0 {
        let still = |wave: Wave| Wave { omega: 0.0, ..wave };
        return plane(1e-10, angle_rad, courant).map(|wave| wave.map(still));
    }
    let (sine, cosine) = Dd::from(angle_rad).sin_cos();
    let (matrix, derivative) = matrices(cosine * k_dx, sine * k_dx, [cosine, sine]);
    matrix.branches([cosine, sine]).map(|(square, vector, speed)| {
        let omega = square.sqrt();
        let slope = derivative.along(vector) / (omega * 2.0);
        let Some(courant) = courant else {
            return Some(Wave { omega: (omega * speed).to_f64(), slope: (slope * speed).to_f64() });
        };
        let half = omega * courant * 0.5;
        if !(courant > 0.0 && half <= Dd::ONE) {
            return None;
        }
        let marched = half.asin() * 2.0 / Dd::from(courant);
        let marched_slope = slope / ((Dd::ONE - half) * (Dd::ONE + half)).sqrt();
        Some(Wave { omega: (marched * speed).to_f64(), slope: (marched_slope * speed).to_f64() })
    })
}

/// D over (c_d/Δx)² and its derivative along the direction of travel.
fn matrices(x: Dd, y: Dd, direction: [Dd; 2]) -> (Symmetric, Symmetric) {
    let third = Dd::ONE / Dd::from(3.0);
    let ((half_sin_x, _), (half_sin_y, _)) = ((x * 0.5).sin_cos(), (y * 0.5).sin_cos());
    let ((sin_x, cos_x), (sin_y, cos_y)) = (x.sin_cos(), y.sin_cos());
    let (square_x, square_y) = (half_sin_x.squared() * 4.0, half_sin_y.squared() * 4.0);
    let (slope_x, slope_y) = (sin_x * direction[0] * 2.0, sin_y * direction[1] * 2.0);
    let cross_slope = cos_x * sin_y * direction[0] + sin_x * cos_y * direction[1];
    let matrix = Symmetric {
        xx: square_x + square_y * third,
        xy: sin_x * sin_y * third * 2.0,
        yy: square_y + square_x * third,
    };
    let derivative = Symmetric {
        xx: slope_x + slope_y * third,
        xy: cross_slope * third * 2.0,
        yy: slope_y + slope_x * third,
    };
    (matrix, derivative)
}
