//! Rows of a data file: typed cells in, CSV text out; an unknown number is an empty cell, never a zero.

use crate::report::csv_number;
use std::sync::Arc;

/// One cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    Text(String),
    /// NaN and infinities are written as empty cells.
    Number(f64),
    Count(u64),
    Flag(bool),
    Empty,
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<f64> for Cell {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<u64> for Cell {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        Self::Count(count as u64)
    }
}

impl From<bool> for Cell {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

impl Cell {
    fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(number) => csv_number(*number),
            Self::Count(count) => count.to_string(),
            Self::Flag(flag) => flag.to_string(),
            Self::Empty => String::new(),
        }
    }
}

/// One row: cells that a whole block of rows has in common, then its own.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    shared: Arc<[Cell]>,
    own: Vec<Cell>,
}

impl Row {
    /// A row of a block; the shared cells come first.
    pub fn of_block(shared: &Arc<[Cell]>, own: Vec<Cell>) -> Self {
        Self { shared: Arc::clone(shared), own }
    }

    fn cells(&self) -> impl Iterator<Item = &Cell> {
        self.shared.iter().chain(&self.own)
    }
}

impl From<Vec<Cell>> for Row {
    fn from(own: Vec<Cell>) -> Self {
        Self { shared: Arc::new([]), own }
    }
}

/// A data file: its name without folder, its columns, its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    pub file: String,
    pub columns: Vec<&'static str>,
    pub rows: Vec<Row>,
}

impl Table {
    /// A table without rows.
    pub fn new(file: impl Into<String>, columns: &[&'static str]) -> Self {
        Self { file: file.into(), columns: columns.to_vec(), rows: Vec::new() }
    }

    /// Adds a row.
    pub fn push(&mut self, row: impl Into<Row>) {
        self.rows.push(row.into());
    }

    /// The bytes of the file, header first, lines ending in `\n`.
    ///
    /// # Panics
    /// When a row has more or fewer cells than there are columns.
    pub fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&self.columns).expect("writing to memory");
        for row in &self.rows {
            let width = row.shared.len() + row.own.len();
            assert_eq!(width, self.columns.len(), "a row of {} does not fit its columns", self.file);
            writer.write_record(row.cells().map(Cell::text)).expect("writing to memory");
        }
        let bytes = writer.into_inner().expect("writing to memory");
        String::from_utf8(bytes).expect("cells are text")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_written_plainly_and_unknown_is_empty() {
        let mut table = Table::new("x.csv", &["a", "b", "c", "d", "e"]);
        table.push(vec![0.1.into(), f64::NAN.into(), "x, y".into(), true.into(), None::<f64>.into()]);
        assert_eq!(table.csv(), "a,b,c,d,e\n0.1,,\"x, y\",true,\n");
    }
}
