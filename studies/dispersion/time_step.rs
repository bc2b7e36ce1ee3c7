//! `asks = "time_step"`: the sharp limit of leapfrog, 2/ω_max, beside the usual row-sum bound.

use super::curve::reference_lattice;
use super::lattice_table::{lattice_row, lattice_table};
use super::sweep::LatticeSweep;
use super::words::BodyName;
use crate::input::OneOrMany;
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of, value_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest_relative;
use pd_verify::dispersion::timestep::TimeStep as Limits;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::report::plot::{Axis, Figure, Guide, Lines, Series};
use pd_verify::scene::Wrong;
use pd_verify::table::{Cell, Table};
use pd_verify_reference as reference;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeStepAsked {
    pub body: OneOrMany<BodyName>,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct TimeStep {
    title: String,
    asked: Vec<(Body, Lattice)>,
}

/// In the plane the searches cost m⁴; at this m a lattice takes the reference about a second.
const LARGEST_M: f64 = 20.0;

impl Asked for TimeStepAsked {
    type Question = TimeStep;

    fn check(&self, written: &Written<'_>) -> Result<TimeStep, Wrong> {
        let mut asked = Vec::new();
        for &name in &self.body.0 {
            let body = name.into();
            let usable = self.lattice.usable(body).map_err(|wrong| wrong.inside("lattice"))?;
            if let Some(lattice) = usable.iter().find(|lattice| body != Body::Bar && lattice.m > LARGEST_M) {
                let message =
                    format!("m = {} takes the search of the whole zone too long in the plane", lattice.m);
                return Err(Wrong::new("lattice.m", message, format!("take m up to {LARGEST_M}")));
            }
            asked.extend(usable.into_iter().map(|lattice| (body, lattice)));
        }
        Ok(TimeStep { title: written.title.to_owned(), asked })
    }
}

impl Question for TimeStep {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        vec![
            claim(place, "sharp", "largest relative error of 2/ω_max")
                .at_most(ErrorKind::Relative, 2e-10)
                .because(
                    Basis::Theory,
                    "both searches find the maximum of a trigonometric polynomial to 1e-10",
                )
                .source("brute force over the Brillouin zone in an independent code"),
            claim(place, "row_sum", "largest relative error of √(2ρ/Σ cV/|ξ|)")
                .at_most(ErrorKind::Relative, 1e-13)
                .because(Basis::Rounding, "one sum of the weights")
                .source(
                    "Silling & Askari 2005, Comput. Struct. 83, 1526; summed in double-double arithmetic",
                ),
            claim(place, "row_sum_is_safe", "smallest sharp limit over row-sum bound")
                .at_least(1.0 - 1e-14)
                .because(Basis::Theory, "Gershgorin: ω_max² ≤ 2Σw/ρ for positive weights; 1e-14 for rounding, as one bond attains it")
                .source("Gershgorin's theorem"),
        ]
    }

    fn effort(&self) -> Effort {
        let work = |&(body, lattice): &(Body, Lattice)| match body {
            Body::Bar => 8.0 * lattice.m * lattice.m,
            Body::PlaneStress | Body::PlaneStrain => {
                (32.0 * lattice.m * lattice.m + 2000.0) * 1.6 * lattice.m * lattice.m
            }
        };
        let visited: f64 = self.asked.iter().map(work).sum();
        let count = self.asked.len() as u64;
        Effort {
            curves: count,
            evaluations: count,
            bond_evaluations: visited as u64,
            reference_evaluations: count,
            ..Effort::default()
        }
    }

    fn equations(&self) -> &'static str {
        "leapfrog: sin²(ωΔt/2) = Δt² Ω²/4, hence Δt ≤ 2/Ω_max; row sum: Δt ≤ √(2ρ/Σ cV/|ξ|), sufficient and smaller"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let found: Vec<Option<(Limits, [f64; 2])>> =
            self.asked.par_iter().map(|&(body, lattice)| limits(subject, body, lattice)).collect();
        let complete = found.iter().all(Option::is_some);
        let judged = || found.iter().flatten();
        let worst = |n: usize, of: fn(&Limits) -> f64| {
            let error = complete
                .then(|| largest_relative(judged().map(|(mine, exact)| (of(mine), exact[n]))))
                .flatten();
            error_of(error, format!("{} lattices", self.asked.len()))
        };
        let ratios = judged().map(|(mine, _)| mine.sharp / mine.row_sum);
        let safest = ratios.reduce(f64::min).filter(|_| complete);
        let evidence = vec![
            ("sharp".into(), worst(0, |mine| mine.sharp)),
            ("row_sum".into(), worst(1, |mine| mine.row_sum)),
            ("row_sum_is_safe".into(), value_of(safest, None, "")),
        ];
        Answer {
            evidence,
            tables: vec![self.table(&found, place)],
            figures: vec![self.figure(&found, place)],
            ..Answer::default()
        }
    }
}

fn limits(subject: &dyn Subject, body: Body, lattice: Lattice) -> Option<(Limits, [f64; 2])> {
    let of = reference_lattice(lattice);
    if body == Body::Bar {
        let mine = subject.bar_time_step(&subject.bar_stencil(lattice).ok()?);
        return Some((
            mine,
            [2.0 / reference::lattice::bar_highest(of), reference::lattice::bar_row_sum(of)],
        ));
    }
    let mine = subject.plane_time_step(&subject.plane_stencil(lattice).ok()?);
    Some((mine, [2.0 / reference::lattice::plane_highest(of), reference::lattice::plane_row_sum(of)]))
}

impl TimeStep {
    fn table(&self, found: &[Option<(Limits, [f64; 2])>], place: &Place) -> Table {
        let columns = [
            "sharp_c_dt_over_dx",
            "row_sum_c_dt_over_dx",
            "sharp_over_row_sum",
            "kx_dx_at_limit",
            "ky_dx_at_limit",
        ];
        let mut table = lattice_table("timestep.csv", &columns);
        for (&(body, lattice), found) in self.asked.iter().zip(found) {
            let limits = found.as_ref().map(|(limits, _)| limits);
            let own: [Cell; 5] = [
                limits.map(|l| l.sharp).into(),
                limits.map(|l| l.row_sum).into(),
                limits.map(|l| l.sharp / l.row_sum).into(),
                limits.map(|l| l.at[0]).into(),
                limits.and_then(|l| l.at.get(1).copied()).into(),
            ];
            table.push(lattice_row(&place.case, body, lattice, own));
        }
        table
    }

    fn figure(&self, found: &[Option<(Limits, [f64; 2])>], place: &Place) -> Figure {
        let mut figure = Figure::new(
            place.case.clone(),
            self.title.clone(),
            "Largest stable time step of leapfrog, 2/ω_max, over the usual bound √(2ρ/Σ cV/|ξ|).",
            Lines::default(),
        );
        figure.panels.clear();
        for body in [Body::Bar, Body::PlaneStress] {
            let mut series: Vec<Series> = Vec::new();
            for (&(of, lattice), found) in self.asked.iter().zip(found) {
                let Some((limits, _)) = found.as_ref().filter(|_| of == body) else { continue };
                let calibrated = if lattice.calibrated { ", calibrated" } else { "" };
                let label = format!("{}, {}{calibrated}", lattice.kernel, lattice.volume_rule.name());
                let point = (lattice.m, limits.sharp / limits.row_sum);
                match series.iter_mut().find(|series| series.label == label) {
                    Some(series) => series.points.push(point),
                    None => series.push(Series::both(label, vec![point])),
                }
            }
            if series.is_empty() {
                continue;
            }
            let title = if body == Body::Bar { "Bar" } else { "Plane" };
            let panel = Lines::new(
                Axis::linear("m = δ/Δx"),
                Axis::linear("sharp limit / row-sum bound").including(1.0),
                series,
            )
            .titled(title)
            .guide(Guide::Horizontal { at: 1.0, label: "row-sum bound".into() });
            figure = figure.panel(panel);
        }
        figure.columns(2)
    }
}
