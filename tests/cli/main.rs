//! The program as its users meet it: exit codes, messages, and the files it writes or leaves alone.

mod avoidable;
mod baseline;
mod bench;
mod check;
mod commands;
mod cost;
mod cost_scene;
mod cracks;
mod diverged;
#[cfg(unix)]
mod faults;
#[cfg(unix)]
mod holed;
mod interruption;
mod limits;
mod patches;
mod place;
mod refinements;
mod refusals;
mod report;
mod results;
mod resume;
mod running;
mod scenes;
mod settings;
mod shards;
mod snapshots;
mod studies;
mod support;
