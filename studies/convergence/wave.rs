//! `asks = "plane_wave"`: a standing plane wave let go in a periodic body, refined. In a plate it may run in any direction
//! of the lattice: the body is one period along each axis.

use super::path::{Level, PathAsked, Sequence, WeightsAsked};
use super::refined::{Bound, Problem, Refined, Solved};
use super::space::{Carried, In, Space};
use super::whole::{self, SEEN};
use crate::bar::pulsed::material;
use crate::dispersion::words::{BodyName, BranchName};
use crate::levels::{Errors, relative};
use crate::question::{Effort, Planned, Question};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::Basis;
use pd_verify::compare::largest;
use pd_verify::constraints::{Edge, Edges};
use pd_verify::dispersion::Branch;
use pd_verify::material::{Body, Material};
use pd_verify::plan::Plan;
use pd_verify::scene::{Initial, Positive, Scene, Shape, Snapshots, StepRule, Time, Wrong};
use pd_verify_reference::medium::Medium;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::TAU;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneWaveAsked {
    pub body: BodyName,
    /// About: the body holds whole cells at every level, and claims say the length that is taken.
    pub wavelength_m: Positive,
    /// Of a plate: the wave runs along this vector of whole numbers.
    pub direction: Option<[u32; 2]>,
    /// Of a plate.
    pub branch: Option<BranchName>,
    /// How long, in periods of the local wave; default 1.125.
    pub periods: Option<Positive>,
    /// Time step over the limit at the coarsest level, the same cΔt/Δx at all; default 0.5.
    pub safety: Option<Positive>,
    pub path: PathAsked,
    pub weights: WeightsAsked,
}

/// The wave, whatever carries it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaneWave<const D: usize> {
    pub material: Material,
    pub body: Body,
    /// Periods along each axis to one wavelength: the direction's whole numbers.
    pub direction: [u32; D],
    pub branch: Branch,
    /// In m, about.
    pub wavelength: f64,
    /// Of the local wave.
    pub periods: f64,
    /// Δt over the limit.
    pub safety: f64,
}

/// A march of the wave.
#[derive(Debug, Clone)]
pub struct Marched<const D: usize> {
    pub scene: Scene<D>,
    pub plan: Plan,
    /// k in rad/m.
    pub wavenumber: [f64; D],
    /// Unit vector.
    pub amplitude: [f64; D],
}

/// Largest whole number of a direction.
const LARGEST: u32 = 40;
/// The amplitude in m; the body is linear, so that it is of no account.
pub const HEIGHT: f64 = 1e-6;

impl Asked for PlaneWaveAsked {
    type Question = Box<dyn Question>;

    fn check(&self, written: &Written<'_>) -> Result<Box<dyn Question>, Wrong> {
        let body = Body::from(self.body);
        let sequences = self.path.sequences(body, &self.weights)?;
        match body {
            Body::Bar => {
                let given = [("direction", self.direction.is_some()), ("branch", self.branch.is_some())];
                if let Some((key, _)) = given.into_iter().find(|(_, given)| *given) {
                    let message = format!("{key} says nothing about a bar");
                    return Err(Wrong::new(key, message, "leave it out, or take a plate"));
                }
                let wave = self.wave(written, body, [1], Branch::P)?.fitting(&sequences)?;
                Ok(Box::new(Refined::new(written.title, wave, sequences, PlaneWave::ready)?))
            }
            Body::PlaneStress | Body::PlaneStrain => {
                let missing =
                    |key: &str| Wrong::new("", format!("a plate needs {key}"), format!("add {key}"));
                let direction = self.direction.ok_or_else(|| missing("direction"))?;
                let branch = self.branch.ok_or_else(|| missing("branch"))?.into();
                PlaneWave::<2>::check_direction(direction)?;
                let wave = self.wave(written, body, direction, branch)?.fitting(&sequences)?;
                Ok(Box::new(Refined::new(written.title, wave, sequences, PlaneWave::ready)?))
            }
        }
    }
}

impl PlaneWaveAsked {
    fn wave<const D: usize>(
        &self,
        written: &Written<'_>,
        body: Body,
        direction: [u32; D],
        branch: Branch,
    ) -> Result<PlaneWave<D>, Wrong> {
        Ok(PlaneWave {
            material: material(written)?,
            body,
            direction,
            branch,
            wavelength: self.wavelength_m.0,
            periods: self.periods.map_or(1.125, |periods| periods.0),
            safety: self.safety.map_or(0.5, |safety| safety.0),
        })
    }
}

impl PlaneWave<2> {
    /// Refuses what is no direction of the lattice.
    pub fn check_direction(direction: [u32; 2]) -> Result<(), Wrong> {
        if direction != [0, 0] && direction.iter().all(|&n| n <= LARGEST) {
            return Ok(());
        }
        let message = format!("{direction:?} is no direction");
        let help = format!("give two whole numbers up to {LARGEST}, not both 0, for example [2, 1]");
        Err(Wrong::new("direction", message, help))
    }
}

impl<const D: usize> PlaneWave<D>
where
    In: Space<D>,
{
    /// The same with the length that whole cells allow nearest to the one asked for.
    pub fn fitting(self, sequences: &[Sequence]) -> Result<Self, Wrong> {
        let Some(first) = sequences.first() else { return Ok(self) };
        let (wavenumber, _) = self.shape(first, first.levels[0])?;
        let length = wavenumber.iter().map(|k| k * k).sum::<f64>().sqrt();
        Ok(Self { wavelength: TAU / length, ..self })
    }

    /// Speed of the local wave in m/s.
    pub fn speed(&self) -> f64 {
        match self.branch {
            Branch::P => self.material.dilatational_speed(self.body),
            Branch::S => self.material.shear_speed(self.body).unwrap_or(f64::NAN),
        }
    }

    /// Cells of the period along each axis at a level, `None` along an axis that the wave does not feel; and whether they
    /// are whole at every level.
    fn periods_in_cells(&self, sequence: &Sequence, level: Level) -> Result<[Option<usize>; D], Wrong> {
        let squares: f64 = self.direction.iter().map(|&n| f64::from(n * n)).sum();
        // Along axis a a period is s/n_a long; with s = L Π n_b whole cells along one make whole cells along all.
        let product: f64 = self.direction.iter().filter(|n| **n > 0).map(|&n| f64::from(n)).product();
        let unit = self.wavelength * squares.sqrt() / product;
        let coarse = sequence.levels[0].spacing;
        let whole = |n: f64| {
            sequence.levels.iter().all(|level| {
                let cells = n * coarse / level.spacing;
                (cells - cells.round()).abs() < 1e-9 * cells
            })
        };
        let wanted = (unit / coarse).round().max(1.0);
        let near = (0..=wanted as u64).flat_map(|off| [wanted - off as f64, wanted + off as f64]);
        let Some(found) = near.filter(|n| *n >= 1.0).find(|n| whole(*n)) else {
            let message = "no wave near this length has whole cells at every level";
            return Err(Wrong::new("path", message, "let each dx divide the coarsest, or take other m"));
        };
        let cells = (found * coarse / level.spacing).round();
        Ok(std::array::from_fn(|axis| {
            let n = self.direction[axis];
            (n > 0).then(|| (cells * product / f64::from(n)).round() as usize)
        }))
    }

    /// The marches of all levels.
    fn ready(&self, sequence: &Sequence) -> Result<Vec<Marched<D>>, Wrong> {
        self.marches(sequence, None)
    }

    /// The same where the limit on the time step of the coarsest level may be known, in s.
    pub fn marches(&self, sequence: &Sequence, limit: Option<f64>) -> Result<Vec<Marched<D>>, Wrong> {
        let scene = |level, step| self.scene(sequence, level, step);
        let scenes = whole::stepped(sequence, self.safety, limit, scene)?;
        let march = |((scene, plan), level): ((Scene<D>, Plan), &Level)| {
            let (wavenumber, amplitude) = self.shape(sequence, *level)?;
            Ok(Marched { scene, plan, wavenumber, amplitude })
        };
        scenes.into_iter().zip(&sequence.levels).map(march).collect()
    }

    fn scene(&self, sequence: &Sequence, level: Level, step: StepRule) -> Result<Scene<D>, Wrong> {
        let lattice = sequence.lattice(level);
        let reach =
            In::reach(lattice).map_err(|wrong| Wrong::new("path.m", wrong.to_string(), wrong.cure()))?;
        let periods = self.periods_in_cells(sequence, level)?;
        let thin = reach.max(level.m.ceil() as usize);
        let nodes = periods.map(|cells| cells.unwrap_or(thin));
        if let Some(cells) = periods.iter().flatten().find(|cells| **cells < thin.max(3)) {
            let message = format!("a period of {cells} cells is shorter than the family reaches, {thin}");
            return Err(Wrong::new("wavelength_m", message, "take a longer wave or a smaller dx"));
        }
        let (wavenumber, amplitude) = self.shape(sequence, level)?;
        let length = wavenumber.iter().map(|k| k * k).sum::<f64>().sqrt();
        let duration = self.periods * TAU / (length * self.speed());
        let phase = -0.5 * level.spacing * wavenumber.iter().sum::<f64>();
        let field = |component: usize| Initial {
            component,
            amplitude: HEIGHT * amplitude[component],
            shape: Shape::Wave { wavenumber, phase },
        };
        Ok(Scene {
            edges: Edges([[Edge::Periodic; 2]; D]),
            displacement: (0..D).map(field).collect(),
            snapshots: vec![Snapshots { name: SEEN.into(), times: vec![duration] }],
            ..Scene::bare(self.material, self.body, lattice, nodes, level.spacing, Time { duration, step })
        })
    }

    /// k in rad/m and the local wave's unit displacement.
    fn shape(&self, sequence: &Sequence, level: Level) -> Result<([f64; D], [f64; D]), Wrong> {
        let periods = self.periods_in_cells(sequence, level)?;
        let wavenumber = periods.map(|cells| cells.map_or(0.0, |cells| TAU / (cells as f64 * level.spacing)));
        let length = wavenumber.iter().map(|k| k * k).sum::<f64>().sqrt();
        let along = wavenumber.map(|k| k / length);
        Ok(match self.branch {
            Branch::P => (wavenumber, along),
            // Across, turned left.
            Branch::S => {
                (wavenumber, std::array::from_fn(|axis| if axis == 0 { -along[D - 1] } else { along[0] }))
            }
        })
    }

    /// c t in m at the end of a march.
    fn end(march: &Marched<D>) -> f64 {
        march.scene.speed() * march.plan.time_step_s * march.plan.steps as f64
    }

    /// cos(k·x + φ) at every node.
    fn cosines(march: &Marched<D>) -> Vec<f64> {
        whole::nodes(&march.scene)
            .map(|node| {
                let phase: f64 =
                    (0..D).map(|axis| march.wavenumber[axis] * node[axis] as f64 * march.scene.spacing).sum();
                libm::cos(phase)
            })
            .collect()
    }
}

impl<const D: usize> Problem<D> for PlaneWave<D>
where
    In: Space<D>,
{
    type Level = Marched<D>;

    fn what(&self) -> String {
        format!("the displacement of a standing plane wave, λ = {:.6} m", self.wavelength)
    }

    fn equations(&self) -> &'static str {
        "u(x, 0) = a cos(k·x), at rest, periodic: u = cos(√M(k) ct) a cos(k·x), M the medium's ω²/c²
local: M = (|k|² I + 2 k kᵀ)/3; lattice: M = Σ w n⊗n (1 − cos k·ξ)/Δx²; nonlocal: ω_P² k̂k̂ᵀ + ω_S² (I − k̂k̂ᵀ)
leapfrog: cos(2n asin(√M cΔt/2)) in place of cos(√M ct)"
    }

    fn source(&self) -> &'static str {
        "the standing wave of the local or nonlocal medium, its ω(k) in double-double arithmetic"
    }

    fn rounding(&self) -> Bound {
        Bound {
            at_most: 1e-10,
            basis: Basis::Rounding,
            because: "leapfrog of a wave turns by 2 asin(ωΔt/2) exactly: only rounding is left, some 1e-16 a step",
        }
    }

    fn plan(&self, level: &Marched<D>) -> Planned {
        level.plan.clone()
    }

    fn effort(&self, level: &Marched<D>) -> Effort {
        Effort { reference_evaluations: 4, ..Effort::of_scenes(std::slice::from_ref(&level.plan)) }
    }

    fn solve(&self, subject: &dyn Subject, march: &Marched<D>, medium: &Medium) -> Result<Solved, String> {
        let record = In::march(subject, &march.scene).map_err(|failure| failure.to_string())?;
        let seen = whole::last(&march.scene, &record)?;
        let own = whole::lattice(&march.scene);
        let (k, a) = (march.wavenumber, march.amplitude);
        let carried =
            |medium: &Medium, by| In::carried(medium, k, a, by).ok_or("the medium carries no such wave");
        let exact = carried(medium, Carried::Time(Self::end(march)))?;
        let steps = Carried::Steps(march.plan.steps, march.scene.speed() * march.plan.time_step_s);
        let own = carried(&own, steps)?;
        let cosines = Self::cosines(march);
        let pairs = |amplitude: [f64; D]| {
            let cosines = &cosines;
            seen.iter().enumerate().flat_map(move |(axis, field)| {
                field.iter().zip(cosines).map(move |(u, cosine)| (u / HEIGHT, amplitude[axis] * cosine))
            })
        };
        Ok(Solved {
            errors: relative(pairs(exact)),
            own: largest(pairs(own).map(|(u, own)| (u - own).abs())),
        })
    }

    fn between(&self, march: &Marched<D>, wrong: &Medium, right: &Medium) -> Option<Errors> {
        let at = |medium: &Medium| {
            In::carried(medium, march.wavenumber, march.amplitude, Carried::Time(Self::end(march)))
        };
        let (wrong, right) = (at(wrong)?, at(right)?);
        let cosines = Self::cosines(march);
        let pair =
            |axis: usize| cosines.iter().map(move |cosine| (wrong[axis] * cosine, right[axis] * cosine));
        Some(relative((0..D).flat_map(pair)))
    }
}
