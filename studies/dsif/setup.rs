//! One cracked plate on one lattice: its scene, the nodes around its tip, and the march that they are watched in.

use super::extraction::Extraction;
use super::load::Load;
use super::plate::{Cracked, PlateAsked};
use crate::subject::Subject;
use pd_verify::lattice::Lattice;
use pd_verify::material::{Body, Material};
use pd_verify::plan::Plan;
use pd_verify::record::{Patch, Record};
use pd_verify::scene::{Probe, Scene, StepRule, Time, Watch, Wrong};
use pd_verify::stress_intensity::{Elastic, Faces, Sites, Tip};

/// What is marched, whatever the lattice.
#[derive(Debug, Clone)]
pub struct Problem {
    pub material: Material,
    pub body: Body,
    pub plate: PlateAsked,
    pub load: Load,
    /// When the march ends, in s after the nominal start of the load.
    pub until: f64,
    /// Δt over the lattice's limit.
    pub safety: f64,
}

/// A plate on one lattice, ready to march.
#[derive(Debug, Clone)]
pub struct Setup {
    pub lattice: Lattice,
    pub plate: Cracked,
    pub scene: Scene<2>,
    pub plan: Plan,
    pub tip: Tip,
    pub elastic: Elastic,
    load: Load,
}

/// The part of the lattice's limit on Δt that is taken by default: leapfrog disperses least near the limit.
pub const SAFETY: f64 = 0.9;
/// Looks at the tip over a march, about.
const LOOKS: u64 = 400;
/// Name of the probe.
const SEEN: &str = "tip";

/// The nodes around a tip over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// In s after the nominal start of the load.
    pub times: Vec<f64>,
    /// Per look and node, in m.
    pub displacement: Vec<Vec<[f64; 2]>>,
    /// In m/s².
    pub acceleration: Vec<Vec<[f64; 2]>>,
    /// What the faces bear.
    pub faces: Vec<Faces>,
}

impl Problem {
    /// The plate with cells of `dx` m, watched as far around its tip as the extractions look and `around` m at least;
    /// `limit` is the lattice's limit on cΔt/Δx if it is known.
    pub fn on(
        &self,
        lattice: Lattice,
        dx: f64,
        extractions: &[Extraction],
        around: f64,
        limit: Option<f64>,
    ) -> Result<Setup, Wrong> {
        let plate = self.plate.on(dx)?;
        let horizon = lattice.m * dx;
        let elastic = Elastic::of(self.material, self.body)
            .ok_or_else(|| Wrong::new("plate.body", "a bar has no crack", "take a plate"))?;
        for (index, extraction) in extractions.iter().enumerate() {
            check_room(extraction, &plate, horizon)
                .map_err(|wrong| wrong.inside(&format!("extraction[{index}]")))?;
        }
        let reach = extractions.iter().map(|one| one.reach(horizon, dx)).fold(around.max(4.0 * dx), f64::max);
        let size = plate.nodes.map(|count| count as f64 * dx);
        let box_ = [-reach, reach].map(|by| [0, 1].map(|axis| (plate.tip[axis] + by).clamp(0.0, size[axis])));
        let time = Time { duration: self.until + self.load.before(), step: StepRule::OfLimit(self.safety) };
        let mut scene = Scene {
            edges: plate.edges(),
            notches: vec![plate.notch()],
            surface: plate.surface,
            effects: self.load.effects(),
            ..Scene::bare(self.material, self.body, lattice, plate.nodes, dx, time)
        };
        let patch = Patch::of(&scene.grid(0), box_[0], box_[1]);
        let first = [0, 1].map(|axis| (patch.first[axis] as f64 + 0.5) * dx - plate.tip[axis]);
        let sites = Sites { nodes: patch.nodes, spacing: dx, first };
        let speed = scene.speed();
        let plan = limit.map_or_else(|| Plan::of(&scene), |limit| Plan::below(&scene, limit * dx / speed))?;
        let every = (plan.steps / LOOKS).max(1);
        scene.probes =
            vec![Probe { name: SEEN.into(), watch: Watch::Patch { from: box_[0], to: box_[1] }, every }];
        let plan = plan.paced(&scene)?;
        let tip = Tip { sites, horizon, crack: plate.free_crack(horizon) };
        for (index, extraction) in extractions.iter().enumerate() {
            let prepared = extraction.prepare(&tip, &elastic);
            prepared.map_err(|no| Wrong::new(format!("extraction[{index}]"), no.to_string(), no.cure()))?;
        }
        Ok(Setup { lattice, plate, scene, plan, tip, elastic, load: self.load.clone() })
    }
}

/// Refuses a tip nearer to an edge than an extraction looks.
fn check_room(extraction: &Extraction, plate: &Cracked, horizon: f64) -> Result<(), Wrong> {
    extraction.check_size(horizon, plate.spacing)?;
    let reach = extraction.reach(horizon, plate.spacing);
    if reach <= plate.room() {
        return Ok(());
    }
    let message = format!(
        "the tip lies {} m from an edge, and {} looks {} m around it",
        plate.room(),
        extraction.name,
        crate::rounded::rounded(reach)
    );
    Err(Wrong::new("", message, "take a smaller outer radius, a smaller dx_m, or a larger plate"))
}

impl Setup {
    /// cΔt/Δx at the lattice's limit.
    pub fn limit(&self) -> f64 {
        self.plan.time_step_s / self.plan.time_step_over_limit * self.scene.speed() / self.scene.spacing
    }

    /// Marches it and takes what its probe saw.
    pub fn march(&self, subject: &dyn Subject) -> Result<Seen, String> {
        let record = subject.march_plate(&self.scene).map_err(|failure| failure.to_string())?;
        self.seen(&record)
    }

    fn seen(&self, record: &Record) -> Result<Seen, String> {
        let trace = record.trace(SEEN).ok_or("nothing was seen of the tip")?;
        let count = self.tip.sites.count();
        if trace.rows.iter().any(|row| row.len() != 4 * count) {
            return Err("the probe at the tip saw other nodes than were asked for".into());
        }
        let pick =
            |row: &[f64], at: usize| row.chunks_exact(4).map(|node| [node[at], node[at + 1]]).collect();
        let times: Vec<f64> = trace.times.iter().map(|t| t - self.load.before()).collect();
        Ok(Seen {
            faces: times.iter().map(|&t| self.load.faces_at(t)).collect(),
            displacement: trace.rows.iter().map(|row| pick(row, 0)).collect(),
            acceleration: trace.rows.iter().map(|row| pick(row, 2)).collect(),
            times,
        })
    }

    /// K_I and K_II in Pa√m at each look, over their tip factors.
    pub fn read(
        &self,
        subject: &dyn Subject,
        seen: &Seen,
        extraction: &Extraction,
        factors: [f64; 2],
    ) -> Result<Vec<[f64; 2]>, String> {
        let prepared = extraction.prepare(&self.tip, &self.elastic).map_err(|no| no.to_string())?;
        let at = |look: usize| {
            let (u, a) = (&seen.displacement[look], &seen.acceleration[look]);
            let k = subject.stress_intensity(&prepared.reading, u, a, seen.faces[look]);
            [k[0] / factors[0], k[1] / factors[1]]
        };
        Ok((0..seen.times.len()).map(at).collect())
    }
}
