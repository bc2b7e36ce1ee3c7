//! Plates with notches: the same suite, and what a cut must do: part two halves, follow its mirror image, lose the
//! bonds that a count by hand loses.

use crate::agrees_with_a_list;
use crate::bodies::{constant, field, force, model, places, rough, scene};
use crate::checks::{balance, gradient, purity, translation};
use crate::costs::bytes;
use pd_verify::constraints::Edge::{Free, MirrorOdd, Periodic};
use pd_verify::constraints::Edges;
use pd_verify::forces::surface::Correction;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::scene::{Notch, Rotations, Scene};

fn plate(m: f64) -> Scene<2> {
    scene::<2>(constant(m, VolumeRule::Linear, false), [21, 18])
}

/// A notch in spacings.
fn notch(from: [f64; 2], to: [f64; 2]) -> Notch {
    let dx = plate(2.0).spacing;
    Notch { from: from.map(|x| x * dx), to: to.map(|x| x * dx) }
}

/// Between rows, through a row of nodes, slanted, two that meet.
fn notches() -> Vec<Vec<Notch>> {
    vec![
        vec![notch([0.0, 9.0], [10.0, 9.0])],
        vec![notch([0.0, 8.5], [10.5, 8.5])],
        vec![notch([4.3, 3.1], [15.2, 12.9])],
        vec![notch([0.0, 6.0], [9.0, 6.0]), notch([9.0, 6.0], [13.7, 11.2])],
    ]
}

#[test]
fn notched_plates_conform() {
    let mut worst = 0.0_f64;
    for notches in notches() {
        for rotations in [Rotations::Small, Rotations::Finite] {
            for surface in [Correction::None, Correction::Energy, Correction::Volume] {
                let free = Scene { notches: notches.clone(), rotations, surface, ..plate(3.015) };
                let own = model(&free);
                for check in [gradient, balance, translation, purity, agrees_with_a_list] {
                    worst = worst.max(check(&free, &own).unwrap());
                }
                for edges in [[[MirrorOdd, Free], [Free, Free]], [[Periodic; 2], [Free, MirrorOdd]]] {
                    let other = Scene { edges: Edges(edges), ..free.clone() };
                    for check in [gradient, purity, agrees_with_a_list] {
                        worst = worst.max(check(&other, &model(&other)).unwrap());
                    }
                }
            }
            let cut = Scene { notches: notches.clone(), rotations, ..plate(3.015) };
            let plan = Plan::of(&cut).unwrap();
            assert_eq!((plan.bytes_per_node * plan.nodes as f64).round() as usize, bytes(&model(&cut)));
            assert!(
                plan.bonds < Plan::of(&plate(3.015)).unwrap().bonds
                    && plan.effects_on.contains(&"notch".into())
            );
        }
    }
    eprintln!("error over bound: {worst}");
}

#[test]
fn a_plate_cut_through_is_two() {
    for rotations in [Rotations::Small, Rotations::Finite] {
        let cut = Scene { notches: vec![notch([0.0, 9.0], [21.0, 9.0])], rotations, ..plate(3.0) };
        let own = model(&cut);
        let dx = cut.spacing;
        let parted = field(&own, |x| if x[1] > 9.0 * dx { [0.3 * dx, 0.2 * dx] } else { [0.0; 2] });
        assert!(places(&own.grid).iter().all(|&at| force(&own, &parted)[at] == 0.0));
        let shorter = Scene { notches: vec![notch([0.0, 9.0], [20.0, 9.0])], ..cut.clone() };
        let whole = model(&shorter);
        assert!(places(&whole.grid).iter().any(|&at| force(&whole, &parted)[at] != 0.0));
        // Row by row: a bond (i, j), j > 0, from any of the j rows below the cut crosses it, 21 − |i| of them a row.
        let uncut = Plan::of(&plate(3.0)).unwrap().bonds;
        let family = pd_verify::family::half_family::<2>(3.0, VolumeRule::Linear);
        let lost: i64 =
            family.iter().map(|n| i64::from(n.offset[1]) * (21 - i64::from(n.offset[0].abs()))).sum();
        assert_eq!(uncut as i64 - Plan::of(&cut).unwrap().bonds as i64, lost);
    }
}

/// A plate held by its plane of symmetry is the right half of a doubled one, notch and all.
#[test]
fn a_mirrored_notch_is_that_of_the_doubled_plate() {
    let edges = Edges([[MirrorOdd, Free], [Free, Free]]);
    let slanted = notch([0.0, 9.0], [8.4, 4.2]);
    let half = Scene { edges, notches: vec![slanted], ..plate(3.0) };
    let width = half.size()[0];
    let right = Notch {
        from: [slanted.from[0] + width, slanted.from[1]],
        to: [slanted.to[0] + width, slanted.to[1]],
    };
    let left = Notch {
        from: [width - slanted.to[0], slanted.to[1]],
        to: [width - slanted.from[0], slanted.from[1]],
    };
    let doubled = Scene { nodes: [42, 18], notches: vec![right, left], ..plate(3.0) };
    let (half, doubled) = (model(&half), model(&doubled));
    let u = rough(&half, 5, 0.01 * plate(3.0).spacing);
    let mut both = doubled.grid.field();
    for node in half.grid.each() {
        let from = half.grid.place(node);
        for (x, sign) in [(21 + node[0], 1.0), (20 - node[0], -1.0)] {
            let to = doubled.grid.place([x, node[1]]);
            both[to] = sign * u[from];
            both[to + doubled.grid.stride()] = u[from + half.grid.stride()];
        }
    }
    let (one, two) = (force(&half, &u), force(&doubled, &both));
    let largest = one.iter().map(|f| f.abs()).fold(0.0, f64::max);
    for node in half.grid.each() {
        for axis in 0..2 {
            let a = one[half.grid.place(node) + axis * half.grid.stride()];
            let b = two[doubled.grid.place([21 + node[0], node[1]]) + axis * doubled.grid.stride()];
            assert!((a - b).abs() <= 1e-13 * largest, "{node:?}: {a:e} {b:e}");
        }
    }
}
