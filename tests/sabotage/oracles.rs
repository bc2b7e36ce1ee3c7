//! Every tabulated answer counts: the library made wrong at that one entry must lose its claim.

use crate::dispersion::continuum_oracles::{ContinuumOracles, kernel};
use crate::dispersion::lattice_oracles::LatticeOracles;
use crate::question::{Place, Question};
use crate::subject::Subject;
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::dispersion::timestep::{self, TimeStep};
use pd_verify::dispersion::{Branch, Wave, continuum};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil, Unusable};
use pd_verify::verdict::{Verdict, judge};
use pd_verify_reference::oracles;
use rayon::prelude::*;

fn lost(question: &dyn Question, subject: &dyn Subject) -> bool {
    let place = Place { study: "sabotage".into(), case: "oracles".into() };
    let evidence = question.answer(subject, &place).evidence;
    question.claims(&place).into_iter().any(|claim| {
        let name = claim.id.rsplit('/').next().unwrap_or_default().to_owned();
        let found = evidence.iter().find(|(of, _)| *of == name).expect("evidence for every claim").1.clone();
        judge(claim, found).verdict == Verdict::Fail
    })
}

/// Wrong by a ten-billionth at one wavenumber of one kernel and branch.
struct WrongAt {
    dimension: u8,
    branch: Branch,
    kernel: Kernel,
    k_horizon: f64,
}

impl WrongAt {
    fn spoil(&self, here: bool, wave: Wave) -> Wave {
        if here { Wave { omega: wave.omega * (1.0 + 1e-10), ..wave } } else { wave }
    }
}

impl Subject for WrongAt {
    fn continuum_bar(&self, kernel: Kernel, k_horizon: f64) -> Wave {
        let here = self.dimension == 1 && kernel == self.kernel && k_horizon == self.k_horizon;
        self.spoil(here, continuum::bar(kernel, k_horizon).0)
    }

    fn continuum_plane(&self, kernel: Kernel, branch: Branch, k_horizon: f64) -> Wave {
        let here = self.dimension == 2
            && branch == self.branch
            && kernel == self.kernel
            && k_horizon == self.k_horizon;
        self.spoil(here, continuum::plane(kernel, branch, k_horizon).0)
    }
}

#[test]
fn every_seventeenth_continuum_answer_counts() {
    let rows = oracles::continuum_table();
    rows.par_iter().step_by(17).for_each(|row| {
        let branch = if row.branch == "S" { Branch::S } else { Branch::P };
        let fault = WrongAt {
            dimension: row.dimension,
            branch,
            kernel: kernel(row.kernel),
            k_horizon: row.k_horizon,
        };
        assert!(lost(&ContinuumOracles, &fault), "{row:?} may be wrong without notice");
    });
}

#[test]
fn every_printed_continuum_answer_counts() {
    for row in oracles::published("continuum_bar_phase_speed") {
        let (of, k_horizon) = (row.kernel.expect("a kernel"), row.argument.expect("a wavenumber"));
        let fault = WrongAt { dimension: 1, branch: Branch::P, kernel: kernel(of), k_horizon };
        assert!(lost(&ContinuumOracles, &fault), "{row:?} may be wrong without notice");
    }
}

/// One lattice whose every number is one per cent off.
struct WrongLattice {
    lattice: Lattice,
    dimension: usize,
}

impl WrongLattice {
    fn spoil<const D: usize>(&self, lattice: Lattice, mut stencil: Stencil<D>) -> Stencil<D> {
        if lattice == self.lattice && D == self.dimension {
            stencil.bonds.iter_mut().for_each(|bond| bond.weight *= 1.01);
            stencil.after.c11 *= 1.01;
            stencil.after.c12 *= 1.01;
            if let Some(calibration) = &mut stencil.calibration {
                calibration.alpha *= 1.01;
            }
        }
        stencil
    }
}

impl Subject for WrongLattice {
    fn bar_stencil(&self, lattice: Lattice) -> Result<Stencil<1>, Unusable> {
        Stencil::new(lattice).map(|stencil| self.spoil(lattice, stencil))
    }

    fn plane_stencil(&self, lattice: Lattice) -> Result<Stencil<2>, Unusable> {
        Stencil::new(lattice).map(|stencil| self.spoil(lattice, stencil))
    }
}

#[test]
fn every_printed_lattice_counts() {
    use pd_verify_reference::VolumeRule as Given;
    for row in oracles::published_table() {
        let dimension = match row.quantity.as_str() {
            "lattice_bar_omega_over_v" | "lattice_bar_long_wave_speed" => 1,
            "lattice_plane_c11" | "lattice_plane_c12" | "calibration_alpha" => 2,
            _ => continue,
        };
        let volume_rule = match row.rule.expect("a volume rule") {
            Given::Full => pd_verify::partial_volume::VolumeRule::Full,
            Given::Linear => pd_verify::partial_volume::VolumeRule::Linear,
            Given::ExactArea => pd_verify::partial_volume::VolumeRule::ExactArea,
        };
        let calibrated = row.quantity.starts_with("calibration");
        let lattice = Lattice {
            kernel: kernel(row.kernel.expect("a kernel")),
            m: row.m.expect("m"),
            volume_rule,
            calibrated,
        };
        let fault = WrongLattice { lattice, dimension };
        assert!(lost(&LatticeOracles, &fault), "{row:?} may be wrong without notice");
    }
}

/// Time steps and frequencies that no stencil knows about.
struct WrongTimeStep<const D: usize>;

impl<const D: usize> Subject for WrongTimeStep<D> {
    fn bar_time_step(&self, stencil: &Stencil<1>) -> TimeStep {
        let limits = timestep::bar(stencil);
        TimeStep { sharp: limits.sharp * if D == 1 { 1.01 } else { 1.0 }, ..limits }
    }

    fn plane_time_step(&self, stencil: &Stencil<2>) -> TimeStep {
        let limits = timestep::plane(stencil);
        TimeStep { sharp: limits.sharp * if D == 2 { 1.01 } else { 1.0 }, ..limits }
    }

    fn bar_wave(&self, relation: &BarDispersion, k_dx: f64) -> Wave {
        relation.wave(k_dx)
    }
}

#[test]
fn printed_time_steps_count_in_both_dimensions() {
    assert!(lost(&LatticeOracles, &WrongTimeStep::<1>));
    assert!(lost(&LatticeOracles, &WrongTimeStep::<2>));
    assert!(!lost(&LatticeOracles, &crate::subject::PdVerify));
}
