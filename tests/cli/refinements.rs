//! `pd-verify convergence`: what it writes, and what it refuses.

use crate::support::{Place, rows};

const HEAD: &str = r#"format = 1
id = "mine"
kind = "convergence"
title = "Refined"
material = { youngs_modulus_gpa = 200, density_kg_m3 = 8000 }
[[case]]
id = "a"
title = "A"
"#;

const WAVE: &str = r#"asks = "plane_wave"
body = "plane_stress"
wavelength_m = 1
direction = [2, 1]
branch = "S"
path = { refine = "delta", m = 2, dx_m = [0.1, 0.05, 0.025, 0.0125] }
weights = { kernel = "gaussian", p = 2, volume_rule = "linear", calibrated = [false, true] }
"#;

const BAR: &str = r#"asks = "point_pulse"
body = "bar"
side_m = 1
width_m = 0.08
path = { refine = "m", horizon_m = 0.1, m = [4, 8, 16, 32] }
weights = { kernel = "constant", volume_rule = ["full", "linear"] }
"#;

const SQUARE: &str = r#"asks = "manufactured"
body = "plane_strain"
path = { refine = "delta_m", m = [2, 3, 4, 6, 8], dx_m = [0.0625, 0.027777777777777776, 0.015625, 0.006944444444444444, 0.00390625] }
weights = { kernel = "gaussian", p = 1, volume_rule = "linear", calibrated = true }
side_m = 1
"#;

const RULES: &str = r#"asks = "volume_rules"
body = "plane_stress"
m = [8, 64]
k_horizon = 1
branch = "P"
weights = { kernel = "constant", volume_rule = "exact_area" }
"#;

const WAVES: &str = r#"asks = "frequency"
body = "plane_stress"
dx_m = 0.01
cells_per_wave = 12
direction = [[1, 0], [2, 1]]
lattice = { kernel = "constant", m = 2, volume_rule = "linear" }
"#;

fn place(case: &str) -> Place {
    Place::with_study(format!("{HEAD}{case}"))
}

#[test]
fn rows_have_the_columns_that_scripts_read() {
    let place = place(WAVE);
    place.run(&["convergence", "study.toml", "--strict"]).code(0);
    let text = place.read("reports/mine/convergence.csv");
    let columns = "sequence,case,kernel,p,volume_rule,calibrated,m,dx_m,horizon_m,norm,error,pairwise_order";
    assert_eq!(text.lines().next(), Some(columns));
    let rows = rows(&text);
    assert_eq!(rows.len(), 2 * 4 * 3, "two lattices, four levels, three norms");
    let calibrated: Vec<f64> = rows
        .iter()
        .filter(|row| row["calibrated"] == "true" && row["norm"] == "l2")
        .map(|row| row["error"].parse().unwrap())
        .collect();
    assert!(calibrated.windows(2).all(|pair| pair[1] < 0.35 * pair[0]), "{calibrated:?}");
    assert!(rows.iter().all(|row| (row["dx_m"] == "0.1") == row["pairwise_order"].is_empty()));
    assert!(place.read("reports/mine/a.svg").contains("order 2"));
}

#[test]
fn every_word_is_answered() {
    for (case, words) in [
        (BAR, ["constant_full_printed", "constant_linear_printed"]),
        (SQUARE, ["order_l1", "order_linf"]),
        (RULES, ["constant_exact_area_printed_law", "constant_exact_area_printed_order"]),
        (WAVES, ["relation", "straight"]),
    ] {
        let place = place(case);
        place.run(&["run", "study.toml", "--strict"]).code(0);
        let verdicts = rows(&place.read("reports/mine/verdicts.csv"));
        for word in words {
            let claim = format!("mine/a/{word}");
            let row = verdicts.iter().find(|row| row["claim"] == claim);
            assert_eq!(row.map(|row| row["verdict"].as_str()), Some("pass"), "{claim}");
        }
    }
}

#[test]
fn levels_that_show_no_order_are_inconclusive() {
    // Waves of five to six cells are not asymptotic.
    let place = place(
        &WAVE.replace("[0.1, 0.05, 0.025, 0.0125]", "[0.2, 0.1, 0.05]").replace("[false, true]", "true"),
    );
    place.run(&["run", "study.toml"]).code(0);
    let verdicts = rows(&place.read("reports/mine/verdicts.csv"));
    let order = verdicts.iter().find(|row| row["claim"] == "mine/a/order_l2").unwrap();
    assert_eq!(order["verdict"], "inconclusive");
    assert!(order["note"].contains("outside the asymptotic range"), "{}", order["note"]);
    place.run(&["run", "study.toml", "--strict"]).code(1);
}

#[test]
fn what_cannot_be_refined_is_refused_and_nothing_is_written() {
    for (case, old, new, said) in [
        (WAVE, "direction = [2, 1]", "direction = [0, 0]", "is no direction"),
        (WAVE, "direction = [2, 1]\n", "", "a plate needs direction"),
        (WAVE, "dx_m = [0.1, 0.05, 0.025, 0.0125]", "dx_m = [0.1, 0.05]", "an order needs three levels"),
        (WAVE, "dx_m = [0.1, 0.05, 0.025, 0.0125]", "dx_m = [0.1, 0.07, 0.033]", "no wave near this length"),
        (WAVE, "m = 2, dx_m", "m = 30, dx_m", "shorter than the family reaches"),
        (WAVE, "\"plane_stress\"", "\"bar\"", "direction says nothing about a bar"),
        (BAR, "refine = \"m\"", "refine = \"delta\"", "a refinement of delta needs dx_m"),
        (BAR, "m = [4, 8, 16, 32]", "m = [4, 8, 8]", "each finer than the one before"),
        (BAR, "width_m = 0.08", "width_m = 0.3", "reaches beyond its period"),
        (BAR, "horizon_m = 0.1", "horizon_m = 0.13", "does not divide the body"),
        (SQUARE, "m = [2, 3, 4, 6, 8]", "m = [20, 30, 40, 60, 80]", "larger than the body"),
        (SQUARE, "side_m = 1\n", "side_m = 0.25\naround = \"held_frame\"\n", "leaves little of"),
        (RULES, "m = [8, 64]", "m = [2, 64]", "shows no law of large m"),
        (RULES, "\"plane_stress\"", "\"bar\"", "a bar has no rim"),
        (WAVES, "cells_per_wave = 12", "cells_per_wave = 1", "shorter than the family reaches"),
    ] {
        assert!(case.contains(old), "{old}");
        let place = place(&case.replace(old, new));
        place.refuses(&["run", "study.toml"], &[said]);
    }
}

/// A case's figure has a CSV that is called like the case, also where the case asks what the table is called after.
#[test]
fn a_case_is_not_called_like_the_table_that_it_writes() {
    for (id, case) in [
        ("volume_rules", RULES),
        ("patch", "asks = \"patch\"\n"),
        ("grid_convergence", "asks = \"grid_convergence\"\n"),
        ("convergence", WAVE),
    ] {
        let place = place(case);
        let set = place.read("study.toml").replace("id = \"a\"", &format!("id = \"{id}\""));
        place.write("study.toml", set);
        place.refuses(&["run", "study.toml"], &["study.toml:7:", "is the name of a table", "another id"]);
    }
}

#[test]
fn a_material_is_missed_whatever_the_body() {
    for case in [WAVE, BAR, SQUARE] {
        let place = place(case);
        let text = place.read("study.toml");
        let bare: Vec<&str> = text.lines().filter(|line| !line.starts_with("material")).collect();
        place.write("study.toml", bare.join("\n"));
        place.refuses(&["run", "study.toml"], &["needs the material of its body", "[material]"]);
    }
}

#[test]
fn a_plan_of_a_body_at_rest_has_no_steps() {
    let place = place(SQUARE);
    let said = place.run(&["plan", "study.toml"]).code(0);
    let text = String::from_utf8_lossy(&said.get_output().stdout).into_owned();
    assert!(text.contains("5 scenes to find at rest, shown below") && !text.contains("to march"), "{text}");
    let rows = text.lines().filter(|line| line.split_whitespace().rev().take(3).all(|word| word == "-"));
    assert_eq!(rows.filter(|line| line.contains(" at rest ")).count(), 5, "{text}");
    let said = place.run(&["plan", "study.toml", "--json"]).code(0);
    let plan: serde_json::Value = serde_json::from_slice(&said.get_output().stdout).expect("a plan in JSON");
    let scene = &plan["cases"][0]["scenes"][0];
    assert_eq!(scene["steps"], 0, "{plan}");
    assert!(scene["nodes"].as_u64().is_some_and(|nodes| nodes == 256), "{scene}");
}
