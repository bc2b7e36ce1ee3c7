//! Verdicts for a terminal: one line per claim, reasons under those that fail, the counts at the end.

use super::row::{Row, counts_line};
use crate::verdict::{Judged, Verdict};

/// The table, no line wider than `width` characters; colours by ANSI codes, which take no width.
pub fn terminal_table(judged: &[Judged], width: usize, colour: bool) -> String {
    let width = width.max(20);
    let rows: Vec<Row> = judged.iter().map(Row::new).collect();
    let longest =
        |text: fn(&Row) -> &str| rows.iter().map(|row| text(row).chars().count()).max().unwrap_or(0);
    let columns = Columns {
        verdict: longest(|row| row.verdict),
        error: longest(|row| &row.weighed),
        bound: longest(|row| &row.bound),
    };
    let mut out = String::new();
    let mut group = String::new();
    for (one, row) in judged.iter().zip(&rows) {
        let next = format!("{}/{}", one.claim.study, one.claim.case);
        if next != group {
            out += &cut(&next, width);
            out.push('\n');
            group = next;
        }
        let name = row.claim.strip_prefix(&format!("{group}/")).unwrap_or(&row.claim);
        out += &line(row, name, &columns, width, one.verdict, colour);
        if row.failing {
            let reason = [row.note.as_str(), row.order.as_str()].into_iter().filter(|text| !text.is_empty());
            for text in reason.flat_map(|text| wrapped(text, width - 6)) {
                out += &format!("      {text}\n");
            }
        }
    }
    out += &cut(&counts_line(judged), width);
    out.push('\n');
    out
}

struct Columns {
    verdict: usize,
    error: usize,
    bound: usize,
}

/// Verdict, claim, error, bound. The claim gives way first; then the line is cut at its end.
fn line(row: &Row, name: &str, columns: &Columns, width: usize, verdict: Verdict, colour: bool) -> String {
    let fixed = 2 + columns.verdict + 2 + 2 + columns.error + 2 + columns.bound;
    let room = width.saturating_sub(fixed).max(12);
    let rest = format!(
        "  {:<room$}  {:>error$}  {}",
        cut(name, room),
        row.weighed,
        row.bound,
        error = columns.error
    );
    let word = format!("{:<size$}", row.verdict, size = columns.verdict);
    let rest = cut(rest.trim_end(), width.saturating_sub(2 + columns.verdict));
    match colour {
        true => format!("  \u{1b}[{}m{word}\u{1b}[0m{rest}\n", code(verdict)),
        false => format!("  {word}{rest}\n"),
    }
}

fn code(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "32",
        Verdict::Xfail => "36",
        Verdict::Fail | Verdict::Xpass | Verdict::Error => "1;31",
        Verdict::Inconclusive | Verdict::Skipped => "33",
    }
}

/// The text, cut to `width` characters, the last of them an ellipsis where something is missing.
fn cut(text: &str, width: usize) -> String {
    if text.chars().count() <= width {
        return text.to_owned();
    }
    text.chars().take(width.saturating_sub(1)).chain(['…']).collect()
}

fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace().map(|word| cut(word, width)) {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;

    #[test]
    fn no_line_is_wider_than_asked_and_none_is_lost() {
        let judged = sample::judged();
        for width in [20, 40, 80, 200] {
            let table = terminal_table(&judged, width, false);
            assert!(table.lines().all(|line| line.chars().count() <= width), "{width}:\n{table}");
            for one in &judged {
                assert!(table.lines().any(|line| line.trim().starts_with(one.verdict.word())), "{table}");
            }
        }
    }

    #[test]
    fn failing_claims_say_why_and_the_counts_come_last() {
        let table = terminal_table(&sample::judged(), 100, false);
        assert!(table.contains("twenty times"));
        assert!(!table.contains("needs four levels"));
        assert!(table.lines().last().unwrap().starts_with("7 claims: 1 pass"));
        assert_eq!(table.matches("dispersion/constant-m3\n").count(), 1);
    }

    #[test]
    fn colour_is_only_there_when_asked() {
        let judged = sample::judged();
        assert!(!terminal_table(&judged, 80, false).contains('\u{1b}'));
        assert!(terminal_table(&judged, 80, true).contains("\u{1b}[32mpass"));
    }
}
