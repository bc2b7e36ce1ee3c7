//! A smooth pulse of displacement let go in a bar: as a scene, and what a march of it shows at a few times.

use super::released::{LINE, cells, whole_bar};
use crate::rounded::rounded;
use crate::subject::Subject;
use crate::written::Written;
use pd_verify::constraints::{Edge, Edges};
use pd_verify::lattice::Lattice;
use pd_verify::material::{Body, Material};
use pd_verify::plan::Plan;
use pd_verify::scene::{Beyond, Initial, Positive, Scene, Shape, StepRule, Time, Wrong};
use pd_verify_reference::pulse_bar::PulseBar;
use schemars::JsonSchema;
use serde::Deserialize;

/// A bar as written.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlainBarAsked {
    pub length_m: Positive,
    pub section_m2: Positive,
}

/// A pulse as written: exp(−((x − centre)/width)²).
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PulseShapeAsked {
    pub centre_m: Positive,
    pub width_m: Positive,
}

/// The bar and its pulse, checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulsed {
    pub exact: PulseBar,
    pub material: Material,
    pub section: f64,
    edges: [Edge; 2],
}

/// A march of the pulse: Δt divides the time between two looks.
#[derive(Debug, Clone)]
pub struct Marched {
    pub scene: Scene<1>,
    pub plan: Plan,
    /// vΔt/Δx.
    pub courant: f64,
}

/// Height of the pulse in m; the bar is linear, so that it is of no account.
pub const HEIGHT: f64 = 1e-6;

/// What of the pulse may reach beyond an end of the bar at t = 0.
const TAIL: f64 = 1e-15;

/// The material of a study, or what to add.
pub fn material(written: &Written<'_>) -> Result<Material, Wrong> {
    written.material()
}

impl Pulsed {
    /// The problem in words, neutral of any solver.
    pub fn problem(&self) -> Vec<(&'static str, String)> {
        let PulseBar { length, speed, sharpness, centre } = self.exact;
        let width = 1.0 / sharpness.sqrt();
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
                    "At t = 0 the displacement is {HEIGHT} m · exp(−((x − {centre} m)/({} m))²), at rest; nothing acts afterwards.",
                    rounded(width)
                ),
            ),
        ]
    }

    pub fn check(
        bar: PlainBarAsked,
        pulse: PulseShapeAsked,
        edges: [Edge; 2],
        material: Material,
    ) -> Result<Self, Wrong> {
        let (length, centre, width) = (bar.length_m.0, pulse.centre_m.0, pulse.width_m.0);
        let exact = PulseBar {
            length,
            speed: material.dilatational_speed(Body::Bar),
            sharpness: 1.0 / (width * width),
            centre,
        };
        if centre >= length || exact.tail() > TAIL {
            let message = format!("a pulse {width} m wide at {centre} m sticks out of a bar of {length} m");
            let help = "keep its centre six widths from both ends: take a smaller width_m";
            return Err(Wrong::new("pulse.width_m", message, help));
        }
        Ok(Self { exact, material, section: bar.section_m2.0, edges })
    }

    /// The scene without its look at the bar, which needs the number of steps.
    fn scene(
        &self,
        lattice: Lattice,
        spacing: f64,
        duration: f64,
        step: StepRule,
    ) -> Result<Scene<1>, Wrong> {
        let shape = Shape::Gaussian { centre: [self.exact.centre], sharpness: self.exact.sharpness };
        let nodes = [cells(self.exact.length, spacing)?];
        Ok(Scene {
            section: self.section,
            edges: Edges([self.edges]),
            displacement: vec![Initial { component: 0, amplitude: HEIGHT, shape }],
            ..Scene::bare(self.material, Body::Bar, lattice, nodes, spacing, Time { duration, step })
        })
    }

    /// Steps of at most `safety` times the limit, a multiple of `looks`.
    pub fn steps(
        &self,
        lattice: Lattice,
        spacing: f64,
        duration: f64,
        safety: f64,
        looks: u64,
    ) -> Result<u64, Wrong> {
        let scene = self.scene(lattice, spacing, duration, StepRule::OfLimit(safety))?;
        Ok(Plan::of(&scene)?.steps.next_multiple_of(looks))
    }

    /// The scene that is marched in so many steps, a multiple of `looks`.
    pub fn marched(
        &self,
        lattice: Lattice,
        spacing: f64,
        duration: f64,
        steps: u64,
        looks: u64,
    ) -> Result<Marched, Wrong> {
        let step = StepRule::Given { seconds: duration / steps as f64, beyond_limit: Beyond::Refused };
        let mut scene = self.scene(lattice, spacing, duration, step)?;
        scene.probes = vec![whole_bar(steps / looks)];
        let plan = Plan::of(&scene)?;
        let courant = self.exact.speed * plan.time_step_s / spacing;
        Ok(Marched { scene, plan, courant })
    }
}

impl Marched {
    pub fn nodes(&self) -> usize {
        self.scene.nodes[0]
    }

    /// Centre of cell j in m.
    pub fn place(&self, j: usize) -> f64 {
        (j as f64 + 0.5) * self.scene.spacing
    }

    /// vt/Δx at the look n of so many.
    pub fn cell_time(&self, look: usize, looks: usize) -> f64 {
        self.courant * (self.plan.steps as usize / looks * look) as f64
    }

    /// Displacements over the pulse's height at each look but that of t = 0.
    pub fn march(&self, subject: &dyn Subject, looks: usize) -> Result<Vec<Vec<f64>>, String> {
        let record = subject.march_bar(&self.scene).map_err(|failure| failure.to_string())?;
        let trace = record.trace(LINE).ok_or("the bar was not recorded")?;
        let whole = trace.rows.iter().all(|row| row.len() == self.nodes());
        if trace.rows.len() != looks + 1 || !whole {
            return Err(format!("{} looks were recorded, not {}", trace.rows.len(), looks + 1));
        }
        Ok(trace.rows[1..].iter().map(|row| row.iter().map(|u| u / HEIGHT).collect()).collect())
    }
}
