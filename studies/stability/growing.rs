//! How leapfrog carries a mode from rest beyond its limit: u(n) = (−1)ⁿ cosh(nφ) u(0), cosh(φ/2) = ωΔt/2.

use super::body::{Looks, Mode};
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
}

/// What a march says of the mode.
#[derive(Debug, Clone, Copy)]
pub struct Grown {
    /// Growth in a step over the second half of the looks.
    pub rate: f64,
    /// Largest |ln|u(n)/u(0)| − ln cosh nφ|/(nφ); infinite where the sign is not that of (−1)ⁿ.
    pub error: Option<f64>,
    /// 1 − |cos| between the last look and the mode.
    pub shape: Option<f64>,
}

impl Growing {
    /// At a time step in s, from displacements.
    pub fn new(mode: &Mode, time_step: f64, start: &[f64]) -> Self {
        let rate = 2.0 * libm::acosh(0.5 * mode.omega * time_step);
        let peak = mode.shape.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        Self { rate, amplitude: dot(&mode.shape, start), peak }
    }

    /// ln cosh nφ, for any n.
    pub fn logarithm(&self, step: u64) -> f64 {
        let turn = self.rate * step as f64;
        turn + libm::log1p(libm::exp(-2.0 * turn)) - std::f64::consts::LN_2
    }

    /// Part of the start's norm that the mode has.
    pub fn share(&self, start: &[f64]) -> f64 {
        self.amplitude.abs() / norm(start)
    }

    /// The step at which the largest displacement is no longer a number.
    pub fn overflow(&self) -> f64 {
        (libm::log(f64::MAX) - libm::log(0.5 * self.amplitude.abs() * self.peak)) / self.rate
    }

    /// What looks say of it.
    pub fn held_against(&self, mode: &Mode, looks: &Looks) -> Grown {
        let part = |look: &Vec<f64>| dot(&mode.shape, look);
        let later = || looks.iter().filter(|(step, _)| *step > 0);
        let error = largest(later().map(|(step, look)| {
            let over = part(look) / self.amplitude;
            let signed = if step % 2 == 0 { over } else { -over };
            if signed <= 0.0 {
                return f64::INFINITY;
            }
            ((libm::log(signed) - self.logarithm(*step)) / (self.rate * *step as f64)).abs()
        }));
        let ends = looks.get(looks.len() / 2).zip(looks.last());
        let rate = ends.map_or(f64::NAN, |((first, a), (last, b))| {
            libm::log((part(b) / part(a)).abs()) / (last - first) as f64
        });
        let shape = looks.last().map(|(_, last)| {
            // Scaled first: squares of what has grown by 1e200 are no numbers.
            let size = last.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let scaled: Vec<f64> = last.iter().map(|x| x / size).collect();
            1.0 - part(&scaled).abs() / norm(&scaled)
        });
        Grown { rate, error, shape }
    }
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

    /// u(n+1) = (2 − ω²Δt²) u(n) − u(n−1) from rest, u(−1) = u(1).
    #[test]
    fn one_node_grows_as_the_recurrence_says() {
        let mode = Mode { omega: 2.02, shape: vec![1.0] };
        let growing = Growing::new(&mode, 1.0, &[1e-9]);
        let twice = 2.0 - 2.02 * 2.02;
        let (mut last, mut now, mut looks) = (0.5 * twice * 1e-9, 1e-9, vec![(0, vec![1e-9])]);
        for step in 1..=1500 {
            (last, now) = (now, twice * now - last);
            looks.push((step, vec![now]));
        }
        let grown = growing.held_against(&mode, &looks);
        // Rounding of 1e-16 a step is carried along: 1e-13 of a logarithm that is hundreds.
        assert!(grown.error.unwrap() < 1e-13 && grown.shape.unwrap() < 1e-15, "{grown:?}");
        assert!((grown.rate / growing.rate - 1.0).abs() < 1e-13);
        let from = (f64::MAX.ln() - 0.5e-9_f64.ln()) / growing.rate;
        assert!((growing.overflow() / from - 1.0).abs() < 1e-12);
        let below = Growing::new(&mode, 0.99, &[1e-9]);
        assert!(below.rate.is_nan() && below.held_against(&mode, &looks).error.unwrap().is_nan());
    }
}
