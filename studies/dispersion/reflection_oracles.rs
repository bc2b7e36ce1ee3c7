//! `asks = "reflection_oracles"`: the joint of finite differences and a lattice, m = 3, against printed and exact values.

use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of, value_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::dispersion::joint::{Chain, cut_off};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Lattice;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::Wrong;
use pd_verify_reference::oracles;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written: it has no parameters, its values are printed.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReflectionOraclesAsked {}

/// The case.
pub struct ReflectionOracles;

impl Asked for ReflectionOraclesAsked {
    type Question = ReflectionOracles;

    fn check(&self, _: &Written<'_>) -> Result<ReflectionOracles, Wrong> {
        Ok(ReflectionOracles)
    }
}

/// The joint whose reflections are printed: finite differences on the left, this on the right.
const RIGHT: Lattice =
    Lattice { kernel: Kernel::Constant, m: 3.0, volume_rule: VolumeRule::Linear, calibrated: false };
/// kΔx of incident waves above the cut-off.
const ABOVE: [f64; 4] = [1.15, 1.6, 2.2, 2.9];

impl Question for ReflectionOracles {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let printed = |name, what| {
            claim(place, name, format!("largest error in half units of the last digit: {what}"))
                .at_most(ErrorKind::Absolute, 1.0 + 1e-9)
                .because(Basis::Rounding, "a printed number stands for half a unit in its last digit")
                .source("printed values of an independent derivation (reference/data/published_values.csv)")
        };
        vec![
            printed("exact", "exact |R| at kΔx = 0.5, 0.8, 1.0"),
            printed("published", "|R| by impedances at equal k, at kΔx = 0.5, 0.8, 1.0"),
            printed("total_printed", "ωΔx/v above which everything comes back"),
            claim(place, "cut_off", "ωΔx/v above which everything comes back")
                .within(ErrorKind::Absolute, 1e-12)
                .because(Basis::Rounding, "the maximum of a trigonometric polynomial of degree 3, at kΔx = π")
                .source("ω(π) of the constant kernel with half end volumes, m = 3: √(28/27)"),
            claim(place, "total", "largest |1 − |R|| above the cut-off")
                .at_most(ErrorKind::Absolute, 1e-10)
                .because(
                    Basis::Theory,
                    "one travelling wave on the left and none on the right carry no energy away",
                )
                .source("conservation: no wave of the right chain has this frequency"),
        ]
    }

    fn effort(&self) -> Effort {
        Effort { curves: 3, evaluations: 11, bond_evaluations: 11 * 400, ..Effort::default() }
    }

    fn equations(&self) -> &'static str {
        "finite differences | constant kernel, m = 3, half end volumes; total reflection above ωΔx/v = √(28/27)"
    }

    fn answer(&self, subject: &dyn Subject, _: &Place) -> Answer {
        let Ok(stencil) = subject.bar_stencil(RIGHT) else { return Answer::default() };
        let (left, right) = (Chain::finite_differences(), Chain::peridynamic(&stencil));
        let exact = |k: f64| subject.reflection(&left, &right, k).map_or(f64::NAN, |found| found.norm());
        let published = |k: f64| subject.published_reflection(&left, &right, k).abs();
        let half_units = |quantity: &str, value: &dyn Fn(f64) -> f64| {
            let rows = oracles::published(quantity);
            let errors = rows
                .iter()
                .map(|row| (value(row.argument.unwrap_or(f64::NAN)) - row.value).abs() / row.half_unit);
            error_of(largest(errors), format!("{} values", rows.len()))
        };
        let cut = cut_off(&stencil);
        let evidence = vec![
            ("exact".into(), half_units("reflection_fd_lattice", &exact)),
            ("published".into(), half_units("published_reflection_fd_lattice", &published)),
            ("total_printed".into(), half_units("total_reflection_omega", &|_| cut)),
            ("cut_off".into(), value_of(Some(cut), Some((28.0_f64 / 27.0).sqrt()), "")),
            (
                "total".into(),
                error_of(largest(ABOVE.map(|k| (1.0 - exact(k)).abs())), "kΔx = 1.15, 1.6, 2.2, 2.9"),
            ),
        ];
        Answer { evidence, ..Answer::default() }
    }
}
