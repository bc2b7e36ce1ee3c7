//! Which wavenumbers a curve is drawn at: a range that ends at the Brillouin zone's edge, or a list.

use super::curve::Curve;
use pd_verify::scene::{Positive, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// Quadrature takes a panel for each wavelength in the horizon.
const MAX_K_HORIZON: f64 = 100_000.0;

/// Which wavenumbers are drawn: a range, or a list.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Wavenumbers {
    /// Start of the range, default 0 (logarithmic: one thousandth of the end).
    pub from_per_m: Option<Positive>,
    /// End of the range; a grid's curve ends at the edge of its Brillouin zone if that comes first.
    pub to_per_m: Option<Positive>,
    /// Points in the range, default 200.
    pub count: Option<u64>,
    #[serde(default)]
    pub spacing: Spacing,
    /// Instead of a range: these wavenumbers and no others.
    pub values_per_m: Option<Vec<Positive>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Spacing {
    #[default]
    Linear,
    Logarithmic,
}

impl Wavenumbers {
    /// Refuses contradictions and empty ranges.
    pub fn check(&self) -> Result<(), Wrong> {
        match (&self.values_per_m, &self.to_per_m) {
            (Some(values), None) if values.is_empty() => Err(Wrong::new(
                "values_per_m",
                "an empty list asks for nothing",
                "give at least one wavenumber",
            )),
            (Some(_), None) if self.from_per_m.is_some() || self.count.is_some() => Err(Wrong::new(
                "values_per_m",
                "values_per_m and a range exclude each other",
                "keep one of the two",
            )),
            (Some(_), None) => Ok(()),
            (None, Some(to)) => {
                if self.from_per_m.is_some_and(|from| from.0 >= to.0) {
                    return Err(Wrong::new(
                        "from_per_m",
                        "the range is empty",
                        "from_per_m must be below to_per_m",
                    ));
                }
                if self.count.is_some_and(|count| count < 2) {
                    return Err(Wrong::new("count", "a range needs at least 2 points", "take count = 200"));
                }
                Ok(())
            }
            (None, None) => {
                Err(Wrong::new("to_per_m", "no wavenumbers are given", "add to_per_m, or values_per_m"))
            }
            (Some(_), Some(_)) => Err(Wrong::new(
                "values_per_m",
                "values_per_m and to_per_m exclude each other",
                "keep one of the two",
            )),
        }
    }

    /// Refuses what a curve cannot be drawn at: a range beyond the zone, more waves in the horizon than are resolved.
    pub fn check_for(&self, curve: &Curve) -> Result<(), Wrong> {
        if let (Some(from), Some(edge)) = (self.from_per_m, curve.zone_edge())
            && from.0 >= edge
        {
            let message = format!("the range begins beyond the zone's edge, {edge} per m");
            return Err(Wrong::new("from_per_m", message, "start below the edge π/Δx, or refine Δx"));
        }
        let values = self.values_per_m.iter().flatten().chain(&self.to_per_m);
        let most = values.map(|k| k.0).fold(0.0, f64::max) * curve.horizon().unwrap_or(0.0);
        if curve.zone_edge().is_none() && most > MAX_K_HORIZON {
            let waves = most / std::f64::consts::TAU;
            let message = format!("{waves:.3e} wavelengths in the horizon are more than are resolved");
            return Err(Wrong::new(
                "",
                message,
                format!("take a smaller k or horizon: kδ up to {MAX_K_HORIZON}"),
            ));
        }
        Ok(())
    }

    /// Points per curve, at most.
    pub fn count(&self) -> u64 {
        self.values_per_m.as_ref().map_or_else(|| self.count.unwrap_or(200), |values| values.len() as u64)
    }

    /// The largest wavenumber of a curve.
    pub fn largest(&self, curve: &Curve) -> f64 {
        match (&self.values_per_m, &self.to_per_m) {
            (Some(values), _) => values.iter().map(|k| k.0).fold(0.0, f64::max),
            (None, Some(to)) => curve.zone_edge().map_or(to.0, |edge| edge.min(to.0)),
            (None, None) => 0.0,
        }
    }

    /// The wavenumbers of a curve: a range ends at the zone's edge, with a point on it.
    pub fn of(&self, curve: &Curve) -> Vec<f64> {
        if let Some(values) = &self.values_per_m {
            return values.iter().map(|k| k.0).collect();
        }
        let to = self.to_per_m.expect("checked").0;
        let end = curve.zone_edge().map_or(to, |edge| edge.min(to));
        let steps = self.count() - 1;
        let logarithmic = self.spacing == Spacing::Logarithmic;
        let from = self.from_per_m.map_or(if logarithmic { 1e-3 * to } else { 0.0 }, |k| k.0);
        let at = |n: u64| {
            let t = n as f64 / steps as f64;
            if logarithmic { from * libm::pow(to / from, t) } else { from + (to - from) * t }
        };
        let mut all: Vec<f64> = (0..=steps).map(at).filter(|&k| k < end * (1.0 - 1e-9)).collect();
        all.push(end);
        all
    }
}
