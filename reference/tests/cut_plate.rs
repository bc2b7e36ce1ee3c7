//! Cut plates, held against counts by hand: what is joined, what is lost, what holds together.

use pd_verify_reference::cut_plate::CutPlate;
use pd_verify_reference::{Kernel, Lattice, VolumeRule};

/// Eight neighbours.
const EIGHT: Lattice =
    Lattice { kernel: Kernel::Constant, m: 1.5, rule: VolumeRule::Full, calibrated: false };

fn plate(cuts: &[[[i64; 2]; 2]], holes: &[([i64; 2], i64)]) -> CutPlate {
    CutPlate { nodes: [6, 5], cuts: cuts.to_vec(), holes: holes.to_vec() }
}

#[test]
fn bonds_are_those_counted_by_hand() {
    // 5·5 along x, 6·4 along y, 2·5·4 diagonals.
    assert_eq!(plate(&[], &[]).bonds(EIGHT), 25 + 24 + 40);
    // From the left over three cells, between rows 1 and 2: 3 upright bonds, and two diagonals at each of the corners of
    // cells at 1, 2 and 3, the last of which is the tip.
    let slit = plate(&[[[0, 200], [300, 200]]], &[]);
    assert_eq!(slit.bonds(EIGHT), 89 - 3 - 6);
    assert!(!slit.joined([2, 1], [3, 2]) && !slit.joined([3, 1], [2, 2]) && slit.joined([3, 1], [4, 2]));
    // Through the nodes of row 2, which belong to its left, above.
    let along = plate(&[[[0, 250], [250, 250]]], &[]);
    assert!(!along.joined([1, 2], [1, 1]) && along.joined([1, 2], [1, 3]) && along.joined([0, 2], [1, 2]));
    // Ends on a node: the node's own bonds downwards are crossed at the tip.
    assert!(!along.joined([2, 2], [2, 1]) && !along.joined([2, 2], [3, 1]) && along.joined([3, 2], [3, 1]));
    // Turned around, the nodes on it belong to the other side.
    let back = plate(&[[[250, 250], [0, 250]]], &[]);
    assert!(back.joined([1, 2], [1, 1]) && !back.joined([1, 2], [1, 3]));
}

#[test]
fn holes_take_nodes_and_the_bonds_across() {
    // Of radius half a cell about a node: the node goes; bonds of its neighbours pass half a diagonal, 0.707, away.
    let one = plate(&[], &[([250, 250], 50)]);
    assert_eq!((one.standing().len(), one.bonds(EIGHT)), (29, 89 - 8));
    // Wider than half a diagonal: they are cut, and the four beside it at a whole cell stay.
    let wide = plate(&[], &[([250, 250], 71)]);
    assert_eq!((wide.standing().len(), wide.bonds(EIGHT)), (29, 89 - 8 - 4));
    assert!(wide.joined([1, 1], [2, 1]) && !wide.joined([2, 1], [3, 2]));
    // What touches the circle stays.
    assert!(
        plate(&[], &[([250, 250], 100)]).stands([3, 2]) && !plate(&[], &[([250, 250], 101)]).stands([3, 2])
    );
}

#[test]
fn pieces_come_apart_where_cuts_close() {
    let cell = [
        [[200, 200], [300, 200]],
        [[300, 200], [300, 300]],
        [[300, 300], [200, 300]],
        [[200, 300], [200, 200]],
    ];
    let alone = plate(&cell, &[]);
    let pieces = alone.pieces(EIGHT);
    assert_eq!((pieces.iter().max(), pieces.iter().filter(|piece| **piece == 1).count()), (Some(&1), 1));
    assert_eq!(pieces[2 * 6 + 2], 1);
    assert_eq!(alone.lost(EIGHT)[2 * 6 + 2], 8);
    assert!(plate(&cell[..3], &[]).pieces(EIGHT).iter().all(|piece| *piece == 0));
}

#[test]
fn forces_are_those_of_the_bonds_that_are_left() {
    // One node moved along x pulls its two neighbours in the row by w, and nothing across a cut.
    let mut moved = vec![[0.0; 2]; 30];
    moved[2 * 6 + 2] = [1.0, 0.0];
    let whole = plate(&[], &[]).forces(EIGHT, &moved).unwrap();
    let cut = plate(&[[[250, 100], [250, 400]]], &[]).forces(EIGHT, &moved).unwrap();
    // The cut goes upwards: nodes on it belong to its left, and the bond to the right is parted.
    assert!(whole[2 * 6 + 1][0] > 0.0 && whole[2 * 6 + 1][0] == whole[2 * 6 + 3][0]);
    assert_eq!((cut[2 * 6 + 1], cut[2 * 6 + 3]), (whole[2 * 6 + 1], [0.0; 2]));
    let balance: f64 = cut.iter().map(|force| force[0]).sum();
    assert!(balance.abs() < 1e-15);
    assert_eq!(plate(&[], &[]).forces(EIGHT, &moved[1..]), None);
}
