//! A bar whose motion is known: the estimate beside its true error, both questions beside each other, and what has no answer.

use super::levels::{Level, Own};
use super::search::{Found, Goal, Machine, SHARE, Stopped, search};
use crate::study::Study;
use crate::subject::PdVerify;
use pd_verify::compare::richardson::SAFETY;
use pd_verify::record::{Failure, Record};
use std::f64::consts::TAU;

/// A bar between rollers that swings in its second mode for a period and a quarter: u = sin 2πx cos 2πct.
const SWINGING: &str = r#"format = 1
id = "swinging"
kind = "scene"
title = "A bar that swings"
material = { youngs_modulus_gpa = 200, density_kg_m3 = 8000 }
[[case]]
id = "second"
asks = "march"
body = "bar"
size_m = 1.0
dx_mm = 10
duration_us = 250
edges = { left = "roller", right = "roller" }
lattice = { kernel = "constant", m = 3, volume_rule = "linear", calibrated = true }
initial = [{ sets = "displacement", shape = "wave", amplitude = 1e-6, wavenumber_per_m = [6.283185307179586], phase_rad = -1.5707963267948966 }]
probe = [{ name = "quarter", watches = "point", at_m = 0.25 }]
"#;

/// √(200 GPa/8000 kg/m³).
const SPEED: f64 = 5000.0;

/// Of a node update, in s.
const RATE: f64 = 1e-8;

fn own(text: &str) -> Own {
    Own::new(Study::read("swinging.toml", text, &[]).unwrap().0, None).unwrap()
}

fn by_rate(level: &Level) -> Result<(Record, f64), Failure> {
    Ok((level.scene.march(&PdVerify)?, RATE * level.plan.node_updates as f64))
}

fn found(own: &Own, goal: Goal, memory: f64) -> Found {
    let machine = Machine { march: &by_rate, costs: None, memory, stop: &|| false };
    search(own, goal, &machine).unwrap()
}

fn asked(goal: Goal) -> Found {
    found(&own(SWINGING), goal, f64::INFINITY)
}

/// Root mean square over the looks of a level, over the amplitude.
fn true_error(own: &Own, cells: usize) -> f64 {
    let record = own.level(cells).unwrap().scene.march(&PdVerify).unwrap();
    let trace = &record.traces[0];
    let exact = |t: f64| 1e-6 * (TAU * SPEED * t).cos();
    let squares = trace.times.iter().zip(&trace.rows).map(|(&t, row)| (row[0] - exact(t)).powi(2));
    (squares.sum::<f64>() / trace.times.len() as f64).sqrt() / 1e-6
}

#[test]
fn the_answer_is_as_accurate_as_asked_and_the_estimate_is_the_true_error() {
    let own = own(SWINGING);
    for error in [1e-2, 1e-3, 1e-4] {
        let found = found(&own, Goal::Error(error), f64::INFINITY);
        let chosen = found.chosen.as_ref().unwrap();
        assert!(found.met(), "{error}: {chosen:?}");
        let exact = true_error(&own, chosen.cells);
        // Before it is marched the answer is a power law's, from levels twice as coarse and more; then it has its own difference.
        let outcome = *chosen.outcome.as_ref().unwrap().error.as_ref().unwrap();
        for (estimated, factor) in [(chosen.error, 1.5), (outcome, 1.25)] {
            assert!((1.0 / factor..factor).contains(&(estimated / exact)), "{error}: {estimated} {exact}");
        }
        assert!(exact <= 1.25 * error, "{error}: {exact}");
        // The next coarser level has more than was asked, by the law that was found and with the factor of safety.
        let order = chosen.order.unwrap();
        let coarser = own.ladder.from(chosen.cells - own.ladder.step);
        let estimate = chosen.error * (chosen.cells as f64 / coarser as f64).powf(order);
        assert!(coarser == chosen.cells - 4 && SAFETY * estimate > error, "{coarser} {estimate}");
        assert!((order - 2.0).abs() < 0.3, "{order}");
    }
}

/// Pulled by a ramp, the bar's strain has kinks: it follows h(t − t₁) + h(t − t₂) until the wave comes back from the free end.
#[test]
fn kinks_are_estimated_as_well_as_waves() {
    let pulled = SWINGING
        .replace("left = \"roller\", right = \"roller\"", "left = \"roller\"")
        .replace("duration_us = 250", "duration_us = 440")
        .replace("watches = \"point\", at_m = 0.25", "watches = \"strain\", at_m = 0.5");
    let start = pulled.find("initial =").unwrap();
    let end = start + pulled[start..].find('\n').unwrap();
    let ramp = r#"effect = [{ acts = "traction", edge = "right", axis = "x", stress_mpa = 200, history = { shape = "ramp", rise_us = 100 } }]"#;
    let own = own(&format!("{}{ramp}{}", &pulled[..start], &pulled[end..]));
    let found = found(&own, Goal::Error(4e-3), f64::INFINITY);
    let chosen = found.chosen.as_ref().unwrap();
    assert!(found.met(), "{chosen:?}");
    // Stress over E is 10⁻³, the wave takes 100 µs to the middle and 300 µs by way of the held end; there strain doubles.
    let h = |t: f64| (t / 100e-6).clamp(0.0, 1.0);
    let exact = |t: f64| 1e-3 * (h(t - 100e-6) + h(t - 300e-6));
    let record = own.level(chosen.cells).unwrap().scene.march(&PdVerify).unwrap();
    let trace = &record.traces[0];
    let squares = trace.times.iter().zip(&trace.rows).map(|(&t, row)| (row[0] - exact(t)).powi(2));
    let error = (squares.sum::<f64>() / trace.times.len() as f64).sqrt() / 2e-3;
    let outcome = *chosen.outcome.as_ref().unwrap().error.as_ref().unwrap();
    assert!((0.67..1.5).contains(&(outcome / error)), "{outcome} {error}");
    assert!((chosen.order.unwrap() - 1.0).abs() < 0.35, "{chosen:?}");
}

#[test]
fn levels_count_what_they_do_and_take_a_tenth_of_the_answer() {
    let found = asked(Goal::Error(1e-4));
    let chosen = found.chosen.as_ref().unwrap();
    let mut coarse = 0.0;
    for level in &found.levels {
        // Cells are counted from 8 in fours; each step moves all nodes.
        assert!(level.cells >= 8 && level.cells % 4 == 0);
        assert_eq!(level.plan.nodes as usize, level.cells);
        assert_eq!(level.plan.node_updates, level.cells as u64 * level.plan.steps);
        // As many whole steps as cover the duration.
        let over = level.plan.steps as f64 * level.plan.time_step_s - 250e-6;
        assert!((-1e-12..level.plan.time_step_s).contains(&over), "{over}");
        assert_eq!(level.seconds, RATE * level.plan.node_updates as f64);
        coarse += if level.cells == chosen.cells { 0.0 } else { level.seconds };
        // The rate is one number: so is what is predicted, and what is taken.
        let predicted = level.predicted.unwrap_or(level.seconds);
        assert!((predicted / level.seconds - 1.0).abs() < 1e-12, "{level:?}");
    }
    assert!(found.levels.windows(2).all(|pair| pair[0].cells < pair[1].cells));
    assert!(coarse <= SHARE * chosen.predicted && found.levels.len() >= 5, "{coarse}");
    // Δt/Δx is one number, that of the scene as written: 100 cells, a step of 0.8 of the limit made to fill the duration.
    let courant = |level: &super::search::Marched| level.plan.time_step_s / level.spacing;
    let written = own(SWINGING).level(100).unwrap();
    for level in &found.levels {
        assert!((courant(level) / (written.plan.time_step_s / 0.01) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn both_questions_have_one_answer() {
    let by_error = asked(Goal::Error(3e-4));
    let chosen = by_error.chosen.as_ref().unwrap();
    // What it takes affords it, and no finer one; a little less does not.
    let afforded = |seconds: f64| asked(Goal::Budget(seconds)).chosen.unwrap();
    let same = afforded(chosen.predicted * (1.0 + 1e-9));
    assert_eq!(same.cells, chosen.cells);
    assert!((0.67..1.5).contains(&(same.error / chosen.error)), "{} {}", same.error, chosen.error);
    assert_eq!(afforded(chosen.predicted * 0.999).cells, chosen.cells - 4);
    let found = asked(Goal::Budget(chosen.predicted));
    assert!(found.met());
    let coarse: f64 =
        found.levels.iter().filter(|level| level.cells != chosen.cells).map(|level| level.seconds).sum();
    assert!(coarse <= SHARE * chosen.predicted);
    // Time goes with the square of cells in a bar: four times the budget affords twice as many, but for a step or two.
    let finer = afforded(4.0 * chosen.predicted);
    assert!(
        (finer.cells as f64 / (2.0 * chosen.cells as f64) - 1.0).abs() < 0.03,
        "{} {}",
        finer.cells,
        chosen.cells
    );
    let own = own(SWINGING);
    let exact = true_error(&own, finer.cells);
    assert!((0.67..1.5).contains(&(finer.error / exact)), "{} {exact}", finer.error);
}

#[test]
fn a_slower_machine_than_predicted_fails_a_budget_and_not_an_error() {
    let own = own(SWINGING);
    let slow = |level: &Level| {
        let slower = if level.cells > 100 { 2.0 } else { 1.0 };
        by_rate(level).map(|(record, seconds)| (record, slower * seconds))
    };
    let machine = Machine { march: &slow, costs: None, memory: f64::INFINITY, stop: &|| false };
    let of = |goal| search(&own, goal, &machine).unwrap();
    let by_error = of(Goal::Error(5e-4));
    assert!(by_error.met());
    let chosen = by_error.chosen.unwrap();
    assert!(chosen.cells > 100, "{}", chosen.cells);
    let by_budget = of(Goal::Budget(chosen.predicted));
    let outcome = by_budget.chosen.as_ref().unwrap().outcome.as_ref().unwrap();
    assert!((outcome.seconds / chosen.predicted - 2.0).abs() < 0.1 && !by_budget.met());
}

#[test]
fn what_cannot_be_told_has_no_number() {
    let poor = asked(Goal::Budget(1e-4));
    assert!(poor.chosen.is_none() && !poor.met());
    assert!(poor.estimate.unwrap_err().contains("a tenth of 0.0001 s"));
    // Levels whose results are shifted to and fro.
    let own = own(SWINGING);
    let shaken = |level: &Level| {
        let (mut record, seconds) = by_rate(level)?;
        let shift = if level.plan.steps.is_multiple_of(2) { 1e-8 } else { -1e-8 };
        record.traces[0].rows.iter_mut().for_each(|row| row[0] += shift * level.cells as f64);
        Ok((record, seconds))
    };
    let machine = Machine { march: &shaken, costs: None, memory: f64::INFINITY, stop: &|| false };
    let found = search(&own, Goal::Budget(10.0), &machine).unwrap();
    assert!(found.chosen.is_none() && !found.met(), "{:?}", found.chosen);
    let stopped = Machine { stop: &|| true, march: &by_rate, ..machine };
    assert!(matches!(search(&own, Goal::Error(0.1), &stopped), Err(Stopped::Interrupted)));
}

#[test]
fn what_does_not_fit_is_not_run() {
    let own = own(SWINGING);
    let chosen = found(&own, Goal::Error(1e-4), f64::INFINITY).chosen.unwrap();
    let found = found(&own, Goal::Error(1e-4), 0.9 * chosen.bytes);
    let (met, refused) = (found.met(), found.chosen.unwrap());
    assert_eq!((refused.cells, met), (chosen.cells, false));
    assert!(refused.not_run.unwrap().contains("GB are free") && refused.outcome.is_none());
    assert!(found.levels.iter().all(|level| level.cells < chosen.cells));
}
