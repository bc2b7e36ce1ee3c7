//! `pd-verify dispersion`: how waves travel in bond-based peridynamics, asked case by case and judged.
//!
//! A case says what it `asks`; each word has a file here with the case as written, its check, its claims and its
//! answer. [`read_case`] is the one place that turns words into questions.

pub mod continuum_oracles;
pub mod curve;
mod curve_report;
mod curve_sweep;
pub mod curves;
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
mod words;

use crate::input::{Document, Refusal, nearest};
use crate::question::Question;
use pd_verify::material::Material;
use pd_verify::scene::Wrong;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::DeserializeOwned;
use serde_json::Value;

/// The words a case may ask.
pub const ASKS: [&str; 14] = [
    "curves",
    "micromodulus",
    "continuum_oracles",
    "lattice_oracles",
    "long_wave",
    "m_convergence",
    "symmetry",
    "small_p",
    "moduli",
    "time_step",
    "reflection",
    "reflection_oracles",
    "polar",
    "heat_map",
];

/// Files that cases share; no figure may take their names.
pub const TABLES: [&str; 11] = [
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

/// The word that only the shipped studies need.
const MISPRINTS: &str = "misprints";

/// Keys that every case has beside its own.
pub const COMMON_KEYS: [&str; 4] = ["id", "asks", "title", "profile"];

/// What a case is read from.
pub struct Written<'a> {
    pub document: &'a Document,
    /// `case[3]`, for messages.
    pub path: String,
    pub value: &'a Value,
    pub title: &'a str,
    pub material: Option<Material>,
}

impl Written<'_> {
    fn read<T: DeserializeOwned>(&self) -> Result<T, Refusal> {
        self.document.read(&self.path, self.value, &COMMON_KEYS)
    }

    fn checked<Q: Question + 'static>(
        &self,
        checked: Result<Q, Wrong>,
    ) -> Result<Box<dyn Question>, Refusal> {
        match checked {
            Ok(question) => Ok(Box::new(question)),
            Err(wrong) => {
                let path = if wrong.key.is_empty() {
                    self.path.clone()
                } else {
                    format!("{}.{}", self.path, wrong.key)
                };
                Err(self.document.refuse(&path, wrong.message).help(wrong.help))
            }
        }
    }
}

/// Turns a case's words into its question, or says what is wrong with them.
pub fn read_case(asks: &str, written: &Written<'_>) -> Result<Box<dyn Question>, Refusal> {
    let title = written.title;
    match asks {
        "curves" => {
            let asked: curves::CurvesAsked = written.read()?;
            written.checked(asked.check(title, written.material))
        }
        "micromodulus" => written.checked(written.read::<micromodulus::MicromodulusAsked>()?.check(title)),
        "continuum_oracles" => {
            written.read::<continuum_oracles::ContinuumOraclesAsked>()?;
            written.checked(Ok(continuum_oracles::ContinuumOracles))
        }
        "lattice_oracles" => {
            written.read::<lattice_oracles::LatticeOraclesAsked>()?;
            written.checked(Ok(lattice_oracles::LatticeOracles))
        }
        "long_wave" => {
            written.read::<long_wave::LongWaveAsked>()?;
            written.checked(Ok(long_wave::LongWave))
        }
        "m_convergence" => written.checked(written.read::<m_convergence::MConvergenceAsked>()?.check(title)),
        "symmetry" => written.checked(written.read::<symmetry::SymmetryAsked>()?.check()),
        "small_p" => {
            written.read::<small_p::SmallPAsked>()?;
            written.checked(Ok(small_p::SmallP))
        }
        "moduli" => written.checked(written.read::<moduli::ModuliAsked>()?.check(title)),
        "time_step" => written.checked(written.read::<time_step::TimeStepAsked>()?.check(title)),
        "reflection" => written.checked(written.read::<reflection::ReflectionAsked>()?.check(title)),
        "reflection_oracles" => {
            written.read::<reflection_oracles::ReflectionOraclesAsked>()?;
            written.checked(Ok(reflection_oracles::ReflectionOracles))
        }
        "polar" => written.checked(written.read::<polar::PolarAsked>()?.check(title)),
        "heat_map" => written.checked(written.read::<heat_map::HeatMapAsked>()?.check(title)),
        MISPRINTS => {
            written.read::<misprints::MisprintsAsked>()?;
            written.checked(Ok(misprints::Misprints))
        }
        unknown => {
            let listed = format!("a dispersion case asks one of: {}", ASKS.join(", "));
            let help = match nearest(unknown, ASKS) {
                Some(word) => format!("did you mean \"{word}\"? {listed}"),
                None => listed,
            };
            let message = format!("no case asks \"{unknown}\"");
            Err(written.document.refuse(&format!("{}.asks", written.path), message).help(help))
        }
    }
}

/// The schema of each kind of case, by the word it asks.
pub fn case_schemas(generator: &mut SchemaGenerator) -> Vec<(&'static str, Schema)> {
    fn of<T: JsonSchema>(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
    vec![
        ("curves", of::<curves::CurvesAsked>(generator)),
        ("micromodulus", of::<micromodulus::MicromodulusAsked>(generator)),
        ("continuum_oracles", of::<continuum_oracles::ContinuumOraclesAsked>(generator)),
        ("lattice_oracles", of::<lattice_oracles::LatticeOraclesAsked>(generator)),
        ("long_wave", of::<long_wave::LongWaveAsked>(generator)),
        ("m_convergence", of::<m_convergence::MConvergenceAsked>(generator)),
        ("symmetry", of::<symmetry::SymmetryAsked>(generator)),
        ("small_p", of::<small_p::SmallPAsked>(generator)),
        ("moduli", of::<moduli::ModuliAsked>(generator)),
        ("time_step", of::<time_step::TimeStepAsked>(generator)),
        ("reflection", of::<reflection::ReflectionAsked>(generator)),
        ("reflection_oracles", of::<reflection_oracles::ReflectionOraclesAsked>(generator)),
        ("polar", of::<polar::PolarAsked>(generator)),
        ("heat_map", of::<heat_map::HeatMapAsked>(generator)),
        (MISPRINTS, of::<misprints::MisprintsAsked>(generator)),
    ]
}
