//! `asks = "arithmetic"`: formulas that lose digits as they are printed, each as the code has it and naively, against higher
//! precision: waves as k → 0, bonds that are hardly stretched, kernels as p → 0, a Fourier series near its jump, and
//! Williams' series of many terms.

use super::arithmetic_sums::{Compared, Sum, fourier, kernels, stretches, waves, williams};
use crate::dispersion::sweep::LatticeSweep;
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::report::plot::{Axis, Figure, Lines, Series};
use pd_verify::scene::Wrong;
use pd_verify::table::{Cell, Table};
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written; one lattice of a plate.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ArithmeticAsked {
    /// The smallest parameter is 10 to minus this.
    pub decades: u32,
    /// Of the series near its jump.
    pub fourier_terms: u32,
    /// Williams' series are fitted with 1 to so many terms.
    pub williams_terms: u32,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct Arithmetic {
    title: String,
    decades: u32,
    fourier_terms: usize,
    williams_terms: usize,
    lattice: Lattice,
}

const MOST_DECADES: u32 = 15;
const MOST_FOURIER_TERMS: u32 = 10_000;
const MOST_WILLIAMS_TERMS: u32 = 12;
/// The stretched plate is nine nodes wide.
const LARGEST_M: f64 = 4.0;

impl Asked for ArithmeticAsked {
    type Question = Arithmetic;

    fn check(&self, written: &Written<'_>) -> Result<Arithmetic, Wrong> {
        let limits = [
            ("decades", self.decades, MOST_DECADES),
            ("fourier_terms", self.fourier_terms, MOST_FOURIER_TERMS),
            ("williams_terms", self.williams_terms, MOST_WILLIAMS_TERMS),
        ];
        if let Some((key, given, most)) =
            limits.into_iter().find(|(_, given, most)| !(1..=*most).contains(given))
        {
            return Err(Wrong::new(
                key,
                format!("{given} {}", key.replace('_', " ")),
                format!("take 1 to {most}"),
            ));
        }
        let lattices = self.lattice.usable(Body::PlaneStress).map_err(|wrong| wrong.inside("lattice"))?;
        let [lattice] = lattices[..] else {
            return Err(Wrong::new("lattice", "one lattice is looked at", "give one value for each key"));
        };
        if lattice.m > LARGEST_M {
            let message = format!("m = {} is larger than the plate that is stretched", lattice.m);
            return Err(Wrong::new("lattice.m", message, format!("take at most {LARGEST_M}")));
        }
        Ok(Arithmetic {
            title: written.title.to_owned(),
            decades: self.decades,
            fourier_terms: self.fourier_terms as usize,
            williams_terms: self.williams_terms as usize,
            lattice,
        })
    }
}

impl Question for Arithmetic {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let small = format!("down to 1e-{}", self.decades);
        let relative = |name: &str, quantity: String, because: &str, source: &str| {
            claim(place, name, quantity)
                .at_most(ErrorKind::Relative, 1e-14)
                .because(Basis::Rounding, because)
                .source(source)
        };
        let allowed = |name: &str, quantity: String, because: &str, source: &str| {
            claim(place, name, quantity)
                .at_most(ErrorKind::Relative, 1.0)
                .because(Basis::Rounding, because)
                .source(source)
        };
        vec![
            relative(
                "waves",
                format!("largest relative error of ω of waves in bar and plate, kΔx {small}"),
                "weights of a few units in the last place, positive terms, a recurrence that adds a unit for each neighbour, and a root that halves: less than 45 units; 1 − cos keeps 1e-16/(kΔx)²",
                "the lattice's sum in double-double arithmetic, by half angles",
            ),
            relative(
                "stretch",
                format!(
                    "largest error of the forces on a stretched plate over the largest force, strains {small}"
                ),
                "displacements across nine cells rounded, 38 units of a bond's own; weights and the sum of 14 bonds the rest: less than 60 units of 1.1e-16; the difference of roots keeps 1e-16/ε",
                "elongations |ξ + η| − |ξ| in double-double arithmetic",
            ),
            relative(
                "kernels",
                format!(
                    "largest relative error of c₀, Gaussian and exponential kernels, bar and plate, p {small}"
                ),
                "series of positive terms, a unit or two each; the printed 1 − exp(−p²) keeps 1e-16/p², the plate's √π erf p − 2p exp(−p²) 1e-16/p³",
                "moments by quadrature in double-double arithmetic",
            ),
            allowed(
                "fourier",
                format!(
                    "largest error of {} terms near a jump over 4·terms·2⁻⁵³ of the jump, distances {small}",
                    self.fourier_terms
                ),
                "phases (n + ½)πx/L are good to two units, the weights fall like 1/n: two units of the jump for each term, the cosine of time as much",
                "the same terms in double-double arithmetic",
            ),
            allowed(
                "williams",
                format!(
                    "largest error of K by 1 to {} terms over 64·2⁻⁵³ times the condition number",
                    self.williams_terms
                ),
                "data in the span of the series leave no residual, so that K errs by the condition number times the rounding of data (some eight units of complex powers) and of the fit, not by its square",
                "K of the field that is given",
            ),
        ]
    }

    fn effort(&self) -> Effort {
        let points = u64::from(2 * self.decades + 1);
        Effort {
            curves: 5,
            evaluations: 9 * points + self.williams_terms as u64,
            bond_evaluations: 4000 * points,
            reference_evaluations: 9 * points,
            ..Effort::default()
        }
    }

    fn equations(&self) -> &'static str {
        "2 sin²(kξ/2) for 1 − cos kξ; η·(2ξ + η)/(|ξ + η| + |ξ|) for |ξ + η| − |ξ|
Mₙ = ∫₀¹ sⁿ exp(−p²s²) ds = e^(−p²) Σ (2p²)ʲ/((n+1)(n+3)…(n+1+2j)) for (1 − e^(−p²))/2p², …
orthogonal factors for the normal equations, whose condition number is the square"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let found = waves(subject, self.lattice, self.decades).and_then(|waves| {
            Ok([
                waves,
                stretches(subject, self.lattice, self.decades)?,
                kernels(subject, self.decades),
                fourier(subject, self.fourier_terms, self.decades),
                williams(subject, self.williams_terms)?,
            ])
        });
        let sums = match found {
            Ok(sums) => sums,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        Answer {
            evidence: sums.iter().map(evidence).collect(),
            tables: vec![table(&sums, place)],
            figures: vec![self.figure(&sums, place)],
            ..Answer::default()
        }
    }
}

fn evidence(sum: &Sum) -> (String, pd_verify::verdict::Evidence) {
    let worst = largest(sum.points.iter().map(|point| point.code / point.unit));
    let naive = sum.points.iter().map(|point| point.naive / point.unit).fold(0.0, f64::max);
    (sum.name.into(), error_of(worst, format!("{} parameters; naively {naive:.1e}", sum.points.len())))
}

/// Where no digit is left.
const NONE_LEFT: f64 = 1.0;
/// Errors below are drawn here.
const EXACT: f64 = 1e-18;

impl Arithmetic {
    fn figure(&self, sums: &[Sum], place: &Place) -> Figure {
        let caption = "Relative errors of five formulas as the code has them and as one would write them down. Errors of none are drawn at 1e-18, those without a right digit at 1.";
        let mut figure = Figure::new(place.case.clone(), self.title.clone(), caption, Lines::default());
        figure.panels.clear();
        for sum in sums {
            let drawn = |of: fn(&Compared) -> f64| {
                let at = |point: &Compared| (point.parameter, of(point).clamp(EXACT, NONE_LEFT));
                sum.points.iter().map(at).collect()
            };
            let both = vec![
                Series::both("code", drawn(|point| point.code)).slot(0),
                Series::both("naive", drawn(|point| point.naive)).slot(1),
            ];
            let panel = Lines::new(Axis::log(sum.axis), Axis::log("relative error"), both).titled(sum.title);
            figure = figure.panel(panel);
        }
        figure.columns(2)
    }
}

/// A row for every parameter.
fn table(sums: &[Sum], place: &Place) -> Table {
    let columns = ["case", "formula", "parameter", "value", "error", "naive_error"];
    let mut table = Table::new("stability_arithmetic.csv", &columns);
    for sum in sums {
        for point in &sum.points {
            let row: Vec<Cell> = vec![
                place.case.as_str().into(),
                sum.name.into(),
                sum.axis.into(),
                point.parameter.into(),
                point.code.into(),
                point.naive.into(),
            ];
            table.push(row);
        }
    }
    table
}
