//! Rows of `stability_time_steps.csv`; norms over steps below and above the limit, and the mode that grows.

use super::body::{FreeBody, Look};
use super::growing::{log_norm, norm};
use super::time_step::{Seen, TimeStepLimit, excess};
use crate::bar::names::{LATTICE, lattice_cells};
use crate::question::Place;
use pd_verify::report::plot::{Axis, Figure, Guide, Lines, Raster, Series};
use pd_verify::table::{Cell, Table};

/// Bodies that one figure shows.
const DRAWN: usize = 4;

/// A row for every body.
pub fn table(asked: &TimeStepLimit, all: &[Seen], place: &Place) -> Table {
    let own = [
        "surface_correction",
        "lattice_limit_s",
        "own_limit_s",
        "step_below_s",
        "steps",
        "norm_excess",
        "step_above_s",
        "growth_per_step_predicted",
        "growth_per_step_measured",
        "growth_error",
        "next_over_fastest",
        "sine_of_angle",
        "sine_at_most",
        "overflow_step_predicted",
        "given_up_at_step",
    ];
    let mut table = Table::new("stability_time_steps.csv", &[&["case"][..], &LATTICE, &own].concat());
    for (body, seen) in asked.bodies.iter().zip(all) {
        let mut row: Vec<Cell> = vec![place.case.as_str().into()];
        row.extend(lattice_cells(Some(body.lattice())));
        row.extend::<[Cell; 15]>([
            asked.surface.name().into(),
            seen.lattice_limit.into(),
            seen.own_limit.into(),
            seen.below.into(),
            asked.steps.into(),
            excess(&seen.bounded).into(),
            seen.above.into(),
            known(libm::exp(seen.growing.rate)).into(),
            known(libm::exp(seen.measured.rate)).into(),
            seen.measured.error.and_then(known).into(),
            known(seen.mode.next_omega / seen.mode.omega).into(),
            seen.measured.sine.and_then(known).into(),
            seen.measured.most.and_then(known).into(),
            known(seen.growing.overflow()).into(),
            seen.given_up.into(),
        ]);
        table.push(row);
    }
    table
}

/// What is no number is an empty cell.
fn known(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

/// Norms over steps, and of the first plate whose fastest mode stands alone the mode that grows.
pub fn figures(asked: &TimeStepLimit, all: &[Seen], place: &Place) -> Vec<Figure> {
    let mut figures = vec![norms(asked, all, place)];
    let plate = |at: &usize| matches!(asked.bodies[*at], FreeBody::Plate(_)) && all[*at].stands_alone();
    if let Some(at) = (0..all.len()).find(plate) {
        figures.extend(mode(asked, all, at, place));
    }
    figures
}

/// The logarithm to base ten of the norm over that of the start.
fn growth(looks: &[Look]) -> Vec<(f64, f64)> {
    let start = looks.first().map_or(f64::NAN, |look| log_norm(&look.displacement));
    let of = |look: &Look| (log_norm(&look.displacement) - start) / std::f64::consts::LN_10;
    looks.iter().map(|look| (look.step as f64, of(look))).collect()
}

fn norms(asked: &TimeStepLimit, all: &[Seen], place: &Place) -> Figure {
    let drawn = || all.iter().zip(&asked.names).take(DRAWN).enumerate();
    let below = drawn().map(|(slot, (seen, name))| {
        let start = seen.bounded.first().map_or(f64::NAN, |look| norm(&look.displacement));
        let points = seen.bounded.iter().map(|look| (look.step as f64, norm(&look.displacement) / start));
        Series::both(name.clone(), points.collect()).slot(slot)
    });
    let below = Lines::new(
        Axis::linear("step"),
        Axis::linear("‖u‖ / ‖u(0)‖").including(0.0).including(1.0),
        below.collect(),
    )
    .titled("Below the limit")
    .guide(Guide::Horizontal { at: 1.0, label: "the start".into() });
    // At equal shares of their own limits all bodies grow alike: one is shown.
    let shown = if asked.corrected() { DRAWN } else { 1 };
    let mut above: Vec<Series> = Vec::new();
    for (slot, (seen, name)) in drawn().take(shown) {
        above.push(Series::markers(name.clone(), growth(&seen.grown)).slot(slot));
        let share = seen.growing.share();
        let predicted =
            |step: u64| libm::log10(share) + seen.growing.logarithm(step) / std::f64::consts::LN_10;
        let points = seen.grown.iter().map(|look| (look.step as f64, predicted(look.step)));
        above.push(Series::line(format!("{name}, fastest mode alone"), points.collect()).slot(slot));
    }
    let above =
        Lines::new(Axis::linear("step"), Axis::linear("log₁₀ ‖u‖ / ‖u(0)‖"), above).titled("Above the limit");
    let caption = format!(
        "Norm of the displacements over that of the start, for {} of {} bodies: below the limit it never exceeds the start's, \
         above the limit the fastest mode grows by e^φ a step, cosh(φ/2) = ωΔt/2 (lines: that mode alone, as predicted).",
        all.len().min(DRAWN),
        all.len()
    );
    Figure::new(place.case.clone(), asked.title.clone(), caption, below).panel(above)
}

/// The larger component of a plate's displacement when it has grown, and the mode predicted.
fn mode(asked: &TimeStepLimit, all: &[Seen], at: usize, place: &Place) -> Option<Figure> {
    let seen = &all[at];
    let (body, last) = (&asked.bodies[at], &seen.grown.last()?.displacement);
    let (columns, components) = body.columns();
    let part = |field: &[f64], component: usize| -> Vec<f64> {
        field.iter().skip(component).step_by(components).copied().collect()
    };
    let larger = usize::from(norm(&part(&seen.mode.shape, 1)) > norm(&part(&seen.mode.shape, 0)));
    let panel = |title: &str, field: &[f64], turned: f64| {
        let values = part(field, larger);
        let largest = values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let rows = values.chunks(columns).map(|row| row.iter().map(|x| Some(turned * x / largest)).collect());
        let value = Axis::linear("displacement / largest").range(-1.0, 1.0);
        Raster::new(Axis::linear("node along x"), Axis::linear("node along y"), value, rows.collect())
            .titled(title)
            .diverging(0.0)
            .to_scale()
    };
    // The mode's sign is free: that of the body where the mode is largest.
    let peak =
        (0..last.len()).max_by(|&a, &b| seen.mode.shape[a].abs().total_cmp(&seen.mode.shape[b].abs()))?;
    let turned = (last[peak] * seen.mode.shape[peak].signum()).signum();
    let title = format!("The mode that grows: {}", asked.names[at]);
    let caption = format!(
        "Displacement along {} of every node after a growth by e^500, and the mode of the largest frequency.",
        ["x", "y"][larger]
    );
    let id = format!("{}-mode", place.case);
    let marched = panel("Marched", last, 1.0);
    Some(Figure::new(id, title, caption, marched).panel(panel("Predicted", &seen.mode.shape, turned)))
}
