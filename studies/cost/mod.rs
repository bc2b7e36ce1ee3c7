//! `pd-verify cost`: what accuracy costs.

#[cfg(test)]
mod ablation;
#[cfg(test)]
mod ablation_bodies;
#[cfg(test)]
mod ablation_report;
#[cfg(test)]
mod ablation_tests;
pub mod advice;
pub mod figure;
pub mod own;
pub mod text;
