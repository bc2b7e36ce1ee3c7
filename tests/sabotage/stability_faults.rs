//! The wrong ingredients of stability, one each: in the time step, in the limits, in the body that is marched, in what is
//! seen of it.

use super::dsif_faults::Fault;
use crate::subject::{PdVerify, Subject};
use pd_verify::dispersion::Wave;
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::dispersion::timestep::TimeStep;
use pd_verify::fastest::Fastest;
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{BodyForce, Damping};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Stencil;
use pd_verify::material::Body;
use pd_verify::record::{Failure, Record};
use pd_verify::scene::{Axis, HistoryAsked, Positive, Rotations, Scene, StepRule};
use pd_verify::stress_intensity::{Faces, Reading};
use pd_verify_reference::released_bar::ReleasedBar;
use std::sync::Arc;

const STEPS: &[&str] = &["stability-time-step"];
const LONG: &[&str] = &["stability-long-run"];
const TURNS: &[&str] = &["stability-rotation"];
const UNITS: &[&str] = &["stability-scaling"];
const DIGITS: &[&str] = &["stability-arithmetic"];

/// All of them.
pub fn all() -> Vec<Fault> {
    let fault = |name, subject| Fault { name, studies: STEPS, subject };
    let long = |name, subject| Fault { name, studies: LONG, subject };
    let turns = |name, subject| Fault { name, studies: TURNS, subject };
    let units = |name, subject| Fault { name, studies: UNITS, subject };
    let digits = |name, subject| Fault { name, studies: DIGITS, subject };
    vec![
        fault("marched with steps a fiftieth too long", Box::new(OtherStep(1.02)) as Box<dyn Subject + Send>),
        fault("marched with steps a fiftieth too short", Box::new(OtherStep(0.98))),
        fault("the lattice's limit is two per cent too large", Box::new(OtherLimit(1.02))),
        fault("the lattice's limit is half of what it is", Box::new(OtherLimit(0.5))),
        fault("the fastest mode is said to be a tenth faster", Box::new(OtherMode(faster))),
        fault("another mode is said to be the fastest", Box::new(OtherMode(upside_down))),
        fault("surface corrections are forgotten", Box::new(Uncorrected)),
        fault("what diverges is noticed far too late", Box::new(Late)),
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
        digits("long waves by 1 − cos", Box::new(Printed)),
        digits("stretched bonds keep their direction", Box::new(Law(Rotations::Small))),
        digits("c₀ by the printed closed forms", Box::new(Printed)),
        digits("a Fourier series without its last term", Box::new(Shorter)),
        digits("K off in its twelfth digit", Box::new(TwelfthDigit)),
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
struct Law(Rotations);

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
        Failure::Diverged { scene, step, time, over_limit } => {
            Failure::Diverged { scene, step: 3 * step, time: 3.0 * time, over_limit }
        }
        other => other,
    }
}

/// Formulas as they are printed.
struct Printed;

impl Subject for Printed {
    fn bar_wave(&self, relation: &BarDispersion, k_dx: f64) -> Wave {
        let terms = relation.weights().iter().zip(1..);
        let square: f64 = terms.map(|(w, j)| 2.0 * w * (1.0 - libm::cos(f64::from(j) * k_dx))).sum();
        Wave { omega: square.sqrt(), ..PdVerify.bar_wave(relation, k_dx) }
    }

    fn micromodulus(&self, body: Body, kernel: Kernel, e: f64, section: f64, horizon: f64) -> f64 {
        match (body, kernel) {
            (Body::Bar, Kernel::Gaussian { p }) => {
                2.0 * e * p * p / (section * horizon * horizon * (1.0 - libm::exp(-p * p)))
            }
            _ => PdVerify.micromodulus(body, kernel, e, section, horizon),
        }
    }
}

struct Shorter;

impl Subject for Shorter {
    fn released_strain(&self, bar: &ReleasedBar, x: f64, t: f64, terms: usize) -> f64 {
        PdVerify.released_strain(bar, x, t, terms - 1)
    }
}

struct TwelfthDigit;

impl Subject for TwelfthDigit {
    fn stress_intensity(&self, reading: &Reading, u: &[[f64; 2]], a: &[[f64; 2]], faces: Faces) -> [f64; 2] {
        PdVerify.stress_intensity(reading, u, a, faces).map(|k| k * (1.0 + 1e-12))
    }
}
