//! Plates with holes, with notches too, and with corrected surfaces: the same suite, a double loop over coordinates, and
//! what a hole must do at mirrors and periods. Faults that are put in must be noticed.

use crate::agrees_with_a_list;
use crate::bodies::{Sums, constant, effect, field, force, model, rough, scene, size};
use crate::checks::{Checked, balance, gradient, purity, rotation, translation, within};
use crate::costs::bytes;
use crate::double_loop::Plain;
use pd_verify::connectivity::Connectivity;
use pd_verify::constraints::Edge::{Free, MirrorEven, MirrorOdd, Periodic};
use pd_verify::constraints::Edges;
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{BodyForce, BondList, Force, Small, family};
use pd_verify::grid::Grid;
use pd_verify::lattice::Stencil;
use pd_verify::model::{Model, surface_factors};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::scene::{Acts, Hole, Notch, Operator, Rotations, Scene, Setting};
use serde_json::json;

/// A plate of 21 by 18 cells.
pub fn plate(m: f64) -> Scene<2> {
    scene::<2>(constant(m, VolumeRule::Linear, false), [21, 18])
}

/// A hole in spacings.
pub fn hole(centre: [f64; 2], radius: f64) -> Hole {
    let dx = plate(2.0).spacing;
    Hole { centre: centre.map(|x| x * dx), radius: radius * dx }
}

fn notch(from: [f64; 2], to: [f64; 2]) -> Notch {
    let dx = plate(2.0).spacing;
    Notch { from: from.map(|x| x * dx), to: to.map(|x| x * dx) }
}

/// A hole; a notch that runs into one of two; one that is cut off by the left edge.
pub fn pierced() -> Vec<Scene<2>> {
    let own = |notches, holes| Scene { notches, holes, ..plate(3.015) };
    vec![
        own(vec![], vec![hole([10.3, 8.6], 3.4)]),
        own(vec![notch([0.0, 9.03], [6.8, 9.03])], vec![hole([9.2, 9.1], 3.0), hole([17.1, 4.0], 1.2)]),
        own(vec![notch([14.1, 18.0], [16.3, 11.2])], vec![hole([0.0, 8.9], 4.2)]),
    ]
}

/// Under both laws, uncorrected and corrected.
fn all() -> impl Iterator<Item = Scene<2>> {
    pierced().into_iter().flat_map(|body| {
        [Rotations::Small, Rotations::Finite].into_iter().flat_map(move |rotations| {
            let body = body.clone();
            [Correction::None, Correction::Energy, Correction::Volume].into_iter().map(move |surface| Scene {
                rotations,
                surface,
                ..body.clone()
            })
        })
    })
}

#[test]
fn holed_plates_conform() {
    let mut worst = 0.0_f64;
    for free in all() {
        let own = model(&free);
        for check in [gradient, balance, translation, purity, agrees_with_a_list, silence, whole_list] {
            worst = worst.max(check(&free, &own).unwrap());
        }
        if free.rotations == Rotations::Finite {
            worst = worst.max(rotation(&free, &own).unwrap());
        }
        let small = free.rotations == Rotations::Small;
        let mirrored = [[MirrorOdd, Free], [Free, MirrorOdd]];
        let even = [[MirrorEven, Free], [Free, MirrorEven]];
        let mixed = [[Periodic; 2], [Free, MirrorOdd]];
        for edges in [mirrored, mixed, [[Periodic; 2]; 2]].into_iter().chain(small.then_some(even)) {
            let other = Scene { edges: Edges(edges), ..free.clone() };
            let own = model(&other);
            for check in [gradient, balance, translation, purity, agrees_with_a_list, silence, whole_list] {
                worst = worst.max(check(&other, &own).unwrap());
            }
            planned(&other, &own);
        }
        planned(&free, &own);
    }
    eprintln!("error over bound: {worst}");
}

/// A plan says what its model keeps, to the byte.
fn planned(scene: &Scene<2>, own: &Model<2>) {
    let plan = Plan::of(scene).unwrap();
    assert_eq!((plan.bytes_per_node * plan.nodes as f64).round() as usize, bytes(own));
    assert!(plan.effects_on.contains(&"hole".into()) && plan.nodes < 21 * 18);
    assert_eq!(plan.band_nodes > 0, scene.surface != Correction::None);
    assert_eq!(plan.operator.contains("as a list"), plan.band_nodes > 0);
}

/// Nothing acts where no node stands, to the last bit.
fn silence(scene: &Scene<2>, own: &Model<2>) -> Checked {
    let u = rough(own, 8, 0.1 * scene.spacing);
    let f = force(own, &u);
    let cells = Grid::<2>::new(own.grid.nodes, own.grid.spacing, own.grid.halo);
    let removed: Vec<_> = cells.each().filter(|node| !own.grid.has(*node)).collect();
    if removed.len() != cells.count() - own.grid.count() || removed.is_empty() {
        return Err("no node is missing: nothing was tried".into());
    }
    let of = |node| [0, 1].map(|axis| f[own.grid.place(node) + axis * own.grid.stride()].abs());
    let largest = removed.into_iter().flat_map(of).fold(0.0, f64::max);
    within("force where no node stands", largest, 0.0)
}

/// One list of all bonds with their factors, in place of a stencil beside a band.
fn whole_list(scene: &Scene<2>, own: &Model<2>) -> Checked {
    match scene.rotations {
        Rotations::Small => agrees(scene, own, |_, _, factor| factor),
        Rotations::Finite => Ok(0.0),
    }
}

/// The same with `change` made to the factor of a bond, known by its owner and its index.
fn agrees(scene: &Scene<2>, own: &Model<2>, change: impl Fn([isize; 2], usize, f64) -> f64) -> Checked {
    let stencil = Stencil::<2>::new(scene.lattice).unwrap();
    let half = family(&stencil, scene.modulus(), scene.spacing);
    let connectivity = Connectivity::of(scene);
    let factors = surface_factors(scene, &half, &own.grid);
    let factor = |owner, bond| change(owner, bond, factors.as_ref().map_or(1.0, |all| all.of(owner, bond)));
    let present = |node, offset| connectivity.present(node, offset);
    let list = BondList::<2, Small>::new(&own.grid, &half, |_| true, &present, factor);
    let u = rough(own, 9, 0.1 * scene.spacing);
    let (f, mut g) = (force(own, &u), own.grid.field());
    for (piece, sum) in g[own.grid.body()].chunks_mut(own.grid.piece()).enumerate() {
        list.add(&crate::bodies::still(&u), piece, sum);
    }
    let (sums, mut worst) = (Sums::of(scene, &own.grid, &u), 0.0_f64);
    for node in own.grid.each() {
        let place = own.grid.place(node);
        let apart =
            [0, 1].map(|axis| f[place + axis * own.grid.stride()] - g[place + axis * own.grid.stride()]);
        worst =
            worst.max(within(&format!("band and list at {node:?}"), size(apart), 1e-13 * sums.pull[place])?);
    }
    Ok(worst)
}

/// Nodes, bonds, weights, factors and forces against a double loop over coordinates.
#[test]
fn holed_plates_are_what_a_double_loop_over_coordinates_gives() {
    let mut worst = 0.0_f64;
    for body in all() {
        for operator in [Operator::Stencil, Operator::Bonds] {
            let scene = Scene { operator, ..body.clone() };
            worst = worst.max(as_by_coordinates(&scene, true).unwrap());
        }
        let plan = Plan::of(&body).unwrap();
        let plain = Plain::of(&body, true);
        assert_eq!((plan.nodes, plan.bonds), (plain.nodes.len() as u64, plain.bonds.len() as u64));
        // Who removes nodes but leaves the bonds across is noticed.
        assert!(Plain::of(&body, false).bonds.len() > plain.bonds.len());
        as_by_coordinates(&body, false).unwrap_err();
    }
    eprintln!("error over bound: {worst}");
}

fn as_by_coordinates(scene: &Scene<2>, across: bool) -> Checked {
    let (own, plain) = (model(scene), Plain::of(scene, across));
    let u = rough(&own, 10, 0.1 * scene.spacing);
    let f = force(&own, &u);
    let at = |field: &[f64], node| [0, 1].map(|axis| field[own.grid.place(node) + axis * own.grid.stride()]);
    let given: Vec<[f64; 2]> = plain.nodes.iter().map(|(node, _)| at(&u, *node)).collect();
    let mut worst = 0.0_f64;
    for ((node, _), (expected, pull)) in plain.nodes.iter().zip(plain.force(scene, &given)) {
        let found = at(&f, *node);
        let apart = [found[0] - expected[0], found[1] - expected[1]];
        worst = worst.max(within(&format!("force at {node:?}"), size(apart), 1e-13 * pull)?);
    }
    Ok(worst)
}

/// By hand. 5 × 5 nodes, each bonded to the eight around it: 2·5·4 + 2·4·4 = 72 bonds. The middle one takes its 8 with
/// it; four diagonals pass it at 0.71 Δx, and nothing else nearer than Δx. Beyond that the four nodes beside it go too:
/// five nodes of 8 bonds, 8 of which join two of them.
#[test]
fn a_plate_of_five_by_five_by_hand() {
    let own = scene::<2>(constant(1.5, VolumeRule::Full, false), [5, 5]);
    let bonds = |radius: f64| {
        let plan = Plan::of(&Scene { holes: vec![hole([2.5, 2.5], radius)], ..own.clone() }).unwrap();
        (plan.nodes, plan.bonds)
    };
    assert_eq!(Plan::of(&own).unwrap().bonds, 72);
    assert_eq!([bonds(0.3), bonds(0.7), bonds(0.72), bonds(1.0)], [(24, 64), (24, 64), (24, 60), (24, 60)]);
    assert_eq!(bonds(1.01), (20, 72 - (5 * 8 - 8)));
}

/// Half a plate held by a plane of symmetry is the right half of the doubled one, holes and all; one hole is cut by it.
#[test]
fn a_mirrored_hole_is_that_of_the_doubled_plate() {
    for (surface, operator) in [(Correction::None, Operator::Stencil), (Correction::Energy, Operator::Bonds)]
    {
        let edges = Edges([[MirrorOdd, Free], [Free, Free]]);
        let holes = vec![hole([1.1, 8.8], 3.3), hole([15.0, 12.0], 2.2)];
        let half = Scene { edges, holes: holes.clone(), surface, operator, ..plate(3.0) };
        let width = half.size()[0];
        let at = |hole: &Hole, x: f64| Hole { centre: [x, hole.centre[1]], ..*hole };
        let both = |hole: &Hole| [at(hole, width + hole.centre[0]), at(hole, width - hole.centre[0])];
        let holes = holes.iter().flat_map(both).collect();
        let doubled = Scene { nodes: [42, 18], holes, surface, operator, ..plate(3.0) };
        let (half, doubled) = (model(&half), model(&doubled));
        assert_eq!(2 * half.grid.count(), doubled.grid.count());
        let u = rough(&half, 5, 0.01 * plate(3.0).spacing);
        let mut fields = doubled.grid.field();
        for node in half.grid.each() {
            let from = half.grid.place(node);
            for (x, sign) in [(21 + node[0], 1.0), (20 - node[0], -1.0)] {
                let to = doubled.grid.place([x, node[1]]);
                fields[to] = sign * u[from];
                fields[to + doubled.grid.stride()] = u[from + half.grid.stride()];
            }
        }
        same(&half, &u, &doubled, &fields, |node| [21 + node[0], node[1]]);
    }
}

/// A plate that repeats itself may be cut into periods anywhere: over a seam a hole is what it is in the middle.
#[test]
fn a_hole_over_a_periodic_seam_is_one_in_the_middle() {
    let edges = Edges([[Periodic; 2]; 2]);
    let with = |x: f64, y: f64| Scene {
        edges,
        holes: vec![hole([x, y], 4.3)],
        surface: Correction::Volume,
        ..plate(3.0)
    };
    let (middle, seam) = (model(&with(10.2, 9.1)), model(&with(20.2, 1.1)));
    let shifted = |node: [isize; 2]| [(node[0] + 10).rem_euclid(21), (node[1] - 8).rem_euclid(18)];
    let u = rough(&middle, 6, 0.01 * plate(3.0).spacing);
    let mut moved = seam.grid.field();
    for node in middle.grid.each() {
        for axis in 0..2 {
            moved[seam.grid.place(shifted(node)) + axis * seam.grid.stride()] =
                u[middle.grid.place(node) + axis * middle.grid.stride()];
        }
    }
    seam.fill_ghosts(&mut moved);
    same(&middle, &u, &seam, &moved, shifted);
}

/// The forces on the nodes of one body and on those of another where they stand: to a few roundings of the largest.
fn same(one: &Model<2>, u: &[f64], other: &Model<2>, v: &[f64], there: impl Fn([isize; 2]) -> [isize; 2]) {
    let (f, g) = (force(one, u), force(other, v));
    let largest = one.grid.each().map(|node| f[one.grid.place(node)].abs()).fold(0.0, f64::max);
    for node in one.grid.each() {
        assert!(other.grid.has(there(node)), "{node:?}");
        for axis in 0..2 {
            let a = f[one.grid.place(node) + axis * one.grid.stride()];
            let b = g[other.grid.place(there(node)) + axis * other.grid.stride()];
            assert!((a - b).abs() <= 1e-13 * largest, "{node:?}: {a:e} {b:e}");
        }
    }
}

#[test]
fn faults_are_noticed() {
    let whole = plate(3.015);
    for surface in [Correction::Energy, Correction::Volume] {
        let scene = Scene { surface, ..pierced().remove(1) };
        let own = model(&scene);
        // The first bond beside the hole without its factor, then one with a millionth too much.
        let beside = [9, 12];
        assert!(own.grid.has(beside) && !own.grid.has([9, 11]));
        let forgotten = |owner, bond, factor| if owner == beside && bond == 0 { 1.0 } else { factor };
        agrees(&scene, &own, forgotten).unwrap_err();
        let more =
            |owner, bond, factor| if owner == beside && bond == 0 { factor * (1.0 + 1e-6) } else { factor };
        agrees(&scene, &own, more).unwrap_err();
        // A load made for the plate without its holes pulls where no node stands.
        let grid = whole.grid(own.grid.halo);
        let push = json!({ "axis": "y", "density_n_m3": 1e6, "history": { "shape": "step" } });
        let setting = Setting { grid: &grid, ..Setting::of(&scene, &own.grid) };
        let Ok(Acts::Force(load)) = effect::<2, BodyForce>(push.clone()).act(&setting) else {
            panic!("a load")
        };
        let mut loaded = model(&scene);
        loaded.add(load);
        assert!(silence(&scene, &loaded).unwrap_err().contains("where no node stands"));
        let sound = model(&Scene { effects: vec![effect::<2, BodyForce>(push)], ..scene.clone() });
        silence(&scene, &sound).unwrap();
        let u = field(&sound, |_| [0.0; 2]);
        let total: f64 = force(&sound, &u)[sound.grid.body()].iter().sum();
        assert_eq!(total, 1e6 * sound.grid.count() as f64);
    }
    assert!(silence(&whole, &model(&whole)).unwrap_err().contains("nothing was tried"));
}
