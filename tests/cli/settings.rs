//! `--set`: typed, refused where there is no such place, and recorded.

use crate::support::{Place, rows, small};

#[test]
fn a_setting_changes_the_study_and_is_recorded() {
    let place = Place::with_study(small());
    let settings = ["material.density_g_cm3=2.5", "case.a.curve.0.m=[3, 5]", "case.a.title=Two horizons"];
    let mut arguments = vec!["run", "study.toml"];
    settings.iter().for_each(|setting| arguments.extend(["--set", setting]));
    place.run(&arguments).code(0);
    let manifest: serde_json::Value =
        serde_json::from_str(&place.read("reports/mine/manifest.json")).unwrap();
    assert_eq!(manifest["settings"], serde_json::json!(settings));
    let curves = rows(&place.read("reports/mine/dispersion_curves.csv"));
    let mut sizes: Vec<_> = curves.iter().map(|row| row["m"].clone()).collect();
    sizes.dedup();
    assert_eq!(sizes, ["3", "5"]);
}

#[test]
fn settings_without_a_place() {
    let place = Place::with_study(small());
    for (setting, words) in [
        ("novalue", ["expected dotted.path=value", "for example"]),
        ("=3", ["expected dotted.path=value", "for example"]),
        ("matreial.density_kg_m3=1", ["no study here has such a place", "case.my-case"]),
        ("case.b.m=1", ["no study here has such a place", "entered by id"]),
        ("case.0.curve.7.m=3", ["no study here has such a place", "entered by id"]),
        ("material.density=1", ["unknown key `density`", "did you mean `density_kg_m3`?"]),
        ("colour=red", ["unknown key `colour`", "allowed: id, kind"]),
        ("id=../y", ["cannot name", "lower-case letters"]),
        ("case.a.curve.0.m=nan", ["finite", "NaN and infinity"]),
        ("case.a.curve.0.m=[3, 4", ["--set", "not valid TOML"]),
        ("case.a.curve.0.m=3\nid = \"y\"", ["expected dotted.path=value", "for example"]),
    ] {
        place.refuses(&["run", "study.toml", "--set", setting], &words);
    }
}

#[test]
fn a_value_that_was_set_is_not_sought_in_the_file() {
    // The line in the file is right; what is wrong stands on the command line.
    let place = Place::with_study(small());
    let setting = "case.a.curve.0.kernel=gausian";
    place.refuses(
        &["run", "study.toml", "--set", setting],
        &["did you mean `gaussian`?", "changed by --set", setting],
    );
}

#[test]
fn shipped_studies_keep_their_names() {
    Place::new().refuses(&["dispersion", "--set", "id=x"], &["id", "x", "another"]);
    Place::new().refuses(&["dispersion", "--set", "case.kernels.nothing=1"], &["unknown key `nothing`"]);
}
