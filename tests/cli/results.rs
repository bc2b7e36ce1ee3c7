//! What a run leaves behind: files and columns as promised to those who read them by script.

use crate::support::{Place, rows, small, small_with};
use sha2::{Digest, Sha256};

#[test]
fn files_of_a_run() {
    let place = Place::with_study(small());
    place.run(&["run", "study.toml"]).code(0);
    let root = place.path("reports");
    let mut names: Vec<_> = place
        .contents()
        .into_keys()
        .filter_map(|path| path.strip_prefix(&root).ok().map(|path| path.display().to_string()))
        .filter(|name| !name.is_empty())
        .collect();
    names.sort();
    assert_eq!(
        names,
        [
            "index.html",
            "junit.xml",
            "mine",
            "mine/a-velocity.csv",
            "mine/a-velocity.svg",
            "mine/a.csv",
            "mine/a.svg",
            "mine/dispersion_curves.csv",
            "mine/dispersion_velocities.csv",
            "mine/manifest.json",
            "mine/phase_error_thresholds.csv",
            "mine/results.json",
            "mine/verdicts.csv",
            "run.json",
            "summary.md",
            "verdicts.csv",
        ]
    );
    assert_eq!(place.read("reports/verdicts.csv"), place.read("reports/mine/verdicts.csv"));
    let page = place.read("reports/index.html");
    assert!(page.matches("<svg").count() >= 2, "figures stand in the page itself");
    for outside in ["src=\"http", "href=\"http", "url(http", "<script src", "@import"] {
        assert!(!page.contains(outside), "the page needs {outside}");
    }
    assert_eq!(place.read("reports/junit.xml").matches("<testcase ").count(), 3);
}

#[test]
fn columns_of_verdicts() {
    let place = Place::with_study(small());
    place.run(&["run", "study.toml"]).code(0);
    let text = place.read("reports/mine/verdicts.csv");
    assert_eq!(
        text.lines().next().unwrap(),
        "claim,study,case,quantity,unit,computed,reference,error,error_kind,relation,tolerance,basis,order,\
         order_low,order_high,order_levels,expected_order,verdict,note,source,seconds"
    );
    let rows = rows(&text);
    assert_eq!(rows.len(), 3);
    for row in rows {
        assert_eq!(row["claim"].strip_prefix("mine/a/").map(str::is_empty), Some(false));
        assert_eq!([&row["study"], &row["case"], &row["verdict"]], ["mine", "a", "pass"]);
        assert!(["<=", ">=", "within", "=="].contains(&row["relation"].as_str()));
        assert!(["absolute", "relative", "linf_relative"].contains(&row["error_kind"].as_str()));
        assert_eq!(row["basis"], "rounding");
        let number = |column: &str| row[column].parse::<f64>().unwrap();
        assert!(number("error") <= number("tolerance") && number("seconds") >= 0.0);
        assert_eq!(row["order"], "", "what is not known is an empty cell");
    }
}

#[test]
fn columns_of_curves() {
    let text =
        small_with("scheme = \"lattice\"", "scheme = [\"lattice\", \"lattice_leapfrog\"]\ncourant = 3")
            .replace("\"bar\"", "\"plane_stress\"");
    let text = format!(
        "{text}[[case.curve]]\nscheme = \"continuum\"\nkernel = \"constant\"\nhorizon_mm = 3\n[[case.curve]]\nscheme = \"fd\"\ndx_mm = 1\nangle_deg = 45\n"
    );
    let place = Place::with_study(text);
    place.run(&["run", "study.toml"]).code(0);
    let text = place.read("reports/mine/dispersion_curves.csv");
    assert_eq!(
        text.lines().next().unwrap(),
        "curve,dimension,branch,angle_deg,scheme,kernel,p,m,dx_m,horizon_m,volume_rule,calibrated,courant,\
         k_per_m,omega_over_c_per_m"
    );
    let rows = rows(&text);
    assert_eq!(rows.len(), 8 * 20);
    let known = ["continuum", "lattice", "lattice_leapfrog", "fd"];
    let mut unstable = 0;
    for row in &rows {
        let empty = |column: &str| row[column].is_empty();
        let scheme = row["scheme"].as_str();
        assert!(known.contains(&scheme), "{scheme}");
        assert_eq!(row["dimension"], "2");
        assert!(["P", "S"].contains(&row["branch"].as_str()));
        assert_eq!(empty("kernel"), scheme == "fd");
        assert_eq!(empty("p"), row["kernel"] != "gaussian");
        assert_eq!(empty("m"), !scheme.starts_with("lattice"));
        assert_eq!(empty("dx_m"), scheme == "continuum");
        assert_eq!(empty("horizon_m"), scheme == "fd");
        assert_eq!(empty("volume_rule"), !scheme.starts_with("lattice"));
        assert_eq!(empty("courant"), scheme != "lattice_leapfrog");
        unstable += usize::from(empty("omega_over_c_per_m"));
        assert!(!empty("omega_over_c_per_m") || scheme == "lattice_leapfrog");
        assert_shortest(&row["k_per_m"]);
    }
    assert!(unstable > 0, "no frequency where the scheme is unstable");
}

/// Not longer than either way of writing the number that reads back to it.
fn assert_shortest(text: &str) {
    let value: f64 = text.parse().unwrap();
    assert!(text.len() <= format!("{value}").len().min(format!("{value:e}").len()), "{text}");
}

#[test]
fn the_manifest_names_the_circumstances() {
    let place = Place::with_study(small());
    place.run(&["run", "study.toml", "--profile", "quick", "--threads", "1", "--isa", "baseline"]).code(0);
    let manifest: serde_json::Value =
        serde_json::from_str(&place.read("reports/mine/manifest.json")).unwrap();
    assert_eq!(manifest["version"], env!("CARGO_PKG_VERSION"));
    assert!(manifest["rustc"].as_str().unwrap().starts_with("rustc 1."));
    assert_eq!(manifest["profile"], "quick");
    assert_eq!(manifest["threads"], 1);
    assert_eq!(manifest["instruction_set_asked"], "baseline");
    assert_eq!(manifest["settings"], serde_json::json!([]));
    assert_eq!(manifest["command_line"].as_array().unwrap().len(), 9);
    assert!(manifest["start"].as_str().unwrap().ends_with('Z'));
    let hash: String = Sha256::digest(small()).iter().map(|byte| format!("{byte:02x}")).collect();
    assert_eq!(manifest["studies"][0]["sha256"], hash);
    for key in ["git_commit", "git_modified", "instruction_set", "cpu", "target"] {
        assert!(manifest.get(key).is_some(), "{key}");
    }
}

#[test]
fn text_from_other_editors_is_read() {
    let windows = small().replace('\n', "\r\n");
    let marked = format!("\u{feff}{}", small());
    let mut tables = [small(), windows, marked].map(|text| {
        let place = Place::with_study(text);
        place.run(&["run", "study.toml"]).code(0);
        place.read("reports/mine/dispersion_curves.csv")
    });
    tables.sort();
    assert!(tables[0] == tables[2]);
}
