//! `asks = "volume_rules"`: how ω² of a plane wave nears the nonlocal continuum's as m grows through every whole number,
//! by volume rule. What is regular in it has an order; what comes from nodes that enter and leave the rim has none.

use super::path::{Weights, WeightsAsked};
use super::theory;
use super::volume_rules_report as report;
use crate::bar::names;
use crate::dispersion::curve::{Curve, Medium, reference_kernel, reference_lattice, reference_rule};
use crate::dispersion::words::{BodyName, BranchName};
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of, value_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::compare::order::{fitted, pairwise};
use pd_verify::dispersion::Branch;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::{Positive, Wrong};
use pd_verify::verdict::Evidence;
use pd_verify_reference::{self as reference, continuum, lattice_points};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VolumeRulesAsked {
    pub body: BodyName,
    /// First and last m; every whole number between is run.
    pub m: [u32; 2],
    pub k_horizon: Positive,
    /// Direction of travel from the x axis; default 0.
    pub angle_deg: Option<f64>,
    pub branch: BranchName,
    pub weights: WeightsAsked,
}

/// The case, checked.
pub struct VolumeRules {
    pub title: String,
    pub body: Body,
    pub m: Vec<f64>,
    pub k_horizon: f64,
    pub degrees: f64,
    pub branch: Branch,
    pub weights: Vec<Weights>,
}

/// The errors of one family of weights.
pub struct Seen {
    /// (m, ω²(lattice)/ω²(continuum) − 1).
    pub errors: Vec<(f64, f64)>,
    /// By theory, at the same m: the smooth part, and what is irregular.
    pub smooth: Option<Vec<f64>>,
    pub irregular: Option<Vec<f64>>,
    /// Whether the smooth part makes half of the error of the reference's lattice at the smallest m.
    asymptotic: bool,
}

/// Largest m that is run.
const LARGEST: u32 = 80;
/// The law is for large m; it holds from here on.
const SMALLEST: u32 = 8;
/// |e − law| m^(5/2) is below it for kernels that jump at δ, kδ up to [`LONGEST`]: twice what was measured.
const LEFT_OVER: f64 = 0.9;
const LONGEST: f64 = 3.0;

impl Asked for VolumeRulesAsked {
    type Question = VolumeRules;

    fn check(&self, written: &Written<'_>) -> Result<VolumeRules, Wrong> {
        let body = Body::from(self.body);
        if body == Body::Bar {
            let help = "take plane_stress or plane_strain; \"m_convergence\" in a study of kind = \"dispersion\" asks this of a bar";
            return Err(Wrong::new("body", "a bar has no rim to be irregular", help));
        }
        let [first, last] = self.m;
        if first < SMALLEST || first > last / 8 || last > LARGEST {
            let message = format!("m from {first} to {last} shows no law of large m");
            let help = format!(
                "take m = [first, last], from {SMALLEST} or more to {LARGEST} or less, 8 apart or more"
            );
            return Err(Wrong::new("m", message, help));
        }
        let degrees = self.angle_deg.unwrap_or(0.0);
        if !degrees.is_finite() {
            return Err(Wrong::new("angle_deg", "an angle must be finite", "give a number of degrees"));
        }
        if self.k_horizon.0 > LONGEST {
            let message = format!("kδ = {} is beyond what the law was tested for", self.k_horizon.0);
            return Err(Wrong::new("k_horizon", message, format!("take at most {LONGEST}")));
        }
        let weights = self.weights.all().map_err(|wrong| wrong.inside("weights"))?;
        if let Some(without) = weights.iter().find(|weights| !theory::has_rim(weights.kernel)) {
            let share = without.kernel.weight(1.0);
            let message = format!(
                "{} weighs {share:.3} at δ of what it weighs at 0: no rim to speak of, and the law of large m shows late",
                without.kernel
            );
            let help = "take constant, or gaussian or exponential with p up to 1";
            return Err(Wrong::new("weights.kernel", message, help));
        }
        Ok(VolumeRules {
            title: written.title.to_owned(),
            body,
            m: (first..=last).map(f64::from).collect(),
            k_horizon: self.k_horizon.0,
            degrees,
            branch: self.branch.into(),
            weights,
        })
    }
}

/// What is claimed of a family of weights beside its bound.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Trend {
    /// Regular: order 2.
    Second,
    /// Between a rim counted whole and Gauss's circle.
    Rim,
    /// Two parts of like size: no claim.
    Mixed,
}

fn trend(weights: Weights) -> Trend {
    match (weights.volume_rule, weights.calibrated) {
        (VolumeRule::Full, _) => Trend::Rim,
        (VolumeRule::Linear, _) => Trend::Mixed,
        _ => Trend::Second,
    }
}

/// Whether the whole law is known, irregular part and all.
fn has_law(weights: Weights) -> bool {
    match weights.volume_rule {
        VolumeRule::Full => false,
        VolumeRule::Linear => !weights.calibrated,
        VolumeRule::ExactArea => true,
    }
}

impl Question for VolumeRules {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let mut claims = Vec::new();
        let poisson =
            "Poisson's summation formula over the reciprocal lattice; Hardy, Quart. J. Math. 46 (1915) 263";
        for (weights, name) in self.weights.iter().zip(self.names()) {
            let of = |what: &str, quantity: String| {
                claim(place, &format!("{}_{what}", weights.slug()), format!("{quantity}: {name}"))
                    .source(poisson)
            };
            if has_law(*weights) {
                claims.push(
                    of("law", "largest m^(5/2) times what the law of large m leaves of the error of ω²".into())
                        .at_most(ErrorKind::Absolute, LEFT_OVER)
                        .because(Basis::Measured, "the next terms of the law are of m^(−5/2); their largest factor for the constant kernel and Gaussian and exponential ones of p = 1, both branches, m = 8 to 77 and kδ up to 3, is 0.46; twice that"),
                );
            }
            match trend(*weights) {
                Trend::Second => claims.push(
                    of("order", "order in 1/m of the error of ω², over every whole m".into())
                        .order(2.0, 0.25)
                        .because(Basis::Theory, "a cell cut by the rim errs by its slope, a bond by the curvature in its cell: m^(−2); 0.25 because the next term is only m^(1/2) smaller"),
                ),
                Trend::Rim => {
                    claims.push(
                        of("trend", "slope in 1/m of the root mean square error of ω² over octaves of m".into())
                            .order(1.25, 0.35)
                            .because(Basis::Theory, "the count of nodes in a disc errs like m^(−3/2) of it (Gauss's circle problem), a rim of ties counted whole like m^(−1): the slope lies between, 0.1 beyond for chance"),
                    );
                    claims.push(scattered(of("scatter", "largest less smallest order from m to 2m".into())));
                }
                Trend::Mixed => {
                    claims.push(scattered(of("scatter", "largest less smallest order from m to 2m".into())));
                }
            }
        }
        claims
    }

    fn effort(&self) -> Effort {
        let bonds: f64 = self.m.iter().map(|m| 1.6 * (m + 1.0) * (m + 1.0)).sum();
        let count = self.weights.len() as u64;
        Effort {
            curves: count,
            evaluations: count * self.m.len() as u64,
            bond_evaluations: count * bonds as u64,
            reference_evaluations: 2 * count * self.m.len() as u64,
            ..Effort::default()
        }
    }

    fn equations(&self) -> &'static str {
        "e(m) = ω²(lattice, kδ, m)/ω²(continuum, kδ) − 1; F(s) = W(s) ∮ q(θ)(1 − cos(kδ s cos θ)) dθ, I = ∫₀¹ F ds
linear: e = F'(1)/(24 I m²) + waves of the rim m^(−3/2) sin(π|g|)/(π|g|); exact_area: e = (F'(1) − F(1))/(24 I m²) + O(m^(−5/2))
full: waves of the rim m^(−3/2) from every reciprocal vector g, and ties |r| = m: no order"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let seen: Vec<Result<Seen, String>> =
            self.weights.par_iter().map(|weights| self.look(subject, *weights)).collect();
        let seen: Vec<Seen> = match seen.into_iter().collect() {
            Ok(seen) => seen,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        let mut answer = Answer::default();
        for (weights, seen) in self.weights.iter().zip(&seen) {
            let mut push = |what: &str, evidence| {
                answer.evidence.push((format!("{}_{what}", weights.slug()), evidence));
            };
            if has_law(*weights) {
                push("law", seen.law());
            }
            match trend(*weights) {
                Trend::Second => push("order", seen.regular(seen.slope(2.0))),
                Trend::Rim => {
                    push("trend", seen.octaves(1.25));
                    push("scatter", seen.scatter());
                }
                Trend::Mixed => push("scatter", seen.scatter()),
            }
        }
        answer.tables.push(report::table(self, &seen, place));
        answer.figures.push(report::figure(self, &seen, place));
        answer
    }
}

/// The claim that there is no order.
fn scattered(claim: Claim) -> Claim {
    claim.at_least(1.0).because(
        Basis::Theory,
        "nodes enter and leave the rim by the dozen from m to m + 1: waves in m whose sign changes make a single pair of levels say anything; 1 is half of the order that one would like to read",
    )
}

impl Seen {
    fn law(&self) -> Evidence {
        let left = |(index, (m, error)): (usize, &(f64, f64))| {
            let smooth = self.smooth.as_ref().map_or(f64::NAN, |smooth| smooth[index]);
            let irregular = self.irregular.as_ref().map_or(0.0, |irregular| irregular[index]);
            (error - smooth - irregular).abs() * m.powf(2.5)
        };
        let most = largest(self.errors.iter().enumerate().map(left));
        error_of(most, format!("{} values of m", self.errors.len()))
    }

    /// The slope of log |e| over log 1/m over all m.
    fn slope(&self, expected: f64) -> Evidence {
        let levels: Vec<(f64, f64)> = self.errors.iter().map(|(m, error)| (1.0 / m, error.abs())).collect();
        let order = fitted(&levels).filter(|_| levels.iter().all(|level| level.1.is_finite()));
        let found = order.map(|order| order.value);
        Evidence { order, ..value_of(found, Some(expected), format!("{} values of m", levels.len())) }
    }

    /// The slope of the root mean square of e over octaves of m: errors that change sign have no logarithm each.
    fn octaves(&self, expected: f64) -> Evidence {
        let first = self.errors.first().map_or(f64::NAN, |(m, _)| *m);
        let mut levels = Vec::new();
        let mut from = first;
        while self.errors.last().is_some_and(|(m, _)| 2.0 * from <= *m) {
            let inside = self.errors.iter().filter(|(m, _)| (from..2.0 * from).contains(m));
            let (count, sum) =
                inside.fold((0.0, 0.0), |(count, sum), (_, error)| (count + 1.0, sum + error * error));
            levels.push((1.0 / from, (sum / count).sqrt()));
            from *= 2.0;
        }
        let order = fitted(&levels).filter(|order| order.levels >= 3);
        let note = format!("root mean squares over {} octaves of m", levels.len());
        Evidence { order, ..value_of(order.map(|order| order.value), Some(expected), note) }
    }

    /// The same evidence, inconclusive where the smooth part of the law does not yet make the error.
    fn regular(&self, found: Evidence) -> Evidence {
        let reason =
            "not asymptotic: the smooth part does not make the error yet; take another kδ or larger m";
        Evidence { outside: (!self.asymptotic).then(|| reason.to_owned()), ..found }
    }

    /// How far apart the orders from m to 2m are.
    fn scatter(&self) -> Evidence {
        let at = |m: f64| {
            self.errors.iter().find(|(other, _)| *other == m).map(|(m, error)| (1.0 / m, error.abs()))
        };
        let orders: Vec<f64> =
            self.errors.iter().filter_map(|(m, _)| pairwise(at(*m)?, at(2.0 * m)?)).collect();
        if self.errors.iter().any(|(_, error)| !error.is_finite()) {
            return error_of(None, "an error is not finite");
        }
        let least = orders.iter().copied().fold(f64::INFINITY, f64::min);
        let most = orders.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let note = format!("{} doublings of m, orders from {least:.2} to {most:.2}", orders.len());
        Evidence { computed: (orders.len() > 1).then_some(most - least), note, ..Evidence::default() }
    }
}

impl VolumeRules {
    /// Of the weights.
    pub fn names(&self) -> Vec<String> {
        let lattices: Vec<Lattice> = self.weights.iter().map(|weights| weights.lattice(self.m[0])).collect();
        names::names(&lattices)
    }

    fn look(&self, subject: &dyn Subject, weights: Weights) -> Result<Seen, String> {
        let kernel = reference_kernel(weights.kernel);
        let branch = if self.branch == Branch::P { reference::Branch::P } else { reference::Branch::S };
        let exact = continuum::plane(kernel, branch, self.k_horizon);
        let exact = exact.ok_or("the continuum has no such wave")?.omega.powi(2);
        let error = |m: &f64| -> Result<(f64, f64), String> {
            let curve = Curve {
                body: self.body,
                medium: Medium::Lattice { lattice: weights.lattice(*m), dx: 1.0 / m },
                courant: None,
                branch: self.branch,
                degrees: self.degrees,
            };
            let prepared = curve.prepare(subject).map_err(|unusable| unusable.to_string())?;
            let omega = prepared.wave(self.k_horizon).ok_or("the lattice carries no such wave")?.omega;
            Ok((*m, omega * omega / exact - 1.0))
        };
        let errors =
            self.m.par_iter().map(error).collect::<Vec<_>>().into_iter().collect::<Result<_, _>>()?;
        let rule = reference_rule(weights.volume_rule);
        let smooth = lattice_points::smooth_part(kernel, rule, weights.calibrated, branch, self.k_horizon);
        let irregular = |m: &f64| {
            let angle = self.degrees.to_radians();
            lattice_points::irregular_part_of_linear(kernel, branch, self.k_horizon, angle, *m)
        };
        let first = self.m[0];
        let angle = self.degrees.to_radians();
        let own = reference::lattice::plane(
            reference_lattice(weights.lattice(first)),
            self.k_horizon / first,
            angle,
        )[usize::from(self.branch == Branch::S)];
        let own = (own.omega * first).powi(2) / exact - 1.0;
        let asymptotic = smooth.is_some_and(|smooth| (own * first * first / smooth - 1.0).abs() < 1.0);
        let rough = weights.volume_rule == VolumeRule::Linear && !weights.calibrated;
        Ok(Seen {
            errors,
            asymptotic,
            smooth: smooth.map(|smooth| self.m.iter().map(|m| smooth / (m * m)).collect()),
            irregular: rough.then(|| self.m.iter().map(irregular).collect()),
        })
    }
}
