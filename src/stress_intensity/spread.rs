//! How much K depends on how it is read: tables over radii and terms, and the spread between readings.
//!
//! Where no exact answer is known the spread between methods that share little is an estimate of their error.

use super::{Annulus, Reading, Unreadable};

/// K read in one way.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// r_min over δ.
    pub inner: f64,
    /// r_max over δ.
    pub outer: f64,
    pub terms: usize,
    /// [K_I, K_II] in Pa√m at every look, or why there is none.
    pub history: Result<Vec<[f64; 2]>, Unreadable>,
}

/// Reads K for every pair of radii, given in units of δ, and every number of terms: `build` prepares a reading, `read`
/// takes it to the looks. Rows go through terms fastest, then outer radii.
pub fn table(
    horizon: f64,
    inner: &[f64],
    outer: &[f64],
    terms: &[usize],
    build: impl Fn(Annulus, usize) -> Result<Reading, Unreadable>,
    read: impl Fn(&Reading) -> Vec<[f64; 2]>,
) -> Vec<Row> {
    let mut rows = Vec::new();
    for &inner in inner {
        for &outer in outer {
            for &terms in terms {
                let annulus = Annulus { inner: inner * horizon, outer: outer * horizon };
                let history = build(annulus, terms).map(|reading| read(&reading));
                rows.push(Row { inner, outer, terms, history });
            }
        }
    }
    rows
}

/// Largest less smallest over the size of the mean. `None` for fewer than two values, NaN when one is not finite.
pub fn spread(values: &[f64]) -> Option<f64> {
    let (range, mean) = range_and_mean(values)?;
    Some(range / mean.abs())
}

/// The largest spread [K_I, K_II] between histories of equal looks, over the largest mean at any look: a K that passes
/// through zero does no harm. `None` for fewer than two histories or none at all of their looks in common; NaN when a
/// value is not finite.
pub fn spread_of_histories(histories: &[&[[f64; 2]]]) -> Option<[f64; 2]> {
    let looks = histories.first()?.len();
    if histories.iter().any(|history| history.len() != looks) {
        return None;
    }
    let of_mode = |mode: usize| -> Option<f64> {
        let (mut widest, mut peak) = (0.0_f64, 0.0_f64);
        for look in 0..looks {
            let values: Vec<f64> = histories.iter().map(|history| history[look][mode]).collect();
            let (range, mean) = range_and_mean(&values)?;
            if range.is_nan() {
                return Some(f64::NAN);
            }
            widest = widest.max(range);
            peak = peak.max(mean.abs());
        }
        (looks > 0).then_some(widest / peak)
    };
    Some([of_mode(0)?, of_mode(1)?])
}

fn range_and_mean(values: &[f64]) -> Option<(f64, f64)> {
    if values.len() < 2 {
        return None;
    }
    if values.iter().any(|value| !value.is_finite()) {
        return Some((f64::NAN, f64::NAN));
    }
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let smallest = values.iter().copied().fold(f64::INFINITY, f64::min);
    Some((largest - smallest, values.iter().sum::<f64>() / values.len() as f64))
}

#[cfg(test)]
mod tests {
    use super::super::interaction_integral::InteractionIntegral;
    use super::super::synthetic::{Potential, displacement, patch, sampled};
    use super::super::williams::Williams;
    use super::super::{Elastic, Tip};
    use super::*;

    #[test]
    fn spreads_by_hand_and_what_is_missing_is_not_small() {
        assert_eq!(spread(&[-1.0, -1.5, -2.0]), Some(1.0 / 1.5));
        assert_eq!(spread(&[1.0]), None);
        assert!(spread(&[1.0, f64::NAN]).unwrap().is_nan());
        let (a, b) = ([[0.0, 1.0], [2.0, 1.0]], [[0.5, 1.0], [2.0, 3.0]]);
        // K_I: 0.5 at the first look over a mean of 2 at the second; K_II: 2 over 2.
        assert_eq!(spread_of_histories(&[&a, &b]), Some([0.25, 1.0]));
        assert_eq!(spread_of_histories(&[&a]), None);
        assert_eq!(spread_of_histories(&[]), None);
        assert_eq!(spread_of_histories(&[&a, &b[..1]]), None);
        let broken = [[0.0, 1.0], [f64::INFINITY, 1.0]];
        let [one, two] = spread_of_histories(&[&a, &broken]).unwrap();
        assert!(one.is_nan() && two == 0.0);
    }

    /// Methods that share no code agree on a field with higher terms; the table says where it refuses.
    #[test]
    fn radii_terms_and_methods_agree_where_they_should() {
        let elastic = Elastic::new(2.5, 2.0, 3.0);
        let tip = Tip { sites: patch(30, 0.01), horizon: 0.03, crack: 1.0 };
        let field = [Potential::k([2.0, 1.0]), Potential::t(3.0), Potential::new(3, 1.0, -2.0)];
        let u = sampled(&tip.sites, |x| displacement(&elastic, &field, x));
        let a = vec![[0.0; 2]; u.len()];
        let build = |annulus, terms| Williams::over(annulus, terms).reading(&tip, &elastic);
        let rows = table(0.03, &[1.0, 2.0], &[6.0, 9.0], &[1, 3], build, |reading| vec![reading.at(&u, &a)]);
        let order: Vec<_> = rows.iter().map(|row| (row.inner, row.outer, row.terms)).collect();
        assert_eq!(order[..3], [(1.0, 6.0, 1), (1.0, 6.0, 3), (1.0, 9.0, 1)]);
        assert!(rows[..4].iter().all(|row| matches!(row.history, Err(Unreadable::InsideHorizon { .. }))));
        let k = |row: &Row| row.history.as_ref().unwrap()[0];
        // Too few terms, and then enough.
        assert!((k(&rows[6])[0] / 2.0 - 1.0).abs() > 0.02 && (k(&rows[7])[0] / 2.0 - 1.0).abs() < 1e-12);
        let integral = InteractionIntegral::over(Annulus { inner: 0.06, outer: 0.27 });
        let other = integral.reading(&tip, &elastic).unwrap().at(&u, &a);
        let apart = spread_of_histories(&[&[k(&rows[7])], &[other]]).unwrap();
        assert!(apart.iter().all(|apart| *apart < 2e-3), "{apart:?}");
    }
}
