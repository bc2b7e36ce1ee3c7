//! Every claim can fail: the library with one ingredient made wrong must lose at least one verdict, and every claim
//! must be lost to at least one wrong ingredient.

mod bar_faults;
mod faults;
mod oracles;

use crate::kind::Kind;
use crate::progress::Silent;
use crate::question::Profile;
use crate::run::run;
use crate::shipped::shipped;
use crate::study::Study;
use crate::subject::{PdVerify, Subject};
use pd_verify::verdict::Verdict;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

fn verdicts(studies: &[Study], subject: &dyn Subject) -> BTreeMap<String, Verdict> {
    let judged = studies.iter().flat_map(|study| run(study, Profile::Full, subject, &Silent).judged);
    judged.map(|judged| (judged.claim.id, judged.verdict)).collect()
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
    check(Kind::Dispersion, faults::all());
}

#[test]
fn every_fault_in_bars_is_caught_and_every_claim_about_them_can_fail() {
    check(Kind::Bar, bar_faults::all());
}

/// Runs the shipped studies of a kind with each fault.
fn check(kind: Kind, faults: Vec<(&'static str, Box<dyn Subject + Send>)>) {
    let studies = shipped(Some(kind), &[]).expect("the shipped studies are sound");
    let sound = verdicts(&studies, &PdVerify);
    let bad: Vec<_> = sound.iter().filter(|(_, v)| !matches!(v, Verdict::Pass | Verdict::Xfail)).collect();
    assert!(bad.is_empty(), "without any fault: {bad:?}");

    let lost: Vec<(&str, BTreeSet<String>)> = faults
        .par_iter()
        .map(|(name, subject)| {
            let faulty = verdicts(&studies, subject.as_ref());
            let lost =
                sound.iter().filter(|(id, verdict)| turned(**verdict, faulty[*id])).map(|(id, _)| id.clone());
            (*name, lost.collect())
        })
        .collect();

    let harmless: Vec<_> =
        lost.iter().filter(|(_, claims)| claims.is_empty()).map(|(name, _)| name).collect();
    assert!(harmless.is_empty(), "no verdict notices these faults: {harmless:?}");
    let caught: BTreeSet<&String> = lost.iter().flat_map(|(_, claims)| claims).collect();
    let safe: Vec<_> = sound.keys().filter(|id| !caught.contains(id)).collect();
    assert!(safe.is_empty(), "no fault turns these claims: {safe:#?}");
}
