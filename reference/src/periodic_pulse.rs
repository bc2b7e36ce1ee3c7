//! A Gaussian pulse let go from rest in a periodic box or ring, carried by any medium.
//!
//! u_x(x, 0) = exp(−a|x − x₀|²) and its images at every period, u_y = 0, u̇ = 0. Each wave of the box, k = 2π(n/L_x, m/L_y),
//! turns on its own: u = Σ û(k) cos(√M(k) ct) e_x e^{ik·(x − x₀)}, û = (π/(a L_x L_y)) e^{−|k|²/4a}. M_xx is even in kx and
//! in ky, M_xy odd in both: cosines carry u_x, sines −u_y.
//!
//! A lattice holds samples at its nodes, the cell centres (i + ½)Δx of cells that fill the box from x = 0. A wave and its
//! aliases k + 2πj/Δx are the same samples, so their coefficients add up with the phases e^{2πijs}, sΔx the place of the
//! first node from x₀: what remains is the discrete Fourier series of the samples, exact, one term for each wave of the
//! first Brillouin zone. Waves whose coefficient is below 1e-17 of the largest are left out.

use crate::clock::Clock;
use crate::medium::{Medium, PlaneWave};
use std::f64::consts::{PI, TAU};

/// Coefficients below this share of the largest are left out.
const NEGLIGIBLE: f64 = 1e-17;
/// −ln of it, with room for the sum of all that is left out.
const LARGEST_EXPONENT: f64 = 45.0;

/// A Gaussian along one side of the box: the part û e^{ik(x − x₀)} of wave n and of −n together.
struct Harmonic {
    k: f64,
    /// û, with the factor 2 for ±n; complex (real, imaginary) on a lattice.
    coefficient: [f64; 2],
}

impl Harmonic {
    fn size(&self) -> f64 {
        libm::hypot(self.coefficient[0], self.coefficient[1])
    }

    /// Real and imaginary part of û e^{ik`distance`}.
    fn at(&self, distance: f64) -> [f64; 2] {
        let ([re, im], (sine, cosine)) = (self.coefficient, libm::sincos(self.k * distance));
        [re * cosine - im * sine, re * sine + im * cosine]
    }
}

/// The Fourier series of exp(−a(x − x₀)²) and its images at the period `length`; of its samples at cell centres if
/// there is a spacing. None where cells do not fill the period, or a quantity is not positive and finite.
fn series(sharpness: f64, centre: f64, length: f64, spacing: Option<f64>) -> Option<Vec<Harmonic>> {
    let sound = [sharpness, length].iter().all(|q| *q > 0.0 && q.is_finite()) && centre.is_finite();
    if !sound {
        return None;
    }
    let largest_k = (4.0 * sharpness * LARGEST_EXPONENT).sqrt();
    let all = (largest_k * length / TAU).floor() as usize;
    let gauss = |k: f64| (PI / sharpness).sqrt() / length * libm::exp(-k * k / (4.0 * sharpness));
    let wave = |n: usize| TAU * n as f64 / length;
    let twice = |n: usize| if n == 0 { 1.0 } else { 2.0 };
    let Some(spacing) = spacing else {
        let harmonic = |n| Harmonic { k: wave(n), coefficient: [twice(n) * gauss(wave(n)), 0.0] };
        return Some((0..=all).map(harmonic).collect());
    };
    let cells = cells_in(length, spacing)?;
    let zone = TAU / spacing;
    let aliases = (largest_k / zone + 0.5).ceil() as i64;
    let first_node = 0.5 - centre / spacing;
    let harmonic = |n: usize| {
        let sum = (-aliases..=aliases).fold([0.0; 2], |[re, im], j| {
            let (sine, cosine) = libm::sincos(TAU * (j as f64 * first_node).rem_euclid(1.0));
            let size = gauss(wave(n) + j as f64 * zone);
            [re + size * cosine, im + size * sine]
        });
        // The shortest wave is its own mirror.
        let pair = if 2 * n == cells { 1.0 } else { twice(n) };
        Harmonic { k: wave(n), coefficient: sum.map(|part| pair * part) }
    };
    Some((0..=all.min(cells / 2)).map(harmonic).collect())
}

/// How many cells fill `length`; None unless a whole number does.
fn cells_in(length: f64, spacing: f64) -> Option<usize> {
    let cells = (length / spacing).round();
    let fits = cells >= 1.0 && (cells * spacing - length).abs() <= 1e-9 * length;
    fits.then_some(cells as usize)
}

impl Medium {
    fn spacing(&self) -> Option<f64> {
        match self {
            Self::Lattice { spacing, .. } => Some(*spacing),
            _ => None,
        }
    }
}

/// A pulse of the x displacement in a periodic box. Lengths as in the medium; c = √(C11/ρ).
pub struct PeriodicPulse {
    centre: [f64; 2],
    along_x: Vec<Harmonic>,
    along_y: Vec<Harmonic>,
    /// The two waves of each (n, m), n the faster: ω/c and e_x e; nothing where the coefficient is negligible.
    waves: Vec<Option<[PlaneWave; 2]>>,
}

impl PeriodicPulse {
    /// exp(−`sharpness` |x − `centre`|²) and its images in a box with these `sides`. None where a side or the sharpness
    /// is not positive, where the lattice's cells do not fill the box, and where the medium has no answer
    /// ([`Medium::plane_waves`]). The nonlocal continuum takes about a millisecond for each length of wave.
    pub fn new(medium: Medium, sharpness: f64, centre: [f64; 2], sides: [f64; 2]) -> Option<Self> {
        let along_x = series(sharpness, centre[0], sides[0], medium.spacing())?;
        let along_y = series(sharpness, centre[1], sides[1], medium.spacing())?;
        let largest = |side: &[Harmonic]| side.iter().map(Harmonic::size).fold(0.0, f64::max);
        let least = NEGLIGIBLE * largest(&along_x) * largest(&along_y);
        let modes = along_y.iter().flat_map(|y| along_x.iter().map(move |x| (x, y)));
        let counts: Vec<bool> = modes.clone().map(|(x, y)| x.size() * y.size() >= least).collect();
        let wanted: Vec<[f64; 2]> =
            modes.zip(&counts).filter(|(_, counts)| **counts).map(|((x, y), _)| [x.k, y.k]).collect();
        let mut found = medium.many_plane_waves(&wanted)?.into_iter();
        let part = |(omega, e): PlaneWave| (omega, [e[0] * e[0], e[0] * e[1]]);
        let waves = counts.iter().map(|&counts| if counts { found.next() } else { None });
        let waves = waves.map(|pair| pair.map(|pair| pair.map(part))).collect();
        Some(Self { centre, along_x, along_y, waves })
    }

    /// u_x and u_y at the points (x, y) of a grid, row by row along x, at c times the time. On a lattice the values at
    /// nodes; between them a trigonometric interpolation. Good to some 1e-15 (1 + ωt) of the pulse's height, ω the
    /// frequency of its waves.
    pub fn fields(&self, xs: &[f64], ys: &[f64], ct: f64) -> Option<[Vec<f64>; 2]> {
        self.at(xs, ys, Clock::Exact(ct))
    }

    /// The same after `steps` of leapfrog, `c_dt` = cΔt, the first half a step's acceleration. None above its limit.
    pub fn fields_after(&self, xs: &[f64], ys: &[f64], steps: u64, c_dt: f64) -> Option<[Vec<f64>; 2]> {
        self.at(xs, ys, Clock::Leapfrog(steps, c_dt))
    }

    fn at(&self, xs: &[f64], ys: &[f64], clock: Clock) -> Option<[Vec<f64>; 2]> {
        let turned = self.waves.iter().map(|waves| turned(waves.as_ref(), clock));
        let turned = turned.collect::<Option<Vec<[f64; 2]>>>()?;
        // One row for each harmonic along x or y, one entry for each place.
        let rows = |side: &[Harmonic], places: &[f64], centre: f64| -> Vec<Vec<[f64; 2]>> {
            side.iter().map(|wave| places.iter().map(|place| wave.at(place - centre)).collect()).collect()
        };
        let (in_x, in_y) = (rows(&self.along_x, xs, self.centre[0]), rows(&self.along_y, ys, self.centre[1]));
        let component = |part: usize, sign: f64| {
            let sums: Vec<Vec<f64>> = turned
                .chunks(in_x.len())
                .map(|row| {
                    let mut sum = vec![0.0; xs.len()];
                    for (factors, shape) in row.iter().zip(&in_x) {
                        add(&mut sum, sign * factors[part], shape.iter().map(|both| both[part]));
                    }
                    sum
                })
                .collect();
            let mut field = Vec::with_capacity(xs.len() * ys.len());
            for row in 0..ys.len() {
                let mut sum = vec![0.0; xs.len()];
                for (shape, along) in in_y.iter().zip(&sums) {
                    add(&mut sum, shape[row][part], along.iter().copied());
                }
                field.extend(sum);
            }
            field
        };
        Some([component(0, 1.0), component(1, -1.0)])
    }
}

/// The column e_x of cos(√M ct).
fn turned(waves: Option<&[PlaneWave; 2]>, clock: Clock) -> Option<[f64; 2]> {
    let mut sum = [0.0; 2];
    for (omega, part) in waves.into_iter().flatten() {
        let cosine = clock.cosine(*omega)?;
        sum = [sum[0] + cosine * part[0], sum[1] + cosine * part[1]];
    }
    Some(sum)
}

/// sum += factor · terms.
fn add(sum: &mut [f64], factor: f64, terms: impl Iterator<Item = f64>) {
    for (sum, term) in sum.iter_mut().zip(terms) {
        *sum += factor * term;
    }
}

/// A pulse in a ring: a bar that closes on itself. Lengths as in the medium; c = √(E/ρ).
pub struct RingPulse {
    centre: f64,
    /// Each wave with its ω/c.
    waves: Vec<(Harmonic, f64)>,
}

impl RingPulse {
    /// exp(−`sharpness` (x − `centre`)²) and its images in a ring of this `length`. None as in [`PeriodicPulse::new`].
    pub fn new(medium: Medium, sharpness: f64, centre: f64, length: f64) -> Option<Self> {
        let harmonics = series(sharpness, centre, length, medium.spacing())?;
        let waves: Vec<f64> = harmonics.iter().map(|wave| wave.k).collect();
        let squares = medium.bar_squares(&waves)?;
        let stable = squares.iter().all(|square| *square >= 0.0);
        let turning = harmonics.into_iter().zip(squares.into_iter().map(f64::sqrt));
        stable.then(|| Self { centre, waves: turning.collect() })
    }

    /// u at each x, at c times the time; on a lattice at the nodes.
    pub fn displacements(&self, xs: &[f64], ct: f64) -> Option<Vec<f64>> {
        self.at(xs, Clock::Exact(ct))
    }

    /// The same after `steps` of leapfrog, `c_dt` = cΔt. None above its limit.
    pub fn displacements_after(&self, xs: &[f64], steps: u64, c_dt: f64) -> Option<Vec<f64>> {
        self.at(xs, Clock::Leapfrog(steps, c_dt))
    }

    fn at(&self, xs: &[f64], clock: Clock) -> Option<Vec<f64>> {
        let cosines =
            self.waves.iter().map(|(_, omega)| clock.cosine(*omega)).collect::<Option<Vec<f64>>>()?;
        let at = |x: &f64| {
            let parts = self.waves.iter().zip(&cosines);
            parts.map(|((wave, _), cosine)| wave.at(x - self.centre)[0] * cosine).sum()
        };
        Some(xs.iter().map(at).collect())
    }
}
