//! `probes.csv`: what the probes saw, one number a row.

use super::balances::asked_for;
use crate::question::Place;
use pd_verify::record::Record;
use pd_verify::table::{Cell, Row, Table};
use std::sync::Arc;

/// Rows that a case may write.
pub const MAX_ROWS: u64 = 2_000_000;

const COLUMNS: [&str; 9] = ["case", "scene", "probe", "quantity", "unit", "x_m", "y_m", "t_s", "value"];

/// The rows of a case, probe by probe, quantity by quantity, in the order of time.
pub fn table<'a>(records: impl Iterator<Item = &'a Record>, place: &Place) -> Table {
    let mut table = Table::new("probes.csv", &COLUMNS);
    for record in records {
        for trace in record.traces.iter().filter(|trace| asked_for(&trace.probe)) {
            for (index, column) in trace.columns.iter().enumerate() {
                let at = |axis: usize| column.at.as_ref().and_then(|at| at.get(axis).copied());
                let shared: Arc<[Cell]> = vec![
                    place.case.clone().into(),
                    record.plan.name.clone().into(),
                    trace.probe.clone().into(),
                    column.quantity.into(),
                    column.unit.into(),
                    at(0).into(),
                    at(1).into(),
                ]
                .into();
                for (time, row) in trace.times.iter().zip(&trace.rows) {
                    table.push(Row::of_block(&shared, vec![(*time).into(), row[index].into()]));
                }
            }
        }
    }
    table
}
