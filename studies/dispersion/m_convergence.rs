//! `asks = "m_convergence"`: at fixed δ and k, the lattice's ω tends to the continuum's as m → ∞; at which order?

use super::curve::{reference_kernel, reference_lattice};
use super::sweep::{check_sizes, kernels};
use super::words::{KernelName, VolumeRuleName};
use crate::input::OneOrMany;
use crate::question::{Answer, Claiming, Effort, Place, Question, claim};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim};
use pd_verify::compare::order;
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::report::plot::{Axis, Figure, Guide, Lines, Series};
use pd_verify::scene::{Positive, Wrong};
use pd_verify::table::Table;
use pd_verify::verdict::Evidence;
use pd_verify_reference as reference;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written. The body is a bar.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MConvergenceAsked {
    pub kernel: OneOrMany<KernelName>,
    pub p: Option<OneOrMany<Positive>>,
    /// Horizons over spacing, growing, at least three.
    pub m: Vec<Positive>,
    pub k_horizon: Positive,
    pub volume_rule: OneOrMany<VolumeRuleName>,
}

/// The case, checked.
pub struct MConvergence {
    title: String,
    sequences: Vec<Sequence>,
    m: Vec<f64>,
    k_horizon: f64,
}

struct Sequence {
    name: String,
    kernel: Kernel,
    volume_rule: VolumeRule,
    expected: f64,
}

impl Asked for MConvergenceAsked {
    type Question = MConvergence;

    fn check(&self, written: &Written<'_>) -> Result<MConvergence, Wrong> {
        let m: Vec<f64> = self.m.iter().map(|m| m.0).collect();
        if m.len() < 3 || m.windows(2).any(|pair| pair[0] >= pair[1]) || m[0] < 1.0 {
            return Err(Wrong::new(
                "m",
                "an order needs three levels or more, growing from 1",
                "for example m = [5, 10, 20, 40]",
            ));
        }
        if m.iter().any(|m| m.fract() != 0.0) {
            let help = "take whole numbers: between them the end of the horizon moves through a cell and no order is defined";
            return Err(Wrong::new("m", "the order of the end correction holds for whole m", help));
        }
        let mut sequences = Vec::new();
        for kernel in kernels(&self.kernel, self.p.as_ref())? {
            for &rule in &self.volume_rule.0 {
                let volume_rule = rule.into();
                let name = format!("{}_{}", slug(kernel), VolumeRule::name(volume_rule));
                sequences.push(Sequence {
                    name,
                    kernel,
                    volume_rule,
                    expected: expected(kernel, volume_rule),
                });
            }
        }
        let largest = |sequence: &Sequence| sequence.lattice(m[m.len() - 1]);
        check_sizes(Body::Bar, &sequences.iter().map(largest).collect::<Vec<_>>())?;
        Ok(MConvergence { title: written.title.to_owned(), sequences, m, k_horizon: self.k_horizon.0 })
    }
}

impl Sequence {
    fn lattice(&self, m: f64) -> Lattice {
        Lattice { kernel: self.kernel, m, volume_rule: self.volume_rule, calibrated: false }
    }

    /// The leading error of ω², over 2/M₁, by Euler–Maclaurin on f(s) = W(s)(1 − cos zs)/s with step h = 1/m: a whole
    /// end cell leaves h f(1)/2 too much, half of it leaves h²/12 (f'(1) − f'(0)).
    fn leading(&self, z: f64, h: f64) -> f64 {
        let kernel = self.kernel;
        let (cosine, sine) = (libm::cos(z), libm::sin(z));
        if self.expected == 1.0 {
            return 0.5 * h * kernel.weight(1.0) * (1.0 - cosine);
        }
        let end = end_slope(kernel) * (1.0 - cosine) + kernel.weight(1.0) * (z * sine - (1.0 - cosine));
        h * h / 12.0 * (end - 0.5 * z * z)
    }
}

/// W'(1) from within the horizon.
fn end_slope(kernel: Kernel) -> f64 {
    match kernel {
        Kernel::Constant => 0.0,
        Kernel::Gaussian { p } => -2.0 * p * p * kernel.weight(1.0),
        Kernel::Exponential { p } => -p * kernel.weight(1.0),
        Kernel::Conical => -1.0,
        Kernel::Parabolic => -2.0,
    }
}

/// The order by Euler–Maclaurin; a kernel that vanishes at δ makes a trapezoidal rule of either volume rule.
pub fn expected(kernel: Kernel, rule: VolumeRule) -> f64 {
    if rule == VolumeRule::Full && kernel.weight(1.0) > 0.0 { 1.0 } else { 2.0 }
}

/// A kernel in the name of a claim.
pub fn slug(kernel: Kernel) -> String {
    kernel.to_string().replace(" p = ", "_").replace('.', "_")
}

impl Question for MConvergence {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let claim_of = |sequence: &Sequence| {
            let quantity = format!(
                "order of ω(kδ = {}) in 1/m: {}, {} volumes",
                self.k_horizon,
                sequence.kernel,
                sequence.volume_rule.name()
            );
            claim(place, &sequence.name, quantity)
                .order(sequence.expected, 0.1)
                .because(
                    Basis::Theory,
                    "Euler–Maclaurin; 0.1 leaves room for the next power at the coarsest m",
                )
                .source("Euler–Maclaurin formula on ∫₀¹ W(s)(1 − cos kδs)/s ds (DLMF 2.10(i))")
        };
        self.sequences.iter().map(claim_of).collect()
    }

    fn effort(&self) -> Effort {
        let count = self.sequences.len() as u64;
        let bonds: f64 = self.m.iter().sum();
        let evaluations = count * self.m.len() as u64;
        Effort {
            curves: count,
            evaluations,
            bond_evaluations: count * bonds as u64,
            reference_evaluations: count,
            ..Effort::default()
        }
    }

    fn equations(&self) -> &'static str {
        "lattice: (2/M₁) Σ_j β_j W(j/m) (1 − cos(kδ j/m))/j → continuum: (2/M₁) ∫₀¹ W(s) (1 − cos kδs)/s ds
whole end cell: error W(1)(1 − cos kδ)/(2m), order 1; half end cell: order 2"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let mut answer = Answer::default();
        let columns = [
            "case",
            "kernel",
            "p",
            "volume_rule",
            "m",
            "k_horizon",
            "omega_relative_error",
            "pairwise_order",
        ];
        let mut table = Table::new("dispersion_m_convergence.csv", &columns);
        let mut series = Vec::new();
        for sequence in &self.sequences {
            let levels = self.levels(subject, sequence);
            for (index, &(h, error)) in levels.iter().enumerate() {
                let pairwise =
                    index.checked_sub(1).and_then(|coarse| order::pairwise(levels[coarse], (h, error)));
                table.push(vec![
                    place.case.clone().into(),
                    sequence.kernel.name().into(),
                    sequence.kernel.p().into(),
                    sequence.volume_rule.name().into(),
                    (1.0 / h).into(),
                    self.k_horizon.into(),
                    error.into(),
                    pairwise.into(),
                ]);
            }
            answer.evidence.push((sequence.name.clone(), self.evidence(&levels, sequence)));
            series.push((sequence.volume_rule, Series::both(sequence.kernel.to_string(), levels)));
        }
        answer.figures.push(self.figure(series, place));
        answer.tables.push(table);
        answer
    }
}

impl MConvergence {
    /// A panel for each volume rule.
    fn figure(&self, series: Vec<(VolumeRule, Series)>, place: &Place) -> Figure {
        let caption =
            format!("Relative error of ω at kδ = {} against the nonlocal continuum.", self.k_horizon);
        let mut figure = Figure::new(place.case.clone(), self.title.clone(), caption, Lines::default());
        figure.panels.clear();
        for rule in VolumeRule::ALL {
            let mine: Vec<Series> =
                series.iter().filter(|(of, _)| *of == rule).map(|(_, series)| series.clone()).collect();
            if !mine.is_empty() {
                let panel = Lines::new(Axis::log("1/m = Δx/δ"), Axis::log("relative error of ω"), mine)
                    .titled(format!("{} volumes", rule.name().replace('_', " ")))
                    .guide(Guide::Slope { order: 1.0, label: "order 1".into() })
                    .guide(Guide::Slope { order: 2.0, label: "order 2".into() });
                figure = figure.panel(panel);
            }
        }
        figure.columns(2)
    }

    /// (1/m, relative error of ω) from coarse to fine.
    fn levels(&self, subject: &dyn Subject, sequence: &Sequence) -> Vec<(f64, f64)> {
        let exact = reference::continuum::bar(reference_kernel(sequence.kernel), self.k_horizon);
        let error = |m: f64| {
            let lattice =
                Lattice { kernel: sequence.kernel, m, volume_rule: sequence.volume_rule, calibrated: false };
            let stencil = subject.bar_stencil(lattice).ok()?;
            let omega = subject.bar_wave(&BarDispersion::new(&stencil), self.k_horizon / m).omega * m;
            let exact = exact?.omega;
            Some((omega - exact).abs() / exact)
        };
        self.m.iter().map(|&m| (1.0 / m, error(m).unwrap_or(f64::NAN))).collect()
    }

    /// The order over the finest levels above the round-off floor; inconclusive where the leading term of the
    /// expansion does not yet make the error.
    fn evidence(&self, levels: &[(f64, f64)], sequence: &Sequence) -> Evidence {
        let resolved: Vec<_> =
            levels.iter().copied().filter(|level| level.1.is_nan() || level.1 > ROUND_OFF).collect();
        let tail = &resolved[resolved.len().saturating_sub(TAIL)..];
        let order = if tail.iter().all(|level| level.1.is_finite()) && tail.len() >= 3 {
            order::fitted(tail)
        } else {
            None
        };
        let left_out = levels.len() - resolved.len();
        let floor = if left_out > 0 {
            format!(", {left_out} levels at the round-off floor left out")
        } else {
            String::new()
        };
        let outside = tail.first().filter(|_| !self.asymptotic(sequence, tail[0].0));
        Evidence {
            computed: order.map(|order| order.value),
            reference: Some(sequence.expected),
            error: order.map(|order| (order.value - sequence.expected).abs()),
            order,
            outside: outside
                .map(|_| "not asymptotic: the leading term does not make the error; take larger m".into()),
            note: format!("fitted over the {} finest levels{floor}", tail.len()),
            ..Evidence::default()
        }
    }

    /// Whether the reference's own lattice errs by the leading term, to within 15 %, at step h.
    fn asymptotic(&self, sequence: &Sequence, h: f64) -> bool {
        let exact = reference::continuum::bar(reference_kernel(sequence.kernel), self.k_horizon);
        let lattice =
            reference::lattice::bar(reference_lattice(sequence.lattice(1.0 / h)), self.k_horizon * h);
        let Some(exact) = exact else { return false };
        let square = exact.omega * exact.omega;
        let measured = (lattice.omega / h).powi(2) - square;
        let predicted = 2.0 / sequence.kernel.moment(1) * sequence.leading(self.k_horizon, h);
        (measured - predicted).abs() <= 0.15 * predicted.abs()
    }
}

/// Relative errors below this are rounding.
const ROUND_OFF: f64 = 1e-13;
/// Levels of the fit.
const TAIL: usize = 4;
