//! `asks = "wave_cost"` and `asks = "pulse_cost"`: a standing plane wave, or a Gaussian pulse let go, in a periodic body.

use super::problem::{Facts, Order, Problem};
use super::runs::{Run, Solved, seconds};
use super::settings::{Setting, SettingsAsked, Track};
use super::work_precision::WorkPrecision;
use crate::convergence::path::Sequence;
use crate::convergence::pulse::{self, PointPulse};
use crate::convergence::refined::{self, Problem as Refinable};
use crate::convergence::space::{In, Space};
use crate::convergence::wave::{self, PlaneWave};
use crate::dispersion::words::{BodyName, BranchName};
use crate::dsif::tips::Tips;
use crate::question::Effort;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::ErrorKind;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::scene::{Positive, Scene, Wrong};
use pd_verify_reference::medium::Medium;
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// A plane wave in a plate as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WaveCostAsked {
    /// A plate.
    pub body: BodyName,
    /// About: the body holds whole cells at every level.
    pub wavelength_m: Positive,
    /// The wave runs along this vector of whole numbers.
    pub direction: [u32; 2],
    pub branch: BranchName,
    /// How long, in periods of the local wave.
    pub periods: Positive,
    pub settings: SettingsAsked,
}

/// A pulse as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PulseCostAsked {
    pub body: BodyName,
    /// Length of the ring, or of a side of the square.
    pub side_m: Positive,
    /// Where exp(−(r/width)²) has fallen to 1/e.
    pub width_m: Positive,
    /// How far a local P wave travels meanwhile, over the side.
    pub travel: Positive,
    pub settings: SettingsAsked,
}

impl Asked for WaveCostAsked {
    type Question = WorkPrecision;

    fn check(&self, written: &Written<'_>) -> Result<WorkPrecision, Wrong> {
        let body = Body::from(self.body);
        if body == Body::Bar {
            let message = "in a bar a wave has no direction";
            return Err(Wrong::new("body", message, "take a plate, or asks = \"pulse_cost\""));
        }
        PlaneWave::check_direction(self.direction)?;
        let settings = self.settings.all(body).map_err(|wrong| wrong.inside("settings"))?;
        let spacings = self.settings.spacings().map_err(|wrong| wrong.inside("settings"))?;
        let sequences: Vec<Sequence> = settings.iter().map(|one| one.sequence(&spacings)).collect();
        let wave = PlaneWave {
            material: written.material()?,
            body,
            direction: self.direction,
            branch: self.branch.into(),
            wavelength: self.wavelength_m.0,
            periods: self.periods.0,
            safety: f64::NAN,
        };
        WorkPrecision::new(written.title, &wave.fitting(&sequences)?, settings, &spacings)
    }
}

impl Asked for PulseCostAsked {
    type Question = WorkPrecision;

    fn check(&self, written: &Written<'_>) -> Result<WorkPrecision, Wrong> {
        let body = Body::from(self.body);
        let settings = self.settings.all(body).map_err(|wrong| wrong.inside("settings"))?;
        let spacings = self.settings.spacings().map_err(|wrong| wrong.inside("settings"))?;
        let pulse = PointPulse {
            material: written.material()?,
            body,
            side: self.side_m.0,
            width: self.width_m.0,
            travel: self.travel.0,
            safety: f64::NAN,
        };
        pulse.check(spacings[0])?;
        WorkPrecision::new(written.title, &pulse, settings, &spacings)
    }
}

impl Problem for PlaneWave<2> {
    fn facts(&self) -> Facts {
        // Three levels with (kδ)² beyond 1.6 at the first say little of what it tends to.
        facts::<2, _>(self, 0.2 * self.wavelength)
    }

    fn track(&self, setting: Setting, spacings: &[f64]) -> Result<Track, Wrong> {
        let wave = Self { safety: setting.safety, ..*self };
        let marches = wave.marches(&setting.sequence(spacings), None)?;
        Ok(track(setting, wave, marches))
    }
}

impl Problem for PointPulse {
    fn facts(&self) -> Facts {
        match self.body {
            Body::Bar => facts::<1, _>(self, f64::INFINITY),
            _ => facts::<2, _>(self, f64::INFINITY),
        }
    }

    fn track(&self, setting: Setting, spacings: &[f64]) -> Result<Track, Wrong> {
        let pulse = Self { safety: setting.safety, ..*self };
        let sequence = setting.sequence(spacings);
        Ok(match self.body {
            Body::Bar => track::<1, _>(setting, pulse, pulse.ready(&sequence)?),
            _ => track::<2, _>(setting, pulse, pulse.ready(&sequence)?),
        })
    }
}

/// A march of a refined problem as a run: its error in L2 against the local answer.
struct Marched<const D: usize, P: Marches<D>> {
    problem: Arc<P>,
    level: P::Level,
}

/// A refined problem whose levels are scenes that are marched.
trait Marches<const D: usize>: Refinable<D> {
    fn scene(level: &Self::Level) -> &Scene<D>;
    fn planned(level: &Self::Level) -> &Plan;
}

impl Marches<2> for PlaneWave<2> {
    fn scene(level: &wave::Marched<2>) -> &Scene<2> {
        &level.scene
    }

    fn planned(level: &wave::Marched<2>) -> &Plan {
        &level.plan
    }
}

impl<const D: usize> Marches<D> for PointPulse
where
    In: Space<D>,
{
    fn scene(level: &pulse::Marched<D>) -> &Scene<D> {
        &level.scene
    }

    fn planned(level: &pulse::Marched<D>) -> &Plan {
        &level.plan
    }
}

fn track<const D: usize, P: Marches<D> + 'static>(
    setting: Setting,
    problem: P,
    levels: Vec<P::Level>,
) -> Track {
    let problem = Arc::new(problem);
    let run = |level| Box::new(Marched { problem: problem.clone(), level }) as Box<dyn Run>;
    Track { setting, runs: levels.into_iter().map(run).collect() }
}

fn facts<const D: usize, P: Refinable<D>>(problem: &P, widest: f64) -> Facts {
    let refined::Order { expected, because } = problem.order();
    Facts {
        what: problem.what(),
        equations: problem.equations(),
        source: problem.source(),
        error_kind: ErrorKind::L2Relative,
        dimension: D as u32,
        own: Some(problem.rounding()),
        order: Some(Order { expected, within: 0.1, steady: true, widest, because }),
        readings: vec![String::new()],
        falling: Vec::new(),
        disperses: true,
    }
}

/// Index of L2 in the norms of a refinement.
const L2: usize = 1;

impl<const D: usize, P: Marches<D>> Run for Marched<D, P> {
    fn spacing(&self) -> f64 {
        P::scene(&self.level).spacing
    }

    fn courant(&self) -> f64 {
        let scene = P::scene(&self.level);
        scene.speed() * self.plan().time_step_s / scene.spacing
    }

    fn plan(&self) -> &Plan {
        P::planned(&self.level)
    }

    fn effort(&self) -> Effort {
        self.problem.effort(&self.level)
    }

    fn solve(&self, subject: &dyn Subject, _: &Tips) -> Result<Solved, String> {
        let solved = self.problem.solve(subject, &self.level, &Medium::Local)?;
        Ok(Solved { errors: vec![Some(solved.errors[L2])], own: solved.own })
    }

    fn seconds(&self, times: usize) -> Result<Vec<f64>, String> {
        seconds(P::scene(&self.level), self.plan(), times)
    }
}
