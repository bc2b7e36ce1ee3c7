//! Tables and figures of a released bar: histories beside the exact ones, and the errors of each lattice.

use super::jump::AWAY;
use super::names::{LATTICE, lattice_cells};
use super::release::{Release, Seen};
use super::released::{POINT, STRAIN};
use crate::question::Place;
use pd_verify::report::plot::{Axis, Category, Colour, Dash, Dots, Figure, Lines, Series};
use pd_verify::table::{Cell, Table};
use rayon::prelude::*;

/// Rows per curve and points per line, about.
const SHOWN: usize = 800;

/// A curve of the figure and of the tables.
pub struct Curve {
    name: String,
    lattice: Vec<Cell>,
    times: Vec<f64>,
    strains: Vec<f64>,
    displacements: Vec<f64>,
}

pub fn tables(release: &Release, seen: &[Seen], curves: &[Curve], place: &Place) -> Vec<Table> {
    let columns = |value| [&["curve"][..], &LATTICE, &["x_m", "t_s", value]].concat();
    let mut strain = Table::new("bar_strain.csv", &columns("strain"));
    let mut displacement = Table::new("bar_displacement.csv", &columns("displacement_m"));
    for curve in curves {
        // References keep their plain names; a lattice is told apart by its columns.
        let name = match curve.name.as_str() {
            "exact" | "fourier" => curve.name.clone(),
            modes if modes.starts_with("lattice_modes") => "lattice_modes".to_owned(),
            label => format!("{}/{label}", place.case),
        };
        for (n, &t) in curve.times.iter().enumerate() {
            let row = |value: f64| {
                let start: Vec<Cell> = vec![name.clone().into()];
                let end: [Cell; 3] = [release.place.into(), t.into(), value.into()];
                start.into_iter().chain(curve.lattice.clone()).chain(end).collect::<Vec<_>>()
            };
            strain.push(row(curve.strains[n]));
            displacement.push(row(curve.displacements[n]));
        }
    }
    vec![strain, displacement, errors(release, seen, place)]
}

fn errors(release: &Release, seen: &[Seen], place: &Place) -> Table {
    let own = [
        "l1_error",
        "l2_error",
        "max_error_away_from_fronts",
        "overshoot",
        "arrival_s",
        "front_speed_over_classical",
        "lattice_speed_over_classical",
        "error_against_leapfrog_modes",
        "error_against_modes_in_exact_time",
        "time_step_s",
        "time_step_over_limit",
    ];
    let mut table = Table::new("bar_errors.csv", &[&["case"][..], &LATTICE, &own].concat());
    for ((scene, plan), seen) in release.scenes.iter().zip(seen) {
        let start: Vec<Cell> = vec![place.case.clone().into()];
        let own: [Cell; 11] = [
            seen.errors.l1.into(),
            seen.errors.l2.into(),
            seen.errors.away.into(),
            seen.errors.overshoot.into(),
            seen.errors.arrival.into(),
            seen.front_speed.into(),
            seen.lattice_speed.into(),
            seen.modes.into(),
            seen.exact_time.into(),
            plan.time_step_s.into(),
            plan.time_step_over_limit.into(),
        ];
        let cells = lattice_cells(Some((scene.lattice, scene.spacing)));
        table.push(start.into_iter().chain(cells).chain(own).collect::<Vec<_>>());
    }
    table
}

/// The exact curve, its series, then for each lattice the march and the lattice's modes in exact time.
pub fn curves(release: &Release, seen: &[Seen]) -> Vec<Curve> {
    let lattices: Vec<(usize, &Seen)> = seen.iter().enumerate().collect();
    let marched: Vec<Vec<Curve>> =
        lattices.into_par_iter().map(|(index, seen)| of_lattice(release, index, seen)).collect();
    let times = marched.iter().flatten().next().map_or(Vec::new(), |curve| curve.times.clone());
    let known = |name: &str, strain: &dyn Fn(f64) -> f64, displacement: &dyn Fn(f64) -> f64| Curve {
        name: name.into(),
        lattice: lattice_cells(None),
        strains: times.iter().map(|&t| strain(t)).collect(),
        displacements: times.iter().map(|&t| displacement(t)).collect(),
        times: times.clone(),
    };
    let (bar, x, terms) = (&release.bar.exact, release.place, release.terms);
    let exact = known("exact", &|t| bar.strain_at(x, t), &|t| bar.displacement_at(x, t));
    let series =
        known("fourier", &|t| bar.fourier_strain(x, t, terms), &|t| bar.fourier_displacement(x, t, terms));
    [exact, series].into_iter().chain(marched.into_iter().flatten()).collect()
}

/// What one lattice did, and its modes in exact time where the probe stands on a cell face.
fn of_lattice(release: &Release, index: usize, seen: &Seen) -> Vec<Curve> {
    let (Some(strain), Some(point)) = (seen.record.trace(STRAIN), seen.record.trace(POINT)) else {
        return Vec::new();
    };
    let (scene, label) = (&release.scenes[index].0, &release.labels[index]);
    let step = (strain.times.len() / SHOWN).max(1);
    let thin = |values: Vec<f64>| values.into_iter().step_by(step).collect::<Vec<f64>>();
    let times = thin(strain.times.clone());
    let lattice = lattice_cells(Some((scene.lattice, scene.spacing)));
    let mut curves = vec![Curve {
        name: label.clone(),
        lattice: lattice.clone(),
        times: times.clone(),
        strains: thin(strain.column(0)),
        displacements: thin(point.column(0)),
    }];
    let face = release.place / scene.spacing;
    let inside = face.round() >= 1.0 && face.round() < scene.nodes[0] as f64;
    if let Some(modes) =
        release.bar.modes(scene, None).filter(|_| inside && (face - face.round()).abs() < 1e-9)
    {
        let cells: Vec<f64> = times.iter().map(|&t| release.bar.cell_times(scene, t)).collect();
        let face = face.round() as usize;
        let strains = modes.strain_history(face, &cells);
        let ends = [face - 1, face].map(|node| modes.displacement_history(node, &cells));
        let mean = ends[0].iter().zip(&ends[1]).map(|(a, b)| 0.5 * (a + b) * release.bar.peak());
        curves.push(Curve {
            name: format!("lattice_modes: {label}"),
            lattice,
            strains: strains.iter().map(|strain| release.bar.exact.strain * strain).collect(),
            displacements: mean.collect(),
            times,
        });
    }
    curves
}

/// Lattices that one figure can show.
const DRAWN: usize = 6;

pub fn figures(release: &Release, seen: &[Seen], curves: &[Curve], place: &Place) -> Vec<Figure> {
    let milli = |times: &[f64], values: &[f64], scale: f64| -> Vec<(f64, f64)> {
        times.iter().zip(values).map(|(t, value)| (1e3 * t, value / scale)).collect()
    };
    let panel = |what: &str, scale: f64, of: fn(&Curve) -> &Vec<f64>| {
        let shown =
            curves.iter().filter(|curve| curve.name != "fourier" && !curve.name.starts_with("lattice_modes"));
        let series = shown.take(DRAWN + 1).map(|curve| {
            let points = milli(&curve.times, of(curve), scale);
            match curve.name.as_str() {
                "exact" => Series::reference("exact", points),
                name => Series::line(name, points).width(1.4).dash(Dash::Solid),
            }
        });
        Lines::new(Axis::linear("time (ms)"), Axis::linear(what), series.collect())
    };
    let strain = release.bar.exact.strain;
    let speeds = release
        .labels
        .iter()
        .zip(seen)
        .take(DRAWN)
        .filter_map(|(label, seen)| seen.lattice_speed.map(|speed| format!("{label} at {speed:.4} v")));
    let lattice = release.scenes[0].0.lattice;
    let caption = format!(
        "Strain at {} m of a bar of {} m let go at t = 0, over F₀/(EA), and its displacement, against the exact solution; \
         {} nodes, m = {}, {} volumes{}. Long waves of the lattice run: {}.",
        release.place,
        release.bar.exact.length,
        release.scenes[0].0.nodes[0],
        lattice.m,
        lattice.volume_rule.name(),
        if lattice.calibrated { ", calibrated weights" } else { "" },
        speeds.collect::<Vec<_>>().join(", ")
    );
    let histories = Figure::new(
        place.case.clone(),
        release.title.clone(),
        caption,
        panel("strain / (F₀/EA)", strain, |curve| &curve.strains),
    )
    .panel(panel("displacement / (F₀L/EA)", release.bar.peak(), |curve| &curve.displacements));
    if seen.len() <= DRAWN {
        vec![histories, error_figure(release, seen, curves, place)]
    } else {
        vec![all_errors(release, seen, place)]
    }
}

/// The errors of more lattices than curves can tell apart: a row each.
fn all_errors(release: &Release, seen: &[Seen], place: &Place) -> Figure {
    let rows = |of: fn(&Seen) -> Option<f64>| -> Vec<Category> {
        let row =
            |(label, seen): (&String, &Seen)| Category::new(label.clone(), [of(seen).unwrap_or(f64::NAN)]);
        release.labels.iter().zip(seen).map(row).collect()
    };
    let dots = |label: &str, of| Dots::new(Axis::linear(label), vec!["marched".into()], rows(of));
    let l1 = dots("(1/T) ∫ |ε − exact| dt / (F₀/EA)", |seen| Some(seen.errors.l1));
    let overshoot = dots("overshoot behind the first front / jump", |seen| seen.errors.overshoot);
    let caption = "Mean error of the strain of each lattice, and how far it overshoots: the error is the kernel's and the \
                   weights', the overshoot is the Airy function's for all.";
    Figure::new(place.case.clone(), release.title.clone(), caption, l1)
        .panel(overshoot.reference(super::release::AIRY_OVERSHOOT, "Airy front 0.2744"))
}

/// |ε − ε_exact| over time: what disperses grows, what comes from a wrong speed drifts.
fn error_figure(release: &Release, seen: &[Seen], curves: &[Curve], place: &Place) -> Figure {
    let bar = &release.bar.exact;
    let running = |curve: &Curve| -> Vec<(f64, f64)> {
        let mut sum = 0.0;
        let errors = curve.times.iter().zip(&curve.strains).enumerate().map(|(n, (&t, strain))| {
            sum += (strain - bar.strain_at(release.place, t)).abs() / bar.strain;
            (1e3 * t, sum / (n + 1) as f64)
        });
        errors.collect()
    };
    let shown =
        curves.iter().filter(|curve| curve.name != "exact" && !curve.name.starts_with("lattice_modes"));
    let series = shown.take(DRAWN + 1).map(|curve| match curve.name.as_str() {
        "fourier" => Series::line(format!("Fourier series, {} terms", release.terms), running(curve))
            .colour(Colour::Black)
            .dash(Dash::Dotted),
        name => Series::line(name, running(curve)).width(1.6),
    });
    let panel = Lines::new(
        Axis::linear("time T (ms)"),
        Axis::linear("(1/T) ∫ |ε − exact| dt / (F₀/EA)"),
        series.collect(),
    );
    let quiet = seen.iter().filter_map(|seen| seen.errors.away).reduce(f64::max);
    let quiet = quiet.map_or(String::new(), |error| {
        format!(
            " Further than {AWAY} front widths, each (3βx)^(1/3) after a way x in a medium ω = ck(1 − βk²), from any exact \
             front the largest error is {error:.2}; an error near 1 is a front of the wrong speed."
        )
    });
    Figure::new(
        format!("{}-error", place.case),
        format!("{}: mean error so far", release.title),
        format!("Mean absolute error of the strain up to time T.{quiet}"),
        panel,
    )
}
