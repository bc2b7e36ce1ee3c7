//! What is claimed of a march without an exact answer, and the evidence: bounds follow from steps and sizes alone.

use super::balances::energy_change;
use super::march::{March, Marched};
use super::operators::rounding;
use crate::question::{Claiming, Place, claim, error_of, value_of};
use crate::subject::Subject;
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::record::{Failure, Record};
use pd_verify::verdict::Evidence;

/// Drift of a march is no rounding beyond this, however long it lasts.
const MOST_ROUNDING: f64 = 1e-8;

/// Drift of the energy that finite rotations may show.
const MOST_DRIFT_TURNED: f64 = 0.01;

/// The claims of a case.
pub fn claims(case: &March, place: &Place) -> Vec<Claim> {
    let mut claims = vec![finite(case, place), energy(case, place), operators(case, place)];
    if momentum_is_claimed(case) {
        claims.push(momentum(case, place));
    }
    claims.extend(case.expect.iter().map(|expect| expect.claim(case.scenes.len(), place)));
    claims
}

fn finite(case: &March, place: &Place) -> Claim {
    let (basis, because) = match is_linear(case) {
        true => (
            Basis::Theory,
            "leapfrog below its limit keeps a quadratic form positive, so nothing grows without bound",
        ),
        false => (
            Basis::Engineering,
            "with finite rotations leapfrog keeps no quadratic form; the limit is that of the linear lattice, which tension lowers: that nothing grew is shown by the run alone",
        ),
    };
    claim(place, "finite", "numbers seen by the probes that are not finite")
        .exactly()
        .because(basis, because)
        .source("von Neumann's limit 2/ω_max of the linear lattice")
}

/// Whether leapfrog keeps the balances of all its scenes exactly.
fn is_linear(case: &March) -> bool {
    case.scenes.iter().all(|one| one.scene.linear())
}

/// Whether one of its scenes was given a step above its limit.
fn above_limit(case: &March) -> bool {
    case.scenes.iter().any(|one| one.plan.time_step_over_limit > 1.0)
}

fn energy(case: &March, place: &Place) -> Claim {
    let quantity = "largest change of kinetic + elastic − works over the largest of them";
    if !is_linear(case) {
        return claim(place, "energy_balance", quantity)
            .at_most(ErrorKind::LinfRelative, MOST_DRIFT_TURNED)
            .because(
                Basis::Engineering,
                "with finite rotations leapfrog keeps the energy to second order in Δt; a hundredth is what an eye sees in a figure",
            )
            .source("the ledger of the march, by the stored energies of the bonds");
    }
    claim(place, "energy_balance", quantity)
        .at_most(ErrorKind::LinfRelative, drift(case, |steps, longest, _| steps * (longest + steps)))
        .because(
            Basis::Rounding,
            "leapfrog of a linear body keeps the balance exactly; each of n steps rounds displacements by ε, of which strains see (N + n) times as much, N nodes long and n steps drifted: ε n (N + n), but no more than 1e-8",
        )
        .source("½ρV Σ v(n + ½)² + ½ u(n)ᵀK u(n + 1) is invariant under leapfrog (Hairer, Lubich & Wanner 2006, ch. I)")
}

fn operators(case: &March, place: &Place) -> Claim {
    let of =
        |one: &Marched| one.twice.as_ref().map_or(0.0, |twice| rounding(one.scene.extent().0, twice.steps()));
    let bound = case.scenes.iter().map(of).fold(f64::EPSILON, f64::max).min(MOST_ROUNDING);
    claim(place, "operators_agree", "largest difference of displacements by stencil and by list of bonds, over the largest")
        .at_most(ErrorKind::LinfRelative, bound)
        .because(
            Basis::Rounding,
            "sums of b bonds in another order differ by εb; with Δt²Σw/ρ ≤ 2 that is 4εb|u| a step, n²/2 times as much after n steps: 2ε b n², but no more than 1e-8",
        )
        .source("the first steps of the same scene by the other operator")
}

fn momentum(case: &March, place: &Place) -> Claim {
    claim(place, "momentum", "largest |P(t) − P(0) − impulse of the loads| over √(2 M E)")
        .at_most(ErrorKind::LinfRelative, drift(case, |steps, longest, bonds| 4.0 * bonds * (steps + longest)))
        .because(
            Basis::Rounding,
            "bonds pull their ends apart equally, to ε of each of b bonds a step; E is the largest energy, √(2 M E) what it could move: 4ε b (N + n), but no more than 1e-8",
        )
        .source("initial velocities and loads summed over nodes and steps, without bonds")
}

/// ε times what the longest scene gives for its steps, its nodes along the longest axis, and the bonds of a node.
fn drift(case: &March, of: fn(f64, f64, f64) -> f64) -> f64 {
    let one = |one: &Marched| {
        let (bonds, longest) = one.scene.extent();
        f64::EPSILON * of(one.plan.steps as f64, longest as f64, bonds as f64)
    };
    case.scenes.iter().map(one).fold(0.0, f64::max).min(MOST_ROUNDING)
}

fn momentum_is_claimed(case: &March) -> bool {
    case.scenes.iter().all(|one| one.scene.loads_alone_push())
}

/// Evidence for the claims from the records of the case's scenes, in their order.
pub fn evidence(case: &March, records: &[&Record], subject: &dyn Subject) -> Vec<(String, Evidence)> {
    let pairs = || case.scenes.iter().zip(records);
    let values = records.iter().flat_map(|record| record.traces.iter().flat_map(|trace| trace.known()));
    let (mut seen, mut wild) = (0_u64, 0_u64);
    values.for_each(|value| {
        seen += 1;
        wild += u64::from(!value.is_finite());
    });
    let finite = value_of((seen > 0).then_some(wild as f64), Some(0.0), format!("{seen} numbers"));
    let energy = energy_evidence(case, worst(pairs().map(|(_, record)| energy_change(record))));
    let mut found = vec![
        ("finite".into(), on_purpose(case, finite)),
        ("energy_balance".into(), on_purpose(case, energy)),
        ("operators_agree".into(), on_purpose(case, agreement(case, subject))),
    ];
    if momentum_is_claimed(case) {
        let errors = pairs().map(|(one, record)| one.scene.momentum_error(record));
        found.push(("momentum".into(), on_purpose(case, booked(case, worst(errors)))));
    }
    found.extend(case.expect.iter().map(|expect| (expect.name.clone(), expect.evidence(records))));
    found
}

/// Why a march has no record, and what can be done about it where nobody meant it.
pub fn why(case: &March, failure: &Failure) -> String {
    let grew = matches!(failure, Failure::Diverged(_));
    let advice = match grew && !is_linear(case) && !above_limit(case) {
        true => {
            "; the lattice's limit is that of small rotations, which tension lowers, and tension to come may lower the body's own further"
        }
        false => "",
    };
    format!("{failure}{advice}")
}

/// Evidence that says nothing where the march was made to be unstable.
fn on_purpose(case: &March, evidence: Evidence) -> Evidence {
    if !above_limit(case) || evidence.skipped.is_some() {
        return evidence;
    }
    Evidence { outside: Some("run above its limit on purpose".into()), ..evidence }
}

/// Evidence from the energy ledger; what can be done about a drift is said with it.
fn energy_evidence(case: &March, error: Option<f64>) -> Evidence {
    let evidence = booked(case, error);
    let fails = evidence.error.is_some_and(|error| error > MOST_DRIFT_TURNED);
    if is_linear(case) || !fails {
        return evidence;
    }
    let note = "with finite rotations the drift falls with Δt²: take a smaller Δt (safety or time_step_s)";
    Evidence { note: note.into(), ..evidence }
}

/// The largest of all, if all are known; a NaN is the largest.
fn worst(errors: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    errors.collect::<Option<Vec<f64>>>()?.into_iter().max_by(f64::total_cmp)
}

/// Evidence from the ledger, which long marches do without.
fn booked(case: &March, error: Option<f64>) -> Evidence {
    if case.scenes.iter().any(|one| !one.scene.booked()) {
        let reason = "the march is too long for a ledger nobody asks for; add a probe that watches energies";
        return Evidence { skipped: Some(reason.into()), ..Evidence::default() };
    }
    match error {
        Some(error) => error_of(Some(error), ""),
        None => Evidence { outside: Some("nothing moved".into()), ..Evidence::default() },
    }
}

fn agreement(case: &March, subject: &dyn Subject) -> Evidence {
    // Above the limit rounding grows without bound.
    if above_limit(case) {
        return Evidence::default();
    }
    let mut errors = Vec::new();
    for one in &case.scenes {
        let Some(twice) = &one.twice else {
            let reason = "the body is too large to be marched a second time by a list of bonds";
            return Evidence { skipped: Some(reason.into()), ..Evidence::default() };
        };
        match twice.difference(subject) {
            Ok(error) => errors.push(error),
            Err(reason) => return Evidence { failed: Some(reason), ..Evidence::default() },
        }
    }
    let steps = case.scenes.iter().filter_map(|one| one.twice.as_ref()).map(|twice| twice.steps());
    let note = format!("{} steps", steps.max().unwrap_or(0));
    match worst(errors.into_iter()) {
        Some(error) => error_of(Some(error), note),
        None => Evidence { outside: Some("nothing moved in the first steps".into()), ..Evidence::default() },
    }
}
