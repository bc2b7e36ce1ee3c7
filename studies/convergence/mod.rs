//! How errors fall: refinements in δ, in m and in both, of waves, pulses and bodies at rest, with the order of each.

pub mod frequency;
mod frequency_report;
pub mod path;
pub mod pulse;
pub mod refined;
mod refined_report;
pub mod rest;
mod space;
mod theory;
pub mod volume_rules;
mod volume_rules_report;
pub mod wave;
mod whole;

use crate::written::Word;

/// What a case may ask.
pub const WORDS: &[Word] = &[
    Word::of::<wave::PlaneWaveAsked>("plane_wave"),
    Word::of::<pulse::PointPulseAsked>("point_pulse"),
    Word::of::<frequency::FrequencyAsked>("frequency"),
    Word::of::<volume_rules::VolumeRulesAsked>("volume_rules"),
    Word::of::<rest::ManufacturedAsked>("manufactured"),
];

/// Files that cases share; no figure may take their names.
pub const TABLES: &[&str] = &["convergence", "marched_waves", "volume_rules", "verdicts"];

/// Ends of the names of figures beside the one that is called like its case.
pub const SUFFIXES: &[&str] = &[];
