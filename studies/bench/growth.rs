//! How the time of a step grows with nodes and with bonds: exponents with their 95 % intervals; 1 where cost is linear.

use super::rates::Rates;
use pd_verify::compare::order::fitted;
use serde::Serialize;

/// Plates smaller than this hold too few pieces of work for all threads.
const LEAST_NODES: u64 = 256 * 256;

/// The exponent of time over what grows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Growth {
    /// `nodes` or `bonds`.
    pub with: &'static str,
    pub group: &'static str,
    /// Of what grows, in the cases that were used.
    pub from: f64,
    pub to: f64,
    pub exponent: f64,
    /// `None` with fewer than three cases.
    pub interval: Option<(f64, f64)>,
}

/// Of the plates by size and by family. Times are those of the same rounds, over the reference's.
pub fn growths(cases: &[Rates]) -> Vec<Growth> {
    let nodes = |case: &Rates| case.node_count as f64;
    let bonds = |case: &Rates| nodes(case) * case.bond_updates_per_s / case.node_updates_per_s;
    let time = |case: &Rates| nodes(case) / case.ratio;
    let group = |name: &str| -> Vec<&Rates> {
        cases.iter().filter(|case| case.group == name && case.node_count >= LEAST_NODES).collect()
    };
    let of = |with, name: &'static str, x: &dyn Fn(&Rates) -> f64| {
        let points: Vec<(f64, f64)> = group(name).into_iter().map(|case| (x(case), time(case))).collect();
        let xs = || points.iter().map(|point| point.0);
        fitted(&points).map(|fit| Growth {
            with,
            group: name,
            from: xs().fold(f64::INFINITY, f64::min),
            to: xs().fold(0.0, f64::max),
            exponent: fit.value,
            interval: fit.interval,
        })
    };
    [of("nodes", "plates by size", &nodes), of("bonds", "plates by family", &bonds)]
        .into_iter()
        .flatten()
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::rates::sample;
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn exponents_by_hand() {
        // Four times the nodes at half the rate: eight times the time, n^1.5. Small plates are left out.
        let large = Rates { node_count: 1 << 22, ratio: 0.5, ..sample() };
        let small = Rates { node_count: 256, ratio: 1e-3, ..sample() };
        // Twice the bonds at a quarter of the nodes' rate: b².
        let of_family = |case: Rates| Rates { group: "plates by family", ..case };
        let dense = Rates { node_updates_per_s: 0.25e9, bond_updates_per_s: 9e9, ratio: 0.25, ..sample() };
        let cases = [sample(), large, small, of_family(sample()), of_family(dense)];
        let growths = growths(&cases);
        assert_eq!(growths.iter().map(|growth| growth.with).collect::<Vec<_>>(), ["nodes", "bonds"]);
        assert_relative_eq!(growths[0].exponent, 1.5, max_relative = 1e-12);
        assert_relative_eq!(growths[1].exponent, 2.0, max_relative = 1e-12);
        assert_eq!((growths[0].from, growths[0].to), ((1 << 20) as f64, (1 << 22) as f64));
    }

    #[test]
    fn one_case_has_no_exponent() {
        assert!(growths(&[sample()]).is_empty());
    }
}
