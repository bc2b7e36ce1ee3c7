//! What is refused of notches that run, and how fast they run in steps.

use crate::forces::surface::Correction;
use crate::scene::{Running, SLACK, Scene, Wrong};

/// Whether each running notch has a way to go, inside the body, and nothing else needs the bonds to stay.
pub fn check<const D: usize>(scene: &Scene<D>) -> Result<(), Wrong> {
    for (index, running) in scene.running.iter().enumerate() {
        let path = format!("notch[{}].runs", running.notch);
        if scene.running[..index].iter().any(|other| other.notch == running.notch) {
            let message = "the notch runs already";
            return Err(Wrong::new(path, message, "let each notch run once"));
        }
        one(scene, running).map_err(|wrong| wrong.inside(&path))?;
        if scene.surface != Correction::None {
            let message =
                "a surface correction is made for the bonds at t = 0, and a notch that runs cuts some";
            let help = "leave surface_correction out, or let no notch run";
            return Err(Wrong::new("surface_correction", message, help));
        }
    }
    Ok(())
}

fn one<const D: usize>(scene: &Scene<D>, running: &Running) -> Result<(), Wrong> {
    let Some(notch) = scene.notches.get(running.notch) else {
        let message = format!("there is no notch {} that could run", running.notch);
        return Err(Wrong::new("", message, "add the notch, or leave runs out"));
    };
    let Running { speed, start, by, .. } = *running;
    if !(speed.is_finite() && speed > 0.0) {
        let message = format!("a notch does not run at {speed} m/s");
        return Err(Wrong::new("speed_m_s", message, "give a positive number"));
    }
    if !(start.is_finite() && start >= 0.0) {
        let message = format!("a notch cannot set out at {start} s");
        return Err(Wrong::new("start_s", message, "give a time from 0 on"));
    }
    if !(by.is_finite() && by >= scene.spacing * (1.0 - SLACK)) {
        let message = format!("a way of {by} m is shorter than a cell of {} m", scene.spacing);
        return Err(Wrong::new("by_m", message, "let it run over a cell or more"));
    }
    let (end, size) = (running.end(notch), scene.size());
    let slack = SLACK * scene.spacing;
    let outside = (0..D).find(|&axis| !(-slack..=size[axis] + slack).contains(&end[axis]));
    let Some(axis) = outside else { return Ok(()) };
    // As far as the first edge on its way.
    let left = (0..D).filter(|&axis| end[axis] != notch.to[axis]).map(|axis| {
        let edge = if end[axis] > notch.to[axis] { size[axis] } else { 0.0 };
        by * (edge - notch.to[axis]) / (end[axis] - notch.to[axis])
    });
    let left = left.fold(by, f64::min);
    let message = format!(
        "the notch runs out of the body: to {} m along {}, and the body reaches from 0 to {} m",
        end[axis],
        ["x", "y"][axis],
        size[axis]
    );
    Err(Wrong::new("by_m", message, format!("let it run by {left} m or less")))
}

/// Δx/(vΔt) of the fastest; `None` where no notch runs.
pub fn steps_per_cell<const D: usize>(scene: &Scene<D>, time_step: f64) -> Option<f64> {
    let fastest = scene.running.iter().map(|running| running.speed).reduce(f64::max)?;
    Some(scene.spacing / (fastest * time_step))
}
