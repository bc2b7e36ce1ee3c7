//! The effects that a scene may call for, by word: a row here is all that a new effect needs outside its own file.

use crate::input::{Refusal, nearest};
use crate::written::Written;
use pd_verify::constraints::PrescribedMotion;
use pd_verify::forces::{BodyForce, Damping, FaceTraction, Traction};
use pd_verify::scene::Effect;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::borrow::Cow;
use std::sync::Arc;

/// Every effect.
pub const EFFECTS: &[EffectWord] = &[
    EffectWord::of::<BodyForce>("body_force"),
    EffectWord::of::<Traction>("traction"),
    EffectWord::of::<FaceTraction>("face_traction"),
    EffectWord::of::<PrescribedMotion>("prescribed_motion"),
    EffectWord::of::<Damping>("damping"),
];

/// The names of all effects in plans: their words, with blanks.
pub fn names() -> impl Iterator<Item = String> {
    EFFECTS.iter().map(|effect| effect.word.replace('_', " "))
}

/// The key that names the effect.
const ACTS: &str = "acts";

/// An effect ready to act on a bar or on a plate.
#[derive(Debug, Clone)]
pub struct Acting {
    pub on_bar: Arc<dyn Effect<1>>,
    pub on_plate: Arc<dyn Effect<2>>,
}

/// A word that `acts` may have.
pub struct EffectWord {
    pub word: &'static str,
    read: fn(&Written<'_>, &str, &Value) -> Result<Acting, Refusal>,
    schema: fn(&mut SchemaGenerator) -> Schema,
}

impl EffectWord {
    /// The word for an effect whose keys are the fields of `E`.
    const fn of<E>(word: &'static str) -> Self
    where
        E: DeserializeOwned + JsonSchema + Effect<1> + Effect<2> + 'static,
    {
        Self { word, read: read::<E>, schema: E::json_schema }
    }
}

fn read<E>(written: &Written<'_>, path: &str, value: &Value) -> Result<Acting, Refusal>
where
    E: DeserializeOwned + Effect<1> + Effect<2> + 'static,
{
    let effect = Arc::new(written.document.read::<E>(path, value, &[ACTS])?);
    Ok(Acting { on_bar: effect.clone(), on_plate: effect })
}

/// An effect as it stands in a case: a table whose other keys depend on its word.
#[derive(Debug, Clone, Deserialize)]
#[serde(transparent)]
pub struct EffectAsked {
    written: Value,
    #[serde(skip)]
    acting: Option<Acting>,
}

impl EffectAsked {
    /// Reads the effect by its word; `index` counts the effects of the case.
    pub fn read(&mut self, written: &Written<'_>, index: usize) -> Result<(), Refusal> {
        let path = format!("{}.effect[{index}]", written.path);
        let words: Vec<&str> = EFFECTS.iter().map(|effect| effect.word).collect();
        let listed = format!("an effect is one of: {}", words.join(", "));
        let refuse =
            |at: &str, message: String, help: String| Err(written.document.refuse(at, message).help(help));
        let acts = match self.written.get(ACTS) {
            Some(Value::String(word)) => word,
            Some(_) => {
                return refuse(&format!("{path}.{ACTS}"), format!("{path}.{ACTS} must be a word"), listed);
            }
            None => return refuse(&path, format!("{path}: the key `{ACTS}` is missing"), listed),
        };
        let Some(effect) = EFFECTS.iter().find(|effect| effect.word == acts) else {
            let help = match nearest(acts, words) {
                Some(near) => format!("did you mean \"{near}\"? {listed}"),
                None => listed,
            };
            return refuse(&format!("{path}.{ACTS}"), format!("nothing acts as \"{acts}\""), help);
        };
        self.acting = Some((effect.read)(written, &path, &self.written)?);
        Ok(())
    }

    /// The effect, once it has been read.
    pub fn acting(&self) -> Option<&Acting> {
        self.acting.as_ref()
    }
}

impl JsonSchema for EffectAsked {
    fn schema_name() -> Cow<'static, str> {
        "Effect".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let one = |effect: &EffectWord| {
            let mut schema = (effect.schema)(generator).to_value();
            schema["properties"][ACTS] = json!({ "const": effect.word });
            let mut required = schema["required"].as_array().cloned().unwrap_or_default();
            required.push(ACTS.into());
            schema["required"] = Value::Array(required);
            schema
        };
        let all: Vec<Value> = EFFECTS.iter().map(one).collect();
        json_schema!({ "oneOf": all })
    }
}
