//! A figure for each probe: what it saw over time, or along a line at a few times.

use super::balances::asked_for;
use super::figure_units::{Unit, is_rounding, largest, largest_displacement};
use crate::question::Place;
use crate::rounded::rounded;
use pd_verify::record::{Column, Record, Trace};
use pd_verify::report::plot::{Axis, Figure, Lines, Series};

/// Panels beyond these would not be read.
const MOST_PANELS: usize = 6;

/// Times at which a line is drawn.
const MOST_TIMES: usize = 6;

/// Points that a curve needs on paper.
const MOST_POINTS: usize = 4000;

/// What a probe saw of a scene, and how far the scene moved.
struct Seen<'a> {
    scene: &'a str,
    trace: &'a Trace,
    displacement: f64,
}

/// The figures of a case, in the order of its probes.
pub fn figures(title: &str, records: &[&Record], place: &Place) -> Vec<Figure> {
    let Some(first) = records.first() else { return Vec::new() };
    // A patch is data for whoever reads the table: no one would read a curve for each of its nodes.
    let is_patch = |trace: &Trace| trace.columns.iter().any(|column| column.quantity == "acceleration_x");
    let drawn = first.traces.iter().filter(|trace| !is_patch(trace));
    let probes = drawn.map(|trace| &trace.probe).filter(|probe| asked_for(probe));
    let moved: Vec<f64> = records.iter().map(|record| largest_displacement(record)).collect();
    let of = |probe: &String| {
        let seen = records.iter().zip(&moved).filter_map(|(record, &displacement)| {
            Some(Seen { scene: record.plan.name.as_str(), trace: record.trace(probe)?, displacement })
        });
        figure(title, probe, &seen.collect::<Vec<_>>(), place)
    };
    probes.map(of).collect()
}

fn figure(title: &str, probe: &str, seen: &[Seen<'_>], place: &Place) -> Figure {
    let columns = seen.first().map_or(&[][..], |one| one.trace.columns.as_slice());
    let (mut panels, mut caption) = match columns {
        [first, ..] if first.unit == "J" => (energies(seen), "Energies and works over time.".to_owned()),
        [first, second, ..] if columns.len() > 2 || first.at != second.at => {
            (along(seen), format!("Displacements along a line of nodes{}.", line_place(columns)))
        }
        _ => (over_time(seen), format!("What the probe saw over time{}.", point_place(columns))),
    };
    for quantity in quantities(columns) {
        if seen.iter().all(|one| is_rounding(one.trace, quantity, one.displacement)) {
            caption += &format!(" The {} is zero to rounding.", in_words(quantity));
        }
    }
    if panels.len() > MOST_PANELS {
        caption += &format!(" The first {MOST_PANELS} of {} panels; probes.csv has all.", panels.len());
        panels.truncate(MOST_PANELS);
    }
    if columns.iter().any(|column| column.removed) {
        caption += " In a hole there is nothing to draw.";
    }
    let mut figure = Figure::new(
        format!("{}.{probe}", place.case),
        format!("{title}: {probe}"),
        caption,
        Lines::default(),
    );
    figure.panels.clear();
    let columns = panels.len().clamp(1, 2);
    panels.into_iter().fold(figure, Figure::panel).columns(columns)
}

/// A panel for each quantity, a curve for each scene.
fn over_time(seen: &[Seen<'_>]) -> Vec<Lines> {
    let Some(first) = seen.first() else { return Vec::new() };
    let time = time_unit(seen);
    let panel = |(index, column): (usize, &Column)| {
        let unit = value_unit(seen, column.quantity);
        let series = seen.iter().map(|one| {
            let name = if seen.len() > 1 { one.scene } else { "" };
            Series::line(name, curve(one.trace, index, time, unit))
        });
        Lines::new(time_axis(time), value_axis(column, unit), series.collect())
    };
    first.trace.columns.iter().enumerate().map(panel).collect()
}

/// A panel for each scene, a curve for each account that is not empty.
fn energies(seen: &[Seen<'_>]) -> Vec<Lines> {
    let time = time_unit(seen);
    let panel = |one: &Seen<'_>| {
        let columns = one.trace.columns.iter().enumerate();
        let used = columns.filter(|(index, _)| one.trace.rows.iter().any(|row| row[*index] != 0.0));
        let series = used.map(|(index, column)| {
            let points = curve(one.trace, index, time, None);
            Series::line(column.quantity.replace('_', " "), points).slot(index)
        });
        let panel = Lines::new(time_axis(time), Axis::linear("energy (J)"), series.collect());
        if seen.len() > 1 { panel.titled(one.scene) } else { panel }
    };
    seen.iter().map(panel).collect()
}

/// A panel for each scene and component, a curve for each of a few times.
fn along(seen: &[Seen<'_>]) -> Vec<Lines> {
    let time = time_unit(seen);
    let mut panels = Vec::new();
    for Seen { scene, trace, .. } in seen {
        let axis = usize::from(runs_along_y(&trace.columns));
        for quantity in quantities(&trace.columns) {
            let here: Vec<usize> =
                (0..trace.columns.len()).filter(|&index| trace.columns[index].quantity == quantity).collect();
            let unit = value_unit(seen, quantity);
            let value = |si: f64| unit.map_or(si, |unit| unit.of(si));
            let place = |index: usize| trace.columns[index].at.as_ref().map_or(f64::NAN, |at| at[axis]);
            let series = shown(trace.times.len()).into_iter().map(|look| {
                let points = here.iter().map(|&index| (place(index), value(trace.rows[look][index])));
                let at = format!("t = {} {}", rounded(time.of(trace.times[look])), time.name);
                Series::line(at, points.collect())
            });
            let x = Axis::linear(if axis == 0 { "x (m)" } else { "y (m)" });
            let Some(&first) = here.first() else { continue };
            let panel = Lines::new(x, value_axis(&trace.columns[first], unit), series.collect());
            panels.push(if seen.len() > 1 { panel.titled(*scene) } else { panel });
        }
    }
    panels
}

/// The quantities of a probe, each once.
fn quantities(columns: &[Column]) -> Vec<&'static str> {
    let mut quantities: Vec<&'static str> = columns.iter().map(|column| column.quantity).collect();
    quantities.sort_unstable();
    quantities.dedup();
    quantities
}

/// Where a point stands: ` at (0.1, 0.025) m`; nothing for quantities of the whole body.
fn point_place(columns: &[Column]) -> String {
    match columns.first().and_then(|column| column.at.as_deref()) {
        Some([x]) => format!(" at {} m", rounded(*x)),
        Some([x, y, ..]) => format!(" at ({}, {}) m", rounded(*x), rounded(*y)),
        _ => String::new(),
    }
}

/// Where a line of a plate runs: ` at y = 0.025 m`; nothing for a bar.
fn line_place(columns: &[Column]) -> String {
    match columns.first().and_then(|column| column.at.as_deref()) {
        Some([x, ..]) if runs_along_y(columns) => format!(" at x = {} m", rounded(*x)),
        Some([_, y, ..]) => format!(" at y = {} m", rounded(*y)),
        _ => String::new(),
    }
}

fn runs_along_y(columns: &[Column]) -> bool {
    let mut places = columns.iter().filter_map(|column| column.at.as_ref());
    let first = places.next();
    places.any(|at| first.is_some_and(|first| at[0] == first[0] && at.get(1) != first.get(1)))
}

/// Up to six looks, the first and the last among them.
pub(super) fn shown(looks: usize) -> Vec<usize> {
    if looks <= MOST_TIMES {
        return (0..looks).collect();
    }
    (0..MOST_TIMES).map(|n| n * (looks - 1) / (MOST_TIMES - 1)).collect()
}

fn curve(trace: &Trace, index: usize, time: Unit, unit: Option<Unit>) -> Vec<(f64, f64)> {
    let thin = trace.times.len().div_ceil(MOST_POINTS).max(1);
    let point =
        |(t, row): (&f64, &Vec<f64>)| (time.of(*t), unit.map_or(row[index], |unit| unit.of(row[index])));
    trace.times.iter().zip(&trace.rows).step_by(thin).map(point).collect()
}

fn time_unit(seen: &[Seen<'_>]) -> Unit {
    let last = seen.iter().filter_map(|one| one.trace.times.last().copied());
    Unit::of_time(last.fold(0.0, f64::max))
}

fn time_axis(unit: Unit) -> Axis {
    Axis::linear(format!("time t ({})", unit.name))
}

/// The unit of a displacement in all scenes of a figure; where there is only rounding, that of what else moves.
fn value_unit(seen: &[Seen<'_>], quantity: &str) -> Option<Unit> {
    let of = |one: &Seen<'_>| {
        let most = largest(one.trace, |column| column.quantity == quantity && column.unit == "m");
        if is_rounding(one.trace, quantity, one.displacement) { one.displacement } else { most }
    };
    let most = seen.iter().map(of).fold(0.0, f64::max);
    quantity.starts_with("displacement").then(|| Unit::of_displacement(most))
}

fn value_axis(column: &Column, unit: Option<Unit>) -> Axis {
    let name = in_words(column.quantity);
    match (column.unit, unit) {
        (_, Some(unit)) => Axis::linear(format!("{name} ({})", unit.name)),
        ("1", None) => Axis::linear(name),
        (si, None) => Axis::linear(format!("{name} ({si})")),
    }
}

fn in_words(quantity: &str) -> String {
    match quantity.rsplit_once('_') {
        Some((name, axis @ ("x" | "y"))) => format!("{name} along {axis}"),
        _ => quantity.replace('_', " "),
    }
}
