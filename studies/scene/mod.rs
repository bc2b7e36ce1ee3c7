//! Studies of one scene of one's own: bodies, loads and probes as written, marched in time.
//!
//! A scene has no exact answer to be held against. What can be judged without one is: finite numbers, the energy ledger,
//! the balance of momentum, the other operator, and what the author of the study expects.

mod balances;
mod body;
mod diverged;
mod edges;
pub mod effects;
pub mod either;
mod expect;
mod figure_units;
mod figures;
pub mod march;
mod march_claims;
mod operators;
mod probe_table;
pub mod probes;
pub mod size;
mod snapshot_figure;
mod snapshots;
#[cfg(test)]
mod tests;
pub mod time;

use crate::written::Word;

/// What a case of a scene study may ask.
pub const WORDS: &[Word] = &[Word::of::<march::MarchAsked>("march")];

/// Files that cases share; no figure may take their names.
pub const TABLES: &[&str] = &["diverged", "probes", "verdicts"];
