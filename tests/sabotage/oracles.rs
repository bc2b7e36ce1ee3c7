//! Every tabulated answer counts: the library made wrong at that one entry must lose its claim.

use crate::dispersion::continuum_oracles::{ContinuumOracles, kernel};
use crate::dispersion::lattice_oracles::LatticeOracles;
use crate::dispersion::reflection_oracles::ReflectionOracles;
use crate::question::{Place, Question};
use crate::subject::{PdVerify, Subject};
use nalgebra::Complex;
use pd_verify::claim::Claim;
use pd_verify::dispersion::joint::{self, Chain};
use pd_verify::dispersion::timestep::{self, TimeStep};
use pd_verify::dispersion::{Branch, Wave, continuum};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil, Unusable};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::verdict::{Verdict, judge};
use pd_verify_reference::oracles;
use rayon::prelude::*;

/// The names of the claims that a fault costs.
fn lost(question: &dyn Question, subject: &dyn Subject) -> Vec<String> {
    let place = Place { study: "sabotage".into(), case: "oracles".into() };
    let evidence = question.answer(subject, &place).evidence;
    let fails = |claim: Claim| {
        let name = claim.id.rsplit('/').next().unwrap_or_default().to_owned();
        let found = evidence.iter().find(|(of, _)| *of == name).expect("evidence for every claim").1.clone();
        (judge(claim, found).verdict == Verdict::Fail).then_some(name)
    };
    question.claims(&place).into_iter().filter_map(fails).collect()
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
        assert!(!lost(&ContinuumOracles, &fault).is_empty(), "{row:?} may be wrong without notice");
    });
}

#[test]
fn every_printed_continuum_answer_counts() {
    for row in oracles::published("continuum_bar_phase_speed") {
        let (of, k_horizon) = (row.kernel.expect("a kernel"), row.argument.expect("a wavenumber"));
        let fault = WrongAt { dimension: 1, branch: Branch::P, kernel: kernel(of), k_horizon };
        assert!(!lost(&ContinuumOracles, &fault).is_empty(), "{row:?} may be wrong without notice");
    }
}

/// One lattice made wrong: weights and moduli one per cent off, one calibration factor off, or a neighbour forgotten.
struct WrongLattice {
    lattice: Lattice,
    dimension: usize,
    quantity: String,
}

impl WrongLattice {
    fn spoil<const D: usize>(&self, lattice: Lattice, mut stencil: Stencil<D>) -> Stencil<D> {
        if lattice != self.lattice || D != self.dimension {
            return stencil;
        }
        let calibration = stencil.calibration.as_mut();
        match self.quantity.as_str() {
            "lattice_bar_omega_over_v" => stencil.bonds.iter_mut().for_each(|bond| bond.weight *= 1.01),
            "lattice_bar_long_wave_speed" | "lattice_plane_c11" => stencil.after.c11 *= 1.01,
            "lattice_plane_c12" => stencil.after.c12 *= 1.01,
            "calibration_alpha" => calibration.expect("a calibrated lattice").alpha *= 1.01,
            "calibration_beta" => calibration.expect("a calibrated lattice").beta *= 1.01,
            "neighbours_plane" => stencil.bonds.truncate(stencil.bonds.len() - 1),
            other => panic!("no fault is known for {other}"),
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

/// The time step of one lattice one per cent too large.
struct WrongTimeStep(Lattice);

impl WrongTimeStep {
    fn spoil<const D: usize>(&self, stencil: &Stencil<D>, limits: TimeStep) -> TimeStep {
        let here = Stencil::<D>::new(self.0).is_ok_and(|own| own == *stencil);
        TimeStep { sharp: limits.sharp * if here { 1.01 } else { 1.0 }, ..limits }
    }
}

/// Time steps of bars alone, and of plates alone.
struct InDimension<const D: usize>(WrongTimeStep);

impl<const D: usize> Subject for InDimension<D> {
    fn bar_time_step(&self, stencil: &Stencil<1>) -> TimeStep {
        let limits = timestep::bar(stencil);
        if D == 1 { self.0.spoil(stencil, limits) } else { limits }
    }

    fn plane_time_step(&self, stencil: &Stencil<2>) -> TimeStep {
        let limits = timestep::plane(stencil);
        if D == 2 { self.0.spoil(stencil, limits) } else { limits }
    }
}

/// The lattice of a printed number.
fn lattice_of(row: &oracles::PublishedOracle) -> Lattice {
    use pd_verify_reference::VolumeRule as Given;
    let volume_rule = match row.rule.expect("a volume rule") {
        Given::Full => VolumeRule::Full,
        Given::Linear => VolumeRule::Linear,
        Given::ExactArea => VolumeRule::ExactArea,
    };
    let calibrated = row.quantity.starts_with("calibration");
    Lattice {
        kernel: row.kernel.map_or(Kernel::Constant, kernel),
        m: row.m.expect("m"),
        volume_rule,
        calibrated,
    }
}

#[test]
fn every_printed_lattice_number_counts() {
    let mut seen = 0;
    for row in oracles::published_table() {
        let (dimension, claim) = match row.quantity.as_str() {
            "lattice_bar_omega_over_v" => (1, "frequencies"),
            "lattice_bar_long_wave_speed" => (1, "long_wave_speeds"),
            "lattice_plane_c11" | "lattice_plane_c12" => (2, "moduli"),
            "calibration_alpha" | "calibration_beta" => (2, "calibration"),
            "neighbours_plane" => (2, "neighbours"),
            _ => continue,
        };
        let fault = WrongLattice { lattice: lattice_of(&row), dimension, quantity: row.quantity.clone() };
        assert!(
            lost(&LatticeOracles, &fault).contains(&claim.to_owned()),
            "{row:?} may be wrong without notice"
        );
        seen += 1;
    }
    assert_eq!(seen, 9 + 13 + 40 + 2 + 3);
}

#[test]
fn every_printed_time_step_counts() {
    let rows = |quantity| oracles::published(quantity).into_iter().map(|row| lattice_of(&row));
    for lattice in rows("bar_sharp_over_row_sum") {
        assert_eq!(lost(&LatticeOracles, &InDimension::<1>(WrongTimeStep(lattice))), ["time_steps"]);
    }
    for lattice in rows("plane_sharp_over_row_sum") {
        assert_eq!(lost(&LatticeOracles, &InDimension::<2>(WrongTimeStep(lattice))), ["time_steps"]);
    }
    assert!(lost(&LatticeOracles, &PdVerify).is_empty());
}

/// Reflections ten per cent too large at one wavenumber.
struct WrongReflection {
    theta: f64,
    published: bool,
}

impl WrongReflection {
    fn factor(&self, theta: f64, published: bool) -> f64 {
        if theta == self.theta && published == self.published { 1.1 } else { 1.0 }
    }
}

impl Subject for WrongReflection {
    fn published_reflection(&self, left: &Chain, right: &Chain, theta: f64) -> f64 {
        self.factor(theta, true) * joint::impedances_at_equal_wavenumber(left, right, theta)
    }

    fn reflection(&self, left: &Chain, right: &Chain, theta: f64) -> Option<Complex<f64>> {
        joint::exact(left, right, theta).map(|r| r * self.factor(theta, false))
    }
}

#[test]
fn every_printed_reflection_counts() {
    for (quantity, published, claim) in
        [("reflection_fd_lattice", false, "exact"), ("published_reflection_fd_lattice", true, "published")]
    {
        for row in oracles::published(quantity) {
            let fault = WrongReflection { theta: row.argument.expect("a wavenumber"), published };
            assert_eq!(lost(&ReflectionOracles, &fault), [claim], "{row:?}");
        }
    }
    assert!(lost(&ReflectionOracles, &PdVerify).is_empty());
}
