//! What every implementation of the bonds must do. A check answers with its error over its bound, at most 1, or with
//! what is wrong.
//!
//! One bond's share of a force takes at most 16 roundings (the finite law: differences, a root, two quotients), and a
//! node adds up its family: the error of its force is below (family + 16) u Σ|w||u_j − u_i|, u = 2⁻⁵³.

use crate::bodies::{Rough, Sums, UNIT, apart, each_bond, field, force, kept, places, rough, size, still};
use pd_verify::model::Model;
use pd_verify::scene::{Rotations, Scene};

/// Error over bound, or what is wrong.
pub type Checked = Result<f64, String>;

/// Whether an error keeps to its bound; what is not a number does not.
pub fn within(what: &str, error: f64, bound: f64) -> Checked {
    if error <= bound {
        Ok(if bound == 0.0 { 0.0 } else { error / bound })
    } else {
        Err(format!("{what}: {error:e} is above {bound:e}"))
    }
}

/// Rough displacements: bonds stay longer than 0.7 of their length and none turns over.
fn start<const D: usize>(scene: &Scene<D>, model: &Model<D>) -> Vec<f64> {
    rough(model, 1, 0.1 * scene.spacing)
}

/// Roundings of a node's force.
fn roundings(sums: &Sums) -> f64 {
    (sums.family + 16) as f64
}

/// Force times cell volume is −∂E/∂u, along a rough field and along single components at corners, edge and centre.
///
/// Small rotations: E is quadratic and central differences are exact at any step; a twentieth of Δx loses no digits.
/// Finite rotations: Richardson's extrapolation from h and h/2 is wrong by h⁴E⁽⁵⁾/480; along a bond that opens by v,
/// |φ⁽⁵⁾| ≤ 23 |ξ||v|⁵/|y|⁴, since the fifth derivative of √(s² + p²) is 15p²s(3p² − 4s²)/r⁹. At h = Δx/2000 that and
/// the rounding of E over h are of like size.
pub fn gradient<const D: usize>(scene: &Scene<D>, model: &Model<D>) -> Checked {
    let (grid, u) = (&model.grid, start(scene, model));
    let (sums, at, f) = (Sums::of(scene, grid, &u), places(grid), force(model, &u));
    let finite = scene.rotations == Rotations::Finite;
    let h = scene.spacing * if finite { 1.0 / 2000.0 } else { 1.0 / 20.0 };
    let terms = roundings(&sums) + (sums.family + at.len()) as f64;
    let (mut worst, mut steepest) = (0.0_f64, 0.0_f64);
    for trial in 0..5 {
        let mut way = match trial {
            0 => rough(model, 2, 1.0),
            _ => grid.field().to_vec(),
        };
        if trial > 0 {
            way[at[[0, at.len() / 2, at.len() - 1, D * scene.nodes[0] - 1][trial - 1]]] = 1.0;
            model.fill_ghosts(&mut way);
        }
        let energy = |h: f64| {
            let moved: Vec<f64> = u.iter().zip(&way).map(|(u, way)| u + h * way).collect();
            model.energy(&still(&moved))
        };
        let difference = |h: f64| (energy(h) - energy(-h)) / (2.0 * h);
        let slope = if finite { (4.0 * difference(0.5 * h) - difference(h)) / 3.0 } else { difference(h) };
        let work: f64 = at.iter().map(|&at| f[at] * way[at]).sum::<f64>() * model.cell_volume;
        let (mut truncated, mut reach) = (0.0, 0.0);
        each_bond(scene, grid, |near, far, bond| {
            let (eta, v) = (apart(grid, &u, near, far), size(apart(grid, &way, near, far)));
            let y = size::<D>(std::array::from_fn(|axis| bond.direction.xi[axis] + eta[axis]));
            let weight = 0.5 * model.cell_volume * bond.weight.abs();
            if finite && D == 2 {
                truncated +=
                    weight * 23.0 / 480.0 * h.powi(4) * bond.direction.length * v.powi(5) / y.powi(4);
            }
            reach += 0.5 * weight * (size(eta) + h * v).powi(2);
        });
        let own = |place: usize| size::<D>(std::array::from_fn(|axis| way[place + axis * grid.stride()]));
        let carried: f64 = grid.each().map(|node| grid.place(node)).map(|at| sums.pull[at] * own(at)).sum();
        // Three energies' worth of error over h, and the work's own.
        let bound = 1.1 * truncated + terms * UNIT * (3.0 * reach / h + model.cell_volume * carried);
        worst = worst.max(within("force and slope of the energy", (slope + work).abs(), bound)?);
        steepest = steepest.max(slope.abs() / bound);
    }
    if steepest < 1e5 {
        return Err(format!("the slopes are only {steepest:e} bounds high: nothing was tried"));
    }
    Ok(worst)
}

/// The bonds of a body add up to no force along the axes that no edge holds, those of a free one to no moment either:
/// about the nodes where they are with finite rotations, where they were with small ones. Bound: rounding of each node's
/// force and of the sum, times the largest arm.
pub fn balance<const D: usize>(scene: &Scene<D>, model: &Model<D>) -> Checked {
    let (grid, u) = (&model.grid, start(scene, model));
    let (sums, f) = (Sums::of(scene, grid, &u), force(model, &u));
    let (mut total, mut moment, mut arm) = ([0.0; D], 0.0, 0.0_f64);
    let kept = kept(&scene.edges);
    for node in grid.each() {
        let (place, mut x) = (grid.place(node), grid.position(node));
        let of = |axis: usize| f[place + axis * grid.stride()];
        if scene.rotations == Rotations::Finite {
            (0..D).for_each(|axis| x[axis] += u[place + axis * grid.stride()]);
        }
        (0..D).filter(|&axis| kept[axis]).for_each(|axis| total[axis] += of(axis));
        if D == 2 {
            moment += x[0] * of(1) - x[1] * of(0);
        }
        arm = arm.max(size(x));
    }
    let bound = (roundings(&sums) + grid.count() as f64) * UNIT * sums.all_pull();
    let force = within("sum of the forces", size(total), bound)?;
    if scene.edges.any() {
        return Ok(force);
    }
    Ok(force.max(within("sum of the moments", f64::abs(moment), 2.0 * bound * arm)?))
}

/// A body translated along axes that no edge holds feels nothing at all: differences are taken before they are summed,
/// in both laws.
pub fn translation<const D: usize>(scene: &Scene<D>, model: &Model<D>) -> Checked {
    let kept = kept(&scene.edges);
    let way = |axis: usize| if kept[axis] { 1234.567 * (axis as f64 - 0.3) } else { 0.0 };
    let f = force(model, &field(model, |_| std::array::from_fn(way)));
    let largest = places(&model.grid).iter().map(|&at| f[at].abs()).fold(0.0, f64::max);
    within(&format!("force of a translated body with edges {:?}", scene.edges.0), largest, 0.0)
}

/// The displacement of a point turned about (0.011, −0.007) m.
fn turned<const D: usize>(x: [f64; D], degrees: f64) -> [f64; D] {
    let (sine, cosine) = match degrees {
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        _ => (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians())),
    };
    // cos − 1 from the half angle: tiny rotations keep their digits.
    let half = libm::sin(0.5 * degrees.to_radians());
    let less = if degrees == 90.0 || degrees == 180.0 { cosine - 1.0 } else { -2.0 * half * half };
    if D == 1 {
        return x.map(|x| less * (x - 0.011));
    }
    let (a, b) = (x[0] - 0.011, x[1] + 0.007);
    let mut u = [0.0; D];
    (u[0], u[1]) = (less * a - sine * b, sine * a + less * b);
    u
}

/// A turned free body feels nothing with finite rotations: at most 1e-12 of Σ|w||ξ|. The displacement of a node is some
/// twenty spacings here, so rounding alone makes bonds longer or shorter by 1e-15 of their length.
pub fn rotation<const D: usize>(scene: &Scene<D>, model: &Model<D>) -> Checked {
    let angles: &[f64] = if D == 1 { &[180.0] } else { &[1e-8, 0.01, 1.0, 30.0, 90.0, 137.0, 180.0, 271.3] };
    let mut worst = 0.0_f64;
    for &degrees in angles {
        let f = force(model, &field(model, |x| turned(x, degrees)));
        let largest = places(&model.grid).iter().map(|&at| f[at].abs()).fold(0.0, f64::max);
        let bound = 1e-12 * Sums::of(scene, &model.grid, &model.grid.field()).largest_stiffness();
        worst = worst.max(within(&format!("force of a body turned by {degrees}°"), largest, bound)?);
    }
    Ok(worst)
}

/// Deformed and then turned, a body feels the turned force: the same bound.
pub fn objectivity(scene: &Scene<2>, model: &Model<2>) -> Checked {
    let (grid, u) = (&model.grid, start(scene, model));
    let (sine, cosine) = (0.6, -0.8);
    let f = force(model, &u);
    let mut numbers = Rough::new(1);
    let moved = field(model, |x| {
        let own: [f64; 2] = std::array::from_fn(|_| 0.1 * scene.spacing * numbers.next());
        let y = [x[0] + own[0], x[1] + own[1]];
        [cosine * y[0] - sine * y[1] - x[0], sine * y[0] + cosine * y[1] - x[1]]
    });
    let (g, mut largest) = (force(model, &moved), 0.0_f64);
    for node in grid.each() {
        let (x, y) = (grid.place(node), grid.place(node) + grid.stride());
        let back = [cosine * g[x] + sine * g[y], cosine * g[y] - sine * g[x]];
        largest = largest.max((back[0] - f[x]).abs()).max((back[1] - f[y]).abs());
    }
    let bound = 1e-12 * Sums::of(scene, grid, &u).largest_stiffness();
    within("force of a deformed and turned body", largest, bound)
}

/// The same state gives the same bits, whatever was evaluated in between, and is not changed.
pub fn purity<const D: usize>(scene: &Scene<D>, model: &Model<D>) -> Checked {
    let (u, other) = (start(scene, model), rough(model, 3, 0.05 * scene.spacing));
    let copy = u.clone();
    let (first, energy) = (force(model, &u), model.energy(&still(&u)));
    force(model, &other);
    model.energy(&still(&other));
    same_bits("forces of the same state", &first, &force(model, &u))?;
    same_bits("energies of the same state", &[energy], &[model.energy(&still(&u))])?;
    same_bits("a state before and after", &copy, &u)
}

/// Whether two fields agree to the last bit.
pub fn same_bits(what: &str, a: &[f64], b: &[f64]) -> Checked {
    let different = a.iter().zip(b).filter(|(a, b)| a.to_bits() != b.to_bits()).count();
    if different == 0 && a.len() == b.len() {
        Ok(0.0)
    } else {
        Err(format!("{what} differ in {different} of {} numbers", a.len()))
    }
}

/// Two implementations of the same bonds agree at each node to 1e-13 of Σ|w||u_j − u_i|: a few hundred roundings at
/// most, with the largest family here; also far from the origin, where u is large and its differences are not.
pub fn agreement<const D: usize>(scene: &Scene<D>, one: &Model<D>, other: &Model<D>) -> Checked {
    let mut worst = 0.0_f64;
    for shift in [0.0, 1e3 * scene.spacing] {
        let mut numbers = Rough::new(4);
        let u = field(one, |_| std::array::from_fn(|_| shift + 0.1 * scene.spacing * numbers.next()));
        let (sums, f, g) = (Sums::of(scene, &one.grid, &u), force(one, &u), force(other, &u));
        for node in one.grid.each() {
            let place = one.grid.place(node);
            let difference: [f64; D] = std::array::from_fn(|axis| {
                f[place + axis * one.grid.stride()] - g[place + axis * one.grid.stride()]
            });
            let what = format!("two implementations at {node:?}");
            worst = worst.max(within(&what, size(difference), 1e-13 * sums.pull[place])?);
        }
        let (one, other) = (one.energy(&still(&u)), other.energy(&still(&u)));
        let bound = 2.0 * (roundings(&sums) + f.len() as f64) * UNIT * sums.energy;
        worst = worst.max(within("energies of two implementations", (one - other).abs(), bound)?);
    }
    Ok(worst)
}
