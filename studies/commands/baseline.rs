//! `pd-verify baseline save NAME` and `compare NAME`: what a run found, kept beside the code, and how far a later one has drifted.

use super::judge::End;
use super::say;
use crate::input::Refusal;
use crate::results::baseline::{Baseline, Drift, Moved, OF_ROUNDING, ROUNDING, SHARE, drift};
use crate::results::read::{Earlier, earlier};
use pd_verify::verdict::Judged;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The folder of baselines, below that of the results.
const FOLDER: &str = "baselines";

/// Keeps what the run in `dir` found under a name.
pub fn save(name: &str, dir: &Path, with_seconds: bool) -> Result<u8, Refusal> {
    let place = place(name, dir)?;
    let found = whole(dir)?;
    if place.exists() {
        // What is no baseline of ours is not replaced.
        read(&place, "choose another name")?;
    }
    let baseline = Baseline::of(&found.run, judged(&found), with_seconds);
    write(&place, &baseline.json()).map_err(|error| {
        Refusal::new(format!("cannot write {}: {error}", place.display()))
            .help("choose another name, or a path that ends in .json")
    })?;
    Ok(printed(&format!("kept {} claims in {}\n", baseline.claims.len(), place.display()), 0))
}

/// Holds the run in `dir` against a baseline.
pub fn compare(name: &str, dir: &Path, slower: Option<f64>) -> Result<u8, Refusal> {
    if let Some(factor) = slower.filter(|factor| !(*factor >= 1.0 && factor.is_finite())) {
        return Err(Refusal::new(format!("--slower {factor} is no factor of 1 or more"))
            .help("as in --slower 1.5 for half as long again"));
    }
    let place = place(name, dir)?;
    let before = read(&place, &others(dir))?;
    if slower.is_some() && before.claims.iter().all(|one| one.seconds.is_none()) {
        return Err(Refusal::new(format!("{} has no seconds", place.display()))
            .help("save it with --seconds, or leave out --slower"));
    }
    let found = whole(dir)?;
    let drift = drift(&before, &found.run, judged(&found), slower);
    let text = said(&place, &before, &found, &drift);
    Ok(printed(&text, if drift.is_none() { 0 } else { End::Fail.code() }))
}

/// A run that is whole.
fn whole(dir: &Path) -> Result<Earlier, Refusal> {
    let found = earlier(dir)?;
    let dir = dir.display();
    if let Some(shard) = found.run.shard {
        return Err(Refusal::new(format!("{dir} holds part {shard} of a run"))
            .help("put the parts together with `pd-verify merge DIR…`"));
    }
    if !found.run.complete {
        return Err(Refusal::new(format!("the run in {dir} was interrupted")).help("finish it with --resume"));
    }
    Ok(found)
}

fn judged(found: &Earlier) -> impl Iterator<Item = &Judged> {
    found.folders.iter().flat_map(|source| source.folder.judged())
}

/// A name stands for a file below the results; a path is a path.
fn place(name: &str, dir: &Path) -> Result<PathBuf, Refusal> {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    let path = Path::new(name);
    if path.extension().is_some_and(|ending| ending == "json") {
        return Ok(path.to_owned());
    }
    if !name.is_empty() && name.len() <= 80 && name.chars().all(plain) && !name.starts_with('.') {
        return Ok(dir.join(FOLDER).join(format!("{name}.json")));
    }
    Err(Refusal::new(format!("\"{name}\" cannot name a baseline"))
        .help("use letters, digits, - and _, or give a path that ends in .json"))
}

fn read(place: &Path, help: &str) -> Result<Baseline, Refusal> {
    let text = fs::read_to_string(place)
        .map_err(|error| Refusal::new(format!("cannot read {}: {error}", place.display())).help(help))?;
    Baseline::parse(place, &text)
}

/// The baselines that are there, for who has misspelt one.
fn others(dir: &Path) -> String {
    let entries = fs::read_dir(dir.join(FOLDER)).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries
        .filter_map(|entry| Some(entry.file_name().to_str()?.strip_suffix(".json")?.to_owned()))
        .collect();
    names.sort();
    match names.is_empty() {
        true => "make one with `pd-verify baseline save NAME`".to_owned(),
        false => format!("there are: {}", names.join(", ")),
    }
}

/// Under a temporary name first, so that no half file takes the place of a whole one.
fn write(place: &Path, text: &str) -> io::Result<()> {
    if let Some(folder) = place.parent() {
        fs::create_dir_all(folder)?;
    }
    let partial = place.with_extension(format!("partial-{}", std::process::id()));
    let written = fs::write(&partial, text).and_then(|()| fs::rename(&partial, place));
    if written.is_err() {
        let _ = fs::remove_file(&partial);
    }
    written
}

fn printed(text: &str, code: u8) -> u8 {
    match say(text) {
        Ok(()) => code,
        Err(error) => {
            let _ = writeln!(io::stderr(), "error: cannot print: {error}");
            End::Computation.code()
        }
    }
}

/// What has changed, in words: what was lost first, then what moved.
fn said(place: &Path, before: &Baseline, found: &Earlier, drift: &Drift) -> String {
    let mut text = format!("{} claims compared with {}\n", drift.compared, place.display());
    let now = &found.run.manifest;
    let commit = |commit: &Option<String>| commit.clone().unwrap_or_else(|| "unknown".into());
    for (what, was, is) in [
        ("version", before.version.clone(), now.version.clone()),
        ("commit", commit(&before.git_commit), commit(&now.git_commit)),
        ("target", before.target.clone(), now.target.clone()),
        ("instruction set", before.instruction_set.clone(), now.instruction_set.clone()),
        ("profile", before.profile.clone(), now.profile.clone()),
        ("--set", before.settings.join(", "), now.settings.join(", ")),
    ] {
        if was != is {
            text += &format!("another {what}: {was} then, {is} now\n");
        }
    }
    for (claim, was, is) in &drift.verdicts {
        text += &format!("verdict  {claim}: {} then, {} now\n", was.word(), is.word());
    }
    for claim in &drift.missing {
        text += &format!("missing  {claim}\n");
    }
    for one in &drift.moved {
        text += &line(one);
    }
    for claim in &drift.new {
        text += &format!("new      {claim}\n");
    }
    if !drift.moved.is_empty() {
        text += &format!(
            "allowed: {ROUNDING:e} of the quantity with the same bits; {SHARE} of the tolerance on another instruction set; \
             {OF_ROUNDING} of it for what is rounding itself\n"
        );
    }
    let (verdicts, moved) = (drift.verdicts.len(), drift.moved.len());
    let (missing, new) = (drift.missing.len(), drift.new.len());
    text + &format!(
        "{verdicts} verdicts changed, {moved} quantities moved, {missing} claims missing, {new} new\n"
    )
}

fn line(one: &Moved) -> String {
    let number = |value: Option<f64>| value.map_or_else(|| "unknown".to_owned(), |x| format!("{x:?}"));
    let by = one.before.zip(one.now).map_or(String::new(), |(a, b)| format!(", by {:.3e}", b - a));
    format!(
        "moved    {}: {} {} then, {} now{by}; allowed {:.1e}, tolerance {:e}\n",
        one.claim,
        one.quantity,
        number(one.before),
        number(one.now),
        one.allowed,
        one.tolerance
    )
}
