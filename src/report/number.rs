//! Numbers as text: all digits for files, a few for readers.

/// The shortest text that reads back to the same number; empty where there is none.
pub fn csv_number(value: f64) -> String {
    if !value.is_finite() {
        return String::new();
    }
    let (plain, science) = (format!("{value}"), format!("{value:e}"));
    if science.len() < plain.len() { science } else { plain }
}

/// Four significant digits for a reader; a dash where there is no number.
pub fn readable(value: Option<f64>) -> String {
    rounded(value, 4)
}

/// Six significant digits, for values whose difference is the point.
pub(super) fn precise(value: Option<f64>) -> String {
    rounded(value, 6)
}

fn rounded(value: Option<f64>, digits: usize) -> String {
    let Some(value) = value else { return "–".to_owned() };
    if value.is_nan() {
        return "not a number".to_owned();
    }
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    let size = rounded.abs();
    if size == 0.0 || (1e-3..1e6).contains(&size) { format!("{rounded}") } else { format!("{rounded:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_numbers_read_back_to_the_same_bits() {
        for value in [0.0, -0.0, 1.0, 0.1, 1e300, 5e-324, -2.5e-7, 123456.789, f64::MAX, f64::EPSILON] {
            let text = csv_number(value);
            assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits(), "{text}");
        }
    }

    #[test]
    fn csv_numbers_are_short_and_unknown_ones_empty() {
        assert_eq!(csv_number(1e-7), "1e-7");
        assert_eq!(csv_number(0.25), "0.25");
        assert_eq!(csv_number(f64::NAN), "");
        assert_eq!(csv_number(f64::NEG_INFINITY), "");
    }

    #[test]
    fn readers_see_four_digits() {
        assert_eq!(readable(Some(1.0 / 3.0)), "0.3333");
        assert_eq!(readable(Some(123_456.0)), "123500");
        assert_eq!(readable(Some(1.234567e-9)), "1.235e-9");
        assert_eq!(readable(Some(1e-3)), "0.001");
        assert_eq!(readable(Some(f64::INFINITY)), "inf");
        assert_eq!(readable(None), "–");
        assert_eq!(precise(Some(4996.2534)), "4996.25");
    }
}
