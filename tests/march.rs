//! The march held against exact motions of the lattice: modes of a bar, plane waves of a plate.

use pd_verify::constraints::{Edge, Edges};
use pd_verify::forces::surface::Correction;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Lattice;
use pd_verify::material::{Body, Material};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::record::run;
use pd_verify::scene::{Initial, Operator, Probe, Rotations, Scene, Shape, StepRule, Time, Watch};
use pd_verify_reference as reference;

fn bar(operator: Operator) -> Scene<1> {
    Scene {
        name: "released bar".into(),
        material: Material { youngs_modulus: 200e9, density: 7850.0 },
        body: Body::Bar,
        lattice: Lattice {
            kernel: Kernel::Gaussian { p: 2.0 },
            m: 5.0,
            volume_rule: VolumeRule::Full,
            calibrated: true,
        },
        nodes: [80],
        spacing: 1.0 / 80.0,
        section: 1e-6,
        rotations: Rotations::Small,
        operator,
        edges: Edges([[Edge::MirrorOdd, Edge::MirrorEven]]),
        surface: Correction::None,
        displacement: vec![Initial { component: 0, amplitude: 1e-3, shape: Shape::Linear { along: 0 } }],
        velocity: vec![],
        effects: vec![],
        time: Time { duration: 0.8e-3, step: StepRule::OfLimit(0.8) },
        probes: vec![
            Probe { name: "all".into(), watch: Watch::Line { along: 0, through: 0.0 }, every: 7 },
            Probe { name: "energy".into(), watch: Watch::Energies, every: 1 },
        ],
    }
}

#[test]
fn a_released_bar_moves_in_the_modes_of_its_lattice() {
    for operator in [Operator::Stencil, Operator::Bonds] {
        let scene = bar(operator);
        let record = run(&scene).unwrap();
        let of = reference::Lattice {
            kernel: reference::Kernel::Gaussian { p: 2.0 },
            m: 5.0,
            rule: reference::VolumeRule::Full,
            calibrated: true,
        };
        let courant = scene.speed() * record.plan.time_step_s / scene.spacing;
        let modes = reference::released_bar::LatticeModes::new(of, 80, Some(courant)).unwrap();
        let trace = record.trace("all").unwrap();
        assert!(trace.times.len() > 30);
        let mut worst = 0.0_f64;
        for (t, row) in trace.times.iter().zip(&trace.rows) {
            for (j, u) in row.iter().enumerate() {
                let exact = 1e-3 * modes.displacement(j, scene.speed() * t / scene.spacing);
                worst = worst.max((u - exact).abs() / 1e-3);
            }
        }
        assert!(worst < 1e-12, "{worst:e}");
        let energy = record.trace("energy").unwrap();
        let closed: Vec<f64> =
            energy.rows.iter().map(|row| row[0] + row[1] - row[2] - row[3] - row[4]).collect();
        let drift = closed.iter().map(|e| (e / closed[0] - 1.0).abs()).fold(0.0, f64::max);
        eprintln!("{worst:e} {drift:e} {:?}", record.plan);
        assert!(drift < 1e-11);
    }
}
