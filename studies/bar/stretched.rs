//! A bar at rest under tractions, or between driven ends: as scenes, and the moduli that its displacements show.

use super::pulsed::PlainBarAsked;
use super::released::{cells, whole_bar};
use crate::dispersion::curve::reference_lattice;
use pd_verify::constraints::{Edge, Edges, PrescribedMotion};
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{BodyForce, Traction};
use pd_verify::lattice::Lattice;
use pd_verify::material::{Body, Material};
use pd_verify::scene::{
    Axis, Effect, HistoryAsked, Initial, Positive, Region, Scene, Shape, Side, StepRule, Time, Wrong,
};
use pd_verify_reference::static_bar::{Correction as ReferenceCorrection, LeftEnd, StaticBar};
use std::sync::Arc;

/// The bar and its load, checked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulled {
    pub length: f64,
    pub section: f64,
    pub material: Material,
    /// σ in Pa.
    pub stress: f64,
    /// Cells at each end that carry it.
    pub layer: usize,
}

/// What holds or pulls the bar.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// Both free, pulled by σ.
    Pulled,
    /// A few nodes at both ends moved to u = εx.
    Driven,
    /// u odd about the left end, a few nodes at the right end moved to u = εx.
    Mirrored,
    /// Both free, let go from u = εx.
    LetGo,
}

impl Pulled {
    pub fn new(bar: PlainBarAsked, material: Material, stress: Positive, layer: usize) -> Self {
        let (length, section) = (bar.length_m.0, bar.section_m2.0);
        Self { length, section, material, stress: stress.0, layer }
    }

    /// σ/E.
    pub fn strain(&self) -> f64 {
        self.stress / self.material.youngs_modulus
    }

    /// A scene; a march of it lasts one step.
    pub fn scene(
        &self,
        lattice: Lattice,
        correction: Correction,
        spacing: f64,
        ends: Ends,
    ) -> Result<Scene<1>, Wrong> {
        let nodes = cells(self.length, spacing)?;
        let left = if ends == Ends::Mirrored { Edge::MirrorOdd } else { Edge::Free };
        let stretched = Initial { component: 0, amplitude: self.strain(), shape: Shape::Linear { along: 0 } };
        // Driven nodes reach twice as far as a family: the nodes between them have no corrected bond.
        let band = 2 * lattice.m.ceil() as usize;
        let effects = match ends {
            Ends::Pulled => self.loads(spacing),
            Ends::Driven if 2 * band < nodes => self.driven(spacing, (0..band).chain(nodes - band..nodes)),
            Ends::Mirrored if band < nodes => self.driven(spacing, nodes - band..nodes),
            Ends::LetGo => Vec::new(),
            Ends::Driven | Ends::Mirrored => {
                let message = format!("{nodes} nodes leave none between driven ends of {band}");
                return Err(Wrong::new("dx_m", message, "take a smaller spacing or a smaller m"));
            }
        };
        // Below half of the limit of any lattice with positive weights, corrected or not.
        let duration = 0.4 * spacing / self.material.dilatational_speed(Body::Bar);
        let time = Time { duration, step: StepRule::OfLimit(0.8) };
        Ok(Scene {
            name: format!("{lattice}, Δx = {spacing} m, surface {}", correction.name()),
            section: self.section,
            edges: Edges([[left, Edge::Free]]),
            surface: correction,
            displacement: if ends == Ends::LetGo { vec![stretched] } else { Vec::new() },
            effects,
            probes: vec![whole_bar(1)],
            ..Scene::bare(self.material, Body::Bar, lattice, [nodes], spacing, time)
        })
    }

    /// Tractions on one layer of cells, or the same forces spread over more.
    fn loads(&self, spacing: f64) -> Vec<Arc<dyn Effect<1>>> {
        let ends = [(Side::Left, -self.stress), (Side::Right, self.stress)];
        let load = |(edge, stress_pa): (Side, f64)| -> Arc<dyn Effect<1>> {
            if self.layer == 1 {
                return Arc::new(Traction { edge, axis: Axis::X, stress_pa, history: HistoryAsked::step() });
            }
            let depth = self.layer as f64 * spacing;
            let region = Region { edge: Some(edge), depth_m: Some(Positive(depth)), ..Region::default() };
            let density_n_m3 = stress_pa / depth;
            Arc::new(BodyForce {
                axis: Axis::X,
                density_n_m3,
                region: Some(region),
                history: HistoryAsked::step(),
            })
        };
        ends.map(load).to_vec()
    }

    /// Each of these nodes is moved to εx.
    fn driven(&self, spacing: f64, nodes: impl Iterator<Item = usize>) -> Vec<Arc<dyn Effect<1>>> {
        let drive = |node: usize| -> Arc<dyn Effect<1>> {
            let at = |cells: f64| Some(vec![(node as f64 + cells) * spacing]);
            let region = Region { from_m: at(0.25), to_m: at(0.75), ..Region::default() };
            let displacement_m = self.strain() * (node as f64 + 0.5) * spacing;
            Arc::new(PrescribedMotion {
                region,
                axis: Axis::X,
                displacement_m,
                history: HistoryAsked::step(),
            })
        };
        nodes.map(drive).collect()
    }

    /// The reference's bar; its displacements are over σΔx/E.
    pub fn reference(&self, lattice: Lattice, correction: Correction, nodes: usize) -> StaticBar {
        let correction = match correction {
            Correction::None => ReferenceCorrection::None,
            Correction::Energy => ReferenceCorrection::Energy,
            Correction::Volume => ReferenceCorrection::Volume,
        };
        let lattice = reference_lattice(lattice);
        StaticBar { lattice, nodes, left: LeftEnd::Free, correction, layer: self.layer }
    }
}

/// E_app/E from displacements over σΔx/E: σL/E over the distance by which the ends move apart, each end extrapolated from
/// its two outermost nodes.
pub fn recovered_modulus(u: &[f64]) -> f64 {
    let last = u.len() - 1;
    let right = u[last] + 0.5 * (u[last] - u[last - 1]);
    let left = u[0] - 0.5 * (u[1] - u[0]);
    u.len() as f64 / (right - left)
}

/// E/E from the strain of a straight line through the nodes of the middle half.
pub fn middle_modulus(u: &[f64]) -> f64 {
    let length = u.len() as f64;
    let places = u.iter().enumerate().map(|(i, u)| (i as f64 + 0.5 - 0.5 * length, u));
    let (top, bottom) = places
        .filter(|(x, _)| x.abs() <= 0.25 * length)
        .fold((0.0, 0.0), |(top, bottom), (x, u)| (top + x * u, bottom + x * x));
    bottom / top
}
