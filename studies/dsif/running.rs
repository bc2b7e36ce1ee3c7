//! `asks = "running_crack"`: a long crack at rest under a wave sets out at a given speed. K, read with the fields of a running
//! tip, is k(v) times that of the crack at rest at the same place.

use super::known::{Known, KnownAsked, Window, holds_until};
use super::load::{Load, LoadAsked, On};
use super::plate::{CrackPlace, PlateAsked};
use super::running_report as report;
use super::setup::{Problem, Seen, Setup};
use super::smooth::smooth;
use crate::convergence::path::{Weights, WeightsAsked};
use crate::input::OneOrMany;
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of};
use crate::rounded::rounded;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::plan::Plan;
use pd_verify::scene::{Positive, Running, Wrong};
use pd_verify::stress_intensity::running::{Running as RunningFit, rayleigh_speed};
use pd_verify::stress_intensity::{Annulus, Elastic, Sites, Tip};
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunningAsked {
    pub plate: PlateAsked,
    pub load: LoadAsked,
    pub known: KnownAsked,
    /// When the crack sets out, in times of the wave's arrival.
    pub starts_arrivals: Positive,
    /// When K is judged.
    pub from_arrivals: Positive,
    pub to_arrivals: Positive,
    /// Over that of Rayleigh waves.
    pub speeds: Vec<Positive>,
    pub m: Positive,
    /// From coarse to fine.
    pub dx_m: OneOrMany<Positive>,
    pub weights: WeightsAsked,
    /// Of the annulus, in δ; default 3.
    pub outer_horizons: Option<Positive>,
    /// Highest term of the series; default 2.
    pub terms: Option<usize>,
    /// Whether the term r^(−1/2), a tip seen elsewhere, is fitted too. Default `false`.
    pub process_zone: Option<bool>,
    /// Of the root mean square of the error over the largest |K| of the reference, at the finest level.
    pub at_most: Positive,
    pub basis: Basis,
    pub because: String,
}

/// The question.
pub struct RunningCrack {
    pub title: String,
    pub known: Known,
    pub load: Load,
    pub window: Window,
    /// When the crack sets out, in s.
    pub start: f64,
    pub runs: Vec<Run>,
    pub half_height: f64,
    outer: f64,
    terms: usize,
    process_zone: bool,
    at_most: f64,
    basis: Basis,
    because: String,
}

/// One speed, from coarse to fine.
pub struct Run {
    /// Over Rayleigh's.
    pub share: f64,
    /// In m/s.
    pub speed: f64,
    pub setups: Vec<Setup>,
}

/// What one march of a running crack showed. Per look.
#[derive(Debug, Clone)]
pub struct Ran {
    /// In s.
    pub times: Vec<f64>,
    /// In Pa√m, as read.
    pub k: Vec<f64>,
    /// The mean over one period of cutting bonds, Δx/v, about each look; `None` where the period is not whole.
    pub smoothed: Vec<Option<f64>>,
}

impl Asked for RunningAsked {
    type Question = RunningCrack;

    fn check(&self, written: &Written<'_>) -> Result<RunningCrack, Wrong> {
        let (material, body) = (written.material()?, self.plate.body.into());
        let load = self.load.check(self.plate.lateral.unwrap_or_default())?;
        if self.plate.crack != CrackPlace::LeftEdge || load.on != On::Top {
            let message = "a running crack is known for a wave that meets a crack from the left edge";
            return Err(Wrong::new("load.on", message, "take crack = \"left_edge\" and on = \"top\""));
        }
        let known = self.known.check((material, body), &self.plate, &load)?;
        if known.running_at(0.0, 0.0).is_none() {
            let message = "a running crack is known in an infinite plane alone";
            return Err(Wrong::new("known.answer", message, "take answer = \"freund\""));
        }
        let weights = match self.weights.all().map_err(|wrong| wrong.inside("weights"))?[..] {
            [one] => one,
            _ => {
                let help = "write one kernel, p, volume rule and calibration";
                return Err(Wrong::new("weights", "one kind of weights at a time", help));
            }
        };
        let [start, from, to] =
            [self.starts_arrivals, self.from_arrivals, self.to_arrivals].map(|time| time.0 * known.arrival);
        if !(start < from && from < to) {
            let message = "the crack sets out, then K is judged, then the march ends";
            return Err(Wrong::new("from_arrivals", message, "let starts, from and to grow"));
        }
        let spacings: Vec<f64> = self.dx_m.0.iter().map(|dx| dx.0).collect();
        if !spacings.windows(2).all(|pair| pair[0] > pair[1]) {
            return Err(Wrong::new("dx_m", "levels go from coarse to fine", "write falling spacings"));
        }
        let finest = spacings[spacings.len() - 1];
        let (last, _) = holds_until(&known, (material, body), &self.plate.on(finest)?, &load)?;
        if to > last * (1.0 + 1e-9) {
            let message =
                format!("the reference holds to {} s, and K is judged to {} s", rounded(last), rounded(to));
            return Err(Wrong::new("to_arrivals", message, "end earlier, or take a larger plate"));
        }
        let elastic = Elastic::of(material, body)
            .ok_or_else(|| Wrong::new("plate.body", "a bar has no crack", "take a plate"))?;
        let problem = Problem { material, body, plate: self.plate.clone(), load: load.clone(), until: to };
        let outer = self.outer_horizons.map_or(3.0, |outer| outer.0);
        let way = Way { start, by: to - start, outer, rayleigh: rayleigh_speed(&elastic) };
        let runs = self.speeds.iter().map(|share| way.run(&problem, weights, share.0, self.m.0, &spacings));
        let runs: Vec<Run> = runs.collect::<Result<_, _>>()?;
        if runs.is_empty() {
            return Err(Wrong::new("speeds", "no speed is given", "for example [0.2, 0.4, 0.6]"));
        }
        Ok(RunningCrack {
            title: written.title.to_owned(),
            known,
            load,
            window: Window { from, to },
            start,
            runs,
            half_height: self.plate.half_height(),
            outer,
            terms: self.terms.unwrap_or(2),
            process_zone: self.process_zone.unwrap_or(false),
            at_most: self.at_most.0,
            basis: self.basis,
            because: self.because.clone(),
        })
    }
}

/// What all speeds have in common.
struct Way {
    /// In s.
    start: f64,
    /// For how long, in s.
    by: f64,
    outer: f64,
    /// In m/s.
    rayleigh: f64,
}

impl Way {
    fn run(
        &self,
        problem: &Problem,
        weights: Weights,
        share: f64,
        m: f64,
        spacings: &[f64],
    ) -> Result<Run, Wrong> {
        if share >= 1.0 {
            let message = format!("a crack at {share} times the speed of Rayleigh waves has no such K");
            return Err(Wrong::new("speeds", message, "give parts of that speed below 1"));
        }
        let speed = share * self.rayleigh;
        let mut setups: Vec<Setup> = Vec::new();
        for &dx in spacings {
            let reach = self.outer * m * dx + 3.0 * dx;
            let travel = speed * self.by;
            let limit = setups.last().map(Setup::limit);
            let mut setup = problem.on(weights.lattice(m), dx, &[], reach + travel, limit)?;
            if reach + travel > setup.plate.room() {
                let message =
                    format!("the crack at {share} of Rayleigh's speed comes too near to the right edge");
                return Err(Wrong::new("speeds", message, "take a wider plate, or end earlier"));
            }
            setup.scene.running = vec![Running { notch: 0, speed, start: self.start, by: travel + dx }];
            let limit = setup.limit() * dx / setup.scene.speed();
            setup.plan = Plan::below(&setup.scene, limit)?;
            // Several looks in the time in which the tip passes a cell.
            let looks = (dx / speed / setup.plan.time_step_s / LOOKS).floor().max(1.0);
            setup.scene.probes[0].every = looks as u64;
            setups.push(setup);
        }
        Ok(Run { share, speed, setups })
    }
}

/// Looks while the tip passes a cell, at least where steps are short enough.
const LOOKS: f64 = 8.0;

impl Question for RunningCrack {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let source = "Freund 1990, 6.4: k(v) with its factor S+, times K of the crack at rest";
        let mode = self.load.mode.word();
        let mut claims: Vec<Claim> = self
            .runs
            .iter()
            .map(|run| {
                let quantity = format!(
                    "root mean square error of K_{mode}, smoothed over the time in which the tip passes a cell, at {} of Rayleigh's speed",
                    run.share
                );
                claim(place, &name(run), quantity)
                    .at_most(ErrorKind::RmsOfPeak, self.at_most)
                    .because(self.basis, self.because.clone())
                    .source(source)
            })
            .collect();
        if self.runs[0].setups.len() > 1 {
            let quantity = format!("levels at which the error of K_{mode} does not fall, all speeds");
            claims.push(
                claim(place, "not_falling", quantity)
                    .exactly()
                    .because(
                        Basis::Theory,
                        "the annulus that is read and the zone that cuts bonds both shrink with the horizon",
                    )
                    .source(source),
            );
        }
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.runs.iter().flat_map(|run| &run.setups).map(|setup| setup.plan.clone()).collect()
    }

    fn effort(&self) -> Effort {
        Effort::of_scenes(&self.scenes())
    }

    fn equations(&self) -> &'static str {
        "K(t, v) = k(v) K(t), k_I(v) = (1 - v/c_R)/sqrt(1 - v/c_d) S+(-1/v)\n\
         bonds across the crack's line are cut when the tip has passed them"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let work: Vec<(&Run, &Setup)> =
            self.runs.iter().flat_map(|run| run.setups.iter().map(move |setup| (run, setup))).collect();
        let ran: Vec<Result<Ran, String>> =
            work.par_iter().map(|(run, setup)| self.read(subject, run, setup)).collect();
        let ran: Vec<Ran> = match ran.into_iter().collect() {
            Ok(ran) => ran,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        let levels = self.runs[0].setups.len();
        let by_run: Vec<&[Ran]> = ran.chunks(levels).collect();
        Answer {
            evidence: self.evidence(&by_run),
            tables: vec![report::table(self, &by_run, place)],
            figures: vec![report::figure(self, &by_run, place)],
            ..Answer::default()
        }
    }
}

fn name(run: &Run) -> String {
    format!("v_{}", run.share).replace('.', "_")
}

impl RunningCrack {
    /// How far the tip of a run has gone at t in s, in m.
    pub fn gone(&self, run: &Run, t: f64) -> f64 {
        run.speed * (t - self.start).max(0.0)
    }

    /// K of the running tip at t in Pa√m; of the crack at rest before it sets out.
    pub fn known_at(&self, run: &Run, t: f64) -> Option<f64> {
        self.known.running_at(t, if t > self.start { run.speed } else { 0.0 })
    }

    /// Marches a run and reads K at every look from somewhat before the crack sets out.
    fn read(&self, subject: &dyn Subject, run: &Run, setup: &Setup) -> Result<Ran, String> {
        let seen: Seen = setup.march(subject)?;
        let horizon = setup.tip.horizon;
        let annulus = Annulus { inner: 2.0 * horizon, outer: self.outer * horizon };
        let (mut times, mut k) = (Vec::new(), Vec::new());
        for (look, &t) in seen.times.iter().enumerate() {
            if t < 0.9 * self.start {
                continue;
            }
            let gone = self.gone(run, t);
            let Sites { first, .. } = setup.tip.sites;
            let sites = Sites { first: [first[0] - gone, first[1]], ..setup.tip.sites };
            let tip = Tip { sites, crack: setup.tip.crack + gone, ..setup.tip };
            let speed = if t > self.start { run.speed } else { 0.0 };
            let fit = RunningFit {
                process_zone: self.process_zone,
                ..RunningFit::over(annulus, speed, self.terms)
            };
            let reading = subject.running_reading(&fit, &tip, &setup.elastic);
            let reading = reading.map_err(|unreadable| unreadable.to_string())?;
            let (u, a) = (&seen.displacement[look], &seen.acceleration[look]);
            times.push(t);
            k.push(subject.stress_intensity(&reading, u, a, seen.faces[look])[self.load.mode.index()]);
        }
        let smoothed = smooth(&times, &k, setup.scene.spacing / run.speed);
        Ok(Ran { times, k, smoothed })
    }

    /// Pairs (smoothed K, reference) within the window.
    pub fn pairs(&self, run: &Run, ran: &Ran) -> Option<Vec<(f64, f64)>> {
        let inside = ran.times.iter().zip(&ran.smoothed).filter(|(t, _)| self.window.holds(**t));
        let known = inside.filter_map(|(t, k)| k.map(|k| (*t, k)));
        let pairs: Option<Vec<(f64, f64)>> = known.map(|(t, k)| Some((k, self.known_at(run, t)?))).collect();
        pairs.filter(|pairs| pairs.len() >= 10)
    }

    /// Root mean square of the error over the largest reference.
    pub fn rms(&self, run: &Run, ran: &Ran) -> f64 {
        self.pairs(run, ran).map_or(f64::NAN, |pairs| super::errors::of_pairs(&pairs).rms)
    }

    fn evidence(&self, ran: &[&[Ran]]) -> Vec<(String, Evidence)> {
        let errors: Vec<Vec<f64>> = self
            .runs
            .iter()
            .zip(ran)
            .map(|(run, levels)| levels.iter().map(|ran| self.rms(run, ran)).collect())
            .collect();
        let mut evidence: Vec<(String, Evidence)> = self
            .runs
            .iter()
            .zip(&errors)
            .map(|(run, levels)| {
                let listed = levels.iter().map(|rms| rounded(*rms)).collect::<Vec<_>>().join(", ");
                (name(run), error_of(levels.last().copied(), listed))
            })
            .collect();
        if self.runs[0].setups.len() > 1 {
            let rising = |levels: &Vec<f64>| -> f64 {
                if levels.iter().any(|rms| !rms.is_finite()) {
                    return f64::NAN;
                }
                levels.windows(2).filter(|pair| pair[1] >= pair[0]).count() as f64
            };
            let count = largest(errors.iter().map(rising)).filter(|count| count.is_finite());
            let found = Evidence {
                computed: count,
                reference: Some(0.0),
                error: count,
                note: format!("{} speeds", self.runs.len()),
                ..Evidence::default()
            };
            evidence.push(("not_falling".into(), found));
        }
        evidence
    }
}
