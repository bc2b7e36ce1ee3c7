//! What speaks of a whole run, made from results alone: the page, the summary, JUnit, verdicts.

use super::ledger::ledger;
use super::shown::shown;
use super::{CaseResults, FigureResults, Folder, RUN, Run, StudyResults};
use crate::output::Output;
use pd_verify::report::{
    Drawn, RunSummary, StudyReport, index_html, junit_xml, summary_markdown, verdicts_csv,
};
use pd_verify::verdict::Judged;
use std::fs;
use std::io::{self, Write};
use std::path::PathBuf;

/// Bytes of figures that a page may hold; browsers open more with trouble.
const FIGURES: usize = 24 << 20;

/// A folder of results, and where its files are, if they could be written.
pub struct Kept {
    pub folder: Folder,
    pub place: Option<PathBuf>,
}

/// The run as pages and tables tell it.
pub fn summary(run: &Run, kept: Vec<Kept>) -> RunSummary {
    let mut room = FIGURES;
    let (mut studies, mut tables) = (Vec::new(), Vec::new());
    for Kept { folder, place } in kept {
        tables.extend(place.iter().flat_map(|place| shown(&folder, place)));
        for study in folder.studies {
            if run.shard.is_none() || !study.cases.is_empty() {
                studies.push(report(study, place.as_ref(), &mut room));
            }
        }
    }
    let title = format!("Verification of peridynamics{}", if run.complete { "" } else { ", interrupted" });
    let judged: Vec<&Judged> = studies.iter().flat_map(|study: &StudyReport| &study.judged).collect();
    // What a study of one's own shows is no figure of the sources.
    let ledger = if run.folders.len() > 1 { ledger(&judged) } else { Vec::new() };
    RunSummary {
        title,
        command: run.manifest.command(),
        manifest: run.manifest.pairs(),
        studies,
        ledger,
        tables,
    }
}

fn report(study: StudyResults, place: Option<&PathBuf>, room: &mut usize) -> StudyReport {
    let StudyResults { id, kind, title, mut text, source, cases, .. } = study;
    let (mut figures, mut left_out, mut judged) = (Vec::new(), 0, Vec::new());
    for CaseResults { figures: of_case, judged: of_claims, .. } in cases {
        judged.extend(of_claims);
        for figure in of_case {
            match place.and_then(|place| drawn(figure, place, room)) {
                Some(drawn) => figures.push(drawn),
                None => left_out += 1,
            }
        }
    }
    if left_out > 0 {
        text +=
            &format!("\n\n{left_out} more figures are not shown here: they are files beside the verdicts.");
    }
    StudyReport { id, kind, title, text, source, figures, judged }
}

/// The figure, if the page has room for it.
fn drawn(figure: FigureResults, place: &std::path::Path, room: &mut usize) -> Option<Drawn> {
    let file = place.join(figure.svg?.name);
    let size = usize::try_from(fs::metadata(&file).ok()?.len()).ok()?;
    *room = room.checked_sub(size)?;
    let svg = fs::read_to_string(file).ok()?;
    Some(Drawn { id: figure.id, title: figure.title, caption: figure.caption, svg })
}

/// Writes all that speaks of the run. Returns all claims, and what went wrong.
pub fn write(run: &Run, kept: Vec<Kept>, output: &Output) -> (Vec<Judged>, Vec<String>) {
    let summary = summary(run, kept);
    let mut problems = Vec::new();
    let mut replace = |name: &str, text: &str| {
        if let Err(error) = output.replace_file(name, text) {
            problems.push(format!("cannot write {name}: {error}"));
        }
    };
    let markdown = summary_markdown(&summary);
    replace("summary.md", &markdown);
    replace("junit.xml", &junit_xml(&summary));
    replace("index.html", &index_html(&summary));
    let judged: Vec<Judged> = summary.studies.into_iter().flat_map(|study| study.judged).collect();
    replace("verdicts.csv", &verdicts_csv(&judged));
    replace(RUN, &run.json());
    if let Err(error) = append_step_summary(&markdown) {
        problems.push(format!("cannot append to GITHUB_STEP_SUMMARY: {error}"));
    }
    (judged, problems)
}

/// GitHub shows what is appended to the file named by `GITHUB_STEP_SUMMARY`.
fn append_step_summary(markdown: &str) -> io::Result<()> {
    match std::env::var_os("GITHUB_STEP_SUMMARY").filter(|path| !path.is_empty()) {
        Some(path) => {
            fs::OpenOptions::new().create(true).append(true).open(path)?.write_all(markdown.as_bytes())
        }
        None => Ok(()),
    }
}

impl Run {
    /// The bytes of `run.json`.
    pub fn json(&self) -> String {
        serde_json::to_string_pretty(self).expect("plain data") + "\n"
    }
}
