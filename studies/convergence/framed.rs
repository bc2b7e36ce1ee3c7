//! A plate in a frame that holds it at a field: the scenes of patch tests, and their free nodes.

use super::space::{In, Space};
use super::whole;
use crate::scene::size::cells;
use pd_verify::constraints::HeldFrame;
use pd_verify::lattice::Lattice;
use pd_verify::material::{Body, Material};
use pd_verify::plan::Plan;
use pd_verify::scene::{Initial, Scene, Shape, StepRule, Time, Wrong};
use pd_verify_reference::bent_plate::BentPlate;
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// What the frame is held at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Field {
    /// Uniform strains, one after the other: along x, along y, shear.
    Strain,
    /// u_x = −κxy, u_y = ½κ(x² + y²/3), about the middle.
    Bending,
}

/// A plate in its frame, once for each field.
pub struct Framed {
    pub scenes: Vec<Scene<2>>,
    pub plan: Plan,
    /// Width of the frame in nodes.
    held: usize,
}

/// The strain, or the curvature times the side; the body is linear, so that it is of no account.
pub const STRAIN: f64 = 1e-6;

impl Field {
    /// The fields that are held, each by its components.
    fn all(self, side: f64, about: [f64; 2]) -> Vec<Vec<Initial<2>>> {
        let term = |component, amplitude, powers| Initial {
            component,
            amplitude,
            shape: Shape::Monomial { about, powers },
        };
        match self {
            Self::Strain => vec![
                vec![term(0, STRAIN, [1, 0])],
                vec![term(1, STRAIN, [0, 1])],
                vec![term(0, STRAIN, [0, 1]), term(1, STRAIN, [1, 0])],
            ],
            Self::Bending => {
                let bent = BentPlate::intended(STRAIN / side);
                let (half, swollen) = (0.5 * bent.curvature, 0.5 * bent.curvature * bent.swelling);
                vec![vec![term(0, -bent.curvature, [1, 1]), term(1, half, [2, 0]), term(1, swollen, [0, 2])]]
            }
        }
    }
}

impl Framed {
    /// A free square with its frame around it, as wide as a family reaches.
    pub fn new(
        field: Field,
        (material, body): (Material, Body),
        lattice: Lattice,
        side: f64,
        dx: f64,
    ) -> Result<Self, Wrong> {
        let (free, spacing) = cells([side; 2], dx).map_err(|wrong| Wrong { key: "path".into(), ..wrong })?;
        let held = <In as Space<2>>::reach(lattice)
            .map_err(|wrong| Wrong::new("path.m", wrong.to_string(), wrong.cure()))?;
        let nodes = free.map(|count| count + 2 * held);
        let time = Time { duration: 1.0, step: StepRule::OfLimit(1.0) };
        let bare = Scene::bare(material, body, lattice, nodes, spacing, time);
        let middle = bare.size().map(|side| 0.5 * side);
        let of = |fields: Vec<Initial<2>>| Scene {
            effects: vec![Arc::new(HeldFrame { layers: held, fields: fields.clone() })],
            displacement: fields,
            ..bare.clone()
        };
        let scenes: Vec<Scene<2>> = field.all(side, middle).into_iter().map(of).collect();
        let plan = Plan::at_rest(&scenes[0])?;
        Ok(Framed { scenes, plan, held })
    }

    fn free(&self, node: [usize; 2]) -> bool {
        whole::inside(node, self.held, self.nodes())
    }

    /// Nodes along each axis, frame included.
    pub fn nodes(&self) -> [usize; 2] {
        self.scenes[0].nodes
    }

    /// The exact displacements of free nodes.
    pub fn exact(&self, scene: &Scene<2>) -> Vec<[f64; 2]> {
        let at = |node: [usize; 2]| {
            let x = node.map(|n| (n as f64 + 0.5) * scene.spacing);
            let mut u = [0.0; 2];
            scene.displacement.iter().for_each(|field| u[field.component] += field.at(x));
            u
        };
        whole::nodes(scene).filter(|node| self.free(*node)).map(at).collect()
    }

    /// What is known of all nodes, of the free ones.
    pub fn of_free(&self, all: Vec<[f64; 2]>) -> Result<Vec<[f64; 2]>, String> {
        if all.len() != self.nodes().iter().product::<usize>() {
            return Err(format!("{} answers for {:?} nodes", all.len(), self.nodes()));
        }
        let each = whole::nodes(&self.scenes[0]).zip(all);
        Ok(each.filter(|(node, _)| self.free(*node)).map(|(_, u)| u).collect())
    }
}
