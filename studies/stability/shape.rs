//! Plates with cuts and holes, placed in spacings so that both the judged code and whole numbers can be asked what they cut.

use super::body::FreeBody;
use pd_verify::lattice::Lattice;
use pd_verify::material::{Body, Material};
use pd_verify::scene::{HoleAsked, Initial, NotchAsked, Positive, Scene, Shape, Wrong};
use pd_verify_reference::cut_plate::{CutPlate, UNIT};
use schemars::JsonSchema;
use serde::Deserialize;

/// A plate's cuts and holes as written; without any it is whole. All numbers are spacings, with at most two decimals.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ShapeAsked {
    pub name: String,
    /// Straight cuts, from (x, y) to (x, y): four numbers each.
    #[serde(default)]
    pub cut: Vec<[f64; 4]>,
    /// Round holes: x and y of the centre, and the radius.
    #[serde(default)]
    pub hole: Vec<[f64; 3]>,
}

/// A plate of a lattice with its cuts and holes, twice: for the code under judgement, and in whole numbers.
pub struct Shaped {
    pub name: String,
    pub scene: Scene<2>,
    pub exact: CutPlate,
}

/// Largest velocity of the start over c times the largest displacement over Δx: so slow that nodes stay where they are.
const SLOW: f64 = 1e-2;

impl ShapeAsked {
    /// The plate, or what is wrong with it.
    pub fn check(&self, plain: &Scene<2>) -> Result<Shaped, Wrong> {
        let dx = plain.spacing;
        let mut exact =
            CutPlate { nodes: plain.nodes.map(|n| n as i64), cuts: Vec::new(), holes: Vec::new() };
        let (mut notches, mut holes) = (Vec::new(), Vec::new());
        for (index, cut) in self.cut.iter().enumerate() {
            let inside = |wrong: Wrong| Wrong { key: format!("cut[{index}]"), ..wrong };
            let [x, y, to_x, to_y] = whole(*cut).map_err(inside)?;
            exact.cuts.push([[x, y], [to_x, to_y]]);
            let (from_m, to_m) = ([cut[0] * dx, cut[1] * dx], [cut[2] * dx, cut[3] * dx]);
            notches.push(NotchAsked { from_m, to_m, runs: None }.check(plain.size(), dx).map_err(inside)?);
        }
        for (index, hole) in self.hole.iter().enumerate() {
            let inside = |wrong: Wrong| Wrong { key: format!("hole[{index}]"), ..wrong };
            let [x, y, radius] = whole(*hole).map_err(inside)?;
            if radius <= 0 {
                return Err(inside(Wrong::new(
                    "",
                    "a hole needs a radius above 0",
                    "give x, y and the radius",
                )));
            }
            exact.holes.push(([x, y], radius));
            let asked =
                HoleAsked { centre_m: [hole[0] * dx, hole[1] * dx], radius_m: Positive(hole[2] * dx) };
            holes.push(asked.check(plain.size()).map_err(inside)?);
        }
        Ok(Shaped { name: self.name.clone(), scene: Scene { notches, holes, ..plain.clone() }, exact })
    }
}

/// In hundredths.
fn whole<const N: usize>(places: [f64; N]) -> Result<[i64; N], Wrong> {
    let units = places.map(|x| x * UNIT as f64);
    match units.iter().find(|x| (*x - x.round()).abs() > 1e-6 || x.abs() > 1e9) {
        Some(x) => {
            let message = format!("{} spacings are no whole hundredths of a spacing", x / UNIT as f64);
            Err(Wrong::new("", message, "give at most two decimals"))
        }
        None => Ok(units.map(|x| x.round() as i64)),
    }
}

impl Shaped {
    pub fn body(&self) -> FreeBody {
        FreeBody::Plate(self.scene.clone())
    }

    pub fn lattice(&self) -> Lattice {
        self.scene.lattice
    }

    /// With a rough velocity at the start that differs from place to place, so that pieces fly apart.
    pub fn flying(&self) -> Scene<2> {
        let fields = self.scene.displacement.iter().map(|field| {
            let shape = match &field.shape {
                Shape::Wave { wavenumber, phase } => {
                    Shape::Wave { wavenumber: wavenumber.map(|k| 0.21 * k), phase: phase + 0.4 }
                }
                other => other.clone(),
            };
            let amplitude = SLOW * field.amplitude * self.scene.speed() / self.scene.spacing;
            Initial { amplitude, shape, ..field.clone() }
        });
        Scene { velocity: fields.collect(), ..self.scene.clone() }
    }

    /// A field at the nodes that stand, in the order of the exact plate.
    pub fn at_nodes(&self, fields: &[Initial<2>]) -> Vec<[f64; 2]> {
        let place = |node: &[i64; 2]| node.map(|n| (n as f64 + 0.5) * self.scene.spacing);
        let value = |node: &[i64; 2]| {
            let mut sum = [0.0; 2];
            fields.iter().for_each(|field| sum[field.component] += field.at(place(node)));
            sum
        };
        self.exact.standing().iter().map(value).collect()
    }
}

/// The plain plate of a case.
pub fn plain(
    asked: &super::body::FreeBodyAsked,
    material: Material,
    lattice: Lattice,
) -> Result<Scene<2>, Wrong> {
    match asked.check(material, lattice).map_err(|wrong| wrong.inside("body"))? {
        FreeBody::Plate(scene) if Body::from(asked.is) != Body::Bar && asked.notch.is_empty() => Ok(scene),
        _ => Err(Wrong::new(
            "body",
            "shapes are cut out of a plate",
            "take a plate, without notches of its own",
        )),
    }
}
