//! Numbers as readers see them in the tables of a run: four significant digits.

/// Four significant digits, without trailing zeros: `0.3333`, `3.553e-15`.
pub fn rounded(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    let size = rounded.abs();
    if size == 0.0 || (1e-3..1e6).contains(&size) { format!("{rounded}") } else { format!("{rounded:e}") }
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn readers_see_four_digits() {
        for (value, text) in [
            (1.0 / 3.0, "0.3333"),
            (16.0 * f64::EPSILON, "3.553e-15"),
            (1e-5, "1e-5"),
            (0.0, "0"),
            (2.5, "2.5"),
        ] {
            assert_eq!(rounded(value), text);
        }
        assert_eq!(rounded(f64::NAN), "NaN");
    }
}
