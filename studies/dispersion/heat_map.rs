//! `asks = "heat_map"`: worst phase error over directions and branches, by kernel, p and m, at equal nodes per wave.

use super::curve::{Curve, Medium};
use super::lattice_table::{lattice_row, lattice_table};
use super::moduli::sound_in_plane as sound;
use super::sweep::{LatticeSweep, check_sizes, distinct, unusable};
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::dispersion::{Branch, Wave};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::report::plot::{Axis, Figure, HeatMap as HeatMapPanel};
use pd_verify::scene::{Positive, Wrong};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::TAU;

/// The case as written; plane stress and plane strain have the same answer.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeatMapAsked {
    /// Wavelength over Δx, above 2.
    pub nodes_per_wavelength: Positive,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct HeatMap {
    title: String,
    nodes_per_wavelength: f64,
    lattices: Vec<Lattice>,
}

impl Asked for HeatMapAsked {
    type Question = HeatMap;

    fn check(&self, written: &Written<'_>) -> Result<HeatMap, Wrong> {
        if self.nodes_per_wavelength.0 <= 2.0 {
            let message =
                format!("{} nodes per wavelength are no wave on a grid", self.nodes_per_wavelength.0);
            return Err(Wrong::new("nodes_per_wavelength", message, "take more than 2, for example 20"));
        }
        let lattices = self.lattice.lattices().map_err(|wrong| wrong.inside("lattice"))?;
        check_sizes(Body::PlaneStress, &lattices).map_err(|wrong| wrong.inside("lattice"))?;
        let refused = |lattice: &Lattice| unusable(Body::PlaneStress, *lattice);
        if lattices.iter().all(|lattice| refused(lattice).is_some())
            && let Some(reason) = lattices.first().and_then(refused)
        {
            return Err(Wrong::new("lattice.m", reason.to_string(), reason.cure()));
        }
        Ok(HeatMap {
            title: written.title.to_owned(),
            nodes_per_wavelength: self.nodes_per_wavelength.0,
            lattices,
        })
    }
}

const DIRECTIONS: [f64; 4] = [0.0, 15.0, 30.0, 45.0];

impl Question for HeatMap {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        vec![
            claim(place, "worst_phase_error", "largest error of the worst phase error, over all cells")
                .at_most(ErrorKind::Absolute, 1e-13)
                .because(Basis::Rounding, "2×2 eigenvalues of sums of positive terms")
                .source("the same matrices summed in double-double arithmetic"),
        ]
    }

    fn effort(&self) -> Effort {
        let count = self.lattices.len() as u64;
        let bonds: f64 = self.lattices.iter().map(|lattice| 1.6 * lattice.m * lattice.m).sum();
        let waves = 2 * DIRECTIONS.len() as u64;
        Effort {
            curves: count,
            evaluations: count * waves,
            bond_evaluations: bonds as u64 * waves,
            reference_evaluations: count * waves,
            ..Effort::default()
        }
    }

    fn equations(&self) -> &'static str {
        "max over θ and branch of |ω/(ck) − 1|, at kΔx = 2π/(nodes per wavelength)"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let found: Vec<(Option<f64>, Option<f64>)> =
            self.lattices.par_iter().map(|&lattice| self.cell(subject, lattice)).collect();
        let differences = found.iter().filter_map(|(mine, exact)| match (mine, exact) {
            (Some(mine), Some(exact)) => Some((mine - exact).abs()),
            (None, None) => None,
            _ => Some(f64::INFINITY),
        });
        let cells = found.iter().filter(|(mine, _)| mine.is_some()).count();
        let evidence =
            vec![("worst_phase_error".into(), error_of(largest(differences), format!("{cells} cells")))];
        let mut table = lattice_table("worst_phase_error.csv", &["k_dx", "worst_phase_error_percent"]);
        for (&lattice, (mine, _)) in self.lattices.iter().zip(&found) {
            let own = [self.k_dx().into(), mine.map(|error| 100.0 * error).into()];
            table.push(lattice_row(&place.case, Body::PlaneStress, lattice, own));
        }
        let values: Vec<Option<f64>> =
            found.iter().map(|(mine, _)| mine.map(|error| 100.0 * error)).collect();
        Answer { evidence, tables: vec![table], figures: self.figure(&values, place), ..Answer::default() }
    }
}

impl HeatMap {
    fn k_dx(&self) -> f64 {
        TAU / self.nodes_per_wavelength
    }

    /// Worst phase error by the code under judgement and by the reference; `None` where the lattice is unusable.
    fn cell(&self, subject: &dyn Subject, lattice: Lattice) -> (Option<f64>, Option<f64>) {
        let medium = Medium::Lattice { lattice, dx: 1.0 };
        let worst = |wave: &dyn Fn(&Curve) -> Option<Wave>| {
            let curves = [Branch::P, Branch::S].into_iter().flat_map(|branch| {
                DIRECTIONS.map(|degrees| Curve {
                    body: Body::PlaneStress,
                    medium,
                    courant: None,
                    branch,
                    degrees,
                })
            });
            largest(
                curves
                    .map(|curve| wave(&curve).map_or(f64::NAN, |wave| (wave.phase(self.k_dx()) - 1.0).abs())),
            )
        };
        let mine = worst(&|curve| curve.prepare(subject).ok()?.wave(self.k_dx()));
        (
            mine.filter(|_| subject.plane_stencil(lattice).is_ok()),
            worst(&|curve| curve.reference(self.k_dx())).filter(|_| sound(lattice)),
        )
    }

    /// One panel for each volume rule and calibration: kernels down, m across.
    fn figure(&self, values: &[Option<f64>], place: &Place) -> Vec<Figure> {
        let kernels = distinct(self.lattices.iter().map(|lattice| lattice.kernel));
        let sizes = distinct(self.lattices.iter().map(|lattice| lattice.m));
        let kinds = distinct(self.lattices.iter().map(|lattice| (lattice.volume_rule, lattice.calibrated)));
        let largest_shown = values.iter().flatten().copied().fold(0.0, f64::max).max(1e-3);
        let smallest_shown = values.iter().flatten().copied().fold(largest_shown, f64::min).max(1e-3);
        // Cells of one value, or of one cell, need a scale around it.
        let single = largest_shown < smallest_shown * (1.0 + 1e-9);
        let spread = if single { 2.0 } else { 1.0 };
        let panels = kinds.into_iter().map(|(volume_rule, calibrated)| {
            let value = |kernel: Kernel, m: f64| {
                let wanted = Lattice { kernel, m, volume_rule, calibrated };
                let at = self.lattices.iter().position(|lattice| *lattice == wanted)?;
                values[at]
            };
            let rows =
                kernels.iter().map(|&kernel| sizes.iter().map(|&m| value(kernel, m)).collect()).collect();
            let title =
                format!("{}, {}", volume_rule.name(), if calibrated { "calibrated" } else { "as printed" });
            HeatMapPanel::new(
                ("m = δ/Δx", sizes.iter().map(f64::to_string).collect()),
                ("kernel", kernels.iter().map(Kernel::to_string).collect()),
                Axis::log("worst phase error (%)").range(smallest_shown / spread, largest_shown * spread),
                rows,
            )
            .titled(title)
        });
        let mut panels = panels.collect::<Vec<_>>().into_iter();
        let Some(first) = panels.next() else { return Vec::new() };
        let title = format!("{}, {} nodes per wavelength", self.title, self.nodes_per_wavelength);
        let figure = Figure::new(
            place.case.clone(),
            title,
            "Largest error of the phase speed over P and S waves at 0°, 15°, 30° and 45°, at a fixed number of nodes per wavelength, so that the horizon grows with m. Hatched where the lattice is refused.",
            first,
        );
        vec![panels.fold(figure, Figure::panel)]
    }
}
