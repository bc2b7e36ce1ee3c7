//! Williams' series fitted to the displacements of an annulus: both modes, rigid motion, T-stress, higher terms, inertia.
//!
//! The nonlocal zone of the tip is left out by the inner radius, so a peridynamic body is read where it is nearly classical.
//! In motion the static series is not complete: term n drives a [`companion`](super::companion) as its amplitude accelerates.

use super::companion::companion;
use super::eigenfunction::{Field, term};
use super::fit::{Column, Fit, Unknown};
use super::{Annulus, Elastic, Faces, Functional, Mode, Reading, Tip, Unreadable};

/// What is done about inertia.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Inertia {
    /// Nothing: the static series.
    Neglected,
    /// The companions of n = 0, 1, 2 are fitted with amplitudes of their own.
    Fitted,
    /// The same companions with the amplitudes that a static series fitted to the acceleration has.
    Measured,
}

/// What is known of the uniform stress on the faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FaceStress {
    /// Its value is given at every look.
    Known,
    /// σ_yy and σ_xy are unknowns of the fit.
    Fitted,
}

/// A fit of Williams' series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Williams {
    pub annulus: Annulus,
    /// The highest n, at least 1.
    pub terms: usize,
    /// Whether n = −1 is fitted too: a tip, or a process zone, somewhat off the origin.
    pub process_zone: bool,
    /// Nodes nearer to the crack than this, in m, are left out.
    pub clear_of_faces: f64,
    pub inertia: Inertia,
    pub faces: FaceStress,
}

impl Williams {
    /// The plain series up to n = `terms` over all nodes of an annulus.
    pub fn over(annulus: Annulus, terms: usize) -> Self {
        Self {
            annulus,
            terms,
            process_zone: false,
            clear_of_faces: 0.0,
            inertia: Inertia::Neglected,
            faces: FaceStress::Known,
        }
    }

    /// Prepares K_I and K_II.
    pub fn reading(&self, tip: &Tip, elastic: &Elastic) -> Result<Reading, Unreadable> {
        Ok(self.fit(tip, elastic)?.reading())
    }

    /// Prepares all amplitudes.
    pub fn fit(&self, tip: &Tip, elastic: &Elastic) -> Result<Fit, Unreadable> {
        tip.check_annulus(self.annulus)?;
        let nodes = self.annulus.nodes(&tip.sites, self.clear_of_faces);
        let places: Vec<[f64; 2]> = nodes.iter().map(|&node| tip.sites.place(node)).collect();
        let at = |field: &Field| places.iter().map(|&x| field.displacement(x)).collect::<Vec<_>>();
        let lowest = if self.process_zone { -1 } else { 0 };
        let highest = self.terms.max(1) as i32;
        let each = (lowest..=highest).flat_map(|n| Mode::BOTH.map(|mode| (n, mode)));
        let series: Vec<Column> =
            each.map(|(n, mode)| (Unknown::Term { n, mode }, at(&term(elastic, n, mode)))).collect();
        let driven = |n, mode| at(&companion(elastic, &term(elastic, n, mode)));
        let uniform = [Faces { normal: 1.0, shear: 0.0 }, Faces { normal: 0.0, shear: 1.0 }]
            .map(|faces| places.iter().map(|&x| faces.displacement(elastic, x)).collect::<Vec<_>>());

        let mut columns = series.clone();
        if self.inertia == Inertia::Fitted {
            columns.extend(DRIVING.map(|(n, mode)| (Unknown::Inertia { n, mode }, driven(n, mode))));
        }
        if self.faces == FaceStress::Fitted {
            let [normal, shear] = uniform.clone();
            columns.extend([(Unknown::FaceNormal, normal), (Unknown::FaceShear, shear)]);
        }
        let mut fit = Fit::new(&nodes, columns)?;
        if self.faces == FaceStress::Known {
            fit = fit.less_faces(uniform);
        }
        if self.inertia == Inertia::Measured {
            let of_acceleration = Fit::new(&nodes, series)?;
            let read = |n, mode| -> Option<(Functional, Vec<[f64; 2]>)> {
                Some((of_acceleration.amplitude(Unknown::Term { n, mode })?.clone(), driven(n, mode)))
            };
            fit = fit.less_driven(DRIVING.iter().filter_map(|&(n, mode)| read(n, mode)).collect());
        }
        Ok(fit)
    }
}

/// Terms whose companions count: translations, K, T and rotation.
const DRIVING: [(i32, Mode); 6] =
    [(0, Mode::I), (0, Mode::II), (1, Mode::I), (1, Mode::II), (2, Mode::I), (2, Mode::II)];

#[cfg(test)]
mod tests {
    use super::super::synthetic::{Potential, displacement, patch, plus, sampled};
    use super::*;

    /// Steel: µ = 72 GPa, κ = 2.
    const ELASTIC: Elastic = Elastic { shear_modulus: 72e9, kappa: 2.0, density: 8000.0 };
    const K: [f64; 2] = [2e6, -3e6];
    /// A plate of 5 mm cells around the tip, δ = 15 mm.
    const RING: Annulus = Annulus { inner: 0.03, outer: 0.2 };

    fn tip() -> Tip {
        Tip { sites: patch(45, 0.005), horizon: 0.015, crack: 1.0 }
    }

    /// A field with K, T, two higher terms, translation and rotation.
    fn rich(x: [f64; 2]) -> [f64; 2] {
        let potentials =
            [Potential::k(K), Potential::t(5e6), Potential::new(3, 4e6, 1e6), Potential::new(4, -2e6, 3e6)];
        let rigid = [1e-4 - 2e-4 * x[1], -3e-4 + 2e-4 * x[0]];
        plus(displacement(&ELASTIC, &potentials, x), 1.0, rigid)
    }

    fn error(found: [f64; 2]) -> f64 {
        (found[0] / K[0] - 1.0).abs().max((found[1] / K[1] - 1.0).abs())
    }

    /// Rounding of u (1e-16 of 3e-4 m, where K makes 1e-5 m) times the condition number, below 20.
    const ROUNDING: f64 = 1e-12;
    /// Rounding in what is left: sums of 10⁴ numbers, each thirty times as large as the strained part of u.
    const SUMS: f64 = 3e-11;

    #[test]
    fn what_is_in_the_span_is_recovered_to_rounding() {
        let tip = tip();
        let u = sampled(&tip.sites, rich);
        for terms in [4, 5, 7] {
            let fit = Williams::over(RING, terms).fit(&tip, &ELASTIC).unwrap();
            assert!(error(fit.reading().at(&u, &[])) < ROUNDING, "{:?}", fit.reading().at(&u, &[]));
            let t = fit.t_stress().unwrap().at(&u, &[], Faces::default());
            assert!((t / 5e6 - 1.0).abs() < 1e-11, "{t}");
            let turned = fit.amplitude(Unknown::Term { n: 2, mode: Mode::II }).unwrap();
            assert!((turned.at(&u, &[], Faces::default()) / 2e-4 - 1.0).abs() < 1e-11);
            let left = fit.residual(&u, &[], Faces::default());
            assert!(left < SUMS, "{left:e}");
            assert!(fit.condition() < 20.0, "terms {terms}: {}", fit.condition());
        }
    }

    /// What the series lacks is seen in the residual, and its part in K falls with the outer radius: the first missing
    /// term, n = 5, is r² of the K field, so halving the annulus divides by about 4.
    #[test]
    fn a_missing_term_shows_and_fades_with_the_annulus() {
        let tip = tip();
        let u = sampled(&tip.sites, |x| {
            displacement(&ELASTIC, &[Potential::k(K), Potential::new(5, 3e7, 2e7)], x)
        });
        let read = |inner, outer| {
            let fit = Williams::over(Annulus { inner, outer }, 4).fit(&tip, &ELASTIC).unwrap();
            (error(fit.reading().at(&u, &[])), fit.residual(&u, &[], Faces::default()))
        };
        let (wide, near) = (read(0.06, 0.2), read(0.03, 0.1));
        assert!(wide.1 > 1e-3 && near.1 < wide.1);
        assert!((wide.0 / near.0 - 4.0).abs() < 0.4, "{wide:?} {near:?}");
    }

    #[test]
    fn rigid_motion_is_no_stress() {
        let tip = tip();
        let u = sampled(&tip.sites, |x| [1.0 - 0.5 * x[1], -2.0 + 0.5 * x[0]]);
        // Rounding of 2 m as an opening, µ · 2 m · 1e-16/√(0.03 m) ≈ 1e-4 Pa√m, summed at random over 10⁴ numbers.
        let k = Williams::over(RING, 5).reading(&tip, &ELASTIC).unwrap().at(&u, &[]);
        assert!(k[0].abs().max(k[1].abs()) < 1e-2, "{k:?}");
    }

    #[test]
    fn a_uniform_stress_on_the_faces_is_taken_off_when_known_and_found_when_not() {
        let tip = tip();
        let faces = Faces { normal: -30e6, shear: 20e6 };
        let u = sampled(&tip.sites, |x| plus(rich(x), 1.0, faces.displacement(&ELASTIC, x)));
        let plain = Williams::over(RING, 5);
        let fit = plain.fit(&tip, &ELASTIC).unwrap();
        assert!(error(fit.reading().at_loaded(&u, &[], faces)) < ROUNDING);
        let left = fit.residual(&u, &[], faces);
        assert!(left < SUMS, "{left:e}");
        // Left out, it costs more than a tenth of K.
        assert!(error(fit.reading().at(&u, &[])) > 0.1);
        let fitted = Williams { faces: FaceStress::Fitted, ..plain }.fit(&tip, &ELASTIC).unwrap();
        assert!(error(fitted.reading().at(&u, &[])) < 10.0 * ROUNDING);
        for (unknown, wanted) in [(Unknown::FaceNormal, faces.normal), (Unknown::FaceShear, faces.shear)] {
            let found = fitted.amplitude(unknown).unwrap().at(&u, &[], Faces::default());
            assert!((found / wanted - 1.0).abs() < 1e-10, "{found}");
        }
    }

    /// u = s(t) U + s̈ C with s̈ constant is an exact motion of a cracked body; U from the complex potentials.
    #[test]
    fn an_accelerating_field_is_recovered_with_its_companions_and_not_without() {
        let tip = tip();
        // As much of the companion as a K that rises from 0 in 40 µs has: s̈/s = 2/t².
        let (value, rate) = (1.0, 2.0 / (40e-6 * 40e-6));
        let quiet = |x| displacement(&ELASTIC, &[Potential::k(K), Potential::t(5e6)], x);
        let fields = [(1, Mode::I, K[0]), (1, Mode::II, K[1]), (2, Mode::I, 5e6)]
            .map(|(n, mode, size)| companion(&ELASTIC, &term(&ELASTIC, n, mode)).times(size));
        let driven = |x| fields.iter().fold([0.0; 2], |sum, field| plus(sum, 1.0, field.displacement(x)));
        let u = sampled(&tip.sites, |x| plus(quiet(x).map(|u| value * u), rate, driven(x)));
        let a = sampled(&tip.sites, |x| quiet(x).map(|u| rate * u));
        let read = |inertia| {
            let fit = Williams { inertia, ..Williams::over(RING, 5) }.fit(&tip, &ELASTIC).unwrap();
            (error(fit.reading().at(&u, &a)), fit.residual(&u, &a, Faces::default()))
        };
        let (neglected, fitted, measured) =
            (read(Inertia::Neglected), read(Inertia::Fitted), read(Inertia::Measured));
        assert!(neglected.0 > 1e-3 && neglected.1 > 1e-3);
        assert!(fitted.0 < 10.0 * ROUNDING && fitted.1 < 1e-12, "{fitted:?}");
        assert!(measured.0 < 10.0 * ROUNDING && measured.1 < 1e-12, "{measured:?}");
    }

    /// A standing wave cos ωt around a crack, summed over companions of companions: what one generation leaves is
    /// (ωr/c)⁴, at ωr_max/c_s = 1 two percent of what the static series leaves.
    #[test]
    fn one_generation_of_companions_leaves_little_of_a_standing_wave() {
        let tip = tip();
        let omega = ELASTIC.shear_speed() / RING.outer;
        let mut generation = Mode::BOTH.map(|mode| term(&ELASTIC, 1, mode));
        let mut wave = vec![[0.0; 2]; tip.sites.count()];
        for _ in 0..6 {
            for (field, k) in generation.iter().zip(K) {
                let add = sampled(&tip.sites, |x| field.displacement(x));
                for (u, add) in wave.iter_mut().zip(add) {
                    *u = plus(*u, k, add);
                }
            }
            generation = generation.map(|field| companion(&ELASTIC, &field).times(-omega * omega));
        }
        let a: Vec<[f64; 2]> = wave.iter().map(|u| u.map(|u| -omega * omega * u)).collect();
        let read = |inertia| {
            let williams = Williams { inertia, ..Williams::over(RING, 5) };
            error(williams.reading(&tip, &ELASTIC).unwrap().at(&wave, &a))
        };
        let (neglected, fitted, measured) =
            (read(Inertia::Neglected), read(Inertia::Fitted), read(Inertia::Measured));
        assert!(neglected > 0.01, "{neglected}");
        assert!(fitted < 0.05 * neglected && measured < 0.1 * neglected, "{neglected} {fitted} {measured}");
    }

    /// A tip 2 mm behind the one assumed: K is wrong by about d/r, with n = −1 by (d/r)².
    #[test]
    fn a_tip_that_lies_elsewhere_is_seen_from_afar() {
        let tip = tip();
        let d = -0.002;
        let moved = |x: [f64; 2]| displacement(&ELASTIC, &[Potential::k(K)], [x[0] - d, x[1]]);
        let u = sampled(&tip.sites, moved);
        let plain = Williams { clear_of_faces: 0.01, ..Williams::over(RING, 5) };
        let zone = Williams { process_zone: true, ..plain }.fit(&tip, &ELASTIC).unwrap();
        let blind = error(plain.reading(&tip, &ELASTIC).unwrap().at(&u, &[]));
        let seeing = error(zone.reading().at(&u, &[]));
        assert!(blind > 3e-3 && seeing < 0.1 * blind, "{blind} {seeing}");
        for (mode, k) in Mode::BOTH.into_iter().zip(K) {
            let far = zone.amplitude(Unknown::Term { n: -1, mode }).unwrap().at(&u, &[], Faces::default());
            assert!((-2.0 * far / k / d - 1.0).abs() < 0.1, "{far}");
        }
    }

    #[test]
    fn fits_with_too_few_nodes_and_inside_the_horizon_are_refused() {
        let refused =
            |inner, outer, terms| Williams::over(Annulus { inner, outer }, terms).fit(&tip(), &ELASTIC).err();
        // Sixteen nodes lie between 6 and 7.2 cells in each quarter at most: fewer than 2 · 40 unknowns.
        assert!(matches!(refused(0.03, 0.036, 39), Some(Unreadable::TooFewNodes { unknowns: 80, .. })));
        assert!(matches!(refused(0.02, 0.1, 4), Some(Unreadable::InsideHorizon { .. })));
    }
}
