//! What is known of K: Freund's crack in an infinite plane, or finite elements of the same plate; and when it holds.

use super::load::{Growth, Load, ModeName, On};
use super::plate::{CrackPlace, Cracked, LateralName, PlateAsked};
use crate::rounded::rounded;
use pd_verify::material::{Body, Material};
use pd_verify::scene::{Positive, Wrong};
use pd_verify_reference::cracked_plate::{Behind, CrackedPlate, Lateral, Loading};
use pd_verify_reference::elastic::{Mode, Plane};
use pd_verify_reference::finite_elements::{History as Computed, Loading as Sheared, Plate, Rise};
use pd_verify_reference::freund::{Load as KnownLoad, StationaryCrack};
use pd_verify_reference::running_crack::RunningCrack;
use schemars::JsonSchema;
use serde::Deserialize;

/// Which answer is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AnswerName {
    /// A long crack in an infinite plane, until something comes back from an edge.
    Freund,
    /// Chen's plate, mode I, in tension on both short edges.
    ChenPlate,
    /// The 104 mm x 40 mm plate in pure shear on all four edges.
    ShearFourEdges,
    /// The same in opposite shear on its long edges alone.
    ShearTopBottom,
}

/// A reference as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct KnownAsked {
    pub answer: AnswerName,
    /// A published comparison's Poisson ratio, in plane strain: drawn beside the consistent answer and never judged by.
    pub reference_poisson_ratio: Option<Positive>,
}

/// When results are held against it, as written: in s, or in times of the first wave's arrival at the crack.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WindowAsked {
    pub from_s: Option<f64>,
    pub to_s: Option<f64>,
    pub from_arrivals: Option<f64>,
    pub to_arrivals: Option<f64>,
}

/// From when to when, in s after the nominal start of the load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    pub from: f64,
    pub to: f64,
}

impl Window {
    pub fn holds(&self, t: f64) -> bool {
        self.from <= t && t <= self.to
    }
}

/// K over time.
#[derive(Debug, Clone)]
pub struct Known {
    history: History,
    /// Published comparison, where it differs.
    published: Option<Freund>,
    /// The same formula with the other plane state, which it is mistaken for; none beside finite elements.
    confused: Option<Freund>,
    /// When the first wave reaches the crack, in s.
    pub arrival: f64,
    /// When its first part does, as a smooth rise begins before t = 0.
    pub begins: f64,
}

#[derive(Debug, Clone)]
enum History {
    Freund(Freund),
    /// K/(σ₀√(πa)), and σ₀ in Pa.
    FiniteElements(Computed, f64),
}

/// A long crack, the load, and what is known of the plate.
#[derive(Debug, Clone)]
struct Freund {
    crack: StationaryCrack,
    load: KnownLoad,
    /// In Pa, of all waves.
    stress: f64,
    /// When the load's first wave reaches the crack.
    arrival: f64,
}

impl Freund {
    fn at(&self, t: f64) -> f64 {
        self.stress * self.crack.at(&self.load, t - self.arrival)
    }
}

impl KnownAsked {
    /// The answer to a plate under a load.
    pub fn check(
        &self,
        (material, body): (Material, Body),
        plate: &PlateAsked,
        load: &Load,
    ) -> Result<Known, Wrong> {
        let mode = match load.mode {
            ModeName::I => Mode::One,
            ModeName::II => Mode::Two,
        };
        let freund = |plane: Plane| {
            let arrival = match load.on {
                On::Faces => 0.0,
                _ => plate.half_height() / plane.wave_speed(mode),
            };
            let crack = StationaryCrack { plane, mode };
            Freund { crack, load: load.known(), stress: load.waves() * load.stress, arrival }
        };
        let plane = plane(material, body)?;
        let (e, rho) = (material.youngs_modulus, material.density);
        let published = match self.reference_poisson_ratio {
            Some(nu) if nu.0 >= 0.5 => {
                let message = format!("a Poisson ratio of {} has no dilatational waves", nu.0);
                return Err(Wrong::new("known.reference_poisson_ratio", message, "take less than 0.5"));
            }
            nu => nu.map(|nu| freund(Plane::plane_strain(e, nu.0, rho))),
        };
        let own = freund(plane);
        let arrival = own.arrival;
        let confused = match (self.answer.plate(), body, body.poisson_ratio()) {
            (None, Body::PlaneStress, Some(nu)) => Some(freund(Plane::plane_strain(e, nu, rho))),
            (None, Body::PlaneStrain, Some(nu)) => Some(freund(Plane::plane_stress(e, nu, rho))),
            _ => None,
        };
        let history = match self.answer.plate() {
            None => History::Freund(own),
            Some(_) if published.is_some() => {
                let message = "these finite elements stand beside no published formula";
                return Err(Wrong::new("known.reference_poisson_ratio", message, "leave it out"));
            }
            Some(known) => History::FiniteElements(computed(known, &plane, plate, load)?, load.stress),
        };
        Ok(Known { arrival, begins: arrival - load.before(), history, published, confused })
    }
}

impl AnswerName {
    /// The plate that finite elements were made for; `None` of a closed form.
    fn plate(self) -> Option<Plate> {
        match self {
            Self::Freund => None,
            Self::ChenPlate => Some(Plate::Chen),
            Self::ShearFourEdges => Some(Plate::Shear(Sheared::FourEdges)),
            Self::ShearTopBottom => Some(Plate::Shear(Sheared::TopBottom)),
        }
    }
}

/// The history of a plate for which there is one, for the rise of the load and the speeds of the body.
fn computed(known: Plate, plane: &Plane, plate: &PlateAsked, load: &Load) -> Result<Computed, Wrong> {
    let geometry = known.geometry();
    let size = [2.0 * (geometry.ahead + known.half_crack()), 2.0 * geometry.half_height];
    let asked = [plate.size_m[0].0, plate.size_m[1].0, plate.crack_length_m.0];
    let wanted = [size[0], size[1], 2.0 * known.half_crack()];
    let same = asked.iter().zip(wanted).all(|(asked, wanted)| (asked / wanted - 1.0).abs() < 1e-6);
    if !same || plate.crack != CrackPlace::Centre {
        let [width, height, crack] = wanted.map(rounded);
        let message = format!(
            "the answer is that of a plate of {width} m by {height} m with {crack} m of crack in the middle"
        );
        return Err(Wrong::new("plate", message, "take this plate, or another answer"));
    }
    let (mode, on) = match known {
        Plate::Chen => (ModeName::I, On::TopAndBottom),
        Plate::Shear(Sheared::FourEdges) => (ModeName::II, On::AllEdges),
        Plate::Shear(Sheared::TopBottom) => (ModeName::II, On::TopAndBottom),
    };
    if (load.mode, load.on) != (mode, on) || plate.lateral.is_some_and(|edge| edge != LateralName::Free) {
        let help =
            format!("take mode {}, free lateral edges, and the edges that the answer names", mode.word());
        return Err(Wrong::new("load.on", "the answer is that of another load", help));
    }
    // A rise in the time of the plate that was computed.
    let width = load.rise * plane.dilatational_speed() / known.body().dilatational_speed();
    let stated = (width / known.stated_rise().width_s() - 1.0).abs() < 1e-9;
    let history = match load.grows {
        Growth::Step => Some(known.raw()),
        Growth::RaisedCosineRate if stated => Some(known.smoothed()),
        Growth::RaisedCosineRate => known.with_rise(Rise::RaisedCosineRate { width_s: width }),
        Growth::Ramp => {
            let help = "take grows = \"raised_cosine_rate\", or \"step\"";
            return Err(Wrong::new("load.grows", "the answer is centred on t = 0, and a ramp is not", help));
        }
    };
    let history = history.and_then(|history| history.in_body(known, plane));
    history.ok_or_else(|| {
        let message = "the answer cannot be had for a rise as short or as long as this";
        Wrong::new("load.rise_s", message, format!("take {} s", rounded(known.stated_rise().width_s())))
    })
}

/// The body as a plane with Poisson's ratio.
fn plane(material: Material, body: Body) -> Result<Plane, Wrong> {
    let (e, rho) = (material.youngs_modulus, material.density);
    match (body, body.poisson_ratio()) {
        (Body::PlaneStress, Some(nu)) => Ok(Plane::plane_stress(e, nu, rho)),
        (Body::PlaneStrain, Some(nu)) => Ok(Plane::plane_strain(e, nu, rho)),
        _ => Err(Wrong::new("plate.body", "a bar has no crack", "take plane_stress or plane_strain")),
    }
}

impl Known {
    /// K in Pa√m of a crack of this a in m, at t in s after the nominal start; `None` where it is not known.
    pub fn at(&self, t: f64, a: f64) -> Option<f64> {
        match &self.history {
            History::Freund(freund) => Some(freund.at(t)),
            History::FiniteElements(history, stress) => {
                history.at(t).map(|unit| unit * stress * (std::f64::consts::PI * a).sqrt())
            }
        }
        .filter(|k| k.is_finite())
    }

    /// Whether it is that of a crack in an infinite plane.
    pub fn is_freund(&self) -> bool {
        matches!(self.history, History::Freund(_))
    }

    /// Whether a published comparison stands beside it.
    pub fn has_published(&self) -> bool {
        self.published.is_some()
    }

    /// Refuses a lattice whose loaded edges are not where the answer has them: the wave would come early or late.
    pub fn check_height(&self, asked: &PlateAsked, plate: &Cracked) -> Result<(), Wrong> {
        let (wanted, real) = (asked.half_height(), plate.tip[1]);
        let from_an_edge = self.is_freund() && self.arrival > 0.0;
        if !from_an_edge || (real / wanted - 1.0).abs() < 1e-9 {
            return Ok(());
        }
        let message = format!(
            "cells of {} m make half the height {} m, and the answer's wave comes from {} m",
            plate.spacing,
            rounded(real),
            rounded(wanted)
        );
        Err(Wrong::new("dx_m", message, "take cells that divide half the height"))
    }

    /// The published comparison.
    pub fn published_at(&self, t: f64) -> Option<f64> {
        self.published.as_ref().map(|freund| freund.at(t)).filter(|k| k.is_finite())
    }

    /// What the formula with the other plane state would say.
    pub fn confused_at(&self, t: f64) -> Option<f64> {
        self.confused.as_ref().map(|freund| freund.at(t)).filter(|k| k.is_finite())
    }

    /// K in Pa√m at t of a crack that runs at a speed in m/s at that moment; `None` where it is not known.
    pub fn running_at(&self, t: f64, speed: f64) -> Option<f64> {
        let History::Freund(freund) = &self.history else { return None };
        let StationaryCrack { plane, mode } = freund.crack;
        let crack = RunningCrack { plane, mode, speed };
        Some(freund.stress * crack.at(&freund.load, t - freund.arrival)?).filter(|k| k.is_finite())
    }

    /// In `dsif_history.csv`.
    pub fn word(&self) -> &'static str {
        match self.history {
            History::Freund(_) => "consistent",
            History::FiniteElements(..) => "finite_elements",
        }
    }

    /// Where it comes from.
    pub fn source(&self) -> &'static str {
        match self.history {
            History::Freund(_) => {
                "Freund 1990, sections 2.5 and 2.6, with the plane-strain ratio and the wave speeds of the body that is computed"
            }
            History::FiniteElements(..) => {
                "finite elements of classical elastodynamics: quarter-point triangles, interaction integral with inertia; reference/data/finite_elements"
            }
        }
    }
}

impl WindowAsked {
    /// The window, refused where it is empty or reaches beyond what is known.
    pub fn check(&self, known: &Known, last: f64) -> Result<Window, Wrong> {
        let (from, to) = match (self.from_s, self.to_s, self.from_arrivals, self.to_arrivals) {
            (Some(from), Some(to), None, None) => (from, to),
            (None, None, Some(from), Some(to)) if known.arrival > 0.0 => {
                (from * known.arrival, to * known.arrival)
            }
            (None, None, Some(_), Some(_)) => {
                let message = "a load on the faces needs no time to arrive";
                return Err(Wrong::new("window", message, "give from_s and to_s"));
            }
            _ => {
                let help = "give from_s and to_s, or from_arrivals and to_arrivals";
                return Err(Wrong::new("window", "a window has a beginning and an end", help));
            }
        };
        if !(from.is_finite() && to.is_finite() && from < to) {
            let message = format!("the window from {} s to {} s is empty", rounded(from), rounded(to));
            return Err(Wrong::new("window", message, "let it end after it begins"));
        }
        let slack = 1e-9 * last.abs();
        let first = if known.is_freund() { known.begins } else { 0.0 };
        if from < first - slack || to > last + slack {
            let message = format!(
                "the reference holds from {} s to {} s, and the window is {} s to {} s",
                rounded(first),
                rounded(last),
                rounded(from),
                rounded(to)
            );
            return Err(Wrong::new("window", message, "keep the window within, or take a larger plate"));
        }
        Ok(Window { from, to })
    }
}

/// How long the answer holds at the tip of a plate, in s after the nominal start, and what ends it.
pub fn holds_until(
    known: &Known,
    (material, body): (Material, Body),
    plate: &Cracked,
    load: &Load,
) -> Result<(f64, &'static str), Wrong> {
    if let History::FiniteElements(history, _) = &known.history {
        return Ok((history.valid_until_s(), "the end of the finite elements"));
    }
    let width = plate.nodes[0] as f64 * plate.spacing;
    let ahead = width - plate.tip[0];
    let cracked = CrackedPlate {
        half_height: plate.tip[1],
        ahead,
        behind: match plate.place {
            CrackPlace::LeftEdge => Behind::Mouth { crack: plate.crack },
            CrackPlace::Centre => Behind::Tip { crack: plate.crack, beyond: ahead },
        },
        lateral: match plate.lateral {
            LateralName::Free => Lateral::Free,
            LateralName::Rollers | LateralName::Guides => Lateral::Guided,
        },
    };
    let mode = match load.mode {
        ModeName::I => Mode::One,
        ModeName::II => Mode::Two,
    };
    let loading = if load.on == On::Faces { Loading::Faces } else { Loading::Edges };
    let plane = plane(material, body)?;
    let first = cracked.disturbances(&plane, mode, loading).into_iter().next();
    let first = first.ok_or_else(|| Wrong::new("plate", "nothing is known of this plate", "take another"))?;
    Ok((first.arrival_s - load.before(), first.what))
}
