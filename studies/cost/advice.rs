//! The cheapest settings of a plate in which waves of a length travel as accurately as asked.
//!
//! A lattice, leapfrog at 0.9 of its limit, and Δx as large as the phase error allows: the worst over directions and both
//! branches, at the wavelength and at all longer ones. With N pairs ±ξ for each node, a step Δt = C Δx/c_d updates N bonds for
//! each Δx² of the plate: N c_d/(C Δx³) bond updates for each m² and second.

use pd_verify::dispersion::accuracy::{Accuracy, PhaseError};
use pd_verify::dispersion::timestep;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::partial_volume::VolumeRule;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Of the largest stable time step.
pub const OF_LIMIT: f64 = 0.9;

/// What is searched: every kernel with every m, volume rule and both calibrations.
pub const KERNELS: [Kernel; 9] = [
    Kernel::Constant,
    Kernel::Conical,
    Kernel::Parabolic,
    Kernel::Gaussian { p: 1.0 },
    Kernel::Gaussian { p: 2.0 },
    Kernel::Gaussian { p: 3.0 },
    Kernel::Exponential { p: 1.0 },
    Kernel::Exponential { p: 2.0 },
    Kernel::Exponential { p: 3.0 },
];
pub const MS: [f64; 18] =
    [1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5, 6.0, 6.5, 7.0, 7.5, 8.0, 8.5, 9.0, 9.5, 10.0];

/// How much finer than the error allows a setting is, so that rounding does not take it beyond.
const MARGIN: f64 = 1e-12;

/// What is asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asked {
    /// Largest phase error.
    pub error: f64,
    /// In m.
    pub wavelength: f64,
    /// c_d in m/s.
    pub speed: f64,
    pub bound: Bound,
}

/// What a setting must be besides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    Free,
    /// m at least.
    LeastM(f64),
    /// δ in m: Δx is δ/m.
    Horizon(f64),
}

/// A lattice that can carry waves with the error asked for.
#[derive(Debug, Clone)]
pub struct Candidate {
    pub lattice: Lattice,
    /// Pairs ±ξ of a node.
    pub pairs: usize,
    /// c_d Δt/Δx.
    pub courant: f64,
    /// The largest kΔx of a wave as accurate as asked, and all longer ones.
    pub reach: f64,
    accuracy: Accuracy,
}

/// A way to run.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    pub lattice: Lattice,
    /// Others that come to the same weights: calibration leaves a family of eight neighbours no choice.
    pub alike: Vec<Lattice>,
    pub pairs: usize,
    pub courant: f64,
    /// In m.
    pub spacing: f64,
    /// In s.
    pub time_step: f64,
    /// At the wavelength.
    pub error: PhaseError,
    /// For each m² and second.
    pub node_updates: f64,
    pub bond_updates: f64,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    pub asked: Asked,
    /// Lattices that were looked at, and those of them that carry long waves as accurately as asked.
    pub searched: usize,
    pub accurate: usize,
    /// The cheapest first; equal costs in the order of the search. Those that come to the same are one.
    pub settings: Vec<Setting>,
    /// The cheapest without the bound.
    pub unbound: Option<Setting>,
}

/// Looks at everything.
pub fn advise(asked: Asked) -> Advice {
    let lattices = lattices();
    let candidates: Vec<Candidate> =
        lattices.par_iter().filter_map(|&lattice| Candidate::new(lattice, asked.error)).collect();
    let unbound = candidates.iter().filter_map(|one| one.setting(&Asked { bound: Bound::Free, ..asked }));
    Advice {
        asked,
        searched: lattices.len(),
        accurate: candidates.len(),
        unbound: ranked(unbound.collect()).into_iter().next(),
        settings: ranked(candidates.iter().filter_map(|one| one.setting(&asked)).collect()),
    }
}

/// What of two settings may differ by rounding when their weights are the same.
const ALIKE: f64 = 1e-9;

fn ranked(mut settings: Vec<Setting>) -> Vec<Setting> {
    settings.sort_by(|a, b| a.bond_updates.total_cmp(&b.bond_updates));
    let mut ranked: Vec<Setting> = Vec::new();
    for setting in settings {
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < ALIKE;
        let alike = |one: &Setting| {
            one.pairs == setting.pairs
                && near(one.spacing, setting.spacing)
                && near(one.time_step, setting.time_step)
        };
        let mut cheap =
            ranked.iter_mut().rev().take_while(|one| near(one.bond_updates, setting.bond_updates));
        match cheap.find(|one| alike(one)) {
            Some(one) => one.alike.push(setting.lattice),
            None => ranked.push(setting),
        }
    }
    ranked
}

fn lattices() -> Vec<Lattice> {
    let of = |kernel, m, volume_rule| {
        [false, true].map(|calibrated| Lattice { kernel, m, volume_rule, calibrated })
    };
    let of_m = |kernel, m| VolumeRule::ALL.into_iter().flat_map(move |rule| of(kernel, m, rule));
    KERNELS.into_iter().flat_map(|kernel| MS.into_iter().flat_map(move |m| of_m(kernel, m))).collect()
}

impl Candidate {
    /// `None` for a lattice that resists no shear, and where the longest waves are not as accurate as asked.
    pub fn new(lattice: Lattice, error: f64) -> Option<Self> {
        let stencil = Stencil::<2>::new(lattice).ok()?;
        let courant = OF_LIMIT * timestep::plane(&stencil).sharp;
        let accuracy = Accuracy::new(&stencil, courant);
        let reach = accuracy.reach(error).filter(|reach| *reach > 0.0)?;
        let pairs = stencil.bonds.iter().filter(|bond| bond.weight != 0.0).count();
        Some(Self { lattice, pairs, courant, reach, accuracy })
    }

    /// The coarsest way to run it; `None` where the bound forbids it.
    pub fn setting(&self, asked: &Asked) -> Option<Setting> {
        let Self { lattice, pairs, courant, reach, .. } = *self;
        let wavenumber = TAU / asked.wavelength;
        let spacing = match asked.bound {
            Bound::LeastM(least) if lattice.m < least => return None,
            Bound::Horizon(horizon) => horizon / lattice.m,
            _ => (1.0 - MARGIN) * reach / wavenumber,
        };
        if spacing * wavenumber > reach {
            return None;
        }
        let time_step = courant * spacing / asked.speed;
        let node_updates = 1.0 / (spacing * spacing * time_step);
        Some(Setting {
            lattice,
            alike: Vec::new(),
            pairs,
            courant,
            spacing,
            time_step,
            error: self.accuracy.worst(spacing * wavenumber),
            node_updates,
            bond_updates: pairs as f64 * node_updates,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dispersion::curve::reference_lattice;
    use approx::assert_relative_eq;
    use pd_verify_reference as reference;

    const ASKED: Asked = Asked { error: 0.01, wavelength: 0.02, speed: 5000.0, bound: Bound::Free };

    /// The worst phase error by the reference's sums and its leapfrog, at half degrees.
    fn by_reference(setting: &Setting, k_dx: f64) -> f64 {
        let lattice = reference_lattice(setting.lattice);
        let of = |degrees: f64| {
            let [p, s] = reference::lattice::plane(lattice, k_dx, degrees.to_radians());
            [(p, setting.courant), (s, setting.courant / 3_f64.sqrt())].map(|(space, courant)| {
                reference::leapfrog::wave(space, courant)
                    .map_or(f64::INFINITY, |wave| (wave.omega / k_dx - 1.0).abs())
            })
        };
        (0..=90).flat_map(|n| of(0.5 * f64::from(n))).fold(0.0, f64::max)
    }

    #[test]
    fn the_ten_cheapest_are_as_accurate_as_asked_and_no_finer_than_that_takes() {
        let advice = advise(ASKED);
        assert_eq!(advice.searched, 9 * 18 * 3 * 2);
        let alike: usize = advice.settings.iter().map(|setting| 1 + setting.alike.len()).sum();
        assert!((100..advice.searched).contains(&advice.accurate) && alike == advice.accurate);
        assert_eq!(advice.unbound.as_ref(), advice.settings.first());
        for setting in &advice.settings[..10] {
            let k_dx = TAU / ASKED.wavelength * setting.spacing;
            // Directions between those of the search may be worse by a thousandth.
            assert!(by_reference(setting, k_dx) <= 0.01 * (1.0 + 1e-3), "{setting:?}");
            assert!(by_reference(setting, 0.5 * k_dx) <= 0.01, "{setting:?}");
            assert!(by_reference(setting, 1.01 * k_dx) > 0.01, "{setting:?}");
            assert!(setting.error.value.abs() <= 0.01);
        }
        let costs: Vec<f64> = advice.settings.iter().map(|setting| setting.bond_updates).collect();
        assert!(costs.is_sorted());
    }

    /// A lattice with the limit of its step by the reference's search.
    #[test]
    fn steps_are_nine_tenths_of_the_limit() {
        let lattice = Lattice {
            kernel: Kernel::Gaussian { p: 2.0 },
            m: 3.0,
            volume_rule: VolumeRule::Linear,
            calibrated: true,
        };
        let candidate = Candidate::new(lattice, 0.01).unwrap();
        let limit = 2.0 / reference::lattice::plane_highest(reference_lattice(lattice));
        assert_relative_eq!(candidate.courant, 0.9 * limit, max_relative = 1e-9);
        assert_eq!(candidate.pairs, 18);
        // Δx = 1 mm and c_d Δt = C mm: 10⁶ nodes for each m², each 5·10⁶/C times a second.
        let asked = Asked { wavelength: TAU * 1e-3 / candidate.reach, ..ASKED };
        let setting = candidate.setting(&asked).unwrap();
        assert_relative_eq!(setting.spacing, 1e-3, max_relative = 2.0 * MARGIN);
        assert_relative_eq!(setting.node_updates, 5e12 / candidate.courant, max_relative = 4.0 * MARGIN);
        assert_relative_eq!(setting.bond_updates, 9e13 / candidate.courant, max_relative = 4.0 * MARGIN);
    }

    /// Calibrated, eight neighbours have two weights for two moduli: the kernel does not matter.
    #[test]
    fn settings_that_come_to_the_same_are_one() {
        let advice = advise(ASKED);
        let eight = advice.settings.iter().find(|one| one.pairs == 4 && one.lattice.calibrated).unwrap();
        assert!(eight.alike.len() > 5 && eight.alike.iter().all(|lattice| lattice.calibrated), "{eight:?}");
        let three: Vec<_> =
            advice.settings.iter().filter(|one| one.lattice.m == 3.0 && one.pairs == 18).collect();
        assert_eq!(three.len(), 7);
        assert!(three.iter().all(|one| one.alike.is_empty()));
    }

    #[test]
    fn bounds_take_away_and_never_add() {
        let bound = |bound| advise(Asked { bound, ..ASKED });
        let free = bound(Bound::Free);
        let wide = bound(Bound::LeastM(5.0));
        let all = |one: &Setting| one.alike.iter().chain([&one.lattice]).all(|lattice| lattice.m >= 5.0);
        assert!(wide.settings.iter().all(all));
        assert_eq!(wide.unbound, free.unbound);
        assert!(wide.settings[0].bond_updates > free.settings[0].bond_updates);
        let horizon = bound(Bound::Horizon(0.004));
        assert!(!horizon.settings.is_empty());
        for setting in &horizon.settings {
            assert_relative_eq!(setting.spacing * setting.lattice.m, 0.004, max_relative = 1e-14);
            assert!(setting.error.value.abs() <= 0.01);
        }
        assert!(bound(Bound::Horizon(1.0)).settings.is_empty());
    }
}
