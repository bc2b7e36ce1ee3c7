//! A scene of a bar or of a plate, where the rest of a study need not know which.

use crate::subject::Subject;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::plan::Plan;
use pd_verify::record::{Failure, Patch, Record};
use pd_verify::scene::{Beyond, Operator, Probe, Scene, StepRule, Time, Watch, Wrong};

/// One of the two.
#[derive(Debug, Clone)]
pub enum Either {
    Bar(Scene<1>),
    Plate(Scene<2>),
}

impl From<Scene<1>> for Either {
    fn from(scene: Scene<1>) -> Self {
        Self::Bar(scene)
    }
}

impl From<Scene<2>> for Either {
    fn from(scene: Scene<2>) -> Self {
        Self::Plate(scene)
    }
}

impl Either {
    /// Checks it and says how it will be run.
    pub fn plan(&self) -> Result<Plan, Wrong> {
        match self {
            Self::Bar(scene) => Plan::of(scene),
            Self::Plate(scene) => Plan::of(scene),
        }
    }

    /// Asks the code under judgement to march it.
    pub fn march(&self, subject: &dyn Subject) -> Result<Record, Failure> {
        match self {
            Self::Bar(scene) => subject.march_bar(scene),
            Self::Plate(scene) => subject.march_plate(scene),
        }
    }

    /// Its first steps by an operator, with displacements watched along the middle of each axis and where the scene's
    /// own probes watch them.
    pub fn beginning(&self, operator: Operator, steps: u64, plan: &Plan) -> Self {
        match self {
            Self::Bar(scene) => Self::Bar(beginning(scene, operator, steps, plan)),
            Self::Plate(scene) => Self::Plate(beginning(scene, operator, steps, plan)),
        }
    }

    /// At how many places a probe looks.
    pub fn places(&self, probe: &str) -> usize {
        match self {
            Self::Bar(scene) => places(scene, probe),
            Self::Plate(scene) => places(scene, probe),
        }
    }

    /// What its bonds are made from.
    pub fn lattice(&self) -> Lattice {
        match self {
            Self::Bar(scene) => scene.lattice,
            Self::Plate(scene) => scene.lattice,
        }
    }

    /// Bonds of a node far from every edge, and nodes along the longest axis.
    pub fn extent(&self) -> (usize, usize) {
        match self {
            Self::Bar(scene) => (bonds(scene), scene.nodes[0]),
            Self::Plate(scene) => (bonds(scene), scene.nodes[0].max(scene.nodes[1])),
        }
    }
}

fn places<const D: usize>(scene: &Scene<D>, probe: &str) -> usize {
    match scene.probes.iter().find(|other| other.name == probe).map(|probe| &probe.watch) {
        Some(&Watch::Line { along, .. }) => scene.nodes[along],
        Some(&Watch::Patch { from, to }) => Patch::of(&scene.grid(0), from, to).count(),
        _ => 1,
    }
}

fn bonds<const D: usize>(scene: &Scene<D>) -> usize {
    Stencil::<D>::new(scene.lattice).map_or(0, |stencil| 2 * stencil.bonds.len())
}

/// The place across an axis that is nearest to the middle and where holes have left a node.
fn middle<const D: usize>(scene: &Scene<D>, across: usize) -> f64 {
    let half = 0.5 * scene.size()[across];
    let grid = scene.grid(0);
    let places = grid.each().map(|node| grid.position(node)[across]);
    let nearest = places.min_by(|a, b| (a - half).abs().total_cmp(&(b - half).abs()));
    if grid.pierced() { nearest.unwrap_or(half) } else { half }
}

fn beginning<const D: usize>(scene: &Scene<D>, operator: Operator, steps: u64, plan: &Plan) -> Scene<D> {
    let seconds = plan.time_step_s;
    let every = (steps / 20).max(1);
    let lines = (0..D).map(|along| {
        let through = if D == 1 { 0.0 } else { middle(scene, 1 - along) };
        Probe { name: format!("(line {along})"), watch: Watch::Line { along, through }, every }
    });
    let places = |watch: &Watch<D>| matches!(watch, Watch::Point { .. } | Watch::Line { .. });
    let own = scene.probes.iter().filter(|probe| places(&probe.watch));
    let own = own.map(|probe| Probe { every, ..probe.clone() });
    let word = if operator == Operator::Stencil { "stencil" } else { "bonds" };
    Scene {
        name: format!("{}, check: first {steps} steps by {word}", scene.name),
        operator,
        time: Time {
            duration: steps as f64 * seconds,
            step: StepRule::Given { seconds, beyond_limit: Beyond::UntilItShows },
        },
        probes: own.chain(lines).collect(),
        snapshots: Vec::new(),
        ..scene.clone()
    }
}
