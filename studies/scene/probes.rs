//! Probes as written, what each of them sees, and when.

use crate::input::{OneOrMany, nearest};
use pd_verify::plan::Plan;
use pd_verify::scene::{Axis, Probe, Watch, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// What a probe watches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WatchName {
    /// Displacement at a place.
    Point,
    /// Strain of a bar at a place.
    Strain,
    /// Displacements along a row or a column of nodes.
    Line,
    /// Displacements and accelerations of all nodes in a box.
    Patch,
    /// Kinetic and elastic energy, and the work done on the body.
    Energies,
    Momentum,
}

/// A probe as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ProbeAsked {
    /// Part of the names of its figures.
    pub name: String,
    pub watches: WatchName,
    /// Of `point` and `strain`: the place, one number per axis.
    pub at_m: Option<OneOrMany<f64>>,
    /// Of `line`; default x.
    pub along: Option<Axis>,
    /// Of `line` in a plate: where it crosses the other axis.
    pub through_m: Option<f64>,
    /// Of `patch`: the lower corner of the box, one number per axis.
    pub from_m: Option<OneOrMany<f64>>,
    /// Its upper corner.
    pub to_m: Option<OneOrMany<f64>>,
    /// Steps from one look to the next. Default: 1, beyond 2000 steps such that there are about 500 looks; a line and a
    /// patch are seen at t = 0 and up to 5 times more.
    pub every_steps: Option<u64>,
}

impl ProbeAsked {
    /// The probe; how often it looks is settled by [`ProbeAsked::every`] when the steps are known.
    pub fn check<const D: usize>(&self, size: [f64; D]) -> Result<Probe<D>, Wrong> {
        check_name(&self.name)?;
        self.check_keys::<D>()?;
        let watch = match self.watches {
            WatchName::Point => Watch::Point { at: place("at_m", &self.at_m, size)? },
            WatchName::Strain => Watch::Strain { at: place("at_m", &self.at_m, size)?[0] },
            WatchName::Patch => Watch::Patch {
                from: place("from_m", &self.from_m, size)?,
                to: place("to_m", &self.to_m, size)?,
            },
            WatchName::Energies => Watch::Energies,
            WatchName::Momentum => Watch::Momentum,
            WatchName::Line => {
                let along = self.along.unwrap_or(Axis::X).index::<D>();
                let along = along.map_err(|wrong| Wrong { key: "along".into(), ..wrong })?;
                let other = size.get(1 - along).copied().unwrap_or(0.0);
                Watch::Line { along, through: snapped(self.through_m.unwrap_or(0.0), other) }
            }
        };
        // Until the steps are known it looks twice, so that no patch is too large before its pace is settled.
        Ok(Probe { name: self.name.clone(), watch, every: self.every_steps.unwrap_or(u64::MAX) })
    }

    /// Keys that this probe needs, and those that say nothing about it.
    fn check_keys<const D: usize>(&self) -> Result<(), Wrong> {
        let placed = matches!(self.watches, WatchName::Point | WatchName::Strain);
        let line = self.watches == WatchName::Line;
        let patch = self.watches == WatchName::Patch;
        let keys = [
            ("at_m", self.at_m.is_some(), placed, placed),
            ("along", self.along.is_some(), line, false),
            ("through_m", self.through_m.is_some(), line && D == 2, line && D == 2),
            ("from_m", self.from_m.is_some(), patch, patch),
            ("to_m", self.to_m.is_some(), patch, patch),
        ];
        if let Some((key, ..)) = keys.iter().find(|(_, given, used, _)| *given && !used) {
            let message = format!("{key} says nothing about this probe");
            return Err(Wrong::new(*key, message, "leave it out"));
        }
        match keys.iter().find(|(_, given, _, needed)| !given && *needed) {
            Some((key, ..)) => Err(Wrong::new("", format!("this probe needs {key}"), format!("add {key}"))),
            None => Ok(()),
        }
    }

    /// The axis along which a line runs.
    pub fn axis(&self) -> usize {
        usize::from(self.along == Some(Axis::Y))
    }

    /// Steps from one look to the next.
    pub fn every(&self, steps: u64) -> u64 {
        let chosen = match self.watches {
            WatchName::Line | WatchName::Patch => steps.div_ceil(5).max(1),
            _ if steps <= 2000 => 1,
            _ => steps.div_ceil(500),
        };
        self.every_steps.unwrap_or(chosen)
    }
}

/// Whether a name can be part of the names of files.
pub fn check_name(name: &str) -> Result<(), Wrong> {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_';
    if !name.is_empty() && name.len() <= 40 && name.chars().all(plain) {
        return Ok(());
    }
    let message = format!("\"{name}\" cannot name a figure");
    Err(Wrong::new("name", message, "use lower-case letters, digits, - and _, at most 40"))
}

/// The place that a key gives.
fn place<const D: usize>(
    key: &str,
    given: &Option<OneOrMany<f64>>,
    size: [f64; D],
) -> Result<[f64; D], Wrong> {
    let given = given.as_ref().map_or(&[][..], |at| &at.0);
    let at: [f64; D] = given.try_into().map_err(|_| {
        let message = format!("{} number(s) are no place in this body", given.len());
        let each = if key == "at_m" { "; one probe for each place" } else { "" };
        Wrong::new(key, message, format!("give {D}, one per axis{each}"))
    })?;
    Ok(std::array::from_fn(|axis| snapped(at[axis], size[axis])))
}

/// A place meant to be the far edge must not miss it by rounding.
fn snapped(at: f64, size: f64) -> f64 {
    if (at - size).abs() <= 1e-9 * size { size } else { at }
}

/// Names of the quantities that a probe sees, in a body of `dimension` axes.
pub fn quantities(watches: WatchName, dimension: usize) -> &'static [&'static str] {
    match watches {
        WatchName::Point | WatchName::Line => &["displacement_x", "displacement_y"][..dimension],
        WatchName::Patch if dimension == 1 => &["displacement_x", "acceleration_x"],
        WatchName::Patch => &["displacement_x", "displacement_y", "acceleration_x", "acceleration_y"],
        WatchName::Strain => &["strain"],
        WatchName::Momentum => &["momentum_x", "momentum_y"][..dimension],
        WatchName::Energies => {
            const ACCOUNTS: [&str; 6] = [
                "kinetic",
                "elastic",
                "work_of_loads",
                "work_of_damping",
                "work_of_driven_nodes",
                "energy_of_cut_bonds",
            ];
            &ACCOUNTS
        }
    }
}

/// The first and the last time at which a probe sees something, and how many there are.
pub fn looks(watches: WatchName, every: u64, plan: &Plan) -> (f64, f64, u64) {
    let (step, half) = (plan.time_step_s, 0.5 * plan.time_step_s);
    let last = |count: u64| count as f64 * every as f64 * step;
    match watches {
        WatchName::Energies => {
            let after = plan.steps.saturating_sub(1) / every;
            (half, last(after) + half, after + 1)
        }
        WatchName::Momentum => {
            let first = every.min(plan.steps) as f64 * step - half;
            (first, plan.steps as f64 * step - half, plan.steps.div_ceil(every))
        }
        _ => (0.0, plan.steps as f64 * step, plan.steps.div_ceil(every) + 1),
    }
}

/// "did you mean …?" for a probe that nobody has.
pub fn did_you_mean<'a>(name: &str, known: impl Iterator<Item = &'a str> + Clone) -> String {
    let listed = known.clone().collect::<Vec<_>>().join(", ");
    match nearest(name, known) {
        Some(near) => format!("did you mean \"{near}\"? there are: {listed}"),
        None => format!("there are: {listed}"),
    }
}
