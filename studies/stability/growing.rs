//! How leapfrog carries a mode from rest beyond its limit: u(n) = (−1)ⁿ cosh(nφ) u(0), cosh(φ/2) = ωΔt/2.

use super::body::{Look, Mode};
use pd_verify::compare::largest;

/// A mode beyond its limit, and how much of it a start contains.
#[derive(Debug, Clone, Copy)]
pub struct Growing {
    /// φ: the logarithm of the growth in a step; NaN below the limit.
    pub rate: f64,
    /// Amplitude at t = 0 in m, of the mode whose squares sum to 1.
    amplitude: f64,
    /// Largest component of the mode.
    peak: f64,
    /// φ of the next slower mode; 0 where that is below its limit, and does not grow.
    next_rate: f64,
    /// Norm of the start in m.
    start: f64,
}

/// What a march says of the mode.
#[derive(Debug, Clone, Copy)]
pub struct Grown {
    /// Growth in a step over the second half of the looks.
    pub rate: f64,
    /// Largest |ln|u(n)/u(0)| − ln cosh nφ|/(nφ); infinite where the sign is not that of (−1)ⁿ.
    pub error: Option<f64>,
    /// Sine of the angle between the last look and the mode.
    pub sine: Option<f64>,
    /// The most that this may be, by what slower modes may hold of the last look.
    pub most: Option<f64>,
    /// ω of the last look in 1/s: ω² = −u·a/u·u.
    pub omega: Option<f64>,
}

impl Growing {
    /// At a time step in s, from displacements.
    pub fn new(mode: &Mode, time_step: f64, start: &[f64]) -> Self {
        let rate = |omega: f64| 2.0 * libm::acosh(0.5 * omega * time_step);
        let peak = mode.shape.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let next_rate = Some(rate(mode.next_omega)).filter(|rate| rate.is_finite()).unwrap_or(0.0);
        Self {
            rate: rate(mode.omega),
            amplitude: dot(&mode.shape, start),
            peak,
            next_rate,
            start: norm(start),
        }
    }

    /// ln cosh nφ.
    pub fn logarithm(&self, step: u64) -> f64 {
        log_cosh(self.rate * step as f64)
    }

    /// Part of the start's norm that the mode has.
    pub fn share(&self) -> f64 {
        self.amplitude.abs() / self.start
    }

    /// What all slower modes may hold of the body at a step, over what the fastest holds: none grows faster than the next.
    fn slower(&self, step: u64) -> f64 {
        let behind = log_cosh(self.next_rate * step as f64) - self.logarithm(step);
        libm::exp(behind) / self.share()
    }

    /// The step at which the largest displacement is no longer a number.
    pub fn overflow(&self) -> f64 {
        (libm::log(f64::MAX) - libm::log(0.5 * self.amplitude.abs() * self.peak)) / self.rate
    }

    /// What looks say of it.
    pub fn held_against(&self, mode: &Mode, looks: &[Look]) -> Grown {
        let part = |look: &Look| dot(&mode.shape, &look.displacement);
        let error = largest(looks.iter().filter(|look| look.step > 0).map(|look| {
            let over = part(look) / self.amplitude;
            let signed = if look.step % 2 == 0 { over } else { -over };
            if signed <= 0.0 {
                return f64::INFINITY;
            }
            ((libm::log(signed) - self.logarithm(look.step)) / (self.rate * look.step as f64)).abs()
        }));
        let ends = looks.get(looks.len() / 2).zip(looks.last());
        let rate = ends.map_or(f64::NAN, |(first, last)| {
            libm::log((part(last) / part(first)).abs()) / (last.step - first.step) as f64
        });
        let last = looks.last();
        Grown {
            rate,
            error,
            sine: last.map(|last| sine(&mode.shape, &last.displacement)),
            most: last.map(|last| self.slower(last.step)),
            omega: last.map(frequency),
        }
    }
}

/// ln cosh x for x ≥ 0, where cosh may be no number.
fn log_cosh(x: f64) -> f64 {
    x + libm::log1p(libm::exp(-2.0 * x)) - std::f64::consts::LN_2
}

/// Of the angle between a vector of length 1 and another.
fn sine(unit: &[f64], other: &[f64]) -> f64 {
    let other = scaled(other);
    let along = dot(unit, &other);
    let across: Vec<f64> = unit.iter().zip(&other).map(|(u, x)| x - along * u).collect();
    norm(&across) / norm(&other)
}

/// Square root of −u·a/u·u.
fn frequency(look: &Look) -> f64 {
    let (u, size) = (scaled(&look.displacement), size(&look.displacement));
    let a: Vec<f64> = look.acceleration.iter().map(|a| a / size).collect();
    (-dot(&u, &a) / dot(&u, &u)).sqrt()
}

/// Over its largest component: squares of what has grown by 1e200 are no numbers.
fn scaled(a: &[f64]) -> Vec<f64> {
    let size = size(a);
    a.iter().map(|x| x / size).collect()
}

fn size(a: &[f64]) -> f64 {
    a.iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// The logarithm of the norm, of vectors whose squares are no numbers too.
pub fn log_norm(a: &[f64]) -> f64 {
    libm::log(size(a)) + libm::log(norm(&scaled(a)))
}

pub fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// u(n+1) = (2 − ω²Δt²) u(n) − u(n−1) of two modes from rest, u(−1) = u(1).
    #[test]
    fn two_nodes_grow_as_the_recurrence_says() {
        let squares = [2.02_f64.powi(2), 2.017_f64.powi(2)];
        let mode = Mode { omega: 2.02, next_omega: 2.017, shape: vec![1.0, 0.0] };
        let start = [1e-9, 3e-9];
        let growing = Growing::new(&mode, 1.0, &start);
        let (mut last, mut now, mut looks) =
            ([0, 1].map(|n| (1.0 - 0.5 * squares[n]) * start[n]), start, vec![]);
        for step in 0..=1500 {
            let acceleration = [0, 1].map(|n| -squares[n] * now[n]);
            looks.push(Look { step, displacement: now.to_vec(), acceleration: acceleration.to_vec() });
            (last, now) = (now, [0, 1].map(|n| 2.0 * now[n] + acceleration[n] - last[n]));
        }
        let grown = growing.held_against(&mode, &looks);
        // Rounding of 1e-16 a step is carried along: 1e-13 of a logarithm that is hundreds.
        assert!(grown.error.unwrap() < 1e-13 && (grown.rate / growing.rate - 1.0).abs() < 1e-13, "{grown:?}");
        // The other mode began three times as large, and the start is √10 of the first.
        let (sine, most) = (grown.sine.unwrap(), grown.most.unwrap());
        assert!((sine / most - 3.0 / 10.0_f64.sqrt()).abs() < 1e-6 && most < 1e-3, "{sine} {most}");
        assert!((grown.omega.unwrap() / 2.02 - 1.0).abs() < 2e-3 * sine * sine, "{grown:?}");
        let from = (f64::MAX.ln() - 0.5e-9_f64.ln()) / growing.rate;
        assert!((growing.overflow() / from - 1.0).abs() < 1e-12);
        let below = Growing::new(&mode, 0.99, &start);
        assert!(below.rate.is_nan() && below.held_against(&mode, &looks).error.unwrap().is_nan());
    }
}
