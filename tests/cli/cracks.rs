//! `pd-verify dsif`: what it writes, and what it refuses by name.

use crate::support::{Place, rows};

const HEAD: &str = r#"format = 1
id = "mine"
kind = "dsif"
title = "A crack"
material = { youngs_modulus_gpa = 72, density_kg_m3 = 2440 }
[[case]]
id = "a"
title = "A"
"#;

const WAVE: &str = r#"asks = "stress_intensity"
plate = { body = "plane_stress", size_mm = [100, 40], crack = "left_edge", crack_length_mm = 50, lateral = "rollers" }
load = { mode = "I", on = "top", stress_mpa = 1, grows = "ramp", rise_us = 3.5 }
known = { answer = "freund" }
window = { from_arrivals = 1.25, to_arrivals = 2.9 }
m = 3
dx_mm = [1.0, 0.5]
weights = { kernel = "gaussian", p = 2, volume_rule = "linear", calibrated = true }
extraction = [{ method = "interaction_integral", tip_factor = true }, { method = "two_point" }]

[[case.expect]]
extraction = "interaction_integral"
quantity = "rms"
at_most = 0.005
basis = "engineering"
because = "half a part in a hundred is what the design allows"
"#;

const SHEAR: &str = r#"asks = "stress_intensity"
plate = { body = "plane_strain", size_mm = [104, 40], crack = "centre", crack_length_mm = 24 }
load = { mode = "II", on = "all_edges", stress_mpa = 1, grows = "raised_cosine_rate", rise_us = 0.4 }
known = { answer = "shear_four_edges" }
window = { from_us = 6, to_us = 9 }
m = 3
dx_mm = 0.52
weights = { kernel = "gaussian", p = 2, volume_rule = "linear", calibrated = true }
extraction = [{ method = "williams" }]

[[case.expect]]
extraction = "williams"
quantity = "l2"
at_most = 0.1
basis = "engineering"
because = "a coarse lattice against finite elements, the first front among what is judged"
"#;

fn place(case: &str) -> Place {
    Place::with_study(format!("{HEAD}{case}"))
}

#[test]
fn histories_have_the_columns_that_scripts_read() {
    let place = place(WAVE);
    place.run(&["dsif", "study.toml", "--strict"]).code(0);
    let text = place.read("reports/mine/dsif_history.csv");
    let columns = "case,mode,kernel,p,m,dx_m,volume_rule,calibrated,extraction,terms,r_min_m,r_max_m,t_s,k_pa_sqrt_m,reference,k_reference_pa_sqrt_m,k_normalized,k_reference_normalized,in_window";
    assert!(text.lines().next().is_some_and(|head| head.starts_with(columns)));
    let rows = rows(&text);
    let inside: Vec<_> = rows
        .iter()
        .filter(|row| row["in_window"] == "true" && row["extraction"] == "interaction_integral")
        .collect();
    assert!(inside.len() > 50);
    for row in inside {
        let [k, known] =
            ["k_pa_sqrt_m", "k_reference_pa_sqrt_m"].map(|name| row[name].parse::<f64>().unwrap());
        assert!((k - known).abs() < 0.01 * 2e5 && row["reference"] == "consistent", "{row:?}");
    }
    assert!(rows.iter().any(|row| row["extraction"] == "two_point" && row["r_min_m"].is_empty()));
    assert!(place.read("reports/mine/a.svg").contains("judged"));
}

#[test]
fn a_tip_that_was_moved_is_said_to_be() {
    let place = place(SHEAR);
    place.run(&["dsif", "study.toml", "--strict"]).code(0);
    let verdicts = rows(&place.read("reports/mine/verdicts.csv"));
    let note = &verdicts[0]["note"];
    assert!(note.contains("height 0.03952 m for 0.04 m, crack 0.02392 m for 0.024 m"), "{note}");
}

#[test]
fn what_no_reading_or_answer_can_serve_is_refused_and_nothing_is_written() {
    let short = WAVE.replace("to_arrivals = 2.9", "to_arrivals = 1.75");
    let outer = "extraction = [{ method = \"williams\", outer_mm = ";
    for (case, old, new, said) in [
        (
            WAVE,
            "method = \"two_point\"",
            "method = \"williams\", inner_horizons = 1.5",
            "inside the nonlocal zone",
        ),
        (WAVE, "extraction = [{", &format!("{outer}60 }}, {{"), "lies 0.02 m from an edge"),
        (&short, "crack_length_mm = 50", "crack_length_mm = 8", "beyond the other end of the crack"),
        (WAVE, "crack_length_mm = 50", "crack_length_mm = 96", "the reference holds from"),
        (WAVE, "size_mm = [100, 40]", "size_mm = [100, 41]", "divide half the height"),
        (WAVE, "crack_length_mm = 50", "crack_length_mm = 100", "ends outside the plate"),
        (
            WAVE,
            "from_arrivals = 1.25, to_arrivals = 2.9",
            "from_arrivals = 2.9, to_arrivals = 1.25",
            "is empty",
        ),
        (WAVE, "to_arrivals = 2.9", "to_arrivals = 3.2", "the reference holds from"),
        (WAVE, "from_arrivals = 1.25", "from_arrivals = 0.9", "the reference holds from"),
        (WAVE, "lateral = \"rollers\"", "lateral = \"guides\"", "stop the wave of mode I"),
        (
            WAVE,
            "extraction = \"interaction_integral\"",
            "extraction = \"integral\"",
            "no extraction is called",
        ),
        (WAVE, "at_most = 0.005\n", "", "one bound that fits"),
        (WAVE, "quantity = \"rms\"", "quantity = \"order\"", "needs 3 levels"),
        (WAVE, "method = \"two_point\"", "method = \"two_points\"", "two_point"),
        (WAVE, "dx_mm = [1.0, 0.5]", "dx_mm = [0.5, 1.0]", "from coarse to fine"),
        (WAVE, "tip_factor = true", "tip_factor = true, outer_mm = 9", "belongs to radii in horizons"),
        (SHEAR, "size_mm = [104, 40]", "size_mm = [100, 40]", "the answer is that of a plate of"),
        (SHEAR, "to_us = 9", "to_us = 90", "the reference holds from"),
        (SHEAR, "on = \"all_edges\"", "on = \"top_and_bottom\"", "the answer is that of another load"),
        (SHEAR, "body = \"plane_strain\"", "body = \"bar\"", "a bar has no crack"),
    ] {
        assert!(case.contains(old), "{old}");
        let place = place(&case.replacen(old, new, 1));
        place.refuses(&["run", "study.toml"], &[said]);
    }
}

/// A wave comes from an edge, whose height counts; a load on the faces does not.
#[test]
fn the_height_counts_where_a_wave_comes_from_an_edge() {
    let odd = WAVE.replace("size_mm = [100, 40]", "size_mm = [100, 41]");
    place(&odd).refuses(&["plan", "study.toml"], &["divide half the height"]);
    let faces = odd
        .replace("on = \"top\"", "on = \"faces\"")
        .replace("from_arrivals = 1.25, to_arrivals = 2.9", "from_us = 1, to_us = 3")
        .replace(", lateral = \"rollers\"", "");
    place(&faces).run(&["plan", "study.toml"]).code(0);
}

#[test]
fn a_case_that_claims_nothing_is_no_success() {
    let silent = WAVE.split("[[case.expect]]").next().unwrap().to_owned();
    place(&silent).run(&["dsif", "study.toml"]).code(1);
}
