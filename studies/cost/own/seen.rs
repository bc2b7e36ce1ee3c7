//! What is taken for the result of a scene: what its probes see over time, at places that are the same on every level.

use crate::scene::either::Either;
use crate::scene::march::MarchAsked;
use crate::scene::probes::{ProbeAsked, WatchName};
use pd_verify::scene::{Probe, Scene, Watch};
use serde_json::Value;

/// Something seen over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    pub name: String,
    pub what: What,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum What {
    /// Displacement at a place in m; a bar's has one coordinate.
    Point([f64; 2]),
    /// Strain of a bar at a place in m.
    Strain(f64),
    Energies,
}

/// Where lines, patches and whole bodies are seen: a quarter, a half and three quarters of the way along each axis.
const QUARTERS: [f64; 3] = [0.25, 0.5, 0.75];

/// The results of a case in a body of a size in m. Momentum is not one: loads alone give it, or it is rounding.
pub fn of(asked: &MarchAsked, size: &[f64]) -> Vec<Seen> {
    let mut all: Vec<Seen> = asked.probe.iter().flat_map(|probe| of_probe(probe, size)).collect();
    if asked.probe.is_empty() && asked.snapshot.as_ref().is_some_and(|snapshots| !snapshots.is_empty()) {
        all = box_of("snapshot", [0.0; 2], corner(size));
    }
    all
}

fn of_probe(probe: &ProbeAsked, size: &[f64]) -> Vec<Seen> {
    let one = |what| vec![Seen { name: probe.name.clone(), what }];
    let place = |given: &Option<crate::input::OneOrMany<f64>>| {
        let given = given.as_ref().map_or(&[][..], |given| &given.0);
        [0, 1].map(|axis| given.get(axis).copied().unwrap_or(0.0))
    };
    match probe.watches {
        WatchName::Point => one(What::Point(place(&probe.at_m))),
        WatchName::Strain => one(What::Strain(place(&probe.at_m)[0])),
        WatchName::Energies => one(What::Energies),
        WatchName::Momentum => Vec::new(),
        WatchName::Line => {
            let along = probe.axis();
            let mut ends = [[0.0; 2], corner(size)];
            if size.len() == 2 {
                ends.iter_mut().for_each(|end| end[1 - along] = probe.through_m.unwrap_or(0.0));
            }
            box_of(&probe.name, ends[0], ends[1])
        }
        WatchName::Patch => box_of(&probe.name, place(&probe.from_m), place(&probe.to_m)),
    }
}

fn corner(size: &[f64]) -> [f64; 2] {
    [0, 1].map(|axis| size.get(axis).copied().unwrap_or(0.0))
}

/// Points a quarter, a half and three quarters of the way along each side of a box that has a length.
fn box_of(name: &str, from: [f64; 2], to: [f64; 2]) -> Vec<Seen> {
    let along = |axis: usize| match to[axis] > from[axis] {
        true => QUARTERS.map(|share| from[axis] + share * (to[axis] - from[axis])).to_vec(),
        false => vec![from[axis]],
    };
    let point = |x: f64, y: f64| Seen { name: format!("{name} ({x}, {y})"), what: What::Point([x, y]) };
    along(1).into_iter().flat_map(|y| along(0).into_iter().map(move |x| point(x, y))).collect()
}

impl Seen {
    /// Coordinates that should stand alike between the nodes of every level: axis, and place in m.
    pub fn coordinates(&self, dimension: usize) -> Vec<(usize, f64)> {
        match self.what {
            What::Point(at) => (0..dimension).map(|axis| (axis, at[axis])).collect(),
            What::Strain(at) => vec![(0, at)],
            What::Energies => Vec::new(),
        }
    }
}

/// The same scene, of which this and nothing else is seen, every so many steps.
pub fn watching(scene: &Either, seen: &[Seen], every: u64) -> Either {
    match scene {
        Either::Bar(scene) => Either::Bar(watched(scene, seen, every)),
        Either::Plate(scene) => Either::Plate(watched(scene, seen, every)),
    }
}

fn watched<const D: usize>(scene: &Scene<D>, seen: &[Seen], every: u64) -> Scene<D> {
    let watch = |what: What| match what {
        What::Point(at) => Watch::Point { at: std::array::from_fn(|axis| at[axis]) },
        What::Strain(at) => Watch::Strain { at },
        What::Energies => Watch::Energies,
    };
    let probe = |seen: &Seen| Probe { name: seen.name.clone(), watch: watch(seen.what), every };
    Scene { probes: seen.iter().map(probe).collect(), snapshots: Vec::new(), ..scene.clone() }
}

/// Coordinates at which a case cuts its body or parts its nodes into regions: ends of notches, boxes and depths. Axis, and
/// place in m.
pub fn drawn(case: &Value) -> Vec<(usize, f64)> {
    let mut all = Vec::new();
    let parts = ["notch", "effect"];
    parts.iter().filter_map(|key| case.get(key)).for_each(|part| collect(part, &mut all));
    all
}

fn collect(part: &Value, all: &mut Vec<(usize, f64)>) {
    match part {
        Value::Array(items) => items.iter().for_each(|item| collect(item, all)),
        Value::Object(table) => {
            for (key, value) in table {
                match (key.as_str(), value) {
                    ("from_m" | "to_m", Value::Array(place)) => {
                        all.extend(
                            place.iter().enumerate().filter_map(|(axis, x)| Some((axis, x.as_f64()?))),
                        );
                    }
                    ("depth_m", depth) => {
                        let upright =
                            matches!(table.get("edge").and_then(Value::as_str), Some("bottom" | "top"));
                        all.extend(depth.as_f64().map(|depth| (usize::from(upright), depth)));
                    }
                    (_, inner) => collect(inner, all),
                }
            }
        }
        _ => {}
    }
}
