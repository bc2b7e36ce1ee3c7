//! What marching in time does to the frequency of a wave.
//!
//! Central differences in time turn ü = −ω²u into sin(ω'Δt/2) = ω Δt/2, so with C = cΔt/Δx and ω in c/Δx
//! ω' = (2/C) asin(Cω/2), dω'/dk = (dω/dk)/√(1 − (Cω/2)²). Stable while Cω/2 ≤ 1 (von Neumann).

use crate::Wave;
use crate::double_double::Dd;

/// The wave of the march that belongs to a wave exact in time, its ω in units of c/Δx; `courant` = cΔt/Δx. None
/// where it grows (Cω/2 > 1); the slope is infinite or not a number at Cω/2 = 1 itself.
pub fn wave(space: Wave, courant: f64) -> Option<Wave> {
    let half = Dd::from(space.omega) * courant * 0.5;
    if !(courant > 0.0 && half <= Dd::ONE) {
        return None;
    }
    let omega = half.asin() * 2.0 / Dd::from(courant);
    let cosine = ((Dd::ONE - half) * (Dd::ONE + half)).sqrt();
    Some(Wave { omega: omega.to_f64(), slope: space.slope / cosine.to_f64() })
}
