//! How far a strain history is from the exact square wave: errors as norms, overshoot, and when the front arrived.

use super::released::Released;
use pd_verify::lattice::Lattice;
use pd_verify_reference::front::Front;

/// Errors of a strain history at one place; strains over ε₀.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JumpErrors {
    /// (1/T) ∫ |ε − ε_exact| dt.
    pub l1: f64,
    /// √((1/T) ∫ (ε − ε_exact)² dt).
    pub l2: f64,
    /// The largest error further than [`AWAY`] widths from any front; `None` where fronts leave no such time.
    pub away: Option<f64>,
    /// How far the strain overshoots behind the first front, over the jump; `None` where no front came.
    pub overshoot: Option<f64>,
    /// When a third of the first jump had passed, in s.
    pub arrival: Option<f64>,
}

/// Widths (3βx)^{1/3} of a front beyond which its oscillation has died down.
pub const AWAY: f64 = 10.0;

/// Errors at `place` of strains over ε₀ at each of the times.
pub fn errors(
    bar: &Released,
    place: f64,
    times: &[f64],
    strains: &[f64],
    width: impl Fn(f64) -> f64,
) -> JumpErrors {
    let exact: Vec<f64> = times.iter().map(|&t| bar.exact.strain_at(place, t) / bar.exact.strain).collect();
    let differences: Vec<f64> = strains.iter().zip(&exact).map(|(a, b)| a - b).collect();
    let arrival = crossing(times, strains, 2.0 / 3.0);
    // The first front leaves strain 0 behind it, until the one reflected at the held end comes by a way of 2x later; its
    // foot is kept out by half of that.
    let behind =
        |t: f64| arrival.is_some_and(|at| t > at && t < at * (1.0 + place / (bar.exact.length - place)));
    let swing = times.iter().zip(strains).filter(|(t, _)| behind(**t)).map(|(_, strain)| *strain);
    let quiet = |t: f64| {
        let way = bar.exact.speed * t;
        fronts(bar, place, t).all(|front| (way - front).abs() > AWAY * width(front))
    };
    let seen = |keep: &dyn Fn(f64) -> bool| -> Vec<f64> {
        times.iter().zip(&differences).filter(|(t, _)| keep(**t)).map(|(_, d)| *d).collect()
    };
    JumpErrors {
        l1: mean(times, differences.iter().map(|d| d.abs())),
        l2: mean(times, differences.iter().map(|d| d * d)).sqrt(),
        away: seen(&quiet).into_iter().map(f64::abs).reduce(f64::max),
        overshoot: swing.reduce(f64::min).map(|lowest| -lowest),
        arrival,
    }
}

/// (1/T) ∫ f dt by the trapezoidal rule over the times.
pub fn mean(times: &[f64], values: impl Iterator<Item = f64>) -> f64 {
    let values: Vec<f64> = values.collect();
    let spans = times.windows(2).zip(values.windows(2));
    let integral: f64 = spans.map(|(t, f)| 0.5 * (t[1] - t[0]) * (f[0] + f[1])).sum();
    integral / (times.last().unwrap_or(&f64::NAN) - times.first().unwrap_or(&f64::NAN))
}

/// Ways vt after which a front stands at `place`, up to beyond t.
fn fronts(bar: &Released, place: f64, t: f64) -> impl Iterator<Item = f64> {
    let length = bar.exact.length;
    let turns = (bar.exact.speed * t / (2.0 * length)).ceil() as usize + 1;
    (0..=turns).flat_map(move |turn| {
        let odd = (2 * turn + 1) as f64 * length;
        [odd - place, odd + place]
    })
}

/// When falling values first pass a level, between two times on a straight line.
fn crossing(times: &[f64], values: &[f64], level: f64) -> Option<f64> {
    let at = values.iter().position(|value| *value <= level)?;
    let before = at.checked_sub(1)?;
    let share = (values[before] - level) / (values[before] - values[at]);
    Some(times[before] + share * (times[at] - times[before]))
}

/// The speed of the front over v, from its arrival: corrected for the shape that the lattice gives it.
pub fn front_speed(bar: &Released, front: &Front, spacing: f64, place: f64, arrival: f64) -> f64 {
    let way = (bar.exact.length - place) / spacing;
    way / (bar.exact.speed * arrival / spacing + front.earliness_of_a_third(way))
}

/// The front of a lattice as leapfrog carries it.
pub fn front(lattice: Lattice, courant: f64) -> Option<Front> {
    Front::of(crate::dispersion::curve::reference_lattice(lattice), Some(courant))
}

/// The error that a wave of the wrong speed, else exact, would have: what refining tends to without calibration.
pub fn plateau(bar: &Released, place: f64, duration: f64, speed_ratio: f64) -> f64 {
    let wrong =
        pd_verify_reference::released_bar::ReleasedBar { speed: bar.exact.speed * speed_ratio, ..bar.exact };
    const SAMPLES: usize = 200_000;
    let at = |n: usize| (n as f64 + 0.5) / SAMPLES as f64 * duration;
    let error = |t: f64| (wrong.strain_at(place, t) - bar.exact.strain_at(place, t)).abs();
    (0..SAMPLES).map(|n| error(at(n))).sum::<f64>() / (SAMPLES as f64 * bar.exact.strain)
}
