//! A study: a question with a file. Its header, its cases, and the checks that need no computation.

use crate::dispersion::{COMMON_KEYS, TABLES, Written, read_case};
use crate::input::{Document, Positive, Refusal, Setting, other_units};
use crate::question::{Effort, Place, Profile, Question};
use pd_verify::claim::Claim;
use pd_verify::material::Material;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;
use std::collections::HashSet;

/// The version of the format that this program reads.
pub const FORMAT: u64 = 1;

/// Kinds of study that this program runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    Dispersion,
}

/// The head of a study file.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Header {
    /// Folder name of the results: lower-case letters, digits, `-` and `_`.
    id: String,
    kind: Kind,
    title: String,
    /// What the study claims, in prose.
    about: Option<String>,
    /// Publication or data that the study follows.
    source: Option<String>,
    material: Option<MaterialAsked>,
}

/// Elastic constants; the bond-based law fixes Poisson's ratio (1/3 plane stress, 1/4 plane strain).
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct MaterialAsked {
    youngs_modulus_pa: Positive,
    density_kg_m3: Positive,
    /// Optional; any value but the law's is refused.
    poisson_ratio: Option<f64>,
}

/// The parts of a case that all kinds share.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
struct CaseHeader {
    id: String,
    asks: String,
    title: Option<String>,
    /// The smallest profile that runs the case; default `quick`.
    profile: Option<Profile>,
}

/// One case, checked and ready.
pub struct Case {
    pub place: Place,
    pub title: String,
    pub asks: String,
    /// The smallest profile that runs it.
    pub profile: Profile,
    pub question: Box<dyn Question>,
}

impl Case {
    /// Every claim of the case, with the case's claims checked for duplicates by construction.
    pub fn claims(&self) -> Vec<Claim> {
        self.question.claims(&self.place)
    }
}

/// A study, checked and ready.
pub struct Study {
    pub id: String,
    pub kind: Kind,
    pub title: String,
    pub about: String,
    pub source: String,
    pub document: Document,
    pub cases: Vec<Case>,
}

impl Study {
    /// Reads a study from its text and applies `--set` changes. Returns which of them found their place.
    pub fn read(name: &str, text: &str, settings: &[Setting]) -> Result<(Self, Vec<bool>), Refusal> {
        let mut document = Document::parse(name, text)?;
        let mut found = Vec::new();
        for setting in settings {
            found.push(document.set(setting)?);
        }
        Ok((Self::check(document)?, found))
    }

    fn check(document: Document) -> Result<Self, Refusal> {
        check_format(&document)?;
        let header: Header = document.read("", &document.whole(), &["format", "case"])?;
        check_id(&document, "id", &header.id)?;
        let material = header.material.as_ref().map(|asked| Material {
            youngs_modulus: asked.youngs_modulus_pa.0,
            density: asked.density_kg_m3.0,
        });
        let ratio = header.material.as_ref().and_then(|asked| asked.poisson_ratio);
        let cases = read_cases(&document, &header.id, material, ratio)?;
        let Header { id, kind, title, about, source, .. } = header;
        let (about, source) = (about.unwrap_or_default(), source.unwrap_or_default());
        Ok(Self { id, kind, title, about, source, document, cases })
    }

    /// The work of all cases that `profile` runs.
    pub fn effort(&self, profile: Profile) -> Effort {
        let mut total = Effort::default();
        for case in self.cases.iter().filter(|case| case.profile <= profile) {
            total += case.question.effort();
        }
        total
    }
}

fn check_format(document: &Document) -> Result<(), Refusal> {
    match document.get("format") {
        Some(Value::Number(number)) if number.as_u64() == Some(FORMAT) => Ok(()),
        Some(other) => {
            let message =
                format!("format = {other} is not known to this version, which reads format = {FORMAT}");
            Err(document.refuse("format", message).help("write format = 1, or update the program"))
        }
        None => Err(document
            .refuse("", format!("{}: missing field `format`", document.name()))
            .help("a study file starts with format = 1; see `pd-verify schema`")),
    }
}

fn check_id(document: &Document, path: &str, id: &str) -> Result<(), Refusal> {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_';
    if !id.is_empty() && id.len() <= 80 && id.chars().all(plain) {
        return Ok(());
    }
    let message = format!("\"{id}\" cannot name a folder of results");
    Err(document.refuse(path, message).help("use lower-case letters, digits, - and _, at most 80"))
}

/// A case's figure is called like the case; it must not take the place of a table.
fn check_figure_name(document: &Document, path: &str, id: &str, asks: &str) -> Result<(), Refusal> {
    if !TABLES.contains(&id) || asks == id {
        return Ok(());
    }
    Err(document.refuse(path, format!("\"{id}\" is the name of a table")).help("choose another id"))
}

/// The bond-based law fixes Poisson's ratio by the body; in a bar it plays no part.
fn check_poisson_ratio(document: &Document, ratio: Option<f64>, case: &Value) -> Result<(), Refusal> {
    let Some(ratio) = ratio else { return Ok(()) };
    let fixed = |body: &str| match body {
        "plane_stress" => vec![1.0 / 3.0],
        "plane_strain" => vec![0.25],
        _ => vec![1.0 / 3.0, 0.25],
    };
    let bodies: Vec<&str> = match &case["body"] {
        Value::Array(bodies) => bodies.iter().filter_map(Value::as_str).collect(),
        body => vec![body.as_str().unwrap_or_default()],
    };
    if bodies.iter().all(|body| fixed(body).iter().any(|fixed| (ratio - fixed).abs() < 1e-3)) {
        return Ok(());
    }
    let message = format!(
        "poisson_ratio = {ratio} is not free: the bond-based law has 1/3 in plane stress, 1/4 in plane strain"
    );
    Err(document.refuse("material.poisson_ratio", message).help("leave poisson_ratio out"))
}

/// Ends of the names of figures beside the one that is called like its case.
const SUFFIXES: [&str; 4] = ["-velocity", "-full", "-linear", "-exact-area"];

fn read_cases(
    document: &Document,
    study: &str,
    material: Option<Material>,
    ratio: Option<f64>,
) -> Result<Vec<Case>, Refusal> {
    let written = match document.get("case") {
        Some(Value::Array(items)) if !items.is_empty() => items,
        Some(Value::Array(_)) | None => {
            return Err(document
                .refuse("", format!("{}: the study has no case", document.name()))
                .help("add a [[case]] table with id and asks; see `pd-verify schema`"));
        }
        Some(_) => {
            return Err(document
                .refuse("case", "case must be a list")
                .help("write [[case]], with two brackets"));
        }
    };
    let mut cases: Vec<Case> = Vec::new();
    let mut ids: HashSet<String> = HashSet::new();
    for (index, value) in written.iter().enumerate() {
        let case = read_one(document, study, material, index, value)?;
        check_poisson_ratio(document, ratio, value)?;
        if !ids.insert(case.place.case.clone()) {
            let message = format!("two cases are called \"{}\"", case.place.case);
            return Err(document
                .refuse(&format!("case[{index}].id"), message)
                .help("give each case its own id"));
        }
        cases.push(case);
    }
    for (index, case) in cases.iter().enumerate() {
        let other = SUFFIXES.iter().find_map(|suffix| case.place.case.strip_suffix(suffix));
        let other = other.filter(|other| ids.contains(*other));
        if let Some(other) = other {
            let message = format!("\"{}\" is the name of a figure of the case \"{other}\"", case.place.case);
            return Err(document.refuse(&format!("case[{index}].id"), message).help("choose another id"));
        }
    }
    Ok(cases)
}

fn read_one(
    document: &Document,
    study: &str,
    material: Option<Material>,
    index: usize,
    value: &Value,
) -> Result<Case, Refusal> {
    let path = format!("case[{index}]");
    let mut common = value.clone();
    if let Value::Object(table) = &mut common {
        table.retain(|key, _| COMMON_KEYS.contains(&key.as_str()));
    }
    let header: CaseHeader = document.read(&path, &common, &[])?;
    check_id(document, &format!("{path}.id"), &header.id)?;
    check_figure_name(document, &format!("{path}.id"), &header.id, &header.asks)?;
    let title = header.title.unwrap_or_else(|| header.id.clone());
    let question = read_case(&header.asks, &Written { document, path, value, title: &title, material })?;
    let place = Place { study: study.to_owned(), case: header.id };
    let profile = header.profile.unwrap_or(Profile::Quick);
    Ok(Case { place, title, asks: header.asks, profile, question })
}

/// The JSON schema of study files.
pub fn schema() -> Value {
    let mut generator = schemars::generate::SchemaSettings::draft2020_12().into_generator();
    let mut header = Header::json_schema(&mut generator).to_value();
    let common = CaseHeader::json_schema(&mut generator).to_value();
    let kinds: Vec<Value> = crate::dispersion::case_schemas(&mut generator)
        .into_iter()
        .map(|(asks, schema)| merged_case(asks, schema.to_value(), &common))
        .collect();
    header["properties"]["case"] = serde_json::json!({
        "type": "array", "minItems": 1, "items": { "oneOf": kinds },
        "description": "What is asked. Numbers are SI; a key may instead end in another unit of its kind (dx_mm for dx_m)."
    });
    if let Some(required) = header["required"].as_array_mut() {
        required.extend(["format".into(), "case".into()]);
    }
    header["$schema"] = "https://json-schema.org/draft/2020-12/schema".into();
    header["title"] = "pd-verify study file".into();
    header["properties"]["format"] =
        serde_json::json!({ "const": FORMAT, "description": "Version of the format." });
    header["$defs"] = Value::Object(generator.take_definitions(true).into_iter().collect());
    with_units(&mut header);
    header
}

/// Adds every key's forms in other units, and lets any of them stand for a required one.
fn with_units(schema: &mut Value) {
    let required: Vec<String> = schema["required"]
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(|key| key.as_str().map(str::to_owned))
        .collect();
    let mut choices = Vec::new();
    if let Some(properties) = schema.get_mut("properties").and_then(Value::as_object_mut) {
        for (key, value) in properties.clone() {
            let forms = other_units(&key);
            if !forms.is_empty() && required.contains(&key) {
                let any: Vec<Value> = forms
                    .iter()
                    .chain([&key])
                    .map(|form| serde_json::json!({ "required": [form] }))
                    .collect();
                choices.push((key, serde_json::json!({ "anyOf": any })));
            }
            properties.extend(forms.into_iter().map(|form| (form, value.clone())));
        }
    }
    if !choices.is_empty() {
        let kept: Vec<&String> =
            required.iter().filter(|key| choices.iter().all(|(other, _)| other != *key)).collect();
        schema["required"] = serde_json::json!(kept);
        schema["allOf"] = choices.into_iter().map(|(_, choice)| choice).collect();
    }
    match schema {
        Value::Object(table) => table.values_mut().for_each(with_units),
        Value::Array(items) => items.iter_mut().for_each(with_units),
        _ => {}
    }
}

/// A case of one kind: its own keys and those of every case.
fn merged_case(asks: &str, mut schema: Value, common: &Value) -> Value {
    for (key, value) in common["properties"].as_object().into_iter().flatten() {
        schema["properties"][key] = value.clone();
    }
    schema["properties"]["asks"] = serde_json::json!({ "const": asks });
    let mut required = schema["required"].as_array().cloned().unwrap_or_default();
    required.extend(["id".into(), "asks".into()]);
    schema["required"] = Value::Array(required);
    schema
}
