//! `asks = "micromodulus"`: c(ξ) of each kernel over that of the constant one, and its constant from energy equivalence.

use super::curve::reference_kernel;
use super::sweep::kernels;
use super::words::KernelName;
use crate::input::OneOrMany;
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest_relative;
use pd_verify::kernel::Kernel;
use pd_verify::material::Body;
use pd_verify::micromodulus::normalised;
use pd_verify::report::plot::{Axis, Figure, Lines, Series};
use pd_verify::scene::{Positive, Wrong};
use pd_verify::table::Table;
use pd_verify_reference as reference;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MicromodulusAsked {
    pub kernel: OneOrMany<KernelName>,
    pub p: Option<OneOrMany<Positive>>,
}

/// The case, checked.
pub struct Micromodulus {
    title: String,
    kernels: Vec<Kernel>,
}

impl Asked for MicromodulusAsked {
    type Question = Micromodulus;

    fn check(&self, written: &Written<'_>) -> Result<Micromodulus, Wrong> {
        Ok(Micromodulus { title: written.title.to_owned(), kernels: kernels(&self.kernel, self.p.as_ref())? })
    }
}

/// An odd body: nothing cancels by chance.
const YOUNGS_MODULUS: f64 = 71.3e9;
const SECTION: f64 = 0.0037;
const HORIZON: f64 = 0.0123;

impl Question for Micromodulus {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        Body::ALL
            .iter()
            .map(|body| {
                claim(place, body.name(), format!("largest relative error of c₀, {}", body.name()))
                    .at_most(ErrorKind::Relative, 1e-13)
                    .because(Basis::Rounding, "closed moments whose terms are all positive")
                    .source("energy equivalence integrated numerically in double-double arithmetic")
            })
            .collect()
    }

    fn effort(&self) -> Effort {
        let count = self.kernels.len() as u64;
        Effort {
            curves: count,
            evaluations: 3 * count,
            bond_evaluations: 3 * count,
            reference_evaluations: 3 * count,
            ..Effort::default()
        }
    }

    fn equations(&self) -> &'static str {
        "C₁₁ = ½ ∫ c(ξ) |ξ| cos⁴θ dV, c = c₀ W(|ξ|/δ)
bar: c₀ = E/(A δ² M₁); plane: c₀ = 8 C₁₁/(3π h δ³ M₂); Mₙ = ∫₀¹ sⁿ W ds"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let mut table = Table::new(
            "micromodulus_constants.csv",
            &["body", "kernel", "p", "c0_over_constant_kernel", "moment"],
        );
        let mut evidence = Vec::new();
        for body in Body::ALL {
            let pairs = self.kernels.iter().map(|&kernel| {
                let computed = subject.micromodulus(body, kernel, YOUNGS_MODULUS, SECTION, HORIZON);
                (computed, exact(body, kernel))
            });
            let pairs: Vec<_> = pairs.collect();
            for (kernel, (computed, _)) in self.kernels.iter().zip(&pairs) {
                let constant = subject.micromodulus(body, Kernel::Constant, YOUNGS_MODULUS, SECTION, HORIZON);
                let moment = kernel.moment(body.dimension() as u32);
                table.push(vec![
                    body.name().into(),
                    kernel.name().into(),
                    kernel.p().into(),
                    (computed / constant).into(),
                    moment.into(),
                ]);
            }
            evidence.push((
                body.name().to_owned(),
                error_of(largest_relative(pairs), format!("{} kernels", self.kernels.len())),
            ));
        }
        Answer { evidence, tables: vec![table], figures: vec![self.figure(place)], ..Answer::default() }
    }
}

fn exact(body: Body, kernel: Kernel) -> f64 {
    let kernel = reference_kernel(kernel);
    match body {
        Body::Bar => reference::micromodulus::bar(kernel, YOUNGS_MODULUS, SECTION, HORIZON),
        Body::PlaneStress => reference::micromodulus::plane_stress(kernel, YOUNGS_MODULUS, SECTION, HORIZON),
        Body::PlaneStrain => reference::micromodulus::plane_strain(kernel, YOUNGS_MODULUS, SECTION, HORIZON),
    }
}

impl Micromodulus {
    fn figure(&self, place: &Place) -> Figure {
        let panel = |body: Body, title: &str| {
            let series = self.kernels.iter().map(|&kernel| {
                let points =
                    (0..=100).map(|n| f64::from(n) / 100.0).map(|s| (s, normalised(body, kernel, s)));
                let ends = [(1.0, 0.0), (1.15, 0.0)];
                Series::line(kernel.to_string(), points.chain(ends).collect())
            });
            let x = Axis::linear("bond length |ξ|/δ");
            Lines::new(x, Axis::linear("c(ξ)/c of the constant kernel"), series.collect()).titled(title)
        };
        Figure::new(
            place.case.clone(),
            self.title.clone(),
            "Micromodulus over that of the constant kernel of the same horizon and elastic moduli.",
            panel(Body::Bar, "Bar"),
        )
        .panel(panel(Body::PlaneStress, "Plane stress and plane strain"))
        .columns(2)
    }
}
