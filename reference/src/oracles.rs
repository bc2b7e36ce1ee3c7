//! Tabulated answers with their provenance, built in: what the functions of this crate and the solver must meet.
//!
//! `data/continuum_dispersion.csv` (mpmath, 20 digits) and `data/published_values.csv` (numbers as printed in
//! the project's derivation, rounded where they were printed); `data/README.md` says where each comes from.

use crate::{Kernel, VolumeRule};

/// The continuum table as a file.
pub const CONTINUUM_CSV: &str = include_str!("../data/continuum_dispersion.csv");
/// The printed numbers as a file.
pub const PUBLISHED_CSV: &str = include_str!("../data/published_values.csv");

/// A plane wave of the continuum, to 20 digits before rounding to doubles.
#[derive(Clone, Debug, PartialEq)]
pub struct ContinuumOracle {
    /// 1 for the bar, 2 for the plane.
    pub dimension: u8,
    /// "P" or "S".
    pub branch: String,
    /// Kernel.
    pub kernel: Kernel,
    /// kδ, exactly this double.
    pub k_horizon: f64,
    /// ω/(kc), c the classical speed of the branch.
    pub phase_speed_ratio: f64,
    /// (dω/dk)/c.
    pub group_speed_ratio: f64,
}

/// A printed number.
#[derive(Clone, Debug, PartialEq)]
pub struct PublishedOracle {
    /// Section of the derivation it was printed in.
    pub section: String,
    /// What it is; `data/README.md` defines each name.
    pub quantity: String,
    /// Kernel, where one applies.
    pub kernel: Option<Kernel>,
    /// Horizon over spacing, where one applies.
    pub m: Option<f64>,
    /// Volume rule, where one applies.
    pub rule: Option<VolumeRule>,
    /// Whether the lattice is calibrated, where that applies.
    pub calibrated: Option<bool>,
    /// kδ, k in 1/m or kΔx, as the quantity says.
    pub argument: Option<f64>,
    /// The number.
    pub value: f64,
    /// Half a unit in its last printed digit, and at least the spacing of doubles there.
    pub half_unit: f64,
}

/// The continuum table: bar, plane P and plane S for eleven kernels and eighteen wave numbers.
pub fn continuum_table() -> Vec<ContinuumOracle> {
    rows(CONTINUUM_CSV)
        .map(|cells| ContinuumOracle {
            dimension: number(cells[0]) as u8,
            branch: cells[1].to_owned(),
            kernel: kernel(cells[2], cells[3]).expect("every row of the continuum table names a kernel"),
            k_horizon: number(cells[4]),
            phase_speed_ratio: number(cells[5]),
            group_speed_ratio: number(cells[6]),
        })
        .collect()
}

/// Every printed number.
pub fn published_table() -> Vec<PublishedOracle> {
    rows(PUBLISHED_CSV)
        .map(|cells| {
            let (value, decimals) = (number(cells[8]), number(cells[9]));
            let spacing = value.abs() * f64::EPSILON;
            PublishedOracle {
                section: cells[0].to_owned(),
                quantity: cells[1].to_owned(),
                kernel: kernel(cells[2], cells[3]),
                m: optional(cells[4]),
                rule: rule(cells[5]),
                calibrated: (!cells[6].is_empty()).then(|| cells[6] == "true"),
                argument: optional(cells[7]),
                value,
                half_unit: (0.5 * 10.0_f64.powi(-(decimals as i32))).max(spacing),
            }
        })
        .collect()
}

/// The printed numbers called `quantity`.
pub fn published(quantity: &str) -> Vec<PublishedOracle> {
    published_table().into_iter().filter(|row| row.quantity == quantity).collect()
}

fn rows(text: &str) -> impl Iterator<Item = Vec<&str>> {
    text.lines().skip(1).filter(|line| !line.is_empty()).map(|line| line.split(',').collect())
}

fn number(text: &str) -> f64 {
    text.parse().expect("the built-in tables hold numbers")
}

fn optional(text: &str) -> Option<f64> {
    (!text.is_empty()).then(|| number(text))
}

fn kernel(name: &str, p: &str) -> Option<Kernel> {
    match name {
        "constant" => Some(Kernel::Constant),
        "gaussian" => Some(Kernel::Gaussian { p: number(p) }),
        "exponential" => Some(Kernel::Exponential { p: number(p) }),
        "conical" => Some(Kernel::Conical),
        "parabolic" => Some(Kernel::Parabolic),
        _ => None,
    }
}

fn rule(name: &str) -> Option<VolumeRule> {
    match name {
        "full" => Some(VolumeRule::Full),
        "linear" => Some(VolumeRule::Linear),
        "exact_area" => Some(VolumeRule::ExactArea),
        _ => None,
    }
}
