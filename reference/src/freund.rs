//! A long crack that is suddenly loaded: its stress intensity factors, exactly, for any history of the load.
//!
//! A half-infinite crack at rest in an infinite plane; from t = 0 on a uniform stress σ₀ acts on both faces, or a plane
//! wave of that stress reaches the crack along its whole length. The two differ by a plane wave that knows no crack.
//! K_I(t) = 2σ₀/(1 − ν')·√(c_d t(1 − 2ν')/π), K_II(t) = 2τ₀ √(2c_s t/(π(1 − ν'))) (Freund, Dynamic Fracture Mechanics
//! (1990), 2.5 and 2.6; K. Ravi-Chandar, Dynamic Fracture (2004), 4.2).
//!
//! Derived here without the Wiener–Hopf method: Laplace's transform in time makes the plane an elastic body on elastic
//! ground, ∇·σ̂ = ρs²û, whose J-integral with W = ½σ̂:ε̂ + ½ρs²û² does not depend on the path. Around the tip it is
//! K̂²/E'; far behind the tip both half planes move as bars, û = σ̂₀/(ρcs) at the faces, and a unit of length holds
//! 2·½σ̂₀û. So K̂² = E'σ₀²/(ρcs³) with σ̂₀ = σ₀/s, and K(t) = 2σ₀ √(E't/(πρc)) with c = c_d in mode I, c_s in mode II: the
//! two formulas above. The Wiener–Hopf constants are checked against it in `tests/freund.rs`.
//!
//! Whatever loads the crack later superposes: K(t) = ∫ σ̇(s) k(t − s) ds, k the response to a unit step. How long a plate
//! follows: [`crate::cracked_plate`].

use crate::elastic::{Mode, Plane};
use crate::quadrature;

/// A long crack at rest, loaded in one mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StationaryCrack {
    /// The body.
    pub plane: Plane,
    /// How it is loaded.
    pub mode: Mode,
}

/// How the stress grows, in parts of its amplitude; times in s.
#[derive(Clone, Debug, PartialEq)]
pub enum Load {
    /// 0 before `start`, 1 from then on.
    Step {
        /// When.
        start: f64,
    },
    /// From 0 at `start` to 1 a time `rise` later, in a straight line.
    Ramp {
        /// When it begins.
        start: f64,
        /// How long it takes, > 0.
        rise: f64,
    },
    /// The same along ½(1 − cos).
    RaisedCosine {
        /// When it begins.
        start: f64,
        /// How long it takes, > 0.
        rise: f64,
    },
    /// sin(2π(t − start)/period) from `start` on.
    Sine {
        /// When it begins.
        start: f64,
        /// Period, > 0.
        period: f64,
    },
    /// Straight lines through (time, value), times not falling; 0 before the first point (a first value other than 0 is
    /// a step there, as are two points at one time), the last value after the last.
    Table {
        /// The points.
        points: Vec<(f64, f64)>,
    },
}

impl StationaryCrack {
    /// K(t)/(σ₀√t) = 2√(E'/(πρc)) in √(m/s).
    pub fn coefficient(&self) -> f64 {
        let impedance = self.plane.density * self.plane.wave_speed(self.mode);
        2.0 * (self.plane.effective_modulus() / (std::f64::consts::PI * impedance)).sqrt()
    }

    /// K/σ₀ in √m at `since` s after a load has reached the crack that grows as `load` says; times of the load are
    /// measured from there too. A wave from an edge at distance H reaches the crack at H/c. Closed forms, but for the
    /// raised cosine and the sine, which are integrated by Gauss's rule to about 1e-14 of the largest |K| so far.
    /// NaN where a time is NaN, a rise or period is not positive, or times of a table fall.
    pub fn at(&self, load: &Load, since: f64) -> f64 {
        match *load {
            Load::Step { start } => self.step(since - start),
            Load::Ramp { start, rise } => self.ramp(since - start, rise),
            Load::RaisedCosine { start, rise } => self.raised_cosine(since - start, rise),
            Load::Sine { start, period } => self.sine(since - start, period),
            Load::Table { ref points } => self.table(points, since),
        }
    }

    /// K/σ₀ in √m, `since` s after a step.
    pub fn step(&self, since: f64) -> f64 {
        self.coefficient() * not_before(since).sqrt()
    }

    /// K/σ₀ in √m, `since` s after a straight rise over `rise` s has begun:
    /// 2/3 (t^{3/2} − (t − t_d)^{3/2})/t_d times the coefficient, written without a difference.
    pub fn ramp(&self, since: f64, rise: f64) -> f64 {
        let (t, s) = (not_before(since), not_before(since - rise));
        let cube = |t: f64| t * t.sqrt();
        let grown = if t > rise { (t * t + t * s + s * s) / (cube(t) + cube(s)) } else { cube(t) / rise };
        if rise > 0.0 { self.coefficient() * grown / 1.5 } else { f64::NAN }
    }

    /// K/σ₀ in √m, `since` s after a rise ½(1 − cos πt/t_d) over t_d = `rise` s has begun.
    pub fn raised_cosine(&self, since: f64, rise: f64) -> f64 {
        let wave = std::f64::consts::PI / rise;
        let rate = |s: f64| 0.5 * wave * libm::sin(wave * s);
        let value = self.smooth(rate, [0.0, rise], since, 1);
        if rise > 0.0 { value } else { f64::NAN }
    }

    /// K/σ₀ in √m, `since` s after sin(2πt/`period`) has begun.
    pub fn sine(&self, since: f64, period: f64) -> f64 {
        if period.is_nan() || period <= 0.0 {
            return f64::NAN;
        }
        let wave = std::f64::consts::TAU / period;
        let rate = |s: f64| wave * libm::cos(wave * s);
        // In √(t − s), in which panels are equal, the last oscillations are twice as dense as the mean ones.
        let panels = 1 + (2.0 * not_before(since) / period) as usize;
        self.smooth(rate, [0.0, f64::INFINITY], since, panels)
    }

    /// K/σ₀ in √m at t for straight lines through `points` (time in s, σ/σ₀), as [`Load::Table`] says.
    pub fn table(&self, points: &[(f64, f64)], t: f64) -> f64 {
        let Some(&(first, value)) = points.first() else { return f64::NAN };
        points.windows(2).fold(value * self.step(t - first), |sum, pair| {
            let [(start, from), (end, to)] = [pair[0], pair[1]];
            let part = if end == start { self.step(t - start) } else { self.ramp(t - start, end - start) };
            sum + (to - from) * part
        })
    }

    /// K/σ₀ in √m at t for a stress that grows at the rate `rate`(s)·σ₀ per s for s in `span` and stays as it is before
    /// and after (0 before the span): ∫ rate(s) k(t − s) ds over u = √(t − s), in which it has no root, by Gauss's rule
    /// of 32 nodes to each of `panels` equal panels in u: to rounding for rates that turn by less than some 10 rad in a
    /// panel. Jumps of the stress are added by [`Self::step`].
    pub fn smooth(&self, rate: impl Fn(f64) -> f64, span: [f64; 2], t: f64, panels: usize) -> f64 {
        // s = span[0] + w(2 far − w), w = far − u: no digits are lost long after a short rise.
        let end = span[1].min(t);
        let [near, far] = [end, span[0]].map(|s| not_before(t - s).sqrt());
        let width = if t > span[0] { (end - span[0]) / (far + near) } else { 0.0 * t };
        let panel = |i: usize| {
            let edge = |i: usize| width / panels as f64 * i as f64;
            let nodes = quadrature::panel_f64(edge(i), edge(i + 1));
            let value = |w: f64| 2.0 * (far - w) * (far - w) * rate(span[0] + w * (2.0 * far - w));
            nodes.map(|(w, weight)| weight * value(w)).sum::<f64>()
        };
        self.coefficient() * (0..panels).map(panel).sum::<f64>()
    }
}

/// A time, or 0 before 0; NaN stays NaN.
fn not_before(t: f64) -> f64 {
    if t < 0.0 { 0.0 } else { t }
}
