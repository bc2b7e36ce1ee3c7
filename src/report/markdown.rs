//! `summary.md`: the verdicts for a pull request or a step summary, short enough to be shown.

use super::RunSummary;
use super::row::{Row, counts_line};
use std::fmt::Write;

/// GitHub drops a step summary of 1 MiB or more as a whole.
const LIMIT: usize = 1_000_000;

/// How much each line says; tried in this order until the summary is short enough.
#[derive(Clone, Copy, PartialEq)]
enum Detail {
    Full,
    ShortNotes,
    NoNotes,
    VerdictsOnly,
    CountsOnly,
}

/// The run as Markdown: counts, what fails, then a table per study. Long summaries lose their notes before their
/// numbers, and their numbers before their verdicts.
pub fn summary_markdown(run: &RunSummary) -> String {
    let details = [Detail::Full, Detail::ShortNotes, Detail::NoNotes, Detail::VerdictsOnly];
    let texts = details.into_iter().map(|detail| write(run, detail));
    texts.into_iter().find(|text| text.len() < LIMIT).unwrap_or_else(|| write(run, Detail::CountsOnly))
}

fn write(run: &RunSummary, detail: Detail) -> String {
    let mut out = format!("# {}\n\n{}\n", escaped(&run.title), counts_line(run.judged()));
    let failing: Vec<Row> = run.judged().map(Row::new).filter(|row| row.failing).collect();
    if !failing.is_empty() {
        let _ = write!(out, "\n## Failing\n\n");
        table(&mut out, &failing, detail);
    }
    for study in &run.studies {
        let _ = write!(out, "\n## {}\n\n{}\n\n", escaped(&study.title), counts_line(&study.judged));
        let rows: Vec<Row> = study.judged.iter().map(Row::new).collect();
        table(&mut out, &rows, detail);
    }
    let omitted = match detail {
        Detail::Full => "",
        Detail::ShortNotes => "Notes are shortened here. ",
        Detail::NoNotes => "Notes are left out here. ",
        Detail::VerdictsOnly => "Numbers and notes are left out here. ",
        Detail::CountsOnly => "Only counts are shown here. ",
    };
    let command = run.command.replace('`', "'");
    let _ = write!(out, "\n{omitted}All digits are in `verdicts.csv`. Reproduce: `{command}`\n");
    out
}

fn table(out: &mut String, rows: &[Row], detail: Detail) {
    if detail == Detail::CountsOnly || rows.is_empty() {
        return;
    }
    if detail == Detail::VerdictsOnly {
        out.push_str("| verdict | claim |\n|---|---|\n");
        for row in rows {
            let _ = writeln!(out, "| {} | {} |", row.verdict, code(&row.claim));
        }
        return;
    }
    out.push_str("| verdict | claim | computed | reference | error | asked | basis | note |\n");
    out.push_str("|---|---|--:|--:|--:|---|---|---|\n");
    for row in rows {
        let said = match (row.order.is_empty(), row.note.is_empty()) {
            (false, false) => format!("{}; {}", row.order, row.note),
            _ => format!("{}{}", row.order, row.note),
        };
        let note = match detail {
            Detail::Full => said,
            Detail::ShortNotes if said.chars().count() > 80 => said.chars().take(79).chain(['…']).collect(),
            Detail::ShortNotes => said,
            _ => String::new(),
        };
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} | {} | {} | {} | {} |",
            if row.failing { format!("**{}**", row.verdict) } else { row.verdict.to_owned() },
            code(&row.claim),
            row.computed,
            row.reference,
            row.error,
            row.bound,
            row.basis,
            escaped(&note)
        );
    }
}

/// Text whose signs Markdown and HTML would take as their own.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '&' => out.push_str("&amp;"),
            '|' | '*' | '_' | '`' | '[' | ']' | '\\' | '#' | '~' => out.extend(['\\', c]),
            c if c.is_whitespace() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

fn code(text: &str) -> String {
    format!("`{}`", text.replace('`', "'").replace('|', "\\|"))
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;

    #[test]
    fn failing_comes_first_and_nothing_breaks_the_table() {
        let text = summary_markdown(&sample::run());
        let (failing, first) =
            (text.find("## Failing").unwrap(), text.find("## The dispersion study").unwrap());
        assert!(failing < first);
        assert!(text.contains("| **fail** | `dispersion/constant-m3/fails` |"));
        assert!(text.contains("twenty times &lt;b>too large"));
        let rows = text.lines().filter(|line| line.starts_with("| "));
        assert!(rows.clone().all(|line| line.replace("\\|", "").matches('|').count() == 9), "{text}");
        assert_eq!(rows.count(), 3 + 7 + 3);
    }

    #[test]
    fn a_long_summary_loses_notes_before_verdicts() {
        let mut run = sample::run();
        let one = run.studies[0].judged[1].clone();
        let note = "a long story ".repeat(40);
        for i in 0..3000 {
            let mut more = one.clone();
            more.claim.id = format!("dispersion/case/number-{i}");
            more.evidence.note = note.clone();
            run.studies[0].judged.push(more);
        }
        let text = summary_markdown(&run);
        assert!(text.len() < 1 << 20);
        assert!(text.contains("Notes are shortened here") || text.contains("Notes are left out here"));
        assert!((0..3000).all(|i| text.contains(&format!("/number-{i}`"))));
    }
}
