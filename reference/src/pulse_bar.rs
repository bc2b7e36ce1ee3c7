//! A smooth pulse let go in a bar held at the left end and free at the right: exact displacement and strain.
//!
//! ρü = E u'', u(0, t) = 0, u'(L, t) = 0, u̇(x, 0) = 0. D'Alembert: u = ½[f(x − vt) + f(x + vt)], f the initial
//! displacement continued odd about 0 and even about L. Method of images: with g(s) = exp(−as²),
//! f(x) = Σ_k (−1)^k [g(x − x₀ − 2kL) − g(x + x₀ − 2kL)], which is smooth, has period 4L and obeys both ends exactly.

/// The bar and the pulse g(x − x₀); displacements are over the pulse's height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PulseBar {
    /// L in m.
    pub length: f64,
    /// v = √(E/ρ) in m/s.
    pub speed: f64,
    /// a in 1/m²; the pulse is 1/√a wide where it has fallen to 1/e.
    pub sharpness: f64,
    /// x₀ in m, between 0 and L.
    pub centre: f64,
}

/// g is zero beyond this distance, in units of 1/√a.
const REACH: f64 = 27.4;

impl PulseBar {
    /// u at x in m, 0 ≤ x ≤ L, and t in s, over the pulse's height. Good to a few 1e-16 plus
    /// √a times the rounding of x ± vt.
    pub fn displacement_at(&self, x: f64, t: f64) -> f64 {
        let way = self.speed * t;
        0.5 * (self.images(x - way, pulse) + self.images(x + way, pulse))
    }

    /// u' at x and t in 1/m, over the pulse's height.
    pub fn strain_at(&self, x: f64, t: f64) -> f64 {
        let way = self.speed * t;
        let root = libm::sqrt(self.sharpness);
        0.5 * root * (self.images(x - way, slope) + self.images(x + way, slope))
    }

    /// At t = 0 the images change the pulse in the bar by no more than this: e^{−ax₀²} + e^{−a(L−x₀)²}.
    pub fn tail(&self) -> f64 {
        let at = |distance: f64| pulse(libm::sqrt(self.sharpness) * distance);
        at(self.centre) + at(self.length - self.centre)
    }

    /// Σ_k (−1)^k [g(x − x₀ − 2kL) − g(x + x₀ − 2kL)], with the images that reach one period about x = 0.
    fn images(&self, x: f64, of: impl Fn(f64) -> f64) -> f64 {
        let (period, root) = (4.0 * self.length, libm::sqrt(self.sharpness));
        let x = x - period * libm::round(x / period);
        let most = libm::ceil((REACH / root + 3.0 * self.length) / (2.0 * self.length)) as i64;
        let image = |k: i64| {
            let (sign, at) = (if k % 2 == 0 { 1.0 } else { -1.0 }, x - 2.0 * k as f64 * self.length);
            sign * (of(root * (at - self.centre)) - of(root * (at + self.centre)))
        };
        (-most..=most).map(image).sum()
    }
}

/// e^{−s²}.
fn pulse(s: f64) -> f64 {
    libm::exp(-s * s)
}

/// d/ds e^{−s²}.
fn slope(s: f64) -> f64 {
    -2.0 * s * libm::exp(-s * s)
}
