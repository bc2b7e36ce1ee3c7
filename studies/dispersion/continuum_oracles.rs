//! `asks = "continuum_oracles"`: continuum waves against tables computed to 40 digits and more.

use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::dispersion::{Branch, Wave};
use pd_verify::kernel::Kernel;
use pd_verify::scene::Wrong;
use pd_verify_reference as reference;
use pd_verify_reference::oracles;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written: it has no parameters, its tables are fixed.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContinuumOraclesAsked {}

/// The case.
pub struct ContinuumOracles;

impl Asked for ContinuumOraclesAsked {
    type Question = ContinuumOracles;

    fn check(&self, _: &Written<'_>) -> Result<ContinuumOracles, Wrong> {
        Ok(ContinuumOracles)
    }
}

const FAMILIES: [(&str, u8, &str); 3] = [("bar", 1, "P"), ("plane_p", 2, "P"), ("plane_s", 2, "S")];

impl Question for ContinuumOracles {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let mut claims = vec![
            claim(place, "printed", "largest relative error of ω/(kv), bar, kδ = 1e-6 … 40")
                .at_most(ErrorKind::Relative, 1e-13)
                .because(Basis::Rounding, "quadrature of a positive integrand keeps its digits")
                .source("20 values printed to 17 digits from 40-digit arithmetic, an independent derivation"),
        ];
        for (name, ..) in FAMILIES {
            let quantity =
                format!("largest relative error of ω/(kc), {}, kδ = 1e-8 … 1e4", name.replace('_', " "));
            claims.push(
                claim(place, name, quantity)
                    .at_most(ErrorKind::Relative, 1e-13)
                    .because(Basis::Rounding, "quadrature of a positive integrand keeps its digits")
                    .source("table to 20 digits by power series in 60-digit arithmetic (reference/data)"),
            );
            claims.push(
                claim(
                    place,
                    &group_name(name),
                    format!("largest error of (dω/dk)/c, {}", name.replace('_', " ")),
                )
                .at_most(ErrorKind::Absolute, 1e-12)
                .because(Basis::Rounding, "the slope's integrand changes sign kδ/π times")
                .source("the same table"),
            );
        }
        claims
    }

    fn effort(&self) -> Effort {
        Effort { curves: 33, evaluations: 614, bond_evaluations: 614 * 2000, ..Effort::default() }
    }

    fn equations(&self) -> &'static str {
        "bar: (ωδ/v)² = (2/M₁) ∫₀¹ W(s) (1 − cos kδs)/s ds; constant kernel: (ωδ/v)² = 4 Cin(kδ)
plane: (ωδ/c_d)² = (8/3M₂) ∫₀¹ W (1 − 2J₀ + 2J₁/x) ds; (ωδ/c_s)² = (8/M₂) ∫₀¹ W (1 − 2J₁/x) ds, x = kδs"
    }

    fn answer(&self, subject: &dyn Subject, _: &Place) -> Answer {
        let table = oracles::continuum_table();
        let mut evidence = vec![("printed".to_owned(), printed(subject))];
        for (name, dimension, branch) in FAMILIES {
            let rows: Vec<_> =
                table.iter().filter(|row| row.dimension == dimension && row.branch == branch).collect();
            let waves: Vec<Wave> = rows
                .iter()
                .map(|row| wave(subject, dimension, branch, kernel(row.kernel), row.k_horizon))
                .collect();
            let phase = rows.iter().zip(&waves).map(|(row, wave)| {
                (wave.omega / row.k_horizon - row.phase_speed_ratio).abs() / row.phase_speed_ratio
            });
            let group = rows.iter().zip(&waves).map(|(row, wave)| (wave.group - row.group_speed_ratio).abs());
            evidence.push((name.to_owned(), error_of(largest(phase), format!("{} values", rows.len()))));
            evidence.push((group_name(name), error_of(largest(group), format!("{} values", rows.len()))));
        }
        Answer { evidence, ..Answer::default() }
    }
}

fn group_name(name: &str) -> String {
    format!("{name}_group")
}

fn printed(subject: &dyn Subject) -> pd_verify::verdict::Evidence {
    let rows = oracles::published("continuum_bar_phase_speed");
    let errors = rows.iter().map(|row| {
        let (Some(given), Some(z)) = (row.kernel, row.argument) else { return f64::NAN };
        (subject.continuum_bar(kernel(given), z).omega / z - row.value).abs() / row.value
    });
    error_of(largest(errors), format!("{} values", rows.len()))
}

fn wave(subject: &dyn Subject, dimension: u8, branch: &str, kernel: Kernel, z: f64) -> Wave {
    match (dimension, branch) {
        (1, _) => subject.continuum_bar(kernel, z),
        (_, "P") => subject.continuum_plane(kernel, Branch::P, z),
        _ => subject.continuum_plane(kernel, Branch::S, z),
    }
}

/// The reference's kernel in the library's words.
pub fn kernel(kernel: reference::Kernel) -> Kernel {
    match kernel {
        reference::Kernel::Constant => Kernel::Constant,
        reference::Kernel::Gaussian { p } => Kernel::Gaussian { p },
        reference::Kernel::Exponential { p } => Kernel::Exponential { p },
        reference::Kernel::Conical => Kernel::Conical,
        reference::Kernel::Parabolic => Kernel::Parabolic,
    }
}
