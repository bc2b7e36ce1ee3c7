//! The wrong ingredients of studies of arithmetic: formulas as they are printed, and results off in a late digit.

use super::dsif_faults::Fault;
use super::stability_faults::Law;
use crate::subject::{PdVerify, Subject};
use pd_verify::dispersion::Wave;
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::kernel::Kernel;
use pd_verify::material::Body;
use pd_verify::scene::Rotations;
use pd_verify::stress_intensity::{Faces, Reading};
use pd_verify_reference::released_bar::ReleasedBar;

/// All of them.
pub fn all() -> Vec<Fault> {
    let digits = |name, subject| Fault { name, studies: &["stability-arithmetic"], subject };
    vec![
        digits("long waves by 1 − cos", Box::new(Printed) as Box<dyn Subject + Send>),
        digits("stretched bonds keep their direction", Box::new(Law(Rotations::Small))),
        digits("c₀ by the printed closed forms", Box::new(Printed)),
        digits("a Fourier series without its last term", Box::new(Shorter)),
        digits("K off in its twelfth digit", Box::new(TwelfthDigit)),
    ]
}

/// Formulas as they are printed.
struct Printed;

impl Subject for Printed {
    fn bar_wave(&self, relation: &BarDispersion, k_dx: f64) -> Wave {
        let terms = relation.weights().iter().zip(1..);
        let square: f64 = terms.map(|(w, j)| 2.0 * w * (1.0 - libm::cos(f64::from(j) * k_dx))).sum();
        Wave { omega: square.sqrt(), ..PdVerify.bar_wave(relation, k_dx) }
    }

    fn micromodulus(&self, body: Body, kernel: Kernel, e: f64, section: f64, horizon: f64) -> f64 {
        match (body, kernel) {
            (Body::Bar, Kernel::Gaussian { p }) => {
                2.0 * e * p * p / (section * horizon * horizon * (1.0 - libm::exp(-p * p)))
            }
            _ => PdVerify.micromodulus(body, kernel, e, section, horizon),
        }
    }
}

struct Shorter;

impl Subject for Shorter {
    fn released_strain(&self, bar: &ReleasedBar, x: f64, t: f64, terms: usize) -> f64 {
        PdVerify.released_strain(bar, x, t, terms - 1)
    }
}

struct TwelfthDigit;

impl Subject for TwelfthDigit {
    fn stress_intensity(&self, reading: &Reading, u: &[[f64; 2]], a: &[[f64; 2]], faces: Faces) -> [f64; 2] {
        PdVerify.stress_intensity(reading, u, a, faces).map(|k| k * (1.0 + 1e-12))
    }
}
