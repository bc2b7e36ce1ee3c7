//! `asks = "reflection"`: what a joint of finite differences and a peridynamic bar sends back.
//!
//! Three answers beside each other: impedances at equal k as published, at equal ω, and the exact scattering.

use super::curve::reference_lattice;
use super::lattice_table::{lattice_row, lattice_table};
use super::sweep::{LatticeSweep, Wrong};
use super::symmetry::all_usable;
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of, value_of};
use crate::subject::Subject;
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::dispersion::joint::{Chain, cut_off, impedances_at_equal_frequency};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::material::Body;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::report::plot::{Axis, Dash, Figure, Lines, Series};
use pd_verify::verdict::Evidence;
use pd_verify_reference::oracles;
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

impl ReflectionAsked {
    pub fn check(&self, title: &str) -> Result<Reflection, Wrong> {
        let usable = self.right.lattices().and_then(|all| all_usable(Body::Bar, all));
        let lattices = usable.map_err(|wrong| wrong.inside("right"))?;
        let most = 40.0;
        if let Some(lattice) = lattices.iter().find(|lattice| lattice.m > most) {
            let message = format!("m = {} makes a scattering problem of too high a degree", lattice.m);
            return Err(Wrong::new("right.m", message, format!("take m up to {most}")));
        }
        Ok(Reflection { title: title.to_owned(), lattices })
    }
}

/// The joint whose reflections are printed.
fn known() -> Lattice {
    Lattice { kernel: Kernel::Constant, m: 3.0, volume_rule: VolumeRule::Linear, calibrated: false }
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
            claim(place, "printed_values", "largest error of |R| at kΔx = 0.5, 0.8, 1.0, m = 3, in half units of the last digit")
                .at_most(ErrorKind::Absolute, 1.0 + 1e-9)
                .because(Basis::Rounding, "a printed number stands for half a unit in its last digit")
                .source("printed values of an independent derivation (reference/data/published_values.csv)"),
            claim(place, "cut_off", "ωΔx/v above which everything comes back, m = 3")
                .within(ErrorKind::Absolute, 1e-12)
                .because(Basis::Rounding, "the maximum of a trigonometric polynomial of degree 3, at kΔx = π")
                .source("ω(π) of the constant kernel with half end volumes, m = 3: √(28/27)"),
            claim(place, "total", "largest |1 − |R|| above the cut-off, m = 3")
                .at_most(ErrorKind::Absolute, 1e-10)
                .because(Basis::Theory, "one travelling wave on the left and none on the right carry no energy away")
                .source("conservation: no wave of the right chain has this frequency"),
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
        let (mut figure, mut errors) = (None::<Figure>, Vec::new());
        for &lattice in &self.lattices {
            let Ok(stencil) = subject.bar_stencil(lattice) else { continue };
            let right = Chain::peridynamic(&stencil);
            let exact = |k: f64| subject.reflection(&left, &right, k).map(|found| found.amplitude());
            let mut curves = [Vec::new(), Vec::new(), Vec::new()];
            for k in (1..POINTS).map(|n| PI * f64::from(n) / f64::from(POINTS)) {
                let answers = [
                    Some(subject.published_reflection(&left, &right, k).abs()),
                    impedances_at_equal_frequency(&left, &right, k).map(f64::abs),
                    exact(k),
                ];
                let own = std::iter::once(k.into()).chain(answers.map(Into::into));
                table.push(lattice_row(&place.case, Body::Bar, lattice, own));
                for (curve, answer) in curves.iter_mut().zip(answers) {
                    curve.extend(answer.map(|r| (k, r)));
                }
            }
            errors.extend(JUDGED.iter().filter_map(|&k| compare(lattice, &left, k, exact(k))));
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
        let judged = format!("{} wavenumbers judged", errors.len());
        let mut evidence = vec![("exact".to_owned(), error_of(largest(errors), judged))];
        evidence.extend(known_answers(subject));
        let figures = figure.into_iter().map(|figure| figure.columns(2)).collect();
        Answer { evidence, tables: vec![table], figures }
    }
}

/// |Δ|R|| where the independent solution exists; infinite where only this one is missing.
fn compare(lattice: Lattice, left: &Chain, k: f64, found: Option<f64>) -> Option<f64> {
    let exact = scattering::reflection(Half::Fd, Half::Pd(reference_lattice(lattice)), left.frequency(k))?;
    Some(found.map_or(f64::INFINITY, |found| (found - exact).abs()))
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

fn known_answers(subject: &dyn Subject) -> Vec<(String, Evidence)> {
    let left = Chain::finite_differences();
    let right: Option<(Stencil<1>, Chain)> =
        subject.bar_stencil(known()).ok().map(|stencil| (stencil.clone(), Chain::peridynamic(&stencil)));
    let amplitude = |k: f64| {
        right
            .as_ref()
            .and_then(|(_, chain)| subject.reflection(&left, chain, k))
            .map_or(f64::NAN, |found| found.amplitude())
    };
    let rows = oracles::published("reflection_fd_lattice");
    let printed = rows
        .iter()
        .map(|row| (amplitude(row.argument.unwrap_or(f64::NAN)) - row.value).abs() / row.half_unit);
    let total = [1.15, 1.6, 2.2, 2.9].map(|k| (1.0 - amplitude(k)).abs());
    let cut = right.as_ref().map(|(stencil, _)| cut_off(stencil));
    vec![
        ("printed_values".into(), error_of(largest(printed), format!("{} values", rows.len()))),
        ("cut_off".into(), value_of(cut, Some((28.0_f64 / 27.0).sqrt()), "printed as 1.0184")),
        ("total".into(), error_of(largest(total), "kΔx = 1.15, 1.6, 2.2, 2.9")),
    ]
}
