//! How wide a text will be, without a font: an estimate on the wide side, and line breaking by it.

/// Width of one character as a share of the font size, after DejaVu Sans, the widest of the usual sans-serif faces.
fn share(c: char) -> f64 {
    match c {
        'i' | 'j' | 'l' | '\'' => 0.28,
        ' ' | '.' | ',' | 'I' | ':' | ';' | '/' | '|' | '·' => 0.34,
        '(' | ')' | '[' | ']' | '-' | 't' | 'f' | 'r' | '!' | '‖' => 0.42,
        '⁰'..='⁹' | '²' | '³' | '¹' | '⁻' | '₀'..='₉' | 'ᵖ' => 0.45,
        'm' | 'M' | 'W' | 'w' | '@' | '%' | '…' | '—' | 'ω' => 1.0,
        'a'..='z' | '0'..='9' | 'α'..='ψ' | '°' | '–' | '_' => 0.64,
        'A'..='Z' | 'Α'..='Ω' => 0.79,
        c if c.is_ascii() => 0.84,
        c if (c as u32) < 0x2E80 => 0.9,
        _ => 1.05,
    }
}

/// Estimated width of a line of text set at `size`.
pub(super) fn width(text: &str, size: f64, bold: bool) -> f64 {
    let shares: f64 = text.chars().map(share).sum();
    shares * size * if bold { 1.12 } else { 1.0 }
}

/// The text in lines no wider than `room`, broken at spaces, beside an equals sign only where the equation is too wide
/// for a line, and inside a word only where one alone is.
pub(super) fn wrap(text: &str, size: f64, bold: bool, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    for word in words(text, size, bold, room) {
        for piece in pieces(&word, size, bold, room) {
            let longer = if line.is_empty() { piece.clone() } else { format!("{line} {piece}") };
            if width(&longer, size, bold) <= room || line.is_empty() {
                line = longer;
            } else {
                lines.push(std::mem::replace(&mut line, piece));
            }
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

/// The words of a text; `p = 2` is one where it fits.
fn words(text: &str, size: f64, bold: bool, room: f64) -> Vec<String> {
    let single: Vec<&str> = text.split_whitespace().collect();
    let mut words = Vec::new();
    let mut start = 0;
    while start < single.len() {
        let equation = single.get(start + 1) == Some(&"=");
        let end = if equation { (start + 3).min(single.len()) } else { start + 1 };
        let joined = single[start..end].join(" ");
        if width(&joined, size, bold) <= room {
            words.push(joined);
        } else {
            words.extend(single[start..end].iter().map(|word| (*word).to_owned()));
        }
        start = end;
    }
    words
}

/// A word cut into parts that fit; almost always the word itself.
fn pieces(word: &str, size: f64, bold: bool, room: f64) -> Vec<String> {
    let mut parts = vec![String::new()];
    for c in word.chars() {
        let last = parts.len() - 1;
        if !parts[last].is_empty() && width(&format!("{}{c}", parts[last]), size, bold) > room {
            parts.push(c.to_string());
        } else {
            parts[last].push(c);
        }
    }
    parts
}

/// Width of the widest of several lines.
pub(super) fn widest<'a>(lines: impl IntoIterator<Item = &'a str>, size: f64) -> f64 {
    lines.into_iter().map(|line| width(line, size, false)).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_fit_and_no_word_is_lost() {
        let text = "group velocity of the exponential kernel, p = 4, m = 3";
        let lines = wrap(text, 14.0, false, 150.0);
        assert!(lines.len() > 1);
        assert!(lines.iter().all(|line| width(line, 14.0, false) <= 150.0), "{lines:?}");
        assert_eq!(lines.join(" "), text);
    }

    #[test]
    fn a_word_wider_than_the_room_is_cut() {
        let lines = wrap(&"x".repeat(60), 14.0, false, 100.0);
        assert!(lines.iter().all(|line| width(line, 14.0, false) <= 100.0), "{lines:?}");
        assert_eq!(lines.concat().len(), 60);
    }

    #[test]
    fn an_equation_stays_together_where_it_fits() {
        let text = "exponential kernel, p = 2, m = 3";
        let room = width("exponential kernel, p =", 14.0, false);
        assert_eq!(wrap(text, 14.0, false, room), ["exponential kernel,", "p = 2, m = 3"]);
        let narrow = wrap(text, 14.0, false, 30.0);
        assert!(narrow.iter().all(|line| width(line, 14.0, false) <= 30.0), "{narrow:?}");
        assert_eq!(narrow.concat().replace(' ', ""), text.replace(' ', ""));
    }

    #[test]
    fn no_text_has_no_lines() {
        assert!(wrap("  ", 14.0, false, 100.0).is_empty());
    }
}
