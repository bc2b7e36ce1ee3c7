//! Scenes of one's own through the program: what they write, what is refused, what happens above the limit.

use crate::support::{Place, rows};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

const BAR: &str = r#"format = 1
id = "my-bar"
kind = "scene"
title = "Steel"

[material]
youngs_modulus_gpa = 200
density_kg_m3 = 7850

[[case]]
id = "pull"
asks = "march"
body = "bar"
size_m = 1.0
dx_mm = 10
section_m2 = 1e-6
duration_ms = 0.2
safety = 0.8
edges = { left = "mirror_odd", right = "free" }
lattice = { kernel = "gaussian", p = 2, m = 3, volume_rule = "linear", calibrated = true }

[[case.initial]]
sets = "displacement"
shape = "gaussian"
amplitude = 1e-4
centre_mm = [500]
width_mm = 100

[[case.effect]]
acts = "traction"
edge = "right"
axis = "x"
stress_mpa = 1
history = { shape = "table", times_us = [0, 10, 20], values = [0, 1, 0.5] }

[[case.probe]]
name = "middle"
watches = "strain"
at_m = 0.5
every_steps = 10

[[case.probe]]
name = "line"
watches = "line"

[[case.expect]]
probe = "middle"
quantity = "strain"
at_us = 0
value = 0
tolerance = 1e-9
basis = "theory"
because = "the initial field is even about the middle"
"#;

fn bar_with(old: &str, new: &str) -> String {
    assert!(BAR.contains(old), "the study has no {old}");
    BAR.replacen(old, new, 1)
}

/// What is replaced by what in the bar, and what the message must say.
struct Slip(&'static str, &'static str, &'static [&'static str]);

fn refused(slips: &[Slip]) {
    for Slip(old, new, words) in slips {
        Place::with_study(bar_with(old, new)).refuses(&["run", "study.toml"], words);
    }
}

fn example(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies/scene/examples").join(name);
    path.display().to_string()
}

#[test]
fn a_bar_is_marched_and_its_probes_are_written() {
    let place = Place::with_study(BAR);
    place.run(&["run", "study.toml", "--strict"]).code(0).stdout(contains("energy_balance"));
    let probes = rows(&place.read("reports/my-bar/probes.csv"));
    let middle: Vec<_> = probes.iter().filter(|row| row["probe"] == "middle").collect();
    assert!(middle.len() > 5);
    for row in &middle {
        assert_eq!(
            [&row["case"], &row["scene"], &row["quantity"], &row["unit"], &row["x_m"], &row["y_m"]],
            ["pull", "pull", "strain", "1", "0.5", ""]
        );
        row["value"].parse::<f64>().unwrap();
    }
    let near = |row: &&BTreeMap<String, String>| {
        row["probe"] == "line" && (row["x_m"].parse::<f64>().unwrap() - 0.105).abs() < 1e-9
    };
    assert_eq!(probes.iter().filter(near).count(), 6);
    for file in ["pull.middle.svg", "pull.middle.csv", "pull.line.svg"] {
        assert!(place.path(&format!("reports/my-bar/{file}")).is_file(), "{file}");
    }
    let verdicts = rows(&place.read("reports/my-bar/verdicts.csv"));
    let claims: Vec<&str> = verdicts.iter().map(|row| row["claim"].rsplit('/').next().unwrap()).collect();
    // A mirror pushes: momentum is not claimed.
    assert_eq!(claims, ["finite", "energy_balance", "operators_agree", "expect_1"]);
}

#[test]
fn the_examples_pass_and_a_plate_that_must_turn_needs_finite_rotations() {
    let place = Place::new();
    for file in ["pulled-bar.toml", "spinning-plate.toml", "notched-plate.toml"] {
        place.run(&["run", &example(file), "--strict", "--quiet"]).code(0);
    }
    let turned = place.run(&["run", &example("spinning-plate.toml"), "--set", "case.spin.rotations=small"]);
    turned.code(1).stdout(contains("fail").and(contains("expect_1")));
    let plan = place.run(&["plan", &example("pulled-bar.toml")]).code(0);
    plan.stdout(contains("effects on:  traction, damping").and(contains("prescribed motion")));
}

#[test]
fn a_sweep_of_lattices_is_a_scene_each() {
    let place = Place::with_study(bar_with("m = 3", "m = [3, 5]"));
    place.run(&["run", "study.toml", "--strict", "--quiet"]).code(0);
    let probes = rows(&place.read("reports/my-bar/probes.csv"));
    for scene in ["m = 3", "m = 5"] {
        assert!(probes.iter().any(|row| row["scene"] == scene), "no {scene}");
    }
    let place = Place::with_study(bar_with("lattice = {", "operator = \"bonds\"\nlattice = {"));
    place.run(&["run", "study.toml", "--strict", "--quiet"]).code(0);
    place.run(&["plan", "study.toml"]).code(0).stdout(contains("operator:    bonds"));
}

#[test]
fn the_limit_is_kept_unless_the_opposite_is_wanted() {
    refused(&[
        Slip(
            "safety = 0.8",
            "time_step_us = 50",
            &["study.toml:18:", "above this lattice's limit", "unstable = true"],
        ),
        Slip("safety = 0.8", "safety = 1.5", &["study.toml:18:", "1.5 is no fraction", "0.8"]),
        Slip("safety = 0.8", "safety = 0.8\ntime_step_us = 1", &["both given", "leave one of the two out"]),
        Slip("safety = 0.8", "unstable = true", &["study.toml:18:", "unstable says nothing", "time_step_s"]),
    ]);
    let case = BAR.split_once("[[case]]").unwrap().1;
    let second = case.replacen("\"pull\"", "\"other\"", 1);
    let wild = bar_with("safety = 0.8", "time_step_us = 3\nunstable = true").replace("= 0.2", "= 20");
    let place = Place::with_study(format!("{wild}\n[[case]]{second}"));
    let said = place.run(&["run", "study.toml"]).code(3);
    said.stdout(
        contains("error").and(contains("grew without bound")).and(contains("of the lattice's limit")),
    );
    let verdicts = rows(&place.read("reports/my-bar/verdicts.csv"));
    for (case, verdict) in [("pull", "error"), ("other", "pass")] {
        let mut of = verdicts.iter().filter(|row| row["claim"].contains(&format!("/{case}/")));
        assert!(of.all(|row| row["verdict"] == verdict), "{case}: {verdicts:?}");
    }
}

#[test]
fn bodies_that_cannot_be() {
    refused(&[
        Slip(
            "dx_mm = 10",
            "dx_mm = 7",
            &["study.toml:15:", "dx_m = 0.007 does not divide", "0.006993", "0.007042"],
        ),
        Slip(
            "dx_mm = 10",
            "dx_mm = 500",
            &["study.toml:20:", "the horizon of 1.5 m", "larger than the body"],
        ),
        Slip("m = 3", "m = 0.5", &["study.toml:20:", "below 1"]),
        Slip("size_m = 1.0", "size_m = [1.0, 0.5]", &["study.toml:14:", "no size of a bar"]),
        Slip("section_m2", "thickness_m", &["study.toml:16:", "says nothing about a bar", "section_m2"]),
        Slip("right = \"free\"", "bottom = \"free\"", &["study.toml:19:", "a bar has no bottom edge"]),
        Slip("right = \"free\"", "right = \"periodic\"", &["study.toml:19:", "periodic edge on the other"]),
        Slip("right = \"free\"", "rigth = \"free\"", &["study.toml:19:", "did you mean `right`?"]),
        Slip("\"mirror_odd\"", "\"miror_odd\"", &["study.toml:19:", "did you mean `mirror_odd`?"]),
        Slip("duration_ms = 0.2", "duration_ms = 0", &["study.toml:17:", "leaves nothing to simulate"]),
        Slip("duration_ms = 0.2", "duration_ms = -1", &["study.toml:17:", "leaves nothing to simulate"]),
        Slip("duration_ms = 0.2", "duration_ms = inf", &["study.toml:17:", "finite"]),
        Slip("amplitude = 1e-4", "amplitude = nan", &["study.toml:", "finite", "NaN"]),
        Slip("[material]", "[material]\npoisson_ratio = 0.3", &["not free", "leave poisson_ratio out"]),
    ]);
    let plate = BAR.replace("\"bar\"", "\"plane_stress\"").replace("size_m = 1.0", "size_m = [1.0, 0.5]");
    Place::with_study(plate)
        .refuses(&["run", "study.toml"], &["study.toml:16:", "section_m2 says nothing", "thickness_m"]);
    let bare = BAR.replace("[material]\nyoungs_modulus_gpa = 200\ndensity_kg_m3 = 7850\n", "");
    Place::with_study(bare)
        .refuses(&["run", "study.toml"], &["needs the material of its body", "[material]"]);
}

#[test]
fn effects_and_fields_that_cannot_act() {
    refused(&[
        Slip(
            "\"traction\"",
            "\"tracton\"",
            &["study.toml:30:", "nothing acts as \"tracton\"", "\"traction\"?"],
        ),
        Slip("acts = \"traction\"\n", "", &["study.toml:29:", "`acts` is missing", "damping"]),
        Slip("stress_mpa", "stres_mpa", &["study.toml:33:", "unknown key `stres_mpa`", "`stress_mpa`?"]),
        Slip("edge = \"right\"", "edge = \"rigth\"", &["study.toml:31:", "did you mean `right`?"]),
        Slip("edge = \"right\"", "edge = \"top\"", &["study.toml:31:", "no bottom or top"]),
        Slip("axis = \"x\"", "axis = \"y\"", &["study.toml:32:", "a bar has no y"]),
        Slip("\"table\"", "\"tabel\"", &["study.toml:34:", "did you mean `table`?"]),
        Slip("[0, 10, 20]", "[0, 20, 10]", &["study.toml:34:", "out of order", "earliest first"]),
        Slip("[0, 10, 20]", "[0, 10]", &["study.toml:34:", "equal length"]),
        Slip("shape = \"gaussian\"", "shape = \"gausian\"", &["study.toml:24:", "did you mean `gaussian`?"]),
        Slip("width_mm = 100\n", "", &["study.toml:22:", "needs width_m"]),
        Slip("centre_mm = [500]", "centre_mm = [1, 2]", &["study.toml:26:", "give 1, one per axis"]),
    ]);
}

#[test]
fn probes_and_expectations_that_see_nothing() {
    refused(&[
        Slip("at_m = 0.5", "at_mm = 1500", &["study.toml:39:", "outside the body", "from 0 to 1 m"]),
        Slip("at_m = 0.5", "at_m = [0.5, 0.1]", &["study.toml:39:", "2 number(s)", "one per axis"]),
        Slip("at_m = 0.5\n", "", &["study.toml:36:", "this probe needs at_m"]),
        Slip("\"strain\"\nat_m = 0.5", "\"patch\"\nfrom_m = 0.2", &["study.toml:36:", "needs to_m"]),
        Slip(
            "\"strain\"\nat_m = 0.5",
            "\"patch\"\nfrom_m = 0.2\nto_m = 1.5",
            &["study.toml:40:", "outside the body", "from 0 to 1 m"],
        ),
        Slip(
            "\"strain\"\nat_m = 0.5",
            "\"patch\"\nfrom_m = 0.2\nto_mm = 202",
            &["study.toml:40:", "holds no node", "widen it"],
        ),
        Slip(
            "\"strain\"\nat_m = 0.5",
            "\"patch\"\nfrom_m = 0.2\nto_m = 0.4",
            &["study.toml:48:", "seen at many places", "a point or a line"],
        ),
        Slip("at_m = 0.5", "at_m = 0.5\nto_m = 0.6", &["study.toml:40:", "to_m says nothing"]),
        Slip("\"strain\"\nat_m", "\"stain\"\nat_m", &["study.toml:38:", "did you mean `strain`?"]),
        Slip("every_steps = 10", "every_steps = 0", &["study.toml:40:", "every 0 steps"]),
        Slip("name = \"line\"", "name = \"middle\"", &["study.toml:43:", "two probes are called \"middle\""]),
        Slip("name = \"line\"", "name = \"../x\"", &["study.toml:43:", "cannot name"]),
        Slip("probe = \"middle\"", "probe = \"midle\"", &["study.toml:47:", "did you mean \"middle\"?"]),
        Slip("quantity = \"strain\"", "quantity = \"stress\"", &["study.toml:48:", "does not see", "strain"]),
        Slip("at_us = 0", "at_us = 900", &["study.toml:49:", "looks from 0 s", "duration_s"]),
        Slip("tolerance = 1e-9", "tolerance = 0", &["study.toml:51:", "a positive number"]),
        Slip(
            "because = \"the initial field is even about the middle\"",
            "because = \"\"",
            &["without a reason"],
        ),
    ]);
    let long = bar_with("duration_ms = 0.2", "duration_s = 1")
        .replace("name = \"line\"", "name = \"line\"\nevery_steps = 1");
    Place::with_study(long)
        .refuses(&["run", "study.toml"], &["rows are asked for", "at most 2000000", "every_steps"]);
}

#[test]
fn notches_lie_in_plates() {
    let place = Place::new();
    let with = |notch: &str| format!("case.pull.notch={notch}");
    for (notch, words) in [
        ("[{from_m=[0,0.04],to_m=[0.2,0.04]}]", ["notch leaves the body", "inside"]),
        ("[{from_m=[0,0.04],to_m=[0.001,0.04]}]", ["shorter than a cell", "over a cell"]),
    ] {
        place.refuses(&["run", &example("notched-plate.toml"), "--set", &with(notch)], &words);
    }
    let pulled = |keys: &str| {
        let effect = format!("{{acts=\"face_traction\",history={{shape=\"step\"}},{keys}}}");
        format!("case.pull.effect=[{effect}]")
    };
    for (keys, words) in [
        ("normal_mpa=1,notch=4", ["there is no notch 4", "name one of them"]),
        ("stress_mpa=1", ["unknown key `stress_mpa`", "normal_pa"]),
        ("notch=0", ["normal_pa and shear_pa", "give one of them"]),
    ] {
        place.refuses(&["run", &example("notched-plate.toml"), "--set", &pulled(keys)], &words);
    }
    let bar = BAR.replace("size_m", "notch = [{ from_m = [0, 0], to_m = [1, 1] }]\nsize_m");
    Place::with_study(bar).refuses(&["run", "study.toml"], &["study.toml:", "a bar has no notches"]);
}

#[test]
fn the_schema_knows_effects_by_word() {
    let printed = Place::new().run(&["schema"]).code(0);
    let schema: Value = serde_json::from_slice(&printed.get_output().stdout).unwrap();
    let text = schema.to_string();
    for word in ["body_force", "traction", "face_traction", "prescribed_motion", "damping"] {
        assert!(text.contains(&format!("\"acts\":{{\"const\":\"{word}\"}}")), "the schema has no {word}");
    }
    for key in ["stress_mpa", "rate_per_s", "every_steps", "surface_correction", "tolerance", "times_us"] {
        assert!(text.contains(&format!("\"{key}\":")), "the schema has no {key}");
    }
}

fn verdict(place: &Place, study: &str, claim: &str) -> BTreeMap<String, String> {
    let verdicts = rows(&place.read(&format!("reports/{study}/verdicts.csv")));
    let found = verdicts.iter().find(|row| row["claim"].rsplit('/').next() == Some(claim));
    found.unwrap_or_else(|| panic!("no claim {claim}: {verdicts:?}")).clone()
}

#[test]
fn a_march_above_its_limit_proves_nothing() {
    let place = Place::with_study(bar_with("safety = 0.8", "time_step_us = 2.48\nunstable = true"));
    place.run(&["run", "study.toml"]).stdout(contains("inconclusive"));
    for claim in ["finite", "energy_balance", "operators_agree"] {
        let row = verdict(&place, "my-bar", claim);
        assert_eq!(row["verdict"], "inconclusive", "{claim}");
        assert!(row["note"].contains("run above its limit on purpose"), "{row:?}");
    }
    let free = BAR.replace("left = \"mirror_odd\", ", "");
    let place = Place::with_study(free.replacen("safety = 0.8", "time_step_us = 2.48\nunstable = true", 1));
    place.run(&["run", "study.toml"]).stdout(contains("inconclusive"));
    assert_eq!(verdict(&place, "my-bar", "momentum")["verdict"], "inconclusive");
}

#[test]
fn reasons_are_those_of_the_law() {
    let place = Place::with_study(BAR);
    place.run(&["explain", "study.toml"]).code(0).stdout(contains("quadratic form positive"));
    let place = Place::with_study(bar_with("safety = 0.8", "rotations = \"finite\""));
    let said = place.run(&["explain", "study.toml"]).code(0);
    said.stdout(contains("tension lowers").and(contains("quadratic form positive").not()));
}

#[test]
fn an_expectation_says_what_was_seen_and_where() {
    let wrong = bar_with("value = 0\n", "value = 1e-5\n")
        .replace("probe = \"middle\"", "name = \"even\"\nprobe = \"middle\"");
    let place = Place::with_study(&wrong);
    place.run(&["run", "study.toml"]).code(1).stdout(contains("even").and(contains("expected 1e-5")));
    let note = verdict(&place, "my-bar", "even")["note"].clone();
    assert!(note.starts_with("saw ") && note.ends_with(", expected 1e-5"), "{note}");
    let late = wrong
        .replace("at_us = 0\n", "at_us = 100\n")
        .replace("volume_rule", "calibrated = [false, true], volume_rule");
    let place = Place::with_study(late.replace(", calibrated = true", ""));
    place.run(&["run", "study.toml"]).code(1);
    let row = verdict(&place, "my-bar", "even");
    assert!(
        row["note"].starts_with("as printed: saw ") || row["note"].starts_with("calibrated: saw "),
        "{row:?}"
    );
    assert!(row["quantity"].contains("of 2 lattices the furthest"), "{row:?}");
    refused(&[
        Slip(
            "quantity = \"strain\"",
            "name = \"finite\"\nquantity = \"strain\"",
            &["study.toml:48:", "another claim"],
        ),
        Slip(
            "quantity = \"strain\"",
            "name = \"A b\"\nquantity = \"strain\"",
            &["study.toml:48:", "cannot name a claim"],
        ),
    ]);
}

#[test]
fn words_that_people_try_are_answered() {
    refused(&[
        Slip(
            "size_m = 1.0",
            "length_m = 1.0",
            &["study.toml:14:", "did you mean `size_m`? it is the length of a bar"],
        ),
        Slip("size_m = 1.0", "length_mm = 1000", &["did you mean `size_mm`?", "dx_m (or _mm, _um, …)"]),
        Slip(
            "\"mirror_odd\"",
            "\"fixed\"",
            &["study.toml:19:", "to hold an edge: mirror_odd", "prescribed_motion"],
        ),
        Slip("duration_ms", "duraton_ms", &["did you mean `duration_ms`?", "duration_s (or _ms, _us, …)"]),
    ]);
}

#[test]
fn a_plan_says_what_is_checked_and_effects_once() {
    let second = BAR.split_once("[[case]]").unwrap().1.replacen("\"pull\"", "\"other\"", 1);
    let place = Place::with_study(format!("{BAR}\n[[case]]{second}"));
    let said = place.run(&["plan", "study.toml"]).code(0);
    let text = String::from_utf8_lossy(&said.get_output().stdout).into_owned();
    for word in ["check: first ", " steps by stencil", " steps by bonds", "effects as above"] {
        assert!(text.contains(word), "no {word}: {text}");
    }
}
