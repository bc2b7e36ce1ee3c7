//! Chance with a seed: studies made from the schema's keys, shipped cases with other values, and texts with pieces moved.

use crate::input::other_units;
use crate::shipped::SHIPPED;
use serde_json::{Map, Value, json};
use std::sync::LazyLock;

static SCHEMA: LazyLock<Value> = LazyLock::new(crate::schema::schema);

/// Head and one case each, of every shipped study.
static CASES: LazyLock<Vec<Value>> = LazyLock::new(|| {
    let mut cases = Vec::new();
    for (_, text) in SHIPPED {
        let whole: Value = toml::from_str(text).expect("a shipped study is TOML");
        for case in whole["case"].as_array().into_iter().flatten() {
            let mut one = whole.clone();
            one["case"] = json!([case]);
            cases.push(one);
        }
    }
    cases
});

/// Numbers at the limits of what can be written, and others that lie about the usual ones.
const NUMBERS: &[f64] = &[
    0.0,
    -0.0,
    -1.0,
    1.0,
    2.0,
    3.0,
    0.5,
    0.1,
    0.01,
    1e-3,
    1e-6,
    10.0,
    100.0,
    1e4,
    1e6,
    1e9,
    1e12,
    1e18,
    1e30,
    1e-12,
    1e-30,
    1e-31,
    1e31,
    1e300,
    1e-300,
    5e-324,
    f64::MAX,
    f64::MIN_POSITIVE,
    1.0 + f64::EPSILON,
];
const WHOLE: &[i64] =
    &[0, 1, -1, 2, 3, 4, 10, 100, 1000, 100_000, 1 << 31, 1 << 32, 1 << 53, i64::MAX, i64::MIN];
const WORDS: &[&str] = &["", "x", "a-b", "../x", "é𝛿\u{202e}", "nan", "verdicts", "a b", "case[0]"];

/// SplitMix64 (Steele, Lea & Flood 2014).
pub struct Chance(pub u64);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count.max(1) as u64) as usize
    }

    fn pick<'a, T: ?Sized>(&mut self, all: &'a [&'a T]) -> &'a T {
        all[self.below(all.len())]
    }

    /// True so many times in a hundred.
    fn in_hundred(&mut self, times: usize) -> bool {
        self.below(100) < times
    }

    /// A study of one or two cases with the schema's keys and values of chance.
    pub fn study_of_the_schema(&mut self) -> Value {
        let kinds = SCHEMA["oneOf"].as_array().expect("kinds");
        let kind = &kinds[self.below(kinds.len())];
        let words = kind["properties"]["case"]["items"]["oneOf"].as_array().expect("words");
        let mut study = self.value(&json!({ "$ref": "#/$defs/MaterialAsked" }), 0);
        study = json!({ "format": 1, "id": "chance", "title": "t", "material": study });
        study["kind"] = kind["properties"]["kind"]["const"].clone();
        let cases = (0..1 + self.below(2)).map(|n| {
            let word = self.below(words.len());
            let mut case = self.value(&words[word], 0);
            case["id"] = format!("c{n}").into();
            case
        });
        study["case"] = Value::Array(cases.collect());
        study
    }

    /// A value that a schema allows, as far as it says.
    fn value(&mut self, schema: &Value, depth: usize) -> Value {
        if let Some(name) = schema["$ref"].as_str().and_then(|path| path.rsplit('/').next()) {
            return self.value(&SCHEMA["$defs"][name], depth + 1);
        }
        if !schema["const"].is_null() {
            return schema["const"].clone();
        }
        for key in ["enum", "anyOf", "oneOf"] {
            let Some(choices) = schema[key].as_array() else { continue };
            let some: Vec<&Value> = choices.iter().filter(|choice| choice["type"] != "null").collect();
            let choice = some[self.below(some.len())];
            if key == "enum" {
                return choice.clone();
            }
            let mut value = self.value(choice, depth + 1);
            if let (Value::Object(more), Value::Object(own)) = (self.table(schema, depth), &mut value) {
                own.extend(more);
            }
            return value;
        }
        let of = match &schema["type"] {
            Value::Array(types) => types[0].as_str(),
            one => one.as_str(),
        };
        match of {
            Some("integer") => WHOLE[self.below(WHOLE.len())].into(),
            Some("number") if self.in_hundred(30) => NUMBERS[self.below(NUMBERS.len())].into(),
            Some("number") => (self.below(4000) as f64 / 1000.0 + 0.001).into(),
            Some("boolean") => self.in_hundred(50).into(),
            Some("string") => (*self.pick(&[&"a", &WORDS[self.0 as usize % WORDS.len()]])).into(),
            Some("array") => self.list(schema, depth),
            _ => self.table(schema, depth),
        }
    }

    fn list(&mut self, schema: &Value, depth: usize) -> Value {
        if let Some(items) = schema["prefixItems"].as_array() {
            return items.iter().map(|item| self.value(item, depth + 1)).collect();
        }
        let fewest = schema["minItems"].as_u64().unwrap_or(0) as usize;
        let more = if self.in_hundred(5) { 60 } else { 3 };
        (0..fewest + self.below(more)).map(|_| self.value(&schema["items"], depth + 1)).collect()
    }

    fn table(&mut self, schema: &Value, depth: usize) -> Value {
        let mut table = Map::new();
        let required = schema.to_string();
        let Some(properties) = schema["properties"].as_object() else { return Value::Object(table) };
        let in_other_units: Vec<String> = properties.keys().flat_map(|key| other_units(key)).collect();
        for (key, value) in properties.iter().filter(|(key, _)| !in_other_units.contains(key)) {
            let needed = required.contains(&format!("\"required\":[\"{key}\""))
                || schema["required"].as_array().is_some_and(|all| all.iter().any(|one| one == key));
            if self.in_hundred(if needed { 99 } else { 25 }) && depth < 12 {
                table.insert(key.clone(), self.value(value, depth + 1));
            }
        }
        Value::Object(table)
    }

    /// A shipped case with up to three of its values changed, taken away or written again.
    pub fn shipped_case(&mut self) -> Value {
        let mut study = CASES[self.below(CASES.len())].clone();
        for _ in 0..1 + self.below(3) {
            self.change(&mut study["case"][0]);
        }
        study
    }

    fn change(&mut self, value: &mut Value) {
        let stop = self.in_hundred(15);
        match value {
            Value::Object(table) if !table.is_empty() => {
                let key = table.keys().nth(self.below(table.len())).cloned().unwrap_or_default();
                if stop && key != "asks" {
                    table.shift_remove(&key);
                } else if key != "asks" && key != "id" {
                    self.change(&mut table[&key]);
                }
            }
            Value::Array(items) if !items.is_empty() => {
                let at = self.below(items.len());
                if stop {
                    let again = items[at].clone();
                    items.extend(vec![again; 1 + self.below(50)]);
                } else {
                    self.change(&mut items[at]);
                }
            }
            Value::Number(number) => {
                let factor = [0.1, 0.5, 0.999, 1.1, 2.0, 10.0, 1000.0][self.below(7)];
                *value = match (number.as_f64(), self.in_hundred(50)) {
                    (Some(was), true) if was.fract() != 0.0 => (was * factor).into(),
                    (Some(was), true) => ((was * factor) as i64).into(),
                    _ if self.in_hundred(50) => WHOLE[self.below(WHOLE.len())].into(),
                    _ => NUMBERS[self.below(NUMBERS.len())].into(),
                };
            }
            Value::Bool(flag) => *flag = !*flag,
            other => *other = WORDS[self.below(WORDS.len())].into(),
        }
    }

    /// The text of a shipped study with a piece cut out, moved, written twice, or replaced by what texts break at.
    pub fn mutated(&mut self) -> String {
        const PIECES: &[&str] = &[
            "\u{feff}",
            "\r\n",
            "\0",
            "\"\"\"",
            "[[",
            "]]",
            "= =",
            "\u{2028}",
            "nan",
            "-inf",
            "1e999",
            "0x",
            "{",
            "}",
            "[case]",
            "#",
            "\u{7f}",
            "9223372036854775808",
            "''",
            "\\u{110000}",
            "1979-05-27",
        ];
        let mut text = toml::to_string(&CASES[self.below(CASES.len())]).expect("a case is TOML");
        for _ in 0..1 + self.below(3) {
            let (from, to) = (self.boundary(&text), self.boundary(&text));
            let (from, to) = (from.min(to), from.max(to).min(from.min(to) + self.below(40)));
            let to = (to..=text.len()).find(|&at| text.is_char_boundary(at)).unwrap_or(text.len());
            let piece = text[from..to].to_owned();
            match self.below(4) {
                0 => text.replace_range(from..to, ""),
                1 => text.replace_range(from..to, PIECES[self.below(PIECES.len())]),
                2 => text.insert_str(from, PIECES[self.below(PIECES.len())]),
                _ => {
                    let at = self.boundary(&text);
                    text.insert_str(at, &piece);
                }
            }
        }
        text
    }

    fn boundary(&mut self, text: &str) -> usize {
        let at = self.below(text.len() + 1);
        (at..=text.len()).find(|&at| text.is_char_boundary(at)).unwrap_or(text.len())
    }
}
