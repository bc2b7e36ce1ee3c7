//! Running notches through the program: judged like any march, told by a plan, refused with their place.

use crate::support::{Place, rows};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;

const PLATE: &str = r#"format = 1
id = "plate"
kind = "scene"
title = "Plate"
material = { youngs_modulus_gpa = 70, density_kg_m3 = 2700 }
[[case]]
id = "tear"
asks = "march"
body = "plane_stress"
size_mm = [80, 40]
dx_mm = 2
duration_us = 40
lattice = { kernel = "constant", m = 3, volume_rule = "linear", calibrated = false }
notch = [{ from_mm = [0, 20], to_mm = [20, 20], runs = { speed_km_s = 1.5, start_us = 2, by_mm = 30 } }]
[[case.effect]]
acts = "face_traction"
normal_mpa = 10
history = { shape = "step" }
[[case.probe]]
name = "all"
watches = "energies"
"#;

#[test]
fn a_running_notch_keeps_what_every_march_keeps() {
    let place = Place::with_study(PLATE);
    place.run(&["run", "study.toml", "--strict", "--quiet"]).code(0);
    let verdicts = rows(&place.read("reports/plate/verdicts.csv"));
    let passed = |claim: &str| {
        let found = verdicts.iter().find(|row| row["claim"].ends_with(claim));
        found.is_some_and(|row| row["verdict"] == "pass")
    };
    for claim in ["finite", "energy_balance", "operators_agree", "momentum"] {
        assert!(passed(claim), "{claim}: {verdicts:?}");
    }
    let probes = rows(&place.read("reports/plate/probes.csv"));
    let cut: Vec<f64> = probes
        .iter()
        .filter(|row| row["quantity"] == "energy_of_cut_bonds")
        .map(|row| row["value"].parse().unwrap())
        .collect();
    // The tip sets out at 2 µs and has gone its way at 22 µs.
    assert!(cut[0] == 0.0 && cut.last().unwrap() > &0.0);
    assert!(cut[cut.len() * 23 / 40..].windows(2).all(|pair| pair[0] == pair[1]));
    let plan = place.run(&["plan", "study.toml"]).code(0);
    let steps = contains("a notch runs over a cell in").and(contains("running notch"));
    plan.stdout(steps.and(contains("face traction")));
    let json = place.run(&["plan", "study.toml", "--json"]).code(0);
    json.stdout(contains("\"steps_per_cell\""));
    let standing =
        Place::with_study(PLATE.replace(", runs = { speed_km_s = 1.5, start_us = 2, by_mm = 30 }", ""));
    standing.run(&["plan", "study.toml"]).code(0).stdout(contains("a notch runs over").not());
}

#[test]
fn a_notch_that_cannot_run_is_refused() {
    let line = "study.toml:14:";
    for (old, new, words) in [
        ("speed_km_s = 1.5", "speed_km_s = 0", &[line, "a positive number"][..]),
        ("speed_km_s = 1.5, ", "", &[line, "speed_m_s"]),
        ("speed_km_s", "sped_km_s", &[line, "unknown key `sped_km_s`", "did you mean `speed_m_s`?", "_km_s"]),
        ("start_us = 2", "start_us = -2", &[line, "cannot set out at"]),
        ("by_mm = 30", "by_mm = 1", &[line, "shorter than a cell"]),
        (
            "by_mm = 30",
            "by_mm = 61",
            &[line, "runs out of the body: to 0.081 m along x", "by 0.06 m or less"],
        ),
        ("by_mm = 30", "until_mm = 60", &[line, "until_mm"]),
        ("dx_mm = 2", "surface_correction = \"volume\"\ndx_mm = 2", &["for the bonds at t = 0", "leave"]),
    ] {
        assert!(PLATE.contains(old), "the study has no {old}");
        Place::with_study(PLATE.replacen(old, new, 1)).refuses(&["run", "study.toml"], words);
    }
}

/// 1.5 km/s, 1500 m/s and 1.5 mm/µs are one speed, and no ending makes another of it.
#[test]
fn speeds_have_units() {
    let pace = |speed: &str| {
        let place = Place::with_study(PLATE.replace("speed_km_s = 1.5", speed));
        let said = place.run(&["plan", "study.toml"]).code(0);
        let text = String::from_utf8_lossy(&said.get_output().stdout).into_owned();
        text.lines().find(|line| line.contains("a notch runs over")).map(str::to_owned).unwrap()
    };
    let expected = pace("speed_m_s = 1500");
    for speed in ["speed_km_s = 1.5", "speed_mm_us = 1.5", "speed_m_us = 0.0015", "speed_m_ms = 1.5"] {
        assert_eq!(pace(speed), expected, "{speed}");
    }
}
