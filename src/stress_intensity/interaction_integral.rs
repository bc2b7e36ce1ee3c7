//! The interaction integral over a domain, with inertia and loaded faces: K from energy, not from a fit.
//!
//! With the near field u° of a unit K, static, its faces free, and q = 1 inside the annulus, falling to 0 at its outer radius,
//!
//! K = E'/2 { ∫ [σ_ij u°_i,1 + σ°_ij u_i,1 − σ_kl ε°_kl δ_1j] q,_j dA + ∫ ρ ü_i u°_i,1 q dA + ∫ σ_i2 [u°_i,1] q dx }
//!
//! the last over the faces, [·] upper less lower, where it is −√(2/π) ∫ q/√s ds per unit of σ_yy or σ_xy (Yau, Wang, Corten
//! 1980, J. Appl. Mech. 47, 335; Shih, Moran, Nakamura 1986, Int. J. Fract. 30, 79). The first integral is a sum over nodes in
//! the annulus, where q changes; the second reaches to the tip, so u°_,1 ~ r^−½ is integrated over each cell. Errors are of
//! second order in Δx; with fourth-order differences only the inertia keeps it.

use super::eigenfunction::{Field, term};
use super::gradient::Differences;
use super::{Annulus, Elastic, Functional, Mode, Reading, Sites, Tip, Unreadable};
use std::f64::consts::PI;

/// A domain integral.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InteractionIntegral {
    /// Where q falls from 1 to 0.
    pub annulus: Annulus,
    /// How gradients are taken. With fourth-order ones the sum beside the faces is of fourth order too.
    pub differences: Differences,
    /// Whether the inertia inside is counted.
    pub inertia: bool,
}

impl InteractionIntegral {
    /// With second-order differences and inertia.
    pub fn over(annulus: Annulus) -> Self {
        Self { annulus, differences: Differences::Second, inertia: true }
    }

    /// Prepares K_I and K_II; it looks at the acceleration where inertia is counted.
    pub fn reading(&self, tip: &Tip, elastic: &Elastic) -> Result<Reading, Unreadable> {
        tip.check_annulus(self.annulus)?;
        self.differences.check(&tip.sites)?;
        let modes = Mode::BOTH.map(|mode| {
            let near = term(elastic, 1, mode);
            let displacement = self.strain_part(&tip.sites, elastic, &near);
            let acceleration =
                if self.inertia { self.inertia_part(&tip.sites, elastic, &near) } else { Vec::new() };
            let load = self.face_part();
            let faces = if mode == Mode::I { [load, 0.0] } else { [0.0, load] };
            Functional::from_fields(&displacement, &acceleration, faces)
        });
        Ok(Reading { modes })
    }

    /// Weights on the displacement of all sites.
    fn strain_part(&self, sites: &Sites, elastic: &Elastic, near: &Field) -> Vec<[f64; 2]> {
        let mut weights = vec![[0.0; 2]; sites.count()];
        let nodes = self.annulus.nodes(sites, 0.0);
        for &node in &nodes {
            let x = sites.place(node);
            let on_gradient = integrand(elastic, near.gradient(x), self.slope(x));
            let share = 0.5 * elastic.plane_modulus() * self.cell(sites, node);
            for (axis, parts) in on_gradient.iter().enumerate() {
                for (other, w) in self.differences.derivative(sites, node, axis) {
                    weights[other][0] += share * w * parts[0];
                    weights[other][1] += share * w * parts[1];
                }
            }
        }
        self.unrotated(sites, &nodes, weights)
    }

    /// A rotation is no strain, but the sum over nodes gives it some K, of the order of its error. That is taken off, the
    /// body's rotation being the mean over the annulus.
    fn unrotated(&self, sites: &Sites, nodes: &[usize], mut weights: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
        let places = (0..sites.count()).map(|node| sites.place(node));
        let response: f64 = weights.iter().zip(places).map(|(w, x)| w[1] * x[0] - w[0] * x[1]).sum();
        let share = 0.5 * response / nodes.len() as f64;
        for &node in nodes {
            for (other, w) in self.differences.derivative(sites, node, 0) {
                weights[other][1] -= share * w;
            }
            for (other, w) in self.differences.derivative(sites, node, 1) {
                weights[other][0] += share * w;
            }
        }
        weights
    }

    /// Area of a node's cell as the sum counts it. Midpoints err by h²/24 of the slope at an end; with the three nearest rows
    /// weighted as here a sum beside the faces is of fourth order.
    fn cell(&self, sites: &Sites, node: usize) -> f64 {
        const BESIDE: [f64; 3] = [13.0 / 12.0, 7.0 / 8.0, 25.0 / 24.0];
        let (row, upper) = (node / sites.nodes[0], sites.upper_row());
        let from_face = if row >= upper { row - upper } else { upper - 1 - row };
        let fourth = self.differences == Differences::Fourth && sites.place(node)[0] < 0.0;
        let weight = if fourth { BESIDE.get(from_face).copied().unwrap_or(1.0) } else { 1.0 };
        weight * sites.spacing * sites.spacing
    }

    /// Weights on the acceleration of all sites.
    fn inertia_part(&self, sites: &Sites, elastic: &Elastic, near: &Field) -> Vec<[f64; 2]> {
        let share = 0.5 * elastic.plane_modulus() * elastic.density;
        let weight = |node| self.over_cell(near, sites.place(node), sites.spacing).map(|w| share * w);
        (0..sites.count()).map(weight).collect()
    }

    /// ∫ u°_i,1 q over the cell around a node. Where q = 1 it is the change of u° across the cell, integrated along its
    /// sides: nothing is singular there, not even at the tip.
    fn over_cell(&self, near: &Field, centre: [f64; 2], spacing: f64) -> [f64; 2] {
        let half = 0.5 * spacing;
        let corner = |way: f64| libm::hypot(centre[0].abs() + way * half, centre[1].abs() + way * half);
        let mut sum = [0.0; 2];
        if corner(-1.0) >= self.annulus.outer {
            return sum;
        }
        if corner(1.0) <= self.annulus.inner {
            for (place, weight) in SIDE {
                for (side, y) in [(1.0, centre[1] + place * half), (-1.0, centre[1] + place * half)] {
                    let u = near.displacement([centre[0] + side * half, y]);
                    (0..2).for_each(|i| sum[i] += side * weight * half * u[i]);
                }
            }
            return sum;
        }
        for x in TWO {
            for y in TWO {
                let x = [centre[0] + x * half, centre[1] + y * half];
                let (slope, q) = (near.gradient(x), self.q(x));
                (0..2).for_each(|i| sum[i] += half * half * q * slope[i][0]);
            }
        }
        sum
    }

    /// K per unit of σ_yy or σ_xy on the faces: −√(2/π) ∫ q/√s ds = −2√(2/π) ∫ q(w²) dw.
    fn face_part(&self) -> f64 {
        let (from, to) = (self.annulus.inner.sqrt(), self.annulus.outer.sqrt());
        let along = |w: f64| self.q([w * w, 0.0]);
        let fall = crate::quadrature::composite(from, to, 4, along).value;
        -2.0 * (2.0 / PI).sqrt() * (from + fall)
    }

    /// How far out in the annulus, 0 to 1.
    fn way(&self, x: [f64; 2]) -> f64 {
        let Annulus { inner, outer } = self.annulus;
        ((libm::hypot(x[0], x[1]) - inner) / (outer - inner)).clamp(0.0, 1.0)
    }

    /// q, with two continuous derivatives.
    fn q(&self, x: [f64; 2]) -> f64 {
        let s = self.way(x);
        1.0 - s * s * s * (10.0 - s * (15.0 - 6.0 * s))
    }

    /// q,_j in 1/m.
    fn slope(&self, x: [f64; 2]) -> [f64; 2] {
        let s = self.way(x);
        let along = -30.0 * s * s * (1.0 - s) * (1.0 - s) / (self.annulus.outer - self.annulus.inner);
        let r = libm::hypot(x[0], x[1]);
        x.map(|x| along * x / r)
    }
}

/// What multiplies u_i,j in the first integral, at `[j][i]`: C(u°_i,1 q,_j) + σ°_ik q,_k δ_1j − q,_1 σ°_ij.
fn integrand(elastic: &Elastic, near: [[f64; 2]; 2], q: [f64; 2]) -> [[f64; 2]; 2] {
    let matrix = |[xx, yy, xy]: [f64; 3]| [[xx, xy], [xy, yy]];
    let pushed = matrix(elastic.stress([0, 1].map(|i| q.map(|q| near[i][0] * q))));
    let stress = matrix(elastic.stress(near));
    let part = |i: usize, j: usize| pushed[i][j] - q[0] * stress[i][j];
    let along = |i: usize| stress[i][0] * q[0] + stress[i][1] * q[1];
    [[part(0, 0) + along(0), part(1, 0) + along(1)], [part(0, 1), part(1, 1)]]
}

/// Two Gauss points on [−1, 1], weights 1: 1/√3.
const TWO: [f64; 2] = [-0.577_350_269_189_625_8, 0.577_350_269_189_625_8];

/// Eight Gauss points on [−1, 1] with weights: a √y beside the tip to 1e-4 of its cell.
const SIDE: [(f64, f64); 8] = [
    (-0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
    (-0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
    (-0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (-0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

#[cfg(test)]
mod tests {
    use super::super::Faces;
    use super::super::companion::companion;
    use super::super::synthetic::{Potential, displacement, patch, plus, sampled};
    use super::*;

    /// Steel: µ = 72 GPa, κ = 2.
    const ELASTIC: Elastic = Elastic { shear_modulus: 72e9, kappa: 2.0, density: 8000.0 };
    const K: [f64; 2] = [2e6, -3e6];
    const RING: Annulus = Annulus { inner: 0.06, outer: 0.2 };

    fn tip(half: usize) -> Tip {
        Tip { sites: patch(half, 0.21 / half as f64), horizon: 0.0, crack: 1.0 }
    }

    /// What has no K: T, higher terms and a rotation.
    fn rest(x: [f64; 2]) -> [f64; 2] {
        let potentials = [Potential::t(2e7), Potential::new(3, 2e7, 2e7), Potential::new(4, 2e6, -3e6)];
        plus(displacement(&ELASTIC, &potentials, x), 2e-4, [1.0 - x[1], -3.0 + x[0]])
    }

    fn near(x: [f64; 2]) -> [f64; 2] {
        displacement(&ELASTIC, &[Potential::k(K)], x)
    }

    type Motion = (Vec<[f64; 2]>, Vec<[f64; 2]>, Faces);

    fn at_rest(sites: &Sites, u: impl Fn([f64; 2]) -> [f64; 2]) -> Motion {
        (sampled(sites, u), vec![[0.0; 2]; sites.count()], Faces::default())
    }

    /// Errors over K of K_I and K_II at 21, 42 and 84 nodes to each side of the tip, of a motion with so much of K.
    fn errors(integral: InteractionIntegral, share: f64, motion: impl Fn(&Sites) -> Motion) -> [[f64; 3]; 2] {
        let each = [21, 42, 84].map(|half| {
            let tip = tip(half);
            let reading = integral.reading(&tip, &ELASTIC).unwrap();
            let (u, a, faces) = motion(&tip.sites);
            let found = reading.at_loaded(&u, &a, faces);
            [0, 1].map(|mode| (found[mode] / K[mode] - share).abs())
        });
        [0, 1].map(|mode| each.map(|error| error[mode]))
    }

    /// The order of the two finest; the coarsest has not come to it yet.
    fn assert_orders(errors: [[f64; 3]; 2], lowest: f64, highest: f64, coarsest: f64) {
        for [first, coarse, fine] in errors {
            let order = (coarse / fine).log2();
            assert!((lowest..highest).contains(&order), "{errors:?} {order}");
            assert!(first < coarsest, "{errors:?}");
        }
    }

    /// Fourteen cells between the radii at the coarsest: (h/r)² ≈ 1/200 times a small factor.
    #[test]
    fn a_static_field_converges_with_the_order_of_the_differences() {
        let plain = InteractionIntegral::over(RING);
        assert_orders(errors(plain, 0.0, |sites| at_rest(sites, rest)), 1.8, 2.2, 3e-3);
        let fourth = InteractionIntegral { differences: Differences::Fourth, ..plain };
        assert_orders(errors(fourth, 0.0, |sites| at_rest(sites, rest)), 3.0, 5.5, 3e-5);
        // The near field itself: of such an order or better, its first errors being small and of either sign.
        for (integral, gain) in [(plain, 8.0), (fourth, 64.0)] {
            for [coarse, _, fine] in errors(integral, 1.0, |sites| at_rest(sites, near)) {
                assert!(coarse < 2e-4 && fine < coarse / gain, "{coarse:e} {fine:e}");
            }
        }
    }

    /// u = s U + s̈ C with s̈ constant is an exact motion; as much of C as a K that rises as t² for 40 µs has.
    #[test]
    fn an_accelerating_field_needs_its_inertia() {
        let rate = 2.0 / (40e-6 * 40e-6);
        let quiet = |x| displacement(&ELASTIC, &[Potential::k(K), Potential::t(5e6)], x);
        let fields = [(1, Mode::I, K[0]), (1, Mode::II, K[1]), (2, Mode::I, 5e6)]
            .map(|(n, mode, size)| companion(&ELASTIC, &term(&ELASTIC, n, mode)).times(size));
        let driven = |x| fields.iter().fold([0.0; 2], |sum, field| plus(sum, 1.0, field.displacement(x)));
        let motion = |sites: &Sites| {
            let u = sampled(sites, |x| plus(quiet(x), rate, driven(x)));
            (u, sampled(sites, |x| quiet(x).map(|u| rate * u)), Faces::default())
        };
        for differences in [Differences::Second, Differences::Fourth] {
            let whole = InteractionIntegral { differences, ..InteractionIntegral::over(RING) };
            assert_orders(errors(whole, 1.0, motion), 1.8, 2.2, 2e-3);
            let without = errors(InteractionIntegral { inertia: false, ..whole }, 1.0, motion);
            assert!(without.iter().flatten().all(|error| *error > 0.1), "{without:?}");
        }
    }

    #[test]
    fn loaded_faces_count() {
        let faces = Faces { normal: 30e6, shear: 20e6 };
        let motion = |faces: Faces| {
            move |sites: &Sites| {
                let load = Faces { normal: 30e6, shear: 20e6 };
                let (u, a, _) = at_rest(sites, |x| plus(rest(x), 1.0, load.displacement(&ELASTIC, x)));
                (u, a, faces)
            }
        };
        let plain = InteractionIntegral::over(RING);
        assert_orders(errors(plain, 0.0, motion(faces)), 1.8, 2.2, 3e-3);
        let unseen = errors(plain, 0.0, motion(Faces::default()));
        assert!(unseen.iter().flatten().all(|error| *error > 0.1), "{unseen:?}");
    }

    #[test]
    fn rigid_motion_and_stress_along_the_crack_are_no_k() {
        let tip = tip(21);
        let (u, a, _) = at_rest(&tip.sites, |x| [1.0 - 0.5 * x[1], -2.0 + 0.5 * x[0]]);
        let reading = InteractionIntegral::over(RING).reading(&tip, &ELASTIC).unwrap();
        // Rounding of 1e-16 of a "K" of µ · 0.5 · √(0.1 m) = 1e10 Pa√m, summed over a thousand nodes.
        assert!(reading.at(&u, &a).iter().all(|k| k.abs() < 1e-3), "{:?}", reading.at(&u, &a));
        // T has no K_II by symmetry, and a K_I of the order of the error of the sum.
        let (u, a, _) = at_rest(&tip.sites, |x| displacement(&ELASTIC, &[Potential::t(5e6)], x));
        let [one, two] = reading.at(&u, &a);
        assert!(one.abs() < 1e-3 * 5e6 * 0.2_f64.sqrt() && two.abs() < 1e-6, "{one} {two}");
    }
}
