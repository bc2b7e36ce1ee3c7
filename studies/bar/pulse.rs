//! `asks = "pulse"`: a smooth pulse between a fixed and a free end, refined at a fixed m, against d'Alembert's solution;
//! and its time step refined, against the exact motion of the lattice.

use super::foreign::{Along, ForeignBar, Quantity};
use super::names::names;
use super::pulse_report;
use super::pulsed::{HEIGHT, Marched, PlainBarAsked, PulseShapeAsked, Pulsed, material};
use crate::dispersion::curve::reference_lattice;
use crate::dispersion::sweep::LatticeSweep;
use crate::foreign::{self, Foreign};
use crate::levels::{self, Errors, Sequence, furthest, refining, relative};
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::constraints::Edge;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::scene::{Positive, Wrong};
use pd_verify::verdict::Evidence;
use pd_verify_reference::front::Front;
use pd_verify_reference::lattice_modes::LatticeModes;
use pd_verify_reference::pulse_bar::PulseBar;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written: odd mirror at the left end, even mirror at the right.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PulseAsked {
    pub bar: PlainBarAsked,
    pub pulse: PulseShapeAsked,
    /// Falling, at least three.
    pub dx_m: Vec<Positive>,
    pub duration_s: Positive,
    /// Times at which the bar is looked at, evenly up to the duration.
    pub looks: u32,
    /// Time step over the limit at the coarsest level, the same vΔt/Δx at all; default 0.8.
    pub safety: Option<Positive>,
    /// How often the time step is halved at the second level of Δx; default 4.
    pub halvings: Option<u32>,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct Pulse {
    pub title: String,
    pub bar: Pulsed,
    pub looks: usize,
    pub duration: f64,
    pub refinements: Vec<Refinement>,
}

/// A lattice with its levels.
pub struct Refinement {
    pub name: String,
    pub lattice: Lattice,
    /// Speed of its long waves over √(E/ρ).
    pub speed: f64,
    /// By falling Δx.
    pub by_spacing: Vec<Marched>,
    /// By falling Δt; the first is the second of `by_spacing`.
    pub by_time_step: Vec<Marched>,
}

/// What a lattice did.
pub struct Seen {
    /// Against d'Alembert, by Δx in m.
    pub by_spacing: Sequence,
    /// Against the lattice in exact time, by Δt in s.
    pub by_time_step: Sequence,
    /// The errors that a wave of the lattice's long-wave speed, else exact, has at the finest level.
    pub predicted: Errors,
    /// Largest difference from the modes carried by leapfrog, over the pulse's height.
    pub modes: f64,
    /// Displacements at the last look, by Δx.
    pub last: Vec<Vec<f64>>,
}

/// Relative errors below this may be rounding: ten times what is claimed of the modes.
pub const FLOOR: f64 = 1e-9;
/// Above it halving Δt once more says nothing new.
const MAX_HALVINGS: u32 = 10;
const MAX_LOOKS: u32 = 1000;

impl Asked for PulseAsked {
    type Question = Pulse;

    fn check(&self, written: &Written<'_>) -> Result<Pulse, Wrong> {
        let ends = [Edge::MirrorOdd, Edge::MirrorEven];
        let bar = Pulsed::check(self.bar, self.pulse, ends, material(written)?)?;
        let spacings = refining("dx_m", &self.dx_m, |coarse, fine| coarse > fine)?;
        let halvings = self.halvings.unwrap_or(4);
        if !(2..=MAX_HALVINGS).contains(&halvings) {
            let message = format!("an order in Δt needs 2 to {MAX_HALVINGS} halvings, not {halvings}");
            return Err(Wrong::new("halvings", message, "leave it out for 4"));
        }
        if !(1..=MAX_LOOKS).contains(&self.looks) {
            let message = format!("{} looks at the bar are none or too many", self.looks);
            return Err(Wrong::new("looks", message, format!("take 1 to {MAX_LOOKS}")));
        }
        let lattices = self
            .lattice
            .marched(Body::Bar, spacings.len() + 1 + halvings as usize)
            .map_err(|wrong| wrong.inside("lattice"))?;
        let (duration, looks) = (self.duration_s.0, u64::from(self.looks));
        let safety = self.safety.map_or(0.8, |safety| safety.0);
        let mut refinements = Vec::new();
        for (&lattice, name) in lattices.iter().zip(names(&lattices)) {
            let coarsest = bar.steps(lattice, spacings[0], duration, safety, looks)? / looks;
            let steps = |spacing: f64| {
                ((coarsest as f64 * spacings[0] / spacing).round().max(1.0) as u64).saturating_mul(looks)
            };
            let march = |spacing, steps| bar.marched(lattice, spacing, duration, steps, looks);
            let second = spacings[1];
            refinements.push(Refinement {
                name,
                lattice,
                speed: Front::of(reference_lattice(lattice), None).map_or(f64::NAN, |front| front.speed),
                by_spacing: spacings
                    .iter()
                    .map(|&spacing| march(spacing, steps(spacing)))
                    .collect::<Result<_, _>>()?,
                by_time_step: (0..=halvings)
                    .map(|halving| march(second, steps(second).saturating_mul(1 << halving)))
                    .collect::<Result<_, _>>()?,
            });
        }
        Ok(Pulse { title: written.title.to_owned(), bar, looks: looks as usize, duration, refinements })
    }
}

impl Refinement {
    /// Whether long waves have the speed that they are meant to have.
    pub fn converges(&self) -> bool {
        (self.speed - 1.0).abs() < 1e-12
    }

    /// All marches but the one that stands in both lists.
    fn marches(&self) -> impl Iterator<Item = &Marched> {
        self.by_spacing.iter().chain(&self.by_time_step[1..])
    }
}

impl Question for Pulse {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let mut claims = vec![
            claim(place, "modes", "largest difference from the lattice's modes carried by leapfrog")
                .at_most(ErrorKind::MaxOfPeak, 1e-10)
                .because(Basis::Rounding, "leapfrog of a mode turns by (2/Δt) asin(ωΔt/2) exactly: only rounding is left, some 1e-16 a step")
                .source("modes sin((2n+1)πx/2L) of the mirrored lattice, frequencies in double-double arithmetic"),
            claim(place, "time_order", "order in Δt of the difference from the lattice in exact time, furthest of all lattices and norms")
                .order(2.0, 0.05)
                .because(Basis::Theory, "leapfrog's frequency is even in Δt, and so is its start from rest; 0.05 leaves room for the next power at the limit")
                .source("modes of the mirrored lattice in exact time"),
        ];
        let of = |norm: &str| {
            format!("order in δ at fixed m, error in {norm} of the displacement, furthest lattice")
        };
        if self.refinements.iter().any(Refinement::converges) {
            claims.extend(levels::NORMS.map(|norm| {
                claim(place, &format!("order_{norm}"), of(norm))
                    .order(2.0, 0.1)
                    .because(Basis::Theory, "long waves have the right speed, and the dispersion of lattice and leapfrog begins with (kΔx)²; 0.1 leaves room for the next power at the coarsest level")
                    .source("d'Alembert's solution by the method of images")
            }));
        }
        if !self.refinements.iter().all(Refinement::converges) {
            let quantity = "error at the finest level over that of a wave with the lattice's long-wave speed, less 1: furthest lattice and norm";
            claims.push(
                claim(place, "plateau", quantity)
                    .at_most(ErrorKind::Relative, 0.05)
                    .because(Basis::Theory, "refining at a fixed m does not change the lattice's modulus: the error tends to that of the wrong speed; 0.05 for the dispersion left at the finest level")
                    .source("d'Alembert's solution at the speed √(Σ w r²), the sum in double-double arithmetic"),
            );
        }
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.refinements.iter().flat_map(Refinement::marches).map(|march| march.plan.clone()).collect()
    }

    fn effort(&self) -> Effort {
        let of = |one: &Refinement| {
            let nodes = |marches: &[Marched]| marches.iter().map(|march| march.nodes() as u64).sum::<u64>();
            nodes(&one.by_spacing) + nodes(&one.by_time_step)
        };
        let reference = self.refinements.iter().map(of).sum();
        Effort { reference_evaluations: reference, ..Effort::of_scenes(&self.scenes()) }
    }

    fn equations(&self) -> &'static str {
        "ρü = E u'', u(0) = 0, u'(L) = 0, u(x, 0) = f(x) = exp(−((x − x₀)/w)²): u = ½[f(x − vt) + f(x + vt)], f odd about 0, even about L
lattice: (ωΔx/v)² = Σ w_r (2 − 2 cos rkΔx) = c²k²Δx² (1 − 2β(kΔx)² …), c² = Σ w_r r² = 1 where calibrated: error ~ (kδ)² vt k/m²
not calibrated: error of a wave of speed cv; leapfrog: ω' = (2/Δt) asin(ωΔt/2) = ω(1 + (ωΔt)²/24 …)"
    }

    fn foreign(&self) -> Vec<Box<dyn Foreign + '_>> {
        let exact = self.bar.exact;
        let spacings = self
            .refinements
            .first()
            .map(|one| one.by_spacing.iter().map(|level| level.scene.spacing).collect());
        let profile = ForeignBar {
            title: &self.title,
            quantity: Quantity::Displacement,
            along: Along::Place { t: self.duration, length: exact.length },
            exact: Box::new(move |x, t| HEIGHT * exact.displacement_at(x, t)),
            bound: None,
            problem: self.bar.problem(),
            source: "d'Alembert's solution by the method of images",
        };
        let convergence = foreign::Refinement {
            title: self.title.clone(),
            what: format!("the error of the displacement at t = {} s in L2 over all nodes, over the exact displacement in L2", self.duration),
            problem: self.bar.problem(),
            order: 2.0,
            within: 0.1,
            because: "long waves have the right speed, and the dispersion of every centred scheme begins with (kΔx)², at a fixed δ/Δx and vΔt/Δx; 0.1 leaves room for the next power at the coarsest level".into(),
            source: "d'Alembert's solution by the method of images".into(),
            floor: FLOOR,
            spacings: spacings.unwrap_or_default(),
        };
        vec![Box::new(profile), Box::new(convergence)]
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let seen: Vec<Result<Seen, String>> =
            self.refinements.par_iter().map(|one| self.follow(subject, one)).collect();
        let seen: Vec<Seen> = match seen.into_iter().collect() {
            Ok(seen) => seen,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        Answer {
            evidence: self.evidence(&seen),
            tables: pulse_report::tables(self, &seen, place),
            figures: pulse_report::figures(self, &seen, place),
            ..Answer::default()
        }
    }
}

/// Rows of displacements at the looks.
type Rows = Vec<Vec<f64>>;

impl Pulse {
    fn follow(&self, subject: &dyn Subject, one: &Refinement) -> Result<Seen, String> {
        let marches: Vec<&Marched> = one.marches().collect();
        let rows: Vec<Result<(Rows, f64), String>> = marches
            .par_iter()
            .map(|march| {
                let rows = march.march(subject, self.looks)?;
                let modes = self.modes(march, Some(march.courant)).ok_or("leapfrog is unstable")?;
                let far = rows.iter().flatten().zip(modes.iter().flatten()).map(|(a, b)| (a - b).abs());
                let far = largest(far).unwrap_or(f64::NAN);
                Ok((rows, far))
            })
            .collect();
        let rows: Vec<(Rows, f64)> = rows.into_iter().collect::<Result<_, _>>()?;
        let (by_spacing, halved) = rows.split_at(one.by_spacing.len());
        let exact_time = self.modes(&one.by_time_step[0], None).ok_or("the lattice has no modes")?;
        let in_space = one.by_spacing.iter().zip(by_spacing).map(|(march, (rows, _))| {
            let exact = self.exact(march, &self.bar.exact);
            (march.scene.spacing, relative(pairs(rows, &exact)))
        });
        let same = std::iter::once(&by_spacing[1]).chain(halved);
        let in_time = one.by_time_step.iter().zip(same);
        let in_time =
            in_time.map(|(march, (rows, _))| (march.plan.time_step_s, relative(pairs(rows, &exact_time))));
        let finest = &one.by_spacing[one.by_spacing.len() - 1];
        let wrong = PulseBar { speed: self.bar.exact.speed * one.speed, ..self.bar.exact };
        let (wrong, exact) = (self.exact(finest, &wrong), self.exact(finest, &self.bar.exact));
        Ok(Seen {
            by_spacing: Sequence { name: one.name.clone(), levels: in_space.collect() },
            by_time_step: Sequence { name: one.name.clone(), levels: in_time.collect() },
            predicted: relative(pairs(&wrong, &exact)),
            modes: largest(rows.iter().map(|(_, far)| *far)).unwrap_or(f64::NAN),
            last: by_spacing.iter().map(|(rows, _)| rows[self.looks - 1].clone()).collect(),
        })
    }

    /// d'Alembert's solution at the nodes of a march, look by look.
    fn exact(&self, march: &Marched, bar: &PulseBar) -> Rows {
        let at = |look: usize| {
            let time = self.duration * look as f64 / self.looks as f64;
            (0..march.nodes()).map(|j| bar.displacement_at(march.place(j), time)).collect()
        };
        (1..=self.looks).map(at).collect()
    }

    /// The lattice's own motion at the looks: carried by leapfrog, or in exact time.
    fn modes(&self, march: &Marched, courant: Option<f64>) -> Option<Rows> {
        let start = |j: usize| self.bar.exact.displacement_at(march.place(j), 0.0);
        let lattice = reference_lattice(march.scene.lattice);
        let modes = LatticeModes::of_displacement(lattice, march.nodes(), courant, start)?;
        let at = |look: usize| modes.displacements(march.cell_time(look, self.looks));
        Some((1..=self.looks).map(at).collect())
    }

    fn evidence(&self, seen: &[Seen]) -> Vec<(String, Evidence)> {
        let marched = format!("{} marches", self.scenes().len());
        let mut evidence =
            vec![("modes".into(), error_of(largest(seen.iter().map(|seen| seen.modes)), marched))];
        let norms = 0..levels::NORMS.len();
        let in_time =
            seen.iter().flat_map(|seen| norms.clone().map(|norm| seen.by_time_step.order(norm, 2.0, FLOOR)));
        evidence.extend(furthest(in_time, 0.05).map(|found| ("time_order".into(), found)));
        let both = || self.refinements.iter().zip(seen);
        for (norm, name) in levels::NORMS.iter().enumerate() {
            let converging = both().filter(|(one, _)| one.converges());
            let orders = converging.map(|(_, seen)| seen.by_spacing.order(norm, 2.0, FLOOR));
            evidence.extend(furthest(orders, 0.1).map(|found| (format!("order_{name}"), found)));
        }
        let plateaus = both().filter(|(one, _)| !one.converges()).flat_map(|(one, seen)| {
            let reached = seen.by_spacing.levels[seen.by_spacing.levels.len() - 1].1;
            norms.clone().map(move |norm| {
                let share = (reached[norm] / seen.predicted[norm] - 1.0).abs();
                let name = levels::NORMS[norm];
                error_of(Some(share), format!("{}: {:.4} in {name}", one.name, reached[norm]))
            })
        });
        evidence.extend(furthest(plateaus, 0.05).map(|found| ("plateau".into(), found)));
        evidence
    }
}

fn pairs<'a>(rows: &'a Rows, exact: &'a Rows) -> impl Iterator<Item = (f64, f64)> + 'a {
    rows.iter().flatten().copied().zip(exact.iter().flatten().copied())
}
