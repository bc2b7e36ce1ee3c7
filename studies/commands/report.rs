//! `pd-verify report --from DIR`: the report of an earlier run, from its results alone.

use super::compute::{Shown, ending};
use super::judge::End;
use crate::cli::RunOptions;
use crate::input::Refusal;
use crate::output::Output;
use crate::results::page::{self, Kept};
use crate::results::read::{Earlier, Source, earlier};
use std::io::{self, Write};
use std::path::Path;

/// Writes it anew, beside the results.
pub fn from(dir: &Path, options: &RunOptions) -> Result<End, Refusal> {
    let Earlier { run, folders, stale } = earlier(dir)?;
    let output = Output::open(dir, &[])?;
    let tell = |line: &str| {
        let _ = writeln!(io::stderr(), "{line}");
    };
    if !stale.is_empty() {
        tell(&format!("left out, since other runs wrote them: {}", stale.join(", ")));
    }
    let mut problems: Vec<String> =
        folders.iter().flat_map(|source| source.folder.problems.iter().cloned()).collect();
    let kept =
        folders.into_iter().map(|Source { place, folder, .. }| Kept { folder, place: Some(place) }).collect();
    let (judged, wrong) = page::write(&run, kept, &output);
    problems.extend(wrong);
    if let Err(error) = (Shown { out: dir, ..options.into() }).print_table(&judged) {
        problems.push(format!("cannot print: {error}"));
    }
    problems.iter().for_each(|problem| tell(&format!("error: {problem}")));
    if !run.complete {
        tell("the run was interrupted: what it did not reach or could not write is not in the report");
    }
    let failed = !problems.is_empty() || judged.iter().any(|one| one.evidence.failed.is_some());
    let end = ending(&judged, options.strict, run.shard.is_some(), failed);
    Ok(if run.complete || end != End::Pass { end } else { End::Fail })
}
