//! The marches of a running crack: one speed on every level, each plate with a notch that sets out.

use super::setup::{Problem, Setup};
use crate::convergence::path::Weights;
use crate::rounded::rounded;
use pd_verify::plan::Plan;
use pd_verify::scene::{Running, Wrong};

/// One speed, from coarse to fine.
pub struct Run {
    /// Over Rayleigh's.
    pub share: f64,
    /// In m/s.
    pub speed: f64,
    pub setups: Vec<Setup>,
}

/// Refuses speeds that no crack has, or that are there twice.
pub fn check_speeds(shares: &[f64]) -> Result<(), Wrong> {
    if shares.is_empty() {
        return Err(Wrong::new("speeds", "no speed is given", "for example [0.2, 0.4, 0.6]"));
    }
    if let Some(share) = shares.iter().find(|share| !(0.01..1.0).contains(*share)) {
        let message = format!("{share} of the speed of Rayleigh waves is no speed to run at");
        return Err(Wrong::new("speeds", message, "give parts of that speed from 0.01 to below 1"));
    }
    if shares.iter().enumerate().any(|(index, share)| shares[..index].contains(share)) {
        return Err(Wrong::new("speeds", "a speed is there twice", "give each once"));
    }
    Ok(())
}

/// What all speeds have in common.
pub struct Way {
    /// In s.
    pub start: f64,
    /// How long before t = 0 the scene's clock starts, in s.
    pub before: f64,
    /// For how long, in s.
    pub by: f64,
    pub outer: f64,
    /// In m/s.
    pub rayleigh: f64,
}

impl Way {
    /// One speed on all levels, its notch made to run.
    pub fn run(
        &self,
        problem: &Problem,
        weights: Weights,
        share: f64,
        m: f64,
        spacings: &[f64],
    ) -> Result<Run, Wrong> {
        let speed = share * self.rayleigh;
        let mut setups: Vec<Setup> = Vec::new();
        for &dx in spacings {
            let reach = self.outer * m * dx + 3.0 * dx;
            let travel = speed * self.by;
            let limit = setups.last().map(Setup::limit);
            let mut setup = problem.on(weights.lattice(m), dx, &[], reach + travel, limit)?;
            if reach > setup.plate.room() || reach + travel > setup.plate.ahead() {
                let message = format!(
                    "K is read {} m around a tip that goes {} m on, and the edges are {} m ahead and {} m beside",
                    rounded(reach),
                    rounded(travel),
                    rounded(setup.plate.ahead()),
                    rounded(setup.plate.tip[1])
                );
                return Err(Wrong::new(
                    "speeds",
                    message,
                    "take a larger plate, a smaller dx_m, or end earlier",
                ));
            }
            setup.scene.running =
                vec![Running { notch: 0, speed, start: self.start + self.before, by: travel + dx }];
            let limit = setup.limit() * dx / setup.scene.speed();
            setup.plan = Plan::below(&setup.scene, limit)?;
            // Several looks in the time in which the tip passes a cell.
            let looks = (dx / speed / setup.plan.time_step_s / LOOKS).floor().max(1.0);
            setup.scene.probes[0].every = looks as u64;
            setups.push(setup);
        }
        Ok(Run { share, speed, setups })
    }
}

/// Looks while the tip passes a cell, at least where steps are short enough.
const LOOKS: f64 = 8.0;
