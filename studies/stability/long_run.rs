//! `asks = "long_run"`: free and notched bodies over very many steps: what leapfrog conserves may drift only as rounding errors
//! add up, the momentum too, and no displacement grows, at surfaces least of all.
//!
//! In units of ρV/Δt², from rest with the norm A, ω_maxΔt/2 ≤ s: ‖u‖ ≤ A, ‖d‖ ≤ 2sA, Δt²‖F‖/ρ ≤ 4s²A, and what the
//! bonds of all nodes pull one by one has the norm Δt²‖S‖/ρ ≤ 2RC²A, R the sum of the lattice's weights and C = cΔt/Δx. With
//! roundings u of d, 3u of Δt²F/ρ, u of u and (family + 16)u of S (tests/invariant.rs), a step moves
//! H = ½d² + ½Δt²F·u/ρ by at most u A² [4s²(2 + 6s) + 2(family + 16)RC²], and the momentum's Σd by slips whose norm is
//! u A [2s + 12s² + 2(family + 16)RC²]. Slips that are independent, of mean zero, add up to λ√n of these with a probability
//! below 2 exp(−λ²/2): 7e-6 for λ = 5 (Hoeffding; Higham & Mary 2019).

use super::body::{FreeBody, FreeBodyAsked, Look, Pace};
use super::growing::norm;
use super::long_run_report as report;
use super::time_step::{bodies, excess};
use crate::bar::names::names;
use crate::dispersion::sweep::LatticeSweep;
use crate::question::{Answer, Claiming, Place, Planned, Question, claim, error_of};
use crate::rounded::rounded;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::plan::Plan;
use pd_verify::scene::{Positive, Wrong};
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LongRunAsked {
    pub body: FreeBodyAsked,
    pub steps: u64,
    /// Time step over the lattice's limit; default 0.8.
    pub safety: Option<Positive>,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct LongRun {
    pub title: String,
    pub bodies: Vec<FreeBody>,
    pub names: Vec<String>,
    safety: f64,
    steps: u64,
    pub plans: Vec<Plan>,
}

/// What one body kept.
pub struct Kept {
    /// H at the first look in J.
    pub energy: f64,
    /// By look: the step, |H − H₀|, and what rounding allows, in J.
    pub drift: Vec<(u64, f64, f64)>,
    /// By look: the step, the momentum, and what rounding allows, in N s.
    pub momentum: Vec<(u64, f64, f64)>,
    pub excess: Option<f64>,
}

/// u of rounding to nearest.
const UNIT: f64 = 0.5 * f64::EPSILON;
/// Independent slips exceed this many standard bounds once in a hundred thousand runs.
const LAMBDA: f64 = 5.0;
/// Looks at the accounts.
const LOOKS: u64 = 200;
/// Fewer are no long run.
const LEAST: u64 = 1000;

impl Asked for LongRunAsked {
    type Question = LongRun;

    fn check(&self, written: &Written<'_>) -> Result<LongRun, Wrong> {
        let safety = self.safety.map_or(0.8, |safety| safety.0);
        if safety >= 1.0 {
            let message = format!("{safety} of the limit leaves nothing that is conserved");
            return Err(Wrong::new("safety", message, "take a number below 1, for example 0.8"));
        }
        if self.steps < LEAST {
            let message = format!("{} steps are no long run", self.steps);
            return Err(Wrong::new("steps", message, format!("take {LEAST} or more")));
        }
        if self.body.surface_correction.is_some() {
            let message = "corrected surfaces are not bounded by the lattice's weights";
            return Err(Wrong::new("body.surface_correction", message, "leave it out"));
        }
        let (lattices, bodies) = bodies(&self.body, &self.lattice, written.material()?)?;
        let mut plans = Vec::new();
        for body in &bodies {
            plans.extend(body.plans(&[(safety, self.steps)])?);
        }
        Ok(LongRun {
            title: written.title.to_owned(),
            names: names(&lattices),
            bodies,
            safety,
            steps: self.steps,
            plans,
        })
    }
}

impl Question for LongRun {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let source = "leapfrog's invariant ½ρVv(n+½)² + ½u(n)ᵀKu(n+1); Higham & Mary 2019, SIAM J. Sci. Comput. 41, A2815";
        let walk = "independent slips of the size of their bounds add up to λ√n of one, λ = 5; the bound of a step follows from the start's norm";
        vec![
            claim(place, "energy", format!("largest drift of the invariant over what rounding allows, {} steps", self.steps))
                .at_most(ErrorKind::Relative, 1.0)
                .because(Basis::Rounding, walk)
                .source(source),
            claim(place, "drift", format!("largest drift of the invariant, {} steps", self.steps))
                .at_most(ErrorKind::Relative, 1e-9)
                .because(Basis::Engineering, "an energy balance to nine digits is more than any use asks for, and a bound by rounding that is wider would say nothing")
                .source(source),
            claim(place, "momentum", format!("largest momentum of the free body over what rounding allows, {} steps", self.steps))
                .at_most(ErrorKind::Relative, 1.0)
                .because(Basis::Rounding, walk)
                .source("bonds pull both ends alike: from rest the momentum stays zero"),
            claim(place, "bounded", "by what the norm of the displacements exceeds that of the start")
                .at_most(ErrorKind::Relative, 1e-6)
                .because(Basis::Theory, "from rest leapfrog carries each mode as cos nθ, those of surfaces and notches too; rounding pushes the body as a whole by 1e-16 a step, n^1.5 of these are 1e-7 after 1e6 steps")
                .source("leapfrog from rest, u(n) = Σ u_k cos nθ_k"),
        ]
    }

    fn scenes(&self) -> Vec<Planned> {
        self.plans.clone()
    }

    fn equations(&self) -> &'static str {
        "H = ½ρV Σ v(n+½)² + ½ u(n)ᵀK u(n+1), P = ρV Σ v(n+½): constant
|H(n) − H(0)| ≤ λ√n uA²(ρV/Δt²)[4s²(2 + 6s) + 2(family + 16)RC²], A = ‖u(0)‖, s = ω_maxΔt/2, C = cΔt/Δx"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let all: Vec<Result<Kept, String>> = self
            .bodies
            .par_iter()
            .zip(&self.plans)
            .map(|(body, plan)| kept(subject, body, plan, self.safety, self.steps))
            .collect();
        let all: Vec<Kept> = match all.into_iter().collect() {
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

/// What a step may move, over u times what it is measured in.
struct Slips {
    /// H, in ρV A²/Δt².
    energy: f64,
    /// The sum of d, in A.
    momentum: f64,
    /// What H is a sum of, in the same.
    terms: f64,
}

/// Of a body below its limit at Δt = `safety` of it.
fn slips(body: &FreeBody, time_step: f64, safety: f64) -> Result<Slips, String> {
    let (family, row_sum) = body.weights()?;
    let pulls = 2.0 * (family + 16) as f64 * row_sum * body.courant(time_step).powi(2);
    Ok(Slips {
        energy: 4.0 * safety * safety * (2.0 + 6.0 * safety) + pulls,
        momentum: 2.0 * safety + 12.0 * safety * safety + pulls,
        terms: 4.0 * safety * safety,
    })
}

/// By how much rounding may move the sum of the displacements of some nodes in m, whose norm with all others is `size`, within
/// so many steps: momentum walks, and is summed.
pub fn wander(body: &FreeBody, time_step: f64, safety: f64, size: f64, steps: u64) -> Result<f64, String> {
    let steps = steps.max(1) as f64;
    let adding = LAMBDA * steps.sqrt() * UNIT * size;
    Ok(LAMBDA * steps * steps.sqrt() * UNIT * slips(body, time_step, safety)?.momentum * size + adding)
}

/// Marches a body from rest at Δt = `safety` of the lattice's limit and holds its accounts against rounding.
pub fn kept(
    subject: &dyn Subject,
    body: &FreeBody,
    plan: &Plan,
    safety: f64,
    steps: u64,
) -> Result<Kept, String> {
    let every = (steps / LOOKS).max(1);
    let pace = Pace { seconds: plan.time_step_s, steps, every };
    let booked = body.booked(subject, pace).map_err(|failure| failure.to_string())?;
    let slips = slips(body, plan.time_step_s, safety)?;
    let start: &Look = booked.looks.first().ok_or("the body was not seen")?;
    let (size, count) = (norm(&start.displacement), start.displacement.len() as f64);
    let inertia = body.mass() / plan.time_step_s.powi(2);
    let walk = |step: u64| LAMBDA * (step.max(1) as f64).sqrt();
    // What is looked at is a sum too: of twice as many terms as there are components.
    let energy_allowed = |step: u64| {
        UNIT * inertia * size * size * (walk(step) * slips.energy + 2.0 * (2.0 * count + 8.0) * slips.terms)
    };
    let momentum_allowed = |step: u64| {
        let sum = (count + 8.0) * count.sqrt() * 2.0 * safety;
        UNIT * body.mass() / plan.time_step_s * size * (walk(step) * slips.momentum + sum)
    };
    let energy = booked.energies.first().ok_or("no energy was booked")?.1;
    let drift = booked.energies.iter().map(|&(step, h)| (step, (h - energy).abs(), energy_allowed(step)));
    let momentum = booked.momenta.iter().map(|&(step, p)| (step, p, momentum_allowed(step)));
    Ok(Kept { energy, drift: drift.collect(), momentum: momentum.collect(), excess: excess(&booked.looks) })
}

impl LongRun {
    fn evidence(&self, all: &[Kept]) -> Vec<(String, Evidence)> {
        let over = |of: &dyn Fn(&Kept) -> Option<f64>, note: String| {
            let each: Option<Vec<f64>> = all.iter().map(of).collect();
            error_of(each.and_then(largest), note)
        };
        let allowed = |kept: &Kept| largest(kept.drift.iter().map(|(_, _, allowed)| allowed / kept.energy));
        let widest = largest(all.iter().filter_map(allowed)).map_or("unknown".into(), rounded);
        let count = || format!("{} bodies", all.len());
        vec![
            (
                "energy".into(),
                over(
                    &|kept| largest(kept.drift.iter().map(|(_, drift, allowed)| drift / allowed)),
                    format!("{}; rounding allows {widest} of the energy", count()),
                ),
            ),
            (
                "drift".into(),
                over(&|kept| largest(kept.drift.iter().map(|(_, drift, _)| drift / kept.energy)), count()),
            ),
            (
                "momentum".into(),
                over(&|kept| largest(kept.momentum.iter().map(|(_, size, allowed)| size / allowed)), count()),
            ),
            ("bounded".into(), over(&|kept| kept.excess, count())),
        ]
    }
}
