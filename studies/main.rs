//! `pd-verify`: runs studies of peridynamics, judges them, and ends with a code that a CI can gate on.
//!
//! A study file is read and checked whole before anything is computed; its cases ask their questions of the library
//! and of the reference, evidence is held against claims, and tables, figures and verdicts go to `reports/`.

mod afford;
mod allocator;
mod attachment;
mod bar;
mod bench;
mod bibliography;
mod cli;
mod commands;
mod convergence;
mod cost;
mod dispersion;
mod dsif;
mod foreign;
mod input;
mod kind;
mod levels;
mod machine;
mod manifest;
mod median;
mod output;
mod progress;
mod question;
mod results;
mod rounded;
mod run;
mod scene;
mod schema;
mod shard;
mod shipped;
mod stability;
mod study;
mod subject;
mod written;

#[cfg(test)]
#[path = "../tests/hostile/mod.rs"]
mod hostile;
#[cfg(test)]
#[path = "../tests/sabotage/mod.rs"]
mod sabotage;

use clap::{CommandFactory, Parser};
use cli::{BaselineCommand, Cli, Command, SchemaOf};
use commands::{explain, judge, list, plan, say};
use input::Refusal;
use kind::Kind;
use std::io::Write;
use std::process::ExitCode;

fn main() -> ExitCode {
    progress::listen();
    match command(Cli::parse()) {
        Ok(code) => ExitCode::from(code),
        Err(refusal) => {
            let _ = writeln!(std::io::stderr(), "{:?}", miette::Report::new(refusal));
            ExitCode::from(2)
        }
    }
}

fn command(cli: Cli) -> Result<u8, Refusal> {
    match cli.command {
        Command::Dispersion { files, options } => {
            judge::shipped_or_files(Kind::Dispersion, &files, &options).map(judge::End::code)
        }
        Command::Bar { files, options } => {
            judge::shipped_or_files(Kind::Bar, &files, &options).map(judge::End::code)
        }
        Command::Convergence { files, options } => {
            judge::shipped_or_files(Kind::Convergence, &files, &options).map(judge::End::code)
        }
        Command::Dsif { files, options } => {
            judge::shipped_or_files(Kind::Dsif, &files, &options).map(judge::End::code)
        }
        Command::Stability { files, options } => {
            judge::shipped_or_files(Kind::Stability, &files, &options).map(judge::End::code)
        }
        Command::Report { from: Some(folder), options } => {
            commands::report::from(&folder, &options).map(judge::End::code)
        }
        Command::Report { from: None, options } => judge::all(&options).map(judge::End::code),
        Command::Run { files, options } => judge::files(&files, &options).map(judge::End::code),
        Command::List { json } => print(&list::list(json)?),
        Command::Explain { id, export: Some(folder), .. } => print(&commands::export::export(&id, &folder)?),
        Command::Explain { id, bibtex, toml, .. } => print(&explain::explain(&id, bibtex, toml)?),
        Command::Check(options) => commands::check::check(&options).map(judge::End::code),
        Command::Selftest => {
            let (text, right) = commands::selftest::selftest()?;
            print(&text).map(|code| if right { code } else { code.max(1) })
        }
        Command::Plan { study, json, profile, set, out } => {
            print(&plan::plan(&study, json, profile, &set, &out)?)
        }
        Command::Bench(options) => commands::bench::bench(&options),
        Command::Cost(options) => commands::cost::cost(&options),
        Command::Merge(options) => commands::merge::merge(&options).map(judge::End::code),
        Command::Baseline { command: BaselineCommand::Save { name, from, seconds } } => {
            commands::baseline::save(&name, &from, seconds)
        }
        Command::Compare { name, from, slower } => commands::baseline::compare(&name, &from, slower),
        Command::Schema { of } => print(&format!("{:#}\n", schema_of(of))),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "pd-verify", &mut script);
            print(&String::from_utf8_lossy(&script))
        }
    }
}

fn schema_of(of: SchemaOf) -> serde_json::Value {
    match of {
        SchemaOf::Study => schema::schema(),
        SchemaOf::Results => results::results_schema(),
        SchemaOf::Run => results::run_schema(),
    }
}

fn print(text: &str) -> Result<u8, Refusal> {
    match say(text) {
        Ok(()) => Ok(0),
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "error: cannot print: {error}");
            Ok(judge::End::Computation.code())
        }
    }
}
