//! A positive quantity as it stands in a file.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer};
use std::borrow::Cow;

/// A number above zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Positive(pub f64);

impl<'de> Deserialize<'de> for Positive {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = f64::deserialize(deserializer)?;
        if !(value.is_finite() && value > 0.0) {
            return Err(de::Error::custom(format!("{value} is not allowed, a positive number is needed")));
        }
        if !(1e-30..=1e30).contains(&value) {
            return Err(de::Error::custom(format!(
                "{value:e} is no quantity: it is not between 1e-30 and 1e30"
            )));
        }
        Ok(Self(value))
    }
}

impl JsonSchema for Positive {
    fn schema_name() -> Cow<'static, str> {
        "Positive".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "number", "exclusiveMinimum": 0 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{from_value, json};

    #[test]
    fn only_positive_numbers_are_positive() {
        for value in [json!(0), json!(-1e-300), json!(1e-31), json!(1e31), json!("1")] {
            assert!(from_value::<Positive>(value).is_err());
        }
        assert_eq!(from_value::<Positive>(json!(1e-30)).unwrap(), Positive(1e-30));
    }
}
