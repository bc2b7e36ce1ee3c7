//! Results into bytes: figures, tables and pages as text, without input, output or printing.

mod figure_csv;
mod html;
mod html_parts;
mod junit;
mod markdown;
mod npy;
mod number;
pub mod plot;
mod row;
mod survey;
mod terminal;
mod verdict_table;
mod vti;

pub use figure_csv::figure_table;
pub use html::index_html;
pub use junit::junit_xml;
pub use markdown::summary_markdown;
pub use npy::npy;
pub use number::{csv_number, readable};
pub use row::counts_line;
pub use terminal::terminal_table;
pub use verdict_table::verdicts_csv;
pub use vti::{pvd, vti};

use crate::verdict::Judged;
use serde::Serialize;

/// Everything that was found in one run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RunSummary {
    pub title: String,
    /// The command line that reproduces the run.
    pub command: String,
    /// Names and values: version, processor, threads, start.
    pub manifest: Vec<(String, String)>,
    pub studies: Vec<StudyReport>,
    /// What the sources show, and what this run says of it.
    pub ledger: Vec<Traced>,
    /// Tables of results that a page shows as they are.
    pub tables: Vec<Shown>,
}

impl RunSummary {
    /// All claims of all studies.
    pub fn judged(&self) -> impl Iterator<Item = &Judged> {
        self.studies.iter().flat_map(|study| &study.judged)
    }
}

/// What was found in one study.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StudyReport {
    pub id: String,
    /// The word of its kind.
    pub kind: String,
    pub title: String,
    /// What the study claims; paragraphs are separated by an empty line.
    pub text: String,
    /// Where the claims and references come from.
    pub source: String,
    pub figures: Vec<Drawn>,
    pub judged: Vec<Judged>,
}

/// A figure, a number or a formula of a source beside what a run found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Traced {
    pub source: String,
    /// What the source shows.
    pub what: String,
    pub outcome: Outcome,
    /// How much differs and why, or what is missing.
    pub why: String,
    /// Claims of this run that say so.
    pub claims: Vec<String>,
}

/// What became of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Outcome {
    Reproduced,
    /// It is not so, and claims say what is.
    Differs,
    /// What it would take is not given, or not built.
    NotReproducible,
    /// Claims that should say it did not come out as expected.
    InDoubt,
    /// Some of its claims did not run.
    NotRun,
}

impl Outcome {
    pub const ALL: [Self; 5] =
        [Self::Reproduced, Self::Differs, Self::NotReproducible, Self::InDoubt, Self::NotRun];

    pub fn word(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::Differs => "differs",
            Self::NotReproducible => "not reproducible",
            Self::InDoubt => "in doubt",
            Self::NotRun => "not run",
        }
    }
}

/// A table of results under a heading.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Shown {
    pub id: String,
    pub title: String,
    pub caption: String,
    pub columns: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

/// A figure that has been drawn.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Drawn {
    pub id: String,
    pub title: String,
    pub caption: String,
    pub svg: String,
}

impl Drawn {
    /// Draws a figure.
    ///
    /// # Errors
    /// Those of [`plot::svg`].
    pub fn new(figure: &plot::Figure) -> Result<Self, plot::PlotError> {
        let svg = plot::svg(figure)?;
        let (id, title, caption) = (figure.id.clone(), figure.title.clone(), figure.caption.clone());
        Ok(Self { id, title, caption, svg })
    }
}

#[cfg(test)]
mod sample;
