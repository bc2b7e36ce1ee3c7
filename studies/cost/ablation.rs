//! `asks = "ablation"`: one plate with each effect on and off: what it costs, what it keeps, what it does to Δt and to the result.
//! What does nothing must leave every bit as it is.

use super::ablation_bodies::{Twin, Variant, WHOLE, plain, twins, variants};
use super::ablation_report::{figure, table};
use crate::dispersion::sweep::LatticeSweep;
use crate::dispersion::words::BodyName;
use crate::median::median;
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, value_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::lattice::Stencil;
use pd_verify::material::Body;
use pd_verify::model::Model;
use pd_verify::plan::{Plan, stable_time_step};
use pd_verify::record::Record;
use pd_verify::scene::{Beyond, Positive, Scene, StepRule, Time, Watch, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;
use std::time::Instant;

/// The case as written; one lattice.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AblationAsked {
    /// A plate.
    pub body: BodyName,
    /// Cells along each axis.
    pub nodes: [usize; 2],
    pub dx_m: Positive,
    pub steps: u64,
    /// Marches of each plate, in turns; the middle one counts.
    pub repeats: u64,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct Ablation {
    pub title: String,
    repeats: u64,
    pub variants: Vec<Ablated>,
    twins: Vec<Pair>,
}

/// A pair of plates, and the plan of the first.
struct Pair {
    twin: Twin,
    plan: Plan,
}

/// A plate with one effect, planned.
pub struct Ablated {
    pub variant: Variant,
    pub plan: Plan,
}

/// What was seen of it.
pub struct Seen {
    /// Over all repeats: the median, and the largest less the least over it.
    pub node_updates_per_s: f64,
    pub spread: f64,
    /// ‖u − u₀‖₂/‖u₀‖₂ of the displacements at the end at nodes that both plates have, u₀ the plain plate's.
    pub change: Option<f64>,
    record: Record,
}

const MOST_STEPS: u64 = 100_000;
const MOST_REPEATS: u64 = 101;
const FEWEST_NODES: usize = 32;
/// Of the lattice's limit: corrected surfaces take less.
const SHARE: f64 = 0.5;

impl Asked for AblationAsked {
    type Question = Ablation;

    fn check(&self, written: &Written<'_>) -> Result<Ablation, Wrong> {
        let (material, body) = (written.material()?, Body::from(self.body));
        if body == Body::Bar {
            let message = "a bar has neither notches nor holes";
            return Err(Wrong::new("body", message, "take plane_stress or plane_strain"));
        }
        for (key, given, most) in [("steps", self.steps, MOST_STEPS), ("repeats", self.repeats, MOST_REPEATS)]
        {
            if given == 0 || given > most {
                return Err(Wrong::new(key, format!("{given} {key}"), format!("take 1 to {most}")));
            }
        }
        if self.nodes.iter().any(|&nodes| nodes < FEWEST_NODES) {
            let message = format!("{} by {} nodes leave no room for a hole", self.nodes[0], self.nodes[1]);
            return Err(Wrong::new("nodes", message, format!("take {FEWEST_NODES} or more along each axis")));
        }
        let lattices = self.lattice.usable(body).map_err(|wrong| wrong.inside("lattice"))?;
        let &[lattice] = lattices.as_slice() else {
            return Err(Wrong::new("lattice", "one lattice is looked at", "give one value for each key"));
        };
        if lattice.calibrated {
            let message = "calibration is one of the effects that are switched on";
            return Err(Wrong::new("lattice.calibrated", message, "leave it out"));
        }
        let time = Time { duration: 1.0, step: StepRule::OfLimit(1.0) };
        let mut bare = Scene::bare(material, body, lattice, self.nodes, self.dx_m.0, time);
        let stencil = Stencil::<2>::new(lattice);
        let unusable =
            |wrong: pd_verify::lattice::Unusable| Wrong::new("lattice", wrong.to_string(), wrong.cure());
        let limit = stable_time_step(&bare, &stencil.map_err(unusable)?);
        let seconds = SHARE * limit;
        bare.time = Time {
            duration: self.steps as f64 * seconds,
            step: StepRule::Given { seconds, beyond_limit: Beyond::Refused },
        };
        let plain = plain(bare);
        let planned = |variant: Variant| Ok(Ablated { plan: named(&variant.scene, variant.name)?, variant });
        let paired = |twin: Twin| Ok(Pair { plan: named(&twin.with, twin.name)?, twin });
        Ok(Ablation {
            title: written.title.to_owned(),
            repeats: self.repeats,
            variants: variants(&plain).into_iter().map(planned).collect::<Result<_, Wrong>>()?,
            twins: twins(&plain).into_iter().map(paired).collect::<Result<_, Wrong>>()?,
        })
    }
}

/// A plan that is called by its effect.
fn named(scene: &Scene<2>, name: &str) -> Result<Plan, Wrong> {
    Ok(Plan { name: name.into(), ..Plan::of(scene)? })
}

impl Question for Ablation {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let source = "the same plate without it";
        let bits = |name: &str, quantity: &str, why: &str| Claim {
            error_kind: ErrorKind::Bits,
            ..claim(place, name, quantity).exactly().because(Basis::Theory, why).source(source)
        };
        let count = |name: &str, quantity: &str, why: &str, source: &str| {
            claim(place, name, quantity).exactly().because(Basis::Theory, why).source(source)
        };
        vec![
            bits(
                "neutral",
                "displacements that differ in any bit where an effect of nothing is on",
                "a force of 0 adds 0, a bond that is cut twice is cut, a factor of 1 changes no product",
            ),
            bits(
                "watched",
                "displacements that differ in any bit where probes, snapshots or the ledger watch",
                "who watches changes nothing, and no bit depends on how many steps are made in one pass",
            ),
            count(
                "named",
                "effects of nothing that a plan does not name, and others that it names",
                "a plan tells from the scene alone what changes no bit of its march",
                "the pairs of plates of the claim above, and those with one effect",
            ),
            count(
                "bytes",
                "bytes by which what plates keep differs from their plans",
                "a plan counts what operators, loads and motions keep, without making them",
                "the lengths of what the model of each plate holds",
            ),
        ]
    }

    fn scenes(&self) -> Vec<Planned> {
        let twins = self.twins.iter().map(|pair| pair.plan.clone());
        self.variants.iter().map(|one| one.plan.clone()).chain(twins).collect()
    }

    fn effort(&self) -> Effort {
        let variants = self.variants.iter().flat_map(|one| (0..self.repeats).map(|_| one.plan.clone()));
        let twins = self.twins.iter().flat_map(|pair| [pair.plan.clone(), pair.plan.clone()]);
        Effort::of_scenes(&variants.chain(twins).collect::<Vec<_>>())
    }

    fn equations(&self) -> &'static str {
        "rate: nodes · steps/s of whole runs; change: ‖u − u₀‖₂/‖u₀‖₂ at the end, u₀ of the plain plate"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let seen = match self.march(subject) {
            Ok(seen) => seen,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        let twins: Result<Vec<(&Twin, [Record; 2])>, String> = self
            .twins
            .iter()
            .map(|Pair { twin, .. }| Ok((twin, [run(subject, &twin.with)?, run(subject, &twin.without)?])))
            .collect();
        let twins = match twins {
            Ok(twins) => twins,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        let kept: Option<f64> =
            self.variants.iter().zip(&seen).map(|(one, seen)| off(one, &seen.record)).sum();
        let differing = |avoidable: bool| {
            let of = twins.iter().filter(|(twin, _)| twin.avoidable == avoidable);
            of.map(|(_, [with, without])| differing(with, without)).sum::<Option<usize>>()
        };
        let unnamed =
            twins.iter().filter(|(twin, [with, _])| twin.avoidable == with.plan.avoidable.is_empty());
        let named = seen.iter().filter(|seen| !seen.record.plan.avoidable.is_empty());
        let mistakes = unnamed.count() + named.count();
        let none = |found: Option<f64>, note: String| value_of(found, Some(0.0), note);
        let pairs = |avoidable: bool| {
            let of = self.twins.iter().filter(|pair| pair.twin.avoidable == avoidable);
            let names: Vec<&str> = of.map(|pair| pair.twin.name).collect();
            names.join(", ")
        };
        Answer {
            evidence: vec![
                ("neutral".into(), none(differing(true).map(|n| n as f64), pairs(true))),
                ("watched".into(), none(differing(false).map(|n| n as f64), pairs(false))),
                ("named".into(), none(Some(mistakes as f64), format!("{} plans", seen.len() + twins.len()))),
                ("bytes".into(), none(kept, format!("{} plates", seen.len()))),
            ],
            tables: vec![table(self, &seen, place)],
            figures: vec![figure(self, &seen, place)],
            ..Answer::default()
        }
    }
}

impl Ablation {
    /// Every plate as often as asked, in turns, so that what disturbs the machine disturbs all.
    fn march(&self, subject: &dyn Subject) -> Result<Vec<Seen>, String> {
        let mut rates = vec![Vec::new(); self.variants.len()];
        let mut records = Vec::new();
        for _ in 0..self.repeats {
            records.clear();
            for (one, rates) in self.variants.iter().zip(&mut rates) {
                let start = Instant::now();
                records.push(run(subject, &one.variant.scene)?);
                rates.push(one.plan.node_updates as f64 / start.elapsed().as_secs_f64());
            }
        }
        let plain = records[0].clone();
        let seen = |(record, rates): (Record, Vec<f64>)| {
            let middle = median(&rates);
            let largest = rates.iter().copied().fold(f64::NAN, f64::max);
            let least = rates.iter().copied().fold(f64::NAN, f64::min);
            let change = change(&record, &plain);
            Seen { node_updates_per_s: middle, spread: (largest - least) / middle, change, record }
        };
        Ok(records.into_iter().zip(rates).map(seen).collect())
    }
}

fn run(subject: &dyn Subject, scene: &Scene<2>) -> Result<Record, String> {
    subject.march_plate(scene).map_err(|failure| failure.to_string())
}

/// Displacements of all cells at the end, `None` where there is no node; empty where nothing was seen.
fn last(record: &Record) -> Vec<Option<f64>> {
    let Some(trace) = record.trace(WHOLE) else { return Vec::new() };
    let Some(row) = trace.rows.last().filter(|_| trace.rows.len() > 1) else { return Vec::new() };
    let all =
        row.iter().zip(&trace.columns).filter(|(_, column)| column.quantity.starts_with("displacement"));
    all.map(|(value, column)| (!column.removed).then_some(*value)).collect()
}

fn change(one: &Record, plain: &Record) -> Option<f64> {
    let (a, b) = (last(one), last(plain));
    let both: Vec<(f64, f64)> = a.iter().zip(&b).filter_map(|(a, b)| a.zip(*b)).collect();
    let apart: f64 = both.iter().map(|(a, b)| (a - b).powi(2)).sum();
    let size: f64 = both.iter().map(|(_, b)| b * b).sum();
    (!both.is_empty() && a.len() == b.len()).then(|| (apart / size).sqrt())
}

/// How many displacements differ; `None` where not all was seen.
fn differing(one: &Record, other: &Record) -> Option<usize> {
    let (a, b) = (last(one), last(other));
    let bits = |value: &Option<f64>| value.map(f64::to_bits);
    (!a.is_empty() && a.len() == b.len())
        .then(|| a.iter().zip(&b).filter(|(a, b)| bits(a) != bits(b)).count())
}

/// Bytes by which the plan of a record and the model of its scene differ.
fn off(one: &Ablated, record: &Record) -> Option<f64> {
    let scene = &one.variant.scene;
    let model = Model::new(scene).ok()?;
    let booked = scene.probes.iter().any(|probe| probe.watch == Watch::Energies);
    let state = if booked { 6 } else { 3 } * size_of::<f64>() * model.grid.field().len();
    let forces: usize = model.forces().iter().map(|force| force.bytes()).sum();
    let held: usize = model.constraints.iter().map(|constraint| size_of_val(constraint.places())).sum();
    let planned = (record.plan.bytes_per_node * record.plan.nodes as f64).round();
    Some((planned - (state + forces + held) as f64).abs())
}
