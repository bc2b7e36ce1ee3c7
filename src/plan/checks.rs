//! What is refused before anything is computed: bodies, edges, holes and probes that cannot be.

use super::counts::Counts;
use crate::constraints::Edge;
use crate::forces::surface::Correction;
use crate::grid::Grid;
use crate::lattice::{Stencil, Unusable};
use crate::record::{Patch, corners, line};
use crate::scene::{Hole, Rotations, Scene, Watch, Wrong};

/// A block larger than this is a slip of the pen.
const MAX_NODES: usize = 1 << 28;

/// What is cut, corrected or loaded is planned node by node: more would take seconds, and any march of it days.
const MAX_CUT_NODES: usize = 1 << 26;

/// Its pairs of bonds near what cuts it.
const MAX_CUT_PAIRS: f64 = 1e9;

/// Visits of nodes by which holes and effects are laid out; a hole is looked at alone and among the others, an effect keeps
/// what it finds, and counts as several.
const MAX_PLANNED: f64 = (1_u64 << 31) as f64;
const HOLE: usize = 2;
const EFFECT: usize = 4;

/// What one run may hold of patches: more is a slip of the pen.
const MAX_PATCH_BYTES: u64 = 4 << 30;

/// A share of a probe's place that is rounding.
const NO_SHARE: f64 = 1e-9;

/// The lattice of a body that can be.
pub fn body<const D: usize>(scene: &Scene<D>) -> Result<Stencil<D>, Wrong> {
    nodes(scene)?;
    let horizon = scene.lattice.m * scene.spacing;
    let smallest = scene.size().into_iter().fold(f64::INFINITY, f64::min);
    if horizon > smallest * (1.0 + 1e-12) {
        let message = format!("the horizon of {horizon} m is larger than the body of {smallest} m");
        return Err(Wrong::new("lattice.m", message, "take a smaller m or spacing, or a larger body"));
    }
    let unusable = |wrong: Unusable| Wrong::new("lattice.m", wrong.to_string(), wrong.cure());
    let stencil = Stencil::<D>::new(scene.lattice).map_err(unusable)?;
    bonds(scene, &stencil)?;
    for (axis, [below, above]) in scene.edges.0.into_iter().enumerate() {
        let key = ["edges.left", "edges.bottom"][axis];
        if (below == Edge::Periodic) != (above == Edge::Periodic) {
            let message = "a periodic edge needs a periodic edge on the other side";
            return Err(Wrong::new(key, message, "make both edges of the axis periodic"));
        }
        let ghosts = below != Edge::Free || above != Edge::Free;
        if ghosts && stencil.reach() > scene.nodes[axis] {
            let message =
                format!("the family reaches {} nodes, the body has {}", stencil.reach(), scene.nodes[axis]);
            return Err(Wrong::new(key, message, "take a smaller horizon, a larger body, or free edges"));
        }
        let even = below == Edge::MirrorEven || above == Edge::MirrorEven;
        if D == 2 && even && scene.rotations == Rotations::Finite {
            let message = "mirror_even is no symmetry of a plate with finite rotations";
            return Err(Wrong::new(key, message, "take rotations = \"small\", or mirror_odd"));
        }
    }
    Ok(stencil)
}

/// Refuses a body of more nodes than any is given, before anything is made of that size.
fn nodes<const D: usize>(scene: &Scene<D>) -> Result<(), Wrong> {
    let (holes, effects) = (scene.holes.len(), scene.effects.len());
    let plain = scene.notches.is_empty() && holes + effects == 0 && scene.surface == Correction::None;
    let (most, which) =
        if plain { (MAX_NODES, "a block") } else { (MAX_CUT_NODES, "a block that is cut or loaded") };
    let count = scene.nodes.iter().map(|&n| n as f64).product::<f64>();
    if count > most as f64 {
        let state = (3 * D * size_of::<f64>()) as f64 * count;
        let message = format!(
            "{:?} nodes do not fit {which} of {most}: their state alone takes {:.0} GB",
            scene.nodes,
            state / 1e9
        );
        return Err(Wrong::new("dx_m", message, "take a larger spacing or a smaller body"));
    }
    if count * (HOLE * holes + EFFECT * effects) as f64 > MAX_PLANNED {
        let message = format!("{holes} holes and {effects} effects are too many to lay out on {count} nodes");
        return Err(Wrong::new("dx_m", message, "take fewer of them, or a larger spacing"));
    }
    Ok(())
}

/// Refuses a cut body of so many bonds near its cuts and edges that laying them out, one by one, would take minutes.
fn bonds<const D: usize>(scene: &Scene<D>, stencil: &Stencil<D>) -> Result<(), Wrong> {
    let corrected = scene.surface != Correction::None;
    if scene.notches.is_empty() && scene.holes.is_empty() && !corrected {
        return Ok(());
    }
    // Weights are corrected up to two families from an edge, by sums over the families of both ends.
    let (reach, visits) = if corrected { (2 * stencil.reach(), 4.0) } else { (stencil.reach(), 1.0) };
    let nodes = |kept: usize| scene.nodes.iter().map(|&n| n.saturating_sub(kept) as f64).product::<f64>();
    let along = scene.nodes.iter().copied().max().unwrap_or(0) as f64;
    let around = |hole: &Hole| (2.0 * (hole.radius / scene.spacing + reach as f64)).min(along).powi(2);
    let near = nodes(0) - nodes(2 * reach)
        + scene.notches.len() as f64 * along * (2 * reach) as f64
        + scene.holes.iter().map(around).sum::<f64>();
    let pairs = near.min(nodes(0)) * stencil.bonds.len() as f64 * visits;
    if pairs <= MAX_CUT_PAIRS {
        return Ok(());
    }
    let message = format!(
        "{pairs:.1e} bonds near edges, notches and holes would be looked at one by one, at most {MAX_CUT_PAIRS:.0e} are"
    );
    Err(Wrong::new("lattice.m", message, "take a smaller m, or a larger spacing"))
}

/// Whether every probe stands where there is something to be seen.
pub fn probes<const D: usize>(scene: &Scene<D>, grid: &Grid<D>) -> Result<(), Wrong> {
    let size = scene.size();
    for (index, probe) in scene.probes.iter().enumerate() {
        let path = format!("probe[{index}]");
        let outside = |axis: usize, at: f64| !(0.0..=size[axis]).contains(&at);
        let refuse = |key: &str, at: f64, axis: usize| {
            let message = format!(
                "the probe \"{}\" stands outside the body: {at} m, and the body reaches from 0 to {} m",
                probe.name, size[axis]
            );
            Err(Wrong::new(format!("{path}.{key}"), message, "move it into the body"))
        };
        match probe.watch {
            Watch::Point { at } => {
                if let Some(axis) = (0..D).find(|&axis| outside(axis, at[axis])) {
                    return refuse("at_m", at[axis], axis);
                }
                in_the_body(scene, grid, &probe.name, at).map_err(|wrong| wrong.inside(&path))?;
            }
            Watch::Strain { at } if outside(0, at) => return refuse("at_m", at, 0),
            Watch::Line { along, through } if D == 2 && outside(1 - along, through) => {
                return refuse("through_m", through, 1 - along);
            }
            Watch::Line { along, through } if line(grid, along, through).all(|node| !grid.has(node)) => {
                let message = format!("the probe \"{}\" runs through a hole from end to end", probe.name);
                return Err(Wrong::new(format!("{path}.through_m"), message, "move it beside the hole"));
            }
            Watch::Patch { from, to } => {
                for (key, corner) in [("from_m", from), ("to_m", to)] {
                    if let Some(axis) = (0..D).find(|&axis| outside(axis, corner[axis])) {
                        return refuse(key, corner[axis], axis);
                    }
                }
                if Patch::of(grid, from, to).each().all(|node| !grid.has(node)) {
                    let message = format!(
                        "the patch \"{}\" from {} to {} holds no node",
                        probe.name,
                        place(from),
                        place(to)
                    );
                    let help =
                        "widen it to hold the centre of a cell, from the lower corner to the upper one";
                    return Err(Wrong::new(format!("{path}.to_m"), message, help));
                }
            }
            _ => {}
        }
        if matches!(probe.watch, Watch::Strain { .. }) && (D != 1 || scene.nodes[0] < 2) {
            let message = "a strain probe needs a bar of two nodes or more";
            return Err(Wrong::new(path, message, "watch displacements of points instead"));
        }
        if scene.probes[..index].iter().any(|other| other.name == probe.name) {
            let message = format!("two probes are called \"{}\"", probe.name);
            return Err(Wrong::new(format!("{path}.name"), message, "give each probe its own name"));
        }
        if probe.every == 0 {
            let message = "a probe cannot look every 0 steps";
            return Err(Wrong::new(format!("{path}.every_steps"), message, "take 1 or more"));
        }
    }
    Ok(())
}

/// Bytes that patches will hold of their looks in a march of so many steps.
pub fn patches<const D: usize>(scene: &Scene<D>, grid: &Grid<D>, steps: u64) -> Result<u64, Wrong> {
    let mut total = 0_u64;
    for (index, probe) in scene.probes.iter().enumerate() {
        let Watch::Patch { from, to } = probe.watch else { continue };
        let look = (2 * D * size_of::<f64>()) as u64 * Patch::of(grid, from, to).count() as u64;
        let looks = steps.div_ceil(probe.every) + 1;
        total = total.saturating_add(look.saturating_mul(looks));
        if total > MAX_PATCH_BYTES {
            let message = format!(
                "the patches would hold {:.1} GiB, at most {} GiB are held",
                total as f64 / (1_u64 << 30) as f64,
                MAX_PATCH_BYTES >> 30
            );
            let help = "look less often (every_steps), or at a smaller patch";
            return Err(Wrong::new(format!("probe[{index}].every_steps"), message, help));
        }
    }
    Ok(total)
}

/// Whether the nodes between which a point is seen are there.
fn in_the_body<const D: usize>(
    scene: &Scene<D>,
    grid: &Grid<D>,
    probe: &str,
    at: [f64; D],
) -> Result<(), Wrong> {
    let removed = |(node, share): &([isize; D], f64)| {
        share.abs() > NO_SHARE && scene.edges.image(grid, *node).is_none()
    };
    let missing = corners(grid, &scene.edges, at).filter(removed).count();
    if !grid.pierced() || missing == 0 {
        return Ok(());
    }
    let away = |node: &[isize; D]| -> f64 {
        let place = grid.position(*node);
        (0..D).map(|axis| (place[axis] - at[axis]).powi(2)).sum()
    };
    let nearest = grid.each().min_by(|a, b| away(a).total_cmp(&away(b)));
    let help = match nearest {
        Some(node) => format!("the nearest node that is left stands at {}", place(grid.position(node))),
        None => "leave the hole out".into(),
    };
    let message = format!("the probe \"{probe}\" at {} sees nodes that a hole has removed", place(at));
    Err(Wrong::new("at_m", message, help))
}

/// A place in words, to nine digits.
fn place<const D: usize>(at: [f64; D]) -> String {
    let digits = |x: &f64| format!("{}", format!("{x:.8e}").parse::<f64>().unwrap_or(*x));
    format!("[{}] m", at.iter().map(digits).collect::<Vec<_>>().join(", "))
}

/// Whether each hole takes nodes from the body, and its images follow the edges.
pub fn holes<const D: usize>(scene: &Scene<D>) -> Result<(), Wrong> {
    if D == 1 && !scene.holes.is_empty() {
        return Err(Wrong::new("hole", "a bar has no holes", "leave them out, or take a plate"));
    }
    let size = scene.size();
    for (index, hole) in scene.holes.iter().enumerate() {
        let refuse = |key: &str, message: String, help: String| {
            Err(Wrong::new(format!("hole[{index}].{key}"), message, help))
        };
        let Hole { centre, radius } = *hole;
        if !(radius > 0.0 && radius.is_finite() && centre.iter().all(|x| x.is_finite())) {
            let message = format!("a radius of {radius} m about {} is no hole", place(centre));
            return refuse("radius_m", message, "give finite numbers and a radius above 0".into());
        }
        for (axis, edges) in scene.edges.0.into_iter().enumerate() {
            let beyond = [(edges[0], centre[axis] < 0.0), (edges[1], centre[axis] > size[axis])];
            if let Some((edge, _)) = beyond.into_iter().find(|(edge, out)| *out && *edge != Edge::Free) {
                let message = format!(
                    "the centre of the hole lies beyond an edge that is {}, where the plate has an image already",
                    edge.described()
                );
                return refuse("centre_m", message, "move the centre onto the edge or into the plate".into());
            }
        }
        let alone = Scene { holes: vec![*hole], ..scene.clone() };
        if !alone.grid(0).pierced() {
            let message = format!(
                "the hole removes no node: its radius of {radius} m does not reach the centre of a cell of {} m",
                scene.spacing
            );
            let help = "take a larger radius_m or a smaller dx_m, move centre_m onto a node, or cut bonds by a notch";
            return refuse("radius_m", message, help.into());
        }
    }
    Ok(())
}

/// Whether holes leave a node.
pub fn left<const D: usize>(scene: &Scene<D>, grid: &Grid<D>) -> Result<(), Wrong> {
    if grid.count() == 0 { Err(swallowed(scene, "no node is left")) } else { Ok(()) }
}

/// Whether holes leave a bond.
pub fn bonded<const D: usize>(scene: &Scene<D>, counts: &Counts) -> Result<(), Wrong> {
    let dust = counts.ends == 0 && !scene.holes.is_empty();
    if dust { Err(swallowed(scene, "no two nodes that are left have a bond")) } else { Ok(()) }
}

/// Names the largest hole.
fn swallowed<const D: usize>(scene: &Scene<D>, left: &str) -> Wrong {
    let all = scene.holes.iter().enumerate();
    let largest = all.max_by(|(_, a), (_, b)| a.radius.total_cmp(&b.radius)).map_or(0, |(index, _)| index);
    let message = format!("the hole swallows the plate: {left}");
    Wrong::new(format!("hole[{largest}].radius_m"), message, "take a smaller radius, or a larger plate")
}
