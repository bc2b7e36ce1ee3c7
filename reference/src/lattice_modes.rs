//! The exact motion of a lattice bar held at the left end and free at the right, from any initial displacement.
//!
//! Nodes j = 0 … N−1 stand at cell centres x = (j + ½)Δx, L = NΔx. With u odd about x = 0 and even about x = L the bar is
//! a piece of the infinite lattice: it moves in the modes sin(κ(j + ½)), κ = (2n+1)π/2N, each with the frequency of the
//! infinite lattice, and no end is approximated. The modes are orthogonal over the nodes, Σ_j sin² = N/2, so that
//! u_j(t) = Σ_n a_n sin(κ_n(j + ½)) cos ω_n t, a_n = (2/N) Σ_j u_j(0) sin(κ_n(j + ½)), for a bar that starts at rest.
//!
//! Every angle is a multiple of π/4N: the sines come from one table, without loss at large arguments.

use crate::bonds::Lattice;
use crate::{lattice, leapfrog};
use std::f64::consts::PI;

/// A bar of N nodes. Displacements have the unit of the initial ones, strains that unit over L; times are vt/Δx.
#[derive(Clone, Debug, PartialEq)]
pub struct LatticeModes {
    /// a_n, N of them.
    amplitudes: Vec<f64>,
    /// ω_nΔx/v, N of them.
    frequencies: Vec<f64>,
    /// sin(πq/4N) for q = 0 … 8N − 1.
    sines: Vec<f64>,
}

impl LatticeModes {
    /// The bar stretched to ε₀ and let go ([`crate::released_bar`]): u over ε₀L is x/L, so strains come over ε₀. In
    /// exact time, or marched by leapfrog at `courant` = vΔt/Δx. None where leapfrog is unstable.
    pub fn new(of: Lattice, nodes: usize, courant: Option<f64>) -> Option<Self> {
        Self::of_displacement(of, nodes, courant, |j| (j as f64 + 0.5) / nodes as f64)
    }

    /// The bar at rest with displacement `initial(j)` of node j. In exact time, or marched by leapfrog at `courant` =
    /// vΔt/Δx, whose first step from rest is half a step's acceleration: then times are multiples of `courant`. None
    /// where leapfrog is unstable. Good to about 1e-15 N times the largest displacement.
    pub fn of_displacement(
        of: Lattice,
        nodes: usize,
        courant: Option<f64>,
        initial: impl Fn(usize) -> f64,
    ) -> Option<Self> {
        let frequency = |n: usize| {
            let wave = lattice::bar(of, (2 * n + 1) as f64 * PI / (2 * nodes) as f64);
            courant.map_or(Some(wave), |courant| leapfrog::wave(wave, courant)).map(|wave| wave.omega)
        };
        let frequencies = (0..nodes).map(frequency).collect::<Option<Vec<f64>>>()?;
        let mut bar = Self { amplitudes: Vec::new(), frequencies, sines: sines(nodes) };
        let start: Vec<f64> = (0..nodes).map(initial).collect();
        // The sum over j for a mode n has the form of the sum over n for a node j: (2j + 1)(2n + 1) is symmetric.
        let amplitude = |n: usize| bar.steps(2 * n + 1, 0).zip(&start).map(|(sine, u)| sine * u).sum::<f64>();
        bar.amplitudes = (0..nodes).map(|n| 2.0 / nodes as f64 * amplitude(n)).collect();
        Some(bar)
    }

    /// Where the bar would rest under a load of `load(j)` E/Δx² per volume on node j, as the start of a motion without it:
    /// put on at t = 0 and kept, the load moves the bar from rest to these displacements at t = 0 less those at t. As
    /// [`Self::of_displacement`] otherwise.
    pub fn of_steady_load(
        of: Lattice,
        nodes: usize,
        courant: Option<f64>,
        load: impl Fn(usize) -> f64,
    ) -> Option<Self> {
        Some(Self::of_displacement(of, nodes, courant, load)?.scaled(of, |square| 1.0 / square))
    }

    /// Half of how far a load may drive the bar that changes its sign with every step, `load(j)` E/Δx² on node j in steps of
    /// even number: each mode by a = −C²f/(4 − C²ω²), C = `courant`, ω that of exact time. With m(n) the motion that starts
    /// from there, the load moves the bar from rest to (−1)ⁿ m(0) − m(n): put into leapfrog, the first term takes the load, and both
    /// leave rest with half a step's acceleration. As [`Self::of_displacement`] otherwise.
    pub fn of_alternating_load(
        of: Lattice,
        nodes: usize,
        courant: f64,
        load: impl Fn(usize) -> f64,
    ) -> Option<Self> {
        let bar = Self::of_displacement(of, nodes, Some(courant), load)?;
        let square = courant * courant;
        Some(bar.scaled(of, |omega_square| -square / (4.0 - square * omega_square)))
    }

    /// Every amplitude times a function of ω², over (v/Δx)², of its mode in exact time.
    fn scaled(mut self, of: Lattice, factor: impl Fn(f64) -> f64) -> Self {
        let nodes = self.amplitudes.len();
        for (n, amplitude) in self.amplitudes.iter_mut().enumerate() {
            let omega = lattice::bar(of, (2 * n + 1) as f64 * PI / (2 * nodes) as f64).omega;
            *amplitude *= factor(omega * omega);
        }
        self
    }

    /// Σ|a_n|: what no displacement ever exceeds.
    pub fn most(&self) -> f64 {
        self.amplitudes.iter().map(|a| a.abs()).sum()
    }

    /// Displacement of node j = 0 … N−1 at `time` = vt/Δx.
    pub fn displacement(&self, j: usize, time: f64) -> f64 {
        self.at(&self.displacement_shape(j), time)
    }

    /// N(u_j − u_{j−1}) at `time` = vt/Δx: the strain half-way between two nodes, j = 1 … N−1.
    pub fn strain(&self, j: usize, time: f64) -> f64 {
        self.at(&self.strain_shape(j), time)
    }

    /// Displacement of node j at each of the times vt/Δx.
    pub fn displacement_history(&self, j: usize, times: &[f64]) -> Vec<f64> {
        let shape = self.displacement_shape(j);
        times.iter().map(|&time| self.at(&shape, time)).collect()
    }

    /// The strain half-way between nodes j − 1 and j at each of the times vt/Δx.
    pub fn strain_history(&self, j: usize, times: &[f64]) -> Vec<f64> {
        let shape = self.strain_shape(j);
        times.iter().map(|&time| self.at(&shape, time)).collect()
    }

    /// Displacements of all N nodes at `time` = vt/Δx.
    pub fn displacements(&self, time: f64) -> Vec<f64> {
        let turned = self.turned(time);
        let at = |j: usize| self.steps(2 * j + 1, 0).zip(&turned).map(|(sine, a)| sine * a).sum();
        (0..turned.len()).map(at).collect()
    }

    /// The N − 1 strains half-way between nodes at `time` = vt/Δx; the first stands between nodes 0 and 1.
    pub fn strains(&self, time: f64) -> Vec<f64> {
        let nodes = self.amplitudes.len();
        let slopes = self.steps(1, 0).map(|sine| 2.0 * nodes as f64 * sine);
        let turned: Vec<f64> = slopes.zip(self.turned(time)).map(|(slope, a)| slope * a).collect();
        let at = |j: usize| self.steps(2 * j, 2 * nodes).zip(&turned).map(|(cosine, a)| cosine * a).sum();
        (1..nodes).map(at).collect()
    }

    /// What each mode gives node j at its largest.
    fn displacement_shape(&self, j: usize) -> Vec<f64> {
        self.steps(2 * j + 1, 0).zip(&self.amplitudes).map(|(sine, a)| sine * a).collect()
    }

    /// What each mode gives the strain before node j: sin κ(j + ½) − sin κ(j − ½) = 2 cos κj sin κ/2.
    fn strain_shape(&self, j: usize) -> Vec<f64> {
        let nodes = self.amplitudes.len();
        let slopes = self.steps(2 * j, 2 * nodes).zip(self.steps(1, 0));
        let twice = 2.0 * nodes as f64;
        slopes.zip(&self.amplitudes).map(|((cosine, sine), a)| twice * cosine * sine * a).collect()
    }

    /// a_n cos ω_n t.
    fn turned(&self, time: f64) -> Vec<f64> {
        let modes = self.amplitudes.iter().zip(&self.frequencies);
        modes.map(|(a, omega)| a * libm::cos(omega * time)).collect()
    }

    fn at(&self, shape: &[f64], time: f64) -> f64 {
        shape.iter().zip(&self.frequencies).map(|(a, omega)| a * libm::cos(omega * time)).sum()
    }

    /// sin(π((2n + 1)`factor` + `shift`)/4N) for n = 0 … N−1.
    fn steps(&self, factor: usize, shift: usize) -> impl Iterator<Item = f64> {
        let turn = self.sines.len();
        let (mut at, step) = ((factor + shift) % turn, 2 * factor % turn);
        (0..turn / 8).map(move |_| {
            let sine = self.sines[at];
            at += step;
            at -= if at >= turn { turn } else { 0 };
            sine
        })
    }
}

/// sin(πq/4N) for q = 0 … 8N − 1, from angles up to π/4.
fn sines(nodes: usize) -> Vec<f64> {
    let angle = |q: usize| PI * q as f64 / (4 * nodes) as f64;
    let quarter = |q: usize| if q <= nodes { libm::sin(angle(q)) } else { libm::cos(angle(2 * nodes - q)) };
    let half = |q: usize| quarter(q.min(4 * nodes - q));
    (0..8 * nodes).map(|q| if q < 4 * nodes { half(q) } else { -half(q - 4 * nodes) }).collect()
}
