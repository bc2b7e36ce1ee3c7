//! The bar of the study: held at the left, stretched by a force at the right, let go; as a scene, and as exact answers.

use crate::dispersion::curve::reference_lattice;
use crate::rounded::rounded;
use crate::scene;
use pd_verify::constraints::{Edge, Edges};
use pd_verify::lattice::Lattice;
use pd_verify::material::{Body, Material};
use pd_verify::plan::Plan;
use pd_verify::scene::{Initial, Positive, Probe, Scene, Shape, Time, Watch, Wrong};
use pd_verify_reference::lattice_modes::LatticeModes;
use pd_verify_reference::released_bar::ReleasedBar;
use schemars::JsonSchema;
use serde::Deserialize;

/// The bar as written.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BarAsked {
    pub length_m: Positive,
    pub section_m2: Positive,
    /// It stretches the bar until t = 0.
    pub force_n: Positive,
}

/// Reads a duration with a step that is either given or a fraction of the limit.
pub fn marching(
    duration: Positive,
    time_step: Option<Positive>,
    safety: Option<Positive>,
) -> Result<Time, Wrong> {
    scene::time::time(duration.0, safety.map(|s| s.0), time_step.map(|s| s.0), None)
}

/// The reference sums all modes at all nodes: more take hours.
const MOST_NODES: usize = 100_000;

/// Whole cells in a length; refused where they do not fill it, or have too many modes.
pub fn cells(length: f64, spacing: f64) -> Result<usize, Wrong> {
    let nodes = scene::size::cells([length], spacing)?.0[0];
    if nodes > MOST_NODES {
        let message =
            format!("{nodes} nodes have too many modes for an exact answer, at most {MOST_NODES} are summed");
        return Err(Wrong::new("dx_m", message, "take a larger spacing or a shorter bar"));
    }
    Ok(nodes)
}

/// The bar, checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Released {
    pub exact: ReleasedBar,
    pub material: Material,
    pub section: f64,
}

impl BarAsked {
    pub fn check(&self, material: Material) -> Result<Released, Wrong> {
        let strain = self.force_n.0 / (material.youngs_modulus * self.section_m2.0);
        let speed = material.dilatational_speed(Body::Bar);
        let exact = ReleasedBar { length: self.length_m.0, speed, strain };
        Ok(Released { exact, material, section: self.section_m2.0 })
    }
}

impl Released {
    /// The problem in words, neutral of any solver.
    pub fn problem(&self) -> Vec<(&'static str, String)> {
        let ReleasedBar { length, speed, strain } = self.exact;
        vec![
            (
                "Geometry",
                format!(
                    "A bar from x = 0 to x = {length} m with a section of {} m²: held at x = 0, free at x = {length} m.",
                    self.section
                ),
            ),
            (
                "Material",
                format!(
                    "Linear elastic, E = {} Pa, ρ = {} kg/m³: waves run at √(E/ρ) = {} m/s. A plate or a body may stand for the bar if its waves along x run at this speed.",
                    self.material.youngs_modulus,
                    self.material.density,
                    rounded(speed)
                ),
            ),
            (
                "Load",
                format!(
                    "Stretched to the strain {} everywhere, u = {} x, at rest, and let go at t = 0; nothing acts afterwards.",
                    rounded(strain),
                    rounded(strain)
                ),
            ),
        ]
    }

    /// The scene: odd mirror at the fixed end, even mirror at the free one, released from u = ε₀x.
    pub fn scene(
        &self,
        lattice: Lattice,
        spacing: f64,
        time: Time,
        probes: Vec<Probe<1>>,
    ) -> Result<Scene<1>, Wrong> {
        let stretched =
            Initial { component: 0, amplitude: self.exact.strain, shape: Shape::Linear { along: 0 } };
        let nodes = [cells(self.exact.length, spacing)?];
        Ok(Scene {
            section: self.section,
            edges: Edges([[Edge::MirrorOdd, Edge::MirrorEven]]),
            displacement: vec![stretched],
            probes,
            ..Scene::bare(self.material, Body::Bar, lattice, nodes, spacing, time)
        })
    }

    /// vΔt/Δx of a scene.
    pub fn courant(&self, scene: &Scene<1>, plan: &Plan) -> f64 {
        self.exact.speed * plan.time_step_s / scene.spacing
    }

    /// The exact motion of the scene's lattice: in exact time, or as leapfrog carries it.
    pub fn modes(&self, scene: &Scene<1>, courant: Option<f64>) -> Option<LatticeModes> {
        LatticeModes::new(reference_lattice(scene.lattice), scene.nodes[0], courant)
    }

    /// t in s as vt/Δx.
    pub fn cell_times(&self, scene: &Scene<1>, seconds: f64) -> f64 {
        self.exact.speed * seconds / scene.spacing
    }

    /// Displacement of the free end before the release: the peak.
    pub fn peak(&self) -> f64 {
        self.exact.strain * self.exact.length
    }
}

/// Names of the probes.
pub const STRAIN: &str = "strain";
pub const POINT: &str = "displacement";
pub const LINE: &str = "bar";

/// Strain and displacement at a place every step, and the whole bar some twenty times.
pub fn probes(at: f64, steps: u64) -> Vec<Probe<1>> {
    vec![
        Probe { name: STRAIN.into(), watch: Watch::Strain { at }, every: 1 },
        Probe { name: POINT.into(), watch: Watch::Point { at: [at] }, every: 1 },
        whole_bar((steps / 20).max(1)),
    ]
}

/// The whole bar every so many steps.
pub fn whole_bar(every: u64) -> Probe<1> {
    Probe { name: LINE.into(), watch: Watch::Line { along: 0, through: 0.0 }, every }
}

/// A scene whose plan says how many steps there are to look at.
pub fn planned(mut scene: Scene<1>, look: impl Fn(u64) -> Vec<Probe<1>>) -> Result<(Scene<1>, Plan), Wrong> {
    let place = |wrong: Wrong| match wrong.key.starts_with("probe") {
        true => Wrong { key: "probe_m".into(), ..wrong },
        false => wrong,
    };
    let steps = Plan::of(&scene).map_err(place)?.steps;
    scene.probes = look(steps);
    let plan = Plan::of(&scene).map_err(place)?;
    Ok((scene, plan))
}

/// How many of a probe's looks are equally far apart: the last one may come sooner.
pub fn evenly(plan: &Plan, probe: &Probe<1>) -> usize {
    (plan.steps / probe.every) as usize + 1
}
