//! Runs a case of a study and judges what it found.

use crate::attachment::Attachment;
use crate::question::{Answer, Profile};
use crate::study::Case;
#[cfg(test)]
use crate::study::Study;
use crate::subject::Subject;
use pd_verify::claim::Claim;
use pd_verify::report::plot::Figure;
use pd_verify::table::Table;
use pd_verify::verdict::{Evidence, Judged, judge};
use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// What a case brought.
#[derive(Debug, Default)]
pub struct Ran {
    pub judged: Vec<Judged>,
    pub tables: Vec<Table>,
    pub figures: Vec<Figure>,
    pub files: Vec<Attachment>,
    pub seconds: f64,
    /// Whether it failed to compute.
    pub failed: bool,
}

/// Runs a case if the profile includes it; if not its claims are `skipped`.
pub fn run_case(case: &Case, profile: Profile, subject: &dyn Subject) -> Ran {
    if case.profile > profile {
        return Ran { judged: skipped(case, profile), ..Ran::default() };
    }
    let start = Instant::now();
    let answer = catch_unwind(AssertUnwindSafe(|| case.question.answer(subject, &case.place)));
    let seconds = start.elapsed().as_secs_f64();
    let claims = case.claims();
    match answer {
        Ok(Answer { evidence, tables, figures, files }) => {
            let failed = evidence.iter().any(|(_, evidence)| evidence.failed.is_some());
            Ran { judged: weigh(claims, evidence, seconds), tables, figures, files, seconds, failed }
        }
        Err(panic) => {
            let reason = panic_text(panic.as_ref());
            let failed = Evidence { failed: Some(reason), seconds: Some(seconds), ..Evidence::default() };
            let judged = claims.into_iter().map(|claim| judge(claim, failed.clone())).collect();
            Ran { judged, seconds, failed: true, ..Ran::default() }
        }
    }
}

/// Every claim of a study, judged.
#[cfg(test)]
pub fn judged(study: &Study, profile: Profile, subject: &dyn Subject) -> Vec<Judged> {
    study.cases.iter().flat_map(|case| run_case(case, profile, subject).judged).collect()
}

fn skipped(case: &Case, profile: Profile) -> Vec<Judged> {
    let reason = format!("profile {profile} leaves this case out; it runs from profile {}", case.profile);
    let skip = |claim| judge(claim, Evidence { skipped: Some(reason.clone()), ..Evidence::default() });
    case.claims().into_iter().map(skip).collect()
}

fn panic_text(panic: &(dyn std::any::Any + Send)) -> String {
    let text =
        panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    format!("the computation broke off: {}", text.unwrap_or("no reason was given"))
}

/// Brings evidence to claims by name; a claim without evidence is inconclusive.
fn weigh(claims: Vec<Claim>, evidence: Vec<(String, Evidence)>, seconds: f64) -> Vec<Judged> {
    let mut by_name: HashMap<String, Evidence> = evidence.into_iter().collect();
    let weigh_one = |claim: Claim| {
        let name = claim.id.rsplit('/').next().unwrap_or_default().to_owned();
        let mut found = by_name.remove(&name).unwrap_or_else(|| Evidence {
            outside: Some("no evidence was brought".into()),
            ..Evidence::default()
        });
        found.seconds.get_or_insert(seconds);
        judge(claim, found)
    };
    claims.into_iter().map(weigh_one).collect()
}
