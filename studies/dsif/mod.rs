//! Dynamic stress intensity factors: plates with a crack, marched, read at the tip, held against exact histories.

pub mod budget;
pub mod errors;
mod expect;
pub mod extraction;
mod foreign;
pub mod intensity;
mod intensity_report;
pub mod known;
pub mod load;
pub mod plate;
pub mod running;
mod running_report;
mod runs;
mod said;
pub mod sensitivity;
pub mod setup;
mod smooth;
mod tip;
pub mod tip_factor;
mod tip_factor_report;
pub mod tips;

use crate::written::Word;

/// What a case may ask.
pub const WORDS: &[Word] = &[
    Word::of::<intensity::IntensityAsked>("stress_intensity"),
    Word::of::<budget::BudgetAsked>("error_budget"),
    Word::of::<sensitivity::SensitivityAsked>("reading_sensitivity"),
    Word::of::<running::RunningAsked>("running_crack"),
    Word::of::<tip_factor::TipFactorAsked>("tip_factor"),
];

/// Files that cases share; no figure may take their names.
pub const TABLES: &[&str] =
    &["dsif_budget", "dsif_errors", "dsif_history", "dsif_running", "dsif_tip_factor", "verdicts"];

/// Ends of the names of figures beside the one that is called like its case.
pub const SUFFIXES: &[&str] = &["-convergence", "-field"];
