//! `pd-verify cost`: what accuracy costs.

pub mod advice;
pub mod figure;
pub mod text;
