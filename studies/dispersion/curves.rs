//! `asks = "curves"`: dispersion curves, their phase error against classical waves, and where it passes 1 % and 5 %.

use super::curve::{Curve, Medium, Prepared};
use super::curve_report;
use super::label::labels;
use super::sweep::{CurveSweep, Wrong};
use super::wavenumbers::Wavenumbers;
use super::words::BodyName;
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of};
use crate::subject::Subject;
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::dispersion::Wave;
use pd_verify::family::half_family;
use pd_verify::material::{Body, Material};
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
}

/// Rows that a case may write.
const MAX_ROWS: u64 = 1_000_000;
/// Wavenumbers at which the reference is asked, spread over each curve.
const JUDGED: usize = 16;
/// Phase errors whose first wavenumber is reported.
const THRESHOLDS: [f64; 2] = [0.01, 0.05];

impl CurvesAsked {
    /// Every combination as a curve, or what is wrong.
    pub fn check(&self, title: &str, material: Option<Material>) -> Result<Curves, Wrong> {
        self.wavenumbers.check().map_err(|wrong| wrong.inside("wavenumbers"))?;
        let mut curves = Vec::new();
        for (index, sweep) in self.curve.iter().enumerate() {
            let found = sweep.curves(self.body.into(), material);
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
        let labels = labels(&curves);
        Ok(Curves { title: title.to_owned(), curves, labels, wavenumbers: self.wavenumbers.clone() })
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
        let per_curve = self.wavenumbers.count() + 600;
        let mut effort = Effort { curves: self.curves.len() as u64, ..Effort::default() };
        for curve in &self.curves {
            effort += Effort {
                evaluations: per_curve,
                bond_evaluations: per_curve.saturating_mul(visits(curve)),
                reference_evaluations: JUDGED as u64 + 18,
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

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let traced: Vec<Traced> = self.curves.par_iter().map(|curve| self.trace(curve, subject)).collect();
        Answer {
            evidence: self.evidence(&traced),
            tables: curve_report::tables(self, &traced, place),
            figures: curve_report::figures(self, &traced, place),
        }
    }
}

/// What was found along one curve.
pub struct Traced {
    /// k in 1/m, and ω/c in 1/m with the group velocity over c; `None` where the scheme is unstable.
    pub points: Vec<(f64, Option<Wave>)>,
    /// Scaled error of ω where the reference was asked.
    omega_errors: Vec<f64>,
    group_errors: Vec<f64>,
    /// First k whose phase error passes each threshold.
    pub first: [Option<f64>; 2],
    first_errors: Vec<f64>,
    beyond_reference: usize,
}

impl Curves {
    fn any(&self, f: impl Fn(&Curve) -> bool) -> bool {
        self.curves.iter().any(f)
    }

    fn trace(&self, curve: &Curve, subject: &dyn Subject) -> Traced {
        let prepared = curve.prepare(subject).expect("every lattice was checked when the study was read");
        let points: Vec<_> = self.wavenumbers.of(curve).into_iter().map(|k| (k, prepared.wave(k))).collect();
        let mut traced = Traced {
            omega_errors: Vec::new(),
            group_errors: Vec::new(),
            first: THRESHOLDS.map(|threshold| first_beyond(&prepared, curve, threshold)),
            first_errors: Vec::new(),
            beyond_reference: 0,
            points,
        };
        let stride = traced.points.len().div_ceil(JUDGED).max(1);
        let last = traced.points.len() - 1;
        for (index, &(k, wave)) in traced.points.iter().enumerate() {
            if k > 0.0 && (index % stride == stride - 1 || index == last) {
                match (wave, curve.reference(k)) {
                    (Some(wave), Some(exact)) => {
                        traced.omega_errors.push(scaled_error(curve, k, wave, exact));
                        traced.group_errors.push((wave.group - exact.group).abs());
                    }
                    (None, None) => {}
                    (Some(_), None) if within_reference(curve, k) => traced.omega_errors.push(f64::INFINITY),
                    (Some(_), None) => traced.beyond_reference += 1,
                    (None, Some(_)) => traced.omega_errors.push(f64::INFINITY),
                }
            }
        }
        for (first, threshold) in traced.first.into_iter().zip(THRESHOLDS) {
            traced.first_errors.extend(first.and_then(|k| judge_first(curve, k, threshold)));
        }
        traced
    }

    fn evidence(&self, traced: &[Traced]) -> Vec<(String, Evidence)> {
        let select = |continuum: bool| {
            let mine = self
                .curves
                .iter()
                .zip(traced)
                .filter(move |(curve, _)| matches!(curve.medium, Medium::Continuum { .. }) == continuum);
            let judged: usize = mine.clone().map(|(_, traced)| traced.omega_errors.len()).sum();
            let beyond: usize = mine.clone().map(|(_, traced)| traced.beyond_reference).sum();
            let error = largest(mine.flat_map(|(_, traced)| traced.omega_errors.iter().copied()));
            let beyond =
                if beyond > 0 { format!(", {beyond} beyond the reference left out") } else { String::new() };
            error_of(error, format!("{judged} wavenumbers judged{beyond}"))
        };
        let group = largest(traced.iter().flat_map(|t| t.group_errors.iter().copied()));
        let first = largest(traced.iter().flat_map(|t| t.first_errors.iter().copied()));
        let passed = traced.iter().flat_map(|t| t.first).filter(Option::is_some).count();
        vec![
            ("continuum".into(), select(true)),
            ("grid".into(), select(false)),
            ("group_velocity".into(), error_of(group, "")),
            ("first_wavenumber".into(), error_of(first, format!("{passed} crossings reported"))),
        ]
    }
}

/// |Δω|/|ω| in the continuum, |Δω|/(|ω| + |k ∂ω/∂k|) on a grid.
pub fn scaled_error(curve: &Curve, k: f64, wave: Wave, exact: Wave) -> f64 {
    let rounding_of_k =
        if matches!(curve.medium, Medium::Continuum { .. }) { 0.0 } else { (k * exact.group).abs() };
    (wave.omega - exact.omega).abs() / (exact.omega.abs() + rounding_of_k)
}

/// Whether a missing answer of the reference means that the scheme is unstable there.
fn within_reference(curve: &Curve, k: f64) -> bool {
    match (curve.medium, curve.body) {
        (Medium::Continuum { .. }, Body::Bar) => {
            k * curve.unit() <= pd_verify_reference::continuum::BAR_LIMIT
        }
        (Medium::Continuum { .. }, _) => k * curve.unit() <= pd_verify_reference::continuum::PLANE_LIMIT,
        _ => true,
    }
}

/// Bonds, or quadrature points, that one evaluation visits.
fn visits(curve: &Curve) -> u64 {
    match (curve.lattice(), curve.body) {
        (Some(lattice), Body::Bar) => half_family::<1>(lattice.m, lattice.volume_rule).len() as u64,
        (Some(lattice), _) => half_family::<2>(lattice.m, lattice.volume_rule).len() as u64,
        (None, _) if matches!(curve.medium, Medium::Continuum { .. }) => 42,
        (None, _) => 1,
    }
}

/// Steps of the search for the first crossing.
const SEARCH: u32 = 512;

/// First k at which |phase error| passes the threshold; 0 where long waves are beyond it already.
fn first_beyond(prepared: &Prepared<'_>, curve: &Curve, threshold: f64) -> Option<f64> {
    let end = search_end(curve);
    let beyond = |k: f64| prepared.wave(k).is_some_and(|wave| (wave.phase(k) - 1.0).abs() > threshold);
    if beyond(1e-6 * end) {
        return Some(0.0);
    }
    let step = end / f64::from(SEARCH);
    let found = (1..=SEARCH).find(|&n| beyond(f64::from(n) * step))?;
    let (mut within, mut outside) = (f64::from(found - 1) * step, f64::from(found) * step);
    loop {
        let middle = 0.5 * (within + outside);
        if middle <= within || middle >= outside {
            return Some(outside);
        }
        if beyond(middle) { outside = middle } else { within = middle }
    }
}

/// The zone's edge of a grid; in the continuum far beyond any crossing.
fn search_end(curve: &Curve) -> f64 {
    curve
        .zone_edge()
        .unwrap_or_else(|| 10.0 * curve.kernel().and_then(|k| k.p()).unwrap_or(1.0).max(1.0) / curve.unit())
}

/// How far the reference is from the threshold at k; infinite where a smaller k passes it already.
fn judge_first(curve: &Curve, k: f64, threshold: f64) -> Option<f64> {
    let error = |k: f64| curve.reference(k).map(|wave| (wave.phase(k) - 1.0).abs());
    if k == 0.0 {
        let long_wave = error(1e-6 * search_end(curve))?;
        return Some(if long_wave > threshold { 0.0 } else { f64::INFINITY });
    }
    let before =
        (1..=8).map(|n| k * f64::from(n) / 8.2).all(|k| error(k).is_some_and(|error| error <= threshold));
    if before { Some((error(k)? - threshold).abs()) } else { Some(f64::INFINITY) }
}
