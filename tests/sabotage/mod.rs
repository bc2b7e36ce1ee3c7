//! Every claim can fail: the library with one ingredient made wrong must lose at least one verdict, and every claim
//! must be lost to at least one wrong ingredient.

mod arithmetic_faults;
mod bar_faults;
mod convergence_faults;
mod cost_faults;
mod dsif_faults;
mod faults;
mod oracles;
mod stability_faults;

use crate::kind::Kind;
use crate::question::Profile;
use crate::run::judged;
use crate::shipped::shipped;
use crate::study::Study;
use crate::subject::{PdVerify, Subject};
use pd_verify::verdict::Verdict;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

fn verdicts<'s>(
    studies: impl IntoIterator<Item = &'s Study>,
    profile: Profile,
    subject: &dyn Subject,
) -> BTreeMap<String, Verdict> {
    let all = studies.into_iter().flat_map(|study| judged(study, profile, subject));
    let ran = all.filter(|judged| judged.verdict != Verdict::Skipped);
    ran.map(|judged| (judged.claim.id, judged.verdict)).collect()
}

/// Whether a claim's verdict has turned: a pass is lost, or a printed formula comes out right.
fn turned(sound: Verdict, faulty: Verdict) -> bool {
    match sound {
        Verdict::Pass => matches!(faulty, Verdict::Fail | Verdict::Error),
        Verdict::Xfail => faulty == Verdict::Xpass,
        _ => false,
    }
}

#[test]
fn every_fault_in_waves_is_caught_and_every_claim_about_them_can_fail() {
    check(Kind::Dispersion, Profile::Full, faults::all());
}

#[test]
fn every_fault_in_bars_is_caught_and_every_claim_about_them_can_fail() {
    check(Kind::Bar, Profile::Full, bar_faults::all());
}

#[test]
fn every_fault_in_refinements_is_caught_and_every_claim_about_them_can_fail() {
    check(Kind::Convergence, Profile::Quick, convergence_faults::all());
}

/// Each fault is looked for in the studies that have its ingredient: all of them with all faults would take too long.
#[test]
fn every_fault_in_cracked_plates_is_caught_and_every_claim_about_them_can_fail() {
    check_where_it_is(Kind::Dsif, &dsif_faults::all());
}

#[test]
fn every_fault_in_stability_is_caught_and_every_claim_about_it_can_fail() {
    let faults: Vec<_> = stability_faults::all().into_iter().chain(arithmetic_faults::all()).collect();
    check_where_it_is(Kind::Stability, &faults);
}

#[test]
fn every_fault_in_costs_is_caught_and_every_claim_about_them_can_fail() {
    check_where_it_is(Kind::Cost, &cost_faults::all());
}

/// Runs the quick studies of a kind, each with the faults that have an ingredient there.
fn check_where_it_is(kind: Kind, faults: &[dsif_faults::Fault]) {
    let studies = shipped(Some(kind), &[]).expect("the shipped studies are sound");
    let sound = verdicts(&studies, Profile::Quick, &PdVerify);
    must_be_sound(&sound);
    let lost: Vec<(&str, BTreeSet<String>)> = faults
        .par_iter()
        .map(|fault| {
            let mine: Vec<&Study> =
                studies.iter().filter(|study| fault.studies.contains(&study.id.as_str())).collect();
            assert_eq!(mine.len(), fault.studies.len(), "{}", fault.name);
            (fault.name, lost(&sound, &verdicts(mine, Profile::Quick, fault.subject.as_ref())))
        })
        .collect();
    all_must_be_lost(&sound, &lost);
}

/// The quick profile stands for the others where these would take too long.
#[test]
fn slow_cases_ask_nothing_that_the_quick_profile_does_not() {
    for kind in [Kind::Convergence, Kind::Dsif, Kind::Stability, Kind::Cost] {
        let studies = shipped(Some(kind), &[]).expect("the shipped studies are sound");
        let asked = |quick: bool| -> BTreeSet<String> {
            let cases = studies.iter().flat_map(|study| &study.cases);
            let cases = cases.filter(|case| (case.profile == Profile::Quick) == quick);
            cases.map(|case| case.asks.clone()).collect()
        };
        let only_slow: Vec<_> = asked(false).difference(&asked(true)).cloned().collect();
        assert!(only_slow.is_empty(), "{only_slow:?}");
    }
}

/// Runs the shipped studies of a kind with each fault.
fn check(kind: Kind, profile: Profile, faults: Vec<(&'static str, Box<dyn Subject + Send>)>) {
    let studies = shipped(Some(kind), &[]).expect("the shipped studies are sound");
    let sound = verdicts(&studies, profile, &PdVerify);
    must_be_sound(&sound);
    let lost: Vec<(&str, BTreeSet<String>)> = faults
        .par_iter()
        .map(|(name, subject)| (*name, lost(&sound, &verdicts(&studies, profile, subject.as_ref()))))
        .collect();
    all_must_be_lost(&sound, &lost);
}

fn must_be_sound(sound: &BTreeMap<String, Verdict>) {
    let bad: Vec<_> = sound.iter().filter(|(_, v)| !matches!(v, Verdict::Pass | Verdict::Xfail)).collect();
    assert!(bad.is_empty(), "without any fault: {bad:?}");
}

/// Claims whose verdicts a fault turns, of those that were judged with it.
fn lost(sound: &BTreeMap<String, Verdict>, faulty: &BTreeMap<String, Verdict>) -> BTreeSet<String> {
    let both = faulty.iter().filter_map(|(id, faulty)| Some((id, *sound.get(id)?, *faulty)));
    both.filter(|(_, sound, faulty)| turned(*sound, *faulty)).map(|(id, ..)| id.clone()).collect()
}

fn all_must_be_lost(sound: &BTreeMap<String, Verdict>, lost: &[(&str, BTreeSet<String>)]) {
    let harmless: Vec<_> =
        lost.iter().filter(|(_, claims)| claims.is_empty()).map(|(name, _)| name).collect();
    assert!(harmless.is_empty(), "no verdict notices these faults: {harmless:?}");
    let caught: BTreeSet<&String> = lost.iter().flat_map(|(_, claims)| claims).collect();
    let safe: Vec<_> = sound.keys().filter(|id| !caught.contains(id)).collect();
    assert!(safe.is_empty(), "no fault turns these claims: {safe:#?}");
}
