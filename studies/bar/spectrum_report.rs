//! Table and figure of a released bar's spectrum.

use super::names::{LATTICE, lattice_cells};
use super::released::STRAIN;
use super::spectrum::{Heard, Mode, Spectrum};
use crate::question::Place;
use pd_verify::report::plot::{Axis, Figure, Guide, Lines, Series};
use pd_verify::table::{Cell, Table};
use std::f64::consts::TAU;

/// A row per mode.
pub fn table(spectrum: &Spectrum, heard: &[Heard], place: &Place) -> Table {
    let own = [
        "k_per_m",
        "omega_over_v_measured_per_m",
        "omega_over_v_predicted_per_m",
        "mode_error_measured",
        "mode_error_predicted",
    ];
    let mut table = Table::new("bar_spectrum.csv", &[&["case"][..], &LATTICE, &own].concat());
    for ((scene, _), heard) in spectrum.scenes.iter().zip(heard) {
        let cells = lattice_cells(Some((scene.lattice, scene.spacing)));
        for mode in &heard.modes {
            let start: Vec<Cell> = vec![place.case.clone().into()];
            let own: [Cell; 5] = [
                mode.k.into(),
                mode.measured.into(),
                mode.predicted.into(),
                mode.error.into(),
                mode.predicted_error.into(),
            ];
            table.push(start.into_iter().chain(cells.clone()).chain(own).collect::<Vec<_>>());
        }
    }
    table
}

/// Spectrum of the strain, error by wavenumber, dispersion, over the same axis.
pub fn figure(spectrum: &Spectrum, heard: &[Heard], place: &Place) -> Figure {
    let panel = |title: &str, x: &str, y: Axis, series| Lines::new(Axis::linear(x), y, series).titled(title);
    let caption = "Amplitudes in the strain's history, the root mean square error of each mode over the run, and the \
                   frequencies measured in the march on the dispersion curves.";
    Figure::new(
        place.case.clone(),
        spectrum.title.clone(),
        caption,
        panel(
            "Amplitudes of the strain's history: nothing above the lattice's highest frequency",
            "ω/v (1/m)",
            Axis::log("amplitude / (F₀/EA)"),
            sounds(spectrum, heard),
        ),
    )
    .panel(
        Lines::new(Axis::log("k (1/m)"), Axis::log("rms error / amplitude"), errors(spectrum, heard))
            .titled("Error of each mode over the run")
            .guide(Guide::Slope { order: 3.0, label: "order 3".into() }),
    )
    .panel(panel("Speed of each mode", "k (1/m)", Axis::linear("ω / (vk)"), speeds(spectrum, heard)))
}

/// Frequencies at which the history is looked at, and samples of it, about.
const FREQUENCIES: usize = 500;
const SAMPLES: usize = 4000;

fn sounds(spectrum: &Spectrum, heard: &[Heard]) -> Vec<Series> {
    let speed = spectrum.bar.exact.speed;
    let highest = heard.iter().flat_map(|h| &h.modes).map(|mode| mode.predicted).fold(0.0, f64::max);
    let over = |times: &[f64], strains: &[f64]| -> Vec<(f64, f64)> {
        let count = times.len() as f64;
        let windowed: Vec<(f64, f64)> = times
            .iter()
            .zip(strains)
            .enumerate()
            .map(|(n, (&t, strain))| (t, strain * (1.0 - libm::cos(TAU * n as f64 / count))))
            .collect();
        let amplitude = |at: usize| {
            let wave = 1.05 * highest * (at as f64 + 0.5) / FREQUENCIES as f64;
            let omega = wave * speed;
            let part =
                |of: fn(f64) -> f64| windowed.iter().map(|(t, e)| e * of(omega * t)).sum::<f64>() / count;
            (wave, 2.0 * part(libm::cos).hypot(part(libm::sin)))
        };
        (0..FREQUENCIES).map(amplitude).collect()
    };
    let mut series = Vec::new();
    for (slot, (heard, label)) in heard.iter().zip(&spectrum.labels).enumerate() {
        let Some(trace) = heard.record.trace(STRAIN) else { continue };
        let step = (trace.times.len() / SAMPLES).max(1);
        let times: Vec<f64> = trace.times.iter().step_by(step).copied().collect();
        let place = trace.columns[0].at.as_deref().map_or(f64::NAN, |at| at[0]);
        let scale = spectrum.bar.exact.strain;
        if series.is_empty() {
            let exact: Vec<f64> =
                times.iter().map(|&t| spectrum.bar.exact.strain_at(place, t) / scale).collect();
            series.push(Series::reference("exact", over(&times, &exact)).width(1.2));
        }
        let strains: Vec<f64> = trace.column(0).iter().step_by(step).map(|strain| strain / scale).collect();
        series.push(Series::line(label.clone(), over(&times, &strains)).slot(slot).width(1.2));
    }
    series
}

/// Of the modes that the looks resolve: predicted as lines, measured as markers equally far apart on the axis.
fn errors(spectrum: &Spectrum, heard: &[Heard]) -> Vec<Series> {
    let mut series = Vec::new();
    for (slot, (heard, label)) in heard.iter().zip(&spectrum.labels).enumerate() {
        let modes: Vec<&Mode> = heard.modes.iter().filter(|mode| mode.k < 0.9 * heard.resolved).collect();
        let line = modes.iter().map(|mode| (mode.k, mode.predicted_error)).collect();
        series.push(Series::line(label.clone(), line).slot(slot).width(1.4));
        let mut next = 0.0;
        let mut markers = Vec::new();
        for mode in modes {
            if mode.k >= next {
                markers.push((mode.k, mode.error));
                next = 1.25 * mode.k;
            }
        }
        series.push(Series::markers(format!("{label}, measured"), markers).slot(slot));
    }
    series
}

/// Predicted as lines, measured as some forty markers.
fn speeds(spectrum: &Spectrum, heard: &[Heard]) -> Vec<Series> {
    let mut series = Vec::new();
    for (slot, (heard, label)) in heard.iter().zip(&spectrum.labels).enumerate() {
        let points = |step: usize, of: fn(&Mode) -> f64| -> Vec<(f64, f64)> {
            heard.modes.iter().step_by(step).map(|mode| (mode.k, of(mode) / mode.k)).collect()
        };
        series.push(Series::line(label.clone(), points(1, |mode| mode.predicted)).slot(slot).width(1.4));
        let markers = points((heard.modes.len() / 40).max(1), |mode| mode.measured);
        series.push(Series::markers(format!("{label}, measured"), markers).slot(slot));
    }
    let end = heard.iter().flat_map(|h| &h.modes).map(|mode| mode.k).fold(0.0, f64::max);
    series.push(Series::reference("exact", vec![(0.0, 1.0), (end, 1.0)]).width(1.2));
    series
}
