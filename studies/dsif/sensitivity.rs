//! `asks = "reading_sensitivity"`: one march, read with many radii and terms: how much K depends on them, and whether the
//! spread between readings tells of the error where no exact answer is known.

use super::errors;
use super::extraction::ExtractionAsked;
use super::intensity::{Found, Intensity, IntensityAsked, Read};
use super::intensity_report as report;
use super::known::{KnownAsked, WindowAsked};
use super::load::LoadAsked;
use super::plate::PlateAsked;
use super::said::{check_name, check_reason};
use crate::convergence::path::WeightsAsked;
use crate::input::one_or_many;
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of};
use crate::rounded::rounded;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::report::plot::{Axis, Figure, Lines, Series};
use pd_verify::scene::{Positive, Wrong};
use pd_verify::stress_intensity::spread::spread_of_histories;
use pd_verify::verdict::Evidence;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SensitivityAsked {
    pub plate: PlateAsked,
    pub load: LoadAsked,
    pub known: KnownAsked,
    pub window: WindowAsked,
    pub m: Positive,
    pub dx_m: Positive,
    pub weights: WeightsAsked,
    /// Each is read with every outer radius, and every highest term where it has a series.
    pub extraction: Vec<ExtractionAsked>,
    /// Outer radii in δ, growing.
    pub outer_horizons: Vec<Positive>,
    /// Highest terms of Williams' series.
    pub terms: Vec<usize>,
    #[serde(default)]
    pub expect: Vec<WorstAsked>,
}

/// How large an error may be at the worst of some radii and terms.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WorstAsked {
    pub extraction: String,
    pub up_to_horizons: Positive,
    /// Root mean square over the largest |K|.
    pub at_most: Positive,
    pub basis: Basis,
    pub because: String,
}

/// Curves that a figure can show.
const DRAWN: usize = 8;

/// The question.
pub struct Sensitivity {
    /// One extraction for each radius and number of terms.
    intensity: Intensity,
    /// Of each of these, in the same order.
    ways: Vec<Way>,
    worst: Vec<WorstAsked>,
}

/// A way to read K.
struct Way {
    /// The extraction that it varies.
    extraction: String,
    terms: Option<usize>,
    /// r_max/δ.
    outer: f64,
}

impl Way {
    /// In legends and notes.
    fn name(&self) -> String {
        let terms = self.terms.map_or(String::new(), |terms| format!(", n ≤ {terms}"));
        format!("{}{terms}", self.extraction.replace('_', " "))
    }
}

impl Asked for SensitivityAsked {
    type Question = Sensitivity;

    fn check(&self, written: &Written<'_>) -> Result<Sensitivity, Wrong> {
        let radii: Vec<f64> = self.outer_horizons.iter().map(|outer| outer.0).collect();
        if radii.len() < 2 || !radii.windows(2).all(|pair| pair[0] < pair[1]) {
            let message = "a sensitivity needs two outer radii or more, growing";
            return Err(Wrong::new("outer_horizons", message, "for example [3, 4, 6, 8]"));
        }
        let (mut extraction, mut ways) = (Vec::new(), Vec::new());
        for (index, asked) in self.extraction.iter().enumerate() {
            let one = asked.check().map_err(|wrong| wrong.inside(&format!("extraction[{index}]")))?;
            if asked.outer_m.is_some() || asked.outer_horizons.is_some() {
                let message = "the outer radii are those of outer_horizons of the case";
                return Err(Wrong::new(
                    format!("extraction[{index}]"),
                    message,
                    "leave outer_horizons and outer_m out here",
                ));
            }
            if one.radii(1.0).is_none() {
                let message = format!("{} has no annulus", one.name);
                return Err(Wrong::new(format!("extraction[{index}].method"), message, "leave it out here"));
            }
            let terms: Vec<Option<usize>> = match one.terms() {
                Some(_) if !self.terms.is_empty() => self.terms.iter().map(|terms| Some(*terms)).collect(),
                own => vec![own],
            };
            for &outer in &radii {
                for &terms in &terms {
                    let said = terms.map_or(String::new(), |terms| format!("_n{terms}"));
                    let name = format!("{}{said}_r{outer}", one.name).replace('.', "_");
                    let outer_horizons = Some(Positive(outer));
                    extraction.push(ExtractionAsked {
                        name: Some(name),
                        outer_horizons,
                        terms,
                        ..asked.clone()
                    });
                    ways.push(Way { extraction: one.name.clone(), terms, outer });
                }
            }
        }
        let asked = IntensityAsked {
            safety: None,
            plate: self.plate.clone(),
            load: self.load.clone(),
            known: self.known.clone(),
            window: self.window.clone(),
            m: one_or_many(self.m),
            dx_m: Some(one_or_many(self.dx_m)),
            horizon_m: None,
            weights: self.weights.clone(),
            extraction,
            expect: Vec::new(),
            normalized_by: None,
            field_m: None,
        };
        let intensity = asked.check(written)?;
        if intensity.tracks.len() != 1 {
            let message = format!("one kind of weights at a time, here {}", intensity.tracks.len());
            return Err(Wrong::new("weights", message, "write one kernel, p, volume rule and calibration"));
        }
        let mut taken = vec!["spread".to_owned()];
        for (index, worst) in self.expect.iter().enumerate() {
            let inside = |wrong: Wrong| wrong.inside(&format!("expect[{index}]"));
            check_reason(&worst.because).map_err(inside)?;
            check_name("extraction", &worst.name(), &taken).map_err(inside)?;
            taken.push(worst.name());
            if !ways.iter().any(|way| worst.covers(way)) && radii[0] > worst.up_to_horizons.0 {
                let message = format!("no radius is as small as {} horizons", worst.up_to_horizons.0);
                let key = format!("expect[{index}].up_to_horizons");
                return Err(Wrong::new(key, message, format!("take {} or more", radii[0])));
            }
            if !ways.iter().any(|way| way.extraction == worst.extraction) {
                let message = format!("no extraction is called \"{}\"", worst.extraction);
                let key = format!("expect[{index}].extraction");
                return Err(Wrong::new(key, message, "name one of the case's extractions"));
            }
        }
        Ok(Sensitivity { intensity, ways, worst: self.expect.clone() })
    }
}

impl WorstAsked {
    /// Of its claim.
    fn name(&self) -> String {
        let radius = self.up_to_horizons.0.to_string().replace('.', "_");
        format!("{}_worst_to_{radius}", self.extraction)
    }

    /// Whether a way is among those that are claimed.
    fn covers(&self, way: &Way) -> bool {
        way.extraction == self.extraction && way.outer <= self.up_to_horizons.0 * (1.0 + 1e-9)
    }
}

impl Question for Sensitivity {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let source = self.intensity.known.source();
        let worst = |worst: &WorstAsked| {
            let quantity = format!(
                "root mean square error of K by {} at the worst of its radii up to {} horizons and of its terms",
                worst.extraction.replace('_', " "),
                worst.up_to_horizons.0
            );
            claim(place, &worst.name(), quantity)
                .at_most(ErrorKind::RmsOfPeak, worst.at_most.0)
                .because(worst.basis, worst.because.clone())
                .source(source)
        };
        let mut claims: Vec<Claim> = self.worst.iter().map(worst).collect();
        claims.push(
            claim(place, "spread", "largest error of the mean of all readings over the largest spread between them")
                .at_most(ErrorKind::Relative, 1.0)
                .because(Basis::Engineering, "the spread between readings that share little is an estimate of their error where no exact answer is known; it is of use as long as it is not too small")
                .source(source),
        );
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.intensity.scenes()
    }

    fn effort(&self) -> Effort {
        self.intensity.effort()
    }

    fn equations(&self) -> &'static str {
        self.intensity.equations()
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let found = match self.intensity.find(subject) {
            Ok(found) => found,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        Answer {
            evidence: self.evidence(&found),
            tables: vec![report::errors(&self.intensity, &found, place)],
            figures: vec![self.figure(&found, place)],
            ..Answer::default()
        }
    }
}

impl Sensitivity {
    fn rms(&self, read: &Read) -> f64 {
        errors::of(&self.intensity, read).map_or(f64::NAN, |errors| errors.rms)
    }

    fn evidence(&self, found: &Found) -> Vec<(String, Evidence)> {
        let reads = &found.reads[0][0];
        let mut evidence = Vec::new();
        for worst in &self.worst {
            let mine = self.ways.iter().zip(reads).filter(|(way, _)| worst.covers(way));
            let all: Vec<(String, f64)> = mine
                .map(|(way, read)| (format!("{}, {} delta", way.name(), way.outer), self.rms(read)))
                .collect();
            let most = largest(all.iter().map(|(_, rms)| *rms));
            let at = all.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or("", |(name, _)| name.as_str());
            evidence.push((worst.name(), error_of(most, format!("{at}, of {}", all.len()))));
        }
        evidence.push(("spread".into(), self.spread(reads)));
        evidence
    }

    /// The error of the mean of all readings over their spread.
    fn spread(&self, reads: &[Read]) -> Evidence {
        let inside = |read: &Read| -> Vec<[f64; 2]> {
            let looks = read.times.iter().zip(&read.k).filter(|(t, _)| self.intensity.window.holds(**t));
            looks.map(|(_, k)| *k).collect()
        };
        let histories: Vec<Vec<[f64; 2]>> = reads.iter().map(inside).collect();
        let slices: Vec<&[[f64; 2]]> = histories.iter().map(Vec::as_slice).collect();
        let mode = self.intensity.load.mode.index();
        let Some(spread) = spread_of_histories(&slices).map(|spread| spread[mode]) else {
            return Evidence::default();
        };
        let count = reads.len() as f64;
        let mean =
            |look: usize| [0, 1].map(|mode| reads.iter().map(|read| read.k[look][mode]).sum::<f64>() / count);
        let middle = Read { k: (0..reads[0].k.len()).map(mean).collect(), ..reads[0].clone() };
        let error = errors::of(&self.intensity, &middle).map(|errors| errors.max);
        let note = error.map_or(String::new(), |error| {
            format!("error {}, spread {} of {} readings", rounded(error), rounded(spread), reads.len())
        });
        error_of(error.map(|error| error / spread), note)
    }

    fn figure(&self, found: &Found, place: &Place) -> Figure {
        let reads = &found.reads[0][0];
        let mut names: Vec<String> = Vec::new();
        for name in self.ways.iter().map(Way::name) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        let of_name = |(slot, name): (usize, &String)| {
            let mine = self.ways.iter().zip(reads).filter(|(way, _)| way.name() == *name);
            let points = mine.map(|(way, read)| (way.outer, 100.0 * self.rms(read)));
            Series::both(name.clone(), points.collect()).slot(slot)
        };
        let series = names.iter().take(DRAWN).enumerate().map(of_name).collect();
        let lines = Lines::new(
            Axis::linear("outer radius of the annulus (δ)"),
            Axis::log("rms error (% of the largest K)"),
            series,
        );
        let mut caption = format!(
            "Error of K of mode {} by the outer radius and the highest term n that it is read with; {}, cells of {} m.",
            self.intensity.load.mode.word(),
            self.intensity.tracks[0].name,
            rounded(self.intensity.tracks[0].setups[0].scene.spacing)
        );
        if names.len() > DRAWN {
            caption += &format!(" {} more ways are in dsif_errors.csv.", names.len() - DRAWN);
        }
        Figure::new(place.case.clone(), self.intensity.title.clone(), caption, lines)
    }
}
