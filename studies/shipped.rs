//! The studies that come with the program, built in so that it runs from any folder.

use crate::input::{Document, Refusal, Setting};
use crate::kind::Kind;
use crate::study::Study;

/// File names and texts, in the order in which they are listed and run.
pub const SHIPPED: &[(&str, &str)] = &[
    ("studies/dispersion/bar.toml", include_str!("dispersion/bar.toml")),
    ("studies/dispersion/plane.toml", include_str!("dispersion/plane.toml")),
    ("studies/dispersion/lattice.toml", include_str!("dispersion/lattice.toml")),
    ("studies/dispersion/joint.toml", include_str!("dispersion/joint.toml")),
    ("studies/dispersion/oracles.toml", include_str!("dispersion/oracles.toml")),
    ("studies/dispersion/misprints.toml", include_str!("dispersion/misprints.toml")),
    ("studies/bar/release.toml", include_str!("bar/release.toml")),
    ("studies/bar/pulse.toml", include_str!("bar/pulse.toml")),
    ("studies/bar/statics.toml", include_str!("bar/statics.toml")),
    ("studies/convergence/waves.toml", include_str!("convergence/waves.toml")),
    ("studies/convergence/pulses.toml", include_str!("convergence/pulses.toml")),
    ("studies/convergence/rest.toml", include_str!("convergence/rest.toml")),
    ("studies/convergence/rules.toml", include_str!("convergence/rules.toml")),
    ("studies/convergence/plates.toml", include_str!("convergence/plates.toml")),
    ("studies/dsif/tips.toml", include_str!("dsif/tips.toml")),
    ("studies/dsif/edges.toml", include_str!("dsif/edges.toml")),
    ("studies/dsif/faces.toml", include_str!("dsif/faces.toml")),
    ("studies/dsif/plates.toml", include_str!("dsif/plates.toml")),
    ("studies/dsif/hybrid.toml", include_str!("dsif/hybrid.toml")),
    ("studies/dsif/running.toml", include_str!("dsif/running.toml")),
    ("studies/stability/time_step.toml", include_str!("stability/time_step.toml")),
    ("studies/stability/long_run.toml", include_str!("stability/long_run.toml")),
    ("studies/stability/rotation.toml", include_str!("stability/rotation.toml")),
    ("studies/stability/scaling.toml", include_str!("stability/scaling.toml")),
    ("studies/cost/bar.toml", include_str!("cost/bar.toml")),
    ("studies/cost/plate.toml", include_str!("cost/plate.toml")),
    ("studies/cost/crack.toml", include_str!("cost/crack.toml")),
    ("studies/cost/ablation.toml", include_str!("cost/ablation.toml")),
];

/// All shipped studies of a kind (or all), with `--set` changes; a setting that no study has a place for is refused.
pub fn shipped(kind: Option<Kind>, settings: &[Setting]) -> Result<Vec<Study>, Refusal> {
    let mut studies = Vec::new();
    let mut used = vec![false; settings.len()];
    for (name, text) in SHIPPED {
        // Settings are for the kind that is asked for; a study of another kind may not even bear them.
        if kind.is_some_and(|kind| !is_of(kind, name, text)) {
            continue;
        }
        let (study, found) = Study::read(name, text, settings)?;
        used.iter_mut().zip(found).for_each(|(used, found)| *used |= found);
        if studies.iter().any(|other: &Study| other.id == study.id) {
            return Err(Refusal::new(format!("id \"{}\" is the id of another shipped study", study.id))
                .help("leave the ids of shipped studies alone"));
        }
        studies.push(study);
    }
    refuse_unused(settings, &used)?;
    Ok(studies)
}

/// The commands that run all shipped studies of a kind, in words.
pub fn commands() -> String {
    let with_studies = |kind: &Kind| SHIPPED.iter().any(|(name, text)| is_of(*kind, name, text));
    let all: Vec<String> = Kind::ALL
        .into_iter()
        .filter(with_studies)
        .map(|kind| format!("`pd-verify {}`", kind.word()))
        .collect();
    match all.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} or {last}", others.join(", ")),
        _ => all.concat(),
    }
}

/// Whether a study's text gives itself this kind.
fn is_of(kind: Kind, name: &str, text: &str) -> bool {
    let document = Document::parse(name, text);
    document.is_ok_and(|document| document.get("kind").is_some_and(|word| word == kind.word()))
}

/// Refuses the first setting that found no place.
pub fn refuse_unused(settings: &[Setting], used: &[bool]) -> Result<(), Refusal> {
    match settings.iter().zip(used).find(|(_, used)| !**used) {
        Some((setting, _)) => Err(Refusal::new(format!("--set {setting}: no study here has such a place"))
            .help("paths start at the top of a study file; cases are entered by id, as in case.my-case.k_horizon=2")),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shipped_studies_share_a_folder_without_overwriting_each_other() {
        let studies = shipped(None, &[]).unwrap();
        let mut ids: Vec<_> =
            studies.iter().flat_map(|study| study.cases.iter().map(|case| case.place.case.clone())).collect();
        let mut claims: Vec<_> = studies
            .iter()
            .flat_map(|study| study.cases.iter().flat_map(|case| case.claims()))
            .map(|claim| claim.id)
            .collect();
        for list in [&mut ids, &mut claims] {
            let count = list.len();
            list.sort();
            list.dedup();
            assert_eq!(list.len(), count);
        }
        assert!(ids.len() > 25 && claims.len() > 100);
    }

    #[test]
    fn the_quick_profile_stays_quick() {
        // 5 s for each command on two cores: some 10⁸ bonds of waves a second and 10⁴ answers of the reference, or
        // 4·10⁸ updates of nodes in a bar, half of the time being left to the exact answers.
        let effort = |kind| {
            let mut total = crate::question::Effort::default();
            for study in shipped(Some(kind), &[]).unwrap() {
                total += study.effort(crate::question::Profile::Quick);
            }
            total
        };
        let waves = effort(Kind::Dispersion);
        assert!(waves.bond_evaluations < 100_000_000 && waves.reference_evaluations < 40_000, "{waves:?}");
        let bars = effort(Kind::Bar);
        assert!(bars.node_updates > 0 && bars.node_updates < 1_200_000_000, "{bars:?}");
        // 15 s, some 4·10⁷ updates of nodes in a plate a second.
        let refined = effort(Kind::Convergence);
        assert!(refined.node_updates > 0 && refined.node_updates < 600_000_000, "{refined:?}");
        // The same 15 s for plates with a crack.
        let cracks = effort(Kind::Dsif);
        assert!(cracks.node_updates > 0 && cracks.node_updates < 600_000_000, "{cracks:?}");
        // 20 s; small bodies are mostly edge, whose nodes go bond by bond: some 4·10⁸ bonds a second.
        let marched = effort(Kind::Stability);
        assert!(marched.node_updates > 0 && marched.bond_evaluations < 8_000_000_000, "{marched:?}");
        // 40 s, each body marched up to ten times.
        let priced = effort(Kind::Cost);
        assert!(priced.node_updates > 0 && priced.node_updates < 600_000_000, "{priced:?}");
    }

    #[test]
    fn every_case_says_what_it_costs() {
        for case in shipped(None, &[]).unwrap().iter().flat_map(|study| &study.cases) {
            assert_ne!(case.question.effort(), crate::question::Effort::default(), "{}", case.place.case);
        }
    }

    #[test]
    fn each_study_is_of_one_kind() {
        let of_kinds: usize = Kind::ALL.iter().map(|&kind| shipped(Some(kind), &[]).unwrap().len()).sum();
        assert_eq!(of_kinds, SHIPPED.len());
    }

    #[test]
    fn every_claim_gives_its_reason_and_its_reference() {
        let studies = shipped(None, &[]).unwrap();
        for claim in studies.iter().flat_map(|study| &study.cases).flat_map(|case| case.claims()) {
            assert!(claim.because.len() > 15 && claim.source.len() > 10, "{}", claim.id);
            assert!(!claim.tolerance.is_nan(), "{}", claim.id);
        }
    }
}
