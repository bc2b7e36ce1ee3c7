//! Tractions on the two faces of a notch, opposite and equal: what opens it or makes its faces slide.
//!
//! On each side of the notch the layer of cells next to its line carries the body force σ/Δx, as on an edge. Faces are
//! loaded between the notch's ends; a cell that it covers in part gets its part. Cells are loaded in pairs across the line,
//! where both nodes stand, so that what a pair feels is zero to the last bit. The layers are Δx apart: a shear τ on a
//! length L of a plate of thickness h has the moment τΔxLh about the normal of the plate, against the sense in which left
//! follows from the notch's direction; it vanishes with Δx. Normal tractions have none.
//! What a running notch opens later carries no traction.

use super::load::finite;
use super::{Class, Force, Now};
use crate::grid::Grid;
use crate::scene::{Acts, Effect, History, HistoryAsked, Notch, Setting, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// Tractions on the faces of a notch as asked for.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FaceTraction {
    /// Which of the notches, from 0; default the first. It must run along x or y.
    pub notch: Option<usize>,
    /// In Pa. A positive value opens: it pushes the face on the left, seen along the notch from one end to the other, to
    /// the left, the other to the right.
    pub normal_pa: Option<f64>,
    /// In Pa. A positive value pushes the face on the left forwards along the notch, the other backwards.
    pub shear_pa: Option<f64>,
    pub history: HistoryAsked,
}

impl<const D: usize> Effect<D> for FaceTraction {
    fn name(&self) -> String {
        "face traction".into()
    }

    fn act(&self, setting: &Setting<'_, D>) -> Result<Acts<D>, Wrong> {
        let given = [("normal_pa", self.normal_pa), ("shear_pa", self.shear_pa)];
        for (key, value) in given {
            finite(key, value.unwrap_or(0.0))?;
        }
        if given.iter().all(|(_, value)| value.is_none()) {
            let message = "a face traction without normal_pa and shear_pa loads nothing";
            return Err(Wrong::new("", message, "give one of them, or both"));
        }
        let history = self.history.check().map_err(|wrong| wrong.inside("history"))?;
        let faces = Faces::of(setting.grid, self.notch(setting.notches)?)?;
        Ok(Acts::Force(Box::new(FaceLoad::new(setting.grid, &faces, self.normal_pa, self.shear_pa, history))))
    }

    fn neutral(&self, until: f64) -> Option<&'static str> {
        let nothing = [self.normal_pa, self.shear_pa].into_iter().flatten().all(|stress| stress == 0.0);
        nothing.then_some("its stresses are 0").or_else(|| self.history.neutral(until))
    }

    fn on_notch(&self) -> Option<usize> {
        Some(self.notch.unwrap_or(0))
    }
}

impl FaceTraction {
    fn notch<'a>(&self, notches: &'a [Notch]) -> Result<&'a Notch, Wrong> {
        let index = self.notch.unwrap_or(0);
        notches.get(index).ok_or_else(|| match notches.len() {
            0 => Wrong::new(
                "notch",
                "there is no notch whose faces could be pulled",
                "add a notch to a plate, or pull at an edge: acts = \"traction\"",
            ),
            count => {
                let message =
                    format!("there is no notch {index}: notches are counted from 0 to {}", count - 1);
                Wrong::new("notch", message, "name one of them")
            }
        })
    }
}

/// What is taken for nothing, in spacings.
const SLACK: f64 = 1e-9;

/// The cells on both sides of a notch.
struct Faces<const D: usize> {
    /// The axis along which it runs, and whether forwards along it.
    along: usize,
    forwards: bool,
    /// Whether the left lies towards larger coordinates.
    left_up: bool,
    /// Left node, right node, and the part of their cells that the notch covers.
    pairs: Vec<([isize; D], [isize; D], f64)>,
}

impl<const D: usize> Faces<D> {
    fn of(grid: &Grid<D>, notch: &Notch) -> Result<Self, Wrong> {
        let ends = [notch.from, notch.to].map(|end| end.map(|x| x / grid.spacing));
        let way = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
        let Some(along) = (0..2).find(|&axis| way[1 - axis].abs() <= SLACK) else {
            let message = "the notch runs at an angle: its faces are no rows of cells";
            let help = "let it run along x or y, or load nodes of your choice by body forces";
            return Err(Wrong::new("notch", message, help));
        };
        let forwards = way[along] > 0.0;
        let left_up = forwards == (along == 0);
        // Nodes on the line belong to its left.
        let line = ends[0][1 - along] - 0.5;
        let [left, right] = match left_up {
            true => [(line - SLACK).ceil(), (line - SLACK).ceil() - 1.0],
            false => [(line + SLACK).floor(), (line + SLACK).floor() + 1.0],
        };
        let rows = 0..grid.nodes.get(1 - along).copied().unwrap_or(1) as isize;
        if !rows.contains(&(left as isize)) || !rows.contains(&(right as isize)) {
            let message = "the notch runs along an edge of the body: it has one face only";
            let help = "let it run inside the plate, or pull at the edge: acts = \"traction\"";
            return Err(Wrong::new("notch", message, help));
        }
        let (low, high) = (ends[0][along].min(ends[1][along]), ends[0][along].max(ends[1][along]));
        let node = |column: isize, row: f64| -> [isize; D] {
            std::array::from_fn(|axis| if axis == along { column } else { row as isize })
        };
        let covered = |column: isize| (column as f64 + 1.0).min(high) - (column as f64).max(low);
        let columns = (low - SLACK).floor() as isize..(high + SLACK).ceil() as isize;
        let pairs: Vec<_> = columns
            .map(|column| (node(column, left), node(column, right), covered(column)))
            .filter(|(left, right, part)| *part > SLACK && grid.has(*left) && grid.has(*right))
            .map(|(left, right, part)| (left, right, if part > 1.0 - SLACK { 1.0 } else { part }))
            .collect();
        if pairs.is_empty() {
            let message = "holes have removed every cell along the faces of the notch";
            return Err(Wrong::new("notch", message, "load another notch, or take a smaller hole"));
        }
        Ok(Self { along, forwards, left_up, pairs })
    }
}

/// Opposite tractions as they act.
struct FaceLoad {
    /// By piece: places in the force field, from the piece's start, and the force density there in N/m³.
    places: Vec<Vec<(usize, f64)>>,
    history: History,
}

impl FaceLoad {
    fn new<const D: usize>(
        grid: &Grid<D>,
        faces: &Faces<D>,
        normal: Option<f64>,
        shear: Option<f64>,
        history: History,
    ) -> Self {
        let mut places = vec![Vec::new(); grid.pieces()];
        let sign = |positive: bool| if positive { 1.0 } else { -1.0 };
        let loads = [
            (1 - faces.along, normal.map(|stress| sign(faces.left_up) * stress)),
            (faces.along, shear.map(|stress| sign(faces.forwards) * stress)),
        ];
        for (axis, stress) in loads.into_iter().filter_map(|(axis, stress)| Some((axis, stress?))) {
            for &(left, right, part) in &faces.pairs {
                let density = part * (stress / grid.spacing);
                for (node, density) in [(left, density), (right, -density)] {
                    let place = grid.place(node) - grid.body().start;
                    let within = place % grid.piece() + axis * grid.stride();
                    places[place / grid.piece()].push((within, density));
                }
            }
        }
        Self { places, history }
    }
}

impl<const D: usize> Force<D> for FaceLoad {
    fn name(&self) -> String {
        "face traction".into()
    }

    fn class(&self) -> Class {
        Class::Load
    }

    fn add(&self, now: &Now<'_>, piece: usize, sum: &mut [f64]) {
        let factor = self.history.over_step(now.time, now.time_step);
        for &(place, density) in &self.places[piece] {
            sum[place] += factor * density;
        }
    }

    fn loaded(&self, grid: &Grid<D>) -> Option<Vec<usize>> {
        let pieces = self.places.iter().enumerate();
        let start = |piece: usize| grid.body().start + piece * grid.piece();
        Some(pieces.flat_map(|(piece, places)| places.iter().map(move |(at, _)| start(piece) + at)).collect())
    }

    fn bytes(&self) -> usize {
        self.places.iter().map(|places| size_of_val(places.as_slice())).sum()
    }
}
