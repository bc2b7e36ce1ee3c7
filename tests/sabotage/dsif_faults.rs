//! The wrong ingredients of stress intensity factors, one each: in what loads the plate, in the lattice, in what is seen of
//! the tip, and in how K is read from it.

use crate::subject::{PdVerify, Subject};
use pd_verify::constraints::Edge;
use pd_verify::material::Body;
use pd_verify::record::{Failure, Record};
use pd_verify::scene::Scene;
use pd_verify::stress_intensity::running::Running;
use pd_verify::stress_intensity::{Elastic, Faces, Reading, Tip, Unreadable};

/// A fault, and the studies in which it is looked for: the others do not have the ingredient.
pub struct Fault {
    pub name: &'static str,
    pub studies: &'static [&'static str],
    pub subject: Box<dyn Subject + Send>,
}

const TIPS: &[&str] = &["dsif-tips"];
const EDGES: &[&str] = &["dsif-edges"];
const WAVES: &[&str] = &["dsif-edges", "dsif-faces", "dsif-plates", "dsif-running"];
const SHORT: &[&str] = &["dsif-faces", "dsif-plates", "dsif-running"];

/// All of them.
pub fn all() -> Vec<Fault> {
    fn march(change: fn(&mut Scene<2>)) -> Box<dyn Subject + Send> {
        Box::new(OtherScene { march: change, rest: |_| () })
    }
    fn rest(change: fn(&mut Scene<2>)) -> Box<dyn Subject + Send> {
        Box::new(OtherScene { march: |_| (), rest: change })
    }
    let fault = |name, studies, subject| Fault { name, studies, subject };
    vec![
        fault("a tip at rest is printed where calibrated was asked for", TIPS, rest(printed)),
        fault(
            "a tip at rest in plane strain has a notch two cells shorter",
            TIPS,
            rest(short_in_plane_strain),
        ),
        fault("a small patch has a notch two cells shorter", TIPS, rest(short_when_small)),
        fault("a tip at rest has a notch two cells shorter", EDGES, rest(shorter)),
        fault("a load acts twice where once was asked for", SHORT, march(twice)),
        fault("the crack is two cells shorter", EDGES, march(shorter)),
        fault("fine grids are a fifth softer", WAVES, march(soft_when_fine)),
        fault("plates on rollers are a fifth softer", EDGES, march(soft_on_rollers)),
        fault("calibration is forgotten", SHORT, march(printed)),
        fault("K is read a twentieth too large", WAVES, Box::new(OtherLook(LARGER))),
        fault("the acceleration is not seen", EDGES, Box::new(OtherLook(NO_ACCELERATION))),
        fault("the stress of the faces is not seen", SHORT, Box::new(OtherLook(NO_FACES))),
        fault("looks come much too early", EDGES, Box::new(Early)),
        fault("a running tip is read as one at rest", &["dsif-running"], Box::new(AtRest)),
        fault("what is printed comes out as printed", EDGES, Box::new(AsPrinted)),
    ]
}

/// Marches another scene than the one asked for, or brings another one to rest.
struct OtherScene {
    march: fn(&mut Scene<2>),
    rest: fn(&mut Scene<2>),
}

impl Subject for OtherScene {
    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        let mut other = scene.clone();
        (self.march)(&mut other);
        PdVerify.march_plate(&other)
    }

    fn rest_plate(&self, scene: &Scene<2>) -> Result<Vec<[f64; 2]>, String> {
        let mut other = scene.clone();
        (self.rest)(&mut other);
        PdVerify.rest_plate(&other)
    }
}

fn printed(scene: &mut Scene<2>) {
    scene.lattice.calibrated = false;
}

fn shorter(scene: &mut Scene<2>) {
    scene.notches.iter_mut().for_each(|notch| notch.to[0] -= 2.0 * scene.spacing);
}

fn short_in_plane_strain(scene: &mut Scene<2>) {
    if scene.body == Body::PlaneStrain {
        shorter(scene);
    }
}

fn short_when_small(scene: &mut Scene<2>) {
    if scene.nodes[0] < 100 {
        shorter(scene);
    }
}

fn twice(scene: &mut Scene<2>) {
    scene.effects.extend(scene.effects.clone());
}

fn soft_when_fine(scene: &mut Scene<2>) {
    if scene.nodes[0] > 300 {
        scene.material.youngs_modulus *= 0.8;
    }
}

fn soft_on_rollers(scene: &mut Scene<2>) {
    if scene.edges.0[0][0] == Edge::MirrorOdd {
        scene.material.youngs_modulus *= 0.8;
    }
}

/// A look at the tip, and what is read from it.
type Read = fn(&Reading, &[[f64; 2]], &[[f64; 2]], Faces) -> [f64; 2];

/// K is read in another way than the one asked for.
struct OtherLook(Read);

impl Subject for OtherLook {
    fn stress_intensity(
        &self,
        reading: &Reading,
        displacement: &[[f64; 2]],
        acceleration: &[[f64; 2]],
        faces: Faces,
    ) -> [f64; 2] {
        (self.0)(reading, displacement, acceleration, faces)
    }
}

const LARGER: Read = |reading, u, a, faces| reading.at_loaded(u, a, faces).map(|k| 1.05 * k);
const NO_ACCELERATION: Read = |reading, u, a, faces| reading.at_loaded(u, &vec![[0.0; 2]; a.len()], faces);
const NO_FACES: Read = |reading, u, a, _| reading.at_loaded(u, a, Faces::default());

/// What is seen at t is said to have been seen at 0.6 t.
struct Early;

impl Subject for Early {
    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        let mut record = PdVerify.march_plate(scene)?;
        record.traces.iter_mut().flat_map(|trace| &mut trace.times).for_each(|t| *t *= 0.6);
        Ok(record)
    }
}

struct AtRest;

impl Subject for AtRest {
    fn running_reading(&self, fit: &Running, tip: &Tip, elastic: &Elastic) -> Result<Reading, Unreadable> {
        PdVerify.running_reading(&Running { speed: 0.0, ..*fit }, tip, elastic)
    }
}

/// The plate has the wave speed of plane strain with a Poisson ratio of 0.3, and one face moves as half the opening.
struct AsPrinted;

/// (c_d of the printed reference over that of the body)²: (1 − ν)/((1 + ν)(1 − 2ν)) at ν = 0.3 over 9/8.
const FASTER: f64 = 0.7 / (1.3 * 0.4) / 1.125;
/// 1 − ν².
const PLANE: f64 = 0.91;
/// What two points find over what is there: the tip factor, and the stress along the crack.
const TWO_POINTS: f64 = 1.075;

impl Subject for AsPrinted {
    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        let mut other = scene.clone();
        if other.edges.0[0][0] == Edge::MirrorOdd {
            other.material.youngs_modulus *= FASTER;
        }
        PdVerify.march_plate(&other)
    }

    fn stress_intensity(
        &self,
        reading: &Reading,
        displacement: &[[f64; 2]],
        acceleration: &[[f64; 2]],
        faces: Faces,
    ) -> [f64; 2] {
        // Two nodes: one face.
        if reading.nodes().len() > 2 {
            // Read with the softer modulus K is FASTER times too small; the printed one has √(E'/c), E' = E/(1 − ν²).
            let k = PdVerify.stress_intensity(reading, displacement, acceleration, faces);
            return k.map(|k| (FASTER / PLANE).sqrt() * k);
        }
        let count = displacement.len() as f64;
        let mean = [0, 1].map(|axis| displacement.iter().map(|u| u[axis]).sum::<f64>() / count);
        let still: Vec<[f64; 2]> = displacement.iter().map(|u| [u[0] - mean[0], u[1] - mean[1]]).collect();
        PdVerify.stress_intensity(reading, &still, acceleration, faces).map(|k| k / TWO_POINTS)
    }
}
