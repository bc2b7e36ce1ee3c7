//! The folder of a command that judges nothing: its files, a manifest, and figures with their data.

use crate::attachment::Attachment;
use crate::cli::Isa;
use crate::manifest::Manifest;
use crate::output::Output;
use pd_verify::report::plot::Figure;
use pd_verify::report::{Drawn, figure_table};

/// Writes it; returns what went wrong. `isa` is the instruction set that was asked for.
pub fn write(
    output: &Output,
    folder: &str,
    isa: Option<Isa>,
    mut files: Vec<Attachment>,
    figures: &[Figure],
) -> Vec<String> {
    let mut problems = Vec::new();
    let manifest =
        Manifest::of_this_run("standard".into(), Vec::new(), isa.map(|isa| isa.word().into()), Vec::new());
    files.push(Attachment::text("manifest.json", manifest.json()));
    for figure in figures {
        match Drawn::new(figure) {
            Ok(drawn) => files.push(Attachment::text(format!("{}.svg", drawn.id), drawn.svg)),
            Err(error) => problems.push(format!("figure {}: {error}", figure.id)),
        }
        let data = figure_table(figure);
        files.push(Attachment::text(data.file.clone(), data.csv()));
    }
    if let Err(error) = output.replace_folder(folder, &files) {
        problems.push(format!("cannot write the results: {error}"));
    }
    problems
}
