//! What each kind of node costs, taken from measured cases: each case tells by what its steps do, not by its name.

use super::rates::Rates;
use pd_verify::plan::time::{BodyCosts, Costs};
use pd_verify::plan::work::{Kinds, Work};

/// The costs of both dimensions, from cases on so many threads; the first case of a dimension is its reference.
pub fn costs(cases: &[Rates], threads: usize) -> Costs {
    let of = |dimension: usize| {
        let cases: Vec<&Rates> =
            cases.iter().filter(|case| case.work.dimension == dimension && case.threads == threads).collect();
        body(&cases)
    };
    Costs { bar: of(1), plate: of(2) }
}

fn body(cases: &[&Rates]) -> BodyCosts {
    let Some(&reference) = cases.first() else { return BodyCosts::default() };
    let plain: Vec<&Rates> = once(cases.iter().copied().filter(|case| is_plain(&case.work)));
    let (count, pairs) = (reference.node_count, reference.work.pairs);
    let sizes = sorted(plain.iter().copied().filter(|case| case.work.pairs == pairs), |case| case.node_count);
    let families =
        sorted(plain.iter().copied().filter(|case| case.node_count == count), |case| case.work.pairs);
    let step_s = step(&sizes);
    let per_node = |case: &Rates| (case.seconds_per_step - step_s).max(0.0) / case.node_count as f64;
    let of_reference = per_node(reference);
    // What an effect adds to the reference, by the ratios of the rounds.
    let added = |case: &Rates| of_reference * (1.0 / case.ratio - 1.0).max(0.0);
    let find = |is: fn(&Work) -> bool| cases.iter().copied().find(|case| is(&case.work));
    let per = |is: fn(&Work) -> bool, count: fn(&Work) -> u64| {
        find(is).map_or(0.0, |case| per_node(case) * case.node_count as f64 / count(&case.work) as f64)
    };
    let listed_end_s = per(|work| nearly_all(work, work.kinds.listed_nodes), |work| work.kinds.listed_ends);
    let masked = find(is_masked).map(|_| per(is_masked, |work| work.kinds.masked_ends));
    BodyCosts {
        step_s,
        whole_by_pairs: families.iter().map(|case| (case.work.pairs as f64, per_node(case))).collect(),
        by_nodes: sizes
            .iter()
            .filter(|case| per_node(case) > 0.0)
            .map(|case| (case.node_count as f64, per_node(case) / of_reference))
            .collect(),
        finite_pair_s: per(|work| work.finite_rotations, |work| work.pairs * work.kinds.nodes()),
        // A bar lacks bonds at its ends alone: nothing to measure, and nothing that counts.
        masked_end_s: masked.unwrap_or(listed_end_s),
        listed_end_s,
        damped_node_s: find(|work| work.damped_nodes > 0).map_or(0.0, added),
        loaded_place_s: find(|work| 2 * work.loaded_places > work.kinds.nodes()).map_or(0.0, added),
        booked_node_s: find(|work| work.booked).map_or(0.0, added),
    }
}

/// What a step takes beside its nodes: the smallest body's, less what its nodes take in the next larger one.
fn step(sizes: &[&Rates]) -> f64 {
    let [smallest, next, ..] = sizes else { return 0.0 };
    let nodes = smallest.node_count as f64;
    let each = (next.seconds_per_step - smallest.seconds_per_step) / (next.node_count as f64 - nodes);
    (smallest.seconds_per_step - nodes * each).clamp(0.0, smallest.seconds_per_step)
}

/// Whether nothing but whole nodes of the linear law are moved.
pub fn is_plain(work: &Work) -> bool {
    let Kinds { whole_nodes, .. } = work.kinds;
    let effects = work.damped_nodes > 0 || work.loaded_places > 0 || work.booked;
    whole_nodes == work.kinds.nodes() && !work.finite_rotations && !effects
}

fn is_masked(work: &Work) -> bool {
    nearly_all(work, work.kinds.masked_nodes) && !work.finite_rotations
}

fn nearly_all(work: &Work, count: u64) -> bool {
    count as f64 > 0.9 * work.kinds.nodes() as f64
}

/// The first of those that do the same.
fn once<'a>(cases: impl Iterator<Item = &'a Rates>) -> Vec<&'a Rates> {
    let mut kept: Vec<&Rates> = Vec::new();
    for case in cases {
        if !kept.iter().any(|one| (one.node_count, one.work.pairs) == (case.node_count, case.work.pairs)) {
            kept.push(case);
        }
    }
    kept
}

fn sorted<'a>(cases: impl Iterator<Item = &'a Rates>, by: fn(&Rates) -> u64) -> Vec<&'a Rates> {
    let mut cases: Vec<&Rates> = cases.collect();
    cases.sort_by_key(|case| by(case));
    cases
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A case of a plate whose steps take `seconds`.
    fn case(work: Work, seconds: f64) -> Rates {
        let node_count = work.kinds.nodes();
        Rates {
            group: "g",
            name: String::new(),
            operator: "stencil",
            isa: "baseline",
            threads: 2,
            nodes: 0,
            cells: Vec::new(),
            node_count,
            m: 3.0,
            masked_share: 0.0,
            node_updates_per_s: 0.0,
            bond_updates_per_s: 0.0,
            gflop_per_s: 0.0,
            gbyte_per_s: 0.0,
            of_limit: 0.0,
            limit: "flops",
            ratio: 1e-3 * 1000.0 / seconds,
            bond_ratio: 1.0,
            spread: 0.0,
            steps: 1,
            rounds: 1,
            work,
            seconds_per_step: seconds,
        }
    }

    fn whole(whole_nodes: u64, pairs: u64) -> Work {
        Work { dimension: 2, pairs, kinds: Kinds { whole_nodes, ..Kinds::default() }, ..Work::default() }
    }

    /// A machine whose steps take 0.5 s, and 1 ms for each node of 10 pairs, 3 ms of 30, 2 ms on a large body: the costs
    /// give the seconds back from which they were made.
    #[test]
    fn costs_give_back_what_was_measured() {
        let reference = whole(1000, 10);
        let masked = Kinds { masked_nodes: 1000, masked_ends: 9000, ..Kinds::default() };
        let listed = Kinds { listed_nodes: 1000, listed_ends: 20_000, ..Kinds::default() };
        let cases = [
            case(reference, 0.5 + 1.0),
            case(whole(10, 10), 0.5 + 0.01),
            case(whole(100, 10), 0.5 + 0.1),
            case(whole(100_000, 10), 0.5 + 200.0),
            case(whole(1000, 30), 0.5 + 3.0),
            case(Work { kinds: masked, ..reference }, 0.5 + 9.0),
            case(Work { kinds: listed, ..reference }, 0.5 + 40.0),
            case(Work { finite_rotations: true, ..reference }, 0.5 + 5.0),
        ];
        let costs = costs(&cases, 2);
        assert_eq!(costs.bar, BodyCosts::default());
        for case in &cases {
            let seconds = costs.of_step(&case.work).unwrap();
            let measured = case.seconds_per_step;
            assert!((seconds / measured - 1.0).abs() < 1e-12, "{:?}: {seconds}, {measured}", case.work);
        }
        assert!(costs.of_step(&Work { dimension: 1, ..reference }).is_none());
        assert_eq!(super::costs(&cases, 3).plate, BodyCosts::default());
    }

    /// An effect at half the rate of the reference takes as much as its nodes.
    #[test]
    fn effects_cost_what_they_add() {
        let reference = whole(1000, 10);
        let damped = Rates { ratio: 0.5, ..case(Work { damped_nodes: 1000, ..reference }, 2.0) };
        let faster = Rates { ratio: 1.1, ..case(Work { booked: true, ..reference }, 0.9) };
        let costs = costs(&[case(reference, 1.0), damped, faster], 2).plate;
        assert!((costs.damped_node_s - 1e-3).abs() < 1e-15);
        assert_eq!(costs.booked_node_s, 0.0);
    }
}
