//! A bar or a plate with a rough start, marched at any time step, seen whole.

use crate::dispersion::words::BodyName;
use crate::subject::Subject;
use pd_verify::fastest::Fastest;
use pd_verify::forces::surface::Correction;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::material::{Body, Material};
use pd_verify::plan::{Plan, stable_time_step};
use pd_verify::record::{Diverged, Failure, Record};
use pd_verify::scene::{
    Beyond, Initial, NotchAsked, Positive, Probe, Scene, Shape, StepRule, Time, Watch, Wrong,
};
use schemars::JsonSchema;
use serde::Deserialize;

/// A body as written: free edges, and in a plate notches.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FreeBodyAsked {
    pub is: BodyName,
    /// Cells along each axis: one number for a bar, two for a plate.
    pub nodes: Vec<usize>,
    pub dx_m: Positive,
    /// Cuts through a plate.
    #[serde(default)]
    pub notch: Vec<NotchAsked>,
    pub surface_correction: Option<Correction>,
}

/// A body of either dimension.
#[derive(Debug, Clone)]
pub enum FreeBody {
    Bar(Scene<1>),
    Plate(Scene<2>),
}

/// What was seen of a whole body at a step.
#[derive(Debug, Clone)]
pub struct Look {
    pub step: u64,
    /// Displacements of all nodes that there are in m, node by node along x, then row by row.
    pub displacement: Vec<f64>,
    /// Accelerations in m/s².
    pub acceleration: Vec<f64>,
}

/// A fastest mode of either dimension.
pub struct Mode {
    /// In 1/s.
    pub omega: f64,
    /// Of the next slower mode.
    pub next_omega: f64,
    /// As a [`Look`] orders displacements; the sum of the squares is 1.
    pub shape: Vec<f64>,
}

/// What a body kept, by the step of each look.
pub struct Booked {
    pub looks: Vec<Look>,
    /// Kinetic and elastic energy together, in J.
    pub energies: Vec<(u64, f64)>,
    /// Length of the momentum in N s.
    pub momenta: Vec<(u64, f64)>,
}

/// How a body is marched: Δt in s, so many steps, from one look to the next.
#[derive(Debug, Clone, Copy)]
pub struct Pace {
    pub seconds: f64,
    pub steps: u64,
    pub every: u64,
}

/// Largest displacement of the start, in spacings.
const SMALL: f64 = 1e-6;
const LOOK: &str = "body";
const ENERGIES: &str = "energies";
const MOMENTUM: &str = "momentum";
/// Looks at the accounts from one look at the whole body to the next.
const SELDOM: u64 = 10;

impl FreeBodyAsked {
    /// The body of a lattice, of section 1, or what is wrong with it.
    pub fn check(&self, material: Material, lattice: Lattice) -> Result<FreeBody, Wrong> {
        let (body, dx) = (Body::from(self.is), self.dx_m.0);
        match (body, &self.nodes[..]) {
            (Body::Bar, &[along]) if self.notch.is_empty() => {
                Ok(FreeBody::Bar(self.rough(Scene::bare(material, body, lattice, [along], dx, NO_TIME))))
            }
            (Body::Bar, &[_]) => {
                Err(Wrong::new("notch", "a bar has no notches", "leave them out, or take a plate"))
            }
            (Body::PlaneStress | Body::PlaneStrain, &[along, across]) => {
                let size = [along, across].map(|n| n as f64 * dx);
                let notch = |(index, notch): (usize, &NotchAsked)| {
                    let inside = |wrong: Wrong| wrong.inside(&format!("notch[{index}]"));
                    if notch.runs.is_some() {
                        let message = "a notch that runs changes the body's limit on the way";
                        return Err(inside(Wrong::new("runs", message, "leave runs out")));
                    }
                    notch.check(size, dx).map_err(inside)
                };
                let notches = self.notch.iter().enumerate().map(notch).collect::<Result<_, Wrong>>()?;
                let bare = Scene::bare(material, body, lattice, [along, across], dx, NO_TIME);
                Ok(FreeBody::Plate(self.rough(Scene { notches, ..bare })))
            }
            (_, nodes) => {
                let message = format!("{} numbers of nodes for a body of {}", nodes.len(), body.name());
                Err(Wrong::new("nodes", message, "give one for a bar, two for a plate"))
            }
        }
    }

    /// Waves without symmetry in every component: some of every mode.
    fn rough<const D: usize>(&self, scene: Scene<D>) -> Scene<D> {
        let wave = |component: usize, turn: f64| {
            let along = |axis: usize| (turn + 0.7 * axis as f64) / scene.spacing;
            let shape = Shape::Wave { wavenumber: std::array::from_fn(along), phase: turn };
            Initial { component, amplitude: SMALL / 3.0 * scene.spacing, shape }
        };
        let turns =
            |component: usize| [1.3, 2.4, 3.05].map(|turn| wave(component, turn + 0.2 * component as f64));
        let surface = self.surface_correction.unwrap_or_default();
        Scene { displacement: (0..D).flat_map(turns).collect(), surface, ..scene }
    }
}

/// Of a scene that is given a pace before it is marched.
const NO_TIME: Time = Time { duration: 1.0, step: StepRule::OfLimit(1.0) };

impl FreeBody {
    /// The lattice's limit in s, as the judged code finds it.
    pub fn lattice_limit(&self, subject: &dyn Subject) -> Result<f64, String> {
        let lost = |unusable: pd_verify::lattice::Unusable| unusable.to_string();
        Ok(match self {
            Self::Bar(scene) => {
                let stencil = Stencil::<1>::new(scene.lattice).map_err(lost)?;
                subject.bar_time_step(&stencil).sharp * scene.spacing / scene.speed()
            }
            Self::Plate(scene) => {
                let stencil = Stencil::<2>::new(scene.lattice).map_err(lost)?;
                subject.plane_time_step(&stencil).sharp * scene.spacing / scene.speed()
            }
        })
    }

    /// Plans of marches at shares of the lattice's limit, for so many steps each.
    pub fn plans(&self, marches: &[(f64, u64)]) -> Result<Vec<Plan>, Wrong> {
        match self {
            Self::Bar(scene) => plans(scene, marches),
            Self::Plate(scene) => plans(scene, marches),
        }
    }

    /// The largest time step in s that a plan allows on this body over the lattice's.
    pub fn planned_share(&self) -> Result<f64, Wrong> {
        let plan = self.plans(&[(1.0, 1)])?;
        Ok(1.0 / plan[0].time_step_over_limit)
    }

    /// Its fastest mode.
    pub fn fastest(&self, subject: &dyn Subject) -> Result<Mode, String> {
        match self {
            Self::Bar(scene) => subject.fastest_bar(scene).map(Mode::of),
            Self::Plate(scene) => subject.fastest_plate(scene).map(Mode::of),
        }
    }

    /// Marches it, however it grows, and looks at it.
    pub fn march(&self, subject: &dyn Subject, pace: Pace) -> Result<Vec<Look>, Failure> {
        match self {
            Self::Bar(scene) => subject.march_bar(&paced(scene, pace)).map(|record| looks::<1>(&record)),
            Self::Plate(scene) => subject.march_plate(&paced(scene, pace)).map(|record| looks::<2>(&record)),
        }
    }

    /// The same until growth shows that it diverges; `None` where it does not.
    pub fn watched(
        &self,
        subject: &dyn Subject,
        pace: Pace,
    ) -> Result<(Vec<Look>, Option<Box<Diverged>>), Failure> {
        let seen = match self {
            Self::Bar(scene) => subject.march_bar(&until_it_shows(paced(scene, pace))),
            Self::Plate(scene) => subject.march_plate(&until_it_shows(paced(scene, pace))),
        };
        let of = |record: &Record| match self {
            Self::Bar(_) => looks::<1>(record),
            Self::Plate(_) => looks::<2>(record),
        };
        match seen {
            Ok(record) => Ok((of(&record), None)),
            Err(Failure::Diverged(diverged)) => Ok((of(&diverged.record), Some(diverged))),
            Err(wrong) => Err(wrong),
        }
    }

    /// Marches it with all forces booked: whole displacements at a few looks, accounts at all.
    pub fn booked(&self, subject: &dyn Subject, pace: Pace) -> Result<Booked, Failure> {
        match self {
            Self::Bar(scene) => subject.march_bar(&accounted(scene, pace)).map(|record| booked::<1>(&record)),
            Self::Plate(scene) => {
                subject.march_plate(&accounted(scene, pace)).map(|record| booked::<2>(&record))
            }
        }
    }

    /// How many neighbours a node has within its lattice, and the sum of their weights in C₁₁/Δx².
    pub fn weights(&self) -> Result<(usize, f64), String> {
        let lost = |unusable: pd_verify::lattice::Unusable| unusable.to_string();
        let lattice = self.lattice().0;
        match self {
            Self::Bar(_) => Stencil::<1>::new(lattice).map(|s| (2 * s.bonds.len(), s.row_sum())),
            Self::Plate(_) => Stencil::<2>::new(lattice).map(|s| (2 * s.bonds.len(), s.row_sum())),
        }
        .map_err(lost)
    }

    /// cΔt/Δx, c the dilatational speed.
    pub fn courant(&self, time_step: f64) -> f64 {
        match self {
            Self::Bar(scene) => scene.speed() * time_step / scene.spacing,
            Self::Plate(scene) => scene.speed() * time_step / scene.spacing,
        }
    }

    /// Of a cell, in kg.
    pub fn mass(&self) -> f64 {
        match self {
            Self::Bar(scene) => scene.material.density * scene.cell_volume(),
            Self::Plate(scene) => scene.material.density * scene.cell_volume(),
        }
    }

    /// Lattice and spacing in m.
    pub fn lattice(&self) -> (Lattice, f64) {
        match self {
            Self::Bar(scene) => (scene.lattice, scene.spacing),
            Self::Plate(scene) => (scene.lattice, scene.spacing),
        }
    }

    /// Cells along x, and components of a node.
    pub fn columns(&self) -> (usize, usize) {
        match self {
            Self::Bar(scene) => (scene.nodes[0], 1),
            Self::Plate(scene) => (scene.nodes[0], 2),
        }
    }
}

impl Mode {
    fn of<const D: usize>(fastest: Fastest<D>) -> Self {
        Self { omega: fastest.omega, next_omega: fastest.next_omega, shape: fastest.mode.into_flattened() }
    }
}

fn plans<const D: usize>(scene: &Scene<D>, marches: &[(f64, u64)]) -> Result<Vec<Plan>, Wrong> {
    let unusable = |wrong: pd_verify::lattice::Unusable| Wrong::new("", wrong.to_string(), wrong.cure());
    let limit = stable_time_step(scene, &Stencil::<D>::new(scene.lattice).map_err(unusable)?);
    let plan = |&(share, steps): &(f64, u64)| {
        let pace = Pace { seconds: share * limit, steps, every: steps };
        Plan::below(&paced(scene, pace), limit)
    };
    marches.iter().map(plan).collect()
}

fn paced<const D: usize>(scene: &Scene<D>, pace: Pace) -> Scene<D> {
    let step = StepRule::Given { seconds: pace.seconds, beyond_limit: Beyond::UntilItOverflows };
    let watch = Watch::Patch { from: [0.0; D], to: scene.size() };
    Scene {
        time: Time { duration: pace.seconds * pace.steps as f64, step },
        probes: vec![Probe { name: LOOK.into(), watch, every: pace.every }],
        ..scene.clone()
    }
}

/// As users march.
fn until_it_shows<const D: usize>(mut scene: Scene<D>) -> Scene<D> {
    if let StepRule::Given { beyond_limit, .. } = &mut scene.time.step {
        *beyond_limit = Beyond::UntilItShows;
    }
    scene
}

/// What a patch saw, displacements and accelerations apart.
fn looks<const D: usize>(record: &Record) -> Vec<Look> {
    let Some(trace) = record.trace(LOOK) else { return Vec::new() };
    let look = |(time, row): (&f64, &Vec<f64>)| {
        let seen: Vec<f64> =
            row.iter().zip(&trace.columns).filter(|(_, c)| !c.removed).map(|(x, _)| *x).collect();
        let part =
            |from: usize| seen.chunks_exact(2 * D).flat_map(|node| node[from..from + D].to_vec()).collect();
        let step = (time / record.plan.time_step_s).round() as u64;
        Look { step, displacement: part(0), acceleration: part(D) }
    };
    trace.times.iter().zip(&trace.rows).map(look).collect()
}

/// The same march with the accounts of every look, and the whole body at fewer.
fn accounted<const D: usize>(scene: &Scene<D>, pace: Pace) -> Scene<D> {
    let mut scene = paced(scene, Pace { every: SELDOM * pace.every, ..pace });
    let probe = |name: &str, watch| Probe { name: name.into(), watch, every: pace.every };
    scene.probes.extend([probe(ENERGIES, Watch::Energies), probe(MOMENTUM, Watch::Momentum)]);
    scene
}

fn booked<const D: usize>(record: &Record) -> Booked {
    // Energies are booked half a step after a look, momenta half a step before.
    let of = |probe: &str, after: f64, value: fn(&[f64]) -> f64| -> Vec<(u64, f64)> {
        let Some(trace) = record.trace(probe) else { return Vec::new() };
        let step = |time: f64| (time / record.plan.time_step_s - after).round() as u64;
        trace.times.iter().zip(&trace.rows).map(|(&time, row)| (step(time), value(row))).collect()
    };
    Booked {
        looks: looks::<D>(record),
        energies: of(ENERGIES, 0.5, |row| row[0] + row[1]),
        momenta: of(MOMENTUM, -0.5, |row| row.iter().map(|p| p * p).sum::<f64>().sqrt()),
    }
}
