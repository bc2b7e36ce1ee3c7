//! `asks = "time_order"`: the march against the lattice's own modes, in exact time and as leapfrog carries them, over Δt.

use super::names::{LATTICE, lattice_cells, names, slug};
use super::released::{BarAsked, LINE, Released, planned, whole_bar};
use crate::dispersion::sweep::LatticeSweep;
use crate::levels::{order_of, pairwise, refining};
use crate::question::{Answer, Claiming, Place, Planned, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::report::plot::{Axis, Figure, Guide, Lines, Marker, Series};
use pd_verify::scene::{Beyond, Positive, Scene, StepRule, Time, Wrong};
use pd_verify::table::{Cell, Table};
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeOrderAsked {
    pub bar: BarAsked,
    pub dx_m: Positive,
    pub duration_s: Positive,
    /// Falling, at least three.
    pub time_step_s: Vec<Positive>,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct TimeOrder {
    title: String,
    bar: Released,
    sequences: Vec<Sequence>,
}

/// A lattice and its scenes, the longest step first.
struct Sequence {
    lattice: Lattice,
    name: String,
    scenes: Vec<(Scene<1>, Plan)>,
}

/// Largest displacement errors over the peak, at one Δt.
struct Level {
    time_step: f64,
    leapfrog: f64,
    exact_time: f64,
}

impl Asked for TimeOrderAsked {
    type Question = TimeOrder;

    fn check(&self, written: &Written<'_>) -> Result<TimeOrder, Wrong> {
        let bar = self.bar.check(written.material()?)?;
        let steps = refining("time_step_s", &self.time_step_s, |coarse, fine| coarse > fine)?;
        let lattices =
            self.lattice.marched(Body::Bar, 2 * steps.len()).map_err(|wrong| wrong.inside("lattice"))?;
        let mut sequences = Vec::new();
        for (&lattice, name) in lattices.iter().zip(names(&lattices)) {
            let scene = |&seconds: &f64| {
                let step = StepRule::Given { seconds, beyond_limit: Beyond::Refused };
                let marching = Time { duration: self.duration_s.0, step };
                let scene = bar.scene(lattice, self.dx_m.0, marching, Vec::new())?;
                planned(scene, |steps| vec![whole_bar((steps / 20).max(1))])
            };
            let scenes = steps.iter().map(scene).collect::<Result<Vec<_>, Wrong>>()?;
            sequences.push(Sequence { lattice, name, scenes });
        }
        Ok(TimeOrder { title: written.title.to_owned(), bar, sequences })
    }
}

impl Question for TimeOrder {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let mut claims = vec![
            claim(
                place,
                "modes",
                "largest displacement error against modes with the frequency (2/Δt) asin(ωΔt/2)",
            )
            .at_most(ErrorKind::MaxOfPeak, 1e-10)
            .because(Basis::Rounding, "some 1e-16 a step")
            .source("modes of the mirrored lattice, frequencies in double-double arithmetic"),
        ];
        claims.extend(self.sequences.iter().map(|sequence| {
            let quantity = format!("order in Δt against modes in exact time: {}", sequence.name);
            claim(place, &format!("order_{}", slug(sequence.lattice)), quantity)
                .order(2.0, 0.05)
                .because(
                    Basis::Theory,
                    "leapfrog is of second order; 0.05 for the fourth-order term at the longest step",
                )
                .source("modes of the mirrored lattice in exact time")
        }));
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.sequences
            .iter()
            .flat_map(|sequence| sequence.scenes.iter().map(|(_, plan)| plan.clone()))
            .collect()
    }

    fn equations(&self) -> &'static str {
        "u_j(t) = Σ a_n sin((2n+1)π(j + ½)/2N) cos ω_n t; exact time: ω_n of the lattice; leapfrog: (2/Δt) asin(ω_nΔt/2)"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let marched: Result<Vec<Vec<Level>>, String> =
            self.sequences.iter().map(|sequence| self.levels(subject, sequence)).collect();
        let levels = match marched {
            Ok(levels) => levels,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        let modes = largest(levels.iter().flatten().map(|level| level.leapfrog));
        let mut evidence: Vec<(String, Evidence)> = vec![("modes".into(), error_of(modes, ""))];
        for (sequence, levels) in self.sequences.iter().zip(&levels) {
            let points: Vec<(f64, f64)> =
                levels.iter().map(|level| (level.time_step, level.exact_time)).collect();
            let order = order_of(&sequence.name, &points, 2.0, 0.0);
            let coarsest =
                points.first().map_or(String::new(), |point| format!(", {:.2e} at {:e} s", point.1, point.0));
            let note = order.note.clone() + &coarsest;
            evidence.push((format!("order_{}", slug(sequence.lattice)), Evidence { note, ..order }));
        }
        Answer {
            evidence,
            tables: vec![self.table(&levels, place)],
            figures: vec![self.figure(&levels, place)],
            ..Answer::default()
        }
    }
}

impl TimeOrder {
    fn levels(&self, subject: &dyn Subject, sequence: &Sequence) -> Result<Vec<Level>, String> {
        let level = |(scene, plan): &(Scene<1>, Plan)| {
            let record = subject.march_bar(scene).map_err(|failure| failure.to_string())?;
            let bar = record.trace(LINE).ok_or("the bar was not recorded")?;
            let far = |courant: Option<f64>| {
                let modes = self.bar.modes(scene, courant)?;
                largest(bar.times.iter().zip(&bar.rows).flat_map(|(&t, row)| {
                    let exact = modes.displacements(self.bar.cell_times(scene, t));
                    row.iter()
                        .zip(exact)
                        .map(|(u, exact)| (u / self.bar.peak() - exact).abs())
                        .collect::<Vec<_>>()
                }))
            };
            let leapfrog = far(Some(self.bar.courant(scene, plan))).ok_or("no stable modes")?;
            let exact_time = far(None).ok_or("no modes")?;
            Ok(Level { time_step: plan.time_step_s, leapfrog, exact_time })
        };
        sequence.scenes.par_iter().map(level).collect()
    }

    fn table(&self, levels: &[Vec<Level>], place: &Place) -> Table {
        let own = [
            "time_step_s",
            "error_against_leapfrog_modes",
            "error_against_modes_in_exact_time",
            "pairwise_order",
        ];
        let mut table = Table::new("bar_time_order.csv", &[&["case"][..], &LATTICE, &own].concat());
        for (sequence, levels) in self.sequences.iter().zip(levels) {
            let points: Vec<(f64, f64)> =
                levels.iter().map(|level| (level.time_step, level.exact_time)).collect();
            for (index, level) in levels.iter().enumerate() {
                let pairwise = pairwise(&points, index);
                let own: [Cell; 4] =
                    [level.time_step.into(), level.leapfrog.into(), level.exact_time.into(), pairwise.into()];
                let start: Vec<Cell> = vec![place.case.clone().into()];
                let spacing = sequence.scenes[index].0.spacing;
                let cells = lattice_cells(Some((sequence.lattice, spacing)));
                table.push(start.into_iter().chain(cells).chain(own).collect::<Vec<_>>());
            }
        }
        table
    }

    fn figure(&self, levels: &[Vec<Level>], place: &Place) -> Figure {
        let mut series = Vec::new();
        for (slot, (sequence, levels)) in self.sequences.iter().zip(levels).enumerate() {
            let of =
                |error: fn(&Level) -> f64| levels.iter().map(|l| (1e9 * l.time_step, error(l))).collect();
            series.push(
                Series::both(format!("{}, exact time", sequence.name), of(|l| l.exact_time)).slot(slot),
            );
            let label = format!("{}, as leapfrog carries the modes", sequence.name);
            series.push(Series::markers(label, of(|l| l.leapfrog)).slot(slot).marker(Marker::Cross));
        }
        let panel = Lines::new(Axis::log("Δt (ns)"), Axis::log("largest displacement error / peak"), series)
            .guide(Guide::Slope { order: 2.0, label: "order 2".into() });
        let caption = "Largest error of the displacements of all nodes over the run, over the peak: second order against \
                       the modes in exact time, rounding against the modes that leapfrog carries.";
        Figure::new(place.case.clone(), self.title.clone(), caption, panel)
    }
}
