//! Work and precision: which runs no other beats, and what a given error costs along a refinement.

/// Indices of the (cost, error) points that no other point beats, by growing cost: none is as cheap and as accurate and
/// better in one of the two. Of equal points the first stands. What is not finite, or negative, is never among them.
pub fn frontier(points: &[(f64, f64)]) -> Vec<usize> {
    let sound = |&(cost, error): &(f64, f64)| cost >= 0.0 && error >= 0.0 && (cost + error).is_finite();
    let mut order: Vec<usize> = (0..points.len()).filter(|&at| sound(&points[at])).collect();
    let by = |&a: &usize, &b: &usize| {
        let (a, b) = (points[a], points[b]);
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    };
    order.sort_by(by);
    let mut least = f64::INFINITY;
    order.retain(|&at| {
        let better = points[at].1 < least;
        least = least.min(points[at].1);
        better
    });
    order
}

/// x where the error of a refinement has fallen to `target` for good: straight in the logarithms between the last level
/// whose error is above it and the next. `levels` are (x, error) from coarse to fine, x positive.
///
/// `None` where the finest level is not that accurate, or an error is no number: nothing is extrapolated to finer levels.
/// Where all levels are more accurate it is x of the coarsest.
pub fn reached(levels: &[(f64, f64)], target: f64) -> Option<f64> {
    if !levels.iter().all(|&(x, error)| x > 0.0 && error >= 0.0 && (x * error).is_finite()) {
        return None;
    }
    let Some(above) = levels.iter().rposition(|level| level.1 > target) else {
        return levels.first().map(|level| level.0);
    };
    let (coarse, fine) = (levels[above], *levels.get(above + 1)?);
    let share = (coarse.1 / target).ln() / (coarse.1 / fine.1).ln();
    Some(coarse.0 * (fine.0 / coarse.0).powf(share))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn the_frontier_by_hand() {
        let points = [(1.0, 0.5), (2.0, 0.5), (2.0, 0.1), (3.0, 0.2), (4.0, 0.01), (4.0, 0.01), (9.0, 0.02)];
        assert_eq!(frontier(&points), [0, 2, 4]);
        assert_eq!(frontier(&[(f64::NAN, 0.0), (1.0, f64::NAN), (2.0, 1.0), (-1.0, 0.5)]), [2]);
        assert!(frontier(&[]).is_empty());
    }

    /// By the definition, pair by pair, on points of a fixed scatter.
    #[test]
    fn the_frontier_is_what_no_other_point_beats() {
        let scatter = |n: u32| f64::from((n.wrapping_mul(2_654_435_761) >> 16) % 1009);
        let points: Vec<(f64, f64)> =
            (0..200).map(|n| (scatter(n * n + 7 * n), scatter(n * n * n + 31))).collect();
        let beaten = |at: usize| {
            points.iter().enumerate().any(|(other, &(cost, error))| {
                let (own_cost, own_error) = points[at];
                let as_good = cost <= own_cost && error <= own_error;
                as_good && (cost < own_cost || error < own_error || other < at)
            })
        };
        let mut found = frontier(&points);
        found.sort_unstable();
        let expected: Vec<usize> = (0..points.len()).filter(|&at| !beaten(at)).collect();
        assert_eq!(found, expected);
        assert!(expected.len() > 2);
    }

    #[test]
    fn an_error_is_reached_on_the_power_law_between_levels() {
        // error = cost^(−2/3): 0.01 at cost 1000.
        let levels: Vec<(f64, f64)> = [10.0, 640.0, 5120.0].map(|x: f64| (x, x.powf(-2.0 / 3.0))).to_vec();
        assert_relative_eq!(reached(&levels, 0.01).unwrap(), 1000.0, max_relative = 1e-12);
        assert_eq!(reached(&levels, 1e-4), None);
        assert_eq!(reached(&levels, 0.9), Some(10.0));
    }

    #[test]
    fn an_error_that_rises_again_is_not_reached_before() {
        let levels = [(1.0, 0.1), (2.0, 0.001), (4.0, 0.02), (8.0, 0.005)];
        let found = reached(&levels, 0.01).unwrap();
        assert!(found > 4.0 && found < 8.0);
        assert_eq!(reached(&[(1.0, 0.1), (2.0, f64::NAN), (4.0, 0.001)], 0.01), None);
        assert_eq!(reached(&[], 0.01), None);
    }
}
