//! An axis: its label with unit, its scale, its range, and where a value stands on the canvas.

use super::PlotError;

/// How values are spaced along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Scale {
    #[default]
    Linear,
    /// By decades; values at or below zero have no place on it.
    Log,
}

impl Scale {
    /// The value, or its decimal logarithm; NaN where there is none.
    pub(super) fn of(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log if value > 0.0 => libm::log10(value),
            Self::Log => f64::NAN,
        }
    }

    /// The value that [`Self::of`] came from.
    pub(super) fn back(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log => libm::pow(10.0, value),
        }
    }
}

/// One axis of a plot.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Axis {
    /// With its unit: `wavenumber k (1/m)`.
    pub label: String,
    pub scale: Scale,
    /// Smallest and largest value shown; `None`: what the data needs.
    pub range: Option<(f64, f64)>,
    /// Values that a range taken from the data must contain.
    pub including: Vec<f64>,
}

impl Axis {
    /// An axis with equal steps.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), ..Self::default() }
    }

    /// An axis by decades.
    pub fn log(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Log, ..Self::default() }
    }

    /// Shows exactly this range.
    pub fn range(mut self, lo: f64, hi: f64) -> Self {
        self.range = Some((lo, hi));
        self
    }

    /// Makes sure that this value is on the axis.
    pub fn including(mut self, value: f64) -> Self {
        self.including.push(value);
        self
    }

    /// The range to show for these values, with a margin on both sides as a share of it.
    pub(super) fn span(
        &self,
        values: impl IntoIterator<Item = f64>,
        margin: f64,
    ) -> Result<(f64, f64), PlotError> {
        if let Some((lo, hi)) = self.range {
            let wide = self.scale.of(hi) - self.scale.of(lo);
            if !(wide.is_finite() && wide > 0.0 && resolvable(lo, hi)) {
                return Err(PlotError::Range { axis: self.label.clone(), lo, hi });
            }
            return Ok((lo, hi));
        }
        // Values near the end of f64 are left outside: the range and its margins must stay finite.
        let most = if self.scale == Scale::Log { 300.0 } else { 1e300 };
        let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.into_iter().chain(self.including.iter().copied()) {
            let value = self.scale.of(value);
            if value.abs() <= most {
                lo = lo.min(value);
                hi = hi.max(value);
            }
        }
        if lo > hi {
            (lo, hi) = (0.0, 1.0);
        }
        if !resolvable(lo, hi) {
            let half = if self.scale == Scale::Log { 0.35 } else { (0.1 * hi.abs()).max(f64::MIN_POSITIVE) };
            let half = if hi == 0.0 { 1.0 } else { half };
            (lo, hi) = (lo - half, hi + half);
        } else {
            let extra = margin * (hi - lo);
            (lo, hi) = (lo - extra, hi + extra);
        }
        Ok((self.scale.back(lo), self.scale.back(hi)))
    }
}

/// Whether f64 can tell enough points apart between the two.
fn resolvable(lo: f64, hi: f64) -> bool {
    hi - lo > 1e-12 * lo.abs().max(hi.abs()) && hi - lo > 1e-290
}

/// A range laid along a stretch of the canvas.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    pub scale: Scale,
    pub lo: f64,
    pub hi: f64,
    /// Pixel of `lo`.
    pub start: f64,
    /// Pixel of `hi`.
    pub end: f64,
}

impl Span {
    /// Pixel of a value; NaN where it has no place.
    pub fn at(&self, value: f64) -> f64 {
        let (lo, hi) = (self.scale.of(self.lo), self.scale.of(self.hi));
        self.start + (self.scale.of(value) - lo) / (hi - lo) * (self.end - self.start)
    }

    /// Whether the value is between the ends, which count as inside.
    pub fn holds(&self, value: f64) -> bool {
        value >= self.lo && value <= self.hi
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_follow_the_data_and_skip_what_has_no_place() {
        let values = [f64::NAN, 1.0, 100.0, f64::INFINITY, -1.0];
        assert_eq!(Axis::linear("").span(values, 0.0), Ok((-1.0, 100.0)));
        let (lo, hi) = Axis::log("").span(values, 0.0).unwrap();
        assert!((lo - 1.0).abs() < 1e-9 && (hi - 100.0).abs() < 1e-9);
    }

    #[test]
    fn one_value_no_value_and_tiny_values_have_a_range() {
        for axis in [Axis::linear(""), Axis::log("")] {
            for values in [
                vec![],
                vec![1e-16],
                vec![0.0],
                vec![f64::NAN],
                vec![5.0, 5.0],
                vec![1e308, 1e-308],
                vec![1e308],
            ] {
                let (lo, hi) = axis.span(values.clone(), 0.05).unwrap();
                assert!(lo < hi && (hi - lo).is_finite(), "{values:?}: {lo} to {hi}");
            }
        }
    }

    #[test]
    fn an_impossible_range_is_refused() {
        assert!(Axis::log("").range(0.0, 1.0).span([], 0.0).is_err());
        assert!(Axis::linear("").range(1.0, 1.0).span([], 0.0).is_err());
        assert!(Axis::linear("").range(0.0, f64::NAN).span([], 0.0).is_err());
    }

    #[test]
    fn ends_of_the_range_are_ends_of_the_stretch() {
        let span = Span { scale: Scale::Log, lo: 1e-3, hi: 10.0, start: 300.0, end: 100.0 };
        assert_eq!((span.at(1e-3), span.at(10.0)), (300.0, 100.0));
        assert!((span.at(0.1) - 200.0).abs() < 1e-9);
        assert!(span.at(0.0).is_nan());
    }
}
