//! Rows of `dsif_tip_factor.csv`, and tip factors over m.

use super::tip_factor::{Factors, TipFactor};
use crate::bar::names::{LATTICE, lattice_cells};
use crate::convergence::path::Weights;
use crate::question::Place;
use pd_verify::lattice::Lattice;
use pd_verify::report::plot::{Axis, Figure, Guide, Lines, Panel, Series};
use pd_verify::table::{Cell, Table};

/// Curves that one panel can show.
const DRAWN: usize = 8;
const MODES: [&str; 2] = ["I", "II"];

/// A row for every lattice, reading and mode. A spacing has no part in it.
pub fn table(asked: &TipFactor, all: &[Factors], place: &Place) -> Table {
    let mut columns = vec!["case"];
    columns.extend(LATTICE.into_iter().filter(|column| *column != "dx_m"));
    columns.extend(["reading", "extraction", "terms", "mode", "tip_factor"]);
    let mut table = Table::new("dsif_tip_factor.csv", &columns);
    for (lattice, factors) in asked.lattices.iter().zip(all) {
        for (extraction, factor) in asked.extractions.iter().zip(&factors.here) {
            for (mode, factor) in MODES.iter().zip(factor) {
                let mut row: Vec<Cell> = vec![place.case.as_str().into()];
                let cells = LATTICE.iter().zip(lattice_cells(Some((*lattice, f64::NAN))));
                row.extend(cells.filter(|(column, _)| **column != "dx_m").map(|(_, cell)| cell));
                row.extend([
                    extraction.name.as_str().into(),
                    extraction.method.word().into(),
                    extraction.terms().into(),
                    (*mode).into(),
                    (*factor).into(),
                ]);
                table.push(row);
            }
        }
    }
    table
}

/// Factors over m, or where there is one m only, by reading.
pub fn figures(asked: &TipFactor, all: &[Factors], place: &Place) -> Vec<Figure> {
    let weights = |lattice: &Lattice| {
        let Lattice { kernel, volume_rule, calibrated, .. } = *lattice;
        Weights { kernel, volume_rule, calibrated }
    };
    let mut kinds: Vec<Weights> = Vec::new();
    for one in asked.lattices.iter().map(weights) {
        if !kinds.contains(&one) {
            kinds.push(one);
        }
    }
    let label = |one: &Weights| {
        let calibrated = if one.calibrated { "calibrated" } else { "as printed" };
        format!("{}, {calibrated}", one.kernel)
    };
    let panel = |extraction: usize, mode: usize| -> Panel {
        let of_kind = |(slot, kind): (usize, &Weights)| {
            let mine = asked.lattices.iter().zip(all).filter(|(lattice, _)| weights(lattice) == *kind);
            let points = mine.map(|(lattice, factors)| (lattice.m, factors.here[extraction][mode]));
            Series::both(label(kind), points.collect()).slot(slot)
        };
        let series = kinds.iter().take(DRAWN).enumerate().map(of_kind).collect();
        let title = format!("{}, mode {}", asked.extractions[extraction].name.replace('_', " "), MODES[mode]);
        let mut lines =
            Lines::new(Axis::linear("m = δ/Δx"), Axis::linear("tip factor"), series).titled(title);
        lines.guides = vec![Guide::Horizontal { at: 1.0, label: String::new() }];
        lines.into()
    };
    let mut panels = (0..asked.extractions.len())
        .flat_map(|one| [0, 1].map(|mode| (one, mode)))
        .map(|(one, mode)| panel(one, mode));
    let Some(first) = panels.next() else { return Vec::new() };
    let mut caption = "What a reading finds in the static field of a tip over the K that is there: 1 would be exact. Refining at fixed m does not change it.".to_owned();
    if kinds.len() > DRAWN {
        caption += &format!(" {} more weights are in dsif_tip_factor.csv.", kinds.len() - DRAWN);
    }
    let figure = Figure::new(place.case.clone(), asked.title.clone(), caption, first);
    vec![panels.fold(figure, Figure::panel).columns(2)]
}
