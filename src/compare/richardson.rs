//! What three grids say where nothing is known: observed order, extrapolated value, grid convergence index.
//!
//! f(h) = f₀ + C h^p through three grids of any ratios: (f₃ − f₂)/(f₂ − f₁) = (h₃^p − h₂^p)/(h₂^p − h₁^p) is solved for p with
//! its sign. GCI = F_s |e|/(r^p − 1) (Roache, J. Fluids Eng. 116 (1994) 405; Celik et al., J. Fluids Eng. 130 (2008)
//! 078001, whose formula takes an absolute value that makes divergence look like convergence; not so here).

/// Roache's factor of safety for three grids or more.
pub const SAFETY: f64 = 1.25;

/// What follows from three grids.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extrapolation {
    /// Observed order; negative when the grids diverge.
    pub order: f64,
    /// f₀.
    pub value: f64,
    /// |f₁ − f₂|/|f₁|.
    pub approximate_error: f64,
    /// |f₀ − f₁|/|f₀|.
    pub extrapolated_error: f64,
    /// Of the finest grid, over |f₁|.
    pub gci: f64,
    /// r^p times the GCI of the finer pair over that of the coarser: 1 in the asymptotic range.
    pub asymptotic_ratio: f64,
}

/// Why three grids do not tell an order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoOrder {
    /// A value is not finite, or the grids are not ordered from fine to coarse.
    Unusable,
    /// Two grids show the same value.
    NoChange,
    /// The values swing about something: no power of h does that.
    Oscillating,
    /// The order would be beyond ±20.
    OutOfRange,
}

impl NoOrder {
    /// In notes.
    pub fn reason(self) -> &'static str {
        match self {
            Self::Unusable => "a grid has no value",
            Self::NoChange => "two grids show the same value",
            Self::Oscillating => "the values oscillate from grid to grid: no power of the spacing",
            Self::OutOfRange => "the values change like no power of the spacing",
        }
    }
}

/// No scheme has an order beyond it.
const LARGEST_ORDER: f64 = 20.0;

/// Extrapolates f from grids (h, f), from fine to coarse.
pub fn extrapolate(grids: [(f64, f64); 3]) -> Result<Extrapolation, NoOrder> {
    let [(h1, f1), (h2, f2), (h3, f3)] = grids;
    let ordered = 0.0 < h1 && h1 < h2 && h2 < h3;
    if !ordered || !grids.iter().all(|(h, f)| h.is_finite() && f.is_finite()) {
        return Err(NoOrder::Unusable);
    }
    let (fine, coarse) = (f2 - f1, f3 - f2);
    if fine == 0.0 || coarse == 0.0 {
        return Err(NoOrder::NoChange);
    }
    if coarse / fine < 0.0 {
        return Err(NoOrder::Oscillating);
    }
    let order = order(coarse / fine, h2 / h1, h3 / h2).ok_or(NoOrder::OutOfRange)?;
    let gained = (h2 / h1).powf(order) - 1.0;
    let value = f1 - fine / gained;
    let gci = |change: f64, f: f64, ratio: f64| SAFETY * (change / f).abs() / (ratio.powf(order) - 1.0).abs();
    let (gci_fine, gci_coarse) = (gci(fine, f1, h2 / h1), gci(coarse, f2, h3 / h2));
    Ok(Extrapolation {
        order,
        value,
        approximate_error: (fine / f1).abs(),
        extrapolated_error: ((value - f1) / value).abs(),
        gci: gci_fine,
        asymptotic_ratio: (h2 / h1).powf(order) * gci_fine / gci_coarse,
    })
}

/// p from (r₂₁^p (r₃₂^p − 1))/(r₂₁^p − 1) = change, which grows with p: by bisection.
fn order(change: f64, r21: f64, r32: f64) -> Option<f64> {
    let at = |p: f64| {
        // (e^{bp} − 1)/(1 − e^{−ap}), at p = 0 b/a.
        let (a, b) = (r21.ln(), r32.ln());
        if p == 0.0 { b / a } else { (b * p).exp_m1() / -(-a * p).exp_m1() }
    };
    let (mut low, mut high) = (-LARGEST_ORDER, LARGEST_ORDER);
    if !(at(low) < change && change < at(high)) {
        return None;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if at(middle) < change { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn published_grids_of_a_constant_ratio() {
        // NASA's example of grid convergence; its program prints 1.78618 from single precision.
        let found = extrapolate([(1.0, 0.97050), (2.0, 0.96854), (4.0, 0.96178)]).unwrap();
        assert_relative_eq!(found.order, 1.786_17, epsilon = 5e-6);
        assert_relative_eq!(found.value, 0.971_300, epsilon = 5e-7);
        assert_relative_eq!(found.gci, 1.031e-3, epsilon = 5e-7);
        assert_relative_eq!(found.asymptotic_ratio, 0.997_98, epsilon = 5e-6);
    }

    #[test]
    fn published_grids_of_unequal_ratios() {
        // By the procedure of Celik et al. (2008).
        let found = extrapolate([(1.0, 6.063), (1.5, 5.972), (2.0, 5.863)]).unwrap();
        assert_relative_eq!(found.order, 1.533_97, epsilon = 5e-6);
        assert_relative_eq!(found.value, 6.168_50, epsilon = 5e-6);
        assert_relative_eq!(found.approximate_error, 0.015_01, epsilon = 5e-6);
        assert_relative_eq!(found.extrapolated_error, 0.017_10, epsilon = 5e-6);
        assert_relative_eq!(found.gci, 0.021_75, epsilon = 5e-6);
    }

    #[test]
    fn a_power_is_found_with_its_sign() {
        for p in [-1.5, -0.3, 0.5, 1.0, 2.0, 7.0] {
            let f = |h: f64| 3.0 + 0.4 * h.powf(p);
            let found = extrapolate([(0.7, f(0.7)), (1.0, f(1.0)), (1.9, f(1.9))]).unwrap();
            assert_relative_eq!(found.order, p, epsilon = 1e-9);
            assert_relative_eq!(found.value, 3.0, epsilon = 1e-9);
        }
    }

    #[test]
    fn what_tells_no_order_says_why() {
        let of = |f: [f64; 3]| extrapolate([(1.0, f[0]), (2.0, f[1]), (4.0, f[2])]).unwrap_err();
        assert_eq!(of([1.0, 2.0, 1.5]), NoOrder::Oscillating);
        assert_eq!(of([1.0, 1.0, 1.5]), NoOrder::NoChange);
        assert_eq!(of([1.0, f64::NAN, 1.5]), NoOrder::Unusable);
        assert_eq!(of([1.0, 1.0 + 1e-12, 1e6]), NoOrder::OutOfRange);
        assert_eq!(extrapolate([(2.0, 1.0), (1.0, 2.0), (4.0, 3.0)]), Err(NoOrder::Unusable));
    }
}
