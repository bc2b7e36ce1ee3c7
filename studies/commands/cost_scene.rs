//! `pd-verify cost --error X SCENE` and `--budget S SCENE`: what accuracy costs in a scene of one's own.

use super::judge::End;
use super::{find, folder, say, threads};
use crate::attachment::Attachment;
use crate::bench::kept;
use crate::cli::CostOptions;
use crate::cost::own::levels::{Level, Own};
use crate::cost::own::search::{Goal, Machine, Stopped, search};
use crate::cost::own::{figure, report};
use crate::input::Refusal;
use crate::machine;
use crate::output::Output;
use crate::progress::interrupted;
use crate::subject::PdVerify;
use pd_verify::record::{Failure, Record};
use std::io::{self, Write};
use std::path::Path;
use std::time::Instant;

/// Searches, marches, prints and writes.
pub fn cost_scene(options: &CostOptions, scene: &Path) -> Result<u8, Refusal> {
    let goal = goal(options)?;
    let own = Own::new(find::file(&scene.display().to_string())?, options.case.as_deref())?;
    if let Some(isa) = options.run.isa {
        if !isa.is_here() {
            return Err(Refusal::new(format!("this processor does not have --isa {}", isa.word()))
                .help("leave --isa out to use the best that is here"));
        }
        isa.pin();
    }
    let kept = kept::read(&options.run.out)?;
    let folder = format!("{}-cost", own.id());
    let output = Output::open(&options.run.out, std::slice::from_ref(&folder))?;
    let machine = Machine {
        march: &timed,
        costs: kept.as_ref().map(|kept| &kept.costs),
        memory: machine::room().bytes,
        stop: &interrupted,
    };
    let pool = threads::pool(options.run.threads)?;
    let found = match pool.install(|| search(&own, goal, &machine)) {
        Ok(found) => found,
        Err(stopped) => return Ok(stop(stopped)),
    };
    let data = serde_json::to_string_pretty(&report::json(&own, &found)).expect("plain data") + "\n";
    let table = report::table(&found);
    let files =
        vec![Attachment::text("cost.json", data.clone()), Attachment::text(table.file.clone(), table.csv())];
    let figures: Vec<_> = figure::figure(&found, &own.name()).into_iter().collect();
    let mut problems = folder::write(&output, &folder, options.run.isa, files, &figures);
    let shown = if options.json { data } else { report::text(&own, &found) };
    if let Err(error) = say(&shown) {
        problems.push(format!("cannot print: {error}"));
    }
    for problem in &problems {
        let _ = writeln!(io::stderr(), "error: {problem}");
    }
    Ok(match (problems.is_empty(), found.met()) {
        (false, _) => End::Computation.code(),
        (true, false) => End::Fail.code(),
        (true, true) => End::Pass.code(),
    })
}

/// What was seen of a level, and the seconds from its plan to its end.
fn timed(level: &Level) -> Result<(Record, f64), Failure> {
    let start = Instant::now();
    let record = level.scene.march(&PdVerify)?;
    Ok((record, start.elapsed().as_secs_f64()))
}

fn stop(stopped: Stopped) -> u8 {
    let (why, end) = match stopped {
        Stopped::Interrupted => ("interrupted: nothing was written".to_owned(), End::Interrupted),
        Stopped::Failed(failure) => (format!("error: {failure}"), End::Computation),
        Stopped::Unusable(why) => (format!("error: no level can be marched: {why}"), End::Computation),
    };
    let _ = writeln!(io::stderr(), "{why}");
    end.code()
}

fn goal(options: &CostOptions) -> Result<Goal, Refusal> {
    let positive = |name: &str, value: f64, example: &str| {
        if value > 0.0 && value.is_finite() {
            return Ok(value);
        }
        Err(Refusal::new(format!("--{name} {value} is not a positive number"))
            .help(format!("as in --{name} {example}")))
    };
    match (options.error, options.budget) {
        (Some(error), _) if error >= 1.0 => {
            Err(Refusal::new(format!("--error {error} lets results be wrong by as much as they are"))
                .help("give a part of their largest size, as in --error 0.01 for one per cent"))
        }
        (Some(error), _) => Ok(Goal::Error(positive("error", error, "0.01")?)),
        (None, Some(seconds)) => Ok(Goal::Budget(positive("budget", seconds, "60")?)),
        (None, None) => Err(Refusal::new("what is the scene to cost, or how accurate is it to be?")
            .help("give --error X or --budget SECONDS")),
    }
}
