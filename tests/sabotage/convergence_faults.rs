//! The wrong ingredients of refinements, one each: in the scenes that are marched or brought to rest, in what is seen of
//! them, and in the weights by which waves are summed.

use crate::subject::{PdVerify, Subject};
use pd_verify::constraints::Edge;
use pd_verify::forces::BodyForce;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil, Unusable};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::record::{Failure, Record};
use pd_verify::scene::{Axis, HistoryAsked, Initial, Operator, Scene, Shape, StepRule};
use std::sync::Arc;

/// All of them, by name.
pub fn all() -> Vec<(&'static str, Box<dyn Subject + Send>)> {
    fn scene(bar: fn(&mut Scene<1>), plate: fn(&mut Scene<2>)) -> Box<dyn Subject + Send> {
        Box::new(OtherScene { bar, plate })
    }
    fn weights(change: fn(&mut Lattice), factor: f64) -> Box<dyn Subject + Send> {
        Box::new(OtherWeights { change, factor })
    }
    vec![
        ("calibration is forgotten", scene(printed, printed)),
        ("the modulus is a tenth off", scene(soft, soft)),
        ("the end of the horizon counts otherwise", scene(other_rule, other_rule)),
        ("all kernels are constant", scene(constant, constant)),
        ("steps are a hundred-thousandth too long", scene(longer_steps, longer_steps)),
        ("waves and pulses start half a cell aside", scene(aside, aside)),
        ("the start is bent by a millionth", scene(bent, bent)),
        ("a body force that nobody asked for", scene(heavy, heavy)),
        ("mirrors are of the other parity", scene(other_mirrors, other_mirrors)),
        ("fine grids are a tenth softer", scene(|_| (), soft_when_fine)),
        ("a list of bonds is a hundredth softer", scene(|_| (), soft_list)),
        ("a cubic term in what is given", scene(|_| (), cubic)),
        ("every node shows its neighbour's displacement", Box::new(OneAside)),
        ("x and y are seen exchanged", Box::new(Exchanged)),
        ("waves are summed with weights a hundredth off", weights(|_| {}, 1.01)),
        (
            "waves are summed by area whatever the rule",
            weights(|lattice| lattice.volume_rule = VolumeRule::ExactArea, 1.0),
        ),
    ]
}

/// Marches, or brings to rest, another scene than the one asked for.
pub struct OtherScene {
    pub bar: fn(&mut Scene<1>),
    pub plate: fn(&mut Scene<2>),
}

fn changed<const D: usize>(scene: &Scene<D>, change: fn(&mut Scene<D>)) -> Scene<D> {
    let mut other = scene.clone();
    change(&mut other);
    other
}

impl Subject for OtherScene {
    fn march_bar(&self, scene: &Scene<1>) -> Result<Record, Failure> {
        PdVerify.march_bar(&changed(scene, self.bar))
    }

    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        PdVerify.march_plate(&changed(scene, self.plate))
    }

    fn rest_bar(&self, scene: &Scene<1>) -> Result<Vec<f64>, String> {
        PdVerify.rest_bar(&changed(scene, self.bar))
    }

    fn rest_plate(&self, scene: &Scene<2>) -> Result<Vec<[f64; 2]>, String> {
        PdVerify.rest_plate(&changed(scene, self.plate))
    }

    fn bond_force_plate(&self, scene: &Scene<2>) -> Result<Vec<[f64; 2]>, String> {
        PdVerify.bond_force_plate(&changed(scene, self.plate))
    }
}

pub fn printed<const D: usize>(scene: &mut Scene<D>) {
    scene.lattice.calibrated = false;
}

pub fn soft<const D: usize>(scene: &mut Scene<D>) {
    scene.material.youngs_modulus *= 0.9;
}

fn other_rule<const D: usize>(scene: &mut Scene<D>) {
    scene.lattice.volume_rule = match scene.lattice.volume_rule {
        VolumeRule::Full => VolumeRule::Linear,
        _ => VolumeRule::Full,
    };
}

fn constant<const D: usize>(scene: &mut Scene<D>) {
    scene.lattice.kernel = Kernel::Constant;
}

fn longer_steps<const D: usize>(scene: &mut Scene<D>) {
    if let StepRule::Given { seconds, .. } = &mut scene.time.step {
        *seconds *= 1.0 + 1e-5;
    }
}

/// Wrong by the first order in Δx.
pub fn aside<const D: usize>(scene: &mut Scene<D>) {
    for initial in &mut scene.displacement {
        match &mut initial.shape {
            Shape::Gaussian { centre, .. } => centre[0] += 0.5 * scene.spacing,
            Shape::Wave { wavenumber, phase } => *phase += 0.5 * scene.spacing * wavenumber[0],
            _ => {}
        }
    }
}

/// A millionth of what the body starts from is in every component.
fn bent<const D: usize>(scene: &mut Scene<D>) {
    let more = |initial: &Initial<D>| {
        (0..D)
            .map(|component| Initial { component, amplitude: 1e-6 * initial.amplitude, ..initial.clone() })
            .collect()
    };
    let added: Vec<Vec<Initial<D>>> = scene.displacement.iter().map(more).collect();
    scene.displacement.extend(added.into_iter().flatten());
}

fn heavy<const D: usize>(scene: &mut Scene<D>) {
    let gravity =
        BodyForce { axis: Axis::X, density_n_m3: 7.7e4, region: None, history: HistoryAsked::step() };
    scene.effects.push(Arc::new(gravity));
}

fn other_mirrors<const D: usize>(scene: &mut Scene<D>) {
    for edge in scene.edges.0.as_flattened_mut() {
        if *edge == Edge::MirrorOdd {
            *edge = Edge::MirrorEven;
        }
    }
}

pub fn soft_when_fine<const D: usize>(scene: &mut Scene<D>) {
    if scene.nodes[0] > 100 {
        soft(scene);
    }
}

fn soft_list(scene: &mut Scene<2>) {
    if scene.operator == Operator::Bonds {
        scene.material.youngs_modulus *= 0.99;
    }
}

/// No lattice is without force in it.
fn cubic(scene: &mut Scene<2>) {
    if let Some(Shape::Monomial { about, .. }) =
        scene.displacement.first().map(|initial| initial.shape.clone())
    {
        let shape = Shape::Monomial { about, powers: [3, 0] };
        scene.displacement.push(Initial { component: 0, amplitude: 1e-9, shape });
    }
}

/// Sees each node of a plate where its right neighbour is.
struct OneAside;

impl Subject for OneAside {
    fn rest_plate(&self, scene: &Scene<2>) -> Result<Vec<[f64; 2]>, String> {
        let (seen, columns) = (PdVerify.rest_plate(scene)?, scene.nodes[0]);
        Ok((0..seen.len()).map(|n| seen[if (n + 1) % columns == 0 { n } else { n + 1 }]).collect())
    }
}

/// Sees the components of a plate in the wrong order.
struct Exchanged;

impl Subject for Exchanged {
    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        let mut record = PdVerify.march_plate(scene)?;
        record.snapshots.iter_mut().for_each(|snapshot| snapshot.displacement.swap(0, 1));
        record.traces.iter_mut().flat_map(|trace| &mut trace.rows).for_each(|row| row.swap(0, 1));
        Ok(record)
    }

    fn rest_plate(&self, scene: &Scene<2>) -> Result<Vec<[f64; 2]>, String> {
        Ok(PdVerify.rest_plate(scene)?.into_iter().map(|[x, y]| [y, x]).collect())
    }
}

/// Sums waves over other weights than asked for.
struct OtherWeights {
    change: fn(&mut Lattice),
    factor: f64,
}

impl Subject for OtherWeights {
    fn plane_stencil(&self, mut lattice: Lattice) -> Result<Stencil<2>, Unusable> {
        (self.change)(&mut lattice);
        let mut stencil = Stencil::new(lattice)?;
        stencil.bonds.iter_mut().for_each(|bond| bond.weight *= self.factor);
        Ok(stencil)
    }
}
