//! What is written of scenes that diverged: all that was seen, when it was sound last, and the time step that would hold.

use super::march::Marched;
use super::snapshots::{self, SnapshotAsked};
use crate::attachment::Attachment;
use crate::input::OneOrMany;
use crate::question::Place;
use crate::rounded::rounded;
use pd_verify::record::{Diverged, Failure, Record};
use pd_verify::report::plot::Figure;
use pd_verify::table::{Cell, Table};

const COLUMNS: [&str; 10] = [
    "case",
    "scene",
    "given_up_step",
    "given_up_t_s",
    "sound_step",
    "sound_t_s",
    "time_step_s",
    "over_lattice_limit",
    "over_own_limit",
    "time_step_that_holds_s",
];

/// What was seen of a scene, to its end or until it was given up.
pub fn seen(run: &Result<Record, Failure>) -> Option<&Record> {
    match run {
        Ok(record) => Some(record),
        Err(Failure::Diverged(diverged)) => Some(&diverged.record),
        Err(Failure::Wrong(_)) => None,
    }
}

fn diverged(run: &Result<Record, Failure>) -> Option<&Diverged> {
    match run {
        Err(Failure::Diverged(diverged)) => Some(diverged),
        _ => None,
    }
}

/// `diverged.csv`, a row for each scene that did; no file where none did.
pub fn table(runs: &[Result<Record, Failure>], place: &Place) -> Option<Table> {
    let mut table = Table::new("diverged.csv", &COLUMNS);
    for diverged in runs.iter().filter_map(diverged) {
        let plan = &diverged.record.plan;
        let row: Vec<Cell> = vec![
            place.case.clone().into(),
            plan.name.clone().into(),
            diverged.step.into(),
            diverged.time.into(),
            diverged.sound_step.into(),
            diverged.sound_time().into(),
            plan.time_step_s.into(),
            plan.time_step_over_limit.into(),
            diverged.over_own_limit().into(),
            diverged.holds().into(),
        ];
        table.push(row);
    }
    (!table.rows.is_empty()).then_some(table)
}

/// Says in the captions of a case from when on they show no motion of the body.
pub fn flag(figures: &mut [Figure], runs: &[Result<Record, Failure>]) {
    for diverged in runs.iter().filter_map(diverged) {
        let until = match diverged.sound_time() {
            Some(time) => format!("what comes after t = {} s is its growth", rounded(time)),
            None => "all that is shown is its growth".into(),
        };
        let said = format!(" \"{}\" diverged: {until}.", diverged.record.plan.name);
        figures.iter_mut().for_each(|figure| figure.caption += &said);
    }
}

/// Files of a scene's snapshots; of one that diverged the body at the last sound look is among them.
pub fn files(
    written: &[SnapshotAsked],
    scene: &Marched,
    run: Result<Record, Failure>,
    alone: bool,
    place: &Place,
) -> Vec<Attachment> {
    let (record, sound) = match run {
        Ok(record) => (record, None),
        Err(Failure::Diverged(diverged)) => (diverged.record, diverged.sound),
        Err(Failure::Wrong(_)) => return Vec::new(),
    };
    let mut files = snapshots::files(written, scene, record.snapshots, alone, place);
    if let Some(sound) = sound {
        let formats = written.first().and_then(|asked| asked.formats.clone());
        let asked = SnapshotAsked {
            name: sound.name.clone(),
            at_s: OneOrMany(vec![sound.time]),
            formats: formats.filter(|formats| !formats.is_empty()),
            picture: Some(false),
        };
        files.extend(snapshots::files(&[asked], scene, vec![sound], alone, place));
    }
    files
}
