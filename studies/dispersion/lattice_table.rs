//! Tables with a row per lattice: the columns that say which lattice it is, and its cells.

use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::table::{Cell, Table};

/// Which lattice a row is about.
const IDENTITY: [&str; 7] = ["case", "body", "kernel", "p", "m", "volume_rule", "calibrated"];

/// A table whose rows start with a lattice.
pub fn lattice_table(file: &str, columns: &[&'static str]) -> Table {
    Table::new(file, &[&IDENTITY[..], columns].concat())
}

/// A row: the lattice, then its own cells.
pub fn lattice_row(
    case: &str,
    body: Body,
    lattice: Lattice,
    own: impl IntoIterator<Item = Cell>,
) -> Vec<Cell> {
    let identity = [
        case.into(),
        body.name().into(),
        lattice.kernel.name().into(),
        lattice.kernel.p().into(),
        lattice.m.into(),
        lattice.volume_rule.name().into(),
        lattice.calibrated.into(),
    ];
    identity.into_iter().chain(own).collect()
}
