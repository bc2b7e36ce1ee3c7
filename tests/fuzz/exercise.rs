//! What is done with any bytes: they are read, checked and planned, or refused in words that can be printed.

use crate::afford;
use crate::input::{Document, Setting};
use crate::machine::Room;
use crate::question::{Effort, Profile};
use crate::study::Study;

/// Room for anything, so that nothing depends on the machine.
const VAST: Room = Room { bytes: 1e15, of: "free in a hall" };

/// What became of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Became {
    /// No text at all.
    NoText,
    Refused,
    /// With so many scenes, at any rate in cases that claim something.
    Planned {
        scenes: usize,
    },
}

/// Reads and plans; panics where a refusal has no place or a plan a number that is none.
pub fn exercise(bytes: &[u8]) -> Became {
    let Ok(text) = std::str::from_utf8(bytes) else { return Became::NoText };
    // The first line once more, as a change from the command line.
    if let Ok(setting) = Setting::parse(text.lines().next().unwrap_or_default())
        && let Ok(mut document) = Document::parse("study.toml", text)
    {
        let _ = document.set(&setting);
    }
    let study = match Study::read("study.toml", text, &[]) {
        Ok((study, _)) => study,
        Err(refusal) => {
            let shown = format!("{:?}", miette::Report::new(refusal));
            assert!(shown.contains("study.toml"), "a refusal without a place: {shown}");
            return Became::Refused;
        }
    };
    let mut scenes = 0;
    for case in &study.cases {
        let claims = case.claims();
        assert!(claims.iter().all(|claim| !claim.id.is_empty()));
        assert_ne!(case.question.effort(), Effort::default(), "{} costs nothing", case.place.case);
        for plan in case.question.scenes() {
            let numbers = [
                plan.bytes_per_node,
                plan.time_step_s,
                plan.time_step_over_limit,
                plan.steps_per_cell.unwrap_or(1.0),
                plan.work.flops_per_step,
                plan.work.state_bytes_per_step,
                plan.work.kept_bytes,
                afford::needed(&plan),
            ];
            let sound = numbers.iter().all(|number| number.is_finite() && *number >= 0.0);
            assert!(sound && plan.nodes > 0, "{}: {plan:?}", case.place.case);
            scenes += 1;
        }
    }
    let _ = afford::check([&study], Profile::Full, 64, VAST);
    Became::Planned { scenes }
}
