//! Rows of `stability_divergence.csv`, and norms above the limit beside energies that grow soundly.

use super::divergence::{Divergence, Seen};
use super::growing::log_norm;
use crate::bar::names::{LATTICE, lattice_cells};
use crate::question::Place;
use pd_verify::report::plot::{Axis, Figure, Guide, Lines, Series};
use pd_verify::table::{Cell, Table};

/// Marches that the figure shows.
const DRAWN: usize = 2;

/// A row for every march above the limit.
pub fn table(asked: &Divergence, all: &[Seen], place: &Place) -> Table {
    let own = [
        "over_own_limit",
        "sound_step",
        "given_up_step",
        "latest_step",
        "own_limit_s",
        "reported_own_limit_s",
        "time_step_that_holds_s",
        "norm_excess_there",
    ];
    let mut table = Table::new("stability_divergence.csv", &[&["case"][..], &LATTICE, &own].concat());
    for (body, seen) in asked.bodies.iter().zip(all) {
        for beyond in &seen.beyond {
            let diverged = beyond.diverged.as_ref();
            let mut row: Vec<Cell> = vec![place.case.as_str().into()];
            row.extend(lattice_cells(Some(body.lattice())));
            row.extend::<[Cell; 8]>([
                beyond.over.into(),
                diverged.and_then(|diverged| diverged.sound_step).into(),
                diverged.map(|diverged| diverged.step).into(),
                beyond.latest.into(),
                beyond.own_limit.into(),
                diverged.and_then(|diverged| diverged.own_limit).into(),
                diverged.and_then(|diverged| diverged.holds()).into(),
                beyond.held.into(),
            ]);
            table.push(row);
        }
    }
    table
}

/// Of the first body: norms until it was given up, and kinetic energies of motions that were not.
pub fn figure(asked: &Divergence, all: &[Seen], place: &Place) -> Figure {
    let first = all.first();
    let mut above = Vec::new();
    let mut guides = Vec::new();
    for (slot, beyond) in first.iter().flat_map(|seen| &seen.beyond).take(DRAWN).enumerate() {
        let start = beyond.looks.first().map_or(f64::NAN, |look| log_norm(&look.displacement));
        let point = |step: u64, logarithm: f64| (step as f64, (logarithm - start) / std::f64::consts::LN_10);
        let points = beyond.looks.iter().map(|look| point(look.step, log_norm(&look.displacement)));
        above.push(
            Series::line(format!("Δt = {} of the own limit", beyond.over), points.collect()).slot(slot),
        );
        let sound = beyond.diverged.as_ref().and_then(|diverged| diverged.sound_step);
        let label = format!("{}: sound until here", beyond.over);
        guides.extend(sound.map(|step| Guide::Vertical { at: step as f64, label }));
    }
    let above = Lines::new(Axis::linear("step"), Axis::linear("log₁₀ ‖u‖ / ‖u(0)‖").including(0.0), above);
    let above = guides.into_iter().fold(above.titled("Given up"), Lines::guide);
    let grown = first.iter().flat_map(|seen| &seen.grown).enumerate().map(|(slot, grown)| {
        let points = grown.kinetic.iter().skip(1).map(|&(step, kinetic)| (step as f64, kinetic));
        Series::line(grown.name, points.collect()).slot(slot)
    });
    let grown = Lines::new(Axis::linear("step"), Axis::log("kinetic energy / J"), grown.collect());
    let caption = format!(
        "{}: above its own limit, until it is given up, and at the limit under loads that make it grow, which is no divergence.",
        asked.names.first().map_or("A body", String::as_str)
    );
    Figure::new(place.case.clone(), asked.title.clone(), caption, above).panel(grown.titled("Not given up"))
}
