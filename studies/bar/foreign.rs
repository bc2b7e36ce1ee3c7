//! What another code saw of a bar: a history at a place or a profile at a time, held against d'Alembert's solution.

use crate::foreign::{Data, Foreign, Keys, Mistake, Suspect, View, Wanted, covers, likely, scaled};
use crate::levels::relative;
use crate::question::{Answer, Claiming, Place, claim, error_of};
use crate::rounded::rounded;
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::verdict::Evidence;

/// What is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    Displacement,
    Strain,
}

/// Along what, and where or when.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Along {
    /// At x in m, until t in s.
    Time { x: f64, until: f64 },
    /// At t in s, over a bar of so many m.
    Place { t: f64, length: f64 },
}

/// A view of a bar whose exact motion is known.
pub struct ForeignBar<'a> {
    pub title: &'a str,
    pub quantity: Quantity,
    pub along: Along,
    /// Over (x, t) in m and s.
    pub exact: Box<dyn Fn(f64, f64) -> f64 + 'a>,
    /// Bound of the case for the mean error, with its reason.
    pub bound: Option<(f64, String)>,
    pub problem: Vec<(&'static str, String)>,
    pub source: &'static str,
}

impl Quantity {
    fn column(self) -> (&'static str, &'static str, &'static [&'static str]) {
        match self {
            Self::Displacement => ("displacement_m", "m", &["u", "ux", "displacement", "displacement_x"]),
            Self::Strain => ("strain", "1", &["eps", "epsilon", "e"]),
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::Strain => "strain",
        }
    }
}

/// Rows that suspects are tried on.
const TRIED: usize = 400;

impl ForeignBar<'_> {
    fn range(&self) -> (f64, f64) {
        match self.along {
            Along::Time { until, .. } => (0.0, until),
            // Codes report nodes or cells: the first may be half a cell off the end.
            Along::Place { length, .. } => (0.01 * length, 0.99 * length),
        }
    }

    fn key(&self) -> (&'static str, &'static str) {
        match self.along {
            Along::Time { .. } => ("t_s", "s"),
            Along::Place { .. } => ("x_m", "m"),
        }
    }

    fn exact_at(&self, key: f64) -> f64 {
        match self.along {
            Along::Time { x, .. } => (self.exact)(x, key),
            Along::Place { t, .. } => (self.exact)(key, t),
        }
    }

    fn bound(&self) -> (ErrorKind, f64, Basis, String) {
        match (self.quantity, &self.bound) {
            (Quantity::Strain, Some((bound, why))) => {
                (ErrorKind::L1Relative, *bound, Basis::Engineering, why.clone())
            }
            (Quantity::Strain, None) => (
                ErrorKind::L1Relative,
                0.1,
                Basis::Engineering,
                "jumps are smeared over a few cells and overshoot by a quarter, so that some hundred cells leave a few hundredths; a wrong speed, sign or height leaves more than a tenth".into(),
            ),
            (Quantity::Displacement, _) => (
                ErrorKind::L2Relative,
                0.02,
                Basis::Engineering,
                "twenty cells to the shortest length of the solution leave less in every scheme of the second order; a wrong speed, sign, end or time leaves more".into(),
            ),
        }
    }

    /// The error of rows against the exact answer, its argument changed by `at`.
    fn error(&self, rows: &[(f64, f64)], at: impl Fn(f64) -> f64) -> Option<f64> {
        let (from, to) = self.range();
        let inside = rows.iter().filter(|(key, _)| *key >= from.min(0.0) && *key <= to * 1.02);
        let pairs: Vec<(f64, f64)> = inside.map(|&(key, value)| (value, at(key))).collect();
        let [l1, l2, _] = relative(pairs.iter().copied());
        let error = if self.bound().0 == ErrorKind::L1Relative { l1 } else { l2 };
        (pairs.len() >= 10 && error.is_finite()).then_some(error)
    }

    fn suspects(&self, rows: &[(f64, f64)]) -> Vec<Suspect> {
        let every = rows.len().div_ceil(TRIED).max(1);
        let rows: Vec<(f64, f64)> = rows.iter().copied().step_by(every).collect();
        let mut all = scaled(|factor| {
            let scaled: Vec<(f64, f64)> = rows.iter().map(|(key, value)| (*key, factor * value)).collect();
            self.error(&scaled, |key| self.exact_at(key))
        });
        let mut add = |cause: String, error| all.push(Suspect { cause, error });
        let at_speed = |ratio: f64| match self.along {
            Along::Time { x, .. } => self.error(&rows, |t| (self.exact)(x, ratio * t)),
            Along::Place { t, .. } => self.error(&rows, |x| (self.exact)(x, ratio * t)),
        };
        for (ratio, what) in [
            (1.0 / (1.0_f64 - 1.0 / 9.0).sqrt(), "of a plate in plane stress with ν = 1/3"),
            ((1.2_f64).sqrt(), "of a plate in plane strain with ν = 1/4"),
            ((1.5_f64).sqrt(), "of a body with ν = 1/3 that cannot contract"),
            (0.5, "half as large"),
            (2.0, "twice as large"),
        ] {
            add(format!("against waves of the speed {what}: is √(E/ρ) what they run at?"), at_speed(ratio));
        }
        let faster = |n: i32| 1.0 + f64::from(n) / 200.0;
        let left = |n: &i32| at_speed(faster(*n)).unwrap_or(f64::INFINITY);
        if let Some(best) = (-60..=60).min_by(|a, b| left(a).total_cmp(&left(b))) {
            let cause = format!(
                "against waves {} times as fast: are E, ρ and the bonds' modulus right?",
                rounded(faster(best))
            );
            add(cause, Some(left(&best)));
        }
        let (from, to) = self.range();
        let shift = |by: f64| self.error(&rows, |key| self.exact_at(key + by));
        let left = |n: &i32| shift(f64::from(*n) / 200.0 * (to - from)).unwrap_or(f64::INFINITY);
        if let Some(best) = (-60..=60).min_by(|a, b| left(a).total_cmp(&left(b))) {
            let (by, (name, unit)) = (f64::from(best) / 200.0 * (to - from), self.key());
            let cause = format!("if about {} {unit} were added to {name}: where is its origin?", rounded(by));
            add(cause, Some(left(&best)));
        }
        if let Along::Place { length, .. } = self.along {
            let mirrored = self.error(&rows, |x| self.exact_at(length - x));
            add("if the bar were turned around: which end is held?".into(), mirrored);
        }
        all
    }

    fn keys_of_reference(&self) -> Vec<f64> {
        let to = match self.along {
            Along::Time { until, .. } => until,
            Along::Place { length, .. } => length,
        };
        // Middles of cells: no row falls upon a jump.
        (0..400).map(|n| (f64::from(n) + 0.5) / 400.0 * to).collect()
    }

    fn columns(&self, of: impl Fn(f64) -> f64) -> Vec<Vec<f64>> {
        let keys = self.keys_of_reference();
        let values = keys.iter().map(|key| of(*key)).collect();
        vec![keys, values]
    }
}

impl Foreign for ForeignBar<'_> {
    fn name(&self) -> String {
        match (self.along, self.quantity) {
            (Along::Place { .. }, _) => "profile".into(),
            (_, quantity) => quantity.word().into(),
        }
    }

    fn what(&self) -> String {
        match self.along {
            Along::Time { x, until } => {
                format!(
                    "{} at x = {} m over time, until {} s",
                    self.quantity.word(),
                    rounded(x),
                    rounded(until)
                )
            }
            Along::Place { t, .. } => {
                format!("{} along the bar at t = {} s", self.quantity.word(), rounded(t))
            }
        }
    }

    fn wanted(&self) -> Vec<Wanted> {
        let (name, unit, short) = self.quantity.column();
        let key = match self.along {
            Along::Time { .. } => Wanted::new("t_s", "s", &["t", "time"], "time after the release"),
            Along::Place { .. } => {
                Wanted::new("x_m", "m", &["x"], "place in the bar at rest, from its left end")
            }
        };
        vec![key, Wanted::new(name, unit, short, self.what())]
    }

    fn keys(&self) -> Keys {
        Keys::Growing(self.key().0)
    }

    fn problem(&self) -> Vec<(&'static str, String)> {
        self.problem.clone()
    }

    fn claims(&self, place: &Place) -> Vec<Claim> {
        let (kind, most, basis, why) = self.bound();
        let norm = if kind == ErrorKind::L1Relative { "mean" } else { "root mean square" };
        let quantity = format!("{norm} error of the {}, over the {norm} of the exact one", self.what());
        vec![
            claim(place, "check_error", quantity).at_most(kind, most).because(basis, why).source(self.source),
        ]
    }

    fn judge(&self, data: &Data, place: &Place) -> Answer {
        let keys = data.of(self.key().0);
        let rows: Vec<(f64, f64)> =
            keys.iter().copied().zip(data.of(self.quantity.column().0).iter().copied()).collect();
        let (name, unit) = self.key();
        let evidence = match covers(keys, self.range(), name, unit) {
            Err(lack) => Evidence { outside: Some(lack), ..Evidence::default() },
            Ok(()) => {
                let error = self.error(&rows, |key| self.exact_at(key));
                let bound = self.bound().1;
                let failed = error.is_some_and(|error| error > bound);
                let cause = if failed { likely(error, bound, self.suspects(&rows)) } else { String::new() };
                Evidence { computed: error, ..error_of(error, format!("{} rows{cause}", rows.len())) }
            }
        };
        let (_, to) = self.range();
        let reference = self.columns(|key| self.exact_at(key));
        let view = View {
            across: if name == "t_s" { "t (ms)".into() } else { "x (m)".into() },
            up: if self.quantity == Quantity::Strain {
                "strain (10⁻⁶)".into()
            } else {
                "displacement (µm)".into()
            },
            unit: [if name == "t_s" { 1e-3 } else { 1.0 }, 1e-6],
            rows: rows
                .iter()
                .map(|&(key, value)| {
                    (key, value, (0.0..=1.02 * to).contains(&key).then(|| self.exact_at(key)))
                })
                .collect(),
            reference: reference[0].iter().copied().zip(reference[1].iter().copied()).collect(),
            judged: None,
            markers: false,
        };
        let caption = format!("{} that was brought, beside d'Alembert's solution.", self.what());
        Answer {
            evidence: vec![("check_error".into(), evidence)],
            tables: vec![view.table(place, &self.name())],
            figures: vec![view.figure(place, self.title, &caption)],
            ..Answer::default()
        }
    }

    fn reference(&self) -> Vec<Vec<f64>> {
        self.columns(|key| self.exact_at(key))
    }

    fn mistakes(&self) -> Vec<Mistake> {
        let strain_plane = (1.2_f64).sqrt();
        let faster = |key: f64| match self.along {
            Along::Time { x, .. } => (self.exact)(x, strain_plane * key),
            Along::Place { t, .. } => (self.exact)(key, strain_plane * t),
        };
        let by = 0.1 * self.range().1;
        let mut all = vec![
            Mistake {
                what: "the sign flipped",
                columns: self.columns(|key| -self.exact_at(key)),
                cause: "sign convention",
            },
            Mistake {
                what: "twice as large, as pulled at two ends",
                columns: self.columns(|key| 2.0 * self.exact_at(key)),
                cause: "1/2",
            },
            Mistake {
                what: "in mm", columns: self.columns(|key| 1e3 * self.exact_at(key)), cause: "10⁻³"
            },
            Mistake {
                what: "the modulus of a plate in plane strain",
                columns: self.columns(faster),
                cause: "plane strain",
            },
        ];
        if let Along::Time { .. } = self.along {
            let columns = self.columns(|key| self.exact_at((key - by).max(0.0)));
            all.push(Mistake { what: "times shifted by a tenth", columns, cause: "origin" });
        }
        all
    }
}
