//! `asks = "scaling"`: the same body in other units of length, mass and stiffness: one motion, seen in spacings and steps; where
//! all factors are powers of two, bit for bit.

use super::body::{FreeBody, FreeBodyAsked, Look, Pace};
use super::growing::norm;
use super::time_step::bodies;
use crate::dispersion::sweep::LatticeSweep;
use crate::question::{Answer, Claiming, Place, Planned, Question, claim, error_of, value_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::material::Material;
use pd_verify::plan::Plan;
use pd_verify::report::plot::{Axis, Figure, Lines, Series};
use pd_verify::scene::{Positive, Wrong};
use pd_verify::table::{Cell, Table};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written; one lattice.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScalingAsked {
    pub body: FreeBodyAsked,
    pub steps: u64,
    /// The same body of other spacings and materials.
    pub scale: Vec<ScaleAsked>,
    pub lattice: LatticeSweep,
}

/// Another spacing and material.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScaleAsked {
    pub dx_m: Positive,
    pub youngs_modulus_pa: Positive,
    pub density_kg_m3: Positive,
}

/// The case, checked.
pub struct Scaling {
    title: String,
    own: Scaled,
    others: Vec<Scaled>,
    /// Of powers of two.
    twos: Vec<Scaled>,
    steps: u64,
}

/// The body in some units.
struct Scaled {
    body: FreeBody,
    spacing: f64,
    material: Material,
    plan: Plan,
}

/// Spacing, modulus and density over the body's own: powers of two, and of four where a root is taken.
const TWOS: [[i32; 3]; 4] = [[-30, 0, 0], [20, 0, 0], [0, -36, 0], [-9, 14, -10]];
const MOST_STEPS: u64 = 20_000;
const SHARE: f64 = 0.5;

impl Asked for ScalingAsked {
    type Question = Scaling;

    fn check(&self, written: &Written<'_>) -> Result<Scaling, Wrong> {
        let material = written.material()?;
        if self.steps == 0 || self.steps > MOST_STEPS {
            let message = format!("{} steps", self.steps);
            return Err(Wrong::new("steps", message, format!("take 1 to {MOST_STEPS}")));
        }
        if self.scale.is_empty() {
            return Err(Wrong::new("scale", "there is nothing to compare", "add a [[case.scale]]"));
        }
        if !self.body.notch.is_empty() {
            let message = "the places of notches do not follow the spacing";
            return Err(Wrong::new("body.notch", message, "leave notches out"));
        }
        let scaled = |spacing: f64, material: Material| {
            let asked = FreeBodyAsked { dx_m: Positive(spacing), ..self.body.clone() };
            let (_, mut made) = bodies(&asked, &self.lattice, material)?;
            let (Some(body), true) = (made.pop(), made.is_empty()) else {
                return Err(Wrong::new("lattice", "one lattice is scaled", "give one value for each key"));
            };
            let plan = body.plans(&[(SHARE, self.steps)])?.remove(0);
            Ok(Scaled { body, spacing, material, plan })
        };
        let other = |asked: &ScaleAsked| {
            let material =
                Material { youngs_modulus: asked.youngs_modulus_pa.0, density: asked.density_kg_m3.0 };
            scaled(asked.dx_m.0, material)
        };
        let two = |[length, stiffness, mass]: &[i32; 3]| {
            let material = Material {
                youngs_modulus: material.youngs_modulus * 2.0_f64.powi(*stiffness),
                density: material.density * 2.0_f64.powi(*mass),
            };
            scaled(self.body.dx_m.0 * 2.0_f64.powi(*length), material)
        };
        Ok(Scaling {
            title: written.title.to_owned(),
            own: scaled(self.body.dx_m.0, material)?,
            others: self.scale.iter().map(other).collect::<Result<_, Wrong>>()?,
            twos: TWOS.iter().map(two).collect::<Result<_, Wrong>>()?,
            steps: self.steps,
        })
    }
}

impl Question for Scaling {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let source = "the same body in the units of the case";
        let bits = claim(place, "bits", "displacements that differ in any bit after scaling by powers of two")
            .exactly()
            .because(Basis::Theory, "a product or root of powers of two, of four under the root, is exact, and so is every sum of numbers that are scaled alike")
            .source(source);
        vec![
            claim(place, "scaled", "largest difference of displacements over spacings from those of the body itself, any units")
                .at_most(ErrorKind::MaxOfPeak, 1e-12)
                .because(Basis::Rounding, "the linear law has no unit: all that differs is rounding, 1e-16 a step that half the limit does not amplify, as the root of a thousand steps")
                .source(source),
            Claim { error_kind: ErrorKind::Bits, ..bits },
        ]
    }

    fn scenes(&self) -> Vec<Planned> {
        let all = std::iter::once(&self.own).chain(&self.others).chain(&self.twos);
        all.map(|scaled| scaled.plan.clone()).collect()
    }

    fn equations(&self) -> &'static str {
        "u/Δx depends on x/Δx and cΔt/Δx alone"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let march = |scaled: &Scaled| self.march(subject, scaled);
        let marched = march(&self.own).and_then(|own| {
            let others = self.others.par_iter().map(march).collect::<Result<Vec<_>, _>>()?;
            let twos = self.twos.par_iter().map(march).collect::<Result<Vec<_>, _>>()?;
            Ok((own, others, twos))
        });
        let (own, others, twos) = match marched {
            Ok(marched) => marched,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        let far: Vec<Option<f64>> = others.iter().map(|other| apart(&own, other)).collect();
        let furthest = far.iter().copied().collect::<Option<Vec<f64>>>().and_then(largest);
        let different: usize = twos.iter().map(|two| differing(&own, two)).sum();
        let seen = own.iter().map(|look| look.displacement.len()).sum::<usize>();
        let note = format!("{} scalings, {} displacements each", twos.len(), seen);
        Answer {
            evidence: vec![
                ("scaled".into(), error_of(furthest, format!("{} scalings", others.len()))),
                ("bits".into(), value_of((seen > 0).then_some(different as f64), Some(0.0), note)),
            ],
            tables: vec![self.table(&far, place)],
            figures: vec![self.figure(&own, &others, place)],
            ..Answer::default()
        }
    }
}

impl Scaling {
    /// Looks at displacements over the spacing.
    fn march(&self, subject: &dyn Subject, scaled: &Scaled) -> Result<Vec<Look>, String> {
        let pace =
            Pace { seconds: scaled.plan.time_step_s, steps: self.steps, every: (self.steps / 20).max(1) };
        let mut looks = scaled.body.march(subject, pace).map_err(|failure| failure.to_string())?;
        for look in &mut looks {
            look.displacement.iter_mut().for_each(|u| *u /= scaled.spacing);
        }
        Ok(looks)
    }

    fn table(&self, far: &[Option<f64>], place: &Place) -> Table {
        let columns = ["case", "dx_m", "youngs_modulus_pa", "density_kg_m3", "time_step_s", "difference"];
        let mut table = Table::new("stability_scaling.csv", &columns);
        for (scaled, far) in self.others.iter().zip(far) {
            let row: Vec<Cell> = vec![
                place.case.as_str().into(),
                scaled.spacing.into(),
                scaled.material.youngs_modulus.into(),
                scaled.material.density.into(),
                scaled.plan.time_step_s.into(),
                (*far).into(),
            ];
            table.push(row);
        }
        table
    }

    fn figure(&self, own: &[Look], others: &[Vec<Look>], place: &Place) -> Figure {
        let series = |(slot, (scaled, looks)): (usize, (&Scaled, &Vec<Look>))| {
            let of = |(a, b): (&Look, &Look)| (a.step as f64, apart_at(a, b, peak(own)));
            let Material { youngs_modulus, density } = scaled.material;
            let name =
                format!("Δx = {:e} m, E = {youngs_modulus:e} Pa, ρ = {density:e} kg/m³", scaled.spacing);
            Series::both(name, own.iter().zip(looks).map(of).collect()).slot(slot)
        };
        let all = self.others.iter().zip(others).enumerate().map(series).collect();
        let panel = Lines::new(Axis::linear("step"), Axis::linear("largest difference / peak"), all);
        let caption = "Largest difference of displacements over spacings from those of the body in its own units, over the peak.";
        Figure::new(place.case.clone(), self.title.clone(), caption, panel)
    }
}

fn peak(looks: &[Look]) -> f64 {
    looks.first().map_or(f64::NAN, |look| look.displacement.iter().fold(0.0, |most, u| u.abs().max(most)))
}

fn apart_at(a: &Look, b: &Look, peak: f64) -> f64 {
    let pairs = a.displacement.iter().zip(&b.displacement);
    largest(pairs.map(|(a, b)| (a - b).abs() / peak)).unwrap_or(f64::NAN)
}

/// The largest difference over the peak of the start; `None` where not all was seen.
fn apart(own: &[Look], other: &[Look]) -> Option<f64> {
    let whole = own.len() == other.len() && own.iter().any(|look| norm(&look.displacement) > 0.0);
    largest(own.iter().zip(other).map(|(a, b)| apart_at(a, b, peak(own)))).filter(|_| whole)
}

/// How many displacements differ in any bit; all, where not all was seen.
fn differing(own: &[Look], other: &[Look]) -> usize {
    if own.len() != other.len() {
        return own.iter().map(|look| look.displacement.len()).sum();
    }
    let bits = |look: &Look| look.displacement.iter().map(|u| u.to_bits()).collect::<Vec<_>>();
    let pairs = own.iter().zip(other);
    pairs.map(|(a, b)| bits(a).iter().zip(bits(b)).filter(|(a, b)| **a != *b).count()).sum()
}
