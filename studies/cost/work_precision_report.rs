//! Rows of `work_precision.csv`, the cheapest ways, what choices cost; error against work and time as the plot people know.

use super::answers::{self, By, CHOICES, TARGETS, Way, best, cheapest, median, prices, ways};
use super::runs::bytes;
use super::work_precision::{Points, WorkPrecision};
use crate::bar::names::lattice_cells;
use crate::question::Place;
use crate::rounded::rounded;
use pd_verify::compare::order::tail;
use pd_verify::report::plot::{Axis, Colour, Figure, Lines, Series};
use pd_verify::table::{Cell, Table};

/// All tables of a case.
pub fn tables(asked: &WorkPrecision, points: &Points, place: &Place) -> Vec<Table> {
    vec![
        runs(asked, points, place),
        exponents(asked, points, place),
        cheapest_ways(asked, points, place),
        choices(asked, points, place),
    ]
}

/// Runs on the frontier by bond updates, and by seconds.
fn frontiers(asked: &WorkPrecision, points: &Points) -> [Vec<(usize, usize, usize)>; 2] {
    let updates = |track: usize, level: usize| asked.tracks[track].runs[level].plan().bond_updates as f64;
    let seconds = |track: usize, level: usize| median(&points[track][level].seconds).unwrap_or(f64::NAN);
    [best(asked, points, updates), best(asked, points, seconds)]
}

/// A row for every run and reading.
fn runs(asked: &WorkPrecision, points: &Points, place: &Place) -> Table {
    let columns = [
        "case",
        "method",
        "kernel",
        "p",
        "m",
        "dx_m",
        "volume_rule",
        "calibrated",
        "courant",
        "error",
        "error_kind",
        "seconds",
        "node_updates",
        "bond_updates",
        "bytes_peak",
        "on_frontier",
        "on_time_frontier",
        "seconds_least",
        "seconds_most",
        "seconds_predicted",
        "time_step_over_limit",
        "extraction",
    ];
    let [by_updates, by_seconds] = frontiers(asked, points);
    let mut table = Table::new("work_precision.csv", &columns);
    for (index, track) in asked.tracks.iter().enumerate() {
        for (level, (run, point)) in track.runs.iter().zip(&points[index]).enumerate() {
            for (reading, name) in asked.facts.readings.iter().enumerate() {
                let (plan, here) = (run.plan(), (index, level, reading));
                let mut row: Vec<Cell> = vec![place.case.as_str().into(), track.setting.method().into()];
                row.extend(lattice_cells(Some((track.setting.lattice, run.spacing()))));
                if track.setting.finite_differences {
                    // What kernels have, plain differences have not: only Δx, the fourth of these cells, is left.
                    [2, 3, 4, 6, 7].iter().for_each(|&at| row[at] = Cell::Empty);
                }
                row.extend::<[Cell; 14]>([
                    run.courant().into(),
                    point.solved.errors[reading].into(),
                    asked.facts.error_kind.word().into(),
                    median(&point.seconds).into(),
                    plan.node_updates.into(),
                    plan.bond_updates.into(),
                    bytes(plan).into(),
                    by_updates.contains(&here).into(),
                    by_seconds.contains(&here).into(),
                    point.seconds.first().copied().into(),
                    point.seconds.last().copied().into(),
                    point.predicted.into(),
                    track.setting.safety.into(),
                    name.as_str().into(),
                ]);
                table.push(row);
            }
        }
    }
    table
}

/// What tells a setting from others, in tables of answers.
const SETTING: [&str; 8] =
    ["method", "kernel", "p", "m", "volume_rule", "calibrated", "time_step_over_limit", "extraction"];

fn setting_cells(asked: &WorkPrecision, track: usize, reading: usize) -> Vec<Cell> {
    let setting = asked.tracks[track].setting;
    let lattice = setting.lattice;
    let mut cells: Vec<Cell> = vec![setting.method().into()];
    match setting.finite_differences {
        true => cells.extend(vec![Cell::Empty; 5]),
        false => cells.extend::<[Cell; 5]>([
            lattice.kernel.name().into(),
            lattice.kernel.p().into(),
            lattice.m.into(),
            lattice.volume_rule.name().into(),
            lattice.calibrated.into(),
        ]),
    }
    cells.extend::<[Cell; 2]>([setting.safety.into(), asked.facts.readings[reading].as_str().into()]);
    cells
}

/// The power of the work at which the error of each setting falls, over its finest levels that agree.
fn exponents(asked: &WorkPrecision, points: &Points, place: &Place) -> Table {
    let own = ["work", "exponent", "exponent_low", "exponent_high", "exponent_levels"];
    let mut table = Table::new("work_exponents.csv", &[&["case"][..], &SETTING, &own].concat());
    for (index, track) in asked.tracks.iter().enumerate() {
        for reading in 0..asked.facts.readings.len() {
            let works: [(&str, &dyn Fn(usize) -> f64); 2] = [
                ("bond_updates", &|level| track.runs[level].plan().bond_updates as f64),
                ("seconds", &|level| median(&points[index][level].seconds).unwrap_or(f64::NAN)),
            ];
            for (work, of) in works {
                let error = |level: usize| points[index][level].solved.errors[reading].unwrap_or(f64::NAN);
                let levels: Vec<(f64, f64)> =
                    (0..track.runs.len()).map(|level| (of(level), error(level))).collect();
                let found = tail(&levels, 1e-9);
                let interval = found.order.and_then(|order| order.interval);
                let mut row: Vec<Cell> = vec![place.case.as_str().into()];
                row.extend(setting_cells(asked, index, reading));
                row.extend::<[Cell; 5]>([
                    work.into(),
                    found.order.map(|order| order.value).into(),
                    interval.map(|(low, _)| low).into(),
                    interval.map(|(_, high)| high).into(),
                    found.levels.len().into(),
                ]);
                table.push(row);
            }
        }
    }
    table
}

fn way_cells(way: &Way) -> [Cell; 5] {
    [way.dx.into(), way.node_updates.into(), way.bond_updates.into(), way.seconds.into(), way.bytes.into()]
}

const WAY: [&str; 5] = ["dx_m", "node_updates", "bond_updates", "seconds", "bytes_peak"];

/// The cheapest way to each error, by updates and by seconds; empty where none comes to it.
fn cheapest_ways(asked: &WorkPrecision, points: &Points, place: &Place) -> Table {
    let mut table = Table::new("work_cheapest.csv", &[&["case", "error", "by"][..], &SETTING, &WAY].concat());
    for target in TARGETS {
        let ways = ways(asked, points, target);
        for by in By::ALL {
            let mut row: Vec<Cell> = vec![place.case.as_str().into(), target.into(), by.word().into()];
            match cheapest(&ways, by) {
                Some(way) => {
                    row.extend(setting_cells(asked, way.track, way.reading));
                    row.extend(way_cells(way));
                }
                None => row.extend(vec![Cell::Empty; SETTING.len() + WAY.len()]),
            }
            table.push(row);
        }
    }
    table
}

/// What each kernel, m, rule, … costs at its cheapest, over the cheapest of all.
fn choices(asked: &WorkPrecision, points: &Points, place: &Place) -> Table {
    let columns = ["case", "error", "by", "choice", "word", "over_cheapest", "cost"];
    let mut table = Table::new("work_choices.csv", &columns);
    for target in TARGETS {
        let ways = ways(asked, points, target);
        for by in By::ALL {
            let least = cheapest(&ways, by).map(|way| by.of(way));
            for (choice, name) in CHOICES.iter().enumerate() {
                let prices = prices(asked, &ways, choice, by);
                if prices.len() < 2 {
                    continue;
                }
                for (word, way) in prices {
                    let cost = way.map(|way| by.of(&way));
                    let over = cost.zip(least).map(|(cost, least)| cost / least);
                    let row: Vec<Cell> = vec![
                        place.case.as_str().into(),
                        target.into(),
                        by.word().into(),
                        (*name).into(),
                        word.into(),
                        over.into(),
                        cost.into(),
                    ];
                    table.push(row);
                }
            }
        }
    }
    table
}

/// Error against bond updates, and against seconds where runs were timed.
pub fn figures(asked: &WorkPrecision, points: &Points, place: &Place) -> Vec<Figure> {
    let [by_updates, by_seconds] = frontiers(asked, points);
    let updates = |track: usize, level: usize| asked.tracks[track].runs[level].plan().bond_updates as f64;
    let seconds = |track: usize, level: usize| median(&points[track][level].seconds).unwrap_or(f64::NAN);
    let error = format!("error ({})", asked.facts.error_kind.word().replace('_', " "));
    let panel = |title: &str, label: &str, cost: &dyn Fn(usize, usize) -> f64, best: &[_]| {
        let series = series(asked, points, cost, best);
        Lines::new(Axis::log(label), Axis::log(error.clone()), series).titled(title)
    };
    let first = panel("Work", "bond updates", &updates, &by_updates);
    let figure = Figure::new(place.case.clone(), asked.title.clone(), caption(asked, points), first);
    let timed = points.iter().flatten().any(|point| !point.seconds.is_empty());
    vec![match timed {
        true => figure.panel(panel("Time", "seconds of marching", &seconds, &by_seconds)).columns(2),
        false => figure,
    }]
}

/// Every run by kernel (or, where results are read in several ways, by extraction), and the frontier.
fn series(
    asked: &WorkPrecision,
    points: &Points,
    cost: &dyn Fn(usize, usize) -> f64,
    best: &[(usize, usize, usize)],
) -> Vec<Series> {
    let several = asked.facts.readings.len() > 1;
    let group = |track: usize, reading: usize| match several {
        true => asked.facts.readings[reading].clone(),
        false => asked.tracks[track].setting.family(),
    };
    let at = |&(track, level, reading): &(usize, usize, usize)| {
        (cost(track, level), points[track][level].solved.errors[reading].unwrap_or(f64::NAN))
    };
    let mut groups: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    for (track, levels) in points.iter().enumerate() {
        for level in 0..levels.len() {
            for reading in 0..asked.facts.readings.len() {
                let (name, point) = (group(track, reading), at(&(track, level, reading)));
                match groups.iter_mut().find(|(other, _)| *other == name) {
                    Some((_, all)) => all.push(point),
                    None => groups.push((name, vec![point])),
                }
            }
        }
    }
    let marked = groups.into_iter().enumerate();
    let mut series: Vec<Series> =
        marked.map(|(slot, (name, all))| Series::markers(name, all).slot(slot)).collect();
    series.push(Series::line("none is cheaper", best.iter().map(at).collect()).colour(Colour::Black));
    series
}

/// What the answer means: the cheapest way to each error, and what other choices cost there.
fn caption(asked: &WorkPrecision, points: &Points) -> String {
    let mut said = format!("Error of {} over the work of every run.", asked.facts.what);
    for target in TARGETS {
        let ways = ways(asked, points, target);
        let percent = 100.0 * target;
        let Some(way) = cheapest(&ways, By::BondUpdates) else {
            said += &format!(" No run comes to {percent} %.");
            continue;
        };
        let reading = &asked.facts.readings[way.reading];
        let read = if reading.is_empty() { String::new() } else { format!(" by {reading}") };
        let seconds = way.seconds.map_or(String::new(), |seconds| format!(", {:.2e} s", seconds));
        said += &format!(
            " {percent} % costs {:.2e} bond updates{seconds}{read}: {}, Δx = {} m.",
            way.bond_updates,
            asked.tracks[way.track].setting.said(),
            rounded(way.dx),
        );
        if target == TARGETS[1] {
            said += &others(asked, &ways, By::BondUpdates.of(way));
        }
    }
    said + &agreement(points)
}

/// What the words of each choice cost at their cheapest over the cheapest of all.
fn others(asked: &WorkPrecision, ways: &[Way], least: f64) -> String {
    let mut said = String::new();
    for (choice, name) in CHOICES.iter().enumerate() {
        let prices = answers::prices(asked, ways, choice, By::BondUpdates);
        if prices.len() < 2 {
            continue;
        }
        let price = |(word, way): &(String, Option<Way>)| match way {
            Some(way) => format!("{word} {:.1}", way.bond_updates / least),
            None => format!("{word} never"),
        };
        let list: Vec<String> = prices.iter().map(price).collect();
        said += &format!(" There by {}, times the cheapest: {}.", name.replace('_', " "), list.join(", "));
    }
    said
}

/// How many predictions were within a factor 1.5 of the time that was taken.
fn agreement(points: &Points) -> String {
    let ratio = |point: &super::work_precision::Point| Some(point.predicted? / median(&point.seconds)?);
    let ratios: Vec<f64> = points.iter().flatten().filter_map(ratio).collect();
    if ratios.is_empty() {
        return String::new();
    }
    let near = ratios.iter().filter(|ratio| (1.0 / 1.5..=1.5).contains(*ratio)).count();
    format!(" Of {} predictions of time {near} were within a factor 1.5.", ratios.len())
}
