//! What differs between bars and plates in a refinement: who is asked to march or to rest, and how waves are carried.

use crate::dispersion::curve::reference_lattice;
use crate::subject::Subject;
use pd_verify::dispersion::Branch;
use pd_verify::lattice::{Lattice, Stencil, Unusable};
use pd_verify::record::{Failure, Record};
use pd_verify::scene::Scene;
use pd_verify_reference::medium::Medium;
use pd_verify_reference::periodic_pulse::{PeriodicPulse, RingPulse};
use pd_verify_reference::standing_wave::{BarStandingWave, StandingWave};
use pd_verify_reference::{forced_rest, lattice};

/// One or two dimensions.
pub struct In;

/// How long a wave has been carried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Carried {
    /// Exactly, for a time t; ct in m.
    Time(f64),
    /// By leapfrog, so many steps of cΔt in m.
    Steps(u64, f64),
}

/// Long-wave moduli this close to the intended ones are the intended ones.
const RIGHT: f64 = 1e-12;

/// Bodies of D dimensions.
pub trait Space<const D: usize> {
    fn march(subject: &dyn Subject, scene: &Scene<D>) -> Result<Record, Failure>;

    /// u in m of all nodes at rest, row by row.
    fn rest(subject: &dyn Subject, scene: &Scene<D>) -> Result<Vec<[f64; D]>, String>;

    /// Local elasticity with the long-wave moduli of a lattice.
    fn moduli(lattice: Lattice) -> Medium;

    /// Whether a lattice has the long-wave moduli that it is meant to have.
    fn intended(lattice: Lattice) -> bool {
        let Medium::Moduli(moduli) = Self::moduli(lattice) else { return false };
        let shear = if D == 1 { 1.0 } else { moduli.c12 };
        (moduli.c11 - 1.0).abs() < RIGHT && (shear - 1.0).abs() < RIGHT
    }

    /// M a of the wave k in a medium, in 1/m²; the body force is C₁₁ M a.
    fn stiffness(medium: &Medium, k: [f64; D], a: [f64; D]) -> Option<[f64; D]>;

    /// M⁻¹ b.
    fn response(medium: &Medium, k: [f64; D], b: [f64; D]) -> Option<[f64; D]>;

    /// Amplitude of u = a cos(k·x + φ) let go from rest.
    fn carried(medium: &Medium, k: [f64; D], a: [f64; D], by: Carried) -> Option<[f64; D]>;

    /// Unit displacement of the wave k of a branch.
    fn polarisation(medium: &Medium, k: [f64; D], branch: Branch) -> Option<[f64; D]>;

    /// A Gaussian pulse of u_x in the middle of a periodic square or ring, seen at the places along each axis: a field
    /// for each component, row by row.
    fn pulse(
        medium: &Medium,
        sharpness: f64,
        side: f64,
        places: [Vec<f64>; D],
        by: Carried,
    ) -> Option<Vec<Vec<f64>>>;

    /// How far a family reaches, in nodes.
    fn reach(lattice: Lattice) -> Result<usize, Unusable> {
        Ok(Stencil::<D>::new(lattice)?.reach())
    }
}

impl Space<1> for In {
    fn march(subject: &dyn Subject, scene: &Scene<1>) -> Result<Record, Failure> {
        subject.march_bar(scene)
    }

    fn rest(subject: &dyn Subject, scene: &Scene<1>) -> Result<Vec<[f64; 1]>, String> {
        Ok(subject.rest_bar(scene)?.into_iter().map(|u| [u]).collect())
    }

    fn moduli(lattice: Lattice) -> Medium {
        let c11 = lattice::bar_modulus(reference_lattice(lattice));
        Medium::Moduli(lattice::Moduli { c11, c12: 0.0, c66: 0.0 })
    }

    fn stiffness(medium: &Medium, k: [f64; 1], a: [f64; 1]) -> Option<[f64; 1]> {
        Some([forced_rest::bar_force_amplitude(medium, k[0], a[0])?])
    }

    fn response(medium: &Medium, k: [f64; 1], b: [f64; 1]) -> Option<[f64; 1]> {
        Some([forced_rest::bar_displacement_amplitude(medium, k[0], b[0])?])
    }

    fn carried(medium: &Medium, k: [f64; 1], a: [f64; 1], by: Carried) -> Option<[f64; 1]> {
        let wave = BarStandingWave { medium: *medium, wavenumber: k[0], amplitude: a[0], phase: 0.0 };
        Some([match by {
            Carried::Time(ct) => wave.amplitude_at(ct)?,
            Carried::Steps(steps, c_dt) => wave.amplitude_after(steps, c_dt)?,
        }])
    }

    fn pulse(
        medium: &Medium,
        sharpness: f64,
        side: f64,
        [xs]: [Vec<f64>; 1],
        by: Carried,
    ) -> Option<Vec<Vec<f64>>> {
        let pulse = RingPulse::new(*medium, sharpness, 0.5 * side, side)?;
        Some(vec![match by {
            Carried::Time(ct) => pulse.displacements(&xs, ct)?,
            Carried::Steps(steps, c_dt) => pulse.displacements_after(&xs, steps, c_dt)?,
        }])
    }

    fn polarisation(_: &Medium, _: [f64; 1], _: Branch) -> Option<[f64; 1]> {
        Some([1.0])
    }
}

impl Space<2> for In {
    fn march(subject: &dyn Subject, scene: &Scene<2>) -> Result<Record, Failure> {
        subject.march_plate(scene)
    }

    fn rest(subject: &dyn Subject, scene: &Scene<2>) -> Result<Vec<[f64; 2]>, String> {
        subject.rest_plate(scene)
    }

    fn moduli(lattice: Lattice) -> Medium {
        Medium::Moduli(lattice::plane_moduli(reference_lattice(lattice)))
    }

    fn stiffness(medium: &Medium, k: [f64; 2], a: [f64; 2]) -> Option<[f64; 2]> {
        forced_rest::force_amplitude(medium, k, a)
    }

    fn response(medium: &Medium, k: [f64; 2], b: [f64; 2]) -> Option<[f64; 2]> {
        forced_rest::displacement_amplitude(medium, k, b)
    }

    fn carried(medium: &Medium, k: [f64; 2], a: [f64; 2], by: Carried) -> Option<[f64; 2]> {
        let wave = StandingWave { medium: *medium, wavenumber: k, amplitude: a, phase: 0.0 };
        match by {
            Carried::Time(ct) => wave.amplitude_at(ct),
            Carried::Steps(steps, c_dt) => wave.amplitude_after(steps, c_dt),
        }
    }

    fn pulse(
        medium: &Medium,
        sharpness: f64,
        side: f64,
        [xs, ys]: [Vec<f64>; 2],
        by: Carried,
    ) -> Option<Vec<Vec<f64>>> {
        let pulse = PeriodicPulse::new(*medium, sharpness, [0.5 * side; 2], [side; 2])?;
        Some(Vec::from(match by {
            Carried::Time(ct) => pulse.fields(&xs, &ys, ct)?,
            Carried::Steps(steps, c_dt) => pulse.fields_after(&xs, &ys, steps, c_dt)?,
        }))
    }

    fn polarisation(medium: &Medium, k: [f64; 2], branch: Branch) -> Option<[f64; 2]> {
        Some(medium.plane_waves(k)?[usize::from(branch == Branch::S)].1)
    }
}
