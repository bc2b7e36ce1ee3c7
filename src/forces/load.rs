//! Loads: a pattern over nodes times a history.
//!
//! A body force fills a region with b in N/m³. A traction σ on an edge is b = σ/Δx on the one layer of cells there.

use super::{Class, Force, Now};
use crate::constraints::Edge;
use crate::grid::Grid;
use crate::scene::{Acts, Axis, Effect, History, HistoryAsked, Initial, Region, Setting, Side, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// A body force as asked for.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodyForce {
    pub axis: Axis,
    /// In N/m³.
    pub density_n_m3: f64,
    /// Default: the whole body.
    pub region: Option<Region>,
    pub history: HistoryAsked,
}

/// A traction on an edge as asked for.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Traction {
    pub edge: Side,
    /// Direction in which it pulls.
    pub axis: Axis,
    /// In Pa. A positive value pulls towards +axis on every edge: to stretch a bar give the left end a negative one.
    pub stress_pa: f64,
    pub history: HistoryAsked,
}

impl<const D: usize> Effect<D> for BodyForce {
    fn name(&self) -> String {
        "body force".into()
    }

    fn act(&self, setting: &Setting<'_, D>) -> Result<Acts<D>, Wrong> {
        finite("density_n_m3", self.density_n_m3)?;
        let region = self.region.clone().unwrap_or_default();
        let nodes = region.nodes(setting.grid).map_err(|wrong| wrong.inside("region"))?;
        let history = self.history.check().map_err(|wrong| wrong.inside("history"))?;
        let axis = self.axis.index::<D>()?;
        let load = Load::new(setting.grid, "body force", axis, self.density_n_m3, &nodes, history);
        Ok(Acts::Force(Box::new(load)))
    }

    fn neutral(&self, until: f64) -> Option<&'static str> {
        (self.density_n_m3 == 0.0).then_some("its density is 0").or_else(|| self.history.neutral(until))
    }
}

impl<const D: usize> Effect<D> for Traction {
    fn name(&self) -> String {
        "traction".into()
    }

    fn act(&self, setting: &Setting<'_, D>) -> Result<Acts<D>, Wrong> {
        finite("stress_pa", self.stress_pa)?;
        let history = self.history.check().map_err(|wrong| wrong.inside("history"))?;
        let (axis, upper) = self.edge.end::<D>()?;
        let beyond = setting.edges.0[axis][usize::from(upper)];
        if matches!(beyond, Edge::MirrorOdd | Edge::Periodic) {
            let message = format!(
                "the {} edge is {}: no surface there can carry a traction",
                self.edge.name(),
                beyond.described()
            );
            return Err(Wrong::new("edge", message, "pull at a free edge, or use a body force"));
        }
        let holds = self.edge.holds(setting.grid, 1)?;
        let nodes: Vec<_> = setting.grid.each().filter(|node| holds(*node)).collect();
        if nodes.is_empty() {
            let message = format!("holes have removed every node along the {} edge", self.edge.name());
            return Err(Wrong::new("edge", message, "pull at another edge, or take a smaller hole"));
        }
        let density = self.stress_pa / setting.grid.spacing;
        let axis = self.axis.index::<D>()?;
        Ok(Acts::Force(Box::new(Load::new(setting.grid, "traction", axis, density, &nodes, history))))
    }

    fn neutral(&self, until: f64) -> Option<&'static str> {
        (self.stress_pa == 0.0).then_some("its stress is 0").or_else(|| self.history.neutral(until))
    }
}

pub(super) fn finite(key: &str, value: f64) -> Result<(), Wrong> {
    if value.is_finite() {
        return Ok(());
    }
    Err(Wrong::new(key, format!("{value} is no load"), "give a finite number"))
}

/// A body force that differs from node to node: fields in N/m³, summed over all nodes. Not a word of study files.
#[derive(Debug, Clone)]
pub struct ForceField<const D: usize> {
    pub fields: Vec<Initial<D>>,
    pub history: History,
}

impl<const D: usize> Effect<D> for ForceField<D> {
    fn name(&self) -> String {
        "body force".into()
    }

    fn act(&self, setting: &Setting<'_, D>) -> Result<Acts<D>, Wrong> {
        Ok(Acts::Force(Box::new(FieldLoad::new(setting.grid, &self.fields, self.history.clone()))))
    }

    fn neutral(&self, until: f64) -> Option<&'static str> {
        let nothing = self.fields.iter().all(|field| field.neutral().is_some());
        let late = self.history.nothing_until(until);
        nothing.then_some("its fields are 0").or(late.then_some("its history is 0 throughout"))
    }
}

/// A force field as it acts.
struct FieldLoad {
    /// By piece, in the order of the force field, in N/m³.
    densities: Vec<Vec<f64>>,
    history: History,
}

impl FieldLoad {
    fn new<const D: usize>(grid: &Grid<D>, fields: &[Initial<D>], history: History) -> Self {
        let mut whole = grid.field();
        for field in fields {
            for node in grid.each() {
                whole[grid.place(node) + field.component * grid.stride()] += field.at(grid.position(node));
            }
        }
        Self { densities: whole[grid.body()].chunks(grid.piece()).map(<[f64]>::to_vec).collect(), history }
    }
}

impl<const D: usize> Force<D> for FieldLoad {
    fn name(&self) -> String {
        "body force".into()
    }

    fn class(&self) -> Class {
        Class::Load
    }

    fn add(&self, now: &Now<'_>, piece: usize, sum: &mut [f64]) {
        let factor = self.history.over_step(now.time, now.time_step);
        sum.iter_mut().zip(&self.densities[piece]).for_each(|(sum, density)| *sum += factor * density);
    }

    fn bytes(&self) -> usize {
        self.densities.iter().map(|densities| 8 * densities.len()).sum()
    }
}

/// A load as it acts.
pub struct Load {
    name: &'static str,
    /// By piece: places in the force field, from the piece's start.
    places: Vec<Vec<usize>>,
    /// In N/m³.
    density: f64,
    history: History,
}

impl Load {
    /// The same density on each of `nodes`.
    pub fn new<const D: usize>(
        grid: &Grid<D>,
        name: &'static str,
        axis: usize,
        density: f64,
        nodes: &[[isize; D]],
        history: History,
    ) -> Self {
        let mut places = vec![Vec::new(); grid.pieces()];
        for node in nodes {
            let place = grid.place(*node) - grid.body().start;
            places[place / grid.piece()].push(place % grid.piece() + axis * grid.stride());
        }
        Self { name, places, density, history }
    }
}

impl<const D: usize> Force<D> for Load {
    fn name(&self) -> String {
        self.name.into()
    }

    fn class(&self) -> Class {
        Class::Load
    }

    fn add(&self, now: &Now<'_>, piece: usize, sum: &mut [f64]) {
        let density = self.density * self.history.over_step(now.time, now.time_step);
        for &place in &self.places[piece] {
            sum[place] += density;
        }
    }

    fn acts_on(&self, piece: usize) -> bool {
        !self.places[piece].is_empty()
    }

    fn loaded(&self, grid: &Grid<D>) -> Option<Vec<usize>> {
        let start = |piece: usize| grid.body().start + piece * grid.piece();
        let of_piece = |(piece, places): (usize, &Vec<usize>)| -> Vec<usize> {
            places.iter().map(|place| start(piece) + place).collect()
        };
        Some(self.places.iter().enumerate().flat_map(of_piece).collect())
    }

    fn bytes(&self) -> usize {
        self.places.iter().map(|places| 8 * places.len()).sum()
    }
}
