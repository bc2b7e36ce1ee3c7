//! What accuracy costs: a problem solved with every setting at every level; errors against updates, which are exact, and
//! against seconds, which are not.
//!
//! Nothing is claimed of seconds. What is claimed is what makes the errors those of the methods: that each march is the
//! lattice's own exact motion, and that errors fall with the work as theory says.

use super::problem::{Facts, Problem};
use super::runs::Solved;
use super::settings::{Setting, Track, named};
use super::work_precision_report as report;
use crate::dsif::tips::Tips;
use crate::levels::{furthest, order_of, tail_order};
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of};
use crate::rounded::rounded;
use crate::subject::Subject;
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::lattice::Lattice;
use pd_verify::scene::Wrong;
use pd_verify::verdict::Evidence;
use rayon::prelude::*;

/// The question.
pub struct WorkPrecision {
    pub title: String,
    pub facts: Facts,
    pub tracks: Vec<Track>,
    pub names: Vec<String>,
    /// Whether the long waves of a track's lattice have the intended speeds.
    right: Vec<bool>,
}

/// What one run showed, and how long it took.
pub struct Point {
    pub solved: Solved,
    /// In s, growing; none where runs are not timed.
    pub seconds: Vec<f64>,
    /// By `plan`, in s.
    pub predicted: Option<f64>,
}

/// By track and level.
pub type Points = Vec<Vec<Point>>;

/// Runs are repeated until a march has taken this long in all, three times at least.
const LONG_ENOUGH: f64 = 0.01;
const MOST_REPEATS: usize = 9;

/// Errors below it are rounding.
const FLOOR: f64 = 1e-9;

/// Errors of K from which on they must fall.
const SMALL: f64 = 1e-3;

/// How far the error of finite differences may be from 1 − (cΔt/Δx)², relative.
const LEAPFROG: f64 = 0.02;

impl WorkPrecision {
    /// Makes every run ready.
    pub fn new(
        title: &str,
        problem: &dyn Problem,
        settings: Vec<Setting>,
        spacings: &[f64],
    ) -> Result<Self, Wrong> {
        let facts = problem.facts();
        let names = named(&settings);
        let right = settings.iter().map(|setting| intended(setting.lattice, facts.dimension)).collect();
        let tracks = settings
            .into_iter()
            .map(|setting| problem.track(setting, spacings))
            .collect::<Result<_, Wrong>>()
            .map_err(|wrong| wrong.inside("settings"))?;
        Ok(Self { title: title.to_owned(), facts, tracks, names, right })
    }

    /// Index of a reading beside the claims it appears in.
    fn readings(&self) -> impl Iterator<Item = (usize, String)> + '_ {
        let of = |(index, name): (usize, &String)| {
            (index, if name.is_empty() { String::new() } else { format!("_{name}") })
        };
        self.facts.readings.iter().enumerate().map(of)
    }

    /// Tracks of finite differences, of which there are at least two time steps.
    fn leapfrogging(&self) -> Vec<usize> {
        let plain = |track: &usize| self.tracks[*track].setting.finite_differences;
        let all: Vec<usize> = (0..self.tracks.len()).filter(plain).collect();
        if self.facts.disperses && all.len() > 1 { all } else { Vec::new() }
    }

    /// (the spacing of as many node updates in a square, error) of a track's levels.
    fn by_work(&self, track: usize, points: &[Point], reading: usize) -> Vec<(f64, f64)> {
        let power = -1.0 / f64::from(self.facts.dimension + 1);
        let level = |(level, point): (usize, &Point)| {
            let run = &self.tracks[track].runs[level];
            let error = point.solved.errors[reading].unwrap_or(f64::NAN);
            ((run.plan().node_updates as f64).powf(power), error)
        };
        points.iter().enumerate().map(level).collect()
    }

    /// Solves everything, several runs at once, then times one march after the other.
    fn points(&self, subject: &dyn Subject) -> Result<Points, String> {
        let runs: Vec<_> = self.tracks.iter().flat_map(|track| &track.runs).collect();
        let tips = Tips::of(runs.iter().filter_map(|run| run.tip()), subject)?;
        let solved: Vec<Result<Solved, String>> =
            runs.par_iter().map(|run| run.solve(subject, &tips)).collect();
        let costs = subject.costs();
        let mut solved = solved.into_iter();
        let mut points = Vec::new();
        for track in &self.tracks {
            let mut levels = Vec::new();
            for run in &track.runs {
                let solved = solved.next().ok_or("a run was lost")??;
                let mut seconds = Vec::new();
                if costs.is_some() {
                    seconds = run.seconds(3)?;
                    let taken: f64 = seconds.iter().sum();
                    if taken < LONG_ENOUGH {
                        seconds.extend(run.seconds(MOST_REPEATS - seconds.len())?);
                    }
                    seconds.sort_by(f64::total_cmp);
                }
                let predicted = costs.and_then(|costs| costs.of_march(run.plan()));
                levels.push(Point { solved, seconds, predicted });
            }
            points.push(levels);
        }
        Ok(points)
    }

    fn evidence(&self, points: &Points) -> Vec<(String, Evidence)> {
        let mut evidence = Vec::new();
        if self.facts.own.is_some() {
            let own = points.iter().flatten().map(|point| point.solved.own.unwrap_or(f64::NAN));
            let runs = points.iter().map(Vec::len).sum::<usize>();
            evidence.push(("own".into(), error_of(largest(own), format!("{runs} runs"))));
        }
        if let Some(order) = &self.facts.order {
            for (reading, suffix) in self.readings() {
                let shows = |track: &usize| {
                    let first = self.tracks[*track].runs.first().map_or(f64::NAN, |run| run.spacing());
                    self.right[*track] && self.tracks[*track].setting.lattice.m * first <= order.widest
                };
                let orders = (0..self.tracks.len()).filter(shows).map(|track| {
                    let levels = self.by_work(track, &points[track], reading);
                    match order.steady {
                        true => tail_order(&self.names[track], &levels, order.expected, order.within, FLOOR),
                        false => order_of(&self.names[track], &levels, order.expected, FLOOR),
                    }
                });
                let found = furthest(orders, order.within);
                evidence.extend(found.map(|found| (format!("exponent{suffix}"), found)));
            }
        }
        for &reading in &self.facts.falling {
            evidence.push((format!("falls_{}", self.facts.readings[reading]), self.falls(reading, points)));
        }
        let plain = self.leapfrogging();
        if !plain.is_empty() {
            evidence.push(("leapfrog".into(), self.leapfrog(&plain, points)));
        }
        evidence
    }

    /// Levels at which the error of a reading rises above [`SMALL`], of all settings with the intended moduli.
    fn falls(&self, reading: usize, points: &Points) -> Evidence {
        let right = (0..self.tracks.len()).filter(|track| self.right[*track]);
        let (mut rising, mut where_, mut known) = (0, Vec::new(), true);
        for track in right {
            let errors: Option<Vec<f64>> =
                points[track].iter().map(|point| point.solved.errors[reading]).collect();
            let errors = errors.unwrap_or_default();
            known &= !errors.is_empty() && errors.iter().all(|error| error.is_finite());
            let here = errors.windows(2).filter(|pair| pair[1] >= pair[0].max(SMALL)).count();
            rising += here;
            where_.extend((here > 0).then(|| self.names[track].clone()));
        }
        let count = known.then_some(rising as f64);
        Evidence { computed: count, reference: Some(0.0), ..error_of(count, where_.join("; ")) }
    }

    /// How far errors of finite differences at the finest level are from being as 1 − (cΔt/Δx)².
    fn leapfrog(&self, plain: &[usize], points: &Points) -> Evidence {
        let over = |&track: &usize| {
            let (run, point) = self.tracks[track].runs.iter().zip(&points[track]).next_back()?;
            Some(point.solved.errors[0]? / (1.0 - run.courant() * run.courant()))
        };
        let all: Option<Vec<f64>> = plain.iter().map(over).collect();
        let far = all.and_then(|all| largest(all.iter().map(|one| (one / all[0] - 1.0).abs())));
        error_of(far, format!("{} time steps", plain.len()))
    }
}

/// Whether long waves have the speeds that they are meant to have.
fn intended(lattice: Lattice, dimension: u32) -> bool {
    use crate::convergence::space::{In, Space};
    match dimension {
        1 => <In as Space<1>>::intended(lattice),
        _ => <In as Space<2>>::intended(lattice),
    }
}

impl Question for WorkPrecision {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let what = &self.facts.what;
        let mut claims = Vec::new();
        if let Some(own) = &self.facts.own {
            claims.push(
                claim(
                    place,
                    "own",
                    format!("largest difference of {what} from the lattice's own exact answer"),
                )
                .at_most(ErrorKind::MaxOfPeak, own.at_most)
                .because(own.basis, own.because)
                .source("motion of the lattice by leapfrog, its sums in double-double arithmetic"),
            );
        }
        if let Some(order) = &self.facts.order {
            let power = self.facts.dimension + 1;
            claims.extend(self.readings().map(|(_, suffix)| {
                let from = match order.widest.is_finite() {
                    true => format!(" and horizons from {} m on", rounded(order.widest)),
                    false => String::new(),
                };
                let quantity = format!(
                    "order of the error of {what} in (node updates)^(−1/{power}), settings with the intended moduli{from}, the furthest"
                );
                claim(place, &format!("exponent{suffix}"), quantity)
                    .order(order.expected, order.within)
                    .because(Basis::Theory, order.because)
                    .source(self.facts.source)
            }));
        }
        for &reading in &self.facts.falling {
            let name = &self.facts.readings[reading];
            let quantity = format!(
                "levels at which the error of K by {name} rises above {SMALL}, settings with the intended moduli"
            );
            claims.push(
                claim(place, &format!("falls_{name}"), quantity)
                    .exactly()
                    .because(Basis::Theory, "with the intended moduli and the tip factor every part of the error falls with the horizon; parts of opposite sign may cancel on a coarse lattice, which a thousandth leaves room for")
                    .source(self.facts.source),
            );
        }
        if !self.leapfrogging().is_empty() {
            let quantity =
                "how far the errors of finite differences are from being as 1 − (cΔt/Δx)², finest level";
            claims.push(
                claim(place, "leapfrog", quantity)
                    .at_most(ErrorKind::Relative, LEAPFROG)
                    .because(Basis::Theory, "leapfrog advances waves by (ωΔt)²/24 where second differences delay them by (kΔx)²/24; a fiftieth for the next power")
                    .source("dispersion of the second difference with leapfrog, in closed form"),
            );
        }
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.tracks.iter().flat_map(|track| &track.runs).map(|run| run.plan().clone()).collect()
    }

    fn effort(&self) -> Effort {
        let mut total = Effort::default();
        self.tracks.iter().flat_map(|track| &track.runs).for_each(|run| total += run.effort());
        total
    }

    fn equations(&self) -> &'static str {
        self.facts.equations
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        match self.points(subject) {
            Err(failure) => Answer::failed(&self.claims(place), &failure),
            Ok(points) => Answer {
                evidence: self.evidence(&points),
                tables: report::tables(self, &points, place),
                figures: report::figures(self, &points, place),
                ..Answer::default()
            },
        }
    }
}
