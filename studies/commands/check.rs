//! `pd-verify check CASE --data FILE`: judges what another code produced, by the case's reference and bounds.

use super::find::find;
use super::judge::{self, End};
use crate::cli::CheckOptions;
use crate::foreign::{Asked, Brought, Data, Foreign, Source, found, read};
use crate::input::{Refusal, nearest};
use crate::manifest::StudyHash;
use crate::question::Profile;
use crate::study::Study;

/// Reads, refuses, judges and writes.
pub fn check(options: &CheckOptions) -> Result<End, Refusal> {
    let asked = Asked { map: pairs("--map", &options.map)?, unit: pairs("--unit", &options.unit)? };
    let mut study = case(&options.case, &options.run.set)?;
    let (source, bytes) = Source::open(&options.data, options.delimiter)?;
    let file = options.data.display().to_string();
    let mut case = study.cases.remove(0);
    let (form, data) = {
        let forms = case.question.foreign();
        let form = chosen(&forms, options.form.as_deref(), &file, &source, &asked)?;
        (form, read(&file, &source, &forms[form].wanted(), forms[form].keys(), &asked)?)
    };
    case.question = Box::new(Brought::new(case.question, form, data));
    // What is brought is judged whatever the case itself would cost.
    case.profile = Profile::Quick;
    study.cases = vec![case];
    let hash = StudyHash::of_bytes("data", &file, &bytes);
    judge::brought("check", study, hash, &options.run)
}

/// The study of one case that other codes can be held against.
pub fn case(name: &str, set: &[String]) -> Result<Study, Refusal> {
    let mut study = find(name, &judge::settings(set)?)?;
    let can = |study: &Study| -> Vec<String> {
        let able = study.cases.iter().filter(|case| !case.question.foreign().is_empty());
        able.map(|case| format!("{}/{}", study.id, case.place.case)).collect()
    };
    if study.cases.len() > 1 {
        let able = can(&study);
        let help = if able.is_empty() {
            "none of its cases can; see `pd-verify explain CASE`".into()
        } else {
            format!("name one of {}", able.join(", "))
        };
        return Err(Refusal::new(format!(
            "{name} has {} cases, and one is held against data",
            study.cases.len()
        ))
        .help(help));
    }
    if can(&study).is_empty() {
        let place = &study.cases[0].place;
        let whole = find(&place.study, &[]).map(|study| can(&study)).unwrap_or_default();
        let help = if whole.is_empty() {
            "cases about dispersion curves, bars let go, refinements, plates at rest and stress intensity can: `pd-verify explain CASE` says so".into()
        } else {
            format!("in the same study these can: {}", whole.join(", "))
        };
        study.cases.clear();
        return Err(Refusal::new(format!("{name} judges no data of other codes")).help(help));
    }
    Ok(study)
}

/// Pairs ours=theirs as typed.
fn pairs(option: &str, typed: &[String]) -> Result<Vec<(String, String)>, Refusal> {
    let pair = |text: &String| match text.split_once('=') {
        Some((ours, theirs)) if !ours.trim().is_empty() && !theirs.trim().is_empty() => {
            Ok((ours.trim().to_owned(), theirs.trim().to_owned()))
        }
        _ => {
            let example = if option == "--map" { "--map t=time" } else { "--unit k=MPa*sqrt(mm)" };
            Err(Refusal::new(format!("{option} {text} is not of the form column=value"))
                .help(format!("write {example}")))
        }
    };
    typed.iter().map(pair).collect()
}

/// Which kind of result the file holds: as asked, or the only one whose columns it has.
fn chosen(
    forms: &[Box<dyn Foreign + '_>],
    asked_form: Option<&str>,
    file: &str,
    source: &Source,
    asked: &Asked,
) -> Result<usize, Refusal> {
    let names: Vec<String> = forms.iter().map(|form| form.name()).collect();
    if let Some(word) = asked_form {
        return names.iter().position(|name| name == word).ok_or_else(|| {
            let near = nearest(word, names.iter().map(String::as_str));
            let near = near.map_or(String::new(), |near| format!("did you mean \"{near}\"? "));
            Refusal::new(format!("--as \"{word}\": this case judges no such data"))
                .help(format!("{near}it judges {}", listed(&names)))
        });
    }
    let each: Vec<(usize, usize)> = forms
        .iter()
        .map(|form| form.wanted())
        .map(|wanted| (found(source, &wanted, asked), wanted.len()))
        .collect();
    let whole: Vec<usize> = (0..forms.len()).filter(|&at| each[at].0 == each[at].1).collect();
    match whole[..] {
        [one] => Ok(one),
        [] => {
            let alone = |at: usize| found(source, &forms[at].wanted(), &Asked::default());
            let best =
                (0..forms.len()).max_by_key(|&at| (each[at].0, alone(at), forms.len() - at)).unwrap_or(0);
            if forms.len() == 1 || each[best].0 > 0 || !asked.map.is_empty() || !asked.unit.is_empty() {
                // Reading says what is missing.
                let form = &forms[best];
                read(file, source, &form.wanted(), form.keys(), asked).map(|_: Data| best)
            } else {
                let columns = |form: &dyn Foreign| {
                    form.wanted().iter().map(|one| one.name).collect::<Vec<_>>().join(", ")
                };
                let all: Vec<String> =
                    forms.iter().map(|form| format!("{} ({})", form.name(), columns(&**form))).collect();
                Err(Refusal::new(format!("{file} has the columns of none of the data that this case judges"))
                    .help(format!("it judges {}; name columns with --map ours=theirs", listed(&all))))
            }
        }
        _ => {
            let able: Vec<String> = whole.iter().map(|&at| names[at].clone()).collect();
            Err(Refusal::new(format!(
                "{file} may be any of {} kinds of data that this case judges",
                able.len()
            ))
            .help(format!("say which with --as: {}", listed(&able))))
        }
    }
}

/// At most so many names.
fn listed(names: &[String]) -> String {
    let shown: Vec<String> = names.iter().take(24).map(|name| format!("\"{name}\"")).collect();
    let more = names.len() - shown.len();
    let more = if more > 0 { format!(" and {more} more (see `pd-verify explain`)") } else { String::new() };
    shown.join(", ") + &more
}
