//! The formulas whose arithmetic is looked at: each as the code under judgement has it, naively, and in higher precision.

use crate::dispersion::curve::{reference_kernel, reference_lattice};
use crate::subject::Subject;
use nalgebra::{DMatrix, DVector};
use pd_verify::dispersion::Branch;
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::dispersion::plane::PlaneDispersion;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::material::{Body, Material};
use pd_verify::scene::{Initial, Rotations, Scene, Shape, StepRule, Time};
use pd_verify::stress_intensity::williams::Williams;
use pd_verify::stress_intensity::{Annulus, Elastic, Faces, Sites, Tip};
use pd_verify_reference as reference;
use reference::near_tip::{Term, singular, translation};
use reference::released_bar::ReleasedBar;
use reference::stretched_plate;
use std::f64::consts::PI;

/// Errors at one parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compared {
    pub parameter: f64,
    pub code: f64,
    pub naive: f64,
    /// What an error is held against: 1, or what rounding allows there.
    pub unit: f64,
}

/// A formula along its parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Sum {
    /// Of its claim.
    pub name: &'static str,
    pub title: &'static str,
    pub axis: &'static str,
    pub points: Vec<Compared>,
}

/// u of rounding to nearest.
const ROUNDING: f64 = 0.5 * f64::EPSILON;

/// 1, 10^(−1/2), 10⁻¹ … of whole decades.
fn falling(decades: u32) -> impl Iterator<Item = f64> {
    (0..=2 * decades).map(|half| 10.0_f64.powi(-(half as i32 / 2)) * if half % 2 == 1 { 0.316 } else { 1.0 })
}

/// The larger; NaN where any is.
fn worst(errors: impl IntoIterator<Item = f64>) -> f64 {
    pd_verify::compare::largest(errors).unwrap_or(f64::NAN)
}

fn off(found: f64, exact: f64) -> f64 {
    if found == exact { 0.0 } else { ((found - exact) / exact).abs() }
}

/// ω of waves in a bar and along 20° of a plate; naively Σ 2w (1 − cos jkΔx) in the bar.
pub fn waves(subject: &dyn Subject, lattice: Lattice, decades: u32) -> Result<Sum, String> {
    const DEGREES: f64 = 20.0;
    let line: Stencil<1> = subject.bar_stencil(lattice).map_err(|lost| lost.to_string())?;
    let square: Stencil<2> = subject.plane_stencil(lattice).map_err(|lost| lost.to_string())?;
    let (bar, plane) = (BarDispersion::new(&line), PlaneDispersion::new(&square));
    let of = reference_lattice(lattice);
    let compared = |k: f64| {
        let exact = reference::lattice::bar(of, k).omega;
        let in_plane = reference::lattice::plane(of, k, DEGREES.to_radians());
        let branches = [Branch::P, Branch::S].into_iter().zip(in_plane);
        let code = branches
            .map(|(branch, exact)| off(subject.plane_wave(&plane, k, DEGREES, branch).omega, exact.omega));
        let term = |bond: &pd_verify::lattice::Bond<1>| {
            2.0 * bond.weight * (1.0 - libm::cos(f64::from(bond.offset[0]) * k))
        };
        let naive = line.bonds.iter().map(term).sum::<f64>().max(0.0).sqrt();
        Compared {
            parameter: k,
            code: worst(code.chain([off(subject.bar_wave(&bar, k).omega, exact)])),
            naive: off(naive, exact),
            unit: 1.0,
        }
    };
    Ok(Sum {
        name: "waves",
        title: "waves as k → 0",
        axis: "kΔx",
        points: falling(decades).map(compared).collect(),
    })
}

/// Forces on a small free plate under a uniform gradient; naively by the difference of roots.
pub fn stretches(subject: &dyn Subject, lattice: Lattice, decades: u32) -> Result<Sum, String> {
    const NODES: [usize; 2] = [9, 8];
    /// Over the strain: stretched, sheared and turned.
    const GRADIENT: [[f64; 2]; 2] = [[1.0, 0.5], [-0.25, 0.75]];
    let material = Material { youngs_modulus: 1.0, density: 1.0 };
    let time = Time { duration: 1.0, step: StepRule::OfLimit(1.0) };
    let bare = Scene {
        rotations: Rotations::Finite,
        ..Scene::bare(material, Body::PlaneStress, lattice, NODES, 1.0, time)
    };
    let weights = subject.plane_stencil(lattice).map_err(|lost| lost.to_string())?;
    let compared = |strain: f64| {
        let strain = 0.1 * strain;
        let gradient = GRADIENT.map(|row| row.map(|entry| strain * entry));
        let linear = |component: usize, along: usize| Initial {
            component,
            amplitude: gradient[component][along],
            shape: Shape::Linear { along },
        };
        let displacement = vec![linear(0, 0), linear(0, 1), linear(1, 0), linear(1, 1)];
        let found = subject.bond_force_plate(&Scene { displacement, ..bare.clone() })?;
        let exact = stretched_plate::forces(reference_lattice(lattice), NODES, gradient);
        let naive = by_roots(&weights, NODES, gradient);
        let size = worst(exact.iter().flatten().map(|force| force.abs()));
        let error = |forces: &[[f64; 2]], unit: f64| {
            let pairs = forces.iter().flatten().zip(exact.iter().flatten());
            worst(pairs.map(|(found, exact)| (found / unit - exact).abs() / size))
        };
        Ok(Compared {
            parameter: strain,
            code: error(&found, bare.modulus()),
            naive: error(&naive, 1.0),
            unit: 1.0,
        })
    };
    let points = falling(decades - 1).map(compared).collect::<Result<_, String>>()?;
    Ok(Sum { name: "stretch", title: "bonds hardly stretched", axis: "strain", points })
}

/// Σ w (|y| − |ξ|) y/|y| as it is written.
fn by_roots(stencil: &Stencil<2>, nodes: [usize; 2], gradient: [[f64; 2]; 2]) -> Vec<[f64; 2]> {
    let force = |node: [usize; 2]| {
        let mut sum = [0.0; 2];
        let both = stencil
            .bonds
            .iter()
            .flat_map(|bond| [(bond.offset, bond.weight), (bond.offset.map(|n| -n), bond.weight)]);
        for (offset, weight) in both {
            let far = [0, 1].map(|axis| node[axis] as i64 + i64::from(offset[axis]));
            if (0..2).all(|axis| (0..nodes[axis] as i64).contains(&far[axis])) {
                let xi = offset.map(f64::from);
                let y = [0, 1].map(|axis| xi[axis] + gradient[axis][0] * xi[0] + gradient[axis][1] * xi[1]);
                let length = (y[0] * y[0] + y[1] * y[1]).sqrt();
                let pull = weight * (length - (xi[0] * xi[0] + xi[1] * xi[1]).sqrt()) / length;
                sum = [sum[0] + pull * y[0], sum[1] + pull * y[1]];
            }
        }
        sum
    };
    (0..nodes[1]).flat_map(|j| (0..nodes[0]).map(move |i| [i, j])).map(force).collect()
}

/// c₀ of Gaussian and exponential kernels; naively by the closed forms of the Gaussian one.
pub fn kernels(subject: &dyn Subject, decades: u32) -> Sum {
    let compared = |p: f64| {
        let gaussian = Kernel::Gaussian { p };
        let errors = [gaussian, Kernel::Exponential { p }].map(|kernel| {
            let of = reference_kernel(kernel);
            let code = |body| subject.micromodulus(body, kernel, 1.0, 1.0, 1.0);
            let bar = off(code(Body::Bar), reference::micromodulus::bar(of, 1.0, 1.0, 1.0));
            let plate = reference::micromodulus::plane_stress(of, 1.0, 1.0, 1.0);
            worst([bar, off(code(Body::PlaneStress), plate)])
        });
        let of = reference_kernel(gaussian);
        let bar = 2.0 * p * p / (1.0 - libm::exp(-p * p));
        let second = (PI.sqrt() * libm::erf(p) - 2.0 * p * libm::exp(-p * p)) / (4.0 * p * p * p);
        let plate = 8.0 * (9.0 / 8.0) / (3.0 * PI * second);
        let naive = off(bar, reference::micromodulus::bar(of, 1.0, 1.0, 1.0));
        let naive = naive.max(off(plate, reference::micromodulus::plane_stress(of, 1.0, 1.0, 1.0)));
        Compared { parameter: p, code: worst(errors), naive, unit: 1.0 }
    };
    Sum {
        name: "kernels",
        title: "kernels as p → 0",
        axis: "p",
        points: falling(decades).map(compared).collect(),
    }
}

/// The strain of a bar as it is released, beside the jump at its free end; naively with cosines by recurrence.
pub fn fourier(subject: &dyn Subject, terms: usize, decades: u32) -> Sum {
    let bar = ReleasedBar { length: 1.0, speed: 1.0, strain: 1.0 };
    let compared = |distance: f64| {
        let x = 1.0 - distance;
        let exact = bar.fourier_strain_in_full(x, 0.0, terms);
        Compared {
            parameter: distance,
            code: (subject.released_strain(&bar, x, 0.0, terms) - exact).abs(),
            naive: (by_recurrence(x, terms) - exact).abs(),
            unit: 4.0 * terms as f64 * ROUNDING,
        }
    };
    let points = falling(decades).map(compared).collect();
    Sum { name: "fourier", title: "a series near its jump", axis: "distance from the jump / L", points }
}

/// cos (n + 1)φ = 2 cos φ cos nφ − cos (n − 1)φ in place of a cosine for each term.
fn by_recurrence(x: f64, terms: usize) -> f64 {
    let turn = 2.0 * libm::cos(PI * x);
    let (mut now, mut before) = (libm::cos(0.5 * PI * x), libm::cos(0.5 * PI * x));
    let mut sum = 0.0;
    for n in 0..terms {
        let sign = if n.is_multiple_of(2) { 2.0 } else { -2.0 };
        sum += sign / ((n as f64 + 0.5) * PI) * now;
        (now, before) = (turn * now - before, now);
    }
    sum
}

/// K of a field of the series itself by fits of growing length; naively by normal equations.
pub fn williams(subject: &dyn Subject, terms: usize) -> Result<Sum, String> {
    const K: [f64; 2] = [1.0, -2.0];
    const HALF: usize = 16;
    let sites = Sites { nodes: [2 * HALF; 2], spacing: 1.0, first: [0.5 - HALF as f64; 2] };
    let tip = Tip { sites, horizon: 0.0, crack: 4.0 * HALF as f64 };
    let annulus = Annulus { inner: 5.0, outer: 15.0 };
    let (elastic, plane) = (
        Elastic::new(1.0, 2.0, 1.0),
        reference::Plane { shear_modulus: 1.0, poisson_ratio: 0.25, density: 1.0 },
    );
    let field = |node: usize| singular(&plane, K, sites.place(node)).displacement;
    let u: Vec<[f64; 2]> = (0..sites.count()).map(field).collect();
    let places: Vec<[f64; 2]> = (0..sites.count())
        .map(|node| sites.place(node))
        .filter(|x| (annulus.inner..=annulus.outer).contains(&libm::hypot(x[0], x[1])))
        .collect();
    let far = |found: [f64; 2]| worst((0..2).map(|mode| off(found[mode], K[mode])));
    let compared = |terms: usize| {
        let fit = Williams::over(annulus, terms).fit(&tip, &elastic).map_err(|no| no.to_string())?;
        let code = subject.stress_intensity(&fit.reading(), &u, &[], Faces::default());
        Ok(Compared {
            parameter: fit.condition(),
            code: far(code),
            naive: far(by_normal_equations(&plane, &places, terms, K)),
            unit: 64.0 * ROUNDING * fit.condition(),
        })
    };
    let points = (1..=terms).map(compared).collect::<Result<_, String>>()?;
    Ok(Sum { name: "williams", title: "Williams' series", axis: "condition number, by terms", points })
}

/// Least squares over the same terms by AᵀA x = Aᵀu; not numbers where that cannot be factored.
fn by_normal_equations(plane: &reference::Plane, places: &[[f64; 2]], terms: usize, k: [f64; 2]) -> [f64; 2] {
    let modes = [reference::Mode::One, reference::Mode::Two];
    let term = |mode, n: i32, x| Term { mode, n }.at(plane, x).displacement;
    let mut columns: Vec<Vec<f64>> = (1..=terms as i32)
        .flat_map(|n| modes.map(|mode| places.iter().flat_map(|&x| term(mode, n, x)).collect()))
        .collect();
    columns.extend(
        [[1.0, 0.0], [0.0, 1.0]].map(|by| places.iter().flat_map(|_| translation(by).displacement).collect()),
    );
    let lengths: Vec<f64> =
        columns.iter().map(|column| column.iter().map(|u| u * u).sum::<f64>().sqrt()).collect();
    let matrix = DMatrix::from_fn(2 * places.len(), columns.len(), |row, column| {
        columns[column][row] / lengths[column]
    });
    let data = DVector::from_iterator(
        2 * places.len(),
        places.iter().flat_map(|&x| singular(plane, k, x).displacement),
    );
    let factored = (matrix.transpose() * &matrix).cholesky();
    let solved = factored.map(|factored| factored.solve(&(matrix.transpose() * data)));
    solved.map_or([f64::NAN; 2], |x| [0, 1].map(|mode| x[mode] / lengths[mode]))
}
