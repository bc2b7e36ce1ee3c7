//! `asks = "statics"`: a bar at rest. Uniform strain is kept; free ends are softer than the bulk; a surface correction
//! changes that. Against an independent solution of the same lattice.

use super::names::names;
use super::pulsed::{PlainBarAsked, material};
use super::released::LINE;
use super::statics_report;
use super::stretched::{Ends, Pulled, middle_modulus, recovered_modulus};
use crate::dispersion::curve::reference_lattice;
use crate::dispersion::sweep::{LatticeSweep, distinct};
use crate::input::{OneOrMany, one_or_many};
use crate::levels::{furthest, order_of, refining};
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::forces::surface::Correction;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::scene::{Positive, Scene, Wrong};
use pd_verify::verdict::Evidence;
use pd_verify_reference::front::Front;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::PI;

/// The case as written: both ends free, pulled apart by σ.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StaticsAsked {
    pub bar: PlainBarAsked,
    /// σ.
    pub stress_pa: Positive,
    /// Cells at each end that carry the load; default 1, a traction.
    pub layer_cells: Option<u32>,
    /// Falling, at least three.
    pub dx_m: Vec<Positive>,
    /// Default: `none`.
    pub correction: Option<OneOrMany<Correction>>,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct Statics {
    pub title: String,
    pub bar: Pulled,
    pub spacings: Vec<f64>,
    pub corrections: Vec<Correction>,
    pub lattices: Vec<Bulk>,
    patches: Vec<Scene<1>>,
    still: Vec<(Scene<1>, Plan)>,
}

/// A lattice and its modulus inside, over E.
pub struct Bulk {
    pub name: String,
    pub lattice: Lattice,
    pub modulus: f64,
}

/// A bar at rest.
pub struct Rested {
    /// Index in [`Statics::lattices`].
    pub bulk: usize,
    pub correction: Correction,
    pub spacing: f64,
    /// Over σΔx/E.
    pub displacements: Vec<f64>,
    pub recovered: f64,
    pub middle: f64,
    /// What a local bar under the same load shows, over its modulus.
    pub local: f64,
    /// Largest difference from the reference over its largest displacement.
    pub far: f64,
}

impl Rested {
    /// How much further the ends move apart than in a local bar of the bulk's modulus under the same load, over σL/E of
    /// that modulus. Negative where the ends are too stiff.
    pub fn softness(&self, bulk: &Bulk) -> f64 {
        bulk.modulus / self.recovered - 1.0 / self.local
    }
}

/// Horizons from an end beyond which its disturbance is looked for.
const FAR: f64 = 3.0;

/// Softness below this may be rounding.
const FLOOR: f64 = 1e-9;

impl Asked for StaticsAsked {
    type Question = Statics;

    fn check(&self, written: &Written<'_>) -> Result<Statics, Wrong> {
        let layer = self.layer_cells.unwrap_or(1) as usize;
        let bar = Pulled::new(self.bar, material(written)?, self.stress_pa, layer);
        let spacings = refining("dx_m", &self.dx_m, |coarse, fine| coarse > fine)?;
        let fewest = (bar.length / spacings[0]).round() as usize;
        if layer == 0 || 8 * layer > fewest {
            let message =
                format!("{layer} loaded cells at each end of {fewest} are none or reach the middle");
            return Err(Wrong::new("layer_cells", message, format!("take 1 to {}", fewest / 8)));
        }
        let lattices = self
            .lattice
            .marched(Body::Bar, 2 * (spacings.len() + 3))
            .map_err(|wrong| wrong.inside("lattice"))?;
        let corrections =
            distinct(self.correction.clone().unwrap_or_else(|| one_or_many(Correction::None)).0);
        let (mut patches, mut still) = (Vec::new(), Vec::new());
        for &lattice in &lattices {
            for &correction in &corrections {
                let scene = |spacing, ends| {
                    let scene = bar.scene(lattice, correction, spacing, ends)?;
                    let plan = Plan::of(&scene)?;
                    Ok::<_, Wrong>((scene, plan))
                };
                for &spacing in &spacings {
                    scene(spacing, Ends::Pulled)?;
                }
                for ends in [Ends::Driven, Ends::Mirrored] {
                    patches.push(scene(spacings[0], ends)?.0);
                }
                still.push(scene(spacings[0], Ends::LetGo)?);
            }
        }
        let modulus = |lattice| {
            Front::of(reference_lattice(lattice), None).map_or(f64::NAN, |front| front.speed.powi(2))
        };
        let named = names(&lattices).into_iter().zip(&lattices);
        let bulk = |(name, &lattice): (String, &Lattice)| Bulk { name, lattice, modulus: modulus(lattice) };
        let lattices = named.map(bulk).collect();
        let title = written.title.to_owned();
        Ok(Statics { title, bar, spacings, corrections, lattices, patches, still })
    }
}

/// What conjugate gradients may lose on N nodes, over the largest displacement: 10 εκ.
fn lost(nodes: f64) -> f64 {
    10.0 * f64::EPSILON * 8.0 * (nodes / PI).powi(2)
}

impl Question for Statics {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let nodes = |spacing: f64| self.bar.length / spacing;
        let (coarsest, finest) = (nodes(self.spacings[0]), nodes(self.spacings[self.spacings.len() - 1]));
        let reach = self.lattices.iter().map(|bulk| bulk.lattice.m).fold(1.0, f64::max);
        let conjugate = "conjugate gradients to 1e-14 lose 10 εκ, κ ≤ 8 (N/π)²: the largest eigenvalue is at most 4 Σ w, a corrected bond at most twice as stiff, Σ w ≤ Σ w r², the lattice's modulus, and the smallest is this modulus times (π/N)²";
        let mut claims = vec![
            claim(place, "still", "largest way in one step of nodes inside let go from u = εx, over εL")
                .at_most(ErrorKind::MaxOfPeak, (2.0 * reach + 4.0) * f64::EPSILON)
                .because(Basis::Rounding, "under uniform strain the forces of bonds cancel; each of 2m + 2 terms rounds by ε of εL, times ½(Δt²/ρ)(E/Δx²) Σ w < 1")
                .source("equilibrium of uniform strain inside an infinite lattice"),
            claim(place, "patch", "largest difference from u = εx at rest between driven or mirrored ends, over εL")
                .at_most(ErrorKind::MaxOfPeak, lost(coarsest))
                .because(Basis::Rounding, conjugate)
                .source("uniform strain is at rest where no bond is missing"),
            claim(place, "bulk", "largest relative error of the modulus of the middle half at the finest Δx")
                .at_most(ErrorKind::Relative, 3.0 * lost(finest) + libm::exp(-0.5 * finest / reach))
                .because(Basis::Rounding, "a slope over N/2 nodes errs by three times its displacements; what the ends disturb has decayed as exp(−2x/δ) or faster at L/4; no correction reaches there")
                .source("E Σ w r², the sum in double-double arithmetic"),
            claim(place, "decay", "largest departure of the strain from σ/E inside beyond 3δ from the ends, over the largest near them, at the finest Δx")
                .at_most(ErrorKind::Absolute, libm::exp(-2.0 * FAR))
                .because(Basis::Theory, "outside of what is missing at an end the disturbance is a sum of the lattice's decaying waves, zeros of Σ w_r (2 − z^r − z^(−r)): the slowest falls as exp(−2x/δ) or faster for kernels that fall or stay")
                .source("E Σ w r², the sum in double-double arithmetic"),
        ];
        for correction in &self.corrections {
            let name = correction.name();
            claims.push(
                claim(
                    place,
                    &format!("agrees_{name}"),
                    format!("largest difference of a displacement from the reference, correction {name}"),
                )
                .at_most(ErrorKind::MaxOfPeak, lost(finest))
                .because(Basis::Rounding, conjugate)
                .source("LDLᵀ of the banded stiffness in double-double arithmetic"),
            );
            claims.push(
                claim(place, &format!("surface_order_{name}"), format!("order in δ at fixed m of the ends' softness E/E_app − 1, correction {name}, furthest lattice"))
                    .order(1.0, 1e-6)
                    .because(Basis::Theory, "a boundary layer is the same in units of Δx at every level, so that L E/E_app = L + cδ exactly; what one end sees of the other, exp(−2L/δ), is below 1e-6 of it")
                    .source("scaling of the lattice's boundary layer"),
            );
        }
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.still.iter().map(|(_, plan)| plan.clone()).collect()
    }

    fn effort(&self) -> Effort {
        // About as many iterations as nodes, each once over all bonds.
        let bonds = |nodes: f64, bulk: &Bulk| nodes * nodes * bulk.lattice.m;
        let each = |bulk: &Bulk| {
            let by_spacing: f64 =
                self.spacings.iter().map(|spacing| bonds(self.bar.length / spacing, bulk)).sum();
            by_spacing + 2.0 * bonds(self.bar.length / self.spacings[0], bulk)
        };
        let bond_evaluations =
            self.lattices.iter().map(each).sum::<f64>() as u64 * self.corrections.len() as u64;
        let count = self.lattices.len() * self.spacings.len() * self.corrections.len();
        let solved = Effort {
            curves: count as u64,
            bond_evaluations,
            reference_evaluations: count as u64,
            ..Effort::default()
        };
        let mut total = Effort::of_scenes(&self.scenes());
        total += solved;
        total
    }

    fn equations(&self) -> &'static str {
        "(E/Δx²) Σ_j f_ij w_ij (u_j − u_i) + b_i = 0, b = ±σ/(layer Δx) on the outermost cells
energy: f_ij = ½(λ_i + λ_j), λ_i = bulk over own energy density under uniform strain; volume: f_ij = 2V₀/(V_i + V_j)
E_app = σL/(u(L) − u(0)), the ends extrapolated from two nodes; E/E_app = 1 + cδ/L, E that of the lattice inside"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        match self.follow(subject) {
            Err(failure) => Answer::failed(&self.claims(place), &failure),
            Ok((rested, patch, still)) => Answer {
                evidence: self.evidence(&rested, patch, still),
                tables: statics_report::tables(self, &rested, place),
                figures: statics_report::figures(self, &rested, place),
                ..Answer::default()
            },
        }
    }
}

impl Statics {
    /// The bars at rest, and what the patch tests and the first step lost.
    fn follow(&self, subject: &dyn Subject) -> Result<(Vec<Rested>, f64, f64), String> {
        let mut asked = Vec::new();
        for bulk in 0..self.lattices.len() {
            for &correction in &self.corrections {
                asked.extend(self.spacings.iter().map(|&spacing| (bulk, correction, spacing)));
            }
        }
        let rested: Vec<Result<Rested, String>> = asked
            .into_par_iter()
            .map(|(bulk, correction, spacing)| self.rest(subject, bulk, correction, spacing))
            .collect();
        let patches: Vec<Result<f64, String>> =
            self.patches.par_iter().map(|scene| self.patch(subject, scene)).collect();
        let still: Vec<Result<f64, String>> =
            self.still.par_iter().map(|(scene, _)| self.moved(subject, scene)).collect();
        let worst = |all: Vec<Result<f64, String>>| -> Result<f64, String> {
            Ok(largest(all.into_iter().collect::<Result<Vec<_>, _>>()?).unwrap_or(f64::NAN))
        };
        Ok((rested.into_iter().collect::<Result<_, _>>()?, worst(patches)?, worst(still)?))
    }

    fn rest(
        &self,
        subject: &dyn Subject,
        index: usize,
        correction: Correction,
        spacing: f64,
    ) -> Result<Rested, String> {
        let bulk = &self.lattices[index];
        let scene =
            self.bar.scene(bulk.lattice, correction, spacing, Ends::Pulled).map_err(|wrong| wrong.message)?;
        let unit = self.bar.strain() * spacing;
        let displacements: Vec<f64> = subject.rest_bar(&scene)?.iter().map(|u| u / unit).collect();
        let reference = self.bar.reference(bulk.lattice, correction, scene.nodes[0]);
        let exact = reference.solve().ok_or("the reference has no such bar")?.displacements;
        if displacements.len() != exact.len() {
            return Err(format!("{} displacements for {} nodes", displacements.len(), exact.len()));
        }
        let peak = largest(exact.iter().map(|u| u.abs())).unwrap_or(f64::NAN);
        let far = largest(displacements.iter().zip(&exact).map(|(a, b)| (a - b).abs() / peak));
        Ok(Rested {
            bulk: index,
            correction,
            spacing,
            recovered: recovered_modulus(&displacements),
            middle: middle_modulus(&displacements),
            local: reference.local_modulus(),
            far: far.unwrap_or(f64::NAN),
            displacements,
        })
    }

    /// u = εx at node j, over εL.
    fn uniform(&self, spacing: f64, j: usize) -> f64 {
        (j as f64 + 0.5) * spacing / self.bar.length
    }

    fn patch(&self, subject: &dyn Subject, scene: &Scene<1>) -> Result<f64, String> {
        let peak = self.bar.strain() * self.bar.length;
        let rest = subject.rest_bar(scene)?;
        let far = rest.iter().enumerate().map(|(j, u)| (u / peak - self.uniform(scene.spacing, j)).abs());
        Ok(largest(far).unwrap_or(f64::NAN))
    }

    /// How far nodes whose bonds and whose neighbours' bonds are all there go in one step.
    fn moved(&self, subject: &dyn Subject, scene: &Scene<1>) -> Result<f64, String> {
        let record = subject.march_bar(scene).map_err(|failure| failure.to_string())?;
        let trace = record.trace(LINE).ok_or("the bar was not recorded")?;
        let last = trace.rows.last().ok_or("the bar was not looked at")?;
        let peak = self.bar.strain() * self.bar.length;
        let band = 2 * scene.lattice.m.ceil() as usize;
        let inside = last.iter().enumerate().take(last.len() - band).skip(band);
        let far = inside.map(|(j, u)| (u / peak - self.uniform(scene.spacing, j)).abs());
        Ok(largest(far).unwrap_or(f64::NAN))
    }

    /// The bars of a lattice and a correction, by falling Δx.
    pub fn levels<'a>(
        &self,
        rested: &'a [Rested],
        bulk: usize,
        correction: Correction,
    ) -> impl Iterator<Item = &'a Rested> {
        rested.iter().filter(move |one| one.bulk == bulk && one.correction == correction)
    }

    /// (δ, |softness|) of a lattice and a correction.
    pub fn softnesses(&self, rested: &[Rested], bulk: usize, correction: Correction) -> Vec<(f64, f64)> {
        let of = &self.lattices[bulk];
        let levels = self.levels(rested, bulk, correction);
        levels.map(|one| (of.lattice.m * one.spacing, one.softness(of).abs())).collect()
    }

    /// The largest departure of the strain from that inside beyond [`FAR`] over the largest of all.
    fn departure(&self, one: &Rested) -> f64 {
        let bulk = &self.lattices[one.bulk];
        let cells = one.displacements.len() as f64;
        let faces = one.displacements.windows(2).zip(1..);
        let all: Vec<(f64, f64)> = faces
            .map(|(u, face)| {
                let end = f64::from(face).min(cells - f64::from(face));
                (end / bulk.lattice.m, (bulk.modulus * (u[1] - u[0]) - 1.0).abs())
            })
            .collect();
        let most = |beyond: f64| largest(all.iter().filter(|(x, _)| *x > beyond).map(|(_, far)| *far));
        most(FAR).zip(most(0.0)).map_or(f64::NAN, |(far, all)| far / all)
    }

    fn evidence(&self, rested: &[Rested], patch: f64, still: f64) -> Vec<(String, Evidence)> {
        let finest = self.spacings[self.spacings.len() - 1];
        let at_finest = rested.iter().filter(|one| one.spacing == finest);
        let bulk = at_finest.clone().map(|one| (one.middle / self.lattices[one.bulk].modulus - 1.0).abs());
        let decays = at_finest.map(|one| self.departure(one));
        let bars = |count: usize| format!("{count} bars");
        let mut evidence = vec![
            ("still".into(), error_of(Some(still), bars(self.still.len()))),
            ("patch".into(), error_of(Some(patch), bars(self.patches.len()))),
            ("decay".into(), error_of(largest(decays), bars(self.lattices.len() * self.corrections.len()))),
            ("bulk".into(), error_of(largest(bulk), bars(self.lattices.len() * self.corrections.len()))),
        ];
        for &correction in &self.corrections {
            let name = correction.name();
            let mine = rested.iter().filter(|one| one.correction == correction);
            let far = largest(mine.clone().map(|one| one.far));
            evidence.push((format!("agrees_{name}"), error_of(far, bars(mine.count()))));
            let orders = (0..self.lattices.len()).map(|bulk| {
                let levels = self.softnesses(rested, bulk, correction);
                order_of(&self.lattices[bulk].name, &levels, 1.0, FLOOR)
            });
            evidence.extend(furthest(orders, 1e-6).map(|found| (format!("surface_order_{name}"), found)));
        }
        evidence
    }
}
