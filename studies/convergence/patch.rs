//! `asks = "patch"`: fields that a lattice keeps exactly, found at rest in a held frame: uniform strain by every lattice,
//! bending in the plane by those with the intended moduli. Others feel a force that no refinement takes away.

use super::foreign::ForeignField;
use super::framed::{Field, Framed, STRAIN};
use super::patch_report as report;
use super::path::{Level, PathAsked, Refine, Sequence, WeightsAsked};
use super::space::{In, Space};
use super::whole;
use crate::bar::names;
use crate::bar::pulsed::material;
use crate::dispersion::curve::reference_lattice;
use crate::dispersion::words::BodyName;
use crate::foreign::Foreign;
use crate::levels::{self, Errors, relative};
use crate::question::{Answer, Claiming, Effort, Place, Planned, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::compare::richardson::extrapolate;
use pd_verify::material::Body;
use pd_verify::scene::{Positive, Scene, Wrong};
use pd_verify::verdict::Evidence;
use pd_verify_reference::bent_plate::BentPlate;
use pd_verify_reference::lattice::{Moduli, plane_moduli};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PatchAsked {
    /// A plate.
    pub body: BodyName,
    /// Side of the free square; the frame lies around it.
    pub side_m: Positive,
    pub field: Field,
    pub path: PathAsked,
    pub weights: WeightsAsked,
}

/// The case, checked.
pub struct Patch {
    pub title: String,
    pub field: Field,
    side: f64,
    pub tracks: Vec<Track>,
}

/// A refinement.
pub struct Track {
    pub name: String,
    pub sequence: Sequence,
    levels: Vec<Framed>,
    /// By the reference, over the intended ones; of each level.
    pub moduli: Vec<Moduli>,
}

/// What one level showed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kept {
    /// Of the displacement at rest, relative.
    pub errors: Errors,
    /// Largest difference of the displacement over the largest displacement.
    pub far: f64,
    /// Force per volume on free nodes at the exact field over its unit, its mean and what the reference has; along y.
    pub force: f64,
    pub residual: f64,
    /// Largest difference from the reference, over the same unit.
    pub force_far: f64,
}

impl Asked for PatchAsked {
    type Question = Patch;

    fn check(&self, written: &Written<'_>) -> Result<Patch, Wrong> {
        let body = Body::from(self.body);
        if body == Body::Bar {
            return Err(Wrong::new(
                "body",
                "a bar has no patch test of this kind",
                "take a plate, or asks = \"statics\"",
            ));
        }
        let (material, title) = (material(written)?, written.title.to_owned());
        let sequences = self.path.sequences(body, &self.weights)?;
        let finest: Vec<_> = sequences.iter().map(|one| one.lattice(one.finest())).collect();
        let mut tracks = Vec::new();
        for (sequence, name) in sequences.into_iter().zip(names::names(&finest)) {
            let framed = |level: &Level| {
                let lattice = sequence.lattice(*level);
                Framed::new(self.field, (material, body), lattice, self.side_m.0, level.spacing)
            };
            let levels = sequence.levels.iter().map(framed).collect::<Result<_, _>>()?;
            let of = |level: &Level| plane_moduli(reference_lattice(sequence.lattice(*level)));
            let moduli = sequence.levels.iter().map(of).collect();
            let track = Track { name, moduli, levels, sequence };
            if self.field == Field::Bending && !track.right() && track.sequence.refine != Refine::Delta {
                let message =
                    format!("{}: its moduli change along the path, and with them its error", track.name);
                return Err(Wrong::new(
                    "path.refine",
                    message,
                    "take refine = \"delta\", or calibrated = true",
                ));
            }
            tracks.push(track);
        }
        Ok(Patch { title, field: self.field, side: self.side_m.0, tracks })
    }
}

impl Track {
    /// Whether every level has the intended moduli.
    pub fn right(&self) -> bool {
        self.sequence.levels.iter().all(|level| <In as Space<2>>::intended(self.sequence.lattice(*level)))
    }
}

impl Patch {
    /// Cells along a side of the largest square, frame included.
    fn cells(&self) -> f64 {
        let all = self.tracks.iter().flat_map(|track| &track.levels);
        all.map(|level| level.nodes()[0] as f64).fold(0.0, f64::max)
    }

    /// What conjugate gradients may lose, over the largest displacement: κ(1e-14 + 10 ε).
    fn lost(&self) -> f64 {
        2.0 * self.cells().powi(2) * (1e-14 + 10.0 * f64::EPSILON)
    }

    /// What forces are measured in: C₁₁ times the strain over the side, the force that bending is without.
    fn unit(&self, scene: &Scene<2>) -> f64 {
        scene.modulus() * STRAIN / self.side
    }

    fn solve(&self, subject: &dyn Subject, framed: &Framed, moduli: Moduli) -> Result<Kept, String> {
        let residual = match self.field {
            Field::Strain => 0.0,
            Field::Bending => BentPlate::intended(1.0).residual(moduli),
        };
        let (mut pairs, mut far, mut forces) = (Vec::new(), 0.0_f64, Vec::new());
        for scene in &framed.scenes {
            let exact = framed.exact(scene);
            let rest = framed.of_free(subject.rest_plate(scene)?)?;
            let force = framed.of_free(subject.bond_force_plate(scene)?)?;
            let mine: Vec<(f64, f64)> = rest.into_iter().flatten().zip(exact.into_iter().flatten()).collect();
            let peak = largest(mine.iter().map(|(_, exact)| exact.abs())).unwrap_or(f64::NAN);
            let most = largest(mine.iter().map(|(u, exact)| (u - exact).abs() / peak));
            far = largest([far, most.unwrap_or(f64::NAN)]).unwrap_or(f64::NAN);
            pairs.extend(mine);
            forces.extend(force.into_iter().map(|f| f.map(|f| f / self.unit(scene))));
        }
        let away = forces.iter().flat_map(|force| [force[0].abs(), (force[1] - residual).abs()]);
        Ok(Kept {
            errors: relative(pairs),
            far,
            force: forces.iter().map(|force| force[1]).sum::<f64>() / forces.len() as f64,
            residual,
            force_far: largest(away).unwrap_or(f64::NAN),
        })
    }

    fn follow(&self, subject: &dyn Subject, track: &Track) -> Result<Vec<Kept>, String> {
        let levels = track.levels.par_iter().zip(&track.moduli);
        let kept: Vec<_> = levels.map(|(level, moduli)| self.solve(subject, level, *moduli)).collect();
        kept.into_iter().collect()
    }

    /// Whether a track keeps the field.
    pub fn keeps(&self, track: &Track) -> bool {
        self.field == Field::Strain || track.right()
    }

    /// What of the error at the finest level the three finest leave at δ → 0.
    fn stays(&self, track: &Track, kept: &[Kept]) -> Evidence {
        let errors = refinement(track, kept).in_norm(1);
        let [.., coarse, middle, fine] = errors[..] else { return Evidence::default() };
        let note = |left: String| format!("{}: {:.4} at the finest level, {left}", track.name, fine.1);
        match extrapolate([fine, middle, coarse]) {
            Ok(found) => Evidence {
                computed: Some(found.value / fine.1),
                note: note(format!("{:.4} at δ → 0", found.value)),
                ..Evidence::default()
            },
            Err(none) => Evidence {
                outside: fine.1.is_finite().then(|| none.reason().to_owned()),
                note: note("none beyond".into()),
                ..Evidence::default()
            },
        }
    }

    fn evidence(&self, kept: &[Vec<Kept>]) -> Vec<(String, Evidence)> {
        let both = || self.tracks.iter().zip(kept);
        let note =
            format!("{} lattices, {} levels", self.tracks.len(), kept.iter().map(Vec::len).sum::<usize>());
        let forces = both().flat_map(|(_, kept)| kept.iter().map(|one| one.force_far));
        let mut evidence = vec![("force".into(), error_of(largest(forces), note.clone()))];
        let keeping = both().filter(|(track, _)| self.keeps(track));
        let far: Vec<f64> = keeping.flat_map(|(_, kept)| kept.iter().map(|one| one.far)).collect();
        if !far.is_empty() {
            evidence.push(("kept".into(), error_of(largest(far), note)));
        }
        let others = both().filter(|(track, _)| !self.keeps(track));
        let least = others.map(|(track, kept)| self.stays(track, kept)).min_by(|a, b| {
            let of = |one: &Evidence| one.computed.filter(|left| !left.is_nan()).unwrap_or(f64::NEG_INFINITY);
            of(a).total_cmp(&of(b))
        });
        evidence.extend(least.map(|found| ("stays".to_owned(), found)));
        evidence
    }
}

impl Patch {
    fn foreign_field(&self, index: usize, framed: &Framed) -> Option<ForeignField<'_>> {
        let scene = framed.scenes.get(index)?;
        let (fields, held) = (scene.displacement.clone(), 0.5 * (scene.size()[0] - self.side));
        let exact = move |at: [f64; 2]| {
            let mut u = [0.0; 2];
            fields.iter().for_each(|field| u[field.component] += field.at(at.map(|x| x + held)));
            u
        };
        let (name, what) = match (self.field, index) {
            (Field::Bending, _) => ("bending", "u_x = −κXY, u_y = ½κ(X² + Y²/3), κ = 10⁻⁶/side"),
            (Field::Strain, 0) => ("strain-along-x", "u_x = 10⁻⁶ X, u_y = 0"),
            (Field::Strain, 1) => ("strain-along-y", "u_x = 0, u_y = 10⁻⁶ Y"),
            (Field::Strain, _) => ("shear", "u_x = 10⁻⁶ Y, u_y = 10⁻⁶ X"),
        };
        let bound = match self.field {
            Field::Strain => (
                1e-6,
                Basis::Engineering,
                "every lattice keeps uniform strain exactly: what is left is where the solver stops, and how many digits were written",
            ),
            Field::Bending => (
                1e-3,
                Basis::Engineering,
                "lattices with the intended moduli keep bending exactly, and elements of the second order too; others are off by percents, which no refinement takes away",
            ),
        };
        let material = scene.material;
        let problem = vec![
            (
                "Geometry",
                format!(
                    "A square of {} m a side, its lower left corner at (0, 0), without load; all around it a frame, as wide as a family reaches (in local elasticity its edges alone), is held at the displacement below. X and Y are counted from the middle of the square.",
                    self.side
                ),
            ),
            (
                "Material",
                format!(
                    "Linear elastic, E = {} Pa, ν' = C₁₂/C₁₁ = 1/3 of the body as it is computed.",
                    material.youngs_modulus
                ),
            ),
            ("Displacement", format!("{what}, in m: what the frame is held at, and the answer inside.")),
        ];
        Some(ForeignField {
            title: &self.title,
            name,
            side: self.side,
            exact: Box::new(exact),
            bound,
            problem,
            source: if self.field == Field::Strain {
                "uniform strain is without force"
            } else {
                "bending in the plane, in closed form"
            },
            wrong: Vec::new(),
        })
    }
}

impl Question for Patch {
    fn foreign(&self) -> Vec<Box<dyn Foreign + '_>> {
        let Some(framed) = self.tracks.first().and_then(|track| track.levels.first()) else {
            return Vec::new();
        };
        let fields = (0..framed.scenes.len()).filter_map(|index| self.foreign_field(index, framed));
        fields.map(|field| Box::new(field) as Box<dyn Foreign + '_>).collect()
    }

    fn claims(&self, place: &Place) -> Vec<Claim> {
        let what = match self.field {
            Field::Strain => "three uniform strains",
            Field::Bending => "bending in the plane",
        };
        let (moment, source) = match self.field {
            Field::Strain => {
                ("nothing: bonds come in pairs ±ξ", "uniform strain is without force in every lattice")
            }
            Field::Bending => (
                "κ(ν'C₁₁ − C₁₂): third derivatives vanish",
                "the bent plate's residual with moduli summed in double-double arithmetic",
            ),
        };
        let rounding = 32.0 * f64::EPSILON * self.cells().powi(2);
        let mut claims = vec![
            claim(place, "force", format!("largest difference of the bonds' force under {what} from the exact one, over C₁₁ times strain over side"))
                .at_most(ErrorKind::MaxOfPeak, rounding)
                .because(Basis::Rounding, format!("a full family feels {moment}. Each of Σ w ≤ 8/3 (weights over C₁₁/Δx², of w r² = 8/3) takes a few roundings of ε of at most ε₀L, which C₁₁/Δx² makes N² in this unit: 32 ε N²"))
                .source(source),
        ];
        if self.tracks.iter().any(|track| self.keeps(track)) {
            claims.push(
                claim(place, "kept", format!("largest difference at rest from {what}, over the largest displacement"))
                    .at_most(ErrorKind::MaxOfPeak, self.lost())
                    .because(Basis::Rounding, "the field is without force, so the held plate is at rest in it. Conjugate gradients stop at 1e-14 and lose 10 ε: times κ ≤ 2N², the largest eigenvalue being at most 4 Σ w ≤ 32/3, the smallest of a held square at least 2π²/(3N²), shear alone")
                    .source("the field that the frame is held at"),
            );
        }
        if self.tracks.iter().any(|track| !self.keeps(track)) {
            claims.push(
                claim(place, "stays", format!("error in l2 of {what} that lattices with other moduli than intended keep at δ → 0, extrapolated from the three finest levels, over that at the finest: the least"))
                    .at_least(0.9)
                    .because(Basis::Theory, "order 0: the force κ(ν'C₁₁ − C₁₂) per volume that is left does not depend on δ, and what it moves does not fall; the frame's edge, known to about δ, changes it by a share of order δ/L, for which 0.1 is left")
                    .source("the bent plate's residual with moduli summed in double-double arithmetic"),
            );
        }
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.tracks.iter().flat_map(|track| &track.levels).map(|level| level.plan.clone()).collect()
    }

    fn effort(&self) -> Effort {
        let mut total = Effort::default();
        for level in self.tracks.iter().flat_map(|track| &track.levels) {
            level.scenes.iter().for_each(|_| total += whole::resting(&level.plan, level.nodes()[0]));
        }
        total
    }

    fn equations(&self) -> &'static str {
        "0 = Σ_b w_b n (n·(u_b − u)) on free nodes, u held in a frame as wide as a family, without load
strain: u = ε₀(x, 0), ε₀(0, y), ε₀(y, x): no force
bending: u_x = −κxy, u_y = ½κ(x² + ν'y²), ν' = 1/3: f_y = κ(ν'C₁₁ − C₁₂), 0 with the intended moduli"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let kept: Vec<_> = self.tracks.par_iter().map(|track| self.follow(subject, track)).collect();
        match kept.into_iter().collect::<Result<Vec<Vec<Kept>>, String>>() {
            Err(failure) => Answer::failed(&self.claims(place), &failure),
            Ok(kept) => Answer {
                evidence: self.evidence(&kept),
                tables: report::tables(self, &kept, place),
                figures: report::figures(self, &kept, place),
                ..Answer::default()
            },
        }
    }
}

/// Levels of a track as a refinement.
pub fn refinement(track: &Track, kept: &[Kept]) -> levels::Sequence {
    let steps = track.sequence.levels.iter().map(|level| track.sequence.step(*level));
    let levels = steps.zip(kept.iter().map(|one| one.errors)).collect();
    levels::Sequence { name: track.name.clone(), levels }
}
