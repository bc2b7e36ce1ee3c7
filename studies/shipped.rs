//! The studies that come with the program, built in so that it runs from any folder.

use crate::input::{Refusal, Setting};
use crate::study::{Kind, Study};

/// File names and texts, in the order in which they are listed and run.
pub const SHIPPED: [(&str, &str); 6] = [
    ("studies/dispersion/bar.toml", include_str!("dispersion/bar.toml")),
    ("studies/dispersion/plane.toml", include_str!("dispersion/plane.toml")),
    ("studies/dispersion/lattice.toml", include_str!("dispersion/lattice.toml")),
    ("studies/dispersion/joint.toml", include_str!("dispersion/joint.toml")),
    ("studies/dispersion/oracles.toml", include_str!("dispersion/oracles.toml")),
    ("studies/dispersion/misprints.toml", include_str!("dispersion/misprints.toml")),
];

/// All shipped studies of a kind (or all), with `--set` changes; a setting that no study has a place for is refused.
pub fn shipped(kind: Option<Kind>, settings: &[Setting]) -> Result<Vec<Study>, Refusal> {
    let mut studies = Vec::new();
    let mut used = vec![false; settings.len()];
    for (name, text) in SHIPPED {
        let (study, found) = Study::read(name, text, settings)?;
        if kind.is_none_or(|kind| kind == study.kind) {
            used.iter_mut().zip(found).for_each(|(used, found)| *used |= found);
            studies.push(study);
        }
    }
    refuse_unused(settings, &used)?;
    Ok(studies)
}

/// Refuses the first setting that found no place.
pub fn refuse_unused(settings: &[Setting], used: &[bool]) -> Result<(), Refusal> {
    match settings.iter().zip(used).find(|(_, used)| !**used) {
        Some((setting, _)) => Err(Refusal::new(format!("--set {setting}: no study here has such a place"))
            .help("paths start at the top of a study file; cases are entered by id, as in case.my-case.k_horizon=2")),
        None => Ok(()),
    }
}
