//! `pd-verify plan STUDY`: what would be done, and what it would cost; runs nothing and writes nothing.

use super::judge::{read_text, settings};
use crate::input::{Refusal, nearest};
use crate::question::Profile;
use crate::shipped::{SHIPPED, refuse_unused};
use crate::study::Study;
use serde_json::json;
use std::path::Path;

/// The plan as text.
pub fn plan(study: &str, as_json: bool, profile: Profile, set: &[String]) -> Result<String, Refusal> {
    let study = find(study, set)?;
    let rows: Vec<_> =
        study.cases.iter().map(|case| (case, case.profile <= profile, case.question.effort())).collect();
    let total = study.effort(profile);
    if as_json {
        let cases: Vec<_> = rows
            .iter()
            .map(|(case, runs, effort)| {
                json!({ "case": case.place.case, "asks": case.asks, "runs": runs, "claims": case.claims().len(), "effort": effort })
            })
            .collect();
        let plan =
            json!({ "study": study.id, "profile": profile.to_string(), "cases": cases, "total": total });
        return Ok(serde_json::to_string_pretty(&plan).expect("plain data") + "\n");
    }
    let mut text = format!(
        "{}: {}\nprofile {profile}; nothing is marched in time: waves are evaluated, effects are off\n\n",
        study.id, study.title
    );
    text += &format!(
        "{:<28} {:<18} {:>7} {:>9} {:>12} {:>15} {:>10}\n",
        "case", "asks", "claims", "curves", "frequencies", "bond visits", "reference"
    );
    for (case, runs, effort) in &rows {
        let skipped = if *runs { String::new() } else { format!("  skipped: from profile {}", case.profile) };
        text += &format!(
            "{:<28} {:<18} {:>7} {:>9} {:>12} {:>15} {:>10}{skipped}\n",
            case.place.case,
            case.asks,
            case.claims().len(),
            effort.curves,
            effort.evaluations,
            effort.bond_evaluations,
            effort.reference_evaluations
        );
    }
    text += &format!(
        "{:<28} {:<18} {:>7} {:>9} {:>12} {:>15} {:>10}\n",
        "total", "", "", total.curves, total.evaluations, total.bond_evaluations, total.reference_evaluations
    );
    Ok(text)
}

/// A shipped study by id, or a file.
fn find(name: &str, set: &[String]) -> Result<Study, Refusal> {
    let settings = settings(set)?;
    let id = |text| Study::read(name, text, &[]).map_or(String::new(), |(study, _)| study.id);
    let shipped = SHIPPED.iter().find(|(_, text)| id(text) == name);
    let (study, used) = match shipped {
        Some((file, text)) => Study::read(file, text, &settings)?,
        None => {
            let ids: Vec<String> = SHIPPED.iter().map(|(_, text)| id(text)).collect();
            let near = nearest(name, ids.iter().map(String::as_str));
            let near = near.map_or(String::new(), |near| format!("did you mean {near}? "));
            let cure = format!("{near}give the path of a study file, or an id from `pd-verify list`");
            Study::read(name, &read_text(Path::new(name), &cure)?, &settings)?
        }
    };
    refuse_unused(&settings, &used)?;
    Ok(study)
}
