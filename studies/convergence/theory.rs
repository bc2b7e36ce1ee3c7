//! What theory says of a refinement in which m grows: the order of each volume rule, or that pairs of levels show none.
//!
//! A bar: by Euler–Maclaurin a whole end cell errs by its half, order 1 where the kernel does not vanish at δ, half an end
//! cell by order 2 (DLMF 2.10(i)). The plane: by Poisson's summation formula `exact_area` errs by m^(−2), and the rest by
//! m^(−5/2); nodes that enter and leave the rim make `full` err by m^(−3/2) and ties by m^(−1), and leave `linear` a small
//! part of that: their errors fall, but pairs of levels show no order (`asks = "volume_rules"` looks at every m). Kernels
//! that all but vanish at δ have no rim; their first error is that of the kink at ξ = 0, m^(−3), down to an m of tens.

use super::path::{Level, Refine, Sequence};
use crate::dispersion::m_convergence;
use crate::levels::{self, tail_order};
use crate::question::{Claiming, Place, claim, value_of};
use pd_verify::claim::{Basis, Claim};
use pd_verify::compare::order::fitted;
use pd_verify::kernel::Kernel;
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

/// Kernels whose weight at δ is a smaller share of that at 0 have no rim to speak of: Gaussian and exponential beyond
/// p = 1.1, conical, parabolic.
pub const RIM: f64 = 0.3;

/// Whether a kernel jumps at δ.
pub fn has_rim(kernel: Kernel) -> bool {
    kernel.weight(1.0) >= RIM
}

/// By the dimension, the path, the rule and the kernel.
pub fn expected<const D: usize>(sequence: &Sequence) -> Expected {
    match (D, sequence.refine) {
        (1, Refine::M) => Expected::Order {
            value: m_convergence::expected(sequence.weights.kernel, sequence.weights.volume_rule),
            within: 0.1,
            because: "Euler–Maclaurin: a whole end cell errs by its half where the kernel does not vanish at δ, else and where half of it is counted by the second order; a time step, if there is one, goes with Δx and errs by the second order; 0.1 for the next power at the coarsest m",
        },
        (_, Refine::M) => in_the_plane(sequence),
        _ => along_a_path::<D>(sequence),
    }
}

fn in_the_plane(sequence: &Sequence) -> Expected {
    match (sequence.weights.volume_rule, has_rim(sequence.weights.kernel)) {
        (VolumeRule::ExactArea, true) => Expected::Slope {
            value: 2.0,
            within: 0.25,
            because: "Poisson summation: cells cut by the rim err by m^(−2), and the next term is only m^(1/2) smaller: 0.25",
        },
        (VolumeRule::Full, true) => Expected::Falls {
            at_least: 0.75,
            because: "a rim counted whole errs by 1/m, Gauss's circle by m^(−3/2): the slope over all levels is 1 or more, less 0.25 for chance; pairs of levels show no order",
        },
        (VolumeRule::Linear, true) => Expected::Falls {
            at_least: 1.25,
            because: "what is left of the rim's waves errs by m^(−3/2), the rest by m^(−2): the slope over all levels is 3/2 or more, less 0.25 for chance; pairs of levels show no order",
        },
        (_, false) => Expected::Falls {
            at_least: 1.5,
            because: "without a rim to speak of the error begins with m^(−2), under which m^(−3) from the kink at ξ = 0 may lie for long: the slope over all levels is 2 or more, less 0.5 for what is left of the rim",
        },
    }
}

/// Weights as printed where m grows as δ falls: nonlocality errs by δ², the volume rule by some power of 1/m.
fn along_a_path<const D: usize>(sequence: &Sequence) -> Expected {
    let (first, last) = (sequence.levels[0], sequence.finest());
    let horizon = |level: Level| level.m * level.spacing;
    let growth = libm::log(last.m / first.m) / libm::log(horizon(first) / horizon(last));
    let in_m = m_convergence::expected(sequence.weights.kernel, sequence.weights.volume_rule);
    if D == 1 && in_m == 2.0 && (growth - 1.0).abs() < 0.05 {
        return Expected::Order {
            value: 2.0,
            within: 0.1,
            because: "nonlocality errs by δ², the volume rule by 1/m²; where m grows like 1/δ both fall by the second order; 0.1 for the next power",
        };
    }
    let slowest = if sequence.weights.volume_rule == VolumeRule::Full { 1.0 } else { 1.5 };
    Expected::Falls {
        at_least: 0.5 * f64::min(2.0, growth * slowest),
        because: "nonlocality errs by δ², the volume rule by 1/m (whole cells) or m^(−3/2) at the slowest, and m grows like a power of 1/δ: the slope over all levels is at least the smaller of the two, half of which is asked for, as the two may be opposed",
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
        Expected::Order { value, within, .. } => tail_order(name, &in_l2, value, within, floor),
        Expected::Slope { .. } | Expected::Falls { .. } => {
            let known = if let Expected::Slope { value, .. } = *expected { Some(value) } else { None };
            let sound = in_l2.iter().all(|level| level.1.is_finite() && level.1 > floor);
            let order = fitted(&in_l2).filter(|_| sound);
            let note = format!("{name}: {} levels", in_l2.len());
            Evidence { order, ..value_of(order.map(|order| order.value), known, note) }
        }
    }
}
