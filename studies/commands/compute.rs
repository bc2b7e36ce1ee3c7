//! Runs groups of studies: each group into a folder of its own as soon as it is done, then what speaks of the whole run.

use super::judge::{Asked, End, Group, fails, verdict_of};
use super::{say, threads};
use crate::bench::short;
use crate::cli::RunOptions;
use crate::input::Refusal;
use crate::kind::Kind;
use crate::manifest::{Manifest, StudyHash};
use crate::output::Output;
use crate::progress::{Progress, interrupted};
use crate::question::Effort;
use crate::results::page::{self, Kept};
use crate::results::resume::{Resume, Take};
use crate::results::write::Writer;
use crate::results::{FORMAT, File, Run, StudyResults, inputs};
use crate::run::run_case;
use crate::study::{Case, Study};
use crate::subject::{PdVerify, Subject, Timed};
use crate::{afford, machine};
use pd_verify::plan::time::Costs;
use pd_verify::report::{counts_line, terminal_table};
use pd_verify::verdict::{Judged, Verdict};
use std::collections::HashMap;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

/// Hashes of inputs by study and case.
type Inputs = HashMap<String, HashMap<String, String>>;

/// Everything a run needs.
struct Work<'a> {
    groups: &'a [Group],
    options: &'a RunOptions,
    output: &'a Output,
    resume: &'a Resume,
    inputs: &'a Inputs,
    subject: &'a dyn Subject,
    progress: &'a Progress,
}

/// What has happened so far.
#[derive(Default)]
struct Done {
    failed: bool,
    unfinished: bool,
    taken: usize,
    ran: usize,
    kept: Vec<Kept>,
    folders: Vec<File>,
    problems: Vec<String>,
}

/// Refuses what cannot be run, runs the rest, judges and writes.
pub fn compute(groups: &[Group], options: &RunOptions) -> Result<End, Refusal> {
    if let Some(isa) = options.isa.filter(|isa| !isa.is_here()) {
        return Err(Refusal::new(format!("this processor does not have --isa {}", isa.word()))
            .help("leave --isa out to use the best that is here"));
    }
    if let Some(isa) = options.isa {
        isa.pin();
    }
    let studies = groups.iter().flat_map(Group::studies);
    afford::check(studies, options.profile, machine::threads(options.threads), machine::room())?;
    let folders: Vec<String> = groups.iter().map(|group| group.folder.clone()).collect();
    let take = match (options.rerun_failed, options.resume) {
        (true, _) => Take::Sound,
        (false, true) => Take::Finished,
        (false, false) => Take::Nothing,
    };
    let resume = Resume::open(&options.out, &folders, take)?;
    let output = Output::open(&options.out, &folders)?;
    let pool = threads::pool(options.threads)?;
    let code = inputs::code(&manifest(&[], options));
    let hashed = |group: &Group| -> Inputs {
        // What another code brought is an input too.
        let brought = group.data.as_ref().map_or("", |data| &data.sha256);
        let code = format!("{code}{brought}");
        group.studies().map(|study| (study.id.clone(), inputs::of_cases(study, &code))).collect()
    };
    let inputs: Inputs = groups.iter().flat_map(hashed).collect();
    let costs = costs(groups, options, &resume, &inputs)?;
    let timed = costs.map(Timed);
    let subject: &dyn Subject = timed.as_ref().map_or(&PdVerify, |timed| timed);
    let cases = groups.iter().flat_map(Group::studies).flat_map(|study| &study.cases);
    let length = cases.filter(|case| case.profile <= options.profile).map(weight).sum();
    let progress = Progress::of(length, !options.quiet && !options.no_progress);
    let (output, resume, inputs, progress) = (&output, &resume, &inputs, &progress);
    let work = Work { groups, options, output, resume, inputs, subject, progress };
    Ok(pool.install(|| work.run()))
}

/// About how many seconds a case takes on two cores.
fn weight(case: &Case) -> f64 {
    let Effort { evaluations, bond_evaluations, reference_evaluations, node_updates, .. } =
        case.question.effort();
    1e-3 + 1e-9 * bond_evaluations as f64
        + 3e-9 * node_updates as f64
        + 1e-7 * evaluations as f64
        + 1e-4 * reference_evaluations as f64
}

/// What nodes cost on this machine, where a study that is run asks what accuracy costs.
fn costs(
    groups: &[Group],
    options: &RunOptions,
    resume: &Resume,
    inputs: &Inputs,
) -> Result<Option<Costs>, Refusal> {
    let runs = |group: &Group, study: &Study| {
        let mut cases = study.cases.iter().filter(|case| case.profile <= options.profile);
        cases
            .any(|case| resume.case(&group.folder, &study.id, &case.place.case, hash(inputs, case)).is_none())
    };
    let asked = |group: &Group| group.studies().any(|study| study.kind == Kind::Cost && runs(group, study));
    if groups.iter().any(asked) {
        short::costs(options, &threads::pools(options.threads)?).map(Some)
    } else {
        Ok(None)
    }
}

fn hash<'a>(inputs: &'a Inputs, case: &Case) -> &'a str {
    inputs.get(&case.place.study).and_then(|of| of.get(&case.place.case)).map_or("", String::as_str)
}

impl Work<'_> {
    fn run(&self) -> End {
        let mut done = Done::default();
        let asked: Vec<&Study> = self.groups.iter().flat_map(Group::studies).collect();
        let mut run = Run {
            format: FORMAT,
            program: "pd-verify".into(),
            manifest: {
                let mut manifest = manifest(&asked, self.options);
                manifest.studies.extend(self.groups.iter().filter_map(|group| group.data.clone()));
                manifest
            },
            shard: self.options.shard,
            complete: false,
            order: self.groups.iter().map(|group| group.folder.clone()).collect(),
            folders: Vec::new(),
        };
        for group in self.groups {
            self.group(group, &mut done);
            run.folders.clone_from(&done.folders);
            // Should the program be killed, this is the run so far.
            if let (false, Err(error)) =
                (run.folders.is_empty(), self.output.replace_file(crate::results::RUN, &run.json()))
            {
                done.problems.push(format!("cannot write {}: {error}", crate::results::RUN));
            }
        }
        self.progress.finish();
        let written = done.kept.iter().all(|kept| kept.place.is_some());
        run.complete = !done.unfinished && written;
        self.end(&run, done)
    }

    /// Runs a group into its folder.
    fn group(&self, group: &Group, done: &mut Done) {
        let studies: Vec<&Study> = group.studies().collect();
        let mut manifest = manifest(&studies, self.options);
        manifest.studies.extend(group.data.clone());
        let mut writer = Writer::new(self.output, &group.folder, manifest, self.options.shard);
        for asked in &group.asked {
            writer.study(head(asked));
            let before = done.ran + done.taken;
            for case in &asked.study.cases {
                self.case(group, case, &mut writer, done);
            }
            let words = format!("{}: {}", asked.study.id, counts_line(writer.judged_last()));
            if done.ran + done.taken > before {
                self.progress.note(&words);
            }
        }
        if writer.len() == 0 {
            return;
        }
        let (folder, placed) = writer.finish();
        let name = group.folder.clone();
        done.problems.extend(folder.problems.iter().cloned());
        let place = match placed {
            Ok((place, sha256)) => {
                done.folders.push(File { name, sha256 });
                self.progress.note(&format!(
                    "wrote {} files to {}",
                    3 + folder.files().count(),
                    place.display()
                ));
                Some(place)
            }
            Err(error) => {
                done.problems.push(format!("cannot write the results of {name}: {error}"));
                None
            }
        };
        done.kept.push(Kept { folder, place });
    }

    /// Takes a case over or runs it; after an interruption nothing more is run.
    fn case(&self, group: &Group, case: &Case, writer: &mut Writer, done: &mut Done) {
        let (study, id, inputs) = (&case.place.study, &case.place.case, hash(self.inputs, case));
        let included = case.profile <= self.options.profile;
        let weight = if included { weight(case) } else { 0.0 };
        self.progress.at(&format!("{study}/{id}"));
        if let Some((source, found)) = self.resume.case(&group.folder, study, id, inputs).filter(|_| included)
        {
            match writer.take_over(source, study, found) {
                Ok(()) => {
                    done.taken += 1;
                    done.failed |= found.judged.iter().any(|one| one.evidence.failed.is_some());
                    return self.progress.advance(weight);
                }
                Err(error) => {
                    let _ =
                        writeln!(io::stderr(), "{study}/{id} is run again, its files have changed: {error}");
                }
            }
        }
        if interrupted() {
            done.unfinished = true;
            return;
        }
        let ran = run_case(case, self.options.profile, self.subject);
        done.ran += 1;
        done.failed |= ran.failed;
        writer.case(id, inputs.to_owned(), ran);
        self.progress.advance(weight);
    }

    /// Writes what speaks of the run, prints, and says how it ended.
    fn end(&self, run: &Run, done: Done) -> End {
        let Done { failed, unfinished, taken, ran, kept, mut problems, .. } = done;
        let (judged, wrong) = match kept.is_empty() && run.shard.is_none() {
            true => (Vec::new(), Vec::new()),
            false => page::write(run, kept, self.output),
        };
        problems.extend(wrong);
        if let Err(error) = Shown::from(self.options).print_table(&judged) {
            problems.push(format!("cannot print: {error}"));
        }
        let tell = |line: &str| {
            let _ = writeln!(io::stderr(), "{line}");
        };
        if self.resume.is_wanted() && !self.options.quiet {
            let place = self.options.out.display();
            self.resume.lacks().iter().for_each(|why| tell(why));
            tell(&format!("took over {taken} of {} cases from {place}, ran {ran}", taken + ran));
        }
        problems.iter().for_each(|problem| tell(&format!("error: {problem}")));
        if unfinished {
            tell(&format!("interrupted: {} claims were judged, the rest was not run", judged.len()));
            return End::Interrupted;
        }
        ending(&judged, self.options.strict, run.shard.is_some(), failed || !problems.is_empty())
    }
}

/// How a run ends that was not interrupted. A part of a run may be without a pass, or empty.
pub fn ending(judged: &[Judged], strict: bool, part: bool, failed: bool) -> End {
    let verdicts: Vec<Verdict> = judged.iter().map(|judged| judged.verdict).collect();
    let passes = verdicts.contains(&Verdict::Pass);
    if !passes && !part {
        let _ = writeln!(io::stderr(), "no claim passed, which is no success");
    }
    if failed {
        return End::Computation;
    }
    if part && !passes && !verdicts.iter().any(|&verdict| fails(verdict, strict)) {
        return End::Pass;
    }
    verdict_of(&verdicts, strict)
}

fn head(asked: &Asked) -> StudyResults {
    let study = &asked.study;
    StudyResults {
        id: study.id.clone(),
        kind: study.kind.word().to_owned(),
        title: study.title.clone(),
        text: asked.text.clone(),
        source: study.source.clone(),
        order: asked.order.clone(),
        cases: Vec::new(),
    }
}

fn manifest(studies: &[&Study], options: &RunOptions) -> Manifest {
    let hash = |study: &&Study| StudyHash::new(&study.id, study.document.name(), study.document.text());
    let settings = studies.iter().flat_map(|study| study.document.settings.clone());
    let mut unique: Vec<String> = Vec::new();
    settings.for_each(|setting| {
        if !unique.contains(&setting) {
            unique.push(setting)
        }
    });
    let isa = options.isa.map(|isa| isa.word().to_owned());
    Manifest::of_this_run(options.profile.to_string(), unique, isa, studies.iter().map(hash).collect())
}

/// What is shown of a run on the terminal, and where it stands.
pub struct Shown<'a> {
    pub out: &'a Path,
    pub strict: bool,
    /// Only what fails.
    pub quiet: bool,
}

impl<'a> From<&'a RunOptions> for Shown<'a> {
    fn from(options: &'a RunOptions) -> Self {
        Self { out: &options.out, strict: options.strict, quiet: options.quiet }
    }
}

impl Shown<'_> {
    /// The table of verdicts.
    pub fn print_table(&self, judged: &[Judged]) -> io::Result<()> {
        let failing = |one: &&Judged| fails(one.verdict, self.strict);
        let shown: Vec<Judged> =
            if self.quiet { judged.iter().filter(failing).cloned().collect() } else { judged.to_vec() };
        if shown.is_empty() {
            return Ok(());
        }
        let terminal = io::stdout().is_terminal();
        let colour = terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
        let width = if terminal { terminal_width() } else { 120 };
        let page = self.out.join("index.html");
        let place = if self.quiet { String::new() } else { format!("see {}\n", page.display()) };
        say(&(terminal_table(&shown, width, colour) + &place))
    }
}

/// The width of the terminal, as its shell tells it.
fn terminal_width() -> usize {
    std::env::var("COLUMNS").ok().and_then(|text| text.parse().ok()).unwrap_or(100)
}
