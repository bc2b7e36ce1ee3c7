//! What a figure did not draw, counted, and the sentence that says so.

use super::axis::Span;

/// Counts of what was left out.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct LeftOut {
    pub not_finite: usize,
    pub not_positive: usize,
    pub outside: usize,
    pub sums: usize,
    pub blank_cells: usize,
    pub grey_cells: usize,
}

impl LeftOut {
    /// Counts a point at `(x, y)`; true where it is drawn.
    pub fn admit(&mut self, x: f64, y: f64, across: &Span, up: &Span) -> bool {
        if !x.is_finite() || !y.is_finite() {
            self.not_finite += 1;
        } else if across.at(x).is_nan() || up.at(y).is_nan() {
            self.not_positive += 1;
        } else if !across.holds(x) || !up.holds(y) {
            self.outside += 1;
        } else {
            return true;
        }
        false
    }

    /// Counts a cell's value that has no colour; one that was never there is not counted.
    pub fn miss(&mut self, value: Option<f64>) {
        self.not_finite += usize::from(value.is_some_and(|v| !v.is_finite()));
        self.not_positive += usize::from(value.is_some_and(f64::is_finite));
    }

    pub fn add(&mut self, other: Self) {
        self.not_finite += other.not_finite;
        self.not_positive += other.not_positive;
        self.outside += other.outside;
        self.sums += other.sums;
        self.blank_cells += other.blank_cells;
        self.grey_cells += other.grey_cells;
    }

    /// The sentence under the figure; empty where nothing was left out.
    pub fn note(&self) -> String {
        let mut parts = Vec::new();
        let count = |n: usize| format!("{n} point{}", if n == 1 { "" } else { "s" });
        if self.not_finite > 0 {
            parts.push(format!("{} missing or not finite", count(self.not_finite)));
        }
        if self.not_positive > 0 {
            parts.push(format!("{} not positive (logarithmic axis)", count(self.not_positive)));
        }
        if self.outside > 0 {
            parts.push(format!("{} outside the axes", count(self.outside)));
        }
        if self.sums > 0 {
            let s = if self.sums == 1 { "" } else { "s" };
            parts.push(format!("{} sum{s} with a part that is not finite", self.sums));
        }
        let mut note = String::new();
        if !parts.is_empty() {
            note = format!("Not drawn: {}.", parts.join(", "));
        }
        for (cells, meaning) in
            [(self.blank_cells, "Hatched: no value."), (self.grey_cells, "Grey: no value.")]
        {
            if cells > 0 {
                note.push_str(if note.is_empty() { "" } else { " " });
                note.push_str(meaning);
            }
        }
        note
    }
}
