//! Words that people try where another is meant: what to say to them.

/// Words, the word that must be known in their place for the advice to apply, and the advice.
const MEANT: [(&[&str], &str, &str); 3] = [
    (
        &["length_m", "height_m", "width_m", "length", "size"],
        "size_m",
        "did you mean `size_m`? it is the length of a bar, [length, height] of a plate",
    ),
    (
        &["fixed", "clamped", "held", "fix", "clamp", "wall", "symmetry", "dirichlet"],
        "mirror_odd",
        "to hold an edge: mirror_odd, also called roller (the edge does not leave its plane, and slides along it), or prescribed_motion with displacement_m = 0",
    ),
    (&["open", "none", "neumann"], "free", "did you mean `free`? bonds beyond such an edge are missing"),
];

/// The word that is meant and the advice, where what is meant by it is among those known.
pub fn meant(word: &str, known: &[&str]) -> Option<(&'static str, &'static str)> {
    let word = word.to_lowercase();
    let fits = |(words, needed, _): &&(&[&str], &str, &str)| {
        words.contains(&word.as_str()) && known.contains(needed)
    };
    MEANT.iter().find(fits).map(|(_, needed, advice)| (*needed, *advice))
}

#[cfg(test)]
mod tests {
    use super::meant;

    #[test]
    fn advice_is_given_where_it_applies() {
        assert!(meant("length_m", &["body", "size_m"]).unwrap().1.contains("`size_m`"));
        assert_eq!(meant("length_m", &["length", "m"]), None);
        assert!(meant("Fixed", &["free", "mirror_odd"]).unwrap().1.contains("prescribed_motion"));
        assert_eq!(meant("fixed", &["step", "ramp"]), None);
    }
}
