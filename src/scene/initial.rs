//! Fields over a body, as sums of a few shapes: displacements or velocities at t = 0, body forces, held displacements.

use super::Axis;
use crate::stress_intensity::eigenfunction::term;
use crate::stress_intensity::{Elastic, Mode};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A field over the body, for one component.
#[derive(Debug, Clone, PartialEq)]
pub struct Initial<const D: usize> {
    /// The component that it sets: 0 for x.
    pub component: usize,
    /// In m, or m/s for a velocity.
    pub amplitude: f64,
    pub shape: Shape<D>,
}

/// Shapes of amplitude 1.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape<const D: usize> {
    /// 1 everywhere.
    Uniform,
    /// The coordinate along an axis, in m: the amplitude is a strain (or a strain rate).
    Linear { along: usize },
    /// exp(−a |x − x₀|²), a in 1/m².
    Gaussian { centre: [f64; D], sharpness: f64 },
    /// cos(k·x + φ), k in rad/m.
    Wave { wavenumber: [f64; D], phase: f64 },
    /// Π (x_a − about_a)^power_a, in m to the sum of the powers: the amplitude is a strain, a curvature and so on.
    Monomial { about: [f64; D], powers: [u8; D] },
    /// The displacement in m near the tip of a crack along −x where K is 1 Pa√m: the amplitude is K over that.
    NearTip { tip: [f64; D], mode: Mode, elastic: Elastic },
}

impl<const D: usize> Initial<D> {
    /// The value at a place in m.
    pub fn at(&self, x: [f64; D]) -> f64 {
        let dot = |k: [f64; D]| (0..D).map(|axis| k[axis] * x[axis]).sum::<f64>();
        let shape = match self.shape {
            Shape::Uniform => 1.0,
            Shape::Linear { along } => x[along],
            Shape::Gaussian { centre, sharpness } => {
                let squares: f64 = (0..D).map(|axis| (x[axis] - centre[axis]).powi(2)).sum();
                libm::exp(-sharpness * squares)
            }
            Shape::Wave { wavenumber, phase } => libm::cos(dot(wavenumber) + phase),
            Shape::Monomial { about, powers } => {
                (0..D).map(|axis| (x[axis] - about[axis]).powi(i32::from(powers[axis]))).product()
            }
            Shape::NearTip { tip, mode, elastic } => {
                let from_tip =
                    [0, 1].map(|axis| x.get(axis).zip(tip.get(axis)).map_or(0.0, |(x, tip)| x - tip));
                term(&elastic, 1, mode).displacement(from_tip)[self.component]
            }
        };
        self.amplitude * shape
    }

    /// Why it is nothing; `None` where it may be something.
    pub fn neutral(&self) -> Option<&'static str> {
        (self.amplitude == 0.0).then_some("its amplitude is 0")
    }
}

/// The words for a [`Shape`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ShapeName {
    Uniform,
    Linear,
    Gaussian,
    Wave,
}

/// What an initial field sets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    Displacement,
    Velocity,
}

/// An initial field as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InitialAsked {
    pub sets: Quantity,
    pub shape: ShapeName,
    /// Component that it sets; default x.
    pub axis: Option<Axis>,
    /// In m, or m/s for a velocity; a strain (rate) for `linear`.
    pub amplitude: f64,
    /// Of `linear`: the coordinate that it grows with; default the component's own.
    pub along: Option<Axis>,
    /// Of `gaussian`.
    pub centre_m: Option<Vec<f64>>,
    /// Of `gaussian`: where exp(−(r/width)²) has fallen to 1/e.
    pub width_m: Option<super::Positive>,
    /// Of `wave`.
    pub wavenumber_per_m: Option<Vec<f64>>,
    /// Of `wave`; default 0.
    pub phase_rad: Option<f64>,
}

impl InitialAsked {
    pub fn check<const D: usize>(&self) -> Result<Initial<D>, super::Wrong> {
        use super::Wrong;
        let gaussian = self.shape == ShapeName::Gaussian;
        let wave = self.shape == ShapeName::Wave;
        let keys = [
            ("along", self.along.is_some(), self.shape == ShapeName::Linear, false),
            ("centre_m", self.centre_m.is_some(), gaussian, true),
            ("width_m", self.width_m.is_some(), gaussian, true),
            ("wavenumber_per_m", self.wavenumber_per_m.is_some(), wave, true),
            ("phase_rad", self.phase_rad.is_some(), wave, false),
        ];
        if let Some((key, ..)) = keys.iter().find(|(_, given, used, _)| *given && !used) {
            let message = format!("{key} says nothing about a field of this shape");
            return Err(Wrong::new(*key, message, "leave it out, or name the shape that uses it"));
        }
        if let Some((key, ..)) = keys.iter().find(|(_, given, used, needed)| !given && *used && *needed) {
            return Err(Wrong::new("", format!("a field of this shape needs {key}"), format!("add {key}")));
        }
        if !self.amplitude.is_finite() {
            return Err(Wrong::new("amplitude", "an amplitude must be finite", "give a finite number"));
        }
        let component = self.axis.unwrap_or(Axis::X).index::<D>()?;
        let vector = |key: &'static str, given: &Option<Vec<f64>>| -> Result<[f64; D], Wrong> {
            let list = given.as_deref().unwrap_or(&[]);
            let finite = list.iter().all(|number| number.is_finite());
            list.try_into().ok().filter(|_| finite).ok_or_else(|| {
                Wrong::new(key, format!("{} number(s) given", list.len()), format!("give {D}, one per axis"))
            })
        };
        let shape = match self.shape {
            ShapeName::Uniform => Shape::Uniform,
            ShapeName::Linear => {
                let along = self.along.map_or(Ok(component), Axis::index::<D>);
                Shape::Linear { along: along.map_err(|wrong| Wrong { key: "along".into(), ..wrong })? }
            }
            ShapeName::Gaussian => {
                let width = self.width_m.map_or(f64::NAN, |width| width.0);
                Shape::Gaussian {
                    centre: vector("centre_m", &self.centre_m)?,
                    sharpness: 1.0 / (width * width),
                }
            }
            ShapeName::Wave => Shape::Wave {
                wavenumber: vector("wavenumber_per_m", &self.wavenumber_per_m)?,
                phase: self.phase_rad.unwrap_or(0.0),
            },
        };
        Ok(Initial { component, amplitude: self.amplitude, shape })
    }
}
