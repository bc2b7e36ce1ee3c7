//! `asks = "crack_cost"`: K of a crack under a wave or with loaded faces, read in several ways, against Freund's history.

use super::problem::{Facts, Problem};
use super::runs::{Run, Solved, seconds};
use super::settings::{Setting, SettingsAsked, Track};
use super::work_precision::WorkPrecision;
use crate::dsif::errors;
use crate::dsif::extraction::ExtractionAsked;
use crate::dsif::intensity::{Intensity, IntensityAsked};
use crate::dsif::known::KnownAsked;
use crate::dsif::known::WindowAsked;
use crate::dsif::load::LoadAsked;
use crate::dsif::plate::PlateAsked;
use crate::dsif::setup::Setup;
use crate::dsif::tips::Tips;
use crate::input::one_or_many;
use crate::question::Effort;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::ErrorKind;
use pd_verify::plan::Plan;
use pd_verify::scene::{Positive, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CrackCostAsked {
    pub plate: PlateAsked,
    pub load: LoadAsked,
    pub known: KnownAsked,
    pub window: WindowAsked,
    pub extraction: Vec<ExtractionAsked>,
    pub settings: SettingsAsked,
}

/// The case beside the study that it stands in.
struct Cracked<'a> {
    asked: &'a CrackCostAsked,
    written: &'a Written<'a>,
    /// Names of the extractions.
    readings: Vec<String>,
    equations: &'static str,
}

/// One plate on one lattice.
struct Marched {
    intensity: Arc<Intensity>,
    level: usize,
}

impl Asked for CrackCostAsked {
    type Question = WorkPrecision;

    fn check(&self, written: &Written<'_>) -> Result<WorkPrecision, Wrong> {
        let body = self.plate.body.into();
        let settings = self.settings.all(body).map_err(|wrong| wrong.inside("settings"))?;
        let spacings = self.settings.spacings().map_err(|wrong| wrong.inside("settings"))?;
        let first =
            settings.first().ok_or_else(|| Wrong::new("settings", "there is no setting", "give one"))?;
        // What is wrong with plate, load or window is said before settings are multiplied.
        let one = self.on(written, *first, &spacings[..1])?;
        let readings = one.extractions.iter().map(|one| one.name.clone()).collect();
        let equations = crate::question::Question::equations(&one);
        WorkPrecision::new(
            written.title,
            &Cracked { asked: self, written, readings, equations },
            settings,
            &spacings,
        )
    }
}

impl CrackCostAsked {
    /// The plate with one setting at some spacings.
    fn on(&self, written: &Written<'_>, setting: Setting, spacings: &[f64]) -> Result<Intensity, Wrong> {
        let asked = IntensityAsked {
            plate: self.plate.clone(),
            load: self.load.clone(),
            known: self.known.clone(),
            window: self.window.clone(),
            m: one_or_many(Positive(setting.lattice.m)),
            dx_m: Some(crate::input::OneOrMany(spacings.iter().copied().map(Positive).collect())),
            horizon_m: None,
            weights: self.settings.weights.clone(),
            safety: Some(Positive(setting.safety)),
            extraction: self.extraction.clone(),
            expect: Vec::new(),
            normalized_by: None,
            field_m: None,
        };
        asked.weighed(written, &[setting.weights()])
    }
}

impl Problem for Cracked<'_> {
    fn facts(&self) -> Facts {
        let divided =
            |(index, one): (usize, &ExtractionAsked)| one.tip_factor.unwrap_or(false).then_some(index);
        Facts {
            what: "the stress intensity factor of a crack".into(),
            equations: self.equations,
            source: "Freund 1990, 2.5 and 2.6, convolved with the load's history",
            error_kind: ErrorKind::RmsOfPeak,
            dimension: 2,
            own: None,
            order: None,
            falling: self.asked.extraction.iter().enumerate().filter_map(divided).collect(),
            readings: self.readings.clone(),
            disperses: false,
        }
    }

    fn track(&self, setting: Setting, spacings: &[f64]) -> Result<Track, Wrong> {
        let intensity = Arc::new(self.asked.on(self.written, setting, spacings)?);
        let run = |level| Box::new(Marched { intensity: intensity.clone(), level }) as Box<dyn Run>;
        Ok(Track { setting, runs: (0..spacings.len()).map(run).collect() })
    }
}

impl Marched {
    fn of(&self) -> &Setup {
        &self.intensity.tracks[0].setups[self.level]
    }
}

impl Run for Marched {
    fn spacing(&self) -> f64 {
        self.of().scene.spacing
    }

    fn courant(&self) -> f64 {
        let scene = &self.of().scene;
        scene.speed() * self.plan().time_step_s / scene.spacing
    }

    fn plan(&self) -> &Plan {
        &self.of().plan
    }

    fn effort(&self) -> Effort {
        Effort::of_scenes(std::slice::from_ref(self.plan()))
    }

    fn tip(&self) -> Option<&Setup> {
        self.intensity.extractions.iter().any(|one| one.tip_factor).then(|| self.of())
    }

    fn solve(&self, subject: &dyn Subject, tips: &Tips) -> Result<Solved, String> {
        let (reads, _) = self.intensity.read(subject, self.of(), tips)?;
        let error = |read| errors::of(&self.intensity, read).map(|errors| errors.rms);
        Ok(Solved { errors: reads.iter().map(error).collect(), own: None })
    }

    fn seconds(&self, times: usize) -> Result<Vec<f64>, String> {
        seconds(&self.of().scene, self.plan(), times)
    }
}
