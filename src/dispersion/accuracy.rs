//! How wrong waves of a lattice travel when leapfrog carries them: the phase speed over the branch's own, less one, the worst
//! over directions and both branches.

use super::plane::{PlaneDispersion, speed_ratio_squared};
use super::{Branch, leapfrog};
use crate::lattice::Stencil;
use std::f64::consts::PI;

/// Directions that stand for all, in degrees: by the lattice's symmetries those of an octant do. The error of a direction is
/// a series in cos 4nφ that falls fast.
const STEP_DEGREES: f64 = 2.5;
const DIRECTIONS: usize = 19;

/// Wavenumbers looked at up to the shortest wave of the lattice.
const SAMPLES: usize = 256;

/// Halvings of the interval of a sample: to rounding.
const HALVINGS: usize = 46;

/// A phase error and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhaseError {
    /// Phase speed over the branch's own speed, less one. Infinite where a wave grows or does not travel.
    pub value: f64,
    pub degrees: f64,
    pub branch: Branch,
}

/// The waves of a plane lattice under leapfrog.
#[derive(Debug, Clone)]
pub struct Accuracy {
    relation: PlaneDispersion,
    courant: f64,
}

impl Accuracy {
    /// `courant` is c_d Δt/Δx, c_d the dilatational speed.
    pub fn new(stencil: &Stencil<2>, courant: f64) -> Self {
        Self { relation: PlaneDispersion::new(stencil), courant }
    }

    /// Phase error of the wave at |k|Δx along `degrees`; at k = 0 that of the long waves.
    pub fn phase_error(&self, k_dx: f64, degrees: f64, branch: Branch) -> PhaseError {
        let courant = self.courant / speed_ratio_squared(branch).sqrt();
        let value = if k_dx == 0.0 {
            self.relation.long_wave(degrees, branch) - 1.0
        } else {
            let space = self.relation.wave(k_dx, degrees, branch);
            leapfrog::wave(space, courant, None).map_or(f64::INFINITY, |wave| wave.phase(k_dx) - 1.0)
        };
        PhaseError { value: if value.is_nan() { f64::INFINITY } else { value }, degrees, branch }
    }

    /// The one that is largest in amount at |k|Δx.
    pub fn worst(&self, k_dx: f64) -> PhaseError {
        let all = [Branch::P, Branch::S].into_iter().flat_map(|branch| {
            (0..DIRECTIONS).map(move |n| self.phase_error(k_dx, STEP_DEGREES * n as f64, branch))
        });
        all.max_by(|a, b| a.value.abs().total_cmp(&b.value.abs())).expect("there are directions")
    }

    /// The largest |k|Δx up to which every wave, the longest included, has a phase error of at most `error`; `None` where the
    /// longest do not.
    pub fn reach(&self, error: f64) -> Option<f64> {
        let holds = |k_dx: f64| self.worst(k_dx).value.abs() <= error;
        let at = |sample: usize| PI * sample as f64 / SAMPLES as f64;
        let Some(first) = (0..=SAMPLES).find(|&sample| !holds(at(sample))) else { return Some(PI) };
        let mut held = at(first.checked_sub(1)?);
        let mut lost = at(first);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (held + lost);
            *(if holds(middle) { &mut held } else { &mut lost }) = middle;
        }
        Some(held)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dispersion::timestep;
    use crate::kernel::Kernel;
    use crate::lattice::Lattice;
    use crate::partial_volume::VolumeRule;
    use approx::assert_relative_eq;

    fn stencil(m: f64, calibrated: bool) -> Stencil<2> {
        let lattice =
            Lattice { kernel: Kernel::Gaussian { p: 2.0 }, m, volume_rule: VolumeRule::Linear, calibrated };
        Stencil::new(lattice).expect("a usable lattice")
    }

    /// The error of long waves is Δx² times a constant: a quarter of the error at half the wavenumber.
    #[test]
    fn the_reach_grows_as_the_root_of_the_error() {
        let stencil = stencil(3.0, true);
        let accuracy = Accuracy::new(&stencil, 0.9 * timestep::plane(&stencil).sharp);
        let [coarse, fine] = [4e-4, 1e-4].map(|error| accuracy.reach(error).expect("long waves are exact"));
        assert_relative_eq!(coarse / fine, 2.0, max_relative = 2e-3);
        assert_relative_eq!(accuracy.worst(fine).value.abs(), 1e-4, max_relative = 1e-9);
    }

    /// Beyond the reach, and nowhere before, is a wave whose error is larger, in directions between those looked at too.
    #[test]
    fn directions_between_hide_nothing() {
        for (m, calibrated) in [(1.5, true), (2.0, true), (3.0, true), (6.0, true), (3.0, false)] {
            let stencil = stencil(m, calibrated);
            let accuracy = Accuracy::new(&stencil, 0.9 * timestep::plane(&stencil).sharp);
            let Some(reach) = accuracy.reach(0.02) else { continue };
            for n in 0..=360 {
                for branch in [Branch::P, Branch::S] {
                    let error = accuracy.phase_error(reach, 0.25 * f64::from(n), branch).value.abs();
                    assert!(error <= 0.02 * (1.0 + 1e-3), "m = {m}, {branch:?}, {n}: {error}");
                }
            }
        }
    }

    #[test]
    fn wrong_moduli_reach_nothing_and_waves_that_grow_are_infinitely_wrong() {
        let printed = stencil(2.0, false);
        let long = Accuracy::new(&printed, 0.1).worst(0.0).value.abs();
        assert!(long > 1e-3);
        assert_eq!(Accuracy::new(&printed, 0.1).reach(0.5 * long), None);
        let calibrated = stencil(3.0, true);
        let hasty = Accuracy::new(&calibrated, 1.1 * timestep::plane(&calibrated).sharp);
        assert_eq!(hasty.worst(PI).value, f64::INFINITY);
    }
}
