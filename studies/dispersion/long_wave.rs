//! `asks = "long_wave"`: the leading phase error of long waves, fitted and held against its closed form.

use super::curve::{Curve, Medium};
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, value_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::dispersion::Branch;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::Wrong;
use pd_verify_reference::oracles;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written: it has no parameters, its coefficients are fixed.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LongWaveAsked {}

/// The case.
pub struct LongWave;

impl Asked for LongWaveAsked {
    type Question = LongWave;

    fn check(&self, _: &Written<'_>) -> Result<LongWave, Wrong> {
        Ok(LongWave)
    }
}

/// A coefficient a of the phase error a x², x = kδ or kΔx.
struct Coefficient {
    name: &'static str,
    quantity: String,
    curve: Curve,
    exact: f64,
    /// The exact value's own uncertainty, relative.
    printed_to: f64,
}

const M: f64 = 5.0;
const COURANT: f64 = 0.6;

fn curve(medium: Medium, courant: Option<f64>) -> Curve {
    Curve { body: Body::Bar, medium, courant, branch: Branch::P, degrees: 0.0 }
}

fn coefficients() -> Vec<Coefficient> {
    let continuum = |kernel| curve(Medium::Continuum { kernel, horizon: 1.0 }, None);
    let lattice =
        Lattice { kernel: Kernel::Constant, m: M, volume_rule: VolumeRule::Linear, calibrated: false };
    let differences = |courant| curve(Medium::FiniteDifferences { dx: 1.0 }, courant);
    let mut all = vec![
        Coefficient {
            name: "continuum",
            quantity: "(phase error)/(kδ)² as k → 0: continuum, constant kernel".into(),
            curve: continuum(Kernel::Constant),
            exact: -1.0 / 48.0,
            printed_to: 0.0,
        },
        Coefficient {
            name: "lattice",
            quantity: "(phase error)/(kδ)² as k → 0: lattice, constant kernel, half end volume, m = 5".into(),
            curve: curve(Medium::Lattice { lattice, dx: 1.0 / M }, None),
            exact: -(1.0 + 1.0 / (M * M)) / 48.0,
            printed_to: 0.0,
        },
        Coefficient {
            name: "finite_differences",
            quantity: "(phase error)/(kΔx)² as k → 0: finite differences".into(),
            curve: differences(None),
            exact: -1.0 / 24.0,
            printed_to: 0.0,
        },
        Coefficient {
            name: "finite_differences_leapfrog",
            quantity: "(phase error)/(kΔx)² as k → 0: finite differences with leapfrog, C = 0.6".into(),
            curve: differences(Some(COURANT)),
            exact: -(1.0 - COURANT * COURANT) / 24.0,
            printed_to: 0.0,
        },
    ];
    for (name, p) in [("gaussian_1", 1.0), ("gaussian_2", 2.0), ("gaussian_3", 3.0)] {
        let rows = oracles::published("continuum_bar_long_wave_coefficient");
        let of_p =
            |row: &&oracles::PublishedOracle| row.kernel == Some(pd_verify_reference::Kernel::Gaussian { p });
        let (exact, half_unit) =
            rows.iter().find(of_p).map_or((f64::NAN, 0.0), |row| (row.value, row.half_unit));
        all.push(Coefficient {
            name,
            quantity: format!("(phase error)/(kδ)² as k → 0: continuum, Gaussian p = {p}"),
            curve: continuum(Kernel::Gaussian { p }),
            exact,
            printed_to: (half_unit / exact).abs(),
        });
    }
    all
}

/// What the fit leaves of the terms beyond x⁶, relative.
const TRUNCATION: f64 = 1e-7;

impl Question for LongWave {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        coefficients()
            .into_iter()
            .map(|c| {
                let tolerance = (TRUNCATION + c.printed_to) * c.exact.abs();
                claim(place, c.name, c.quantity)
                    .within(ErrorKind::Absolute, tolerance)
                    .because(
                        Basis::Theory,
                        "three levels eliminate x⁴ and x⁶; x⁸ is below 1e-7 of the coefficient",
                    )
                    .source(
                        "Taylor series of the dispersion relation: −M₃/(24 M₁) (kδ)², −(1 − C²)/24 (kΔx)²",
                    )
            })
            .collect()
    }

    fn effort(&self) -> Effort {
        Effort { curves: 7, evaluations: 21, bond_evaluations: 21 * 42, ..Effort::default() }
    }

    fn equations(&self) -> &'static str {
        "ω/(vk) − 1 = −(M₃/(24 M₁)) (kδ)² + O((kδ)⁴); constant kernel −(kδ)²/48, its lattice −(1 + 1/m²)(kδ)²/48
finite differences −(kΔx)²/24, with leapfrog −(1 − C²)(kΔx)²/24"
    }

    fn answer(&self, subject: &dyn Subject, _: &Place) -> Answer {
        let evidence = coefficients().into_iter().map(|c| {
            let fitted = fit(subject, &c.curve);
            (
                c.name.to_owned(),
                value_of(fitted, Some(c.exact), "fitted over k = 0.24, 0.12, 0.06 by elimination"),
            )
        });
        Answer { evidence: evidence.collect(), ..Answer::default() }
    }
}

/// lim (ω/k − 1)/k² from k = 0.24, 0.12, 0.06: Richardson's elimination of the next two even powers.
fn fit(subject: &dyn Subject, curve: &Curve) -> Option<f64> {
    let prepared = curve.prepare(subject).ok()?;
    let at = |k: f64| prepared.wave(k).map(|wave| (wave.phase(k) - 1.0) / (k * k));
    let (coarse, middle, fine) = (at(0.24)?, at(0.12)?, at(0.06)?);
    let (first, second) = ((4.0 * middle - coarse) / 3.0, (4.0 * fine - middle) / 3.0);
    Some((16.0 * second - first) / 15.0)
}
