//! Likely causes of a failure: what the error would be if the data were changed as a usual mistake changes them.

use crate::rounded::rounded;
use std::f64::consts::{PI, SQRT_2};

/// A change of the data (or of the reference) that would undo a mistake, and the error that is left then.
pub struct Suspect {
    /// "if multiplied by −1: is the sign convention another one?"
    pub cause: String,
    pub error: Option<f64>,
}

/// Factors that units, conventions and formulas are mistaken by, and how that happens.
const FACTORS: [(f64, &str, &str); 14] = [
    (-1.0, "−1", "is the sign convention another one?"),
    (0.5, "1/2", "does a load on two edges, or a doubled wave at a face, count twice?"),
    (2.0, "2", "is only one of two loaded edges or faces there, or half of what is asked for?"),
    (1e3, "10³", "are units a thousand times larger than was said (mm for m, MPa for kPa)?"),
    (1e-3, "10⁻³", "are units a thousand times smaller than was said (m for mm, kPa for MPa)?"),
    (1e6, "10⁶", "are stresses in MPa where Pa was said?"),
    (1e-6, "10⁻⁶", "are stresses in Pa where MPa was said, or lengths in m where µm was?"),
    (31_622.776_601_683_79, "10^4.5", "is K in MPa√mm where Pa√m was said?"),
    (31.622_776_601_683_793, "√10³", "is a root of a length taken in mm on one side, in m on the other?"),
    (0.031_622_776_601_683_79, "1/√10³", "is a root of a length taken in m on one side, in mm on the other?"),
    (PI, "π", "does √(2π) stand where √(2/π) should, or a frequency without its π?"),
    (1.0 / PI, "1/π", "does √(2π) stand where √(2/π) should?"),
    (2.0 * PI, "2π", "are frequencies in Hz where rad/s was said?"),
    (1.0 / (2.0 * PI), "1/2π", "are frequencies in rad/s where Hz was said?"),
];

/// Factors that are mistaken under a root.
const ROOTS: [(f64, &str, &str); 6] = [
    (SQRT_2, "√2", "does √(r) or √(π r) stand where √(2r) or √(2πr) should?"),
    (1.0 / SQRT_2, "1/√2", "does √(2r) or √(2πr) stand where √r or √(πr) should?"),
    (1.772_453_850_905_516, "√π", "is √π of the definition K = σ√(2πr) missing?"),
    (0.564_189_583_547_756_3, "1/√π", "is √π there once too often?"),
    (2.506_628_274_631_000_7, "√(2π)", "is √(2π) of the definition K = σ√(2πr) missing?"),
    (0.398_942_280_401_432_7, "1/√(2π)", "is √(2π) there once too often?"),
];

/// Suspects that multiply the data: `error` says what is left then.
pub fn scaled(error: impl Fn(f64) -> Option<f64>) -> Vec<Suspect> {
    let each = FACTORS.iter().chain(&ROOTS);
    each.map(|&(factor, name, why)| Suspect {
        cause: format!("if multiplied by {name}: {why}"),
        error: error(factor),
    })
    .collect()
}

/// What a note says of a failure: the change that leaves least, where it explains most of the error; else nothing.
pub fn likely(error: Option<f64>, bound: f64, suspects: Vec<Suspect>) -> String {
    let Some(error) = error.filter(|error| *error > bound) else { return String::new() };
    let known =
        suspects.into_iter().filter_map(|one| Some((one.error.filter(|left| left.is_finite())?, one.cause)));
    // The first of those that do alike: simple causes come first.
    let least = known.fold(None, |best: Option<(f64, String)>, one| match best {
        Some(best) if best.0 <= one.0 => Some(best),
        _ => Some(one),
    });
    match least {
        Some((left, cause)) if left <= bound => format!("; would pass {cause}"),
        Some((left, cause)) if left < 0.2 * error => format!("; would be {} {cause}", rounded(left)),
        _ => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cause_that_leaves_least_is_named_and_none_that_leaves_much() {
        let of = |value: f64| {
            let error = |factor: f64| Some((factor * value - 1.0).abs());
            likely(error(1.0), 0.01, scaled(error))
        };
        assert!(of(-1.0).contains("would pass if multiplied by −1: is the sign convention"), "{}", of(-1.0));
        assert!(of(2.0).contains("multiplied by 1/2") && of(2e-3).is_empty());
        assert!(of(1e-3).contains("10³") && of(1.0 / 31.622_777).contains("√10³"));
        assert!(of(1.45).contains("would be") && of(1.0).is_empty() && of(1.2).is_empty());
        assert!(likely(Some(1.0), 0.1, scaled(|_| Some(f64::NAN))).is_empty());
    }
}
