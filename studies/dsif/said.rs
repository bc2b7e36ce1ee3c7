//! What is refused of every case about cracks: claims without a name or a reason, levels and lattices beyond measure.

use crate::convergence::path::Weights;
use crate::dispersion::sweep::{check_count, check_marched};
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::scene::{Positive, Wrong};

/// Refuses a name that could not be told from others in the id of a claim.
pub fn check_name(key: &str, name: &str, taken: &[String]) -> Result<(), Wrong> {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    if name.is_empty() || name.len() > 60 || !name.chars().all(plain) {
        let message = format!("\"{name}\" cannot be a name here");
        return Err(Wrong::new(key, message, "use lower-case letters, digits and _, at most 60"));
    }
    if taken.iter().any(|other| other == name) {
        return Err(Wrong::new(key, format!("\"{name}\" is there already"), "give each its own name"));
    }
    Ok(())
}

/// Refuses a claim without a reason.
pub fn check_reason(because: &str) -> Result<(), Wrong> {
    if because.trim().len() >= 16 {
        return Ok(());
    }
    let help = "say in a sentence why the bound is what it is";
    Err(Wrong::new("because", "a claim without a reason is not judged", help))
}

/// Refuses more lattices than are run, or too large ones, before any is made; so many bodies of each.
pub fn check_lattices(weights: &[Weights], m: &[Positive], each: usize) -> Result<(), Wrong> {
    let count = weights.len().saturating_mul(m.len());
    check_count(&[count, each])?;
    let of = |m: &Positive| weights.iter().map(|weights| weights.lattice(m.0)).collect::<Vec<_>>();
    let lattices: Vec<Lattice> = m.iter().flat_map(of).collect();
    check_marched(Body::PlaneStress, &lattices, each)
}

/// Cells of all plates of a case: to lay out more takes minutes.
const MOST_CELLS: f64 = 1e9;

/// Refuses plates of more cells than are laid out, so many bodies of each.
pub fn check_cells(plates: &[[usize; 2]], each: usize) -> Result<(), Wrong> {
    let cells: f64 = plates.iter().map(|[columns, rows]| *columns as f64 * *rows as f64).sum();
    if cells * each as f64 <= MOST_CELLS {
        return Ok(());
    }
    let message = format!(
        "{} plates have {:.1e} cells, at most {MOST_CELLS:.0e} are laid out by a case",
        plates.len() * each,
        cells * each as f64
    );
    Err(Wrong::new("dx_m", message, "take larger spacings, or fewer of them"))
}

/// More levels say nothing more.
const MOST_LEVELS: usize = 100;

/// Refuses levels that do not go from coarse to fine.
pub fn check_levels(spacings: &[f64]) -> Result<(), Wrong> {
    if spacings.len() > MOST_LEVELS {
        let message = format!("{} levels are more than the {MOST_LEVELS} that are run", spacings.len());
        return Err(Wrong::new("dx_m", message, "a few levels show an order"));
    }
    if !spacings.is_empty() && spacings.windows(2).all(|pair| pair[0] > pair[1]) {
        return Ok(());
    }
    Err(Wrong::new("dx_m", "levels go from coarse to fine", "write falling spacings"))
}
