//! How K is read, as written: a method with its radii in horizons, and whether it is divided by its tip factor.

use super::said::check_name;
use pd_verify::scene::{Positive, Wrong};
use pd_verify::stress_intensity::gradient::Differences;
use pd_verify::stress_intensity::interaction_integral::InteractionIntegral;
use pd_verify::stress_intensity::stress_fit::StressFit;
use pd_verify::stress_intensity::two_point::{Opening, TwoPoint};
use pd_verify::stress_intensity::williams::{FaceStress, Inertia, Williams};
use pd_verify::stress_intensity::{Annulus, Elastic, Reading, Tip, Unreadable};
use schemars::JsonSchema;
use serde::Deserialize;

/// A way to read K.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MethodName {
    /// Published displacement extrapolation from the columns nearest behind the tip.
    TwoPoint,
    /// Williams' series fitted to an annulus.
    Williams,
    /// A domain integral with inertia.
    InteractionIntegral,
    /// Published: stress by differences ahead of the tip.
    StressFit,
}

impl MethodName {
    /// In tables and messages.
    pub fn word(self) -> &'static str {
        match self {
            Self::TwoPoint => "two_point",
            Self::Williams => "williams",
            Self::InteractionIntegral => "interaction_integral",
            Self::StressFit => "stress_fit",
        }
    }
}

/// What stands for the opening of the crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum OpeningName {
    /// Half of upper less lower face.
    Half,
    /// One face, as printed.
    UpperFace,
}

/// What is done about inertia in Williams' series.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum InertiaName {
    /// The static series.
    Neglected,
    /// What accelerating terms drive, with amplitudes of its own.
    Fitted,
    /// The same with amplitudes read from the acceleration. The default.
    Measured,
}

/// An extraction as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExtractionAsked {
    /// For claims and figures; default the method.
    pub name: Option<String>,
    pub method: MethodName,
    /// Where the annulus begins, in δ; default 2, never less.
    pub inner_horizons: Option<Positive>,
    /// Where it ends, in δ; default 3.
    pub outer_horizons: Option<Positive>,
    /// Where it ends, in m, instead.
    pub outer_m: Option<Positive>,
    /// Highest term of Williams' series, default 5; of `stress_fit` the powers of r beside K, default 2.
    pub terms: Option<usize>,
    /// Of `williams`; default `measured`.
    pub inertia: Option<InertiaName>,
    /// Of `williams`: whether the term r^(−1/2), a tip seen elsewhere, is fitted too. Default `false`.
    pub process_zone: Option<bool>,
    /// Of `two_point`: columns on the line; default 2.
    pub points: Option<usize>,
    /// Of `two_point`: columns left out behind the tip; default 0.
    pub skip: Option<usize>,
    /// Of `two_point`; default `half`.
    pub opening: Option<OpeningName>,
    /// Whether K is divided by what the same reading finds in the static field of a tip with K = 1. Default `false`.
    pub tip_factor: Option<bool>,
}

/// An extraction, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Extraction {
    pub name: String,
    pub method: MethodName,
    way: Way,
    /// Whether it is divided by its tip factor.
    pub tip_factor: bool,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Way {
    TwoPoint(TwoPoint),
    Williams { ring: Ring, terms: usize, inertia: Inertia, process_zone: bool },
    InteractionIntegral { ring: Ring },
    StressFit { ring: Ring, terms: usize },
}

/// Radii of an annulus.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ring {
    /// In δ.
    inner: f64,
    outer: Outer,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Outer {
    Horizons(f64),
    Metres(f64),
}

impl Ring {
    fn at(self, horizon: f64) -> Annulus {
        let outer = match self.outer {
            Outer::Horizons(count) => count * horizon,
            Outer::Metres(outer) => outer,
        };
        Annulus { inner: self.inner * horizon, outer }
    }
}

impl ExtractionAsked {
    pub fn check(&self) -> Result<Extraction, Wrong> {
        use MethodName::{StressFit as Stress, TwoPoint as Two, Williams as Series};
        let ringed = self.method != Two;
        let keys = [
            ("inner_horizons", self.inner_horizons.is_some(), ringed),
            ("outer_horizons", self.outer_horizons.is_some(), ringed),
            ("outer_m", self.outer_m.is_some(), ringed),
            ("terms", self.terms.is_some(), matches!(self.method, Series | Stress)),
            ("inertia", self.inertia.is_some(), self.method == Series),
            ("process_zone", self.process_zone.is_some(), self.method == Series),
            ("points", self.points.is_some(), self.method == Two),
            ("skip", self.skip.is_some(), self.method == Two),
            ("opening", self.opening.is_some(), self.method == Two),
        ];
        if let Some((key, ..)) = keys.iter().find(|(_, given, used)| *given && !used) {
            let message = format!("{key} says nothing about {}", self.method.word());
            return Err(Wrong::new(*key, message, "leave it out, or name the method that uses it"));
        }
        let name = self.name.clone().unwrap_or_else(|| self.method.word().to_owned());
        check_name("name", &name, &[])?;
        let way = match self.method {
            Two => Way::TwoPoint(self.two_point()?),
            Series => Way::Williams {
                ring: self.ring()?,
                terms: at_least("terms", self.terms.unwrap_or(5), 1)?,
                inertia: match self.inertia.unwrap_or(InertiaName::Measured) {
                    InertiaName::Neglected => Inertia::Neglected,
                    InertiaName::Fitted => Inertia::Fitted,
                    InertiaName::Measured => Inertia::Measured,
                },
                process_zone: self.process_zone.unwrap_or(false),
            },
            MethodName::InteractionIntegral => Way::InteractionIntegral { ring: self.ring()? },
            Stress => {
                Way::StressFit { ring: self.ring()?, terms: at_least("terms", self.terms.unwrap_or(2), 0)? }
            }
        };
        Ok(Extraction { name, method: self.method, way, tip_factor: self.tip_factor.unwrap_or(false) })
    }

    fn two_point(&self) -> Result<TwoPoint, Wrong> {
        let opening = match self.opening.unwrap_or(OpeningName::Half) {
            OpeningName::Half => Opening::Half,
            OpeningName::UpperFace => Opening::UpperFace,
        };
        let points = at_least("points", self.points.unwrap_or(2), 2)?;
        Ok(TwoPoint { opening, skip: self.skip.unwrap_or(0), points })
    }

    fn ring(&self) -> Result<Ring, Wrong> {
        let outer = match (self.outer_horizons, self.outer_m) {
            (Some(_), Some(_)) => {
                let message = "the annulus ends at outer_horizons or at outer_m, not at both";
                return Err(Wrong::new("outer_m", message, "leave one of them out"));
            }
            (count, None) => Outer::Horizons(count.map_or(3.0, |count| count.0)),
            (None, Some(outer)) => Outer::Metres(outer.0),
        };
        if matches!(outer, Outer::Metres(_)) && self.tip_factor == Some(true) {
            let message =
                "a tip factor belongs to radii in horizons: only then is it one number for all spacings";
            return Err(Wrong::new("outer_m", message, "give outer_horizons, or leave tip_factor out"));
        }
        let inner = self.inner_horizons.map_or(2.0, |inner| inner.0);
        if inner < 2.0 {
            let message =
                format!("an annulus from {inner} delta on lies inside the nonlocal zone of the tip");
            return Err(Wrong::new("inner_horizons", message, "begin at 2 or further out"));
        }
        if let Outer::Horizons(count) = outer
            && count <= inner
        {
            let message = format!("no annulus lies between {inner} and {count} horizons");
            return Err(Wrong::new("outer_horizons", message, "take more than inner_horizons"));
        }
        Ok(Ring { inner, outer })
    }
}

fn at_least(key: &str, given: usize, least: usize) -> Result<usize, Wrong> {
    if (least..=40).contains(&given) {
        return Ok(given);
    }
    Err(Wrong::new(key, format!("{key} = {given} cannot be"), format!("give a number from {least} to 40")))
}

/// A reading prepared for the nodes around one tip.
#[derive(Debug, Clone)]
pub struct Prepared {
    pub reading: Reading,
    /// Of a fit: how far rounding is magnified.
    pub condition: Option<f64>,
}

/// Numbers that a fit may have: nodes times unknowns; more take gigabytes to prepare.
const MOST_NUMBERS: f64 = 2e7;

impl Extraction {
    /// Refuses what would look at more nodes than are fitted; lengths in m.
    pub fn check_size(&self, horizon: f64, spacing: f64) -> Result<(), Wrong> {
        let reach = self.reach(horizon, spacing) / spacing;
        let numbers = std::f64::consts::PI * reach * reach * (2 * self.terms().unwrap_or(1) + 2) as f64;
        if numbers <= MOST_NUMBERS {
            return Ok(());
        }
        let message =
            format!("{} looks {reach:.0} cells around the tip: a fit of {numbers:.1e} numbers", self.name);
        Err(Wrong::new(
            "",
            message,
            format!("take a smaller radius or m, or fewer terms: at most {MOST_NUMBERS:.0e}"),
        ))
    }

    /// The same with another outer radius, in δ, and another highest term, where it has them.
    pub fn with(&self, outer_horizons: f64, terms: Option<usize>) -> Self {
        let wider = |ring: Ring| Ring { outer: Outer::Horizons(outer_horizons), ..ring };
        let way = match self.way {
            Way::TwoPoint(two_point) => Way::TwoPoint(two_point),
            Way::Williams { ring, terms: own, inertia, process_zone } => {
                Way::Williams { ring: wider(ring), terms: terms.unwrap_or(own), inertia, process_zone }
            }
            Way::InteractionIntegral { ring } => Way::InteractionIntegral { ring: wider(ring) },
            Way::StressFit { ring, terms: own } => {
                Way::StressFit { ring: wider(ring), terms: terms.unwrap_or(own) }
            }
        };
        Self { way, ..self.clone() }
    }

    /// Inner and outer radius in m; `None` of what has no annulus.
    pub fn radii(&self, horizon: f64) -> Option<Annulus> {
        match self.way {
            Way::TwoPoint(_) => None,
            Way::Williams { ring, .. } | Way::InteractionIntegral { ring } | Way::StressFit { ring, .. } => {
                Some(ring.at(horizon))
            }
        }
    }

    /// Highest term of its series.
    pub fn terms(&self) -> Option<usize> {
        match self.way {
            Way::Williams { terms, .. } | Way::StressFit { terms, .. } => Some(terms),
            Way::TwoPoint(_) | Way::InteractionIntegral { .. } => None,
        }
    }

    /// How far around the tip it looks, in m, differences included.
    pub fn reach(&self, horizon: f64, spacing: f64) -> f64 {
        match self.way {
            Way::TwoPoint(two_point) => spacing * (two_point.skip + two_point.points + 1) as f64,
            _ => self.radii(horizon).map_or(0.0, |ring| ring.outer) + 3.0 * spacing,
        }
    }

    /// Prepares the reading for the nodes around a tip.
    pub fn prepare(&self, tip: &Tip, elastic: &Elastic) -> Result<Prepared, Unreadable> {
        let plain = |reading| Prepared { reading, condition: None };
        match self.way {
            Way::TwoPoint(two_point) => two_point.reading(tip, elastic).map(plain),
            Way::Williams { ring, terms, inertia, process_zone } => {
                let williams = Williams {
                    annulus: ring.at(tip.horizon),
                    terms,
                    process_zone,
                    clear_of_faces: 0.0,
                    inertia,
                    faces: FaceStress::Known,
                };
                let fit = williams.fit(tip, elastic)?;
                Ok(Prepared { reading: fit.reading(), condition: Some(fit.condition()) })
            }
            Way::InteractionIntegral { ring } => {
                InteractionIntegral::over(ring.at(tip.horizon)).reading(tip, elastic).map(plain)
            }
            Way::StressFit { ring, terms } => {
                let annulus = ring.at(tip.horizon);
                let fit = StressFit { annulus, terms, differences: Differences::Second };
                fit.reading(tip, elastic).map(plain)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(text: &str) -> Result<Extraction, String> {
        toml::from_str::<ExtractionAsked>(text).unwrap().check().map_err(|wrong| wrong.key)
    }

    #[test]
    fn radii_are_in_horizons_unless_the_outer_one_is_in_metres() {
        let plain = asked("method = 'williams'").unwrap();
        assert_eq!(plain.radii(0.1), Some(Annulus { inner: 0.2, outer: 3.0 * 0.1 }));
        let fixed = asked("method = 'williams'\nouter_m = 0.5").unwrap();
        assert_eq!(fixed.radii(0.1), Some(Annulus { inner: 0.2, outer: 0.5 }));
        assert_eq!((plain.terms(), asked("method = 'two_point'").unwrap().radii(0.1)), (Some(5), None));
        assert_eq!(plain.with(6.0, Some(7)).radii(0.1).unwrap().outer, 6.0 * 0.1);
    }

    #[test]
    fn what_no_reading_can_use_is_refused() {
        for (text, key) in [
            ("method = 'williams'\ninner_horizons = 1.5", "inner_horizons"),
            ("method = 'williams'\nouter_horizons = 2", "outer_horizons"),
            ("method = 'williams'\nouter_m = 0.5\nouter_horizons = 3", "outer_m"),
            ("method = 'williams'\nouter_m = 0.5\ntip_factor = true", "outer_m"),
            ("method = 'williams'\nterms = 0", "terms"),
            ("method = 'two_point'\npoints = 1", "points"),
            ("method = 'two_point'\nterms = 3", "terms"),
            ("method = 'williams'\nskip = 1", "skip"),
            ("method = 'williams'\nname = 'Best way'", "name"),
        ] {
            assert_eq!(asked(text).unwrap_err(), key, "{text}");
        }
    }
}
