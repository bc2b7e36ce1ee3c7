//! Answers from runs: the cheapest way to an error, and what each choice costs beside the best.

use super::runs::bytes;
use super::work_precision::{Points, WorkPrecision};
use pd_verify::compare::frontier::{frontier, reached};

/// Errors that are asked for.
pub const TARGETS: [f64; 3] = [0.05, 0.01, 0.001];

/// What reaching an error takes with one setting, between the two runs around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Way {
    pub track: usize,
    pub reading: usize,
    pub dx: f64,
    pub node_updates: f64,
    pub bond_updates: f64,
    /// `None` where runs were not timed.
    pub seconds: Option<f64>,
    pub bytes: f64,
}

/// What is minimised.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum By {
    BondUpdates,
    Seconds,
}

impl By {
    pub const ALL: [Self; 2] = [Self::BondUpdates, Self::Seconds];

    pub fn word(self) -> &'static str {
        match self {
            Self::BondUpdates => "bond_updates",
            Self::Seconds => "seconds",
        }
    }

    /// What a way costs; NaN where that is unknown.
    pub fn of(self, way: &Way) -> f64 {
        match self {
            Self::BondUpdates => way.bond_updates,
            Self::Seconds => way.seconds.unwrap_or(f64::NAN),
        }
    }
}

/// The median, where there is a number.
pub fn median(numbers: &[f64]) -> Option<f64> {
    Some(crate::median::median(numbers)).filter(|median| median.is_finite())
}

/// Every setting and reading that comes to an error of `target`.
pub fn ways(asked: &WorkPrecision, points: &Points, target: f64) -> Vec<Way> {
    let mut all = Vec::new();
    for (index, track) in asked.tracks.iter().enumerate() {
        for reading in 0..asked.facts.readings.len() {
            let at = |x: &dyn Fn(usize) -> f64| {
                let error = |level: usize| points[index][level].solved.errors[reading].unwrap_or(f64::NAN);
                let levels: Vec<(f64, f64)> =
                    (0..track.runs.len()).map(|level| (x(level), error(level))).collect();
                reached(&levels, target)
            };
            let plan = |level: usize| track.runs[level].plan();
            let way = || {
                Some(Way {
                    track: index,
                    reading,
                    dx: at(&|level| track.runs[level].spacing())?,
                    node_updates: at(&|level| plan(level).node_updates as f64)?,
                    bond_updates: at(&|level| plan(level).bond_updates as f64)?,
                    seconds: at(&|level| median(&points[index][level].seconds).unwrap_or(f64::NAN)),
                    bytes: at(&|level| bytes(plan(level)))?,
                })
            };
            all.extend(way());
        }
    }
    all
}

/// The cheapest of some ways.
pub fn cheapest<'w>(ways: impl IntoIterator<Item = &'w Way>, by: By) -> Option<&'w Way> {
    let known = ways.into_iter().filter(|way| by.of(way).is_finite());
    known.min_by(|a, b| by.of(a).total_cmp(&by.of(b)))
}

/// What settings differ in.
pub const CHOICES: [&str; 6] =
    ["kernel", "m", "volume_rule", "calibrated", "time_step_over_limit", "extraction"];

/// The word of a way for each of [`CHOICES`]; finite differences have but a time step.
pub fn chosen(asked: &WorkPrecision, track: usize, reading: usize) -> [String; 6] {
    let setting = asked.tracks[track].setting;
    let lattice = setting.lattice;
    let of = |word: String| if setting.finite_differences { setting.method().to_owned() } else { word };
    [
        of(lattice.kernel.to_string()),
        of(lattice.m.to_string()),
        of(lattice.volume_rule.name().to_owned()),
        of(lattice.calibrated.to_string()),
        setting.safety.to_string(),
        asked.facts.readings[reading].clone(),
    ]
}

/// The least that each word of a choice costs: the word, and the way, `None` where none comes to the error.
pub fn prices(asked: &WorkPrecision, ways: &[Way], choice: usize, by: By) -> Vec<(String, Option<Way>)> {
    let word = |track, reading| chosen(asked, track, reading)[choice].clone();
    let mut words: Vec<String> = Vec::new();
    for track in 0..asked.tracks.len() {
        for reading in 0..asked.facts.readings.len() {
            let word = word(track, reading);
            if !words.contains(&word) {
                words.push(word);
            }
        }
    }
    let price = |name: String| {
        let such = ways.iter().filter(|way| word(way.track, way.reading) == name);
        let best = cheapest(such, by).copied();
        (name, best)
    };
    words.into_iter().map(price).collect()
}

/// Which runs no other beats, by track, level and reading.
pub fn best(
    asked: &WorkPrecision,
    points: &Points,
    cost: impl Fn(usize, usize) -> f64,
) -> Vec<(usize, usize, usize)> {
    let mut places = Vec::new();
    let mut costs = Vec::new();
    for (track, levels) in points.iter().enumerate() {
        for (level, point) in levels.iter().enumerate() {
            for reading in 0..asked.facts.readings.len() {
                places.push((track, level, reading));
                costs.push((cost(track, level), point.solved.errors[reading].unwrap_or(f64::NAN)));
            }
        }
    }
    frontier(&costs).into_iter().map(|at| places[at]).collect()
}
