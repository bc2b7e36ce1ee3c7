//! What loads a cracked plate: a stress on its edges or on the faces of its crack, and how it grows.

use super::plate::LateralName;
use pd_verify::forces::{FaceTraction, Traction};
use pd_verify::scene::{Axis, Effect, HistoryAsked, HistoryShape, Positive, Side, Wrong};
use pd_verify::stress_intensity::{Faces, Mode};
use pd_verify_reference::freund::Load as KnownLoad;
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// Opening or sliding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
pub enum ModeName {
    /// The stress pulls across the crack.
    I,
    /// The stress shears along it.
    #[allow(clippy::upper_case_acronyms)]
    II,
}

impl ModeName {
    /// In tables.
    pub fn word(self) -> &'static str {
        match self {
            Self::I => "I",
            Self::II => "II",
        }
    }

    /// Of the reading that belongs to it: 0 for K_I.
    pub fn index(self) -> usize {
        self as usize
    }
}

impl From<ModeName> for Mode {
    fn from(name: ModeName) -> Self {
        match name {
            ModeName::I => Self::I,
            ModeName::II => Self::II,
        }
    }
}

/// Where the stress acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum On {
    /// One wave, from the upper edge.
    Top,
    /// Two waves that meet on the crack's line.
    TopAndBottom,
    /// Pure shear: of mode II.
    AllEdges,
    /// On both faces of the crack.
    Faces,
}

/// How the stress grows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Growth {
    /// At once, at t = 0.
    Step,
    /// In a straight line, from t = 0 on.
    Ramp,
    /// Smoothly over `rise_s`, centred on t = 0: its rate is a raised cosine, (1 + cos(2πt/T))/T.
    RaisedCosineRate,
}

/// A load as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadAsked {
    pub mode: ModeName,
    pub on: On,
    pub stress_pa: Positive,
    pub grows: Growth,
    /// Of `ramp` and `raised_cosine_rate`: from nothing to all.
    pub rise_s: Option<Positive>,
}

/// A load, checked.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    pub mode: ModeName,
    pub on: On,
    /// In Pa.
    pub stress: f64,
    pub grows: Growth,
    /// In s; 0 of a step.
    pub rise: f64,
}

impl LoadAsked {
    pub fn check(&self, lateral: LateralName) -> Result<Load, Wrong> {
        let mode = self.mode;
        if (self.on, mode) == (On::AllEdges, ModeName::I) {
            let help = "take on = \"top\" or \"top_and_bottom\", or mode = \"II\"";
            return Err(Wrong::new("load.on", "all four edges are loaded in shear, which is mode II", help));
        }
        let other = match mode {
            ModeName::I => (LateralName::Guides, "rollers"),
            ModeName::II => (LateralName::Rollers, "guides"),
        };
        if lateral == other.0 {
            let message = format!("such lateral edges stop the wave of mode {}", mode.word());
            let help = format!("take lateral = \"{}\" or \"free\"", other.1);
            return Err(Wrong::new("plate.lateral", message, help));
        }
        if self.on == On::AllEdges && lateral != LateralName::Free {
            return Err(Wrong::new("plate.lateral", "loaded edges are free", "leave lateral out"));
        }
        let rise = match (self.grows, self.rise_s) {
            (Growth::Step, None) => 0.0,
            (Growth::Step, Some(_)) => {
                let help = "leave rise_s out, or take grows = \"ramp\"";
                return Err(Wrong::new("load.rise_s", "a step has no rise", help));
            }
            (_, Some(rise)) => rise.0,
            (_, None) => return Err(Wrong::new("load", "this load needs rise_s", "add rise_s")),
        };
        Ok(Load { mode, on: self.on, stress: self.stress_pa.0, grows: self.grows, rise })
    }
}

impl Load {
    /// How long before its nominal start, t = 0, a load begins, in s: the scene's clock starts there.
    pub fn before(&self) -> f64 {
        if self.grows == Growth::RaisedCosineRate { 0.5 * self.rise } else { 0.0 }
    }

    /// What acts on a plate; the crack is its first notch.
    pub fn effects(&self) -> Vec<Arc<dyn Effect<2>>> {
        let history = self.history();
        let traction = |edge: Side, axis: Axis, sign: f64| -> Arc<dyn Effect<2>> {
            Arc::new(Traction { edge, axis, stress_pa: sign * self.stress, history: history.clone() })
        };
        let along = if self.mode == ModeName::I { Axis::Y } else { Axis::X };
        match self.on {
            On::Top => vec![traction(Side::Top, along, 1.0)],
            On::TopAndBottom => vec![traction(Side::Top, along, 1.0), traction(Side::Bottom, along, -1.0)],
            On::AllEdges => vec![
                traction(Side::Top, Axis::X, 1.0),
                traction(Side::Bottom, Axis::X, -1.0),
                traction(Side::Right, Axis::Y, 1.0),
                traction(Side::Left, Axis::Y, -1.0),
            ],
            On::Faces => {
                let part = |mode| (self.mode == mode).then_some(self.stress);
                let (normal_pa, shear_pa) = (part(ModeName::I), part(ModeName::II));
                vec![Arc::new(FaceTraction { notch: None, normal_pa, shear_pa, history })]
            }
        }
    }

    fn history(&self) -> HistoryAsked {
        let step = HistoryAsked::step();
        match self.grows {
            Growth::Step => step,
            Growth::Ramp => {
                HistoryAsked { shape: HistoryShape::Ramp, rise_s: Some(Positive(self.rise)), ..step }
            }
            Growth::RaisedCosineRate => {
                let (times, values): (Vec<f64>, Vec<f64>) = self.points(self.before()).into_iter().unzip();
                HistoryAsked {
                    shape: HistoryShape::Table,
                    times_s: Some(times),
                    values: Some(values),
                    ..step
                }
            }
        }
    }

    /// A smooth rise as straight lines, its centre at a time in s: 128 of them are within 1e-4 of it everywhere.
    fn points(&self, centre: f64) -> Vec<(f64, f64)> {
        let at = |n: u32| {
            let x = f64::from(n) / 128.0;
            (centre + (x - 0.5) * self.rise, smooth(x))
        };
        (0..=128).map(at).collect()
    }

    /// The stress that the faces of the crack bear at t in s.
    pub fn faces_at(&self, t: f64) -> Faces {
        if self.on != On::Faces {
            return Faces::default();
        }
        let stress = -self.stress * self.factor(t);
        match self.mode {
            ModeName::I => Faces { normal: stress, shear: 0.0 },
            ModeName::II => Faces { normal: 0.0, shear: stress },
        }
    }

    /// σ(t)/σ₀; t = 0 is the nominal start.
    fn factor(&self, t: f64) -> f64 {
        let begun = ((t + self.before()) / self.rise).clamp(0.0, 1.0);
        match self.grows {
            Growth::Step => f64::from(t >= 0.0),
            Growth::Ramp => begun,
            Growth::RaisedCosineRate => smooth(begun),
        }
    }

    /// The same history in the reference's words.
    pub fn known(&self) -> KnownLoad {
        let (start, rise) = (-self.before(), self.rise);
        match self.grows {
            Growth::Step => KnownLoad::Step { start },
            Growth::Ramp => KnownLoad::Ramp { start, rise },
            Growth::RaisedCosineRate => KnownLoad::Table { points: self.points(0.0) },
        }
    }

    /// Waves of amplitude σ₀ that reach the crack.
    pub fn waves(&self) -> f64 {
        match self.on {
            On::Top | On::Faces => 1.0,
            On::TopAndBottom | On::AllEdges => 2.0,
        }
    }
}

/// The integral of a raised cosine over 0 … 1, up to x.
fn smooth(x: f64) -> f64 {
    x - libm::sin(std::f64::consts::TAU * x) / std::f64::consts::TAU
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(text: &str, mode: ModeName, lateral: LateralName) -> Result<Load, String> {
        let text = format!("{text}\nmode = '{}'", mode.word());
        toml::from_str::<LoadAsked>(&text).unwrap().check(lateral).map_err(|wrong| wrong.key)
    }

    #[test]
    fn a_smooth_rise_is_centred_on_its_nominal_start() {
        let text = "on = 'faces'\nstress_pa = 2.0\ngrows = 'raised_cosine_rate'\nrise_s = 4.0";
        let load = asked(text, ModeName::II, LateralName::Free).unwrap();
        assert_eq!((load.before(), load.factor(-2.0), load.factor(2.0)), (2.0, 0.0, 1.0));
        assert!((load.faces_at(0.0).shear + 1.0).abs() < 1e-15);
        assert_eq!(load.faces_at(9.0), Faces { normal: 0.0, shear: -2.0 });
    }

    #[test]
    fn loads_that_belong_to_the_other_mode_are_refused() {
        let step = |on: &str| format!("on = '{on}'\nstress_pa = 1.0\ngrows = 'step'");
        assert_eq!(asked(&step("all_edges"), ModeName::I, LateralName::Free).unwrap_err(), "load.on");
        assert_eq!(asked(&step("top"), ModeName::II, LateralName::Rollers).unwrap_err(), "plate.lateral");
        assert_eq!(
            asked(&step("all_edges"), ModeName::II, LateralName::Guides).unwrap_err(),
            "plate.lateral"
        );
        assert!(asked(&step("top"), ModeName::I, LateralName::Rollers).is_ok());
        let risen = step("top") + "\nrise_s = 1.0";
        assert_eq!(asked(&risen, ModeName::I, LateralName::Free).unwrap_err(), "load.rise_s");
        let ramp = "on = 'top'\nstress_pa = 1.0\ngrows = 'ramp'";
        assert_eq!(asked(ramp, ModeName::I, LateralName::Free).unwrap_err(), "load");
    }
}
