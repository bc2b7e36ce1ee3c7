//! `check`, `explain --export` and `selftest`: results of other codes pass, spoiled ones fail with a cause, bad files are refused.

use crate::support::{Place, rows};
use std::path::Path;

const CURVE: &str = "convergence-rest/rest-square";

fn at(path: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path).display().to_string()
}

/// Verdicts and notes of a check that ends with `code`.
fn checked(place: &Place, arguments: &[&str], code: i32) -> Vec<(String, String)> {
    place.run(&[&["check"], arguments].concat()).code(code);
    let verdicts = rows(&place.read("reports/check/verdicts.csv"));
    verdicts.into_iter().map(|row| (row["verdict"].clone(), row["note"].clone())).collect()
}

/// What finite elements found of a sheared plate, in units of τ√(πa), a = 12 mm, τ = 1 Pa.
const ELEMENTS: [&str; 6] = ["--map", "t=t_us", "--map", "k=k2_top_bottom_rise_0.4us", "--unit", "t=us"];

fn elements(factor: &str) -> (Vec<String>, Place) {
    let mut arguments = vec![at("tests/foreign/sheared_plate.toml"), "--data".into()];
    arguments.push(at("reference/data/finite_elements/mode2_plate_104x40.csv"));
    arguments.extend(ELEMENTS.map(str::to_owned));
    // √(π · 0.012).
    arguments.extend(["--unit".into(), format!("k={factor}*0.194162590*Pa*sqrt(m)")]);
    (arguments, Place::new())
}

#[test]
fn finite_elements_pass_and_spoiled_ones_fail_with_their_cause() {
    let (arguments, place) = elements("1");
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let verdicts = checked(&place, &arguments, 0);
    assert!(verdicts.len() == 2 && verdicts.iter().all(|(verdict, _)| verdict == "pass"), "{verdicts:?}");
    for file in [
        "index.html",
        "summary.md",
        "junit.xml",
        "verdicts.csv",
        "check/check.csv",
        "check/two-waves-check.svg",
    ] {
        assert!(!place.read(&format!("reports/{file}")).is_empty());
    }
    assert!(place.read("reports/check/manifest.json").contains("mode2_plate_104x40.csv"));
    for (factor, cause) in [("2", "two edges"), ("0.5", "only one of two"), ("1e-6", "MPa where Pa")] {
        let (arguments, place) = elements(factor);
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let verdicts = checked(&place, &arguments, 1);
        assert!(
            verdicts.iter().all(|(verdict, note)| verdict == "fail" && note.contains(cause)),
            "{verdicts:?}"
        );
    }
}

#[test]
fn every_kind_of_data_passes_as_exported() {
    for (case, file, kind) in [
        ("dsif-plates/plate-chen", "history", ""),
        ("bar-release/release-source", "strain", ""),
        ("bar-release/release-source", "profile", "profile"),
        ("dispersion-bar/kernels", "constant", "constant"),
        (CURVE, "convergence", ""),
        (CURVE, "displacement", ""),
    ] {
        let place = Place::new();
        place.run(&["explain", case, "--export", "brief"]).success();
        let brief = place.read("brief/README.md");
        assert!(brief.contains(&format!("pd-verify check {case}")) && brief.contains("Material"), "{brief}");
        assert!(place.read(&format!("brief/{file}.csv")).lines().count() == 1);
        let data = format!("brief/{file}-reference.csv");
        let mut arguments = vec![case, "--data", &data];
        if !kind.is_empty() {
            arguments.extend(["--as", kind]);
        }
        let verdicts = checked(&place, &arguments, 0);
        assert!(verdicts.iter().all(|(verdict, _)| verdict == "pass"), "{case}: {verdicts:?}");
    }
    let said = Place::new().run(&["explain", CURVE]).success();
    assert!(
        String::from_utf8_lossy(&said.get_output().stdout)
            .contains(&format!("pd-verify check {CURVE} --data FILE"))
    );
}

/// sin(ωΔt/2) = (cΔt/Δx) sin(kΔx/2), written out here: E = 65 GPa, ρ = 2235 kg/m³, Δx = 1 mm, Δt = 10 ns.
#[test]
fn a_curve_by_hand_passes_and_one_with_tan_does_not() {
    let curve = |of: fn(f64) -> f64| -> String {
        let (speed, dx, dt) = ((65e9_f64 / 2235.0).sqrt(), 1e-3, 1e-8);
        let omega = |k: f64| 2.0 / dt * (speed * dt / dx * of(0.5 * k * dx)).asin();
        (1..=25).map(|n| 100.0 * f64::from(n)).map(|k| format!("{k},{}\n", omega(k))).collect()
    };
    let place = Place::new();
    let arguments =
        ["dispersion-joint/finite-differences", "--data", "data.csv", "--as", "finite differences"];
    place.write("data.csv", format!("k,omega_per_s\n{}", curve(f64::sin)));
    let verdicts = checked(&place, &arguments, 0);
    assert_eq!(verdicts[0].0, "pass", "{verdicts:?}");
    place.write("data.csv", format!("k,omega_per_s\n{}", curve(f64::tan)));
    let verdicts = checked(&place, &arguments, 1);
    assert!(verdicts[0].1.contains("sin in place of tan"), "{verdicts:?}");
}

/// u(0.5 m) of the bar let go is ½ε₀ of the way until the first front comes by, written out here.
#[test]
fn a_history_by_hand_passes() {
    let (speed, strain) = ((200e9_f64 / 7850.0).sqrt(), 200.0 / (200e9 * 1e-6));
    let u = |t: f64| {
        // A triangle of period 4 L: flat until the front is there, then down with half of the slope on either side.
        let folded = |x: f64| ((x - 1.0).rem_euclid(4.0) - 2.0).abs() - 1.0;
        0.5 * strain * (folded(0.5 - speed * t) + folded(0.5 + speed * t))
    };
    let rows: String =
        (0..=200).map(|n| 4e-6 * f64::from(n)).map(|t| format!("{},{}\n", 1e6 * t, 1e3 * u(t))).collect();
    let place = Place::new();
    place.write("data.csv", format!("t_us,u [mm]\n{rows}"));
    let verdicts = checked(&place, &["bar-release/release-source", "--data", "data.csv"], 0);
    assert_eq!(verdicts[0].0, "pass", "{verdicts:?}");
}

#[test]
fn any_delimiter_is_read_and_what_does_not_reach_is_inconclusive() {
    let levels = [(0.1, 0.04), (0.05, 0.01), (0.025, 0.0025)];
    let rows = |by: &str, comma: bool| -> String {
        let number = |x: f64| if comma { x.to_string().replace('.', ",") } else { x.to_string() };
        levels.iter().map(|(h, e)| format!("{}{by}{}\r\n", number(*h), number(*e))).collect()
    };
    for text in [
        format!("\u{feff}h;error\r\n{}", rows(";", true)),
        format!("# dx_m error\n{}", rows("  ", false)),
        format!("h [m]\terr\n{}", rows("\t", true)),
        "dx_mm,error\n100,4.d-2\n50,1.D-02\n25,.25d-2\n".into(),
    ] {
        let place = Place::new();
        place.write("data.csv", &text);
        let verdicts = checked(&place, &[CURVE, "--data", "data.csv"], 0);
        assert!(verdicts.iter().all(|(verdict, _)| verdict == "pass"), "{text}: {verdicts:?}");
    }
    let place = Place::new();
    place.write("data.csv", "dx_m,error\n0.1,0.04\n0.05,0.01\n");
    let verdicts = checked(&place, &[CURVE, "--data", "data.csv"], 1);
    assert!(verdicts.iter().all(|(verdict, _)| verdict == "inconclusive"), "{verdicts:?}");
}

#[test]
fn bad_files_are_refused_with_their_place() {
    let place = Place::new();
    let good = "dx_m,error\n0.1,0.04\n0.05,0.01\n0.025,0.0025\n";
    for (text, words) in [
        ("", &["holds no data"][..]),
        ("dx_m,error\n", &["no rows"]),
        ("dx_m,fehler\n0.1,1\n", &["no column error", "--map"]),
        ("dx_m,error\n0.1,x4\n", &["data.csv:2", "column error", "\"x4\" is no number"]),
        ("dx_m,error\n0.1,\n", &["data.csv:2", "the cell is empty"]),
        ("dx_m,error\n0.1,NaN\n", &["data.csv:2", "no quantity"]),
        ("dx_m,error\n0.1,0.1,3\n", &["data.csv:2", "3 columns, the first has 2"]),
        ("dx_m,error\n0.1,1\n0.1,2\n", &["data.csv:3", "data.csv:2", "once"]),
        ("dx_m,h,error\n1,1,1\n", &["may both be dx_m"]),
    ] {
        place.write("data.csv", text);
        place.refuses(&["check", CURVE, "--data", "data.csv"], words);
    }
    place.write("data.csv", b"dx_m,error\n\xff\n");
    place.refuses(&["check", CURVE, "--data", "data.csv"], &["data.csv:2", "UTF-8"]);
    place.write("data.csv", b"\x93NUMPY\x01\x00\x10\x00{}");
    place.refuses(&["check", CURVE, "--data", "data.csv"], &["NPY"]);
    place.write("data.csv", good);
    for (arguments, words) in [
        (&["--unit", "dx=Mm/s"][..], &["no unit of what is measured in m"][..]),
        (&["--unit", "dx=mn"], &["`mn` is no unit", "did you mean"]),
        (&["--map", "error=eror"], &["no column is called \"eror\"", "did you mean"]),
        (&["--map", "eror=error"], &["no column is called eror", "did you mean err"]),
        (&["--map", "error"], &["not of the form"]),
        (&["--as", "convergenz"], &["did you mean \"convergence\""]),
    ] {
        place.refuses(&[&["check", CURVE, "--data", "data.csv"], arguments].concat(), words);
    }
    place.refuses(&["check", CURVE, "--data", "none.csv"], &["cannot read none.csv"]);
    place.refuses(
        &["check", "bar-release/spectrum", "--data", "data.csv"],
        &["judges no data", "bar-release/release-source"],
    );
    place.refuses(
        &["check", "bar-release", "--data", "data.csv"],
        &["name one of bar-release/release-source"],
    );
    place.refuses(&["check", "dispersion-bar/kernels", "--data", "data.csv"], &["none of the data"]);
    place.write("data.csv", "0.1,1\n0.2,2\n");
    place.refuses(&["check", "bar-release/release-source", "--data", "data.csv"], &["say which with --as"]);
    place.write("data.csv", "t,strain\n1,1\n0,1\n");
    place.refuses(
        &["check", "bar-release/release-source", "--data", "data.csv"],
        &["data.csv:3", "sort the rows by t_s"],
    );
}

#[test]
fn the_selftest_rejects_what_is_wrong() {
    let said = Place::new().run(&["selftest"]).success();
    assert!(String::from_utf8_lossy(&said.get_output().stdout).contains("were judged as they should be"));
}
