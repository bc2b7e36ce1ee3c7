//! `asks = "manufactured"`: a chosen displacement and the body force that holds it at rest, found without time, refined.
//! The body is a bar or a square between mirrors, or held at the chosen displacement in a frame as wide as its families.

use super::foreign::{Exact, ForeignField};
use super::path::{Level, PathAsked, Sequence, WeightsAsked};
use super::refined::{Bound, Problem, Refined, Solved};
use super::space::{In, Space};
use super::whole;
use crate::bar::pulsed::material;
use crate::dispersion::words::BodyName;
use crate::foreign::Foreign;
use crate::levels::{Errors, relative};
use crate::question::{Effort, Planned, Question};
use crate::rounded::rounded;
use crate::scene::size::cells;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::Basis;
use pd_verify::compare::largest;
use pd_verify::constraints::{Edge, Edges, HeldFrame};
use pd_verify::forces::ForceField;
use pd_verify::material::{Body, Material};
use pd_verify::plan::Plan;
use pd_verify::scene::{Effect, History, Initial, Positive, Scene, Shape, StepRule, Time, Wrong};
use pd_verify_reference::medium::Medium;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::PI;
use std::sync::Arc;

/// What bounds the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Around {
    /// Mirrors: the displacement normal to every edge is odd. No node misses a bond.
    Mirrors,
    /// A frame of nodes, as wide as the family reaches, held at the chosen displacement.
    HeldFrame,
}

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ManufacturedAsked {
    pub body: BodyName,
    /// Length of the bar, or of a side of the square.
    pub side_m: Positive,
    /// Default: `mirrors`.
    pub around: Option<Around>,
    pub path: PathAsked,
    pub weights: WeightsAsked,
}

/// The chosen displacement: a sum of waves a cos(k·x + φ).
#[derive(Debug, Clone, PartialEq)]
pub struct Manufactured<const D: usize> {
    material: Material,
    body: Body,
    side: f64,
    around: Around,
    waves: Vec<([f64; D], [f64; D])>,
    phase: f64,
}

/// One level: where the forces depend on what is aimed at, the scene without them.
pub struct Rested<const D: usize> {
    scene: Scene<D>,
    plan: Plan,
    /// Layers that are held.
    held: usize,
}

/// Height of the waves in m; the body is linear, so that it is of no account.
const HEIGHT: f64 = 1e-6;
/// Added to the phase in a held frame, so that the displacement vanishes at no edge.
const TURN: f64 = 0.7;

impl Asked for ManufacturedAsked {
    type Question = Box<dyn Question>;

    fn check(&self, written: &Written<'_>) -> Result<Box<dyn Question>, Wrong> {
        let body = Body::from(self.body);
        let sequences = self.path.sequences(body, &self.weights)?;
        let k = PI / self.side_m.0;
        match body {
            Body::Bar => {
                let waves = vec![([k], [1.0])];
                let problem = self.problem(written, body, waves)?;
                Ok(Box::new(Refined::new(written.title, problem, sequences, Manufactured::ready)?))
            }
            Body::PlaneStress | Body::PlaneStrain => {
                // u_x = sin(πx/L) cos(2πy/L), u_y = −½ cos(πx/L) sin(2πy/L).
                let waves = vec![([k, 2.0 * k], [0.5, -0.25]), ([k, -2.0 * k], [0.5, 0.25])];
                let problem = self.problem(written, body, waves)?;
                Ok(Box::new(Refined::new(written.title, problem, sequences, Manufactured::ready)?))
            }
        }
    }
}

impl ManufacturedAsked {
    fn problem<const D: usize>(
        &self,
        written: &Written<'_>,
        body: Body,
        waves: Vec<([f64; D], [f64; D])>,
    ) -> Result<Manufactured<D>, Wrong> {
        let around = self.around.unwrap_or(Around::Mirrors);
        let turn = if around == Around::HeldFrame { TURN } else { 0.0 };
        let phase = turn - 0.5 * PI;
        Ok(Manufactured { material: material(written)?, body, side: self.side_m.0, around, waves, phase })
    }
}

impl<const D: usize> Manufactured<D>
where
    In: Space<D>,
{
    fn ready(&self, sequence: &Sequence) -> Result<Vec<Rested<D>>, Wrong> {
        sequence.levels.iter().map(|level| self.level(sequence, *level)).collect()
    }

    fn level(&self, sequence: &Sequence, level: Level) -> Result<Rested<D>, Wrong> {
        let lattice = sequence.lattice(level);
        let (nodes, spacing) =
            cells([self.side; D], level.spacing).map_err(|wrong| Wrong { key: "path".into(), ..wrong })?;
        let reach =
            In::reach(lattice).map_err(|wrong| Wrong::new("path.m", wrong.to_string(), wrong.cure()))?;
        let time = Time { duration: 1.0, step: StepRule::OfLimit(1.0) };
        let mut scene = Scene::bare(self.material, self.body, lattice, nodes, spacing, time);
        let held = if self.around == Around::HeldFrame { reach } else { 0 };
        if self.around == Around::Mirrors {
            scene.edges = Edges([[Edge::MirrorOdd; 2]; D]);
        } else if nodes.iter().any(|&count| count < 3 * reach) {
            let message = format!("a frame of {reach} nodes leaves little of {nodes:?}");
            return Err(Wrong::new("path", message, "take a smaller m or dx, or a larger side_m"));
        }
        let plan = Plan::at_rest(&Scene { effects: effects(held, Vec::new(), Vec::new()), ..scene.clone() })?;
        Ok(Rested { scene, plan, held })
    }

    /// The waves as fields of every component, each wave's amplitude changed by `of`.
    fn fields(&self, of: impl Fn([f64; D], [f64; D]) -> Option<[f64; D]>) -> Option<Vec<Initial<D>>> {
        let mut fields = Vec::new();
        for &(wavenumber, a) in &self.waves {
            let amplitude = of(wavenumber, a)?;
            let shape = Shape::Wave { wavenumber, phase: self.phase };
            fields.extend((0..D).map(|component| Initial {
                component,
                amplitude: amplitude[component],
                shape: shape.clone(),
            }));
        }
        Some(fields)
    }

    /// The displacement that is aimed at, in m, at a place.
    fn aimed(&self, at: [f64; D]) -> [f64; D] {
        let mut u = [0.0; D];
        for field in self.fields(|_, a| Some(a)).unwrap_or_default() {
            u[field.component] += HEIGHT * field.at(at);
        }
        u
    }

    /// The problem in words, neutral of any solver.
    fn words(&self) -> Vec<(&'static str, String)> {
        let Material { youngs_modulus, density } = self.material;
        let (c11, c66) = (
            youngs_modulus * self.body.stiffness_over_youngs_modulus(),
            youngs_modulus * self.body.stiffness_over_youngs_modulus() / 3.0,
        );
        let waves: Vec<String> = self
            .waves
            .iter()
            .map(|(k, a)| format!("k = {k:?} 1/m, a = {:?} m", a.map(|a| HEIGHT * a)))
            .collect();
        let edges = match self.around {
            Around::Mirrors => {
                "At every edge the displacement is continued oddly: 0 on it, and beyond it that of the mirrored place with the opposite sign, so that the body has no surface"
            }
            Around::HeldFrame => {
                "A frame within, as wide as a family reaches, is held at the exact displacement; what is inside it is free"
            }
        };
        vec![
            (
                "Geometry",
                format!(
                    "{} of {} m{}. {edges}.",
                    if D == 1 { "A bar" } else { "A square" },
                    self.side,
                    if D == 1 { "" } else { " a side, its lower left corner at (0, 0)" }
                ),
            ),
            (
                "Material",
                format!(
                    "Linear elastic, E = {youngs_modulus} Pa, ρ = {density} kg/m³ (at rest it plays no part); C₁₁ = {} Pa, and in a plate C₁₂ = C₆₆ = {} Pa.",
                    rounded(c11),
                    rounded(c66)
                ),
            ),
            (
                "Displacement and load",
                format!(
                    "The displacement is the sum of u = a cos(k·x + {}) over the waves {}. The body force that holds it, in N/m³, is C₁₁ k² u in a bar and C₁₁ (k·u) k + C₆₆ (k² u − (k·u) k) in a plate, of each wave: compute it for your load and find the body at rest.",
                    rounded(self.phase),
                    waves.join("; ")
                ),
            ),
        ]
    }

    /// The scene with the body force that holds the chosen displacement in a medium.
    fn loaded(&self, level: &Rested<D>, medium: &Medium) -> Option<Scene<D>> {
        let modulus = level.scene.modulus();
        let force =
            self.fields(|k, a| Some(In::stiffness(medium, k, a)?.map(|force| HEIGHT * modulus * force)))?;
        let held = self.fields(|_, a| Some(a.map(|a| HEIGHT * a)))?;
        let effects = effects(level.held, force, held);
        Some(Scene { effects, ..level.scene.clone() })
    }

    /// Displacements over the height at the nodes that are free, of waves whose amplitudes are changed by `of`.
    fn displacements(
        &self,
        level: &Rested<D>,
        of: impl Fn([f64; D], [f64; D]) -> Option<[f64; D]>,
    ) -> Option<Vec<[f64; D]>> {
        let fields = self.fields(of)?;
        let at = |node: [usize; D]| {
            let x = node.map(|n| (n as f64 + 0.5) * level.scene.spacing);
            let mut u = [0.0; D];
            fields.iter().for_each(|field| u[field.component] += field.at(x));
            u
        };
        Some(whole::nodes(&level.scene).filter(|node| level.free(*node)).map(at).collect())
    }
}

/// What acts on the body: its force, and where layers are held their displacement.
fn effects<const D: usize>(
    layers: usize,
    force: Vec<Initial<D>>,
    held: Vec<Initial<D>>,
) -> Vec<Arc<dyn Effect<D>>> {
    let mut effects: Vec<Arc<dyn Effect<D>>> =
        vec![Arc::new(ForceField { fields: force, history: History::Step { start: 0.0 } })];
    if layers > 0 {
        effects.push(Arc::new(HeldFrame { layers, fields: held }));
    }
    effects
}

impl<const D: usize> Rested<D> {
    fn free(&self, node: [usize; D]) -> bool {
        whole::inside(node, self.held, self.scene.nodes)
    }
}

/// Components of two fields side by side.
fn pairs<const D: usize>(a: &[[f64; D]], b: &[[f64; D]]) -> Vec<(f64, f64)> {
    a.iter().flatten().copied().zip(b.iter().flatten().copied()).collect()
}

impl<const D: usize> Problem<D> for Manufactured<D>
where
    In: Space<D>,
{
    type Level = Rested<D>;

    fn what(&self) -> String {
        match self.around {
            Around::Mirrors => "a manufactured displacement at rest between mirrors".into(),
            Around::HeldFrame => "a manufactured displacement at rest in a held frame".into(),
        }
    }

    fn equations(&self) -> &'static str {
        "bar: u = sin(πx/L + φ); square: u_x = sin(πx/L + …) cos(2πy/L), u_y = −½ cos sin, as waves a cos(k·x + φ)
0 = C₁₁ Σ M(k) (u' − u)… + b: b = C₁₁ M(k) a cos(k·x + φ), M of local elasticity (δ → 0) or of the nonlocal continuum (m → ∞)
on the lattice between mirrors: u = M_lattice⁻¹ M a cos(k·x + φ)"
    }

    fn source(&self) -> &'static str {
        "the displacement that the body force was made for, its M(k) in double-double arithmetic"
    }

    fn rounding(&self) -> Bound {
        Bound {
            at_most: 1e-10,
            basis: Basis::Rounding,
            because: "conjugate gradients stop at 1e-14 of the first force; the softest mode answers the force left with the stiffness of the body, some 10³ times softer than the load's",
        }
    }

    fn plan(&self, level: &Rested<D>) -> Planned {
        level.plan.clone()
    }

    fn effort(&self, level: &Rested<D>) -> Effort {
        // Between mirrors the load is made of a few waves, and each iteration is rid of one.
        let side = if self.around == Around::Mirrors { 2 } else { level.scene.nodes[0] };
        whole::resting(&level.plan, side)
    }

    fn solve(&self, subject: &dyn Subject, level: &Rested<D>, medium: &Medium) -> Result<Solved, String> {
        let beyond = "the medium carries no such wave";
        let scene = self.loaded(level, medium).ok_or(beyond)?;
        let rest = In::rest(subject, &scene)?;
        if rest.len() != scene.nodes.iter().product::<usize>() {
            return Err(format!("{} answers for {:?} nodes", rest.len(), scene.nodes));
        }
        let free: Vec<[f64; D]> = whole::nodes(&scene)
            .zip(rest)
            .filter(|(node, _)| level.free(*node))
            .map(|(_, u)| u.map(|u| u / HEIGHT))
            .collect();
        let exact = self.displacements(level, |_, a| Some(a)).ok_or(beyond)?;
        let own = match self.around {
            Around::HeldFrame => None,
            Around::Mirrors => {
                let lattice = whole::lattice(&scene);
                let own =
                    self.displacements(level, |k, a| In::response(&lattice, k, In::stiffness(medium, k, a)?));
                let own = own.ok_or(beyond)?;
                largest(pairs(&free, &own).into_iter().map(|(u, own)| (u - own).abs()))
            }
        };
        Ok(Solved { errors: relative(pairs(&free, &exact)), own })
    }

    fn between(&self, level: &Rested<D>, wrong: &Medium, right: &Medium) -> Option<Errors> {
        let answered =
            self.displacements(level, |k, a| In::response(wrong, k, In::stiffness(right, k, a)?))?;
        let exact = self.displacements(level, |_, a| Some(a))?;
        Some(relative(pairs(&answered, &exact)))
    }

    fn problem(&self) -> Option<Vec<(&'static str, String)>> {
        Some(self.words())
    }

    fn fields(&self) -> Vec<Box<dyn Foreign + '_>> {
        if D != 2 {
            return Vec::new();
        }
        let field = |factor: f64| -> Exact<'_> {
            Box::new(move |at| {
                let u = self.aimed(std::array::from_fn(|axis| at[axis.min(1)]));
                [factor * u[0], factor * u[D - 1]]
            })
        };
        vec![Box::new(ForeignField {
            title: "A plate at rest",
            name: "displacement",
            side: self.side,
            exact: field(1.0),
            bound: (
                0.02,
                Basis::Engineering,
                "twenty cells to the shortest wave of the field leave less in every scheme of the second order; a wrong load, modulus or plane state leaves more",
            ),
            problem: self.words(),
            source: self.source(),
            // The field is one of shear: its stiffness E/(2(1 + ν)) has ν = 1/3 in plane stress, 1/4 in plane strain.
            wrong: vec![(
                "the answer with the Poisson ratio of the other plane state, 1/4 for 1/3 or 1/3 for 1/4",
                field(if self.body == Body::PlaneStress { 0.9375 } else { 1.0 / 0.9375 }),
                "Poisson ratio",
            )],
        })]
    }

    fn has_own(&self) -> bool {
        self.around == Around::Mirrors
    }

    fn predicts_plateaus(&self) -> bool {
        self.around == Around::Mirrors
    }
}
