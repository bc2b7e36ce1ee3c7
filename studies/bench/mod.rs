//! `pd-verify bench`: how fast bodies are marched, beside what the machine can do.

pub mod beside;
pub mod bodies;
pub mod cases;
pub mod costs;
pub mod figures;
mod fma;
pub mod forecast;
pub mod growth;
pub mod kept;
pub mod limits;
pub mod measure;
pub mod memory;
pub mod rates;
pub mod short;
pub mod text;
mod triad;
