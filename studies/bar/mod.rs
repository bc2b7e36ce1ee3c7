//! `pd-verify bar`: a bar marched in time and at rest, held against exact answers of the local bar, of its lattice, and
//! of the nonlocal continuum.

mod foreign;
pub mod jump;
pub mod jump_convergence;
pub mod names;
pub mod nonlocal;
pub mod pulse;
mod pulse_report;
pub mod pulsed;
pub mod release;
mod release_report;
pub mod released;
mod ring;
pub mod space_time;
pub mod spectrum;
mod spectrum_report;
pub mod statics;
mod statics_report;
pub mod stretched;
pub mod time_order;

use crate::written::Word;

/// What a case may ask.
pub const WORDS: &[Word] = &[
    Word::of::<release::ReleaseAsked>("release"),
    Word::of::<jump_convergence::JumpConvergenceAsked>("jump_convergence"),
    Word::of::<time_order::TimeOrderAsked>("time_order"),
    Word::of::<spectrum::SpectrumAsked>("spectrum"),
    Word::of::<space_time::SpaceTimeAsked>("space_time"),
    Word::of::<pulse::PulseAsked>("pulse"),
    Word::of::<nonlocal::NonlocalPulseAsked>("nonlocal_pulse"),
    Word::of::<statics::StaticsAsked>("statics"),
];

/// Files that cases share; no figure may take their names.
pub const TABLES: &[&str] = &[
    "bar_strain",
    "bar_displacement",
    "bar_errors",
    "bar_jump_convergence",
    "bar_time_order",
    "bar_spectrum",
    "bar_convergence",
    "bar_time_steps",
    "bar_statics",
    "bar_static_strain",
    "verdicts",
];

/// Ends of the names of figures beside the one that is called like its case.
pub const SUFFIXES: &[&str] = &["-error", "-shape", "-time-step", "-horizon", "-strain"];
