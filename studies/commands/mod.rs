//! What each command does.

pub mod baseline;
pub mod bench;
pub mod check;
mod compute;
pub mod cost;
pub mod cost_scene;
pub mod explain;
pub mod export;
mod find;
mod folder;
pub mod judge;
pub mod list;
pub mod merge;
pub mod plan;
pub mod report;
mod scene_lines;
pub mod selftest;
mod threads;

use std::io::{self, Write};

/// Prints to standard output; a reader who has left is no error.
pub fn say(text: &str) -> io::Result<()> {
    match io::stdout().write_all(text.as_bytes()).and_then(|()| io::stdout().flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        other => other,
    }
}
