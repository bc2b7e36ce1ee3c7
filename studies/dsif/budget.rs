//! `asks = "error_budget"`: what a published comparison is made of, term by term. Every term is the difference of two
//! histories that differ in one thing alone, so that their sum is the whole.

use super::errors;
use super::extraction::ExtractionAsked;
use super::intensity::{Found, Intensity, IntensityAsked, Read};
use super::intensity_report as report;
use super::known::{KnownAsked, WindowAsked};
use super::load::{LoadAsked, ModeName, On};
use super::plate::{LateralName, PlateAsked};
use super::setup::Setup;
use super::tips::Tips;
use crate::bar::names::{LATTICE, lattice_cells};
use crate::convergence::path::WeightsAsked;
use crate::input::one_or_many;
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::report::plot::{Axis, Figure, Stack, StackedBars};
use pd_verify::scene::{Positive, Wrong};
use pd_verify::table::{Cell, Table};
use pd_verify::verdict::Evidence;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BudgetAsked {
    /// As published, with free lateral edges.
    pub plate: PlateAsked,
    pub load: LoadAsked,
    /// With the published `reference_poisson_ratio`.
    pub known: KnownAsked,
    pub window: WindowAsked,
    pub m: Positive,
    pub dx_m: Positive,
    /// As printed: `calibrated` is left out.
    pub weights: WeightsAsked,
    /// How K was read in the publication.
    pub published: ExtractionAsked,
    /// How it is read best.
    pub best: ExtractionAsked,
}

/// The question.
pub struct Budget {
    title: String,
    /// As published; with guided lateral edges; with these and calibrated weights.
    steps: [Intensity; 3],
}

/// Times within the window at which histories are compared.
const LOOKS: usize = 200;

/// The terms, in the order of the sum.
const TERMS: [&str; 5] =
    ["reference", "extraction", "lateral edges", "lattice moduli", "dispersion and spacing"];

/// The budget of one kind of weights.
struct Entry {
    /// Mean over the window of each term, over the largest K of the consistent reference.
    means: [f64; 5],
    /// Root mean square of each, likewise.
    rms: [f64; 5],
    /// Mean of all: the published reading against the published reference.
    whole: f64,
    /// The published reading over the best one, and the ratio of their tip factors.
    ratio: Option<(f64, f64)>,
}

impl Asked for BudgetAsked {
    type Question = Budget;

    fn check(&self, written: &Written<'_>) -> Result<Budget, Wrong> {
        if self.known.reference_poisson_ratio.is_none() {
            let message = "a budget tells the published reference from the consistent one";
            return Err(Wrong::new("known", message, "add reference_poisson_ratio"));
        }
        if self.weights.calibrated.is_some() {
            let message = "a budget compares the weights as printed with calibrated ones";
            return Err(Wrong::new("weights.calibrated", message, "leave it out"));
        }
        if self.plate.lateral.is_some_and(|lateral| lateral != LateralName::Free) {
            let message = "a budget compares free lateral edges with guided ones";
            return Err(Wrong::new("plate.lateral", message, "leave it out"));
        }
        if self.load.on == On::AllEdges {
            let message = "a load on all edges leaves no lateral edges to be guided";
            return Err(Wrong::new("load.on", message, "load the upper edge, both, or the faces"));
        }
        let published = ExtractionAsked { name: Some("published".into()), ..self.published.clone() };
        let best = ExtractionAsked { name: Some("best".into()), ..self.best.clone() };
        let guided = match self.load.mode {
            ModeName::I => LateralName::Rollers,
            ModeName::II => LateralName::Guides,
        };
        let step = |lateral: LateralName, calibrated: bool| {
            let asked = IntensityAsked {
                safety: None,
                plate: PlateAsked { lateral: Some(lateral), ..self.plate.clone() },
                load: self.load.clone(),
                known: self.known.clone(),
                window: self.window.clone(),
                m: one_or_many(self.m),
                dx_m: Some(one_or_many(self.dx_m)),
                horizon_m: None,
                weights: WeightsAsked { calibrated: Some(one_or_many(calibrated)), ..self.weights.clone() },
                extraction: vec![published.clone(), best.clone()],
                expect: Vec::new(),
                normalized_by: None,
                field_m: None,
            };
            asked.check(written)
        };
        let steps = [step(LateralName::Free, false)?, step(guided, false)?, step(guided, true)?];
        Ok(Budget { title: written.title.to_owned(), steps })
    }
}

/// What may be left, over the largest K.
const REST: f64 = 0.005;
/// What free edges may change before their waves arrive.
const LATERAL: f64 = 1e-4;
/// How far a reading at the nearest nodes may be from its tip factor: it looks half a spacing beside the faces, where the
/// stress along the crack opens it too, by a part that falls with the root of the spacing.
const NEAR: f64 = 0.05;

impl Question for Budget {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let source = self.steps[0].known.source();
        vec![
            claim(place, "rest", "root mean square of what is left when all other terms are gone: furthest weights")
                .at_most(ErrorKind::RmsOfPeak, REST)
                .because(Basis::Engineering, "with the body's own reference, tip factors, guided edges and intended moduli only dispersion and the spacing are left")
                .source(source),
            claim(place, "lateral", "root mean square of what free lateral edges change: furthest weights")
                .at_most(ErrorKind::RmsOfPeak, LATERAL)
                .because(Basis::Theory, "within the window no wave of the corners has reached the tip: what comes before the fastest wave is what a lattice's short waves do")
                .source("the same plate with guided edges"),
            claim(place, "extraction_is_the_tip_factor", "ratio of the published reading to the best one, over that of their tip factors, less 1: furthest weights")
                .at_most(ErrorKind::Relative, NEAR)
                .because(Basis::Theory, "the nonlocal zone of a tip looks the same at any spacing in units of the horizon; what is left at a finite spacing is the stress along the crack, seen half a spacing off its faces")
                .source("the same reading in the static field of a tip"),
        ]
    }

    fn scenes(&self) -> Vec<Planned> {
        self.steps.iter().flat_map(Question::scenes).collect()
    }

    fn effort(&self) -> Effort {
        let mut total = Effort::of_scenes(&self.scenes());
        total += Tips::effort(self.setups());
        total
    }

    fn equations(&self) -> &'static str {
        "K_published - K_printed = (K_published - K_best) + (K_best - K_guided) + (K_guided - K_calibrated) + (K_calibrated - K_exact) + (K_exact - K_printed)"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let found = match self.find(subject) {
            Ok(found) => found,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        let entries: Option<Vec<Entry>> =
            (0..self.steps[0].tracks.len()).map(|track| self.entry(&found, track)).collect();
        let Some(entries) = entries else {
            return Answer::failed(&self.claims(place), "the window holds no looks");
        };
        Answer {
            evidence: evidence(&entries),
            tables: vec![self.table(&entries, place), report::histories(&self.steps[0], &found[0], place)],
            figures: vec![self.figure(&entries, place)],
            ..Answer::default()
        }
    }
}

fn evidence(entries: &[Entry]) -> Vec<(String, Evidence)> {
    let term = |index: usize| largest(entries.iter().map(|entry| entry.rms[index]));
    let far = entries
        .iter()
        .map(|entry| entry.ratio.map_or(f64::NAN, |(found, expected)| (found / expected - 1.0).abs()));
    let count = format!("{} weights", entries.len());
    vec![
        ("rest".into(), error_of(term(4), count.clone())),
        ("lateral".into(), error_of(term(2), count.clone())),
        ("extraction_is_the_tip_factor".into(), error_of(largest(far), count)),
    ]
}

impl Budget {
    fn find(&self, subject: &dyn Subject) -> Result<Vec<Found>, String> {
        let tips = Tips::of(self.setups(), subject)?;
        self.steps.iter().map(|step| step.find_with(subject, &tips)).collect()
    }

    fn setups(&self) -> impl Iterator<Item = &Setup> {
        self.steps.iter().flat_map(Intensity::setups)
    }

    /// The budget of one kind of weights; `None` where the window holds too few looks.
    fn entry(&self, found: &[Found], track: usize) -> Option<Entry> {
        let read = |step: usize, way: usize| -> &Read { &found[step].reads[track][0][way] };
        let mode = self.steps[0].load.mode.index();
        let window = self.steps[0].window;
        let at = |look: usize| {
            let share = (look as f64 + 0.5) / LOOKS as f64;
            window.from + share * (window.to - window.from)
        };
        // Marches with other weights take other steps: all are seen at the same times.
        let of = |step: usize, way: usize| -> Option<Vec<f64>> {
            let read = read(step, way);
            (0..LOOKS).map(|look| read.at(at(look), mode)).collect()
        };
        let known = &self.steps[0].known;
        let a = read(0, 0).a;
        let exact: Vec<f64> = (0..LOOKS).map(|look| known.at(at(look), a)).collect::<Option<_>>()?;
        let printed: Vec<f64> = (0..LOOKS).map(|look| known.published_at(at(look))).collect::<Option<_>>()?;
        let (published, best, guided, calibrated) = (of(0, 0)?, of(0, 1)?, of(1, 1)?, of(2, 1)?);
        let peak = exact.iter().map(|k| k.abs()).fold(0.0, f64::max);
        let term = |more: &[f64], less: &[f64]| -> [f64; 2] {
            let all = more.iter().zip(less).map(|(more, less)| (more - less) / peak);
            let squares: f64 = all.clone().map(|part| part * part).sum();
            [all.sum::<f64>() / LOOKS as f64, (squares / LOOKS as f64).sqrt()]
        };
        let terms = [
            term(&exact, &printed),
            term(&published, &best),
            term(&best, &guided),
            term(&guided, &calibrated),
            term(&calibrated, &exact),
        ];
        let whole = term(&published, &printed)[0];
        let left = |way: usize| {
            let divided = self.steps[0].extractions[way].tip_factor;
            read(0, way).factors.map(|factors| if divided { 1.0 } else { factors[mode] })
        };
        let ratio = errors::ratio(&self.steps[0], read(0, 0), read(0, 1))
            .zip(left(0).zip(left(1)).map(|(published, best)| published / best));
        Some(Entry { means: terms.map(|term| term[0]), rms: terms.map(|term| term[1]), whole, ratio })
    }

    fn table(&self, entries: &[Entry], place: &Place) -> Table {
        let mut columns = vec!["case", "mode"];
        columns.extend(LATTICE);
        columns.extend(["term", "mean_of_peak", "rms_of_peak"]);
        let mut table = Table::new("dsif_budget.csv", &columns);
        let mode = self.steps[0].load.mode.word();
        for (track, entry) in self.steps[0].tracks.iter().zip(entries) {
            let setup = &track.setups[0];
            let mut push = |term: &str, mean: f64, rms: Option<f64>| {
                let mut row: Vec<Cell> = vec![place.case.as_str().into(), mode.into()];
                row.extend(lattice_cells(Some((setup.lattice, setup.scene.spacing))));
                row.extend([term.into(), mean.into(), rms.into()]);
                table.push(row);
            };
            for (name, (mean, rms)) in TERMS.iter().zip(entry.means.iter().zip(entry.rms)) {
                push(name, *mean, Some(rms));
            }
            push("whole", entry.whole, None);
        }
        table
    }

    fn figure(&self, entries: &[Entry], place: &Place) -> Figure {
        let stack = |(track, entry): (&super::intensity::Track, &Entry)| {
            Stack::new(track.name.clone(), entry.means.map(|mean| 100.0 * mean))
        };
        let bars = StackedBars {
            title: String::new(),
            value: Axis::linear("mean of K − K_reference in the window (% of the largest K)"),
            contributions: TERMS.map(str::to_owned).to_vec(),
            sum: "the published comparison".into(),
            stacks: self.steps[0].tracks.iter().zip(entries).map(stack).collect(),
        };
        let caption = "Each term is the difference of two histories that differ in one thing: the published reference and the consistent one; the published reading and the best; free lateral edges and guided ones; weights as printed and calibrated; what is left, and the exact history.";
        Figure::new(place.case.clone(), self.title.clone(), caption, bars)
    }
}
