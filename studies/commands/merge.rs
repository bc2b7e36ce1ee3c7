//! `pd-verify merge DIR…`: the parts of a run, made with `--shard`, into one.

use super::compute::{Shown, ending};
use super::judge::End;
use crate::cli::MergeOptions;
use crate::input::Refusal;
use crate::output::Output;
use crate::results::merge::{Part, Whole};
use crate::results::read::earlier;
use std::fs;
use std::io::{self, Write};

/// Merges, or says which part is missing or of another run.
pub fn merge(options: &MergeOptions) -> Result<End, Refusal> {
    let MergeOptions { out, strict, quiet, .. } = options;
    let mut parts = Vec::new();
    for dir in &options.parts {
        let same = fs::canonicalize(dir).is_ok_and(|dir| fs::canonicalize(out).is_ok_and(|out| out == dir));
        if same {
            return Err(Refusal::new(format!("{} is a part and --out as well", dir.display()))
                .help("write the whole to a folder of its own with --out DIR"));
        }
        parts.push(Part { dir: dir.display().to_string(), earlier: earlier(dir)? });
    }
    let folders = parts.first().map(|part| part.earlier.run.order.clone()).unwrap_or_default();
    let whole = Whole::of(parts)?;
    let output = Output::open(out, &folders)?;
    let (_, judged, mut problems) = whole.write(&output, out);
    if let Err(error) = (Shown { out, strict: *strict, quiet: *quiet }).print_table(&judged) {
        problems.push(format!("cannot print: {error}"));
    }
    for problem in &problems {
        let _ = writeln!(io::stderr(), "error: {problem}");
    }
    let failed = !problems.is_empty() || judged.iter().any(|one| one.evidence.failed.is_some());
    Ok(ending(&judged, *strict, false, failed))
}
