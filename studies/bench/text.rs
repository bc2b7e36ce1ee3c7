//! What was measured as text for a terminal: the limits, then a line for each case.

use super::forecast::Forecast;
use super::growth::Growth;
use super::limits::Limits;
use super::rates::Rates;

/// The limits on so many threads, in a line.
pub fn limits(limits: &Limits, isa: &str) -> String {
    let threads =
        if limits.threads == 1 { "1 thread".to_owned() } else { format!("{} threads", limits.threads) };
    format!(
        "limits of {threads}, {isa}: {:.1} GF/s by multiply-adds; triad {:.1} GB/s in memory, {:.1} GB/s in near caches\n",
        limits.fma_gflop_per_s, limits.triad_gbyte_per_s, limits.triad_cache_gbyte_per_s
    )
}

/// The cases by group.
pub fn cases(cases: &[Rates]) -> String {
    let width = cases.iter().map(|case| case.name.chars().count()).max().unwrap_or(0).max("case".len());
    let mut text = String::new();
    let mut group = "";
    for case in cases {
        if case.group != group {
            group = case.group;
            text += &format!(
                "\n{group}\n  {:<width$} {:>9} {:>9} {:>8} {:>8} {:>8} {:>7} {:>7} {:>6}\n",
                "case", "M nodes/s", "M bonds/s", "GF/s", "GB/s", "of limit", "nodes", "bonds", "spread"
            );
        }
        text += &format!("  {:<width$} {}\n", case.name, numbers(case));
    }
    text += "\nnodes, bonds: updates over those of the group's first case in the same round; of limit: the fastest round,\n\
             of what the operator's own operations (F) or bytes (B) allow, whichever is less; all else are medians\n";
    text
}

fn numbers(case: &Rates) -> String {
    format!(
        "{:>9.1} {:>9.0} {:>8.2} {:>8.2} {:>3.0} % {} {:>7.3} {:>7.3} {:>4.0} %",
        1e-6 * case.node_updates_per_s,
        1e-6 * case.bond_updates_per_s,
        case.gflop_per_s,
        case.gbyte_per_s,
        100.0 * case.of_limit,
        if case.limit == "bytes" { "B" } else { "F" },
        case.ratio,
        case.bond_ratio,
        100.0 * case.spread,
    )
}

/// A case by itself.
pub fn one(case: &Rates) -> String {
    let limit = if case.limit == "bytes" { "bytes" } else { "operations" };
    format!(
        "{}, {}, m = {}: {:.1} million node updates a second, {:.0} million bond updates, {:.2} GF/s, {:.2} GB/s\n\
         {:.0} % of the limit, which is set by {limit}; {} of {} steps, spread {:.0} %\n",
        case.name,
        case.operator,
        case.m,
        1e-6 * case.node_updates_per_s,
        1e-6 * case.bond_updates_per_s,
        case.gflop_per_s,
        case.gbyte_per_s,
        100.0 * case.of_limit,
        if case.rounds == 1 { "1 round".to_owned() } else { format!("{} rounds", case.rounds) },
        case.steps,
        100.0 * case.spread,
    )
}

/// How time grows.
pub fn growths(growths: &[Growth]) -> String {
    let mut text = String::new();
    for Growth { with, group, from, to, exponent, interval } in growths {
        let interval = interval
            .map_or("no interval".to_owned(), |(low, high)| format!("95 % interval {low:.3} to {high:.3}"));
        text += &format!(
            "{group}: the time of a step grows with {with} to the power {exponent:.3}, {interval}, from {from:.3e} to {to:.3e}\n"
        );
    }
    text
}

/// Predicted against measured.
pub fn forecasts(forecasts: &[Forecast]) -> String {
    let width = forecasts.iter().map(|one| one.name.chars().count()).max().unwrap_or(0);
    let mut text = format!(
        "\npredictions from these costs, on other bodies\n  {:<width$} {:>10} {:>10} {:>9} {:>17}\n",
        "ms per step", "predicted", "measured", "ratio", "beside reference"
    );
    let number =
        |value: Option<f64>, digits: usize| value.map_or("–".into(), |value| format!("{value:.digits$}"));
    for one in forecasts {
        let predicted = one.predicted_seconds_per_step.map(|seconds| 1e3 * seconds);
        let measured = Some(1e3 * one.measured_seconds_per_step);
        let (predicted, measured, ratio) = (number(predicted, 4), number(measured, 4), number(one.ratio, 2));
        let beside = number(one.ratio_beside_reference, 2);
        text += &format!("  {:<width$} {predicted:>10} {measured:>10} {ratio:>9} {beside:>17}\n", one.name);
    }
    text
}
