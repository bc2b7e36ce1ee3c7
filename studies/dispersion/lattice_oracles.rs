//! `asks = "lattice_oracles"`: lattice frequencies, moduli, calibration and time steps against printed numbers.

use super::continuum_oracles::kernel;
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::Wrong;
use pd_verify::verdict::Evidence;
use pd_verify_reference as reference;
use pd_verify_reference::oracles::{self, PublishedOracle};
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written: it has no parameters, its tables are fixed.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LatticeOraclesAsked {}

/// The case.
pub struct LatticeOracles;

impl Asked for LatticeOraclesAsked {
    type Question = LatticeOracles;

    fn check(&self, _: &Written<'_>) -> Result<LatticeOracles, Wrong> {
        Ok(LatticeOracles)
    }
}

/// What each group of printed numbers is compared with, and in which words.
const GROUPS: [(&str, &[&str], &str); 6] = [
    ("frequencies", &["lattice_bar_omega_over_v"], "ω/v at k = 500 1/m, Δx = 2 mm, m = 3 and 10"),
    ("long_wave_speeds", &["lattice_bar_long_wave_speed"], "long-wave speed of the bar's lattice over v"),
    (
        "moduli",
        &["lattice_plane_c11", "lattice_plane_c12"],
        "lattice C11 and C12 = C66 over the intended ones, plane",
    ),
    (
        "calibration",
        &["calibration_alpha", "calibration_beta"],
        "calibration α + β cos 4θ, Gaussian p = 2, m = 3, linear",
    ),
    ("neighbours", &["neighbours_plane"], "nodes in a family of the plane, m = 3"),
    (
        "time_steps",
        &["bar_sharp_over_row_sum", "plane_sharp_over_row_sum"],
        "sharp time step over the row-sum bound",
    ),
];

impl Question for LatticeOracles {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let mut claims: Vec<Claim> = GROUPS
            .iter()
            .map(|(name, _, quantity)| {
                claim(
                    place,
                    name,
                    format!("largest error in half units of the last printed digit: {quantity}"),
                )
                .at_most(ErrorKind::Absolute, 1.0 + 1e-9)
                .because(Basis::Rounding, "a printed number stands for half a unit in its last digit")
                .source("printed values of an independent derivation (reference/data/published_values.csv)")
            })
            .collect();
        claims[0] = claim(place, GROUPS[0].0, format!("largest relative error: {}", GROUPS[0].2))
            .at_most(ErrorKind::Relative, 1e-13)
            .because(Basis::Rounding, "sums of up to ten positive terms")
            .source("17-digit values of an independent derivation (reference/data/published_values.csv)");
        claims
    }

    fn effort(&self) -> Effort {
        Effort { curves: 75, evaluations: 75, bond_evaluations: 75 * 100, ..Effort::default() }
    }

    fn equations(&self) -> &'static str {
        "(ωΔx/v)² = Σ w_j 4 sin²(jkΔx/2); C₁₁ = Σ w |r|² cos⁴θ, C₁₂ = C₆₆ = Σ w |r|² cos²θ sin²θ over half the family
Δt = 2/ω_max; row sum: Δt = √(2ρ/Σ cV/|ξ|)"
    }

    fn answer(&self, subject: &dyn Subject, _: &Place) -> Answer {
        let evidence =
            GROUPS.iter().map(|(name, quantities, _)| ((*name).to_owned(), judge(subject, name, quantities)));
        Answer { evidence: evidence.collect(), ..Answer::default() }
    }
}

fn judge(subject: &dyn Subject, name: &str, quantities: &[&str]) -> Evidence {
    let rows: Vec<PublishedOracle> =
        quantities.iter().flat_map(|quantity| oracles::published(quantity)).collect();
    let errors = rows.iter().map(|row| {
        let Some(computed) = compute(subject, row) else { return f64::NAN };
        let scale = if name == "frequencies" { row.value } else { row.half_unit };
        (computed - row.value).abs() / scale
    });
    error_of(largest(errors), format!("{} values", rows.len()))
}

fn compute(subject: &dyn Subject, row: &PublishedOracle) -> Option<f64> {
    let volume_rule = match row.rule? {
        reference::VolumeRule::Full => VolumeRule::Full,
        reference::VolumeRule::Linear => VolumeRule::Linear,
        reference::VolumeRule::ExactArea => VolumeRule::ExactArea,
    };
    let calibrated = row.quantity.starts_with("calibration");
    let kernel = row.kernel.map_or(pd_verify::kernel::Kernel::Constant, kernel);
    let lattice = Lattice { kernel, m: row.m?, volume_rule, calibrated };
    let bar = || subject.bar_stencil(lattice).ok();
    let plane = || subject.plane_stencil(lattice).ok();
    let ratio = |step: pd_verify::dispersion::timestep::TimeStep| step.sharp / step.row_sum;
    match row.quantity.as_str() {
        "lattice_bar_omega_over_v" => bar_frequency(subject, &bar()?, row.argument?),
        "lattice_bar_long_wave_speed" => Some(bar()?.after.c11.sqrt()),
        "lattice_plane_c11" => Some(plane()?.after.c11),
        "lattice_plane_c12" => Some(plane()?.after.c12),
        "calibration_alpha" => plane()?.calibration.map(|c| c.alpha),
        "calibration_beta" => plane()?.calibration.map(|c| c.beta),
        "neighbours_plane" => Some(2.0 * plane()?.bonds.len() as f64),
        "bar_sharp_over_row_sum" => Some(ratio(subject.bar_time_step(&bar()?))),
        "plane_sharp_over_row_sum" => Some(ratio(subject.plane_time_step(&plane()?))),
        _ => None,
    }
}

/// ω/v in 1/m at Δx = 2 mm.
fn bar_frequency(subject: &dyn Subject, stencil: &Stencil<1>, k: f64) -> Option<f64> {
    let dx = 0.002;
    Some(subject.bar_wave(&BarDispersion::new(stencil), k * dx).omega / dx)
}
