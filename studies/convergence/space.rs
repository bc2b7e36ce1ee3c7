//! What differs between bars and plates in a refinement: who is asked to march or to rest, and how waves are carried.

use crate::dispersion::curve::reference_lattice;
use crate::subject::Subject;
use pd_verify::dispersion::Branch;
use pd_verify::lattice::{Lattice, Stencil, Unusable};
use pd_verify::record::{Failure, Record};
use pd_verify::scene::Scene;
use pd_verify_reference::lattice;
use pd_verify_reference::medium::{Medium, leapfrog_turn};

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

/// Bodies of D dimensions.
pub trait Space<const D: usize> {
    fn march(subject: &dyn Subject, scene: &Scene<D>) -> Result<Record, Failure>;

    /// u in m of all nodes at rest, row by row.
    fn rest(subject: &dyn Subject, scene: &Scene<D>) -> Result<Vec<[f64; D]>, String>;

    /// Local elasticity with the long-wave moduli of a lattice.
    fn moduli(lattice: Lattice) -> Medium;

    /// M a of the wave k in a medium, in 1/m²; the body force is C₁₁ M a.
    fn stiffness(medium: &Medium, k: [f64; D], a: [f64; D]) -> Option<[f64; D]>;

    /// M⁻¹ b.
    fn response(medium: &Medium, k: [f64; D], b: [f64; D]) -> Option<[f64; D]>;

    /// Amplitude of u = a cos(k·x + φ) let go from rest.
    fn carried(medium: &Medium, k: [f64; D], a: [f64; D], by: Carried) -> Option<[f64; D]>;

    /// Unit displacement of the wave k of a branch.
    fn polarisation(medium: &Medium, k: [f64; D], branch: Branch) -> Option<[f64; D]>;

    /// How far a family reaches, in nodes.
    fn reach(lattice: Lattice) -> Result<usize, Unusable> {
        Ok(Stencil::<D>::new(lattice)?.reach())
    }
}

/// The cosine by which a wave of ω/c has turned.
fn turned(omega: f64, by: Carried) -> Option<f64> {
    match by {
        Carried::Time(ct) => Some(libm::cos(omega * ct)),
        Carried::Steps(steps, c_dt) => Some(libm::cos(leapfrog_turn(omega, c_dt)? * steps as f64)),
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
        Some([medium.bar_square(k[0])? * a[0]])
    }

    fn response(medium: &Medium, k: [f64; 1], b: [f64; 1]) -> Option<[f64; 1]> {
        Some([b[0] / medium.bar_square(k[0])?])
    }

    fn carried(medium: &Medium, k: [f64; 1], a: [f64; 1], by: Carried) -> Option<[f64; 1]> {
        Some([a[0] * turned(medium.bar_square(k[0])?.sqrt(), by)?])
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
        let [xx, xy, yy] = medium.plane_matrix(k)?;
        Some([xx * a[0] + xy * a[1], xy * a[0] + yy * a[1]])
    }

    fn response(medium: &Medium, k: [f64; 2], b: [f64; 2]) -> Option<[f64; 2]> {
        let [xx, xy, yy] = medium.plane_matrix(k)?;
        let determinant = xx * yy - xy * xy;
        Some([(yy * b[0] - xy * b[1]) / determinant, (xx * b[1] - xy * b[0]) / determinant])
    }

    fn carried(medium: &Medium, k: [f64; 2], a: [f64; 2], by: Carried) -> Option<[f64; 2]> {
        let mut total = [0.0; 2];
        for (omega, unit) in medium.plane_waves(k)? {
            let share = (a[0] * unit[0] + a[1] * unit[1]) * turned(omega, by)?;
            total = [total[0] + share * unit[0], total[1] + share * unit[1]];
        }
        Some(total)
    }

    fn polarisation(medium: &Medium, k: [f64; 2], branch: Branch) -> Option<[f64; 2]> {
        Some(medium.plane_waves(k)?[usize::from(branch == Branch::S)].1)
    }
}
