//! `asks = "divergence"`: bodies marched above their limit are given up soon, with what is known of them: until when they
//! were sound, and the step that holds; bodies that grow for good reasons at the limit are not.
//!
//! From rest with the norm A, g the fastest mode's share of it, s = Δt over the own limit > 1, cosh(φ/2) = s. Modes that
//! leapfrog carries move by ‖d‖ ≤ 2A, all by 2sA cosh((n−½)φ), the fastest by 2sgA cosh((n−½)φ). So s² of the motion
//! exceeds 1 from cosh((n−½)φ) = 1/(gs√(s²−1)) on at the latest, and until then ‖u‖ ≤ A e^{φ/2}/(gs√(s²−1)); kinetic energy has
//! grown 10⁸-fold beyond all sound looks, or beyond a first one that was not sound, when cosh²((n−½)φ) reaches 10⁸ times
//! 1/(g⁴s²(s²−1)) and cosh²(3.5φ)/g². The next look at a power of two, or at a thousand, sees it.

use super::body::{FreeBody, FreeBodyAsked, Look, Pace};
use super::divergence_report as report;
use super::growing::{Growing, norm};
use super::sound::Grown;
use super::time_step::{bodies, excess};
use crate::bar::names::names;
use crate::dispersion::sweep::LatticeSweep;
use crate::question::{Answer, Claiming, Place, Planned, Question, claim, error_of, value_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::plan::Plan;
use pd_verify::record::Diverged;
use pd_verify::scene::Wrong;
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DivergenceAsked {
    pub body: FreeBodyAsked,
    /// Time steps over the body's own limit, above 1.
    pub over_limit: Vec<f64>,
    /// Of the marches that must hold, and of those that grow soundly.
    pub steps: u64,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct Divergence {
    pub title: String,
    pub bodies: Vec<FreeBody>,
    pub names: Vec<String>,
    over_limit: Vec<f64>,
    steps: u64,
    plans: Vec<Plan>,
}

/// A body at one step beyond its limit.
pub struct Beyond {
    /// Δt over the own limit.
    pub over: f64,
    /// In s.
    pub own_limit: f64,
    pub looks: Vec<Look>,
    pub diverged: Option<Box<Diverged>>,
    /// The last step at which it may be given up.
    pub latest: u64,
    /// What ‖u‖ may be until the last sound look, over that of the start.
    pub allowed: f64,
    /// By what the norm exceeds that of the start at the step that is said to hold.
    pub held: Option<f64>,
}

/// What one body did: beyond its limit, and at it.
pub struct Seen {
    pub beyond: Vec<Beyond>,
    pub grown: Vec<Grown>,
}

/// Steps that a march above its limit may take: then it must have been given up.
const ENOUGH: u64 = 20_000;
/// Steps from one look at the whole body to the next.
const EVERY: u64 = 4;
/// Fewer steps are no test of what holds.
const LEAST: u64 = 1000;
/// Where the march looks for growth, and for which.
const FIRST: u64 = 4;
const SELDOM: u64 = 1000;
const GROWN: f64 = 1e8;
/// Below, growth takes more steps than are marched.
const LEAST_OVER: f64 = 1.0002;

impl Asked for DivergenceAsked {
    type Question = Divergence;

    fn check(&self, written: &Written<'_>) -> Result<Divergence, Wrong> {
        if self.steps < LEAST {
            let message = format!("{} steps are too few to tell what holds", self.steps);
            return Err(Wrong::new("steps", message, format!("take {LEAST} or more")));
        }
        let far = |over: &f64| (LEAST_OVER..=1.5).contains(over);
        if self.over_limit.is_empty() || !self.over_limit.iter().all(far) {
            let message = format!("steps over the limit between {LEAST_OVER} and 1.5 are asked for");
            return Err(Wrong::new("over_limit", message, "take for example [1.01, 1.001]"));
        }
        let (lattices, bodies) = bodies(&self.body, &self.lattice, written.material()?)?;
        let mut plans = Vec::new();
        for body in &bodies {
            // When growth shows is not known before the modes are: a thousand steps, about.
            let beyond = self.over_limit.iter().flat_map(|&over| [(over, SELDOM), (1.0, self.steps)]);
            plans.extend(body.plans(&beyond.collect::<Vec<_>>())?);
            plans.extend(body.sound_plans(self.steps)?);
        }
        Ok(Divergence {
            title: written.title.to_owned(),
            names: names(&lattices),
            bodies,
            over_limit: self.over_limit.clone(),
            steps: self.steps,
            plans,
        })
    }
}

impl Question for Divergence {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let modes = "leapfrog from rest, u(n) = (−1)ⁿ cosh(nφ) u(0) of the fastest mode, φ = 2 arcosh(ωΔt/2)";
        let recognised = claim(place, "recognised", "steps by which a march above the limit is given up after the last look that growth leaves it")
            .at_most(ErrorKind::Absolute, 0.0)
            .because(Basis::Theory, "modes that leapfrog carries move by at most twice the start, the fastest grows as predicted: from a step on that follows from its share of the start its motion outweighs all others and has grown 1e8-fold; looks are at powers of two and thousands")
            .source(modes);
        vec![
            Claim { unit: "steps".into(), ..recognised },
            claim(place, "sound", "largest norm of the displacements up to the last sound look, over what growth may have made of it")
                .at_most(ErrorKind::Relative, 1.0)
                .because(Basis::Theory, "a look finds motion sound only while what grows moves with less than 1/(s² − 1) of the energy of what does not")
                .source(modes),
            claim(place, "own_limit", "relative difference of the limit that is reported from the body's own")
                .at_most(ErrorKind::Relative, 1e-6)
                .because(Basis::Theory, "an eigenvalue lies within its residual of 1e-6; its root within half of that")
                .source("the largest eigenvalue of the body's force operator, from the start and to 1e-12"),
            claim(place, "holds", format!("by what the norm of the displacements exceeds that of the start at the step that is said to hold, {} steps", self.steps))
                .at_most(ErrorKind::Relative, 1e-6)
                .because(Basis::Theory, "from rest leapfrog carries each mode as cos nθ below the limit; rounding pushes the body as a whole by 1e-16 a step")
                .source("leapfrog from rest, u(n) = Σ u_k cos nθ_k"),
            claim(place, "false_alarms", "motions that grow for good reasons and are taken for a divergence")
                .exactly()
                .because(Basis::Theory, "at the limit and below it s² of the motion is a mean of (ωΔt/2)² ≤ 1, whatever acts; with finite rotations at strains of 1e-3 it stays below as well")
                .source("Rayleigh's quotient never exceeds the largest eigenvalue"),
            claim(place, "growth", "least growth of the kinetic energy of these motions")
                .at_least(1e3)
                .because(Basis::Engineering, "under a constant load or in resonance energy grows with the square of the time, from the first steps on a thousandfold and more: motions that grow by less would say nothing")
                .source("Newton's second law"),
        ]
    }

    fn scenes(&self) -> Vec<Planned> {
        self.plans.clone()
    }

    fn equations(&self) -> &'static str {
        "s² = ¼Δt² dᵀKd/dᵀMd ≤ (Δt/Δt_own)², d = u(n) − u(n−1): above 1 it proves that Δt is above the body's own limit"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let all: Vec<Result<Seen, String>> =
            self.bodies.par_iter().map(|body| self.see(subject, body)).collect();
        let all: Vec<Seen> = match all.into_iter().collect() {
            Ok(all) => all,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        Answer {
            evidence: self.evidence(&all),
            tables: vec![report::table(self, &all, place)],
            figures: vec![report::figure(self, &all, place)],
            ..Answer::default()
        }
    }
}

impl Divergence {
    fn see(&self, subject: &dyn Subject, body: &FreeBody) -> Result<Seen, String> {
        let mode = body.fastest(subject)?;
        let own_limit = 2.0 / mode.omega;
        let mut beyond = Vec::new();
        for &over in &self.over_limit {
            let pace = Pace { seconds: over * own_limit, steps: ENOUGH, every: EVERY };
            let (looks, diverged) = body.watched(subject, pace).map_err(|failure| failure.to_string())?;
            let start = &looks.first().ok_or("the body was not seen")?.displacement;
            let growing = Growing::new(&mode, over * own_limit, start);
            let held = match diverged.as_ref().and_then(|diverged| diverged.holds()) {
                None => None,
                Some(seconds) => {
                    let pace = Pace { seconds, steps: self.steps, every: self.steps / 60 + 1 };
                    excess(&body.march(subject, pace).map_err(|failure| failure.to_string())?)
                }
            };
            let (latest, allowed) = (latest(&growing, over), allowed(&growing, over));
            beyond.push(Beyond { over, own_limit, looks, diverged, latest, allowed, held });
        }
        Ok(Seen { beyond, grown: body.grow_soundly(subject, self.steps)? })
    }

    fn evidence(&self, all: &[Seen]) -> Vec<(String, Evidence)> {
        let each = || all.iter().flat_map(|seen| &seen.beyond);
        let worst = |of: &dyn Fn(&Beyond) -> Option<f64>| {
            let values: Option<Vec<f64>> = each().map(of).collect();
            error_of(values.and_then(largest), format!("{} marches", each().count()))
        };
        let late = |beyond: &Beyond| {
            let late = beyond.diverged.as_ref().map(|diverged| diverged.step.saturating_sub(beyond.latest));
            Some(late.map_or(f64::INFINITY, |steps| steps as f64))
        };
        let own = |beyond: &Beyond| {
            let reported = beyond.diverged.as_ref()?.own_limit?;
            Some((reported / beyond.own_limit - 1.0).abs())
        };
        let sound: Vec<f64> = each().filter_map(Beyond::sound).collect();
        let grown = || all.iter().flat_map(|seen| &seen.grown);
        let (alarms, motions) = (grown().filter(|grown| grown.alarm).count(), grown().count());
        let growth: Option<Vec<f64>> = grown().map(|grown| grown.growth.map(|growth| -growth)).collect();
        let least = growth.and_then(largest).map(|growth| -growth);
        vec![
            ("recognised".into(), worst(&late)),
            (
                "sound".into(),
                error_of(largest(sound.iter().copied()), format!("{} marches with sound looks", sound.len())),
            ),
            ("own_limit".into(), worst(&own)),
            ("holds".into(), worst(&|beyond| beyond.held)),
            (
                "false_alarms".into(),
                value_of((motions > 0).then_some(alarms as f64), Some(0.0), format!("{motions} motions")),
            ),
            (
                "growth".into(),
                Evidence { computed: least, note: format!("{motions} motions"), ..Evidence::default() },
            ),
        ]
    }
}

impl Beyond {
    /// The largest norm up to the last sound look over what it may be; `None` where no look was sound.
    fn sound(&self) -> Option<f64> {
        let last = self.diverged.as_ref()?.sound_step?;
        let start = norm(&self.looks.first()?.displacement);
        let until = self.looks.iter().filter(|look| look.step <= last);
        largest(until.map(|look| norm(&look.displacement) / start / self.allowed))
    }
}

/// cosh((n−½)φ) from which on motion that leapfrog cannot carry outweighs the rest.
fn outweighs(growing: &Growing, over: f64) -> f64 {
    1.0 / (growing.share() * over * (over * over - 1.0).sqrt())
}

fn allowed(growing: &Growing, over: f64) -> f64 {
    libm::exp(0.5 * growing.rate) * outweighs(growing, over)
}

/// The look at which growth must have shown.
fn latest(growing: &Growing, over: f64) -> u64 {
    let (share, rate) = (growing.share(), growing.rate);
    let sound = outweighs(growing, over) / share;
    let first = libm::cosh((FIRST as f64 - 0.5) * rate) / share;
    let cosh = GROWN.sqrt() * sound.max(first);
    // cosh x ≥ ½ eˣ.
    let step = (libm::log(2.0 * cosh) / rate + 0.5).ceil().max(1.0) as u64;
    let doubled = step.next_power_of_two().max(FIRST);
    if doubled < SELDOM { doubled } else { step.div_ceil(SELDOM) * SELDOM }
}
