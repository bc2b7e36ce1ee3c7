//! A stress intensity history of another code, held against what is known of the plate, and what may be wrong with it.

use super::errors::{Errors, of_pairs};
use super::expect::{Expect, QuantityName};
use super::intensity::Intensity;
use super::load::{Growth, Load, ModeName, On};
use super::plate::{CrackPlace, LateralName};
use crate::dispersion::words::BodyName;
use crate::foreign::{Data, Foreign, Keys, Mistake, Suspect, View, Wanted, covers, likely, scaled};
use crate::question::{Answer, Claiming, Place, claim, error_of};
use crate::rounded::rounded;
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::material::Body;
use pd_verify::verdict::Evidence;

/// K of the case's mode over time, by another code.
pub struct ForeignHistory<'a> {
    case: &'a Intensity,
    /// a of the crack as asked, in m.
    a: f64,
}

/// What other codes are asked where the case has no bound of its own for an error.
const RMS: (f64, Basis, &str) = (
    0.02,
    Basis::Engineering,
    "readings of K from a field are commonly good to a percent or two; a wrong load, plane state or time is off by more than five",
);
const MAX: (f64, Basis, &str) = (
    0.05,
    Basis::Engineering,
    "beside kinks of a history that a grid rounds off errors are two to three times their root mean square, for which 0.02 is allowed",
);

/// Rows that suspects are tried on.
const TRIED: usize = 300;

impl<'a> ForeignHistory<'a> {
    pub fn of(case: &'a Intensity) -> Self {
        let length = case.plate.crack_length_m.0;
        let a = if case.plate.crack == CrackPlace::Centre { 0.5 * length } else { length };
        Self { case, a }
    }

    fn known(&self, t: f64) -> Option<f64> {
        self.case.known.at(t, self.a)
    }

    /// The widest bound that the case has for its own readings, or that for other codes.
    fn bound(&self, quantity: QuantityName) -> (f64, Basis, String) {
        let own = self.case.expect.iter().filter_map(|one: &Expect| one.bound_of(quantity));
        let widest = own.max_by(|a, b| a.0.total_cmp(&b.0));
        let (most, basis, why) = widest.unwrap_or(if quantity == QuantityName::Rms { RMS } else { MAX });
        (most, basis, why.to_owned())
    }

    /// Errors of rows (t, K) in the window against some reference; `None` where it is unknown or rows are few.
    fn errors(&self, rows: &[(f64, f64)], known: impl Fn(f64) -> Option<f64>) -> Option<Errors> {
        let inside = rows.iter().filter(|(t, _)| self.case.window.holds(*t));
        let pairs: Option<Vec<(f64, f64)>> = inside.map(|(t, k)| Some((*k, known(*t)?))).collect();
        let errors = of_pairs(&pairs.filter(|pairs| pairs.len() >= 10)?);
        errors.rms.is_finite().then_some(errors)
    }

    /// What may be wrong with rows, by an error of theirs.
    fn suspects(&self, rows: &[(f64, f64)], pick: fn(&Errors) -> f64) -> Vec<Suspect> {
        let every = rows.len().div_ceil(TRIED).max(1);
        let rows: Vec<(f64, f64)> = rows.iter().copied().step_by(every).collect();
        let error = |change: &dyn Fn((f64, f64)) -> (f64, f64), known: &dyn Fn(f64) -> Option<f64>| {
            let changed: Vec<(f64, f64)> = rows.iter().map(|row| change(*row)).collect();
            self.errors(&changed, known).as_ref().map(pick)
        };
        let known = |t: f64| self.known(t);
        let mut all = scaled(|factor| error(&|(t, k)| (t, factor * k), &known));
        let mut add = |cause: String, error: Option<f64>| all.push(Suspect { cause, error });
        let other =
            if self.case.plate.body == BodyName::PlaneStress { "plane strain" } else { "plane stress" };
        add(
            format!("against the answer of {other} with the same E and ν: was {other} computed?"),
            error(&|row| row, &|t| self.case.known.confused_at(t)),
        );
        add(
            "against the published comparison: it belongs to another Poisson ratio".into(),
            error(&|row| row, &|t| self.case.known.published_at(t)),
        );
        for (by, why) in self.shifts() {
            let cause = format!("if {} s were added to its times: {why}", rounded(by));
            add(cause, error(&|(t, k)| (t + by, k), &known));
        }
        let width = self.case.window.to - self.case.window.from;
        let shifted = |by: f64| error(&|(t, k)| (t + by, k), &known).unwrap_or(f64::INFINITY);
        let by = (-60..=60)
            .map(|n| f64::from(n) / 200.0 * width)
            .min_by(|a, b| shifted(*a).total_cmp(&shifted(*b)));
        if let Some(by) = by {
            let cause = format!("if about {} s were added to its times: where is t = 0?", rounded(by));
            add(cause, Some(shifted(by)));
        }
        all
    }

    /// Beginnings that times are commonly counted from.
    fn shifts(&self) -> Vec<(f64, &'static str)> {
        let (arrival, rise) = (self.case.known.arrival, self.case.load.rise);
        let mut all = Vec::new();
        if arrival > 0.0 {
            all.push((arrival, "are they counted from the wave's arrival at the crack?"));
        }
        if self.case.load.before() > 0.0 {
            all.push((
                -0.5 * rise,
                "are they counted from the beginning of the rise, in place of its centre?",
            ));
        } else if rise > 0.0 {
            all.push((0.5 * rise, "are they counted from the middle of the ramp?"));
        }
        all
    }

    fn evidence(&self, rows: &[(f64, f64)], times: &[f64]) -> [Evidence; 2] {
        let window = (self.case.window.from, self.case.window.to);
        if let Err(lack) = covers(times, window, "t_s", "s") {
            let outside = || Evidence { outside: Some(lack.clone()), ..Evidence::default() };
            return [outside(), outside()];
        }
        let errors = self.errors(rows, |t| self.known(t));
        let count = times.iter().filter(|t| self.case.window.holds(**t)).count();
        let of = |quantity, pick: fn(&Errors) -> f64| {
            let error = errors.as_ref().map(pick);
            let bound = self.bound(quantity).0;
            let cause = match error.is_some_and(|error| error > bound) {
                true => likely(error, bound, self.suspects(rows, pick)),
                false => String::new(),
            };
            Evidence { computed: error, ..error_of(error, format!("{count} rows in the window{cause}")) }
        };
        [of(QuantityName::Rms, |errors| errors.rms), of(QuantityName::Max, |errors| errors.max)]
    }

    fn rows_from(&self, change: impl Fn(f64) -> f64) -> Vec<Vec<f64>> {
        let (times, _) = self.sampled();
        let k = times.iter().map(|&t| change(t)).collect();
        vec![times, k]
    }

    fn sampled(&self) -> (Vec<f64>, Vec<f64>) {
        let times: Vec<f64> = (0..=400).map(|n| f64::from(n) / 400.0 * self.case.window.to).collect();
        let known: Vec<(f64, f64)> = times.iter().filter_map(|&t| Some((t, self.known(t)?))).collect();
        known.into_iter().unzip()
    }
}

impl Foreign for ForeignHistory<'_> {
    fn name(&self) -> String {
        "history".into()
    }

    fn what(&self) -> String {
        format!("K_{} at the tip over time", self.case.load.mode.word())
    }

    fn wanted(&self) -> Vec<Wanted> {
        let short: &'static [&'static str] = match self.case.load.mode {
            ModeName::I => &["k", "ki", "k1", "k_i"],
            ModeName::II => &["k", "kii", "k2", "k_ii"],
        };
        vec![
            Wanted::new("t_s", "s", &["t", "time"], "time after the nominal start of the load"),
            Wanted::new("k_pa_sqrt_m", "Pa*sqrt(m)", short, self.what()),
        ]
    }

    fn keys(&self) -> Keys {
        Keys::Growing("t_s")
    }

    fn problem(&self) -> Vec<(&'static str, String)> {
        let Intensity { plate, material, load, window, .. } = self.case;
        let [width, height] = plate.size_m.map(|side| side.0);
        let body = Body::from(plate.body);
        let nu = body.poisson_ratio().unwrap_or(f64::NAN);
        let crack = match plate.crack {
            CrackPlace::LeftEdge => format!(
                "a crack of {} m runs along x from the middle of the left edge; its tip is at ({}, {})",
                plate.crack_length_m.0,
                plate.crack_length_m.0,
                0.5 * height
            ),
            CrackPlace::Centre => format!(
                "a crack of {} m lies along x in the middle; K is read at its right tip",
                plate.crack_length_m.0
            ),
        };
        let lateral = match plate.lateral.unwrap_or_default() {
            LateralName::Free => "free",
            LateralName::Rollers => "on rollers: u_x = 0, u_y free of stress",
            LateralName::Guides => "in guides: u_y = 0, u_x free of stress",
        };
        let state = if plate.body == BodyName::PlaneStress { "plane stress" } else { "plane strain" };
        vec![
            (
                "Geometry",
                format!(
                    "A plate of {width} m (x) by {height} m (y), in {state}; {crack}. The left and the right edge are {lateral}.\n\n{}",
                    drawing(plate.crack)
                ),
            ),
            (
                "Material",
                format!(
                    "Linear elastic, E = {} Pa, ν = {}, ρ = {} kg/m³; c_d = {} m/s.",
                    material.youngs_modulus,
                    rounded(nu),
                    material.density,
                    rounded(material.dilatational_speed(body))
                ),
            ),
            ("Load", loaded(load)),
            (
                "Window",
                format!(
                    "K is judged from t = {} s to t = {} s; the reference ends with {}. Report at least ten rows in it, none further apart than a tenth of it; the reference is known at every time (a closed form, or straight lines between the rows of a table), so that none of yours is moved.",
                    rounded(window.from),
                    rounded(window.to),
                    self.case.ends
                ),
            ),
        ]
    }

    fn claims(&self, place: &Place) -> Vec<Claim> {
        let of = |name, quantity: &str, kind, which| {
            let (most, basis, why) = self.bound(which);
            let quantity = format!(
                "{quantity} of K_{} in the window over its largest reference",
                self.case.load.mode.word()
            );
            claim(place, name, quantity)
                .at_most(kind, most)
                .because(basis, why)
                .source(self.case.known.source())
        };
        vec![
            of("check_rms", "root mean square error", ErrorKind::RmsOfPeak, QuantityName::Rms),
            of("check_max", "largest error", ErrorKind::MaxOfPeak, QuantityName::Max),
        ]
    }

    fn judge(&self, data: &Data, place: &Place) -> Answer {
        let times = data.of("t_s");
        let rows: Vec<(f64, f64)> =
            times.iter().copied().zip(data.of("k_pa_sqrt_m").iter().copied()).collect();
        let [rms, max] = self.evidence(&rows, times);
        let (known_times, known) = self.sampled();
        let view = View {
            across: "t (µs)".into(),
            up: format!("K_{} (MPa√m)", self.case.load.mode.word()),
            unit: [1e-6, 1e6],
            rows: rows
                .iter()
                .map(|&(t, k)| (t, k, self.known(t).filter(|_| t <= self.case.window.to)))
                .collect(),
            reference: known_times.into_iter().zip(known).collect(),
            judged: Some((self.case.window.from, self.case.window.to)),
            markers: false,
        };
        let caption = format!(
            "K that was brought beside the reference ({}).",
            self.case.known.word().replace('_', " ")
        );
        Answer {
            evidence: vec![("check_rms".into(), rms), ("check_max".into(), max)],
            tables: vec![view.table(place, "history")],
            figures: vec![view.figure(place, &self.case.title, &caption)],
            ..Answer::default()
        }
    }

    fn reference(&self) -> Vec<Vec<f64>> {
        let (times, k) = self.sampled();
        vec![times, k]
    }

    fn mistakes(&self) -> Vec<Mistake> {
        let known = |t: f64| self.known(t).unwrap_or(0.0);
        let by = self.shifts().first().map(|shift| shift.0);
        let mut all = vec![
            Mistake {
                what: "the sign flipped",
                columns: self.rows_from(|t| -known(t)),
                cause: "sign convention",
            },
            Mistake {
                what: "twice K, as of two loaded edges",
                columns: self.rows_from(|t| 2.0 * known(t)),
                cause: "two edges",
            },
            Mistake {
                what: "half of K",
                columns: self.rows_from(|t| 0.5 * known(t)),
                cause: "only one of two",
            },
            Mistake {
                what: "K in MPa√m",
                columns: self.rows_from(|t| 1e-6 * known(t)),
                cause: "MPa where Pa",
            },
            Mistake {
                what: "K in MPa√mm",
                columns: self.rows_from(|t| 1e-6 * 1000_f64.sqrt() * known(t)),
                cause: "MPa√mm",
            },
            Mistake {
                what: "√(2r) for √r",
                columns: self.rows_from(|t| known(t) / std::f64::consts::SQRT_2),
                cause: "√(2r)",
            },
        ];
        if let Some(by) = by.filter(|_| self.case.known.is_freund()) {
            let times: Vec<f64> =
                (0..=400).map(|n| f64::from(n) / 400.0 * (self.case.window.to - by.min(0.0))).collect();
            let k = times.iter().map(|&t| known(t + by)).collect();
            all.push(Mistake {
                what: "times counted from elsewhere",
                columns: vec![times, k],
                cause: "counted from",
            });
        }
        let confused = |t: f64| self.case.known.confused_at(t);
        if confused(self.case.window.to).is_some() {
            let columns = self.rows_from(|t| confused(t).unwrap_or(0.0));
            all.push(Mistake { what: "the other plane state", columns, cause: "was plane str" });
        }
        all
    }
}

/// The load in words.
fn loaded(load: &Load) -> String {
    let stress = rounded(load.stress);
    let along = if load.mode == ModeName::I { "pulls along y" } else { "shears along x" };
    let (on, sign) = match load.on {
        On::Top => (
            format!("A stress of {stress} Pa {along} on the upper edge; the lower edge is free."),
            "One wave.",
        ),
        On::TopAndBottom => (
            format!("A stress of {stress} Pa {along} on the upper edge, and its opposite on the lower edge."),
            "Two waves meet on the crack's line.",
        ),
        On::AllEdges => (
            format!(
                "Pure shear of {stress} Pa on all four edges: along +x on the upper, −x on the lower, +y on the right, −y on the left edge."
            ),
            "In balance.",
        ),
        On::Faces => (
            format!(
                "A stress of {stress} Pa on both faces of the crack, equal and opposite: {}.",
                if load.mode == ModeName::I {
                    "it opens the crack"
                } else {
                    "the upper face is driven along +x"
                }
            ),
            "All edges are free of stress.",
        ),
    };
    let grows = match load.grows {
        Growth::Step => "It acts at once from t = 0 on.".to_owned(),
        Growth::Ramp => {
            format!("It grows in a straight line from t = 0 to t = {} s and stays.", rounded(load.rise))
        }
        Growth::RaisedCosineRate => format!(
            "It grows with the rate (1 + cos(2πt/T))/T, T = {} s, from −T/2 to T/2, and stays: t = 0 is the middle of the rise.",
            rounded(load.rise)
        ),
    };
    format!("{on} {sign} {grows}")
}

fn drawing(crack: CrackPlace) -> &'static str {
    match crack {
        CrackPlace::LeftEdge => {
            "```text\n y ^  +---------------------+\n   |  |                     |\n   |  |-----------*         |   crack, tip *\n   |  |                     |\n   |  +---------------------+\n   +--------------------------> x\n```"
        }
        CrackPlace::Centre => {
            "```text\n y ^  +---------------------+\n   |  |                     |\n   |  |      ---------*     |   crack, tip *\n   |  |                     |\n   |  +---------------------+\n   +--------------------------> x\n```"
        }
    }
}
