//! The JSON schema of study files, put together from what each kind of study says of itself.

use crate::input::other_units;
use crate::kind::Kind;
use crate::study::{CaseHeader, FORMAT, Header};
use schemars::JsonSchema;
use schemars::generate::{SchemaGenerator, SchemaSettings};
use serde_json::{Value, json};

/// The JSON schema of study files.
///
/// `properties.case` knows every word of every kind; the `oneOf` at the top says in full what the cases of a kind are.
pub fn schema() -> Value {
    let mut generator = SchemaSettings::draft2020_12().into_generator();
    let mut schema = Header::json_schema(&mut generator).to_value();
    let common = CaseHeader::json_schema(&mut generator).to_value();
    // A kind without words has no studies, and an empty list would be no schema.
    let kinds = || Kind::ALL.into_iter().filter(|kind| !kind.words().is_empty());
    schema["properties"]["case"] = json!({
        "type": "array", "minItems": 1, "items": { "oneOf": words(kinds()) },
        "description": "What is asked. Numbers are SI; a key may instead end in another unit of its kind (dx_mm for dx_m)."
    });
    schema["oneOf"] = kinds().map(|kind| cases_of(kind, &common, &mut generator)).collect();
    if let Some(required) = schema["required"].as_array_mut() {
        required.extend(["format".into(), "case".into()]);
    }
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema".into();
    schema["title"] = "pd-verify study file".into();
    schema["properties"]["format"] = json!({ "const": FORMAT, "description": "Version of the format." });
    schema["$defs"] = Value::Object(generator.take_definitions(true).into_iter().collect());
    with_units(&mut schema);
    schema
}

/// Every word that a case of some kind may ask, each once.
fn words(kinds: impl Iterator<Item = Kind>) -> Vec<Value> {
    let mut names: Vec<&str> = Vec::new();
    for word in kinds.flat_map(Kind::words) {
        if !names.contains(&word.name) {
            names.push(word.name);
        }
    }
    names.into_iter().map(|name| json!({ "properties": { "asks": { "const": name } } })).collect()
}

/// A study of one kind: what its cases are.
fn cases_of(kind: Kind, common: &Value, generator: &mut SchemaGenerator) -> Value {
    let cases: Vec<Value> = kind
        .words()
        .iter()
        .map(|word| merged_case(word.name, word.schema(generator).to_value(), common))
        .collect();
    json!({
        "title": format!("a {} study", kind.word()),
        "properties": { "kind": { "const": kind.word() }, "case": { "items": { "oneOf": cases } } },
    })
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
                let any: Vec<Value> =
                    forms.iter().chain([&key]).map(|form| json!({ "required": [form] })).collect();
                choices.push((key, json!({ "anyOf": any })));
            }
            properties.extend(forms.into_iter().map(|form| (form, value.clone())));
        }
    }
    if !choices.is_empty() {
        let kept: Vec<&String> =
            required.iter().filter(|key| choices.iter().all(|(other, _)| other != *key)).collect();
        schema["required"] = json!(kept);
        schema["allOf"] = choices.into_iter().map(|(_, choice)| choice).collect();
    }
    match schema {
        Value::Object(table) => table.values_mut().for_each(with_units),
        Value::Array(items) => items.iter_mut().for_each(with_units),
        _ => {}
    }
}

/// A case that asks one word: its own keys and those of every case.
fn merged_case(asks: &str, mut schema: Value, common: &Value) -> Value {
    for (key, value) in common["properties"].as_object().into_iter().flatten() {
        schema["properties"][key] = value.clone();
    }
    schema["properties"]["asks"] = json!({ "const": asks });
    let mut required = schema["required"].as_array().cloned().unwrap_or_default();
    required.extend(["id".into(), "asks".into()]);
    schema["required"] = Value::Array(required);
    schema
}
