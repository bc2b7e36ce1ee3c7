//! A figure for each probe: what it saw over time, or along a line at a few times.

use super::balances::asked_for;
use crate::question::Place;
use pd_verify::record::{Record, Trace};
use pd_verify::report::plot::{Axis, Figure, Lines, Series};

/// Panels beyond these would not be read.
const MOST_PANELS: usize = 6;

/// Times at which a line is drawn.
const MOST_TIMES: usize = 6;

/// Points that a curve needs on paper.
const MOST_POINTS: usize = 4000;

/// The figures of a case, in the order of its probes.
pub fn figures(title: &str, records: &[&Record], place: &Place) -> Vec<Figure> {
    let Some(first) = records.first() else { return Vec::new() };
    let probes = first.traces.iter().map(|trace| &trace.probe).filter(|probe| asked_for(probe));
    let of = |probe: &String| {
        let traces =
            records.iter().filter_map(|record| Some((record.plan.name.as_str(), record.trace(probe)?)));
        figure(title, probe, &traces.collect::<Vec<_>>(), place)
    };
    probes.map(of).collect()
}

fn figure(title: &str, probe: &str, traces: &[(&str, &Trace)], place: &Place) -> Figure {
    let (mut panels, caption) = match traces.first().map(|(_, trace)| trace.columns.as_slice()) {
        Some([first, ..]) if first.unit == "J" => (energies(traces), "Energies and works over time."),
        Some([first, second, ..]) if first.at != second.at && first.at.is_some() => {
            (along(traces), "Displacements along a line of nodes.")
        }
        Some(columns) if columns.len() > 2 => (along(traces), "Displacements along a line of nodes."),
        _ => (over_time(traces), "What the probe saw over time."),
    };
    let mut caption = caption.to_owned();
    if panels.len() > MOST_PANELS {
        caption += &format!(" The first {MOST_PANELS} of {} panels; probes.csv has all.", panels.len());
        panels.truncate(MOST_PANELS);
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
fn over_time(traces: &[(&str, &Trace)]) -> Vec<Lines> {
    let Some((_, first)) = traces.first() else { return Vec::new() };
    let panel = |(index, column): (usize, &pd_verify::record::Column)| {
        let series = traces.iter().map(|(name, trace)| {
            Series::line(if traces.len() > 1 { *name } else { "" }, curve(trace, index))
        });
        Lines::new(time(), value_axis(column.quantity, column.unit), series.collect())
    };
    first.columns.iter().enumerate().map(panel).collect()
}

/// A panel for each scene, a curve for each account that is not empty.
fn energies(traces: &[(&str, &Trace)]) -> Vec<Lines> {
    let panel = |(name, trace): &(&str, &Trace)| {
        let columns = trace.columns.iter().enumerate();
        let used = columns.filter(|(index, _)| trace.rows.iter().any(|row| row[*index] != 0.0));
        let series = used.map(|(index, column)| {
            Series::line(column.quantity.replace('_', " "), curve(trace, index)).slot(index)
        });
        let panel = Lines::new(time(), Axis::linear("energy (J)"), series.collect());
        if traces.len() > 1 { panel.titled(*name) } else { panel }
    };
    traces.iter().map(panel).collect()
}

/// A panel for each scene and component, a curve for each of a few times.
fn along(traces: &[(&str, &Trace)]) -> Vec<Lines> {
    let mut panels = Vec::new();
    for (name, trace) in traces {
        let axis = usize::from(runs_along_y(trace));
        let mut quantities: Vec<&'static str> = trace.columns.iter().map(|column| column.quantity).collect();
        quantities.sort_unstable();
        quantities.dedup();
        for quantity in quantities {
            let here: Vec<usize> =
                (0..trace.columns.len()).filter(|&index| trace.columns[index].quantity == quantity).collect();
            let place = |index: usize| trace.columns[index].at.as_ref().map_or(f64::NAN, |at| at[axis]);
            let series = shown(trace.times.len()).into_iter().map(|look| {
                let points = here.iter().map(|&index| (place(index), trace.rows[look][index]));
                Series::line(format!("t = {} s", significant(trace.times[look])), points.collect())
            });
            let x = Axis::linear(if axis == 0 { "x (m)" } else { "y (m)" });
            let panel = Lines::new(x, value_axis(quantity, "m"), series.collect());
            panels.push(if traces.len() > 1 { panel.titled(*name) } else { panel });
        }
    }
    panels
}

fn runs_along_y(trace: &Trace) -> bool {
    let mut places = trace.columns.iter().filter_map(|column| column.at.as_ref());
    let first = places.next();
    places.any(|at| first.is_some_and(|first| at[0] == first[0] && at.get(1) != first.get(1)))
}

/// Up to six looks, the first and the last among them.
fn shown(looks: usize) -> Vec<usize> {
    if looks <= MOST_TIMES {
        return (0..looks).collect();
    }
    (0..MOST_TIMES).map(|n| n * (looks - 1) / (MOST_TIMES - 1)).collect()
}

fn curve(trace: &Trace, index: usize) -> Vec<(f64, f64)> {
    let thin = trace.times.len().div_ceil(MOST_POINTS).max(1);
    trace.times.iter().zip(&trace.rows).step_by(thin).map(|(t, row)| (*t, row[index])).collect()
}

fn time() -> Axis {
    Axis::linear("time t (s)")
}

fn value_axis(quantity: &str, unit: &str) -> Axis {
    let name = match quantity {
        "displacement_x" => "displacement along x",
        "displacement_y" => "displacement along y",
        "momentum_x" => "momentum along x",
        "momentum_y" => "momentum along y",
        other => other,
    };
    Axis::linear(if unit == "1" { name.to_owned() } else { format!("{name} ({unit})") })
}

/// Three digits, as in 2.4e-4.
fn significant(value: f64) -> String {
    let text = format!("{value:.2e}");
    match text.split_once('e') {
        Some((digits, "0")) => digits.trim_end_matches('0').trim_end_matches('.').to_owned(),
        Some((digits, power)) => {
            format!("{}e{power}", digits.trim_end_matches('0').trim_end_matches('.'))
        }
        None => text,
    }
}
