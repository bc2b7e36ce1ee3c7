//! Snapshots as a figure: a row for each time, the displacements along x and y beside each other.

use super::figure_units::Unit;
use crate::rounded::rounded;
use pd_verify::record::Snapshot;
use pd_verify::report::plot::{Axis, Figure, Panel, Raster};
use std::ops::RangeInclusive;

/// Cells along the longer side that can still be seen apart.
const MOST_CELLS: usize = 120;

/// Height over length of bodies that can be seen when drawn to scale.
const TO_SCALE: RangeInclusive<f64> = 0.1..=8.0;

/// Bodies flatter than this need the whole width.
const FLAT: f64 = 0.3;

/// Below this share of the largest displacement a component is rounding.
const ROUNDING: f64 = 1e-12;

/// The figure of the snapshots shown; nothing without any.
pub fn figure(id: String, title: String, shown: &[&Snapshot], taken: usize) -> Option<Figure> {
    let (first, last) = (shown.first()?, shown.last()?);
    let time = Unit::of_time(last.time);
    let sizes = [0, 1].map(|component| largest(shown, component));
    let most = sizes[0].max(sizes[1]);
    let block = first.nodes.iter().max()?.div_ceil(MOST_CELLS);
    let mut caption = "Displacements u of the whole body".to_owned();
    if shown.len() < taken {
        caption += &format!(" at {} of {taken} times", shown.len());
    }
    caption += "; each component has one scale of colours for all times.";
    if block > 1 {
        caption += &format!(" A cell is the mean over {block} by {block} nodes.");
    }
    let slope = first.nodes[1] as f64 / first.nodes[0] as f64;
    let to_scale = TO_SCALE.contains(&slope);
    if !to_scale {
        caption += " Not to scale.";
    }
    let mut panels: Vec<Panel> = Vec::new();
    for snapshot in shown {
        for (component, &size) in sizes.iter().enumerate() {
            let at = format!("t = {} {}", rounded(time.of(snapshot.time)), time.name);
            let scale = if size > ROUNDING * most { size } else { most };
            let mut raster = raster(snapshot, component, scale, block).titled(at);
            if slope < FLAT {
                // The scale beside so flat a body has no room for ticks.
                raster.title +=
                    &format!(", {}, colours up to ±{}", raster.value.label, rounded(end_of(scale)));
            }
            panels.push(if to_scale { raster.to_scale() } else { raster }.into());
        }
    }
    for (size, axis) in sizes.iter().zip(["x", "y"]) {
        if *size <= ROUNDING * most {
            caption += &format!(" The displacement along {axis} is zero to rounding.");
        }
    }
    let mut panels = panels.into_iter();
    let figure = Figure::new(id, title, caption, panels.next()?);
    let columns = if slope < FLAT { 1 } else { 2 };
    Some(panels.fold(figure, Figure::panel).columns(columns))
}

/// The largest finite size of a component.
fn largest(snapshots: &[&Snapshot], component: usize) -> f64 {
    let values = snapshots.iter().flat_map(|snapshot| &snapshot.displacement[component]);
    values.map(|u| u.abs()).filter(|u| u.is_finite()).fold(0.0, f64::max)
}

/// One component at one time, colours running from −`scale` to `scale` in m.
fn raster(snapshot: &Snapshot, component: usize, scale: f64, block: usize) -> Raster {
    let size = |axis: usize| snapshot.nodes[axis] as f64 * snapshot.spacing;
    let place = |name: &str, axis: usize| Axis::linear(name).range(0.0, size(axis));
    let unit = Unit::of_displacement(scale);
    let end = end_of(scale);
    let name = ["u along x", "u along y"][component];
    let value = Axis::linear(format!("{name} ({})", unit.name)).range(-end, end);
    let values = coarse(snapshot, component, block, unit);
    Raster::new(place("x (m)", 0), place("y (m)", 1), value, values).diverging(0.0)
}

/// Where the colours end, in the unit that fits; a body at rest has a scale of 1 m.
fn end_of(scale: f64) -> f64 {
    if scale > 0.0 { Unit::of_displacement(scale).of(scale) } else { 1.0 }
}

/// Means over blocks of nodes, `None` where none of them has material. A last block that is not whole would be drawn
/// too wide: the blocks divide the sides into equal parts as evenly as whole nodes allow.
fn coarse(snapshot: &Snapshot, component: usize, block: usize, unit: Unit) -> Vec<Vec<Option<f64>>> {
    let [columns, rows] = [snapshot.nodes[0], snapshot.nodes[1]];
    let parts = |count: usize| count.div_ceil(block);
    let part = |n: usize, count: usize| n * count / parts(count)..(n + 1) * count / parts(count);
    let mean = |row: usize, column: usize| {
        let nodes = part(row, rows).flat_map(|y| part(column, columns).map(move |x| y * columns + x));
        let values = nodes.map(|node| snapshot.displacement[component][node]).filter(|u| u.is_finite());
        let (sum, count) = values.fold((0.0, 0), |(sum, count), u| (sum + u, count + 1));
        (count > 0).then(|| unit.of(sum / f64::from(count)))
    };
    let row = |row| (0..parts(columns)).map(|column| mean(row, column)).collect();
    (0..parts(rows)).map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn snapshot(nodes: [usize; 2], displacement: Vec<Vec<f64>>) -> Snapshot {
        let velocity = displacement.clone();
        let (name, nodes) = ("s".to_owned(), nodes.to_vec());
        Snapshot { name, index: 0, step: 1, time: 2e-6, nodes, spacing: 0.5, displacement, velocity }
    }

    #[test]
    fn blocks_are_means_of_their_material() {
        let x = vec![1.0, 3.0, 5.0, 7.0, f64::NAN, f64::NAN, f64::NAN, 8.0];
        let taken = snapshot([4, 2], vec![x, vec![0.0; 8]]);
        let metres = Unit::of_displacement(8.0);
        assert_eq!(coarse(&taken, 0, 2, metres), [[Some(2.0), Some(20.0 / 3.0)]]);
        assert_eq!(coarse(&taken, 0, 1, metres)[1], [None, None, None, Some(8.0)]);
        let drawn = figure("f".into(), "f".into(), &[&taken], 7).unwrap();
        assert_eq!((drawn.panels.len(), drawn.columns), (2, 2));
        assert!(drawn.caption.contains("1 of 7 times") && drawn.caption.contains("y is zero to rounding"));
        assert!(pd_verify::report::plot::svg(&drawn).is_ok());
    }

    #[test]
    fn a_body_at_rest_can_be_drawn() {
        let taken = snapshot([4, 2], vec![vec![0.0; 8]; 2]);
        let drawn = figure("f".into(), "f".into(), &[&taken], 1).unwrap();
        assert!(pd_verify::report::plot::svg(&drawn).is_ok());
        assert!(figure("f".into(), "f".into(), &[], 0).is_none());
    }
}
