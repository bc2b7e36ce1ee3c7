//! `asks = "tip_factor"`: what each reading finds at a tip at rest under K = 1, by kernel and m: one number each, the same
//! for all spacings, for plane stress and plane strain, and for any patch that is large enough.

use super::extraction::{Extraction, ExtractionAsked};
use super::intensity::extractions;
use super::load::ModeName;
use super::said::{check_lattices, check_name, check_reason};
use super::tip::{REACH, TipAtRest, TipField};
use super::tip_factor_report as report;
use crate::bar::names;
use crate::convergence::path::WeightsAsked;
use crate::convergence::whole::resting;
use crate::input::OneOrMany;
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of, value_of};
use crate::rounded::rounded;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::forces::surface::Correction;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::scene::{Positive, Wrong};
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TipFactorAsked {
    /// δ/Δx, one or many.
    pub m: OneOrMany<Positive>,
    pub weights: WeightsAsked,
    pub extraction: Vec<ExtractionAsked>,
    /// Numbers that are known from elsewhere.
    #[serde(default)]
    pub number: Vec<NumberAsked>,
}

/// A factor that is known from elsewhere.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumberAsked {
    /// Of its claim.
    pub name: String,
    pub extraction: String,
    pub mode: ModeName,
    /// As `gaussian_2_linear_calibrated`.
    pub weights: String,
    pub m: Positive,
    pub value: f64,
    pub tolerance: Positive,
    pub basis: Basis,
    pub because: String,
    pub source: String,
}

/// The question.
pub struct TipFactor {
    pub title: String,
    pub lattices: Vec<Lattice>,
    pub names: Vec<String>,
    pub extractions: Vec<Extraction>,
    numbers: Vec<Number>,
}

/// A number with the places of what it is about.
struct Number {
    asked: NumberAsked,
    lattice: usize,
    extraction: usize,
}

/// Factors of one lattice, by extraction and mode.
#[derive(Debug, Clone)]
pub struct Factors {
    /// In a patch of [`REACH`] horizons, plane stress, the tip between columns of nodes.
    pub here: Vec<[f64; 2]>,
    /// In a smaller one.
    smaller: Vec<[f64; 2]>,
    /// In the smaller one, in plane strain.
    strain: Vec<[f64; 2]>,
}

impl Asked for TipFactorAsked {
    type Question = TipFactor;

    fn check(&self, written: &Written<'_>) -> Result<TipFactor, Wrong> {
        for (index, asked) in self.extraction.iter().enumerate() {
            for (key, given) in
                [("tip_factor", asked.tip_factor.is_some()), ("outer_m", asked.outer_m.is_some())]
            {
                if given {
                    let message = format!("{key} says nothing about a tip that is alone with its horizon");
                    return Err(Wrong::new(format!("extraction[{index}].{key}"), message, "leave it out"));
                }
            }
        }
        let extractions = extractions(&self.extraction)?;
        let weights = self.weights.all().map_err(|wrong| wrong.inside("weights"))?;
        check_lattices(&weights, &self.m.0, 4)?;
        let mut lattices = Vec::new();
        let mut slugs = Vec::new();
        for m in &self.m.0 {
            for weights in &weights {
                let lattice = weights.lattice(m.0);
                for (index, extraction) in extractions.iter().enumerate() {
                    let inside = |wrong: Wrong| wrong.inside(&format!("extraction[{index}]"));
                    extraction.check_size(lattice.m, 1.0).map_err(inside)?;
                }
                let ready = TipAtRest::new(lattice, (Body::PlaneStress, Correction::None), true, REACH);
                let ready = ready.map_err(|message| Wrong::new("m", message, "take a larger m"))?;
                let smaller =
                    TipAtRest::new(lattice, (Body::PlaneStress, Correction::None), true, SMALLER * REACH);
                let smaller = smaller.map_err(|message| Wrong::new("m", message, "take a larger m"))?;
                for (index, extraction) in extractions.iter().enumerate() {
                    for tip in [&ready, &smaller] {
                        extraction.prepare(&tip.tip, &tip.elastic()).map_err(|no| {
                            Wrong::new(format!("extraction[{index}]"), no.to_string(), no.cure())
                        })?;
                    }
                }
                lattices.push(lattice);
                slugs.push((weights.slug(), m.0));
            }
        }
        let number = |(index, asked): (usize, &NumberAsked)| {
            let path = |key: &str| format!("number[{index}].{key}");
            let at = slugs.iter().position(|(slug, m)| *slug == asked.weights && *m == asked.m.0);
            let lattice = at.ok_or_else(|| {
                let message =
                    format!("no lattice of this case is \"{}\" with m = {}", asked.weights, asked.m.0);
                Wrong::new(path("weights"), message, "name one of the case's weights and m")
            })?;
            let one = extractions.iter().position(|one| one.name == asked.extraction);
            let extraction = one.ok_or_else(|| {
                let message = format!("no extraction is called \"{}\"", asked.extraction);
                Wrong::new(path("extraction"), message, "name one of the case's extractions")
            })?;
            Ok(Number { asked: asked.clone(), lattice, extraction })
        };
        let numbers = self.number.iter().enumerate().map(number).collect::<Result<_, Wrong>>()?;
        let mut taken = BUILT_IN.map(str::to_owned).to_vec();
        for (index, asked) in self.number.iter().enumerate() {
            let inside = |wrong: Wrong| wrong.inside(&format!("number[{index}]"));
            check_name("name", &asked.name, &taken).map_err(inside)?;
            check_reason(&asked.because).map_err(inside)?;
            taken.push(asked.name.clone());
        }
        let names = names::names(&lattices);
        Ok(TipFactor { title: written.title.to_owned(), lattices, names, extractions, numbers })
    }
}

/// Claims that every case of this kind makes.
const BUILT_IN: [&str; 2] = ["any_size", "any_plane"];

/// The other patch, in parts of [`REACH`].
const SMALLER: f64 = 0.6;
/// What the frame adds falls with the power 3/2 of its distance, and K far from the tip is read from a series that ends:
/// parts in a thousand; in mode II the stretched layers along the faces leave a logarithm of the distance beside.
const SAME: f64 = 5e-3;
/// Conjugate gradients end at 1e-14 of the load; a condition number of 10⁴ leaves 1e-10.
const ROUNDING: f64 = 1e-9;

impl Question for TipFactor {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let mut claims = vec![
            claim(place, "any_size", "largest change of a tip factor when the patch is two fifths smaller")
                .at_most(ErrorKind::Relative, SAME)
                .because(Basis::Theory, "around a tip at rest the horizon is the only length: seen in units of it the field is the same in any patch that is large enough; 5e-3 leaves room for what a frame at 12 horizons adds, in mode II with a logarithm")
                .source("the same lattice in a smaller patch"),
            claim(place, "any_plane", "largest difference of a tip factor between plane stress and plane strain")
                .at_most(ErrorKind::Relative, ROUNDING)
                .because(Basis::Rounding, "a bond-based plate has C12 = C66 = C11/3 in both plane states, so that only a scale differs; conjugate gradients leave some 1e-10")
                .source("the same lattice in plane strain"),
        ];
        for Number { asked, .. } in &self.numbers {
            let quantity = format!(
                "tip factor of {} in mode {}, {} with m = {}",
                asked.extraction.replace('_', " "),
                asked.mode.word(),
                asked.weights.replace('_', " "),
                asked.m.0
            );
            claims.push(
                claim(place, &asked.name, quantity)
                    .within(ErrorKind::Absolute, asked.tolerance.0)
                    .because(asked.basis, asked.because.clone())
                    .source(asked.source.clone()),
            );
        }
        claims
    }

    fn effort(&self) -> Effort {
        let mut total = Effort::default();
        for &lattice in &self.lattices {
            for (body, reach) in WAYS {
                let Ok(tip) = TipAtRest::new(lattice, (body, Correction::None), true, reach) else {
                    continue;
                };
                for plan in tip.scenes().iter().filter_map(|scene| Plan::at_rest(scene).ok()) {
                    total += resting(&plan, tip.nodes()[0]);
                }
            }
        }
        total
    }

    fn equations(&self) -> &'static str {
        "u = K sqrt(r/2 pi)/(2 mu) [...] on a frame around the tip, sum c (xi o xi/|xi|^3)(u' - u) V = 0 within\n\
         tip factor = K that a reading finds / K far from the tip"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let all: Vec<Result<Factors, String>> =
            self.lattices.par_iter().map(|lattice| self.factors(subject, *lattice)).collect();
        let all: Vec<Factors> = match all.into_iter().collect() {
            Ok(all) => all,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        Answer {
            evidence: self.evidence(&all),
            tables: vec![report::table(self, &all, place)],
            figures: report::figures(self, &all, place),
            ..Answer::default()
        }
    }
}

/// Bodies and sizes in which a factor is found.
const WAYS: [(Body, f64); 3] =
    [(Body::PlaneStress, REACH), (Body::PlaneStress, SMALLER * REACH), (Body::PlaneStrain, SMALLER * REACH)];

impl TipFactor {
    fn factors(&self, subject: &dyn Subject, lattice: Lattice) -> Result<Factors, String> {
        let of = |(body, reach): (Body, f64)| -> Result<Vec<[f64; 2]>, String> {
            let field: TipField =
                TipAtRest::new(lattice, (body, Correction::None), true, reach)?.solve(subject)?;
            let each = self.extractions.iter().map(|one| field.factors(one));
            each.collect::<Result<_, _>>().map_err(|unreadable| unreadable.to_string())
        };
        let [here, smaller, strain] = WAYS.map(of);
        Ok(Factors { here: here?, smaller: smaller?, strain: strain? })
    }

    fn evidence(&self, all: &[Factors]) -> Vec<(String, Evidence)> {
        type Of = fn(&Factors) -> &Vec<[f64; 2]>;
        let furthest = |one: Of, other: Of| {
            let changes = all.iter().flat_map(move |factors| {
                let pairs = one(factors).iter().zip(other(factors));
                pairs.flat_map(|(here, there)| [0, 1].map(|mode| (there[mode] / here[mode] - 1.0).abs()))
            });
            largest(changes)
        };
        let solved = format!("{} lattices, {} readings, both modes", all.len(), self.extractions.len());
        let mut evidence = vec![
            (
                "any_size".to_owned(),
                error_of(furthest(|factors| &factors.here, |factors| &factors.smaller), solved.clone()),
            ),
            (
                "any_plane".to_owned(),
                error_of(furthest(|factors| &factors.smaller, |factors| &factors.strain), solved),
            ),
        ];
        for Number { asked, lattice, extraction } in &self.numbers {
            let found = all[*lattice].here[*extraction][asked.mode.index()];
            let note = format!("{}: {}", self.names[*lattice], rounded(found));
            evidence.push((asked.name.clone(), value_of(Some(found), Some(asked.value), note)));
        }
        evidence
    }
}
