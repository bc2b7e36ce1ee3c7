//! A history without what repeats itself: means over one period about each time.

/// Means over a period about each time, the values straight between looks; `None` where the period reaches beyond them.
pub fn smooth(times: &[f64], values: &[f64], period: f64) -> Vec<Option<f64>> {
    let (Some(&first), Some(&last)) = (times.first(), times.last()) else { return Vec::new() };
    let at = |t: f64| {
        let after = times.partition_point(|&time| time < t).clamp(1, times.len() - 1);
        let (a, b) = (times[after - 1], times[after]);
        values[after - 1] + (values[after] - values[after - 1]) * (t - a) / (b - a)
    };
    let mean = |&t: &f64| {
        let (from, to) = (t - 0.5 * period, t + 0.5 * period);
        let whole = from >= first && to <= last && times.len() > 1;
        const PARTS: usize = 32;
        let middle = |part: usize| at(from + (part as f64 + 0.5) / PARTS as f64 * period);
        whole.then(|| (0..PARTS).map(middle).sum::<f64>() / PARTS as f64)
    };
    times.iter().map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_period_is_averaged_away_and_a_line_stays() {
        let times: Vec<f64> = (0..200).map(|n| f64::from(n) * 0.05).collect();
        let wavy = |t: f64| 3.0 + 2.0 * t + libm::sin(std::f64::consts::TAU * t);
        let values: Vec<f64> = times.iter().map(|t| wavy(*t)).collect();
        let smoothed = smooth(&times, &values, 1.0);
        assert_eq!((smoothed[5], smoothed[195]), (None, None));
        for (t, mean) in times.iter().zip(&smoothed).filter_map(|(t, mean)| Some((t, (*mean)?))) {
            assert!((mean - 3.0 - 2.0 * t).abs() < 1e-3, "{t}: {mean}");
        }
    }
}
