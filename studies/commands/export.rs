//! `pd-verify explain CASE --export DIR`: the problem for the user of any solver, templates, and the references as CSV.

use super::check::case;
use crate::foreign::Foreign;
use crate::input::Refusal;
use crate::output::Output;
use crate::rounded::rounded;
use crate::study::Case;
use pd_verify::table::{Cell, Table};
use std::fmt::Write;
use std::path::Path;

/// Writes the brief of a case; returns what to print.
pub fn export(id: &str, folder: &Path) -> Result<String, Refusal> {
    let study = case(id, &[])?;
    let case = &study.cases[0];
    let forms = case.question.foreign();
    let output = Output::open(folder, &[])?;
    let mut files = vec![("README.md".to_owned(), brief(case, id, &forms))];
    for (index, form) in forms.iter().enumerate() {
        let name = file_name(&forms, index);
        let header: Vec<&'static str> = form.wanted().iter().map(|one| one.name).collect();
        let mut table = Table::new("reference.csv", &header);
        let template = table.csv();
        let columns = form.reference();
        for row in 0..columns.first().map_or(0, Vec::len) {
            let cells: Vec<Cell> = columns.iter().map(|column| column[row].into()).collect();
            table.push(cells);
        }
        files.push((format!("{name}.csv"), template));
        files.push((format!("{name}-reference.csv"), table.csv()));
    }
    let mut text = String::new();
    for (name, content) in files {
        let refuse = |error| {
            Refusal::new(format!("cannot write {}: {error}", folder.join(&name).display()))
                .help("give another folder to --export")
        };
        let place = output.replace_file(&name, &content).map_err(refuse)?;
        let _ = writeln!(text, "wrote {}", place.display());
    }
    Ok(text)
}

/// A form as a file name.
fn file_name(forms: &[Box<dyn Foreign + '_>], index: usize) -> String {
    let slug = |name: String| -> String {
        let kept: Vec<String> = name
            .split(|letter: char| !(letter.is_ascii_alphanumeric() || letter == '.'))
            .filter(|part| !part.is_empty())
            .map(str::to_lowercase)
            .collect();
        kept.join("-")
    };
    let own = slug(forms[index].name());
    let others = forms.iter().enumerate().filter(|(other, _)| *other != index);
    if own.is_empty() || others.into_iter().any(|(_, form)| slug(form.name()) == own) {
        return format!("{:02}-{own}", index + 1);
    }
    own
}

/// The problem as text.
fn brief(case: &Case, id: &str, forms: &[Box<dyn Foreign + '_>]) -> String {
    let mut text = format!(
        "# {}\n\nCase `{}/{}`. Solve it with any code, write what is asked for below, and let it be judged.\n",
        case.title, case.place.study, case.place.case
    );
    let mut said: Vec<(&'static str, String)> = Vec::new();
    for form in forms {
        let new: Vec<_> = form.problem().into_iter().filter(|part| !said.contains(part)).collect();
        if new.is_empty() {
            continue;
        }
        if forms.len() > 1 && !said.is_empty() {
            let _ = write!(text, "\n## For `{}`\n", form.name());
        }
        for (heading, body) in &new {
            let _ = write!(text, "\n### {heading}\n\n{body}\n");
        }
        said.extend(new);
    }
    let _ = write!(text, "\n### Equations\n\n```text\n{}\n```\n", case.question.equations());
    for (index, form) in forms.iter().enumerate() {
        let name = file_name(forms, index);
        let _ = write!(
            text,
            "\n## Report `{}`\n\n{}.\n\n| column | unit | what |\n|---|---|---|\n",
            form.name(),
            form.what()
        );
        for one in form.wanted() {
            let instead =
                one.instead.map_or(String::new(), |(name, unit, _)| format!("; or `{name}` in {unit}"));
            let _ = writeln!(text, "| `{}` | {} | {}{instead} |", one.name, one.unit, one.what);
        }
        let _ = write!(
            text,
            "\nTemplate: `{name}.csv`. Reference: `{name}-reference.csv`. Columns may have other names and units (`--map`, `--unit`).\n\nJudged by:\n\n"
        );
        for claim in form.claims(&case.place) {
            let bound = match claim.expected_order {
                Some(order) => format!("order {} within {}", rounded(order), rounded(claim.tolerance)),
                None => format!("at most {}", rounded(claim.tolerance)),
            };
            let _ = writeln!(
                text,
                "- {}: {bound} ({}: {}). Reference: {}.",
                claim.quantity,
                claim.basis.word(),
                claim.because,
                claim.source
            );
        }
        let choose = if forms.len() > 1 { format!(" --as '{}'", form.name()) } else { String::new() };
        let _ = write!(text, "\n```sh\npd-verify check {id} --data {name}.csv{choose}\n```\n");
    }
    text
}
