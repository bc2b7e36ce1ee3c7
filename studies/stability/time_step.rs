//! `asks = "time_step"`: free and notched bodies just below and just above their largest stable time step: bounded below it,
//! above it growing in the mode that is predicted and as fast, and not taken for a result.

use super::body::{FreeBody, FreeBodyAsked, Look, Mode, Pace};
use super::growing::{Growing, Grown, norm};
use super::time_step_report as report;
use crate::bar::names::names;
use crate::dispersion::sweep::LatticeSweep;
use crate::question::{Answer, Claiming, Place, Planned, Question, claim, error_of};
use crate::rounded::rounded;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::forces::surface::Correction;
use pd_verify::lattice::Lattice;
use pd_verify::material::{Body, Material};
use pd_verify::plan::Plan;
use pd_verify::record::Failure;
use pd_verify::scene::Wrong;
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeStepAsked {
    pub body: FreeBodyAsked,
    /// For how many steps a body below its limit is marched, from 5000 on: by then what grows has grown.
    pub steps: u64,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct TimeStepLimit {
    pub title: String,
    pub bodies: Vec<FreeBody>,
    pub names: Vec<String>,
    pub steps: u64,
    pub surface: Correction,
    /// The largest step that a plan allows over the lattice's limit, by body.
    planned: Vec<f64>,
    plans: Vec<Plan>,
}

/// What one body did.
pub struct Seen {
    /// In s: the lattice's limit, the body's own, and the steps taken below and above.
    pub lattice_limit: f64,
    pub own_limit: f64,
    pub below: f64,
    pub above: f64,
    pub mode: Mode,
    pub bounded: Vec<Look>,
    pub grown: Vec<Look>,
    pub growing: Growing,
    pub measured: Grown,
    /// The step at which the march was given up; `None` where it was not.
    pub given_up: Option<u64>,
}

impl Seen {
    /// Whether the next mode is slow enough that what grew has the shape of the fastest.
    pub fn stands_alone(&self) -> bool {
        self.measured.most.is_some_and(|most| most <= SAYS_NOTHING)
    }
}

/// Shares of the limits at which is marched.
const BELOW: f64 = 0.99;
const ABOVE: f64 = 1.01;
/// A growth by e to this power is a growth that any body has room for: forces are some 1e20 of a displacement.
const FAR: f64 = 500.0;
/// Looks at a body.
const LOOKS: u64 = 60;
/// Fewer steps end before what grows is no longer a number.
const LEAST: u64 = 5000;
/// Nodes for which a mode is found in seconds, and that are marched for many steps.
const MOST_NODES: usize = 5000;
/// Steps from one look at whether a march is finite to the next.
const WATCHED: f64 = 1000.0;

impl Asked for TimeStepAsked {
    type Question = TimeStepLimit;

    fn check(&self, written: &Written<'_>) -> Result<TimeStepLimit, Wrong> {
        let material = written.material()?;
        if self.steps < LEAST {
            let message = format!("{} steps are too few to tell what grows from what does not", self.steps);
            return Err(Wrong::new("steps", message, format!("take {LEAST} or more")));
        }
        let (lattices, bodies) = bodies(&self.body, &self.lattice, material)?;
        // Above the limit a body grows by e in some 3.5 steps; the own limit, which sets them, is not known yet.
        let marches = [(BELOW, self.steps), (ABOVE, 2000), (ABOVE, 3000)];
        let (mut plans, mut planned) = (Vec::new(), Vec::new());
        for body in &bodies {
            plans.extend(body.plans(&marches)?);
            planned.push(body.planned_share()?);
        }
        Ok(TimeStepLimit {
            title: written.title.to_owned(),
            bodies,
            names: names(&lattices),
            steps: self.steps,
            surface: self.body.surface_correction.unwrap_or_default(),
            planned,
            plans,
        })
    }
}

impl Question for TimeStepLimit {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let steps = |claim: Claim| Claim { unit: "steps".into(), ..claim };
        let mut claims = self.limits(place);
        claims.extend([
            claim(place, "bounded", format!("by what the norm of the displacements exceeds that of the start, {} of the limit, {} steps", BELOW, self.steps))
                .at_most(ErrorKind::Relative, 1e-6)
                .because(Basis::Theory, "from rest leapfrog carries each mode as cos nθ, so that no norm, and no displacement, exceeds the norm of the start; rounding pushes the body as a whole by 1e-16 a step, n^1.5 of these are 1e-8 after 1e5 steps")
                .source("leapfrog from rest, u(n) = Σ u_k cos nθ_k, sin(θ_k/2) = ω_kΔt/2"),
            claim(place, "growth", "largest relative error of the logarithm of the fastest mode's growth, at all looks, above the limit")
                .at_most(ErrorKind::Relative, 1e-6)
                .because(Basis::Theory, "exact but for rounding; a frequency off by 1e-9 moves the logarithm by 1e-7, since dφ/d ln ω is 14 at 1.01 of the limit")
                .source("leapfrog from rest, u(n) = (−1)ⁿ cosh(nφ) u(0), φ = 2 arcosh(ωΔt/2)"),
            claim(place, "frequency", "relative difference of the frequency of the body that grew from that of its fastest mode")
                .at_most(ErrorKind::Relative, 1e-3)
                .because(Basis::Theory, "after a growth by e^500 a mode slower by a thousandth has fallen behind by e^25 or more, so that what is left is faster than that")
                .source("the largest eigenvalue of the body's force operator"),
            steps(claim(place, "given_up", "steps between the one at which a displacement leaves the range of numbers and the one at which the march is given up")
                .at_most(ErrorKind::Absolute, WATCHED)
                .because(Basis::Theory, "a march looks every 1000 steps at whether all is finite; forces leave the range a hundred steps before displacements do")
                .source("the same growth, from the part of the start that is in the fastest mode")),
        ]);
        claims.extend((!self.corrected()).then(|| {
            claim(place, "shape", "by what the sine of the angle between the body that grew and its fastest mode exceeds what slower modes may hold")
                .at_most(ErrorKind::Absolute, 1e-6)
                .because(Basis::Theory, "no slower mode grows faster than the next one, so all hold at most cosh(nφ₂)/cosh(nφ₁) of the start; bodies of which this is above 0.1, the next mode being too near, say nothing; 1e-6 for a mode that is known to 1e-12 over its distance from the next")
                .source("the two largest eigenvalues of the body's force operator and the first one's vector")
        }));
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.plans.clone()
    }

    fn equations(&self) -> &'static str {
        "u(n+1) − (2 − ω²Δt²) u(n) + u(n−1) = 0 for every mode, u(−1) = u(1) from rest
ωΔt/2 = sin(θ/2) below 1: u(n) = u(0) cos nθ; ωΔt/2 = cosh(φ/2) above: u(n) = (−1)ⁿ u(0) cosh nφ
body's own limit: 2/ω_max of K/ρ; with positive weights at least the lattice's"
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
            figures: report::figures(self, &all, place),
            ..Answer::default()
        }
    }
}

impl TimeStepLimit {
    /// Whether bonds near edges may be stiffer than the lattice's, so that its limit says nothing.
    pub fn corrected(&self) -> bool {
        self.surface != Correction::None
    }

    /// What is claimed of the body's own limit.
    fn limits(&self, place: &Place) -> Vec<Claim> {
        let planned = claim(place, "planned", "the body's own limit over the largest time step that a plan allows")
            .at_least(1.0 - ROUNDING)
            .because(Basis::Theory, "a plan divides the lattice's limit by the root of the largest factor of a bond: K is at most as much larger")
            .source("the largest eigenvalue of the body's force operator");
        if self.corrected() {
            let beyond = claim(place, "beyond", "the body's own limit over the lattice's")
                .at_most(ErrorKind::Absolute, BELOW)
                .because(Basis::Engineering, "corrected bonds are stiffer than the lattice's; the claim is that what is safe in a body of positive weights, 0.99 of the lattice's limit, is not safe here")
                .source("the largest eigenvalue of the body's force operator");
            return vec![beyond, planned];
        }
        let own = claim(place, "own_limit", "the body's own limit over the lattice's")
            .at_least(1.0 - ROUNDING)
            .because(Basis::Theory, "a field of the body, continued by zero, is a field of the lattice that holds no less energy: its largest eigenvalue is no smaller; 1e-9 for the search for the lattice's")
            .source("the lattice's largest frequency over the Brillouin zone");
        vec![own, planned]
    }

    fn see(&self, subject: &dyn Subject, body: &FreeBody) -> Result<Seen, String> {
        let lattice_limit = body.lattice_limit(subject)?;
        let mode = body.fastest(subject)?;
        let own_limit = 2.0 / mode.omega;
        let (below, above) = match self.corrected() {
            true => (BELOW * own_limit, BELOW * lattice_limit),
            false => (BELOW * lattice_limit, ABOVE * own_limit),
        };
        let march = |seconds: f64, steps: u64, every: u64| {
            body.march(subject, Pace { seconds, steps, every: every.max(1) })
        };
        let said = |failure: Failure| failure.to_string();
        // A prime number of looks or nearly: no period of a mode.
        let bounded = march(below, self.steps, self.steps / LOOKS + 1).map_err(said)?;
        let start = &bounded.first().ok_or("the body was not seen")?.displacement;
        let growing = Growing::new(&mode, above, start);
        let far = (FAR / growing.rate).clamp(1.0, LEAST as f64) as u64;
        let grown =
            if growing.rate > 0.0 { march(above, far, far / LOOKS).map_err(said)? } else { Vec::new() };
        let given_up = match march(above, self.steps, self.steps) {
            Err(Failure::Diverged(diverged)) => Some(diverged.step),
            Err(other) => return Err(other.to_string()),
            Ok(_) => None,
        };
        let measured = growing.held_against(&mode, &grown);
        Ok(Seen { lattice_limit, own_limit, below, above, mode, bounded, grown, growing, measured, given_up })
    }

    fn evidence(&self, all: &[Seen]) -> Vec<(String, Evidence)> {
        // The worst of all bodies, and which it is.
        let worst = |of: &dyn Fn(&Seen) -> Option<f64>| {
            let each: Option<Vec<f64>> = all.iter().map(of).collect();
            let worst = each.as_ref().and_then(|each| largest(each.iter().copied()));
            let at = each.and_then(|each| each.iter().position(|one| Some(*one) == worst));
            error_of(
                worst,
                at.map_or(String::new(), |at| format!("{} bodies; {}", all.len(), self.names[at])),
            )
        };
        let least = |of: &dyn Fn(&Seen) -> f64| {
            let largest = worst(&|seen| Some(-of(seen)));
            Evidence { computed: largest.error.map(|x| -x), error: None, ..largest }
        };
        let planned: Vec<f64> = all
            .iter()
            .zip(&self.planned)
            .map(|(seen, share)| seen.own_limit / (share * seen.lattice_limit))
            .collect();
        let tightest = largest(planned.iter().map(|share| -share)).map(|share| -share);
        let mut evidence = vec![
            (
                "planned".to_owned(),
                Evidence { computed: tightest, note: format!("{} bodies", all.len()), ..Evidence::default() },
            ),
            ("bounded".to_owned(), worst(&|seen| excess(&seen.bounded))),
            ("growth".to_owned(), worst(&|seen| seen.measured.error)),
            (
                "frequency".to_owned(),
                worst(&|seen| seen.measured.omega.map(|omega| (omega / seen.mode.omega - 1.0).abs())),
            ),
            (
                "given_up".to_owned(),
                worst(&|seen| {
                    Some(
                        seen.given_up
                            .map_or(f64::INFINITY, |step| (step as f64 - seen.growing.overflow()).abs()),
                    )
                }),
            ),
        ];
        evidence.push(match self.corrected() {
            true => ("beyond".to_owned(), worst(&|seen| Some(seen.own_limit / seen.lattice_limit))),
            false => ("own_limit".to_owned(), least(&|seen| seen.own_limit / seen.lattice_limit)),
        });
        if !self.corrected() {
            evidence.push(("shape".to_owned(), self.shape(all)));
        }
        evidence
    }

    /// Of the bodies whose fastest mode stands alone.
    fn shape(&self, all: &[Seen]) -> Evidence {
        let alone = || all.iter().filter(|seen| seen.stands_alone());
        let beyond = |seen: &Seen| {
            let beyond = seen.measured.sine? - seen.measured.most?;
            Some(if beyond < 0.0 { 0.0 } else { beyond })
        };
        let each: Option<Vec<f64>> = alone().map(beyond).collect();
        let widest = largest(alone().filter_map(|seen| seen.measured.sine));
        let note = format!(
            "{} of {} bodies; sine of the angle at most {}",
            alone().count(),
            all.len(),
            widest.map_or("unknown".into(), rounded)
        );
        error_of(each.and_then(largest), note)
    }
}

/// What slower modes may hold of a body that says nothing about the shape of the fastest.
const SAYS_NOTHING: f64 = 0.1;

/// The lattices of a sweep, and the body that is asked for of each.
pub fn bodies(
    asked: &FreeBodyAsked,
    sweep: &LatticeSweep,
    material: Material,
) -> Result<(Vec<Lattice>, Vec<FreeBody>), Wrong> {
    let nodes = asked.nodes.iter().try_fold(1_usize, |count, &n| count.checked_mul(n));
    if nodes.is_none_or(|nodes| nodes > MOST_NODES) {
        let message = "a body this large is not marched for so many steps";
        return Err(Wrong::new("body.nodes", message, format!("take at most {MOST_NODES} nodes")));
    }
    let lattices = sweep.marched(Body::from(asked.is), 3).map_err(|wrong| wrong.inside("lattice"))?;
    let made = |lattice: &Lattice| asked.check(material, *lattice).map_err(|wrong| wrong.inside("body"));
    let bodies = lattices.iter().map(made).collect::<Result<Vec<_>, Wrong>>()?;
    Ok((lattices, bodies))
}

/// Of a limit that is searched for.
const ROUNDING: f64 = 1e-9;

/// By what the norm exceeds that of the start at any look, over it; NaN where it is no number.
pub fn excess(looks: &[Look]) -> Option<f64> {
    let start = norm(&looks.first()?.displacement);
    let over = largest(looks.iter().map(|look| norm(&look.displacement) / start - 1.0))?;
    Some(if over < 0.0 { 0.0 } else { over })
}
