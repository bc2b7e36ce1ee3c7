//! Numbers in JSON without loss: all digits, and words for what JSON has no number for: `"nan"`, `"inf"`, `"-inf"`.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

/// A number as it stands in JSON. Every finite f64 comes back with the same bits; of NaNs there is one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exact(pub f64);

impl Serialize for Exact {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            x if x.is_nan() => serializer.serialize_str("nan"),
            f64::INFINITY => serializer.serialize_str("inf"),
            f64::NEG_INFINITY => serializer.serialize_str("-inf"),
            x => serializer.serialize_f64(x),
        }
    }
}

struct ExactVisitor;

impl Visitor<'_> for ExactVisitor {
    type Value = Exact;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, \"nan\", \"inf\" or \"-inf\"")
    }

    fn visit_f64<E: de::Error>(self, x: f64) -> Result<Exact, E> {
        Ok(Exact(x))
    }

    fn visit_u64<E: de::Error>(self, x: u64) -> Result<Exact, E> {
        Ok(Exact(x as f64))
    }

    fn visit_i64<E: de::Error>(self, x: i64) -> Result<Exact, E> {
        Ok(Exact(x as f64))
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Exact, E> {
        match word {
            "nan" => Ok(Exact(f64::NAN)),
            "inf" => Ok(Exact(f64::INFINITY)),
            "-inf" => Ok(Exact(f64::NEG_INFINITY)),
            other => Err(E::invalid_value(de::Unexpected::Str(other), &self)),
        }
    }
}

impl<'de> Deserialize<'de> for Exact {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ExactVisitor)
    }
}

impl JsonSchema for Exact {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Exact".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [{ "type": "number" }, { "enum": ["nan", "inf", "-inf"] }] })
    }
}

/// For fields that are numbers: `#[serde(with = "exact::number")]`.
pub mod number {
    use super::*;

    #[allow(missing_docs)]
    pub fn serialize<S: Serializer>(x: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        Exact(*x).serialize(serializer)
    }

    #[allow(missing_docs)]
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Exact::deserialize(deserializer).map(|Exact(x)| x)
    }
}

/// For fields that may be unknown: `null`, which is another thing than `"nan"`.
pub mod option {
    use super::*;

    #[allow(missing_docs)]
    pub fn serialize<S: Serializer>(x: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
        x.map(Exact).serialize(serializer)
    }

    #[allow(missing_docs)]
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
        Ok(Option::<Exact>::deserialize(deserializer)?.map(|Exact(x)| x))
    }
}

/// For intervals that may be unknown.
pub mod interval {
    use super::*;

    #[allow(missing_docs)]
    pub fn serialize<S: Serializer>(ends: &Option<(f64, f64)>, serializer: S) -> Result<S::Ok, S::Error> {
        ends.map(|(low, high)| (Exact(low), Exact(high))).serialize(serializer)
    }

    #[allow(missing_docs)]
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<(f64, f64)>, D::Error> {
        let ends = Option::<(Exact, Exact)>::deserialize(deserializer)?;
        Ok(ends.map(|(Exact(low), Exact(high))| (low, high)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn through(x: f64) -> f64 {
        serde_json::from_str::<Exact>(&serde_json::to_string(&Exact(x)).unwrap()).unwrap().0
    }

    /// 5e-324 is the least number, 1.7976931348623157e308 the largest; the others are hard to read back.
    #[test]
    fn every_number_comes_back_with_its_bits() {
        let hard = [9.5367431640625e-7, 2.2250738585072014e-308, 2.225073858507201e-308, 8.41e21];
        for x in [0.0, -0.0, 5.0, 0.1, 5e-324, f64::MAX, f64::MIN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(through(x).to_bits(), x.to_bits(), "{x:e}");
        }
        assert!(hard.into_iter().all(|x| through(x).to_bits() == x.to_bits()));
        assert!(through(f64::NAN).is_nan());
        let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
        for _ in 0..20_000 {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let x = f64::from_bits(bits);
            assert!(x.is_nan() || through(x).to_bits() == bits, "{x:e}");
        }
    }

    #[test]
    fn unknown_is_not_nan() {
        #[derive(Serialize, Deserialize)]
        struct One(#[serde(with = "option")] Option<f64>);
        let text = |x| serde_json::to_string(&One(x)).unwrap();
        assert_eq!([text(None), text(Some(f64::NAN))], ["null", "\"nan\""]);
        assert!(serde_json::from_str::<One>("\"NaN?\"").is_err());
        assert!(serde_json::from_str::<One>("null").unwrap().0.is_none());
    }
}
