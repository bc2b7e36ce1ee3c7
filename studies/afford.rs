//! What a run may cost: studies that need more memory or time than there is are refused before anything is made.

use crate::input::Refusal;
use crate::kind::Kind;
use crate::machine::Room;
use crate::question::{Effort, Planned, Profile};
use crate::study::{Case, Study};

/// More visits of bonds than this are hours of work; nobody means that.
pub const MOST_VISITS: u64 = 2_000_000_000_000;

/// Exact answers: each takes a microsecond in the easiest case, a millisecond in others.
const MOST_ANSWERS: u64 = 50_000_000;

/// Visits of bonds in a second: some 10⁹ on a few cores.
const VISITS_PER_SECOND: f64 = 1e9;

/// While it is made a body takes half as much again as it holds.
const MAKING: f64 = 1.5;

/// Bytes to make a body, to march it, and to keep what is seen of it.
pub fn needed(plan: &Planned) -> f64 {
    MAKING * plan.bytes_per_node * plan.nodes as f64 + (plan.snapshot_bytes + plan.patch_bytes) as f64
}

/// Refuses studies that need more than there is, of the cases that the profile runs; so many threads march at once.
pub fn check<'a>(
    studies: impl IntoIterator<Item = &'a Study>,
    profile: Profile,
    threads: usize,
    room: Room,
) -> Result<(), Refusal> {
    let refused = |study: &'a Study| {
        let run = || study.cases.iter().enumerate().filter(|(_, case)| case.profile <= profile);
        too_long(study, run()).or_else(|| {
            // Scenes of one's own are marched one after the other.
            let at_once = if study.kind == Kind::Scene { 1 } else { threads.max(1) };
            run().find_map(|case| too_large(study, case, at_once, room))
        })
    };
    studies.into_iter().find_map(refused).map_or(Ok(()), Err)
}

/// The refusal of a study that takes too long, at the case that takes longest.
fn too_long<'a>(study: &Study, run: impl Iterator<Item = (usize, &'a Case)>) -> Option<Refusal> {
    let each: Vec<(usize, Effort)> = run.map(|(index, case)| (index, case.question.effort())).collect();
    let all = each.iter().fold(Effort::default(), |mut all, (_, effort)| {
        all += *effort;
        all
    });
    let refuse = |message: String, of: fn(&Effort) -> u64| {
        let longest = each.iter().max_by_key(|(_, effort)| of(effort)).map_or(0, |(index, _)| *index);
        let help = "see `pd-verify plan`; fewer wavenumbers, nodes or steps, smaller m, shorter lists";
        Some(study.document.refuse(&format!("case[{longest}]"), message).help(help))
    };
    let Effort { bond_evaluations: visits, reference_evaluations: answers, .. } = all;
    if visits > MOST_VISITS {
        let message = format!(
            "{}: {visits:e} bond evaluations are planned, {} at 1e9 a second; at most {MOST_VISITS:e} are run",
            study.id,
            lasting(visits)
        );
        return refuse(message, |effort| effort.bond_evaluations);
    }
    if answers > MOST_ANSWERS {
        let message = format!(
            "{}: {answers:e} answers of the reference are planned, hours of work; at most {MOST_ANSWERS:e} are asked for",
            study.id
        );
        return refuse(message, |effort| effort.reference_evaluations);
    }
    None
}

/// The refusal of a case whose largest scenes, so many at once, do not fit.
fn too_large(study: &Study, (index, case): (usize, &Case), at_once: usize, room: Room) -> Option<Refusal> {
    let mut scenes = case.question.scenes();
    scenes.sort_by(|a, b| needed(b).total_cmp(&needed(a)));
    scenes.truncate(at_once);
    let bytes: f64 = scenes.iter().map(needed).sum();
    // What is not a number does not fit either.
    if bytes <= room.bytes {
        return None;
    }
    let (largest, others) = scenes.split_first()?;
    let beside = match others.len() {
        0 => String::new(),
        count => format!(" and {count} more beside it, one for each thread,"),
    };
    let message = format!(
        "{}: \"{}\" with {} nodes{beside} takes {} to make and march, and {} are {}",
        case.place.case,
        largest.name,
        largest.nodes,
        gigabytes(bytes),
        gigabytes(room.bytes),
        room.of
    );
    let help = "take a larger spacing, a smaller body, fewer snapshots, or fewer --threads; `pd-verify plan` says what each scene takes";
    Some(study.document.refuse(&format!("case[{index}]"), message).help(help))
}

fn gigabytes(bytes: f64) -> String {
    format!("{:.2} GB", bytes / 1e9)
}

/// A time in the unit in which one would say it.
fn lasting(visits: u64) -> String {
    let hours = visits as f64 / VISITS_PER_SECOND / 3600.0;
    match hours {
        _ if hours < 48.0 => format!("{hours:.1} hours"),
        _ if hours < 48.0 * 365.0 => format!("{:.0} days", hours / 24.0),
        _ => format!("{:.0} years", hours / 24.0 / 365.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shipped::SHIPPED;

    fn study(of: &str) -> Study {
        let (name, text) = SHIPPED.iter().find(|(name, _)| name.ends_with(of)).unwrap();
        Study::read(name, text, &[]).unwrap().0
    }

    #[test]
    fn a_case_that_does_not_fit_is_named_with_what_it_needs_and_what_there_is() {
        let study = study("bar/release.toml");
        let check = |bytes| check([&study], Profile::Full, 2, Room { bytes, of: "free in a drawer" });
        assert!(check(1e9).is_ok());
        let refusal = format!("{:?}", miette::Report::new(check(1e4).unwrap_err()));
        for word in ["one for each thread", "0.00 GB are free in a drawer", "larger spacing", "release.toml"]
        {
            assert!(refusal.replace("\n  │ ", " ").contains(word), "no {word}: {refusal}");
        }
        assert!(check(f64::NAN).is_err());
        // With room for one of the largest scenes, not for two.
        let largest = study.cases.iter().flat_map(|case| case.question.scenes()).map(|scene| needed(&scene));
        let one = 1.2 * largest.fold(0.0, f64::max);
        let room = Room { bytes: one, of: "free in a drawer" };
        assert!(super::check([&study], Profile::Full, 1, room).is_ok());
        assert!(super::check([&study], Profile::Full, 2, room).is_err());
    }

    #[test]
    fn times_are_said_in_their_unit() {
        assert_eq!(lasting(MOST_VISITS), "0.6 hours");
        assert_eq!(lasting(1_000_000_000_000_000), "12 days");
        assert_eq!(lasting(u64::MAX), "585 years");
    }
}
