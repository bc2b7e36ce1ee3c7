//! A study file as a tree of plain SI values that remembers where each of them was written.

use super::meant::meant;
use super::refusal::{Refusal, nearest};
use super::set::Setting;
use super::units::{Conversion, other_units, to_si, with_units};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::collections::HashMap;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A study larger than this is refused unread.
pub const MAX_BYTES: usize = 4 << 20;

/// Keys nested deeper than this belong to no study.
const MAX_DEPTH: usize = 32;

/// A list longer than this is a slip of the pen.
const MAX_ITEMS: usize = 100_000;

/// The text of a study, its values in SI, and where they stand.
#[derive(Debug, Clone)]
pub struct Document {
    name: String,
    text: String,
    values: Map<String, Value>,
    /// From a path such as `case[2].dx_m` to its place in the text.
    places: HashMap<String, Range<usize>>,
    /// Values changed from outside, for the manifest.
    pub settings: Vec<String>,
}

impl Document {
    /// Parses TOML; `name` is what messages call the file.
    pub fn parse(name: &str, text: &str) -> Result<Self, Refusal> {
        let table = DeTable::parse(text).map_err(|error| {
            let message = format!("{name} is not valid TOML: {}", error.message());
            Refusal::new(message).help("see https://toml.io for the format").at(name, text, error.span())
        })?;
        let mut document = Self {
            name: name.to_owned(),
            text: text.to_owned(),
            values: Map::new(),
            places: HashMap::new(),
            settings: Vec::new(),
        };
        document.values = document.table("", table.get_ref(), 0)?;
        Ok(document)
    }

    /// The file's name as given.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The text as read.
    pub fn text(&self) -> &str {
        &self.text
    }

    fn table(
        &mut self,
        path: &str,
        table: &DeTable<'_>,
        depth: usize,
    ) -> Result<Map<String, Value>, Refusal> {
        let mut values = Map::new();
        for (key, value) in table {
            let (si, conversion) = to_si(key.get_ref());
            let here = if path.is_empty() { si.clone() } else { format!("{path}.{si}") };
            if values.contains_key(&si) {
                let message = format!("{here} is given twice, in different units");
                return Err(self.refuse_span(message, key.span()).help("keep one of the two"));
            }
            self.places.insert(here.clone(), key.span().start..value.span().end.max(key.span().end));
            let value = self.value(&here, value, conversion, depth + 1)?;
            values.insert(si, value);
        }
        Ok(values)
    }

    fn value(
        &mut self,
        path: &str,
        value: &Spanned<DeValue<'_>>,
        conversion: Conversion,
        depth: usize,
    ) -> Result<Value, Refusal> {
        if depth > MAX_DEPTH {
            return Err(self.refuse_span(format!("{path} is nested too deeply"), value.span()));
        }
        match value.get_ref() {
            DeValue::String(text) => Ok(Value::String(text.clone().into_owned())),
            DeValue::Boolean(flag) => Ok(Value::Bool(*flag)),
            DeValue::Integer(number) => {
                let whole = i64::from_str_radix(number.as_str(), number.radix());
                let whole = whole.map_err(|_| {
                    self.refuse_span(format!("{path} is too large a whole number"), value.span())
                })?;
                Ok(if conversion == Conversion::NONE {
                    whole.into()
                } else {
                    conversion.apply(whole as f64).into()
                })
            }
            DeValue::Float(number) => {
                let number = number.as_str().parse::<f64>().map(|x| conversion.apply(x)).unwrap_or(f64::NAN);
                if number.is_finite() {
                    return Ok(number.into());
                }
                let message = format!("{path} must be a finite number");
                Err(self.refuse_span(message, value.span()).help("NaN and infinity are not quantities"))
            }
            DeValue::Datetime(_) => {
                Err(self.refuse_span(format!("{path} is a date, which no study asks for"), value.span()))
            }
            DeValue::Array(items) if items.len() > MAX_ITEMS => {
                let message = format!("{path} has {} values, at most {MAX_ITEMS} are read", items.len());
                Err(self.refuse_span(message, value.span()).help("shorten the list, or split the study"))
            }
            DeValue::Array(items) => {
                let mut values = Vec::new();
                for (index, item) in items.iter().enumerate() {
                    let here = format!("{path}[{index}]");
                    self.places.insert(here.clone(), item.span());
                    values.push(self.value(&here, item, conversion, depth + 1)?);
                }
                Ok(Value::Array(values))
            }
            DeValue::Table(table) => Ok(Value::Object(self.table(path, table, depth + 1)?)),
        }
    }

    /// Applies a `--set`. `Ok(false)` where this document has no such place.
    pub fn set(&mut self, setting: &Setting) -> Result<bool, Refusal> {
        let done = setting.apply(&mut self.values)?;
        if done {
            self.settings.push(setting.to_string());
        }
        Ok(done)
    }

    /// The value at a top-level key.
    pub fn get(&self, key: &str) -> Option<&Value> {
        self.values.get(key)
    }

    /// Reads the part of the document at `path` (empty for the whole) into `T`, leaving out the keys `but`.
    pub fn read<T: DeserializeOwned>(&self, path: &str, part: &Value, but: &[&str]) -> Result<T, Refusal> {
        let mut part = part.clone();
        if let Value::Object(table) = &mut part {
            for key in but {
                table.shift_remove(*key);
            }
        }
        serde_path_to_error::deserialize(part).map_err(|error| {
            let inner = error.path().to_string();
            let inner = inner.trim_start_matches('.');
            let at = match (path.is_empty(), inner.is_empty() || inner == ".") {
                (_, true) => path.to_owned(),
                (true, false) => inner.to_owned(),
                (false, false) => format!("{path}.{inner}"),
            };
            self.explain(&at, path, &error.into_inner().to_string(), but)
        })
    }

    /// The whole document as a value.
    pub fn whole(&self) -> Value {
        Value::Object(self.values.clone())
    }

    /// A refusal of the value at `path`.
    pub fn refuse(&self, path: &str, message: impl Into<String>) -> Refusal {
        // The line in the file may be right: what is wrong can stand on the command line.
        let changed = self.settings.join(", ");
        let note = if changed.is_empty() { changed } else { format!(" (changed by --set {changed})") };
        Refusal::new(message.into() + &note).at(&self.name, &self.text, self.place(path))
    }

    fn refuse_span(&self, message: String, span: Range<usize>) -> Refusal {
        Refusal::new(message).at(&self.name, &self.text, Some(span))
    }

    /// The place of a path, or of the nearest thing around it.
    fn place(&self, path: &str) -> Option<Range<usize>> {
        let mut path = path;
        loop {
            if let Some(place) = self.places.get(path) {
                return Some(self.first_line(place.clone()));
            }
            path = &path[..path.rfind(['.', '['])?];
        }
    }

    /// Long values are marked at their first line only.
    fn first_line(&self, place: Range<usize>) -> Range<usize> {
        let marked = self.text.get(place.clone()).unwrap_or_default();
        let length = marked.find('\n').unwrap_or(marked.len());
        place.start..place.start + length
    }

    /// Turns serde's words into a message with place, cause and cure; `common` keys stand in the table itself.
    fn explain(&self, at: &str, table: &str, words: &str, common: &[&str]) -> Refusal {
        let quoted: Vec<&str> = words.split('`').skip(1).step_by(2).collect();
        match (words.split(' ').next(), words.split(' ').nth(1), quoted.split_first()) {
            (Some("unknown"), Some("field"), Some((wrong, allowed))) => {
                let owner = at.strip_suffix(wrong).map_or(at, |owner| owner.trim_end_matches('.'));
                let own: &[&str] = if owner == table { common } else { &[] };
                let allowed: Vec<&str> = allowed.iter().chain(own).copied().collect();
                let place = join(if owner.is_empty() { table } else { owner }, wrong);
                let written = self.written(&place).unwrap_or(wrong);
                let help = did_you_mean(wrong, &allowed, |near| like(near, written));
                self.refuse(&place, format!("unknown key `{written}`")).help(help)
            }
            (Some("unknown"), Some("variant"), Some((wrong, allowed))) => {
                let message = format!("{at}: `{wrong}` is not one of the words known here");
                self.refuse(at, message).help(did_you_mean(wrong, allowed, str::to_owned))
            }
            (Some("missing"), _, Some((missing, _))) => {
                let owner = if at.is_empty() { self.name.as_str() } else { at };
                let help = match nearest(missing, self.keys(at)) {
                    Some(near) => format!("did you mean `{missing}` by `{near}`?"),
                    None => format!("add `{missing}`; see `pd-verify schema` for all keys"),
                };
                self.refuse(at, format!("{owner}: the key `{missing}` is missing")).help(help)
            }
            _ => {
                let subject = if at.is_empty() { self.name.as_str() } else { at };
                let help = "see `pd-verify schema` for what each key takes";
                self.refuse(at, format!("{subject}: {}", plain(words))).help(help)
            }
        }
    }

    /// A key as it stands in the file, unit and all.
    fn written(&self, path: &str) -> Option<&str> {
        let text = self.text.get(self.places.get(path)?.clone())?;
        Some(text.split(['=', ' ', '\t']).next().unwrap_or(text).trim_matches(['"', '\'']))
    }

    /// Keys written directly in a table.
    fn keys(&self, table: &str) -> impl Iterator<Item = &str> {
        let start = if table.is_empty() { String::new() } else { format!("{table}.") };
        let inside = self.places.keys().filter_map(move |path| path.strip_prefix(start.as_str()));
        inside.filter(|key| !key.contains(['.', '[']))
    }
}

fn did_you_mean(wrong: &str, allowed: &[&str], as_written: impl Fn(&str) -> String) -> String {
    let all: Vec<String> = allowed.iter().map(|key| with_units(key)).collect();
    let listed = format!("allowed: {}", all.join(", "));
    if let Some((word, advice)) = meant(wrong, allowed) {
        return format!("{}; {listed}", advice.replacen(word, &as_written(word), 1));
    }
    match nearest(wrong, allowed.iter().copied()) {
        Some(word) => format!("did you mean `{}`? {listed}", as_written(word)),
        None => listed,
    }
}

/// A key in the unit of another: `youngs_modulus_pa` like `young_modulus_gpa` is `youngs_modulus_gpa`, and so it is like
/// `youngs_modulus_gp`, whose unit is misspelt.
fn like(key: &str, written: &str) -> String {
    let unit = written.rfind('_').map_or("", |at| &written[at..]);
    let stem = key.rfind('_').map_or(key, |at| &key[..at]);
    let other = format!("{stem}{unit}");
    if to_si(&other).0 == key {
        return other;
    }
    let forms = other_units(key);
    let near = nearest(written, forms.iter().map(String::as_str).chain([key]));
    near.unwrap_or(key).to_owned()
}

/// serde's words without the names of Rust.
fn plain(words: &str) -> String {
    let (found, expected) = words.split_once(", expected ").unwrap_or((words, ""));
    if expected.is_empty() {
        return words.to_owned();
    }
    let expected = match expected.split(' ').next().unwrap_or_default() {
        "f64" => "a number",
        "u64" => "a whole number, 0 or larger",
        "enum" => "a word",
        "struct" => "a table",
        "a" if expected == "a string" => "a text",
        "a" if expected == "a boolean" => "true or false",
        "a" if expected == "a sequence" => "a list",
        _ => expected,
    };
    let found = found.trim_start_matches("invalid type: ").trim_start_matches("invalid value: ");
    let found = found.replace("floating point", "the number").replace("integer", "the number");
    let found = found.replace("string", "the text").replace("boolean", "the value");
    let found = match found.as_str() {
        "sequence" => "a list".to_owned(),
        "map" => "a table".to_owned(),
        _ => found,
    };
    format!("{found} is not allowed, {expected} is needed")
}

fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_become_si_and_places_are_kept() {
        let text = "a_mm = [1, 2.5]\n[t]\nb_gpa = 3\n";
        let document = Document::parse("x.toml", text).unwrap();
        assert_eq!(document.get("a_m").unwrap(), &serde_json::json!([0.001, 0.0025]));
        assert_eq!(document.get("t").unwrap()["b_pa"], serde_json::json!(3e9));
        assert_eq!(&text[document.place("t.b_pa").unwrap()], "b_gpa = 3");
        assert_eq!(&text[document.place("a_m[1]").unwrap()], "2.5");
    }

    #[test]
    fn what_is_not_a_quantity_is_refused() {
        for text in [
            "a = nan",
            "a = -inf",
            "a = 1e400",
            "a = 1979-05-27",
            "a_m = 1\na_mm = 1000",
            "a = [",
            "a = 99999999999999999999",
        ] {
            assert!(Document::parse("x.toml", text).is_err(), "{text}");
        }
    }
}
