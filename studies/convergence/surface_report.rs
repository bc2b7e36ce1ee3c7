//! Rows and figure of the surface effect: errors over δ and their coefficients, by which corrections are compared.

use super::surface::{Pulled, Surface, Top, Track, called};
use crate::bar::names::{LATTICE, lattice_cells};
use crate::dispersion::sweep::distinct;
use crate::levels;
use crate::question::Place;
use pd_verify::forces::surface::Correction;
use pd_verify::report::plot::{Axis, Dash, Figure, Guide, Lines, Marker, Series};
use pd_verify::table::{Cell, Table};

/// Lattices that are drawn, two panels for each.
const DRAWN: usize = 2;

/// Rows of `surface_effect.csv`: errors times L/δ.
pub fn tables(surface: &Surface, pulled: &[Vec<Pulled>], place: &Place) -> Vec<Table> {
    let own = [
        "correction",
        "horizon_m",
        "side_over_horizon",
        "l1_over_share",
        "l2_over_share",
        "linf_over_share",
        "softness_over_share",
        "pairwise_order_l1",
        "pairwise_order_l2",
        "pairwise_order_linf",
    ];
    let mut table = Table::new("surface_effect.csv", &[&["case"][..], &LATTICE, &own].concat());
    for (track, pulled) in surface.tracks.iter().zip(pulled) {
        let refinement = track.refinement(pulled);
        let norms: Vec<_> = (0..3).map(|norm| refinement.in_norm(norm)).collect();
        for (index, (level, one)) in track.sequence.levels.iter().zip(pulled).enumerate() {
            let horizon = track.sequence.step(*level);
            let share = horizon / surface.side;
            let start: [Cell; 1] = [place.case.clone().into()];
            let mut row: Vec<Cell> = start.to_vec();
            row.extend(lattice_cells(Some((track.sequence.lattice(*level), level.spacing))));
            row.extend([track.correction.name().into(), horizon.into(), (1.0 / share).into()]);
            row.extend(one.errors.iter().map(|error| Cell::from(error / share)));
            row.push((one.softness / share).into());
            row.extend(norms.iter().map(|levels| Cell::from(levels::pairwise(levels, index))));
            table.push(row);
        }
    }
    vec![table]
}

/// For each of the first lattices: the error in L2 over δ, and the largest error over δ/L against L/δ.
pub fn figure(surface: &Surface, pulled: &[Vec<Pulled>], place: &Place) -> Figure {
    let lattices = distinct(surface.tracks.iter().map(|track| track.name.clone()));
    let seen = match surface.top {
        Top::Free => {
            "A plate pulled at a free edge beside a free edge, at rest: order 1. The largest error over δ/L grows with ln(L/δ), straight lines here: a point force at the corner."
        }
        Top::Mirror => {
            "A plate pulled at a free edge between mirrors, at rest. The error, of order δ, is confined to within δ of the edge: order 3/2 in L2; the largest error over δ/L does not change."
        }
    };
    let mut caption = format!("{seen} {}", best(surface, pulled));
    if lattices.len() > DRAWN {
        caption += &format!(" {} more lattices are in surface_effect.csv.", lattices.len() - DRAWN);
    }
    let mut figure = Figure::new(place.case.clone(), surface.title.clone(), caption, Lines::default());
    figure.panels.clear();
    for name in lattices.iter().take(DRAWN) {
        let mine = || surface.tracks.iter().zip(pulled).filter(|(track, _)| track.name == *name);
        let by_horizon = mine().map(|(track, pulled)| {
            look(Series::both(called(track.correction), track.refinement(pulled).in_norm(1)), track)
        });
        let (order, label) = match surface.top {
            Top::Free => (1.0, "order 1"),
            Top::Mirror => (1.5, "order 3/2"),
        };
        let order = Guide::Slope { order, label: label.into() };
        let axes = (Axis::log("δ (m)"), Axis::log("error in L2"));
        figure =
            figure.panel(Lines::new(axes.0, axes.1, by_horizon.collect()).titled(name.clone()).guide(order));
        let corner = mine().map(|(track, pulled)| {
            let share =
                |(horizon, error): (f64, f64)| (surface.side / horizon, error * surface.side / horizon);
            let points = track.refinement(pulled).in_norm(2).into_iter().map(share).collect();
            look(Series::both(called(track.correction), points), track)
        });
        let axes = (Axis::log("L/δ"), Axis::linear("largest error over δ/L"));
        figure = figure.panel(Lines::new(axes.0, axes.1, corner.collect()).titled(name.clone()));
    }
    figure
}

/// The same look of a correction in every panel.
fn look(series: Series, track: &Track) -> Series {
    match track.correction {
        Correction::None => series.slot(0).dash(Dash::Solid).marker(Marker::Circle),
        Correction::Energy => series.slot(1).dash(Dash::Dashed).marker(Marker::Square),
        Correction::Volume => series.slot(2).dash(Dash::Dotted).marker(Marker::Triangle),
    }
}

/// Which correction leaves the smallest error of each lattice at the finest level, in the norm that tells: of order 1.
fn best(surface: &Surface, pulled: &[Vec<Pulled>]) -> String {
    let (norm, error) = match surface.top {
        Top::Free => (1, "Error in L2"),
        Top::Mirror => (2, "Largest error"),
    };
    let coefficient = |track: &Track, pulled: &[Pulled]| {
        let horizon = track.sequence.step(track.sequence.finest());
        pulled.last().map_or(f64::NAN, |one| one.errors[norm] * surface.side / horizon)
    };
    let lattices = distinct(surface.tracks.iter().map(|track| track.name.clone()));
    let said = lattices.iter().map(|name| {
        let mine = surface.tracks.iter().zip(pulled).filter(|(track, _)| track.name == *name);
        let of =
            |(track, pulled): (&Track, &Vec<Pulled>)| (called(track.correction), coefficient(track, pulled));
        let mut ranked: Vec<(&str, f64)> = mine.map(of).collect();
        ranked.sort_by(|a, b| a.1.total_cmp(&b.1));
        let listed: Vec<String> = ranked.iter().map(|(name, c)| format!("{name} {c:.3}")).collect();
        format!("{name}: {}", listed.join(", "))
    });
    format!("{error} times L/δ at the finest level: {}.", said.collect::<Vec<_>>().join("; "))
}
