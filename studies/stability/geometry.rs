//! `asks = "geometry"`: cuts and holes in awkward places: through nodes, between them, slanted, crossing, closed around a piece
//! or a single node, touching an edge: the bonds that are left are those that whole numbers leave, nothing grows just below
//! the limit, and every piece flies off with its own momentum.

use super::body::{FreeBody, FreeBodyAsked, Pace};
use super::geometry_report as report;
use super::growing::norm;
use super::long_run::{Kept, kept, wander};
use super::shape::{ShapeAsked, Shaped, plain};
use crate::bar::names::names;
use crate::dispersion::curve::reference_lattice;
use crate::dispersion::sweep::LatticeSweep;
use crate::question::{Answer, Claiming, Place, Planned, Question, claim, error_of, value_of};
use crate::rounded::rounded;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::scene::{Operator, Scene, Wrong};
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GeometryAsked {
    pub body: FreeBodyAsked,
    /// Of the march just below the limit; a tenth of them of the one in which pieces fly.
    pub steps: u64,
    pub shape: Vec<ShapeAsked>,
    pub lattice: LatticeSweep,
}

/// The case, checked: every shape of every lattice.
pub struct Geometry {
    pub title: String,
    pub shaped: Vec<Shaped>,
    pub names: Vec<String>,
    steps: u64,
    plans: Vec<Plan>,
}

/// What one plate did.
pub struct Seen {
    /// Nodes whose force is not that of the bonds that whole numbers leave, by stencil and by list.
    pub wrong: [usize; 2],
    pub kept: Kept,
    /// The largest distance of a piece from where its own momentum takes it, over what rounding allows.
    pub flight: Option<f64>,
    pub pieces: usize,
}

/// Of the lattice's limit.
const SAFETY: f64 = 0.99;
const LEAST: u64 = 1000;
const MOST_NODES: usize = 5000;
/// Of the largest force, times the neighbours: what summing in another order may change, with room for directions.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

impl Asked for GeometryAsked {
    type Question = Geometry;

    fn check(&self, written: &Written<'_>) -> Result<Geometry, Wrong> {
        let material = written.material()?;
        if self.steps < LEAST {
            let message = format!("{} steps are too few to tell what grows", self.steps);
            return Err(Wrong::new("steps", message, format!("take {LEAST} or more")));
        }
        let count = self.body.nodes.iter().try_fold(1_usize, |count, &n| count.checked_mul(n));
        if count.is_none_or(|count| count > MOST_NODES) {
            let message = "a body this large is not marched for so many steps";
            return Err(Wrong::new("body.nodes", message, format!("take at most {MOST_NODES} nodes")));
        }
        if self.body.surface_correction.is_some() {
            let message = "corrected surfaces are not bounded by the lattice's weights";
            return Err(Wrong::new("body.surface_correction", message, "leave it out"));
        }
        if self.shape.is_empty() {
            return Err(Wrong::new("shape", "there is nothing to cut", "add a [[case.shape]]"));
        }
        let lattices =
            self.lattice.usable(Body::from(self.body.is)).map_err(|wrong| wrong.inside("lattice"))?;
        let (mut shaped, mut all) = (Vec::new(), Vec::new());
        let mut plans = Vec::new();
        for (lattice, name) in lattices.iter().zip(names(&lattices)) {
            let plain = plain(&self.body, material, *lattice)?;
            for (index, shape) in self.shape.iter().enumerate() {
                let inside = |wrong: Wrong| wrong.inside(&format!("shape[{index}]"));
                let one = shape.check(&plain).map_err(inside)?;
                plans.extend(
                    one.body().plans(&[(SAFETY, self.steps), (SAFETY, self.steps / 10)]).map_err(inside)?,
                );
                all.push(if lattices.len() == 1 {
                    shape.name.clone()
                } else {
                    format!("{}, {name}", shape.name)
                });
                shaped.push(one);
            }
        }
        Ok(Geometry { title: written.title.to_owned(), shaped, names: all, steps: self.steps, plans })
    }
}

impl Question for Geometry {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let walk = "independent slips of the size of their bounds add up to λ√n of one, λ = 5; the bound of a step follows from the start's norm";
        let invariant = "leapfrog's invariant ½ρVv(n+½)² + ½u(n)ᵀKu(n+1); Higham & Mary 2019, SIAM J. Sci. Comput. 41, A2815";
        let mut claims = vec![
            claim(place, "bonds", "nodes of all shapes on which stencil or list pull otherwise than the bonds that are left")
                .exactly()
                .because(Basis::Theory, "a bond too many or too few, or one that only one of its ends knows, moves the force under a rough displacement by far more than rounding, 8ε for each neighbour of the largest force")
                .source("cuts and holes decided by products of whole numbers, bond by bond"),
            claim(place, "energy", format!("largest drift of the invariant over what rounding allows, {} steps at {SAFETY} of the limit", self.steps))
                .at_most(ErrorKind::Relative, 1.0)
                .because(Basis::Rounding, walk)
                .source(invariant),
            claim(place, "momentum", format!("largest momentum of the free body over what rounding allows, {} steps", self.steps))
                .at_most(ErrorKind::Relative, 1.0)
                .because(Basis::Rounding, walk)
                .source("bonds pull both ends alike: from rest the momentum stays zero"),
            claim(place, "bounded", "by what the norm of the displacements exceeds that of the start")
                .at_most(ErrorKind::Relative, 1e-6)
                .because(Basis::Theory, "cutting bonds slows a body's modes: below the lattice's limit leapfrog carries all of them as cos nθ; rounding pushes the body as a whole by 1e-16 a step")
                .source("leapfrog from rest, u(n) = Σ u_k cos nθ_k"),
        ];
        claims.extend(self.apart().then(|| {
            claim(place, "flight", "largest distance of a piece from where its own momentum takes it, over what rounding allows")
                .at_most(ErrorKind::Relative, 1.0)
                .because(Basis::Rounding, "bonds within a piece pull both ends alike, and none leads out of it: its mean moves uniformly; slips of its momentum walk, and are summed: λn^1.5 of one, λ = 5")
                .source("mean displacement and velocity of the piece at the start; pieces by following bonds that whole numbers leave")
        }));
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.plans.clone()
    }

    fn equations(&self) -> &'static str {
        "a cut parts a bond whose ends lie on different sides of its line (on it: left) and that crosses it between its ends, these included
ū(n) = ū(0) + nΔt v̄(0) of every piece that bonds hold together"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let all: Vec<Result<Seen, String>> =
            self.shaped.par_iter().map(|shaped| self.see(subject, shaped)).collect();
        let all: Vec<Seen> = match all.into_iter().collect() {
            Ok(all) => all,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        Answer {
            evidence: self.evidence(&all),
            tables: vec![report::table(self, &all, place)],
            figures: vec![report::figure(self, place)],
            ..Answer::default()
        }
    }
}

impl Geometry {
    /// Whether a shape leaves several pieces.
    fn apart(&self) -> bool {
        self.shaped
            .iter()
            .any(|one| one.exact.pieces(reference_lattice(one.lattice())).iter().any(|piece| *piece > 0))
    }

    fn see(&self, subject: &dyn Subject, shaped: &Shaped) -> Result<Seen, String> {
        let body = shaped.body();
        let plan = body.plans(&[(SAFETY, self.steps)]).map_err(|wrong| wrong.message)?.remove(0);
        let pieces = shaped.exact.pieces(reference_lattice(shaped.lattice()));
        Ok(Seen {
            wrong: [wrong(subject, shaped, Operator::Stencil)?, wrong(subject, shaped, Operator::Bonds)?],
            kept: kept(subject, &body, &plan, SAFETY, self.steps)?,
            flight: self.flight(subject, shaped, &plan, &pieces)?,
            pieces: pieces.iter().max().map_or(0, |last| last + 1),
        })
    }

    /// Where pieces are, over where they should be by what rounding allows.
    fn flight(
        &self,
        subject: &dyn Subject,
        shaped: &Shaped,
        plan: &Plan,
        pieces: &[usize],
    ) -> Result<Option<f64>, String> {
        let scene = shaped.flying();
        let body = FreeBody::Plate(scene.clone());
        let steps = self.steps / 10;
        let pace = Pace { seconds: plan.time_step_s, steps, every: steps / 10 };
        let looks = body.march(subject, pace).map_err(|failure| failure.to_string())?;
        let (start, speed) = (shaped.at_nodes(&scene.displacement), shaped.at_nodes(&scene.velocity));
        let size =
            largest(looks.iter().map(|look| norm(&look.displacement))).ok_or("the body was not seen")?;
        let mut over = Vec::new();
        for look in looks.iter().filter(|look| look.step > 0) {
            let time = look.step as f64 * plan.time_step_s;
            let allowed = wander(&body, plan.time_step_s, SAFETY, size, look.step)?;
            if look.displacement.len() != 2 * pieces.len() {
                return Err("not all nodes were seen, or more than there are".into());
            }
            for piece in 0..=pieces.iter().copied().max().unwrap_or(0) {
                let mut away = [0.0; 2];
                for node in (0..pieces.len()).filter(|&node| pieces[node] == piece) {
                    for (axis, away) in away.iter_mut().enumerate() {
                        let expected = start[node][axis] + time * speed[node][axis];
                        *away += look.displacement[2 * node + axis] - expected;
                    }
                }
                over.extend(away.map(|away| away.abs() / allowed));
            }
        }
        Ok(largest(over))
    }

    fn evidence(&self, all: &[Seen]) -> Vec<(String, Evidence)> {
        let worst = |of: &dyn Fn(&Seen) -> Option<f64>| {
            let each: Option<Vec<f64>> = all.iter().map(of).collect();
            let worst = each.as_ref().and_then(|each| largest(each.iter().copied()));
            let at = each.and_then(|each| each.iter().position(|one| Some(*one) == worst));
            error_of(
                worst,
                at.map_or(String::new(), |at| format!("{} plates; {}", all.len(), self.names[at])),
            )
        };
        let wrong: usize = all.iter().flat_map(|seen| seen.wrong).sum();
        let lost: usize = self
            .shaped
            .iter()
            .map(|one| one.exact.lost(reference_lattice(one.lattice())).iter().sum::<usize>() / 2)
            .sum();
        let loose: usize = all.iter().map(|seen| seen.pieces - 1).sum();
        let flight = worst(&|seen| seen.flight);
        let flight = Evidence { note: format!("{loose} loose pieces; {}", flight.note), ..flight };
        let drift = |kept: &Kept| largest(kept.drift.iter().map(|(_, drift, allowed)| drift / allowed));
        let momentum = |kept: &Kept| largest(kept.momentum.iter().map(|(_, size, allowed)| size / allowed));
        vec![
            (
                "bonds".into(),
                value_of(
                    (!all.is_empty()).then_some(wrong as f64),
                    Some(0.0),
                    format!("{} plates without {} of their bonds", all.len(), rounded(lost as f64)),
                ),
            ),
            ("energy".into(), worst(&|seen| drift(&seen.kept))),
            ("momentum".into(), worst(&|seen| momentum(&seen.kept))),
            ("bounded".into(), worst(&|seen| seen.kept.excess)),
            ("flight".into(), flight),
        ]
    }
}

/// How many nodes an operator pulls otherwise than the bonds that are left; all where it knows others nodes.
fn wrong(subject: &dyn Subject, shaped: &Shaped, operator: Operator) -> Result<usize, String> {
    let scene = Scene { operator, ..shaped.scene.clone() };
    let pulled = subject.bond_force_plate(&scene)?;
    let lattice = reference_lattice(shaped.lattice());
    let start = shaped.at_nodes(&scene.displacement);
    let exact = shaped.exact.forces(lattice, &start).ok_or("nodes and displacements differ in number")?;
    if pulled.len() != exact.len() {
        return Ok(exact.len());
    }
    let unit = scene.modulus() / (scene.spacing * scene.spacing);
    let most = largest(exact.iter().flatten().map(|force| (unit * force).abs())).unwrap_or(f64::NAN);
    let allowed = ROUNDING * shaped.body().weights()?.0 as f64 * most;
    let other =
        |(a, b): &(&[f64; 2], &[f64; 2])| !(0..2).all(|axis| (a[axis] - unit * b[axis]).abs() <= allowed);
    Ok(pulled.iter().zip(&exact).filter(other).count())
}
