//! `asks = "stress_intensity"`: K over time at the tip of a loaded crack, on one lattice or many, read in one way or
//! many, against the exact history within a window.

use super::expect::{Expect, ExpectAsked};
use super::extraction::{Extraction, ExtractionAsked};
use super::foreign::ForeignHistory;
use super::intensity_report as report;
use super::known::{Known, KnownAsked, Window, WindowAsked, holds_until};
use super::load::{Load, LoadAsked, On};
use super::plate::PlateAsked;
use super::said::{check_cells, check_lattices, check_levels, check_name};
use super::setup::{Problem, SAFETY, Seen, Setup};
use super::tips::Tips;
use crate::bar::names;
use crate::convergence::path::{Weights, WeightsAsked};
use crate::dispersion::sweep::check_count;
use crate::foreign::Foreign;
use crate::input::OneOrMany;
use crate::question::{Answer, Effort, Place, Planned, Question};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::Claim;
use pd_verify::material::{Body, Material};
use pd_verify::scene::{Positive, Wrong};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// What K is divided by in figures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum UnitName {
    /// σ₀√H, H half the height.
    #[default]
    Height,
    /// σ₀√(πa), a the length of an edge crack, half that of one in the middle.
    Crack,
}

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct IntensityAsked {
    pub plate: PlateAsked,
    pub load: LoadAsked,
    pub known: KnownAsked,
    pub window: WindowAsked,
    /// δ/Δx; growing where δ is fixed.
    pub m: OneOrMany<Positive>,
    /// Levels from coarse to fine, at fixed m.
    pub dx_m: Option<OneOrMany<Positive>>,
    /// δ in m instead: each m is a level.
    pub horizon_m: Option<Positive>,
    pub weights: WeightsAsked,
    /// Time step over the limit; default 0.9.
    pub safety: Option<Positive>,
    pub extraction: Vec<ExtractionAsked>,
    #[serde(default)]
    pub expect: Vec<ExpectAsked>,
    /// Default: `height`.
    pub normalized_by: Option<UnitName>,
    /// Half the side in m of the field around the tip that is drawn; left out, none is drawn.
    pub field_m: Option<Positive>,
}

/// One kind of weights, from coarse to fine.
pub struct Track {
    pub name: String,
    pub slug: String,
    pub setups: Vec<Setup>,
}

/// The question.
pub struct Intensity {
    pub title: String,
    pub material: Material,
    pub plate: PlateAsked,
    pub load: Load,
    pub known: Known,
    pub window: Window,
    /// What ends the validity of the answer.
    pub ends: &'static str,
    pub tracks: Vec<Track>,
    /// Whether δ is fixed and m grows.
    pub by_m: bool,
    pub extractions: Vec<Extraction>,
    pub expect: Vec<Expect>,
    pub unit: UnitName,
    pub half_height: f64,
    pub field: Option<f64>,
}

/// What one extraction found on one lattice.
#[derive(Debug, Clone)]
pub struct Read {
    /// In s after the nominal start.
    pub times: Vec<f64>,
    /// a of the crack in m, as its lattice has it.
    pub a: f64,
    /// K_I and K_II in Pa√m at each.
    pub k: Vec<[f64; 2]>,
    /// Of its tip at rest, where that can be told; divided by where the extraction says so.
    pub factors: Option<[f64; 2]>,
}

impl Read {
    /// K of a mode at t in s, straight between looks; `None` beyond them.
    pub fn at(&self, t: f64, mode: usize) -> Option<f64> {
        let after = self.times.partition_point(|&time| time < t);
        let (before, last) = (after.checked_sub(1)?, self.times.get(after)?);
        let (from, to) = (self.k[before][mode], self.k[after][mode]);
        Some(from + (to - from) * (t - self.times[before]) / (last - self.times[before]))
    }
}

/// All extractions of all levels of all tracks, and the last field around each finest tip.
pub struct Found {
    /// By track, level, extraction.
    pub reads: Vec<Vec<Vec<Read>>>,
    /// Displacement around the finest tip of the first track, at the end of the window.
    pub field: Option<Vec<[f64; 2]>>,
}

impl Asked for IntensityAsked {
    type Question = Intensity;

    fn check(&self, written: &Written<'_>) -> Result<Intensity, Wrong> {
        self.weighed(written, &self.weights.all().map_err(|wrong| wrong.inside("weights"))?)
    }
}

impl IntensityAsked {
    /// The case with these weights in place of its own.
    pub fn weighed(&self, written: &Written<'_>, weights: &[Weights]) -> Result<Intensity, Wrong> {
        let (material, body) = (written.material()?, self.plate.body.into());
        let load = self.load.check(self.plate.lateral.unwrap_or_default())?;
        let known = self.known.check((material, body), &self.plate, &load)?;
        let extractions = extractions(&self.extraction)?;
        let levels = self.levels()?;
        let (mut last, mut ends) = (f64::INFINITY, "");
        let mut cells = Vec::new();
        for &(m, dx) in levels.iter().flatten() {
            let plate = self.plate.on(dx)?;
            known.check_height(&self.plate, &plate)?;
            cells.push(plate.nodes);
            let (until, what) = holds_until(&known, (material, body), &plate, &load)?;
            let until = until - seen_before(&extractions, m * dx, (material, body), &load);
            if until < last {
                (last, ends) = (until, what);
            }
        }
        let window = self.window.check(&known, last)?;
        let problem = Problem {
            material,
            body,
            plate: self.plate.clone(),
            load: load.clone(),
            until: window.to,
            safety: self.safety.map_or(SAFETY, |safety| safety.0),
        };
        let mut tracks = Vec::new();
        check_cells(&cells, weights.len())?;
        check_lattices(weights, &self.m.0, self.dx_m.as_ref().map_or(1, |dx| dx.0.len()))?;
        for levels in &levels {
            for weights in weights {
                let mut setups: Vec<Setup> = Vec::new();
                for &(m, dx) in levels {
                    let same = setups.last().filter(|before| before.lattice.m == m).map(Setup::limit);
                    let around = self.field_m.map_or(0.0, |half| half.0);
                    setups.push(problem.on(weights.lattice(m), dx, &extractions, around, same)?);
                }
                tracks.push(Track { name: String::new(), slug: weights.slug(), setups });
            }
        }
        name(&mut tracks, self.horizon_m.is_some());
        let expect = Expect::all(
            &self.expect,
            &extractions,
            &tracks,
            known.has_published(),
            self.horizon_m.is_some(),
        )?;
        Ok(Intensity {
            title: written.title.to_owned(),
            material,
            plate: self.plate.clone(),
            load,
            known,
            window,
            ends,
            tracks,
            by_m: self.horizon_m.is_some(),
            extractions,
            expect,
            unit: self.normalized_by.unwrap_or_default(),
            half_height: self.plate.half_height(),
            field: self.field_m.map(|half| half.0),
        })
    }
}

/// How long before it reaches the tip a wave is seen by the widest annulus, in s: with loaded faces K grows all the time, and
/// what comes back is no plane wave. (From loaded edges the first that comes back is the tip's own wave, spread out and weak;
/// by finite elements K and displacements beside the tip hold until it is there.)
fn seen_before(
    extractions: &[Extraction],
    horizon: f64,
    (material, body): (Material, Body),
    load: &Load,
) -> f64 {
    let widest = extractions.iter().filter_map(|one| Some(one.radii(horizon)?.outer)).fold(0.0, f64::max);
    if load.on == On::Faces { widest / material.dilatational_speed(body) } else { 0.0 }
}

/// Each is prepared for every lattice.
const MOST_EXTRACTIONS: usize = 200;

/// Extractions with names of their own.
pub fn extractions(asked: &[ExtractionAsked]) -> Result<Vec<Extraction>, Wrong> {
    if asked.is_empty() {
        return Err(Wrong::new("", "no extraction reads K", "add [[case.extraction]] with a method"));
    }
    if asked.len() > MOST_EXTRACTIONS {
        let message =
            format!("{} extractions are more than the {MOST_EXTRACTIONS} that are prepared", asked.len());
        return Err(Wrong::new("extraction", message, "split the case"));
    }
    let mut all: Vec<Extraction> = Vec::new();
    for (index, one) in asked.iter().enumerate() {
        let path = format!("extraction[{index}]");
        let one = one.check().map_err(|wrong| wrong.inside(&path))?;
        let taken: Vec<String> = all.iter().map(|other: &Extraction| other.name.clone()).collect();
        check_name("name", &one.name, &taken).map_err(|wrong| wrong.inside(&path))?;
        all.push(one);
    }
    Ok(all)
}

/// Names tracks by what differs between their finest lattices.
fn name(tracks: &mut [Track], by_m: bool) {
    let finest: Vec<_> = tracks.iter().filter_map(|track| Some(track.setups.last()?.lattice)).collect();
    for (track, name) in tracks.iter_mut().zip(names::names(&finest)) {
        track.name = match by_m {
            true => name.split(", ").filter(|part| !part.starts_with("m = ")).collect::<Vec<_>>().join(", "),
            false => name,
        };
    }
}

impl IntensityAsked {
    /// m and Δx of every level of every refinement.
    fn levels(&self) -> Result<Vec<Vec<(f64, f64)>>, Wrong> {
        let m: Vec<f64> = self.m.0.iter().map(|m| m.0).collect();
        match (&self.dx_m, self.horizon_m) {
            (Some(dx), None) => {
                let dx: Vec<f64> = dx.0.iter().map(|dx| dx.0).collect();
                check_levels(&dx)?;
                check_count(&[m.len(), dx.len()])?;
                Ok(m.iter().map(|&m| dx.iter().map(|&dx| (m, dx)).collect()).collect())
            }
            (None, Some(horizon)) => {
                if !m.windows(2).all(|pair| pair[0] < pair[1]) {
                    return Err(Wrong::new("m", "at fixed horizon each m is a level", "write growing m"));
                }
                Ok(vec![m.into_iter().map(|m| (m, horizon.0 / m)).collect()])
            }
            _ => {
                let message = "a lattice needs dx_m, or horizon_m with m as levels";
                Err(Wrong::new("", message, "give one of the two"))
            }
        }
    }
}

impl Intensity {
    pub fn setups(&self) -> impl Iterator<Item = &Setup> {
        self.tracks.iter().flat_map(|track| &track.setups)
    }

    /// Those whose tips at rest are asked for: none where nothing is divided by a tip factor or compared with one.
    fn with_tips(&self) -> impl Iterator<Item = &Setup> {
        let divided = self.extractions.iter().any(|one| one.tip_factor);
        let needed = divided || self.expect.iter().any(Expect::asks_for_factors);
        self.setups().filter(move |_| needed)
    }

    /// Marches every lattice and reads K in every way.
    pub fn find(&self, subject: &dyn Subject) -> Result<Found, String> {
        self.find_with(subject, &Tips::of(self.with_tips(), subject)?)
    }

    /// The same where the tips at rest are known.
    pub fn find_with(&self, subject: &dyn Subject, tips: &Tips) -> Result<Found, String> {
        let work: Vec<&Setup> = self.setups().collect();
        let done: Vec<Result<(Vec<Read>, Seen), String>> =
            work.par_iter().map(|setup| self.read(subject, setup, tips)).collect();
        let mut done: Vec<(Vec<Read>, Seen)> = done.into_iter().collect::<Result<_, _>>()?;
        let finest = self.tracks[0].setups.len() - 1;
        let field = self.field.and_then(|_| done[finest].1.displacement.last().cloned());
        let reads = self
            .tracks
            .iter()
            .map(|track| done.drain(..track.setups.len()).map(|(reads, _)| reads).collect());
        Ok(Found { reads: reads.collect(), field })
    }

    /// Marches one lattice and reads K in every way.
    pub fn read(
        &self,
        subject: &dyn Subject,
        setup: &Setup,
        tips: &Tips,
    ) -> Result<(Vec<Read>, Seen), String> {
        let seen = setup.march(subject)?;
        let mut reads = Vec::new();
        for extraction in &self.extractions {
            let factors = tips.factors(setup, extraction);
            let divisor = match (extraction.tip_factor, factors) {
                (true, Some(factors)) => factors,
                (true, None) => {
                    let name = &extraction.name;
                    return Err(format!("{name} looks too far for its tip factor: take fewer horizons"));
                }
                (false, _) => [1.0; 2],
            };
            let k = setup.read(subject, &seen, extraction, divisor)?;
            reads.push(Read { times: seen.times.clone(), a: setup.plate.a(), k, factors });
        }
        Ok((reads, seen))
    }

    /// What figures divide K by, in Pa√m.
    pub fn unit_of(&self, setup: &Setup) -> f64 {
        let length = match self.unit {
            UnitName::Height => self.half_height,
            UnitName::Crack => std::f64::consts::PI * setup.plate.a(),
        };
        self.load.stress * length.sqrt()
    }
}

impl Question for Intensity {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        self.expect.iter().map(|expect| expect.claim(self, place)).collect()
    }

    fn scenes(&self) -> Vec<Planned> {
        self.setups().map(|setup| setup.plan.clone()).collect()
    }

    fn effort(&self) -> Effort {
        let mut total = Effort::of_scenes(&self.scenes());
        total += Tips::effort(self.with_tips());
        total
    }

    fn equations(&self) -> &'static str {
        "K_I(t) = 2 sigma0/(1 - nu) sqrt(c_d t (1 - 2 nu)/pi), K_II(t) = 2 tau0 sqrt(2 c_s t/(pi (1 - nu))) after a step, nu the plane-strain ratio\n\
         K(t) = int (d sigma/ds) k(t - s) ds, k the response to a unit step\n\
         every reading is a sum of weights: K = sum w.u + sum w.a, over its value in the static field of a tip with K = 1"
    }

    fn foreign(&self) -> Vec<Box<dyn Foreign + '_>> {
        vec![Box::new(ForeignHistory::of(self))]
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        match self.find(subject) {
            Err(failure) => Answer::failed(&self.claims(place), &failure),
            Ok(found) => Answer {
                evidence: self
                    .expect
                    .iter()
                    .map(|expect| (expect.name.clone(), expect.evidence(self, &found)))
                    .collect(),
                tables: vec![report::histories(self, &found, place), report::errors(self, &found, place)],
                figures: report::figures(self, &found, place),
                ..Answer::default()
            },
        }
    }
}
