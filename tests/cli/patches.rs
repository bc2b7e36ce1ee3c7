//! Patches through the program: what they write, how often, and what a plan says of them.

use crate::support::{Place, rows};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;

const PLATE: &str = r#"format = 1
id = "plate"
kind = "scene"
title = "Plate"
material = { youngs_modulus_gpa = 70, density_kg_m3 = 2700 }
[[case]]
id = "fall"
asks = "march"
body = "plane_stress"
size_mm = [40, 30]
dx_mm = 2
duration_us = 8
lattice = { kernel = "constant", m = 2, volume_rule = "linear", calibrated = false }
[[case.effect]]
acts = "body_force"
axis = "y"
density_n_m3 = 2.7e9
history = { shape = "step" }
[[case.probe]]
name = "tip"
watches = "patch"
from_mm = [9, 5]
to_mm = [13, 8]
"#;

#[test]
fn a_patch_is_written_node_by_node() {
    let place = Place::with_study(PLATE);
    place.run(&["run", "study.toml", "--strict", "--quiet"]).code(0);
    let probes = rows(&place.read("reports/plate/probes.csv"));
    // Nodes at 9, 11, 13 and 5, 7 mm, two vectors of two components, at t = 0 and five times more.
    assert_eq!(probes.len(), 3 * 2 * 4 * 6);
    for row in &probes {
        let value: f64 = row["value"].parse().unwrap();
        let expected = if row["quantity"] == "acceleration_y" { 1e6 } else { 0.0 };
        // The plate falls as one: y displacements are those of the fall.
        if row["quantity"] == "displacement_y" {
            let t: f64 = row["t_s"].parse().unwrap();
            assert!((value - 5e5 * t * t).abs() < 1e-15, "{row:?}");
        } else {
            assert!((value - expected).abs() <= 1e-9 * 1e6, "{row:?}");
        }
        assert_eq!(row["unit"], if row["quantity"].starts_with("acc") { "m/s²" } else { "m" });
    }
    let place_of = |key: &str| probes[0][key].parse::<f64>().unwrap();
    assert!((place_of("x_m") - 9e-3).abs() < 1e-15 && (place_of("y_m") - 5e-3).abs() < 1e-15);
    let said = place.run(&["plan", "study.toml"]).code(0);
    said.stdout(contains("patches:     0.001 MB in memory").and(contains("snapshots:").not()));
    let json = place.run(&["plan", "study.toml", "--json"]).code(0);
    json.stdout(contains(format!("\"patch_bytes\": {}", 3 * 2 * 4 * 8 * 6)));
}

#[test]
fn a_pace_that_fills_the_memory_or_the_table_is_refused() {
    let wide = PLATE.replace("from_mm = [9, 5]", "every_steps = 1\nfrom_mm = [0, 0]");
    let often = wide.replace("to_mm = [13, 8]", "to_mm = [40, 30]").replace("n_us = 8", "n_us = 1000");
    Place::with_study(often).refuses(&["run", "study.toml"], &["rows are asked for", "every_steps"]);
    let endless =
        wide.replace("to_mm = [13, 8]", "to_mm = [40, 30]").replace("duration_us = 8", "duration_s = 1");
    Place::with_study(endless)
        .refuses(&["run", "study.toml"], &["study.toml:", "the patches would hold", "at most 4 GiB"]);
}
