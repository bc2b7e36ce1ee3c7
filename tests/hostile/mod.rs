//! Study files that nobody means well with: the corpus of the fuzzer, and whatever chance makes of the schema's keys and of
//! the shipped studies. All are read and planned by the same few lines as the fuzzer's.

mod chance;
mod corpus;
#[path = "../fuzz/exercise.rs"]
mod exercise;
mod properties;
