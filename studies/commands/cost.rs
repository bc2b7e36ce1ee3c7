//! `pd-verify cost`: the studies of what accuracy costs, with `--advise` the cheapest settings for an error, or a scene of one's own.

use super::cost_scene::cost_scene;
use super::judge::{self, End};
use super::{folder, say, threads};
use crate::attachment::Attachment;
use crate::cli::CostOptions;
use crate::cost::advice::{Asked, Bound, MS, advise};
use crate::cost::{figure, text};
use crate::input::Refusal;
use crate::kind::Kind;
use crate::output::Output;
use std::io::{self, Write};

/// The folder below `--out`.
const FOLDER: &str = "advice";

/// Dilatational speed of steel in plane stress in m/s.
const STEEL: f64 = 5354.0;

/// Runs studies, or searches.
pub fn cost(options: &CostOptions) -> Result<u8, Refusal> {
    if options.advise {
        return advice(options);
    }
    if options.error.is_some() || options.budget.is_some() {
        return match options.files.as_slice() {
            [scene] => cost_scene(options, scene),
            files => {
                Err(Refusal::new(format!("{} study files are given with --error or --budget", files.len()))
                    .help(
                        "name one scene of your own, or ask for settings: --advise --error E --wavelength L",
                    ))
            }
        };
    }
    if options.json || options.case.is_some() {
        return Err(Refusal::new("--json and --case belong to a question")
            .help("add --advise with --error and --wavelength, or --error X or --budget SECONDS with a scene of your own"));
    }
    judge::shipped_or_files(Kind::Cost, &options.files, &options.run).map(End::code)
}

/// Searches, prints and writes.
fn advice(options: &CostOptions) -> Result<u8, Refusal> {
    let asked = asked(options)?;
    let output = Output::open(&options.run.out, &[FOLDER.to_owned()])?;
    let pool = threads::pool(options.run.threads)?;
    let advice = pool.install(|| advise(asked));
    let data = serde_json::to_string_pretty(&text::json(&advice)).expect("plain data") + "\n";
    let table = text::table(&advice);
    let files = vec![
        Attachment::text("advice.json", data.clone()),
        Attachment::text(table.file.clone(), table.csv()),
    ];
    let mut problems = folder::write(&output, FOLDER, None, files, &[figure::figure(&advice)]);
    let shown = if options.json { data } else { text::text(&advice) };
    if let Err(error) = say(&shown) {
        problems.push(format!("cannot print: {error}"));
    }
    for problem in &problems {
        let _ = writeln!(io::stderr(), "error: {problem}");
    }
    Ok(match (problems.is_empty(), advice.settings.is_empty()) {
        (false, _) => End::Computation.code(),
        (true, true) => End::Fail.code(),
        (true, false) => 0,
    })
}

fn asked(options: &CostOptions) -> Result<Asked, Refusal> {
    let CostOptions { error, wavelength, speed, min_m, horizon, .. } = *options;
    let speed = speed.unwrap_or(STEEL);
    let positive = |name: &str, value: f64, example: &str| {
        if value > 0.0 && value.is_finite() {
            return Ok(value);
        }
        Err(Refusal::new(format!("--{name} {value} is not a positive number"))
            .help(format!("as in --{name} {example}")))
    };
    // The parser asks for both beside --advise.
    let error = positive("error", error.unwrap_or(f64::NAN), "0.01")?;
    if error >= 1.0 {
        return Err(Refusal::new(format!("--error {error} lets waves be wrong by as much as they are"))
            .help("give a part of the phase speed, as in --error 0.01 for one per cent"));
    }
    let most = MS[MS.len() - 1];
    let bound = match (min_m, horizon) {
        (Some(least), _) if !(0.0..=most).contains(&least) => {
            return Err(Refusal::new(format!("--min-m {least} is outside what is searched"))
                .help(format!("m is searched from {} to {most}", MS[0])));
        }
        (Some(least), _) => Bound::LeastM(least),
        (None, Some(horizon)) => Bound::Horizon(positive("horizon", horizon, "0.004")?),
        (None, None) => Bound::Free,
    };
    Ok(Asked {
        error,
        wavelength: positive("wavelength", wavelength.unwrap_or(f64::NAN), "0.02")?,
        speed: positive("speed", speed, "5354")?,
        bound,
    })
}
