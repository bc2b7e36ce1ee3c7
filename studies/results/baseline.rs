//! A baseline: what a run found, small enough to be kept beside the code, and how far a later run has drifted from it.

use super::{FORMAT, Run};
use crate::input::Refusal;
use pd_verify::claim::{Basis, Claim, ErrorKind, Relation};
use pd_verify::exact;
use pd_verify::verdict::{Judged, Verdict};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// Rounding of another order of sums, over the size of a quantity: marches of 10⁶ steps leave less.
pub const ROUNDING: f64 = 1e-10;

/// On another instruction set quantities may drift by this share of what the claim tolerates.
pub const SHARE: f64 = 0.01;

/// The same where the claim tolerates nothing that could be shared, over the size of the quantity.
const UNTOLD: f64 = 1e-6;

/// What is rounding itself may drift by this share of what the claim tolerates.
pub const OF_ROUNDING: f64 = 0.5;

/// No drift that is taken for rounding may be as large as this share of what the claim tolerates.
const LARGEST: f64 = 0.1;

/// Under which circumstances, and what was found.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Baseline {
    pub format: u64,
    pub program: String,
    pub version: String,
    pub git_commit: Option<String>,
    pub target: String,
    pub instruction_set: String,
    pub profile: String,
    pub settings: Vec<String>,
    pub claims: Vec<Quantities>,
}

/// The quantities of a claim that are watched.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantities {
    pub claim: String,
    pub verdict: Verdict,
    #[serde(with = "exact::number")]
    pub tolerance: f64,
    #[serde(default, with = "exact::option", skip_serializing_if = "Option::is_none")]
    pub computed: Option<f64>,
    #[serde(default, with = "exact::option", skip_serializing_if = "Option::is_none")]
    pub reference: Option<f64>,
    #[serde(default, with = "exact::option", skip_serializing_if = "Option::is_none")]
    pub error: Option<f64>,
    #[serde(default, with = "exact::option", skip_serializing_if = "Option::is_none")]
    pub order: Option<f64>,
    /// Only where it was asked for.
    #[serde(default, with = "exact::option", skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
}

impl Quantities {
    fn of(judged: &Judged, with_seconds: bool) -> Self {
        let evidence = &judged.evidence;
        Self {
            claim: judged.claim.id.clone(),
            verdict: judged.verdict,
            tolerance: judged.claim.tolerance,
            computed: evidence.computed,
            reference: evidence.reference,
            error: evidence.error,
            order: evidence.order.map(|order| order.value),
            seconds: evidence.seconds.filter(|_| with_seconds),
        }
    }
}

impl Baseline {
    /// The baseline of a run, claims sorted by name.
    pub fn of<'a>(run: &Run, judged: impl Iterator<Item = &'a Judged>, with_seconds: bool) -> Self {
        let manifest = run.manifest.clone();
        let mut claims: Vec<Quantities> = judged.map(|one| Quantities::of(one, with_seconds)).collect();
        claims.sort_by(|a, b| a.claim.cmp(&b.claim));
        Self {
            format: FORMAT,
            program: "pd-verify baseline".into(),
            version: manifest.version,
            git_commit: manifest.git_commit,
            target: manifest.target,
            instruction_set: manifest.instruction_set,
            profile: manifest.profile,
            settings: manifest.settings,
            claims,
        }
    }

    /// JSON with a line for each claim, so that a difference shows what moved.
    pub fn json(&self) -> String {
        let head = serde_json::to_string_pretty(&Self { claims: Vec::new(), ..self.clone() });
        let head = head.expect("plain data");
        let lines: Vec<String> =
            self.claims.iter().map(|one| serde_json::to_string(one).expect("plain data")).collect();
        let body =
            if lines.is_empty() { "[]".into() } else { format!("[\n    {}\n  ]", lines.join(",\n    ")) };
        head.replace("\"claims\": []", &format!("\"claims\": {body}")) + "\n"
    }

    /// Reads one back.
    pub fn parse(place: &Path, text: &str) -> Result<Self, Refusal> {
        let found: Self = serde_json::from_str(text).map_err(|error| {
            Refusal::new(format!("{} is no baseline: {error}", place.display()))
                .help("make one with `pd-verify baseline save NAME`")
        })?;
        if found.format != FORMAT {
            let message =
                format!("{} has format {}, this version reads {FORMAT}", place.display(), found.format);
            return Err(Refusal::new(message).help("save it again with this version"));
        }
        Ok(found)
    }
}

/// A quantity that is not what it was.
#[derive(Debug, Clone, PartialEq)]
pub struct Moved {
    pub claim: String,
    pub quantity: &'static str,
    pub before: Option<f64>,
    pub now: Option<f64>,
    /// How far it may drift.
    pub allowed: f64,
    pub tolerance: f64,
}

/// How a run differs from a baseline.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Drift {
    pub compared: usize,
    /// Claim, verdict before, verdict now.
    pub verdicts: Vec<(String, Verdict, Verdict)>,
    pub moved: Vec<Moved>,
    pub missing: Vec<String>,
    pub new: Vec<String>,
}

impl Drift {
    /// Whether nothing is lost, moved or judged otherwise, and something was compared. New claims do no harm.
    pub fn is_none(&self) -> bool {
        self.compared > 0 && self.verdicts.is_empty() && self.moved.is_empty() && self.missing.is_empty()
    }
}

/// Holds a run against a baseline; seconds only count where they may be so many times as many.
pub fn drift<'a>(
    before: &Baseline,
    run: &Run,
    judged: impl Iterator<Item = &'a Judged>,
    slower: Option<f64>,
) -> Drift {
    // AVX2 and AVX-512 give the same bits.
    let lanes = |set: &str| if set == "baseline" { "baseline" } else { "vectors" };
    let same_bits = before.target == run.manifest.target
        && lanes(&before.instruction_set) == lanes(&run.manifest.instruction_set);
    let mut left: BTreeMap<&str, &Quantities> =
        before.claims.iter().map(|one| (one.claim.as_str(), one)).collect();
    let mut drift = Drift::default();
    for one in judged {
        let Some(old) = left.remove(one.claim.id.as_str()) else {
            drift.new.push(one.claim.id.clone());
            continue;
        };
        drift.compared += 1;
        if old.verdict != one.verdict {
            drift.verdicts.push((old.claim.clone(), old.verdict, one.verdict));
        }
        drift.moved.extend(moved(old, one, same_bits));
        drift.moved.extend(slower.and_then(|factor| slowed(old, one, factor)));
    }
    drift.missing = left.into_keys().map(str::to_owned).collect();
    drift
}

fn moved(old: &Quantities, judged: &Judged, same_bits: bool) -> Vec<Moved> {
    let (claim, now) = (&judged.claim, Quantities::of(judged, false));
    // A bound is written down, so that it never drifts.
    let pairs = [
        ("tolerance", Some(old.tolerance), Some(now.tolerance), 0.0),
        ("computed", old.computed, now.computed, allowed(claim, "computed", old, same_bits)),
        ("reference", old.reference, now.reference, allowed(claim, "reference", old, same_bits)),
        ("error", old.error, now.error, allowed(claim, "error", old, same_bits)),
        ("order", old.order, now.order, allowed(claim, "order", old, same_bits)),
    ];
    let drifts = pairs.into_iter().filter(|(_, before, now, allowed)| !within(*before, *now, *allowed));
    drifts
        .map(|(quantity, before, now, allowed)| Moved {
            claim: claim.id.clone(),
            quantity,
            before,
            now,
            allowed,
            tolerance: claim.tolerance,
        })
        .collect()
}

/// Whether two numbers are as near as allowed; what is no number must stay none, infinities must stay themselves.
fn within(before: Option<f64>, now: Option<f64>, allowed: f64) -> bool {
    match (before, now) {
        (None, None) => true,
        (Some(a), Some(b)) => a == b || (a.is_nan() && b.is_nan()) || (a - b).abs() <= allowed,
        _ => false,
    }
}

/// How far a quantity may drift, in its own unit.
fn allowed(claim: &Claim, quantity: &str, old: &Quantities, same_bits: bool) -> f64 {
    let known = |value: Option<f64>| value.filter(|x| x.is_finite()).map_or(0.0, f64::abs);
    let values = known(old.computed).max(known(old.reference));
    let of_error = match claim.error_kind {
        ErrorKind::Absolute | ErrorKind::Order | ErrorKind::Count | ErrorKind::Bits => {
            values.max(known(old.error))
        }
        // Relative to the size of the quantity, whose rounding it then shows as it is.
        _ => known(old.error).max(1.0),
    };
    let size = match quantity {
        "error" => of_error,
        "order" => known(old.order),
        _ => values,
    };
    let rounding = ROUNDING * size;
    let Some(width) = width(claim, quantity, known(old.reference)) else {
        return if same_bits { rounding } else { UNTOLD * size };
    };
    let width = width.abs();
    match (claim.basis, same_bits) {
        (Basis::Rounding, _) => OF_ROUNDING * width,
        (_, true) => rounding.min(LARGEST * width),
        (_, false) => rounding.min(LARGEST * width).max(SHARE * width),
    }
}

/// What the claim tolerates, in the unit of the quantity; `None` where it says nothing about it.
fn width(claim: &Claim, quantity: &str, reference: f64) -> Option<f64> {
    let tolerance = claim.tolerance;
    match (quantity, claim.relation, claim.error_kind) {
        (_, Relation::Equal, _) => Some(0.0),
        ("order", _, ErrorKind::Order) => Some(tolerance),
        ("order", ..) => None,
        ("error", Relation::AtMost | Relation::Within, _) => Some(tolerance),
        ("error", ..) => None,
        (_, Relation::Within | Relation::AtLeast, _) => Some(tolerance),
        (_, Relation::AtMost, ErrorKind::Absolute) => Some(tolerance),
        (_, Relation::AtMost, ErrorKind::Relative) => Some(tolerance * reference),
        (_, Relation::AtMost, _) => None,
    }
    .filter(|width| !width.is_nan())
}

fn slowed(old: &Quantities, judged: &Judged, factor: f64) -> Option<Moved> {
    let (before, now) = (old.seconds?, judged.evidence.seconds?);
    // What takes a tenth of a second is noise.
    let allowed = (factor * before).max(0.1);
    (now > allowed).then(|| Moved {
        claim: old.claim.clone(),
        quantity: "seconds",
        before: Some(before),
        now: Some(now),
        allowed: allowed - before,
        tolerance: judged.claim.tolerance,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use pd_verify::claim::Expectation;
    use pd_verify::verdict::{Evidence, judge};

    fn claim(relation: Relation, error_kind: ErrorKind, tolerance: f64, basis: Basis) -> Claim {
        Claim {
            id: "s/c/n".into(),
            study: "s".into(),
            case: "c".into(),
            quantity: "q".into(),
            unit: "m".into(),
            error_kind,
            relation,
            tolerance,
            basis,
            because: "b".into(),
            expected_order: None,
            expectation: Expectation::Holds,
            source: "s".into(),
        }
    }

    /// Names of what has moved from one value to another, on the same instruction set or not.
    fn moves(claim: &Claim, before: (f64, f64), now: (f64, f64), same: bool) -> Vec<&'static str> {
        let judged = |(computed, reference): (f64, f64)| {
            let error = Some(match claim.error_kind {
                ErrorKind::Absolute => (computed - reference).abs(),
                _ => (computed / reference - 1.0).abs(),
            });
            let evidence = Evidence {
                computed: Some(computed),
                reference: Some(reference),
                error,
                seconds: Some(computed),
                ..Evidence::default()
            };
            judge(claim.clone(), evidence)
        };
        let old = Quantities::of(&judged(before), true);
        moved(&old, &judged(now), same).into_iter().map(|one| one.quantity).collect()
    }

    /// 2e6 with a part in 10⁹: 2e3 times what rounding leaves; with a part in 10¹²: a fiftieth of it.
    #[test]
    fn drifts_beyond_rounding_move_on_the_same_machine() {
        let absolute = claim(Relation::Within, ErrorKind::Absolute, 1e4, Basis::Theory);
        let reference = 2e6;
        assert_eq!(moves(&absolute, (2e6, reference), (2e6 + 2e-3, reference), true), ["computed", "error"]);
        assert!(moves(&absolute, (2e6, reference), (2e6 + 2e-6, reference), true).is_empty());
        // 1 % of the tolerance is 100: another instruction set may do that, the same one not.
        assert!(moves(&absolute, (2e6, reference), (2e6 + 99.0, reference), false).is_empty());
        assert_eq!(
            moves(&absolute, (2e6, reference), (2e6 + 101.0, reference), false),
            ["computed", "error"]
        );
        // A relative tolerance of 1e-3 of 2e6 is 2e3, a hundredth of it 20.
        let relative = claim(Relation::AtMost, ErrorKind::Relative, 1e-3, Basis::Theory);
        assert!(moves(&relative, (2e6, reference), (2e6 + 19.0, reference), false).is_empty());
        assert_eq!(moves(&relative, (2e6, reference), (2e6 + 21.0, reference), false), ["computed", "error"]);
    }

    #[test]
    fn a_tight_tolerance_is_never_drowned_in_rounding() {
        // 1e-10 of 1 is ten times this tolerance; a drift by a fifth of it is told.
        let tight = claim(Relation::AtMost, ErrorKind::Relative, 1e-11, Basis::Theory);
        assert!(moves(&tight, (1.0, 1.0), (1.0 + 5e-13, 1.0), true).is_empty());
        assert!(!moves(&tight, (1.0, 1.0), (1.0 + 2e-12, 1.0), true).is_empty());
        // What is rounding itself may change by half of what is tolerated.
        let rounding = claim(Relation::AtMost, ErrorKind::Relative, 1e-11, Basis::Rounding);
        assert!(moves(&rounding, (1.0, 1.0), (1.0 + 4e-12, 1.0), true).is_empty());
        assert!(!moves(&rounding, (1.0, 1.0), (1.0 + 6e-12, 1.0), true).is_empty());
        // Counts are exact everywhere.
        let count = claim(Relation::Equal, ErrorKind::Count, 0.0, Basis::Theory);
        for same in [true, false] {
            assert!(moves(&count, (36.0, 36.0), (36.0 + 1e-13, 36.0), same).contains(&"computed"));
        }
    }

    #[test]
    fn what_is_no_number_stays_none() {
        let near = |before, now| within(before, now, 1e300);
        assert!(near(None, None) && near(Some(f64::NAN), Some(f64::NAN)));
        assert!(near(Some(f64::INFINITY), Some(f64::INFINITY)));
        for (before, now) in
            [(None, Some(0.0)), (Some(f64::NAN), Some(0.0)), (Some(f64::INFINITY), Some(0.0))]
        {
            assert!(!near(before, now) && !near(now, before));
        }
    }

    #[test]
    fn seconds_move_beyond_the_factor() {
        let claim = claim(Relation::AtMost, ErrorKind::Absolute, 1.0, Basis::Theory);
        let took = |seconds| {
            let evidence = Evidence { error: Some(0.0), seconds: Some(seconds), ..Evidence::default() };
            judge(claim.clone(), evidence)
        };
        let old = Quantities::of(&took(1.0), true);
        assert!(slowed(&old, &took(1.9), 2.0).is_none());
        assert_eq!(slowed(&old, &took(2.1), 2.0).unwrap().quantity, "seconds");
        assert!(slowed(&Quantities::of(&took(1.0), false), &took(9.0), 2.0).is_none());
    }
}
