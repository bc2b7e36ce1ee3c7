//! Plates with holes and edges through the program: the shipped example, what its plan says, what is refused and how.

use crate::support::{Place, rows};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use serde_json::Value;

const PLATE: &str = include_str!("../../studies/scene/examples/holed-plate.toml");

fn plate_with(old: &str, new: &str) -> String {
    assert!(PLATE.contains(old), "the study has no {old}");
    PLATE.replacen(old, new, 1)
}

fn refused(slips: &[(&str, &str, &[&str])]) {
    for (old, new, words) in slips {
        Place::with_study(plate_with(old, new)).refuses(&["run", "study.toml"], words);
    }
}

/// A coarse one that marches in no time.
fn coarse() -> String {
    plate_with("dx_mm = 0.5", "dx_mm = 1").replacen("duration_us = 150", "duration_us = 2", 1)
}

/// The study without its expectations.
fn without_expectations(text: &str) -> String {
    text.split("# Finite elements").next().unwrap().to_owned()
}

#[test]
fn the_example_meets_finite_elements_and_its_plan_tells_hole_and_band() {
    let place = Place::with_study(PLATE);
    place.run(&["run", "study.toml", "--strict", "--quiet"]).code(0);
    let on = "hole, surface correction, mirror_odd edge";
    let said = place.run(&["plan", "study.toml"]).code(0);
    said.stdout(contains(on).and(contains("operator:    stencil; 690 of 2421 nodes (28.5 %) as a list")));
    let said = place.run(&["plan", "study.toml", "--json"]).code(0);
    let plan: Value = serde_json::from_slice(&said.get_output().stdout).unwrap();
    let scene = &plan["cases"][0]["scenes"][0];
    let within = |n: &usize| ((n % 50) as f64 + 0.5).hypot((n / 50) as f64 + 0.5) < 10.0;
    let left = 2500 - (0..2500).filter(within).count();
    assert_eq!((&scene["nodes"], &scene["band_nodes"]), (&Value::from(left), &Value::from(690)));
    let bare = PLATE.replace("surface_correction = \"energy\"\n", "");
    let whole = bare.replace("[[case.hole]]\ncentre_m = [0, 0]\nradius_mm = 5\n", "");
    let said = Place::with_study(whole).run(&["plan", "study.toml"]).code(0);
    said.stdout(contains("effects off: notch, hole,").and(contains("operator:    stencil\n")));
}

#[test]
fn where_no_node_stands_a_cell_is_empty() {
    let place = Place::with_study(without_expectations(&coarse()));
    place.run(&["run", "study.toml", "--strict", "--quiet"]).code(0);
    let probes = rows(&place.read("reports/holed-plate/probes.csv"));
    let row: Vec<_> = probes.iter().filter(|row| row["probe"] == "row").collect();
    assert!(!row.is_empty());
    for seen in row {
        // Centres at 0.5, 1.5, … mm, the row itself at 0.5 mm: up to 4.5 mm they lie within 5 mm.
        assert_eq!(seen["value"].is_empty(), seen["x_m"].parse::<f64>().unwrap() < 5e-3, "{seen:?}");
    }
}

#[test]
fn an_expectation_takes_a_node_that_is_there() {
    let expect = r#"
[[case.expect]]
probe = "row"
quantity = "displacement_x"
at_m = 0.001
at_us = 0
value = 0
tolerance = 1e-12
basis = "theory"
because = "it begins at rest, at the rim too"
"#;
    let place = Place::with_study(without_expectations(&coarse()) + expect);
    place.run(&["run", "study.toml", "--strict", "--quiet"]).code(0);
}

#[test]
fn holes_that_cannot_be() {
    let line = "centre_m = [0, 0]";
    refused(&[
        (
            line,
            "centre_m = [0.03, 0.03]",
            &["study.toml:27:", "lies outside the plate", "0.007071", "(0.025, 0.025) m"],
        ),
        (
            line,
            "centre_m = [0, -0.001]",
            &["study.toml:27:", "beyond an edge that is mirror_odd (a roller)", "onto the edge"],
        ),
        (line, "centre_m = [0]", &["study.toml:27:"]),
        (
            "radius_mm = 5",
            "radius_mm = 40",
            &["study.toml:28:", "the hole swallows the plate", "smaller radius"],
        ),
        ("radius_mm = 5", "radius_mm = 0.3", &["study.toml:28:", "removes no node", "larger radius_m"]),
        ("radius_mm = 5", "radius_mm = 0", &["study.toml:28:", "a positive number"]),
        ("radius_mm = 5", "diameter_mm = 5", &["study.toml:28:", "unknown key `diameter_mm`"]),
        ("radius_mm = 5\n", "", &["radius_m"]),
        (
            "at_m = [0.025, 0]",
            "at_m = [0.004, 0.001]",
            &["study.toml:44:", "\"pulled\"", "a hole has removed", "stands at ["],
        ),
        ("radius_mm = 5", "radius_mm = 25.5", &["study.toml:44:", "\"pulled\"", "a hole has removed"]),
    ]);
    let gone = without_expectations(&plate_with("radius_mm = 5", "radius_mm = 25.5"));
    let gone = gone.replace("at_m = [0.025, 0]", "at_m = [0.024, 0.024]");
    let gone = gone.replace("at_m = [0, 0.025]", "at_m = [0.0225, 0.0235]");
    Place::with_study(gone).refuses(&["run", "study.toml"], &["\"row\" runs through a hole from end to end"]);
    let bar = PLATE
        .replace("\"plane_stress\"", "\"bar\"")
        .replace("size_m = [0.025, 0.025]", "size_m = 0.025")
        .replace("thickness_m", "section_m2")
        .replace(", bottom = \"roller\"", "");
    Place::with_study(bar)
        .refuses(&["run", "study.toml"], &["study.toml:26:", "a bar has no holes", "take a plate"]);
}

#[test]
fn edges_that_contradict_what_acts_there() {
    let pulled = "acts = \"traction\"\nedge = \"right\"\naxis = \"x\"\nstress_mpa = 200\n";
    let driven = |edge: &str, axis: &str| {
        format!(
            "acts = \"prescribed_motion\"\nregion = {{ edge = \"{edge}\" }}\naxis = \"{axis}\"\ndisplacement_um = 1\n"
        )
    };
    let (left, bottom) = (driven("left", "x"), driven("bottom", "y"));
    refused(&[
        (
            pulled,
            &left,
            &[
                "study.toml:33:",
                "the left edge is mirror_odd (a roller)",
                "holds it along x",
                "leave this motion out",
            ],
        ),
        (pulled, &bottom, &["study.toml:33:", "the bottom edge is mirror_odd", "holds it along y"]),
        (
            "edge = \"right\"",
            "edge = \"left\"",
            &["study.toml:32:", "the left edge is mirror_odd (a roller)", "free edge"],
        ),
        (
            "bottom = \"roller\"",
            "bottom = \"periodic\"",
            &["study.toml:22:", "periodic edge on the other side"],
        ),
    ]);
    let even = plate_with("bottom = \"roller\"", "bottom = \"mirror_even\"");
    let even = even.replacen(pulled, &driven("bottom", "x"), 1);
    Place::with_study(even)
        .refuses(&["run", "study.toml"], &["bottom edge is mirror_even", "holds it along x"]);
    let ring = plate_with("bottom = \"roller\"", "bottom = \"periodic\", top = \"periodic\"");
    let ring =
        ring.replacen(pulled, &driven("top", "y"), 1).replacen("at_m = [0, 0.025]", "at_m = [0, 0.01]", 1);
    Place::with_study(ring)
        .refuses(&["run", "study.toml"], &["the top edge is periodic", "box by from_m and to_m"]);
    let thin = plate_with(pulled, &driven("right", "x").replace("\" }", "\", depth_mm = 0.2 }"));
    Place::with_study(thin)
        .refuses(&["run", "study.toml"], &["a layer of 0.0002 m is thinner than a cell", "0.0005 m or more"]);
}

#[test]
fn a_roller_is_mirror_odd_and_the_schema_knows_both() {
    let short = without_expectations(&coarse());
    let seen = |text: &str| {
        let place = Place::with_study(text);
        place.run(&["run", "study.toml", "--quiet"]).code(0);
        place.read("reports/holed-plate/probes.csv")
    };
    assert!(seen(&short) == seen(&short.replace("\"roller\"", "\"mirror_odd\"")));
    let printed = Place::new().run(&["schema"]).code(0);
    let schema = String::from_utf8_lossy(&printed.get_output().stdout).into_owned();
    for word in ["\"roller\"", "\"radius_mm\"", "\"centre_m\"", "\"hole\""] {
        assert!(schema.contains(word), "the schema has no {word}");
    }
}
