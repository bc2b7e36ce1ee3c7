//! `pd-verify dispersion`: how waves travel in bond-based peridynamics, asked case by case and judged.
//!
//! A case says what it `asks`; each word has a file here with the case as written, its check, its claims and its
//! answer; [`WORDS`] is their table.

pub mod continuum_oracles;
pub mod curve;
mod curve_report;
mod curve_sweep;
pub mod curves;
mod foreign;
pub mod heat_map;
mod label;
pub mod lattice_oracles;
mod lattice_table;
pub mod long_wave;
pub mod m_convergence;
pub mod micromodulus;
pub mod misprints;
pub mod moduli;
pub mod polar;
pub mod reflection;
pub mod reflection_oracles;
pub mod small_p;
pub mod sweep;
pub mod symmetry;
pub mod time_step;
mod trace;
mod wavenumbers;
pub mod words;

use crate::written::Word;

/// What a case may ask.
pub const WORDS: &[Word] = &[
    Word::of::<curves::CurvesAsked>("curves"),
    Word::of::<micromodulus::MicromodulusAsked>("micromodulus"),
    Word::of::<continuum_oracles::ContinuumOraclesAsked>("continuum_oracles"),
    Word::of::<lattice_oracles::LatticeOraclesAsked>("lattice_oracles"),
    Word::of::<long_wave::LongWaveAsked>("long_wave"),
    Word::of::<m_convergence::MConvergenceAsked>("m_convergence"),
    Word::of::<symmetry::SymmetryAsked>("symmetry"),
    Word::of::<small_p::SmallPAsked>("small_p"),
    Word::of::<moduli::ModuliAsked>("moduli").all_figures_suffixed(),
    Word::of::<time_step::TimeStepAsked>("time_step"),
    Word::of::<reflection::ReflectionAsked>("reflection"),
    Word::of::<reflection_oracles::ReflectionOraclesAsked>("reflection_oracles"),
    Word::of::<polar::PolarAsked>("polar"),
    Word::of::<heat_map::HeatMapAsked>("heat_map"),
    // Only the shipped studies need it.
    Word::of::<misprints::MisprintsAsked>("misprints").not_offered(),
];

/// Files that cases share; no figure may take their names.
pub const TABLES: &[&str] = &[
    "dispersion_curves",
    "dispersion_velocities",
    "dispersion_m_convergence",
    "phase_error_thresholds",
    "micromodulus_constants",
    "moduli",
    "timestep",
    "reflection_coefficients",
    "polar_phase_error",
    "worst_phase_error",
    "verdicts",
];

/// Ends of the names of figures beside the one that is called like its case.
pub const SUFFIXES: &[&str] = &["-velocity", "-full", "-linear", "-exact-area"];
