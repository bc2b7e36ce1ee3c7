//! The parts of a run put together: looked at as a whole first, then copied case by case.

use super::page::{self, Kept};
use super::read::{Earlier, Source, differs};
use super::write::Writer;
use super::{CaseResults, File, Run, StudyResults};
use crate::input::Refusal;
use crate::manifest::Manifest;
use crate::output::Output;
use pd_verify::verdict::{Evidence, Judged};
use std::path::Path;

/// A part: the folder that was given, and what is in it.
pub struct Part {
    pub dir: String,
    pub earlier: Earlier,
}

/// Parts that make one run.
pub struct Whole {
    parts: Vec<Part>,
    folders: Vec<Planned>,
}

/// A folder to be written: its studies, and where each of their cases is found.
struct Planned {
    name: String,
    studies: Vec<(StudyResults, Vec<Place>)>,
}

/// A case of a part: the part, its folder, the case's id.
struct Place {
    part: usize,
    folder: usize,
    case: String,
}

impl Whole {
    /// Refuses parts that do not make one run.
    pub fn of(parts: Vec<Part>) -> Result<Self, Refusal> {
        refuse_incomplete(&parts)?;
        for part in &parts[1..] {
            one_piece(&parts[0], part)?;
        }
        let names = parts[0].earlier.run.order.clone();
        let folders = names.into_iter().map(|name| planned(&parts, name)).collect::<Result<_, _>>()?;
        Ok(Self { parts, folders })
    }

    /// Writes the whole. Returns its run, its claims, and what went wrong.
    pub fn write(&self, output: &Output, out: &Path) -> (Run, Vec<Judged>, Vec<String>) {
        let runs: Vec<&Manifest> = self.parts.iter().map(|part| &part.earlier.run.manifest).collect();
        let mut problems = Vec::new();
        let (mut kept, mut folders) = (Vec::new(), Vec::new());
        for folder in &self.folders {
            let (found, recorded) = self.folder(folder, output, out, &mut problems);
            kept.push(found);
            folders.extend(recorded);
        }
        let first = &self.parts[0].earlier.run;
        let manifest = together(&runs, out);
        let run = Run { manifest, shard: None, complete: true, folders, ..first.clone() };
        let (judged, wrong) = page::write(&run, kept, output);
        problems.extend(wrong);
        (run, judged, problems)
    }

    fn folder(
        &self,
        folder: &Planned,
        output: &Output,
        out: &Path,
        problems: &mut Vec<String>,
    ) -> (Kept, Option<File>) {
        let sources: Vec<&Source> = self.parts.iter().filter_map(|part| part.folder(&folder.name)).collect();
        let manifests: Vec<&Manifest> = sources.iter().map(|source| &source.folder.manifest).collect();
        let mut writer = Writer::new(output, &folder.name, together(&manifests, out), None);
        for source in &sources {
            writer.problems(&source.folder.problems);
        }
        for (study, places) in &folder.studies {
            writer.study(study.clone());
            for Place { part, folder, case } in places {
                let source = &self.parts[*part].earlier.folders[*folder];
                let Some(found) = source.case(&study.id, case) else { continue };
                if let Err(error) = writer.take_over(source, &study.id, found) {
                    problems.push(format!("cannot copy {}/{case}: {error}", study.id));
                }
            }
        }
        let (found, placed) = writer.finish();
        problems.extend(found.problems.iter().cloned());
        match placed {
            Ok((place, sha256)) => {
                let recorded = File { name: folder.name.clone(), sha256 };
                (Kept { folder: found, place: Some(place) }, Some(recorded))
            }
            Err(error) => {
                problems.push(format!("cannot write the results of {}: {error}", folder.name));
                (Kept { folder: found, place: None }, None)
            }
        }
    }
}

impl Part {
    fn folder(&self, name: &str) -> Option<&Source> {
        let at = self.earlier.run.folders.iter().position(|folder| folder.name == name)?;
        self.earlier.folders.get(at)
    }
}

/// Every part must be one, finished, of the same number, and all must be there.
fn refuse_incomplete(parts: &[Part]) -> Result<(), Refusal> {
    let mut found = Vec::new();
    for Part { dir, earlier } in parts {
        let Some(shard) = earlier.run.shard else {
            return Err(Refusal::new(format!("{dir} is no part of a run, but a whole one"))
                .help("give folders of runs with --shard"));
        };
        if !earlier.run.complete {
            return Err(Refusal::new(format!("{dir}, part {shard}, was interrupted"))
                .help("run it again with --resume, then merge"));
        }
        found.push(shard);
    }
    let Some(first) = found.first() else {
        return Err(Refusal::new("there is nothing to merge").help("give the folders of all parts"));
    };
    if let Some(at) = found.iter().position(|shard| shard.of != first.of) {
        let message = format!("{} is part {first}, {} is part {}", parts[0].dir, parts[at].dir, found[at]);
        return Err(Refusal::new(message).help("run all parts with the same n in --shard k/n"));
    }
    let missing: Vec<String> = (1..=first.of)
        .filter(|part| !found.iter().any(|shard| shard.part == *part))
        .map(|part| format!("{part}/{}", first.of))
        .collect();
    if missing.is_empty() {
        return Ok(());
    }
    let listed = missing.iter().take(20).cloned().collect::<Vec<_>>().join(", ");
    let more = if missing.len() > 20 { ", …" } else { "" };
    Err(Refusal::new(format!("{} of {} parts are missing: {listed}{more}", missing.len(), first.of))
        .help("run them with --shard, and give their folders too"))
}

/// Both must come of the same program and the same command.
fn one_piece(a: &Part, b: &Part) -> Result<(), Refusal> {
    let (one, other) = (&a.earlier.run, &b.earlier.run);
    let differs = differs(&one.manifest, &other.manifest)
        .or_else(|| (one.manifest.settings != other.manifest.settings).then_some("--set"))
        .or_else(|| (one.order != other.order).then_some("list of folders"))
        .or_else(|| (one.manifest.studies != other.manifest.studies).then_some("list of study files"));
    match differs {
        Some(what) => Err(Refusal::new(format!("{} and {} differ in their {what}", a.dir, b.dir))
            .help("parts must be run by one program with one command, but for --shard, --out and --threads")),
        None => Ok(()),
    }
}

/// Where each case of a folder is found; refuses what is missing, and what is there twice and not the same.
fn planned(parts: &[Part], name: String) -> Result<Planned, Refusal> {
    let holders: Vec<(usize, usize)> = parts
        .iter()
        .enumerate()
        .filter_map(|(at, part)| {
            Some((at, part.earlier.run.folders.iter().position(|folder| folder.name == name)?))
        })
        .collect();
    let source = |(part, folder): (usize, usize)| &parts[part].earlier.folders[folder];
    let Some(&first) = holders.first() else {
        return Err(Refusal::new(format!("no part has results of {name}"))
            .help("run all parts again with the same command"));
    };
    let mut studies = Vec::new();
    for (at, head) in source(first).folder.studies.iter().enumerate() {
        let head = StudyResults { cases: Vec::new(), ..head.clone() };
        for &holder in &holders {
            let other = source(holder).folder.studies.get(at);
            let other = other.map(|other| StudyResults { cases: Vec::new(), ..other.clone() });
            if other.as_ref() != Some(&head) {
                let message = format!("{} says other things of {}", parts[holder.0].dir, head.id);
                return Err(Refusal::new(message).help("run all parts with the same study files"));
            }
        }
        let mut places = Vec::new();
        for case in &head.order {
            let found: Vec<(usize, usize, &CaseResults)> = holders
                .iter()
                .filter_map(|&(part, folder)| {
                    Some((part, folder, source((part, folder)).case(&head.id, case)?))
                })
                .collect();
            let Some(&(part, folder, one)) = found.first() else {
                return Err(Refusal::new(format!("{}/{case} is in no part", head.id))
                    .help("run all parts again with the same command"));
            };
            if let Some((other, ..)) = found.iter().find(|(_, _, other)| !same(one, other)) {
                let message = format!(
                    "{}/{case} is in {} and in {}, with different results",
                    head.id, parts[part].dir, parts[*other].dir
                );
                return Err(Refusal::new(message).help("leave out the folder that is not of this run"));
            }
            places.push(Place { part, folder, case: case.clone() });
        }
        studies.push((head, places));
    }
    Ok(Planned { name, studies })
}

/// Whether two parts found the same, apart from the time that it took. NaN is the same as NaN.
fn same(a: &CaseResults, b: &CaseResults) -> bool {
    let text = |case: &CaseResults| {
        let timeless = |one: &Judged| Judged {
            evidence: Evidence { seconds: None, ..one.evidence.clone() },
            ..one.clone()
        };
        let judged = case.judged.iter().map(timeless).collect();
        serde_json::to_string(&CaseResults { seconds: 0.0, judged, ..case.clone() })
    };
    matches!((text(a), text(b)), (Ok(a), Ok(b)) if a == b)
}

/// One manifest of several: the first start, all machines where they differ, the command without its parts.
fn together(manifests: &[&Manifest], out: &Path) -> Manifest {
    let mut whole = manifests[0].clone();
    let mut machines: Vec<String> = Vec::new();
    for manifest in manifests {
        let machine = format!("{}, {} threads", manifest.cpu, manifest.threads);
        if !machines.contains(&machine) {
            machines.push(machine);
        }
        if manifest.start < whole.start {
            whole.start.clone_from(&manifest.start);
        }
    }
    whole.machines = if machines.len() > 1 { machines } else { Vec::new() };
    whole.command_line = command_of_whole(&whole.command_line, out);
    whole
}

/// The command of a part without what makes it one, and with the folder of the whole.
fn command_of_whole(part: &[String], out: &Path) -> Vec<String> {
    const WITH_VALUE: [&str; 2] = ["--shard", "--out"];
    const ALONE: [&str; 2] = ["--resume", "--rerun-failed"];
    let mut words = Vec::new();
    let mut left = part.iter();
    while let Some(word) = left.next() {
        let name = word.split('=').next().unwrap_or_default();
        if WITH_VALUE.contains(&word.as_str()) {
            left.next();
        } else if !WITH_VALUE.contains(&name) && !ALONE.contains(&name) {
            words.push(word.clone());
        }
    }
    if out != Path::new("reports") {
        words.extend(["--out".to_owned(), out.display().to_string()]);
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_of_the_whole_is_that_of_a_part_without_the_part() {
        let words = |text: &str| text.split(' ').map(str::to_owned).collect::<Vec<_>>();
        let part = words("pd-verify run a.toml --shard 1/2 --out part-1 --profile quick --resume");
        let whole = command_of_whole(&part, Path::new("all"));
        assert_eq!(whole, words("pd-verify run a.toml --profile quick --out all"));
        let part = words("pd-verify report --shard=1/2 --out=x --strict");
        assert_eq!(command_of_whole(&part, Path::new("reports")), words("pd-verify report --strict"));
    }
}
