//! `pd-verify stability`: cases that break codes: time steps at and beyond the limit of a body, very many steps, rotations, other units, digits lost.

pub mod arithmetic;
mod arithmetic_sums;
pub mod body;
pub mod discontinuities;
mod discontinuities_report;
pub mod divergence;
mod divergence_report;
pub mod geometry;
mod geometry_report;
mod growing;
mod jumps;
pub mod long_run;
mod long_run_report;
pub mod rotation;
pub mod scaling;
mod shape;
mod sound;
pub mod time_step;
mod time_step_report;

use crate::written::Word;

/// What a case may ask.
pub const WORDS: &[Word] = &[
    Word::of::<time_step::TimeStepAsked>("time_step"),
    Word::of::<divergence::DivergenceAsked>("divergence"),
    Word::of::<discontinuities::DiscontinuitiesAsked>("discontinuities"),
    Word::of::<geometry::GeometryAsked>("geometry"),
    Word::of::<long_run::LongRunAsked>("long_run"),
    Word::of::<rotation::RotationAsked>("rotation"),
    Word::of::<scaling::ScalingAsked>("scaling"),
    Word::of::<arithmetic::ArithmeticAsked>("arithmetic"),
];

/// Files that cases share; no figure may take their names.
pub const TABLES: &[&str] = &[
    "stability_arithmetic",
    "stability_discontinuities",
    "stability_divergence",
    "stability_geometry",
    "stability_long_run",
    "stability_rotation",
    "stability_scaling",
    "stability_time_steps",
    "verdicts",
];

/// Ends of the names of figures beside the one that is called like its case.
pub const SUFFIXES: &[&str] = &["-mode"];
