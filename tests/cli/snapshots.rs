//! Snapshots through the program: their files, read back and held against a probe; what is refused.

use crate::support::{Place, rows};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;
use std::collections::BTreeSet;
use std::fs;

const PLATE: &str = r#"format = 1
id = "plate"
kind = "scene"
title = "Plate"
material = { youngs_modulus_gpa = 70, density_kg_m3 = 2700 }
[[case]]
id = "push"
asks = "march"
body = "plane_stress"
size_mm = [40, 30]
dx_mm = 2
duration_us = 8
lattice = { kernel = "constant", m = 2, volume_rule = "linear", calibrated = false }
[[case.initial]]
sets = "velocity"
shape = "gaussian"
amplitude = 1
centre_mm = [10, 10]
width_mm = 5
[[case.probe]]
name = "row"
watches = "line"
through_mm = 11
[[case.snapshot]]
name = "field"
at_us = [0, 4, 8]
"#;

fn with(old: &str, new: &str) -> String {
    assert!(PLATE.contains(old), "the study has no {old}");
    PLATE.replacen(old, new, 1)
}

/// Names of the files of a run that begin so.
fn files(place: &Place, folder: &str, start: &str) -> BTreeSet<String> {
    let names = fs::read_dir(place.path(folder)).unwrap().map(|entry| entry.unwrap().file_name());
    names.map(|name| name.into_string().unwrap()).filter(|name| name.starts_with(start)).collect()
}

/// The header and the numbers of an array.
fn npy(place: &Place, file: &str) -> (String, Vec<f64>) {
    let bytes = fs::read(place.path(file)).unwrap();
    let start = 10 + u16::from_le_bytes([bytes[8], bytes[9]]) as usize;
    let numbers = bytes[start..].chunks(8).map(|eight| f64::from_le_bytes(eight.try_into().unwrap()));
    (String::from_utf8_lossy(&bytes[10..start]).into_owned(), numbers.collect())
}

#[test]
fn snapshots_are_written_drawn_and_what_a_probe_sees() {
    let place = Place::with_study(PLATE);
    place.run(&["run", "study.toml", "--strict", "--quiet"]).code(0);
    let found = files(&place, "reports/plate", "push.field.");
    let mut expected: BTreeSet<String> =
        ["push.field.csv", "push.field.svg", "push.field.pvd"].map(String::from).into();
    for index in 0..3 {
        let ends = ["vti", "displacement.npy", "velocity.npy"];
        expected.extend(ends.map(|end| format!("push.field.{index:03}.{end}")));
    }
    assert_eq!(found, expected);
    let (header, u) = npy(&place, "reports/plate/push.field.002.displacement.npy");
    assert!(header.contains("'shape': (15, 20, 2)"), "{header}");
    // The row of nodes through 11 mm is the sixth; the probe's last look is at the last step.
    let probes = rows(&place.read("reports/plate/probes.csv"));
    let last = probes.iter().map(|row| row["t_s"].parse::<f64>().unwrap()).fold(0.0, f64::max);
    let mut moved = 0;
    for row in probes.iter().filter(|row| row["t_s"].parse::<f64>().unwrap() == last) {
        let column = (row["x_m"].parse::<f64>().unwrap() / 0.002 - 0.5).round() as usize;
        let component = usize::from(row["quantity"] == "displacement_y");
        assert_eq!(u[(5 * 20 + column) * 2 + component], row["value"].parse::<f64>().unwrap());
        moved += usize::from(u[(5 * 20 + column) * 2 + component].abs() > 1e-9);
    }
    assert!(moved > 20);
    let (_, start) = npy(&place, "reports/plate/push.field.000.velocity.npy");
    for (n, v) in start.chunks(2).enumerate() {
        let [x, y] = [n % 20, n / 20].map(|k| (k as f64 + 0.5) * 0.002);
        let squares = (x - 0.01).powi(2) + (y - 0.01).powi(2);
        assert!((v[0] - (-squares / 25e-6).exp()).abs() < 1e-13 && v[1] == 0.0, "{n} {v:?}");
    }
    let list = place.read("reports/plate/push.field.pvd");
    assert!(
        list.contains(&format!("timestep=\"{last:e}\" part=\"0\" file=\"push.field.002.vti\"")),
        "{list}"
    );
    let vti = fs::read(place.path("reports/plate/push.field.002.vti")).unwrap();
    let data = vti.windows(2).position(|two| two == b"\n_").unwrap() + 2;
    // Time with its header, the header of the displacements, then x, y, 0 of each cell.
    for (n, pair) in u.chunks(2).enumerate() {
        let at = data + 16 + 8 + 24 * n;
        assert_eq!([&vti[at..at + 8], &vti[at + 8..at + 16]], [pair[0], pair[1]].map(f64::to_le_bytes));
    }
    assert!(place.read("reports/index.html").contains("u along x"));
    place.run(&["plan", "study.toml"]).code(0).stdout(contains("snapshots:   0.029 MB in memory"));
    place.run(&["plan", "study.toml", "--json"]).code(0).stdout(contains("\"snapshot_bytes\": 28800"));
}

#[test]
fn formats_and_lattices_are_chosen() {
    let place = Place::with_study(with("at_us", "formats = [\"npy\"]\npicture = false\nat_us"));
    place.run(&["run", "study.toml", "--quiet"]).code(0);
    let found = files(&place, "reports/plate", "push.field.");
    assert!(found.len() == 6 && found.iter().all(|name| name.ends_with(".npy")), "{found:?}");
    let place = Place::with_study(with(" m = 2", " m = [2, 3]").replace("[0, 4, 8]", "4"));
    place.run(&["run", "study.toml", "--quiet"]).code(0);
    let found = files(&place, "reports/plate", "push.field.");
    for m in [2, 3] {
        let base = format!("push.field.constant_m{m}_linear");
        for end in ["svg", "csv", "pvd", "000.vti", "000.velocity.npy", "000.displacement.npy"] {
            assert!(found.contains(&format!("{base}.{end}")), "no {base}.{end} in {found:?}");
        }
    }
    assert_eq!(found.len(), 12);
    place.run(&["schema"]).code(0).stdout(contains("\"snapshot\"").and(contains("\"at_us\"")));
}

#[test]
fn snapshots_that_cannot_be_are_refused() {
    let bar = with("\"plane_stress\"", "\"bar\"").replace("[40, 30]", "40").replace("[10, 10]", "[10]");
    let bar = bar.replace("through_mm = 11\n", "");
    let many: Vec<String> = (0..4000).map(|n| format!("{n}")).collect();
    let many =
        with("[0, 4, 8]", &format!("[{}]", many.join(", "))).replace("duration_us = 8", "duration_us = 4000");
    let large = with("size_mm = [40, 30]", "size_m = [20, 20]");
    for (text, words) in [
        (with("[0, 4, 8]", "[0, 9]"), &["study.toml:26:", "from 0 to 0.000008 s", "within the duration"][..]),
        (with("[0, 4, 8]", "-1"), &["study.toml:26:", "nothing to see at -0.000001 s"]),
        (with("[0, 4, 8]", "[4, 0]"), &["study.toml:26:", "out of order"]),
        (with("[0, 4, 8]", "[4, 4.01]"), &["study.toml:26:", "same step"]),
        (with("[0, 4, 8]", "[]"), &["an empty list"]),
        (with("name = \"field\"", "name = \"row\""), &["study.toml:25:", "a probe of this case is called"]),
        (with("name = \"field\"", "name = \"a/b\""), &["study.toml:25:", "\"a/b\" cannot name"]),
        (with("at_us", "formats = []\npicture = false\nat_us"), &["neither written nor drawn"]),
        (with("at_us", "formats = [\"vtk\"]\nat_us"), &["study.toml:26:", "vti"]),
        (with("at_us", "pictures = true\nat_us"), &["pictures", "picture"]),
        (bar, &["a bar has no snapshots", "a probe that watches a line sees the whole bar"]),
        (many, &["12001 files of snapshots", "at most 10000"]),
        (large, &["study.toml:26:", "GiB", "fewer times"]),
    ] {
        Place::with_study(text).refuses(&["run", "study.toml"], words);
    }
}

#[test]
fn a_plate_may_be_watched_by_snapshots_alone_but_not_by_nobody() {
    let probe = "[[case.probe]]\nname = \"row\"\nwatches = \"line\"\nthrough_mm = 11\n";
    let alone = with(probe, "");
    let place = Place::with_study(&alone);
    place.run(&["run", "study.toml", "--strict", "--quiet"]).code(0);
    assert!(place.path("reports/plate/push.field.002.vti").is_file());
    let snapshot = "[[case.snapshot]]\nname = \"field\"\nat_us = [0, 4, 8]\n";
    Place::with_study(alone.replace(snapshot, ""))
        .refuses(&["run", "study.toml"], &["nobody watches this march"]);
}
