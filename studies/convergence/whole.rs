//! The whole body at the end of a march: how studies look at it, and its nodes in the order in which it is seen.

use crate::dispersion::curve::reference_lattice;
use pd_verify::record::Record;
use pd_verify::scene::Scene;
use pd_verify_reference::medium::Medium;

/// Name of the snapshot.
pub const SEEN: &str = "end";

/// All nodes, row by row along x.
pub fn nodes<const D: usize>(scene: &Scene<D>) -> impl Iterator<Item = [usize; D]> + use<D> {
    let counts = scene.nodes;
    (0..counts.iter().product()).map(move |n: usize| {
        std::array::from_fn(|axis| if axis == 0 { n % counts[0] } else { n / counts[0] })
    })
}

/// Displacements of the last snapshot in m, a field for each component.
pub fn last(record: &Record) -> Result<&[Vec<f64>], String> {
    match record.snapshots.last() {
        Some(snapshot) if snapshot.step == record.plan.steps => Ok(&snapshot.displacement),
        _ => Err("the body was not seen at the end".into()),
    }
}

/// The lattice of a scene as a medium.
pub fn lattice<const D: usize>(scene: &Scene<D>) -> Medium {
    Medium::Lattice { lattice: reference_lattice(scene.lattice), spacing: scene.spacing }
}
