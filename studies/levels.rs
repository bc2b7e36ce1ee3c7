//! Levels of a refinement: errors in three norms, the order at which they fall, and their rows in a table.

use pd_verify::compare::order;
use pd_verify::lattice::Lattice;
use pd_verify::scene::{Positive, Wrong};
use pd_verify::table::{Cell, Table};
use pd_verify::verdict::Evidence;

/// The norms of [`Errors`], as tables name them.
pub const NORMS: [&str; 3] = ["l1", "l2", "linf"];

/// An error in each norm, over the same norm of the exact field.
pub type Errors = [f64; 3];

/// Relative errors from many pairs (computed, exact).
pub fn relative(pairs: impl IntoIterator<Item = (f64, f64)>) -> Errors {
    let (mut error, mut size) = ([0.0_f64; 3], [0.0_f64; 3]);
    let mut all_numbers = true;
    for (computed, exact) in pairs {
        let (far, exact) = ((computed - exact).abs(), exact.abs());
        all_numbers &= far.is_finite();
        error = [error[0] + far, error[1] + far * far, error[2].max(far)];
        size = [size[0] + exact, size[1] + exact * exact, size[2].max(exact)];
    }
    if !all_numbers {
        return [f64::NAN; 3];
    }
    [error[0] / size[0], (error[1] / size[1]).sqrt(), error[2] / size[2]]
}

/// One refinement of a lattice: a step h with its errors, from coarse to fine.
#[derive(Debug, Clone, PartialEq)]
pub struct Sequence {
    pub name: String,
    pub levels: Vec<(f64, Errors)>,
}

impl Sequence {
    /// (h, error) in one norm.
    pub fn in_norm(&self, norm: usize) -> Vec<(f64, f64)> {
        self.levels.iter().map(|(h, errors)| (*h, errors[norm])).collect()
    }

    /// The order in one norm over all levels above a floor; what lies at the floor is left out and counted.
    pub fn order(&self, norm: usize, expected: f64, floor: f64) -> Evidence {
        order_of(&self.name, &self.in_norm(norm), expected, floor)
    }
}

/// The observed order of some levels, beside the expected one.
pub fn order_of(name: &str, levels: &[(f64, f64)], expected: f64, floor: f64) -> Evidence {
    let resolved: Vec<_> =
        levels.iter().copied().filter(|level| level.1.is_nan() || level.1 > floor).collect();
    let sound = resolved.len() >= 3 && resolved.iter().all(|level| level.1.is_finite());
    let order = if sound { order::fitted(&resolved) } else { None };
    let left_out = match levels.len() - resolved.len() {
        0 => String::new(),
        count => format!(", {count} at the round-off floor of {floor:e} left out"),
    };
    Evidence {
        computed: order.map(|order| order.value),
        reference: Some(expected),
        error: order.map(|order| (order.value - expected).abs()),
        order,
        note: format!("{name}: {} levels{left_out}", resolved.len()),
        ..Evidence::default()
    }
}

/// The observed order of the finest levels whose pairwise orders agree, to be within `within` of the expected one.
///
/// Where fewer than three agree it is inconclusive, unless the orders move away from the expected one: then the finest
/// pair is judged, for that is no coarse level's fault.
pub fn tail_order(name: &str, levels: &[(f64, f64)], expected: f64, within: f64, floor: f64) -> Evidence {
    let tail = order::tail(levels, floor);
    let mut note = format!("{name}: the {} finest levels", tail.levels.len());
    if tail.too_coarse > 0 {
        note += &format!(", {} coarser ones left out", tail.too_coarse);
    }
    if tail.at_floor > 0 {
        note += &format!(", {} at the round-off floor of {floor:e} left out", tail.at_floor);
    }
    let found = |value: f64| Evidence {
        computed: Some(value),
        reference: Some(expected),
        error: Some((value - expected).abs()),
        order: tail.order,
        note: note.clone(),
        ..Evidence::default()
    };
    if let Some(order) = tail.order {
        return found(order.value);
    }
    if levels.iter().any(|level| !level.1.is_finite()) {
        return Evidence { note: format!("{name}: a level is not finite"), ..Evidence::default() };
    }
    let resolved: Vec<_> = levels.iter().copied().filter(|level| level.1 > floor).collect();
    let orders: Vec<f64> = resolved.windows(2).filter_map(|pair| order::pairwise(pair[0], pair[1])).collect();
    let listed = orders.iter().map(|order| format!("{order:.2}")).collect::<Vec<_>>().join(", ");
    if let [.., before, last] = orders[..]
        && (last - expected).abs() > within
        && (last - expected).abs() > (before - expected).abs()
    {
        let note = format!("{name}: by the finest pair, as orders move away from {expected}: {listed}");
        return Evidence { note, ..found(last) };
    }
    let outside = Some(format!("outside the asymptotic range: pairwise orders {listed}"));
    Evidence { reference: Some(expected), outside, note, ..Evidence::default() }
}

/// The evidence to be judged of several, when `bound` is what an error may be: one beyond it before one without a number,
/// and this before one within; among alike the largest error.
pub fn furthest(all: impl IntoIterator<Item = Evidence>, bound: f64) -> Option<Evidence> {
    let rank = |evidence: &Evidence| match evidence.error.filter(|error| !error.is_nan()) {
        _ if evidence.outside.is_some() || evidence.failed.is_some() => (1, 0.0),
        None => (1, 0.0),
        Some(error) => (if error > bound { 2 } else { 0 }, error),
    };
    all.into_iter().max_by(|a, b| {
        let (a, b) = (rank(a), rank(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    })
}

/// A table of errors by sequence and level.
pub fn table(name: &str) -> Table {
    let columns = [
        "sequence",
        "case",
        "kernel",
        "p",
        "volume_rule",
        "calibrated",
        "m",
        "dx_m",
        "horizon_m",
        "norm",
        "error",
        "pairwise_order",
    ];
    Table::new(name, &columns)
}

/// Adds the rows of one refinement; `at` gives the lattice and Δx of a level.
pub fn push(
    table: &mut Table,
    sequence: &str,
    case: &str,
    levels: &Sequence,
    at: impl Fn(usize) -> (Lattice, f64),
) {
    for (norm, name) in NORMS.iter().enumerate() {
        let errors = levels.in_norm(norm);
        for (index, &(_, error)) in errors.iter().enumerate() {
            let (lattice, spacing) = at(index);
            let row: [Cell; 12] = [
                sequence.into(),
                case.into(),
                lattice.kernel.name().into(),
                lattice.kernel.p().into(),
                lattice.volume_rule.name().into(),
                lattice.calibrated.into(),
                lattice.m.into(),
                spacing.into(),
                (lattice.m * spacing).into(),
                (*name).into(),
                error.into(),
                pairwise(&errors, index).into(),
            ];
            table.push(row.to_vec());
        }
    }
}

/// The order from the level before.
pub fn pairwise(levels: &[(f64, f64)], index: usize) -> Option<f64> {
    order::pairwise(levels[index.checked_sub(1)?], levels[index])
}

/// More levels say nothing more of an order.
const MOST_LEVELS: usize = 100;

/// Steps of a refinement, each finer than the one before; fewer than three make no order.
pub fn refining(key: &str, steps: &[Positive], finer: impl Fn(f64, f64) -> bool) -> Result<Vec<f64>, Wrong> {
    if steps.len() > MOST_LEVELS {
        let message = format!("{} levels are more than the {MOST_LEVELS} that are run", steps.len());
        return Err(Wrong::new(key, message, "an order is seen from a few, each half of the one before"));
    }
    let steps: Vec<f64> = steps.iter().map(|step| step.0).collect();
    if steps.len() < 3 || !steps.windows(2).all(|pair| finer(pair[0], pair[1])) {
        let message = "an order needs three levels or more, each finer than the one before";
        return Err(Wrong::new(key, message, "write them from coarse to fine"));
    }
    Ok(steps)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn norms_are_over_those_of_the_exact_field() {
        let [l1, l2, most] = relative([(1.0, 2.0), (4.0, 4.0), (-2.0, -4.0)]);
        assert_eq!([l1, most], [0.3, 0.5]);
        assert!((l2 - (5.0_f64 / 36.0).sqrt()).abs() < 1e-15);
        assert!(relative([(f64::NAN, 1.0), (1.0, 1.0)]).iter().all(|error| error.is_nan()));
    }

    #[test]
    fn what_is_at_the_floor_is_left_out_and_said() {
        let levels = [(0.4, 1.6e-1), (0.2, 4e-2), (0.1, 1e-2), (0.05, 1e-13)];
        let evidence = order_of("lattice", &levels, 2.0, 1e-10);
        assert!((evidence.computed.unwrap() - 2.0).abs() < 1e-12);
        assert!(evidence.note.ends_with("3 levels, 1 at the round-off floor of 1e-10 left out"));
        assert_eq!(order_of("lattice", &levels[2..], 2.0, 1e-10).computed, None);
    }

    #[test]
    fn a_failure_is_told_before_a_missing_order_and_this_before_what_is_right() {
        let none = || order_of("x", &[(1.0, f64::NAN), (0.5, 1.0), (0.25, 0.5)], 1.0, 0.0);
        let one = || order_of("y", &[(1.0, 4.0), (0.5, 2.0), (0.25, 1.0)], 1.0, 0.0);
        let wrong = order_of("z", &[(1.0, 4.0), (0.5, 1.0), (0.25, 0.25)], 1.0, 0.0);
        assert_eq!(furthest([none(), one()], 0.1).unwrap().computed, None);
        assert!((furthest([none(), wrong, one()], 0.1).unwrap().computed.unwrap() - 2.0).abs() < 1e-12);
    }

    #[test]
    fn orders_that_move_away_are_judged_and_those_on_their_way_are_not() {
        let of = |error: fn(f64) -> f64| {
            let levels: Vec<(f64, f64)> = [0.8, 0.4, 0.2, 0.1, 0.05].map(|h| (h, error(h))).to_vec();
            tail_order("x", &levels, 2.0, 0.1, 1e-12)
        };
        // A residue that does not vanish, and an error of the first order under one of the second.
        for stopping in [of(|h| 0.5 * h * h + 3e-4), of(|h| 0.5 * h * h + 0.02 * h)] {
            assert!(stopping.error.unwrap() > 0.1 && stopping.outside.is_none(), "{stopping:?}");
        }
        let coarse = of(|h| h * h / (1.0 + 300.0 * h * h));
        assert!(coarse.computed.is_none() && coarse.outside.is_some(), "{coarse:?}");
        let broken =
            tail_order("x", &[(8.0, f64::NAN), (4.0, 0.16), (2.0, 0.04), (1.0, 0.01)], 2.0, 0.1, 0.0);
        assert!(broken.computed.is_none() && broken.error.is_none());
    }
}
