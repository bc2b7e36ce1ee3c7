//! The levels of a scene of one's own: whole numbers of cells at which its body, notches and probes stand alike between nodes.

use super::seen::{Seen, drawn, of, watching};
use crate::input::Refusal;
use crate::kind::Kind;
use crate::scene::either::Either;
use crate::scene::march::MarchAsked;
use crate::scene::probes::{ProbeAsked, WatchName};
use crate::study::Study;
use crate::written::{Asked, COMMON_KEYS, Written};
use pd_verify::lattice::Lattice;
use pd_verify::plan::Plan;
use pd_verify::scene::{Positive, Wrong};
use serde_json::Value;

/// Looks of every probe, at most: close enough for levels to be held against each other at any time between.
const LOOKS: u64 = 20_000;

/// Nodes across the body on the coarsest level, at least; and beyond the reach of a family on both sides.
const FEWEST: usize = 8;

/// A case of a scene study that can be refined.
pub struct Own {
    study: Study,
    case: usize,
    asked: MarchAsked,
    /// Of the scene as written, over its Δx: the same on every level, so that errors in time fall with those in space.
    time_step_over_spacing: f64,
    pub lattice: Lattice,
    /// Of the body, in m.
    pub size: Vec<f64>,
    /// What is held against each other from level to level.
    pub seen: Vec<Seen>,
    pub ladder: Ladder,
    /// Cells along x of the coarsest level.
    pub coarsest: usize,
}

/// One level.
pub struct Level {
    /// Along x.
    pub cells: usize,
    /// Δx in m.
    pub spacing: f64,
    pub scene: Either,
    pub plan: Plan,
}

impl Own {
    /// The case of a study, refused where it cannot be refined.
    pub fn new(study: Study, case: Option<&str>) -> Result<Self, Refusal> {
        let case = chosen(&study, case)?;
        let written = written(&study, case);
        let mut asked: MarchAsked = study.document.read(&written.path, written.value, &COMMON_KEYS)?;
        asked.read_parts(&written)?;
        let refuse = |wrong: Wrong| written.refuse(wrong);
        let mut scenes = asked.check(&written).map_err(refuse)?.scenes;
        if scenes.len() > 1 {
            let message = format!("{} lattices are asked for: which of them is to be refined?", scenes.len());
            return Err(refuse(Wrong::new(
                "lattice",
                message,
                "leave one kernel, p, m, volume rule and calibration",
            )));
        }
        if asked.unstable == Some(true) {
            let message = "a march beyond the limit has no error that falls";
            return Err(refuse(Wrong::new("unstable", message, "leave it out, and time_step_s too")));
        }
        let marched = scenes.remove(0);
        let (scene, time_step_over_spacing) = (marched.scene, marched.plan.time_step_s / asked.dx_m.0);
        let size: Vec<f64> = asked.size_m.0.iter().map(|length| length.0).collect();
        let stands = |seen: &Seen| watching(&scene, std::slice::from_ref(seen), 1).plan().is_ok();
        let seen: Vec<Seen> = of(&asked, &size).into_iter().filter(stands).collect();
        if seen.is_empty() {
            let help = "add a probe that watches a point, a line, a strain or the energies: its error is what is asked";
            return Err(refuse(Wrong::new("", "nothing is seen of this scene that has an error", help)));
        }
        let cells = (size[0] / asked.dx_m.0).round() as usize;
        let places: Vec<(usize, f64)> = seen.iter().flat_map(|one| one.coordinates(size.len())).collect();
        let lattice = scene.lattice();
        let ladder = Ladder::new(&size, &drawn(written.value), &places, cells);
        let least = FEWEST.max(2 * lattice.m.ceil() as usize + 2) as f64;
        let shortest = size.iter().copied().fold(f64::INFINITY, f64::min);
        let coarsest = ladder.from((least * size[0] / shortest).ceil() as usize);
        drop(written);
        Ok(Self { study, case, asked, time_step_over_spacing, lattice, size, seen, ladder, coarsest })
    }

    /// The scene with so many cells along x, and what it costs.
    pub fn level(&self, cells: usize) -> Result<Level, Wrong> {
        let spacing = self.size[0] / cells as f64;
        let asked = MarchAsked {
            dx_m: Positive(spacing),
            safety: None,
            time_step_s: Some(self.time_step_over_spacing * spacing),
            probe: vec![nothing_much()],
            snapshot: None,
            expect: None,
            ..self.asked.clone()
        };
        let mut scenes = asked.check(&written(&self.study, self.case))?.scenes;
        let marched = scenes.remove(0);
        let scene = watching(&marched.scene, &self.seen, marched.plan.steps.div_ceil(LOOKS));
        let plan = scene.plan()?;
        Ok(Level { cells, spacing, scene, plan })
    }

    /// The coarsest level of so many cells or more that can be marched; `None` where none of the next does.
    pub fn from(&self, cells: usize) -> Option<Level> {
        let first = self.ladder.from(cells);
        (0..TRIED).find_map(|n| self.level(first + n * self.ladder.step).ok())
    }

    /// Study and case, as `pulled-bar/pull`.
    pub fn name(&self) -> String {
        let place = &self.study.cases[self.case].place;
        format!("{}/{}", place.study, place.case)
    }

    /// Of the study.
    pub fn id(&self) -> &str {
        &self.study.id
    }
}

/// Levels tried until one is found that a hole or a region allows.
const TRIED: usize = 20;

/// A probe that costs nothing, to be replaced.
fn nothing_much() -> ProbeAsked {
    ProbeAsked {
        name: "momentum".into(),
        watches: WatchName::Momentum,
        at_m: None,
        along: None,
        through_m: None,
        from_m: None,
        to_m: None,
        every_steps: None,
    }
}

fn written(study: &Study, case: usize) -> Written<'_> {
    let value = study.document.get("case").and_then(|cases| cases.get(case)).unwrap_or(&Value::Null);
    Written {
        document: &study.document,
        path: format!("case[{case}]"),
        value,
        title: &study.cases[case].title,
        material: study.material,
    }
}

fn chosen(study: &Study, case: Option<&str>) -> Result<usize, Refusal> {
    if study.kind != Kind::Scene {
        let message = format!("{} is no study of kind \"scene\"", study.document.name());
        let help = "give a scene of your own: kind = \"scene\", see `pd-verify schema`";
        return Err(study.document.refuse("kind", message).help(help));
    }
    let names: Vec<&str> = study.cases.iter().map(|one| one.place.case.as_str()).collect();
    let listed = names.join(", ");
    match case {
        None if names.len() == 1 => Ok(0),
        None => Err(Refusal::new(format!("{} has {} cases", study.document.name(), names.len()))
            .help(format!("name one with --case: {listed}"))),
        Some(case) => names.iter().position(|name| *name == case).ok_or_else(|| {
            Refusal::new(format!("{} has no case {case}", study.document.name()))
                .help(format!("there are: {listed}"))
        }),
    }
}

/// Numbers of cells along x, in equal steps: at all of them the body is of whole cells, and at all, where `alike`, places stand
/// between nodes as they do in the scene as written. What moves between nodes from level to level scatters its error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ladder {
    pub first: usize,
    pub step: usize,
    pub alike: bool,
}

/// No body needs larger steps.
const LONGEST_STEP: usize = 20_000;

/// What is taken for a whole number of cells.
const SLACK: f64 = 1e-7;

impl Ladder {
    /// For a body of a size in m, places along its axes where it is cut or parted and where it is seen, and the cells along x as
    /// written. Where not all can stand alike those of the body do, if they can.
    fn new(size: &[f64], drawn: &[(usize, f64)], seen: &[(usize, f64)], cells: usize) -> Self {
        let whole = |length: f64, step: usize| {
            let count = length / size[0] * step as f64;
            (count - count.round()).abs() <= SLACK * count.max(1.0)
        };
        let fits = |step: &usize| size.iter().all(|&length| whole(length, *step));
        let keeps = |step: &usize, places: &[(usize, f64)]| {
            fits(step) && places.iter().all(|&(_, x)| whole(x, *step))
        };
        // One level below the one as written, at least.
        let short = || 1..=LONGEST_STEP.min(cells / 2);
        let all = [drawn, seen].concat();
        let alike = short().find(|step| keeps(step, &all));
        let step = alike.or_else(|| short().find(|step| keeps(step, drawn)));
        match step.or_else(|| (1..=LONGEST_STEP).find(fits)) {
            Some(step) => Self { first: (cells - 1) % step + 1, step, alike: alike.is_some() },
            None => Self { first: cells, step: cells, alike: false },
        }
    }

    /// The least of them that is so large or larger.
    pub fn from(&self, cells: usize) -> usize {
        self.first + cells.saturating_sub(self.first).div_ceil(self.step) * self.step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_stand_alike_at_every_number_of_cells() {
        // As written the middle lies on a face: so it does at every even number.
        let ladder = Ladder::new(&[1.0], &[], &[(0, 0.5)], 100);
        assert_eq!(
            (ladder, ladder.from(7), ladder.from(8)),
            (Ladder { first: 2, step: 2, alike: true }, 8, 8)
        );
        // With 25 cells it stands on a node: odd numbers.
        assert_eq!(Ladder::new(&[1.0], &[], &[(0, 0.5)], 25).from(8), 9);
        // 0.1 by 0.04 m takes fives and twos, 0.03 m tenths.
        let plate = Ladder::new(&[0.1, 0.04], &[(1, 0.02)], &[(0, 0.03)], 50);
        assert_eq!(plate, Ladder { first: 10, step: 10, alike: true });
        for cells in (0..5).map(|n| plate.first + n * plate.step) {
            let dx = 0.1 / cells as f64;
            assert!(((0.04 / dx) - (0.04 / dx).round()).abs() < 1e-9);
        }
        // A probe that repeats only at thousands: the body with its notch counts, and it is said.
        let notch = &[(1, 0.04), (0, 0.05)];
        let plate = Ladder::new(&[0.1, 0.08], notch, &[(0, 0.0333)], 50);
        assert_eq!(plate, Ladder { first: 10, step: 10, alike: false });
        assert_eq!(
            Ladder::new(&[0.1, 0.05], &[], &[(0, 0.0333)], 20),
            Ladder { first: 2, step: 2, alike: false }
        );
    }
}
