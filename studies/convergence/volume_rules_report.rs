//! Table and figure of volume rules: the error of ω² at every m, beside the law of large m.

use super::volume_rules::{Seen, VolumeRules};
use crate::question::Place;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::report::plot::{Axis, Dash, Figure, Guide, Lines, Marker, Series};
use pd_verify::table::Table;

/// Rows of every m.
pub fn table(asked: &VolumeRules, seen: &[Seen], place: &Place) -> Table {
    let columns = [
        "case",
        "kernel",
        "p",
        "volume_rule",
        "calibrated",
        "m",
        "k_horizon",
        "angle_deg",
        "branch",
        "omega_squared_relative_error",
        "smooth_part",
        "irregular_part",
    ];
    let mut table = Table::new("volume_rules.csv", &columns);
    for (weights, seen) in asked.weights.iter().zip(seen) {
        for (index, &(m, error)) in seen.errors.iter().enumerate() {
            table.push(vec![
                place.case.clone().into(),
                weights.kernel.name().into(),
                weights.kernel.p().into(),
                weights.volume_rule.name().into(),
                weights.calibrated.into(),
                m.into(),
                asked.k_horizon.into(),
                asked.degrees.into(),
                asked.branch.name().into(),
                error.into(),
                seen.smooth.as_ref().map(|smooth| smooth[index]).into(),
                seen.irregular.as_ref().map(|irregular| irregular[index]).into(),
            ]);
        }
    }
    table
}

/// A panel for each volume rule: |e| over 1/m, and the smooth part of the law.
pub fn figure(asked: &VolumeRules, seen: &[Seen], place: &Place) -> Figure {
    let caption = format!(
        "Relative error of ω² of {} waves at kδ = {}, {}° to the lattice, against the nonlocal continuum, at every whole m. Lines: the smooth part of the law of large m.",
        asked.branch.name(),
        asked.k_horizon,
        asked.degrees
    );
    let mut figure = Figure::new(place.case.clone(), asked.title.clone(), caption, Lines::default());
    figure.panels.clear();
    for rule in VolumeRule::ALL {
        let mut series = Vec::new();
        let mine = asked.weights.iter().zip(seen).zip(asked.names());
        for (slot, ((weights, seen), name)) in
            mine.filter(|((w, _), _)| w.volume_rule == rule).take(7).enumerate()
        {
            let points = seen.errors.iter().map(|(m, error)| (1.0 / m, error.abs()));
            let marker = if weights.calibrated { Marker::Cross } else { Marker::Circle };
            series.push(Series::markers(name, points.collect()).slot(slot).marker(marker));
            if let Some(smooth) = &seen.smooth {
                let line = asked.m.iter().zip(smooth).map(|(m, smooth)| (1.0 / m, smooth.abs()));
                series.push(Series::line("", line.collect()).slot(slot).dash(Dash::Dashed).width(1.2));
            }
        }
        if series.is_empty() {
            continue;
        }
        let order = if rule == VolumeRule::Full { 1.5 } else { 2.0 };
        let panel = Lines::new(Axis::log("1/m = Δx/δ"), Axis::log("|error| of ω²"), series)
            .titled(format!("{} volumes", rule.name().replace('_', " ")))
            .guide(Guide::Slope { order, label: format!("order {order}") });
        figure = figure.panel(panel);
    }
    figure
}
