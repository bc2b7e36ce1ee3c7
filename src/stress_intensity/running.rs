//! A fit of the field around a tip that runs: Williams' series with the dilatational and shear parts each contracted.
//!
//! At speed v, with α_d,s = √(1 − v²/c_d,s²) and z_d,s = x + i α_d,s y, a steady motion with free faces is, term n, p = n/2,
//!
//! I:  u_x = A Re z_d^p + B α_s Re z_s^p,  u_y = −A α_d Im z_d^p − B Im z_s^p,
//! II: u_x = A Im z_d^p + B α_s Im z_s^p,  u_y = A α_d Re z_d^p + B Re z_s^p,
//!
//! B/A = −2α_d/(1 + α_s²) where n is odd in mode I or even in mode II, −(1 + α_s²)/(2α_s) elsewhere. n = 1 has σ_yy or σ_xy =
//! K/√(2πx) ahead: A = 2(1 + α_s²) K/(µ√2π D) or 4α_s K/(µ√2π D), D = 4α_dα_s − (1 + α_s²)² (Freund 1990, Dynamic Fracture
//! Mechanics, ch. 4). D vanishes like v²: below 10⁻⁴ c_s, where rounding over D reaches v²/c_s², the static terms are taken. The
//! tip is taken to run steadily: what K̇ and v̇ add to the higher terms is left to them.

use super::eigenfunction::term;
use super::fit::{Column, Fit, Unknown};
use super::{Annulus, Elastic, Faces, Mode, Reading, Tip, Unreadable};
use std::f64::consts::PI;

/// A fit around a running tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Running {
    pub annulus: Annulus,
    /// v in m/s along +x, from 0 to below Rayleigh's.
    pub speed: f64,
    /// The highest n, at least 1.
    pub terms: usize,
    /// Whether n = −1 is fitted too: a tip somewhat off the origin, as one known to a cell is.
    pub process_zone: bool,
    /// Nodes nearer to the crack than this, in m, are left out.
    pub clear_of_faces: f64,
}

impl Running {
    /// The plain series up to n = `terms` over all nodes of an annulus.
    pub fn over(annulus: Annulus, speed: f64, terms: usize) -> Self {
        Self { annulus, speed, terms, process_zone: false, clear_of_faces: 0.0 }
    }

    /// Prepares K_I and K_II.
    pub fn reading(&self, tip: &Tip, elastic: &Elastic) -> Result<Reading, Unreadable> {
        Ok(self.fit(tip, elastic)?.reading())
    }

    /// Prepares all amplitudes. Terms 1 and −1 are those of K, term 2 that of T and of rotation, as at rest; the others have
    /// A as in term 1 over K.
    pub fn fit(&self, tip: &Tip, elastic: &Elastic) -> Result<Fit, Unreadable> {
        tip.check_annulus(self.annulus)?;
        let waves = Contraction::of(elastic, self.speed)?;
        let nodes = self.annulus.nodes(&tip.sites, self.clear_of_faces);
        let places: Vec<[f64; 2]> = nodes.iter().map(|&node| tip.sites.place(node)).collect();
        let lowest = if self.process_zone { -1 } else { 0 };
        let each = (lowest..=self.terms.max(1) as i32).flat_map(|n| Mode::BOTH.map(|mode| (n, mode)));
        let column = |(n, mode)| -> Column {
            let at = |&x: &[f64; 2]| running_term(elastic, waves, n, mode, x);
            (Unknown::Term { n, mode }, places.iter().map(at).collect())
        };
        let uniform = [Faces { normal: 1.0, shear: 0.0 }, Faces { normal: 0.0, shear: 1.0 }]
            .map(|faces| places.iter().map(|&x| faces.displacement(elastic, x)).collect::<Vec<_>>());
        Ok(Fit::new(&nodes, each.map(column).collect())?.less_faces(uniform))
    }
}

/// α_d, α_s and D of a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Contraction {
    dilatational: f64,
    shear: f64,
    rayleigh: f64,
    /// Too slow to tell from rest.
    still: bool,
}

/// v/c_s below which a tip is taken to rest: K is then off by less than 10⁻⁷.
pub const STILL: f64 = 1e-4;

impl Contraction {
    fn of(elastic: &Elastic, speed: f64) -> Result<Self, Unreadable> {
        let rayleigh = rayleigh_speed(elastic);
        if !(0.0..rayleigh).contains(&speed) {
            return Err(Unreadable::TooFast { speed, rayleigh });
        }
        Ok(Self::at(elastic, speed))
    }

    fn at(elastic: &Elastic, speed: f64) -> Self {
        let contracted = |wave: f64| (1.0 - (speed / wave) * (speed / wave)).sqrt();
        let (dilatational, shear) =
            (contracted(elastic.dilatational_speed()), contracted(elastic.shear_speed()));
        let sum = 1.0 + shear * shear;
        let rayleigh = 4.0 * dilatational * shear - sum * sum;
        Self { dilatational, shear, rayleigh, still: speed < STILL * elastic.shear_speed() }
    }
}

/// Speed of Rayleigh waves in m/s, where D = 0.
pub fn rayleigh_speed(elastic: &Elastic) -> f64 {
    // D > 0 below it, D = −1 at c_s; D(v) has one root between, for no κ below c_s/2.
    let (mut low, mut high) = (0.5 * elastic.shear_speed(), elastic.shear_speed());
    while high - low > 4.0 * f64::EPSILON * high {
        let middle = 0.5 * (low + high);
        if Contraction::at(elastic, middle).rayleigh > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Energy in J/m² that a tip at speed v takes: G = (A_I K_I² + A_II K_II²)/E', A = 4v²α_d,s/((κ+1) c_s² D), 1 at rest.
pub fn energy_release(elastic: &Elastic, speed: f64, k: [f64; 2]) -> Result<f64, Unreadable> {
    let waves = Contraction::of(elastic, speed)?;
    let ratio = speed / elastic.shear_speed();
    let common = 4.0 * ratio * ratio / ((elastic.kappa + 1.0) * waves.rayleigh);
    let factors = if waves.still { [1.0; 2] } else { [common * waves.dilatational, common * waves.shear] };
    Ok((factors[0] * k[0] * k[0] + factors[1] * k[1] * k[1]) / elastic.plane_modulus())
}

/// Displacement in m of term n.
fn running_term(elastic: &Elastic, waves: Contraction, n: i32, mode: Mode, x: [f64; 2]) -> [f64; 2] {
    let rigid = n == 0 || (n == 2 && mode == Mode::II);
    if waves.still || rigid {
        return term(elastic, n, mode).displacement(x);
    }
    let Contraction { dilatational, shear, rayleigh, .. } = waves;
    let odd = n % 2 != 0;
    let sum = 1.0 + shear * shear;
    let ratio = if odd == (mode == Mode::I) { -2.0 * dilatational / sum } else { -sum / (2.0 * shear) };
    let amplitude = match (n, mode) {
        // σ_xx = 2µA (α_d² − α_s²).
        (2, _) => 1.0 / (2.0 * elastic.shear_modulus * (dilatational * dilatational - shear * shear)),
        (_, Mode::I) => 2.0 * sum / (elastic.shear_modulus * (2.0 * PI).sqrt() * rayleigh),
        (_, Mode::II) => 4.0 * shear / (elastic.shear_modulus * (2.0 * PI).sqrt() * rayleigh),
    };
    let [d, d_across] = power(x, dilatational, n);
    let [s, s_across] = power(x, shear, n);
    let u = match mode {
        Mode::I => [d + ratio * shear * s, -dilatational * d_across - ratio * s_across],
        Mode::II => [d_across + ratio * shear * s_across, dilatational * d + ratio * s],
    };
    u.map(|u| amplitude * u)
}

/// (x + iαy)^{n/2}, real and imaginary part.
fn power([x, y]: [f64; 2], alpha: f64, n: i32) -> [f64; 2] {
    let (r, theta, p) = (libm::hypot(x, alpha * y), libm::atan2(alpha * y, x), 0.5 * f64::from(n));
    let size = libm::pow(r, p);
    [size * libm::cos(p * theta), size * libm::sin(p * theta)]
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{imbalance, patch, plus, sampled};
    use super::super::williams::Williams;
    use super::*;
    use approx::assert_relative_eq;

    const ELASTIC: Elastic = Elastic { shear_modulus: 2.5, kappa: 1.7, density: 3.0 };
    const PLACES: [[f64; 2]; 4] = [[0.3, 0.6], [-0.6, 0.4], [-0.5, -0.5], [0.7, -0.1]];

    fn at(share: f64) -> Contraction {
        Contraction::of(&ELASTIC, share * ELASTIC.shear_speed()).unwrap()
    }

    /// Central differences of fourth order.
    fn slope(f: impl Fn(f64) -> f64, h: f64) -> f64 {
        (8.0 * (f(h) - f(-h)) - f(2.0 * h) + f(-2.0 * h)) / (12.0 * h)
    }

    fn stress(waves: Contraction, n: i32, mode: Mode, x: [f64; 2]) -> [f64; 3] {
        let u =
            |i: usize, dx: f64, dy: f64| running_term(&ELASTIC, waves, n, mode, [x[0] + dx, x[1] + dy])[i];
        ELASTIC.stress([0, 1].map(|i| [slope(|d| u(i, d, 0.0), 1e-3), slope(|d| u(i, 0.0, d), 1e-3)]))
    }

    /// Σ_11, Σ_22, Σ_12 over √(2πr) as Freund prints them, (4.3.11) and (4.3.24).
    fn freund(mode: Mode, share: f64, [x, y]: [f64; 2]) -> [f64; 3] {
        let wave = (ELASTIC.kappa - 1.0) / (ELASTIC.kappa + 1.0); // (c_s/c_d)²
        let (ad, a_s) = ((1.0 - share * share * wave).sqrt(), (1.0 - share * share).sqrt());
        let (r, theta) = (libm::hypot(x, y), libm::atan2(y, x));
        let part = |alpha: f64| {
            let tilted = libm::atan2(alpha * libm::sin(theta), libm::cos(theta));
            let gamma = (1.0 - (1.0 - alpha * alpha) * libm::pow(libm::sin(theta), 2.0)).sqrt();
            (libm::cos(0.5 * tilted) / gamma.sqrt(), libm::sin(0.5 * tilted) / gamma.sqrt())
        };
        let ((cd, sd), (cs, ss)) = (part(ad), part(a_s));
        let sum = 1.0 + a_s * a_s;
        let wide = 1.0 + 2.0 * ad * ad - a_s * a_s;
        let d = 4.0 * ad * a_s - sum * sum;
        let parts = match mode {
            Mode::I => [
                sum * wide * cd - 4.0 * a_s * ad * cs,
                -(sum * sum * cd - 4.0 * ad * a_s * cs),
                2.0 * ad * sum * (sd - ss),
            ],
            Mode::II => [
                -2.0 * a_s * (wide * sd - sum * ss),
                2.0 * a_s * sum * (sd - ss),
                4.0 * ad * a_s * cd - sum * sum * cs,
            ],
        };
        parts.map(|part| part / d / (2.0 * PI * r).sqrt())
    }

    /// Differences of 1e-3 at r ≈ 0.7 err by h⁴/30 · 100 ≈ 1e-11.
    #[test]
    fn term_one_has_the_published_stresses() {
        for share in [0.1, 0.5, 0.8] {
            for mode in Mode::BOTH {
                for x in PLACES {
                    let (found, wanted) = (stress(at(share), 1, mode, x), freund(mode, share, x));
                    for i in 0..3 {
                        assert!((found[i] - wanted[i]).abs() < 1e-9, "{share} {mode:?} {found:?} {wanted:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn all_terms_move_steadily_and_their_faces_are_free() {
        for n in -1..=6 {
            for mode in Mode::BOTH {
                let (share, h) = (0.6, 2e-3);
                let speed = share * ELASTIC.shear_speed();
                let field = |x| running_term(&ELASTIC, at(share), n, mode, x);
                for x in PLACES {
                    let u = |k: i32, i: usize| field([x[0] + h * f64::from(k), x[1]])[i];
                    let second = |i| {
                        (16.0 * (u(1, i) + u(-1, i)) - u(2, i) - u(-2, i) - 30.0 * u(0, i)) / (12.0 * h * h)
                    };
                    let wanted = [0, 1].map(|i| ELASTIC.density * speed * speed * second(i));
                    let left = imbalance(&ELASTIC, field, wanted, x, h);
                    assert!(left < 1e-6, "{n} {mode:?} {left:e}");
                }
                // The upper face from above, the lower from below, by one-sided differences.
                for side in [1.0, -1.0] {
                    let u = |i: usize, dx: f64, k: f64| field([-0.7 + dx, side * (1e-3 * k + 1e-12)])[i];
                    let across = |i| {
                        let f = |k| u(i, 0.0, k);
                        (-25.0 * f(0.0) + 48.0 * f(1.0) - 36.0 * f(2.0) + 16.0 * f(3.0) - 3.0 * f(4.0))
                            / (12e-3 * side)
                    };
                    let gradient = [0, 1].map(|i| [slope(|d| u(i, d, 0.0), 1e-3), across(i)]);
                    let [_, normal, shear] = ELASTIC.stress(gradient);
                    assert!(normal.abs() < 1e-7 && shear.abs() < 1e-7, "{n} {mode:?} {normal:e} {shear:e}");
                }
            }
        }
    }

    #[test]
    fn term_two_is_a_uniform_stress_along_the_crack() {
        let [along, across, shear] = stress(at(0.6), 2, Mode::I, PLACES[1]);
        assert!((along - 1.0).abs() < 1e-9 && across.abs() < 1e-9 && shear.abs() < 1e-9);
    }

    /// The difference is of the order of v²: a quarter at half the speed, and small at 10⁻³ c_s.
    #[test]
    fn a_slow_tip_is_a_tip_at_rest() {
        for mode in Mode::BOTH {
            let difference = |share: f64| {
                let each = PLACES.map(|x| {
                    let (a, b) = (running_term(&ELASTIC, at(share), 1, mode, x), term(&ELASTIC, 1, mode));
                    let b = b.displacement(x);
                    libm::hypot(a[0] - b[0], a[1] - b[1]) / libm::hypot(b[0], b[1])
                });
                each.into_iter().fold(0.0, f64::max)
            };
            assert_relative_eq!(difference(0.02) / difference(0.01), 4.0, max_relative = 0.01);
            // A few v², and at the switch rounding over D besides, 1e-8 each.
            assert!(difference(1e-3) < 5e-6 && difference(STILL) < 1e-7, "{}", difference(1e-3));
            assert_eq!(difference(0.99 * STILL), 0.0);
        }
    }

    /// G is the work of closing the crack over d: K √π/(2√2) times the half opening over √r.
    #[test]
    fn the_energy_taken_is_that_of_closing_the_crack() {
        for share in [0.2, 0.7] {
            let speed = share * ELASTIC.shear_speed();
            let behind = |mode| running_term(&ELASTIC, at(share), 1, mode, [-1.0, 0.0]);
            let work = |opening: f64| (PI / 8.0).sqrt() * opening;
            let one = energy_release(&ELASTIC, speed, [1.0, 0.0]).unwrap();
            let two = energy_release(&ELASTIC, speed, [0.0, 1.0]).unwrap();
            assert_relative_eq!(one, work(behind(Mode::I)[1]), max_relative = 1e-12);
            assert_relative_eq!(two, work(behind(Mode::II)[0]), max_relative = 1e-12);
        }
        let rest = energy_release(&ELASTIC, 0.0, [3.0, 4.0]).unwrap();
        assert_relative_eq!(rest, 25.0 / ELASTIC.plane_modulus(), max_relative = 1e-14);
    }

    #[test]
    fn a_running_field_is_recovered_and_a_static_fit_is_not_right() {
        let tip = Tip { sites: patch(30, 0.01), horizon: 0.03, crack: 1.0 };
        let annulus = Annulus { inner: 0.06, outer: 0.25 };
        let k = [2.0, -3.0];
        for share in [1e-3, 0.3, 0.6, 0.85] {
            let field = |x: [f64; 2]| {
                let one = |n, mode| running_term(&ELASTIC, at(share), n, mode, x);
                let near = plus(plus([0.1, -0.2], k[0], one(1, Mode::I)), k[1], one(1, Mode::II));
                let far = plus(plus(near, 4.0, one(2, Mode::I)), 1.5, one(3, Mode::II));
                plus(far, 0.2, [-x[1], x[0]])
            };
            let u = sampled(&tip.sites, field);
            let error = |found: [f64; 2]| (found[0] / k[0] - 1.0).abs().max((found[1] / k[1] - 1.0).abs());
            let running = Running::over(annulus, share * ELASTIC.shear_speed(), 4);
            let fit = running.fit(&tip, &ELASTIC).unwrap();
            // Rounding 1e-16 over D, which is 1e-6 at the slowest, times sums of 10³ numbers.
            let found = error(fit.reading().at(&u, &[]));
            let still = error(Williams::over(annulus, 4).reading(&tip, &ELASTIC).unwrap().at(&u, &[]));
            assert!(found < 1e-9 && fit.condition() < 20.0, "{share} {found:e} {}", fit.condition());
            assert_eq!(still > 0.02, share > 0.1, "{share} {still}");
        }
    }

    /// κ = 2 (ν = 1/4): c_R = c_s √(2 − 2/√3), the textbook root.
    #[test]
    fn speeds_from_rayleighs_on_are_refused() {
        let quarter = Elastic::new(2.0, 2.0, 2.0);
        assert_relative_eq!(
            rayleigh_speed(&quarter),
            (2.0 - 2.0 / 3.0_f64.sqrt()).sqrt(),
            max_relative = 1e-12
        );
        for speed in [0.92, 1.0, 5.0, -0.1, f64::NAN] {
            let refused = Contraction::of(&quarter, speed);
            assert!(matches!(refused, Err(Unreadable::TooFast { .. })), "{speed}");
        }
        assert!(Contraction::of(&quarter, 0.91).is_ok());
    }
}
