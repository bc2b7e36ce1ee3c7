//! What a scene calls for that changes no bit of its march: it could be left out.
//!
//! Effects answer for themselves (`Effect::neutral`, `Initial::neutral`); what is neutral only on a body is asked here: a hole or a
//! notch that takes no node and no bond that others leave, a surface correction that no bond feels, a calibration that leaves
//! the weights alone. What differs by rounding is not neutral: finite rotations of a bar, a notch that sets out after the
//! end (its bonds are served one by one). Probes and snapshots are never reported: they change no bit and are what was asked for.

use crate::connectivity::Connectivity;
use crate::forces::surface::Correction;
use crate::lattice::{Bond, Lattice, Stencil};
use crate::scene::{Hole, Scene};
use serde::Serialize;

/// An effect that is on and does nothing.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Avoidable {
    /// Where it is written, within the case: `effect[0]`.
    pub key: String,
    pub effect: String,
    pub because: String,
}

/// All that could be left out together; `band` is the number of nodes whose weights are corrected, `until` the time in s
/// up to which the march asks for loads and motions.
pub(super) fn of<const D: usize>(
    scene: &Scene<D>,
    stencil: &Stencil<D>,
    band: u64,
    until: f64,
) -> Vec<Avoidable> {
    let said =
        |key: String, effect: String, because: &str| Avoidable { key, effect, because: because.into() };
    let effects = scene.effects.iter().enumerate().filter_map(|(index, effect)| {
        Some(said(format!("effect[{index}]"), effect.name(), effect.neutral(until)?))
    });
    let fields = [("initial displacement", &scene.displacement), ("initial velocity", &scene.velocity)];
    let fields = fields.into_iter().flat_map(|(name, fields)| {
        fields.iter().filter_map(move |field| Some(said("initial".into(), name.into(), field.neutral()?)))
    });
    let mut all: Vec<Avoidable> = effects.chain(fields).collect();
    if scene.surface != Correction::None && band == 0 {
        all.push(said("surface_correction".into(), "surface correction".into(), "it changes no bond"));
    }
    if scene.lattice.calibrated && weights_are_right(scene.lattice, stencil) {
        all.push(said("lattice.calibrated".into(), "lattice calibration".into(), "it changes no weight"));
    }
    all.extend(obstacles(scene, stencil));
    all
}

/// Whether the lattice has the same weights uncalibrated, to the bit.
fn weights_are_right<const D: usize>(lattice: Lattice, stencil: &Stencil<D>) -> bool {
    let plain = Stencil::<D>::new(Lattice { calibrated: false, ..lattice });
    plain.is_ok_and(|plain| plain.bonds == stencil.bonds)
}

/// Holes and notches among which idle ones are looked for: each is held against all others.
const MOST: usize = 32;

/// Holes and notches; of two that do the same the first is kept. Of more than [`MOST`] none is named.
fn obstacles<const D: usize>(scene: &Scene<D>, stencil: &Stencil<D>) -> Vec<Avoidable> {
    if scene.holes.len() + scene.notches.len() > MOST {
        return Vec::new();
    }
    let (rest, mut all) = holes(scene, stencil);
    all.splice(0..0, notches(scene, rest, stencil));
    all
}

/// The scene without the holes that could be left out, and these.
fn holes<const D: usize>(scene: &Scene<D>, stencil: &Stencil<D>) -> (Scene<D>, Vec<Avoidable>) {
    let (mut rest, mut all) = (scene.clone(), Vec::new());
    for index in (0..scene.holes.len()).rev() {
        let with = rest.clone();
        let hole = rest.holes.remove(index);
        if takes_nodes(&rest, &hole) || differ(&with, &rest, hole.bounds(), stencil) {
            rest = with;
        } else {
            all.insert(0, taken_by_others("hole", index, "it takes no node and no bond that others leave"));
        }
    }
    (rest, all)
}

/// The notches of a scene that could be left out; `rest` is the scene without idle holes.
fn notches<const D: usize>(scene: &Scene<D>, mut rest: Scene<D>, stencil: &Stencil<D>) -> Vec<Avoidable> {
    let mut all = Vec::new();
    let grid = rest.grid(0);
    let loaded = scene.effects.iter().filter_map(|effect| effect.on_notch()).max();
    for index in (0..scene.notches.len()).rev() {
        // Notches that effects name by their number stay, and so do those counted before them.
        let runs = scene.running.iter().any(|running| running.notch == index);
        if runs || loaded.is_some_and(|loaded| index <= loaded) {
            continue;
        }
        let with = Connectivity::on(&rest, grid.clone());
        let notch = rest.notches.remove(index);
        let without = Connectivity::on(&rest, grid.clone());
        if parts(&with, &without, &rest, notch.bounds(), stencil) {
            rest.notches.insert(index, notch);
        } else {
            all.insert(0, taken_by_others("notch", index, "it cuts no bond that others leave"));
        }
    }
    all
}

fn taken_by_others(effect: &str, index: usize, because: &str) -> Avoidable {
    Avoidable { key: format!("{effect}[{index}]"), effect: effect.into(), because: because.into() }
}

/// Whether a hole surely takes a node that the scene without it has: said at a glance, for nearly all holes.
fn takes_nodes<const D: usize>(without: &Scene<D>, hole: &Hole) -> bool {
    let (voids, dx) = (without.voids(), without.spacing);
    let place =
        |node: [isize; D]| std::array::from_fn(|axis| node.get(axis).map_or(0.0, |&n| (n as f64 + 0.5) * dx));
    let own = |node| hole.holds(place(node), dx) && !voids.iter().any(|other| other.holds(place(node), dx));
    around(without, hole.bounds(), 0).any(own)
}

/// Whether two scenes that differ by what lies in a box have different nodes or bonds.
fn differ<const D: usize>(
    with: &Scene<D>,
    without: &Scene<D>,
    bounds: [[f64; 2]; 2],
    stencil: &Stencil<D>,
) -> bool {
    let grids = [with.grid(0), without.grid(0)];
    let [one, other] = [with, without].map(Connectivity::of);
    grids[0] != grids[1] || parts(&one, &other, without, bounds, stencil)
}

/// Whether a bond exists without what lies in a box and not with it. An image of it beyond an edge cuts the images of bonds
/// that it cuts itself: those of nodes near the box, seen from either end, are all there are.
fn parts<const D: usize>(
    with: &Connectivity<D>,
    without: &Connectivity<D>,
    scene: &Scene<D>,
    bounds: [[f64; 2]; 2],
    stencil: &Stencil<D>,
) -> bool {
    let both = |bond: &Bond<D>| [bond.offset, bond.offset.map(|n| -n)];
    let offsets: Vec<[i32; D]> = stencil.bonds.iter().flat_map(both).collect();
    let lost = |node, offset| without.present(node, offset) && !with.present(node, offset);
    around(scene, bounds, stencil.reach())
        .any(|node| without.image(node).is_some() && offsets.iter().any(|&offset| lost(node, offset)))
}

/// The cells in a box in m and so many beside it.
fn around<const D: usize>(
    scene: &Scene<D>,
    [low, high]: [[f64; 2]; 2],
    beside: usize,
) -> impl Iterator<Item = [isize; D]> {
    let dx = scene.spacing;
    let cells = |axis: usize| {
        let Some(&count) = scene.nodes.get(axis) else { return 0..1 };
        let from = (low[axis] / dx - 1.0).floor() as isize - beside as isize;
        let to = (high[axis] / dx + 1.0).ceil() as isize + beside as isize;
        from.clamp(0, count as isize)..to.clamp(0, count as isize)
    };
    let (columns, rows) = (cells(0), cells(1));
    rows.flat_map(move |row| {
        columns.clone().map(move |column| std::array::from_fn(|axis| [column, row][axis]))
    })
}
