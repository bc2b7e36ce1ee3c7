//! How long a scene lasts and by which steps, as written.

use pd_verify::scene::{Beyond, StepRule, Time, Wrong};

/// The share of the limit where nothing is said.
const SAFETY: f64 = 0.8;

/// Duration and step from the keys of a case; the plan checks their values.
pub fn time(
    duration: f64,
    safety: Option<f64>,
    time_step: Option<f64>,
    unstable: Option<bool>,
) -> Result<Time, Wrong> {
    let step = match (safety, time_step, unstable) {
        (Some(_), Some(_), _) => {
            let message = "safety and time_step_s are both given, and each alone says what Δt is";
            return Err(Wrong::new("time_step_s", message, "leave one of the two out"));
        }
        (_, None, Some(_)) => {
            let message = "unstable says nothing where the program chooses Δt";
            return Err(Wrong::new("unstable", message, "leave it out, or give time_step_s"));
        }
        (safety, None, None) => StepRule::OfLimit(safety.unwrap_or(SAFETY)),
        (None, Some(seconds), unstable) => {
            let beyond_limit = if unstable == Some(true) { Beyond::UntilItShows } else { Beyond::Refused };
            StepRule::Given { seconds, beyond_limit }
        }
    };
    Ok(Time { duration, step })
}
