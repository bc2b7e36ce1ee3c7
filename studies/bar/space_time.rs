//! `asks = "space_time"`: the strain of a released bar over place and time, and what it has beside the exact one.

use super::released::{BarAsked, LINE, Released, evenly, marching, planned, whole_bar};
use crate::dispersion::sweep::LatticeSweep;
use crate::question::{Answer, Claiming, Place, Planned, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::record::Trace;
use pd_verify::report::plot::{Axis, Figure, Raster};
use pd_verify::scene::{Positive, Scene, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written; one lattice.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpaceTimeAsked {
    pub bar: BarAsked,
    pub dx_m: Positive,
    pub duration_s: Positive,
    /// Largest time step over the limit; default 0.8.
    pub safety: Option<Positive>,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct SpaceTime {
    title: String,
    bar: Released,
    scene: Scene<1>,
    plan: Plan,
}

/// Cells of the picture along the bar and along time, at most.
const COLUMNS: usize = 200;
const ROWS: u64 = 160;

impl Asked for SpaceTimeAsked {
    type Question = SpaceTime;

    fn check(&self, written: &Written<'_>) -> Result<SpaceTime, Wrong> {
        let bar = self.bar.check(written.material()?)?;
        let lattices = self.lattice.marched(Body::Bar, 2).map_err(|wrong| wrong.inside("lattice"))?;
        let [lattice] = lattices[..] else {
            return Err(Wrong::new("lattice", "a picture shows one lattice", "give one value for each key"));
        };
        let scene =
            bar.scene(lattice, self.dx_m.0, marching(self.duration_s, None, self.safety)?, Vec::new())?;
        let (scene, plan) = planned(scene, |steps| vec![whole_bar(steps.div_ceil(ROWS).max(1))])?;
        Ok(SpaceTime { title: written.title.to_owned(), bar, scene, plan })
    }
}

impl Question for SpaceTime {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        vec![
            claim(place, "modes", "largest displacement error of any node against modes carried by leapfrog")
                .at_most(ErrorKind::MaxOfPeak, 1e-10)
                .because(Basis::Rounding, "some 1e-16 a step")
                .source("modes of the mirrored lattice, frequencies in double-double arithmetic"),
        ]
    }

    fn scenes(&self) -> Vec<Planned> {
        vec![self.plan.clone()]
    }

    fn equations(&self) -> &'static str {
        "ε(x, t) = ½[s(x − vt) + s(x + vt)] F₀/(EA), s = 1 for |x| < L, −1 up to 3L, of period 4L"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let record = match subject.march_bar(&self.scene) {
            Ok(record) => record,
            Err(failure) => return Answer::failed(&self.claims(place), &failure.to_string()),
        };
        let Some(bar) = record.trace(LINE) else { return Answer::default() };
        Answer {
            evidence: vec![(
                "modes".into(),
                error_of(self.against_modes(bar), format!("{} times", bar.times.len())),
            )],
            tables: Vec::new(),
            figures: vec![self.figure(bar, place)],
            ..Answer::default()
        }
    }
}

impl SpaceTime {
    fn against_modes(&self, bar: &Trace) -> Option<f64> {
        let modes = self.bar.modes(&self.scene, Some(self.bar.courant(&self.scene, &self.plan)))?;
        largest(bar.times.iter().zip(&bar.rows).flat_map(|(&t, row)| {
            let exact = modes.displacements(self.bar.cell_times(&self.scene, t));
            row.iter().zip(exact).map(|(u, exact)| (u / self.bar.peak() - exact).abs()).collect::<Vec<_>>()
        }))
    }

    fn figure(&self, bar: &Trace, place: &Place) -> Figure {
        let nodes = self.scene.nodes[0];
        let cells = COLUMNS.min(nodes - 1);
        let (dx, strain) = (self.scene.spacing, self.bar.exact.strain);
        // A cell of the picture shows the strain between the nodes at its ends.
        let ends = |cell: usize| [cell * (nodes - 1) / cells, (cell + 1) * (nodes - 1) / cells];
        let seen = |row: &[f64], cell: usize| {
            let [a, b] = ends(cell);
            (row[b] - row[a]) / ((b - a) as f64 * dx * strain)
        };
        let exact = |t: f64, cell: usize| {
            let [a, b] = ends(cell).map(|n| self.bar.exact.displacement_at((n as f64 + 0.5) * dx, t));
            let [i, j] = ends(cell);
            (b - a) / ((j - i) as f64 * dx * strain)
        };
        let picture = |of: &dyn Fn(f64, &[f64], usize) -> f64| -> Vec<Vec<Option<f64>>> {
            let line = |(&t, row): (&f64, &Vec<f64>)| (0..cells).map(|cell| Some(of(t, row, cell))).collect();
            bar.times
                .iter()
                .zip(&bar.rows)
                .take(evenly(&self.plan, &self.scene.probes[0]))
                .map(line)
                .collect()
        };
        let axes = || {
            let rows = evenly(&self.plan, &self.scene.probes[0]);
            let time = 1e3 * bar.times.get(rows - 1).copied().unwrap_or(0.0);
            (
                Axis::linear("x (m)").range(0.0, self.bar.exact.length),
                Axis::linear("time (ms)").range(0.0, time),
            )
        };
        let panel = |title: &str, label: &str, values| {
            let (x, y) = axes();
            Raster::new(x, y, Axis::linear(label), values).titled(title).diverging(0.0)
        };
        let marched = panel("Marched", "strain / (F₀/EA)", picture(&|_, row, cell| seen(row, cell)));
        let error = picture(&|t, row, cell| seen(row, cell) - exact(t, cell));
        let error = panel("Marched less exact", "strain error / (F₀/EA)", error);
        let caption = "Strain over place and time: fronts run from the free end at the right, and ripples follow each of them.";
        Figure::new(place.case.clone(), self.title.clone(), caption, marched).panel(error)
    }
}
