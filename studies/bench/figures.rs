//! Figures of what was measured: shares of the limits, rates over size and over family.

use super::rates::Rates;
use pd_verify::report::plot::{Axis, Figure, Guide, Lines, Series, Stack, StackedBars};

pub fn figures(cases: &[Rates]) -> Vec<Figure> {
    vec![shares(cases), rates(cases)]
}

/// Each case as a share of its limit.
fn shares(cases: &[Rates]) -> Figure {
    let mut groups: Vec<&str> = cases.iter().map(|case| case.group).collect();
    groups.dedup();
    let most = cases.iter().map(|case| case.of_limit).fold(1.0, f64::max);
    let panel = |group: &&str| {
        let of_group = cases.iter().filter(|case| case.group == *group);
        let stacks = of_group.map(|case| Stack { label: case.name.clone(), parts: parts(case) }).collect();
        let names = vec!["set by operations".to_owned(), "set by bytes".to_owned()];
        let axis = Axis::linear("share of the limit").range(0.0, 1.02 * most);
        StackedBars::new(axis, names, "share", stacks).titled(*group)
    };
    let panels = groups.iter().map(panel).map(Into::into).collect();
    Figure {
        id: "bench_limits".into(),
        title: "Rates as shares of the machine's limits".into(),
        caption: "Measured steps per second over the least of what multiply-adds in registers, triads over as many bytes \
                  and triads in near caches would allow for the operator's own operations, the bytes of a pass and those of \
                  a step."
            .into(),
        panels,
        columns: 2,
    }
}

fn parts(case: &Rates) -> Vec<Option<f64>> {
    let here = |limit: &str| (case.limit == limit).then_some(case.of_limit);
    vec![here("flops"), here("bytes")]
}

/// Node updates over the size, bond updates over m.
fn rates(cases: &[Rates]) -> Figure {
    let points = |groups: [&str; 1], x: fn(&Rates) -> f64, y: fn(&Rates) -> f64| {
        let of_group = cases.iter().filter(|case| groups.contains(&case.group));
        let mut points: Vec<(f64, f64)> = of_group.map(|case| (x(case), 1e-6 * y(case))).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    };
    let plates = points(["plates by size"], |case| case.node_count as f64, |case| case.node_updates_per_s);
    let bars = cases
        .iter()
        .filter(|case| case.group == "bars" && super::costs::is_plain(&case.work) && case.m == 3.0);
    let mut bars: Vec<(f64, f64)> =
        bars.map(|case| (case.node_count as f64, 1e-6 * case.node_updates_per_s)).collect();
    bars.sort_by(|a, b| a.0.total_cmp(&b.0));
    let by_size = Lines::new(
        Axis::log("nodes"),
        Axis::log("million node updates per second"),
        vec![Series::both("plates, m = 3", plates), Series::both("bars, m = 3", bars)],
    );
    let families = points(["plates by family"], |case| case.m, |case| case.bond_updates_per_s);
    let third = families.iter().find(|(m, _)| *m == 3.0).map(|(_, rate)| 0.8 * rate);
    let by_family = Lines::new(
        Axis::linear("m"),
        Axis::linear("million bond updates per second").including(0.0),
        vec![Series::both("plates of 1024² nodes", families)],
    );
    let by_family = match third {
        Some(at) => by_family.guide(Guide::Horizontal { at, label: "0.8 of m = 3".into() }),
        None => by_family,
    };
    Figure::new("bench_rates", "Rates by size and by family", "Updates per second of plain bodies.", by_size)
        .panel(by_family)
        .columns(2)
}
