//! Results into bytes: figures, tables and pages as text, without input, output or printing.

mod figure_csv;
mod html;
mod junit;
mod markdown;
mod npy;
mod number;
pub mod plot;
mod row;
mod terminal;
mod verdict_table;
mod vti;

pub use figure_csv::figure_table;
pub use html::index_html;
pub use junit::junit_xml;
pub use markdown::summary_markdown;
pub use npy::npy;
pub use number::csv_number;
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
    pub title: String,
    /// What the study claims; paragraphs are separated by an empty line.
    pub text: String,
    /// Where the claims and references come from.
    pub source: String,
    pub figures: Vec<Drawn>,
    pub judged: Vec<Judged>,
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
