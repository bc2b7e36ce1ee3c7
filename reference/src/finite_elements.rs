//! Dynamic stress intensity factors of two finite plates, by finite elements of classical elastodynamics.
//!
//! Where a plate's edges matter there is no closed form; these histories were computed once with six-node triangles,
//! quarter-point elements at the tips and the interaction integral, and hold from the first wave to the last row.
//! `data/finite_elements/README.md` says how they were made, what they were checked on and what they hash to.
//!
//! Each is the response to a step of stress of amplitude σ (τ) at t = 0, as K/(σ√(πa)), and the same smoothed: the
//! response to a load that rises over a width T centred on t = 0, K(t) = ∫ σ̇(s) k(t − s) ds. A smooth history is known
//! better than a raw one, whose kinks at wave fronts no grid resolves: compare with the rise that was applied.

use std::f64::consts::{PI, TAU};

use crate::cracked_plate::{Behind, CrackedPlate, Lateral};
use crate::elastic::{Mode, Plane};

/// The rows of the plate in tension as a file.
pub const CHEN_CSV: &str = include_str!("../data/finite_elements/chen_plate_mode1_nu025.csv");
/// The rows of the sheared plate as a file.
pub const SHEAR_CSV: &str = include_str!("../data/finite_elements/mode2_plate_104x40.csv");

/// A plate whose history is known. Both have a central crack and free edges where nothing is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plate {
    /// Chen's (Eng. Fract. Mech. 7 (1975) 653): 20 mm × 40 mm, crack 2a = 4.8 mm across the 20 mm, tension on both short
    /// edges; mode I. Plane strain, E = 200 GPa, ν = ¼, ρ = 5000 kg/m³.
    Chen,
    /// 104 mm × 40 mm, crack 2a = 24 mm along the 104 mm; mode II. Plane strain, E = 73.5 GPa, ν = ¼, ρ = 2450 kg/m³.
    Shear(Loading),
}

/// On which edges of the sheared plate τ acts. The article that poses the example does not say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loading {
    /// On the two long edges, in opposite directions: without balance of moments, the plate begins to turn.
    TopBottom,
    /// Pure shear: the complementary τ on the short edges too.
    FourEdges,
}

/// How the stress rises from 0 to its amplitude over a width T in s, centred on t = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rise {
    /// The rate is a raised cosine, σ̇ = (1 + cos 2πt/T)/T: what the smoothed columns have.
    RaisedCosineRate {
        /// T.
        width_s: f64,
    },
    /// The stress is one, σ = ½(1 + sin πt/T): a load ½(1 − cos) that begins T/2 earlier.
    RaisedCosine {
        /// T.
        width_s: f64,
    },
    /// A straight line.
    Ramp {
        /// T.
        width_s: f64,
    },
}

/// K/(σ√(πa)) over time.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// Times in s, growing.
    pub times_s: Vec<f64>,
    /// K/(σ√(πa)), one for each time; 0 before the first.
    pub values: Vec<f64>,
    /// Estimated errors of the values: the largest difference to coarser meshes. Empty where not estimated.
    pub errors: Vec<f64>,
    /// Whether cubics are to go through the values, or straight lines.
    smooth: bool,
}

impl Plate {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Chen, Self::Shear(Loading::TopBottom), Self::Shear(Loading::FourEdges)];

    /// The mode that is loaded.
    pub fn mode(self) -> Mode {
        match self {
            Self::Chen => Mode::One,
            Self::Shear(_) => Mode::Two,
        }
    }

    /// The body.
    pub fn body(self) -> Plane {
        match self {
            Self::Chen => Plane::plane_strain(200e9, 0.25, 5000.0),
            Self::Shear(_) => Plane::plane_strain(73.5e9, 0.25, 2450.0),
        }
    }

    /// a in m.
    pub fn half_crack(self) -> f64 {
        match self {
            Self::Chen => 0.0024,
            Self::Shear(_) => 0.012,
        }
    }

    /// The plate from one of its tips, the crack along x.
    pub fn geometry(self) -> CrackedPlate {
        let half_width = match self {
            Self::Chen => 0.010,
            Self::Shear(_) => 0.052,
        };
        let ahead = half_width - self.half_crack();
        CrackedPlate {
            half_height: 0.020,
            ahead,
            behind: Behind::Tip { crack: 2.0 * self.half_crack(), beyond: ahead },
            lateral: Lateral::Free,
        }
    }

    /// The response to a step. Noise at wave fronts is up to 0.04, a few tenths of a µs later 0.005.
    pub fn raw(self) -> History {
        let [raw, ..] = self.columns();
        History {
            times_s: column(self.file(), 0),
            values: column(self.file(), raw),
            errors: vec![],
            smooth: false,
        }
    }

    /// The smoothed column with its estimated errors, for the rise [`Self::stated_rise`].
    pub fn smoothed(self) -> History {
        let [times_s, values, errors] =
            [0, self.columns()[1], self.columns()[2]].map(|index| column(self.file(), index));
        History { times_s, values, errors, smooth: true }
    }

    /// The rise of the smoothed column: 0.2 µs for the plate in tension, 0.4 µs for the sheared one.
    pub fn stated_rise(self) -> Rise {
        let width_s = match self {
            Self::Chen => 0.2e-6,
            Self::Shear(_) => 0.4e-6,
        };
        Rise::RaisedCosineRate { width_s }
    }

    /// The response to another rise: the raw column, straight between its times, convolved exactly. None where the
    /// width is not positive, shorter than two of the column's steps, or longer than the history.
    pub fn with_rise(self, rise: Rise) -> Option<History> {
        let raw = self.raw();
        let (start, end, width) = (raw.times_s[0], raw.valid_until_s(), rise.width_s());
        let step = raw.times_s[1] - start;
        if !(width > 2.0 * step && width < end) {
            return None;
        }
        // The response begins half a width earlier than that to a step.
        let earlier = libm::ceil((0.5 * width - start).max(0.0) / step) as usize;
        let before = (1..=earlier).rev().map(|i| start - i as f64 * step);
        let times_s: Vec<f64> =
            before.chain(raw.times_s.iter().copied().filter(|t| t + 0.5 * width <= end)).collect();
        let values = times_s.iter().map(|&t| raw.risen(rise, t)).collect();
        Some(History { times_s, values, errors: vec![], smooth: true })
    }

    fn file(self) -> &'static str {
        match self {
            Self::Chen => CHEN_CSV,
            Self::Shear(_) => SHEAR_CSV,
        }
    }

    /// Raw, smoothed, error.
    fn columns(self) -> [usize; 3] {
        match self {
            Self::Chen | Self::Shear(Loading::TopBottom) => [1, 2, 3],
            Self::Shear(Loading::FourEdges) => [4, 5, 6],
        }
    }
}

impl Rise {
    /// T in s.
    pub fn width_s(self) -> f64 {
        match self {
            Self::RaisedCosineRate { width_s } | Self::RaisedCosine { width_s } | Self::Ramp { width_s } => {
                width_s
            }
        }
    }

    /// ∫ σ dt from before the rise to t: t once it is over.
    fn integral(self, t: f64) -> f64 {
        let width = self.width_s();
        let x = t / width;
        match self {
            _ if x <= -0.5 => 0.0,
            _ if x >= 0.5 => t,
            Self::Ramp { .. } => 0.5 * width * (x + 0.5) * (x + 0.5),
            Self::RaisedCosine { .. } => width * (0.5 * x - libm::cos(PI * x) / TAU + 0.25),
            Self::RaisedCosineRate { .. } => {
                width * (0.5 * x * (x + 1.0) + 0.125 - (1.0 + libm::cos(TAU * x)) / (TAU * TAU))
            }
        }
    }
}

impl History {
    /// The last time in s at which it is known.
    pub fn valid_until_s(&self) -> f64 {
        self.times_s.last().copied().unwrap_or(f64::NAN)
    }

    /// The value at t in s, between times by a cubic through four (raw histories: a straight line); 0 before the first
    /// time, when no wave is there yet. None after the last and for NaN. Between times the smoothed columns are good to
    /// 5e-5, raw ones to 0.01 at fronts.
    pub fn at(&self, t: f64) -> Option<f64> {
        self.between(&self.values, t, self.smooth)
    }

    /// The estimated error at t, straight between times. None where there is none, and where [`Self::at`] is.
    pub fn error_at(&self, t: f64) -> Option<f64> {
        self.between(&self.errors, t, false)
    }

    /// The history of a plate of the same size made of something else, by its dilatational speed. None where ν' is not
    /// ¼ (plane stress with ν = ⅓ has it) to 1e-9.
    pub fn in_body(&self, of: Plate, body: &Plane) -> Option<Self> {
        let ratio = of.body().dilatational_speed() / body.dilatational_speed();
        let times_s = self.times_s.iter().map(|t| t * ratio).collect();
        ((body.poisson_ratio - 0.25).abs() < 1e-9 && ratio.is_finite())
            .then(|| Self { times_s, ..self.clone() })
    }

    fn between(&self, values: &[f64], t: f64, smooth: bool) -> Option<f64> {
        let after = self.times_s.partition_point(|&time| time < t);
        let (last, _) = (*self.times_s.last()?, values.first()?);
        match after {
            _ if t.is_nan() || t > last => None,
            0 if t < self.times_s[0] => Some(0.0),
            _ => {
                let first = after.saturating_sub(if smooth { 2 } else { 1 });
                let count = if smooth { 4 } else { 2 };
                let first = first.min(values.len().checked_sub(count)?);
                Some(through(&self.times_s[first..first + count], &values[first..first + count], t))
            }
        }
    }

    /// Σ slope of each interval times the integral of σ over it, all at rest before the first time.
    fn risen(&self, rise: Rise, t: f64) -> f64 {
        let (times, values) = (&self.times_s, &self.values);
        let part = |i: usize| {
            let slope = (values[i + 1] - values[i]) / (times[i + 1] - times[i]);
            slope * (rise.integral(t - times[i]) - rise.integral(t - times[i + 1]))
        };
        // Intervals that are wholly past add up to the value at the first that is not.
        let half = 0.5 * rise.width_s();
        let first = times.partition_point(|&time| time <= t - half).saturating_sub(1);
        let end = times.partition_point(|&time| time < t + half).min(times.len() - 1);
        values[first] + (first..end).map(part).sum::<f64>()
    }
}

/// Lagrange's polynomial through the points.
fn through(times: &[f64], values: &[f64], t: f64) -> f64 {
    let weight = |i: usize| {
        let others = times.iter().enumerate().filter(|(j, _)| *j != i);
        others.map(|(_, other)| (t - other) / (times[i] - other)).product::<f64>()
    };
    values.iter().enumerate().map(|(i, value)| value * weight(i)).sum()
}

/// A column of a file; the first, times, from µs to s.
fn column(file: &str, index: usize) -> Vec<f64> {
    let unit = if index == 0 { 1e-6 } else { 1.0 };
    let rows = file.lines().skip(1).filter(|line| !line.is_empty());
    let cell = |line: &str| {
        line.split(',')
            .nth(index)
            .and_then(|cell| cell.parse::<f64>().ok())
            .map_or(f64::NAN, |value| value * unit)
    };
    rows.map(cell).collect()
}
