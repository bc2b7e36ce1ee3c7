//! Rows of `dsif_history.csv` and `dsif_errors.csv`, and the figures of a case: histories with the window shaded, errors
//! over the spacing, the field around the tip.

use super::errors;
use super::intensity::{Found, Intensity, Read, UnitName};
use super::setup::Setup;
use crate::bar::names::{LATTICE, lattice_cells};
use crate::question::Place;
use pd_verify::report::plot::{Axis, Band, Colour, Dash, Figure, Guide, Lines, Panel, Raster, Series};
use pd_verify::table::{Cell, Row, Table};
use std::sync::Arc;

/// Curves that one panel can show.
const DRAWN: usize = 8;

/// Rows of all looks of all histories, the published reference beside the one that judges.
pub fn histories(intensity: &Intensity, found: &Found, place: &Place) -> Table {
    let mut table = table("dsif_history.csv");
    each(intensity, found, |setup, index, read| {
        let extraction = &intensity.extractions[index];
        let ring = extraction.radii(setup.tip.horizon);
        let mode = intensity.load.mode;
        let unit = intensity.unit_of(setup);
        let [kernel, p, m, dx, rule, calibrated] = lattice(setup);
        let factor = read.factors.filter(|_| extraction.tip_factor).map(|factors| factors[mode.index()]);
        let shared: Arc<[Cell]> = [
            place.case.as_str().into(),
            mode.word().into(),
            kernel,
            p,
            m,
            dx,
            rule,
            calibrated,
            extraction.method.word().into(),
            extraction.terms().into(),
            ring.map(|ring| ring.inner).into(),
            ring.map(|ring| ring.outer).into(),
        ]
        .into();
        for (t, k) in read.times.iter().zip(&read.k) {
            let k = k[mode.index()];
            let mut row = |name: &str, known: Option<f64>| {
                let own: Vec<Cell> = vec![
                    (*t).into(),
                    k.into(),
                    name.into(),
                    known.into(),
                    (k / unit).into(),
                    known.map(|known| known / unit).into(),
                    intensity.window.holds(*t).into(),
                    extraction.name.as_str().into(),
                    factor.into(),
                ];
                table.push(Row::of_block(&shared, own));
            };
            row(intensity.known.word(), intensity.known.at(*t, read.a));
            if let Some(published) = intensity.known.published_at(*t) {
                row("published", Some(published));
            }
        }
    });
    table
}

/// An empty table of histories.
pub fn table(file: &str) -> Table {
    let columns = [
        "case",
        "mode",
        "kernel",
        "p",
        "m",
        "dx_m",
        "volume_rule",
        "calibrated",
        "extraction",
        "terms",
        "r_min_m",
        "r_max_m",
        "t_s",
        "k_pa_sqrt_m",
        "reference",
        "k_reference_pa_sqrt_m",
        "k_normalized",
        "k_reference_normalized",
        "in_window",
        "reading",
        "tip_factor",
    ];
    Table::new(file, &columns)
}

/// kernel, p, m, Δx, volume rule and calibration of a lattice.
fn lattice(setup: &Setup) -> [Cell; LATTICE.len()] {
    let mut cells = lattice_cells(Some((setup.lattice, setup.scene.spacing))).into_iter();
    std::array::from_fn(|_| cells.next().unwrap_or(Cell::Empty))
}

fn each(intensity: &Intensity, found: &Found, mut act: impl FnMut(&Setup, usize, &Read)) {
    for (track, levels) in intensity.tracks.iter().zip(&found.reads) {
        for (setup, reads) in track.setups.iter().zip(levels) {
            for (index, read) in reads.iter().enumerate() {
                act(setup, index, read);
            }
        }
    }
}

/// A row of errors for every history.
pub fn errors(intensity: &Intensity, found: &Found, place: &Place) -> Table {
    let mut columns = vec!["case", "mode"];
    columns.extend(LATTICE);
    columns.extend([
        "reading",
        "extraction",
        "terms",
        "r_min_m",
        "r_max_m",
        "tip_factor",
        "divided_by_it",
        "condition",
    ]);
    columns.extend(["rms", "max", "mean", "l2", "peak", "moved"]);
    let mut table = Table::new("dsif_errors.csv", &columns);
    each(intensity, found, |setup, index, read| {
        let extraction = &intensity.extractions[index];
        let ring = extraction.radii(setup.tip.horizon);
        let mode = intensity.load.mode;
        let condition = extraction.prepare(&setup.tip, &setup.elastic).ok().and_then(|one| one.condition);
        let found = errors::of(intensity, read);
        let mut row: Vec<Cell> = vec![place.case.as_str().into(), mode.word().into()];
        row.extend(lattice(setup));
        row.extend([
            extraction.name.as_str().into(),
            extraction.method.word().into(),
            extraction.terms().into(),
            ring.map(|ring| ring.inner).into(),
            ring.map(|ring| ring.outer).into(),
            read.factors.map(|factors| factors[mode.index()]).into(),
            extraction.tip_factor.into(),
            condition.into(),
            found.map(|errors| errors.rms).into(),
            found.map(|errors| errors.max).into(),
            found.map(|errors| errors.mean).into(),
            found.map(|errors| errors.l2).into(),
            found.map(|errors| errors.peak).into(),
            setup.plate.moved.as_str().into(),
        ]);
        table.push(row);
    });
    table
}

/// Histories at the finest level; errors over the spacing; the field.
pub fn figures(intensity: &Intensity, found: &Found, place: &Place) -> Vec<Figure> {
    let mut figures = vec![history(intensity, found, place)];
    if intensity.tracks.iter().any(|track| track.setups.len() > 1) {
        figures.push(convergence(intensity, found, place));
    }
    figures.extend(field(intensity, found, place));
    figures
}

/// What is drawn: every extraction of one kind of weights, or the first of several.
fn drawn(intensity: &Intensity) -> Vec<(usize, usize, String)> {
    let single = intensity.tracks.len() == 1;
    let name = |track: usize, index: usize| {
        let reading = intensity.extractions[index].name.replace('_', " ");
        match (single, intensity.extractions.len()) {
            (true, _) => reading,
            (false, 1) => intensity.tracks[track].name.clone(),
            (false, _) => format!("{}, {reading}", intensity.tracks[track].name),
        }
    };
    let all = (0..intensity.tracks.len())
        .flat_map(|track| (0..intensity.extractions.len()).map(move |index| (track, index)));
    all.map(|(track, index)| (track, index, name(track, index))).collect()
}

fn band(intensity: &Intensity, scale: f64) -> Band {
    let window = intensity.window;
    Band { from: window.from / scale, to: window.to / scale, label: "judged".into() }
}

fn history(intensity: &Intensity, found: &Found, place: &Place) -> Figure {
    let all = drawn(intensity);
    let setup = &intensity.tracks[0].setups[intensity.tracks[0].setups.len() - 1];
    let (unit, mode) = (intensity.unit_of(setup), intensity.load.mode);
    let micro = 1e-6;
    let x = || Axis::linear("t (µs)").range(0.0, intensity.window.to / micro);
    let finest = |track: usize, index: usize| found.reads[track].last().map(|reads| &reads[index]);
    let (mut curves, mut errors) = (Vec::new(), Vec::new());
    let times = || finest(0, 0).map(|read| read.times.as_slice()).unwrap_or_default().iter().copied();
    let known = |of: &dyn Fn(f64) -> Option<f64>| -> Vec<(f64, f64)> {
        times().filter_map(|t| Some((t / micro, of(t)? / unit))).collect()
    };
    curves.push(Series::reference("exact", known(&|t| intensity.known.at(t, setup.plate.a()))));
    let published = known(&|t| intensity.known.published_at(t));
    if !published.is_empty() {
        curves.push(Series::line("published reference", published).colour(Colour::Black).dash(Dash::Dashed));
    }
    for (slot, (track, index, name)) in all.iter().take(DRAWN).enumerate() {
        let Some(read) = finest(*track, *index) else { continue };
        let k = |(t, k): (&f64, &[f64; 2])| (t / micro, k[mode.index()] / unit);
        curves.push(Series::line(name.clone(), read.times.iter().zip(&read.k).map(k).collect()).slot(slot));
        if let Some(pairs) = errors::pairs(intensity, read) {
            let peak = pairs.iter().map(|pair| pair.1.abs()).fold(0.0, f64::max);
            let inside = read.times.iter().filter(|t| intensity.window.holds(**t));
            let far = inside.zip(&pairs).map(|(t, (k, known))| (t / micro, 100.0 * (k - known) / peak));
            errors.push(Series::line("", far.collect()).slot(slot));
        }
    }
    let label = match intensity.unit {
        UnitName::Height => "σ₀√H",
        UnitName::Crack => "σ₀√(πa)",
    };
    let mut upper = Lines::new(x(), Axis::linear(format!("K_{}/({label})", mode.word())), curves);
    upper.bands = vec![band(intensity, micro)];
    let mut lower = Lines::new(x(), Axis::linear("error (% of the largest K)"), errors);
    lower.bands = vec![band(intensity, micro)];
    lower.guides = vec![Guide::Horizontal { at: 0.0, label: String::new() }];
    let mut caption = format!(
        "K of mode {} at the finest level, cells of {:.4} mm, and what it is beyond the reference, in the window that is judged; the reference holds until {}.",
        mode.word(),
        1e3 * setup.scene.spacing,
        intensity.ends
    );
    if all.len() > DRAWN {
        caption += &format!(" {} more histories are in dsif_history.csv.", all.len() - DRAWN);
    }
    Figure::new(place.case.clone(), intensity.title.clone(), caption, upper).panel(lower)
}

fn convergence(intensity: &Intensity, found: &Found, place: &Place) -> Figure {
    let step = |setup: &Setup| if intensity.by_m { 1.0 / setup.lattice.m } else { setup.scene.spacing };
    let mut series = Vec::new();
    for (slot, (track, index, name)) in drawn(intensity).into_iter().take(DRAWN).enumerate() {
        let setups = &intensity.tracks[track].setups;
        let levels = setups.iter().zip(&found.reads[track]);
        let points = levels.filter_map(|(setup, reads)| {
            Some((step(setup), 100.0 * errors::of(intensity, &reads[index])?.rms))
        });
        series.push(Series::both(name, points.collect()).slot(slot));
    }
    let x = if intensity.by_m { Axis::log("1/m = Δx/δ") } else { Axis::log("Δx (m)") };
    let mut lines = Lines::new(x, Axis::log("rms error (% of the largest K)"), series);
    if !intensity.by_m {
        lines = lines.guide(Guide::Slope { order: 1.0, label: "order 1".into() });
    }
    let caption = "Root mean square of the error in the window over the largest K of the reference there.";
    Figure::new(
        format!("{}-convergence", place.case),
        format!("{}: error by level", intensity.title),
        caption,
        lines,
    )
}

/// Displacement around the finest tip of the first weights at the last look.
fn field(intensity: &Intensity, found: &Found, place: &Place) -> Option<Figure> {
    let (half, field) = (intensity.field?, found.field.as_ref()?);
    let setup = intensity.tracks[0].setups.last()?;
    let sites = setup.tip.sites;
    let rows = |component: usize| -> Vec<Vec<Option<f64>>> {
        let row = |j: usize| (0..sites.nodes[0]).map(move |i| j * sites.nodes[0] + i);
        (0..sites.nodes[1]).map(|j| row(j).map(|node| Some(1e6 * field[node][component])).collect()).collect()
    };
    let range = |axis: usize| {
        let low = sites.first[axis] - 0.5 * sites.spacing;
        (low, low + sites.nodes[axis] as f64 * sites.spacing)
    };
    let panel = |component: usize, name: &str| -> Panel {
        let values = rows(component);
        let all = || values.iter().flatten().flatten();
        let mean = all().sum::<f64>() / all().count() as f64;
        let values: Vec<Vec<Option<f64>>> =
            values.iter().map(|row| row.iter().map(|u| u.map(|u| u - mean)).collect()).collect();
        let most = values.iter().flatten().flatten().map(|u| u.abs()).fold(0.0, f64::max);
        let [x, y] = [0, 1].map(range);
        let axis = |name: &str, (from, to)| Axis::linear(name).range(from, to);
        Raster::new(axis("x − tip (m)", x), axis("y (m)", y), Axis::linear(name).range(-most, most), values)
            .diverging(0.0)
            .to_scale()
            .into()
    };
    let caption = format!(
        "Displacement of the nodes at least {half} m around the tip at the end of the window, less its mean; {}.",
        intensity.tracks[0].name
    );
    let title = format!("{}: the field around the tip", intensity.title);
    let figure = Figure::new(format!("{}-field", place.case), title, caption, panel(0, "u along x (µm)"));
    Some(figure.panel(panel(1, "u along y (µm)")).columns(2))
}
