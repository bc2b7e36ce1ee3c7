//! `pd-verify cost`: what accuracy costs in work and in time, by method, kernel, m and time step.

pub mod ablation;
mod ablation_bodies;
mod ablation_report;
#[cfg(test)]
mod ablation_tests;
pub mod advice;
mod answers;
pub mod crack;
pub mod figure;
pub mod jump;
pub mod own;
mod problem;
mod runs;
mod settings;
pub mod text;
pub mod wave;
mod work_precision;
mod work_precision_report;

use crate::written::Word;

/// What a case may ask.
pub const WORDS: &[Word] = &[
    Word::of::<wave::PulseCostAsked>("pulse_cost"),
    Word::of::<jump::JumpCostAsked>("jump_cost"),
    Word::of::<wave::WaveCostAsked>("wave_cost"),
    Word::of::<crack::CrackCostAsked>("crack_cost"),
    Word::of::<ablation::AblationAsked>("ablation"),
];

/// Files that cases share; no figure may take their names.
pub const TABLES: &[&str] =
    &["ablation", "work_precision", "work_exponents", "work_cheapest", "work_choices", "verdicts"];

/// Ends of the names of figures beside the one that is called like its case.
pub const SUFFIXES: &[&str] = &[];
