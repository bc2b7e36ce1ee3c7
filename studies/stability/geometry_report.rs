//! Rows of `stability_geometry.csv`, and the bonds that nodes have lost.

use super::geometry::{Geometry, Seen};
use super::shape::Shaped;
use crate::bar::names::{LATTICE, lattice_cells};
use crate::dispersion::curve::reference_lattice;
use crate::question::Place;
use pd_verify::compare::largest;
use pd_verify::report::plot::{Axis, Figure, Panel, Raster};
use pd_verify::table::{Cell, Table};

/// Shapes that the figure shows.
const DRAWN: usize = 6;

/// A row for every plate.
pub fn table(asked: &Geometry, all: &[Seen], place: &Place) -> Table {
    let own = [
        "shape",
        "nodes",
        "bonds",
        "bonds_lost",
        "pieces",
        "nodes_wrong_stencil",
        "nodes_wrong_list",
        "drift_over_energy",
        "norm_excess",
        "flight_over_allowed",
    ];
    let mut table = Table::new("stability_geometry.csv", &[&["case"][..], &LATTICE, &own].concat());
    for (shaped, seen) in asked.shaped.iter().zip(all) {
        let lattice = reference_lattice(shaped.lattice());
        let lost = shaped.exact.lost(lattice).iter().sum::<usize>() / 2;
        let drift = largest(seen.kept.drift.iter().map(|(_, drift, _)| drift / seen.kept.energy));
        let mut row: Vec<Cell> = vec![place.case.as_str().into()];
        row.extend(lattice_cells(Some(shaped.body().lattice())));
        row.extend::<[Cell; 10]>([
            shaped.name.as_str().into(),
            (shaped.exact.standing().len() as u64).into(),
            (shaped.exact.bonds(lattice) as u64).into(),
            (lost as u64).into(),
            (seen.pieces as u64).into(),
            (seen.wrong[0] as u64).into(),
            (seen.wrong[1] as u64).into(),
            drift.into(),
            seen.kept.excess.into(),
            seen.flight.into(),
        ]);
        table.push(row);
    }
    table
}

/// How many bonds each node has lost to cuts and holes, for a few shapes.
pub fn figure(asked: &Geometry, place: &Place) -> Figure {
    let mut panels = asked.shaped.iter().take(DRAWN).map(lost);
    let caption = format!(
        "Bonds that each node has lost to cuts and holes, by whole numbers, for {} of {} plates; a grey cell holds no node.",
        asked.shaped.len().min(DRAWN),
        asked.shaped.len()
    );
    let first = panels.next().unwrap_or_else(|| {
        Raster::new(Axis::linear("x"), Axis::linear("y"), Axis::linear("bonds lost"), Vec::new()).into()
    });
    let figure = Figure::new(place.case.clone(), asked.title.clone(), caption, first);
    panels.fold(figure, Figure::panel).columns(2)
}

fn lost(shaped: &Shaped) -> Panel {
    let [columns, rows] = shaped.scene.nodes;
    let mut values = vec![vec![None; columns]; rows];
    let lost = shaped.exact.lost(reference_lattice(shaped.lattice()));
    for (node, lost) in shaped.exact.standing().iter().zip(lost) {
        values[node[1] as usize][node[0] as usize] = Some(lost as f64);
    }
    let axis = |name: &str, count: usize| Axis::linear(name).range(0.0, count as f64);
    let value = Axis::linear("bonds lost").including(0.0);
    Raster::new(axis("x/Δx", columns), axis("y/Δx", rows), value, values)
        .titled(shaped.name.clone())
        .to_scale()
        .into()
}
