//! Notches that run: a tip that goes on in the direction of its notch at a given speed, whatever the body does.

use super::{Notch, Positive};
use schemars::JsonSchema;
use serde::Deserialize;

/// How a notch runs, as written.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunsAsked {
    /// Of the tip, which is `to_m` of the notch at first.
    pub speed_m_s: Positive,
    /// When it sets out; default 0.
    pub start_s: Option<f64>,
    /// How far it goes in the direction of the notch.
    pub by_m: Positive,
}

/// A notch of a scene that runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Running {
    /// Which of the scene's notches, from 0.
    pub notch: usize,
    /// Of its tip, in m/s.
    pub speed: f64,
    /// When the tip sets out, in s.
    pub start: f64,
    /// How far it goes, in m.
    pub by: f64,
}

impl RunsAsked {
    /// What is written, of the notch at an index; a plan checks it.
    pub fn of(&self, notch: usize) -> Running {
        Running { notch, speed: self.speed_m_s.0, start: self.start_s.unwrap_or(0.0), by: self.by_m.0 }
    }
}

impl Running {
    /// Where the tip of its notch will stop, in m.
    pub fn end(&self, notch: &Notch) -> [f64; 2] {
        let share = self.by / notch.length();
        std::array::from_fn(|axis| notch.to[axis] + share * (notch.to[axis] - notch.from[axis]))
    }
}
