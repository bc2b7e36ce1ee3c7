//! The largest stable time step of leapfrog on a lattice: Δt = 2/ω_max, the largest frequency over the zone.
//!
//! Von Neumann's limit is sharp for the infinite lattice. The usual bound √(2ρ/Σ cV/|ξ|), Silling & Askari 2005
//! (Comput. Struct. 83, 1526), comes from row sums: safe for positive weights, and smaller.

use super::bar::BarDispersion;
use super::plane::PlaneDispersion;
use crate::lattice::Stencil;
use std::f64::consts::PI;

/// Limits on the time step, both as cΔt/Δx with c the dilatational speed.
#[derive(Debug, Clone, PartialEq)]
pub struct TimeStep {
    /// 2/ω_max.
    pub sharp: f64,
    /// √(2ρ/Σw).
    pub row_sum: f64,
    /// kΔx of the wave that grows first.
    pub at: Vec<f64>,
}

/// Samples per period of the shortest harmonic: enough to find the basin of the largest maximum.
const SAMPLES_PER_HARMONIC: usize = 8;

/// The limits in a bar.
pub fn bar(stencil: &Stencil<1>) -> TimeStep {
    let relation = BarDispersion::new(stencil);
    let intervals = SAMPLES_PER_HARMONIC * stencil.reach();
    let sample = |n: usize| PI * n as f64 / intervals as f64;
    let best =
        (0..=intervals).max_by(|&a, &b| relation.square(sample(a)).total_cmp(&relation.square(sample(b))));
    let start = sample(best.unwrap_or(intervals));
    let (square, at) = climb(|[theta, _]| relation.square(theta), [start, 0.0], [PI / intervals as f64, 0.0]);
    limits(square, stencil.row_sum(), vec![at[0].min(PI)])
}

/// The limits in a plate; the square lattice lets 0 ≤ k_y ≤ k_x ≤ π/Δx stand for the zone.
pub fn plane(stencil: &Stencil<2>) -> TimeStep {
    let relation = PlaneDispersion::new(stencil);
    let largest = |theta: [f64; 2]| relation.matrix(theta).eigen().0[0];
    let intervals = SAMPLES_PER_HARMONIC * stencil.reach().max(2);
    let spacing = PI / intervals as f64;
    let grid = (0..=intervals).flat_map(|i| (0..=i).map(move |j| [i, j]));
    let mut samples: Vec<_> =
        grid.map(|at| at.map(|n| n as f64 * spacing)).map(|theta| (largest(theta), theta)).collect();
    samples.sort_by(|a, b| b.0.total_cmp(&a.0));
    let starts = samples.into_iter().take(STARTS);
    let (square, at) = starts
        .map(|(_, theta)| climb(largest, theta, [spacing; 2]))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .expect("the grid is not empty");
    limits(square, stencil.row_sum(), at.to_vec())
}

/// Samples from which the climb starts: neighbouring ridges may be close in height.
const STARTS: usize = 6;

fn limits(square: f64, row_sum: f64, at: Vec<f64>) -> TimeStep {
    TimeStep { sharp: 2.0 / square.sqrt(), row_sum: (2.0 / row_sum).sqrt(), at }
}

/// Pattern search uphill: the ridge may have a kink where two branches cross, so no derivative is asked for.
fn climb(height: impl Fn([f64; 2]) -> f64, start: [f64; 2], step: [f64; 2]) -> (f64, [f64; 2]) {
    let (mut at, mut best, mut step) = (start, height(start), step);
    while step[0] > 1e-9 {
        let mut moved = false;
        for turn in 0..8 {
            let angle = PI / 4.0 * f64::from(turn);
            let next = [at[0] + step[0] * libm::cos(angle), at[1] + step[1] * libm::sin(angle)];
            let value = height(next);
            if value > best {
                (best, at, moved) = (value, next, true);
            }
        }
        if !moved {
            step = step.map(|length| 0.5 * length);
        }
    }
    (best, at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Kernel;
    use crate::lattice::Lattice;
    use crate::partial_volume::VolumeRule;
    use approx::assert_abs_diff_eq;

    #[test]
    fn ratios_to_the_row_sum_bound_are_the_known_ones() {
        let lattice = |kernel, volume_rule| Lattice { kernel, m: 3.0, volume_rule, calibrated: false };
        let ratio = |t: TimeStep| t.sharp / t.row_sum;
        let bar = |rule| ratio(bar(&Stencil::new(lattice(Kernel::Constant, rule)).unwrap()));
        assert_abs_diff_eq!(bar(VolumeRule::Full), 1.173, epsilon = 5e-4);
        assert_abs_diff_eq!(bar(VolumeRule::Linear), 1.195, epsilon = 5e-4);
        let plane = |kernel, rule| ratio(plane(&Stencil::new(lattice(kernel, rule)).unwrap()));
        assert_abs_diff_eq!(plane(Kernel::Constant, VolumeRule::Linear), 1.68, epsilon = 0.015);
        assert_abs_diff_eq!(plane(Kernel::Gaussian { p: 2.0 }, VolumeRule::Linear), 1.54, epsilon = 0.01);
    }

    #[test]
    fn one_bond_is_the_courant_limit() {
        let chain =
            Lattice { kernel: Kernel::Constant, m: 1.0, volume_rule: VolumeRule::Full, calibrated: true };
        assert_abs_diff_eq!(bar(&Stencil::new(chain).unwrap()).sharp, 1.0, epsilon = 1e-15);
    }
}
