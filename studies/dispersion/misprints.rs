//! `asks = "misprints"`: published formulas that concern dispersion, each as printed (expected to fail) and right.

use super::curve::{reference_kernel, reference_lattice};
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of, value_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::dispersion::Branch;
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::dispersion::finite_differences::QUARTER;
use pd_verify::dispersion::joint::Chain;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::Wrong;
use pd_verify::verdict::Evidence;
use pd_verify_reference as reference;
use pd_verify_reference::scattering::{self, Half};
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::PI;

/// The case as written: it has no parameters, the formulas are the publications'.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MisprintsAsked {}

/// The case.
pub struct Misprints;

impl Asked for MisprintsAsked {
    type Question = Misprints;

    fn check(&self, _: &Written<'_>) -> Result<Misprints, Wrong> {
        Ok(Misprints)
    }
}

/// One formula: the same bound asked of what is printed and of what is right.
struct Pair {
    /// Claim names, as printed and right.
    names: [&'static str; 2],
    quantity: &'static str,
    bound: Bound,
    basis: Basis,
    because: &'static str,
    /// Where it is printed, and what is wrong with it.
    printed_in: &'static str,
    wrong: &'static str,
    /// What the right form rests on.
    right: &'static str,
    measure: fn(&dyn Subject) -> [Evidence; 2],
}

enum Bound {
    AtMost(ErrorKind, f64),
    AtLeast(f64),
}

const PAIRS: [Pair; 8] = [
    Pair {
        names: ["kernel_cut_printed", "kernel_cut_right"],
        quantity: "|C11/C11_intended − 1|, constant kernel, m = 3, linear volumes, plane",
        bound: Bound::AtMost(ErrorKind::Absolute, 0.05),
        basis: Basis::Engineering,
        because: "no more than 5 % of the stiffness may be lost at the edge of the horizon",
        printed_in: "Bouaraquia 2024, (10) with (36)",
        wrong: "the kernel is 0 for ξ > δ although the volume factor is positive to δ + Δx/2: 8 of 36 bonds are lost",
        right: "kernel continued wherever the volume fraction is positive",
        measure: kernel_cut,
    },
    Pair {
        names: ["time_step_printed", "time_step_right"],
        quantity: "row-sum bound over sharp limit, constant kernel, m = 3, linear volumes, plane",
        bound: Bound::AtLeast(0.5),
        basis: Basis::Theory,
        because: "over the zone the two eigenvalues have mean Σw/2, so 2/ω_max ≤ 2√(2/Σw): the row sum loses at most a factor 2",
        printed_in: "Bouaraquia 2024, (42)",
        wrong: "Δt ≤ √(ρ/ΣVC) lacks the factor √2 and is called necessary; marches at 2.3 times it are stable",
        right: "√(2ρ/ΣVC), sufficient; sharp: 2/ω_max",
        measure: time_step,
    },
    Pair {
        names: ["long_wave_printed", "long_wave_right"],
        quantity: "|long-wave speed/v − 1|, constant kernel, m = 3, bar",
        bound: Bound::AtMost(ErrorKind::Absolute, 1e-12),
        basis: Basis::Theory,
        because: "waves longer than anything in the lattice travel at v",
        printed_in: "Bouaraquia 2024, (48)–(50)",
        wrong: "the sum has no partial volume: the speed is √((m+1)/m) v, and refining at fixed m keeps it so",
        right: "lattice calibration",
        measure: long_wave,
    },
    Pair {
        names: ["mixed_derivative_printed", "mixed_derivative_right"],
        quantity: "|phase speed/c_d − 1| of finite differences at 45°, kΔx = 1e-3",
        bound: Bound::AtMost(ErrorKind::Absolute, 1e-6),
        basis: Basis::Theory,
        because: "second order: (kΔx)²/24 = 4e-8 there",
        printed_in: "Wildman & Gazonas 2014 (Int. J. Fract. 190, 39), (20)",
        wrong: "the mixed derivative lacks its factor ¼",
        right: "differences of the four diagonal neighbours over 4ΔxΔy",
        measure: mixed_derivative,
    },
    Pair {
        names: ["impedance_printed", "impedance_right"],
        quantity: "error of |R|, finite differences | constant kernel m = 3, at kΔx = 0.5, 0.8, 0.97, largest",
        bound: Bound::AtMost(ErrorKind::Absolute, 1e-6),
        basis: Basis::Theory,
        because: "the reference's absorbing layers send back less than 1e-6",
        printed_in: "Wildman & Gazonas 2014, (29)",
        wrong: "impedances are compared at equal k; a wave keeps its frequency, and near the joint fading modes take part",
        right: "exact scattering of the two joined lattices",
        measure: impedance,
    },
    Pair {
        names: ["pulse_printed", "pulse_right"],
        quantity: "peak reflected over peak sent: pulse exp(−7.5·10⁴ (x − 0.1)²), Δx = 1 mm, δ = 3Δx; relative error",
        bound: Bound::AtMost(ErrorKind::Relative, 0.05),
        basis: Basis::Engineering,
        because: "march and spectrum read the peak at slightly different nodes and times, and start the pulse differently",
        printed_in: "Wildman & Gazonas 2014, 3.2",
        wrong: "about 12 % is printed; the pulse given reflects about 1.5 %, one of 2.5·10⁵ would reflect 13 %",
        right: "spectrum of the pulse times the exact R(k), carried to where the march reads it",
        measure: pulse,
    },
    Pair {
        names: ["bar_constant_printed", "bar_constant_right"],
        quantity: "relative error of the micromodulus constant of a bar",
        bound: Bound::AtMost(ErrorKind::Relative, 1e-12),
        basis: Basis::Rounding,
        because: "a closed form against quadrature in double-double arithmetic",
        printed_in: "Zhou 2022, (3.9), 1D",
        wrong: "3E/(Aδ²) makes every wave √1.5 times too fast",
        right: "2E/(Aδ²)",
        measure: bar_constant,
    },
    Pair {
        names: ["plane_strain_constant_printed", "plane_strain_constant_right"],
        quantity: "relative error of the micromodulus constant in plane strain",
        bound: Bound::AtMost(ErrorKind::Relative, 1e-12),
        basis: Basis::Rounding,
        because: "a closed form against quadrature in double-double arithmetic",
        printed_in: "Zhou 2022, (3.9), plane strain",
        wrong: "K̄ = 9E/8 in c = 12K̄/(πhδ³) is the value of another state",
        right: "K̄ = 4E/5",
        measure: plane_strain_constant,
    },
];

impl Question for Misprints {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let bounded = |pair: &Pair, name: &str| {
            let begun = claim(place, name, pair.quantity);
            let bounded = match pair.bound {
                Bound::AtMost(kind, tolerance) => begun.at_most(kind, tolerance),
                Bound::AtLeast(tolerance) => begun.at_least(tolerance),
            };
            bounded.because(pair.basis, pair.because)
        };
        let both = |pair: &Pair| {
            let [printed, right] = pair.names;
            [
                bounded(pair, printed).source(pair.printed_in).broken(format!("misprint: {}", pair.wrong)),
                bounded(pair, right)
                    .source(format!("{}; printed otherwise in {}", pair.right, pair.printed_in)),
            ]
        };
        PAIRS.iter().flat_map(both).collect()
    }

    fn effort(&self) -> Effort {
        Effort {
            curves: 16,
            evaluations: 2100,
            bond_evaluations: 2100 * 400,
            reference_evaluations: 8,
            ..Effort::default()
        }
    }

    fn equations(&self) -> &'static str {
        "each formula as printed and in its right form, against the same bound; see the source of each claim"
    }

    fn answer(&self, subject: &dyn Subject, _: &Place) -> Answer {
        let both = |pair: &Pair| {
            let [printed, right] = (pair.measure)(subject);
            [(pair.names[0].to_owned(), printed), (pair.names[1].to_owned(), right)]
        };
        Answer { evidence: PAIRS.iter().flat_map(both).collect(), ..Answer::default() }
    }
}

fn lattice(volume_rule: VolumeRule, calibrated: bool) -> Lattice {
    Lattice { kernel: Kernel::Constant, m: 3.0, volume_rule, calibrated }
}

fn kernel_cut(subject: &dyn Subject) -> [Evidence; 2] {
    let linear = lattice(VolumeRule::Linear, false);
    let Ok(stencil) = subject.plane_stencil(linear) else { return Default::default() };
    let inside =
        |offset: [i32; 2]| f64::from(offset[0] * offset[0] + offset[1] * offset[1]) <= linear.m * linear.m;
    let c11 = |cut: bool| -> f64 {
        let kept = stencil.bonds.iter().filter(|bond| !cut || inside(bond.offset));
        kept.map(|bond| {
            let [x, y] = bond.offset.map(|n| f64::from(n).powi(2));
            bond.weight * x * x / (x + y)
        })
        .sum()
    };
    [true, false]
        .map(|cut| Evidence { computed: Some(c11(cut)), ..error_of(Some((c11(cut) - 1.0).abs()), "") })
}

fn time_step(subject: &dyn Subject) -> [Evidence; 2] {
    let Ok(stencil) = subject.plane_stencil(lattice(VolumeRule::Linear, false)) else {
        return Default::default();
    };
    let limits = subject.plane_time_step(&stencil);
    let ratio = limits.row_sum / limits.sharp;
    [ratio / 2.0_f64.sqrt(), ratio].map(|ratio| value_of(Some(ratio), None, ""))
}

fn long_wave(subject: &dyn Subject) -> [Evidence; 2] {
    let k = 1e-7;
    [false, true].map(|calibrated| {
        let stencil = subject.bar_stencil(lattice(VolumeRule::Full, calibrated)).ok();
        let speed = stencil.map(|stencil| subject.bar_wave(&BarDispersion::new(&stencil), k).phase(k));
        Evidence { computed: speed, ..error_of(speed.map(|speed| (speed - 1.0).abs()), "kΔx = 1e-7") }
    })
}

fn mixed_derivative(subject: &dyn Subject) -> [Evidence; 2] {
    let k = 1e-3;
    [1.0, QUARTER].map(|mixed| {
        let phase = subject.finite_differences_plane(k, 45.0, Branch::P, mixed).phase(k);
        Evidence { computed: Some(phase), ..error_of(Some((phase - 1.0).abs()), "") }
    })
}

fn impedance(subject: &dyn Subject) -> [Evidence; 2] {
    let of = lattice(VolumeRule::Linear, false);
    let Ok(stencil) = subject.bar_stencil(of) else { return Default::default() };
    let (left, right) = (Chain::finite_differences(), Chain::peridynamic(&stencil));
    let mut worst = [0.0_f64; 2];
    for k in [0.5, 0.8, 0.97] {
        let exact = scattering::reflection(Half::Fd, Half::Pd(reference_lattice(of)), left.frequency(k));
        let exact = exact.unwrap_or(f64::NAN);
        let mine = subject.reflection(&left, &right, k).map_or(f64::NAN, |found| found.norm());
        let printed = subject.published_reflection(&left, &right, k).abs();
        worst = [(worst[0], printed), (worst[1], mine)].map(|(worst, r)| {
            let error = (r - exact).abs();
            if error.is_nan() || worst.is_nan() { f64::NAN } else { worst.max(error) }
        });
    }
    worst.map(|error| error_of(Some(error), ""))
}

/// Sharpness a of the pulse exp(−a x²) in 1/m², and the spacing it is given on.
const SHARPNESS: f64 = 7.5e4;
const DX: f64 = 1e-3;

fn pulse(subject: &dyn Subject) -> [Evidence; 2] {
    let of = lattice(VolumeRule::Linear, false);
    let marched = scattering::pulse_reflection(Half::Fd, Half::Pd(reference_lattice(of)), SHARPNESS, DX, 0.1);
    let stencil = subject.bar_stencil(of).ok();
    let peak = stencil.and_then(|stencil| reflected_peak(subject, &Chain::peridynamic(&stencil)));
    let judge = |(reference, note): (f64, &str)| Evidence {
        computed: peak,
        reference: Some(reference),
        error: peak.map(|peak| (peak - reference).abs() / reference),
        note: note.into(),
        ..Evidence::default()
    };
    [(0.12, "reference: as printed"), (marched, "reference: time march of the pulse, C = 0.1")].map(judge)
}

/// Peak of ∫ R(θ) û(θ) cos(θ(D − n) − ω(θ)t) dθ over the nodes n and times t at which the march is read: the pulse
/// starts D = 9/√a from the joint, its echo is read from D/2 off the joint until it is back where it started.
fn reflected_peak(subject: &dyn Subject, right: &Chain) -> Option<f64> {
    let left = Chain::finite_differences();
    let sharpness = SHARPNESS * DX * DX;
    let distance = (9.0 / sharpness.sqrt()).ceil();
    let mut spectrum = Vec::new();
    let count = 300;
    for theta in (0..count).map(|n| PI * (f64::from(n) + 0.5) / f64::from(count)) {
        let weight = libm::exp(-theta * theta / (4.0 * sharpness));
        if weight > 1e-12 {
            let r = subject.reflection(&left, right, theta)?;
            spectrum.push((theta, left.frequency(theta), weight, r.norm(), r.arg()));
        }
    }
    let sent: f64 = spectrum.iter().map(|(_, _, weight, ..)| weight).sum();
    let at = |node: f64, time: f64| -> f64 {
        let wave = |&(theta, omega, weight, size, phase): &(f64, f64, f64, f64, f64)| {
            weight * size * libm::cos(theta * (distance - node) - omega * time + phase)
        };
        spectrum.iter().map(wave).sum()
    };
    let nodes = || (0..=(1.5 * distance) as i32).map(|n| -0.5 * distance - f64::from(n));
    let times = (0..=(0.75 * distance) as i32).map(|n| 1.5 * distance + f64::from(n));
    let peak =
        times.flat_map(|time| nodes().map(move |node| (node, time))).map(|(node, time)| at(node, time).abs());
    Some(peak.fold(0.0, f64::max) / sent)
}

fn bar_constant(subject: &dyn Subject) -> [Evidence; 2] {
    let (e, area, horizon) = (200e9, 1e-6, 0.0037);
    let exact = reference::micromodulus::bar(reference_kernel(Kernel::Constant), e, area, horizon);
    let right = subject.micromodulus(Body::Bar, Kernel::Constant, e, area, horizon);
    let printed = 1.5 * right;
    [printed, right].map(|c| Evidence {
        computed: Some(c),
        reference: Some(exact),
        ..error_of(Some((c - exact).abs() / exact), "")
    })
}

fn plane_strain_constant(subject: &dyn Subject) -> [Evidence; 2] {
    let (e, thickness, horizon) = (72e9, 0.002, 0.0041);
    let exact =
        reference::micromodulus::plane_strain(reference_kernel(Kernel::Constant), e, thickness, horizon);
    let right = subject.micromodulus(Body::PlaneStrain, Kernel::Constant, e, thickness, horizon);
    let printed = right * (9.0 / 8.0) / (4.0 / 5.0);
    [printed, right].map(|c| Evidence {
        computed: Some(c),
        reference: Some(exact),
        ..error_of(Some((c - exact).abs() / exact), "")
    })
}
