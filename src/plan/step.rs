//! The time step: the lattice's stable limit, Δt as asked, and how many steps there are.

use crate::dispersion::timestep;
use crate::lattice::Stencil;
use crate::scene::{Beyond, Scene, StepRule, Wrong};

/// A march of more steps takes weeks on the smallest body.
const MAX_STEPS: u64 = 1_000_000_000_000;

/// From here on the search for the sharp limit takes long, a tenth of a second in the plane, and the row-sum bound stands in
/// for it.
const LARGEST_SEARCHED_M: [f64; 2] = [1000.0, 20.0];

/// The largest stable Δt in s of a lattice: sharp, or beyond m = 1000 in a bar, 20 in the plane, the row-sum bound.
pub fn stable_time_step<const D: usize>(scene: &Scene<D>, stencil: &Stencil<D>) -> f64 {
    let unit = scene.spacing / scene.speed();
    let bonds =
        |limit: fn(&Stencil<1>) -> timestep::TimeStep| Stencil::<1>::new(scene.lattice).map(|s| limit(&s));
    let courant = match D {
        _ if scene.lattice.m > LARGEST_SEARCHED_M[D - 1] => Ok((2.0 / stencil.row_sum()).sqrt()),
        1 => bonds(timestep::bar).map(|limits| limits.sharp),
        _ => Stencil::<2>::new(scene.lattice).map(|s| timestep::plane(&s).sharp),
    };
    courant.unwrap_or(f64::NAN) * unit
}

/// Δt in s, over its limit, and the number of steps.
pub fn time_step<const D: usize>(scene: &Scene<D>, limit: f64) -> Result<(f64, f64, u64), Wrong> {
    let duration = scene.time.duration;
    if !(duration.is_finite() && duration > 0.0) {
        let message = format!("a duration of {duration} s leaves nothing to simulate");
        return Err(Wrong::new("duration_s", message, "give a positive number of seconds"));
    }
    if !(limit.is_finite() && limit > 0.0) {
        let message = format!("no time step is stable on this body: the limit is {limit} s");
        return Err(Wrong::new("surface_correction", message, "take another correction, kernel or m"));
    }
    match scene.time.step {
        StepRule::OfLimit(fraction) if !(fraction > 0.0 && fraction <= 1.0) => {
            let message = format!("{fraction} is no fraction of the limit that keeps leapfrog stable");
            return Err(Wrong::new("safety", message, "take a number above 0 and up to 1, for example 0.8"));
        }
        StepRule::Given { seconds, .. } if !(seconds > 0.0 && seconds.is_finite()) => {
            let message = format!("a time step of {seconds} s does not advance");
            return Err(Wrong::new("time_step_s", message, "give a positive number of seconds"));
        }
        StepRule::Given { seconds, beyond_limit: Beyond::Refused } if seconds > limit => {
            let message = format!(
                "Δt = {seconds:e} s is above this lattice's limit of {limit:.4e} s: leapfrog would grow without bound"
            );
            let help = "take a smaller step, or safety = 0.8 in place of time_step_s";
            return Err(Wrong::new("time_step_s", message, help));
        }
        StepRule::Given { seconds, .. } if seconds > duration => {
            let message = format!("Δt = {seconds:e} s is longer than the duration of {duration:e} s");
            return Err(Wrong::new("time_step_s", message, "take a smaller step or a longer duration"));
        }
        _ => {}
    }
    let (seconds, steps) = scene.time.step.steps(duration, limit);
    if steps > MAX_STEPS {
        let message =
            format!("{steps:e} steps of {seconds:.4e} s are asked for, at most {MAX_STEPS:e} are marched");
        return Err(Wrong::new(
            "duration_s",
            message,
            "take a shorter duration, or a larger time step or spacing",
        ));
    }
    Ok((seconds, seconds / limit, steps))
}
