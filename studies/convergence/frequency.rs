//! `asks = "frequency"`: plane waves marched in a periodic body, their frequency read from the motion and held against the
//! dispersion relation that the lattice has by its sums.

use super::frequency_report as report;
use super::path::{Level, Refine, Sequence, Weights};
use super::space::{In, Space};
use super::wave::{HEIGHT, Marched, PlaneWave};
use super::whole;
use crate::bar::pulsed::material;
use crate::dispersion::curve::{Curve, Medium as Travels};
use crate::dispersion::sweep::LatticeSweep;
use crate::dispersion::words::BodyName;
use crate::input::OneOrMany;
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::dispersion::Branch;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::record::Trace;
use pd_verify::scene::{Positive, Probe, Watch, Wrong};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FrequencyAsked {
    pub body: BodyName,
    pub dx_m: Positive,
    /// λ/Δx, about: the body holds whole cells.
    pub cells_per_wave: OneOrMany<Positive>,
    /// Of a plate: vectors of whole numbers along which waves run, both branches along each.
    pub direction: Option<Vec<[u32; 2]>>,
    /// How long, in periods of the local wave; default 3.
    pub periods: Option<Positive>,
    /// Time step over the limit; default 0.8.
    pub safety: Option<Positive>,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct Frequency<const D: usize> {
    title: String,
    waves: Vec<Wave<D>>,
}

/// One wave on one lattice.
pub struct Wave<const D: usize> {
    pub of: PlaneWave<D>,
    pub lattice: Lattice,
    pub march: Marched<D>,
}

/// What was read from its motion.
pub struct Read {
    /// |k| in rad/m and c, the branch's own speed, in m/s.
    pub k: f64,
    pub speed: f64,
    pub degrees: f64,
    /// rad/s: read, by the relation under judgement, by the reference.
    pub measured: Option<f64>,
    pub relation: Option<f64>,
    pub reference: Option<f64>,
    /// What left the wave's own displacement, over its height.
    pub leaked: Option<f64>,
}

/// The probe that sees every step.
const CLOCK: &str = "clock";

impl Asked for FrequencyAsked {
    type Question = Box<dyn Question>;

    fn check(&self, written: &Written<'_>) -> Result<Box<dyn Question>, Wrong> {
        let body = Body::from(self.body);
        let along = 2 * self.direction.as_ref().map_or(1, Vec::len);
        let marches = along.saturating_mul(self.cells_per_wave.0.len());
        let lattices = self.lattice.marched(body, marches).map_err(|wrong| wrong.inside("lattice"))?;
        let title = written.title.to_owned();
        match (body, &self.direction) {
            (Body::Bar, None) => {
                let waves = self.waves(written, body, &[([1], Branch::P)], &lattices)?;
                Ok(Box::new(Frequency { title, waves }))
            }
            (Body::Bar, Some(_)) => {
                Err(Wrong::new("direction", "direction says nothing about a bar", "leave it out"))
            }
            (_, Some(none)) if none.is_empty() => Err(Wrong::new(
                "direction",
                "no direction is given",
                "for example direction = [[1, 0], [1, 1]]",
            )),
            (_, None) => Err(Wrong::new("", "a plate needs direction", "add direction = [[1, 0], [1, 1]]")),
            (_, Some(directions)) => {
                let mut along = Vec::new();
                for &direction in directions {
                    PlaneWave::<2>::check_direction(direction)?;
                    along.extend([(direction, Branch::P), (direction, Branch::S)]);
                }
                let waves = self.waves(written, body, &along, &lattices)?;
                Ok(Box::new(Frequency { title, waves }))
            }
        }
    }
}

impl FrequencyAsked {
    fn waves<const D: usize>(
        &self,
        written: &Written<'_>,
        body: Body,
        along: &[([u32; D], Branch)],
        lattices: &[Lattice],
    ) -> Result<Vec<Wave<D>>, Wrong>
    where
        In: Space<D>,
    {
        let material = material(written)?;
        let periods = self.periods.unwrap_or(Positive(3.0)).0;
        let safety = self.safety.unwrap_or(Positive(0.8)).0;
        let mut waves = Vec::new();
        for &lattice in lattices {
            let mut limit = None;
            for &(direction, branch) in along {
                for cells in &self.cells_per_wave.0 {
                    let wavelength = cells.0 * self.dx_m.0;
                    let of = PlaneWave { material, body, direction, branch, wavelength, periods, safety };
                    let march = own_wave(&of, lattice, self.dx_m.0, limit)?;
                    limit = Some(march.plan.time_step_s / march.plan.time_step_over_limit);
                    waves.push(Wave { of, lattice, march });
                }
            }
        }
        Ok(waves)
    }
}

/// The march of a wave that starts in the lattice's own displacement, seen at a node at every step.
fn own_wave<const D: usize>(
    of: &PlaneWave<D>,
    lattice: Lattice,
    spacing: f64,
    limit: Option<f64>,
) -> Result<Marched<D>, Wrong>
where
    In: Space<D>,
{
    let Lattice { kernel, m, volume_rule, calibrated } = lattice;
    let level = Level { m, spacing };
    let weights = Weights { kernel, volume_rule, calibrated };
    let sequence = Sequence { refine: Refine::Delta, weights, levels: vec![level] };
    let mut march = of.marches(&sequence, limit)?.remove(0);
    let own = In::polarisation(&whole::lattice(&march.scene), march.wavenumber, of.branch);
    march.amplitude = own.ok_or_else(|| {
        Wrong::new("lattice", "this lattice carries no such wave", "take another lattice or a longer wave")
    })?;
    for field in &mut march.scene.displacement {
        field.amplitude = HEIGHT * march.amplitude[field.component];
    }
    march.scene.snapshots.clear();
    let watch = Watch::Point { at: [0.5 * spacing; D] };
    march.scene.probes = vec![Probe { name: CLOCK.into(), watch, every: 1 }];
    march.plan = Plan::below(&march.scene, march.plan.time_step_s / march.plan.time_step_over_limit)?;
    Ok(march)
}

impl<const D: usize> Wave<D>
where
    In: Space<D>,
{
    /// Its dispersion relation, with leapfrog.
    pub fn curve(&self) -> Curve {
        let plan = &self.march.plan;
        let k = self.march.wavenumber;
        let up = if D == 2 { k[D - 1] } else { 0.0 };
        Curve {
            body: self.of.body,
            medium: Travels::Lattice { lattice: self.lattice, dx: self.march.scene.spacing },
            courant: Some(self.march.scene.speed() * plan.time_step_s / self.march.scene.spacing),
            branch: self.of.branch,
            degrees: libm::atan2(up, k[0]).to_degrees(),
        }
    }

    fn read(&self, subject: &dyn Subject) -> Result<Read, String> {
        let record = In::march(subject, &self.march.scene).map_err(|failure| failure.to_string())?;
        let trace = record.trace(CLOCK).ok_or("the wave was not recorded")?;
        let curve = self.curve();
        let k = self.march.wavenumber.iter().map(|k| k * k).sum::<f64>().sqrt();
        let speed = self.of.speed();
        let prepared = curve.prepare(subject).map_err(|unusable| unusable.to_string())?;
        let (along, leaked) = split(trace, self.march.amplitude);
        Ok(Read {
            k,
            speed,
            degrees: curve.degrees,
            measured: frequency(&along, self.march.plan.time_step_s),
            relation: prepared.wave(k).map(|wave| speed * wave.omega),
            reference: curve.reference(k).map(|wave| speed * wave.omega),
            leaked,
        })
    }
}

/// The motion along a unit vector, over its height, and the largest part across it.
fn split<const D: usize>(trace: &Trace, unit: [f64; D]) -> (Vec<f64>, Option<f64>) {
    let along = |row: &[f64]| (0..D).map(|axis| row[axis] * unit[axis]).sum::<f64>();
    let across = |row: &[f64]| {
        let along = along(row);
        (0..D).map(|axis| (row[axis] - along * unit[axis]).abs()).fold(0.0, f64::max) / HEIGHT
    };
    (
        trace.rows.iter().map(|row| along(row) / HEIGHT).collect(),
        largest(trace.rows.iter().map(|row| across(row))),
    )
}

/// ω in rad/s of a motion a(n) = A cos(ωnΔt + φ): 4 sin²(ωΔt/2) = (2a(n) − a(n+1) − a(n−1))/a(n), by least squares.
fn frequency(motion: &[f64], time_step: f64) -> Option<f64> {
    let (mut bent, mut size) = (0.0, 0.0);
    for near in motion.windows(3) {
        bent += near[1] * (2.0 * near[1] - near[0] - near[2]);
        size += near[1] * near[1];
    }
    let sine = (0.25 * bent / size).sqrt();
    let omega = 2.0 / time_step * libm::asin(sine);
    omega.is_finite().then_some(omega)
}

/// |a/b − 1|; NaN where one is missing.
fn relative(a: Option<f64>, b: Option<f64>) -> f64 {
    a.zip(b).map_or(f64::NAN, |(a, b)| (a / b - 1.0).abs())
}

impl<const D: usize> Question for Frequency<D>
where
    In: Space<D>,
{
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let rounding = "leapfrog turns a wave of the lattice by 2 asin(ΩΔt/2) a step exactly, and the reading is exact for one frequency; rounding alone is left";
        let mut claims = vec![
            claim(place, "relation", "ω of marched waves over that of the dispersion relation, less 1: the largest")
                .at_most(ErrorKind::Relative, 1e-6)
                .because(Basis::Engineering, "a wave that differs by more is another wave: 1e-6 is a thousandth of the smallest difference between kernels that is of use; rounding leaves far less")
                .source("the dispersion relation by its sums, with leapfrog, as `dispersion` judges it"),
            claim(place, "reference", "ω of marched waves over that of the reference's lattice, less 1: the largest")
                .at_most(ErrorKind::Relative, 1e-9)
                .because(Basis::Rounding, rounding)
                .source("lattice sums in double-double arithmetic, with leapfrog"),
        ];
        if D == 2 {
            claims.push(
                claim(
                    place,
                    "straight",
                    "what leaves the displacement that the wave started with, over its height: the largest",
                )
                .at_most(ErrorKind::MaxOfPeak, 1e-10)
                .because(
                    Basis::Rounding,
                    "an eigenvector of the lattice stays one; rounding of some 1e-16 a step is left",
                )
                .source("eigenvectors of the lattice's matrix in double-double arithmetic"),
            );
        }
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.waves.iter().map(|wave| wave.march.plan.clone()).collect()
    }

    fn effort(&self) -> Effort {
        let reference_evaluations = 2 * self.waves.len() as u64;
        Effort { reference_evaluations, ..Effort::of_scenes(&self.scenes()) }
    }

    fn equations(&self) -> &'static str {
        "u(x, 0) = e cos(k·x), e an eigenvector of M(k), at rest, periodic: u = e cos(k·x) cos ωnΔt, sin(ωΔt/2) = √λ c_d Δt/2
read: 4 sin²(ωΔt/2) = Σ a(n)(2a(n) − a(n+1) − a(n−1)) / Σ a(n)²"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let read: Vec<Result<Read, String>> = self.waves.par_iter().map(|wave| wave.read(subject)).collect();
        let read: Vec<Read> = match read.into_iter().collect() {
            Ok(read) => read,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        let note = format!("{} waves", read.len());
        let of = |errors: Vec<f64>| error_of(largest(errors), note.clone());
        let relation = read.iter().map(|read| relative(read.measured, read.relation)).collect();
        let reference = read.iter().map(|read| relative(read.measured, read.reference)).collect();
        let leaked = read.iter().map(|read| read.leaked.unwrap_or(f64::NAN)).collect();
        let mut evidence = vec![("relation".into(), of(relation)), ("reference".into(), of(reference))];
        if D == 2 {
            evidence.push(("straight".into(), of(leaked)));
        }
        Answer {
            evidence,
            tables: vec![report::table(&self.waves, &read, place)],
            figures: vec![report::figure(&self.title, &self.waves, &read, place)],
            ..Answer::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frequency_is_read_from_a_cosine_of_any_phase() {
        let step = 1e-7;
        for omega in [3e4, 2e5, 2.9e7] {
            for phase in [0.0, 1.1] {
                let motion: Vec<f64> = (0..500).map(|n| libm::cos(omega * n as f64 * step + phase)).collect();
                assert!((frequency(&motion, step).unwrap() / omega - 1.0).abs() < 1e-9);
            }
        }
        assert_eq!(frequency(&[0.0; 9], step), None);
    }
}
