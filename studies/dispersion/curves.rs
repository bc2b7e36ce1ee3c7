//! `asks = "curves"`: dispersion curves, their phase error against classical waves, and where it passes 1 % and 5 %.

use super::curve::{Curve, Medium};
use super::curve_report;
use super::curve_sweep::CurveSweep;
use super::foreign::ForeignCurve;
use super::label::labels;
use super::sweep::family_size;
use super::trace::{JUDGED, LeftOut, SEARCH, Traced, trace};
use super::wavenumbers::Wavenumbers;
use super::words::BodyName;
use crate::foreign::Foreign;
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::dispersion::continuum::panels;
use pd_verify::material::Material;
use pd_verify::scene::Wrong;
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CurvesAsked {
    pub body: BodyName,
    pub wavenumbers: Wavenumbers,
    /// Each entry is a sweep; all its combinations are drawn.
    pub curve: Vec<CurveSweep>,
}

/// The case, checked.
pub struct Curves {
    pub title: String,
    pub curves: Vec<Curve>,
    /// What distinguishes each curve from the others.
    pub labels: Vec<String>,
    wavenumbers: Wavenumbers,
    material: Option<Material>,
}

/// Rows that a case may write.
const MAX_ROWS: u64 = 1_000_000;

impl Asked for CurvesAsked {
    type Question = Curves;

    /// Every combination as a curve, or what is wrong.
    fn check(&self, written: &Written<'_>) -> Result<Curves, Wrong> {
        self.wavenumbers.check().map_err(|wrong| wrong.inside("wavenumbers"))?;
        let mut curves = Vec::new();
        for (index, sweep) in self.curve.iter().enumerate() {
            let found = sweep.curves(self.body.into(), written.material);
            curves.extend(found.map_err(|wrong| wrong.inside(&format!("curve[{index}]")))?);
        }
        let rows = (curves.len() as u64).saturating_mul(self.wavenumbers.count());
        if rows == 0 {
            return Err(Wrong::new("curve", "no curve is asked for", "add a [[case.curve]] table"));
        }
        if rows > MAX_ROWS {
            let message = format!("{rows} rows are asked for, at most {MAX_ROWS} are written by a case");
            return Err(Wrong::new(
                "wavenumbers",
                message,
                "fewer wavenumbers, or shorter lists in the sweeps",
            ));
        }
        for curve in &curves {
            self.wavenumbers.check_for(curve).map_err(|wrong| wrong.inside("wavenumbers"))?;
        }
        let labels = labels(&curves);
        Ok(Curves {
            title: written.title.to_owned(),
            curves,
            labels,
            wavenumbers: self.wavenumbers.clone(),
            material: written.material,
        })
    }
}

impl Question for Curves {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let about = |name, quantity: &str, kind| {
            claim(place, name, quantity).at_most(kind, 1e-13).source(
                "the defining sums and integrals evaluated term by term in double-double arithmetic (31 digits)",
            )
        };
        let mut claims = Vec::new();
        if self.any(|curve| matches!(curve.medium, Medium::Continuum { .. })) {
            claims.push(
                about("continuum", "largest relative error of ω(k), continuum", ErrorKind::Relative)
                    .because(Basis::Rounding, "quadrature of a positive integrand keeps its digits"),
            );
        }
        if self.any(|curve| !matches!(curve.medium, Medium::Continuum { .. })) {
            claims.push(
                about(
                    "grid",
                    "largest |Δω|/(|ω| + |k ∂ω/∂k|), lattices and finite differences",
                    ErrorKind::LinfRelative,
                )
                .because(Basis::Rounding, "rounding of k alone moves ω by k ∂ω/∂k times the unit roundoff"),
            );
        }
        claims.push(
            claim(place, "group_velocity", "largest error of dω/dk over c")
                .at_most(ErrorKind::Absolute, 1e-10)
                .because(Basis::Rounding, "dω/dk divides by ω and, near leapfrog's limit, by √(1 − (ωΔt/2)²)")
                .source("derivative of the same sums in double-double arithmetic"),
        );
        claims.push(
            claim(
                place,
                "first_wavenumber",
                "largest |phase error − threshold| at the first k beyond 1 % and 5 %",
            )
            .at_most(ErrorKind::Absolute, 1e-10)
            .because(
                Basis::Rounding,
                "bisection ends at neighbouring doubles; the error's slope does the rest",
            )
            .source("phase speed of the reference at the wavenumber reported, and at eight smaller ones"),
        );
        claims
    }

    fn effort(&self) -> Effort {
        let evaluations = self.wavenumbers.count().saturating_add(2 * u64::from(SEARCH));
        let mut effort = Effort { curves: self.curves.len() as u64, ..Effort::default() };
        for curve in &self.curves {
            effort += Effort {
                evaluations,
                bond_evaluations: evaluations.saturating_mul(visits(curve, self.wavenumbers.largest(curve))),
                reference_evaluations: JUDGED as u64 + 34,
                ..Effort::default()
            };
        }
        effort
    }

    fn equations(&self) -> &'static str {
        "bar, continuum: (ωδ/v)² = (2/M₁) ∫₀¹ W(s) (1 − cos kδs)/s ds, Mₙ = ∫₀¹ sⁿ W ds
bar, lattice: (ωΔx/v)² = Σ_{j>0} w_j 4 sin²(jkΔx/2), w_j = W(j/m) β_j/(m² M₁ j)
plane, continuum: (ωδ/c_d)² = (8/3M₂) ∫₀¹ W (1 − 2J₀ + 2J₁/x) ds; (ωδ/c_s)² = (8/M₂) ∫₀¹ W (1 − 2J₁/x) ds, x = kδs
plane, lattice: eigenvalues of Σ w n⊗n 4 sin²(k·ξ/2), w = 8 W β/(3π m³ M₂ |ξ|/Δx)
leapfrog: sin(ωΔt/2) = ΩΔt/2, Ω the frequency in exact time"
    }

    fn foreign(&self) -> Vec<Box<dyn Foreign + '_>> {
        let name = |index: usize| match self.labels[index].as_str() {
            "" => format!("curve {}", index + 1),
            label => label.to_owned(),
        };
        let all = self.curves.iter().enumerate().map(|(index, curve)| -> Box<dyn Foreign + '_> {
            let others = self.curves.iter().enumerate().filter(|(other, _)| *other != index);
            Box::new(ForeignCurve {
                title: &self.title,
                name: name(index),
                curve: *curve,
                others: others.map(|(other, curve)| (name(other), *curve)).collect(),
                material: self.material,
                largest: self.wavenumbers.largest(curve),
            })
        });
        all.collect()
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let follow = |curve: &Curve| trace(curve, self.wavenumbers.of(curve), subject);
        let Some(traced) = self.curves.par_iter().map(follow).collect::<Option<Vec<Traced>>>() else {
            return Answer::default();
        };
        Answer {
            evidence: self.evidence(&traced),
            tables: curve_report::tables(self, &traced, place),
            figures: curve_report::figures(self, &traced, place),
            ..Answer::default()
        }
    }
}

impl Curves {
    fn any(&self, f: impl Fn(&Curve) -> bool) -> bool {
        self.curves.iter().any(f)
    }

    fn evidence(&self, traced: &[Traced]) -> Vec<(String, Evidence)> {
        let omega = |continuum: bool| {
            let pairs = self.curves.iter().zip(traced);
            let mine: Vec<&Traced> = pairs
                .filter(|(curve, _)| matches!(curve.medium, Medium::Continuum { .. }) == continuum)
                .map(|(_, traced)| traced)
                .collect();
            let mut left_out = LeftOut::default();
            mine.iter().for_each(|traced| left_out += traced.left_out);
            let errors: Vec<f64> =
                mine.iter().flat_map(|traced| traced.omega_errors.iter().copied()).collect();
            error_of(
                largest(errors.iter().copied()),
                format!("{} wavenumbers judged{left_out}", errors.len()),
            )
        };
        let group = largest(traced.iter().flat_map(|t| t.group_errors.iter().copied()));
        let first = largest(traced.iter().flat_map(|t| t.first_errors.iter().copied()));
        let passed = traced.iter().flat_map(|t| t.first).filter(Option::is_some).count();
        let none = 2 * traced.len() - passed;
        vec![
            ("continuum".into(), omega(true)),
            ("grid".into(), omega(false)),
            ("group_velocity".into(), error_of(group, "")),
            (
                "first_wavenumber".into(),
                error_of(first, format!("{passed} crossings, {none} curves never cross")),
            ),
        ]
    }
}

/// Bonds, or quadrature points, that one evaluation at k visits.
fn visits(curve: &Curve, k: f64) -> u64 {
    match (curve.medium, curve.body) {
        (Medium::Continuum { kernel, .. }, _) => {
            42_u64.saturating_mul(panels(kernel, k * curve.unit()) as u64)
        }
        (Medium::Lattice { lattice, .. }, body) => family_size(body, lattice),
        (Medium::FiniteDifferences { .. }, _) => 1,
    }
}
