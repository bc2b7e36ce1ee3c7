//! How far a history of K is from what is known, in the window, over the largest |K| that is known there.

use super::intensity::{Intensity, Read};
use pd_verify::compare::largest;

/// Errors of one history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Root mean square over the largest |reference|.
    pub rms: f64,
    /// Largest over the largest |reference|.
    pub max: f64,
    /// Mean, with its sign, over the largest |reference|.
    pub mean: f64,
    /// In L2, over that of the reference.
    pub l2: f64,
    /// |largest |K|/largest |reference| − 1|.
    pub peak: f64,
}

/// K and the reference at each look of the window; `None` where the reference is unknown at one of them, or there are
/// fewer than ten.
pub fn pairs(intensity: &Intensity, read: &Read) -> Option<Vec<(f64, f64)>> {
    paired(intensity, read, |t| intensity.known.at(t, read.a))
}

fn paired(intensity: &Intensity, read: &Read, known: impl Fn(f64) -> Option<f64>) -> Option<Vec<(f64, f64)>> {
    let mode = intensity.load.mode.index();
    let looks = read.times.iter().zip(&read.k).filter(|(t, _)| intensity.window.holds(**t));
    let pairs: Option<Vec<(f64, f64)>> = looks.map(|(t, k)| Some((k[mode], known(*t)?))).collect();
    pairs.filter(|pairs| pairs.len() >= 10)
}

/// Errors of a history; `None` where they cannot be known.
pub fn of(intensity: &Intensity, read: &Read) -> Option<Errors> {
    against(intensity, read, false)
}

/// The same, or against the published reference.
pub fn against(intensity: &Intensity, read: &Read, published: bool) -> Option<Errors> {
    let pairs = match published {
        false => pairs(intensity, read)?,
        true => paired(intensity, read, |t| intensity.known.published_at(t))?,
    };
    Some(of_pairs(&pairs)).filter(|errors| errors.rms.is_finite())
}

/// Errors of pairs (K, reference).
pub fn of_pairs(pairs: &[(f64, f64)]) -> Errors {
    let count = pairs.len() as f64;
    let most = |of: fn(&(f64, f64)) -> f64| pairs.iter().map(of).fold(0.0, f64::max);
    let peak = most(|(_, known)| known.abs());
    let squares: f64 = pairs.iter().map(|(k, known)| (k - known) * (k - known)).sum();
    let known: f64 = pairs.iter().map(|(_, known)| known * known).sum();
    Errors {
        rms: (squares / count).sqrt() / peak,
        max: most(|(k, known)| (k - known).abs()) / peak,
        mean: pairs.iter().map(|(k, known)| k - known).sum::<f64>() / count / peak,
        l2: (squares / known).sqrt(),
        peak: (most(|(k, _)| k.abs()) / peak - 1.0).abs(),
    }
}

/// The largest difference of two histories in the window over the largest |reference|.
pub fn apart(intensity: &Intensity, a: &Read, b: &Read) -> Option<f64> {
    let (a, b) = (pairs(intensity, a)?, pairs(intensity, b)?);
    let mixed: Vec<(f64, f64)> = a.iter().zip(&b).map(|(a, b)| (a.0 - b.0 + a.1, a.1)).collect();
    Some(of_pairs(&mixed)).filter(|errors| errors.rms.is_finite()).map(|errors| errors.max)
}

/// The largest |K| before the first wave arrives over the largest |reference| of the window; `None` without such a look.
pub fn early(intensity: &Intensity, read: &Read) -> Option<f64> {
    let mode = intensity.load.mode.index();
    let peak = pairs(intensity, read)?.iter().map(|pair| pair.1.abs()).fold(0.0, f64::max);
    let before = read.times.iter().zip(&read.k).filter(|(t, _)| **t < intensity.known.begins);
    largest(before.map(|(_, k)| k[mode].abs() / peak))
}

/// The factor by which one history is another's multiple in the window, by least squares.
pub fn ratio(intensity: &Intensity, a: &Read, b: &Read) -> Option<f64> {
    let (a, b) = (pairs(intensity, a)?, pairs(intensity, b)?);
    let both: f64 = a.iter().zip(&b).map(|(a, b)| a.0 * b.0).sum();
    let square: f64 = b.iter().map(|b| b.0 * b.0).sum();
    Some(both / square).filter(|ratio| ratio.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_over_the_largest_reference() {
        let errors = of_pairs(&[(1.1, 1.0), (1.9, 2.0), (-3.9, -4.0), (2.0, 2.0)]);
        assert!((errors.rms - (0.03_f64 / 4.0).sqrt() / 4.0).abs() < 1e-15);
        assert!((errors.max - 0.025).abs() < 1e-15 && (errors.mean - 0.1 / 16.0).abs() < 1e-15);
        assert!((errors.l2 - (0.03_f64 / 25.0).sqrt()).abs() < 1e-15);
        assert!((errors.peak - 0.025).abs() < 1e-15);
        assert!(of_pairs(&[(f64::NAN, 1.0), (1.0, 1.0)]).rms.is_nan());
    }
}
