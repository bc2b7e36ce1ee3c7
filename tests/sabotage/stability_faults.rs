//! The wrong ingredients of stability, one each: in the time step, in the limits, in the body that is marched, in what is
//! seen of it.

use super::dsif_faults::Fault;
use crate::subject::{PdVerify, Subject};
use pd_verify::dispersion::timestep::TimeStep;
use pd_verify::fastest::Fastest;
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{BodyForce, Damping};
use pd_verify::lattice::Stencil;
use pd_verify::record::{Diverged, Failure, Record};
use pd_verify::scene::{Axis, HistoryAsked, Notch, Positive, Rotations, Scene, StepRule};
use std::sync::Arc;

const STEPS: &[&str] = &["stability-time-step", "stability-extremes"];
const GROWTH: &[&str] = &["stability-divergence"];
const SHAPES: &[&str] = &["stability-geometry"];
const JUMPS: &[&str] = &["stability-discontinuities"];
const LONG: &[&str] = &["stability-long-run", "stability-extremes"];
const ENDS: &[&str] = &["stability-extremes"];
const TURNS: &[&str] = &["stability-rotation"];
const UNITS: &[&str] = &["stability-scaling"];

/// All of them.
pub fn all() -> Vec<Fault> {
    let fault = |name, subject| Fault { name, studies: STEPS, subject };
    let growth = |name, subject| Fault { name, studies: GROWTH, subject };
    let ends = |name, subject| Fault { name, studies: ENDS, subject };
    let shapes = |name, subject| Fault { name, studies: SHAPES, subject };
    let jumps = |name, subject| Fault { name, studies: JUMPS, subject };
    let long = |name, subject| Fault { name, studies: LONG, subject };
    let turns = |name, subject| Fault { name, studies: TURNS, subject };
    let units = |name, subject| Fault { name, studies: UNITS, subject };
    vec![
        fault("marched with steps a fiftieth too long", Box::new(OtherStep(1.02)) as Box<dyn Subject + Send>),
        fault("marched with steps a fiftieth too short", Box::new(OtherStep(0.98))),
        fault("the lattice's limit is two per cent too large", Box::new(OtherLimit(1.02))),
        fault("the lattice's limit is half of what it is", Box::new(OtherLimit(0.5))),
        fault("the fastest mode is said to be a tenth faster", Box::new(OtherMode(faster))),
        fault("another mode is said to be the fastest", Box::new(OtherMode(upside_down))),
        fault("surface corrections are forgotten", Box::new(Uncorrected)),
        fault("what diverges is noticed far too late", Box::new(Late)),
        growth("a march that grows is given up far too late", Box::new(Late)),
        growth(
            "the last sound look is that at which the march is given up",
            Box::new(Told(sound_to_the_end)),
        ),
        growth("the limit that is reported is two per cent too large", Box::new(Told(long_limit))),
        growth("neither limit is known well", Box::new(Told(long_limits))),
        growth("what grows a thousandfold is given up", Box::new(Alarmed)),
        growth("loads are forgotten but for a damped fall", Box::new(Unloaded)),
        ends("bonds are a millionth softer", Box::new(Softer)),
        ends("no notch cuts while the smallest bodies move", Box::new(Whole)),
        shapes("nodes on a notch belong to its right", Box::new(Turned)),
        shapes("no notch cuts while the body moves", Box::new(Whole)),
        shapes("shapes are damped", Box::new(Acted(damped, damped))),
        shapes("shapes fall", Box::new(Acted(heavy, heavy))),
        shapes("shapes are marched with steps two fifths too long", Box::new(OtherStep(1.4))),
        jumps("jumps are marched with steps half too long", Box::new(OtherStep(1.5))),
        jumps("jumps are damped", Box::new(Acted(damped, damped))),
        long("damping that nobody asked for", Box::new(Acted(damped, damped))),
        long("a body force that nobody asked for", Box::new(Acted(heavy, heavy))),
        long("marched with steps two fifths too long", Box::new(OtherStep(1.4))),
        turns("all rotations are small", Box::new(Law(Rotations::Small))),
        turns("all rotations are finite", Box::new(Law(Rotations::Finite))),
        turns("fast spins are a tenth faster", Box::new(Spun)),
        turns("a spin is damped", Box::new(Acted(damped, damped))),
        units(
            "bonds of small bodies are a billionth softer",
            Box::new(Acted(soft_when_small, soft_when_small)),
        ),
    ]
}

/// Marches with another step than the one asked for.
struct OtherStep(f64);

impl OtherStep {
    fn changed<const D: usize>(&self, scene: &Scene<D>) -> Scene<D> {
        let mut other = scene.clone();
        if let StepRule::Given { seconds, .. } = &mut other.time.step {
            *seconds *= self.0;
            other.time.duration *= self.0;
        }
        other
    }
}

impl Subject for OtherStep {
    fn march_bar(&self, scene: &Scene<1>) -> Result<Record, Failure> {
        PdVerify.march_bar(&self.changed(scene))
    }

    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        PdVerify.march_plate(&self.changed(scene))
    }
}

struct OtherLimit(f64);

impl Subject for OtherLimit {
    fn bar_time_step(&self, stencil: &Stencil<1>) -> TimeStep {
        let limits = PdVerify.bar_time_step(stencil);
        TimeStep { sharp: self.0 * limits.sharp, ..limits }
    }

    fn plane_time_step(&self, stencil: &Stencil<2>) -> TimeStep {
        let limits = PdVerify.plane_time_step(stencil);
        TimeStep { sharp: self.0 * limits.sharp, ..limits }
    }
}

/// Says something else of the fastest mode: of its frequency and its components.
struct OtherMode(fn(&mut f64, &mut [f64]));

impl OtherMode {
    fn changed<const D: usize>(&self, mut mode: Fastest<D>) -> Fastest<D> {
        (self.0)(&mut mode.omega, mode.mode.as_flattened_mut());
        mode
    }
}

impl Subject for OtherMode {
    fn fastest_bar(&self, scene: &Scene<1>) -> Result<Fastest<1>, String> {
        PdVerify.fastest_bar(scene).map(|mode| self.changed(mode))
    }

    fn fastest_plate(&self, scene: &Scene<2>) -> Result<Fastest<2>, String> {
        PdVerify.fastest_plate(scene).map(|mode| self.changed(mode))
    }
}

fn faster(omega: &mut f64, _: &mut [f64]) {
    *omega *= 1.1;
}

/// The second half of the components with the other sign.
fn upside_down(_: &mut f64, mode: &mut [f64]) {
    let half = mode.len() / 2;
    mode[half..].iter_mut().for_each(|x| *x = -*x);
}

struct Uncorrected;

impl Subject for Uncorrected {
    fn fastest_bar(&self, scene: &Scene<1>) -> Result<Fastest<1>, String> {
        PdVerify.fastest_bar(&Scene { surface: Correction::None, ..scene.clone() })
    }

    fn fastest_plate(&self, scene: &Scene<2>) -> Result<Fastest<2>, String> {
        PdVerify.fastest_plate(&Scene { surface: Correction::None, ..scene.clone() })
    }
}

/// Something acts that nobody asked for.
struct Acted(fn(&mut Scene<1>), fn(&mut Scene<2>));

impl Subject for Acted {
    fn march_bar(&self, scene: &Scene<1>) -> Result<Record, Failure> {
        let mut other = scene.clone();
        (self.0)(&mut other);
        PdVerify.march_bar(&other)
    }

    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        let mut other = scene.clone();
        (self.1)(&mut other);
        PdVerify.march_plate(&other)
    }
}

/// So weakly that a hundred thousand steps of 0.2 µs lose two parts in a million.
fn damped<const D: usize>(scene: &mut Scene<D>) {
    scene.effects.push(Arc::new(Damping { rate_per_s: Positive(1e-4) }));
}

/// A ten-millionth of gravity.
fn heavy<const D: usize>(scene: &mut Scene<D>) {
    let gravity =
        BodyForce { axis: Axis::X, density_n_m3: 2.4e-3, region: None, history: HistoryAsked::step() };
    scene.effects.push(Arc::new(gravity));
}

/// Another law than the one asked for.
pub struct Law(pub Rotations);

impl Subject for Law {
    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        PdVerify.march_plate(&Scene { rotations: self.0, ..scene.clone() })
    }

    fn bond_force_plate(&self, scene: &Scene<2>) -> Result<Vec<[f64; 2]>, String> {
        PdVerify.bond_force_plate(&Scene { rotations: self.0, ..scene.clone() })
    }
}

struct Spun;

impl Subject for Spun {
    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        let mut other = scene.clone();
        let fast = other.velocity.iter().any(|velocity| velocity.amplitude > 5000.0);
        other.velocity.iter_mut().filter(|_| fast).for_each(|velocity| velocity.amplitude *= 1.1);
        PdVerify.march_plate(&other)
    }
}

fn soft_when_small<const D: usize>(scene: &mut Scene<D>) {
    if scene.spacing < 1e-8 {
        scene.material.youngs_modulus *= 1.0 - 1e-9;
    }
}

/// A march is given up only after three times as many steps.
struct Late;

impl Subject for Late {
    fn march_bar(&self, scene: &Scene<1>) -> Result<Record, Failure> {
        PdVerify.march_bar(scene).map_err(later)
    }

    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        PdVerify.march_plate(scene).map_err(later)
    }
}

fn later(failure: Failure) -> Failure {
    match failure {
        Failure::Diverged(diverged) => {
            Failure::Diverged(Box::new(Diverged { step: 3 * diverged.step, ..*diverged }))
        }
        other => other,
    }
}

/// What is said of a march that was given up is changed.
struct Told(fn(&mut Diverged));

impl Told {
    fn changed(&self, failure: Failure) -> Failure {
        match failure {
            Failure::Diverged(mut diverged) => {
                (self.0)(&mut diverged);
                Failure::Diverged(diverged)
            }
            other => other,
        }
    }
}

impl Subject for Told {
    fn march_bar(&self, scene: &Scene<1>) -> Result<Record, Failure> {
        PdVerify.march_bar(scene).map_err(|failure| self.changed(failure))
    }

    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        PdVerify.march_plate(scene).map_err(|failure| self.changed(failure))
    }
}

fn sound_to_the_end(diverged: &mut Diverged) {
    diverged.sound_step = Some(diverged.step);
}

/// A plan that allows twice too much does not mend an own limit that is too large.
fn long_limits(diverged: &mut Diverged) {
    long_limit(diverged);
    diverged.record.plan.time_step_over_limit *= 0.5;
}

fn long_limit(diverged: &mut Diverged) {
    diverged.own_limit = diverged.own_limit.map(|limit| 1.02 * limit);
}

/// Gives up whatever gains energy.
struct Alarmed;

impl Alarmed {
    fn judged(&self, record: Record) -> Result<Record, Failure> {
        let kinetic = record.trace("energies").map(|trace| trace.column(0)).unwrap_or_default();
        let grown = kinetic.get(1).zip(kinetic.last()).is_some_and(|(first, last)| *last > 1e3 * first);
        if !grown {
            return Ok(record);
        }
        let (sound_step, own_limit, sound) = (None, None, None);
        Err(Failure::Diverged(Box::new(Diverged {
            step: 1,
            time: 0.0,
            sound_step,
            own_limit,
            sound,
            record,
        })))
    }
}

impl Subject for Alarmed {
    fn march_bar(&self, scene: &Scene<1>) -> Result<Record, Failure> {
        PdVerify.march_bar(scene).and_then(|record| self.judged(record))
    }

    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        PdVerify.march_plate(scene).and_then(|record| self.judged(record))
    }
}

/// A damped fall in place of any load: its energy grows by little.
struct Unloaded;

impl Unloaded {
    fn changed<const D: usize>(&self, scene: &Scene<D>) -> Scene<D> {
        let mut other = Scene { effects: Vec::new(), ..scene.clone() };
        if !scene.effects.is_empty() {
            heavy(&mut other);
            other.effects.push(Arc::new(Damping { rate_per_s: Positive(1e6) }));
        }
        other
    }
}

impl Subject for Unloaded {
    fn march_bar(&self, scene: &Scene<1>) -> Result<Record, Failure> {
        PdVerify.march_bar(&self.changed(scene))
    }

    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        PdVerify.march_plate(&self.changed(scene))
    }
}

/// Notches are seen from their other end: nodes on them change sides.
struct Turned;

impl Subject for Turned {
    fn bond_force_plate(&self, scene: &Scene<2>) -> Result<Vec<[f64; 2]>, String> {
        let turned = scene.notches.iter().map(|notch| Notch { from: notch.to, to: notch.from });
        PdVerify.bond_force_plate(&Scene { notches: turned.collect(), ..scene.clone() })
    }
}

/// What was cut free is held by the rest of the plate.
struct Whole;

impl Subject for Whole {
    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        PdVerify.march_plate(&Scene { notches: Vec::new(), ..scene.clone() })
    }
}

/// Bonds that pull by a millionth less when they are asked.
struct Softer;

impl Subject for Softer {
    fn bond_force_plate(&self, scene: &Scene<2>) -> Result<Vec<[f64; 2]>, String> {
        let mut other = scene.clone();
        other.material.youngs_modulus *= 1.0 - 1e-6;
        PdVerify.bond_force_plate(&other)
    }
}
