//! Runs the cases of studies one after the other and judges what they found.

use crate::attachment::Attachment;
use crate::question::{Answer, Profile};
use crate::study::{Case, Study};
use crate::subject::Subject;
use pd_verify::claim::Claim;
use pd_verify::report::plot::Figure;
use pd_verify::table::Table;
use pd_verify::verdict::{Evidence, Judged, judge};
use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// What a study brought.
#[derive(Debug)]
pub struct Ran {
    pub judged: Vec<Judged>,
    pub tables: Vec<Table>,
    pub figures: Vec<Figure>,
    pub files: Vec<Attachment>,
    pub seconds: f64,
    /// Whether any case failed to compute.
    pub failed: bool,
    /// Cases that ended, of those the study has.
    pub finished: usize,
}

/// What a run asks before each case, and tells after it.
pub trait Watch {
    /// Whether to stop before the next case.
    fn stop(&self) -> bool;
    /// A case begins.
    fn begin(&self, case: &Case);
    /// A case has ended.
    fn end(&self, case: &Case);
}

/// Runs the cases of a study that the profile includes; the claims of the others are `skipped`.
pub fn run(study: &Study, profile: Profile, subject: &dyn Subject, watch: &dyn Watch) -> Ran {
    let start = Instant::now();
    let mut ran = Ran {
        judged: Vec::new(),
        tables: Vec::new(),
        figures: Vec::new(),
        files: Vec::new(),
        seconds: 0.0,
        failed: false,
        finished: 0,
    };
    for case in &study.cases {
        if watch.stop() {
            break;
        }
        if case.profile > profile {
            ran.judged.extend(skipped(case, profile));
        } else {
            watch.begin(case);
            run_case(case, subject, &mut ran);
            watch.end(case);
        }
        ran.finished += 1;
    }
    ran.seconds = start.elapsed().as_secs_f64();
    ran
}

fn skipped(case: &Case, profile: Profile) -> Vec<Judged> {
    let reason = format!("profile {profile} leaves this case out; it runs from profile {}", case.profile);
    let skip = |claim| judge(claim, Evidence { skipped: Some(reason.clone()), ..Evidence::default() });
    case.claims().into_iter().map(skip).collect()
}

fn run_case(case: &Case, subject: &dyn Subject, ran: &mut Ran) {
    let start = Instant::now();
    let answer = catch_unwind(AssertUnwindSafe(|| case.question.answer(subject, &case.place)));
    let seconds = start.elapsed().as_secs_f64();
    let claims = case.claims();
    match answer {
        Ok(answer) => {
            let Answer { evidence, tables, figures, files } = answer;
            ran.failed |= evidence.iter().any(|(_, evidence)| evidence.failed.is_some());
            ran.judged.extend(weigh(claims, evidence, seconds));
            tables.into_iter().for_each(|table| merge(&mut ran.tables, table));
            ran.figures.extend(figures);
            ran.files.extend(files);
        }
        Err(panic) => {
            ran.failed = true;
            let reason = panic_text(panic.as_ref());
            let failed = Evidence { failed: Some(reason), seconds: Some(seconds), ..Evidence::default() };
            ran.judged.extend(claims.into_iter().map(|claim| judge(claim, failed.clone())));
        }
    }
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

/// Adds the rows of a table to the one of the same file.
pub fn merge(tables: &mut Vec<Table>, table: Table) {
    match tables.iter_mut().find(|other| other.file == table.file) {
        Some(other) => {
            assert_eq!(other.columns, table.columns, "{} has two kinds of row", table.file);
            other.rows.extend(table.rows);
        }
        None => tables.push(table),
    }
}
