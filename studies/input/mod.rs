//! Study files into data: TOML with a place for every value, so that each refusal can point at its line.
//!
//! Text → tree of plain values in SI, with the span of every key → `--set` changes → typed structures. Everything
//! that can be wrong with a study is found here or in the study's own checks, before anything is computed.

mod document;
mod fields;
mod meant;
mod refusal;
mod set;
mod units;

pub use document::{Document, MAX_BYTES};
pub use fields::{OneOrMany, one_or_many};
pub use refusal::{Refusal, nearest};
pub use set::Setting;
pub use units::{other_units, to_si_factor};
