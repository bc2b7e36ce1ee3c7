//! Rows and figures of patch tests: what is left of a field that should be kept, and the force that other moduli leave.

use super::framed::Field;
use super::patch::{Kept, Patch, Track, refinement};
use crate::bar::names::{LATTICE, lattice_cells};
use crate::levels;
use crate::question::Place;
use pd_verify::report::plot::{Axis, Colour, Figure, Lines, Marker, Series};
use pd_verify::table::{Cell, Table};

/// Curves that one panel can show.
const DRAWN: usize = 7;

/// Rows of `convergence.csv` and `patch.csv`.
pub fn tables(patch: &Patch, kept: &[Vec<Kept>], place: &Place) -> Vec<Table> {
    let own = [
        "field",
        "c11_over_intended",
        "c12_over_intended",
        "largest_difference",
        "force_y",
        "force_y_reference",
        "force_difference",
    ];
    let mut patches = Table::new("patch.csv", &[&["case"][..], &LATTICE, &own].concat());
    let mut errors = levels::table("convergence.csv");
    let field = match patch.field {
        Field::Strain => "strain",
        Field::Bending => "bending",
    };
    for (track, kept) in patch.tracks.iter().zip(kept) {
        let at = |level: usize| {
            let level = track.sequence.levels[level];
            (track.sequence.lattice(level), level.spacing)
        };
        levels::push(&mut errors, track.sequence.refine.word(), &place.case, &refinement(track, kept), at);
        for (level, one) in kept.iter().enumerate() {
            let start: [Cell; 1] = [place.case.clone().into()];
            let own: [Cell; 7] = [
                field.into(),
                track.moduli[level].c11.into(),
                track.moduli[level].c12.into(),
                one.far.into(),
                one.force.into(),
                one.residual.into(),
                one.force_far.into(),
            ];
            patches
                .push(start.into_iter().chain(lattice_cells(Some(at(level)))).chain(own).collect::<Vec<_>>());
        }
    }
    vec![errors, patches]
}

/// Errors at rest over the step; of bending also the force that is left.
pub fn figures(patch: &Patch, kept: &[Vec<Kept>], place: &Place) -> Vec<Figure> {
    let both = || patch.tracks.iter().zip(kept);
    let mut panels = Vec::new();
    for (title, keeps) in [("kept: rounding alone is left", true), ("other moduli than intended", false)] {
        let mine: Vec<_> = both().filter(|(track, _)| patch.keeps(track) == keeps).collect();
        if mine.is_empty() {
            continue;
        }
        let shown = mine.iter().take(DRAWN).enumerate();
        let series = shown.map(|(slot, (track, kept))| errors(track, kept).slot(slot)).collect();
        panels.push(Lines::new(Axis::log("δ (m)"), Axis::log("error in L2"), series).titled(title));
    }
    if patch.field == Field::Bending {
        let others: Vec<_> = both().filter(|(track, _)| !patch.keeps(track)).collect();
        if !others.is_empty() {
            panels.push(forces(&others));
        }
    }
    let left_out = patch.tracks.len().saturating_sub(DRAWN);
    let mut caption = match patch.field {
        Field::Strain => "Displacement at rest in a frame held at uniform strain, three strains together.".to_owned(),
        Field::Bending => "Displacement at rest in a frame held at bending in the plane, and the force of bonds in the exact field: with C₁₂ ≠ C₁₁/3 a force is left that no refinement takes away.".to_owned(),
    };
    if left_out > 0 {
        caption += " Panels show seven lattices at most; all are in convergence.csv.";
    }
    let mut figure = Figure::new(place.case.clone(), patch.title.clone(), caption, Lines::default());
    figure.panels = panels.into_iter().map(Into::into).collect();
    vec![figure]
}

fn errors(track: &Track, kept: &[Kept]) -> Series {
    Series::both(track.name.clone(), refinement(track, kept).in_norm(1))
}

/// The force left at the finest level over C₁₁κ by m, the reference's beside it.
fn forces(both: &[(&Track, &Vec<Kept>)]) -> Lines {
    let mut named: Vec<(String, Vec<(f64, f64)>)> = Vec::new();
    let mut exact = Vec::new();
    for (track, kept) in both {
        let Some(one) = kept.last() else { continue };
        let m = track.sequence.finest().m;
        let parts = track.name.split(", ").filter(|part| !part.starts_with("m = "));
        let name = parts.collect::<Vec<_>>().join(", ");
        exact.push((m, one.residual));
        match named.iter_mut().find(|(other, _)| *other == name) {
            Some((_, points)) => points.push((m, one.force)),
            None => named.push((name, vec![(m, one.force)])),
        }
    }
    let drawn = named.into_iter().take(DRAWN).enumerate();
    let mut series: Vec<Series> =
        drawn.map(|(slot, (name, points))| Series::markers(name, points).slot(slot)).collect();
    let exact = Series::markers("by the moduli", exact);
    series.push(exact.colour(Colour::Black).marker(Marker::Plus));
    Lines::new(Axis::linear("m = δ/Δx"), Axis::linear("force left over C₁₁κ"), series)
        .titled("force of bonds in the exact field")
}
