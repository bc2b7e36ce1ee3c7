//! Rows of `stability_discontinuities.csv`, displacements on the way, and peaks over the steps.

use super::discontinuities::{Discontinuities, Seen};
use crate::bar::names::{LATTICE, lattice_cells};
use crate::question::Place;
use pd_verify::report::plot::{Axis, Figure, Lines, Series};
use pd_verify::table::{Cell, Table};

/// Marches that the figure shows: those of the first lattice.
const DRAWN: usize = 4;
/// Of the march, whose peaks are drawn.
const STRETCHES: usize = 50;

/// A row for every march.
pub fn table(asked: &Discontinuities, all: &[Seen], place: &Place) -> Table {
    let own =
        ["jump", "difference_from_exact", "norm_over_bound", "overshoot_over_allowed", "peak_over_bound"];
    let mut table = Table::new("stability_discontinuities.csv", &[&["case"][..], &LATTICE, &own].concat());
    for (one, seen) in asked.marches.iter().zip(all) {
        let mut row: Vec<Cell> = vec![place.case.as_str().into()];
        row.extend(lattice_cells(Some(one.body.lattice())));
        row.extend::<[Cell; 5]>([
            one.jump.name().into(),
            seen.error.into(),
            seen.norm.into(),
            seen.overshoot.into(),
            seen.most.into(),
        ]);
        table.push(row);
    }
    table
}

/// Displacements soon after the start, and the largest over the steps.
pub fn figure(asked: &Discontinuities, all: &[Seen], place: &Place) -> Figure {
    let drawn = || asked.marches.iter().zip(all).take(DRAWN).enumerate();
    // A load's displacements have no height to compare with: over their own largest.
    let scale = |seen: &Seen, jumps: usize| {
        let most = seen.peaks.iter().map(|(_, peak)| *peak).fold(0.0, f64::max);
        if jumps > 0 { 1.0 } else { most }
    };
    let mut way = Vec::new();
    for (slot, (one, seen)) in drawn().filter(|(_, (one, _))| one.jump.jumps() > 0) {
        let (step, marched, exact) = &seen.way;
        let points = |u: &[f64]| u.iter().enumerate().map(|(j, u)| (j as f64, *u)).collect::<Vec<_>>();
        way.push(Series::markers(format!("{}, step {step}", one.jump.name()), points(marched)).slot(slot));
        way.push(Series::reference(format!("{}, exact", one.jump.name()), points(exact)).slot(slot));
    }
    let way = Lines::new(Axis::linear("node"), Axis::linear("displacement / height"), way);
    let peaks = drawn().map(|(slot, (one, seen))| {
        let scale = scale(seen, one.jump.jumps());
        // The largest of each stretch of the march: an envelope can be seen, every look cannot.
        let stretch = |looks: &[(u64, f64)]| {
            let peak = looks.iter().map(|(_, peak)| *peak).fold(0.0, f64::max);
            (looks[looks.len() / 2].0 as f64, peak / scale)
        };
        let points = seen.peaks.chunks(seen.peaks.len().div_ceil(STRETCHES).max(1)).map(stretch);
        Series::line(one.jump.name(), points.collect()).slot(slot)
    });
    let peaks = Lines::new(
        Axis::linear("step"),
        Axis::linear("largest displacement").including(0.0),
        peaks.collect(),
    );
    let caption = "Bars of the first lattice: displacements soon after a start that jumps, with the exact answer of the lattice, and \
                   the largest displacement over the steps, over the height of the start or, under loads, over its largest.";
    let figure =
        Figure::new(place.case.clone(), asked.title.clone(), caption, way.titled("Soon after the start"));
    figure.panel(peaks.titled("All the while"))
}
