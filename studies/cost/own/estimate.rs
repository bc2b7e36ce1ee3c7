//! What levels say of their errors where no answer is known: order, and size from the differences of their histories.
//!
//! Errors are taken to fall like h^p and to be alike from level to level by a correlation (h_fine/h_coarse)^κ. With κ = 0 the lack is C(t) h^p
//! and this is Richardson's extrapolation. At kinks and jumps it is not: what is wrong there grows narrower with h, neighbouring levels
//! are wrong at other times, and Richardson's error would be several times too large. p and κ follow from two differences of three
//! levels: the ratio of their sizes and the cosine between them. Sizes are root mean squares over time, of all components of a
//! result, over its largest size. The last two triples must agree in p; else there is none, and no number.

use super::triple::Triple;
use pd_verify::compare::richardson::SAFETY;
use pd_verify::record::Trace;

/// Times at which levels are held against each other.
const TIMES: usize = 10_000;

/// Orders of successive triples may differ by this factor.
const AGREEMENT: f64 = 1.5;

/// Cells of a level over those of the next coarser that counts beside it: differences of closer ones are what scatters.
const APART: f64 = 1.25;

/// Differences of less than this part of the result are rounding.
const ROUNDING: f64 = 1e-10;

/// Levels that an order takes.
pub const LEVELS: usize = 4;

/// What was seen of one result on one level.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    pub name: String,
    /// In s, growing.
    pub times: Vec<f64>,
    pub rows: Vec<Vec<f64>>,
}

impl From<&Trace> for History {
    fn from(trace: &Trace) -> Self {
        Self { name: trace.probe.clone(), times: trace.times.clone(), rows: trace.rows.clone() }
    }
}

impl History {
    /// Every component at a time, by the cubic through the four looks around it.
    fn at(&self, time: f64) -> Vec<f64> {
        let after = self.times.partition_point(|&t| t <= time);
        let from = after.saturating_sub(2).min(self.times.len().saturating_sub(4));
        let around = from..(from + 4).min(self.times.len());
        let weight = |one: usize| -> f64 {
            let others = around.clone().filter(|&other| other != one);
            others.map(|other| (time - self.times[other]) / (self.times[one] - self.times[other])).product()
        };
        let mut values = vec![0.0; self.rows.first().map_or(0, Vec::len)];
        for one in around.clone() {
            let weight = weight(one);
            values.iter_mut().zip(&self.rows[one]).for_each(|(value, seen)| *value += weight * seen);
        }
        values
    }
}

/// How the error of one result falls.
#[derive(Debug, Clone, PartialEq)]
pub struct Law {
    pub name: String,
    /// `None` where levels differ by rounding alone.
    pub order: Option<f64>,
    /// Δx of the finest level in m, and its error.
    pub spacing: f64,
    pub error: f64,
    /// Of every level, from coarse to fine, by its distance from the finest.
    pub errors: Vec<f64>,
    /// Of the triples that end at each level; `None` where it does not count beside a finer one, and of the first two.
    pub orders: Vec<Option<f64>>,
}

/// How the error of a scene falls: that of its worst result.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    pub laws: Vec<Law>,
}

impl Law {
    /// The error at Δx in m.
    pub fn at(&self, spacing: f64) -> f64 {
        self.order.map_or(self.error, |order| self.error * (spacing / self.spacing).powf(order))
    }
}

impl Estimate {
    /// From levels of (Δx in m, results), from coarse to fine, or why they say nothing.
    pub fn new(levels: &[(f64, &[History])]) -> Result<Self, String> {
        let kept = apart_enough(levels);
        if kept.len() < LEVELS {
            return Err(format!("{} levels are too few to tell an order: it takes {LEVELS}", kept.len()));
        }
        let results = levels[0].1.len();
        let mut laws = Vec::new();
        for index in 0..results {
            let of: Vec<(f64, &History)> = levels.iter().map(|(h, seen)| (*h, &seen[index])).collect();
            laws.extend(law(&of, &kept)?);
        }
        if laws.is_empty() {
            Err("nothing moves where the scene is watched".into())
        } else {
            Ok(Self { laws })
        }
    }

    /// The worst result at Δx in m.
    pub fn worst(&self, spacing: f64) -> &Law {
        let worst = self.laws.iter().max_by(|a, b| a.at(spacing).total_cmp(&b.at(spacing)));
        worst.expect("an estimate has a law")
    }

    /// The largest error at Δx in m.
    pub fn at(&self, spacing: f64) -> f64 {
        self.worst(spacing).at(spacing)
    }

    /// The largest error of each level, from coarse to fine.
    pub fn errors(&self) -> Vec<f64> {
        let count = self.laws[0].errors.len();
        (0..count).map(|n| self.laws.iter().map(|law| law.errors[n]).fold(0.0, f64::max)).collect()
    }

    /// The largest Δx in m of which every result is as accurate as asked, with Roache's factor of safety.
    pub fn spacing_for(&self, error: f64) -> f64 {
        let of = |law: &Law| match law.order {
            Some(order) => law.spacing * (error / (SAFETY * law.error)).powf(1.0 / order),
            None if SAFETY * law.error <= error => f64::INFINITY,
            None => 0.0,
        };
        self.laws.iter().map(of).fold(f64::INFINITY, f64::min)
    }
}

/// Levels that count, from coarse to fine: the finest, and each that is coarse enough beside the next that counts.
fn apart_enough(levels: &[(f64, &[History])]) -> Vec<usize> {
    let mut kept: Vec<usize> = Vec::new();
    for index in (0..levels.len()).rev() {
        let finer = kept.last().map_or(0.0, |&finer| levels[finer].0);
        if levels[index].0 >= (APART - 1e-9) * finer {
            kept.push(index);
        }
    }
    kept.reverse();
    kept
}

/// The law of one result, by those levels that count; `None` where nothing is ever seen of it.
fn law(levels: &[(f64, &History)], kept: &[usize]) -> Result<Option<Law>, String> {
    let name = levels[0].1.name.clone();
    let sampled = sample(levels).ok_or_else(|| format!("{name} is not seen often enough"))?;
    let h: Vec<f64> = levels.iter().map(|(h, _)| *h).collect();
    let last = h.len() - 1;
    let columns = levels[0].1.rows[0].len();
    let peak = peak(&sampled[last], columns);
    if peak == 0.0 {
        return Ok(None);
    }
    let product = |a: &[f64], b: &[f64]| dot(a, b) / (TIMES as f64 * peak * peak);
    let apart: Vec<Vec<f64>> =
        kept.windows(2).map(|pair| minus(&sampled[pair[0]], &sampled[pair[1]])).collect();
    let sizes: Vec<f64> = apart.iter().map(|apart| product(apart, apart).sqrt()).collect();
    if sizes.iter().any(|size| !size.is_finite()) {
        return Err(format!("{name} is not finite on every level"));
    }
    let triple = |n: usize| {
        let cosine = product(&apart[n - 2], &apart[n - 1]) / (sizes[n - 2] * sizes[n - 1]);
        Triple::of([h[kept[n - 2]], h[kept[n - 1]], h[kept[n]]], [sizes[n - 2], sizes[n - 1]], cosine)
    };
    let end = kept.len() - 1;
    let mut orders = vec![None; h.len()];
    (2..=end).for_each(|n| orders[kept[n]] = triple(n).ok().map(|triple| triple.order));
    let from_finest = |one: &Vec<f64>| {
        let apart = minus(one, &sampled[last]);
        product(&apart, &apart).sqrt()
    };
    if sizes[end - 1] < ROUNDING {
        let errors = sampled.iter().map(from_finest).collect();
        return Ok(Some(Law { name, order: None, spacing: h[last], error: sizes[end - 1], errors, orders }));
    }
    let named = |why: &str| format!("{name}: {why}");
    let (coarser, finer) = (triple(end - 1).map_err(named)?, triple(end).map_err(named)?);
    if finer.order <= 0.0 || coarser.order <= 0.0 {
        return Err(format!(
            "{name}: levels move apart, by orders {:.2} and {:.2}",
            coarser.order, finer.order
        ));
    }
    if !(1.0 / AGREEMENT..=AGREEMENT).contains(&(finer.order / coarser.order)) {
        return Err(format!("{name}: orders scatter, {:.2} and then {:.2}", coarser.order, finer.order));
    }
    let errors = h.iter().zip(&sampled).map(|(h, one)| finer.error_at(*h, from_finest(one))).collect();
    Ok(Some(Law { name, order: Some(finer.order), spacing: h[last], error: finer.error, errors, orders }))
}

/// All levels at the same times, component after component at each; `None` where they have none in common.
fn sample(levels: &[(f64, &History)]) -> Option<Vec<Vec<f64>>> {
    let ends = |seen: &History| Some((*seen.times.first()?, *seen.times.last()?));
    let (mut from, mut to) = ends(levels[0].1)?;
    for (_, seen) in levels {
        let (first, last) = ends(seen)?;
        (from, to) = (from.max(first), to.min(last));
    }
    if to <= from {
        return None;
    }
    let time = |n: usize| from + (to - from) * n as f64 / (TIMES - 1) as f64;
    let of = |seen: &History| (0..TIMES).flat_map(|n| seen.at(time(n))).collect();
    Some(levels.iter().map(|(_, seen)| of(seen)).collect())
}

/// The largest size of a vector over time.
fn peak(values: &[f64], columns: usize) -> f64 {
    values.chunks(columns).map(|row| dot(row, row).sqrt()).fold(0.0, f64::max)
}

fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Levels of sin t + h^p cos 3t + other, looked at at times of their own.
    fn levels(hs: &[f64], p: f64, other: fn(f64, usize) -> f64) -> Vec<(f64, Vec<History>)> {
        let of = |(n, &h): (usize, &f64)| {
            let looks = (40.0 / h).ceil() as usize;
            let times: Vec<f64> = (0..=looks).map(|k| 6.0 * k as f64 / looks as f64).collect();
            let at = |t: &f64| vec![t.sin() + h.powf(p) * (3.0 * t).cos() + other(*t, n)];
            (h, vec![History { name: "u".into(), rows: times.iter().map(at).collect(), times }])
        };
        hs.iter().enumerate().map(of).collect()
    }

    fn estimate(levels: &[(f64, Vec<History>)]) -> Result<Estimate, String> {
        let all: Vec<(f64, &[History])> = levels.iter().map(|(h, seen)| (*h, seen.as_slice())).collect();
        Estimate::new(&all)
    }

    const HS: [f64; 5] = [0.35, 0.24, 0.16, 0.1, 0.07];

    #[test]
    fn a_power_is_found_with_its_error() {
        for p in [0.5, 1.0, 2.0] {
            let found = estimate(&levels(&HS, p, |_, _| 0.0)).unwrap();
            let law = found.worst(0.07);
            // The finest result is nearly sin t: the largest size is about 1, the mean square of cos 3t a half.
            assert!((law.order.unwrap() - p).abs() < 1e-2, "{p}: {law:?}");
            for (&h, &error) in HS.iter().zip(&found.errors()) {
                let exact = h.powf(p) * 0.5_f64.sqrt();
                assert!((error / exact - 1.0).abs() < 0.3, "{p}, {h}: {error} {exact}");
                assert!((found.at(h) / error - 1.0).abs() < 0.05, "{p}, {h}");
            }
            // The spacing for an error has that error, with the factor of safety.
            assert!((SAFETY * found.at(found.spacing_for(1e-3)) / 1e-3 - 1.0).abs() < 1e-9);
        }
    }

    /// What is wrong around a kink grows narrower with h, and lies elsewhere on each level.
    #[test]
    fn errors_that_grow_narrower_are_found_too() {
        let bump = |t: f64, h: f64| h * (-((t - 3.0) / h).powi(2)).exp() * ((t - 3.0) / h).cos();
        let of = |h: &f64| {
            let times: Vec<f64> = (0..=4000).map(|k| 6.0 * f64::from(k) / 4000.0).collect();
            let rows = times.iter().map(|&t| vec![t.sin() + bump(t, *h)]).collect();
            (*h, vec![History { name: "u".into(), rows, times }])
        };
        let hs = [0.6, 0.4, 0.27, 0.18, 0.12];
        let levels: Vec<_> = hs.iter().map(of).collect();
        let law = estimate(&levels).unwrap().laws.remove(0);
        let exact = |h: f64| {
            let squares: f64 = (0..60_000).map(|k| bump(1e-4 * f64::from(k), h).powi(2)).sum();
            (squares / 60_000.0).sqrt()
        };
        assert!((law.order.unwrap() - 1.5).abs() < 0.1, "{law:?}");
        for (h, error) in hs.iter().zip(&law.errors) {
            assert!((error / exact(*h) - 1.0).abs() < 0.25, "{h}: {error} {}", exact(*h));
        }
    }

    /// A level close to another changes no law.
    #[test]
    fn levels_that_are_close_do_not_count_twice() {
        let more = [0.35, 0.24, 0.16, 0.1, 0.075, 0.07];
        let law = |hs: &[f64]| estimate(&levels(hs, 2.0, |_, _| 0.0)).unwrap().laws.remove(0);
        let (plain, close) = (law(&HS), law(&more));
        assert_eq!((plain.order, plain.error), (close.order, close.error));
        assert_eq!((close.orders[4], close.orders[5]), (None, close.order));
        assert!((close.errors[4] / close.errors[5] - (0.075_f64 / 0.07).powi(2)).abs() < 0.02);
    }

    #[test]
    fn what_follows_no_power_has_no_number() {
        let why = |levels: &[(f64, Vec<History>)]| estimate(levels).unwrap_err();
        let no_power = |said: String| {
            let words = ["scatter", "apart", "like no power", "swing"];
            assert!(words.iter().any(|word| said.contains(word)), "{said}");
        };
        no_power(why(&levels(&HS, -1.0, |_, _| 0.0)));
        let shaken = |t: f64, n: usize| 0.02 * ((2.0 + 3.0 * n as f64) * t).sin();
        no_power(why(&levels(&HS, 2.0, shaken)));
        let jumps = |t: f64, n: usize| if n.is_multiple_of(2) { 0.1 } else { -0.1 } * t.cos();
        no_power(why(&levels(&HS, 2.0, jumps)));
        assert!(why(&levels(&HS[..3], 2.0, |_, _| 0.0)).contains("3 levels"));
        let lost = |_: f64, n: usize| if n == 3 { f64::NAN } else { 0.0 };
        assert!(why(&levels(&HS, 2.0, lost)).contains("not finite"));
    }

    #[test]
    fn what_is_rounding_is_said_and_what_is_still_is_left_out() {
        let still = |levels: &mut Vec<(f64, Vec<History>)>, keep: f64| {
            let seen = levels.iter_mut().flat_map(|(_, seen)| seen.iter_mut());
            seen.flat_map(|one| one.rows.iter_mut().flatten()).for_each(|value| *value *= keep);
        };
        let mut none = levels(&HS, 2.0, |_, _| 0.0);
        still(&mut none, 0.0);
        assert!(estimate(&none).unwrap_err().contains("nothing moves"));
        let exact: Vec<(f64, Vec<History>)> = HS
            .iter()
            .map(|&h| {
                let times: Vec<f64> = (0..=600).map(|k| 0.01 * f64::from(k)).collect();
                let rows = times.iter().map(|t| vec![t * t + 1e-13 * h]).collect();
                (h, vec![History { name: "u".into(), times, rows }])
            })
            .collect();
        let law = estimate(&exact).unwrap().laws.remove(0);
        assert!(law.order.is_none() && law.error < ROUNDING);
    }

    #[test]
    fn cubics_are_seen_exactly_between_looks() {
        let times = vec![0.0, 0.5, 1.0, 2.0, 2.5];
        let cubic = |t: f64| 1.0 - t + 2.0 * t * t - 0.5 * t * t * t;
        let seen = History { name: "u".into(), rows: times.iter().map(|&t| vec![cubic(t)]).collect(), times };
        for t in [0.0, 0.2, 0.75, 1.4, 2.2, 2.5] {
            assert!((seen.at(t)[0] - cubic(t)).abs() < 1e-14);
        }
    }
}
