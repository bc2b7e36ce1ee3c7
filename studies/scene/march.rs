//! `asks = "march"`: a scene of one's own is marched in time; its probes are written down, and it is judged by what
//! every march must keep and by what its author expects.

use super::body;
use super::diverged;
use super::edges::EdgesAsked;
use super::effects::{Acting, EffectAsked};
use super::either::Either;
use super::expect::{Expect, ExpectAsked};
use super::figures::figures;
use super::march_claims::{claims, evidence, why};
use super::operators::Twice;
use super::probe_table::{MAX_ROWS, table};
use super::probes::{ProbeAsked, looks, quantities};
use super::snapshots::{self, SnapshotAsked, check_files};
use crate::bar::names::differences;
use crate::dispersion::sweep::LatticeSweep;
use crate::dispersion::words::BodyName;
use crate::input::{OneOrMany, Refusal};
use crate::question::{Answer, Place, Planned, Question};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::Claim;
use pd_verify::forces::surface::Correction;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::record::{Failure, Record};
use pd_verify::scene::{HoleAsked, InitialAsked, NotchAsked, Operator, Positive, Rotations, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MarchAsked {
    pub body: BodyName,
    /// The length of a bar; [length, height] of a plate.
    pub size_m: OneOrMany<Positive>,
    /// Must divide the size.
    pub dx_m: Positive,
    /// Of a bar; default 1.
    pub section_m2: Option<Positive>,
    /// Of a plate; default 1.
    pub thickness_m: Option<Positive>,
    pub duration_s: f64,
    /// Largest Δt over the limit of the lattice; default 0.8.
    pub safety: Option<f64>,
    /// Δt itself, in place of `safety`.
    pub time_step_s: Option<f64>,
    /// Whether `time_step_s` may be above the limit: then it is marched until growth shows. Default `false`.
    pub unstable: Option<bool>,
    /// Default `small`.
    pub rotations: Option<Rotations>,
    /// Default `stencil`.
    pub operator: Option<Operator>,
    /// Default `none`.
    pub surface_correction: Option<Correction>,
    pub edges: Option<EdgesAsked>,
    /// Of a plate: straight cuts, which part the bonds that cross them.
    pub notch: Option<Vec<NotchAsked>>,
    /// Of a plate: round holes, which remove the nodes within and cut the bonds across.
    pub hole: Option<Vec<HoleAsked>>,
    /// Every combination is a scene.
    pub lattice: LatticeSweep,
    /// Fields at t = 0, summed.
    pub initial: Option<Vec<InitialAsked>>,
    /// What acts beside the bonds.
    pub effect: Option<Vec<EffectAsked>>,
    /// What is seen; a plate may be watched by snapshots alone.
    #[serde(default)]
    pub probe: Vec<ProbeAsked>,
    /// Of a plate: displacement and velocity of all nodes at chosen times.
    pub snapshot: Option<Vec<SnapshotAsked>>,
    /// Numbers that a probe must see.
    pub expect: Option<Vec<ExpectAsked>>,
}

/// The case, checked.
pub struct March {
    pub title: String,
    pub scenes: Vec<Marched>,
    pub expect: Vec<Expect>,
    pub snapshots: Vec<SnapshotAsked>,
}

/// A scene with its plan, and its beginning by both operators where that can be afforded.
pub struct Marched {
    pub scene: Either,
    pub plan: Plan,
    pub twice: Option<Twice>,
}

/// A case of more scenes is a slip of the pen.
const MAX_SCENES: usize = 100;

impl Asked for MarchAsked {
    type Question = March;

    fn read_parts(&mut self, written: &Written<'_>) -> Result<(), Refusal> {
        let effects = self.effect.iter_mut().flatten().enumerate();
        effects.into_iter().try_for_each(|(index, effect)| effect.read(written, index))
    }

    fn check(&self, written: &Written<'_>) -> Result<March, Wrong> {
        let material = written.material()?;
        let of = Body::from(self.body);
        let lattices = self.lattice.marched(of, 3).map_err(|wrong| wrong.inside("lattice"))?;
        if lattices.len() > MAX_SCENES {
            let message =
                format!("{} scenes are asked for, at most {MAX_SCENES} are marched", lattices.len());
            return Err(Wrong::new("lattice", message, "shorten its lists, or split the case"));
        }
        if self.probe.is_empty() && self.snapshot.as_ref().is_none_or(Vec::is_empty) {
            let help = "add a [[case.probe]] table, or a [[case.snapshot]] of a plate";
            return Err(Wrong::new("", "nobody watches this march", help));
        }
        let effects: Vec<&Acting> = self.effect.iter().flatten().filter_map(EffectAsked::acting).collect();
        let mut scenes = Vec::new();
        for (lattice, name) in
            lattices.iter().zip(names(&lattices, written.value["id"].as_str().unwrap_or(written.title)))
        {
            let (scene, plan): (Either, Plan) = if of == Body::Bar {
                let effects: Vec<_> = effects.iter().map(|effect| effect.on_bar.clone()).collect();
                let (scene, plan) = body::scene::<1>(self, name, material, *lattice, &effects)?;
                (scene.into(), plan)
            } else {
                let effects: Vec<_> = effects.iter().map(|effect| effect.on_plate.clone()).collect();
                let (scene, plan) = body::scene::<2>(self, name, material, *lattice, &effects)?;
                (scene.into(), plan)
            };
            let twice = Twice::of(&scene, &plan)?;
            scenes.push(Marched { scene, plan, twice });
        }
        self.check_rows(&scenes, of.dimension())?;
        check_files(self, &scenes)?;
        let plans: Vec<&Plan> = scenes.iter().map(|one| &one.plan).collect();
        let mut expect: Vec<Expect> = Vec::new();
        for (index, asked) in self.expect.iter().flatten().enumerate() {
            let found = asked.check(index, &expect, &self.probe, &plans, of.dimension());
            expect.push(found.map_err(|wrong| wrong.inside(&format!("expect[{index}]")))?);
        }
        let snapshots = self.snapshot.clone().unwrap_or_default();
        Ok(March { title: written.title.to_owned(), scenes, expect, snapshots })
    }
}

impl MarchAsked {
    /// Refuses a table that nobody could open.
    fn check_rows(&self, scenes: &[Marched], dimension: usize) -> Result<(), Wrong> {
        let of = |one: &Marched, probe: &ProbeAsked| {
            let columns = (one.scene.places(&probe.name) * quantities(probe.watches, dimension).len()) as u64;
            looks(probe.watches, probe.every(one.plan.steps), &one.plan).2.saturating_mul(columns)
        };
        let each = self.probe.iter().map(|probe| scenes.iter().map(|one| of(one, probe)).sum::<u64>());
        let each: Vec<u64> = each.collect();
        let rows = each.iter().fold(0_u64, |sum, rows| sum.saturating_add(*rows));
        if rows <= MAX_ROWS {
            return Ok(());
        }
        let most = (0..each.len()).max_by_key(|&index| each[index]).unwrap_or(0);
        let message = format!("{rows} rows are asked for, at most {MAX_ROWS} are written by a case");
        let help =
            "take a larger every_steps, or leave it out: there are then at most 2000 looks, 6 of a line";
        Err(Wrong::new(format!("probe[{most}].every_steps"), message, help))
    }
}

/// A name for each scene: the case's own, or what distinguishes its lattices.
fn names(lattices: &[Lattice], case: &str) -> Vec<String> {
    let named = |name: String| if name.is_empty() { case.to_owned() } else { name };
    differences(lattices).into_iter().map(named).collect()
}

impl Question for March {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        claims(self, place)
    }

    fn scenes(&self) -> Vec<Planned> {
        let alone = self.scenes.len() == 1;
        let of = |one: &Marched| {
            let mut plans = vec![one.plan.clone()];
            plans.extend(one.twice.iter().flat_map(|twice| twice.plans.clone()));
            let own = format!("{}, ", one.plan.name);
            // Where there is one scene only, its name says nothing.
            for plan in plans.iter_mut().skip(1).filter(|_| alone) {
                plan.name = plan.name.strip_prefix(&own).unwrap_or(&plan.name).to_owned();
            }
            plans
        };
        self.scenes.iter().flat_map(of).collect()
    }

    fn equations(&self) -> &'static str {
        "ρü(x) = Σ w (ξ⊗ξ/|ξ|²)(u(x + ξ) − u(x)) + b, or with finite rotations Σ w e y/|y|, y = ξ + η, e = |y| − |ξ|
leapfrog: v(n + ½) = v(n − ½) + Δt a(n), u(n + 1) = u(n) + Δt v(n + ½); v(n) = (u(n + 1) − u(n − 1))/2Δt
ledger: ½ρV Σ v(n + ½)² + ½ u(n)ᵀK u(n + 1) − work + energy of cut bonds is constant; momentum: P(t) = P(0) + ∫ loads dt"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let runs: Vec<Result<Record, Failure>> =
            self.scenes.iter().map(|one| one.scene.march(subject)).collect();
        let seen = || runs.iter().filter_map(diverged::seen);
        let ran = || self.scenes.iter().zip(&runs).filter_map(|(one, run)| Some((one, diverged::seen(run)?)));
        let alone = self.scenes.len() == 1;
        let mut tables = vec![table(seen(), place)];
        tables.extend(diverged::table(&runs, place));
        let mut figures = figures(&self.title, &seen().collect::<Vec<_>>(), place);
        figures.extend(snapshots::figures(
            &self.title,
            &self.snapshots,
            &ran().collect::<Vec<_>>(),
            alone,
            place,
        ));
        diverged::flag(&mut figures, &runs);
        let failure = runs.iter().find_map(|run| run.as_ref().err());
        let evidence = match failure {
            Some(failure) => Answer::failed(&self.claims(place), &why(self, failure)).evidence,
            None => evidence(self, &seen().collect::<Vec<_>>(), subject),
        };
        let files = self
            .scenes
            .iter()
            .zip(runs)
            .flat_map(|(one, run)| diverged::files(&self.snapshots, one, run, alone, place));
        Answer { evidence, tables, figures, files: files.collect() }
    }
}
