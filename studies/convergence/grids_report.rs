//! Rows and figure of grid convergence: values over Δx with the extrapolation and the band of every three grids.

use super::grids::{Followed, Grids};
use super::grids_said::extrapolated;
use crate::bar::names::{LATTICE, lattice_cells};
use crate::question::Place;
use pd_verify::compare::richardson::{Extrapolation, NoOrder};
use pd_verify::report::plot::{Axis, Dash, Figure, Guide, Lines, Marker, Series};
use pd_verify::table::{Cell, Table};

/// Curves that one panel can show.
const DRAWN: usize = 3;
/// How far beside its grid a bar stands, over the coarsest Δx.
const BESIDE: f64 = 0.012;

/// Rows of `grid_convergence.csv`; what three grids say stands with the finest of them.
pub fn table(grids: &Grids, followed: &[Followed], place: &Place) -> Table {
    let own =
        ["correction", "quantity", "value", "order", "extrapolated", "gci", "asymptotic_ratio", "no_order"];
    let mut table = Table::new("grid_convergence.csv", &[&["case"][..], &LATTICE, &own].concat());
    for (track, one) in grids.tracks.iter().zip(followed) {
        for (quantity, values) in grids.quantities.iter().zip(&one.values) {
            for (index, &(spacing, value)) in values.iter().enumerate() {
                let mut row: Vec<Cell> = vec![place.case.clone().into()];
                row.extend(lattice_cells(Some((
                    track.sequence.lattice(track.sequence.levels[index]),
                    spacing,
                ))));
                row.extend([track.correction.name().into(), quantity.word().into(), value.into()]);
                let said = (index >= 2).then(|| extrapolated(values, values.len() - 1 - index));
                row.extend(cells(said));
                table.push(row);
            }
        }
    }
    table
}

fn cells(said: Option<Result<Extrapolation, NoOrder>>) -> [Cell; 5] {
    match said {
        None => [Cell::Empty, Cell::Empty, Cell::Empty, Cell::Empty, Cell::Empty],
        Some(Err(none)) => [Cell::Empty, Cell::Empty, Cell::Empty, Cell::Empty, none.reason().into()],
        Some(Ok(found)) => [
            found.order.into(),
            found.value.into(),
            found.gci.into(),
            found.asymptotic_ratio.into(),
            Cell::Empty,
        ],
    }
}

/// A panel for each quantity: values, the bands of extrapolations at the finest grid that they are made of, the limit.
pub fn figure(grids: &Grids, followed: &[Followed], place: &Place) -> Figure {
    let mut caption = "Values over σL/C₁₁ by grid. Upright bars beside a grid: extrapolation of the three grids that end there, with its GCI; broken line: that of the three finest through them to Δx = 0.".to_owned();
    if grids.tracks.len() > DRAWN {
        caption += &format!(" {} more lattices are in grid_convergence.csv.", grids.tracks.len() - DRAWN);
    }
    let mut figure = Figure::new(place.case.clone(), grids.title.clone(), caption, Lines::default());
    figure.panels.clear();
    let notched = followed.first().is_some_and(|_| grids.quantities.iter().any(|one| one.exact().is_none()));
    for (index, quantity) in grids.quantities.iter().enumerate() {
        let mut series = Vec::new();
        for (slot, (track, one)) in grids.tracks.iter().zip(followed).take(DRAWN).enumerate() {
            let values = &one.values[index];
            series.push(Series::markers(track.name.clone(), values.clone()).slot(slot));
            series.extend(
                through(values).map(|line| Series::line("", line).slot(slot).dash(Dash::Dashed).width(1.2)),
            );
            for before in 0..values.len().saturating_sub(2) {
                series.extend(bar(values, before, slot).into_iter().map(|one| one.slot(slot)));
            }
        }
        let mut panel =
            Lines::new(Axis::linear("Δx (m)").including(0.0), Axis::linear(label(quantity.word())), series);
        if let (false, Some(exact)) = (notched, quantity.exact()) {
            panel = panel.guide(Guide::Horizontal { at: exact, label: "exact".into() });
        }
        figure = figure.panel(panel);
    }
    figure
}

fn label(word: &str) -> String {
    format!("{word} over σL/C₁₁")
}

/// f₀ ± GCI at the finest of its three grids: an upright bar and a mark.
fn bar(values: &[(f64, f64)], before: usize, slot: usize) -> Vec<Series> {
    let Ok(found) = extrapolated(values, before) else { return Vec::new() };
    let (h, fine) = values[values.len() - 1 - before];
    let h = h + BESIDE * (slot as f64 + 1.0) * values[0].0;
    let half = found.gci * fine.abs();
    vec![
        Series::line("", vec![(h, found.value - half), (h, found.value + half)]).dash(Dash::Solid).width(1.6),
        Series::markers("", vec![(h, found.value)]).marker(Marker::Plus),
    ]
}

/// f₀ + C h^p through the three finest grids, down to h = 0.
fn through(values: &[(f64, f64)]) -> Option<Vec<(f64, f64)>> {
    let found = extrapolated(values, 0).ok().filter(|found| found.order > 0.0)?;
    let (finest, value) = values[values.len() - 1];
    let coarsest = values[values.len() - 3].0;
    let at = |share: f64| {
        let h = share * coarsest;
        (h, found.value + (value - found.value) * libm::pow(h / finest, found.order))
    };
    Some((0..=40).map(|step| at(f64::from(step) / 40.0)).collect())
}
