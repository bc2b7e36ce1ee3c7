//! `asks = "grid_convergence"`: what grids say where no exact answer is known. A plate, notched or whole, pulled at rest; three
//! grids predict the next, and their extrapolation is held against it. The whole plate's exact answer judges extrapolation.

use super::grids_report as report;
use super::grids_said::{band, change, known, order};
use super::path::{PathAsked, Sequence, WeightsAsked};
use super::whole;
use crate::bar::pulsed::material;
use crate::dispersion::sweep::distinct;
use crate::dispersion::words::BodyName;
use crate::input::{OneOrMany, one_or_many};
use crate::levels::furthest;
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of};
use crate::scene::size::cells;
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::constraints::{Edge, Edges};
use pd_verify::forces::Traction;
use pd_verify::forces::surface::Correction;
use pd_verify::material::{Body, Material};
use pd_verify::plan::Plan;
use pd_verify::scene::{
    Axis, Effect, HistoryAsked, Notch, Operator, Positive, Scene, Side, StepRule, Time, Wrong,
};
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GridsAsked {
    /// A plate.
    pub body: BodyName,
    /// L: height of the plate and half of its width, mirrored at the left; pulled up and down.
    pub side_m: Positive,
    /// Half of the length of a notch across the middle, from the mirror; without it the plate is whole.
    pub notch_m: Option<Positive>,
    /// Default: `none`.
    pub correction: Option<OneOrMany<Correction>>,
    pub path: PathAsked,
    pub weights: WeightsAsked,
}

/// What is followed from grid to grid, over σL/C₁₁.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Mean distance by which the pulled edges move apart.
    Elongation,
    /// Mean way of the right edge to the left.
    Contraction,
    /// Distance by which the faces of the notch move apart at the mirror.
    Opening,
}

/// The case, checked.
pub struct Grids {
    pub title: String,
    pub quantities: Vec<Quantity>,
    pub tracks: Vec<Track>,
    side: f64,
}

/// A refinement with one correction.
pub struct Track {
    /// Of lattice and correction.
    pub name: String,
    pub correction: Correction,
    pub sequence: Sequence,
    levels: Vec<(Scene<2>, Plan)>,
}

/// What one refinement showed.
#[derive(Debug, Clone, PartialEq)]
pub struct Followed {
    /// By quantity, (Δx, value) from coarse to fine.
    pub values: Vec<Vec<(f64, f64)>>,
    /// Largest difference of displacements by the other operator at the coarsest level, over the largest.
    pub operators: f64,
}

/// σ/C₁₁; the body is linear, so that it is of no account.
const LOAD: f64 = 1e-6;
/// Grids that it takes to predict one more.
const GRIDS: usize = 4;

impl Quantity {
    /// In tables and names of claims.
    pub fn word(self) -> &'static str {
        match self {
            Self::Elongation => "elongation",
            Self::Contraction => "contraction",
            Self::Opening => "opening",
        }
    }

    /// Of the whole plate in local elasticity: ε = 9σ/(8C₁₁) along, ε/3 across, as C₁₂ = C₁₁/3 in both plane states.
    pub fn exact(self) -> Option<f64> {
        match self {
            Self::Elongation => Some(9.0 / 8.0),
            Self::Contraction => Some(3.0 / 8.0),
            Self::Opening => None,
        }
    }

    fn of(self, u: &[[f64; 2]], columns: usize) -> f64 {
        let rows = u.len() / columns;
        let at = |column: usize, row: usize| u[row * columns + column];
        match self {
            Self::Elongation => {
                let apart = (0..columns).map(|column| at(column, rows - 1)[1] - at(column, 0)[1]);
                apart.sum::<f64>() / columns as f64
            }
            Self::Contraction => -(0..rows).map(|row| at(columns - 1, row)[0]).sum::<f64>() / rows as f64,
            Self::Opening => at(0, rows / 2)[1] - at(0, rows / 2 - 1)[1],
        }
    }
}

impl Asked for GridsAsked {
    type Question = Grids;

    fn check(&self, written: &Written<'_>) -> Result<Grids, Wrong> {
        let body = Body::from(self.body);
        if body == Body::Bar {
            return Err(Wrong::new(
                "body",
                "a bar has no notch to open",
                "take a plate, or asks = \"statics\"",
            ));
        }
        let (material, title) = (material(written)?, written.title.to_owned());
        let corrections =
            distinct(self.correction.clone().unwrap_or_else(|| one_or_many(Correction::None)).0);
        let sequences = whole::falling(&self.path, body, &self.weights)?;
        let mut tracks = Vec::new();
        for (sequence, name) in &sequences {
            if sequence.levels.len() < GRIDS {
                let message = format!("{} grids: three predict a fourth", sequence.levels.len());
                return Err(Wrong::new(
                    "path.dx_m",
                    message,
                    "give four grids or more, five to see orders agree",
                ));
            }
            for &correction in &corrections {
                let ready = |dx: f64| self.ready(material, body, sequence, correction, dx);
                let levels = sequence.levels.iter().map(|level| ready(level.spacing));
                let levels = levels.collect::<Result<_, Wrong>>()?;
                let name = match corrections[..] {
                    [Correction::None] => name.clone(),
                    _ => format!("{name}, {}", super::surface::called(correction)),
                };
                tracks.push(Track { name, correction, sequence: sequence.clone(), levels });
            }
        }
        let quantities = match self.notch_m {
            Some(_) => vec![Quantity::Opening, Quantity::Elongation],
            None => vec![Quantity::Elongation, Quantity::Contraction],
        };
        Ok(Grids { title, quantities, tracks, side: self.side_m.0 })
    }
}

impl GridsAsked {
    fn ready(
        &self,
        material: Material,
        body: Body,
        sequence: &Sequence,
        correction: Correction,
        dx: f64,
    ) -> Result<(Scene<2>, Plan), Wrong> {
        let side = self.side_m.0;
        let (nodes, spacing) = cells([side; 2], dx).map_err(|wrong| Wrong { key: "path".into(), ..wrong })?;
        let lattice = sequence.lattice(sequence.finest());
        let time = Time { duration: 1.0, step: StepRule::OfLimit(1.0) };
        let bare = Scene::bare(material, body, lattice, nodes, spacing, time);
        let mut notches = Vec::new();
        if let Some(Positive(half)) = self.notch_m {
            if half >= side {
                let message = format!("a notch of {half} m leaves nothing of {side} m");
                return Err(Wrong::new("notch_m", message, "take a shorter one"));
            }
            let (cut, _) = cells([half], spacing).map_err(|wrong| {
                Wrong::new("notch_m", format!("at dx_m = {dx} the notch ends within a cell"), wrong.help)
            })?;
            if nodes[1] % 2 == 1 {
                let message = format!("{} rows at dx_m = {dx}: the notch would cut nodes", nodes[1]);
                return Err(Wrong::new("path.dx_m", message, "take an even number of cells for side_m"));
            }
            let middle = 0.5 * nodes[1] as f64 * spacing;
            notches.push(Notch { from: [0.0, middle], to: [cut[0] as f64 * spacing, middle] });
        }
        let pull = |edge, share: f64| -> Arc<dyn Effect<2>> {
            let stress_pa = share * LOAD * bare.modulus();
            Arc::new(Traction { edge, axis: Axis::Y, stress_pa, history: HistoryAsked::step() })
        };
        let scene = Scene {
            name: format!("{}, surface {}", bare.name, correction.name()),
            edges: Edges([[Edge::MirrorOdd, Edge::Free], [Edge::Free; 2]]),
            notches,
            surface: correction,
            effects: vec![pull(Side::Top, 1.0), pull(Side::Bottom, -1.0)],
            ..bare
        };
        let plan = Plan::at_rest(&scene)?;
        Ok((scene, plan))
    }
}

impl Grids {
    fn follow(&self, subject: &dyn Subject, track: &Track) -> Result<Followed, String> {
        let rest = |scene: &Scene<2>| -> Result<Vec<[f64; 2]>, String> {
            let rest = subject.rest_plate(scene)?;
            let expected = scene.nodes.iter().product::<usize>();
            if rest.len() != expected {
                return Err(format!("{} displacements for {expected} nodes", rest.len()));
            }
            Ok(rest)
        };
        let solved: Vec<_> = track.levels.par_iter().map(|(scene, _)| rest(scene)).collect();
        let solved = solved.into_iter().collect::<Result<Vec<_>, _>>()?;
        let coarsest = &track.levels[0].0;
        let bonds = rest(&Scene { operator: Operator::Bonds, ..coarsest.clone() })?;
        let peak = largest(solved[0].iter().flatten().map(|u| u.abs())).unwrap_or(f64::NAN);
        let apart = solved[0].iter().flatten().zip(bonds.iter().flatten()).map(|(a, b)| (a - b).abs() / peak);
        let of = |quantity: &Quantity| {
            let each = track.levels.iter().zip(&solved);
            let unit = LOAD * self.side;
            each.map(|((scene, _), u)| (scene.spacing, quantity.of(u, scene.nodes[0]) / unit)).collect()
        };
        Ok(Followed {
            values: self.quantities.iter().map(of).collect(),
            operators: largest(apart).unwrap_or(f64::NAN),
        })
    }

    /// Whether there is a notch, and no exact answer.
    fn notched(&self) -> bool {
        self.quantities.contains(&Quantity::Opening)
    }

    fn evidence(&self, followed: &[Followed]) -> Vec<(String, Evidence)> {
        let operators = largest(followed.iter().map(|one| one.operators));
        let mut evidence =
            vec![("operators".into(), error_of(operators, format!("{} lattices", self.tracks.len())))];
        for (index, quantity) in self.quantities.iter().enumerate() {
            let each = || {
                let both = self.tracks.iter().zip(followed);
                both.map(move |(track, one)| (track, one.values[index].as_slice()))
            };
            let word = quantity.word();
            let mut add = |name: &str, bound: f64, all: Vec<Evidence>| {
                evidence.extend(furthest(all, bound).map(|found| (format!("{name}_{word}"), found)));
            };
            add("band", 1.0, each().map(|(track, values)| band(&track.name, values)).collect());
            add("change", 0.1, each().map(|(track, values)| change(&track.name, values)).collect());
            let plain = each().filter(|(track, _)| self.notched() && track.correction == Correction::None);
            add("order", 0.1, plain.map(|(track, values)| order(&track.name, values)).collect());
            if let (false, Some(exact)) = (self.notched(), quantity.exact()) {
                add("exact", 1.0, each().map(|(track, values)| known(&track.name, values, exact)).collect());
            }
        }
        evidence
    }
}

impl Question for Grids {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let mut claims = vec![
            claim(place, "operators", "largest difference of displacements by bonds stored one by one at the coarsest grid, over the largest")
                .at_most(ErrorKind::MaxOfPeak, 1e-10)
                .because(Basis::Rounding, "one sum in two orders; conjugate gradients to 1e-14 on N cells lose some N² times it")
                .source("every bond stored: the other operator"),
        ];
        // The whole plate has an exact answer; its order is what `surface` asks.
        let plain = self.notched() && self.tracks.iter().any(|track| track.correction == Correction::None);
        for quantity in &self.quantities {
            let word = quantity.word();
            let grids =
                "grids alone: f(h) = f₀ + C h^p through three, Roache's GCI with a factor of safety of 1.25";
            claims.push(
                claim(place, &format!("band_{word}"), format!("finest {word} less the extrapolation of the three grids before, over their GCI: the furthest"))
                    .at_most(ErrorKind::Absolute, 1.0)
                    .because(Basis::Engineering, "the band is meant to hold the limit, and every finer grid on the way to it")
                    .source(grids),
            );
            claims.push(
                claim(place, &format!("change_{word}"), format!("last change of the {word} over the one that the three grids before predict, furthest lattice"))
                    .within(ErrorKind::Relative, 0.1)
                    .because(Basis::Engineering, "in the asymptotic range one power tells the next change; a tenth is a tenth of the band. (The usual asymptotic ratio of three grids at a constant ratio is f₂/f₁ whatever the order, so it judges nothing)")
                    .source(grids),
            );
            if plain {
                claims.push(
                    claim(place, &format!("order_{word}"), format!("order of the {word} by the three finest grids without correction, furthest lattice"))
                        .order(1.0, 0.1)
                        .because(Basis::Theory, "bonds are missing within δ of free edges and of a notch's faces, and its tip is known to about δ: a share of order δ/L; 0.1 for δ/L ln(L/δ) at corners and for (δ/a)² at the tip")
                        .source(grids),
                );
            }
            if let (false, Some(_)) = (self.notched(), quantity.exact()) {
                claims.push(
                    claim(place, &format!("exact_{word}"), format!("extrapolated {word} less the exact one, over the GCI of the three finest grids: the furthest"))
                        .at_most(ErrorKind::Absolute, 1.0)
                        .because(Basis::Engineering, "the band is meant to hold the limit")
                        .source("uniform tension of local elasticity, ε = 9σ/(8C₁₁)"),
                );
            }
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
        "0 = Σ_b f_b w_b n (n·(u_b − u)) + b, b_y = ±σ/Δx on the cells of the top and bottom edge; no bond through the notch
f(h) = f₀ + C h^p; GCI = 1.25 |f₂ − f₁|/|f₁|/(r^p − 1); whole plate, δ → 0: elongation 9σL/(8C₁₁), contraction a third of it"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let followed: Vec<_> = self.tracks.par_iter().map(|track| self.follow(subject, track)).collect();
        match followed.into_iter().collect::<Result<Vec<Followed>, String>>() {
            Err(failure) => Answer::failed(&self.claims(place), &failure),
            Ok(followed) => Answer {
                evidence: self.evidence(&followed),
                tables: vec![report::table(self, &followed, place)],
                figures: vec![report::figure(self, &followed, place)],
                ..Answer::default()
            },
        }
    }
}
