//! Results that another code produced: what a case asks of them, how they are read, and how they are judged.
//!
//! A file → cells (`text`, `npy`) → columns in SI (`columns`, `unit`) → a case's own judgement (`Foreign`), by the same
//! references and bounds as our results, with a likely cause where it fails (`suspects`).

mod columns;
mod npy;
mod refinement;
mod source;
mod suspects;
#[cfg(test)]
mod tests;
mod text;
mod unit;
mod view;
mod window;

pub use columns::{Asked, Data, Keys, Wanted, found, read};
pub use refinement::Refinement;
pub use source::{Delimiter, Source};
pub use suspects::{Suspect, likely, scaled};
pub use view::View;
pub use window::covers;

use crate::question::{Answer, Effort, Place, Question};
use crate::subject::Subject;
use pd_verify::claim::Claim;

/// One kind of result of a case that another code may bring: a history, a curve, a table of errors, a field.
pub trait Foreign {
    /// Unique in the case; chosen by `--as`.
    fn name(&self) -> String;
    /// What is reported, in a sentence.
    fn what(&self) -> String;
    /// The columns, in the order in which a file without a header has them.
    fn wanted(&self) -> Vec<Wanted>;
    /// What tells rows apart.
    fn keys(&self) -> Keys;
    /// The problem, neutral of any solver: a heading and what stands under it.
    fn problem(&self) -> Vec<(&'static str, String)>;
    /// What is claimed of the data, with every bound and its reason.
    fn claims(&self, place: &Place) -> Vec<Claim>;
    /// Holds the data against the reference.
    fn judge(&self, data: &Data, place: &Place) -> Answer;
    /// What a code without error would report: the wanted columns, in SI.
    fn reference(&self) -> Vec<Vec<f64>>;
    /// Results of known mistakes, which must be rejected.
    fn mistakes(&self) -> Vec<Mistake> {
        Vec::new()
    }
}

/// A result that is known to be wrong.
pub struct Mistake {
    pub what: &'static str,
    /// The wanted columns.
    pub columns: Vec<Vec<f64>>,
    /// What the note must say of it; empty where no cause can be told from the data.
    pub cause: &'static str,
}

/// A case whose answer is read from a file in place of being computed.
pub struct Brought {
    question: Box<dyn Question>,
    /// Which of its kinds.
    form: usize,
    data: Data,
}

impl Brought {
    pub fn new(question: Box<dyn Question>, form: usize, data: Data) -> Self {
        Self { question, form, data }
    }
}

impl Question for Brought {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        self.question.foreign().get(self.form).map(|form| form.claims(place)).unwrap_or_default()
    }

    fn effort(&self) -> Effort {
        Effort::default()
    }

    fn equations(&self) -> &'static str {
        self.question.equations()
    }

    fn answer(&self, _: &dyn Subject, place: &Place) -> Answer {
        let forms = self.question.foreign();
        let Some(form) = forms.get(self.form) else { return Answer::default() };
        let mut answer = form.judge(&self.data, place);
        for (_, evidence) in &mut answer.evidence {
            for said in &self.data.said {
                evidence.note += if evidence.note.is_empty() { "" } else { "; " };
                evidence.note += said;
            }
        }
        answer
    }
}
