//! Tables and figures of a refined pulse: errors by horizon and by time step, and the pulse beside the exact one.

use super::names::{LATTICE, lattice_cells};
use super::pulse::{FLOOR, Pulse, Refinement, Seen};
use crate::levels;
use crate::question::Place;
use pd_verify::report::plot::{Axis, Colour, Figure, Guide, Lines, Marker, Series};
use pd_verify::table::{Cell, Table};

/// Curves that one panel can show.
const DRAWN: usize = 7;
/// The norm that figures show.
const L2: usize = 1;

pub fn tables(pulse: &Pulse, seen: &[Seen], place: &Place) -> Vec<Table> {
    let mut by_spacing = levels::table("bar_convergence.csv");
    let own = ["time_step_s", "time_step_over_limit", "norm", "error", "pairwise_order"];
    let mut by_step = Table::new("bar_time_steps.csv", &[&["case"][..], &LATTICE, &own].concat());
    for (one, seen) in pulse.refinements.iter().zip(seen) {
        let at = |level: usize| (one.lattice, one.by_spacing[level].scene.spacing);
        levels::push(&mut by_spacing, "delta", &place.case, &seen.by_spacing, at);
        for (norm, name) in levels::NORMS.iter().enumerate() {
            let errors = seen.by_time_step.in_norm(norm);
            for (level, march) in one.by_time_step.iter().enumerate() {
                let start: [Cell; 1] = [place.case.clone().into()];
                let own: [Cell; 5] = [
                    march.plan.time_step_s.into(),
                    march.plan.time_step_over_limit.into(),
                    (*name).into(),
                    errors[level].1.into(),
                    levels::pairwise(&errors, level).into(),
                ];
                let lattice = lattice_cells(Some((one.lattice, march.scene.spacing)));
                by_step.push(start.into_iter().chain(lattice).chain(own).collect::<Vec<_>>());
            }
        }
    }
    vec![by_spacing, by_step]
}

pub fn figures(pulse: &Pulse, seen: &[Seen], place: &Place) -> Vec<Figure> {
    vec![convergence(pulse, seen, place), shape(pulse, seen, place), time_steps(pulse, seen, place)]
}

/// Error over δ: a panel for lattices whose long waves have the right speed, one for the others.
fn convergence(pulse: &Pulse, seen: &[Seen], place: &Place) -> Figure {
    let mut panels = Vec::new();
    for converges in [true, false] {
        let mine: Vec<(&Refinement, &Seen)> =
            pulse.refinements.iter().zip(seen).filter(|(one, _)| one.converges() == converges).collect();
        if mine.is_empty() {
            continue;
        }
        let curve = |(one, seen): &(&Refinement, &Seen)| {
            let errors = seen.by_spacing.in_norm(L2).into_iter();
            Series::both(one.name.clone(), errors.map(|(h, error)| (one.lattice.m * h, error)).collect())
        };
        let mut series: Vec<Series> = mine.iter().take(DRAWN).map(curve).collect();
        let title = match converges {
            true => "long waves at the speed √(E/ρ): calibrated, or exact as printed",
            false => "as printed, long waves at another speed",
        };
        if !converges {
            let predicted = mine.iter().take(DRAWN).map(|(one, seen)| {
                let finest = seen.by_spacing.levels[seen.by_spacing.levels.len() - 1].0;
                (one.lattice.m * finest, seen.predicted[L2])
            });
            let label = "predicted from the long-wave speed";
            let marks = Series::markers(label, predicted.collect());
            series.push(marks.colour(Colour::Black).marker(Marker::Plus));
        }
        let mut panel = Lines::new(Axis::log("δ (m)"), Axis::log("error in L2"), series).titled(title);
        if converges {
            panel = panel.guide(Guide::Slope { order: 2.0, label: "order 2".into() });
        }
        panels.push(panel);
    }
    let left_out =
        seen.iter().flat_map(|seen| seen.by_spacing.in_norm(L2)).filter(|(_, error)| *error <= FLOOR);
    let left_out = match left_out.count() {
        0 => String::new(),
        count => format!(" {count} levels lie at the round-off floor of {FLOOR:e} and carry no order."),
    };
    let caption = format!(
        "Displacement error in L2 over the bar and {} times up to {} s, relative to the exact displacement, at fixed m and fixed vΔt/Δx.{left_out}",
        pulse.looks, pulse.duration
    );
    let mut figure = Figure::new(place.case.clone(), pulse.title.clone(), caption, Lines::default());
    figure.panels = panels.into_iter().map(Into::into).collect();
    figure
}

/// The pulse at the last look: exact, and the first lattice of each kind at two levels.
fn shape(pulse: &Pulse, seen: &[Seen], place: &Place) -> Figure {
    let bar = &pulse.bar.exact;
    const SAMPLES: usize = 600;
    let exact = (0..=SAMPLES).map(|n| bar.length * n as f64 / SAMPLES as f64);
    let exact = exact.map(|x| (x, bar.displacement_at(x, pulse.duration))).collect();
    let mut series = vec![Series::reference("exact", exact)];
    for converges in [true, false] {
        let first = pulse.refinements.iter().zip(seen).find(|(one, _)| one.converges() == converges);
        let Some((one, seen)) = first else { continue };
        for level in [0, one.by_spacing.len() - 1] {
            let march = &one.by_spacing[level];
            let points = seen.last[level].iter().enumerate().map(|(j, u)| (march.place(j), *u));
            let label = format!("{}, {} cells", one.name, march.nodes());
            series.push(Series::line(label, points.collect()).width(1.6));
        }
    }
    let panel = Lines::new(Axis::linear("x (m)"), Axis::linear("displacement / height of the pulse"), series);
    let caption = format!(
        "Displacement at {} s, after both halves of the pulse have been reflected, of the coarsest and the finest level.",
        pulse.duration
    );
    let title = format!("{}: shape", pulse.title);
    Figure::new(format!("{}-shape", place.case), title, caption, panel)
}

/// What a caption says where a panel does not show all lattices.
fn drawn(count: usize) -> String {
    if count > DRAWN { format!(" Shown: the first {DRAWN} of {count} lattices.") } else { String::new() }
}

/// The difference that leapfrog makes, over Δt.
fn time_steps(pulse: &Pulse, seen: &[Seen], place: &Place) -> Figure {
    let curve = |(one, seen): (&Refinement, &Seen)| {
        let limits = one.by_time_step.iter().map(|march| march.plan.time_step_over_limit);
        let points = limits.zip(seen.by_time_step.in_norm(L2)).map(|(over, (_, error))| (over, error));
        Series::both(one.name.clone(), points.collect())
    };
    let series = pulse.refinements.iter().zip(seen).take(DRAWN).map(curve).collect();
    let panel = Lines::new(Axis::log("Δt / limit"), Axis::log("difference in L2"), series)
        .guide(Guide::Slope { order: 2.0, label: "order 2".into() });
    let spacing = pulse.refinements.first().map_or(f64::NAN, |one| one.by_time_step[0].scene.spacing);
    let caption = format!(
        "Difference in L2 from the exact motion of the same lattice in exact time, over the time step, at Δx = {spacing} m.{}",
        drawn(pulse.refinements.len())
    );
    let title = format!("{}: time step", pulse.title);
    Figure::new(format!("{}-time-step", place.case), title, caption, panel)
}
