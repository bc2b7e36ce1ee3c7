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
