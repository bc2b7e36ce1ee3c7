//! Commands that judge studies: which studies, in which folders, and the code that tells how it went.

use super::compute::compute;
use crate::cli::RunOptions;
use crate::input::{MAX_BYTES, Refusal, Setting};
use crate::kind::Kind;
use crate::manifest::StudyHash;
use crate::shard::Shard;
use crate::shipped::{commands, refuse_unused, shipped};
use crate::study::Study;
use pd_verify::verdict::Verdict;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    Pass,
    Fail,
    Computation,
    Interrupted,
}

impl End {
    /// The exit code of the contract.
    pub fn code(self) -> u8 {
        match self {
            Self::Pass => 0,
            Self::Fail => 1,
            Self::Computation => 3,
            Self::Interrupted => 130,
        }
    }
}

/// A folder of results and the studies that go into it.
pub struct Group {
    pub folder: String,
    pub asked: Vec<Asked>,
    /// Data of another code that is judged.
    pub data: Option<StudyHash>,
}

/// A study of which the part at hand is run, and what is said of the whole.
pub struct Asked {
    pub study: Study,
    /// All cases, those of other parts too.
    pub order: Vec<String>,
    pub text: String,
}

impl Group {
    fn new(folder: &str, studies: Vec<Study>, options: &RunOptions) -> Self {
        let asked = studies.into_iter().map(|study| Asked::new(study, options.shard)).collect();
        Self { folder: folder.to_owned(), asked, data: None }
    }

    pub fn studies(&self) -> impl Iterator<Item = &Study> {
        self.asked.iter().map(|asked| &asked.study)
    }
}

impl Asked {
    fn new(mut study: Study, shard: Option<Shard>) -> Self {
        let order = study.cases.iter().map(|case| case.place.case.clone()).collect();
        let text = text_of(&study);
        if let Some(shard) = shard {
            study.cases.retain(|case| shard.takes(&case.place.study, &case.place.case));
        }
        Self { study, order, text }
    }
}

/// The shipped studies of a kind, all in one folder, or the files given, each in its own.
pub fn shipped_or_files(kind: Kind, files: &[PathBuf], options: &RunOptions) -> Result<End, Refusal> {
    let settings = settings(&options.set)?;
    if !files.is_empty() {
        return compute(&read_files(files, Some(kind), &settings, options)?, options);
    }
    let studies = shipped(Some(kind), &settings)?;
    compute(&[Group::new(kind.word(), studies, options)], options)
}

/// All shipped studies, those of a kind in a folder.
pub fn all(options: &RunOptions) -> Result<End, Refusal> {
    let mut studies = shipped(None, &settings(&options.set)?)?;
    let mut groups = Vec::new();
    for kind in Kind::ALL {
        let (of_kind, others): (Vec<Study>, Vec<Study>) =
            studies.into_iter().partition(|study| study.kind == kind);
        studies = others;
        if !of_kind.is_empty() {
            groups.push(Group::new(kind.word(), of_kind, options));
        }
    }
    compute(&groups, options)
}

/// Any study files, each with a folder of its own.
pub fn files(files: &[PathBuf], options: &RunOptions) -> Result<End, Refusal> {
    let settings = settings(&options.set)?;
    compute(&read_files(files, None, &settings, options)?, options)
}

/// A study whose answer was brought with a file, in a folder of its own.
pub fn brought(folder: &str, study: Study, data: StudyHash, options: &RunOptions) -> Result<End, Refusal> {
    let group = Group::new(folder, vec![study], options);
    compute(&[Group { data: Some(data), ..group }], options)
}

/// The `--set` options as settings.
pub fn settings(written: &[String]) -> Result<Vec<Setting>, Refusal> {
    written.iter().map(|text| Setting::parse(text)).collect()
}

/// Names that shipped commands write to.
const RESERVED: [&str; 13] = [
    "advice",
    "baselines",
    "check",
    "dispersion",
    "bar",
    "bench",
    "convergence",
    "dsif",
    "cost",
    "stability",
    "statics",
    "fracture",
    "hybrid",
];

fn read_files(
    files: &[PathBuf],
    kind: Option<Kind>,
    settings: &[Setting],
    options: &RunOptions,
) -> Result<Vec<Group>, Refusal> {
    let mut groups: Vec<Group> = Vec::new();
    let mut used = vec![false; settings.len()];
    for file in files {
        let cure = format!(
            "give the path of a study file, or run all the shipped studies of a kind with {}",
            commands()
        );
        let text = read_text(file, &cure)?;
        let (study, found) = Study::read(&file.display().to_string(), &text, settings)?;
        used.iter_mut().zip(found).for_each(|(used, found)| *used |= found);
        if kind.is_some_and(|kind| kind != study.kind) {
            let message = format!("{} is a study of another kind", file.display());
            return Err(study
                .document
                .refuse("kind", message)
                .help("use `pd-verify run`, which takes any kind"));
        }
        let taken = RESERVED.contains(&study.id.as_str());
        if taken || groups.iter().any(|group| group.folder == study.id) {
            let reason =
                if taken { "the folder of a shipped command" } else { "the id of another study of this run" };
            return Err(study
                .document
                .refuse("id", format!("id \"{}\" is {reason}", study.id))
                .help("choose another id"));
        }
        groups.push(Group::new(&study.id.clone(), vec![study], options));
    }
    refuse_unused(settings, &used)?;
    Ok(groups)
}

/// The text of a study file; a pipe is as good as a file.
pub fn read_text(file: &Path, cure: &str) -> Result<String, Refusal> {
    let name = file.display().to_string();
    let refuse = |error: io::Error| Refusal::new(format!("cannot read {name}: {error}")).help(cure);
    let mut bytes = Vec::new();
    let opened = fs::File::open(file).map_err(refuse)?;
    opened.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(refuse)?;
    if bytes.len() > MAX_BYTES {
        let message = format!("{name} is larger than a study can be, {MAX_BYTES} bytes");
        return Err(Refusal::new(message).help("split it into several studies"));
    }
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + before.iter().filter(|byte| **byte == b'\n').count();
        Refusal::new(format!("{name}:{line} is not UTF-8 text")).help("save the file as UTF-8")
    })
}

/// 0 when at least one claim passes and none fails.
pub fn verdict_of(verdicts: &[Verdict], strict: bool) -> End {
    let failing = verdicts.iter().any(|&verdict| fails(verdict, strict));
    if verdicts.contains(&Verdict::Pass) && !failing { End::Pass } else { End::Fail }
}

/// Whether a verdict makes the run fail.
pub fn fails(verdict: Verdict, strict: bool) -> bool {
    match verdict {
        Verdict::Fail | Verdict::Xpass | Verdict::Error => true,
        Verdict::Inconclusive => strict,
        Verdict::Pass | Verdict::Xfail | Verdict::Skipped => false,
    }
}

fn text_of(study: &Study) -> String {
    let mut equations: Vec<&str> = Vec::new();
    for line in study.cases.iter().flat_map(|case| case.question.equations().lines()) {
        if !equations.contains(&line) {
            equations.push(line);
        }
    }
    [study.about.as_str(), &equations.join("\n\n")]
        .iter()
        .filter(|text| !text.is_empty())
        .copied()
        .collect::<Vec<_>>()
        .join("\n\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_judged_is_not_a_pass() {
        use Verdict::{Error, Fail, Inconclusive, Pass, Skipped, Xfail, Xpass};
        for (verdicts, strict, end) in [
            (vec![], false, End::Fail),
            (vec![Skipped], false, End::Fail),
            (vec![Xfail], false, End::Fail),
            (vec![Pass], true, End::Pass),
            (vec![Pass, Xfail, Skipped, Inconclusive], false, End::Pass),
            (vec![Pass, Inconclusive], true, End::Fail),
            (vec![Pass, Fail], false, End::Fail),
            (vec![Pass, Xpass], false, End::Fail),
            (vec![Pass, Error], false, End::Fail),
        ] {
            assert_eq!(verdict_of(&verdicts, strict), end, "{verdicts:?}");
        }
    }
}
