//! The data that a figure draws, as a table: one row per point, cell or dot, with its panel, series and axes.

use super::plot::{Figure, Panel};
use crate::table::{Cell, Row, Table};
use std::sync::Arc;

/// The table `<figure>.csv`. A heat map gives its rows as series and its columns as x, a dot chart its groups as x.
pub fn figure_table(figure: &Figure) -> Table {
    let columns = ["panel", "series", "x_axis", "y_axis", "x", "y"];
    let mut table = Table::new(format!("{}.csv", figure.id), &columns);
    for (index, panel) in figure.panels.iter().enumerate() {
        let block = |title: &str, series: &str, x_axis: &str, y_axis: &str| -> Arc<[Cell]> {
            let title = if title.is_empty() { (index + 1).to_string() } else { title.to_owned() };
            Arc::new([title.into(), series.into(), x_axis.into(), y_axis.into()])
        };
        let mut push = |shared: &Arc<[Cell]>, x: Cell, y: Cell| table.push(Row::of_block(shared, vec![x, y]));
        match panel {
            Panel::Lines(lines) => {
                for series in &lines.series {
                    let shared = block(&lines.title, &series.label, &lines.x.label, &lines.y.label);
                    series.points.iter().for_each(|&(x, y)| push(&shared, x.into(), y.into()));
                }
            }
            Panel::Polar(polar) => {
                for series in &polar.series {
                    let shared = block(&polar.title, &series.label, "direction (°)", &polar.radial.label);
                    series.points.iter().for_each(|&(x, y)| push(&shared, x.into(), y.into()));
                }
            }
            Panel::HeatMap(map) => {
                for (row, values) in map.y.iter().zip(&map.values) {
                    let shared = block(&map.title, row, &map.x_label, &map.value.label);
                    map.x
                        .iter()
                        .zip(values)
                        .for_each(|(x, &value)| push(&shared, x.as_str().into(), value.into()));
                }
            }
            Panel::Dots(dots) => {
                for category in &dots.categories {
                    let shared = block(&dots.title, &category.label, "group", &dots.value.label);
                    let values = category.dots.iter().map(|dot| dot.as_ref().map(|dot| dot.value));
                    dots.groups
                        .iter()
                        .zip(values)
                        .for_each(|(x, value)| push(&shared, x.as_str().into(), value.into()));
                }
            }
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::plot::{Axis, Lines, Series};

    #[test]
    fn every_point_is_a_row_and_a_gap_an_empty_cell() {
        let series = Series::line("a", vec![(1.0, 2.0), (3.0, f64::NAN)]);
        let panel = Lines::new(Axis::linear("t (s)"), Axis::linear("u (m)"), vec![series]);
        let text = figure_table(&Figure::new("f", "", "", panel)).csv();
        assert_eq!(text, "panel,series,x_axis,y_axis,x,y\n1,a,t (s),u (m),1,2\n1,a,t (s),u (m),3,\n");
    }
}
