//! `asks = "discontinuities"`: a square wave, colliding pulses, a load put on at once, a load of alternating sign: the march
//! meets the exact answer of its lattice, fronts overshoot by what they may, and no peak exceeds the sum of its modes.

use super::body::{FreeBody, FreeBodyAsked, Look, Pace};
use super::discontinuities_report as report;
use super::growing::norm;
use super::jumps::{Exact, Jump};
use super::time_step::bodies;
use crate::bar::names::names;
use crate::dispersion::sweep::LatticeSweep;
use crate::question::{Answer, Claiming, Place, Planned, Question, claim, error_of};
use crate::rounded::rounded;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::plan::Plan;
use pd_verify::scene::{Positive, Scene, Wrong};
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written; a bar.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DiscontinuitiesAsked {
    pub body: FreeBodyAsked,
    pub steps: u64,
    /// Time step over the lattice's limit; default 0.9.
    pub safety: Option<Positive>,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct Discontinuities {
    pub title: String,
    pub marches: Vec<Jumping>,
    steps: u64,
}

/// A bar and what jumps.
pub struct Jumping {
    pub jump: Jump,
    pub name: String,
    pub body: FreeBody,
    pub plan: Plan,
    scene: Scene<1>,
}

/// What one bar did.
pub struct Seen {
    /// Largest difference from the exact answer, over the largest displacement.
    pub error: Option<f64>,
    /// Largest norm over its bound.
    pub norm: Option<f64>,
    /// By what displacements leave the range of the start until a front reaches an end, over what they may; of starts that jump.
    pub overshoot: Option<f64>,
    /// The largest displacement over its bound.
    pub most: Option<f64>,
    /// Steps and the largest displacement there, over the height.
    pub peaks: Vec<(u64, f64)>,
    /// Displacements over the height at a step on the way, marched and exact.
    pub way: (u64, Vec<f64>, Vec<f64>),
}

/// Steps from one look to the next: no multiple of a load's period.
const EVERY: u64 = 7;
/// ∫ Ai over its negative axis to the first zero, less 2/3: what a front of third-order dispersion exceeds its jump by.
const FRONT: f64 = 0.274_352;
const LEAST: u64 = 1000;

impl Asked for DiscontinuitiesAsked {
    type Question = Discontinuities;

    fn check(&self, written: &Written<'_>) -> Result<Discontinuities, Wrong> {
        let safety = self.safety.map_or(0.9, |safety| safety.0);
        if safety >= 1.0 {
            let message = format!("at {safety} of the limit nothing is bounded");
            return Err(Wrong::new("safety", message, "take a number below 1, for example 0.9"));
        }
        if self.steps < LEAST {
            let message = format!("{} steps are too few to tell what grows", self.steps);
            return Err(Wrong::new("steps", message, format!("take {LEAST} or more")));
        }
        let (lattices, bodies) = bodies(&self.body, &self.lattice, written.material()?)?;
        let mut marches = Vec::new();
        for (body, name) in bodies.iter().zip(names(&lattices)) {
            let FreeBody::Bar(bar) = body else {
                return Err(Wrong::new("body", "the exact answer is known in a bar", "take is = \"bar\""));
            };
            let plan = body.plans(&[(safety, self.steps)])?.remove(0);
            for jump in Jump::ALL {
                let scene = jump.on(bar, plan.time_step_s, self.steps);
                let body = FreeBody::Bar(scene.clone());
                let name = if lattices.len() == 1 {
                    jump.name().to_owned()
                } else {
                    format!("{}, {name}", jump.name())
                };
                marches.push(Jumping { jump, name, body, plan: plan.clone(), scene });
            }
        }
        Ok(Discontinuities { title: written.title.to_owned(), marches, steps: self.steps })
    }
}

impl Question for Discontinuities {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let modes = "modes of the bar of N nodes, u(n) = Σ a_k sin κ_k(j + ½) cos nθ_k, and for a load (−1)ⁿf the response −Δt²f/(4ρ(1 − s_k²))";
        vec![
            claim(place, "exact", format!("largest difference from the exact answer of the lattice over the largest displacement, {} steps", self.steps))
                .at_most(ErrorKind::LinfRelative, 1e-10)
                .because(Basis::Rounding, "frequencies to 1e-14 turn by 1e-11 in some thousand steps; roundings of 1e-16 a step add up to less")
                .source(modes),
            claim(place, "norm", "largest norm of the displacements over what it may be")
                .at_most(ErrorKind::Relative, 1.0 + 1e-10)
                .because(Basis::Theory, "each mode goes as cos nθ: a start keeps below its norm, a load below twice that of what it holds at rest, or holds with alternating sign; 1e-10 for rounding")
                .source(modes),
            claim(place, "overshoot", "by what displacements leave the range of a start that jumps until a front reaches an end, over what the fronts may")
                .at_most(ErrorKind::Relative, 1.0)
                .because(Basis::Theory, "a jump parts into two fronts of half its height, each of which dispersion lets overshoot by 0.2744 of its height, the integral of the Airy function, however fine the lattice: all fronts of all jumps at one place and time are the worst there can be")
                .source("third-order dispersion of a step: u = ∫ Ai"),
            claim(place, "peak", format!("largest displacement of {} steps over what it may ever be", self.steps))
                .at_most(ErrorKind::Relative, 1.0)
                .because(Basis::Theory, "an almost periodic motion never exceeds the sum of the sizes of its modes, under a load twice that: a bound that knows no time, so that nothing grows")
                .source(modes),
        ]
    }

    fn scenes(&self) -> Vec<Planned> {
        self.marches.iter().map(|one| one.plan.clone()).collect()
    }

    fn equations(&self) -> &'static str {
        "u_k(n + 1) − (2 − 4s_k²) u_k(n) + u_k(n − 1) = Δt²f_k(n)/ρ, s_k = ω_kΔt/2 = sin θ_k/2
f(n) = (−1)ⁿf: u_k(n) = −Δt²f_k/(4ρ(1 − s_k²)) [(−1)ⁿ − cos nθ_k]"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let all: Vec<Result<Seen, String>> =
            self.marches.par_iter().map(|one| self.see(subject, one)).collect();
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

impl Discontinuities {
    fn see(&self, subject: &dyn Subject, one: &Jumping) -> Result<Seen, String> {
        let pace = Pace { seconds: one.plan.time_step_s, steps: self.steps, every: EVERY };
        let mut looks = one.body.march(subject, pace).map_err(|failure| failure.to_string())?;
        let height = one.jump.height(&one.scene);
        looks.iter_mut().for_each(|look| look.displacement.iter_mut().for_each(|u| *u /= height));
        let courant = one.body.courant(one.plan.time_step_s);
        let exact =
            one.jump.exact(one.scene.lattice, one.scene.nodes[0], courant).ok_or("leapfrog is unstable")?;
        let peaks: Vec<(u64, f64)> = looks.iter().map(|look| (look.step, peak(&look.displacement))).collect();
        let most = largest(peaks.iter().map(|(_, peak)| *peak));
        let allowed = FRONT * one.jump.jumps() as f64;
        let early = looks.iter().filter(|look| look.step <= exact.free);
        let left = largest(early.flat_map(|look| &look.displacement).map(|u| (u - 1.0).max(-u)));
        let on_the_way = looks.get(looks.len() / 20).ok_or("the bar was not seen")?;
        let way = (on_the_way.step, on_the_way.displacement.clone(), exact.at(on_the_way.step));
        Ok(Seen {
            error: most.and_then(|most| error(&looks, &exact, most)),
            norm: largest(looks.iter().map(|look| norm(&look.displacement) / exact.bound())),
            overshoot: left.filter(|_| allowed > 0.0).map(|left| left / allowed),
            most: most.map(|most| most / exact.most()),
            peaks,
            way,
        })
    }

    fn evidence(&self, all: &[Seen]) -> Vec<(String, Evidence)> {
        let worst = |each: Vec<(usize, Option<f64>)>| {
            let values: Option<Vec<f64>> = each.iter().map(|(_, value)| *value).collect();
            let worst = values.and_then(largest);
            let at = each.iter().find(|(_, value)| *value == worst).map(|(index, _)| *index);
            let note =
                at.map_or(String::new(), |at| format!("{} marches; {}", each.len(), self.marches[at].name));
            error_of(worst, note)
        };
        let each = |of: &dyn Fn(&Seen) -> Option<f64>| all.iter().map(of).enumerate().collect::<Vec<_>>();
        let mut jumping = each(&|seen| seen.overshoot);
        jumping.retain(|(index, _)| self.marches[*index].jump.jumps() > 0);
        let overshoot = worst(jumping);
        let widest = overshoot.error.map_or("unknown".into(), |share| rounded(FRONT * share));
        let overshoot =
            Evidence { note: format!("{}; {widest} of the height a jump", overshoot.note), ..overshoot };
        vec![
            ("exact".into(), worst(each(&|seen| seen.error))),
            ("norm".into(), worst(each(&|seen| seen.norm))),
            ("overshoot".into(), overshoot),
            ("peak".into(), worst(each(&|seen| seen.most))),
        ]
    }
}

fn peak(displacement: &[f64]) -> f64 {
    largest(displacement.iter().map(|u| u.abs())).unwrap_or(f64::NAN)
}

fn error(looks: &[Look], exact: &Exact, most: f64) -> Option<f64> {
    largest(looks.iter().map(|look| {
        let known = exact.at(look.step);
        if known.len() != look.displacement.len() {
            return f64::NAN;
        }
        peak(&look.displacement.iter().zip(known).map(|(u, known)| u - known).collect::<Vec<_>>()) / most
    }))
}
