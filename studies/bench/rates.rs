//! What was measured, as rates: updates, operations and bytes each second, and as shares of the limits.

use super::limits::Limits;
use super::measure::Measured;
use crate::cli::Isa;
pub use crate::median::median;
use pd_verify::plan::work::Work;
use serde::Serialize;

/// A case in numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rates {
    pub group: &'static str,
    pub name: String,
    pub operator: &'static str,
    pub isa: &'static str,
    pub threads: usize,
    /// Cells along the first axis.
    pub nodes: usize,
    /// Cells along each axis.
    pub cells: Vec<usize>,
    /// Nodes of the body.
    pub node_count: u64,
    pub m: f64,
    /// The part of the nodes that lack bonds and are served by the stencil.
    pub masked_share: f64,
    /// The median of the rounds.
    pub node_updates_per_s: f64,
    /// Each bond once per step.
    pub bond_updates_per_s: f64,
    /// By the operator's own operations.
    pub gflop_per_s: f64,
    /// By the operator's own bytes.
    pub gbyte_per_s: f64,
    /// Of the fastest round.
    pub best_node_updates_per_s: f64,
    /// The fastest round over the lower of the limits, which are those of the fastest tries.
    pub of_limit: f64,
    /// Which one that is: `flops` or `bytes`.
    pub limit: &'static str,
    /// Node updates over those of the group's first case, in the same round; the median.
    pub ratio: f64,
    /// The same of bond updates.
    pub bond_ratio: f64,
    /// Largest less least rate, over the median.
    pub spread: f64,
    /// Marched in each round.
    pub steps: u64,
    pub rounds: usize,
    #[serde(skip)]
    pub work: Work,
    #[serde(skip)]
    pub seconds_per_step: f64,
}

impl Rates {
    /// `first` is the group's first case.
    pub fn of(group: &'static str, isa: Isa, measured: &Measured, first: &Measured, limits: &Limits) -> Self {
        let (plan, work) = (&measured.plan, measured.plan.work);
        let steps = median(&measured.rates);
        let (most, by_bytes) = limits.steps_per_s(&work, measured.steps_per_pass);
        let ratio = median(&measured.ratios);
        let largest = measured.rates.iter().copied().fold(f64::NAN, f64::max);
        let least = measured.rates.iter().copied().fold(f64::NAN, f64::min);
        let cells = measured.case.body.nodes();
        let per_node = |plan: &pd_verify::plan::Plan| plan.nodes as f64;
        let per_bond = |plan: &pd_verify::plan::Plan| plan.bonds as f64;
        Self {
            group,
            name: measured.case.name.clone(),
            operator: measured.case.body.operator(),
            isa: isa.word(),
            threads: measured.threads,
            nodes: cells[0],
            cells,
            node_count: plan.nodes,
            m: measured.case.body.m(),
            masked_share: work.kinds.masked_nodes as f64 / plan.nodes as f64,
            node_updates_per_s: steps * plan.nodes as f64,
            bond_updates_per_s: steps * plan.bonds as f64,
            gflop_per_s: 1e-9 * steps * work.flops_per_step,
            gbyte_per_s: 1e-9 * steps * work.bytes_per_step(measured.steps_per_pass),
            best_node_updates_per_s: largest * plan.nodes as f64,
            of_limit: largest / most,
            limit: if by_bytes { "bytes" } else { "flops" },
            ratio: ratio * per_node(plan) / per_node(&first.plan),
            bond_ratio: ratio * per_bond(plan) / per_bond(&first.plan),
            spread: (largest - least) / steps,
            steps: measured.steps,
            rounds: measured.rates.len(),
            work,
            seconds_per_step: 1.0 / steps,
        }
    }
}

/// A case on two threads, for tests: the plate of reference.
#[cfg(test)]
pub fn sample() -> Rates {
    Rates {
        group: "plates by size",
        name: "1024², m = 3".into(),
        operator: "stencil",
        isa: "baseline",
        threads: 2,
        nodes: 1024,
        cells: vec![1024, 1024],
        node_count: 1 << 20,
        m: 3.0,
        masked_share: 0.0,
        node_updates_per_s: 1e9,
        bond_updates_per_s: 18e9,
        gflop_per_s: 125.0,
        gbyte_per_s: 64.0,
        best_node_updates_per_s: 1.1e9,
        of_limit: 0.5,
        limit: "bytes",
        ratio: 1.0,
        bond_ratio: 1.0,
        spread: 0.01,
        steps: 100,
        rounds: 5,
        work: Work::default(),
        seconds_per_step: 1e-3,
    }
}

#[cfg(test)]
mod tests {
    use super::super::bodies::plate;
    use super::super::cases::Case;
    use super::*;

    #[test]
    fn medians_by_hand() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert!(median(&[]).is_nan());
    }

    /// A plate of 32² and one of 16², whole, 18 pairs: 1024 and 256 nodes, 18432 and 4608 bonds.
    #[test]
    fn rates_by_hand() {
        let measured = |side: usize, rates: [f64; 3], ratios: [f64; 3]| {
            let case = Case::new("x", plate([side; 2], 3.0));
            let plan = case.body.plan().unwrap();
            Measured {
                case,
                plan,
                threads: 2,
                steps_per_pass: 1,
                steps: 7,
                rates: rates.to_vec(),
                ratios: ratios.to_vec(),
            }
        };
        let first = measured(32, [10.0, 11.0, 12.0], [1.0; 3]);
        let one = measured(16, [100.0, 110.0, 90.0], [10.0, 10.0, 7.5]);
        let limits = Limits {
            threads: 2,
            triad_gbyte_per_s: 1.0,
            triad_cache_gbyte_per_s: 1.0,
            triad_by_bytes: vec![(1.0, 1.0)],
            fma_gflop_per_s: 1e9,
        };
        let rates = Rates::of("g", Isa::Baseline, &one, &first, &limits);
        assert_eq!((rates.node_updates_per_s, rates.bond_updates_per_s), (25_600.0, 460_800.0));
        assert_eq!((rates.ratio, rates.bond_ratio, rates.spread), (2.5, 2.5, 0.2));
        // 64 bytes of u and d for each node, 24 for each of 16 runs.
        let bytes = (64 * 256 + 24 * 16) as f64;
        assert!((rates.gbyte_per_s - 1e-7 * bytes).abs() < 1e-18);
        // The fastest round had 110 steps a second.
        assert!((rates.of_limit - 1.1e-7 * bytes).abs() < 1e-18 && rates.limit == "bytes");
        assert_eq!(rates.best_node_updates_per_s, 110.0 * 256.0);
        // 118 operations for the bonds of a node, 6 to move it.
        assert!((rates.gflop_per_s - 1e-7 * 256.0 * 124.0).abs() < 1e-18);
    }
}
