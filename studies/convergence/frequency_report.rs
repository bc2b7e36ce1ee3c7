//! Table and figure of frequencies read from marches.

use super::frequency::{Read, Wave};
use super::space::{In, Space};
use crate::bar::names::{LATTICE, lattice_cells};
use crate::question::Place;
use pd_verify::dispersion::Branch;
use pd_verify::report::plot::{Axis, Figure, Lines, Marker, Series};
use pd_verify::table::{Cell, Table};

/// Rows of all waves.
pub fn table<const D: usize>(waves: &[Wave<D>], read: &[Read], place: &Place) -> Table {
    let own = ["branch", "angle_deg", "k_per_m", "omega_rad_per_s", "omega_relation_rad_per_s"];
    let more = ["omega_reference_rad_per_s", "across_over_height"];
    let mut table = Table::new("marched_waves.csv", &[&["case"][..], &LATTICE, &own, &more].concat());
    for (wave, read) in waves.iter().zip(read) {
        let start: [Cell; 1] = [place.case.clone().into()];
        let branch = if D == 1 { Cell::Empty } else { wave.of.branch.name().into() };
        let own: [Cell; 7] = [
            branch,
            read.degrees.into(),
            read.k.into(),
            read.measured.into(),
            read.relation.into(),
            read.reference.into(),
            read.leaked.into(),
        ];
        let lattice = lattice_cells(Some((wave.lattice, wave.march.scene.spacing)));
        table.push(start.into_iter().chain(lattice).chain(own).collect::<Vec<_>>());
    }
    table
}

/// Phase speeds read from marches over the curves of the relation, of the first lattice.
pub fn figure<const D: usize>(title: &str, waves: &[Wave<D>], read: &[Read], place: &Place) -> Figure
where
    In: Space<D>,
{
    let first = waves.first().map(|wave| wave.lattice);
    let mut panels = Vec::new();
    for branch in [Branch::P, Branch::S] {
        let mine: Vec<(&Wave<D>, &Read)> = waves
            .iter()
            .zip(read)
            .filter(|(wave, _)| wave.of.branch == branch && Some(wave.lattice) == first)
            .collect();
        if mine.is_empty() {
            continue;
        }
        let mut angles: Vec<f64> = mine.iter().map(|(_, read)| read.degrees).collect();
        angles.dedup();
        let mut series = Vec::new();
        for (slot, &angle) in angles.iter().enumerate() {
            let along = mine.iter().filter(|(_, read)| read.degrees == angle);
            let phase = |k: f64, omega: f64, read: &Read| omega / (k * read.speed);
            let marched = along.clone().filter_map(|(wave, read)| {
                Some((read.k * wave.march.scene.spacing, phase(read.k, read.measured?, read)))
            });
            series.push(
                Series::markers(format!("{}°, marched", (100.0 * angle).round() / 100.0), marched.collect())
                    .slot(slot)
                    .marker(Marker::Circle),
            );
            let line = along.clone().next().map(|(wave, _)| curve(wave)).unwrap_or_default();
            let label = if slot == 0 { "lines: the relation by its sums" } else { "" };
            series.push(Series::line(label, line).slot(slot).width(1.4));
        }
        let axis = Axis::linear("ω/(ck)");
        let mut panel = Lines::new(Axis::linear("kΔx"), axis, series);
        if D == 2 {
            panel = panel.titled(format!(
                "{}: {}",
                branch.name(),
                first.map_or(String::new(), |lattice| lattice.to_string())
            ));
        }
        panels.push(panel);
    }
    let caption = format!(
        "Phase speed over that of the local wave, with leapfrog: points read from marches, lines the relation by its sums. {}.",
        first.map_or(String::new(), |lattice| lattice.to_string())
    );
    let mut figure = Figure::new(place.case.clone(), title, caption, Lines::default());
    figure.panels = panels.into_iter().map(Into::into).collect();
    figure
}

/// ω/(ck) by the reference's relation over kΔx, along a wave's direction and with its time step.
fn curve<const D: usize>(wave: &Wave<D>) -> Vec<(f64, f64)>
where
    In: Space<D>,
{
    const SAMPLES: usize = 60;
    let (curve, spacing) = (wave.curve(), wave.march.scene.spacing);
    let end = curve.zone_edge().unwrap_or(f64::NAN);
    let at = |n: usize| {
        let k = end * n as f64 / SAMPLES as f64;
        Some((k * spacing, curve.reference(k)?.omega / k))
    };
    (1..=SAMPLES).filter_map(at).collect()
}
