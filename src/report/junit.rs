//! JUnit XML: a test suite per study, a test per claim, for continuous integration.

use super::RunSummary;
use super::row::Row;
use crate::verdict::{Judged, Verdict};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use std::time::Duration;

/// The run as JUnit XML: `fail` and `xpass` are failures, `error` is an error, `skipped` and `inconclusive` are skipped.
pub fn junit_xml(run: &RunSummary) -> String {
    let mut report = Report::new(&run.title);
    for study in &run.studies {
        let mut suite = TestSuite::new(&study.id);
        suite.add_test_cases(study.judged.iter().map(test_case));
        report.add_test_suite(suite);
    }
    report.to_string().expect("XML in memory, made of strings that quick-junit cleans")
}

fn test_case(judged: &Judged) -> TestCase {
    let row = Row::new(judged);
    let mut case = TestCase::new(row.claim.as_str(), status(judged.verdict, &row));
    case.set_classname(format!("{}.{}", judged.claim.study, judged.claim.case));
    // Without a time the attribute is left out; a negative or infinite one would be nonsense.
    if let Some(Ok(time)) = judged.evidence.seconds.map(Duration::try_from_secs_f64) {
        case.set_time(time);
    }
    if judged.verdict == Verdict::Xfail {
        case.set_system_out(format!("xfail: {}", row.note));
    }
    case
}

fn status(verdict: Verdict, row: &Row) -> TestCaseStatus {
    let kind = match verdict {
        Verdict::Pass | Verdict::Xfail => return TestCaseStatus::success(),
        Verdict::Inconclusive | Verdict::Skipped => {
            let mut status = TestCaseStatus::skipped();
            status.set_message(format!("{}: {}", row.verdict, row.note));
            return status;
        }
        Verdict::Fail | Verdict::Xpass => NonSuccessKind::Failure,
        Verdict::Error => NonSuccessKind::Error,
    };
    let mut status = TestCaseStatus::non_success(kind);
    status.set_type(row.verdict);
    status.set_message(format!("{}: error {}, asked: {}", row.quantity, row.error, row.bound));
    status.set_description(format!(
        "computed {} {unit}\nreference {} {unit}\nerror {} ({})\nasked: {}\nwhy: {} ({})\nnote: {}\nsource: {}",
        row.computed,
        row.reference,
        row.error,
        row.error_kind,
        row.bound,
        row.because,
        row.basis,
        row.note,
        row.source,
        unit = row.unit,
    ));
    status
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;

    #[test]
    fn every_verdict_lands_in_its_place() {
        let run = sample::run();
        let xml = junit_xml(&run);
        let head = xml.lines().find(|line| line.starts_with("<testsuites ")).unwrap();
        for count in [r#"tests="7""#, r#"failures="2""#, r#"errors="1""#] {
            assert!(head.contains(count), "{head}");
        }
        assert_eq!(xml.matches("<testsuite ").count(), 2);
        assert_eq!(xml.matches("<testcase ").count(), 7);
        assert_eq!(xml.matches("<failure ").count(), 2);
        assert_eq!(xml.matches("<error ").count(), 1);
        assert_eq!(xml.matches("<skipped ").count(), 2);
        assert!(!xml.contains("<b>"));
        assert_eq!(xml, junit_xml(&run));
    }
}
