//! Rows of `dsif_running.csv`, K of running tips over time, and k over the speed.

use super::running::{Ran, RunningCrack};
use crate::bar::names::{LATTICE, lattice_cells};
use crate::question::Place;
use crate::rounded::rounded;
use pd_verify::report::plot::{Axis, Band, Dash, Figure, Lines, Series};
use pd_verify::table::{Cell, Row, Table};
use std::sync::Arc;

/// A row for every look of every march.
pub fn table(asked: &RunningCrack, ran: &[&[Ran]], place: &Place) -> Table {
    let mut columns = vec!["case", "mode"];
    columns.extend(LATTICE);
    columns.extend(["speed_over_rayleigh", "speed_m_s", "t_s", "tip_x_m"]);
    columns.extend(["k_pa_sqrt_m", "k_smoothed_pa_sqrt_m", "k_reference_pa_sqrt_m", "in_window"]);
    let mut table = Table::new("dsif_running.csv", &columns);
    for (run, levels) in asked.runs.iter().zip(ran) {
        for (setup, ran) in run.setups.iter().zip(*levels) {
            let mut shared: Vec<Cell> = vec![place.case.as_str().into(), asked.load.mode.word().into()];
            shared.extend(lattice_cells(Some((setup.lattice, setup.scene.spacing))));
            shared.extend([run.share.into(), run.speed.into()]);
            let shared: Arc<[Cell]> = shared.into();
            for (look, &t) in ran.times.iter().enumerate() {
                let own: Vec<Cell> = vec![
                    t.into(),
                    (setup.plate.tip[0] + asked.gone(run, t)).into(),
                    ran.k[look].into(),
                    ran.smoothed[look].into(),
                    asked.known_at(run, t).into(),
                    asked.window.holds(t).into(),
                ];
                table.push(Row::of_block(&shared, own));
            }
        }
    }
    table
}

/// K at the finest level, and its mean ratio to K at rest over the speed, beside k(v).
pub fn figure(asked: &RunningCrack, ran: &[&[Ran]], place: &Place) -> Figure {
    let micro = 1e-6;
    let unit = asked.load.stress * asked.half_height.sqrt();
    let mut series = Vec::new();
    for (slot, (run, levels)) in asked.runs.iter().zip(ran).enumerate() {
        let Some(ran) = levels.last() else { continue };
        let known = ran.times.iter().filter_map(|&t| Some((t / micro, asked.known_at(run, t)? / unit)));
        let smoothed = ran.times.iter().zip(&ran.smoothed);
        let smoothed = smoothed.filter_map(|(t, k)| Some((t / micro, (*k)? / unit)));
        let label = format!("v = {} c_R", rounded(run.share));
        series.push(Series::line("", known.collect()).slot(slot).dash(Dash::Dashed).width(1.4));
        series.push(Series::line(label, smoothed.collect()).slot(slot));
    }
    let axis = Axis::linear(format!("K_{}/(σ₀√H)", asked.load.mode.word()));
    let mut history = Lines::new(Axis::linear("t (µs)"), axis, series);
    history.bands =
        vec![Band { from: asked.window.from / micro, to: asked.window.to / micro, label: "judged".into() }];
    let rest = |t: f64| asked.known.running_at(t, 0.0);
    let middle = 0.5 * (asked.window.from + asked.window.to);
    let rayleigh = asked.runs[0].speed / asked.runs[0].share;
    let k = |share: f64| Some(asked.known.running_at(middle, share * rayleigh)? / rest(middle)?);
    let exact = (0..=100).filter_map(|n| Some((f64::from(n) / 100.0, k(f64::from(n) / 100.0)?))).collect();
    let mut over_speed = vec![Series::reference("k(v)", exact)];
    let levels = asked.runs[0].setups.len();
    for level in 0..levels {
        let found = asked.runs.iter().zip(ran).filter_map(|(run, ran)| {
            let pairs = asked.pairs(run, &ran[level])?;
            let share: f64 = pairs.iter().map(|(k, known)| k / known).sum::<f64>() / pairs.len() as f64;
            Some((run.share, share * k(run.share)?))
        });
        let dx = asked.runs[0].setups[level].scene.spacing;
        over_speed.push(Series::markers(format!("Δx = {} m", rounded(dx)), found.collect()));
    }
    let speeds = Lines::new(Axis::linear("v/c_R"), Axis::linear("K/K at rest"), over_speed);
    let caption = "Left: K at the finest level, smoothed over the time in which the tip passes a cell; broken: k(v) times K at rest. Right: mean ratio to K at rest in the window.";
    Figure::new(place.case.clone(), asked.title.clone(), caption, history).panel(speeds).columns(2)
}
