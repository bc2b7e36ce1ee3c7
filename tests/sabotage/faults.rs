//! The wrong ingredients, one each.

use crate::subject::Subject;
use nalgebra::Complex;
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::dispersion::joint::{self, Chain};
use pd_verify::dispersion::plane::PlaneDispersion;
use pd_verify::dispersion::timestep::{self, TimeStep};
use pd_verify::dispersion::{Branch, Wave, continuum, finite_differences, leapfrog};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil, Unusable};
use pd_verify::material::Body;
use pd_verify::micromodulus;
use pd_verify::partial_volume::VolumeRule;

/// All of them, by name.
pub fn all() -> Vec<(&'static str, Box<dyn Subject + Send>)> {
    vec![
        ("the end of the horizon counts whole", Box::new(EndCountsWhole)),
        ("the end of the horizon counts half", Box::new(EndCountsHalf)),
        ("the kernel is evaluated a tenth of a cell off", Box::new(KernelShifted)),
        ("one neighbour is forgotten", Box::new(NeighbourForgotten)),
        ("weights are 15 % too large", Box::new(Stiffer)),
        ("calibration is always on", Box::new(AlwaysCalibrated)),
        ("calibration is never on", Box::new(NeverCalibrated)),
        ("continuum waves are a millionth too fast", Box::new(ContinuumFast)),
        ("lattice waves are a millionth too fast", Box::new(LatticeFast)),
        ("finite differences are a millionth too fast", Box::new(DifferencesFast)),
        ("group velocities are a millionth too large", Box::new(GroupLarge)),
        ("leapfrog is forgotten", Box::new(NoLeapfrog)),
        ("the mixed derivative always has its quarter", Box::new(AlwaysQuarter)),
        ("the lattice is not periodic", Box::new(NotPeriodic)),
        ("the lattice grows", Box::new(Grows)),
        ("the sharp time step is halved", Box::new(HalfTimeStep)),
        ("the row sum counts half the family", Box::new(HalfRowSum)),
        ("the row sum counts the family twice", Box::new(TwiceRowSum)),
        ("reflections are one per cent too large", Box::new(Reflects(1.01))),
        ("reflections are eight times too large", Box::new(Reflects(0.12 / 0.0151))),
        ("impedances are ten per cent off", Box::new(WrongImpedances)),
        ("sound lattices are refused", Box::new(RefusesSound)),
        ("the published coefficient is replaced by the exact one", Box::new(ExactAsPublished)),
        ("the Gaussian factor is taken as printed", Box::new(PrintedGaussianFactor)),
        ("the micromodulus is two thirds", Box::new(Micromodulus(2.0 / 3.0))),
        ("the micromodulus is 32/45", Box::new(Micromodulus(32.0 / 45.0))),
    ]
}

/// Makes both kinds of stencil from another lattice.
macro_rules! other_lattice {
    ($name:ident, $change:expr) => {
        struct $name;
        impl Subject for $name {
            fn bar_stencil(&self, lattice: Lattice) -> Result<Stencil<1>, Unusable> {
                let change: fn(Lattice) -> Lattice = $change;
                Stencil::new(change(lattice))
            }
            fn plane_stencil(&self, lattice: Lattice) -> Result<Stencil<2>, Unusable> {
                let change: fn(Lattice) -> Lattice = $change;
                Stencil::new(change(lattice))
            }
        }
    };
}

other_lattice!(EndCountsWhole, |lattice| Lattice { volume_rule: VolumeRule::Full, ..lattice });
other_lattice!(EndCountsHalf, |lattice| Lattice { volume_rule: VolumeRule::Linear, ..lattice });
other_lattice!(KernelShifted, |lattice| Lattice { m: lattice.m + 0.1, ..lattice });
other_lattice!(AlwaysCalibrated, |lattice| Lattice { calibrated: true, ..lattice });
other_lattice!(NeverCalibrated, |lattice| Lattice { calibrated: false, ..lattice });

struct NeighbourForgotten;

impl Subject for NeighbourForgotten {
    fn bar_stencil(&self, lattice: Lattice) -> Result<Stencil<1>, Unusable> {
        Stencil::new(lattice).map(without_last)
    }

    fn plane_stencil(&self, lattice: Lattice) -> Result<Stencil<2>, Unusable> {
        Stencil::new(lattice).map(without_last)
    }
}

fn without_last<const D: usize>(mut stencil: Stencil<D>) -> Stencil<D> {
    if stencil.bonds.len() > 1 {
        stencil.bonds.pop();
    }
    stencil
}

struct Stiffer;

impl Subject for Stiffer {
    fn bar_stencil(&self, lattice: Lattice) -> Result<Stencil<1>, Unusable> {
        Stencil::new(lattice).map(stiffer)
    }

    fn plane_stencil(&self, lattice: Lattice) -> Result<Stencil<2>, Unusable> {
        Stencil::new(lattice).map(stiffer)
    }
}

fn stiffer<const D: usize>(mut stencil: Stencil<D>) -> Stencil<D> {
    stencil.bonds.iter_mut().for_each(|bond| bond.weight *= 1.15);
    stencil
}

const MILLIONTH: f64 = 1e-6;

fn faster(wave: Wave) -> Wave {
    Wave { omega: wave.omega * (1.0 + MILLIONTH), ..wave }
}

struct ContinuumFast;

impl Subject for ContinuumFast {
    fn continuum_bar(&self, kernel: Kernel, k_horizon: f64) -> Wave {
        faster(continuum::bar(kernel, k_horizon).0)
    }

    fn continuum_plane(&self, kernel: Kernel, branch: Branch, k_horizon: f64) -> Wave {
        faster(continuum::plane(kernel, branch, k_horizon).0)
    }
}

struct LatticeFast;

impl Subject for LatticeFast {
    fn bar_wave(&self, relation: &BarDispersion, k_dx: f64) -> Wave {
        faster(relation.wave(k_dx))
    }

    fn plane_wave(&self, relation: &PlaneDispersion, k_dx: f64, degrees: f64, branch: Branch) -> Wave {
        faster(relation.wave(k_dx, degrees, branch))
    }
}

struct DifferencesFast;

impl Subject for DifferencesFast {
    fn finite_differences_bar(&self, k_dx: f64, courant: Option<f64>) -> Option<Wave> {
        match courant {
            Some(courant) => leapfrog::finite_differences_bar(k_dx, courant).map(faster),
            None => Some(faster(finite_differences::bar(k_dx))),
        }
    }

    fn finite_differences_plane(&self, k_dx: f64, degrees: f64, branch: Branch, mixed: f64) -> Wave {
        Wave { omega: 1.000_01 * finite_differences::plane(k_dx, degrees, branch, mixed).omega, group: 1.0 }
    }
}

struct GroupLarge;

fn larger_group(wave: Wave) -> Wave {
    Wave { group: wave.group * (1.0 + MILLIONTH), ..wave }
}

impl Subject for GroupLarge {
    fn continuum_bar(&self, kernel: Kernel, k_horizon: f64) -> Wave {
        larger_group(continuum::bar(kernel, k_horizon).0)
    }

    fn continuum_plane(&self, kernel: Kernel, branch: Branch, k_horizon: f64) -> Wave {
        larger_group(continuum::plane(kernel, branch, k_horizon).0)
    }

    fn bar_wave(&self, relation: &BarDispersion, k_dx: f64) -> Wave {
        larger_group(relation.wave(k_dx))
    }

    fn plane_wave(&self, relation: &PlaneDispersion, k_dx: f64, degrees: f64, branch: Branch) -> Wave {
        larger_group(relation.wave(k_dx, degrees, branch))
    }
}

struct NoLeapfrog;

impl Subject for NoLeapfrog {
    fn leapfrog(&self, wave: Wave, _: f64) -> Option<Wave> {
        Some(wave)
    }

    fn finite_differences_bar(&self, k_dx: f64, _: Option<f64>) -> Option<Wave> {
        Some(finite_differences::bar(k_dx))
    }
}

struct AlwaysQuarter;

impl Subject for AlwaysQuarter {
    fn finite_differences_plane(&self, k_dx: f64, degrees: f64, branch: Branch, _: f64) -> Wave {
        finite_differences::plane(k_dx, degrees, branch, finite_differences::QUARTER)
    }
}

struct NotPeriodic;

impl Subject for NotPeriodic {
    fn bar_square(&self, relation: &BarDispersion, k_dx: f64) -> f64 {
        relation.square(k_dx) * (1.0 + MILLIONTH * k_dx)
    }

    fn plane_squares(&self, relation: &PlaneDispersion, k_dx: [f64; 2]) -> [f64; 2] {
        relation.matrix(k_dx).eigen().0.map(|square| square * (1.0 + MILLIONTH * k_dx[0]))
    }
}

struct Grows;

impl Subject for Grows {
    fn bar_square(&self, relation: &BarDispersion, k_dx: f64) -> f64 {
        relation.square(k_dx) - 0.01
    }

    fn plane_squares(&self, relation: &PlaneDispersion, k_dx: [f64; 2]) -> [f64; 2] {
        relation.matrix(k_dx).eigen().0.map(|square| square - 0.01)
    }
}

struct HalfTimeStep;

impl Subject for HalfTimeStep {
    fn bar_time_step(&self, stencil: &Stencil<1>) -> TimeStep {
        let limits = timestep::bar(stencil);
        TimeStep { sharp: 0.5 * limits.sharp, ..limits }
    }

    fn plane_time_step(&self, stencil: &Stencil<2>) -> TimeStep {
        let limits = timestep::plane(stencil);
        TimeStep { sharp: 0.5 * limits.sharp, ..limits }
    }
}

struct HalfRowSum;

impl Subject for HalfRowSum {
    fn bar_time_step(&self, stencil: &Stencil<1>) -> TimeStep {
        let limits = timestep::bar(stencil);
        TimeStep { row_sum: 2.0_f64.sqrt() * limits.row_sum, ..limits }
    }

    fn plane_time_step(&self, stencil: &Stencil<2>) -> TimeStep {
        let limits = timestep::plane(stencil);
        TimeStep { row_sum: 1.4 * 2.0_f64.sqrt() * limits.row_sum, ..limits }
    }
}

struct TwiceRowSum;

impl Subject for TwiceRowSum {
    fn bar_time_step(&self, stencil: &Stencil<1>) -> TimeStep {
        let limits = timestep::bar(stencil);
        TimeStep { row_sum: limits.row_sum / 2.0_f64.sqrt(), ..limits }
    }

    fn plane_time_step(&self, stencil: &Stencil<2>) -> TimeStep {
        let limits = timestep::plane(stencil);
        TimeStep { row_sum: limits.row_sum / 2.0_f64.sqrt(), ..limits }
    }
}

struct Reflects(f64);

impl Subject for Reflects {
    fn reflection(&self, left: &Chain, right: &Chain, theta: f64) -> Option<Complex<f64>> {
        joint::exact(left, right, theta).map(|found| found * self.0)
    }
}

struct WrongImpedances;

impl Subject for WrongImpedances {
    fn published_reflection(&self, left: &Chain, right: &Chain, theta: f64) -> f64 {
        1.1 * joint::impedances_at_equal_wavenumber(left, right, theta)
    }

    fn reflection_at_equal_frequency(&self, left: &Chain, right: &Chain, theta: f64) -> Option<f64> {
        joint::impedances_at_equal_frequency(left, right, theta).map(|r| 1.1 * r)
    }
}

struct RefusesSound;

impl Subject for RefusesSound {
    fn bar_stencil(&self, lattice: Lattice) -> Result<Stencil<1>, Unusable> {
        if lattice.m == 3.0 { Err(Unusable::NoShear { lattice }) } else { Stencil::new(lattice) }
    }

    fn plane_stencil(&self, lattice: Lattice) -> Result<Stencil<2>, Unusable> {
        if lattice.m == 3.0 { Err(Unusable::NoShear { lattice }) } else { Stencil::new(lattice) }
    }
}

struct ExactAsPublished;

impl Subject for ExactAsPublished {
    fn published_reflection(&self, left: &Chain, right: &Chain, theta: f64) -> f64 {
        joint::exact(left, right, theta).map_or(f64::NAN, |found| found.norm())
    }
}

struct PrintedGaussianFactor;

impl Subject for PrintedGaussianFactor {
    fn micromodulus(&self, body: Body, kernel: Kernel, e: f64, section: f64, horizon: f64) -> f64 {
        let constant = micromodulus::constant(body, Kernel::Constant, e, section, horizon);
        match kernel {
            Kernel::Gaussian { p } => constant * p * p / (1.0 - (-p * p).exp()),
            Kernel::Exponential { p } => constant * 0.5 * p * p / (1.0 - (1.0 + p) * (-p).exp()),
            other => micromodulus::constant(body, other, e, section, horizon),
        }
    }
}

struct Micromodulus(f64);

impl Subject for Micromodulus {
    fn micromodulus(&self, body: Body, kernel: Kernel, e: f64, section: f64, horizon: f64) -> f64 {
        self.0 * micromodulus::constant(body, kernel, e, section, horizon)
    }
}
