//! The fastest mode of a linear body: the largest eigenvalue ω² of its force operator K/ρ, by Lanczos; no matrix is built.
//!
//! Leapfrog on this body is stable up to Δt = 2/ω and beyond it grows in this mode: u(n+1) − (2 − ω²Δt²) u(n) + u(n−1) = 0
//! has the roots −e^{±φ}, cosh(φ/2) = ωΔt/2. A body of positive weights is slower than its lattice, since a field that is
//! zero outside the body is a field of the lattice; corrected surfaces and negative weights do not keep to that.

use crate::breaking::Broken;
use crate::field::Window;
use crate::forces::{Class, Now};
use crate::march::{March, initial};
use crate::model::{Inertia, Model};
use crate::scene::{Scene, Wrong};
use thiserror::Error;

/// The fastest mode that a start contains.
#[derive(Debug, Clone, PartialEq)]
pub struct Fastest<const D: usize> {
    /// In 1/s.
    pub omega: f64,
    /// Of the next slower mode in 1/s, as far as the iterations know it: from below, and 0 where there is none.
    pub next_omega: f64,
    /// Displacements of the nodes that there are, row by row; the sum of their squares is 1.
    pub mode: Vec<[f64; D]>,
    /// ‖Kv/ρ − ω²v‖/ω², as the recurrence says: ω is off by about half its square over the gap to the next mode.
    pub residual: f64,
    pub iterations: usize,
}

impl<const D: usize> Fastest<D> {
    /// 2/ω in s: the largest stable time step of leapfrog on this body.
    pub fn stable_time_step(&self) -> f64 {
        2.0 / self.omega
    }
}

/// Why no mode is known.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NoMode {
    /// The scene cannot be made a model.
    #[error("{}", .0.message)]
    Wrong(Wrong),
    /// The exact law.
    #[error("finite rotations are not linear: they have no modes")]
    NotLinear,
    /// Nothing from which to start.
    #[error("the displacement at t = 0 is zero: no mode is contained in it")]
    NoStart,
    /// Too many iterations.
    #[error("no mode after {iterations} iterations: {residual:e} of the force is left")]
    NotConverged { iterations: usize, residual: f64 },
}

/// Iterations, at most, and from one look at the residual to the next.
const MOST: usize = 3000;
const LOOKS: usize = 10;
/// Of the residual; rounding leaves some 1e-15.
const TOLERANCE: f64 = 1e-12;

/// How far a mode is sought: iterations at most, and what is left of the residual.
#[derive(Debug, Clone, Copy)]
struct Effort {
    most: usize,
    tolerance: f64,
}

/// Of a motion four digits are enough to say what step it bears, and differences of forces have no more than nine.
const ROUGHLY: f64 = 1e-6;
/// Iterations for these, and numbers that all vectors together may hold.
const FEW: usize = 300;
const HELD: usize = 20_000_000;
/// Of a spacing: the displacements by which a body of finite rotations is asked how stiff it is.
const NUDGE: f64 = 1e-6;

/// The fastest mode that the scene's displacement at t = 0 contains. Among modes of one frequency it is the part of them that
/// the start contains, so that a march from there grows in it. Loads do not act; driven nodes are held.
pub fn fastest<const D: usize>(scene: &Scene<D>) -> Result<Fastest<D>, NoMode> {
    let model = Model::new(scene).map_err(NoMode::Wrong)?;
    if !model.linear {
        return Err(NoMode::NotLinear);
    }
    let body = Packed::new(&model, Broken::none(), None);
    let start = initial(&model.grid, &scene.displacement, 1.0);
    lanczos(&body, body.pack(&start), Effort { most: MOST, tolerance: TOLERANCE })
}

/// The fastest mode that the step done last contains, to some digits, with the bonds that are there now; of a body with
/// finite rotations about the displacement `at`.
pub fn fastest_of_motion<const D: usize>(march: &March<'_, D>, at: &[f64]) -> Result<Fastest<D>, NoMode> {
    let model = march.model();
    let body = Packed::new(model, march.broken(), (!model.linear).then_some(at));
    let size = march.increment().iter().fold(0.0_f64, |most, d| most.max(d.abs()));
    let start: Vec<f64> = body.pack(march.increment()).iter().map(|d| d / size).collect();
    let most = FEW.min(HELD / start.len().max(1));
    lanczos(&body, start, Effort { most, tolerance: ROUGHLY })
}

/// A body's components as one vector, and what its forces do to it.
struct Packed<'m, const D: usize> {
    model: &'m Model<D>,
    density: f64,
    broken: &'m Broken,
    /// About which it moves, where it is not linear.
    at: Option<&'m [f64]>,
    /// Of all free components, node by node, and of those that are driven.
    places: Vec<usize>,
    held: Vec<bool>,
}

impl<'m, const D: usize> Packed<'m, D> {
    fn new(model: &'m Model<D>, broken: &'m Broken, at: Option<&'m [f64]>) -> Self {
        let grid = &model.grid;
        let of = |node| (0..D).map(move |axis| grid.place(node) + axis * grid.stride());
        let places: Vec<usize> = grid.each().flat_map(of).collect();
        let mut driven: Vec<usize> =
            model.constraints.iter().flat_map(|constraint| constraint.places()).copied().collect();
        driven.sort_unstable();
        let held = places.iter().map(|place| driven.binary_search(place).is_ok()).collect();
        let density = match &model.inertia {
            Inertia::Uniform(density) => *density,
            // Of no scene's body; with the smallest density the mode is no slower than it is.
            Inertia::Diagonal(densities) => {
                places.iter().map(|&place| densities[place]).fold(f64::INFINITY, f64::min)
            }
        };
        Self { model, density, broken, at, places, held }
    }

    /// Values at the places, zero where they are held.
    fn pack(&self, field: &[f64]) -> Vec<f64> {
        let at = self.places.iter().zip(&self.held);
        at.map(|(&place, &held)| if held { 0.0 } else { field[place] }).collect()
    }

    /// Kv/ρ, or where the body is not linear its difference quotient.
    fn times(&self, vector: &[f64]) -> Vec<f64> {
        let Some(at) = self.at else { return self.pull(None, vector, 1.0) };
        let nudge =
            NUDGE * self.model.grid.spacing / vector.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let [ahead, behind] = [nudge, -nudge].map(|by| self.pull(Some(at), vector, by));
        ahead.iter().zip(behind).map(|(ahead, behind)| (ahead - behind) / (2.0 * nudge)).collect()
    }

    /// −F/ρ at a displacement, moved by a vector.
    fn pull(&self, from: Option<&[f64]>, vector: &[f64], by: f64) -> Vec<f64> {
        let (mut displacement, mut force) = (self.model.grid.field(), self.model.grid.field());
        if let Some(from) = from {
            displacement.copy_from_slice(from);
        }
        self.places.iter().zip(vector).for_each(|(&place, &x)| displacement[place] += by * x);
        self.model.fill_ghosts(&mut displacement);
        let now = Now {
            displacement: Window::from(&displacement),
            increment: Window::NONE,
            time: 0.0,
            time_step: f64::NAN,
            broken: self.broken,
        };
        self.model.add_forces(self.model.of_class(Class::Internal), &now, &mut force);
        self.pack(&force).iter().map(|f| f / -self.density).collect()
    }
}

/// The largest eigenvalue and its vector; every vector is made orthogonal to all before it, twice.
fn lanczos<const D: usize>(
    body: &Packed<'_, D>,
    mut start: Vec<f64>,
    effort: Effort,
) -> Result<Fastest<D>, NoMode> {
    let length = norm(&start);
    if !(length > 0.0 && length.is_finite()) {
        return Err(NoMode::NoStart);
    }
    start.iter_mut().for_each(|x| *x /= length);
    let most = start.len().min(effort.most);
    if most == 0 {
        return Err(NoMode::NotConverged { iterations: 0, residual: f64::NAN });
    }
    let (mut basis, mut diagonal, mut beside) = (vec![start], Vec::new(), Vec::new());
    loop {
        let last = &basis[basis.len() - 1];
        let mut next = body.times(last);
        diagonal.push(dot(last, &next));
        for _ in 0..2 {
            for vector in &basis {
                let share = dot(vector, &next);
                next.iter_mut().zip(vector).for_each(|(x, v)| *x -= share * v);
            }
        }
        let (length, iterations) = (norm(&next), basis.len());
        if iterations % LOOKS == 0 || iterations == most || length == 0.0 {
            let square = eigenvalue(&diagonal, &beside, 1);
            let weights = vector(&diagonal, &beside, square);
            let residual = length * weights[iterations - 1].abs() / square;
            if residual <= effort.tolerance {
                let next_square = eigenvalue(&diagonal, &beside, 2);
                return Ok(combined(&basis, &weights, [square, next_square], residual));
            }
            if iterations == most || !residual.is_finite() {
                return Err(NoMode::NotConverged { iterations, residual });
            }
        }
        next.iter_mut().for_each(|x| *x /= length);
        beside.push(length);
        basis.push(next);
    }
}

fn combined<const D: usize>(
    basis: &[Vec<f64>],
    weights: &[f64],
    squares: [f64; 2],
    residual: f64,
) -> Fastest<D> {
    let mut vector = vec![0.0; basis[0].len()];
    for (one, weight) in basis.iter().zip(weights) {
        vector.iter_mut().zip(one).for_each(|(x, v)| *x += weight * v);
    }
    let length = norm(&vector);
    let nodes = vector.chunks_exact(D);
    let mode = nodes.map(|node| std::array::from_fn(|axis| node[axis] / length)).collect();
    // What has no second eigenvalue ends at the lower end of the search, which is negative.
    let [omega, next_omega] = squares.map(|square| if square > 0.0 { square.sqrt() } else { 0.0 });
    Fastest { omega, next_omega, mode, residual, iterations: basis.len() }
}

/// Pivots of x − T of a symmetric tridiagonal matrix T: as many are negative as eigenvalues lie above x.
fn pivots(diagonal: &[f64], beside: &[f64], x: f64) -> Vec<f64> {
    let mut last = f64::INFINITY;
    let pivot = |(row, d): (usize, &f64)| {
        let off = if row == 0 { 0.0 } else { beside[row - 1] };
        last = x - d - off * off / last;
        last
    };
    diagonal.iter().enumerate().map(pivot).collect()
}

/// The largest eigenvalue of a symmetric tridiagonal matrix, or the second largest and so on, by bisection, from above.
fn eigenvalue(diagonal: &[f64], beside: &[f64], rank: usize) -> f64 {
    let off = |row: Option<usize>| row.and_then(|row| beside.get(row)).copied().unwrap_or(0.0);
    let size = |row: usize| diagonal[row].abs() + off(row.checked_sub(1)) + off(Some(row));
    let mut high = (0..diagonal.len()).map(size).fold(0.0, f64::max) * (1.0 + 1e-12);
    let mut low = -high;
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return high;
        }
        let above = pivots(diagonal, beside, middle).iter().filter(|pivot| **pivot <= 0.0).count();
        if above < rank { high = middle } else { low = middle }
    }
}

/// The vector of length 1 to the largest eigenvalue, by inverse iteration just above it.
fn vector(diagonal: &[f64], beside: &[f64], largest: f64) -> Vec<f64> {
    let pivots = pivots(diagonal, beside, largest);
    let mut vector = vec![1.0; diagonal.len()];
    for _ in 0..3 {
        for row in 1..vector.len() {
            vector[row] += beside[row - 1] / pivots[row - 1] * vector[row - 1];
        }
        vector.iter_mut().zip(&pivots).for_each(|(x, pivot)| *x /= pivot);
        for row in (1..vector.len()).rev() {
            vector[row - 1] += beside[row - 1] / pivots[row - 1] * vector[row];
        }
        // Scaled first: what the first solution has grown by may have no square.
        let largest = vector.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        vector.iter_mut().for_each(|x| *x /= largest);
        let length = norm(&vector);
        vector.iter_mut().for_each(|x| *x /= length);
    }
    vector
}

/// In order, whatever the threads do.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}
