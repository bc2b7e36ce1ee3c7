//! Standing waves against the equation of motion, marches written out, and waves of one kind.

use pd_verify_reference::standing_wave::{BarStandingWave, StandingWave};
use pd_verify_reference::{Kernel, Lattice, Medium, VolumeRule, continuum, lattice};

const MEDIA: [Medium; 4] = [
    Medium::Local,
    Medium::Moduli(lattice::Moduli { c11: 1.1, c12: 0.8, c66: 0.8 }),
    Medium::Nonlocal { kernel: Kernel::Exponential { p: 1.0 }, horizon: 0.4 },
    Medium::Lattice {
        lattice: Lattice { kernel: Kernel::Constant, m: 2.5, rule: VolumeRule::ExactArea, calibrated: true },
        spacing: 0.1,
    },
];

fn wave(medium: Medium) -> StandingWave {
    StandingWave { medium, wavenumber: [3.0, -5.0], amplitude: [0.7, 0.4], phase: 0.3 }
}

/// −M a.
fn force([xx, xy, yy]: [f64; 3], a: [f64; 2]) -> [f64; 2] {
    [-(xx * a[0] + xy * a[1]), -(xy * a[0] + yy * a[1])]
}

// Second differences of step h err by ω⁴h²/12 and rounding 1e-16/h²; ω = 6, h = 1e-4.
#[test]
fn the_equation_of_motion_holds() {
    for medium in MEDIA {
        let wave = wave(medium);
        assert_eq!(wave.amplitude_at(0.0).map(|a| a.map(|a| (a * 1e14).round() / 1e14)), Some([0.7, 0.4]));
        let (t, h) = (1.234, 1e-4);
        let [before, now, after] = [t - h, t, t + h].map(|t| wave.amplitude_at(t).expect("in range"));
        let expected = force(medium.plane_matrix(wave.wavenumber).expect("in range"), now);
        for i in 0..2 {
            let found = (after[i] - 2.0 * now[i] + before[i]) / (h * h);
            assert!((found - expected[i]).abs() < 2e-6, "{medium:?}: {found} against {}", expected[i]);
        }
    }
}

#[test]
fn steps_are_those_of_a_march() {
    let c_dt = 0.05;
    for medium in MEDIA {
        let wave = wave(medium);
        let mut now = wave.amplitude;
        let matrix = medium.plane_matrix(wave.wavenumber).expect("in range");
        let push = |a: [f64; 2]| force(matrix, a).map(|f| f * c_dt * c_dt);
        let first = push(now);
        let mut before = [now[0] + 0.5 * first[0], now[1] + 0.5 * first[1]];
        for step in 0..=1000_u64 {
            if step % 333 == 1 || step < 3 {
                let found = wave.amplitude_after(step, c_dt).expect("stable");
                // The march itself collects rounding, some 1e-16 a step twice over.
                assert!((found[0] - now[0]).abs() + (found[1] - now[1]).abs() < 1e-12, "{medium:?} {step}");
            }
            let f = push(now);
            let next = [2.0 * now[0] - before[0] + f[0], 2.0 * now[1] - before[1] + f[1]];
            before = std::mem::replace(&mut now, next);
        }
        assert_eq!(wave.amplitude_after(1, 1.0), None, "ωΔt = 5.8 is too long");
    }
}

#[test]
fn a_pure_shear_wave_of_local_elasticity() {
    let wave =
        StandingWave { medium: Medium::Local, wavenumber: [0.6, 0.8], amplitude: [-0.8, 0.6], phase: 0.0 };
    let [x, y] = wave.amplitude_at(3.0).expect("any k");
    let turned = libm::cos(3.0_f64.sqrt());
    assert!((x + 0.8 * turned).abs() < 1e-15 && (y - 0.6 * turned).abs() < 1e-15);
    assert_eq!(wave.shape([2.0, -1.0]), libm::cos(0.6 * 2.0 - 0.8));
}

#[test]
fn bars() {
    let nonlocal = Medium::Nonlocal { kernel: Kernel::Conical, horizon: 2.0 };
    let bar = BarStandingWave { medium: nonlocal, wavenumber: 3.0, amplitude: 2.0, phase: 0.5 };
    let omega = continuum::bar(Kernel::Conical, 6.0).expect("in range").omega / 2.0;
    assert!((bar.amplitude_at(0.7).expect("in range") - 2.0 * libm::cos(omega * 0.7)).abs() < 1e-15);
    assert_eq!(bar.shape(0.25), libm::cos(1.25));
    let local = BarStandingWave { medium: Medium::Local, ..bar };
    // ωΔt = 1 turns by π/3 a step.
    assert!((local.amplitude_after(2, 1.0 / 3.0).expect("stable") + 1.0).abs() < 1e-15);
    assert_eq!(local.amplitude_after(2, 0.7), None);
}
