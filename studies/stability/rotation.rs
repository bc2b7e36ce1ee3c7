//! `asks = "rotation"`: a plate that turns: the exact law feels no rigid rotation, a free plate that spins keeps its angular momentum
//! and stretches with the square of its spin; the linearised law takes a rotation for a strain.

use super::body::{FreeBody, FreeBodyAsked};
use super::time_step::bodies;
use crate::dispersion::sweep::LatticeSweep;
use crate::levels::order_of;
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::lattice::Stencil;
use pd_verify::plan::Plan;
use pd_verify::record::Record;
use pd_verify::report::plot::{Axis, Figure, Lines, Series};
use pd_verify::scene::{
    Beyond, Initial, Positive, Probe, Rotations, Scene, Shape, StepRule, Time, Watch, Wrong,
};
use pd_verify::table::{Cell, Table};
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written; one lattice.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RotationAsked {
    /// A plate.
    pub body: FreeBodyAsked,
    /// How many rigid rotations follow each other.
    pub rotations: u64,
    /// Angular velocities, falling, at least three.
    pub spin_per_s: Vec<Positive>,
    /// Of each free spin.
    pub steps: u64,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct Rotation {
    title: String,
    plate: Scene<2>,
    rotations: u64,
    /// By angular velocity in 1/s.
    spins: Vec<(f64, Scene<2>, Plan)>,
    /// ΣwΔx in N/m³: what the bonds of a node pull, stretched by 1.
    pull: f64,
}

/// What a free spin kept.
struct Spun {
    spin: f64,
    /// By step: angular momentum over the first less 1.
    momentum: Vec<f64>,
    /// By step: the second moment of the nodes about their middle over that at t = 0 less 1.
    stretch: Vec<f64>,
}

const LOOK: &str = "body";
/// Angle of one rotation; no fraction of a turn.
const TURN: f64 = 2.399_963_229_728_653;
const MOST_ROTATIONS: u64 = 100_000;
const MOST_STEPS: u64 = 20_000;

impl Asked for RotationAsked {
    type Question = Rotation;

    fn check(&self, written: &Written<'_>) -> Result<Rotation, Wrong> {
        for (key, given, most) in
            [("rotations", self.rotations, MOST_ROTATIONS), ("steps", self.steps, MOST_STEPS)]
        {
            if given == 0 || given > most {
                return Err(Wrong::new(key, format!("{given} {key}"), format!("take 1 to {most}")));
            }
        }
        let spins = crate::levels::refining("spin_per_s", &self.spin_per_s, |fast, slow| fast > slow)?;
        let (_, made) = bodies(&self.body, &self.lattice, written.material()?)?;
        let [FreeBody::Plate(plate)] = &made[..] else {
            let message = "a rotation needs one plate of one lattice";
            return Err(Wrong::new("body", message, "take a plate, and one value for each key of lattice"));
        };
        let plate = Scene { rotations: Rotations::Finite, displacement: Vec::new(), ..plate.clone() };
        let unusable =
            |wrong: pd_verify::lattice::Unusable| Wrong::new("lattice", wrong.to_string(), wrong.cure());
        let stencil = Stencil::<2>::new(plate.lattice).map_err(unusable)?;
        let limit = pd_verify::plan::stable_time_step(&plate, &stencil);
        let spinning = |&spin: &f64| {
            let scene = spun(&plate, spin, 0.5 * limit, self.steps);
            let plan = Plan::below(&scene, limit)?;
            Ok((spin, scene, plan))
        };
        let spins = spins.iter().map(spinning).collect::<Result<Vec<_>, Wrong>>()?;
        Ok(Rotation {
            title: written.title.to_owned(),
            pull: stencil.row_sum() * plate.modulus() / plate.spacing,
            rotations: self.rotations,
            plate,
            spins,
        })
    }
}

impl Question for Rotation {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        vec![
            claim(place, "no_force", format!("largest force of the exact law after any of {} rigid rotations, over ΣwΔx", self.rotations))
                .at_most(ErrorKind::Relative, 1e-12)
                .because(Basis::Rounding, "a thousand products of rotations leave 1e-13 of a length, displacements of a few plates 1e-14 of a bond's")
                .source("f = cs(ξ + η)/|ξ + η| with the stretch s = 0"),
            claim(place, "linear_resists", "largest force of the linearised law after a half turn, over ΣwΔx")
                .at_least(0.1)
                .because(Basis::Theory, "η = −2ξ is taken for a strain of −2: at a straight edge, where half of the bonds are missing, these add up to more than a tenth")
                .source("f = c (ξ⊗ξ/|ξ|³) η"),
            claim(place, "angular_momentum", "largest change of the angular momentum of a plate that spins freely, any spin")
                .at_most(ErrorKind::Relative, 1e-10)
                .because(Basis::Rounding, "leapfrog keeps Σ x(n) × v(n+½) exactly under forces along bonds as they are; increments are seen to 1e-12 in displacements a million times as large")
                .source("x(n+1) × v(n+½) = x(n) × v(n+½), and no torque of bonds"),
            claim(place, "stretch", "order of the mean growth of the second moment in the spin")
                .order(2.0, 0.01)
                .because(Basis::Theory, "ρΩ²r² is the only load, and the body hardly strained: what is not of second order is of the size of the strain, 1e-3 at most")
                .source("centrifugal load ρΩ²r"),
        ]
    }

    fn scenes(&self) -> Vec<Planned> {
        self.spins.iter().map(|(_, _, plan)| plan.clone()).collect()
    }

    fn effort(&self) -> Effort {
        let mut total = Effort::of_scenes(&self.scenes());
        let nodes = self.plate.nodes.iter().product::<usize>() as u64;
        total += Effort { curves: 1, node_updates: nodes * self.rotations, ..Effort::default() };
        total
    }

    fn equations(&self) -> &'static str {
        "u = (R − I)x, R = R₁R₂…: f = cs(ξ + η)/|ξ + η| = 0
L = ρV Σ x(n) × v(n+½) constant; Σ|x|²/Σ|x₀|² − 1 ∝ Ω²"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let spun: Result<Vec<Spun>, String> = self
            .spins
            .par_iter()
            .map(|(spin, scene, plan)| {
                let record = subject.march_plate(scene).map_err(|failure| failure.to_string())?;
                seen(*spin, scene, plan, &record)
            })
            .collect();
        let found = spun.and_then(|spun| Ok((spun, self.turned(subject)?, self.resisted(subject)?)));
        let (spun, turned, resisted) = match found {
            Ok(found) => found,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        let momentum = largest(spun.iter().flat_map(|one| one.momentum.iter().map(|change| change.abs())));
        let points: Vec<(f64, f64)> = spun.iter().map(|one| (one.spin, mean(&one.stretch))).collect();
        let resists = Evidence { computed: Some(resisted), ..Evidence::default() };
        Answer {
            evidence: vec![
                ("no_force".into(), error_of(turned, format!("{} rotations", self.rotations))),
                ("linear_resists".into(), resists),
                ("angular_momentum".into(), error_of(momentum, format!("{} spins", spun.len()))),
                ("stretch".into(), order_of("mean growth of the second moment", &points, 2.0, 0.0)),
            ],
            tables: vec![table(&spun, place)],
            figures: vec![self.figure(&spun, place)],
            ..Answer::default()
        }
    }
}

impl Rotation {
    /// The largest force over all rotations, over the pull of all bonds.
    fn turned(&self, subject: &dyn Subject) -> Result<Option<f64>, String> {
        let (sin, cos) = (libm::sin(TURN), libm::cos(TURN));
        let mut turn = [[1.0, 0.0], [0.0, 1.0]];
        let mut scenes = Vec::new();
        for _ in 0..self.rotations {
            turn = turn.map(|[x, y]| [cos * x + sin * y, cos * y - sin * x]);
            scenes.push(rotated(&self.plate, turn));
        }
        let force = |scene: &Scene<2>| subject.bond_force_plate(scene).map(|forces| strongest(&forces));
        let forces = scenes.par_iter().map(force).collect::<Result<Vec<_>, String>>()?;
        Ok(largest(forces.into_iter().map(|force| force / self.pull)))
    }

    /// The largest force of the linearised law after half a turn, over the pull of all bonds.
    fn resisted(&self, subject: &dyn Subject) -> Result<f64, String> {
        let half = rotated(&self.plate, [[-1.0, 0.0], [0.0, -1.0]]);
        let linear = Scene { rotations: Rotations::Small, ..half };
        Ok(strongest(&subject.bond_force_plate(&linear)?) / self.pull)
    }

    fn figure(&self, spun: &[Spun], place: &Place) -> Figure {
        let series = |(slot, one): (usize, &Spun)| {
            let over = |(step, stretch): (usize, &f64)| (step as f64, stretch / (one.spin * one.spin));
            Series::line(format!("Ω = {} 1/s", one.spin), one.stretch.iter().enumerate().map(over).collect())
                .slot(slot)
        };
        let all = spun.iter().enumerate().map(series).collect();
        let panel =
            Lines::new(Axis::linear("step"), Axis::linear("growth of the second moment / Ω² (s²)"), all);
        let caption = "A plate that is set spinning swings about the stretch of its centrifugal load: over Ω² all spins are one curve.";
        Figure::new(place.case.clone(), self.title.clone(), caption, panel)
    }
}

/// A field that grows with a coordinate, from the middle of the body on.
fn linear(plate: &Scene<2>, component: usize, along: usize, amplitude: f64) -> [Initial<2>; 2] {
    let middle = 0.5 * plate.size()[along];
    [
        Initial { component, amplitude, shape: Shape::Linear { along } },
        Initial { component, amplitude: -amplitude * middle, shape: Shape::Uniform },
    ]
}

/// u = (R − I)(x − x₀).
fn rotated(plate: &Scene<2>, turn: [[f64; 2]; 2]) -> Scene<2> {
    let entry = |(row, column): (usize, usize)| {
        let one = if row == column { 1.0 } else { 0.0 };
        linear(plate, row, column, turn[row][column] - one)
    };
    let displacement = [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().flat_map(entry).collect();
    Scene { displacement, ..plate.clone() }
}

/// v = Ω × (x − x₀) at t = 0, and the whole body at every step.
fn spun(plate: &Scene<2>, spin: f64, seconds: f64, steps: u64) -> Scene<2> {
    let velocity = [linear(plate, 0, 1, -spin), linear(plate, 1, 0, spin)].concat();
    let step = StepRule::Given { seconds, beyond_limit: Beyond::Refused };
    let watch = Watch::Patch { from: [0.0; 2], to: plate.size() };
    Scene {
        velocity,
        time: Time { duration: seconds * steps as f64, step },
        probes: vec![Probe { name: LOOK.into(), watch, every: 1 }],
        ..plate.clone()
    }
}

/// Angular momenta and second moments, step by step.
fn seen(spin: f64, scene: &Scene<2>, plan: &Plan, record: &Record) -> Result<Spun, String> {
    let trace = record.trace(LOOK).ok_or("the plate was not seen")?;
    let middle = scene.size().map(|side| 0.5 * side);
    let columns = scene.nodes[0];
    let place = |index: usize| {
        let node = [index % columns, index / columns];
        [0, 1].map(|axis| (node[axis] as f64 + 0.5) * scene.spacing - middle[axis])
    };
    let moved = |row: &[f64]| -> Vec<[f64; 2]> {
        let at = |(index, node): (usize, &[f64])| [0, 1].map(|axis| place(index)[axis] + node[axis]);
        row.chunks_exact(4).enumerate().map(at).collect()
    };
    let (mut momentum, mut stretch) = (Vec::new(), Vec::new());
    for pair in trace.rows.windows(2) {
        let turned = |(x, (next, now)): (&[f64; 2], (&[f64], &[f64]))| {
            let v = [0, 1].map(|axis| (next[axis] - now[axis]) / plan.time_step_s);
            x[0] * v[1] - x[1] * v[0]
        };
        let steps = pair[1].chunks_exact(4).zip(pair[0].chunks_exact(4));
        momentum.push(moved(&pair[0]).iter().zip(steps).map(turned).sum::<f64>());
    }
    for row in &trace.rows {
        stretch.push(moved(row).iter().map(|[x, y]| x * x + y * y).sum::<f64>());
    }
    let over =
        |values: Vec<f64>| -> Vec<f64> { values.iter().map(|value| value / values[0] - 1.0).collect() };
    Ok(Spun { spin, momentum: over(momentum), stretch: over(stretch) })
}

fn strongest(forces: &[[f64; 2]]) -> f64 {
    largest(forces.iter().flatten().map(|force| force.abs())).unwrap_or(f64::NAN)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// A row for every spin.
fn table(spun: &[Spun], place: &Place) -> Table {
    let columns = ["case", "spin_per_s", "angular_momentum_change", "second_moment_growth"];
    let mut table = Table::new("stability_rotation.csv", &columns);
    for one in spun {
        let change = largest(one.momentum.iter().map(|change| change.abs()));
        let row: Vec<Cell> =
            vec![place.case.as_str().into(), one.spin.into(), change.into(), mean(&one.stretch).into()];
        table.push(row);
    }
    table
}
