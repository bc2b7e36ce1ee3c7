//! `asks = "nonlocal_pulse"`: a pulse on a periodic bar at a fixed horizon, m → ∞, against the nonlocal continuum.

use super::pulsed::{Marched, PlainBarAsked, PulseShapeAsked, Pulsed, material};
use super::ring::Ring;
use crate::dispersion::curve::{reference_kernel, reference_lattice};
use crate::dispersion::m_convergence;
use crate::dispersion::sweep::{check_marched, check_usable, kernels};
use crate::dispersion::words::{KernelName, VolumeRuleName};
use crate::input::OneOrMany;
use crate::levels::{self, Sequence, refining, relative};
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::{largest, order};
use pd_verify::constraints::Edge;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::report::plot::{Axis, Figure, Guide, Lines, Series};
use pd_verify::scene::{Positive, Wrong};
use pd_verify::verdict::Evidence;
use pd_verify_reference as reference;
use pd_verify_reference::nonlocal_pulse::NonlocalPulse;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written. The bar is a ring; the pulse stands in its middle.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NonlocalPulseAsked {
    pub bar: PlainBarAsked,
    pub pulse: PulseShapeAsked,
    pub horizon_m: Positive,
    pub duration_s: Positive,
    /// Times at which the bar is looked at, evenly up to the duration.
    pub looks: u32,
    /// vΔt/Δx, about; default 0.2.
    pub courant: Option<Positive>,
    pub kernel: OneOrMany<KernelName>,
    pub p: Option<OneOrMany<Positive>>,
    /// Horizons over spacing, growing whole numbers, at least three.
    pub m: Vec<Positive>,
    pub volume_rule: OneOrMany<VolumeRuleName>,
    /// Default `false`.
    pub calibrated: Option<OneOrMany<bool>>,
}

/// The case, checked.
pub struct Nonlocal {
    title: String,
    bar: Pulsed,
    horizon: f64,
    duration: f64,
    looks: usize,
    refinements: Vec<Refinement>,
}

/// A kernel and a volume rule with their levels of m.
struct Refinement {
    slug: String,
    name: String,
    kernel: Kernel,
    rule: VolumeRule,
    calibrated: bool,
    expected: f64,
    levels: Vec<Marched>,
}

/// Relative errors below this may be rounding.
const FLOOR: f64 = 1e-9;

impl Asked for NonlocalPulseAsked {
    type Question = Nonlocal;

    fn check(&self, written: &Written<'_>) -> Result<Nonlocal, Wrong> {
        let bar = Pulsed::check(self.bar, self.pulse, [Edge::Periodic; 2], material(written)?)?;
        if (2.0 * bar.exact.centre / bar.exact.length - 1.0).abs() > 1e-12 {
            let help = format!("take {} m", 0.5 * bar.exact.length);
            return Err(Wrong::new("pulse.centre_m", "the pulse must stand in the middle of the ring", help));
        }
        let m = refining("m", &self.m, |coarse, fine| coarse < fine)?;
        if m.iter().any(|m| m.fract() != 0.0) {
            let help = "take whole numbers: between them the end of the horizon moves through a cell";
            return Err(Wrong::new("m", "the order of the end correction holds for whole m", help));
        }
        let (horizon, duration, looks) = (self.horizon_m.0, self.duration_s.0, u64::from(self.looks.max(1)));
        let courant = self.courant.map_or(0.2, |courant| courant.0);
        let per_look = bar.exact.speed * duration * m[0] / (horizon * courant * looks as f64);
        let calibrated = self.calibrated.as_ref().map_or(&[false][..], |list| &list.0);
        let mut refinements = Vec::new();
        for kernel in kernels(&self.kernel, self.p.as_ref())? {
            for rule in self.volume_rule.0.iter().map(|&rule| VolumeRule::from(rule)) {
                for &calibrated in calibrated {
                    let of = |m| Lattice { kernel, m, volume_rule: rule, calibrated };
                    let lattices: Vec<Lattice> = m.iter().map(|&m| of(m)).collect();
                    check_marched(Body::Bar, &lattices, 1 + refinements.len())?;
                    check_usable(Body::Bar, &lattices)?;
                    let level = |&fine: &f64| {
                        let steps = ((per_look.ceil() * fine / m[0]).round() as u64).saturating_mul(looks);
                        bar.marched(of(fine), horizon / fine, duration, steps, looks)
                    };
                    let weights = if calibrated { "calibrated" } else { "as printed" };
                    refinements.push(Refinement {
                        slug: slug(kernel, rule, calibrated),
                        name: format!("{kernel}, {weights}"),
                        kernel,
                        rule,
                        calibrated,
                        expected: m_convergence::expected(kernel, rule),
                        levels: m.iter().map(level).collect::<Result<_, _>>()?,
                    });
                }
            }
        }
        let title = written.title.to_owned();
        Ok(Nonlocal { title, bar, horizon, duration, looks: looks as usize, refinements })
    }
}

fn slug(kernel: Kernel, rule: VolumeRule, calibrated: bool) -> String {
    format!(
        "{}_{}_{}",
        m_convergence::slug(kernel),
        rule.name(),
        if calibrated { "calibrated" } else { "printed" }
    )
}

impl Question for Nonlocal {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let rounding = "leapfrog of a wave turns by (2/Δt) asin(ωΔt/2) exactly: only rounding is left, some 1e-16 a step";
        let mut claims = vec![
            claim(place, "modes", "largest difference from the ring's waves carried by leapfrog")
                .at_most(ErrorKind::MaxOfPeak, 1e-10)
                .because(Basis::Rounding, rounding)
                .source("waves of the periodic lattice, frequencies in double-double arithmetic"),
        ];
        claims.extend(self.refinements.iter().map(|one| {
            let quantity =
                format!("order in 1/m of the error in L2: {}, {} volumes", one.name, one.rule.name());
            claim(place, &one.slug, quantity)
                .order(one.expected, 0.1)
                .because(Basis::Theory, "Euler–Maclaurin: a whole end cell errs by its half, half of it by the second order; vΔt/Δx is fixed, so that leapfrog adds to the second order only; calibration changes E by the same orders; 0.1 for the next power at the coarsest m")
                .source("Fourier series of the ring with ω(k) of the nonlocal continuum")
        }));
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.refinements.iter().flat_map(|one| &one.levels).map(|march| march.plan.clone()).collect()
    }

    fn effort(&self) -> Effort {
        let nodes = self.refinements.iter().flat_map(|one| &one.levels).map(|march| march.nodes() as u64 / 2);
        Effort { reference_evaluations: nodes.sum(), ..Effort::of_scenes(&self.scenes()) }
    }

    fn equations(&self) -> &'static str {
        "u(x, 0) = exp(−((x − L/2)/w)²), period L: u = Σ_k a_k cos k(x − L/2) cos ω(k)t
continuum: (ωδ/v)² = (2/M₁) ∫₀¹ W(s)(1 − cos kδs)/s ds; lattice: (2/M₁) Σ_j β_j W(j/m)(1 − cos(kδ j/m))/j, m → ∞ at fixed δ"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let seen: Vec<Result<(Sequence, f64), String>> =
            self.refinements.par_iter().map(|one| self.follow(subject, one)).collect();
        let seen: Vec<(Sequence, f64)> = match seen.into_iter().collect() {
            Ok(seen) => seen,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        let mut table = levels::table("bar_convergence.csv");
        let marches = format!("{} marches", self.scenes().len());
        let modes = error_of(largest(seen.iter().map(|(_, far)| *far)), marches);
        let mut evidence = vec![("modes".into(), modes)];
        for (one, (sequence, _)) in self.refinements.iter().zip(&seen) {
            let at = |level: usize| (one.levels[level].scene.lattice, one.levels[level].scene.spacing);
            levels::push(&mut table, "m", &place.case, sequence, at);
            evidence.push((one.slug.clone(), self.evidence(one, sequence)));
        }
        Answer {
            evidence,
            tables: vec![table],
            figures: vec![self.figure(&seen, place)],
            ..Answer::default()
        }
    }
}

impl Nonlocal {
    /// Errors against the continuum by 1/m, and the largest difference from the ring's own waves.
    fn follow(&self, subject: &dyn Subject, one: &Refinement) -> Result<(Sequence, f64), String> {
        let scale = self.horizon * self.horizon;
        let period = self.bar.exact.length / self.horizon;
        let kernel = reference_kernel(one.kernel);
        let exact = NonlocalPulse::periodic(kernel, self.bar.exact.sharpness * scale, period)
            .ok_or("the pulse has waves beyond the range of the continuum")?;
        let level = |march: &Marched| -> Result<((f64, levels::Errors), f64), String> {
            let rows = march.march(subject, self.looks)?;
            let start: Vec<f64> =
                (0..march.nodes()).map(|j| self.bar.exact.displacement_at(march.place(j), 0.0)).collect();
            let ring = Ring::new(reference_lattice(march.scene.lattice), &start, march.courant)
                .ok_or("leapfrog is unstable")?;
            let mut known = Vec::new();
            let mut far = Vec::new();
            for (row, look) in rows.iter().zip(1..) {
                let time = self.bar.exact.speed * self.duration * look as f64 / self.looks as f64;
                let waves = ring.displacements(march.cell_time(look, self.looks));
                far.extend(row.iter().zip(waves).map(|(u, wave)| (u - wave).abs()));
                known.extend((0..march.nodes()).map(|j| {
                    let x = (march.place(j) - self.bar.exact.centre) / self.horizon;
                    exact.displacement(x, time / self.horizon).unwrap_or(f64::NAN)
                }));
            }
            let errors = relative(rows.iter().flatten().copied().zip(known));
            Ok(((1.0 / march.scene.lattice.m, errors), largest(far).unwrap_or(f64::NAN)))
        };
        let found: Vec<Result<_, String>> = one.levels.par_iter().map(level).collect();
        let found: Vec<((f64, levels::Errors), f64)> = found.into_iter().collect::<Result<_, _>>()?;
        let far = largest(found.iter().map(|(_, far)| *far)).unwrap_or(f64::NAN);
        let levels = found.into_iter().map(|(level, _)| level).collect();
        Ok((Sequence { name: one.name.clone(), levels }, far))
    }

    /// The order in L2; inconclusive where the lattice itself is not yet asymptotic.
    fn evidence(&self, one: &Refinement, sequence: &Sequence) -> Evidence {
        let others = [0, 2].map(|norm| sequence.order(norm, one.expected, FLOOR).computed);
        let other = |order: Option<f64>| order.map_or("none".into(), |order| format!("{order:.3}"));
        let found = sequence.order(1, one.expected, FLOOR);
        let note = format!("{}; L1 {}, L∞ {}", found.note, other(others[0]), other(others[1]));
        let outside = (!self.asymptotic(one)).then(|| {
            "not asymptotic: the reference's lattice does not have this order at these m; take larger m"
                .into()
        });
        Evidence { outside, note, ..found }
    }

    /// Whether ω² of the reference's lattice tends to the continuum's at the expected order between the coarsest and
    /// the finest m, at the root mean square wavenumber of the pulse.
    fn asymptotic(&self, one: &Refinement) -> bool {
        let z = (2.0 * self.bar.exact.sharpness).sqrt() * self.horizon;
        let Some(exact) = reference::continuum::bar(reference_kernel(one.kernel), z) else { return false };
        let error = |march: &Marched| {
            let m = march.scene.lattice.m;
            let omega = m * reference::lattice::bar(reference_lattice(march.scene.lattice), z / m).omega;
            (1.0 / m, (omega * omega - exact.omega * exact.omega).abs())
        };
        let (coarse, fine) = (error(&one.levels[0]), error(&one.levels[one.levels.len() - 1]));
        order::pairwise(coarse, fine).is_some_and(|order| (order - one.expected).abs() < 0.1)
    }

    /// A panel for each volume rule.
    fn figure(&self, seen: &[(Sequence, f64)], place: &Place) -> Figure {
        let width = 1.0 / self.bar.exact.sharpness.sqrt();
        let caption = format!(
            "Displacement error in L2 over a ring of {:.3} δ and {} times, of a pulse {:.3} δ wide, against the nonlocal continuum at fixed δ.",
            self.bar.exact.length / self.horizon,
            self.looks,
            width / self.horizon
        );
        let mut figure = Figure::new(place.case.clone(), self.title.clone(), caption, Lines::default());
        figure.panels.clear();
        for rule in VolumeRule::ALL {
            let mine = self.refinements.iter().zip(seen).filter(|(one, _)| one.rule == rule);
            let curve = |(one, (sequence, _)): (&Refinement, &(Sequence, f64))| {
                let series = Series::both(one.name.clone(), sequence.in_norm(1));
                if one.calibrated { series.dash(pd_verify::report::plot::Dash::Dashed) } else { series }
            };
            let series: Vec<Series> = mine.take(8).map(curve).collect();
            if series.is_empty() {
                continue;
            }
            let mut panel = Lines::new(Axis::log("1/m = Δx/δ"), Axis::log("error in L2"), series)
                .titled(format!("{} volumes", rule.name().replace('_', " ")));
            for order in [1.0, 2.0] {
                if self.refinements.iter().any(|one| one.rule == rule && one.expected == order) {
                    panel = panel.guide(Guide::Slope { order, label: format!("order {order}") });
                }
            }
            figure = figure.panel(panel);
        }
        figure
    }
}
