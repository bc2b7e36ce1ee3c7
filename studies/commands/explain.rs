//! `pd-verify explain ID`: what a study, case or claim says, against what, and why its bounds are what they are.

use super::find::{file, shipped_text, text_of};
use crate::bibliography;
use crate::foreign::Foreign;
use crate::input::{Refusal, nearest};
use crate::rounded::rounded;
use crate::shipped::shipped;
use crate::study::{Case, Study};
use pd_verify::claim::{Claim, Expectation, Relation};
use std::fmt::Write;
use std::path::Path;

/// What an id names in a study: all of it, a case, or a claim of a case.
enum Named {
    Study,
    Case(usize),
    Claim(usize, Box<Claim>),
}

/// The explanation as text: in words, as the publications it rests on, or as the study file.
pub fn explain(id: &str, bibtex: bool, toml: bool) -> Result<String, Refusal> {
    // Planning all studies takes seconds: only the one whose name the id begins with is read.
    let own = match shipped_text(id.split('/').next().unwrap_or_default()) {
        Some((file, text)) => Some(Study::read(file, text, &[])?.0),
        None => None,
    };
    let (study, what) = match own.and_then(|study| named(&study, id).map(|what| (study, what))) {
        Some(found) => found,
        None if id.ends_with(".toml") || Path::new(id).is_file() => (file(id)?, Named::Study),
        None => return Err(unknown(&shipped(None, &[])?, id)),
    };
    if toml {
        return Ok(match what {
            Named::Study => text_of(&study, None),
            Named::Case(index) | Named::Claim(index, _) => text_of(&study, Some(index)),
        });
    }
    let text = in_words(&study, what);
    Ok(if bibtex { bibliography::cited_in(&text) } else { text })
}

fn named(study: &Study, id: &str) -> Option<Named> {
    if study.id == id {
        return Some(Named::Study);
    }
    study.cases.iter().enumerate().find_map(|(index, case)| {
        if format!("{}/{}", study.id, case.place.case) == id {
            return Some(Named::Case(index));
        }
        let claim = case.claims().into_iter().find(|claim| claim.id == id)?;
        Some(Named::Claim(index, Box::new(claim)))
    })
}

fn in_words(study: &Study, what: Named) -> String {
    let mut text = String::new();
    head(&mut text, study);
    match what {
        Named::Study => study.cases.iter().for_each(|case| about_case(&mut text, case, &case.claims())),
        Named::Case(index) => about_case(&mut text, &study.cases[index], &study.cases[index].claims()),
        Named::Claim(index, claim) => about_case(&mut text, &study.cases[index], &[*claim]),
    }
    text
}

fn unknown(studies: &[Study], id: &str) -> Refusal {
    let mut ids: Vec<String> = Vec::new();
    for study in studies {
        ids.push(study.id.clone());
        for case in &study.cases {
            ids.push(format!("{}/{}", study.id, case.place.case));
            ids.extend(case.claims().into_iter().map(|claim| claim.id));
        }
    }
    let inside = format!("/{id}");
    let end = ids.iter().map(String::as_str).find(|known| known.ends_with(&inside));
    let help = match end.or_else(|| nearest(id, ids.iter().map(String::as_str))) {
        Some(near) => format!("did you mean {near}? `pd-verify list` shows all"),
        None => "`pd-verify list` shows all studies and cases".into(),
    };
    Refusal::new(format!("nothing is called {id}")).help(help)
}

fn head(text: &mut String, study: &Study) {
    let _ = writeln!(text, "{}: {}\n", study.id, study.title);
    if !study.about.trim().is_empty() {
        let _ = writeln!(text, "{}\n", study.about.trim());
    }
    if !study.source.is_empty() {
        let _ = writeln!(text, "Source: {}\n", study.source);
    }
}

fn about_case(text: &mut String, case: &Case, claims: &[Claim]) {
    let _ = writeln!(text, "{}/{}: {}", case.place.study, case.place.case, case.title);
    let _ = writeln!(text, "  runs from profile {}; asks \"{}\"\n\n  Equations", case.profile, case.asks);
    for line in case.question.equations().lines() {
        let _ = writeln!(text, "    {line}");
    }
    let forms = case.question.foreign();
    if !forms.is_empty() {
        let id = format!("{}/{}", case.place.study, case.place.case);
        let _ = writeln!(
            text,
            "\n  Results of other codes\n    pd-verify explain {id} --export DIR    the problem for any solver\n    pd-verify check {id} --data FILE       judges {}",
            listed(&forms)
        );
    }
    let _ = writeln!(text, "\n  Claims");
    for claim in claims {
        about_claim(text, claim);
    }
    text.push('\n');
}

/// Kinds of data, at most a few.
fn listed(forms: &[Box<dyn Foreign + '_>]) -> String {
    let mut names: Vec<String> = forms.iter().take(4).map(|form| form.name()).collect();
    if forms.len() > names.len() {
        names.push(format!("{} more", forms.len() - names.len()));
    }
    names.join("; ")
}

fn about_claim(text: &mut String, claim: &Claim) {
    let tolerance = rounded(claim.tolerance);
    let bound = match claim.relation {
        Relation::AtMost => {
            format!("error ({}) at most {tolerance}", claim.error_kind.word().replace('_', " "))
        }
        Relation::AtLeast => format!("at least {tolerance}"),
        Relation::Within => match claim.expected_order {
            Some(order) => format!("order {order} within {tolerance}"),
            None => format!("within {tolerance} of the reference"),
        },
        Relation::Equal => "equal to the reference".into(),
    };
    let _ = writeln!(text, "    {}", claim.id);
    let _ = writeln!(text, "      {}", claim.quantity);
    let _ = writeln!(text, "      bound: {bound}");
    let _ = writeln!(text, "      basis: {}: {}", claim.basis.word(), claim.because);
    let _ = writeln!(text, "      reference: {}", claim.source);
    if let Expectation::Broken(why) = &claim.expectation {
        let _ = writeln!(text, "      expected to fail: {why}");
    }
}
