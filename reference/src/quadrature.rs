//! Integrals of smooth functions over an interval, to about 31 digits.
//!
//! Gauss–Legendre with 32 nodes to a panel: ∫ f ≈ Σ w_i f(x_i), x_i the zeros of the Legendre polynomial P₃₂,
//! w_i = 2/((1 − x_i²) P₃₂'(x_i)²) on (−1, 1); exact for polynomials of degree 63 (Abramowitz and Stegun 25.4.29).

use std::sync::LazyLock;

use crate::double_double::Dd;

/// Nodes to a panel.
const NODES: usize = 32;

/// Node and weight on (−1, 1), the nodes by Newton's method.
static RULE: LazyLock<Vec<(Dd, Dd)>> = LazyLock::new(|| {
    (0..NODES)
        .map(|i| {
            let guess = libm::cos(std::f64::consts::PI * (i as f64 + 0.75) / (NODES as f64 + 0.5));
            let x = (0..6).fold(Dd::from(guess), |x, _| {
                let (value, slope) = legendre(x);
                x - value / slope
            });
            let slope = legendre(x).1;
            (x, Dd::from(2.0) / ((Dd::ONE - x.squared()) * slope.squared()))
        })
        .collect()
});

/// P₃₂(x) and its derivative, by the three-term recurrence.
fn legendre(x: Dd) -> (Dd, Dd) {
    let (mut before, mut value) = (Dd::ONE, x);
    for n in 2..=NODES {
        let n_f64 = n as f64;
        let next = (x * value * (2.0 * n_f64 - 1.0) - before * (n_f64 - 1.0)) / Dd::from(n_f64);
        (before, value) = (value, next);
    }
    let slope = (before - x * value) * NODES as f64 / (Dd::ONE - x.squared());
    (value, slope)
}

/// Nodes and weights of one panel from `start` to `end`.
pub(crate) fn panel(start: Dd, end: Dd) -> impl Iterator<Item = (Dd, Dd)> {
    let (middle, half) = ((start + end) * 0.5, (end - start) * 0.5);
    RULE.iter().map(move |(x, weight)| (middle + half * *x, half * *weight))
}

/// The same in doubles, for integrands that are doubles.
pub(crate) fn panel_f64(start: f64, end: f64) -> impl Iterator<Item = (f64, f64)> {
    panel(Dd::from(start), Dd::from(end)).map(|(x, weight)| (x.to_f64(), weight.to_f64()))
}

/// Nodes and weights of `count` equal panels over (0, 1).
pub(crate) fn panels(count: usize) -> impl Iterator<Item = (Dd, Dd)> {
    let edge = move |i: usize| Dd::from(i as f64) / Dd::from(count as f64);
    (0..count).flat_map(move |i| panel(edge(i), edge(i + 1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_up_to_degree_63_are_integrated_exactly() {
        for degree in [0, 1, 2, 7, 30, 62, 63] {
            let integral: Dd =
                panel(Dd::ZERO, Dd::ONE).map(|(x, w)| (0..degree).fold(w, |product, _| product * x)).sum();
            let error = (integral * (degree as f64 + 1.0) - Dd::ONE).to_f64();
            assert!(error.abs() < 1e-29, "degree {degree}: {error:e}");
        }
        let beyond: Dd =
            panel(Dd::ZERO, Dd::ONE).map(|(x, w)| (0..90).fold(w, |product, _| product * x)).sum();
        assert!((beyond * 91.0 - Dd::ONE).to_f64().abs() > 1e-29, "degree 90 cannot be exact with 32 nodes");
    }

    #[test]
    fn an_exponential_over_three_panels() {
        let integral: Dd = panels(3).map(|(x, weight)| weight * x.exp()).sum();
        let error = integral - (Dd::ONE.exp() - Dd::ONE);
        assert!(error.to_f64().abs() < 1e-30, "{error:?}");
    }
}
