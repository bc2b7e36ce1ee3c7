//! What is asked to be simulated: plain data, from a study file or written in Rust.

mod positive;
mod wrong;

pub use positive::Positive;
pub use wrong::Wrong;
