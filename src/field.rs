//! Numbers of a body in memory: a slice of f64 that begins on a cache line.
//!
//! Rows of a [`crate::grid::Grid`] are whole lines, so that a vector of eight nodes is one line: loads across two lines
//! cost the stencil a quarter of its speed.

use std::ops::{Deref, DerefMut};

/// A line of the cache.
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Zeroable, bytemuck::Pod)]
#[repr(C, align(64))]
struct Line([f64; 8]);

/// So many f64; behaves as a slice.
#[derive(Clone, PartialEq, Default)]
pub struct Field {
    lines: Vec<Line>,
    len: usize,
}

impl Field {
    /// Zeros.
    pub fn zeros(len: usize) -> Self {
        Self { lines: vec![Line([0.0; 8]); len.div_ceil(8)], len }
    }
}

impl Deref for Field {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &bytemuck::cast_slice(&self.lines)[..self.len]
    }
}

impl DerefMut for Field {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut bytemuck::cast_slice_mut(&mut self.lines)[..self.len]
    }
}

impl std::fmt::Debug for Field {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        (**self).fmt(formatter)
    }
}

impl<'a> IntoIterator for &'a Field {
    type Item = &'a f64;
    type IntoIter = std::slice::Iter<'a, f64>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl<'a> IntoIterator for &'a mut Field {
    type Item = &'a mut f64;
    type IntoIter = std::slice::IterMut<'a, f64>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter_mut()
    }
}

impl From<Vec<f64>> for Field {
    fn from(values: Vec<f64>) -> Self {
        let mut field = Self::zeros(values.len());
        field.copy_from_slice(&values);
        field
    }
}

impl FromIterator<f64> for Field {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Self {
        values.into_iter().collect::<Vec<_>>().into()
    }
}

/// Whether all are finite numbers.
pub fn all_finite(values: &[f64]) -> bool {
    // What is infinite or no number is none times zero.
    folded(values, |sum, value| sum + 0.0 * value).iter().sum::<f64>() == 0.0
}

/// The largest absolute value; of numbers alone, see [`all_finite`].
pub fn largest(values: &[f64]) -> f64 {
    folded(values, |most, value| if value.abs() > most { value.abs() } else { most })
        .into_iter()
        .fold(0.0, f64::max)
}

/// Folds every eighth value from 0, so that eight make a vector.
fn folded(values: &[f64], with: impl Fn(f64, f64) -> f64) -> [f64; 8] {
    let lines = values.chunks_exact(8);
    let rest = lines.remainder();
    let mut all =
        lines.fold([0.0; 8], |all: [f64; 8], line| std::array::from_fn(|lane| with(all[lane], line[lane])));
    all.iter_mut().zip(rest).for_each(|(all, value)| *all = with(*all, *value));
    all
}

/// A stretch of a field, known by the places of the whole.
#[derive(Debug, Clone, Copy)]
pub struct Window<'a> {
    values: &'a [f64],
    start: usize,
}

impl<'a> Window<'a> {
    /// Of nothing.
    pub const NONE: Self = Self { values: &[], start: 0 };

    /// The places from `start` on.
    pub fn new(values: &'a [f64], start: usize) -> Self {
        Self { values, start }
    }

    /// What can be seen.
    pub fn values(&self) -> &'a [f64] {
        self.values
    }

    /// The place of the first.
    pub fn start(&self) -> usize {
        self.start
    }
}

impl<'a> From<&'a [f64]> for Window<'a> {
    fn from(values: &'a [f64]) -> Self {
        Self { values, start: 0 }
    }
}

impl<'a> From<&'a Field> for Window<'a> {
    fn from(field: &'a Field) -> Self {
        Self { values: field, start: 0 }
    }
}

impl std::ops::Index<usize> for Window<'_> {
    type Output = f64;

    #[inline(always)]
    fn index(&self, place: usize) -> &f64 {
        &self.values[place - self.start]
    }
}

impl std::ops::Index<std::ops::Range<usize>> for Window<'_> {
    type Output = [f64];

    fn index(&self, places: std::ops::Range<usize>) -> &[f64] {
        &self.values[places.start - self.start..places.end - self.start]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_bad_value_is_found_wherever_it_stands() {
        let values: Vec<f64> = (0..21).map(|n| 1.5 - f64::from(n)).collect();
        assert!(all_finite(&values) && all_finite(&[]));
        assert_eq!((largest(&values), largest(&[]), largest(&[-3.0, 2.0])), (18.5, 0.0, 3.0));
        for at in 0..values.len() {
            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut spoiled = values.clone();
                spoiled[at] = bad;
                assert!(!all_finite(&spoiled), "{bad} at {at}");
            }
        }
    }
}
