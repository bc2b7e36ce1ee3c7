//! A rectangle with a central crack along its middle line, in tension or shear at rest: its stress intensity factor.
//!
//! Stresses that leave both faces of a crack |x| < a free of traction and have the rectangle's symmetries are
//! Φ = m(g/s + p), Ω = m(g/s − p), s = √(z² − a²), with real polynomials g (odd) and p (even); m = 1 in mode I and −i in
//! mode II, σ_yy − iσ_xy = Φ(z) + Ω(z̄) + (z − z̄)Φ̄', σ_xx + σ_yy = 4 Re Φ (Muskhelishvili (1963), 120 and 124). They are
//! fitted by least squares to the tractions on the outer edges, the polynomials in a basis orthogonal on the edges'
//! points (Brubeck, Nakatsukasa and Trefethen, SIAM Rev. 63 (2021) 405). K = 2m̄√(π/a) g(a).
//!
//! Checked: strips of 2a/W = 0.2, 0.5, 0.8 against Isida's 1.0246, 1.1867, 1.8160 (Int. J. Fract. Mech. 7 (1971) 301);
//! square 10 : 50 mm, finite elements Y = 1.0554 ± 0.0005; 104 × 40 mm, 2a = 24 mm in pure shear, finite elements 1.1806.

use crate::complex::Complex;
use crate::elastic::Mode;
use crate::least_squares;

/// A rectangle with a crack along x in its middle. Lengths in any one unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrackedRectangle {
    /// a.
    pub half_crack: f64,
    /// Half the length along the crack.
    pub half_width: f64,
    /// Half the length across the crack.
    pub half_height: f64,
}

/// A number and how good it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its difference to what three quarters of the polynomials give.
    pub error: f64,
}

/// Polynomials in each of g and p.
const TERMS: usize = 80;

impl CrackedRectangle {
    /// Y = K/(σ√(πa)): mode I, σ_yy = σ on the two edges along the crack, the others free; mode II, σ_xy = σ on all four.
    /// About 10⁻⁹ for cracks up to half the width and heights up to 2.5 widths, 10⁻⁴ up to 0.8 of the width. None where
    /// the estimated error is above 10⁻³ (cracks nearly to the edge, long strips), or a length is not positive.
    pub fn shape_factor(&self, mode: Mode) -> Option<Estimate> {
        let [w, h] = [self.half_width, self.half_height].map(|length| length / self.half_crack);
        if !(w > 1.0 && w.is_finite() && h > 0.0 && h.is_finite() && self.half_crack > 0.0) {
            return None;
        }
        let [fewer, value] = [TERMS * 3 / 4, TERMS].map(|terms| solve(w, h, mode, terms));
        let error = (value - fewer).abs();
        (error < 1e-3).then_some(Estimate { value, error })
    }
}

/// Points on the right and then the top edge of a quarter, denser towards the corner, each with √(its share).
fn edges(w: f64, h: f64, count: usize) -> Vec<(Complex, f64)> {
    let places = (0..count).map(|i| {
        let (sin, cos) = libm::sincos(std::f64::consts::FRAC_PI_2 * (i as f64 + 0.5) / count as f64);
        (sin, cos.sqrt())
    });
    let right = places.clone().map(|(x, share)| (Complex::new(w, h * x), share * h.sqrt()));
    let top = places.map(|(x, share)| (Complex::new(w * x, h), share * w.sqrt()));
    right.chain(top).collect()
}

/// Y for a = 1.
fn solve(w: f64, h: f64, mode: Mode, terms: usize) -> f64 {
    let count = 2 * terms;
    let points = edges(w, h, count);
    let zeta: Vec<Complex> = points.iter().map(|(z, _)| *z * *z).chain([Complex::new(1.0, 0.0)]).collect();
    let basis = polynomials(&zeta, 2 * count, terms);
    let tip: Vec<f64> = basis.iter().map(|of| of[2 * count].0.re).collect();
    // Rows: the normal, then the shear traction at each point. In mode II the constant of p only turns the body.
    let first = usize::from(mode == Mode::Two);
    let columns: Vec<Vec<f64>> = (0..terms)
        .map(|j| (j, true))
        .chain((first..terms).map(|j| (j, false)))
        .map(|(j, singular)| {
            let tractions = |i: usize| {
                let (z, share) = points[i];
                let [xx, yy, xy] = stress(mode, z, potential(z, basis[j][i], singular), singular);
                [if i < count { xx } else { yy }, xy].map(|traction| traction * share)
            };
            (0..2 * count).flat_map(tractions).collect()
        })
        .collect();
    let wanted: Vec<f64> = (0..2 * count)
        .flat_map(|i| {
            let share = points[i].1;
            match mode {
                Mode::One => [if i < count { 0.0 } else { share }, 0.0],
                Mode::Two => [0.0, share],
            }
        })
        .collect();
    let found = least_squares::solve(columns, wanted);
    2.0 * found.iter().zip(&tip).map(|(factor, value)| factor * value).sum::<f64>()
}

/// Polynomials in ζ and their derivatives at `zeta`, orthonormal over its first `over` points (real inner product, so
/// that coefficients stay real), orthogonalised twice.
fn polynomials(zeta: &[Complex], over: usize, terms: usize) -> Vec<Vec<(Complex, Complex)>> {
    let mean = |a: &[(Complex, Complex)], b: &[(Complex, Complex)]| {
        let products = a.iter().zip(b).take(over);
        products.map(|((a, _), (b, _))| a.re * b.re + a.im * b.im).sum::<f64>() / over as f64
    };
    let mut basis = vec![vec![(Complex::new(1.0, 0.0), Complex::new(0.0, 0.0)); zeta.len()]];
    while basis.len() < terms {
        let last = &basis[basis.len() - 1];
        let mut next: Vec<(Complex, Complex)> =
            last.iter().zip(zeta).map(|(&(q, dq), &x)| (q * x, q + dq * x)).collect();
        for known in basis.iter().chain(&basis) {
            let part = mean(known, &next);
            for (value, of) in next.iter_mut().zip(known) {
                *value = (value.0 - of.0 * part, value.1 - of.1 * part);
            }
        }
        let size = 1.0 / mean(&next, &next).sqrt();
        basis.push(next.into_iter().map(|(q, dq)| (q * size, dq * size)).collect());
    }
    basis
}

/// Φ/m and Φ'/m of a term: g/s with g = z q(z²), or p = q(z²).
fn potential(z: Complex, (q, dq): (Complex, Complex), singular: bool) -> (Complex, Complex) {
    if !singular {
        return (q, z * dq * 2.0);
    }
    let one = Complex::new(1.0, 0.0);
    let s = (z - one).half_power(1) * (z + one).half_power(1);
    let (g, dg) = (z * q, q + z * z * dq * 2.0);
    (g / s, dg / s - g * z / (s * s * s))
}

/// (σ_xx, σ_yy, σ_xy) of Φ and Φ' over m, Ω = ±Φ.
fn stress(mode: Mode, z: Complex, (phi, slope): (Complex, Complex), singular: bool) -> [f64; 3] {
    let m = match mode {
        Mode::One => Complex::new(1.0, 0.0),
        Mode::Two => -Complex::I,
    };
    // Real coefficients: Ω(z̄) = m·conj(±Φ/m).
    let omega = m * phi.conj() * if singular { 1.0 } else { -1.0 };
    let sum = m * phi + omega + Complex::new(0.0, 2.0 * z.im) * (m * slope).conj();
    [4.0 * (m * phi).re - sum.re, sum.re, -sum.im]
}
