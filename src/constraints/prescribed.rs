//! Nodes that move as prescribed: a displacement times a history.

use super::Constraint;
use crate::field::Window;
use crate::scene::{Acts, Axis, Effect, History, HistoryAsked, Initial, Region, Setting, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// A motion as asked for.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PrescribedMotion {
    pub region: Region,
    pub axis: Axis,
    /// Multiplied by the history; 0 holds the nodes.
    pub displacement_m: f64,
    pub history: HistoryAsked,
}

impl<const D: usize> Effect<D> for PrescribedMotion {
    fn name(&self) -> String {
        "prescribed motion".into()
    }

    fn act(&self, setting: &Setting<'_, D>) -> Result<Acts<D>, Wrong> {
        if !self.displacement_m.is_finite() {
            let message = format!("{} is no displacement", self.displacement_m);
            return Err(Wrong::new("displacement_m", message, "give a finite number"));
        }
        let nodes = self.region.nodes(setting.grid).map_err(|wrong| wrong.inside("region"))?;
        let history = self.history.check().map_err(|wrong| wrong.inside("history"))?;
        let axis = self.axis.index::<D>()?;
        if let Some(side) = self.region.edge {
            setting.edges.may_drive(side, axis)?;
        }
        let component = axis * setting.grid.stride();
        let places = nodes.iter().map(|node| (setting.grid.place(*node) + component, self.displacement_m));
        Ok(Acts::Constraint(Box::new(Driven::new(places.collect(), history))))
    }
}

/// Nodes along all edges held at a field in m: the volume constraint of nonlocal theory. Not a word of study files.
#[derive(Debug, Clone)]
pub struct HeldFrame<const D: usize> {
    /// Layers of nodes from each edge.
    pub layers: usize,
    /// Summed; a component without a field is held at 0.
    pub fields: Vec<Initial<D>>,
}

impl<const D: usize> Effect<D> for HeldFrame<D> {
    fn name(&self) -> String {
        "prescribed motion".into()
    }

    fn act(&self, setting: &Setting<'_, D>) -> Result<Acts<D>, Wrong> {
        let grid = setting.grid;
        let depth = |node: [isize; D]| {
            let from_edge = |axis: usize| node[axis].min(grid.nodes[axis] as isize - 1 - node[axis]);
            (0..D).map(from_edge).min().unwrap_or(0)
        };
        let held: Vec<_> = grid.each().filter(|node| depth(*node) < self.layers as isize).collect();
        let mut driven = Vec::new();
        for component in 0..D {
            let of = |node| {
                let mine = self.fields.iter().filter(|field| field.component == component);
                mine.map(|field| field.at(grid.position(node))).sum::<f64>()
            };
            let place = |node: [isize; D]| grid.place(node) + component * grid.stride();
            driven.extend(held.iter().map(|node| (place(*node), of(*node))));
        }
        let history = History::Step { start: 0.0 };
        Ok(Acts::Constraint(Box::new(Driven::new(driven, history))))
    }

    fn neutral(&self, _until: f64) -> Option<&'static str> {
        (self.layers == 0).then_some("it holds no node")
    }
}

/// A motion as it acts.
struct Driven {
    places: Vec<usize>,
    /// In m, of each place.
    displacements: Vec<f64>,
    history: History,
}

impl Driven {
    /// Places and their displacements in any order.
    fn new(mut driven: Vec<(usize, f64)>, history: History) -> Self {
        driven.sort_by_key(|(place, _)| *place);
        let (places, displacements) = driven.into_iter().unzip();
        Self { places, displacements, history }
    }
}

impl<const D: usize> Constraint<D> for Driven {
    fn name(&self) -> String {
        "prescribed motion".into()
    }

    fn places(&self) -> &[usize] {
        &self.places
    }

    fn hold(&self, next: f64, displacement: Window<'_>, increment: &mut [f64], start: usize) {
        let at = |place: usize| self.places.partition_point(|&other| other < place);
        let mine = at(start)..at(start + increment.len());
        if mine.is_empty() {
            return;
        }
        let factor = self.history.at(next);
        for (&place, target) in self.places[mine.clone()].iter().zip(&self.displacements[mine]) {
            increment[place - start] = target * factor - displacement[place];
        }
    }
}
