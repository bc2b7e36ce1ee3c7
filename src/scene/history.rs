//! How a load or a driven motion goes with time: a factor that multiplies its pattern.

use super::{Positive, Wrong};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// A factor over time.
#[derive(Debug, Clone, PartialEq)]
pub enum History {
    /// 0 before `start`, 1 from then on.
    Step { start: f64 },
    /// From 0 at `start` to 1 a time `rise` later, in a straight line.
    Ramp { start: f64, rise: f64 },
    /// The same along ½(1 − cos): no kink at either end.
    RaisedCosine { start: f64, rise: f64 },
    /// sin(2π(t − start)/period), 0 before `start`.
    Sine { start: f64, period: f64 },
    /// Straight lines through points of growing time in s; the first and the last value beyond them.
    Table { points: Vec<(f64, f64)> },
}

impl History {
    /// The factor at t in s.
    pub fn at(&self, t: f64) -> f64 {
        let since = |start: f64, rise: f64| ((t - start) / rise).clamp(0.0, 1.0);
        match *self {
            Self::Step { start } => f64::from(t >= start),
            Self::Ramp { start, rise } => since(start, rise),
            Self::RaisedCosine { start, rise } => 0.5 * (1.0 - libm::cos(PI * since(start, rise))),
            Self::Sine { start, period } if t > start => libm::sin(TAU * (t - start) / period),
            Self::Sine { .. } => 0.0,
            Self::Table { ref points } => between(points, t),
        }
    }
}

impl History {
    /// Whether it is exactly 0 at every time from 0 to `until`, in s.
    pub fn nothing_until(&self, until: f64) -> bool {
        match *self {
            Self::Step { start } => start > until,
            Self::Ramp { start, .. } | Self::RaisedCosine { start, .. } | Self::Sine { start, .. } => {
                start >= until
            }
            Self::Table { ref points } => {
                // From the last point before the time to the first behind it.
                let from = points.partition_point(|&(time, _)| time <= 0.0).saturating_sub(1);
                let to =
                    points.partition_point(|&(time, _)| time < until).min(points.len().saturating_sub(1));
                points.get(from..=to).is_some_and(|seen| seen.iter().all(|&(_, value)| value == 0.0))
            }
        }
    }

    /// The factor that acts over the step of length Δt around t: a jump that falls into it acts for its part. What is
    /// there from t = 0 on is there in whole, as the march starts with half a step.
    pub fn over_step(&self, t: f64, time_step: f64) -> f64 {
        match *self {
            Self::Step { start } if start > 0.0 && time_step > 0.0 => {
                ((t - start) / time_step + 0.5).clamp(0.0, 1.0)
            }
            _ => self.at(t),
        }
    }
}

fn between(points: &[(f64, f64)], t: f64) -> f64 {
    let after = points.partition_point(|&(time, _)| time <= t);
    match (after.checked_sub(1).map(|n| points[n]), points.get(after)) {
        (None, Some(first)) => first.1,
        (Some(last), None) => last.1,
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (t - a.0) / (b.0 - a.0),
        (None, None) => f64::NAN,
    }
}

/// The words for a [`History`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum HistoryShape {
    Step,
    Ramp,
    RaisedCosine,
    Sine,
    Table,
}

/// A history as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HistoryAsked {
    pub shape: HistoryShape,
    /// When it begins; default 0.
    pub start_s: Option<f64>,
    /// Of `ramp` and `raised_cosine`.
    pub rise_s: Option<Positive>,
    /// Of `sine`.
    pub period_s: Option<Positive>,
    /// Of `table`, growing.
    pub times_s: Option<Vec<f64>>,
    /// Of `table`, one for each time.
    pub values: Option<Vec<f64>>,
}

impl HistoryAsked {
    /// What is there from t = 0 on.
    pub fn step() -> Self {
        let shape = HistoryShape::Step;
        Self { shape, start_s: None, rise_s: None, period_s: None, times_s: None, values: None }
    }

    /// Why what it multiplies does nothing before `until`, in s.
    pub(crate) fn neutral(&self, until: f64) -> Option<&'static str> {
        let nothing = self.check().is_ok_and(|history| history.nothing_until(until));
        nothing.then_some("its history is 0 throughout")
    }

    pub fn check(&self) -> Result<History, Wrong> {
        let has = [
            ("start_s", self.start_s.is_some(), self.shape != HistoryShape::Table),
            (
                "rise_s",
                self.rise_s.is_some(),
                matches!(self.shape, HistoryShape::Ramp | HistoryShape::RaisedCosine),
            ),
            ("period_s", self.period_s.is_some(), self.shape == HistoryShape::Sine),
            ("times_s", self.times_s.is_some(), self.shape == HistoryShape::Table),
            ("values", self.values.is_some(), self.shape == HistoryShape::Table),
        ];
        if let Some((key, ..)) = has.iter().find(|(_, given, used)| *given && !used) {
            let message = format!("{key} says nothing about a history of this shape");
            return Err(Wrong::new(*key, message, "leave it out, or name the shape that uses it"));
        }
        if let Some((key, ..)) = has.iter().find(|(key, given, used)| *key != "start_s" && !given && *used) {
            let message = format!("a history of this shape needs {key}");
            return Err(Wrong::new("", message, format!("add {key}")));
        }
        let start = self.start_s.unwrap_or(0.0);
        if !start.is_finite() {
            return Err(Wrong::new("start_s", "a time must be finite", "give seconds"));
        }
        let seconds = |given: Option<Positive>| given.map_or(f64::NAN, |given| given.0);
        Ok(match self.shape {
            HistoryShape::Step => History::Step { start },
            HistoryShape::Ramp => History::Ramp { start, rise: seconds(self.rise_s) },
            HistoryShape::RaisedCosine => History::RaisedCosine { start, rise: seconds(self.rise_s) },
            HistoryShape::Sine => History::Sine { start, period: seconds(self.period_s) },
            HistoryShape::Table => self.table()?,
        })
    }

    fn table(&self) -> Result<History, Wrong> {
        let (times, values) = (self.times_s.as_deref().unwrap_or(&[]), self.values.as_deref().unwrap_or(&[]));
        if times.is_empty() || times.len() != values.len() {
            let message =
                format!("a table has one value for each time, here {} for {}", values.len(), times.len());
            return Err(Wrong::new("values", message, "give lists of equal length"));
        }
        if let Some(bad) = times.iter().chain(values).find(|number| !number.is_finite()) {
            return Err(Wrong::new("values", format!("{bad} is no number"), "give finite numbers"));
        }
        if let Some(late) = times.windows(2).find(|pair| pair[0] >= pair[1]) {
            let message = format!("the table is out of order: {} s stands before {} s", late[0], late[1]);
            return Err(Wrong::new("times_s", message, "give each time once, the earliest first"));
        }
        Ok(History::Table { points: times.iter().copied().zip(values.iter().copied()).collect() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn histories_go_as_their_words_say() {
        let ramp = History::Ramp { start: 1.0, rise: 2.0 };
        assert_eq!([0.0, 1.0, 2.0, 3.0, 9.0].map(|t| ramp.at(t)), [0.0, 0.0, 0.5, 1.0, 1.0]);
        let soft = History::RaisedCosine { start: 0.0, rise: 2.0 };
        assert_eq!(soft.at(0.0), 0.0);
        assert!((soft.at(1.0) - 0.5).abs() < 1e-15 && soft.at(0.5) < 0.25 && soft.at(2.0) == 1.0);
        let step = History::Step { start: 0.0 };
        assert_eq!([-1e-9, 0.0, 1.0].map(|t| step.at(t)), [0.0, 1.0, 1.0]);
        let sine = History::Sine { start: 1.0, period: 4.0 };
        assert_eq!([0.0, 2.0].map(|t| sine.at(t)), [0.0, 1.0]);
        let table = History::Table { points: vec![(0.0, 1.0), (2.0, 3.0), (3.0, 0.0)] };
        assert_eq!(
            [-1.0, 0.0, 1.0, 2.0, 2.5, 3.0, 8.0].map(|t| table.at(t)),
            [1.0, 1.0, 2.0, 3.0, 1.5, 0.0, 0.0]
        );
    }

    #[test]
    fn nothing_is_said_of_histories_that_are_zero_throughout() {
        let table = |values: [f64; 4]| History::Table {
            points: [-1.0, 1.0, 3.0, 5.0].into_iter().zip(values).collect(),
        };
        for (history, until, nothing) in [
            (History::Step { start: 2.0 }, 2.0, false),
            (History::Step { start: 2.1 }, 2.0, true),
            (History::Ramp { start: 2.0, rise: 1.0 }, 2.0, true),
            (History::RaisedCosine { start: 1.9, rise: 1.0 }, 2.0, false),
            (History::Sine { start: 2.0, period: 1.0 }, 2.0, true),
            (History::Sine { start: 0.0, period: 1.0 }, 2.0, false),
            (History::Ramp { start: 2.0, rise: 1.0 }, f64::INFINITY, false),
            (table([0.0; 4]), f64::INFINITY, true),
            (table([0.0, 0.0, 0.0, 1e-300]), 3.0, true),
            (table([0.0, 0.0, 0.0, 1e-300]), 3.1, false),
            (table([1.0, 0.0, 0.0, 0.0]), 3.0, false),
            (table([0.0, 0.0, 0.0, 1.0]), 9.0, false),
        ] {
            assert_eq!(history.nothing_until(until), nothing, "{history:?} until {until}");
            // What is said to be nothing is 0 at every time looked at, the last included.
            let times = (0..=100).map(|n| f64::from(n) / 100.0 * until.min(9.0));
            assert!(!nothing || times.into_iter().all(|t| history.at(t) == 0.0), "{history:?}");
        }
    }

    #[test]
    fn a_step_within_a_step_acts_for_its_part() {
        let step = History::Step { start: 3.0 };
        assert_eq!([1.0, 2.0, 3.0, 4.0].map(|t| step.over_step(t, 1.0)), [0.0, 0.0, 0.5, 1.0]);
        assert_eq!(History::Step { start: 2.75 }.over_step(3.0, 1.0), 0.75);
        assert_eq!(History::Step { start: 0.0 }.over_step(0.0, 1.0), 1.0);
        assert_eq!(step.over_step(3.0, f64::NAN), 1.0);
    }

    #[test]
    fn wrong_histories_are_refused_by_name() {
        let asked = |text: &str| serde_json::from_str::<HistoryAsked>(text).unwrap().check();
        let key = |text: &str| asked(text).unwrap_err().key;
        assert_eq!(key(r#"{"shape":"table","times_s":[0,2,1],"values":[0,1,2]}"#), "times_s");
        assert_eq!(key(r#"{"shape":"table","times_s":[0,1],"values":[0]}"#), "values");
        assert_eq!(key(r#"{"shape":"step","rise_s":1}"#), "rise_s");
        assert!(asked(r#"{"shape":"ramp"}"#).unwrap_err().message.contains("rise_s"));
        assert!(asked(r#"{"shape":"ramp","rise_s":1}"#).is_ok());
    }
}
