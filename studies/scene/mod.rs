//! Scenes of one's own, marched in time.

use crate::written::Word;

/// What a case may ask.
pub const WORDS: &[Word] = &[];

/// Files that cases share; no figure may take their names.
pub const TABLES: &[&str] = &["probes", "verdicts"];
