//! `asks = "spectrum"`: what a released bar's strain is made of, and which of its waves go wrong: frequencies measured in
//! the march, beside the dispersion curve; the error of each mode by wavenumber.

use super::names::{names, slug};
use super::released::{BarAsked, LINE, Released, STRAIN, evenly, planned, whole_bar};
use super::spectrum_report;
use crate::dispersion::curve::reference_lattice;
use crate::dispersion::sweep::LatticeSweep;
use crate::question::{Answer, Claiming, Place, Planned, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::record::Record;
use pd_verify::scene::{Beyond, Positive, Probe, Scene, StepRule, Time, Watch, Wrong};
use pd_verify_reference as reference;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::PI;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpectrumAsked {
    pub bar: BarAsked,
    pub dx_m: Positive,
    pub duration_s: Positive,
    pub time_step_s: Positive,
    /// Where the strain is watched.
    pub probe_m: Positive,
    pub lattice: LatticeSweep,
}

/// The case, checked.
pub struct Spectrum {
    pub title: String,
    pub bar: Released,
    pub scenes: Vec<(Scene<1>, Plan)>,
    pub lattices: Vec<Lattice>,
    pub labels: Vec<String>,
}

/// What the march says of one mode sin(kx), k = (2n+1)π/2L.
pub struct Mode {
    /// In 1/m.
    pub k: f64,
    /// ω/v in 1/m, as measured and as the dispersion relation with leapfrog says.
    pub measured: f64,
    pub predicted: f64,
    /// Root mean square over the run of (marched − exact) amplitude, over the amplitude at t = 0: as measured, and as
    /// the two frequencies say.
    pub error: f64,
    pub predicted_error: f64,
}

/// What one lattice's march brought.
pub struct Heard {
    pub record: Record,
    pub modes: Vec<Mode>,
    /// Waves shorter than this, in 1/m, turn by more than π from one look to the next.
    pub resolved: f64,
}

/// Looks at the whole bar, and nodes that the projection on its modes can take.
const LOOKS: u64 = 240;
const MAX_NODES: usize = 2000;

impl Asked for SpectrumAsked {
    type Question = Spectrum;

    fn check(&self, written: &Written<'_>) -> Result<Spectrum, Wrong> {
        let bar = self.bar.check(written.material()?)?;
        let lattices = self.lattice.marched(Body::Bar, 2).map_err(|wrong| wrong.inside("lattice"))?;
        let step = StepRule::Given { seconds: self.time_step_s.0, beyond_limit: Beyond::Refused };
        let marching = Time { duration: self.duration_s.0, step };
        let look = |steps: u64| {
            let strain = Probe { name: STRAIN.into(), watch: Watch::Strain { at: self.probe_m.0 }, every: 1 };
            vec![strain, whole_bar((steps / LOOKS).max(1))]
        };
        let mut scenes = Vec::new();
        for &lattice in &lattices {
            let scene = bar.scene(lattice, self.dx_m.0, marching, Vec::new())?;
            if scene.nodes[0] > MAX_NODES {
                let message = format!("{} nodes have too many modes to be listened to", scene.nodes[0]);
                return Err(Wrong::new("dx_m", message, format!("take at most {MAX_NODES} nodes")));
            }
            scenes.push(planned(scene, look)?);
        }
        let labels = names(&lattices);
        Ok(Spectrum { title: written.title.to_owned(), bar, scenes, lattices, labels })
    }
}

impl Question for Spectrum {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let of = |lattice: &Lattice, label: &String| {
            let slug = slug(*lattice);
            let source = "the lattice's dispersion relation in double-double arithmetic, (2/Δt) asin(ωΔt/2)";
            [
                claim(place, &format!("frequencies_{slug}"), format!("largest relative error of ω measured in the march, all modes: {label}"))
                    .at_most(ErrorKind::Relative, 1e-6)
                    .because(Basis::Rounding, "1e-12 of an amplitude that may be 1e-6 of the first one's; cos ωτ is as flat as (ωτ)² for the longest waves")
                    .source(source),
                claim(place, &format!("error_by_wavenumber_{slug}"), format!("largest difference of the modes' errors from those predicted by their frequencies: {label}"))
                    .at_most(ErrorKind::Absolute, 1e-6)
                    .because(Basis::Rounding, "1e-12 of an amplitude that may be 1e-6 of the first one's")
                    .source(source),
            ]
        };
        self.lattices.iter().zip(&self.labels).flat_map(|(lattice, label)| of(lattice, label)).collect()
    }

    fn scenes(&self) -> Vec<Planned> {
        self.scenes.iter().map(|(_, plan)| plan.clone()).collect()
    }

    fn equations(&self) -> &'static str {
        "a_n(t) = (2/N) Σ_j u_j(t) sin(k_n x_j), k_n = (2n+1)π/2L; a_n(t) = a_n(0) cos ω_n t
measured: cos ωτ = Σ a(t)(a(t+τ) + a(t−τ)) / 2Σ a(t)²"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let heard: Result<Vec<Heard>, String> =
            self.scenes.par_iter().map(|(scene, plan)| self.listen(subject, scene, plan)).collect();
        let heard = match heard {
            Ok(heard) => heard,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        let evidence = self.lattices.iter().zip(&heard).flat_map(|(lattice, heard)| {
            let slug = slug(*lattice);
            let count = format!("{} modes", heard.modes.len());
            let frequency =
                largest(heard.modes.iter().map(|mode| (mode.measured / mode.predicted - 1.0).abs()));
            let error = largest(heard.modes.iter().map(|mode| (mode.error - mode.predicted_error).abs()));
            [
                (format!("frequencies_{slug}"), error_of(frequency, count.clone())),
                (format!("error_by_wavenumber_{slug}"), error_of(error, count)),
            ]
        });
        Answer {
            evidence: evidence.collect(),
            tables: vec![spectrum_report::table(self, &heard, place)],
            figures: vec![spectrum_report::figure(self, &heard, place)],
            ..Answer::default()
        }
    }
}

impl Spectrum {
    fn listen(&self, subject: &dyn Subject, scene: &Scene<1>, plan: &Plan) -> Result<Heard, String> {
        let record = subject.march_bar(scene).map_err(|failure| failure.to_string())?;
        let bar = record.trace(LINE).ok_or("the bar was not recorded")?;
        let nodes = scene.nodes[0];
        let courant = self.bar.courant(scene, plan);
        let every = scene.probes[1].every;
        // An interval of so many steps turns the fastest mode by less than π only if it is one step.
        let apart = every as f64 * courant;
        let looks = evenly(plan, &scene.probes[1]);
        let amplitudes: Vec<Vec<f64>> = bar.rows.iter().take(looks).map(|row| project(row)).collect();
        let mode = |n: usize| {
            let theta = (2 * n + 1) as f64 * PI / (2 * nodes) as f64;
            let wave = reference::lattice::bar(reference_lattice(scene.lattice), theta);
            let predicted = reference::leapfrog::wave(wave, courant)?.omega;
            let history: Vec<f64> = amplitudes.iter().map(|at| at[n]).collect();
            let cosine = turn(&history);
            let rms = |of: &dyn Fn(usize) -> f64| {
                let squares: f64 = (0..history.len()).map(|look| of(look).powi(2)).sum();
                (squares / history.len() as f64).sqrt()
            };
            let exact = |look: usize| libm::cos(theta * apart * look as f64);
            Some(Mode {
                k: theta / scene.spacing,
                measured: unfold(libm::acos(cosine.clamp(-1.0, 1.0)), predicted * apart)
                    / apart
                    / scene.spacing,
                predicted: predicted / scene.spacing,
                error: rms(&|look| history[look] / history[0] - exact(look)),
                predicted_error: rms(&|look| libm::cos(predicted * apart * look as f64) - exact(look)),
            })
        };
        let modes = (0..nodes).map(mode).collect::<Option<Vec<_>>>().ok_or("leapfrog is unstable")?;
        Ok(Heard { record, modes, resolved: PI / (apart * scene.spacing) })
    }
}

/// Amplitudes of the modes sin((2n+1)π(j + ½)/2N).
fn project(row: &[f64]) -> Vec<f64> {
    let nodes = row.len();
    let quarter: Vec<f64> = (0..8 * nodes).map(|q| libm::sin(PI * q as f64 / (4 * nodes) as f64)).collect();
    let amplitude = |n: usize| {
        let sine = |j: usize| quarter[(2 * n + 1) * (2 * j + 1) % (8 * nodes)];
        2.0 / nodes as f64 * row.iter().enumerate().map(|(j, u)| u * sine(j)).sum::<f64>()
    };
    (0..nodes).map(amplitude).collect()
}

/// cos ωτ of a history sampled every τ.
fn turn(history: &[f64]) -> f64 {
    let middle = &history[1..history.len() - 1];
    let sums = history.iter().zip(&history[2..]).map(|(before, after)| before + after);
    let products: f64 = middle.iter().zip(sums).map(|(a, sum)| a * sum).sum();
    products / (2.0 * middle.iter().map(|a| a * a).sum::<f64>())
}

/// The angle of the same cosine that is nearest to another: sampling leaves whole turns open.
fn unfold(angle: f64, near: f64) -> f64 {
    let turns = (near / (2.0 * PI)).floor();
    let candidates = [-1.0, 0.0, 1.0].into_iter().flat_map(|shift| {
        let base = 2.0 * PI * (turns + shift);
        [base + angle, base - angle]
    });
    candidates.min_by(|a, b| (a - near).abs().total_cmp(&(b - near).abs())).unwrap_or(angle)
}
