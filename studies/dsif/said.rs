//! What every claim written in a study file must have: a name that can be part of its id, and a reason.

use pd_verify::scene::Wrong;

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

/// Refuses levels that do not go from coarse to fine.
pub fn check_levels(spacings: &[f64]) -> Result<(), Wrong> {
    if !spacings.is_empty() && spacings.windows(2).all(|pair| pair[0] > pair[1]) {
        return Ok(());
    }
    Err(Wrong::new("dx_m", "levels go from coarse to fine", "write falling spacings"))
}
