//! What theory says of a refinement in which m grows: the order in 1/m of each volume rule, or that there is none.
//!
//! A bar: by Euler–Maclaurin a whole end cell errs by its half, order 1 where the kernel does not vanish at δ, half an end
//! cell by order 2 (DLMF 2.10(i)). The plane: by Poisson's summation formula the sum over nodes differs from the integral by
//! the transform of what is summed at the reciprocal vectors g/Δx, g ≠ 0.

use super::path::{Refine, Sequence};
use crate::dispersion::m_convergence;
use crate::levels::{self, tail_order};
use crate::question::{Claiming, Place, claim};
use pd_verify::claim::{Basis, Claim};
use pd_verify::compare::order::pairwise;
use pd_verify::verdict::Evidence;

/// What is expected of a refinement in which m grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Expected {
    /// A power of the step.
    Order(f64),
    /// No power: pairwise orders scatter.
    Irregular,
}

/// By the dimension, the rule and the kernel.
pub fn expected<const D: usize>(sequence: &Sequence) -> Expected {
    let _ = D;
    let in_m = m_convergence::expected(sequence.weights.kernel, sequence.weights.volume_rule);
    Expected::Order(match sequence.refine {
        Refine::M => in_m,
        Refine::Delta => 2.0,
        Refine::DeltaM => in_m.min(2.0),
    })
}

/// Name of the claim about a sequence that is claimed by itself.
pub fn name_of(sequence: &Sequence) -> String {
    sequence.weights.slug()
}

/// The claim about a sequence that is claimed by itself.
pub fn claim_of<const D: usize>(
    place: &Place,
    sequence: &Sequence,
    name: &str,
    what: &str,
    source: &str,
) -> Claim {
    let by = if sequence.refine == Refine::M { "1/m" } else { "δ" };
    let started =
        claim(place, &name_of(sequence), format!("order in {by} of the error in l2 of {what}: {name}"));
    let claimed = match expected::<D>(sequence) {
        Expected::Order(order) => started.order(order, 0.1).because(Basis::Theory, "TODO"),
        Expected::Irregular => started.at_least(0.5).because(Basis::Theory, "TODO"),
    };
    claimed.source(source)
}

/// Evidence for [`claim_of`], in L2.
pub fn evidence_of(expected: &Expected, name: &str, levels: &levels::Sequence, floor: f64) -> Evidence {
    let in_l2 = levels.in_norm(1);
    match expected {
        Expected::Order(order) => tail_order(name, &in_l2, *order, floor),
        Expected::Irregular => {
            let orders: Vec<f64> = in_l2.windows(2).filter_map(|pair| pairwise(pair[0], pair[1])).collect();
            let most = orders.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let least = orders.iter().copied().fold(f64::INFINITY, f64::min);
            let note = format!("{name}: pairwise orders from {least:.2} to {most:.2}");
            Evidence { computed: (orders.len() >= 2).then_some(most - least), note, ..Evidence::default() }
        }
    }
}
