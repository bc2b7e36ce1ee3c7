//! Does a third of a step pass when it is due? Against the exact motion of released bars, at x = L/2.

use pd_verify_reference::front::Front;
use pd_verify_reference::lattice_modes::LatticeModes;
use pd_verify_reference::{Kernel, Lattice, VolumeRule, continuum, lattice, leapfrog};

const CONSTANT: Lattice =
    Lattice { kernel: Kernel::Constant, m: 5.0, rule: VolumeRule::Full, calibrated: false };
const NARROW: Lattice = Lattice { kernel: Kernel::Gaussian { p: 2.0 }, ..CONSTANT };

fn lattices() -> [(Lattice, Option<f64>); 6] {
    let linear = VolumeRule::Linear;
    [
        (CONSTANT, None),
        (NARROW, None),
        (Lattice { rule: linear, ..CONSTANT }, None),
        (Lattice { rule: linear, ..NARROW }, Some(0.5)),
        (Lattice { calibrated: true, ..NARROW }, None),
        (Lattice { calibrated: true, ..NARROW }, Some(0.5)),
    ]
}

/// A bar of `nodes` released at its right end, with its front: what has passed the middle when it is due.
fn released(of: Lattice, courant: Option<f64>, nodes: usize) -> (Front, LatticeModes, f64) {
    let front = Front::of(of, courant).expect("shorter waves are slower");
    let modes = LatticeModes::new(of, nodes, courant).expect("stable");
    // The middle loses its strain ε₀ in one step, when the release has come L/2.
    let passed = 1.0 - modes.strain(nodes / 2, 0.5 * nodes as f64 / front.speed);
    (front, modes, passed)
}

#[test]
fn a_third_has_passed_and_the_rest_falls_as_said() {
    for (of, courant) in lattices() {
        let deviations = [800, 1600, 3200].map(|nodes| {
            let (front, _, passed) = released(of, courant, nodes);
            let way = 0.5 * nodes as f64;
            (passed - 1.0 / 3.0, passed - front.fraction_at_arrival(way))
        });
        for pair in deviations.windows(2) {
            let order = |a: f64, b: f64| (a / b).log2();
            let (plain, corrected) = (order(pair[0].0, pair[1].0), order(pair[0].1, pair[1].1));
            assert!((plain - 2.0 / 3.0).abs() < 0.02, "{of:?}: {plain}");
            assert!((corrected - 4.0 / 3.0).abs() < 0.03, "{of:?}: {corrected}");
        }
        assert!(deviations[0].0.abs() < 5e-4 && deviations[0].1.abs() < 6e-6, "{of:?}: {deviations:?}");
    }
}

#[test]
fn the_level_of_a_third_is_early_by_a_hundredth_of_a_spacing() {
    for (of, courant) in lattices() {
        for nodes in [800, 1600] {
            let (front, modes, _) = released(of, courant, nodes);
            let way = 0.5 * nodes as f64;
            let due = way / front.speed;
            let (mut before, mut after) = (due - front.width(way), due + front.width(way));
            while after - before > 1e-9 {
                let middle = 0.5 * (before + after);
                let risen = 1.0 - modes.strain(nodes / 2, middle) > 1.0 / 3.0;
                (before, after) = if risen { (before, middle) } else { (middle, after) };
            }
            let (found, said) = (due - before, front.earliness_of_a_third(way));
            assert!((found - said).abs() < 0.01 * said.abs(), "{of:?}: {found} against {said}");
            assert!((found / due).abs() < 3e-5, "{of:?}: {found} of {due}");
        }
    }
}

#[test]
fn long_waves_have_the_speed_and_the_shares_of_the_lattice() {
    for (of, courant) in lattices() {
        let front = Front::of(of, courant).expect("shorter waves are slower");
        assert!((front.speed - lattice::bar_modulus(of).sqrt()).abs() < 1e-15);
        let omega = |k: f64| {
            let space = lattice::bar(of, k);
            courant.map_or(Some(space), |courant| leapfrog::wave(space, courant)).expect("stable").omega
        };
        let share = |k: f64| (1.0 - omega(k) / (front.speed * k)) / (k * k);
        let (one, two) = (share(0.01), share(0.02));
        assert!((one - front.beta + front.gamma * 1e-4).abs() < 1e-7, "{of:?}: {one}");
        assert!(((one - two) / 3e-4 - front.gamma).abs() < 1e-3 * front.gamma, "{of:?}");
    }
    // m → ∞: β/m² and γ/m⁴ are the continuum's 1/48 and 1/2160 − 1/4608.
    let fine = Lattice { m: 2000.0, rule: VolumeRule::Linear, ..CONSTANT };
    let front = Front::of(fine, None).expect("shorter waves are slower");
    let z = 0.1;
    let wave = continuum::bar(Kernel::Constant, z).expect("within the range").omega / z;
    let (beta, gamma) = (front.beta / 2000.0_f64.powi(2), front.gamma / 2000.0_f64.powi(4));
    assert!((beta - 1.0 / 48.0).abs() < 1e-7 && (gamma - 1.0 / 2160.0 + 1.0 / 4608.0).abs() < 1e-8);
    assert!((wave - (1.0 - beta * z * z + gamma * z.powi(4))).abs() < 1e-8);
}

#[test]
fn fronts_of_another_shape_have_no_answer() {
    // Nearest neighbours at Courant's number 1 do not disperse: β = (1 − C²)/24.
    let nearest = Lattice { m: 1.0, calibrated: true, ..CONSTANT };
    let beta = Front::of(nearest, Some(0.6)).expect("shorter waves are slower").beta;
    assert!((beta - (1.0 - 0.36) / 24.0).abs() < 1e-15);
    assert_eq!(Front::of(nearest, Some(1.1)), None);
    assert_eq!(Front::of(Lattice { kernel: Kernel::Conical, m: 1.0, ..CONSTANT }, None), None);
}
