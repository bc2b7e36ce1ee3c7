//! `asks = "reflection"`: what a joint of finite differences and a peridynamic bar sends back.
//!
//! Three answers beside each other: impedances at equal k as published, at equal ω, and the exact scattering.

use super::curve::reference_lattice;
use super::lattice_table::{lattice_row, lattice_table};
use super::sweep::LatticeSweep;
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::dispersion::joint::Chain;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::report::plot::{Axis, Dash, Figure, Lines, Series};
use pd_verify::scene::Wrong;
use pd_verify_reference as reference;
use pd_verify_reference::scattering::{self, Half};
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::PI;

/// The case as written: finite differences on the left, each of these lattices on the right.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReflectionAsked {
    pub right: LatticeSweep,
}

/// The case, checked.
pub struct Reflection {
    title: String,
    lattices: Vec<Lattice>,
}

impl Asked for ReflectionAsked {
    type Question = Reflection;

    fn check(&self, written: &Written<'_>) -> Result<Reflection, Wrong> {
        let lattices = self.right.usable(Body::Bar).map_err(|wrong| wrong.inside("right"))?;
        let most = 40.0;
        if let Some(lattice) = lattices.iter().find(|lattice| lattice.m > most) {
            let message = format!("m = {} makes a scattering problem of too high a degree", lattice.m);
            return Err(Wrong::new("right.m", message, format!("take m up to {most}")));
        }
        Ok(Reflection { title: written.title.to_owned(), lattices })
    }
}

/// kΔx of the finite differences at which the independent scattering is asked.
const JUDGED: [f64; 7] = [0.15, 0.3, 0.5, 0.7, 0.8, 0.9, 0.97];
const POINTS: u32 = 240;

impl Question for Reflection {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        vec![
            claim(place, "exact", "largest error of |R|, finite differences | lattice")
                .at_most(ErrorKind::Absolute, 1e-6)
                .because(Basis::Theory, "the reference's absorbing layers send back less than 1e-6")
                .source("driven finite chain between absorbing layers, solved by elimination: no modes are matched"),
            claim(place, "equal_omega", "largest relative error of the frequency at the wavenumber that equal ω gives")
                .at_most(ErrorKind::Relative, 1e-12)
                .because(Basis::Rounding, "a root of a polynomial of degree m, polished by Newton")
                .source("the reference's lattice frequency at kΔx (1 + R)/(1 − R), which must be that of the differences"),
            claim(place, "equal_k", "largest error of the published coefficient")
                .at_most(ErrorKind::Absolute, 1e-13)
                .because(Basis::Rounding, "a quotient of two frequencies")
                .source("Wildman & Gazonas 2014 (Int. J. Fract. 190, 39), (29), from the reference's frequencies"),
        ]
    }

    fn effort(&self) -> Effort {
        let count = self.lattices.len() as u64;
        let evaluations = count * u64::from(POINTS);
        Effort {
            curves: 3 * count,
            evaluations,
            bond_evaluations: evaluations * 400,
            reference_evaluations: 7 * count,
            ..Effort::default()
        }
    }

    fn equations(&self) -> &'static str {
        "as published: R = (Z₁ − Z₂)/(Z₁ + Z₂), Z = ρω/k, both at the same k; at equal ω: the same Z at the wave's frequency
exactly: nodes n < 0 obey one stencil, n ≥ 0 the other; each side carries its own outgoing and fading modes zⁿ"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let mut table =
            lattice_table("reflection_coefficients.csv", &["k_dx_fd", "equal_k", "equal_omega", "exact"]);
        let left = Chain::finite_differences();
        let (mut figure, mut errors) = (None::<Figure>, Errors::default());
        for &lattice in &self.lattices {
            let Ok(stencil) = subject.bar_stencil(lattice) else {
                return Answer::default();
            };
            let right = Chain::peridynamic(&stencil);
            let exact = |k: f64| subject.reflection(&left, &right, k).map(|found| found.norm());
            let mut curves = [Vec::new(), Vec::new(), Vec::new()];
            for k in (1..POINTS).map(|n| PI * f64::from(n) / f64::from(POINTS)) {
                let answers = [
                    Some(subject.published_reflection(&left, &right, k).abs()),
                    subject.reflection_at_equal_frequency(&left, &right, k).map(f64::abs),
                    exact(k),
                ];
                let own = std::iter::once(k.into()).chain(answers.map(Into::into));
                table.push(lattice_row(&place.case, Body::Bar, lattice, own));
                for (curve, answer) in curves.iter_mut().zip(answers) {
                    curve.extend(answer.map(|r| (k, r)));
                }
            }
            JUDGED.iter().for_each(|&k| errors.add(subject, lattice, (&left, &right), k));
            let panel = panel(lattice, curves);
            figure = Some(match figure {
                None => Figure::new(
                    place.case.clone(),
                    self.title.clone(),
                    "Amplitude that returns to the finite differences, by the incident wave. Impedances at equal ω end where the lattice carries no wave.",
                    panel,
                ),
                Some(figure) => figure.panel(panel),
            });
        }
        let judged =
            |errors: &[f64]| error_of(largest(errors.iter().copied()), format!("{} values", errors.len()));
        let evidence = vec![
            ("exact".to_owned(), judged(&errors.exact)),
            ("equal_omega".to_owned(), judged(&errors.equal_omega)),
            ("equal_k".to_owned(), judged(&errors.equal_k)),
        ];
        let figures = figure.into_iter().map(|figure| figure.columns(2)).collect();
        Answer { evidence, tables: vec![table], figures, ..Answer::default() }
    }
}

/// How far each answer is from the reference's.
#[derive(Default)]
struct Errors {
    exact: Vec<f64>,
    equal_omega: Vec<f64>,
    equal_k: Vec<f64>,
}

impl Errors {
    fn add(&mut self, subject: &dyn Subject, lattice: Lattice, (left, right): (&Chain, &Chain), k: f64) {
        let other = reference_lattice(lattice);
        let incident = 2.0 * libm::sin(0.5 * k);
        if let Some(exact) = scattering::reflection(Half::Fd, Half::Pd(other), incident) {
            let found = subject.reflection(left, right, k).map_or(f64::INFINITY, |found| found.norm());
            self.exact.push((found - exact).abs());
        }
        let at_same_k = reference::lattice::bar(other, k).omega;
        let published = (incident - at_same_k) / (incident + at_same_k);
        self.equal_k.push((subject.published_reflection(left, right, k) - published).abs());
        if let Some(r) = subject.reflection_at_equal_frequency(left, right, k) {
            let transmitted = reference::lattice::bar(other, k * (1.0 + r) / (1.0 - r)).omega;
            self.equal_omega.push((transmitted - incident).abs() / incident);
        }
    }
}

fn panel(lattice: Lattice, [equal_k, equal_omega, exact]: [Vec<(f64, f64)>; 3]) -> Lines {
    let series = vec![
        Series::reference("exact scattering", exact),
        Series::line("impedances, equal ω", equal_omega).dash(Dash::Dashed),
        Series::line("impedances, equal k (published)", equal_k).dash(Dash::Dotted),
    ];
    Lines::new(Axis::linear("kΔx of the incident wave"), Axis::linear("|R|").range(0.0, 1.05), series)
        .titled(lattice.to_string())
}
