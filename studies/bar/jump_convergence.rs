//! `asks = "jump_convergence"`: how fast the error of a released bar falls with the spacing, and where it stops falling.
//!
//! A dispersive front is an Airy function's integral of width h ∝ Δx^{2/3}; behind it ripples fall off only like
//! (distance/h)^{-3/4}, so that the mean error over a bar is h^{3/4} ∝ Δx^{1/2}: half an order, for every calibrated
//! lattice. A lattice of the wrong long-wave speed tends to the error of a square wave of that speed.

use super::jump;
use super::names::{LATTICE, lattice_cells, names, slug};
use super::released::{BarAsked, LINE, Released, STRAIN, marching, planned, whole_bar};
use crate::dispersion::sweep::LatticeSweep;
use crate::levels::{order_of, pairwise, refining};
use crate::question::{Answer, Claiming, Place, Planned, Question, claim, error_of, value_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use pd_verify::report::plot::{Axis, Figure, Guide, Lines, Series};
use pd_verify::scene::{Positive, Probe, Scene, Watch, Wrong};
use pd_verify::table::{Cell, Table};
use pd_verify::verdict::Evidence;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JumpConvergenceAsked {
    pub bar: BarAsked,
    /// Falling, at least three.
    pub dx_m: Vec<Positive>,
    pub duration_s: Positive,
    /// Largest time step over the limit; default 0.8.
    pub safety: Option<Positive>,
    /// Where the strain is watched.
    pub probe_m: Positive,
    pub lattice: LatticeSweep,
    /// Claims these errors, one for each spacing, for a case of one lattice.
    pub l1_expected: Option<Vec<Positive>>,
}

/// The case, checked.
pub struct JumpConvergence {
    title: String,
    bar: Released,
    place: f64,
    duration: f64,
    sequences: Vec<Sequence>,
    expected: Option<Vec<f64>>,
}

/// A lattice and its scenes, coarse to fine.
struct Sequence {
    lattice: Lattice,
    name: String,
    scenes: Vec<(Scene<1>, Plan)>,
    /// Long-wave speed over the classical one.
    speed: f64,
}

/// One level: the error, and the largest difference from the lattice's own modes at the end.
struct Level {
    spacing: f64,
    l1: f64,
    modes: f64,
}

impl Asked for JumpConvergenceAsked {
    type Question = JumpConvergence;

    fn check(&self, written: &Written<'_>) -> Result<JumpConvergence, Wrong> {
        let bar = self.bar.check(written.material()?)?;
        let spacings = refining("dx_m", &self.dx_m, |coarse, fine| coarse > fine)?;
        let marching = marching(self.duration_s, None, self.safety)?;
        let lattices =
            self.lattice.marched(Body::Bar, 2 * spacings.len()).map_err(|wrong| wrong.inside("lattice"))?;
        let place = self.probe_m.0;
        let mut sequences = Vec::new();
        for (&lattice, name) in lattices.iter().zip(names(&lattices)) {
            let look = |steps| {
                vec![
                    Probe { name: STRAIN.into(), watch: Watch::Strain { at: place }, every: 1 },
                    whole_bar(steps),
                ]
            };
            let scene = |&dx: &f64| planned(bar.scene(lattice, dx, marching, Vec::new())?, look);
            let scenes = spacings.iter().map(scene).collect::<Result<Vec<_>, Wrong>>()?;
            let unusable =
                |wrong: pd_verify::lattice::Unusable| Wrong::new("lattice", wrong.to_string(), wrong.cure());
            let speed = Stencil::<1>::new(lattice).map_err(unusable)?.after.c11.sqrt();
            sequences.push(Sequence { lattice, name, scenes, speed });
        }
        let expected = self.l1_expected.as_ref().map(|list| list.iter().map(|l1| l1.0).collect::<Vec<f64>>());
        if expected.as_ref().is_some_and(|list| list.len() != spacings.len() || sequences.len() != 1) {
            let message = "expected errors go with one lattice, one for each spacing";
            return Err(Wrong::new("l1_expected", message, "leave them out, or ask for one lattice"));
        }
        let title = written.title.to_owned();
        Ok(JumpConvergence { title, bar, place, duration: marching.duration, sequences, expected })
    }
}

impl Sequence {
    fn right_speed(&self) -> bool {
        (self.speed - 1.0).abs() < 1e-12
    }

    fn slug(&self) -> String {
        slug(self.lattice)
    }
}

impl Question for JumpConvergence {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let mut claims = vec![
            claim(place, "modes", "largest displacement error at the end against modes carried by leapfrog")
                .at_most(ErrorKind::MaxOfPeak, 1e-10)
                .because(Basis::Rounding, "some 1e-16 a step")
                .source("modes of the mirrored lattice, frequencies in double-double arithmetic"),
        ];
        for sequence in &self.sequences {
            let named = |what: &str, quantity: &str| {
                claim(place, &format!("{what}_{}", sequence.slug()), format!("{quantity}: {}", sequence.name))
            };
            if sequence.right_speed() {
                claims.push(
                    named("order", "order of the strain's mean error")
                        .order(0.5, 0.1)
                        .because(Basis::Theory, "Airy front of width Δx^(2/3) with ripples that fall off like (distance)^(-3/4); the next term is smaller by Δx^(1/6) only, which holds a fitted order up to 0.1 below 1/2 at these spacings")
                        .source("integral of the Airy function's tail (Abramowitz & Stegun 10.4.83)"),
                );
                claims.push(
                    named("front_law", "largest relative departure of the errors from aΔx^(1/2) − bΔx^(2/3), a and b positive")
                        .at_most(ErrorKind::Relative, 0.01)
                        .because(Basis::Theory, "the mean of |∫Ai| from the front to a distance X is 4X^(1/4) less a constant: both powers follow; a hundredth for fronts that are still near where they began")
                        .source("integral of the Airy function's tail (Abramowitz & Stegun 10.4.83)"),
                );
            } else {
                claims.push(
                    named("plateau", "relative error of the strain error at Δx → 0")
                        .at_most(ErrorKind::Relative, 0.05)
                        .because(Basis::Theory, "what is left is the wrong long-wave speed; extrapolated at order 1/2 from the two finest spacings, once the front is ten times narrower than its delay")
                        .source("square wave of the lattice's long-wave speed against that of v"),
                );
            }
        }
        if self.expected.is_some() {
            claims.push(
                claim(place, "values", "largest difference from the errors expected")
                    .at_most(ErrorKind::Absolute, 1e-3)
                    .because(
                        Basis::Literature,
                        "given with three digits (0.0005), in time steps not stated (0.0005)",
                    )
                    .source("an independent prototype of the same bar"),
            );
        }
        claims
    }

    fn scenes(&self) -> Vec<Planned> {
        self.sequences
            .iter()
            .flat_map(|sequence| sequence.scenes.iter().map(|(_, plan)| plan.clone()))
            .collect()
    }

    fn equations(&self) -> &'static str {
        "error E(Δx) = (1/T) ∫ |ε − ε_exact| dt / (F₀/EA)
right speed: E ∝ Δx^(1/2); speed c ≠ v: E → (1/T) ∫ |s(ct) − s(vt)| dt, s the square wave"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let marched: Result<Vec<Vec<Level>>, String> =
            self.sequences.par_iter().map(|sequence| self.levels(subject, sequence)).collect();
        let levels = match marched {
            Ok(levels) => levels,
            Err(failure) => return Answer::failed(&self.claims(place), &failure),
        };
        let modes = largest(levels.iter().flatten().map(|level| level.modes));
        let mut evidence: Vec<(String, Evidence)> = vec![("modes".into(), error_of(modes, ""))];
        evidence.extend(
            self.sequences.iter().zip(&levels).flat_map(|(sequence, levels)| self.tail(sequence, levels)),
        );
        if let Some(expected) = &self.expected {
            let found = levels.iter().flatten().zip(expected);
            let error = largest(found.map(|(level, expected)| (level.l1 - expected).abs()));
            let list: Vec<String> = levels.iter().flatten().map(|level| format!("{:.4}", level.l1)).collect();
            evidence.push(("values".into(), error_of(error, list.join(", "))));
        }
        Answer {
            evidence,
            tables: vec![self.table(&levels, place)],
            figures: vec![self.figure(&levels, place)],
            ..Answer::default()
        }
    }
}

impl JumpConvergence {
    fn levels(&self, subject: &dyn Subject, sequence: &Sequence) -> Result<Vec<Level>, String> {
        let level = |(scene, plan): &(Scene<1>, Plan)| {
            let record = subject.march_bar(scene).map_err(|failure| failure.to_string())?;
            let strain = record.trace(STRAIN).ok_or("no strain was recorded")?;
            let strains: Vec<f64> = strain.column(0).iter().map(|e| e / self.bar.exact.strain).collect();
            let errors = jump::errors(&self.bar, self.place, &strain.times, &strains, |_| f64::INFINITY);
            let bar = record.trace(LINE).ok_or("the bar was not recorded")?;
            let modes =
                self.bar.modes(scene, Some(self.bar.courant(scene, plan))).ok_or("no stable modes")?;
            let (time, row) = bar.times.last().zip(bar.rows.last()).ok_or("the bar was not recorded")?;
            let exact = modes.displacements(self.bar.cell_times(scene, *time));
            let far = row.iter().zip(exact).map(|(u, exact)| (u / self.bar.peak() - exact).abs());
            Ok(Level { spacing: scene.spacing, l1: errors.l1, modes: largest(far).unwrap_or(f64::NAN) })
        };
        sequence.scenes.iter().map(level).collect()
    }

    /// The order of a right speed, the plateau of a wrong one.
    fn tail(&self, sequence: &Sequence, levels: &[Level]) -> Vec<(String, Evidence)> {
        let points: Vec<(f64, f64)> = levels.iter().map(|level| (level.spacing, level.l1)).collect();
        if sequence.right_speed() {
            let law = front_law(&points);
            let note = law.map_or(String::new(), |(a, b, _)| format!("a = {a:.3}, b = {b:.3} (Δx in m)"));
            let law = error_of(law.map(|(.., far)| far), note);
            return vec![
                (format!("order_{}", sequence.slug()), order_of(&sequence.name, &points, 0.5, 0.0)),
                (format!("front_law_{}", sequence.slug()), law),
            ];
        }
        let [.., coarse, fine] = points[..] else {
            return vec![(format!("plateau_{}", sequence.slug()), Evidence::default())];
        };
        let ratio = (coarse.0 / fine.0).sqrt();
        let limit = (fine.1 * ratio - coarse.1) / (ratio - 1.0);
        let predicted = self.plateau(sequence);
        let mut evidence =
            value_of(Some(limit), Some(predicted), format!("{:.4} at the finest spacing", fine.1));
        evidence.error = Some((limit / predicted - 1.0).abs());
        let blur = self.front_over_delay(sequence, fine.0);
        if blur.is_none_or(|blur| blur > 0.1) {
            let words =
                "the front is not yet ten times narrower than the way by which the wrong speed displaces it";
            evidence.outside =
                Some(format!("{words}: {}", blur.map_or("unknown".into(), |blur| format!("{blur:.2}"))));
        }
        vec![(format!("plateau_{}", sequence.slug()), evidence)]
    }

    /// Width of the front at the end over the way by which its speed has displaced it.
    fn front_over_delay(&self, sequence: &Sequence, spacing: f64) -> Option<f64> {
        let way = self.bar.exact.speed * self.duration;
        let width = jump::front(sequence.lattice, 0.0)?.width(way / spacing) * spacing;
        Some(width / ((sequence.speed - 1.0).abs() * way))
    }

    fn plateau(&self, sequence: &Sequence) -> f64 {
        jump::plateau(&self.bar, self.place, self.duration, sequence.speed)
    }

    fn table(&self, levels: &[Vec<Level>], place: &Place) -> Table {
        let own = ["l1_error", "pairwise_order", "plateau_of_the_wrong_speed"];
        let mut table = Table::new("bar_jump_convergence.csv", &[&["case"][..], &LATTICE, &own].concat());
        for (sequence, levels) in self.sequences.iter().zip(levels) {
            let plateau = (!sequence.right_speed()).then(|| self.plateau(sequence));
            let points: Vec<(f64, f64)> = levels.iter().map(|level| (level.spacing, level.l1)).collect();
            for (index, level) in levels.iter().enumerate() {
                let pairwise = pairwise(&points, index);
                let start: Vec<Cell> = vec![place.case.clone().into()];
                let own: [Cell; 3] = [level.l1.into(), pairwise.into(), plateau.into()];
                let cells = lattice_cells(Some((sequence.lattice, level.spacing)));
                table.push(start.into_iter().chain(cells).chain(own).collect::<Vec<_>>());
            }
        }
        table
    }

    fn figure(&self, levels: &[Vec<Level>], place: &Place) -> Figure {
        let series = self.sequences.iter().zip(levels).map(|(sequence, levels)| {
            let points = levels.iter().map(|level| (1e3 * level.spacing, level.l1)).collect();
            Series::both(sequence.name.clone(), points)
        });
        let label = "(1/T) ∫ |ε − exact| dt / (F₀/EA)";
        let (right, wrong): (Vec<_>, Vec<_>) =
            self.sequences.iter().partition(|sequence| sequence.right_speed());
        // A plateau is only seen as one beside zero.
        let error = if right.is_empty() { Axis::linear(label).including(0.0) } else { Axis::log(label) };
        let mut panel = Lines::new(Axis::log("Δx (mm)"), error, series.collect());
        for sequence in &wrong {
            let label = format!("wave of the wrong speed {:.4} v", sequence.speed);
            panel = panel.guide(Guide::Horizontal { at: self.plateau(sequence), label });
        }
        if !right.is_empty() {
            panel = panel.guide(Guide::Slope { order: 0.5, label: "order 1/2".into() });
        }
        let mut caption = String::from("Mean error of the strain over the spacing at fixed m.");
        if !right.is_empty() {
            caption += " Where long waves have the right speed it falls by half an order: jumps disperse.";
        }
        if !wrong.is_empty() {
            caption += " Where they have not it tends to the error of a wave of that speed, however fine the lattice.";
        }
        Figure::new(place.case.clone(), self.title.clone(), caption, panel)
    }
}

/// a, b and the largest relative departure of errors E(h) from a h^(1/2) − b h^(2/3), by least squares of what is
/// relative; `None` for fewer than four errors.
fn front_law(points: &[(f64, f64)]) -> Option<(f64, f64, f64)> {
    let terms = |&(h, error): &(f64, f64)| (h.sqrt() / error, -libm::cbrt(h * h) / error);
    let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
        points.iter().map(terms).map(|(half, more)| of(half, more)).sum()
    };
    let (aa, ab, bb) = (sum(&|a, _| a * a), sum(&|a, b| a * b), sum(&|_, b| b * b));
    let (a1, b1) = (sum(&|a, _| a), sum(&|_, b| b));
    let determinant = aa * bb - ab * ab;
    let (a, b) = ((a1 * bb - b1 * ab) / determinant, (b1 * aa - a1 * ab) / determinant);
    let far = largest(points.iter().map(terms).map(|(half, more)| (a * half + b * more - 1.0).abs()))?;
    // Errors that need another sign do not obey the law at all.
    let far = if a > 0.0 && b > 0.0 { far } else { far.max(1.0) };
    (points.len() >= 4).then_some((a, b, far))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_law_is_recognised_and_others_are_not() {
        let of = |error: &dyn Fn(f64) -> f64| -> Vec<(f64, f64)> {
            (0..5).map(|n| 5e-3 / f64::from(1 << n)).map(|h| (h, error(h))).collect()
        };
        let (a, b, far) = front_law(&of(&|h| 1.9 * h.sqrt() - 1.4 * h.powf(2.0 / 3.0))).unwrap();
        assert!((a - 1.9).abs() < 1e-9 && (b - 1.4).abs() < 1e-9 && far < 1e-12);
        assert!(front_law(&of(&|h| h)).unwrap().2 >= 1.0);
        assert!(front_law(&of(&|h| h.powf(0.25))).unwrap().2 > 0.02);
        assert!(front_law(&of(&|h| h.sqrt())[..3]).is_none());
    }
}
