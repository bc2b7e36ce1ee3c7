//! Measures rates: in each round every case of a group runs once, so that what disturbs the machine disturbs all of them.

use super::cases::{Body, Case, Group};
use pd_verify::ledger::Ledger;
use pd_verify::march::March;
use pd_verify::model::Model;
use pd_verify::plan::Plan;
use pd_verify::scene::{Scene, Wrong};
use rayon::ThreadPool;
use std::time::Instant;

/// The threads that march: all that were asked for, and one.
pub struct Pools {
    pub all: ThreadPool,
    pub one: ThreadPool,
}

impl Pools {
    pub fn of(&self, case: &Case) -> &ThreadPool {
        if case.alone { &self.one } else { &self.all }
    }
}

/// How long and how often.
#[derive(Debug, Clone, Copy)]
pub struct Pace {
    pub rounds: usize,
    /// Of a case in a round, in s, where `steps` is not given.
    pub seconds: f64,
    pub steps: Option<u64>,
}

/// A case that was measured.
#[derive(Debug, Clone)]
pub struct Measured {
    pub case: Case,
    pub plan: Plan,
    pub threads: usize,
    pub steps_per_pass: u64,
    /// Of one round.
    pub steps: u64,
    /// Steps per second, round by round.
    pub rates: Vec<f64>,
    /// Over that of the group's first case in the same round.
    pub ratios: Vec<f64>,
}

/// Why there is no measurement.
#[derive(Debug)]
pub enum Failure {
    Wrong(Wrong),
    /// The named case left the numbers.
    Diverged(String),
    Interrupted,
}

/// A body that goes on by steps.
trait Goes: Send {
    fn advance(&mut self, steps: u64);
    fn is_finite(&self) -> bool;
    fn steps_per_pass(&self) -> u64;
}

struct Going<'m, const D: usize> {
    march: March<'m, D>,
    ledger: Option<Ledger<D>>,
}

impl<const D: usize> Goes for Going<'_, D> {
    fn advance(&mut self, steps: u64) {
        match &mut self.ledger {
            None => self.march.advance_to(self.march.step() + steps),
            Some(ledger) => (0..steps).for_each(|_| self.march.advance_booked(ledger)),
        }
    }

    fn is_finite(&self) -> bool {
        self.march.is_finite()
    }

    fn steps_per_pass(&self) -> u64 {
        if self.ledger.is_some() { 1 } else { self.march.steps_per_pass() as u64 }
    }
}

enum Made {
    Bar(Model<1>),
    Plate(Model<2>),
}

impl Made {
    fn of(body: &Body) -> Result<Self, Wrong> {
        Ok(match body {
            Body::Bar(scene) => Self::Bar(Model::new(scene)?),
            Body::Plate(scene) => Self::Plate(Model::new(scene)?),
        })
    }

    fn going<'m>(&'m self, body: &Body, plan: &Plan) -> Box<dyn Goes + 'm> {
        match (self, body) {
            (Self::Bar(model), Body::Bar(scene)) => going(model, scene, plan),
            (Self::Plate(model), Body::Plate(scene)) => going(model, scene, plan),
            _ => unreachable!("a model is made of its own body"),
        }
    }
}

fn going<'m, const D: usize>(model: &'m Model<D>, scene: &Scene<D>, plan: &Plan) -> Box<dyn Goes + 'm> {
    let march = March::new(model, scene, plan.time_step_s);
    Box::new(Going { march, ledger: plan.work.booked.then(|| Ledger::new(model)) })
}

/// Measures the cases of a group; `stop` is asked after each.
pub fn measure(
    group: &Group,
    pools: &Pools,
    pace: Pace,
    stop: &dyn Fn() -> bool,
) -> Result<Vec<Measured>, Failure> {
    let mut models = Vec::new();
    for case in &group.cases {
        if stop() {
            return Err(Failure::Interrupted);
        }
        models.push(pools.of(case).install(|| Made::of(&case.body)).map_err(Failure::Wrong)?);
    }
    let (mut bodies, mut measured) = (Vec::new(), Vec::new());
    for (case, made) in group.cases.iter().zip(&models) {
        let plan = case.body.plan().map_err(Failure::Wrong)?;
        let pool = pools.of(case);
        let mut body = pool.install(|| made.going(&case.body, &plan));
        let steps_per_pass = body.steps_per_pass();
        // A pass that is not counted warms caches and threads up.
        rate(pool, &mut *body, steps_per_pass);
        let steps = pace.steps.unwrap_or_else(|| enough(pool, &mut *body, pace.seconds));
        let (rates, ratios) = (Vec::new(), Vec::new());
        let threads = pool.current_num_threads();
        measured.push(Measured { case: case.clone(), plan, threads, steps_per_pass, steps, rates, ratios });
        bodies.push(body);
    }
    for _ in 0..pace.rounds {
        for (body, measured) in bodies.iter_mut().zip(&mut measured) {
            if stop() {
                return Err(Failure::Interrupted);
            }
            measured.rates.push(rate(pools.of(&measured.case), &mut **body, measured.steps));
        }
        let first = measured[0].rates[measured[0].rates.len() - 1];
        measured.iter_mut().for_each(|one| one.ratios.push(one.rates[one.rates.len() - 1] / first));
    }
    match bodies.iter().zip(&measured).find(|(body, _)| !body.is_finite()) {
        Some((_, measured)) => Err(Failure::Diverged(measured.case.name.clone())),
        None => Ok(measured),
    }
}

/// Steps per second.
fn rate(pool: &ThreadPool, body: &mut dyn Goes, steps: u64) -> f64 {
    let start = Instant::now();
    pool.install(|| body.advance(steps));
    steps as f64 / start.elapsed().as_secs_f64()
}

/// Steps that take so many seconds, whole passes and two of them at least.
fn enough(pool: &ThreadPool, body: &mut dyn Goes, seconds: f64) -> u64 {
    let pass = body.steps_per_pass();
    let (mut steps, mut found) = (pass, rate(pool, body, pass));
    while (steps as f64) < 0.25 * seconds * found && steps < 1 << 40 {
        steps *= 4;
        found = rate(pool, body, steps);
    }
    pass * ((seconds * found / pass as f64).ceil() as u64).max(2)
}
