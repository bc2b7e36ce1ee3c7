//! The search: coarse levels are marched until they say how errors fall and what time costs; then the answer is.
//!
//! Times of levels not yet marched are the plan's, by `bench` where it has run here, else by its operations, times what the finest
//! level so far has taken over its own. Coarse levels take a tenth of what the answer will, where that leaves enough of them.

use super::estimate::{Estimate, History};
use super::levels::{Level, Own};
use crate::afford::needed;
use pd_verify::plan::Plan;
use pd_verify::plan::time::Costs;
use pd_verify::record::{Failure, Record};

/// What is asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// Largest error of any result.
    Error(f64),
    /// For the answer, in s.
    Budget(f64),
}

/// What coarse levels take, over the answer's time or the budget.
pub const SHARE: f64 = 0.1;

/// Cells of a level over those of the one before.
const REFINED: f64 = 1.5;

/// Visits of bonds after which levels that tell no order are given up: half a minute.
const GIVEN_UP: u64 = 10_000_000_000;

/// Visits of bonds beyond which no answer is marched: hours.
const MAX_VISITS: u64 = 2_000_000_000_000;

/// How often one more answer is sought where one is not as accurate as was thought.
const MORE: usize = 4;

/// A budget is kept if the answer takes no longer than this many times it.
pub const KEPT: f64 = 1.5;

/// A level that was marched.
#[derive(Debug, Clone)]
pub struct Marched {
    pub cells: usize,
    /// Δx in m.
    pub spacing: f64,
    pub plan: Plan,
    /// In s; `None` of the first.
    pub predicted: Option<f64>,
    /// In s.
    pub seconds: f64,
    seen: Vec<History>,
}

/// The answer.
#[derive(Debug, Clone)]
pub struct Chosen {
    pub cells: usize,
    /// Δx in m.
    pub spacing: f64,
    pub plan: Plan,
    /// In s, and bytes while it is made.
    pub predicted: f64,
    pub bytes: f64,
    /// Estimated before it was marched, and the order by which.
    pub error: f64,
    pub order: Option<f64>,
    /// Why it was not marched.
    pub not_run: Option<String>,
    pub outcome: Option<Outcome>,
}

/// What came of it.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// In s.
    pub seconds: f64,
    /// Estimated anew, the answer among the levels; or why there is no estimate.
    pub error: Result<f64, String>,
}

/// Everything found.
#[derive(Debug)]
pub struct Found {
    pub goal: Goal,
    /// From coarse to fine, the answer among them.
    pub levels: Vec<Marched>,
    /// Of all levels; or why there is none.
    pub estimate: Result<Estimate, String>,
    /// `None` where nothing can be said.
    pub chosen: Option<Chosen>,
}

/// Why nothing was found.
#[derive(Debug)]
pub enum Stopped {
    Interrupted,
    Failed(Failure),
    Unusable(String),
}

/// Marches a level: what was seen, and how long it took in s.
pub type March = dyn Fn(&Level) -> Result<(Record, f64), Failure> + Sync;

/// What marches and what the machine offers: what a test puts in place of a clock.
pub struct Machine<'a> {
    pub march: &'a March,
    pub costs: Option<&'a Costs>,
    /// In bytes.
    pub memory: f64,
    pub stop: &'a (dyn Fn() -> bool + Sync),
}

impl Found {
    /// Whether the answer is as accurate as asked, or as quick within [`KEPT`] and its error known.
    pub fn met(&self) -> bool {
        let outcome = self.chosen.as_ref().and_then(|chosen| chosen.outcome.as_ref());
        outcome.is_some_and(|outcome| match (self.goal, &outcome.error) {
            (Goal::Error(asked), Ok(error)) => *error <= asked,
            (Goal::Budget(seconds), Ok(_)) => outcome.seconds <= KEPT * seconds,
            (_, Err(_)) => false,
        })
    }
}

/// Searches and marches.
pub fn search(own: &Own, goal: Goal, machine: &Machine) -> Result<Found, Stopped> {
    let mut search = Search { own, goal, machine, levels: Vec::new() };
    let chosen = search.climb()?;
    let chosen = match chosen {
        Ok(chosen) => Some(search.until_met(chosen)?),
        Err(why) => {
            return Ok(Found { goal, levels: search.levels, estimate: Err(why), chosen: None });
        }
    };
    let estimate = search.estimate();
    Ok(Found { goal, levels: search.levels, estimate, chosen })
}

struct Search<'a> {
    own: &'a Own,
    goal: Goal,
    machine: &'a Machine<'a>,
    levels: Vec<Marched>,
}

impl Search<'_> {
    /// Marches levels, each finer than the last, until the answer can be told or it is clear that none can.
    fn climb(&mut self) -> Result<Result<Chosen, String>, Stopped> {
        let mut cells = self.own.coarsest;
        loop {
            if (self.machine.stop)() {
                return Err(Stopped::Interrupted);
            }
            let Some(next) = self.own.from(cells) else {
                let why = self
                    .own
                    .level(self.own.ladder.from(cells))
                    .err()
                    .map_or(String::new(), |wrong| wrong.message);
                return match self.levels.is_empty() {
                    true => Err(Stopped::Unusable(why)),
                    false => Ok(self
                        .choose()
                        .map_err(|none| format!("{none}, and there is no finer level: {why}"))),
                };
            };
            if let Some(end) = self.enough(&next) {
                return Ok(end);
            }
            cells = ((REFINED * next.cells as f64).round() as usize).max(next.cells + 1);
            self.march(next)?;
        }
    }

    /// Whether to stop before another level: the answer, or why there is none.
    fn enough(&self, next: &Level) -> Option<Result<Chosen, String>> {
        let predicted = self.seconds(&next.plan)?;
        let spent: f64 = self.levels.iter().map(|level| level.seconds).sum();
        if needed(&next.plan) > self.machine.memory {
            return Some(self.choose().map_err(|why| format!("{why}, and no finer level fits the memory")));
        }
        match self.goal {
            Goal::Budget(budget) => (spent + predicted > SHARE * budget).then(|| {
                self.choose().map_err(|why| format!("{why}; a tenth of {budget} s pays for no finer level"))
            }),
            Goal::Error(_) => match self.choose() {
                Ok(chosen) if chosen.cells <= next.cells => Some(Ok(chosen)),
                Ok(chosen) if spent + predicted > SHARE * chosen.predicted => Some(Ok(chosen)),
                Ok(_) => None,
                Err(why) => {
                    let visits: u64 = self.levels.iter().map(|level| level.plan.bond_updates).sum();
                    let many = visits.saturating_add(next.plan.bond_updates) > GIVEN_UP;
                    many.then(|| Err(format!("{why}, on levels of {visits:e} bond updates")))
                }
            },
        }
    }

    fn march(&mut self, level: Level) -> Result<(), Stopped> {
        let predicted = self.seconds(&level.plan);
        let (record, seconds) = (self.machine.march)(&level).map_err(Stopped::Failed)?;
        let seen = record.traces.iter().map(History::from).collect();
        let Level { cells, spacing, plan, .. } = level;
        self.levels.push(Marched { cells, spacing, plan, predicted, seconds, seen });
        self.levels.sort_by_key(|level| level.cells);
        Ok(())
    }

    fn estimate(&self) -> Result<Estimate, String> {
        let levels: Vec<(f64, &[History])> =
            self.levels.iter().map(|level| (level.spacing, level.seen.as_slice())).collect();
        Estimate::new(&levels)
    }

    /// The answer by the levels so far.
    fn choose(&self) -> Result<Chosen, String> {
        let estimate = self.estimate()?;
        let level = match self.goal {
            Goal::Error(error) => {
                let spacing = estimate.spacing_for(error);
                let cells = (self.own.size[0] / spacing * (1.0 - 1e-12)).ceil();
                let coarsest = self.levels[0].cells;
                if cells > 1e9 {
                    return Err(format!(
                        "an error of {error} takes Δx = {spacing:.3e} m, by order {:?}",
                        estimate.worst(spacing).order
                    ));
                }
                // An answer coarser than all that was marched would be a guess.
                self.own.from((cells as usize).max(coarsest)).ok_or("no level is so fine")?
            }
            Goal::Budget(seconds) => self.finest(seconds),
        };
        let predicted = self.seconds(&level.plan).unwrap_or(f64::NAN);
        let Level { cells, spacing, plan, .. } = level;
        let (bytes, order) = (needed(&plan), estimate.worst(spacing).order);
        let error = estimate.at(spacing);
        Ok(Chosen { cells, spacing, plan, predicted, bytes, error, order, not_run: None, outcome: None })
    }

    /// The finest level that is predicted to take so many seconds, of those that can be marched.
    fn finest(&self, seconds: f64) -> Level {
        let (ladder, known) = (self.own.ladder, self.levels[self.levels.len() - 1].cells);
        let affords = |index: usize| {
            let level = self.own.level(known + index * ladder.step).ok()?;
            (self.seconds(&level.plan)? <= seconds).then_some(level)
        };
        let mut above = 1;
        while affords(above).is_some() {
            above *= 2;
        }
        let mut below = above / 2;
        while above - below > 1 {
            let middle = below + (above - below) / 2;
            if affords(middle).is_some() { below = middle } else { above = middle }
        }
        affords(below).or_else(|| self.own.level(known).ok()).expect("the finest level was marched")
    }

    /// Marches the answer; where it is not as accurate as was thought, the next one by all levels, and where it tells no order, one
    /// more level before that.
    fn until_met(&mut self, chosen: Chosen) -> Result<Chosen, Stopped> {
        let mut chosen = self.run(chosen)?;
        for _ in 0..MORE {
            let (Goal::Error(asked), Some(outcome)) = (self.goal, &chosen.outcome) else { break };
            match outcome.error {
                Ok(error) if error <= asked => break,
                Ok(_) => {}
                Err(_) => {
                    let finest = self.levels.last().map_or(0, |level| level.cells);
                    let next = self.own.from((REFINED * finest as f64).round() as usize);
                    let cheap = |level: &Level| level.plan.bond_updates <= GIVEN_UP;
                    let Some(next) = next.filter(cheap) else { break };
                    self.march(next)?;
                }
            }
            match self.choose() {
                Ok(finer) if finer.cells != chosen.cells => chosen = self.run(finer)?,
                Ok(_) => chosen = self.run(chosen)?,
                Err(_) => {}
            }
        }
        Ok(chosen)
    }

    /// Marches the answer, if it can be, and estimates anew.
    fn run(&mut self, chosen: Chosen) -> Result<Chosen, Stopped> {
        let not_run = if chosen.bytes > self.machine.memory {
            Some(format!(
                "it takes {:.2} GB, and {:.2} GB are free",
                1e-9 * chosen.bytes,
                1e-9 * self.machine.memory
            ))
        } else if chosen.plan.bond_updates > MAX_VISITS {
            Some(format!(
                "it takes {:e} bond updates, and at most {MAX_VISITS:e} are run",
                chosen.plan.bond_updates
            ))
        } else {
            None
        };
        if not_run.is_some() {
            return Ok(Chosen { not_run, ..chosen });
        }
        if (self.machine.stop)() {
            return Err(Stopped::Interrupted);
        }
        if !self.levels.iter().any(|level| level.cells == chosen.cells) {
            let level = self.own.level(chosen.cells).map_err(|wrong| Stopped::Unusable(wrong.message))?;
            self.march(level)?;
        }
        let marched = self.levels.iter().find(|level| level.cells == chosen.cells);
        let seconds = marched.map_or(f64::NAN, |level| level.seconds);
        let error = self.estimate().map(|estimate| estimate.at(chosen.spacing));
        Ok(Chosen { outcome: Some(Outcome { seconds, error }), ..chosen })
    }

    /// How long a plan will take, by what the finest level has taken; `None` before there is one.
    fn seconds(&self, plan: &Plan) -> Option<f64> {
        let finest = self.levels.last()?;
        Some(self.effort(plan) * finest.seconds / self.effort(&finest.plan))
    }

    /// Seconds by `bench`, or operations.
    fn effort(&self, plan: &Plan) -> f64 {
        let march = self.machine.costs.and_then(|costs| costs.of_march(plan));
        march.unwrap_or(plan.steps as f64 * plan.work.flops_per_step)
    }
}
