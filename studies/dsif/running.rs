//! `asks = "running_crack"`: a long crack at rest under a wave sets out at a given speed. K, read with the fields of a running
//! tip, is k(v) times that of the crack at rest at the same place.

use super::known::{Known, KnownAsked, Window, holds_until};
use super::load::{Load, LoadAsked, On};
use super::plate::{CrackPlace, PlateAsked};
use super::running_report as report;
use super::runs::{Run, Way, check_speeds};
use super::said::{check_levels, check_reason};
use super::setup::{Problem, SAFETY, Seen, Setup};
use super::smooth::smooth;
use crate::convergence::path::WeightsAsked;
use crate::input::OneOrMany;
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of};
use crate::rounded::rounded;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::scene::{Positive, Wrong};
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
        if !known.is_freund() {
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
        check_levels(&spacings)?;
        check_reason(&self.because)?;
        if self.terms == Some(0) {
            return Err(Wrong::new("terms", "K is the first term", "give 1 or more"));
        }
        let elastic = Elastic::of(material, body)
            .ok_or_else(|| Wrong::new("plate.body", "a bar has no crack", "take a plate"))?;
        let shares: Vec<f64> = self.speeds.iter().map(|share| share.0).collect();
        let rayleigh = rayleigh_speed(&elastic);
        check_speeds(&shares)?;
        // The last looks that are judged are smoothed with later ones.
        let slowest = shares.iter().copied().fold(f64::INFINITY, f64::min) * rayleigh;
        let until = to + 0.5 * spacings[0] / slowest;
        let fastest = shares.iter().copied().fold(0.0, f64::max) * rayleigh;
        for &dx in &spacings {
            let plate = self.plate.on(dx)?;
            known.check_height(&self.plate, &plate)?;
            let further = plate.further(fastest * (until - start));
            let (at_rest, _) = holds_until(&known, (material, body), &plate, &load)?;
            let (gone, _) = holds_until(&known, (material, body), &further, &load)?;
            let last = at_rest.min(gone);
            if until > last * (1.0 + 1e-9) {
                let message = format!(
                    "the reference holds to {} s, and K is seen to {} s",
                    rounded(last),
                    rounded(until)
                );
                return Err(Wrong::new("to_arrivals", message, "end earlier, or take a larger plate"));
            }
        }
        let problem =
            Problem { material, body, plate: self.plate.clone(), load: load.clone(), until, safety: SAFETY };
        let outer = self.outer_horizons.map_or(3.0, |outer| outer.0);
        if outer <= 2.0 {
            let message = format!("no annulus lies between 2 and {outer} horizons");
            return Err(Wrong::new("outer_horizons", message, "take more than 2"));
        }
        let way = Way { start, before: load.before(), by: until - start, outer, rayleigh };
        let runs = self.speeds.iter().map(|share| way.run(&problem, weights, share.0, self.m.0, &spacings));
        let runs: Vec<Run> = runs.collect::<Result<_, _>>()?;
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
        if self.falls() {
            let quantity = format!("levels at which the error of K_{mode} does not fall, all speeds");
            claims.push(
                claim(place, "not_falling", quantity)
                    .exactly()
                    .because(
                        Basis::Theory,
                        "what cuts bonds lies beside the tip by a part of the horizon: its trace is the term r^(-1/2), which is fitted, and the annulus shrinks with the horizon",
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
    /// Whether the error is to fall with the horizon: where the trace of the zone that cuts bonds is fitted too.
    fn falls(&self) -> bool {
        self.process_zone && self.runs[0].setups.len() > 1
    }

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
        let pairs: Option<Vec<(f64, f64)>> =
            inside.map(|(t, k)| Some(((*k)?, self.known_at(run, *t)?))).collect();
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
                let mut listed = levels.iter().map(|rms| rounded(*rms)).collect::<Vec<_>>().join(", ");
                for moved in
                    run.setups.iter().map(|setup| &setup.plate.moved).filter(|moved| !moved.is_empty())
                {
                    listed += &format!("; {moved}");
                }
                (name(run), error_of(levels.last().copied(), listed))
            })
            .collect();
        if self.falls() {
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
