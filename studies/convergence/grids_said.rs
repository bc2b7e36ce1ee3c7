//! What three grids say of the next and of the limit, as evidence: values are (Δx, f) from coarse to fine.

use crate::question::error_of;
use pd_verify::compare::richardson::{Extrapolation, NoOrder, extrapolate};
use pd_verify::verdict::Evidence;

/// The three grids that end so many before the finest, extrapolated.
pub fn extrapolated(values: &[(f64, f64)], before: usize) -> Result<Extrapolation, NoOrder> {
    match values[..values.len() - before] {
        [.., coarse, middle, fine] => extrapolate([fine, middle, coarse]),
        _ => Err(NoOrder::Unusable),
    }
}

/// Values that change by a smaller power of Δx than this go nowhere.
const LEAST_ORDER: f64 = 0.1;

/// What three grids tell, or the evidence that they tell nothing; grids that diverge fail.
fn told(name: &str, values: &[(f64, f64)], before: usize) -> Result<Extrapolation, Box<Evidence>> {
    match extrapolated(values, before) {
        Err(none) => Err(Box::new(untold(name, none, values))),
        Ok(found) if found.order < LEAST_ORDER => {
            let note = format!("{name}: the grids diverge, order {:.3}", found.order);
            let error = error_of(Some(f64::INFINITY), note);
            Err(Box::new(Evidence { computed: Some(found.order), reference: Some(1.0), ..error }))
        }
        Ok(found) => Ok(found),
    }
}

/// Evidence of what three grids do not tell.
fn untold(name: &str, none: NoOrder, values: &[(f64, f64)]) -> Evidence {
    let finite = values.iter().all(|(_, value)| value.is_finite());
    Evidence {
        outside: finite.then(|| none.reason().to_owned()),
        note: format!("{name}: {}", none.reason()),
        ..Evidence::default()
    }
}

/// How far the finest value is from the extrapolation of the grids before, over their band.
pub fn band(name: &str, values: &[(f64, f64)]) -> Evidence {
    match told(name, values, 1) {
        Err(evidence) => *evidence,
        Ok(found) => {
            let finest = values[values.len() - 1].1;
            let half = found.gci * values[values.len() - 2].1.abs();
            let note = format!("{name}: {finest:.6} in {:.6} ± {half:.6}", found.value);
            error_of(Some((finest - found.value).abs() / half), note)
        }
    }
}

/// The last change over the one that the three grids before predict.
pub fn change(name: &str, values: &[(f64, f64)]) -> Evidence {
    match told(name, values, 1) {
        Err(evidence) => *evidence,
        Ok(found) => {
            let [.., (h, f), (finer, finest)] = values[..] else { return Evidence::default() };
            let predicted = (f - found.value) * (libm::pow(finer / h, found.order) - 1.0);
            let ratio = (finest - f) / predicted;
            let note =
                format!("{name}: {:.3e} against {predicted:.3e} by order {:.3}", finest - f, found.order);
            Evidence {
                computed: Some(ratio),
                reference: Some(1.0),
                error: Some((ratio - 1.0).abs()),
                note,
                ..Evidence::default()
            }
        }
    }
}

/// The order of the three finest grids beside 1.
pub fn order(name: &str, values: &[(f64, f64)]) -> Evidence {
    match told(name, values, 0) {
        Err(evidence) => *evidence,
        Ok(found) => Evidence {
            computed: Some(found.order),
            reference: Some(1.0),
            error: Some((found.order - 1.0).abs()),
            note: format!("{name}: the three finest grids, extrapolated {:.6}", found.value),
            ..Evidence::default()
        },
    }
}

/// How far the extrapolation of the finest grids is from the exact answer, over its band.
pub fn known(name: &str, values: &[(f64, f64)], exact: f64) -> Evidence {
    match told(name, values, 0) {
        Err(evidence) => *evidence,
        Ok(found) => {
            let half = found.gci * values[values.len() - 1].1.abs();
            let note = format!("{name}: {exact:.6} in {:.6} ± {half:.6}", found.value);
            error_of(Some((found.value - exact).abs() / half), note)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grids(f: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        [1.0, 0.5, 0.25, 0.125].map(|h| (h, f(h))).to_vec()
    }

    #[test]
    fn grids_that_diverge_fail_every_claim() {
        for f in [|h: f64| 1.0 + 0.05 * h.powf(-0.3), |h: f64| 1.0 - 0.05 * h.ln()] {
            let values = grids(f);
            for found in
                [band("x", &values), change("x", &values), order("x", &values), known("x", &values, 1.0)]
            {
                assert_eq!(found.error, Some(f64::INFINITY), "{found:?}");
            }
        }
    }

    #[test]
    fn a_power_is_predicted_and_its_limit_is_in_the_band() {
        let values = grids(|h| 3.0 + h.powf(1.5));
        assert!(change("x", &values).error.unwrap() < 1e-9);
        assert!((order("x", &values).computed.unwrap() - 1.5).abs() < 1e-9);
        // 0.125^p of a band of 1.25 · 0.25^p.
        assert!((band("x", &values).error.unwrap() - 0.5_f64.powf(1.5) / 1.25).abs() < 1e-9);
        assert!(known("x", &values, 3.0).error.unwrap() < 1e-9);
        // The band is 1.25 times the last error wide.
        assert!((known("x", &values, 3.0 - 0.125_f64.powf(1.5)).error.unwrap() - 0.8).abs() < 1e-9);
    }

    #[test]
    fn a_grid_that_breaks_away_leaves_the_band() {
        let mut values = grids(|h| 3.0 + h);
        values[3].1 = 2.6;
        assert!(band("x", &values).error.unwrap() > 1.0 && change("x", &values).error.unwrap() > 0.1);
    }

    #[test]
    fn what_oscillates_or_is_missing_is_no_pass() {
        let swings = grids(|h| 3.0 + if h == 0.5 { 1.0 } else { 0.0 } + h);
        let said = band("x", &swings);
        assert!(said.error.is_none() && said.outside.unwrap().contains("oscillate"));
        let mut missing = grids(|h| 3.0 + h);
        missing[1].1 = f64::NAN;
        let said = change("x", &missing);
        assert!(said.error.is_none() && said.outside.is_none());
    }
}
