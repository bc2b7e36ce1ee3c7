//! `asks = "release"`: a stretched bar is let go; strain and displacement at a place against the exact square wave, its
//! Fourier series, and the exact motion of the lattice itself.

use super::foreign::{Along, ForeignBar, Quantity};
use super::jump::{self, AWAY, JumpErrors};
use super::names::names;
use super::release_report;
use super::released::{BarAsked, LINE, POINT, Released, STRAIN, marching, planned, probes};
use crate::dispersion::sweep::LatticeSweep;
use crate::foreign::Foreign;
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of, value_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::record::Record;
use pd_verify::scene::{Positive, Scene, Wrong};
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReleaseAsked {
    pub bar: BarAsked,
    pub dx_m: Positive,
    pub duration_s: Positive,
    /// Refused above the lattice's limit. Default: `safety`.
    pub time_step_s: Option<Positive>,
    /// Largest time step over the limit; default 0.8.
    pub safety: Option<Positive>,
    /// Where strain and displacement are watched.
    pub probe_m: Positive,
    /// Terms of the Fourier series.
    pub fourier_terms: u32,
    pub lattice: LatticeSweep,
    /// Claims that (1/T)∫|ε − ε_exact|dt/ε₀ of every lattice is at most this.
    pub l1_at_most: Option<Positive>,
    /// Why: goes into the claim.
    pub because: Option<String>,
}

/// The case, checked.
pub struct Release {
    pub title: String,
    pub bar: Released,
    pub place: f64,
    duration: f64,
    pub terms: usize,
    pub scenes: Vec<(Scene<1>, Plan)>,
    pub labels: Vec<String>,
    bound: Option<(f64, String)>,
}

/// What one lattice did.
pub struct Seen {
    pub record: Record,
    pub errors: JumpErrors,
    /// Over that of the classical bar: as measured, and as the dispersion relation says.
    pub front_speed: Option<f64>,
    pub lattice_speed: Option<f64>,
    /// Largest displacement error against the lattice's own modes over the peak: as leapfrog carries them, in exact time.
    pub modes: Option<f64>,
    pub exact_time: Option<f64>,
}

/// Terms beyond which a Fourier series takes longer than the march.
const MAX_TERMS: u32 = 100_000;

impl Asked for ReleaseAsked {
    type Question = Release;

    fn check(&self, written: &Written<'_>) -> Result<Release, Wrong> {
        let bar = self.bar.check(written.material()?)?;
        if !(1..=MAX_TERMS).contains(&self.fourier_terms) {
            let message = format!("{} terms make no series", self.fourier_terms);
            return Err(Wrong::new("fourier_terms", message, format!("take 1 to {MAX_TERMS}")));
        }
        let marching = marching(self.duration_s, self.time_step_s, self.safety)?;
        let lattices = self.lattice.marched(Body::Bar, 2).map_err(|wrong| wrong.inside("lattice"))?;
        let place = self.probe_m.0;
        let mut scenes = Vec::new();
        for &lattice in &lattices {
            let scene = bar.scene(lattice, self.dx_m.0, marching, Vec::new())?;
            scenes.push(planned(scene, |steps| probes(place, steps))?);
        }
        let bound = self
            .l1_at_most
            .map(|bound| (bound.0, self.because.clone().unwrap_or_else(|| "asked for by the study".into())));
        let (labels, terms) = (names(&lattices), self.fourier_terms as usize);
        let duration = self.duration_s.0;
        Ok(Release { title: written.title.to_owned(), bar, place, duration, terms, scenes, labels, bound })
    }
}

impl Question for Release {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let mut claims = vec![
            claim(place, "modes", "largest displacement error against the lattice's modes carried by leapfrog")
                .at_most(ErrorKind::MaxOfPeak, 1e-10)
                .because(Basis::Rounding, "leapfrog of a mode turns by (2/Δt) asin(ωΔt/2) exactly: only rounding is left, some 1e-16 a step")
                .source("modes sin((2n+1)πx/2L) of the mirrored lattice, frequencies in double-double arithmetic"),
            claim(place, "fourier", "largest error of the Fourier series of the displacement, over its bound 2ε₀L/(π² terms)")
                .at_most(ErrorKind::Relative, 1.0)
                .because(Basis::Theory, "the terms left out are below Σ 2/((n + ½)π)², n ≥ terms")
                .source("Fourier series as printed, against d'Alembert's solution"),
            claim(place, "front_speed", "largest relative error of the front's speed")
                .at_most(ErrorKind::Relative, 1e-3)
                .because(Basis::Theory, "a third of a step has passed at x/c (Airy front); the first correction is made, the next falls with x^(-4/3)")
                .source("long-wave speed of the lattice's dispersion relation, leapfrog included"),
            claim(place, "overshoot", "overshoot behind the first front, furthest from that of an Airy front")
                .within(ErrorKind::Absolute, 0.02)
                .because(Basis::Theory, "the front of every dispersive lattice tends to ∫Ai, whose first swing passes the step by 27.4 %; 0.02 for fronts a few cells wide")
                .source("largest value of ∫ Ai is 1.2743 (Abramowitz & Stegun 10.4, first zero of Ai)"),
        ];
        if let Some((bound, why)) = &self.bound {
            let quantity = "largest (1/T)∫|ε − ε_exact|dt/ε₀";
            let claim = claim(place, "l1", quantity).at_most(ErrorKind::L1Relative, *bound);
            claims.push(claim.because(Basis::Engineering, why.clone()).source("d'Alembert's square wave"));
        }
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.scenes.iter().map(|(_, plan)| plan.clone()).collect()
    }

    fn effort(&self) -> Effort {
        let reference = 40 * self.scenes.iter().map(|(scene, _)| scene.nodes[0] as u64).sum::<u64>();
        Effort { reference_evaluations: reference, ..Effort::of_scenes(&self.scenes()) }
    }

    fn equations(&self) -> &'static str {
        "ρü = E u'', u(0) = 0, u'(L) = 0, u(x, 0) = F₀x/(EA): ε(x, t) = ½[s(x − vt) + s(x + vt)] F₀/(EA), s = 1 for |x| < L, −1 up to 3L, of period 4L
Fourier: ε = F₀/(EA) Σ (−1)ⁿ 4/(π(2n+1)) cos((2n+1)πx/2L) cos((2n+1)πvt/2L)
lattice, u odd about the fixed end and even about the free one: modes sin((2n+1)πx/2L), leapfrog (2/Δt) asin(ωΔt/2)
error: (1/T) ∫ |ε − ε_exact| dt / (F₀/EA)"
    }

    fn foreign(&self) -> Vec<Box<dyn Foreign + '_>> {
        let until = self.duration;
        let exact = self.bar.exact;
        let history = |quantity, exact: Box<dyn Fn(f64, f64) -> f64>| -> Box<dyn Foreign + '_> {
            Box::new(ForeignBar {
                title: &self.title,
                quantity,
                along: Along::Time { x: self.place, until },
                exact,
                bound: self.bound.clone(),
                problem: self.bar.problem(),
                source: "d'Alembert's solution: a square wave of strain, a triangle of displacement",
            })
        };
        let profile = ForeignBar {
            title: &self.title,
            quantity: Quantity::Displacement,
            along: Along::Place { t: until, length: exact.length },
            exact: Box::new(move |x, t| exact.displacement_at(x, t)),
            bound: None,
            problem: self.bar.problem(),
            source: "d'Alembert's solution",
        };
        vec![
            history(Quantity::Strain, Box::new(move |x, t| exact.strain_at(x, t))),
            history(Quantity::Displacement, Box::new(move |x, t| exact.displacement_at(x, t))),
            Box::new(profile),
        ]
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let seen: Vec<Result<Seen, String>> =
            self.scenes.par_iter().map(|(scene, plan)| self.follow(subject, scene, plan)).collect();
        let seen: Vec<Seen> = match seen.into_iter().collect() {
            Ok(seen) => seen,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        let curves = release_report::curves(self, &seen);
        Answer {
            evidence: self.evidence(subject, &seen),
            tables: release_report::tables(self, &seen, &curves, place),
            figures: release_report::figures(self, &seen, &curves, place),
            ..Answer::default()
        }
    }
}

impl Release {
    fn follow(&self, subject: &dyn Subject, scene: &Scene<1>, plan: &Plan) -> Result<Seen, String> {
        let record = subject.march_bar(scene).map_err(|failure| failure.to_string())?;
        let strain = record.trace(STRAIN).ok_or("no strain was recorded")?;
        let strains: Vec<f64> =
            strain.column(0).iter().map(|strain| strain / self.bar.exact.strain).collect();
        let courant = self.bar.courant(scene, plan);
        let front = jump::front(scene.lattice, courant);
        let width =
            |way: f64| front.map_or(scene.spacing, |front| front.width(way / scene.spacing) * scene.spacing);
        let errors = jump::errors(&self.bar, self.place, &strain.times, &strains, width);
        let speed = |front| {
            errors.arrival.map(|at| jump::front_speed(&self.bar, &front, scene.spacing, self.place, at))
        };
        Ok(Seen {
            front_speed: front.and_then(speed),
            lattice_speed: front.map(|front| front.speed),
            modes: self.against_modes(scene, &record, Some(courant)),
            exact_time: self.against_modes(scene, &record, None),
            errors,
            record,
        })
    }

    /// Largest error of the whole bar against the lattice's modes, over the peak.
    fn against_modes(&self, scene: &Scene<1>, record: &Record, courant: Option<f64>) -> Option<f64> {
        let modes = self.bar.modes(scene, courant)?;
        let trace = record.trace(LINE)?;
        let at = |(&t, row): (&f64, &Vec<f64>)| {
            let exact = modes.displacements(self.bar.cell_times(scene, t));
            largest(row.iter().zip(exact).map(|(u, exact)| (u / self.bar.peak() - exact).abs()))
        };
        largest(trace.times.iter().zip(&trace.rows).map(|row| at(row).unwrap_or(f64::NAN)))
    }

    fn evidence(&self, subject: &dyn Subject, seen: &[Seen]) -> Vec<(String, Evidence)> {
        let worst = |of: &dyn Fn(&Seen) -> Option<f64>| {
            seen.iter().map(of).collect::<Option<Vec<f64>>>().and_then(largest)
        };
        let speed = worst(&|seen| Some((seen.front_speed? / seen.lattice_speed? - 1.0).abs()));
        let overshoots: Option<Vec<f64>> = seen.iter().map(|seen| seen.errors.overshoot).collect();
        let far = |overshoot: &f64| (overshoot - AIRY_OVERSHOOT).abs();
        let furthest = overshoots.and_then(|all| all.into_iter().max_by(|a, b| far(a).total_cmp(&far(b))));
        let count = format!("{} lattices", seen.len());
        let exact_time = worst(&|seen| seen.exact_time);
        let note =
            exact_time.map_or(String::new(), |error| format!("{error:.2e} against modes in exact time"));
        let mut evidence = vec![
            ("modes".into(), error_of(worst(&|seen| seen.modes), note)),
            ("fourier".into(), error_of(self.fourier_error(subject, seen), format!("{} terms", self.terms))),
            ("front_speed".into(), self.of_fronts(error_of(speed, count.clone()))),
            ("overshoot".into(), self.of_fronts(value_of(furthest, Some(AIRY_OVERSHOOT), count))),
        ];
        if self.bound.is_some() {
            let l1 = worst(&|seen| Some(seen.errors.l1));
            evidence.push(("l1".into(), error_of(l1, format!("{} steps", self.scenes[0].1.steps))));
        }
        evidence
    }

    /// Evidence that rests on the shape of a front by itself: away from both ends of the bar.
    fn of_fronts(&self, evidence: Evidence) -> Evidence {
        let away = self.place.min(self.bar.exact.length - self.place);
        let near = |(scene, plan): &(Scene<1>, Plan)| {
            let front = jump::front(scene.lattice, self.bar.courant(scene, plan));
            let way = (self.bar.exact.length - self.place) / scene.spacing;
            front.is_none_or(|front| away < AWAY * front.width(way) * scene.spacing)
        };
        if !self.scenes.iter().any(near) {
            return evidence;
        }
        let words = format!(
            "a front is seen by itself {AWAY} of its widths away from both ends only, and the probe is nearer"
        );
        Evidence { outside: Some(words), ..evidence }
    }

    /// The series against d'Alembert at the times of the line probe, over the bound of what is left out.
    fn fourier_error(&self, subject: &dyn Subject, seen: &[Seen]) -> Option<f64> {
        let times = &seen.first()?.record.trace(POINT)?.times;
        let bar = &self.bar.exact;
        let bound = 2.0 * bar.strain * bar.length / (std::f64::consts::PI.powi(2) * self.terms as f64);
        let error = |t: &f64| {
            let series = subject.released_series(bar, self.place, *t, self.terms);
            (series - bar.displacement_at(self.place, *t)).abs() / bound
        };
        largest(times.iter().step_by((times.len() / 400).max(1)).map(error))
    }
}

/// The largest value of ∫_z^∞ Ai, less 1: at the first zero of Ai, z = −2.33811.
pub const AIRY_OVERSHOOT: f64 = 0.274_352_059_137_675_4;
