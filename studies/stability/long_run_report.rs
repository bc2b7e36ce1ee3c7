//! Rows of `stability_long_run.csv`, and the drift of the invariant over the steps.

use super::long_run::{Kept, LongRun};
use crate::bar::names::{LATTICE, lattice_cells};
use crate::question::Place;
use pd_verify::report::plot::{Axis, Figure, Lines, Series};
use pd_verify::table::{Cell, Table};

/// Bodies that the figure shows.
const DRAWN: usize = 4;

/// A row for every body and look.
pub fn table(asked: &LongRun, all: &[Kept], place: &Place) -> Table {
    let own = ["step", "drift_over_energy", "allowed_over_energy", "momentum_n_s", "allowed_momentum_n_s"];
    let mut table = Table::new("stability_long_run.csv", &[&["case"][..], &LATTICE, &own].concat());
    for (body, kept) in asked.bodies.iter().zip(all) {
        for &(step, drift, allowed) in &kept.drift {
            let momentum = kept.momentum.iter().find(|(at, ..)| *at == step);
            let mut row: Vec<Cell> = vec![place.case.as_str().into()];
            row.extend(lattice_cells(Some(body.lattice())));
            row.extend::<[Cell; 5]>([
                step.into(),
                (drift / kept.energy).into(),
                (allowed / kept.energy).into(),
                momentum.map(|(_, size, _)| *size).into(),
                momentum.map(|(_, _, allowed)| *allowed).into(),
            ]);
            table.push(row);
        }
    }
    table
}

/// |H − H₀|/H₀ over steps, and what rounding allows.
pub fn figure(asked: &LongRun, all: &[Kept], place: &Place) -> Figure {
    let mut series = Vec::new();
    for (slot, (kept, name)) in all.iter().zip(&asked.names).take(DRAWN).enumerate() {
        // Neither the first look nor a drift of nothing has a place on logarithmic axes.
        let points = |of: fn(&(u64, f64, f64)) -> f64| {
            let later = kept.drift.iter().filter(|at| at.0 > 0 && of(at) > 0.0);
            later.map(|at| (at.0 as f64, of(at) / kept.energy)).collect::<Vec<_>>()
        };
        series.push(Series::line(name.clone(), points(|at| at.1)).slot(slot));
        series.push(Series::reference(format!("{name}, allowed"), points(|at| at.2)).slot(slot));
    }
    let panel = Lines::new(Axis::log("step"), Axis::log("drift of the invariant / its value"), series);
    let caption = format!(
        "Drift of leapfrog's invariant for {} of {} bodies, and what a random walk of rounding errors allows (the smooth lines above).",
        all.len().min(DRAWN),
        all.len()
    );
    Figure::new(place.case.clone(), asked.title.clone(), caption, panel)
}
