//! A study: a question with a file. Its header, its cases, and the checks that need no computation.

use crate::input::{Document, Refusal, Setting};
use crate::kind::Kind;
use crate::question::{Effort, Place, Profile, Question};
use crate::written::{COMMON_KEYS, Written};
use pd_verify::claim::Claim;
use pd_verify::material::Material;
use pd_verify::scene::Positive;
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;
use std::collections::HashSet;

/// The version of the format that this program reads.
pub const FORMAT: u64 = 1;

/// The head of a study file.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Header {
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
pub struct CaseHeader {
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
    pub material: Option<Material>,
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
        let cases = read_cases(&document, &header, material, ratio)?;
        let Header { id, kind, title, about, source, .. } = header;
        let (about, source) = (about.unwrap_or_default(), source.unwrap_or_default());
        Ok(Self { id, kind, title, about, source, material, document, cases })
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

/// A case's figure is called like the case and has a CSV of that name; it must not take the place of a table.
fn check_figure_name(document: &Document, kind: Kind, path: &str, case: &CaseHeader) -> Result<(), Refusal> {
    let id = case.id.as_str();
    if !kind.tables().contains(&id) || kind.suffixes_all_figures(&case.asks) {
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

fn read_cases(
    document: &Document,
    study: &Header,
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
        let other = study.kind.suffixes().iter().find_map(|suffix| case.place.case.strip_suffix(suffix));
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
    study: &Header,
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
    check_figure_name(document, study.kind, &format!("{path}.id"), &header)?;
    let title = header.title.unwrap_or_else(|| header.id.clone());
    let written = Written { document, path, value, title: &title, material };
    let question = study.kind.read_case(&header.asks, &written)?;
    let place = Place { study: study.id.clone(), case: header.id };
    let profile = header.profile.unwrap_or(Profile::Quick);
    Ok(Case { place, title, asks: header.asks, profile, question })
}
