//! A problem solved level by level: errors in three norms, the order at which they fall, the plateau that wrong moduli
//! leave, and the lattice's own answer. Every question of this kind that has an exact answer is asked here.

use super::path::{Refine, Sequence};
use super::refined_report as report;
use super::space::{In, Space};
use super::theory::{self, Expected};
use crate::bar::names;
use crate::foreign::{Foreign, Refinement};
use crate::levels::{self, Errors, NORMS, furthest, tail_order};
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of};
use crate::subject::Subject;
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::scene::Wrong;
use pd_verify::verdict::Evidence;
use pd_verify_reference::medium::Medium;
use rayon::prelude::*;

/// A bound with its reason.
pub struct Bound {
    pub at_most: f64,
    pub basis: Basis,
    pub because: &'static str,
}

/// What was found at one level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solved {
    /// Relative to the exact field, in each norm.
    pub errors: Errors,
    /// Largest difference from the lattice's own exact answer over the largest displacement, where it has one.
    pub own: Option<f64>,
}

/// The order of convergence with the intended moduli, and why.
pub struct Order {
    pub expected: f64,
    pub because: &'static str,
}

/// Bonds are symmetric and nothing is cut: only even powers of δ.
pub const SECOND: Order = Order {
    expected: 2.0,
    because: "with the intended moduli the error of a lattice begins with (kδ)²: bonds are symmetric, so that only even powers occur; 0.1 leaves room for the next power",
};

/// A problem with an exact answer in any medium.
pub trait Problem<const D: usize>: Send + Sync {
    /// One level made ready.
    type Level: Send + Sync;

    /// What is refined, for claims and captions: "the displacement of …".
    fn what(&self) -> String;
    fn equations(&self) -> &'static str;
    /// Where the exact answer comes from.
    fn source(&self) -> &'static str;
    /// The order with the intended moduli.
    fn order(&self) -> Order {
        SECOND
    }
    /// Whether the lattice has an exact answer of its own.
    fn has_own(&self) -> bool {
        true
    }
    /// What rounding may leave; errors below ten times it carry no order.
    fn rounding(&self) -> Bound;
    /// Whether [`Problem::between`] is known.
    fn predicts_plateaus(&self) -> bool {
        true
    }
    fn plan(&self, level: &Self::Level) -> Planned;
    fn effort(&self, level: &Self::Level) -> Effort;
    /// Solves one level and compares it with the exact answer in `medium`.
    fn solve(&self, subject: &dyn Subject, level: &Self::Level, medium: &Medium) -> Result<Solved, String>;
    /// Errors of the exact answer in one medium against that in another, at the nodes of a level.
    fn between(&self, level: &Self::Level, wrong: &Medium, right: &Medium) -> Option<Errors>;
    /// The problem in words, neutral of any solver; none where other codes' errors are not judged.
    fn problem(&self) -> Option<Vec<(&'static str, String)>> {
        None
    }
    /// Fields of other codes that can be judged.
    fn fields(&self) -> Vec<Box<dyn Foreign + '_>> {
        Vec::new()
    }
}

/// A problem along one refinement.
pub struct Track<L> {
    pub name: String,
    pub sequence: Sequence,
    /// From coarse to fine.
    pub levels: Vec<L>,
    /// Whether long waves have the speeds that they are meant to have at every level.
    pub right_moduli: bool,
}

/// A problem along several refinements.
pub struct Refined<const D: usize, P: Problem<D>> {
    pub title: String,
    pub problem: P,
    pub tracks: Vec<Track<P::Level>>,
}

/// What one refinement showed.
pub struct Seen {
    pub levels: levels::Sequence,
    /// Largest difference from the lattice's own answer.
    pub own: Option<f64>,
    /// Errors that the lattice's moduli alone leave at the finest level.
    pub plateau: Option<Errors>,
}

impl<const D: usize, P: Problem<D>> Refined<D, P>
where
    In: Space<D>,
{
    /// Makes every level ready.
    pub fn new(
        title: &str,
        problem: P,
        sequences: Vec<Sequence>,
        ready: impl Fn(&P, &Sequence) -> Result<Vec<P::Level>, Wrong>,
    ) -> Result<Self, Wrong> {
        let finest: Vec<_> = sequences.iter().map(|one| one.lattice(one.finest())).collect();
        let mut tracks = Vec::new();
        for (sequence, name) in sequences.into_iter().zip(names::names(&finest)) {
            for level in &sequence.levels {
                In::reach(sequence.lattice(*level))
                    .map_err(|unusable| Wrong::new("path.m", unusable.to_string(), unusable.cure()))?;
            }
            let levels = ready(&problem, &sequence)?;
            let right_moduli = sequence.levels.iter().all(|level| In::intended(sequence.lattice(*level)));
            let name = if sequence.refine == Refine::Delta { name } else { without_m(&name) };
            let track = Track { name, sequence, levels, right_moduli };
            if track.stops() && !problem.predicts_plateaus() {
                let message = format!(
                    "{}: its moduli are not the intended ones, so that its error does not fall",
                    track.name
                );
                return Err(Wrong::new("weights.calibrated", message, "take calibrated = true"));
            }
            tracks.push(track);
        }
        Ok(Self { title: title.to_owned(), problem, tracks })
    }

    /// Rounding: errors below it carry no order.
    pub fn floor(&self) -> f64 {
        10.0 * self.problem.rounding().at_most
    }

    fn follow(&self, subject: &dyn Subject, track: &Track<P::Level>) -> Result<Seen, String> {
        let sequence = &track.sequence;
        let right = match sequence.horizon() {
            None => Medium::Local,
            Some(horizon) => Medium::Nonlocal {
                kernel: crate::dispersion::curve::reference_kernel(sequence.weights.kernel),
                horizon,
            },
        };
        let solved: Vec<Result<Solved, String>> =
            track.levels.par_iter().map(|level| self.problem.solve(subject, level, &right)).collect();
        let solved: Vec<Solved> = solved.into_iter().collect::<Result<_, _>>()?;
        let steps = sequence.levels.iter().map(|level| sequence.step(*level));
        let finest = track.levels.last().ok_or("there are no levels")?;
        let wrong = In::moduli(sequence.lattice(sequence.finest()));
        Ok(Seen {
            levels: levels::Sequence {
                name: track.name.clone(),
                levels: steps.zip(solved.iter().map(|solved| solved.errors)).collect(),
            },
            own: largest(solved.iter().map(|solved| solved.own.unwrap_or(f64::NAN))),
            plateau: track.stops().then(|| self.problem.between(finest, &wrong, &right)).flatten(),
        })
    }
}

/// Names without m, which grows along the path.
fn without_m(name: &str) -> String {
    name.split(", ").filter(|part| !part.starts_with("m = ")).collect::<Vec<_>>().join(", ")
}

/// How far an order may be from the expected one.
const WITHIN: f64 = 0.1;
/// How far a plateau may be from the predicted one, relative.
const PLATEAU: f64 = 0.05;
/// Index of L2 in [`NORMS`].
const L2: usize = 1;

impl<L> Track<L> {
    /// Refined at fixed m with other moduli than intended: it stops converging.
    pub fn stops(&self) -> bool {
        self.sequence.refine == Refine::Delta && !self.right_moduli
    }

    /// Refined at fixed m, or along a path, with the intended moduli.
    pub fn converges(&self) -> bool {
        self.sequence.refine != Refine::M && self.right_moduli
    }

    /// What theory says of the others.
    pub fn expected<const D: usize>(&self) -> Expected {
        theory::expected::<D>(&self.sequence)
    }

    /// Claimed by itself, under its own name.
    pub fn alone(&self) -> bool {
        !self.converges() && !self.stops()
    }
}

impl<const D: usize, P: Problem<D>> Question for Refined<D, P>
where
    In: Space<D>,
{
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let what = self.problem.what();
        let source = self.problem.source();
        let mut claims = Vec::new();
        if self.problem.has_own() {
            let rounding = self.problem.rounding();
            claims.push(
                claim(
                    place,
                    "own",
                    format!("largest difference of {what} from the lattice's own exact answer"),
                )
                .at_most(ErrorKind::MaxOfPeak, rounding.at_most)
                .because(rounding.basis, rounding.because)
                .source("waves of the lattice, its sums in double-double arithmetic"),
            );
        }
        let Order { expected, because } = self.problem.order();
        if self.tracks.iter().any(Track::converges) {
            claims.extend(NORMS.map(|norm| {
                let quantity = format!("order in δ of the error in {norm} of {what}, furthest lattice");
                claim(place, &format!("order_{norm}"), quantity)
                    .order(expected, WITHIN)
                    .because(Basis::Theory, because)
                    .source(source)
            }));
        }
        if self.tracks.iter().any(Track::stops) {
            let quantity = format!(
                "level at which the error in l2 of {what} stops, over that of an exact body with the lattice's moduli, less 1: furthest lattice"
            );
            claims.push(
                claim(place, "plateau", quantity)
                    .at_most(ErrorKind::Relative, PLATEAU)
                    .because(Basis::Theory, "refining at a fixed m does not change the lattice's moduli: the error tends to that of a body with these, by even powers of δ; its square, a parabola in δ², is extrapolated from the three finest levels; 0.05 for the next power")
                    .source("local elasticity with the lattice's moduli, summed in double-double arithmetic"),
            );
        }
        for track in self.tracks.iter().filter(|track| track.alone()) {
            claims.push(theory::claim_of::<D>(place, &track.sequence, &track.name, &what, source));
        }
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.levels().map(|level| self.problem.plan(level)).collect()
    }

    fn effort(&self) -> Effort {
        let mut total = Effort::default();
        self.levels().for_each(|level| total += self.problem.effort(level));
        total
    }

    fn equations(&self) -> &'static str {
        self.problem.equations()
    }

    fn foreign(&self) -> Vec<Box<dyn Foreign + '_>> {
        let mut all = self.problem.fields();
        let converging = self.tracks.iter().find(|track| track.converges());
        if let Some((problem, track)) = self.problem.problem().zip(converging) {
            let Order { expected, because } = self.problem.order();
            all.push(Box::new(Refinement {
                title: self.title.clone(),
                what: format!(
                    "the error in L2 of {} over that of the exact one, at a fixed δ/Δx",
                    self.problem.what()
                ),
                problem,
                order: expected,
                within: WITHIN,
                because: because.to_owned(),
                source: self.problem.source().to_owned(),
                floor: self.floor(),
                spacings: track.sequence.levels.iter().map(|level| level.spacing).collect(),
            }));
        }
        all
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let seen: Vec<Result<Seen, String>> =
            self.tracks.par_iter().map(|track| self.follow(subject, track)).collect();
        let seen: Vec<Seen> = match seen.into_iter().collect() {
            Ok(seen) => seen,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        Answer {
            evidence: self.evidence(&seen),
            tables: vec![report::table(&self.tracks, &seen, place)],
            figures: report::figures(self, &seen, place),
            ..Answer::default()
        }
    }
}

impl<const D: usize, P: Problem<D>> Refined<D, P>
where
    In: Space<D>,
{
    fn levels(&self) -> impl Iterator<Item = &P::Level> {
        self.tracks.iter().flat_map(|track| &track.levels)
    }

    fn evidence(&self, seen: &[Seen]) -> Vec<(String, Evidence)> {
        let floor = self.floor();
        let both = || self.tracks.iter().zip(seen);
        let solved = format!("{} levels", self.levels().count());
        let mut evidence = Vec::new();
        if self.problem.has_own() {
            evidence.push((
                "own".into(),
                error_of(largest(seen.iter().map(|seen| seen.own.unwrap_or(f64::NAN))), solved),
            ));
        }
        let expected = self.problem.order().expected;
        for (norm, name) in NORMS.iter().enumerate() {
            let converging = both().filter(|(track, _)| track.converges());
            let orders = converging.map(|(track, seen)| {
                tail_order(&track.name, &seen.levels.in_norm(norm), expected, WITHIN, floor)
            });
            evidence.extend(furthest(orders, WITHIN).map(|found| (format!("order_{name}"), found)));
        }
        let stopped = both().filter(|(track, _)| track.stops());
        let plateaus = stopped.map(|(track, seen)| plateau(track, seen));
        evidence.extend(furthest(plateaus, PLATEAU).map(|found| ("plateau".into(), found)));
        for (track, seen) in both().filter(|(track, _)| track.alone()) {
            let found = theory::evidence_of(&track.expected::<D>(), &track.name, &seen.levels, floor);
            evidence.push((theory::name_of(&track.sequence), found));
        }
        evidence
    }
}

/// The level that the error tends to, over what the moduli predict; inconclusive where it is still far from there.
fn plateau<L>(track: &Track<L>, seen: &Seen) -> Evidence {
    let errors = seen.levels.in_norm(L2);
    let (Some(limit), Some((_, last))) = (limit(&errors), errors.last()) else { return Evidence::default() };
    let predicted = seen.plateau.map(|errors| errors[L2]);
    let share = predicted.map(|predicted| (limit / predicted - 1.0).abs());
    let far = (limit - last).abs() > 0.5 * limit.abs();
    let expected = predicted.unwrap_or(f64::NAN);
    Evidence {
        outside: far.then(|| {
            format!("{}: {last:.2e} is still far from its plateau {limit:.2e}, take finer levels", track.name)
        }),
        ..error_of(
            share,
            format!("{}: {limit:.4e} against {expected:.4e}, {last:.4e} at the finest level", track.name),
        )
    }
}

/// What an error in L2 tends to: e² = |a + b δ² + …|², a parabola in δ², through the three finest levels. (The norm alone
/// has no sign: where a and bδ² are opposed it falls and rises again.)
fn limit(errors: &[(f64, f64)]) -> Option<f64> {
    let [.., coarse, middle, fine] = errors else { return None };
    let points = [coarse, middle, fine].map(|(h, error)| (h * h, error * error));
    let share = |index: usize| {
        let others = points.iter().enumerate().filter(|(other, _)| *other != index);
        others.map(|(_, (x, _))| x / (x - points[index].0)).product::<f64>()
    };
    let square: f64 = (0..3).map(|index| share(index) * points[index].1).sum();
    Some(square.sqrt()).filter(|limit| limit.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plateau_is_found_through_a_change_of_sign() {
        let errors = [0.4, 0.2, 0.1].map(|h: f64| (h, (0.02 - 0.5 * h * h).abs()));
        assert!((limit(&errors).unwrap() - 0.02).abs() < 1e-15);
        assert_eq!(limit(&errors[1..]), None);
        assert_eq!(limit(&[(4.0, 1.0), (2.0, f64::NAN), (1.0, 1.0)]), None);
    }
}
