//! The shipped studies through the program, and a study of one's own of several kinds.

use crate::support::{CASE, HEAD, Place, rows};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Commands with shipped studies, and the folders of these.
const KINDS: [&str; 6] = ["dispersion", "bar", "convergence", "dsif", "stability", "cost"];

/// Name and text of every shipped study file.
pub fn shipped() -> Vec<(String, String)> {
    let folder = |kind: &&str| Path::new(env!("CARGO_MANIFEST_DIR")).join("studies").join(kind);
    let entries = KINDS.iter().flat_map(|kind| fs::read_dir(folder(kind)).unwrap());
    let paths = entries.map(|entry| entry.unwrap().path());
    let files = paths.filter(|path| path.extension().is_some_and(|ending| ending == "toml"));
    files.map(|path| (path.display().to_string(), fs::read_to_string(&path).unwrap())).collect()
}

#[test]
fn shipped_files_are_accepted_as_files() {
    let place = Place::new();
    for (file, _) in shipped() {
        place.run(&["plan", &file]).code(0);
    }
    let oracles = shipped().into_iter().find(|(file, _)| file.ends_with("oracles.toml")).unwrap().0;
    place.run(&["dispersion", &oracles, "--strict", "--quiet"]).code(0);
    assert!(place.path("reports/dispersion-oracles/verdicts.csv").is_file());
}

#[test]
fn the_quick_profile_passes_and_threads_change_no_bit() {
    for (kind, claims, files) in
        [("dispersion", 100, 60), ("bar", 20, 10), ("convergence", 80, 20), ("stability", 20, 10)]
    {
        quick_profile(kind, claims, files);
    }
}

/// Runs a command in its quick profile on one thread and on two; it has more claims and files than these.
fn quick_profile(kind: &str, claims: usize, files: usize) {
    let place = Place::new();
    for threads in ["1", "2"] {
        let out = format!("out-{threads}");
        place.run(&[kind, "--profile", "quick", "--strict", "--threads", threads, "--out", &out]).code(0);
    }
    let verdicts = rows(&place.read("out-1/verdicts.csv"));
    let ids: BTreeSet<_> = verdicts.iter().map(|row| row["claim"].clone()).collect();
    assert_eq!(ids.len(), verdicts.len(), "a claim's id is unique");
    assert!(ids.len() > claims);
    assert_eq!(
        without_seconds(&place.read("out-1/verdicts.csv")),
        without_seconds(&place.read("out-2/verdicts.csv"))
    );
    let mut compared = 0;
    for entry in fs::read_dir(place.path(&format!("out-1/{kind}"))).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        // These speak of times and threads.
        if !["manifest.json", "results.json", "verdicts.csv"].contains(&name.as_str()) {
            let [one, two] = ["1", "2"].map(|n| place.read(&format!("out-{n}/{kind}/{name}")));
            assert!(one == two, "{name} depends on the number of threads");
            compared += 1;
        }
    }
    assert!(compared > files);
    figures_have_their_data(&place, &format!("out-1/{kind}"));
}

/// The last column holds seconds and nothing else does.
fn without_seconds(text: &str) -> Vec<String> {
    text.lines().map(|line| line.rsplit_once(',').unwrap().0.to_owned()).collect()
}

/// Every drawing stands beside a file of the points it draws.
fn figures_have_their_data(place: &Place, folder: &str) {
    let mut figures = 0;
    for entry in fs::read_dir(place.path(folder)).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        if let Some(figure) = name.strip_suffix(".svg") {
            let data = place.read(&format!("{folder}/{figure}.csv"));
            let header = data.lines().next().unwrap();
            assert!(header.starts_with("panel,series,"), "{figure}.csv holds no figure but {header}");
            figures += 1;
        }
    }
    assert!(figures > 0);
}

/// A study of several kinds.
fn several() -> String {
    let curves = CASE
        .replace("\"bar\"", "\"plane_strain\"")
        .replace("\"lattice\"", "[\"lattice\", \"lattice_leapfrog\"]\ntime_step_ns = 20")
        .replace("m = 3", "m = 7.3");
    format!(
        r#"{HEAD}{curves}
[[case.curve]]
scheme = "continuum"
kernel = "gaussian"
p = 1.5
horizon_mm = 7.3

[[case]]
id = "weights"
asks = "moduli"
body = "plane_strain"
[case.lattice]
kernel = "gaussian"
p = 1.5
m = 7.3
volume_rule = ["full", "linear", "exact_area"]
calibrated = [false, true]

[[case]]
id = "map"
asks = "heat_map"
nodes_per_wavelength = 12
[case.lattice]
kernel = "gaussian"
p = 1.5
m = 7.3
volume_rule = "linear"
"#
    )
}

#[test]
fn a_study_of_ones_own_by_run_and_by_dispersion() {
    let place = Place::with_study(several());
    for (command, out) in [("run", "a"), ("dispersion", "b")] {
        place.run(&[command, "study.toml", "--strict", "--out", out]).code(0);
    }
    let folder = place.path("a/mine");
    for entry in fs::read_dir(&folder).unwrap().map(Result::unwrap) {
        let name = entry.file_name().into_string().unwrap();
        if name.ends_with(".csv") && name != "verdicts.csv" {
            assert_eq!(
                place.read(&format!("a/mine/{name}")),
                place.read(&format!("b/mine/{name}")),
                "{name}"
            );
        }
    }
    figures_have_their_data(&place, "a/mine");
}

#[test]
fn a_heat_map_of_lattices_that_cannot_be_used_is_refused() {
    let (head, map) =
        several().split_once("[[case]]\nid = \"map\"").map(|(_, map)| (HEAD, map.to_owned())).unwrap();
    let text = format!("{head}\n[[case]]\nid = \"map\"{}", map.replace("m = 7.3", "m = 0.5"));
    Place::with_study(text)
        .refuses(&["run", "study.toml"], &["study.toml:17:", "m = 0.5 is below 1", "take m >= 1"]);
}

#[test]
fn a_kernel_named_twice_is_asked_once() {
    let case = "\n[[case]]\nid = \"a\"\nasks = \"m_convergence\"\nkernel = [\"constant\", \"constant\"]\nm = [10, 20, 40]\nk_horizon = 2\nvolume_rule = \"linear\"\n";
    let place = Place::with_study(format!("{HEAD}{case}"));
    place.run(&["run", "study.toml"]);
    let verdicts = rows(&place.read("reports/verdicts.csv"));
    let ids: BTreeSet<_> = verdicts.iter().map(|row| row["claim"].clone()).collect();
    assert_eq!(ids.len(), verdicts.len(), "a claim's id is unique");
}
