//! How errors fall: refinements in δ, in m and in both, of waves, pulses and bodies at rest, with the order of each.

mod foreign;
mod framed;
pub mod frequency;
mod frequency_report;
pub mod grids;
mod grids_report;
mod grids_said;
pub mod patch;
mod patch_report;
pub mod path;
pub mod pulse;
pub mod refined;
mod refined_report;
pub mod rest;
pub mod space;
pub mod surface;
mod surface_report;
mod theory;
pub mod volume_rules;
mod volume_rules_report;
pub mod wave;
pub mod whole;

use crate::written::Word;

/// What a case may ask.
pub const WORDS: &[Word] = &[
    Word::of::<wave::PlaneWaveAsked>("plane_wave"),
    Word::of::<pulse::PointPulseAsked>("point_pulse"),
    Word::of::<frequency::FrequencyAsked>("frequency"),
    Word::of::<volume_rules::VolumeRulesAsked>("volume_rules"),
    Word::of::<rest::ManufacturedAsked>("manufactured"),
    Word::of::<patch::PatchAsked>("patch"),
    Word::of::<surface::SurfaceAsked>("surface"),
    Word::of::<grids::GridsAsked>("grid_convergence"),
];

/// Files that cases share; no figure may take their names.
pub const TABLES: &[&str] = &[
    "convergence",
    "grid_convergence",
    "marched_waves",
    "patch",
    "surface_effect",
    "volume_rules",
    "verdicts",
];

/// Ends of the names of figures beside the one that is called like its case.
pub const SUFFIXES: &[&str] = &[];

#[cfg(test)]
mod at_rest_tests;
