//! `pd-verify bench`: how fast bodies are marched, beside what the machine can do.

pub mod fma;
pub mod limits;
pub mod triad;
