//! `pd-verify list`: the shipped studies.

use crate::input::Refusal;
use crate::question::Profile;
use crate::shipped::{commands, shipped};
use crate::study::Study;
use serde_json::json;

/// The list as text.
pub fn list(as_json: bool) -> Result<String, Refusal> {
    let studies = shipped(None, &[])?;
    if as_json {
        let all: Vec<_> = studies.iter().map(entry).collect();
        return Ok(serde_json::to_string_pretty(&all).expect("plain data") + "\n");
    }
    let mut text = String::new();
    for study in &studies {
        let claims: usize = study.cases.iter().map(|case| case.claims().len()).sum();
        text += &format!("{}\n  {}\n", study.id, study.title);
        let claim = study.about.split("\n\n").next().unwrap_or_default();
        text += &format!("{}\n", textwrap::indent(&textwrap::fill(claim, 96), "    "));
        text += &format!("  kind: {}\n  source: {}\n", study.kind.word(), study.source);
        text += &format!("  {} cases, {claims} claims, {}\n", study.cases.len(), cost(study));
        for case in &study.cases {
            text += &format!("    {:<34} {}\n", format!("{}/{}", study.id, case.place.case), case.title);
        }
        text += "\n";
    }
    text += &format!(
        "Run all of a kind with {}; `pd-verify explain ID` says what an entry claims and why.\n",
        commands()
    );
    Ok(text)
}

fn cost(study: &Study) -> String {
    let effort = study.effort(Profile::Standard);
    let marched = match effort.node_updates {
        0 => String::new(),
        updates => format!(", {:.0e} node updates", updates as f64),
    };
    format!(
        "about {:.0e} bond evaluations{marched}, {} by the reference",
        effort.bond_evaluations as f64, effort.reference_evaluations
    )
}

fn entry(study: &Study) -> serde_json::Value {
    let cases: Vec<_> = study
        .cases
        .iter()
        .map(|case| {
            let claims: Vec<String> = case.claims().into_iter().map(|claim| claim.id).collect();
            json!({ "id": format!("{}/{}", study.id, case.place.case), "title": case.title, "asks": case.asks, "claims": claims })
        })
        .collect();
    json!({
        "id": study.id,
        "kind": study.kind.word(),
        "title": study.title,
        "claims": study.about,
        "source": study.source,
        "cost": study.effort(Profile::Standard),
        "cases": cases,
    })
}
