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
    use quick_xml::Reader;
    use quick_xml::events::Event;

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

    /// An element of JUnit's schema as Jenkins reads it: its name, attributes that must be there, those that may, and the
    /// elements within.
    type Element = (&'static str, &'static [&'static str], &'static [&'static str], &'static [&'static str]);

    const SCHEMA: [Element; 8] = [
        // Writers of today count skipped tests here too.
        (
            "testsuites",
            &[],
            &["name", "tests", "failures", "errors", "skipped", "disabled", "time"],
            &["testsuite"],
        ),
        (
            "testsuite",
            &["name", "tests"],
            &["failures", "errors", "disabled", "skipped", "time", "timestamp", "hostname", "id", "package"],
            &["testcase"],
        ),
        (
            "testcase",
            &["name", "classname"],
            &["assertions", "time", "status"],
            &["skipped", "failure", "error", "system-out", "system-err"],
        ),
        ("skipped", &[], &["message", "type"], &[]),
        ("failure", &[], &["message", "type"], &[]),
        ("error", &[], &["message", "type"], &[]),
        ("system-out", &[], &[], &[]),
        ("system-err", &[], &[], &[]),
    ];

    /// What does not fit the schema; the counts of a suite must be those of what it holds.
    fn misfits(xml: &str) -> Vec<String> {
        let (mut wrong, mut open, mut reader) = (Vec::new(), Vec::new(), Reader::from_str(xml));
        loop {
            let (start, empty) = match reader.read_event() {
                Ok(Event::Start(start)) => (start, false),
                Ok(Event::Empty(start)) => (start, true),
                Ok(Event::End(_)) => {
                    open.pop();
                    continue;
                }
                Ok(Event::Eof) => return wrong,
                Ok(_) => continue,
                Err(error) => return vec![error.to_string()],
            };
            let name = String::from_utf8_lossy(start.name().as_ref()).into_owned();
            let Some((_, must, may, _)) = SCHEMA.iter().find(|element| element.0 == name) else {
                return vec![format!("<{name}> is unknown")];
            };
            let inside = open.last().map(|parent: &String| {
                SCHEMA.iter().any(|element| element.0 == parent && element.3.contains(&name.as_str()))
            });
            if inside != Some(true) && !(open.is_empty() && name == "testsuites") {
                wrong.push(format!("<{name}> in {open:?}"));
            }
            let given: Vec<(String, String)> = start
                .attributes()
                .map(|one| one.expect("well-formed"))
                .map(|one| {
                    [one.key.as_ref(), &one.value].map(|bytes| String::from_utf8_lossy(bytes).into_owned())
                })
                .map(|[key, value]| (key, value))
                .collect();
            let has = |key: &&&str| given.iter().any(|one| one.0 == **key);
            wrong.extend(must.iter().filter(|key| !has(key)).map(|key| format!("<{name}> without {key}")));
            for (key, value) in &given {
                let number = value.parse::<f64>().is_ok_and(|number| number >= 0.0);
                let counted =
                    ["tests", "failures", "errors", "disabled", "skipped", "time"].contains(&key.as_str());
                if !(must.contains(&key.as_str()) || may.contains(&key.as_str())) || counted && !number {
                    wrong.push(format!("<{name} {key}=\"{value}\">"));
                }
            }
            if !empty {
                open.push(name);
            }
        }
    }

    #[test]
    fn it_fits_the_schema_and_what_does_not_is_seen() {
        let xml = junit_xml(&sample::run());
        assert_eq!(misfits(&xml), Vec::<String>::new());
        for (from, to) in [
            ("<testcase name=", "<testcase title="),
            ("<failure ", "<failed "),
            ("classname=", "class="),
            ("tests=\"7\"", "tests=\"all\""),
            ("<skipped ", "<skipped reason=\"none\" "),
            ("</testsuite>", "</testsuites>"),
        ] {
            assert!(xml.contains(from), "{from}");
            assert!(!misfits(&xml.replacen(from, to, 1)).is_empty(), "{from}");
        }
    }
}
