//! Cases as written: what a case is read from, and the words that turn what is written into a question.

use crate::input::{Document, Refusal};
use crate::question::Question;
use pd_verify::material::Material;
use pd_verify::scene::Wrong;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::DeserializeOwned;
use serde_json::Value;

/// Keys that every case has beside its own.
pub const COMMON_KEYS: [&str; 4] = ["id", "asks", "title", "profile"];

/// What a case is read from.
pub struct Written<'a> {
    pub document: &'a Document,
    /// `case[3]`, for messages.
    pub path: String,
    pub value: &'a Value,
    pub title: &'a str,
    pub material: Option<Material>,
}

impl Written<'_> {
    /// The material of the study, or what to add.
    pub fn material(&self) -> Result<Material, Wrong> {
        self.material.ok_or_else(|| {
            let help = "add a [material] table with youngs_modulus_pa and density_kg_m3";
            Wrong::new("", "this case needs the material of its body", help)
        })
    }

    /// The refusal of what is wrong, at its place in the file.
    pub fn refuse(&self, wrong: Wrong) -> Refusal {
        let wrong = wrong.inside(&self.path);
        self.document.refuse(&wrong.key, wrong.message).help(wrong.help)
    }
}

/// A case as written; its fields are the keys of the case beside the common ones.
pub trait Asked: DeserializeOwned + JsonSchema {
    type Question: Question + 'static;

    /// Reads those parts of the case whose keys depend on a word in them; each refusal points at its line.
    fn read_parts(&mut self, _: &Written<'_>) -> Result<(), Refusal> {
        Ok(())
    }

    /// The question that is asked, or what is wrong with it. Computes nothing that takes time.
    fn check(&self, written: &Written<'_>) -> Result<Self::Question, Wrong>;
}

/// A word that a case may ask: a row in the table of its kind.
pub struct Word {
    pub name: &'static str,
    /// Whether messages offer it; what only the shipped studies need is not offered.
    pub offered: bool,
    /// Whether its figures all have more in their names than the case's id: such a case may be called like a table.
    pub suffixes_all_figures: bool,
    read: fn(&Written<'_>) -> Result<Box<dyn Question>, Refusal>,
    schema: fn(&mut SchemaGenerator) -> Schema,
}

impl Word {
    /// The word `name`, which asks what `A` says.
    pub const fn of<A: Asked>(name: &'static str) -> Self {
        Self { name, offered: true, suffixes_all_figures: false, read: read::<A>, schema: A::json_schema }
    }

    /// The same word, kept out of messages.
    pub const fn not_offered(self) -> Self {
        Self { offered: false, ..self }
    }

    /// The same word, whose figures are all called like the case with more behind.
    pub const fn all_figures_suffixed(self) -> Self {
        Self { suffixes_all_figures: true, ..self }
    }

    /// Turns a case into its question, or says what is wrong with it.
    pub fn read(&self, written: &Written<'_>) -> Result<Box<dyn Question>, Refusal> {
        (self.read)(written)
    }

    /// The schema of the case's own keys.
    pub fn schema(&self, generator: &mut SchemaGenerator) -> Schema {
        (self.schema)(generator)
    }
}

fn read<A: Asked>(written: &Written<'_>) -> Result<Box<dyn Question>, Refusal> {
    let mut asked: A = written.document.read(&written.path, written.value, &COMMON_KEYS)?;
    asked.read_parts(written)?;
    match asked.check(written) {
        Ok(question) => Ok(Box::new(question)),
        Err(wrong) => Err(written.refuse(wrong)),
    }
}
