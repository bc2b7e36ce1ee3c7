//! A stretched plate: by hand on four neighbours, nothing under a rotation, nothing inside.

use pd_verify_reference::stretched_plate::forces;
use pd_verify_reference::{Kernel, Lattice, VolumeRule};

const PRINTED: Lattice =
    Lattice { kernel: Kernel::Constant, m: 1.0, rule: VolumeRule::Full, calibrated: false };

/// w = 8/(3π M₂) = 8/π for the constant kernel at m = 1, M₂ = 1/3; stretched by ε along x, the left node of a row of two is
/// pulled to the right by w ε.
#[test]
fn a_pair_of_nodes_by_hand() {
    for strain in [0.5, 1e-3, 1e-12] {
        let found = forces(PRINTED, [2, 1], [[strain, 0.0], [0.0, 0.0]]);
        let wanted = 8.0 / std::f64::consts::PI * strain;
        assert!(
            (found[0][0] / wanted - 1.0).abs() < 1e-15 && (found[1][0] / wanted + 1.0).abs() < 1e-15,
            "{found:?}"
        );
        assert_eq!((found[0][1], found[1][1]), (0.0, 0.0));
    }
}

#[test]
fn a_rotation_pulls_nothing_and_a_strain_nothing_inside() {
    let of =
        Lattice { kernel: Kernel::Gaussian { p: 2.0 }, m: 2.0, rule: VolumeRule::Linear, calibrated: true };
    let (sine, cosine) = (0.6, 0.8);
    let turned = forces(of, [6, 6], [[cosine - 1.0, -sine], [sine, cosine - 1.0]]);
    assert!(turned.iter().flatten().all(|force| force.abs() < 1e-15), "{turned:?}");
    let strained = forces(of, [6, 6], [[1e-9, 2e-9], [-3e-9, 4e-9]]);
    let inside = strained[2 * 6 + 2];
    assert!(inside.iter().all(|force| force.abs() < 1e-24), "{inside:?}");
    assert!(strained[0].iter().any(|force| force.abs() > 1e-10));
}
