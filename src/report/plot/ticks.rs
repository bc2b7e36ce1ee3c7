//! Ticks: round numbers on linear axes, powers of ten on logarithmic ones, and labels even under one decade.

use super::axis::Scale;
use super::number::{fixed, superscript};
use super::text;

/// A mark on an axis; without a label it is a minor one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    pub value: f64,
    pub label: Option<String>,
}

/// The ticks of an axis; the labels are to be multiplied by 10 to the `exponent`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Ticks {
    pub ticks: Vec<Tick>,
    pub exponent: i32,
}

impl Ticks {
    /// The labels with their values.
    pub fn labelled(&self) -> impl Iterator<Item = (f64, &str)> {
        self.ticks.iter().filter_map(|tick| Some((tick.value, tick.label.as_deref()?)))
    }

    /// Width of the widest label.
    pub fn widest(&self, size: f64) -> f64 {
        text::widest(self.labelled().map(|(_, label)| label), size)
    }
}

/// As many ticks as stand clear of each other on `length` pixels; `across`: the labels stand side by side.
pub(super) fn fitting(scale: Scale, lo: f64, hi: f64, length: f64, across: bool, size: f64) -> Ticks {
    let most = if across { 11 } else { 9 };
    let mut ticks = all(scale, lo, hi, most);
    for fewer in (1..most).rev() {
        let room = if across { ticks.widest(size) + 0.9 * size } else { 1.9 * size };
        if closest(scale, lo, hi, &ticks) * length >= room {
            break;
        }
        ticks = all(scale, lo, hi, fewer);
    }
    ticks
}

fn all(scale: Scale, lo: f64, hi: f64, most: usize) -> Ticks {
    match scale {
        Scale::Linear => linear(lo, hi, most),
        Scale::Log => log(lo, hi, most),
    }
}

/// Smallest distance between two labels as a share of the axis.
fn closest(scale: Scale, lo: f64, hi: f64, ticks: &Ticks) -> f64 {
    let share = |v: f64| (scale.of(v) - scale.of(lo)) / (scale.of(hi) - scale.of(lo));
    let at: Vec<f64> = ticks.labelled().map(|(value, _)| share(value)).collect();
    at.windows(2).map(|pair| pair[1] - pair[0]).fold(1.0, f64::min)
}

/// Multiples of 1, 2, 2.5 or 5 times a power of ten, at most `most` of them.
fn linear(lo: f64, hi: f64, most: usize) -> Ticks {
    let most = most.max(2) as f64;
    let mut power = libm::floor(libm::log10((hi - lo) / most)) as i32;
    let steps = [(1.0, 0), (2.0, 0), (2.5, 1), (5.0, 0), (10.0, 0)];
    let unit = ten_to(power);
    let (factor, more) = steps.into_iter().find(|(f, _)| (hi - lo) / (f * unit) <= most).unwrap_or((10.0, 0));
    if factor == 10.0 {
        power += 1;
    }
    let step = factor * unit;
    // Rounding must not lose a tick at the very end of the range.
    let first = libm::ceil(lo / step - 1e-9) as i64;
    let last = libm::floor(hi / step + 1e-9) as i64;
    let largest = lo.abs().max(hi.abs());
    let size = if largest > 0.0 { libm::floor(libm::log10(largest) + 1e-9) as i32 } else { 0 };
    let exponent = if (-3..5).contains(&size) { 0 } else { size };
    let decimals = (more + exponent - power).clamp(0, 15) as usize;
    let ticks = (first..=last)
        .map(|i| {
            let value = (i as f64 * step).clamp(lo, hi);
            Tick { value, label: Some(fixed(i as f64 * step / ten_to(exponent), decimals)) }
        })
        .collect();
    Ticks { ticks, exponent }
}

/// Powers of ten, with 2 to 9 unlabelled between them; under about one decade round numbers with labels.
fn log(lo: f64, hi: f64, most: usize) -> Ticks {
    let (first, last) = (libm::floor(libm::log10(lo)) as i32, libm::ceil(libm::log10(hi)) as i32);
    let inside = |v: f64| v >= lo * (1.0 - 1e-9) && v <= hi * (1.0 + 1e-9);
    let every = |digits: &[f64]| -> Vec<f64> {
        let decade = |n| digits.iter().map(move |d| d * ten_to(n));
        (first..=last).flat_map(decade).filter(|&v| inside(v)).collect()
    };
    let decades = every(&[1.0]).len();
    if decades < 2 {
        return under_a_decade(lo, hi, most, every(&[1.0, 2.0, 5.0]), every(&[3.0, 4.0, 6.0, 7.0, 8.0, 9.0]));
    }
    let stride = decades.div_ceil(most.max(2)) as i32;
    let mut ticks = Vec::new();
    for n in first..=last {
        for digit in 1..10 {
            let value = f64::from(digit) * ten_to(n);
            let major = digit == 1 && n.rem_euclid(stride) == 0;
            // Between labels many decades apart only the decades themselves are marked.
            if inside(value) && (digit == 1 || stride == 1) {
                let label = major.then(|| format!("10{}", superscript(n)));
                ticks.push(Tick { value: value.clamp(lo, hi), label });
            }
        }
    }
    Ticks { ticks, exponent: 0 }
}

fn under_a_decade(lo: f64, hi: f64, most: usize, round: Vec<f64>, minor: Vec<f64>) -> Ticks {
    if round.len() < 3 || round.len() > most.max(3) {
        return linear(lo, hi, most);
    }
    let size = libm::floor(libm::log10(hi) + 1e-9) as i32;
    let exponent = if (-3..5).contains(&size) { 0 } else { size };
    let label = |v: f64| Some(super::number::short(v / ten_to(exponent), 3));
    let marked = round.into_iter().map(|v| Tick { value: v.clamp(lo, hi), label: label(v) });
    let plain = minor.into_iter().map(|v| Tick { value: v.clamp(lo, hi), label: None });
    let mut ticks: Vec<Tick> = marked.chain(plain).collect();
    ticks.sort_by(|a, b| a.value.total_cmp(&b.value));
    Ticks { ticks, exponent }
}

/// The f64 nearest to a power of ten.
pub(super) fn ten_to(n: i32) -> f64 {
    format!("1e{n}").parse().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &Ticks) -> Vec<&str> {
        ticks.labelled().map(|(_, label)| label).collect()
    }

    #[test]
    fn linear_ticks_are_round_and_keep_both_ends() {
        assert_eq!(labels(&linear(0.0, 1.0, 6)), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(&linear(-0.5, 0.5, 4)), ["−0.50", "−0.25", "0.00", "0.25", "0.50"]);
        assert_eq!(labels(&linear(0.0, 3000.0, 4)), ["0", "1000", "2000", "3000"]);
    }

    #[test]
    fn very_small_and_large_numbers_get_a_common_power() {
        let ticks = linear(0.0, 4e-16, 5);
        assert_eq!((labels(&ticks), ticks.exponent), (vec!["0", "1", "2", "3", "4"], -16));
        let ticks = linear(0.0, 2.5e9, 6);
        assert_eq!((labels(&ticks), ticks.exponent), (vec!["0.0", "0.5", "1.0", "1.5", "2.0", "2.5"], 9));
    }

    #[test]
    fn decades_are_labelled_as_powers_down_to_the_smallest() {
        assert_eq!(labels(&log(1e-16, 1e-13, 8)), ["10⁻¹⁶", "10⁻¹⁵", "10⁻¹⁴", "10⁻¹³"]);
        assert_eq!(labels(&log(1e-12, 1.0, 5)), ["10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "10⁰"]);
    }

    #[test]
    fn under_one_decade_there_are_labels_too() {
        assert_eq!(labels(&log(0.3, 6.0, 8)), ["0.5", "1", "2", "5"]);
        let narrow = log(1.2, 1.9, 8);
        assert_eq!(labels(&narrow), ["1.2", "1.3", "1.4", "1.5", "1.6", "1.7", "1.8", "1.9"]);
        let tiny = log(1.2e-7, 6e-7, 8);
        assert!(tiny.labelled().count() >= 2 && tiny.exponent == -7, "{tiny:?}");
    }

    #[test]
    fn fewer_labels_where_there_is_less_room() {
        let wide = fitting(Scale::Linear, 0.0, 1.0, 600.0, true, 14.0);
        let narrow = fitting(Scale::Linear, 0.0, 1.0, 120.0, true, 14.0);
        assert!(narrow.ticks.len() < wide.ticks.len() && narrow.ticks.len() >= 2);
    }
}
