//! Numbers as short text for ticks and cells.

/// An exponent in raised digits: -16 gives `⁻¹⁶`.
pub(super) fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    exponent.to_string().chars().map(|c| c.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize])).collect()
}

/// With a fixed number of decimals and a true minus sign; never `−0`.
pub(super) fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| c == '0' || c == '.') => digits.to_owned(),
        Some(digits) => format!("−{digits}"),
        None => text,
    }
}

/// At most `digits` significant digits, without trailing zeros: `0.0123`, `1.2e−5`.
pub(super) fn short(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "–".to_owned();
    }
    let science = format!("{value:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = science.split_once('e').unwrap_or((&science, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-3..5).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        return trimmed(&fixed(value, decimals)).to_owned();
    }
    let exponent = exponent.to_string().replace('-', "−");
    format!("{}e{exponent}", trimmed(mantissa).replace('-', "−"))
}

/// The numbers of a table: with the same decimals where they are of like size, each for itself otherwise.
pub(super) fn together(rows: &[Vec<Option<f64>>]) -> Vec<Vec<String>> {
    let sizes = || rows.iter().flatten().flatten().map(|v| v.abs()).filter(|v| v.is_finite() && *v > 0.0);
    let (least, most) = (sizes().fold(f64::INFINITY, f64::min), sizes().fold(0.0, f64::max));
    let alike = most < 1000.0 * least && (1e-2..1e5).contains(&most);
    let decimals = if alike { (2 - libm::floor(libm::log10(most)) as i32).max(0) as usize } else { 0 };
    let text = |v: f64| if alike && v.is_finite() { fixed(v, decimals) } else { short(v, 3) };
    rows.iter().map(|row| row.iter().map(|v| v.map_or_else(String::new, text)).collect()).collect()
}

fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_numbers_read_well() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (0.01234, "0.0123"),
            (-2.5, "−2.5"),
            (99.96, "100"),
            (1234.5, "1234"),
            (1.2e-5, "1.2e−5"),
            (-3e20, "−3e20"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(short(value, 3), text);
        }
    }

    #[test]
    fn fixed_has_no_negative_zero() {
        assert_eq!(fixed(-0.001, 2), "0.00");
        assert_eq!(fixed(-0.5, 1), "−0.5");
        assert_eq!(superscript(-16), "⁻¹⁶");
    }
}
