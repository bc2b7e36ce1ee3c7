//! `asks = "small_p"`: Gaussian and exponential kernels become the constant one as p → 0, without losing digits.

use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest_relative;
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::dispersion::{Branch, plane::PlaneDispersion};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::Wrong;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written: it has no parameters.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SmallPAsked {}

/// The case.
pub struct SmallP;

impl Asked for SmallPAsked {
    type Question = SmallP;

    fn check(&self, _: &Written<'_>) -> Result<SmallP, Wrong> {
        Ok(SmallP)
    }
}

/// The relative change from the constant kernel is of the order of `distance`: p² Gaussian, p exponential.
const LIMITS: [(&str, Kernel); 2] =
    [("gaussian", Kernel::Gaussian { p: 1e-8 }), ("exponential", Kernel::Exponential { p: 1e-16 })];

impl Question for SmallP {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        LIMITS
            .iter()
            .map(|(name, kernel)| {
                let quantity = format!(
                    "largest relative difference between {kernel} and constant: c₀, continuum, lattices"
                );
                claim(place, name, quantity)
                    .at_most(ErrorKind::Relative, 1e-14)
                    .because(
                        Basis::Rounding,
                        "the kernels differ by 1e-16; the printed factor p²/(1 − e^(−p²)) is 0/0 there",
                    )
                    .source("the limit p → 0 of the kernel")
            })
            .collect()
    }

    fn effort(&self) -> Effort {
        Effort { curves: 4, evaluations: 66, bond_evaluations: 66 * 42, ..Effort::default() }
    }

    fn equations(&self) -> &'static str {
        "exp(−(pξ/δ)²) → 1, exp(−pξ/δ) → 1 as p → 0"
    }

    fn answer(&self, subject: &dyn Subject, _: &Place) -> Answer {
        let constant = numbers(subject, Kernel::Constant);
        let evidence = LIMITS.iter().map(|(name, kernel)| {
            let error = constant.as_ref().zip(numbers(subject, *kernel)).and_then(|(constant, limit)| {
                largest_relative(limit.into_iter().zip(constant.iter().copied()))
            });
            ((*name).into(), error_of(error, "11 wavenumbers, m = 3"))
        });
        Answer { evidence: evidence.collect(), ..Answer::default() }
    }
}

/// Everything that depends on the kernel, in one list.
fn numbers(subject: &dyn Subject, kernel: Kernel) -> Option<Vec<f64>> {
    let lattice = Lattice { kernel, m: 3.0, volume_rule: VolumeRule::Linear, calibrated: false };
    let bar = BarDispersion::new(&subject.bar_stencil(lattice).ok()?);
    let plane = PlaneDispersion::new(&subject.plane_stencil(lattice).ok()?);
    let mut all: Vec<f64> =
        Body::ALL.iter().map(|&body| subject.micromodulus(body, kernel, 1.0, 1.0, 1.0)).collect();
    for n in 1..=11 {
        let x = 0.27 * f64::from(n);
        all.push(subject.continuum_bar(kernel, x).omega);
        all.push(subject.bar_wave(&bar, x).omega);
        for branch in [Branch::P, Branch::S] {
            all.push(subject.continuum_plane(kernel, branch, x).omega);
            all.push(subject.plane_wave(&plane, x, 20.0, branch).omega);
        }
    }
    Some(all)
}
