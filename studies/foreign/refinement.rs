//! A table of errors by spacing: its observed order against the one that the case expects, and what its levels still lack.

use super::{Data, Foreign, Keys, Mistake, Wanted};
use crate::levels::tail_order;
use crate::question::{Answer, Claiming, Place, claim, error_of};
use crate::rounded::rounded;
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::order;
use pd_verify::compare::richardson::{SAFETY, extrapolate};
use pd_verify::report::plot::{Axis, Figure, Guide, Lines, Series};
use pd_verify::table::Table;
use pd_verify::verdict::Evidence;

/// What is refined, and what is expected of it.
pub struct Refinement {
    pub title: String,
    /// How the errors are had.
    pub what: String,
    pub problem: Vec<(&'static str, String)>,
    pub order: f64,
    pub within: f64,
    pub because: String,
    pub source: String,
    /// Errors below are rounding.
    pub floor: f64,
    /// The case's own spacings in m.
    pub spacings: Vec<f64>,
}

/// What the grid convergence index of the finest level may be.
const GCI: f64 = 0.05;

impl Refinement {
    fn levels(data: &Data) -> Vec<(f64, f64)> {
        let mut levels: Vec<(f64, f64)> =
            data.of("dx_m").iter().copied().zip(data.of("error").iter().copied()).collect();
        levels.sort_by(|a, b| b.0.total_cmp(&a.0));
        levels
    }

    fn order(&self, levels: &[(f64, f64)]) -> Evidence {
        if levels.iter().any(|(h, error)| !(*h > 0.0 && *error >= 0.0)) {
            let outside = Some("a spacing is not above 0, or an error is negative".into());
            return Evidence { outside, reference: Some(self.order), ..Evidence::default() };
        }
        if levels.len() < 3 {
            let outside = Some(format!("{} levels tell no order: three are needed", levels.len()));
            return Evidence { outside, reference: Some(self.order), ..Evidence::default() };
        }
        let mut found = tail_order("the data", levels, self.order, self.within, self.floor);
        if let Some(order) = found.computed.filter(|order| (order - self.order).abs() > self.within) {
            found.note += &self.cause(order, levels);
        }
        found
    }

    /// Why an order may be another one.
    fn cause(&self, order: f64, levels: &[(f64, f64)]) -> String {
        let near = |other: f64| (order - other).abs() <= 2.0 * self.within;
        let steps = levels.windows(2).map(|pair| pair[0].0 / pair[1].0);
        let growing = steps.clone().fold(0.0, f64::max) > 1.0;
        if near(self.order - 1.0) {
            return format!(
                "; order {order:.2} is one less than {}: is a boundary, a load or a time one cell or half a cell off?",
                self.order
            );
        }
        if near(2.0 * self.order) {
            return "; order is twice the expected one: are these squares of the errors?".into();
        }
        if near(0.5 * self.order) {
            return "; order is half the expected one: are these roots of the errors, or is the solution not smooth?".into();
        }
        if near(0.0) && growing {
            return "; errors do not fall: is what is computed another problem, with other moduli or another load?".into();
        }
        if near(-self.order) {
            return "; errors grow: are numbers of cells given in place of their size?".into();
        }
        String::new()
    }
}

impl Foreign for Refinement {
    fn name(&self) -> String {
        "convergence".into()
    }

    fn what(&self) -> String {
        format!("{}, at three spacings or more", self.what)
    }

    fn wanted(&self) -> Vec<Wanted> {
        vec![
            Wanted::new("dx_m", "m", &["dx", "h", "spacing"], "the spacing"),
            Wanted::new("error", "1", &["err", "e", "l2"], self.what.clone()),
        ]
    }

    fn keys(&self) -> Keys {
        Keys::Distinct(&["dx_m"])
    }

    fn problem(&self) -> Vec<(&'static str, String)> {
        self.problem.clone()
    }

    fn claims(&self, place: &Place) -> Vec<Claim> {
        vec![
            claim(place, "check_order", "order in the spacing of the errors that were brought")
                .order(self.order, self.within)
                .because(Basis::Theory, self.because.clone())
                .source(self.source.clone()),
            claim(place, "check_uncertainty", "grid convergence index of the finest error: what of it the three finest levels leave at h → 0")
                .at_most(ErrorKind::Absolute, GCI)
                .because(Basis::Engineering, "where the error falls as it should nothing is left of it at h → 0: a residue of a twentieth of the coarsest of the three levels' error, with the factor of safety 1.25, would hide another problem")
                .source("Roache 1994, Richardson extrapolation of the three finest levels to h → 0, over the coarsest of them"),
        ]
    }

    fn judge(&self, data: &Data, place: &Place) -> Answer {
        let levels = Self::levels(data);
        let order = self.order(&levels);
        let uncertainty = residue(&levels);
        let mut table = Table::new("check.csv", &["case", "data", "dx_m", "error", "pairwise_order"]);
        for (index, &(h, error)) in levels.iter().enumerate() {
            let pair = index.checked_sub(1).and_then(|before| order::pairwise(levels[before], levels[index]));
            table.push(vec![
                place.case.as_str().into(),
                "convergence".into(),
                h.into(),
                error.into(),
                pair.into(),
            ]);
        }
        let lines = Lines::new(
            Axis::log("spacing (m)"),
            Axis::log("error"),
            vec![Series::both("the data", levels.clone()).slot(0)],
        )
        .guide(Guide::Slope { order: self.order, label: format!("order {}", self.order) });
        let caption = "Errors that were brought, and the order that is expected of them.";
        let figure = Figure::new(format!("{}-check", place.case), self.title.clone(), caption, lines);
        let drawable = levels.iter().filter(|(h, error)| *h > 0.0 && *error > 0.0).count() > 1;
        Answer {
            evidence: vec![("check_order".into(), order), ("check_uncertainty".into(), uncertainty)],
            tables: vec![table],
            figures: if drawable { vec![figure] } else { Vec::new() },
            ..Answer::default()
        }
    }

    fn reference(&self) -> Vec<Vec<f64>> {
        let errors = self.spacings.iter().map(|h| 0.01 * libm::pow(h / self.spacings[0], self.order));
        vec![self.spacings.clone(), errors.collect()]
    }

    fn mistakes(&self) -> Vec<Mistake> {
        let of = |error: &dyn Fn(f64) -> f64| {
            vec![self.spacings.clone(), self.spacings.iter().map(|h| error(h / self.spacings[0])).collect()]
        };
        let order = self.order;
        vec![
            Mistake {
                what: "an order less",
                columns: of(&|h| 0.01 * libm::pow(h, order - 1.0)),
                cause: "one less",
            },
            Mistake {
                what: "squares of errors",
                columns: of(&|h| 1e-4 * libm::pow(h, 2.0 * order)),
                cause: "squares",
            },
            Mistake {
                what: "errors that stay",
                columns: of(&|h| 0.01 + 1e-7 * h),
                cause: "errors do not fall",
            },
        ]
    }
}

/// |error extrapolated to h → 0| with the factor of safety, over the error of the coarsest of the three finest levels.
fn residue(levels: &[(f64, f64)]) -> Evidence {
    let [.., coarse, middle, fine] = levels else {
        return Evidence { outside: Some("three levels are needed".into()), ..Evidence::default() };
    };
    match extrapolate([*fine, *middle, *coarse]) {
        Ok(found) => {
            let left = SAFETY * found.value.abs() / coarse.1;
            let note =
                format!("order {:.3} by the three finest, {} at h → 0", found.order, rounded(found.value));
            Evidence { computed: Some(found.value), ..error_of(Some(left), note) }
        }
        Err(none) => Evidence { outside: Some(none.reason().into()), ..Evidence::default() },
    }
}
