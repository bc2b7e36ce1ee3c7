//! `asks = "symmetry"`: lattices are periodic in the Brillouin zone, even, and have the symmetry of the square.

use super::sweep::LatticeSweep;
use super::words::BodyName;
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of, value_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::dispersion::plane::PlaneDispersion;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::scene::Wrong;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::{PI, TAU};

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SymmetryAsked {
    pub body: BodyName,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct Symmetry {
    body: Body,
    lattices: Vec<Lattice>,
}

impl Asked for SymmetryAsked {
    type Question = Symmetry;

    fn check(&self, _: &Written<'_>) -> Result<Symmetry, Wrong> {
        let body = self.body.into();
        let lattices = self.lattice.usable(body).map_err(|wrong| wrong.inside("lattice"))?;
        Ok(Symmetry { body, lattices })
    }
}

/// Points along an axis of the zone; odd, so that none is special by chance.
const GRID: i32 = 11;

impl Question for Symmetry {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let bound = |name, quantity: &str| {
            claim(place, name, quantity)
                .at_most(ErrorKind::LinfRelative, 1e-13)
                .because(Basis::Rounding, "kΔx + 2π is rounded before the code sees it")
                .source("the defining sum: cos is even and 2π-periodic, bonds come in ±ξ")
        };
        let mut claims = vec![
            bound("periodic", "largest |ω²(k + 2π/Δx) − ω²(k)| over the largest ω²"),
            bound("even", "largest |ω²(−k) − ω²(k)| over the largest ω²"),
            claim(place, "no_growth", "wavenumbers of the zone with ω² < 0")
                .exactly()
                .because(Basis::Theory, "positive bond weights make a positive semi-definite operator")
                .source("the defining sum"),
        ];
        if self.body != Body::Bar {
            claims.push(bound("square", "largest change of ω² under the eight symmetries of the square"));
        }
        claims
    }

    fn effort(&self) -> Effort {
        let points = if self.body == Body::Bar { GRID } else { GRID * GRID * 10 } as u64;
        let count = self.lattices.len() as u64;
        let evaluations = 3 * points * count;
        Effort { curves: count, evaluations, bond_evaluations: evaluations * 40, ..Effort::default() }
    }

    fn equations(&self) -> &'static str {
        "ω(k + 2π/Δx) = ω(k) = ω(−k); in the plane also ω(Qk) = ω(k) for the symmetries Q of the square; ω² ≥ 0"
    }

    fn answer(&self, subject: &dyn Subject, _: &Place) -> Answer {
        let found: Vec<Found> =
            self.lattices.iter().filter_map(|&lattice| self.look(subject, lattice)).collect();
        let worst = |f: fn(&Found) -> f64| {
            error_of(largest(found.iter().map(f)), format!("{} lattices", found.len()))
        };
        let growing = Some(found.iter().map(|f| f.growing).sum::<usize>() as f64);
        let evidence = vec![
            ("periodic".into(), worst(|f| f.periodic)),
            ("even".into(), worst(|f| f.even)),
            ("square".into(), worst(|f| f.square)),
            ("no_growth".into(), value_of(growing, Some(0.0), "")),
        ];
        Answer { evidence, ..Answer::default() }
    }
}

/// Largest differences of ω² over its largest value, and the number of growing waves.
#[derive(Default, Clone, Copy)]
struct Found {
    periodic: f64,
    even: f64,
    square: f64,
    growing: usize,
}

impl Symmetry {
    fn look(&self, subject: &dyn Subject, lattice: Lattice) -> Option<Found> {
        if self.body == Body::Bar {
            let relation = BarDispersion::new(&subject.bar_stencil(lattice).ok()?);
            Some(look_at_bar(|theta| subject.bar_square(&relation, theta)))
        } else {
            let relation = PlaneDispersion::new(&subject.plane_stencil(lattice).ok()?);
            Some(look_at_plane(|theta| subject.plane_squares(&relation, theta)))
        }
    }
}

fn look_at_bar(square: impl Fn(f64) -> f64) -> Found {
    let mut found = Found::default();
    let thetas: Vec<f64> = (0..=GRID).map(|n| PI * f64::from(n) / f64::from(GRID)).collect();
    let squares: Vec<f64> = thetas.iter().map(|&theta| square(theta)).collect();
    let top = squares.iter().fold(0.0, |most: f64, &value| most.max(value));
    for (&theta, &value) in thetas.iter().zip(&squares) {
        found.growing += usize::from(value.is_nan() || value < ROUNDED_ZERO * top);
        found.periodic = worse(found.periodic, (square(theta + TAU) - value).abs() / top);
        found.even = worse(found.even, (square(-theta) - value).abs() / top);
    }
    found
}

/// ω² at k = 0 may come out this far below zero, over the largest ω².
const ROUNDED_ZERO: f64 = -1e-14;

fn look_at_plane(squares: impl Fn([f64; 2]) -> [f64; 2]) -> Found {
    let mut found = Found::default();
    let at = |n: i32| PI * f64::from(n) / f64::from(GRID);
    let points: Vec<[f64; 2]> =
        (-GRID..=GRID).flat_map(|i| (0..=GRID).map(move |j| [at(i), at(j)])).collect();
    let values: Vec<[f64; 2]> = points.iter().map(|&theta| squares(theta)).collect();
    let top = values.iter().fold(0.0, |most: f64, value| most.max(value[0]));
    let change = |theta: [f64; 2], value: [f64; 2]| {
        let moved = squares(theta);
        (0..2).map(|n| (moved[n] - value[n]).abs() / top).fold(0.0, worse)
    };
    for (&[x, y], &value) in points.iter().zip(&values) {
        found.growing +=
            value.iter().filter(|square| square.is_nan() || **square < ROUNDED_ZERO * top).count();
        found.periodic = worse(found.periodic, change([x + TAU, y], value));
        found.periodic = worse(found.periodic, change([x, y - TAU], value));
        found.even = worse(found.even, change([-x, -y], value));
        for image in [[-x, y], [x, -y], [y, x], [-y, x], [y, -x], [-y, -x]] {
            found.square = worse(found.square, change(image, value));
        }
    }
    found
}

/// The larger of two, NaN if either is.
fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}
