//! What a measurement leaves: `bench.json`, from which `plan` predicts times, and `bench.csv`.

use super::forecast::Forecast;
use super::growth::growths;
use super::limits::Limits;
use super::rates::Rates;
use crate::input::Refusal;
use crate::manifest::cpu_model;
use pd_verify::plan::time::Costs;
use pd_verify::table::{Cell, Table};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::io;
use std::path::Path;

/// The folder below `--out`.
pub const FOLDER: &str = "bench";
const FILE: &str = "bench.json";

/// What `plan` reads of `bench.json`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Kept {
    pub isa: String,
    pub threads: usize,
    pub cpu: String,
    pub costs: Costs,
}

/// Everything that was measured.
pub struct Suite {
    pub limits: Limits,
    pub cases: Vec<Rates>,
    pub costs: Costs,
    pub forecasts: Vec<Forecast>,
}

/// One case and the limits, as data.
pub fn one(case: &Rates, limits: &Limits) -> Value {
    let limits = json!({
        "triad_gbyte_per_s": limits.triad_gbyte_per_s,
        "triad_cache_gbyte_per_s": limits.triad_cache_gbyte_per_s,
        "fma_gflop_per_s": limits.fma_gflop_per_s,
        "triad_by_bytes": limits.triad_by_bytes,
    });
    let mut value = json!(case);
    if let (Value::Object(value), Value::Object(limits)) = (&mut value, limits) {
        value.extend(limits);
    }
    value
}

impl Suite {
    /// The plate of reference, which stands for all, and everything else.
    pub fn json(&self) -> Value {
        let mut value = one(&self.cases[0], &self.limits);
        let more = json!({
            "cpu": cpu_model(),
            "cases": self.cases,
            "growth": growths(&self.cases),
            "costs": self.costs,
            "predictions": self.forecasts,
        });
        if let (Value::Object(value), Value::Object(more)) = (&mut value, more) {
            value.extend(more);
        }
        value
    }

    pub fn table(&self) -> Table {
        let columns = [
            "group",
            "case",
            "operator",
            "isa",
            "threads",
            "node_count",
            "m",
            "masked_share",
            "node_updates_per_s",
            "bond_updates_per_s",
            "gflop_per_s",
            "gbyte_per_s",
            "of_limit",
            "limit",
            "ratio",
            "bond_ratio",
            "spread",
            "steps",
            "rounds",
        ];
        let mut table = Table::new("bench.csv", &columns);
        for case in &self.cases {
            let row: Vec<Cell> = vec![
                case.group.into(),
                case.name.clone().into(),
                case.operator.into(),
                case.isa.into(),
                case.threads.into(),
                case.node_count.into(),
                case.m.into(),
                case.masked_share.into(),
                case.node_updates_per_s.into(),
                case.bond_updates_per_s.into(),
                case.gflop_per_s.into(),
                case.gbyte_per_s.into(),
                case.of_limit.into(),
                case.limit.into(),
                case.ratio.into(),
                case.bond_ratio.into(),
                case.spread.into(),
                case.steps.into(),
                case.rounds.into(),
            ];
            table.push(row);
        }
        table
    }
}

/// What a measurement left below `out`; `None` where there is none.
pub fn read(out: &Path) -> Result<Option<Kept>, Refusal> {
    let path = out.join(FOLDER).join(FILE);
    let refuse = |why: String| {
        Refusal::new(format!("{} is no result of `pd-verify bench`: {why}", path.display()))
            .help("run `pd-verify bench` again, or name the folder of another run with --out DIR")
    };
    match std::fs::read_to_string(&path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(refuse(error.to_string())),
        Ok(text) => serde_json::from_str(&text).map(Some).map_err(|error| refuse(error.to_string())),
    }
}

#[cfg(test)]
mod tests {
    use super::super::rates::sample;
    use super::*;
    use pd_verify::plan::time::BodyCosts;

    fn suite() -> Suite {
        let limits = Limits {
            threads: 2,
            triad_gbyte_per_s: 30.0,
            triad_cache_gbyte_per_s: 300.0,
            triad_by_bytes: vec![(1e6, 300.0), (1e9, 30.0)],
            fma_gflop_per_s: 200.0,
        };
        let plate = BodyCosts { step_s: 0.1, whole_by_pairs: vec![(18.0, 1e-9)], ..BodyCosts::default() };
        let slow = Rates { name: "slow".into(), ratio: 0.5, ..sample() };
        let forecasts = Vec::new();
        Suite { limits, cases: vec![sample(), slow], costs: Costs { plate, ..Costs::default() }, forecasts }
    }

    #[test]
    fn what_is_left_is_read_again() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(read(folder.path()).unwrap(), None);
        std::fs::create_dir(folder.path().join(FOLDER)).unwrap();
        let file = folder.path().join(FOLDER).join(FILE);
        std::fs::write(&file, suite().json().to_string()).unwrap();
        let kept = read(folder.path()).unwrap().unwrap();
        assert_eq!((kept.isa.as_str(), kept.threads, &kept.costs), ("baseline", 2, &suite().costs));
        for foreign in ["", "{}", "[1, 2]", "{\"isa\": 3}"] {
            std::fs::write(&file, foreign).unwrap();
            assert!(
                read(folder.path()).unwrap_err().to_string().contains("bench.json is no result"),
                "{foreign}"
            );
        }
    }

    #[test]
    fn the_plate_of_reference_stands_for_all_and_every_case_has_its_numbers() {
        let json = suite().json();
        for key in ["node_updates_per_s", "bond_updates_per_s", "gflop_per_s", "gbyte_per_s", "of_limit"] {
            assert_eq!(json[key], json["cases"][0][key]);
            assert!(json["cases"][1][key].is_number(), "{key}");
        }
        assert_eq!((&json["triad_gbyte_per_s"], &json["fma_gflop_per_s"]), (&json!(30.0), &json!(200.0)));
        assert_eq!((&json["cases"][1]["name"], &json["cases"][1]["ratio"]), (&json!("slow"), &json!(0.5)));
        let csv = suite().table().csv();
        assert_eq!(csv.lines().count(), 3);
        assert!(
            csv.lines().nth(2).unwrap().starts_with("plates by size,slow,stencil,baseline,2,1048576,3,0,"),
            "{csv}"
        );
    }
}
