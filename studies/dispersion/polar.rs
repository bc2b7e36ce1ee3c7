//! `asks = "polar"`: phase-speed error over the direction of travel, P and S, at a given number of nodes per wave.

use super::curve::{Curve, Medium};
use super::label::labels;
use super::sweep::LatticeSweep;
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::dispersion::Branch;
use pd_verify::material::Body;
use pd_verify::report::plot::{Axis, Figure, Polar as PolarPanel, Series};
use pd_verify::scene::{Positive, Wrong};
use pd_verify::table::Table;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::TAU;

/// The case as written; plane stress and plane strain have the same answer.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PolarAsked {
    /// Wavelength over Δx, above 2.
    pub nodes_per_wavelength: Positive,
    pub lattice: LatticeSweep,
    /// Whether finite differences are drawn beside.
    pub finite_differences: Option<bool>,
}

/// The case, checked.
pub struct Polar {
    title: String,
    nodes_per_wavelength: f64,
    media: Vec<Medium>,
}

impl Asked for PolarAsked {
    type Question = Polar;

    fn check(&self, written: &Written<'_>) -> Result<Polar, Wrong> {
        if self.nodes_per_wavelength.0 <= 2.0 {
            let message =
                format!("{} nodes per wavelength are no wave on a grid", self.nodes_per_wavelength.0);
            return Err(Wrong::new("nodes_per_wavelength", message, "take more than 2, for example 10"));
        }
        let lattices = self.lattice.usable(Body::PlaneStress).map_err(|wrong| wrong.inside("lattice"))?;
        let mut media: Vec<Medium> =
            lattices.into_iter().map(|lattice| Medium::Lattice { lattice, dx: 1.0 }).collect();
        if self.finite_differences == Some(true) {
            media.push(Medium::FiniteDifferences { dx: 1.0 });
        }
        Ok(Polar {
            title: written.title.to_owned(),
            nodes_per_wavelength: self.nodes_per_wavelength.0,
            media,
        })
    }
}

const STEP: u32 = 3;

fn curve(medium: Medium, branch: Branch, degrees: f64) -> Curve {
    Curve { body: Body::PlaneStress, medium, courant: None, branch, degrees }
}

impl Question for Polar {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        vec![
            claim(place, "phase_speed", "largest error of the phase speed over c, every 15° of the circle")
                .at_most(ErrorKind::Absolute, 1e-13)
                .because(Basis::Rounding, "a 2×2 eigenvalue of a sum of positive terms")
                .source("the same matrix summed in double-double arithmetic"),
        ]
    }

    fn effort(&self) -> Effort {
        let curves = 2 * self.media.len() as u64;
        let evaluations = curves * u64::from(360 / STEP + 1);
        Effort {
            curves,
            evaluations,
            bond_evaluations: evaluations * 40,
            reference_evaluations: curves * 24,
            ..Effort::default()
        }
    }

    fn equations(&self) -> &'static str {
        "eigenvalues of Σ w n⊗n 4 sin²(k·ξ/2) over c²k², k = 2π/λ (cos θ, sin θ)"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let asked: Vec<(Branch, Medium)> = [Branch::P, Branch::S]
            .into_iter()
            .flat_map(|branch| self.media.iter().map(move |&m| (branch, m)))
            .collect();
        let traced: Vec<(Vec<(f64, f64)>, f64)> =
            asked.par_iter().map(|&(branch, medium)| self.trace(subject, branch, medium)).collect();
        let names =
            labels(&self.media.iter().map(|&medium| curve(medium, Branch::P, 0.0)).collect::<Vec<_>>());
        let mut table = Table::new(
            "polar_phase_error.csv",
            &["case", "branch", "medium", "k_dx", "angle_deg", "phase_speed_error_percent"],
        );
        let mut panels = [Vec::new(), Vec::new()];
        for (index, ((branch, _), (points, _))) in asked.iter().zip(&traced).enumerate() {
            let name = &names[index % self.media.len()];
            for &(degrees, error) in points {
                table.push(vec![
                    place.case.clone().into(),
                    branch.name().into(),
                    name.clone().into(),
                    self.k_dx().into(),
                    degrees.into(),
                    error.into(),
                ]);
            }
            panels[usize::from(*branch == Branch::S)].push(Series::line(name.clone(), points.clone()));
        }
        let [p, s] = panels;
        let errors = || {
            traced
                .iter()
                .flat_map(|(points, _)| points)
                .map(|point| point.1)
                .filter(|error| error.is_finite())
        };
        let radial = || errors().fold(Axis::linear("phase-speed error (%)").including(0.0), Axis::including);
        let title = format!("{}, {} nodes per wavelength", self.title, self.nodes_per_wavelength);
        let figure = Figure::new(
            place.case.clone(),
            title,
            "Error of the phase speed against that of the local continuum, by direction of travel; the heavy circle is zero.",
            PolarPanel::new(radial(), p).titled("P waves (heavy circle: no error)"),
        )
        .panel(PolarPanel::new(radial(), s).titled("S waves (heavy circle: no error)"))
        .columns(2);
        let error = largest(traced.iter().map(|(_, error)| *error));
        let evidence = vec![("phase_speed".into(), error_of(error, format!("{} curves", traced.len())))];
        Answer { evidence, tables: vec![table], figures: vec![figure], ..Answer::default() }
    }
}

impl Polar {
    fn k_dx(&self) -> f64 {
        TAU / self.nodes_per_wavelength
    }

    /// Phase error in percent by direction, and the largest difference of the phase speed from the reference's.
    fn trace(&self, subject: &dyn Subject, branch: Branch, medium: Medium) -> (Vec<(f64, f64)>, f64) {
        let speed = |degrees: f64| {
            let prepared = curve(medium, branch, degrees).prepare(subject).ok()?;
            prepared.wave(self.k_dx()).map(|wave| wave.phase(self.k_dx()))
        };
        let points = (0..=360 / STEP)
            .map(|n| f64::from(n * STEP))
            .map(|degrees| (degrees, speed(degrees).map_or(f64::NAN, |speed| 100.0 * (speed - 1.0))));
        let differences = (0..24).map(|n| 15.0 * f64::from(n)).map(|degrees| {
            let exact =
                curve(medium, branch, degrees).reference(self.k_dx()).map(|wave| wave.phase(self.k_dx()));
            speed(degrees).zip(exact).map_or(f64::NAN, |(mine, exact)| (mine - exact).abs())
        });
        (points.collect(), largest(differences).unwrap_or(f64::NAN))
    }
}
