//! The data that a figure draws, as a table: one row per point, cell or dot, named by its panel and series.

use super::plot::{Figure, Panel};
use crate::table::{Cell, Table};

/// The table `<figure>.csv`. Curves: x and y; polar: angle in degrees and radius; maps and charts: names and value.
pub fn figure_table(figure: &Figure) -> Table {
    let mut table = Table::new(format!("{}.csv", figure.id), &["panel", "series", "x", "y"]);
    for (index, panel) in figure.panels.iter().enumerate() {
        let name = |title: &str| if title.is_empty() { format!("{}", index + 1) } else { title.to_owned() };
        let mut push = |title: &str, series: &str, x: Cell, y: Cell| {
            table.push(vec![name(title).into(), series.into(), x, y]);
        };
        match panel {
            Panel::Lines(lines) => {
                for series in &lines.series {
                    series
                        .points
                        .iter()
                        .for_each(|&(x, y)| push(&lines.title, &series.label, x.into(), y.into()));
                }
            }
            Panel::Polar(polar) => {
                for series in &polar.series {
                    series
                        .points
                        .iter()
                        .for_each(|&(x, y)| push(&polar.title, &series.label, x.into(), y.into()));
                }
            }
            Panel::HeatMap(map) => {
                for (row, values) in map.y.iter().zip(&map.values) {
                    for (column, &value) in map.x.iter().zip(values) {
                        push(&map.title, row, column.as_str().into(), value.into());
                    }
                }
            }
            Panel::Dots(dots) => {
                for category in &dots.categories {
                    for (group, dot) in dots.groups.iter().zip(&category.dots) {
                        let value = dot.as_ref().map(|dot| dot.value);
                        push(&dots.title, &category.label, group.as_str().into(), value.into());
                    }
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
        let figure = Figure::new("f", "", "", Lines::new(Axis::linear("x"), Axis::linear("y"), vec![series]));
        assert_eq!(figure_table(&figure).csv(), "panel,series,x,y\n1,a,1,2\n1,a,3,\n");
    }
}
