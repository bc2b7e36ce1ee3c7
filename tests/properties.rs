//! Properties that hold for every input: nothing makes the parser panic, units mean what they say, and a change of
//! the unit of length changes no dispersion.

#[path = "../studies/input/mod.rs"]
#[allow(dead_code, unused_imports)]
mod input;

use input::{Document, OneOrMany, Setting};
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::dispersion::plane::PlaneDispersion;
use pd_verify::dispersion::{Branch, continuum};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::Positive;
use proptest::prelude::*;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// A small study with the numbers left open; the units of its keys follow `units`.
fn study(units: &Units, numbers: [f64; 6]) -> String {
    let [young, density, dx, horizon, step, k] = numbers;
    format!(
        r#"format = 1
id = "mine"
kind = "dispersion"
title = "Units"
[material]
youngs_modulus_{} = {:?}
density_{} = {:?}
[[case]]
id = "a"
asks = "curves"
body = "bar"
wavenumbers = {{ to_{} = {:?}, count = 30 }}
[[case.curve]]
scheme = "lattice_leapfrog"
kernel = "gaussian"
p = 1.5
dx_{} = [{:?}]
horizon_{} = {:?}
volume_rule = "linear"
time_step_{} = {:?}
"#,
        units.pressure.0,
        young / units.pressure.1,
        units.density.0,
        density / units.density.1,
        units.wavenumber.0,
        k / units.wavenumber.1,
        units.length.0,
        dx / units.length.1,
        units.length.0,
        horizon / units.length.1,
        units.time.0,
        step / units.time.1,
    )
}

/// Ending of a key and its size in SI, for each kind of quantity.
struct Units {
    length: (&'static str, f64),
    time: (&'static str, f64),
    pressure: (&'static str, f64),
    density: (&'static str, f64),
    wavenumber: (&'static str, f64),
}

const SI: Units = Units {
    length: ("m", 1.0),
    time: ("s", 1.0),
    pressure: ("pa", 1.0),
    density: ("kg_m3", 1.0),
    wavenumber: ("per_m", 1.0),
};

const LABORATORY: Units = Units {
    length: ("mm", 1e-3),
    time: ("us", 1e-6),
    pressure: ("gpa", 1e9),
    density: ("g_cm3", 1e3),
    wavenumber: ("per_mm", 1e3),
};

const MICROSCOPE: Units = Units {
    length: ("um", 1e-6),
    time: ("ns", 1e-9),
    pressure: ("mpa", 1e6),
    density: ("kg_mm3", 1e9),
    wavenumber: ("per_um", 1e6),
};

/// Largest relative difference of two trees' numbers; infinite where anything else differs.
fn difference(a: &Value, b: &Value) -> f64 {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap(), b.as_f64().unwrap());
            if a == b { 0.0 } else { (a - b).abs() / a.abs().max(b.abs()) }
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            a.iter().zip(b).map(|(a, b)| difference(a, b)).fold(0.0, f64::max)
        }
        (Value::Object(a), Value::Object(b)) if a.len() == b.len() => a
            .iter()
            .map(|(key, a)| b.get(key).map_or(f64::INFINITY, |b| difference(a, b)))
            .fold(0.0, f64::max),
        _ if a == b => 0.0,
        _ => f64::INFINITY,
    }
}

/// Text built from the pieces that study files are made of, mostly wrong.
fn nearly_toml() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        Just("format = 1\n".to_owned()),
        Just("[[case]]\n".to_owned()),
        Just("[material]\n".to_owned()),
        Just("[case.curve]\n".to_owned()),
        Just("dx_mm".to_owned()),
        Just("dx_m".to_owned()),
        Just(" = ".to_owned()),
        Just("[".to_owned()),
        Just("]".to_owned()),
        Just("{ a.b = 1, ".to_owned()),
        Just("}".to_owned()),
        Just("\"\"\"".to_owned()),
        Just("\n".to_owned()),
        Just("1979-05-27T07:32:00Z".to_owned()),
        Just("0x7fffffffffffffff".to_owned()),
        Just("-inf".to_owned()),
        any::<f64>().prop_map(|x| format!("{x:e}")),
        any::<i64>().prop_map(|x| x.to_string()),
        "\\PC{0,8}",
    ];
    prop::collection::vec(piece, 0..40).prop_map(|pieces| pieces.concat())
}

/// Everything the parser does with a text; refusals are printed, since that takes the place apart.
fn exercise(text: &str) {
    let shown = match Document::parse("x.toml", text) {
        Ok(document) => {
            let whole = document.whole();
            let wrong = document.read::<OneOrMany<Positive>>("", &whole, &["format"]).err();
            let place = document.refuse("case[1].dx_m", "wrong");
            format!("{:?} {:?}", wrong.map(miette::Report::new), miette::Report::new(place))
        }
        Err(refusal) => format!("{:?}", miette::Report::new(refusal)),
    };
    assert!(!shown.is_empty());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_bytes_make_the_parser_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        exercise(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn no_text_that_is_nearly_a_study_makes_the_parser_panic(text in nearly_toml()) {
        exercise(&text);
    }

    #[test]
    fn no_setting_makes_the_parser_panic(text in "\\PC{0,40}", path in "[a-z.0-9]{1,12}", value in "\\PC{0,12}") {
        let study = study(&SI, [70e9, 2700.0, 1e-3, 3e-3, 1e-8, 1500.0]);
        for written in [text, format!("{path}={value}"), format!("case.{path}={value}")] {
            if let Ok(setting) = Setting::parse(&written) {
                let mut document = Document::parse("x.toml", &study).unwrap();
                let _ = document.set(&setting);
                prop_assert_eq!(setting.to_string(), written);
            }
        }
    }

    #[test]
    fn a_cut_study_never_panics(cut in 0_usize..600) {
        let study = study(&LABORATORY, [70e9, 2700.0, 1e-3, 3e-3, 1e-8, 1500.0]);
        exercise(study.get(..cut).unwrap_or(&study));
    }

    #[test]
    fn units_are_read_as_si(
        young in 1e6..1e12, density in 1e2..2e4, dx in 1e-6..1.0, m in 1.0..9.0, step in 1e-12..1e-3, k in 1.0..1e7,
    ) {
        let numbers = [young, density, dx, m * dx, step, k];
        let read = |units| Document::parse("x.toml", &study(units, numbers)).unwrap().whole();
        let si = read(&SI);
        prop_assert!(si["case"][0]["curve"][0]["dx_m"][0].as_f64() == Some(dx));
        for units in [&LABORATORY, &MICROSCOPE] {
            let difference = difference(&si, &read(units));
            prop_assert!(difference < 1e-12, "{difference:e}");
        }
    }

    /// ω/c depends on k, Δx and δ through kΔx and δ/Δx alone: L times the lengths, k/L, give ω/c over L.
    #[test]
    fn the_unit_of_length_does_not_matter(
        p in 0.1..4.0, m in 1.5..8.0, share in 0.001..0.999, power in -12..12, degrees in 0.0..90.0,
    ) {
        let lattice = |kernel| Lattice { kernel, m, volume_rule: VolumeRule::Linear, calibrated: false };
        let dx = 1.3e-3;
        let k = share * std::f64::consts::PI / dx;
        let scale = 10_f64.powi(power) * 1.7;
        for kernel in [Kernel::Constant, Kernel::Gaussian { p }] {
            let bar = BarDispersion::new(&Stencil::new(lattice(kernel)).unwrap());
            let plane = PlaneDispersion::new(&Stencil::new(lattice(kernel)).unwrap());
            let relations: [&dyn Fn(f64) -> f64; 4] = [
                &|theta| bar.wave(theta).omega,
                &|theta| plane.wave(theta, degrees, Branch::P).omega,
                &|theta| plane.wave(theta, degrees, Branch::S).omega,
                &|z| continuum::bar(kernel, z).0.omega,
            ];
            for relation in relations {
                let omega = |k: f64, dx: f64| relation(k * dx) / dx;
                let (here, there) = (omega(k, dx), omega(k / scale, dx * scale) * scale);
                prop_assert!((here - there).abs() <= 1e-12 * here, "{here:e} {there:e}");
            }
        }
    }
}

/// The curves that the program writes for a study.
fn curves(folder: &Path, study: &str) -> Vec<[f64; 2]> {
    fs::write(folder.join("study.toml"), study).unwrap();
    let mut program = assert_cmd::Command::new(env!("CARGO_BIN_EXE_pd-verify"));
    program.current_dir(folder).args(["run", "study.toml", "--strict", "--quiet"]).assert().code(0);
    let mut reader = csv::Reader::from_path(folder.join("reports/mine/dispersion_curves.csv")).unwrap();
    let number = |text: &str| text.parse().unwrap_or(f64::NAN);
    reader.records().map(Result::unwrap).map(|row| [number(&row[13]), number(&row[14])]).collect()
}

#[test]
fn results_are_the_same_in_any_unit() {
    let folder = tempfile::tempdir().unwrap();
    for numbers in [
        [70e9, 2700.0, 1e-3, 3e-3, 1e-8, 1500.0],
        [3.1e9, 1180.0, 0.37e-3, 0.37e-3 * 4.6, 0.9e-7, 7000.0],
        [200e9, 7850.0, 0.013, 0.05, 1.1e-6, 230.0],
    ] {
        let si = curves(folder.path(), &study(&SI, numbers));
        assert_eq!(si.len(), 30);
        for units in [&LABORATORY, &MICROSCOPE] {
            let other = curves(folder.path(), &study(units, numbers));
            assert_eq!(si.len(), other.len());
            for (a, b) in si.iter().flatten().zip(other.iter().flatten()) {
                assert!(a == b || (a - b).abs() <= 1e-12 * a.abs(), "{a:e} {b:e}");
            }
        }
    }
}
