//! `asks = "point_pulse"`: a Gaussian pulse of the x-displacement let go in the middle of a periodic square (or ring),
//! refined: waves of both branches, of all lengths and, in a plate, all directions at once.

use super::path::{Level, PathAsked, Sequence, WeightsAsked};
use super::refined::{Bound, Problem, Refined, Solved};
use super::space::{Carried, In, Space};
use super::whole::{self, SEEN};
use crate::bar::pulsed::material;
use crate::dispersion::words::BodyName;
use crate::levels::{Errors, relative};
use crate::question::{Effort, Planned, Question};
use crate::scene::size::cells;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::Basis;
use pd_verify::compare::largest;
use pd_verify::constraints::{Edge, Edges};
use pd_verify::material::{Body, Material};
use pd_verify::plan::Plan;
use pd_verify::scene::{Initial, Positive, Scene, Shape, Snapshots, Time, Wrong};
use pd_verify_reference::medium::Medium;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointPulseAsked {
    pub body: BodyName,
    /// Length of the ring, or of a side of the square.
    pub side_m: Positive,
    /// Where exp(−(r/width)²) has fallen to 1/e.
    pub width_m: Positive,
    /// How far a local P wave travels meanwhile, over the side; default 0.3.
    pub travel: Option<Positive>,
    /// Time step over the limit at the coarsest level, the same cΔt/Δx at all; default 0.5.
    pub safety: Option<Positive>,
    pub path: PathAsked,
    pub weights: WeightsAsked,
}

/// The pulse, whatever carries it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointPulse {
    pub material: Material,
    pub body: Body,
    pub side: f64,
    pub width: f64,
    /// Of a local P wave, over the side.
    pub travel: f64,
    /// Δt over the limit.
    pub safety: f64,
}

/// A march of the pulse.
#[derive(Debug, Clone)]
pub struct Marched<const D: usize> {
    pub scene: Scene<D>,
    pub plan: Plan,
}

/// Its height in m; the body is linear, so that it is of no account.
const HEIGHT: f64 = 1e-6;

impl Asked for PointPulseAsked {
    type Question = Box<dyn Question>;

    fn check(&self, written: &Written<'_>) -> Result<Box<dyn Question>, Wrong> {
        let body = Body::from(self.body);
        let pulse = PointPulse {
            material: material(written)?,
            body,
            side: self.side_m.0,
            width: self.width_m.0,
            travel: self.travel.map_or(0.3, |travel| travel.0),
            safety: self.safety.map_or(0.5, |safety| safety.0),
        };
        let sequences = self.path.sequences(body, &self.weights)?;
        let coarsest = sequences.iter().map(|one| one.levels[0].spacing).fold(0.0, f64::max);
        pulse.check(coarsest)?;
        Ok(match body {
            Body::Bar => Box::new(Refined::<1, _>::new(written.title, pulse, sequences, PointPulse::ready)?),
            _ => Box::new(Refined::<2, _>::new(written.title, pulse, sequences, PointPulse::ready)?),
        })
    }
}

impl PointPulse {
    /// Refuses a pulse that meets its images, or that falls between nodes this far apart.
    pub fn check(&self, coarsest: f64) -> Result<(), Wrong> {
        // The nearest image is a side away: exp(−144) of it; half a side away exp(−36).
        if self.width > self.side / 12.0 {
            let message =
                format!("a pulse {} m wide reaches beyond its period of {} m", self.width, self.side);
            return Err(Wrong::new("width_m", message, "take at most a twelfth of side_m"));
        }
        if self.width < 2.0 * coarsest {
            let message = format!("a pulse {} m wide falls between nodes {coarsest} m apart", self.width);
            return Err(Wrong::new("width_m", message, "take at least twice the coarsest dx"));
        }
        Ok(())
    }

    /// The marches of all levels.
    pub fn ready<const D: usize>(&self, sequence: &Sequence) -> Result<Vec<Marched<D>>, Wrong>
    where
        In: Space<D>,
    {
        let duration = self.travel * self.side / self.material.dilatational_speed(self.body);
        let shape = Shape::Gaussian { centre: [0.5 * self.side; D], sharpness: self.sharpness() };
        let scene = |level: Level, step| {
            let (nodes, spacing) = cells([self.side; D], level.spacing)
                .map_err(|wrong| Wrong { key: "path".into(), ..wrong })?;
            let (lattice, time) = (sequence.lattice(level), Time { duration, step });
            Ok(Scene {
                edges: Edges([[Edge::Periodic; 2]; D]),
                displacement: vec![Initial { component: 0, amplitude: HEIGHT, shape: shape.clone() }],
                snapshots: vec![Snapshots { name: SEEN.into(), times: vec![duration] }],
                ..Scene::bare(self.material, self.body, lattice, nodes, spacing, time)
            })
        };
        let marches = whole::stepped(sequence, self.safety, None, scene)?;
        Ok(marches.into_iter().map(|(scene, plan)| Marched { scene, plan }).collect())
    }

    /// In 1/m².
    pub fn sharpness(&self) -> f64 {
        1.0 / (self.width * self.width)
    }
}

impl<const D: usize> Marched<D>
where
    In: Space<D>,
{
    /// The pulse in a medium at the end, component by component, row by row, over its height.
    fn exact(&self, pulse: &PointPulse, medium: &Medium, by: Carried) -> Option<Vec<Vec<f64>>> {
        let places = |axis: usize| -> Vec<f64> {
            (0..self.scene.nodes[axis]).map(|n| (n as f64 + 0.5) * self.scene.spacing).collect()
        };
        In::pulse(medium, pulse.sharpness(), pulse.side, std::array::from_fn(places), by)
    }

    /// c t in m at the end.
    fn end(&self) -> Carried {
        Carried::Time(self.scene.speed() * self.plan.time_step_s * self.plan.steps as f64)
    }
}

impl<const D: usize> Problem<D> for PointPulse
where
    In: Space<D>,
{
    type Level = Marched<D>;

    fn what(&self) -> String {
        "the displacement of a Gaussian pulse let go".into()
    }

    fn equations(&self) -> &'static str {
        "u_x(x, 0) = exp(−|x − x₀|²/w²), u_y = 0, at rest, periodic: u = Σ_k û(k) cos(√M(k) ct) e_x cos k·(x − x₀)
M(k): ω²/c² of local elasticity, of the nonlocal continuum, or of the lattice with leapfrog"
    }

    fn source(&self) -> &'static str {
        "Fourier series of the periodic pulse, ω(k) of the local or nonlocal medium"
    }

    fn rounding(&self) -> Bound {
        Bound {
            at_most: 1e-10,
            basis: Basis::Rounding,
            because: "leapfrog turns every wave of the lattice by 2 asin(ωΔt/2) exactly: only rounding is left, some 1e-16 a step",
        }
    }

    fn plan(&self, level: &Marched<D>) -> Planned {
        level.plan.clone()
    }

    fn effort(&self, level: &Marched<D>) -> Effort {
        let waves = (6.0 * self.side / self.width) as u64;
        let reference_evaluations = waves.pow(D as u32) / 10 + 1;
        Effort { reference_evaluations, ..Effort::of_scenes(std::slice::from_ref(&level.plan)) }
    }

    fn solve(&self, subject: &dyn Subject, march: &Marched<D>, medium: &Medium) -> Result<Solved, String> {
        let record = In::march(subject, &march.scene).map_err(|failure| failure.to_string())?;
        let seen = whole::last(&march.scene, &record)?;
        let missing = "the medium has no answer for these waves";
        let exact = march.exact(self, medium, march.end()).ok_or(missing)?;
        let steps = Carried::Steps(march.plan.steps, march.scene.speed() * march.plan.time_step_s);
        let own = march.exact(self, &whole::lattice(&march.scene), steps).ok_or(missing)?;
        let pairs = |other: &[Vec<f64>]| -> Vec<(f64, f64)> {
            let seen = seen.iter().flatten().map(|u| u / HEIGHT);
            seen.zip(other.iter().flatten().copied()).collect()
        };
        Ok(Solved {
            errors: relative(pairs(&exact)),
            own: largest(pairs(&own).into_iter().map(|(u, own)| (u - own).abs())),
        })
    }

    fn between(&self, march: &Marched<D>, wrong: &Medium, right: &Medium) -> Option<Errors> {
        let at = |medium: &Medium| march.exact(self, medium, march.end());
        let (wrong, right) = (at(wrong)?, at(right)?);
        Some(relative(wrong.into_iter().flatten().zip(right.into_iter().flatten())))
    }
}
