//! `pd-verify plan STUDY`: what would be done, and what it would cost; runs nothing and writes nothing.

use super::find::find;
use super::judge::settings;
use super::scene_lines::{SceneLines, is_at_rest, seconds};
use crate::bench::kept::{self, Kept};
use crate::input::Refusal;
use crate::machine::Room;
use crate::question::{Effort, Planned, Profile};
use crate::scene::effects;
use crate::study::{Case, Study};
use crate::{afford, machine};
use pd_verify::plan::time::Costs;
use serde_json::{Value, json};
use std::fmt::Display;
use std::path::Path;

/// A case as planned.
struct Row<'a> {
    case: &'a Case,
    runs: bool,
    effort: Effort,
    scenes: Vec<Planned>,
}

/// The plan as text.
pub fn plan(
    study: &str,
    as_json: bool,
    profile: Profile,
    set: &[String],
    out: &Path,
) -> Result<String, Refusal> {
    let study = find(study, &settings(set)?)?;
    let measured = kept::read(out)?;
    Ok(planned(&study, as_json, profile, measured.as_ref(), machine::room()))
}

/// What a run would refuse is shown all the same, and why.
fn planned(study: &Study, as_json: bool, profile: Profile, measured: Option<&Kept>, room: Room) -> String {
    let refused = afford::check([study], profile, machine::threads(None), room)
        .err()
        .map(|refusal| refusal.to_string());
    let refused = refused.as_deref();
    let rows: Vec<Row> = study.cases.iter().map(|case| row_of(case, profile)).collect();
    let mut total = Effort::default();
    rows.iter().filter(|row| row.runs).for_each(|row| total += row.effort);
    match as_json {
        true => as_data(study, profile, &rows, total, measured, refused),
        false => as_text(study, profile, &rows, total, measured, refused),
    }
}

fn as_text(
    study: &Study,
    profile: Profile,
    rows: &[Row],
    total: Effort,
    measured: Option<&Kept>,
    refused: Option<&str>,
) -> String {
    let mut text = format!("{}: {}\nprofile {profile}; {}\n", study.id, study.title, marched(rows));
    text += &refused.map_or(String::new(), |why| format!("not run here: {why}\n"));
    text += &(time(rows, measured) + "\n");
    text += &line([
        "case",
        "asks",
        "claims",
        "curves",
        "frequencies",
        "bond visits",
        "node updates",
        "reference",
    ]);
    text += "\n";
    for Row { case, runs, effort, .. } in rows {
        text += &line(cells(&case.place.case, &case.asks, &case.claims().len().to_string(), effort));
        if !runs {
            text += &format!("  skipped: from profile {}", case.profile);
        }
        text += "\n";
    }
    text += &line(cells("total", "", "", &total));
    text += "\n";
    let mut lines = SceneLines::with(measured.map(|measured| &measured.costs));
    for row in rows.iter().filter(|row| !row.scenes.is_empty()) {
        let skipped = if row.runs { String::new() } else { format!(", from profile {}", row.case.profile) };
        text += &format!("\n{}: {}{skipped}\n", row.case.place.case, counted(row.scenes.len()));
        text += &lines.of_case(&row.scenes);
    }
    text
}

fn row_of(case: &Case, profile: Profile) -> Row<'_> {
    let scenes = case.question.scenes().into_iter().map(|scene| scene.beside(effects::names())).collect();
    Row { case, runs: case.profile <= profile, effort: case.question.effort(), scenes }
}

fn as_data(
    study: &Study,
    profile: Profile,
    rows: &[Row],
    total: Effort,
    measured: Option<&Kept>,
    refused: Option<&str>,
) -> String {
    let costs = measured.map(|measured| &measured.costs);
    let scene = |scene: &Planned| {
        let mut value = json!(scene);
        value["predicted_seconds"] = json!(seconds(costs, scene));
        value
    };
    let entry = |row: &Row| {
        json!({
            "case": row.case.place.case,
            "asks": row.case.asks,
            "runs": row.runs,
            "claims": row.case.claims().len(),
            "effort": row.effort,
            "scenes": row.scenes.iter().map(scene).collect::<Vec<Value>>(),
        })
    };
    let cases: Vec<_> = rows.iter().map(entry).collect();
    let plan = json!({
        "study": study.id,
        "profile": profile.to_string(),
        "cases": cases,
        "total": total,
        "refused": refused,
        "predicted_seconds": costs.map(|costs| in_all(rows, costs)),
        "predicted_with": measured.map(|measured| json!({
            "isa": measured.isa, "threads": measured.threads, "cpu": measured.cpu,
        })),
    });
    serde_json::to_string_pretty(&plan).expect("plain data") + "\n"
}

/// How long marching takes by what `bench` has measured, in a line; no line where nothing is marched.
fn time(rows: &[Row], measured: Option<&Kept>) -> String {
    if run(rows).all(is_at_rest) {
        return String::new();
    }
    let Some(Kept { isa, threads, cpu, costs }) = measured else {
        return "time to march: unknown: run pd-verify bench\n".to_owned();
    };
    let threads = if *threads == 1 { "1 thread".to_owned() } else { format!("{threads} threads") };
    format!("time to march: {:.3} s, as measured with {isa} on {threads} of {cpu}\n", in_all(rows, costs))
}

/// Seconds that marching takes in all cases that run.
fn in_all(rows: &[Row], costs: &Costs) -> f64 {
    run(rows).filter_map(|scene| seconds(Some(costs), scene)).sum()
}

/// The scenes of the cases that run.
fn run<'a>(rows: &'a [Row]) -> impl Iterator<Item = &'a Planned> {
    rows.iter().filter(|row| row.runs).flat_map(|row| &row.scenes)
}

/// What the cases march in time and what they find at rest, in words.
fn marched(rows: &[Row]) -> String {
    if rows.iter().all(|row| row.scenes.is_empty()) {
        return "nothing is marched in time: waves are evaluated, effects are off".to_owned();
    }
    let at_rest = run(rows).filter(|scene| is_at_rest(scene)).count();
    let parts = match (run(rows).count() - at_rest, at_rest) {
        (marched, 0) => vec![format!("{} to march in time", counted(marched))],
        (0, at_rest) => vec![format!("{} to find at rest", counted(at_rest))],
        (marched, at_rest) => {
            vec![format!("{} to march in time", counted(marched)), format!("{at_rest} to find at rest")]
        }
    };
    format!("{}, shown below", parts.join(", "))
}

fn counted(scenes: usize) -> String {
    if scenes == 1 { "1 scene".to_owned() } else { format!("{scenes} scenes") }
}

fn cells(case: &str, asks: &str, claims: &str, effort: &Effort) -> [String; 8] {
    let counts = [
        effort.curves,
        effort.evaluations,
        effort.bond_evaluations,
        effort.node_updates,
        effort.reference_evaluations,
    ];
    let [curves, evaluations, bonds, nodes, reference] = counts.map(|count| count.to_string());
    [case.into(), asks.into(), claims.into(), curves, evaluations, bonds, nodes, reference]
}

/// A line of the table of cases.
fn line<T: Display>(cells: [T; 8]) -> String {
    let [case, asks, claims, curves, frequencies, bonds, nodes, reference] = cells;
    format!(
        "{case:<28} {asks:<18} {claims:>7} {curves:>9} {frequencies:>12} {bonds:>15} {nodes:>15} {reference:>10}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::question::{Answer, Place, Question};
    use crate::shipped::SHIPPED;
    use crate::subject::Subject;
    use pd_verify::claim::Claim;
    use pd_verify::plan::time::BodyCosts;
    use pd_verify::plan::work::{Kinds, Work};

    const VAST: Room = Room { bytes: 1e12, of: "free in a hall" };

    /// A question that marches one scene.
    struct Marching;

    impl Question for Marching {
        fn claims(&self, _: &Place) -> Vec<Claim> {
            Vec::new()
        }

        fn scenes(&self) -> Vec<Planned> {
            vec![Planned {
                name: "m = 3".into(),
                effects_on: vec!["bond forces".into()],
                effects_off: vec!["damage".into()],
                avoidable: Vec::new(),
                operator: "half families".into(),
                nodes: 1000,
                band_nodes: 0,
                bonds: 3000,
                bytes_per_node: 48.0,
                snapshot_bytes: 0,
                patch_bytes: 0,
                time_step_s: 1e-7,
                time_step_over_limit: 0.9,
                steps: 2000,
                node_updates: 2_000_000,
                bond_updates: 6_000_000,
                steps_per_cell: None,
                work: work(),
                looks: Default::default(),
            }]
        }

        fn equations(&self) -> &'static str {
            ""
        }

        fn answer(&self, _: &dyn Subject, _: &Place) -> Answer {
            Answer::default()
        }
    }

    /// 1000 nodes of a bar with 3 pairs each.
    fn work() -> Work {
        let kinds = Kinds { whole_nodes: 1000, ..Kinds::default() };
        Work { dimension: 1, pairs: 3, kinds, ..Work::default() }
    }

    /// A step takes 0.5 ms, a node of it 1 µs: 2000 steps and the first forces take 3.0015 s.
    #[test]
    fn marching_takes_as_long_as_it_was_measured_to_take() {
        let bar = BodyCosts {
            step_s: 0.5e-3,
            whole_by_pairs: vec![(3.0, 1e-6)],
            by_nodes: vec![(1000.0, 1.0)],
            ..BodyCosts::default()
        };
        let costs = Costs { bar, ..Costs::default() };
        let kept = Kept { isa: "avx2".into(), threads: 4, cpu: "a".into(), costs };
        let (name, text) = SHIPPED[0];
        let (mut study, _) = Study::read(name, text, &[]).unwrap();
        study.cases.truncate(2);
        study.cases[1].question = Box::new(Marching);
        let text = planned(&study, false, Profile::Quick, Some(&kept), VAST);
        assert!(text.contains("time to march: 3.00"), "{text}");
        assert!(text.contains(" s, as measured with avx2 on 4 threads of a\n"), "{text}");
        let data: Value =
            serde_json::from_str(&planned(&study, true, Profile::Quick, Some(&kept), VAST)).unwrap();
        for seconds in [&data["predicted_seconds"], &data["cases"][1]["scenes"][0]["predicted_seconds"]] {
            assert!((seconds.as_f64().unwrap() - 2001.0 * 1.5e-3).abs() < 1e-12, "{seconds}");
        }
        assert_eq!(data["predicted_with"], json!({ "isa": "avx2", "threads": 4, "cpu": "a" }));
    }

    #[test]
    fn what_is_marched_is_shown_and_counted() {
        let (name, text) = SHIPPED[0];
        let (mut study, _) = Study::read(name, text, &[]).unwrap();
        study.cases.truncate(2);
        let nothing = "nothing is marched in time";
        assert!(planned(&study, false, Profile::Quick, None, VAST).contains(nothing));
        study.cases[1].question = Box::new(Marching);
        let text = planned(&study, false, Profile::Quick, None, VAST);
        assert!(!text.contains(nothing), "{text}");
        for word in ["1 scene to march", "node updates", " 2000000 ", "effects off: damage", "half families"]
        {
            assert!(text.contains(word), "no {word}: {text}");
        }
        let data: serde_json::Value =
            serde_json::from_str(&planned(&study, true, Profile::Quick, None, VAST)).unwrap();
        assert_eq!(data["cases"][0]["scenes"], json!([]));
        assert_eq!(data["cases"][1]["scenes"][0]["steps"], 2000);
        assert_eq!(data["total"]["node_updates"], 2_000_000);
        assert!(text.contains("unknown: run pd-verify bench"), "{text}");
        assert!(data["predicted_seconds"].is_null() && data["predicted_with"].is_null());
    }

    #[test]
    fn what_does_not_fit_is_shown_and_said() {
        let (name, text) = SHIPPED[0];
        let (mut study, _) = Study::read(name, text, &[]).unwrap();
        study.cases[1].question = Box::new(Marching);
        let drawer = Room { bytes: 1e4, of: "free in a drawer" };
        let text = planned(&study, false, Profile::Full, None, drawer);
        // 1000 nodes of 48 bytes, and half as much again.
        assert!(text.contains("not run here: ") && text.contains("1000 nodes takes 0.00 GB"), "{text}");
        assert!(text.contains("1 scene to march"), "{text}");
        let refused = |room| {
            let data: Value =
                serde_json::from_str(&planned(&study, true, Profile::Full, None, room)).unwrap();
            data["refused"].as_str().map(str::to_owned)
        };
        assert!(refused(drawer).unwrap().contains("free in a drawer") && refused(VAST).is_none());
    }

    #[test]
    fn what_is_found_at_rest_is_counted_apart() {
        let (name, text) = SHIPPED[0];
        let (mut study, _) = Study::read(name, text, &[]).unwrap();
        study.cases.truncate(2);
        let [marched] = Marching.scenes().try_into().unwrap();
        let at_rest = || Planned { steps: 0, time_step_s: 0.0, node_updates: 0, ..marched.clone() };
        let said = |scenes: [Vec<Planned>; 2]| {
            let rows = study
                .cases
                .iter()
                .zip(scenes)
                .map(|(case, scenes)| Row { scenes, ..row_of(case, Profile::Full) });
            super::marched(&rows.collect::<Vec<_>>())
        };
        let (one, two) = (vec![at_rest()], vec![at_rest(), marched.clone(), at_rest()]);
        assert_eq!(
            said([one.clone(), two.clone()]),
            "1 scene to march in time, 3 to find at rest, shown below"
        );
        assert_eq!(said([one, vec![]]), "1 scene to find at rest, shown below");
        assert_eq!(said([vec![], vec![marched.clone()]]), "1 scene to march in time, shown below");
    }
}
