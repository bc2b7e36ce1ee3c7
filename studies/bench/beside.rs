//! What a march costs beside its steps: to begin, to stop, to look for growth, to ask a patch for its forces.

use super::bodies::{bar, plan, plate};
use super::measure::Pools;
use pd_verify::constraints::{Edge, Edges};
use pd_verify::march::March;
use pd_verify::model::Model;
use pd_verify::plan::time::{BodyCosts, BySize, Costs};
use pd_verify::plan::{Looks, Plan};
use pd_verify::record;
use pd_verify::scene::{Probe, Scene, Snapshots, Watch, Wrong};
use std::time::Instant;

/// Steps of a march that is timed, and how often it is.
const STEPS: u64 = 64;
const TIMES: usize = 7;

/// Adds it to the costs of steps, on all threads.
pub fn beside(costs: Costs, pools: &Pools) -> Result<Costs, Wrong> {
    pools.all.install(|| {
        let bars: Vec<Timed> = [100, 1000, 5000, 20_000]
            .into_iter()
            .map(|nodes| Timed::of(bar(nodes, 3.0), &costs))
            .collect::<Result<_, _>>()?;
        let plates: Vec<Timed> = [16, 32, 64, 128, 256]
            .into_iter()
            .map(|side| Timed::of(plate([side; 2], 3.0), &costs))
            .collect::<Result<_, _>>()?;
        Ok(Costs { bar: with(costs.bar.clone(), &bars), plate: with(costs.plate.clone(), &plates) })
    })
}

/// One body's: seconds of each thing, a step's own taken off where it makes forces.
struct Timed {
    nodes: f64,
    begin: f64,
    growth: f64,
    stop: f64,
    snapshot: f64,
    /// Of a step, where ghosts are filled after it.
    repeat: f64,
    patch_node: f64,
    value: f64,
}

impl Timed {
    fn of<const D: usize>(scene: Scene<D>, costs: &Costs) -> Result<Self, Wrong> {
        let plan = Plan { steps: STEPS, ..plan(&scene)? };
        let model = Model::new(&scene)?;
        let step = costs.of_step(&plan.work).unwrap_or(0.0);
        let new = || March::new(&model, &scene, plan.time_step_s);
        let begin = least(|| {
            let start = Instant::now();
            let march = new();
            (start.elapsed().as_secs_f64(), march.step())
        });
        let (mut at_once, mut step_by_step) = (new(), new());
        let whole = least(|| {
            let (start, from) = (Instant::now(), at_once.step());
            at_once.advance_to(from + STEPS);
            (start.elapsed().as_secs_f64(), 0)
        });
        let stopped = least(|| {
            let (start, from) = (Instant::now(), step_by_step.step());
            let finite = (1..=STEPS).filter(|step| {
                step_by_step.advance_to(from + step);
                step_by_step.is_finite()
            });
            let finite = finite.count() as u64;
            (start.elapsed().as_secs_f64(), finite)
        });
        let growth = least(|| {
            let start = Instant::now();
            let motion = step_by_step.motion();
            (start.elapsed().as_secs_f64(), u64::from(motion.square > 1.0))
        });
        let looked = |watch: Watch<D>| {
            let probe = Probe { name: "seen".into(), watch, every: 1 };
            let scene = Scene { probes: vec![probe], ..scene.clone() };
            run(&scene, &plan, &model)
        };
        let repeated = {
            let scene = Scene { edges: Edges([[Edge::Periodic; 2]; D]), ..scene.clone() };
            let model = Model::new(&scene)?;
            let mut march = March::new(&model, &scene, plan.time_step_s);
            least(|| {
                let (start, from) = (Instant::now(), march.step());
                march.advance_to(from + STEPS);
                (start.elapsed().as_secs_f64(), 0)
            })
        };
        let size = scene.size();
        let (point, few) = looked(Watch::Point { at: size.map(|length| 0.5 * length) });
        let (line, many) = looked(Watch::Line { along: 0, through: 0.5 * size[D - 1] });
        let (seen, _) = {
            let until = STEPS as f64 * plan.time_step_s;
            let asked = Snapshots { name: "seen".into(), times: vec![until] };
            run(&Scene { snapshots: vec![asked], ..scene.clone() }, &plan, &model)
        };
        let (unseen, _) = run(&scene, &plan, &model);
        let quarter = |share: f64| size.map(|length| share * length);
        let (patch, asked) = looked(Watch::Patch { from: quarter(0.375), to: quarter(0.625) });
        let more = |most: u64| (most - few.values.min(most)).max(1) as f64;
        let value = ((line - point) / more(many.values)).max(0.0);
        let patch_node =
            ((patch - point - value * more(asked.values)) / asked.patch_nodes.max(1) as f64).max(0.0);
        Ok(Self {
            nodes: plan.nodes as f64,
            begin: (begin - step).max(0.0),
            growth: (growth - step).max(0.0),
            stop: ((stopped - whole) / STEPS as f64).max(0.0),
            snapshot: (seen - unseen).max(0.0),
            repeat: ((repeated - whole) / STEPS as f64).max(0.0),
            patch_node,
            value,
        })
    }
}

/// Seconds of a march that is looked at, and what its looks see.
fn run<const D: usize>(scene: &Scene<D>, plan: &Plan, model: &Model<D>) -> (f64, Looks) {
    let looks = Looks::of(scene, &model.grid, STEPS);
    let seconds = least(|| {
        let plan = plan.clone();
        let start = Instant::now();
        let record = record::march(scene, plan, model);
        (start.elapsed().as_secs_f64(), u64::from(record.is_ok()))
    });
    (seconds, looks)
}

/// The least of several: what disturbs the machine only adds.
fn least(mut timed: impl FnMut() -> (f64, u64)) -> f64 {
    (0..TIMES).map(|_| std::hint::black_box(timed()).0).fold(f64::INFINITY, f64::min)
}

fn with(steps: BodyCosts, timed: &[Timed]) -> BodyCosts {
    let by_size = |of: fn(&Timed) -> f64| BySize(timed.iter().map(|one| (one.nodes, of(one))).collect());
    // The steps of a larger body would hide what a look takes.
    let middle = timed.get(timed.len() / 2);
    BodyCosts {
        begin: by_size(|timed| timed.begin),
        growth: by_size(|timed| timed.growth),
        stop: by_size(|timed| timed.stop),
        snapshot: by_size(|timed| timed.snapshot),
        repeat: by_size(|timed| timed.repeat),
        patch_node_s: middle.map_or(0.0, |timed| timed.patch_node),
        value_s: middle.map_or(0.0, |timed| timed.value),
        ..steps
    }
}
