//! Nodes that move as prescribed: a displacement times a history.

use super::Constraint;
use crate::scene::{Acts, Axis, Effect, History, HistoryAsked, Region, Setting, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// A motion as asked for.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PrescribedMotion {
    pub region: Region,
    pub axis: Axis,
    /// Multiplied by the history; 0 holds the nodes.
    pub displacement_m: f64,
    pub history: HistoryAsked,
}

impl<const D: usize> Effect<D> for PrescribedMotion {
    fn name(&self) -> String {
        "prescribed motion".into()
    }

    fn act(&self, setting: &Setting<'_, D>) -> Result<Acts<D>, Wrong> {
        if !self.displacement_m.is_finite() {
            let message = format!("{} is no displacement", self.displacement_m);
            return Err(Wrong::new("displacement_m", message, "give a finite number"));
        }
        let nodes = self.region.nodes(setting.grid).map_err(|wrong| wrong.inside("region"))?;
        let history = self.history.check().map_err(|wrong| wrong.inside("history"))?;
        let axis = self.axis.index::<D>()?;
        if let Some(side) = self.region.edge {
            setting.edges.may_drive(side, axis)?;
        }
        let component = axis * setting.grid.stride();
        let places = nodes.iter().map(|node| setting.grid.place(*node) + component).collect();
        Ok(Acts::Constraint(Box::new(Driven { places, displacement: self.displacement_m, history })))
    }
}

/// A motion as it acts.
struct Driven {
    places: Vec<usize>,
    displacement: f64,
    history: History,
}

impl<const D: usize> Constraint<D> for Driven {
    fn name(&self) -> String {
        "prescribed motion".into()
    }

    fn places(&self) -> &[usize] {
        &self.places
    }

    fn hold(&self, next: f64, displacement: &[f64], increment: &mut [f64]) {
        let target = self.displacement * self.history.at(next);
        for &place in &self.places {
            increment[place] = target - displacement[place];
        }
    }
}
