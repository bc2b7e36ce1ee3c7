//! For tests: cracked bodies by complex potentials in Rice's form, which shares nothing with the eigenfunctions.
//!
//! 2µ(u_x + iu_y) = κφ(z) − ω(z*) − (z − z*) Φ(z)*, σ_yy − iσ_xy = Φ(z) + Ω(z*) + (z − z*) Φ'(z)*, Φ = φ', Ω = ω'. Faces at
//! θ = ±π are free where Ω = Φ for half-integer powers and Ω = −Φ for integer ones; Φ = (K_I − iK_II)/(2√(2πz)).

use super::{Elastic, Mode, Sites};
use nalgebra::Complex;
use std::f64::consts::PI;

/// φ = c z^{n/2}.
#[derive(Debug, Clone, Copy)]
pub struct Potential {
    pub n: i32,
    pub c: Complex<f64>,
}

impl Potential {
    pub fn new(n: i32, re: f64, im: f64) -> Self {
        Self { n, c: Complex::new(re, im) }
    }

    /// Of K_I and K_II in Pa√m.
    pub fn k(k: [f64; 2]) -> Self {
        Self::new(1, k[0] / (2.0 * PI).sqrt(), -k[1] / (2.0 * PI).sqrt())
    }

    /// Of a T-stress in Pa.
    pub fn t(t: f64) -> Self {
        Self::new(2, t / 4.0, 0.0)
    }

    /// What a term of amplitude one has by its definition; `None` for rigid motions.
    pub fn of_term(n: i32, mode: Mode) -> Option<Self> {
        match (n, mode) {
            (0, _) | (2, Mode::II) => None,
            (1, Mode::I) => Some(Self::k([1.0, 0.0])),
            (1, Mode::II) => Some(Self::k([0.0, 1.0])),
            (2, Mode::I) => Some(Self::t(1.0)),
            (_, Mode::I) => Some(Self::new(n, 1.0 / (2.0 * PI).sqrt(), 0.0)),
            (_, Mode::II) => Some(Self::new(n, 0.0, -1.0 / (2.0 * PI).sqrt())),
        }
    }
}

/// Displacement in m of some potentials.
pub fn displacement(elastic: &Elastic, potentials: &[Potential], x: [f64; 2]) -> [f64; 2] {
    let z = Complex::new(x[0], x[1]);
    let mut sum = Complex::new(0.0, 0.0);
    for &Potential { n, c } in potentials {
        let p = f64::from(n) / 2.0;
        let sign = if n % 2 == 0 { -1.0 } else { 1.0 };
        let slope = c * p * z.powf(p - 1.0);
        sum += c * elastic.kappa * z.powf(p) - c * sign * z.conj().powf(p) - (z - z.conj()) * slope.conj();
    }
    let w = sum / (2.0 * elastic.shear_modulus);
    [w.re, w.im]
}

/// A square patch of nodes around a tip between columns: `half` nodes on each side.
pub fn patch(half: usize, spacing: f64) -> Sites {
    let first = -(half as f64 - 0.5) * spacing;
    Sites { nodes: [2 * half, 2 * half], spacing, first: [first, first] }
}

/// A field over sites.
pub fn sampled(sites: &Sites, field: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<[f64; 2]> {
    (0..sites.count()).map(|node| field(sites.place(node))).collect()
}

/// Sum of two displacements, the second one times a factor.
pub fn plus(a: [f64; 2], factor: f64, b: [f64; 2]) -> [f64; 2] {
    [a[0] + factor * b[0], a[1] + factor * b[1]]
}

/// Largest |∇·σ(u) − wanted| over µ by fourth-order differences of step h: the equation of motion held by a field.
pub fn imbalance(
    elastic: &Elastic,
    field: impl Fn([f64; 2]) -> [f64; 2],
    wanted: [f64; 2],
    x: [f64; 2],
    h: f64,
) -> f64 {
    let at = |i: i32, j: i32| field([x[0] + h * f64::from(i), x[1] + h * f64::from(j)]);
    let second = |axis: usize, component: usize| {
        let f = |k: i32| if axis == 0 { at(k, 0)[component] } else { at(0, k)[component] };
        (16.0 * (f(1) + f(-1)) - f(2) - f(-2) - 30.0 * f(0)) / (12.0 * h * h)
    };
    let weights = [(1, 8.0 / 12.0), (-1, -8.0 / 12.0), (2, -1.0 / 12.0), (-2, 1.0 / 12.0)];
    let mixed = |component: usize| -> f64 {
        let pairs = weights.iter().flat_map(|a| weights.iter().map(move |b| (a, b)));
        pairs.map(|(a, b)| a.1 * b.1 * at(a.0, b.0)[component]).sum::<f64>() / (h * h)
    };
    let (mu, lambda) = (elastic.shear_modulus, elastic.lambda());
    let force = [
        (lambda + 2.0 * mu) * second(0, 0) + mu * second(1, 0) + (lambda + mu) * mixed(1),
        (lambda + 2.0 * mu) * second(1, 1) + mu * second(0, 1) + (lambda + mu) * mixed(0),
    ];
    libm::hypot(force[0] - wanted[0], force[1] - wanted[1]) / mu
}
