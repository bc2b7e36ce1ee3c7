//! `pd-verify cost --error X SCENE` and `--budget S SCENE`: what accuracy costs in a scene of one's own.
//!
//! The scene is refined at its m, so that its horizon shrinks with Δx, and Δt with both. Cheap levels are marched; from what is seen of
//! them the order and the error of every level follow, from their times those of finer ones; the answer is marched
//! and held against what was predicted.

pub mod estimate;
pub mod figure;
pub mod levels;
pub mod report;
pub mod search;
#[cfg(test)]
mod search_tests;
pub mod seen;
mod triple;
