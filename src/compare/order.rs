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

/// The part of a refinement that carries an order.
#[derive(Debug, Clone, PartialEq)]
pub struct Tail {
    /// (h, error) from coarse to fine: the finest levels whose pairwise orders agree.
    pub levels: Vec<(f64, f64)>,
    /// Levels left out because their error is rounding.
    pub at_floor: usize,
    /// Levels left out because they are too coarse to show the order of the finer ones.
    pub too_coarse: usize,
    /// `None` with fewer than three levels that agree: outside the asymptotic range.
    pub order: Option<ObservedOrder>,
}

/// How far pairwise orders of one tail may be from the finest pair's: as far as an order is commonly claimed to.
pub const AGREEMENT: f64 = 0.1;

/// The finest levels above a floor whose pairwise orders lie within [`AGREEMENT`] of the finest pair's. A level that is
/// not finite leaves no order at all: what broke down is not coarse.
pub fn tail(levels: &[(f64, f64)], floor: f64) -> Tail {
    let sound = levels.iter().all(|level| level.1.is_finite());
    let resolved: Vec<(f64, f64)> = levels.iter().copied().filter(|level| level.1 > floor).collect();
    let orders: Vec<Option<f64>> = resolved.windows(2).map(|pair| pairwise(pair[0], pair[1])).collect();
    let finest = orders.last().copied().flatten();
    let agrees = |order: &Option<f64>| order.zip(finest).is_some_and(|(a, b)| (a - b).abs() <= AGREEMENT);
    let agreeing = orders.iter().rev().take_while(|order| agrees(order)).count();
    let used = if agreeing == 0 { 0 } else { agreeing + 1 };
    let tail = resolved[resolved.len() - used..].to_vec();
    Tail {
        at_floor: levels.iter().filter(|level| level.1 <= floor).count(),
        too_coarse: resolved.len() - used,
        order: if used >= 3 && sound { fitted(&tail) } else { None },
        levels: tail,
    }
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
    fn a_tail_leaves_out_what_is_coarse_and_what_is_rounding_and_says_so() {
        let levels =
            [(32.0, 3.0), (16.0, 2.0), (8.0, 0.64), (4.0, 0.16), (2.0, 0.04), (1.0, 0.01), (0.5, 1e-15)];
        let found = tail(&levels, 1e-13);
        assert_eq!((found.levels.len(), found.at_floor, found.too_coarse), (4, 1, 2));
        assert_relative_eq!(found.order.unwrap().value, 2.0, epsilon = 1e-12);
        // Of errors 1e-6, 6e-8, 4e-15, 5e-15 two levels are left: no order.
        let rounding = tail(&[(8.0, 1e-6), (4.0, 6e-8), (2.0, 4e-15), (1.0, 5e-15)], 1e-13);
        assert_eq!((rounding.at_floor, rounding.order), (2, None));
    }

    #[test]
    fn a_tail_of_orders_that_disagree_is_none() {
        let ragged = [(8.0, 1.0), (4.0, 0.3), (2.0, 0.2), (1.0, 0.02), (0.5, 0.019)];
        assert_eq!(tail(&ragged, 0.0).order, None);
        for broken in [f64::NAN, f64::INFINITY] {
            let levels = [(8.0, broken), (4.0, 0.16), (2.0, 0.04), (1.0, 0.01)];
            assert_eq!(tail(&levels, 0.0).order, None);
        }
        assert_eq!(tail(&[], 0.0).order, None);
        // A wrong order is an order: it is not hidden as inconclusive.
        let first = [(8.0, 0.8), (4.0, 0.4), (2.0, 0.2), (1.0, 0.1)];
        assert_relative_eq!(tail(&first, 0.0).order.unwrap().value, 1.0, epsilon = 1e-12);
    }

    #[test]
    fn too_little_is_no_order() {
        assert!(fitted(&[]).is_none());
        assert!(fitted(&[(1.0, 1.0), (0.5, 0.0)]).is_none());
        assert!(fitted(&[(1.0, 1.0), (0.5, 0.5)]).unwrap().interval.is_none());
        assert!(pairwise((1.0, 1.0), (0.5, 0.0)).is_none());
    }
}
