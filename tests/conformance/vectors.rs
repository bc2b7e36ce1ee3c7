//! Every instruction set against plain code with every access checked, and against the list of bonds.
//!
//! Plates are longer than a strip of the stencil and of no multiple of a vector's length, with a notch and a hole.

use crate::bodies::{constant, force, rough, scene};
use crate::checks::{agreement, same_bits};
use pd_verify::constraints::{Edge, Edges};
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::{Hole, Notch, Operator, Rotations, Scene};
use pd_verify::simd::{InstructionSet, Isa};

/// The same body for an instruction set.
fn on<const D: usize>(scene: &Scene<D>, isa: Isa) -> Model<D> {
    Model::on(scene, isa).unwrap_or_else(|wrong| panic!("{}: {}", scene.name, wrong.message))
}

/// One family for each kernel of the stencil: those of registers, those of memory, and one too long for either.
fn plates() -> Vec<Scene<2>> {
    let families = [1.5, 2.0, 2.4, 3.0, 3.2, 3.7, 4.0, 5.0, 6.0, 7.0, 9.0].map(|m| (m, VolumeRule::Linear));
    let full = [2.0, 3.0, 4.0].map(|m| (m, VolumeRule::Full));
    let exact = [1.7, 3.6, 4.4, 5.2, 6.4, 7.4].map(|m| (m, VolumeRule::ExactArea));
    let mut all = Vec::new();
    for (m, rule) in families.into_iter().chain(full).chain(exact).chain([(48.0, VolumeRule::Full)]) {
        let nodes = if m > 40.0 { [101, 49] } else { [277, 27] };
        let plain = scene::<2>(constant(m, rule, false), nodes);
        let dx = plain.spacing;
        let mirrors = Edges([[Edge::MirrorOdd, Edge::Free], [Edge::Free, Edge::MirrorOdd]]);
        let notches = vec![Notch { from: [60.2 * dx, 0.0], to: [71.7 * dx, 9.1 * dx] }];
        let holes = vec![Hole { centre: [200.0 * dx, 13.0 * dx], radius: 2.6 * dx }];
        let name = format!("m = {m}, {rule:?}");
        all.push(Scene { name: name.clone(), edges: mirrors, ..plain.clone() });
        all.push(Scene { name: format!("{name}, cut"), edges: mirrors, notches, holes, ..plain });
    }
    all
}

fn bars() -> Vec<Scene<1>> {
    [1.0, 2.0, 3.0, 4.0, 7.0, 30.0].map(|m| scene::<1>(constant(m, VolumeRule::Linear, false), [4203])).into()
}

fn hold<const D: usize>(scenes: Vec<Scene<D>>) -> usize {
    let mut compared = 0;
    for scene in scenes {
        for rotations in [Rotations::Small, Rotations::Finite] {
            if rotations == Rotations::Finite && scene.lattice.m > 4.0 {
                continue;
            }
            let scene = Scene { rotations, ..scene.clone() };
            let list = on(&Scene { operator: Operator::Bonds, ..scene.clone() }, Isa::best());
            let mirror = on(&scene, Isa::mirror());
            let u = rough(&mirror, 5, 0.05 * scene.spacing);
            let expected = force(&mirror, &u);
            for isa in Isa::all() {
                let own = on(&scene, isa);
                let f = force(&own, &u);
                if isa.set() != InstructionSet::Baseline {
                    let what = format!("{}, {}", scene.name, isa.set().name());
                    same_bits(&what, &f, &expected).unwrap();
                    compared += 1;
                }
                if scene.lattice.m < 40.0 {
                    agreement(&scene, &own, &list).unwrap_or_else(|wrong| panic!("{}: {wrong}", scene.name));
                }
            }
        }
    }
    compared
}

#[test]
fn vectors_do_what_plain_code_does_to_the_last_bit() {
    let compared = hold(plates()) + hold(bars());
    eprintln!("{compared} forces compared bit for bit");
    // A processor without vectors has the baseline alone: nothing to compare.
    assert_eq!(compared > 0, InstructionSet::Avx2.is_here());
}

/// Multiplying and adding in one rounding changes bits: the baseline and the mirror are two arithmetics.
#[test]
fn a_second_rounding_is_seen() {
    let plate = scene::<2>(constant(3.0, VolumeRule::Linear, false), [40, 30]);
    let (once, twice) = (on(&plate, Isa::mirror()), on(&plate, Isa::of(InstructionSet::Baseline).unwrap()));
    let u = rough(&once, 5, 0.05 * plate.spacing);
    same_bits("two arithmetics", &force(&once, &u), &force(&twice, &u)).unwrap_err();
}
