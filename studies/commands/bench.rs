//! `pd-verify bench`: the whole suite of speeds, or one case, beside the machine's own limits.

use super::judge::End;
use super::{folder, say, threads};
use crate::attachment::Attachment;
use crate::bench::beside::beside;
use crate::bench::cases::{Case, Group, M, SIDE, suite};
use crate::bench::forecast::forecasts;
use crate::bench::growth::growths;
use crate::bench::kept::{FOLDER, Suite, one};
use crate::bench::limits::Limits;
use crate::bench::measure::{Failure, Measured, Pace, measure};
use crate::bench::rates::Rates;
use crate::bench::{bodies, costs, figures, memory, text};
use crate::cli::{BenchOptions, BondOperator, Isa};
use crate::input::Refusal;
use crate::output::Output;
use crate::progress::{Progress, interrupted};
use crate::{afford, machine};
use pd_verify::scene::{Operator, Scene};
use serde_json::Value;
use std::io::{self, Write};

/// Rounds of the suite and seconds of a case in each.
const SUITE: Pace = Pace { rounds: 6, seconds: 0.05, steps: None };
/// What is held against predictions.
const CHECK: Pace = Pace { rounds: 5, seconds: 0.05, steps: None };
/// A case alone.
const ALONE: Pace = Pace { rounds: 15, seconds: 0.1, steps: None };

/// The families of larger plates are not run.
const LARGEST_M: f64 = 200.0;

/// Runs the suite, or the one case that the options name.
pub fn bench(options: &BenchOptions) -> Result<u8, Refusal> {
    let isa = instruction_set(options.isa)?;
    isa.pin();
    let alone = options.nodes.is_some()
        || options.m.is_some()
        || options.steps.is_some()
        || options.operator.is_some();
    if alone {
        let case = case(options)?;
        return one_case(case, isa, options);
    }
    let output = Output::open(&options.out, &[FOLDER.to_owned()])?;
    whole_suite(isa, options, &output)
}

/// The one that is asked for, or the best that is here.
fn instruction_set(asked: Option<Isa>) -> Result<Isa, Refusal> {
    match asked {
        Some(isa) if !isa.is_here() => {
            Err(Refusal::new(format!("this processor does not have --isa {}", isa.word()))
                .help("leave --isa out to use the best that is here"))
        }
        Some(isa) => Ok(isa),
        None => Ok(Isa::best()),
    }
}

/// The plate that is asked for, refused before anything large is made.
fn case(options: &BenchOptions) -> Result<Case, Refusal> {
    let (side, m) = (options.nodes.unwrap_or(SIDE as u32) as usize, options.m.unwrap_or(M));
    if m > LARGEST_M {
        return Err(Refusal::new(format!("m = {m} is more than the {LARGEST_M} that are run"))
            .help(format!("take --m {LARGEST_M} or less")));
    }
    if m > side as f64 {
        return Err(Refusal::new(format!(
            "the horizon of {m} spacings is larger than the plate of {side}² nodes"
        ))
        .help("take more --nodes, or a smaller --m"));
    }
    let operator = match options.operator {
        Some(BondOperator::Bonds) => Operator::Bonds,
        _ => Operator::Stencil,
    };
    let case = Case::new(format!("{side}² nodes"), Scene { operator, ..bodies::plate([side; 2], m) });
    let plan = case.body.plan().map_err(|wrong| Refusal::new(wrong.message).help(wrong.help))?;
    let (needed, room) = (afford::needed(&plan), machine::room());
    if needed > room.bytes {
        let message = format!(
            "a plate of {side}² nodes with m = {m} takes {:.1} GB to make and march, and {:.1} GB are {}",
            needed / 1e9,
            room.bytes / 1e9,
            room.of
        );
        return Err(Refusal::new(message).help("take fewer --nodes, a smaller --m, or --operator stencil"));
    }
    Ok(case)
}

fn one_case(case: Case, isa: Isa, options: &BenchOptions) -> Result<u8, Refusal> {
    let pools = threads::pools(options.threads)?;
    let limits = pools.all.install(|| Limits::measure(isa));
    // Steps that are given are run once.
    let pace = match options.steps {
        Some(steps) => Pace { rounds: 1, steps: Some(steps), ..ALONE },
        None => ALONE,
    };
    let group = Group { name: "one case", cases: vec![case] };
    let measured = match measure(&group, &pools, pace, &interrupted) {
        Ok(measured) => measured,
        Err(failure) => return ended(failure),
    };
    let limits = limits.or_better(&pools.all.install(|| Limits::measure(isa)));
    let rates = Rates::of(group.name, isa, &measured[0], &measured[0], &limits);
    let text = match options.json {
        true => pretty(&one(&rates, &limits)),
        false => text::limits(&limits, isa.word()) + &text::one(&rates),
    };
    Ok(printed(&text, Vec::new()))
}

fn whole_suite(isa: Isa, options: &BenchOptions, output: &Output) -> Result<u8, Refusal> {
    let pools = threads::pools(options.threads)?;
    let threads = pools.all.current_num_threads();
    let groups = suite(threads);
    let progress = Progress::new(groups.len() + 2, !options.no_progress);
    progress.at("limits");
    let of_all = || pools.all.install(|| Limits::measure(isa));
    let (mut limits, limits_alone) = (of_all(), pools.one.install(|| Limits::measure(isa)));
    progress.step();
    let mut groups_measured = Vec::new();
    for group in &groups {
        progress.at(group.name);
        let (group, left_out) = memory::fitting(group);
        left_out.iter().for_each(|note| progress.note(note));
        let measured = match measure(&group, &pools, SUITE, &interrupted) {
            Ok(measured) => measured,
            Err(failure) => return ended(failure),
        };
        groups_measured.push((group.name, measured));
        limits = limits.or_better(&of_all());
        progress.step();
    }
    let limit = |one: &Measured| if one.case.alone { &limits_alone } else { &limits };
    let rates = |(group, measured): &(&'static str, Vec<Measured>)| -> Vec<Rates> {
        measured.iter().map(|one| Rates::of(group, isa, one, &measured[0], limit(one))).collect()
    };
    let cases: Vec<Rates> = groups_measured.iter().flat_map(rates).collect();
    progress.at("predictions");
    let costs = beside(costs::costs(&cases, threads), &pools)
        .map_err(|wrong| Refusal::new(wrong.message).help(wrong.help))?;
    let forecasts = match forecasts(&costs, &pools, CHECK, &interrupted) {
        Ok(forecasts) => forecasts,
        Err(failure) => return ended(failure),
    };
    progress.finish();
    let suite = Suite { limits, cases, costs, forecasts };
    let data = pretty(&suite.json());
    let problems = written(&suite, &data, options, output);
    let text = if options.json { data } else { as_text(&suite, &limits_alone, isa) };
    Ok(printed(&text, problems))
}

fn as_text(suite: &Suite, alone: &Limits, isa: Isa) -> String {
    let mut text = text::limits(&suite.limits, isa.word());
    if suite.limits.threads > 1 {
        text += &text::limits(alone, isa.word());
    }
    text += &text::cases(&suite.cases);
    text += &text::growths(&growths(&suite.cases));
    text + &text::forecasts(&suite.forecasts)
}

fn pretty(value: &Value) -> String {
    serde_json::to_string_pretty(value).expect("plain data") + "\n"
}

/// Writes the folder; returns what went wrong.
fn written(suite: &Suite, data: &str, options: &BenchOptions, output: &Output) -> Vec<String> {
    let table = suite.table();
    let files = vec![Attachment::text("bench.json", data), Attachment::text(table.file.clone(), table.csv())];
    folder::write(output, FOLDER, options.isa, files, &figures::figures(&suite.cases))
}

fn printed(text: &str, mut problems: Vec<String>) -> u8 {
    if let Err(error) = say(text) {
        problems.push(format!("cannot print: {error}"));
    }
    for problem in &problems {
        let _ = writeln!(io::stderr(), "error: {problem}");
    }
    if problems.is_empty() { 0 } else { End::Computation.code() }
}

fn ended(failure: Failure) -> Result<u8, Refusal> {
    let (end, message) = match failure {
        Failure::Wrong(wrong) => return Err(Refusal::new(wrong.message).help(wrong.help)),
        Failure::Diverged(case) => (End::Computation, format!("error: \"{case}\" grew without bound")),
        Failure::Interrupted => (End::Interrupted, "interrupted: nothing is written".to_owned()),
    };
    let _ = writeln!(io::stderr(), "{message}");
    Ok(end.code())
}
