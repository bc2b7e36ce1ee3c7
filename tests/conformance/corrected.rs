//! Surface corrections: what a uniform stretch stores, and a time step under which nothing grows.

use crate::bodies::{constant, field, model, rough, scene, still};
use crate::holed::{hole, pierced, plate};
use pd_verify::constraints::{Edge, Edges};
use pd_verify::forces::family;
use pd_verify::forces::surface::Correction;
use pd_verify::lattice::Stencil;
use pd_verify::ledger::Ledger;
use pd_verify::march::March;
use pd_verify::model::{Model, surface_factors};
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::scene::{Scene, StepRule, Time};

const STRAIN: f64 = 1e-3;

/// Energy per volume of nodes, of a body stretched along x.
fn stored<const D: usize>(scene: &Scene<D>) -> f64 {
    let own = model(scene);
    let stretched = field(&own, |x| std::array::from_fn(|axis| if axis == 0 { STRAIN * x[0] } else { 0.0 }));
    own.energy(&still(&stretched)) / (own.cell_volume * own.grid.count() as f64)
}

/// The same of a node in the bulk of a plate: half of each bond's ½w(ε ξ_x²/|ξ|)², over offsets, constant kernel.
fn bulk(scene: &Scene<2>) -> f64 {
    let (m, reach) = (scene.lattice.m, scene.lattice.m.ceil() as i32 + 1);
    let mut sum = 0.0;
    for row in -reach..=reach {
        for column in -reach..=reach {
            let distance = f64::from(row).hypot(f64::from(column));
            let fraction = match scene.lattice.volume_rule {
                VolumeRule::Full => f64::from(distance <= m),
                _ => (m + 0.5 - distance).clamp(0.0, 1.0),
            };
            if distance > 0.0 {
                sum += 0.25 * fraction / distance * (STRAIN * f64::from(column).powi(2) / distance).powi(2);
            }
        }
    }
    // c V/|ξ| = 9E/(πm³Δx) over a distance in spacings, times Δx² of the elongations.
    sum * 9.0 * scene.material.youngs_modulus / (std::f64::consts::PI * m.powi(3))
}

/// λ_i W_i = W of the bulk for each node, and a bond along the stretch takes the mean of its ends' λ. So the energies of
/// such bonds, half at each end, add up to Σ λ_i W_i: a corrected body that has no others stores exactly what as much
/// bulk does. Bars and plates of one row are such bodies, holes or not.
#[test]
fn a_corrected_row_stores_in_a_stretch_what_the_bulk_does() {
    for m in [1.0, 2.0, 5.0] {
        // Linear volumes: the bulk's modulus is E.
        let bar = scene::<1>(constant(m, VolumeRule::Linear, false), [23]);
        let bar = Scene { surface: Correction::Energy, ..bar };
        let bulk = 0.5 * bar.material.youngs_modulus * STRAIN * STRAIN;
        // Differences of ε x keep 1e-15 of twenty-three spacings; sums of a few hundred terms.
        assert!((stored(&bar) / bulk - 1.0).abs() < 1e-13, "{m}");
        assert!(stored(&Scene { surface: Correction::None, ..bar }) < 0.98 * bulk);
    }
    for holes in [vec![], vec![hole([11.3, 0.4], 1.2)], vec![hole([7.0, 0.5], 0.7), hole([17.0, 1.0], 2.1)]] {
        let row = scene::<2>(constant(3.0, VolumeRule::Linear, false), [23, 1]);
        let row = Scene { holes, surface: Correction::Energy, ..row };
        assert!((stored(&row) / bulk(&row) - 1.0).abs() < 1e-13, "{:?}", row.holes);
        assert!(stored(&Scene { surface: Correction::None, ..row.clone() }) < 0.9 * bulk(&row));
    }
}

/// Where all nodes lack the same along both axes every factor is their λ, slanted bonds or not: each node stores what the
/// bulk does. A hole leaves two squares of four nodes, each of which has one neighbour along x, one along y, one across.
#[test]
fn corrected_nodes_that_are_all_alike_store_what_the_bulk_does() {
    let lattice = constant(1.5, VolumeRule::Full, false);
    let squares = Scene { holes: vec![hole([2.5, 1.0], 0.8)], ..scene::<2>(lattice, [5, 2]) };
    assert_eq!(squares.grid(0).count(), 8);
    let squares = Scene { surface: Correction::Energy, ..squares };
    assert!((stored(&squares) / bulk(&squares) - 1.0).abs() < 1e-13);
    // Of the 2 + 4 bonds that a stretch strains in the bulk 1 + 1 are left.
    assert!(stored(&Scene { surface: Correction::None, ..squares.clone() }) < 0.5 * bulk(&squares));
    // The whole plate is not alike: the correction is no longer exact.
    let plate = Scene { holes: vec![], ..squares };
    assert!((stored(&plate) / bulk(&plate) - 1.0).abs() > 1e-3);
}

/// The largest 2V₀/(V_i + V_j) of a plate mirrored at x = 0 and y = 0 around a hole of `radius` spacings at that corner,
/// over all its bonds, linear volumes.
fn largest_by_hand(count: i32, m: f64, radius: f64) -> f64 {
    let reach = m.ceil() as i32 + 1;
    let place = |n: [i32; 2]| n.map(|n| f64::from(n) + 0.5);
    let mirrored = |n: [i32; 2]| n.map(|n| if n < 0 { -1 - n } else { n }.min(2 * count - 1 - n));
    let fraction =
        |offset: [i32; 2]| (m + 0.5 - f64::from(offset[0]).hypot(f64::from(offset[1]))).clamp(0.0, 1.0);
    let offsets = || (-reach..=reach).flat_map(move |x| (-reach..=reach).map(move |y| [x, y]));
    let family = || offsets().filter(|&offset| offset != [0, 0] && fraction(offset) > 0.0);
    // Both ends and all between them lie outside the circle about the corner.
    let bonded = |node: [i32; 2], offset: [i32; 2]| {
        let ([x, y], [dx, dy]) = (place(node), offset.map(f64::from));
        let nearest = (-(x * dx + y * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
        (x + nearest * dx).hypot(y + nearest * dy) > radius
    };
    let far = |node: [i32; 2], offset: [i32; 2]| [node[0] + offset[0], node[1] + offset[1]];
    let volume =
        |node: [i32; 2]| -> f64 { family().filter(|&offset| bonded(node, offset)).map(fraction).sum() };
    let bulk: f64 = family().map(fraction).sum();
    let nodes = (0..count).flat_map(|x| (0..count).map(move |y| [x, y]));
    let of = |node: [i32; 2]| {
        let bonds = family().filter(move |&offset| bonded(node, offset));
        bonds.map(move |offset| 2.0 * bulk / (volume(node) + volume(mirrored(far(node, offset))))).collect()
    };
    nodes.flat_map(|node| -> Vec<f64> { of(node) }).fold(1.0, f64::max)
}

/// Bonds across a left or bottom mirror are owned by ghosts; the largest factor may be theirs.
#[test]
fn the_largest_factor_is_that_of_any_bond() {
    for surface in [Correction::Volume, Correction::Energy] {
        let whole = scene::<2>(constant(2.0, VolumeRule::Linear, false), [40, 40]);
        let plate = Scene { edges: Edges([[Edge::MirrorOdd; 2]; 2]), surface, ..whole };
        let at = |corner: [f64; 2]| {
            let plate = Scene { holes: vec![hole(corner, 2.3)], ..plate.clone() };
            let stencil = Stencil::<2>::new(plate.lattice).unwrap();
            let grid = plate.grid(stencil.reach());
            let family = family(&stencil, plate.modulus(), plate.spacing);
            surface_factors(&plate, &family, &grid).unwrap().largest(&grid)
        };
        // The same plate seen from another side: nothing but the owners of the bonds differs, and the order of sums.
        for corner in [[40.0, 0.0], [0.0, 40.0], [40.0, 40.0]] {
            assert!((at([0.0, 0.0]) / at(corner) - 1.0).abs() < 1e-13, "{surface:?} {corner:?}");
        }
        if surface == Correction::Volume {
            let (found, by_hand) = (at([0.0, 0.0]), largest_by_hand(40, 2.0, 2.3));
            // Sums of two dozen fractions.
            assert!((found / by_hand - 1.0).abs() < 1e-14, "{found} {by_hand}");
            assert!((found - 1.549).abs() < 5e-4, "{found}");
        }
    }
}

/// ω_max from below, by powers of the stiffness.
fn highest(own: &Model<2>, density: f64) -> f64 {
    let mut u = rough(own, 11, 1.0);
    let mut square = 0.0;
    for _ in 0..400 {
        let mut f = own.grid.field();
        own.force(&still(&u), &mut f);
        let norm = |field: &[f64]| field[own.grid.body()].iter().map(|x| x * x).sum::<f64>().sqrt();
        square = norm(&f) / (norm(&u) * density);
        let size = norm(&f);
        u.iter_mut().zip(&f).for_each(|(u, f)| *u = f / size);
    }
    square.sqrt()
}

/// At 0.9 of the limit nothing grows. Leapfrog keeps H = kinetic·(1 − ω²Δt²/4) + …, mode by mode, hence no kinetic energy
/// is above H/(1 − 0.81). At 1.9 of it a corrected plate does grow, and an uncorrected one at 1.2.
#[test]
fn nothing_grows_below_the_planned_limit() {
    for body in pierced() {
        for surface in [Correction::None, Correction::Energy, Correction::Volume] {
            let scene = Scene { surface, ..body.clone() };
            let own = model(&scene);
            let limit = Plan::of(&scene).unwrap();
            let limit = limit.time_step_s / limit.time_step_over_limit;
            let over = limit * highest(&own, scene.material.density) / 2.0;
            assert!(over < 1.0 && over > 0.5, "{surface:?}: {over}");
            eprintln!("{surface:?}: limit over 2/ω_max = {over:.4}");
            let (most, drift) = grown(&scene, &own, 0.9, 3000);
            assert!(most < 1.0 / (1.0 - 0.81) && drift < 1e-9, "{surface:?}: {most} {drift:e}");
            let (most, _) = grown(&scene, &own, if surface == Correction::None { 1.2 } else { 1.9 }, 300);
            assert!(most > 1e6, "{surface:?}: {most}");
        }
    }
}

/// The largest kinetic energy over the conserved one at the start, and its largest relative change.
fn grown(scene: &Scene<2>, own: &Model<2>, fraction: f64, steps: u64) -> (f64, f64) {
    let plan = Plan::of(scene).unwrap();
    let time_step = fraction * plan.time_step_s / plan.time_step_over_limit;
    let start = [12, 13].map(|seed| rough(own, seed, 0.01 * scene.spacing));
    let [displacement, velocity_step] = start;
    let mut march = March::from_fields(own, displacement, velocity_step, time_step);
    let (mut ledger, mut first, mut most, mut drift) = (Ledger::new(own), 0.0, 0.0_f64, 0.0_f64);
    for step in 0..steps {
        march.advance_booked(&mut ledger);
        let balance = ledger.balance();
        first = if step == 0 { balance.closed() } else { first };
        most = most.max(balance.kinetic / first);
        drift = drift.max((balance.closed() / first - 1.0).abs());
    }
    (most, drift)
}

#[test]
fn the_band_is_counted() {
    // 3 + 1 layers along each edge feel a correction: neighbours of nodes whose families reach 3 nodes over the edge.
    let own = Scene { surface: Correction::Energy, ..plate(3.0) };
    let plan = Plan::of(&own).unwrap();
    let (inner, all) = ((21 - 2 * 6) * (18 - 2 * 6), 21 * 18);
    assert_eq!((plan.band_nodes, plan.nodes), (all - inner, all));
    assert!((plan.band_share() - 324.0 / 378.0).abs() < 1e-15);
    assert_eq!(plan.operator, "stencil; 324 of 378 nodes (85.7 %) as a list");
    let time = Time { duration: 1e-4, step: StepRule::OfLimit(0.5) };
    assert!(Plan::of(&Scene { time, ..plate(3.0) }).unwrap().operator == "stencil");
}
