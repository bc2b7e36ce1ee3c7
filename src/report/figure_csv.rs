//! The data that a figure draws, as a table: one row per point, cell or dot, with its panel, series and axes.

use super::plot::{Figure, Panel};
use crate::table::{Cell, Row, Table};
use std::sync::Arc;

/// The table `<figure>.csv`. A heat map gives its rows as series and its columns as x, a dot chart its groups as x;
/// stacked bars give their contributions, then the sum, as series and the bars' names as x. A raster gives what its values are as series, and the value of each cell at its middle in a column of its own, which
/// only figures with rasters have.
pub fn figure_table(figure: &Figure) -> Table {
    let columns = ["panel", "series", "x_axis", "y_axis", "x", "y", "value"];
    let rasters = figure.panels.iter().any(|panel| matches!(panel, Panel::Raster(_)));
    let columns = if rasters { &columns[..] } else { &columns[..6] };
    let mut table = Table::new(format!("{}.csv", figure.id), columns);
    for (index, panel) in figure.panels.iter().enumerate() {
        let block = |title: &str, series: &str, x_axis: &str, y_axis: &str| -> Arc<[Cell]> {
            let title = if title.is_empty() { (index + 1).to_string() } else { title.to_owned() };
            Arc::new([title.into(), series.into(), x_axis.into(), y_axis.into()])
        };
        let mut push_all = |shared: &Arc<[Cell]>, x: Cell, y: Cell, value: Cell| {
            let mut own = vec![x, y, value];
            own.truncate(columns.len() - shared.len());
            table.push(Row::of_block(shared, own));
        };
        let mut push = |shared: &Arc<[Cell]>, x: Cell, y: Cell| push_all(shared, x, y, Cell::Empty);
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
            Panel::Raster(raster) => {
                let shared = block(&raster.title, &raster.value.label, &raster.x.label, &raster.y.label);
                for (x, y, value) in raster.points() {
                    push_all(&shared, x.into(), y.into(), value.into());
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
            Panel::StackedBars(bars) => {
                let parts = bars.contributions.iter().enumerate();
                for (i, name) in parts {
                    let shared = block(&bars.title, name, "bar", &bars.value.label);
                    for stack in &bars.stacks {
                        push(
                            &shared,
                            stack.label.as_str().into(),
                            stack.parts.get(i).copied().flatten().into(),
                        );
                    }
                }
                let shared = block(&bars.title, &bars.sum, "bar", &bars.value.label);
                bars.stacks
                    .iter()
                    .for_each(|stack| push(&shared, stack.label.as_str().into(), stack.sum().into()));
            }
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::plot::{Axis, Lines, Raster, Series, Stack, StackedBars};

    #[test]
    fn every_point_is_a_row_and_a_gap_an_empty_cell() {
        let series = Series::line("a", vec![(1.0, 2.0), (3.0, f64::NAN)]);
        let panel = Lines::new(Axis::linear("t (s)"), Axis::linear("u (m)"), vec![series]);
        let text = figure_table(&Figure::new("f", "", "", panel)).csv();
        assert_eq!(text, "panel,series,x_axis,y_axis,x,y\n1,a,t (s),u (m),1,2\n1,a,t (s),u (m),3,\n");
    }

    #[test]
    fn every_cell_of_a_raster_is_a_row_with_its_value() {
        let (x, t) = (Axis::linear("x (m)").range(0.0, 1.0), Axis::linear("t (s)").range(0.0, 4.0));
        let values = vec![vec![Some(0.1), None], vec![Some(-2.0), Some(0.0)]];
        let panel = Raster::new(x, t, Axis::linear("strain (1)"), values).titled("bar");
        let text = figure_table(&Figure::new("f", "", "", panel)).csv();
        let rows = ["0.25,1,0.1", "0.75,1,", "0.25,3,-2", "0.75,3,0"];
        let rows = rows.map(|row| format!("bar,strain (1),x (m),t (s),{row}\n")).concat();
        assert_eq!(text, format!("panel,series,x_axis,y_axis,x,y,value\n{rows}"));
    }

    #[test]
    fn beside_a_raster_curves_leave_the_value_empty() {
        let line =
            Lines::new(Axis::linear("x"), Axis::linear("y"), vec![Series::line("a", vec![(1.0, 2.0)])]);
        let raster =
            Raster::new(Axis::linear("i"), Axis::linear("j"), Axis::linear("v"), vec![vec![Some(7.0)]]);
        let text = figure_table(&Figure::new("f", "", "", line).panel(raster)).csv();
        assert_eq!(text, "panel,series,x_axis,y_axis,x,y,value\n1,a,x,y,1,2,\n2,v,i,j,0.5,0.5,7\n");
    }

    #[test]
    fn bars_give_a_row_for_each_part_and_each_sum() {
        let stacks = vec![
            Stack::new("p = 1", [1.0, -0.25]),
            Stack { label: "p = 2".into(), parts: vec![Some(2.0), None] },
            Stack::new("p = 3", [f64::NAN, 3.0]),
        ];
        let names = vec!["moduli".to_owned(), "edge".to_owned()];
        let panel = StackedBars::new(Axis::linear("error (%)"), names, "sum", stacks).titled("peak");
        let text = figure_table(&Figure::new("f", "", "", panel)).csv();
        let block = |series: &str, values: [&str; 3]| {
            let row = |(i, value)| format!("peak,{series},bar,error (%),p = {i},{value}\n");
            (1..).zip(values).map(row).collect::<String>()
        };
        let rows = [
            block("moduli", ["1", "2", ""]),
            block("edge", ["-0.25", "", "3"]),
            block("sum", ["0.75", "2", ""]),
        ];
        assert_eq!(text, format!("panel,series,x_axis,y_axis,x,y\n{}", rows.concat()));
    }
}
