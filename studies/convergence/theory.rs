//! What theory says of a refinement in which m grows: the order of each volume rule, or that pairs of levels show none.
//!
//! A bar: by Euler–Maclaurin a whole end cell errs by its half, order 1 where the kernel does not vanish at δ, half an end
//! cell by order 2 (DLMF 2.10(i)). The plane: by Poisson's summation formula `exact_area` errs by m^(−2), and the rest by
//! m^(−5/2); nodes that enter and leave the rim make `full` err by m^(−3/2) and ties by m^(−1), and leave `linear` a small
//! part of that: their errors fall, but pairs of levels show no order (`asks = "volume_rules"` looks at every m).

use super::path::{Refine, Sequence};
use crate::dispersion::m_convergence;
use crate::levels::{self, tail_order};
use crate::question::{Claiming, Place, claim, value_of};
use pd_verify::claim::{Basis, Claim};
use pd_verify::compare::order::fitted;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::verdict::Evidence;

/// What is expected of a refinement in which m grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Expected {
    /// A power of the step, to within so much.
    Order { value: f64, within: f64, because: &'static str },
    /// A power under some scatter: the slope over all levels, to within so much.
    Slope { value: f64, within: f64, because: &'static str },
    /// No power; the slope over all levels is at least this.
    Falls { at_least: f64, because: &'static str },
}

/// By the dimension, the path, the rule and the kernel.
pub fn expected<const D: usize>(sequence: &Sequence) -> Expected {
    let (kernel, rule) = (sequence.weights.kernel, sequence.weights.volume_rule);
    let in_m = m_convergence::expected(kernel, rule);
    match (D, sequence.refine, rule) {
        (1, Refine::M, _) => Expected::Order {
            value: in_m,
            within: 0.1,
            because: "Euler–Maclaurin: a whole end cell errs by its half, half of it by the second order; cΔt/Δx is fixed, so that leapfrog adds to the second order only; 0.1 for the next power at the coarsest m",
        },
        (_, Refine::DeltaM, VolumeRule::Linear | VolumeRule::ExactArea) if in_m == 2.0 && D == 1 => {
            Expected::Order {
                value: 2.0,
                within: 0.1,
                because: "nonlocality errs by δ², the volume rule by 1/m²; where m grows like 1/δ both fall by the second order; 0.1 for the next power",
            }
        }
        (2, _, VolumeRule::ExactArea) => Expected::Slope {
            value: 2.0,
            within: 0.25,
            because: "Poisson summation: cells cut by the rim err by m^(−2), and the next term is only m^(1/2) smaller: 0.25",
        },
        (_, _, VolumeRule::Full) => Expected::Falls {
            at_least: 0.75,
            because: "a rim counted whole errs by 1/m, Gauss's circle by m^(−3/2): the slope over all levels is 1 or more, less 0.25 for chance; pairs of levels show no order",
        },
        _ => Expected::Falls {
            at_least: 1.25,
            because: "what is left of the rim's waves errs by m^(−3/2), the rest by m^(−2): the slope over all levels is 3/2 or more, less 0.25 for chance; pairs of levels show no order",
        },
    }
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
    let of = |word: &str| {
        claim(place, &name_of(sequence), format!("{word} in {by} of the error in l2 of {what}: {name}"))
            .source(source)
    };
    match expected::<D>(sequence) {
        Expected::Order { value, within, because } => {
            of("order").order(value, within).because(Basis::Theory, because)
        }
        Expected::Slope { value, within, because } => {
            of("slope over all levels").order(value, within).because(Basis::Theory, because)
        }
        Expected::Falls { at_least, because } => {
            of("slope over all levels").at_least(at_least).because(Basis::Theory, because)
        }
    }
}

/// Evidence for [`claim_of`], in L2.
pub fn evidence_of(expected: &Expected, name: &str, levels: &levels::Sequence, floor: f64) -> Evidence {
    let in_l2 = levels.in_norm(1);
    match *expected {
        Expected::Order { value, .. } => tail_order(name, &in_l2, value, floor),
        Expected::Slope { .. } | Expected::Falls { .. } => {
            let known = if let Expected::Slope { value, .. } = *expected { Some(value) } else { None };
            let sound = in_l2.iter().all(|level| level.1.is_finite() && level.1 > floor);
            let order = fitted(&in_l2).filter(|_| sound);
            let note = format!("{name}: {} levels", in_l2.len());
            Evidence { order, ..value_of(order.map(|order| order.value), known, note) }
        }
    }
}
