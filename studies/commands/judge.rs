//! Commands that compute: read, refuse, run, judge, write, and end with the code that tells how it went.

use super::{say, threads};
use crate::attachment::Attachment;
use crate::bench::short;
use crate::cli::RunOptions;
use crate::input::{MAX_BYTES, Refusal, Setting};
use crate::kind::Kind;
use crate::manifest::{Manifest, StudyHash};
use crate::output::Output;
use crate::progress::Progress;
use crate::run::{Ran, merge, run};
use crate::shipped::{commands, refuse_unused, shipped};
use crate::study::Study;
use crate::subject::{PdVerify, Subject, Timed};
use crate::{afford, machine};
use pd_verify::plan::time::Costs;
use pd_verify::report::{
    Drawn, RunSummary, StudyReport, figure_table, index_html, junit_xml, summary_markdown, terminal_table,
    verdicts_csv,
};
use pd_verify::verdict::{Judged, Verdict};
use std::fs;
use std::io::{self, IsTerminal, Read, Write};
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
struct Group {
    folder: String,
    studies: Vec<Study>,
    /// Data of another code that is judged.
    data: Option<StudyHash>,
}

/// The shipped studies of a kind, all in one folder, or the files given, each in its own.
pub fn shipped_or_files(kind: Kind, files: &[PathBuf], options: &RunOptions) -> Result<End, Refusal> {
    let settings = settings(&options.set)?;
    if !files.is_empty() {
        return compute(read_files(files, Some(kind), &settings)?, options);
    }
    let studies = shipped(Some(kind), &settings)?;
    compute(vec![Group { folder: kind.word().to_owned(), studies, data: None }], options)
}

/// Any study files, each with a folder of its own.
pub fn files(files: &[PathBuf], options: &RunOptions) -> Result<End, Refusal> {
    let settings = settings(&options.set)?;
    compute(read_files(files, None, &settings)?, options)
}

/// A study whose answer was brought with a file, in a folder of its own.
pub fn brought(folder: &str, study: Study, data: StudyHash, options: &RunOptions) -> Result<End, Refusal> {
    compute(vec![Group { folder: folder.to_owned(), studies: vec![study], data: Some(data) }], options)
}

/// The `--set` options as settings.
pub fn settings(written: &[String]) -> Result<Vec<Setting>, Refusal> {
    written.iter().map(|text| Setting::parse(text)).collect()
}

/// Names that shipped commands write to.
const RESERVED: [&str; 12] = [
    "advice",
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

fn read_files(files: &[PathBuf], kind: Option<Kind>, settings: &[Setting]) -> Result<Vec<Group>, Refusal> {
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
        groups.push(Group { folder: study.id.clone(), studies: vec![study], data: None });
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

fn compute(groups: Vec<Group>, options: &RunOptions) -> Result<End, Refusal> {
    if let Some(isa) = options.isa.filter(|isa| !isa.is_here()) {
        return Err(Refusal::new(format!("this processor does not have --isa {}", isa.word()))
            .help("leave --isa out to use the best that is here"));
    }
    if let Some(isa) = options.isa {
        isa.pin();
    }
    let studies = groups.iter().flat_map(|group| &group.studies);
    afford::check(studies, options.profile, machine::threads(options.threads), machine::room())?;
    let folders: Vec<String> = groups.iter().map(|group| group.folder.clone()).collect();
    let output = Output::open(&options.out, &folders)?;
    let pool = threads::pool(options.threads)?;
    let costs = costs(&groups, options)?;
    pool.install(|| Ok(compute_and_write(&groups, options, costs, &output)))
}

/// What nodes cost on this machine, where a study asks what accuracy costs.
fn costs(groups: &[Group], options: &RunOptions) -> Result<Option<Costs>, Refusal> {
    let asked = groups.iter().flat_map(|group| &group.studies).any(|study| study.kind == Kind::Cost);
    if asked { short::costs(options, &threads::pools(options.threads)?).map(Some) } else { Ok(None) }
}

fn compute_and_write(groups: &[Group], options: &RunOptions, costs: Option<Costs>, output: &Output) -> End {
    let timed = costs.map(Timed);
    let subject: &dyn Subject = timed.as_ref().map_or(&PdVerify, |timed| timed);
    let cases = groups.iter().flat_map(|group| &group.studies).map(|study| study.cases.len()).sum();
    let progress = Progress::new(cases, !options.quiet && !options.no_progress);
    let mut reports = Vec::new();
    let mut manifests = Vec::new();
    let mut problems = Vec::new();
    let (mut failed, mut unfinished) = (false, false);
    for group in groups {
        let ran: Vec<Ran> =
            group.studies.iter().map(|study| run(study, options.profile, subject, &progress)).collect();
        failed |= ran.iter().any(|ran| ran.failed);
        unfinished |= ran.iter().zip(&group.studies).any(|(ran, study)| ran.finished < study.cases.len());
        if ran.iter().all(|ran| ran.finished == 0) {
            continue;
        }
        let mut manifest = manifest(&group.studies, options);
        manifest.studies.extend(group.data.clone());
        let (files, studies) = folder_of(&group.studies, ran, &manifest, &mut problems);
        match output.replace_folder(&group.folder, &files) {
            Ok(place) => progress.note(&format!("wrote {} files to {}", files.len(), place.display())),
            Err(error) => problems.push(format!("cannot write the results of {}: {error}", group.folder)),
        }
        reports.extend(studies);
        manifests.push(manifest);
    }
    progress.finish();
    let verdicts: Vec<Verdict> =
        reports.iter().flat_map(|report: &StudyReport| &report.judged).map(|judged| judged.verdict).collect();
    problems.extend(finish(reports, &manifests, options, output, unfinished));
    for problem in &problems {
        let _ = writeln!(io::stderr(), "error: {problem}");
    }
    if unfinished {
        let total = verdicts.len();
        let _ = writeln!(io::stderr(), "interrupted: {total} claims were judged, the rest was not run");
        return End::Interrupted;
    }
    if !verdicts.contains(&Verdict::Pass) {
        let _ = writeln!(io::stderr(), "no claim passed, which is no success");
    }
    if failed || !problems.is_empty() { End::Computation } else { verdict_of(&verdicts, options.strict) }
}

/// 0 when at least one claim passes and none fails.
pub fn verdict_of(verdicts: &[Verdict], strict: bool) -> End {
    let failing = verdicts.iter().any(|&verdict| fails(verdict, strict));
    if verdicts.contains(&Verdict::Pass) && !failing { End::Pass } else { End::Fail }
}

/// Whether a verdict makes the run fail.
fn fails(verdict: Verdict, strict: bool) -> bool {
    match verdict {
        Verdict::Fail | Verdict::Xpass | Verdict::Error => true,
        Verdict::Inconclusive => strict,
        Verdict::Pass | Verdict::Xfail | Verdict::Skipped => false,
    }
}

fn manifest(studies: &[Study], options: &RunOptions) -> Manifest {
    let hash = |study: &Study| StudyHash::new(&study.id, study.document.name(), study.document.text());
    let settings: Vec<String> = studies.iter().flat_map(|study| study.document.settings.clone()).collect();
    let mut unique: Vec<String> = Vec::new();
    settings.into_iter().for_each(|setting| {
        if !unique.contains(&setting) {
            unique.push(setting)
        }
    });
    let isa = options.isa.map(|isa| isa.word().to_owned());
    Manifest::of_this_run(options.profile.to_string(), unique, isa, studies.iter().map(hash).collect())
}

/// The files of a folder of results, and what the page says of its studies.
fn folder_of(
    studies: &[Study],
    ran: Vec<Ran>,
    manifest: &Manifest,
    problems: &mut Vec<String>,
) -> (Vec<Attachment>, Vec<StudyReport>) {
    let mut tables = Vec::new();
    let mut files = vec![Attachment::text("manifest.json", manifest.json())];
    let mut reports = Vec::new();
    for (study, ran) in studies.iter().zip(ran) {
        ran.tables.into_iter().for_each(|table| merge(&mut tables, table));
        files.extend(ran.files);
        let mut figures = Vec::new();
        for figure in &ran.figures {
            match Drawn::new(figure) {
                Ok(drawn) => {
                    files.push(Attachment::text(format!("{}.svg", drawn.id), drawn.svg.clone()));
                    figures.push(drawn);
                }
                Err(error) => problems.push(format!("figure {}: {error}", figure.id)),
            }
            let data = figure_table(figure);
            files.push(Attachment::text(data.file.clone(), data.csv()));
        }
        reports.push(StudyReport {
            id: study.id.clone(),
            title: study.title.clone(),
            text: text_of(study),
            source: study.source.clone(),
            figures,
            judged: ran.judged,
        });
    }
    files.extend(tables.iter().map(|table| Attachment::text(table.file.clone(), table.csv())));
    for (index, Attachment { name, .. }) in files.iter().enumerate() {
        if files[..index].iter().any(|other| other.name == *name) {
            problems.push(format!("two results would be called {name}"));
        }
    }
    let judged: Vec<Judged> = reports.iter().flat_map(|report| report.judged.clone()).collect();
    files.push(Attachment::text("verdicts.csv", verdicts_csv(&judged)));
    (files, reports)
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

/// Writes what speaks of the whole run and prints the table. Returns what went wrong.
fn finish(
    reports: Vec<StudyReport>,
    manifests: &[Manifest],
    options: &RunOptions,
    output: &Output,
    unfinished: bool,
) -> Vec<String> {
    let Some(manifest) = manifests.first() else { return Vec::new() };
    let mut pairs = manifest.pairs();
    for other in &manifests[1..] {
        pairs.extend(other.pairs().into_iter().filter(|(name, _)| name.starts_with("study ")));
    }
    let title = format!("Verification of peridynamics{}", if unfinished { ", interrupted" } else { "" });
    let summary = RunSummary { title, command: manifest.command(), manifest: pairs, studies: reports };
    let judged: Vec<Judged> = summary.judged().cloned().collect();
    let markdown = summary_markdown(&summary);
    let files = [
        ("verdicts.csv", verdicts_csv(&judged)),
        ("summary.md", markdown.clone()),
        ("junit.xml", junit_xml(&summary)),
        ("index.html", index_html(&summary)),
    ];
    let mut problems = Vec::new();
    for (name, text) in files {
        if let Err(error) = output.replace_file(name, &text) {
            problems.push(format!("cannot write {name}: {error}"));
        }
    }
    if let Err(error) = append_step_summary(&markdown) {
        problems.push(format!("cannot append to GITHUB_STEP_SUMMARY: {error}"));
    }
    if let Err(error) = print_table(&judged, options) {
        problems.push(format!("cannot print: {error}"));
    }
    problems
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

fn print_table(judged: &[Judged], options: &RunOptions) -> io::Result<()> {
    let failing = |one: &&Judged| fails(one.verdict, options.strict);
    let shown: Vec<Judged> =
        if options.quiet { judged.iter().filter(failing).cloned().collect() } else { judged.to_vec() };
    if shown.is_empty() {
        return Ok(());
    }
    let terminal = io::stdout().is_terminal();
    let colour = terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    let width = if terminal { terminal_width() } else { 120 };
    let place = if options.quiet {
        String::new()
    } else {
        format!("see {}\n", options.out.join("index.html").display())
    };
    say(&(terminal_table(&shown, width, colour) + &place))
}

/// The width of the terminal, as its shell tells it.
fn terminal_width() -> usize {
    std::env::var("COLUMNS").ok().and_then(|text| text.parse().ok()).unwrap_or(100)
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
