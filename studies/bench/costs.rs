//! What each kind of node costs, taken from measured cases: each case tells by what its steps do, not by its name.

use super::rates::Rates;
use pd_verify::plan::time::{BodyCosts, Costs};
use pd_verify::plan::work::{Kinds, Work};

/// The costs of both dimensions, from cases on so many threads; the first case of a dimension is its reference.
///
/// A machine that is shared is slower at one time than at another. What other cases take is therefore taken from their
/// ratio to the reference, which was measured in the same rounds, and the reference from where it was fastest.
pub fn costs(cases: &[Rates], threads: usize) -> Costs {
    let of = |dimension: usize| {
        let mut found =
            cases.iter().filter(|case| case.work.dimension == dimension && case.threads == threads);
        found.next().map_or_else(BodyCosts::default, |reference| Measured::of(reference, cases).costs())
    };
    Costs { bar: of(1), plate: of(2) }
}

/// The cases that were measured beside one reference.
struct Measured<'a> {
    reference: &'a Rates,
    /// Seconds of its steps.
    seconds: f64,
    cases: Vec<&'a Rates>,
}

impl<'a> Measured<'a> {
    fn of(reference: &'a Rates, all: &'a [Rates]) -> Self {
        let same = |case: &Rates| {
            (case.threads, case.work, case.node_count)
                == (reference.threads, reference.work, reference.node_count)
        };
        let first = |group: &str| all.iter().find(|case| case.group == group).is_some_and(same);
        let cases: Vec<&Rates> = all.iter().filter(|case| first(case.group)).collect();
        let fastest = cases.iter().filter(|case| same(case)).map(|case| case.seconds_per_step);
        Self { reference, seconds: fastest.fold(f64::INFINITY, f64::min), cases }
    }

    /// Of a step.
    fn seconds(&self, case: &Rates) -> f64 {
        self.seconds * case.node_count as f64 / (self.reference.node_count as f64 * case.ratio)
    }

    fn find(&self, is: impl Fn(&Work) -> bool) -> Option<&'a Rates> {
        self.cases.iter().copied().find(|case| is(&case.work))
    }

    fn costs(&self) -> BodyCosts {
        let plain = once(self.cases.iter().copied().filter(|case| is_plain(&case.work)));
        let (count, pairs) = (self.reference.node_count, self.reference.work.pairs);
        let sizes =
            sorted(plain.iter().copied().filter(|case| case.work.pairs == pairs), |case| case.node_count);
        let families =
            sorted(plain.iter().copied().filter(|case| case.node_count == count), |case| case.work.pairs);
        let step_s = self.step(&sizes);
        let beyond = |case: &Rates| (self.seconds(case) - step_s).max(0.0);
        let per_node = |case: &Rates| beyond(case) / case.node_count as f64;
        let of_reference = per_node(self.reference);
        let added = |is: fn(&Work) -> bool| {
            self.find(is).map_or(0.0, |case| (per_node(case) - of_reference).max(0.0))
        };
        let per = |is: fn(&Work) -> bool, count: fn(&Work) -> u64| {
            self.find(is).map(|case| beyond(case) / count(&case.work) as f64)
        };
        let listed_end_s = per(is_listed, |work| work.kinds.listed_ends).unwrap_or(0.0);
        let of_sizes = sizes.iter().map(|case| (case.node_count as f64, per_node(case) / of_reference));
        BodyCosts {
            step_s,
            whole_by_pairs: families.iter().map(|case| (case.work.pairs as f64, per_node(case))).collect(),
            by_nodes: of_sizes.filter(|(_, factor)| *factor > 0.0).collect(),
            finite_pair_s: per(|work| work.finite_rotations, |work| work.pairs * work.kinds.nodes())
                .unwrap_or(0.0),
            // A bar lacks bonds at its ends alone: nothing to measure, and nothing that counts.
            masked_end_s: per(is_masked, |work| work.kinds.masked_ends).unwrap_or(listed_end_s),
            listed_end_s,
            damped_node_s: added(|work| work.damped_nodes > 0),
            loaded_place_s: added(|work| 2 * work.loaded_places > work.kinds.nodes()),
            booked_node_s: added(|work| work.booked),
            // What is beside the steps is measured beside them.
            ..BodyCosts::default()
        }
    }

    /// What a step takes beside its nodes: the smallest body's, less what its nodes take in the next larger one.
    fn step(&self, sizes: &[&Rates]) -> f64 {
        let [smallest, next, ..] = sizes else { return 0.0 };
        let nodes = smallest.node_count as f64;
        let seconds = self.seconds(smallest);
        let each = (self.seconds(next) - seconds) / (next.node_count as f64 - nodes);
        (seconds - nodes * each).clamp(0.0, seconds)
    }
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

fn is_listed(work: &Work) -> bool {
    nearly_all(work, work.kinds.listed_nodes) && !work.finite_rotations
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
    use super::super::rates::sample;
    use super::*;

    /// A case of a plate whose steps take `seconds` where those of 1000 nodes of reference take 1.5 s.
    fn case(work: Work, seconds: f64) -> Rates {
        let node_count = work.kinds.nodes();
        let ratio = 1.5 * node_count as f64 / (1000.0 * seconds);
        Rates { group: "g", node_count, ratio, work, seconds_per_step: seconds, ..sample() }
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

    /// An effect at half the rate of the reference takes as much as its nodes; one that seems to speed it up nothing. In a
    /// second group the reference was slower, and everything beside it: only the ratio counts.
    #[test]
    fn effects_cost_what_they_add_however_busy_the_machine() {
        let reference = whole(1000, 10);
        let damped = case(Work { damped_nodes: 1000, ..reference }, 3.0);
        let faster = case(Work { booked: true, ..reference }, 1.4);
        let slowed = |one: Rates| Rates { group: "h", seconds_per_step: 7.0 * one.seconds_per_step, ..one };
        let cases = [case(reference, 1.5), faster, slowed(case(reference, 1.5)), slowed(damped)];
        let costs = costs(&cases, 2).plate;
        assert!((costs.damped_node_s - 1.5e-3).abs() < 1e-15);
        assert_eq!(costs.booked_node_s, 0.0);
        // Cases beside another reference tell nothing.
        let other = Rates { group: "i", ..case(whole(10, 10), 1.0) };
        let more = [cases.to_vec(), vec![other, Rates { group: "i", ..case(whole(20, 10), 1.0) }]].concat();
        assert_eq!(super::costs(&more, 2).plate, costs);
    }
}
