//! Wrong study files: each is refused with code 2, its place, cause and cure, before anything is written.

use crate::support::{CASE, HEAD, Place, small, small_with};

/// A slip: what is replaced by what in the small study, and what the message must say.
struct Slip(&'static str, &'static str, &'static [&'static str]);

fn refused(slips: &[Slip]) {
    for Slip(old, new, words) in slips {
        Place::with_study(small_with(old, new)).refuses(&["run", "study.toml"], words);
    }
}

#[test]
fn misspelt_words_and_keys() {
    refused(&[
        Slip("kernel =", "kernal =", &["study.toml:17:", "unknown key `kernal`", "did you mean `kernel`?"]),
        Slip("\"gaussian\"", "\"gausian\"", &["study.toml:", "`gausian`", "did you mean `gaussian`?"]),
        Slip("\"lattice\"", "\"Lattice\"", &["did you mean `lattice`?"]),
        Slip("\"lattice\"", "\"lattice-leapfrog\"", &["did you mean `lattice_leapfrog`?"]),
        Slip("\"bar\"", "\"plane-stress\"", &["did you mean `plane_stress`?"]),
        Slip("\"dispersion\"", "\"dispersoin\"", &["study.toml:3:", "did you mean `dispersion`?"]),
        Slip("\"curves\"", "\"curve\"", &["no case asks \"curve\"", "did you mean \"curves\"?"]),
        Slip("body = ", "profile = \"fast\"\nbody = ", &["`fast`", "quick, standard, full"]),
        Slip("dx_mm", "dx", &["unknown key `dx`", "did you mean `dx_m`?"]),
        Slip("title = \"Aluminium\"", "titel = \"Aluminium\"", &["did you mean `title`?"]),
    ]);
}

#[test]
fn a_cure_is_one_that_cures() {
    // The unit as written, or seventy gigapascals would become seventy pascals.
    refused(&[Slip(
        "youngs_modulus_gpa",
        "young_modulus_gpa",
        &["unknown key `young_modulus_gpa`", "did you mean `youngs_modulus_gpa`?"],
    )]);
    refused(&[
        Slip(
            "youngs_modulus_gpa",
            "youngs_modulus_gp",
            &["did you mean `youngs_modulus_gpa`?", "(or _mpa, _gpa, …)"],
        ),
        Slip(
            "density_kg_m3",
            "densty_g_cm3",
            &["did you mean `density_g_cm3`?", "density_kg_m3 (or _g_cm3)"],
        ),
    ]);
    // Keys of a case are no keys of its curves.
    let place = Place::with_study(small_with("m = 3\n", "m = 3\ntitel = \"x\"\n"));
    let assert = place.run(&["run", "study.toml"]).code(2);
    let said = String::from_utf8_lossy(&assert.get_output().stderr).into_owned();
    assert!(said.contains("unknown key `titel`") && !said.contains("title"), "{said}");
}

#[test]
fn missing_keys() {
    refused(&[
        Slip("format = 1\n", "", &["study.toml", "`format`", "format = 1"]),
        Slip("kind = \"dispersion\"\n", "", &["study.toml", "`kind` is missing", "add `kind`"]),
        Slip("title = \"Aluminium\"\n", "", &["`title` is missing"]),
        Slip("asks = \"curves\"\n", "", &["study.toml:10:", "`asks` is missing"]),
        Slip("body = \"bar\"\n", "", &["`body` is missing", "add `body`"]),
        Slip("wavenumbers = { to_per_m = 1500, count = 20 }\n", "", &["`wavenumbers` is missing"]),
        Slip("{ to_per_m = 1500, count = 20 }", "{ count = 20 }", &["add to_per_m, or values_per_m"]),
        Slip("p = 1.5\n", "", &["study.toml:17:", "kernel \"gaussian\" needs p", "add p"]),
        Slip("volume_rule = \"linear\"\n", "", &["needs volume_rule", "\"exact_area\""]),
        Slip("dx_mm = 1\n", "", &["the size of the horizon is not given", "two of m, dx_m and horizon_m"]),
        Slip("\"lattice\"", "\"lattice_leapfrog\"", &["needs a time step", "add courant or time_step_s"]),
    ]);
    Place::with_study(HEAD).refuses(&["run", "study.toml"], &["study.toml", "no case", "[[case]]"]);
}

#[test]
fn values_of_the_wrong_kind() {
    refused(&[
        Slip("m = 3\n", "m = \"three\"\n", &["study.toml:19:", "\"three\"", "a number"]),
        Slip("m = 3\n", "m = [3, \"x\"]\n", &["study.toml:19:9", "a number"]),
        Slip("kernel = \"gaussian\"", "kernel = 3", &["study.toml:17:", "a word"]),
        Slip("volume_rule = \"linear\"", "volume_rule = true", &["a word"]),
        Slip("{ to_per_m = 1500, count = 20 }", "1500", &["wavenumbers", "a table"]),
        Slip("count = 20", "count = 20.5", &["a whole number"]),
        Slip("count = 20", "count = -20", &["a whole number"]),
        Slip("title = \"Aluminium\"", "title = 3", &["study.toml:4:", "a text"]),
        Slip("m = 3\n", "m = 1979-05-27\n", &["a date"]),
        Slip("[[case]]", "[case]", &["case must be a list", "[[case]]"]),
    ]);
}

#[test]
fn numbers_that_are_no_quantity() {
    refused(&[
        Slip("= 2700", "= -2700", &["study.toml:8:", "density_kg_m3: -2700", "a positive number"]),
        Slip("dx_mm = 1\n", "dx_mm = 0\n", &["study.toml:20:", "a positive number"]),
        Slip("m = 3\n", "m = nan\n", &["study.toml:19:", "finite", "NaN and infinity"]),
        Slip("dx_mm = 1\n", "dx_mm = inf\n", &["study.toml:20:", "finite"]),
        Slip("dx_mm = 1\n", "dx_mm = 1e300\n", &["study.toml:20:", "not between 1e-30 and 1e30"]),
        Slip("dx_mm = 1\n", "dx_mm = 1e-320\n", &["study.toml:20:", "not between 1e-30 and 1e30"]),
        Slip("m = 3\n", "m = 99999999999999999999\n", &["too large a whole number"]),
        Slip("m = 3\n", "m = []\n", &["study.toml:19:", "an empty list asks for nothing"]),
        Slip("count = 20", "count = 1", &["at least 2 points"]),
        Slip("count = 20", "from_per_m = 1600", &["the range is empty", "below to_per_m"]),
    ]);
}

#[test]
fn contradictions() {
    refused(&[
        Slip("m = 3\n", "m = 3\nhorizon_mm = 3\n", &["study.toml:20:", "leave one of the three out"]),
        Slip("dx_mm = 1\n", "dx_mm = 1\ndx_m = 0.001\n", &["given twice, in different units"]),
        Slip("\"gaussian\"", "\"constant\"", &["study.toml:18:", "no kernel to narrow", "leave it out"]),
        Slip("m = 3\n", "m = 3\ncourant = 0.5\n", &["study.toml:20:", "courant means nothing"]),
        Slip("m = 3\n", "m = 3\nangle_deg = 45\n", &["angle_deg means nothing"]),
        Slip("\"lattice\"", "\"fd\"", &["kernel means nothing"]),
        Slip(
            "\"lattice\"",
            "\"lattice_leapfrog\"\ncourant = 0.5\ntime_step_ns = 3",
            &["leave one of the two out"],
        ),
        Slip(
            "density",
            "poisson_ratio = 0.3\ndensity",
            &["study.toml:8:", "not free", "leave poisson_ratio out"],
        ),
        Slip(
            "to_per_m = 1500, count",
            "from_per_m = 1e5, to_per_m = 2e5, count",
            &["beyond the zone's edge"],
        ),
    ]);
    let plane = small_with("\"bar\"", "\"plane_stress\"").replace("density", "poisson_ratio = 0.25\ndensity");
    Place::with_study(plane).refuses(&["run", "study.toml"], &["poisson_ratio = 0.25", "plane stress"]);
}

#[test]
fn lattices_that_cannot_be_used() {
    refused(&[
        Slip("m = 3\n", "m = 0.5\n", &["study.toml:19:", "m = 0.5 is below 1", "take m >= 1"]),
        Slip("m = 3\n", "m = [3, 0.5]\n", &["m = 0.5 is below 1"]),
        Slip("p = 1.5", "p = 30", &["study.toml:", "lost its weights", "a larger m, a smaller p"]),
        Slip("m = 3\n", "horizon_mm = 1e9\n", &["study.toml:", "m = 1000000000", "take a smaller m"]),
    ]);
    let square = small_with("\"bar\"", "\"plane_stress\"")
        .replace("kernel = \"gaussian\"\np = 1.5\nm = 3", "kernel = \"constant\"\nm = 1")
        .replace("linear", "full");
    Place::with_study(square).refuses(&["run", "study.toml"], &["no shear stiffness", "take m >= 1.5"]);
}

#[test]
fn ids_that_cannot_name_files() {
    refused(&[
        Slip("\"mine\"", "\"../x\"", &["study.toml:2:", "cannot name", "lower-case letters, digits"]),
        Slip("\"mine\"", "\"\"", &["cannot name"]),
        Slip("\"mine\"", "\"dispersion\"", &["the folder of a shipped command", "choose another id"]),
        Slip("\"a\"", "\"../a\"", &["study.toml:11:", "cannot name"]),
        Slip(
            "\"a\"",
            "\"dispersion_curves\"",
            &["study.toml:11:", "the name of a table", "choose another id"],
        ),
        Slip("\"a\"", "\"verdicts\"", &["the name of a table"]),
    ]);
    let twice = format!("{}{CASE}", small());
    Place::with_study(twice)
        .refuses(&["run", "study.toml"], &["study.toml:24:", "two cases are called \"a\""]);
    let nearly = format!("{}{}", small(), CASE.replace("\"a\"", "\"a-velocity\""));
    Place::with_study(nearly)
        .refuses(&["run", "study.toml"], &["study.toml:24:", "a-velocity", "choose another id"]);
}

#[test]
fn text_that_is_no_study() {
    refused(&[
        Slip("format = 1", "format = 2", &["study.toml:1:", "reads format = 1"]),
        Slip("format = 1", "format = \"1\"", &["study.toml:1:", "reads format = 1"]),
        Slip("id = \"mine\"", "id = \"mine", &["study.toml:2:", "not valid TOML", "https://toml.io"]),
        Slip("m = 3", "m = = 3", &["study.toml:19:", "not valid TOML"]),
        Slip("m = 3\n", "m = 3\nm = 4\n", &["study.toml:20:", "duplicate key"]),
    ]);
    Place::with_study("")
        .refuses(&["run", "study.toml"], &["study.toml", "a study file starts with format = 1"]);
    Place::with_study(b"format = 1\n# \xff\n")
        .refuses(&["run", "study.toml"], &["study.toml:2", "UTF-8", "save the file as UTF-8"]);
    let nested = format!("a = {}", "[".repeat(100_000));
    Place::with_study(nested).refuses(&["run", "study.toml"], &["study.toml", "recurs"]);
    let nested = format!("a = {}1{}", "[".repeat(60), "]".repeat(60));
    Place::with_study(nested).refuses(&["run", "study.toml"], &["study.toml:1:", "nested too deeply"]);
}
