//! Observed order of convergence: the slope of log error over log h, with its sign and its 95 % interval.

use crate::verdict::ObservedOrder;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// The order between two levels, from their actual ratio: ln(e₂/e₁)/ln(h₂/h₁). Negative when errors grow.
pub fn pairwise(coarse: (f64, f64), fine: (f64, f64)) -> Option<f64> {
    let order = (coarse.1 / fine.1).ln() / (coarse.0 / fine.0).ln();
    order.is_finite().then_some(order)
}

/// Least-squares order over (h, error) levels; `None` with fewer than two usable levels.
///
/// Levels whose error is zero, negative or not finite cannot carry an order and are left out.
pub fn fitted(levels: &[(f64, f64)]) -> Option<ObservedOrder> {
    let usable = |&&(h, error): &&(f64, f64)| h > 0.0 && error > 0.0 && (h * error).is_finite();
    let points: Vec<_> = levels.iter().filter(usable).map(|&(h, error)| (h.ln(), error.ln())).collect();
    let count = points.len() as f64;
    let mean = |f: fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let spread: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    let value = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / spread;
    if points.len() < 2 || !value.is_finite() {
        return None;
    }
    let residual: f64 = points.iter().map(|p| (p.1 - y - value * (p.0 - x)).powi(2)).sum();
    Some(ObservedOrder {
        value,
        interval: interval(value, residual, spread, points.len()),
        levels: points.len(),
    })
}

fn interval(value: f64, residual: f64, spread: f64, levels: usize) -> Option<(f64, f64)> {
    let freedom = levels.checked_sub(2).filter(|&n| n > 0)? as f64;
    let quantile = StudentsT::new(0.0, 1.0, freedom).ok()?.inverse_cdf(0.975);
    let half = quantile * (residual / freedom / spread).sqrt();
    Some((value - half, value + half))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn errors_that_grow_have_a_negative_order() {
        assert_relative_eq!(pairwise((2.0, 1e-3), (1.0, 2e-3)).unwrap(), -1.0, max_relative = 1e-15);
        assert_relative_eq!(
            fitted(&[(4.0, 1e-3), (2.0, 2e-3), (1.0, 4e-3)]).unwrap().value,
            -1.0,
            max_relative = 1e-14
        );
    }

    #[test]
    fn an_exact_power_has_a_point_interval_and_noise_widens_it() {
        let exact = fitted(&[(1.0, 1.0), (0.5, 0.25), (0.25, 0.0625), (0.125, 0.015_625)]).unwrap();
        let (low, high) = exact.interval.unwrap();
        assert!((exact.value - 2.0).abs() < 1e-14 && high - low < 1e-10 && exact.levels == 4);
        let noisy = fitted(&[(1.0, 1.0), (0.5, 0.3), (0.25, 0.05), (0.125, 0.02)]).unwrap();
        let (low, high) = noisy.interval.unwrap();
        assert!(low < 2.0 && 2.0 < high && high - low > 0.1);
    }

    #[test]
    fn too_little_is_no_order() {
        assert!(fitted(&[]).is_none());
        assert!(fitted(&[(1.0, 1.0), (0.5, 0.0)]).is_none());
        assert!(fitted(&[(1.0, 1.0), (0.5, 0.5)]).unwrap().interval.is_none());
        assert!(pairwise((1.0, 1.0), (0.5, 0.0)).is_none());
    }
}
