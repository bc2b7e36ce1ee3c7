//! Three levels: the order and the size of their errors from the two differences that can be seen.
//!
//! Errors E_i of sizes h_i^p have the correlation (h_fine/h_coarse)^κ between two levels. Then ‖E₁ − E₂‖, ‖E₂ − E₃‖ and the cosine between them
//! are known functions of p and κ, and both are found from these by bisection.

/// What three levels tell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triple {
    pub order: f64,
    /// κ: 0 where errors are multiples of each other, large where they have nothing in common.
    pub narrowing: f64,
    /// Of the finest level.
    pub error: f64,
    /// Its Δx.
    pub spacing: f64,
}

/// No scheme has an order beyond, or diverges faster. Halving does not come upon 0, where all levels are alike.
const ORDERS: (f64, f64) = (-3.7, 12.1);

/// Errors of levels that are so much apart as these have nothing in common.
const NARROWEST: f64 = 60.0;

/// How far below what the model allows a cosine may be: what few looks at narrow errors scatter.
const SLACK: f64 = 0.1;

/// Halvings of an interval: to its last bit.
const HALVINGS: usize = 80;

impl Triple {
    /// Of levels from coarse to fine, by the sizes of their two differences and the cosine between these.
    pub fn of(h: [f64; 3], sizes: [f64; 2], cosine: f64) -> Result<Self, &'static str> {
        if sizes.contains(&0.0) || cosine.is_nan() {
            return Err("levels differ like no power of the spacing: two are the same");
        }
        let ratio = sizes[0] / sizes[1];
        let at = |narrowing: f64| {
            let order = bisected(ORDERS, |order| Seen::of(h, order, narrowing).ratio() < ratio)?;
            Some((order, Seen::of(h, order, narrowing)))
        };
        let outside = "levels differ like no power of the spacing";
        let (_, loosest) = at(NARROWEST).ok_or(outside)?;
        if cosine < loosest.cosine() - SLACK {
            return Err("levels swing about something: no power of the spacing does that");
        }
        let falls = |narrowing: f64| at(narrowing).is_some_and(|(_, seen)| seen.cosine() > cosine);
        let narrowing = bisected((0.0, NARROWEST), falls).unwrap_or(if falls(0.0) { NARROWEST } else { 0.0 });
        let (order, seen) = at(narrowing).ok_or(outside)?;
        // The model has errors of 1 on the coarsest level.
        let error = sizes[1] / seen.sizes[1] * (h[2] / h[0]).powf(order);
        Ok(Self { order, narrowing, error, spacing: h[2] })
    }

    /// The error of a level at Δx in m that is so far from the finest.
    pub fn error_at(&self, spacing: f64, apart: f64) -> f64 {
        let alike = (self.spacing / spacing).powf(self.narrowing);
        let across = apart * apart - self.error * self.error * (1.0 - alike * alike);
        alike * self.error + across.max(0.0).sqrt()
    }
}

/// What two differences of three levels look like.
struct Seen {
    sizes: [f64; 2],
    product: f64,
}

impl Seen {
    fn of(h: [f64; 3], order: f64, narrowing: f64) -> Self {
        let size = h.map(|one| (one / h[0]).powf(order));
        let both = |a: usize, b: usize| size[a] * size[b] * (h[b] / h[a]).powf(narrowing);
        let apart = |a: usize, b: usize| (both(a, a) + both(b, b) - 2.0 * both(a, b)).sqrt();
        let product = both(0, 1) - both(0, 2) - both(1, 1) + both(1, 2);
        Self { sizes: [apart(0, 1), apart(1, 2)], product }
    }

    /// Of the coarser difference over the finer: it grows with the order.
    fn ratio(&self) -> f64 {
        self.sizes[0] / self.sizes[1]
    }

    fn cosine(&self) -> f64 {
        self.product / (self.sizes[0] * self.sizes[1])
    }
}

/// Where what holds at the lower end ceases to; `None` where it does not hold there or holds at the upper end.
fn bisected((mut low, mut high): (f64, f64), holds: impl Fn(f64) -> bool) -> Option<f64> {
    if !holds(low) || holds(high) {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if holds(middle) { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pd_verify::compare::richardson::extrapolate;

    const H: [f64; 3] = [0.36, 0.24, 0.1];

    #[test]
    fn multiples_of_one_error_are_what_richardson_extrapolates() {
        for p in [0.5, 1.0, 2.0, 3.3] {
            let f = H.map(|h: f64| 7.0 - 0.3 * h.powf(p));
            let by_values = extrapolate([(H[2], f[2]), (H[1], f[1]), (H[0], f[0])]).unwrap();
            let found = Triple::of(H, [f[1] - f[0], f[2] - f[1]], 1.0).unwrap();
            assert!((found.order - by_values.order).abs() < 1e-9 && (found.order - p).abs() < 1e-9);
            assert!((found.error / (by_values.value - f[2]) - 1.0).abs() < 1e-6, "{found:?}");
            // Each level's distance from the finest gives its own error.
            for (h, f_h) in H.iter().zip(f) {
                let error = found.error_at(*h, f[2] - f_h);
                assert!((error / (0.3 * h.powf(p)) - 1.0).abs() < 1e-6, "{h}");
            }
        }
    }

    /// Errors along axes of their own, of correlation 1/2 and 1/4: (1, 0, 0), (1/2, √3/2, 0), and (1/4, √3/4, √3/2), times h.
    #[test]
    fn errors_that_turn_are_found_by_hand() {
        let h = [4.0, 2.0, 1.0];
        let unit = [[1.0, 0.0, 0.0], [0.5, 0.75_f64.sqrt(), 0.0], [0.25, 0.1875_f64.sqrt(), 0.75_f64.sqrt()]];
        let error = |n: usize| unit[n].map(|x| x * h[n]);
        let minus = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let (one, two) = (minus(error(0), error(1)), minus(error(1), error(2)));
        let sizes = [dot(one, one).sqrt(), dot(two, two).sqrt()];
        let found = Triple::of(h, sizes, dot(one, two) / (sizes[0] * sizes[1])).unwrap();
        assert!((found.order - 1.0).abs() < 1e-9 && (found.narrowing - 1.0).abs() < 1e-9, "{found:?}");
        assert!((found.error - 1.0).abs() < 1e-9);
        let far = minus(error(0), error(2));
        assert!((found.error_at(4.0, dot(far, far).sqrt()) - 4.0).abs() < 1e-9);
    }

    #[test]
    fn what_no_power_does_is_no_order() {
        assert!(Triple::of(H, [1.0, 0.5], -0.95).unwrap_err().contains("swing"));
        assert!(Triple::of(H, [1.0, 0.0], f64::NAN).unwrap_err().contains("two are the same"));
        assert!(Triple::of(H, [1e9, 1e-9], 1.0).unwrap_err().contains("no power"));
        assert!(Triple::of(H, [0.1, 1.0], 1.0).unwrap().order < 0.0);
    }
}
