//! Rows of `ablation.csv`, and rates and bytes beside those of the plain plate.

use super::ablation::{Ablated, Ablation, Seen};
use crate::question::Place;
use pd_verify::report::plot::{Axis, Figure, Stack, StackedBars};
use pd_verify::table::{Cell, Table};

/// A row for every plate.
pub fn table(asked: &Ablation, seen: &[Seen], place: &Place) -> Table {
    let columns = [
        "case",
        "effect",
        "nodes",
        "steps",
        "node_updates",
        "node_updates_per_s",
        "spread",
        "rate_over_plain",
        "bytes_per_node",
        "bytes_over_plain",
        "time_step_s",
        "time_step_limit_s",
        "limit_over_plain",
        "change_l2",
    ];
    let mut table = Table::new("ablation.csv", &columns);
    let limit = |one: &Ablated| one.plan.time_step_s / one.plan.time_step_over_limit;
    let Some((first, plain)) = asked.variants.iter().zip(seen).next() else { return table };
    for (one, seen) in asked.variants.iter().zip(seen) {
        let row: Vec<Cell> = vec![
            place.case.as_str().into(),
            one.variant.name.into(),
            one.plan.nodes.into(),
            one.plan.steps.into(),
            one.plan.node_updates.into(),
            seen.node_updates_per_s.into(),
            seen.spread.into(),
            (seen.node_updates_per_s / plain.node_updates_per_s).into(),
            one.plan.bytes_per_node.into(),
            (one.plan.bytes_per_node / first.plan.bytes_per_node).into(),
            one.plan.time_step_s.into(),
            limit(one).into(),
            (limit(one) / limit(first)).into(),
            seen.change.into(),
        ];
        table.push(row);
    }
    table
}

/// Bars over the plain plate's: how much longer a node takes, and how much more it keeps.
pub fn figure(asked: &Ablation, seen: &[Seen], place: &Place) -> Figure {
    let panel = |label: &str, of: &dyn Fn(&Ablated, &Seen) -> f64| {
        let stack = |(one, seen): (&Ablated, &Seen)| Stack::new(one.variant.name, [of(one, seen)]);
        let stacks: Vec<Stack> = asked.variants.iter().zip(seen).map(stack).collect();
        StackedBars::new(Axis::linear(label), vec![String::new()], "", stacks)
    };
    let rate = seen.first().map_or(f64::NAN, |plain| plain.node_updates_per_s);
    let bytes = asked.variants.first().map_or(f64::NAN, |plain| plain.plan.bytes_per_node);
    let caption = "Time of a node's update and bytes that a node keeps, over those of the plain plate: medians of whole runs \
                   in turns, models being made among them. Effects are on one at a time.";
    let time = panel("time of a node / plain", &|_, seen| rate / seen.node_updates_per_s);
    let kept = panel("bytes of a node / plain", &|one, _| one.plan.bytes_per_node / bytes);
    Figure::new(place.case.clone(), asked.title.clone(), caption, time).panel(kept).columns(2)
}
