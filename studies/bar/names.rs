//! Names of lattices that stand beside each other: what distinguishes them.

use crate::dispersion::m_convergence;
use pd_verify::lattice::Lattice;
use pd_verify::table::Cell;

/// A name for each lattice, saying only what is not the same for all; the kernel is always said.
pub fn names(lattices: &[Lattice]) -> Vec<String> {
    saying(lattices, |part, differs| part == 0 || differs)
}

/// What is not the same for all lattices, of each; empty where nothing differs.
pub fn differences(lattices: &[Lattice]) -> Vec<String> {
    saying(lattices, |_, differs| differs)
}

/// Kernel, m, volume rule and weights of each lattice, as far as they are to be said.
fn saying(lattices: &[Lattice], said: impl Fn(usize, bool) -> bool) -> Vec<String> {
    let parts = |lattice: &Lattice| {
        [
            lattice.kernel.to_string(),
            format!("m = {}", lattice.m),
            lattice.volume_rule.name().to_owned(),
            if lattice.calibrated { "calibrated" } else { "as printed" }.to_owned(),
        ]
    };
    let all: Vec<[String; 4]> = lattices.iter().map(parts).collect();
    let differs = |part: usize| all.iter().any(|other| other[part] != all[0][part]);
    let said: Vec<usize> = (0..4).filter(|&part| said(part, differs(part))).collect();
    let name = |of: &[String; 4]| said.iter().map(|&part| of[part].as_str()).collect::<Vec<_>>().join(", ");
    all.iter().map(name).collect()
}

/// kernel, p, m, dx_m, volume_rule, calibrated: which lattice a row of a table is about.
pub const LATTICE: [&str; 6] = ["kernel", "p", "m", "dx_m", "volume_rule", "calibrated"];

/// The cells of [`LATTICE`]; without a lattice they are empty.
pub fn lattice_cells(lattice: Option<(Lattice, f64)>) -> Vec<Cell> {
    let Some((lattice, spacing)) = lattice else { return vec![Cell::Empty; LATTICE.len()] };
    vec![
        lattice.kernel.name().into(),
        lattice.kernel.p().into(),
        lattice.m.into(),
        spacing.into(),
        lattice.volume_rule.name().into(),
        lattice.calibrated.into(),
    ]
}

/// A lattice in the name of a claim.
pub fn slug(lattice: Lattice) -> String {
    let kernel = m_convergence::slug(lattice.kernel);
    let calibrated = if lattice.calibrated { "_calibrated" } else { "" };
    let m = format!("m{}", lattice.m).replace('.', "_");
    format!("{kernel}_{m}_{}{calibrated}", lattice.volume_rule.name())
}
