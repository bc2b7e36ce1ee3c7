//! Measured against expected: errors as norms, never signed sums; orders with their sign.

pub mod frontier;
pub mod order;
pub mod richardson;

/// max |a − b| / |b| over pairs; `None` when there is no pair, NaN when any is not finite.
pub fn largest_relative(pairs: impl IntoIterator<Item = (f64, f64)>) -> Option<f64> {
    largest(pairs.into_iter().map(|(a, b)| if a == b { 0.0 } else { (a - b).abs() / b.abs() }))
}

/// The largest of some errors; `None` when there is none, NaN when any is NaN.
pub fn largest(errors: impl IntoIterator<Item = f64>) -> Option<f64> {
    errors.into_iter().reduce(|a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_and_nan_are_not_small() {
        assert_eq!(largest_relative([]), None);
        assert!(largest([0.0, f64::NAN, 1.0]).unwrap().is_nan());
        assert_eq!(largest_relative([(1.0, 2.0), (3.0, 3.0)]), Some(0.5));
        assert_eq!(largest_relative([(0.0, 0.0)]), Some(0.0));
    }
}
