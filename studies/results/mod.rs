//! Results as data: what pages and tables are made from, in a file beside them that loses nothing.

pub mod baseline;
pub mod inputs;
mod ledger;
pub mod merge;
pub mod page;
pub mod read;
pub mod resume;
mod shown;
#[cfg(test)]
mod tests;
pub mod write;

use crate::manifest::Manifest;
use crate::shard::Shard;
use pd_verify::exact::{self, Exact};
use pd_verify::verdict::Judged;
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

/// The version of both formats.
pub const FORMAT: u64 = 1;

/// The file of a folder of results.
pub const RESULTS: &str = "results.json";

/// The file that says which folders belong to a run.
pub const RUN: &str = "run.json";

/// `results.json`: everything that stands in one folder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Folder {
    /// Version of the format.
    pub format: u64,
    pub manifest: Manifest,
    /// The part of a run that was run here, if not all of it.
    pub shard: Option<Shard>,
    /// Data files that cases share; each begins with a line of columns.
    pub tables: Vec<Table>,
    /// What could not be drawn or written.
    pub problems: Vec<String>,
    pub studies: Vec<StudyResults>,
}

/// A data file, and the columns of its first line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Table {
    pub columns: String,
    pub file: File,
}

/// A file of the folder and the SHA-256 of its bytes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct File {
    pub name: String,
    pub sha256: String,
}

/// What was found in a study.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StudyResults {
    pub id: String,
    pub kind: String,
    pub title: String,
    /// What the study claims; paragraphs are separated by an empty line.
    pub text: String,
    pub source: String,
    /// All its cases in order, those among them that were not run here.
    pub order: Vec<String>,
    /// The cases that were run or left out by the profile.
    pub cases: Vec<CaseResults>,
}

/// What was found in a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaseResults {
    pub id: String,
    /// SHA-256 of what the results depend on: the case as resolved, the program, the instruction set.
    pub inputs: String,
    #[serde(with = "exact::number")]
    #[schemars(with = "Exact")]
    pub seconds: f64,
    pub judged: Vec<Judged>,
    pub figures: Vec<FigureResults>,
    /// How many bytes of which data file are the case's; they follow those of the case before.
    pub rows: Vec<Rows>,
    /// Further files.
    pub files: Vec<File>,
}

/// A figure and its data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FigureResults {
    pub id: String,
    pub title: String,
    pub caption: String,
    /// Missing where it could not be drawn.
    pub svg: Option<File>,
    pub csv: File,
}

/// A case's part of a data file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rows {
    pub file: String,
    pub bytes: u64,
}

/// `run.json`: which folders belong to a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// Version of the format.
    pub format: u64,
    pub program: String,
    pub manifest: Manifest,
    pub shard: Option<Shard>,
    /// Whether all cases were run that should have been, and all that was found could be written.
    pub complete: bool,
    /// Names of all folders in order, those among them of which no case was run here.
    pub order: Vec<String>,
    /// The folders that were written, with the SHA-256 of their `results.json`.
    pub folders: Vec<File>,
}

impl Folder {
    /// All claims.
    pub fn judged(&self) -> impl Iterator<Item = &Judged> {
        self.cases().flat_map(|case| &case.judged)
    }

    /// All cases.
    pub fn cases(&self) -> impl Iterator<Item = &CaseResults> {
        self.studies.iter().flat_map(|study| &study.cases)
    }

    /// Every file but `results.json`, `manifest.json` and `verdicts.csv`.
    pub fn files(&self) -> impl Iterator<Item = &File> {
        self.tables.iter().map(|table| &table.file).chain(self.cases().flat_map(CaseResults::files))
    }
}

impl CaseResults {
    /// The files that are the case's alone.
    pub fn files(&self) -> impl Iterator<Item = &File> {
        let drawn = self.figures.iter().flat_map(|figure| figure.svg.iter().chain([&figure.csv]));
        drawn.chain(&self.files)
    }
}

/// SHA-256 in hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

/// Bytes in hexadecimal digits.
pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The JSON schema of `results.json`.
pub fn results_schema() -> Value {
    schema::<Folder>("pd-verify results of a folder")
}

/// The JSON schema of `run.json`.
pub fn run_schema() -> Value {
    schema::<Run>("pd-verify run")
}

fn schema<T: JsonSchema>(title: &str) -> Value {
    let mut schema = SchemaSettings::draft2020_12().into_generator().into_root_schema_for::<T>().to_value();
    schema["title"] = title.into();
    schema["properties"]["format"] = json!({ "const": FORMAT, "description": "Version of the format." });
    schema
}
