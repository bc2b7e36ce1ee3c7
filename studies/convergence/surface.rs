//! `asks = "surface"`: how free edges enter the order. A plate pulled at a free edge, at rest, with each surface correction:
//! bonds missing within δ of an edge change the error by a share of order δ/L, and a corner of two free edges adds a logarithm.

use super::path::{Level, PathAsked, Sequence, WeightsAsked};
use super::surface_report as report;
use super::whole;
use crate::bar::pulsed::material;
use crate::dispersion::sweep::distinct;
use crate::dispersion::words::BodyName;
use crate::input::{OneOrMany, one_or_many};
use crate::levels::{self, Errors, NORMS, furthest, relative, tail_order};
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim};
use crate::scene::size::cells;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim};
use pd_verify::constraints::{Edge, Edges};
use pd_verify::forces::Traction;
use pd_verify::forces::surface::Correction;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::scene::{Axis, HistoryAsked, Positive, Scene, Side, StepRule, Time, Wrong};
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// What lies along the pull.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Top {
    /// A free edge: it meets the pulled one in a corner.
    #[default]
    Free,
    /// A mirror: nothing swells, the pulled edge alone is free.
    Mirror,
}

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceAsked {
    /// A plate.
    pub body: BodyName,
    /// L: side of a quarter of the plate, mirrored left and bottom.
    pub side_m: Positive,
    /// Default: `free`.
    pub top: Option<Top>,
    /// Default: `none`.
    pub correction: Option<OneOrMany<Correction>>,
    pub path: PathAsked,
    pub weights: WeightsAsked,
}

/// The case, checked.
pub struct Surface {
    pub title: String,
    pub side: f64,
    pub top: Top,
    pub tracks: Vec<Track>,
}

/// A refinement with one correction.
pub struct Track {
    /// Of the lattice alone.
    pub name: String,
    pub correction: Correction,
    pub sequence: Sequence,
    levels: Vec<(Scene<2>, Plan)>,
}

/// What one level showed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulled {
    /// Of the displacement, relative to the local answer.
    pub errors: Errors,
    /// How much further than in the local plate the loaded edge moves, over its way there; negative where it is too stiff.
    pub softness: f64,
}

/// σ/C₁₁; the body is linear, so that it is of no account.
const LOAD: f64 = 1e-6;
/// How far an order may be from the expected one.
const WITHIN: f64 = 0.1;
/// Errors below may be what conjugate gradients lose.
const FLOOR: f64 = 1e-9;

impl Asked for SurfaceAsked {
    type Question = Surface;

    fn check(&self, written: &Written<'_>) -> Result<Surface, Wrong> {
        let body = Body::from(self.body);
        if body == Body::Bar {
            return Err(Wrong::new(
                "body",
                "a bar has no edges to pull along",
                "take a plate, or asks = \"statics\"",
            ));
        }
        let (material, title) = (material(written)?, written.title.to_owned());
        let corrections =
            distinct(self.correction.clone().unwrap_or_else(|| one_or_many(Correction::None)).0);
        let sequences = whole::falling(&self.path, body, &self.weights)?;
        let top = self.top.unwrap_or_default();
        let above = if top == Top::Free { Edge::Free } else { Edge::MirrorOdd };
        let mut tracks = Vec::new();
        for (sequence, name) in &sequences {
            for &correction in &corrections {
                let ready = |level: &Level| {
                    let lattice = sequence.lattice(*level);
                    let (nodes, spacing) = cells([self.side_m.0; 2], level.spacing)
                        .map_err(|wrong| Wrong { key: "path".into(), ..wrong })?;
                    let time = Time { duration: 1.0, step: StepRule::OfLimit(1.0) };
                    let bare = Scene::bare(material, body, lattice, nodes, spacing, time);
                    let stress_pa = LOAD * bare.modulus();
                    let pull = Traction {
                        edge: Side::Right,
                        axis: Axis::X,
                        stress_pa,
                        history: HistoryAsked::step(),
                    };
                    let scene = Scene {
                        name: format!("{}, surface {}", bare.name, correction.name()),
                        edges: Edges([[Edge::MirrorOdd, Edge::Free], [Edge::MirrorOdd, above]]),
                        surface: correction,
                        effects: vec![Arc::new(pull)],
                        ..bare
                    };
                    let plan = Plan::at_rest(&scene)?;
                    Ok((scene, plan))
                };
                let levels = sequence.levels.iter().map(ready).collect::<Result<_, Wrong>>()?;
                let (name, sequence) = (name.clone(), sequence.clone());
                tracks.push(Track { name, correction, sequence, levels });
            }
        }
        Ok(Surface { title, side: self.side_m.0, top, tracks })
    }
}

impl Top {
    /// The local plate under σ: u = ε(x, −y/3), ε = 9σ/(8C₁₁), as C₁₂ = C₁₁/3 in both plane states; between mirrors
    /// u = (σ/C₁₁)(x, 0).
    fn local(self, x: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Free => [LOAD * 9.0 / 8.0 * x[0], -LOAD * 3.0 / 8.0 * x[1]],
            Self::Mirror => [LOAD * x[0], 0.0],
        }
    }

    /// The order in each norm, as far as there is one: the largest error of a corner has none.
    fn orders(self) -> &'static [f64] {
        match self {
            Self::Free => &[1.0, 1.0],
            Self::Mirror => &[2.0, 1.5, 1.0],
        }
    }

    fn because(self) -> &'static str {
        match self {
            Self::Free => {
                "bonds are missing within δ of a free edge, corrected or not: a layer as wide as δ of other compliance changes displacements by a share of order δ/L (in a bar by cδ/L exactly; Le and Bobaru 2018); 0.1 for δ/L ln(L/δ), which the corner adds"
            }
            Self::Mirror => {
                "bonds are missing within δ of the pulled edge, corrected or not: its layer is the same in units of Δx at every level and moves the edge by cδ, as in a bar (Le and Bobaru 2018). Inside nothing is wrong, so that the mean over the body of its p-th power has order p + 1, and its norm 1 + 1/p; 0.1 for the field at the outermost nodes, half a cell from the edge"
            }
        }
    }

    fn source(self) -> &'static str {
        match self {
            Self::Free => "uniform tension of local elasticity, u = 9σ/(8C₁₁) (x, −y/3)",
            Self::Mirror => "uniform tension of local elasticity without swelling, u = σ/C₁₁ (x, 0)",
        }
    }
}

fn solve(subject: &dyn Subject, top: Top, scene: &Scene<2>) -> Result<Pulled, String> {
    let rest = subject.rest_plate(scene)?;
    let [columns, rows] = scene.nodes;
    if rest.len() != columns * rows {
        return Err(format!("{} displacements for {columns} by {rows} nodes", rest.len()));
    }
    let places = whole::nodes(scene).map(|node| node.map(|n| (n as f64 + 0.5) * scene.spacing));
    let pairs = rest.iter().zip(places).flat_map(|(u, x)| {
        let exact = top.local(x);
        [(u[0], exact[0]), (u[1], exact[1])]
    });
    let edge = rest.chunks(columns).map(|row| row[columns - 1][0]).sum::<f64>() / rows as f64;
    let exact = top.local([(columns as f64 - 0.5) * scene.spacing, 0.0])[0];
    Ok(Pulled { errors: relative(pairs), softness: edge / exact - 1.0 })
}

impl Track {
    /// δ in m and the errors of each level.
    pub fn refinement(&self, pulled: &[Pulled]) -> levels::Sequence {
        let steps = self.sequence.levels.iter().map(|level| self.sequence.step(*level));
        let name = format!("{}, {}", self.name, called(self.correction));
        levels::Sequence { name, levels: steps.zip(pulled.iter().map(|one| one.errors)).collect() }
    }
}

/// What a correction is called in legends and notes.
pub fn called(correction: Correction) -> &'static str {
    match correction {
        Correction::None => "no correction",
        Correction::Energy => "energy",
        Correction::Volume => "volume",
    }
}

/// The power of δ by which the growth of error/δ per factor e of δ still changes, from the three finest levels: 0 for
/// δ(a + b ln(L/δ)), p − 1 for δ^p.
fn logarithm(levels: &levels::Sequence) -> Evidence {
    let share: Vec<(f64, f64)> =
        levels.in_norm(2).into_iter().map(|(horizon, error)| (libm::log(horizon), error / horizon)).collect();
    // At the middle of a pair.
    let growth = |pair: &[(f64, f64)]| {
        (0.5 * (pair[0].0 + pair[1].0), (pair[1].1 - pair[0].1) / (pair[0].0 - pair[1].0))
    };
    let growths: Vec<(f64, f64)> = share.windows(2).map(growth).collect();
    let power = match growths[..] {
        [.., before, finest] => libm::log(finest.1 / before.1) / (finest.0 - before.0),
        _ => f64::NAN,
    };
    let listed: Vec<String> = growths.iter().map(|(_, growth)| format!("{growth:.3}")).collect();
    Evidence {
        computed: Some(power),
        reference: Some(0.0),
        error: Some(power.abs()),
        note: format!(
            "{}: error/δ (per metre) grows by {} with each factor e of L/δ",
            levels.name,
            listed.join(", ")
        ),
        ..Evidence::default()
    }
}

impl Surface {
    fn corrections(&self) -> Vec<Correction> {
        distinct(self.tracks.iter().map(|track| track.correction))
    }

    fn follow(&self, subject: &dyn Subject) -> Result<Vec<Vec<Pulled>>, String> {
        let solved: Vec<Result<Vec<Pulled>, String>> = self
            .tracks
            .par_iter()
            .map(|track| {
                let each: Vec<_> =
                    track.levels.par_iter().map(|(scene, _)| solve(subject, self.top, scene)).collect();
                each.into_iter().collect()
            })
            .collect();
        solved.into_iter().collect()
    }

    fn evidence(&self, pulled: &[Vec<Pulled>]) -> Vec<(String, Evidence)> {
        let mut evidence = Vec::new();
        for correction in self.corrections() {
            let mine = || {
                let all = self.tracks.iter().zip(pulled);
                let mine = all.filter(move |(track, _)| track.correction == correction);
                mine.map(|(track, pulled)| track.refinement(pulled))
            };
            for (norm, (name, expected)) in NORMS.iter().zip(self.top.orders()).enumerate() {
                let orders = mine()
                    .map(|levels| tail_order(&levels.name, &levels.in_norm(norm), *expected, WITHIN, FLOOR));
                evidence.extend(furthest(orders, WITHIN).map(|found| (order_name(name, correction), found)));
            }
            if self.top == Top::Mirror {
                continue;
            }
            let corners = furthest(mine().map(|levels| logarithm(&levels)), WITHIN);
            evidence.extend(corners.map(|found| (format!("corner_{}", correction.name()), found)));
        }
        evidence
    }
}

fn order_name(norm: &str, correction: Correction) -> String {
    format!("order_{norm}_{}", correction.name())
}

impl Question for Surface {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let source = self.top.source();
        let mut claims = Vec::new();
        for correction in self.corrections() {
            let with = called(correction);
            for (norm, expected) in NORMS.iter().zip(self.top.orders()) {
                let quantity = format!(
                    "order in δ of the error in {norm} of a plate pulled at free edges, {with}, furthest lattice"
                );
                claims.push(
                    claim(place, &order_name(norm, correction), quantity)
                        .order(*expected, WITHIN)
                        .because(Basis::Theory, self.top.because())
                        .source(source),
                );
            }
            if self.top == Top::Mirror {
                continue;
            }
            let quantity = format!(
                "order in δ of the growth of the largest error over δ per factor e of L/δ, {with}, furthest lattice"
            );
            claims.push(
                claim(place, &format!("corner_{}", correction.name()), quantity)
                    .order(0.0, WITHIN)
                    .because(Basis::Theory, "the layer along the free edge carries too little or too much by a force cσδ, which enters at the corner like a point force: its displacement grows as ln(L/δ) there (Flamant), so that the largest error is δ(a + b ln(L/δ)), the growth b; δ^p would show p − 1, what follows the logarithm falls with δ")
                    .source(source),
            );
        }
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.tracks.iter().flat_map(|track| &track.levels).map(|(_, plan)| plan.clone()).collect()
    }

    fn effort(&self) -> Effort {
        let mut total = Effort::default();
        let levels = self.tracks.iter().flat_map(|track| &track.levels);
        levels.for_each(|(scene, plan)| total += whole::resting(plan, scene.nodes[0]));
        total
    }

    fn equations(&self) -> &'static str {
        "0 = Σ_b f_b w_b n (n·(u_b − u)) + b, b_x = σ/Δx on the cells of the right edge; u odd about left and bottom, top free or a mirror
energy: f = 1/√Σ (n_a/λ_a)², λ_a bulk over own energy density stretched along a; volume: f = 2V₀/(V_i + V_j)
δ → 0: u = 9σ/(8C₁₁) (x, −y/3); error = cδ/L in l1 and l2, δ/L (a + b ln(L/δ)) at the corner of two free edges
between mirrors: u = σ/C₁₁ (x, 0), error cδ/L within δ of the edge: orders 2, 3/2, 1 in l1, l2, linf"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        match self.follow(subject) {
            Err(failure) => Answer::failed(&self.claims(place), &failure),
            Ok(pulled) => Answer {
                evidence: self.evidence(&pulled),
                tables: report::tables(self, &pulled, place),
                figures: vec![report::figure(self, &pulled, place)],
                ..Answer::default()
            },
        }
    }
}
