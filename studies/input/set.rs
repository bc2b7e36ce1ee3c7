//! `--set dotted.path=value`: one value of a study changed from the command line.

use super::refusal::Refusal;
use super::units::to_si;
use serde_json::{Map, Value};
use std::fmt;
use toml::de::DeTable;

/// A change asked for on the command line.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    path: Vec<String>,
    value: Value,
    written: String,
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.written)
    }
}

impl Setting {
    /// Reads `path=value`; the value is TOML, a bare word is text.
    pub fn parse(written: &str) -> Result<Self, Refusal> {
        let wrong = || {
            Refusal::new(format!("--set {written}: expected dotted.path=value"))
                .help("for example --set material.density_kg_m3=2700 or --set case.mine.curve.0.m=5")
        };
        let (path, value) = written.split_once('=').ok_or_else(wrong)?;
        let mut path: Vec<String> = path.trim().split('.').map(str::to_owned).collect();
        if path.iter().any(String::is_empty) || value.trim().is_empty() {
            return Err(wrong());
        }
        let last = path.pop().expect("split gives at least one part");
        let value = value.trim();
        let text = format!("{last} = {value}");
        // A bare word is text; what begins like a list, a table or a text must be one.
        let bare = DeTable::parse(&text).is_err() && !value.starts_with(['[', '{', '"', '\'']);
        let text = if bare { format!("{last} = {}", Value::from(value)) } else { text };
        let document = super::Document::parse("--set", &text)?;
        let (last, _) = to_si(&last);
        if document.whole().as_object().is_none_or(|table| table.len() != 1) {
            return Err(wrong());
        }
        let value = document.get(&last).cloned().ok_or_else(wrong)?;
        path.push(last);
        Ok(Self { path, value, written: written.to_owned() })
    }

    /// Changes the value; lists are entered by position or by the `id` of their items.
    ///
    /// `Ok(false)` where the table that should hold the key does not exist.
    pub fn apply(&self, values: &mut Map<String, Value>) -> Result<bool, Refusal> {
        let (last, way) = self.path.split_last().expect("a path has a last part");
        let Some((first, rest)) = way.split_first() else {
            return Ok(Self::put(values, last, &self.value));
        };
        let Some(mut here) = values.get_mut(first) else { return Ok(false) };
        for part in rest {
            match step(here, part) {
                Some(next) => here = next,
                None => return Ok(false),
            }
        }
        match here {
            Value::Object(table) => Ok(Self::put(table, last, &self.value)),
            Value::Array(items) => {
                let slot = last.parse::<usize>().ok().and_then(|index| items.get_mut(index));
                Ok(slot.map(|slot| *slot = self.value.clone()).is_some())
            }
            _ => Ok(false),
        }
    }

    fn put(table: &mut Map<String, Value>, key: &str, value: &Value) -> bool {
        table.insert(key.to_owned(), value.clone());
        true
    }
}

fn step<'a>(here: &'a mut Value, part: &str) -> Option<&'a mut Value> {
    match here {
        Value::Object(table) => table.get_mut(part),
        Value::Array(items) => match part.parse::<usize>() {
            Ok(index) => items.get_mut(index),
            Err(_) => items.iter_mut().find(|item| item.get("id").and_then(Value::as_str) == Some(part)),
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn table() -> Map<String, Value> {
        let value = json!({ "material": { "density_kg_m3": 1 }, "case": [{ "id": "a", "m": [1, 2] }] });
        value.as_object().unwrap().clone()
    }

    #[test]
    fn values_are_typed_and_found_by_id_or_position() {
        let mut values = table();
        for (written, path, expected) in [
            ("material.density_kg_m3=2700", "/material/density_kg_m3", json!(2700)),
            ("material.density_g_cm3=2.5", "/material/density_kg_m3", json!(2500.0)),
            ("case.a.m.1=7.3", "/case/0/m/1", json!(7.3)),
            ("case.0.m=[3, 4]", "/case/0/m", json!([3, 4])),
            ("case.a.kernel=gaussian", "/case/0/kernel", json!("gaussian")),
        ] {
            assert!(Setting::parse(written).unwrap().apply(&mut values).unwrap(), "{written}");
            assert_eq!(Value::Object(values.clone()).pointer(path), Some(&expected), "{written}");
        }
    }

    #[test]
    fn unknown_places_and_malformed_settings_are_told_apart() {
        assert!(!Setting::parse("matreial.x=1").unwrap().apply(&mut table()).unwrap());
        assert!(!Setting::parse("case.b.m=1").unwrap().apply(&mut table()).unwrap());
        for written in ["novalue", "=3", "a..b=1", "a=", "a=nan"] {
            assert!(Setting::parse(written).is_err(), "{written}");
        }
    }
}
