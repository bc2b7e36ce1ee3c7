//! What was found, as text for a terminal, as a table, and as data.

use super::estimate::Estimate;
use super::levels::Own;
use super::search::{Chosen, Found, Goal, KEPT, Marched};
use crate::rounded::rounded;
use pd_verify::compare::richardson::SAFETY;
use pd_verify::table::{Cell, Table};
use serde_json::{Value, json};

const COLUMNS: [&str; 13] = [
    "dx_m",
    "cells_x",
    "nodes",
    "dt_s",
    "steps",
    "node_updates",
    "bond_updates",
    "bytes",
    "predicted_seconds",
    "measured_seconds",
    "error",
    "order",
    "answer",
];

/// All levels, from coarse to fine.
pub fn table(found: &Found) -> Table {
    let mut table = Table::new("levels.csv", &COLUMNS);
    for (index, level) in found.levels.iter().enumerate() {
        let plan = &level.plan;
        let row: Vec<Cell> = vec![
            level.spacing.into(),
            level.cells.into(),
            plan.nodes.into(),
            plan.time_step_s.into(),
            plan.steps.into(),
            plan.node_updates.into(),
            plan.bond_updates.into(),
            (plan.bytes_per_node * plan.nodes as f64).into(),
            level.predicted.into(),
            level.seconds.into(),
            error(found, index).into(),
            order(found, index).into(),
            is_answer(found, level).into(),
        ];
        table.push(row);
    }
    table
}

fn is_answer(found: &Found, level: &Marched) -> bool {
    found.chosen.as_ref().is_some_and(|chosen| chosen.cells == level.cells)
}

fn error(found: &Found, index: usize) -> Option<f64> {
    found.estimate.as_ref().ok().map(|estimate| estimate.errors()[index])
}

/// Of the three levels that end here, of the result that is worst on the finest.
fn order(found: &Found, index: usize) -> Option<f64> {
    let estimate = found.estimate.as_ref().ok()?;
    let worst = estimate.worst(found.levels.last()?.spacing);
    *worst.orders.get(index)?
}

/// The question, the levels, the answer.
pub fn text(own: &Own, found: &Found) -> String {
    let mut text = head(own, found);
    text += &format!(
        "\n{:>10} {:>10} {:>9} {:>14} {:>11} {:>11} {:>10} {:>6}\n",
        "dx m", "nodes", "steps", "node updates", "predicted s", "measured s", "error", "order"
    );
    let number = |value: Option<f64>| value.map_or("-".into(), rounded);
    for (index, level) in found.levels.iter().enumerate() {
        text += &format!(
            "{:>10} {:>10} {:>9} {:>14} {:>11} {:>11} {:>10} {:>6}{}\n",
            rounded(level.spacing),
            level.plan.nodes,
            level.plan.steps,
            level.plan.node_updates,
            number(level.predicted),
            rounded(level.seconds),
            number(error(found, index)),
            order(found, index).map_or("-".into(), |order| format!("{order:.2}")),
            if is_answer(found, level) { "  answer" } else { "" }
        );
    }
    text + "\n" + &end(found)
}

fn head(own: &Own, found: &Found) -> String {
    let asked = match found.goal {
        Goal::Error(error) => format!("the coarsest Δx whose error is at most {error}"),
        Goal::Budget(seconds) => format!("the finest Δx that {seconds} s afford"),
    };
    let results: Vec<&str> = own.seen.iter().map(|seen| seen.name.as_str()).collect();
    let alike = match own.ladder.alike {
        true => String::new(),
        false => {
            "Probes, notches or regions lie between nodes otherwise on each level, which scatters errors: \
                  place them at simple fractions of the size.\n"
                .to_owned()
        }
    };
    format!(
        "{}: {asked}.\n{}; refined at m = {}: the horizon and Δt shrink with Δx.\n\
         Error: root mean square over time over the largest size, the worst of: {}.\n{alike}",
        own.name(),
        own.lattice,
        own.lattice.m,
        results.join(", "),
    )
}

fn end(found: &Found) -> String {
    let Some(chosen) = &found.chosen else {
        let why = found.estimate.as_ref().err().map_or("", String::as_str);
        return format!("Inconclusive: {why}.\n");
    };
    let order = chosen.order.map_or("levels alike to rounding".into(), |order| format!("order {order:.2}"));
    let mut text = format!(
        "Answer: Δx = {} m, horizon and Δt with it; {} nodes, {} steps of {} s, {} MB.\n\
         Predicted: {} s, error {} ({order}; {} with Roache's factor of safety {SAFETY}).\n",
        chosen.spacing,
        chosen.plan.nodes,
        chosen.plan.steps,
        rounded(chosen.plan.time_step_s),
        rounded(1e-6 * chosen.bytes),
        rounded(chosen.predicted),
        rounded(chosen.error),
        rounded(SAFETY * chosen.error),
    );
    if let Some(why) = &chosen.not_run {
        return text + &format!("Not run: {why}.\n");
    }
    let Some(outcome) = &chosen.outcome else { return text };
    text += &format!(
        "Marched:   {} s, {:.2} of what was predicted",
        rounded(outcome.seconds),
        outcome.seconds / chosen.predicted
    );
    match (&outcome.error, found.goal, found.met()) {
        (Err(why), ..) => text += &format!("; inconclusive with the answer among the levels: {why}.\n"),
        (Ok(error), Goal::Error(_), met) => {
            let said = if met { "as accurate as asked" } else { "not as accurate as asked" };
            text += &format!("; error {}: {said}.\n", rounded(*error));
        }
        (Ok(error), Goal::Budget(_), met) => {
            let said = if met { "" } else { "; more than half as much again as the budget" };
            text += &format!("; error {}{said}.\n", rounded(*error));
        }
    }
    text
}

/// Everything as data.
pub fn json(own: &Own, found: &Found) -> Value {
    let level = |(index, level): (usize, &Marched)| {
        json!({
            "dx_m": level.spacing,
            "cells_x": level.cells,
            "nodes": level.plan.nodes,
            "dt_s": level.plan.time_step_s,
            "steps": level.plan.steps,
            "node_updates": level.plan.node_updates,
            "bond_updates": level.plan.bond_updates,
            "predicted_seconds": level.predicted,
            "measured_seconds": level.seconds,
            "error": error(found, index),
            "order": order(found, index),
        })
    };
    let law = |estimate: &Estimate| -> Vec<Value> {
        let of = |law: &super::estimate::Law| json!({ "result": law.name, "order": law.order, "error": law.error });
        estimate.laws.iter().map(of).collect()
    };
    json!({
        "case": own.name(),
        "asked_error": match found.goal { Goal::Error(error) => Some(error), Goal::Budget(_) => None },
        "budget_seconds": match found.goal { Goal::Budget(seconds) => Some(seconds), Goal::Error(_) => None },
        "safety": SAFETY,
        "kept_within": KEPT,
        "places_alike": own.ladder.alike,
        "levels": found.levels.iter().enumerate().map(level).collect::<Vec<_>>(),
        "results": found.estimate.as_ref().ok().map(law),
        "inconclusive": found.estimate.as_ref().err(),
        "answer": found.chosen.as_ref().map(answer),
        "met": found.met(),
    })
}

fn answer(chosen: &Chosen) -> Value {
    let outcome = chosen.outcome.as_ref();
    json!({
        "dx_m": chosen.spacing,
        "cells_x": chosen.cells,
        "nodes": chosen.plan.nodes,
        "steps": chosen.plan.steps,
        "node_updates": chosen.plan.node_updates,
        "bytes": chosen.bytes,
        "predicted_seconds": chosen.predicted,
        "predicted_error": chosen.error,
        "order": chosen.order,
        "not_run": chosen.not_run,
        "measured_seconds": outcome.map(|outcome| outcome.seconds),
        "measured_over_predicted": outcome.map(|outcome| outcome.seconds / chosen.predicted),
        "error": outcome.and_then(|outcome| outcome.error.as_ref().ok()),
        "why_no_error": outcome.and_then(|outcome| outcome.error.as_ref().err()),
    })
}
