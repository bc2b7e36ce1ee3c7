//! `pd-verify explain ID`: what a study, case or claim says, against what, and why its bounds are what they are.

use crate::bibliography;
use crate::input::{Refusal, nearest};
use crate::shipped::shipped;
use crate::study::{Case, Study};
use pd_verify::claim::{Claim, Expectation, Relation};
use std::fmt::Write;

/// The explanation as text.
pub fn explain(id: &str, bibtex: bool) -> Result<String, Refusal> {
    let studies = shipped(None, &[])?;
    let Some(text) = studies.iter().find_map(|study| explain_in(study, id)) else {
        return Err(unknown(&studies, id));
    };
    Ok(if bibtex { bibliography::cited_in(&text) } else { text })
}

fn explain_in(study: &Study, id: &str) -> Option<String> {
    let mut text = String::new();
    if study.id == id {
        head(&mut text, study);
        study.cases.iter().for_each(|case| about_case(&mut text, case, &case.claims()));
        return Some(text);
    }
    for case in &study.cases {
        let name = format!("{}/{}", study.id, case.place.case);
        let claims = case.claims();
        if name == id {
            head(&mut text, study);
            about_case(&mut text, case, &claims);
            return Some(text);
        }
        if let Some(claim) = claims.iter().find(|claim| claim.id == id) {
            head(&mut text, study);
            about_case(&mut text, case, std::slice::from_ref(claim));
            return Some(text);
        }
    }
    None
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
    let _ = writeln!(
        text,
        "{}: {}\n\n{}\n\nSource: {}\n",
        study.id,
        study.title,
        study.about.trim(),
        study.source
    );
}

fn about_case(text: &mut String, case: &Case, claims: &[Claim]) {
    let _ = writeln!(text, "{}/{}: {}", case.place.study, case.place.case, case.title);
    let _ = writeln!(text, "  runs from profile {}; asks \"{}\"\n\n  Equations", case.profile, case.asks);
    for line in case.question.equations().lines() {
        let _ = writeln!(text, "    {line}");
    }
    let _ = writeln!(text, "\n  Claims");
    for claim in claims {
        about_claim(text, claim);
    }
    text.push('\n');
}

fn about_claim(text: &mut String, claim: &Claim) {
    let bound = match claim.relation {
        Relation::AtMost => {
            format!("error ({}) at most {:e}", claim.error_kind.word().replace('_', " "), claim.tolerance)
        }
        Relation::AtLeast => format!("at least {}", claim.tolerance),
        Relation::Within => match claim.expected_order {
            Some(order) => format!("order {order} within {}", claim.tolerance),
            None => format!("within {:e} of the reference", claim.tolerance),
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
