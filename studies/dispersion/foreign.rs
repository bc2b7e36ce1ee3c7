//! A dispersion curve of another code, held against the same curve in double-double arithmetic.

use super::curve::{Curve, Medium};
use crate::foreign::{Data, Foreign, Keys, Mistake, Suspect, View, Wanted, likely, scaled};
use crate::question::{Answer, Claiming, Place, claim, error_of};
use crate::rounded::rounded;
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::dispersion::Branch;
use pd_verify::dispersion::plane::speed_ratio_squared;
use pd_verify::lattice::Lattice;
use pd_verify::material::{Body, Material};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::verdict::Evidence;

/// One curve of a case.
pub struct ForeignCurve<'a> {
    pub title: &'a str,
    /// Unique in the case.
    pub name: String,
    pub curve: Curve,
    /// The others of the case, with their names.
    pub others: Vec<(String, Curve)>,
    pub material: Option<Material>,
    /// The largest k of the case in 1/m.
    pub largest: f64,
}

/// What a frequency may be off by.
const BOUND: f64 = 1e-3;
/// Rows that are judged: each asks the reference for sums of some thousand terms.
const JUDGED: usize = 400;
/// Rows that suspects are tried on.
const TRIED: usize = 24;
/// kδ, or kΔx, to which a curve must reach: below, all of them are straight.
const REACH: f64 = 1.0;

impl ForeignCurve<'_> {
    /// ω/c in 1/m by the reference.
    fn known(curve: &Curve, k: f64) -> Option<f64> {
        curve.reference(k).map(|wave| wave.omega).filter(|omega| omega.is_finite())
    }

    /// Rows (k, ω/c, reference) where there is one, evenly thinned to so many.
    fn beside(curve: &Curve, rows: &[(f64, f64)], most: usize) -> Vec<(f64, f64, Option<f64>)> {
        let every = rows.len().div_ceil(most).max(1);
        let edge = curve.zone_edge().unwrap_or(f64::INFINITY);
        let judged = rows.iter().filter(|(k, _)| *k > 0.0 && *k <= edge * (1.0 + 1e-9)).step_by(every);
        judged.map(|&(k, omega)| (k, omega, Self::known(curve, k))).collect()
    }

    /// The largest relative error of rows whose ω/c is changed by `change`.
    fn error(beside: &[(f64, f64, Option<f64>)], change: impl Fn(f64, f64) -> f64) -> Option<f64> {
        let known = beside.iter().filter_map(|&(k, omega, known)| Some((k, omega, known?)));
        largest(known.map(|(k, omega, known)| (change(k, omega) / known - 1.0).abs()))
    }

    fn suspects(&self, rows: &[(f64, f64)]) -> Vec<Suspect> {
        let own = Self::beside(&self.curve, rows, TRIED);
        let mut all = scaled(|factor| Self::error(&own, |_, omega| factor * omega));
        let mut add = |cause: String, error| all.push(Suspect { cause, error });
        if let Some(half) = self.half_step() {
            let turned = |omega: f64| libm::tan(omega * half) / half;
            add(
                "if tan(ωΔt/2) = ΩΔt/2 were replaced by sin: was another scheme in time taken than leapfrog?"
                    .into(),
                Self::error(&own, |_, omega| self.in_time(turned(omega))),
            );
            add(
                "with sin(ωΔt/2) = ΩΔt/2: is it the frequency in exact time, without leapfrog?".into(),
                Self::error(&own, |_, omega| self.in_time(omega)),
            );
        }
        if self.narrow() {
            let half = 0.5 * self.curve.unit();
            let bent = |omega: f64| libm::sin(libm::atan(omega * half)) / half;
            add(
                "with sin in place of tan: ΩΔx/c = 2 sin(kΔx/2)".into(),
                Self::error(&own, |_, omega| self.in_time(bent(self.in_space(omega)))),
            );
        }
        for (what, other) in self.variants().into_iter().chain(self.others.clone()) {
            let beside = Self::beside(&other, rows, TRIED);
            add(
                format!("as the curve of {what}: was that computed?"),
                Self::error(&beside, |_, omega| omega),
            );
        }
        all
    }

    /// Whether only nearest neighbours act, so that ΩΔx/c = 2 sin(kΔx/2).
    fn narrow(&self) -> bool {
        matches!(self.curve.medium, Medium::FiniteDifferences { .. })
    }

    /// Δt/2 over 1/c in m; none in exact time.
    fn half_step(&self) -> Option<f64> {
        self.curve.own_courant().map(|courant| 0.5 * courant * self.curve.unit())
    }

    /// Ω/c of the space alone from ω/c of leapfrog.
    fn in_space(&self, omega: f64) -> f64 {
        self.half_step().map_or(omega, |half| libm::sin(omega * half) / half)
    }

    /// ω/c of leapfrog from Ω/c; NaN where it is unstable.
    fn in_time(&self, omega: f64) -> f64 {
        self.half_step().map_or(omega, |half| libm::asin(omega * half) / half)
    }

    /// Curves that this one is mistaken for.
    fn variants(&self) -> Vec<(String, Curve)> {
        let curve = self.curve;
        let mut all = Vec::new();
        match curve.medium {
            Medium::Lattice { lattice, dx } => {
                let mut add = |what: String, lattice: Lattice| {
                    all.push((what, Curve { medium: Medium::Lattice { lattice, dx }, ..curve }));
                };
                for m in [lattice.m - 1.0, lattice.m + 1.0].into_iter().filter(|m| *m >= 1.0) {
                    add(format!("m = {m}, one off"), Lattice { m, ..lattice });
                }
                let calibrated = !lattice.calibrated;
                let word =
                    if calibrated { "calibrated weights" } else { "weights as printed, not calibrated" };
                add(word.into(), Lattice { calibrated, ..lattice });
                for volume_rule in [VolumeRule::Full, VolumeRule::Linear] {
                    if volume_rule != lattice.volume_rule {
                        let what = format!("the volume rule {}", volume_rule.name());
                        add(what, Lattice { volume_rule, ..lattice });
                    }
                }
            }
            Medium::Continuum { kernel, horizon } => {
                for (factor, what) in [(0.5, "half the horizon"), (2.0, "twice the horizon")] {
                    let medium = Medium::Continuum { kernel, horizon: factor * horizon };
                    all.push((what.into(), Curve { medium, ..curve }));
                }
            }
            Medium::FiniteDifferences { .. } => {}
        }
        if curve.body != Body::Bar {
            let (branch, what) = match curve.own_branch() {
                Branch::P => (Branch::S, "the S branch"),
                Branch::S => (Branch::P, "the P branch"),
            };
            all.push((what.into(), Curve { branch, ..curve }));
        }
        all
    }

    fn wavenumbers(&self) -> Vec<f64> {
        let edge = self.curve.zone_edge().unwrap_or(f64::INFINITY);
        let most = self.largest.min(0.98 * edge);
        (1..=60).map(|n| f64::from(n) / 60.0 * most).collect()
    }

    fn columns(&self, of: impl Fn(f64) -> Option<f64>) -> Vec<Vec<f64>> {
        let rows = self.wavenumbers().into_iter().filter_map(|k| Some((k, of(k)?)));
        let (k, omega): (Vec<f64>, Vec<f64>) = rows.unzip();
        vec![k, omega]
    }

    fn speed(&self) -> Option<f64> {
        let dilatational = self.material?.dilatational_speed(self.curve.body);
        Some(dilatational * speed_ratio_squared(self.curve.own_branch()).sqrt())
    }
}

impl Foreign for ForeignCurve<'_> {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn what(&self) -> String {
        format!("ω(k) of the curve \"{}\"", self.name)
    }

    fn wanted(&self) -> Vec<Wanted> {
        let omega = "angular frequency over the classical speed of the branch";
        let mut omega = Wanted::new("omega_over_c_per_m", "1/m", &["omega_over_c"], omega);
        omega.instead = self.speed().map(|speed| ("omega_per_s", "1/s", 1.0 / speed));
        vec![
            Wanted::new("k_per_m", "1/m", &["k", "wavenumber"], "wavenumber along the direction of travel"),
            omega,
        ]
    }

    fn keys(&self) -> Keys {
        Keys::Growing("k_per_m")
    }

    fn problem(&self) -> Vec<(&'static str, String)> {
        let curve = &self.curve;
        let body = match curve.body {
            Body::Bar => "a bar",
            Body::PlaneStress => "a plate in plane stress",
            Body::PlaneStrain => "a plate in plane strain",
        };
        let wave = match (curve.body, curve.own_branch()) {
            (Body::Bar, _) => "waves along it".to_owned(),
            (_, Branch::P) => format!("P waves at {}° from the x axis", curve.degrees),
            (_, Branch::S) => format!("S waves at {}° from the x axis", curve.degrees),
        };
        let medium = match curve.medium {
            Medium::Continuum { kernel, horizon } => {
                format!("the continuum of the kernel {kernel} with the horizon δ = {} m", rounded(horizon))
            }
            Medium::Lattice { lattice, dx } => format!(
                "a square lattice of spacing {} m, δ/Δx = {}, kernel {}, volume rule {}, {}",
                rounded(dx),
                lattice.m,
                lattice.kernel,
                lattice.volume_rule.name(),
                if lattice.calibrated {
                    "weights calibrated to the intended moduli"
                } else {
                    "weights as printed"
                }
            ),
            Medium::FiniteDifferences { dx } => format!("central differences of spacing {} m", rounded(dx)),
        };
        let time = match curve.courant {
            Some(courant) => format!("leapfrog with c_d Δt/Δx = {}", rounded(courant)),
            None => "exact time".into(),
        };
        let material = match (self.material, self.speed()) {
            (Some(material), Some(speed)) => format!(
                "E = {} Pa, ρ = {} kg/m³; the classical speed of the branch is c = {} m/s.",
                material.youngs_modulus,
                material.density,
                rounded(speed)
            ),
            _ => "Any: frequencies are over the classical speed of their branch.".into(),
        };
        let reach = format!(
            "Report five wavenumbers or more between 0 and the end of the curve, one of them at least {} 1/m; those beyond the first Brillouin zone are left out. The reference is evaluated at your wavenumbers.",
            rounded(REACH / curve.unit())
        );
        vec![
            ("Medium", format!("Plane {wave} in {body}: {medium}; {time}.")),
            ("Material", material),
            ("Wavenumbers", reach),
        ]
    }

    fn claims(&self, place: &Place) -> Vec<Claim> {
        let quantity = format!("largest relative error of ω(k), {}", self.name);
        vec![
            claim(place, "check_omega", quantity)
                .at_most(ErrorKind::Relative, BOUND)
                .because(Basis::Engineering, "a tenth of the 1 % at which curves are read, and what frequencies measured in a march of some hundred periods reach; formulas evaluated in single precision are far below")
                .source("the defining sums and integrals evaluated term by term in double-double arithmetic (31 digits)"),
        ]
    }

    fn judge(&self, data: &Data, place: &Place) -> Answer {
        let rows: Vec<(f64, f64)> =
            data.of("k_per_m").iter().copied().zip(data.of("omega_over_c_per_m").iter().copied()).collect();
        let beside = Self::beside(&self.curve, &rows, JUDGED);
        let judged: Vec<f64> = beside.iter().filter(|row| row.2.is_some()).map(|row| row.0).collect();
        let reach = judged.iter().fold(0.0_f64, |most, k| most.max(*k)) * self.curve.unit();
        let evidence = if judged.len() < 5 || reach < REACH * (1.0 - 1e-9) {
            let outside = format!(
                "{} wavenumbers between 0 and the edge of the zone, up to {} 1/m: five are needed, one at least {} 1/m",
                judged.len(),
                rounded(reach / self.curve.unit()),
                rounded(REACH / self.curve.unit())
            );
            Evidence { outside: Some(outside), ..Evidence::default() }
        } else {
            let error = Self::error(&beside, |_, omega| omega);
            let failed = error.is_some_and(|error| error > BOUND);
            let cause = if failed { likely(error, BOUND, self.suspects(&rows)) } else { String::new() };
            let left = rows.len() - judged.len();
            let left = if left > 0 { format!(", {left} left out") } else { String::new() };
            Evidence {
                computed: error,
                ..error_of(error, format!("{} wavenumbers{left}{cause}", judged.len()))
            }
        };
        let reference = self.columns(|k| Self::known(&self.curve, k));
        let view = View {
            across: "k (1/m)".into(),
            up: "ω/c (1/m)".into(),
            unit: [1.0, 1.0],
            rows: beside,
            reference: reference[0].iter().copied().zip(reference[1].iter().copied()).collect(),
            judged: None,
            markers: rows.len() <= 100,
        };
        let caption = format!("Frequencies that were brought, beside the curve \"{}\".", self.name);
        Answer {
            evidence: vec![("check_omega".into(), evidence)],
            tables: vec![view.table(place, &self.name)],
            figures: vec![view.figure(place, self.title, &caption)],
            ..Answer::default()
        }
    }

    fn reference(&self) -> Vec<Vec<f64>> {
        self.columns(|k| Self::known(&self.curve, k))
    }

    fn mistakes(&self) -> Vec<Mistake> {
        let of = |curve: &Curve| self.columns(|k| Self::known(curve, k));
        let scaled = |factor: f64| self.columns(|k| Some(factor * Self::known(&self.curve, k)?));
        let mut all = vec![
            Mistake { what: "frequencies in Hz", columns: scaled(0.159_154_943_091_895_35), cause: "in Hz" },
            Mistake { what: "the sign flipped", columns: scaled(-1.0), cause: "sign convention" },
        ];
        if self.narrow() {
            let half = 0.5 * self.curve.unit();
            let columns = self.columns(|k| {
                Some(self.in_time(libm::tan(k * half) / half)).filter(|omega| omega.is_finite())
            });
            all.push(Mistake { what: "tan in place of sin", columns, cause: "sin in place of tan" });
        }
        if let Some((_, other)) = self.variants().iter().find(|(what, _)| what.contains("one off")) {
            all.push(Mistake { what: "m off by one", columns: of(other), cause: "one off" });
        }
        all
    }
}
