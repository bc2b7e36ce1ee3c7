//! What a plan says a scene costs, held against the model that is made of it and against counting.

use crate::bodies::{cases, constant, each_bond, effect, model, scene};
use crate::wrong::{Way, spoilt};
use pd_verify::constraints::Edge::{self, Free, MirrorEven, MirrorOdd, Periodic};
use pd_verify::constraints::Edges;
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{BodyForce, Damping, Traction};
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::scene::{Operator, Scene};
use serde_json::json;

/// State and force, and what the terms of a model say they keep.
pub fn bytes<const D: usize>(model: &Model<D>) -> usize {
    let terms: usize = model.forces().iter().map(|force| force.bytes()).sum();
    terms + 3 * 8 * model.grid.field().len()
}

/// Whether the plan's bytes are the model's and its bonds those that one can count.
fn costs<const D: usize>(scene: &Scene<D>, model: &Model<D>) -> Result<(), String> {
    let plan = Plan::of(scene).map_err(|wrong| wrong.message)?;
    let planned = (plan.bytes_per_node * plan.nodes as f64).round() as usize;
    if planned != bytes(model) {
        return Err(format!("{}: planned {planned} bytes, kept {}", scene.name, bytes(model)));
    }
    let mut ends = 0;
    each_bond(scene, &model.grid, |_, _, _| ends += 1);
    // A bond ends twice in the body, or once there and once in an image of it.
    if plan.bonds != ends / 2 || plan.bond_updates != plan.bonds * plan.steps {
        return Err(format!("{}: planned {} bonds, counted {} ends", scene.name, plan.bonds, ends));
    }
    Ok(())
}

#[test]
fn a_plan_knows_bytes_and_bonds() {
    for scene in cases::<1>(&[1.0, 3.015, 5.0], [13]) {
        costs(&scene, &model(&scene)).unwrap();
    }
    for scene in cases::<2>(&[2.0, 3.015], [9, 7]) {
        costs(&scene, &model(&scene)).unwrap();
    }
    let step = json!({ "shape": "step" });
    let pull = json!({ "edge": "top", "axis": "y", "stress_pa": 1e6, "history": step });
    let corner = json!({ "from_m": [0.0, 0.0], "to_m": [0.01, 0.02] });
    let push = json!({ "axis": "x", "density_n_m3": 1e6, "region": corner, "history": step });
    let effects = vec![effect::<2, Traction>(pull), effect::<2, BodyForce>(push)];
    let plate = scene::<2>(constant(3.0, VolumeRule::Linear, false), [150, 130]);
    for operator in [Operator::Stencil, Operator::Bonds] {
        let loaded = Scene { operator, effects: effects.clone(), ..plate.clone() };
        costs(&loaded, &model(&loaded)).unwrap();
    }
    costs(&plate, &spoilt(&plate, Way::Heavy)).unwrap_err();
    let other = Scene { edges: Edges([[Periodic; 2], [Free; 2]]), ..plate.clone() };
    costs(&other, &model(&plate)).unwrap_err();
}

/// Around the length of a piece of work: the last piece may hold few nodes with all their bonds, or none.
#[test]
fn a_plan_knows_the_bytes_of_bars_of_one_piece_and_a_bit() {
    for edges in [[Free, Free], [MirrorOdd, Free], [Free, MirrorEven], [Periodic, Periodic]] {
        for nodes in [8180, 8183, 8185, 8186, 8187, 8189, 8192, 8195, 8200] {
            let name = format!("{nodes} nodes, edges {edges:?}");
            let bar = scene::<1>(constant(3.0, VolumeRule::Full, false), [nodes]);
            let bar = Scene { name, edges: Edges([edges]), ..bar };
            costs(&bar, &model(&bar)).unwrap();
        }
    }
}

/// A corrected body keeps its band as a list, whose bonds the plan counts.
#[test]
fn a_plan_knows_what_a_corrected_body_keeps() {
    for surface in [Correction::Energy, Correction::Volume] {
        let plate = scene::<2>(constant(3.0, VolumeRule::Linear, false), [40, 30]);
        let plate = Scene { surface, ..plate };
        for operator in [Operator::Stencil, Operator::Bonds] {
            let plate = Scene { operator, ..plate.clone() };
            costs(&plate, &model(&plate)).unwrap();
            let bar = scene::<1>(constant(3.0, VolumeRule::Linear, false), [8190]);
            let bar = Scene { operator, surface, ..bar };
            costs(&bar, &model(&bar)).unwrap();
        }
    }
}

/// By hand. A bar of 10 nodes, m = 2, free: 9 + 8 bonds; 3 fields of 32 numbers (two lines of nodes, one on each side); a run
/// of nodes with all their bonds, one at each end of nodes without, whose words fill a line each. A plate of 6 × 5, m = √2, free: 5·5 + 6·4 along the axes, 2·5·4 across; rows of
/// four lines.
#[test]
fn costs_of_a_bar_and_a_plate_by_hand() {
    let bar = scene::<1>(constant(2.0, VolumeRule::Full, false), [10]);
    let plan = Plan::of(&bar).unwrap();
    assert_eq!((plan.nodes, plan.bonds), (10, 17));
    // A run is a place, a length and where its words begin.
    assert_eq!(plan.bytes_per_node, (3 * 32 * 8 + 3 * 24 + 2 * 8 * 8) as f64 / 10.0);
    let plate = scene::<2>(constant(1.5, VolumeRule::Full, false), [6, 5]);
    let plan = Plan::of(&plate).unwrap();
    assert_eq!((plan.nodes, plan.bonds), (30, 25 + 24 + 40));
    // Three rows with a run of whole nodes and one at each side, two rows of nodes that lack bonds.
    let fields = 3 * 8 * (2 * 32 * 7);
    let (runs, lines) = (3 * 3 + 2, 3 * 2 + 2);
    assert_eq!((plan.bytes_per_node * 30.0).round() as usize, fields + runs * 24 + lines * 64);
    let mirrored = Scene { edges: Edges([[Edge::MirrorOdd; 2]]), ..bar };
    assert_eq!(Plan::of(&mirrored).unwrap().bonds, 20);
}

/// By hand. The same plate: 12 nodes with 8 bonds each, 18 that share the other 178 − 96 ends; 30 operations for a node
/// with all bonds, 11 for an end of one that lacks some, 6 to move it, 4 to damp it, 1 for each place that is loaded.
#[test]
fn what_a_step_does_by_hand() {
    let plate = scene::<2>(constant(1.5, VolumeRule::Full, false), [6, 5]);
    let work = |scene: &Scene<2>| Plan::of(scene).unwrap().work;
    let free = work(&plate);
    assert_eq!((free.kinds.whole_nodes, free.kinds.masked_nodes, free.kinds.masked_ends), (12, 18, 82));
    assert_eq!((free.pairs, free.kinds.listed_nodes, free.kinds.breaking_nodes), (4, 0, 0));
    assert_eq!(free.flops_per_step, (12 * 30 + 82 * 11 + 30 * 6) as f64);
    // 32 bytes for each component, 24 for each of 3 runs of whole nodes and 8 of others, a line of words for each of these.
    assert_eq!(free.bytes_per_step(1), (30 * 64 + 11 * 24 + 8 * 64) as f64);
    assert_eq!(free.bytes_per_step(4), (30 * 16 + 11 * 24 + 8 * 64) as f64);
    let listed = work(&Scene { operator: Operator::Bonds, ..plate.clone() });
    assert_eq!((listed.kinds.listed_nodes, listed.kinds.listed_ends), (30, 178));
    assert_eq!(listed.flops_per_step, (178 * 11 + 30 * 6) as f64);
    let step = json!({ "shape": "step" });
    let pull = json!({ "edge": "top", "axis": "y", "stress_pa": 1e6, "history": step });
    let effects = vec![effect::<2, Traction>(pull), effect::<2, Damping>(json!({ "rate_per_s": 1.0 }))];
    let loaded = work(&Scene { effects, ..plate });
    assert_eq!((loaded.loaded_places, loaded.damped_nodes), (6, 30));
    assert_eq!(loaded.flops_per_step, free.flops_per_step + 6.0 + 30.0 * 8.0);
}
