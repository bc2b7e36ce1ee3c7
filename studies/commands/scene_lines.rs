//! What a case marches in time, scene by scene, as lines of `pd-verify plan`.

use crate::question::Planned;
use pd_verify::plan::time::Costs;

/// More lines than this about one case are not read by anybody.
const MOST: usize = 20;

/// Scenes in which the same effects act through the same operator.
struct Alike<'a> {
    first: &'a Planned,
    scenes: Vec<&'a Planned>,
}

/// Names wider than this are cut.
const WIDEST: usize = 60;

/// A line that is yet to be set: its width depends on the others.
enum Line<'a> {
    Text(String),
    Columns,
    /// And the seconds it takes, where they are known.
    Scene(&'a Planned, Option<f64>),
}

/// Writes case after case, and remembers which effects it has told last.
#[derive(Default)]
pub struct SceneLines<'c> {
    told: Option<[Vec<String>; 3]>,
    costs: Option<&'c Costs>,
}

impl<'c> SceneLines<'c> {
    /// With times by these costs.
    pub fn with(costs: Option<&'c Costs>) -> Self {
        Self { told: None, costs }
    }

    /// The scenes of a case, those alike under one heading; what does not fit is counted.
    pub fn of_case(&mut self, scenes: &[Planned]) -> String {
        let mut lines = Vec::new();
        let mut shown: Vec<&Planned> = Vec::new();
        for alike in alike(scenes) {
            if lines.len() >= MOST {
                break;
            }
            lines.extend(self.heading(alike.first));
            for scene in alike.scenes {
                // Every heading has at least one scene below it.
                if lines.len() >= MOST && scene != alike.first {
                    break;
                }
                lines.push(Line::Scene(scene, seconds(self.costs, scene)));
                shown.push(scene);
            }
        }
        let more = scenes.len() - shown.len();
        if more > 0 {
            lines.push(Line::Text(format!("  and {more} more; --json has all")));
        }
        let total = |of: fn(&Planned) -> u64| scenes.iter().map(of).sum::<u64>();
        let held = [
            ("snapshots:", total(|scene| scene.snapshot_bytes)),
            ("patches:", total(|scene| scene.patch_bytes)),
        ];
        for (what, bytes) in held.into_iter().filter(|(_, bytes)| *bytes > 0) {
            lines.push(Line::Text(format!("  {what:<12} {:.3} MB in memory", bytes as f64 / 1e6)));
        }
        let paces = scenes.iter().filter_map(|scene| scene.steps_per_cell);
        if let Some(fewest) = paces.reduce(f64::min) {
            lines.push(Line::Text(format!("  a notch runs over a cell in {fewest:.1} steps")));
        }
        let names = shown.iter().map(|scene| scene.name.chars().count());
        let width = names.max().unwrap_or(0).clamp("scene".len(), WIDEST);
        lines.iter().map(|line| line.set(width) + "\n").collect()
    }

    fn heading<'a>(&mut self, scene: &Planned) -> Vec<Line<'a>> {
        let avoidable: Vec<String> = scene
            .avoidable
            .iter()
            .map(|one| format!("{} ({}: {})", one.key, one.effect, one.because))
            .collect();
        let effects = [scene.effects_on.clone(), scene.effects_off.clone(), avoidable];
        let mut texts = if self.told.as_ref() == Some(&effects) {
            vec!["effects as above".to_owned()]
        } else {
            vec![
                format!("effects on:  {}", listed(&scene.effects_on)),
                format!("effects off: {}", listed(&scene.effects_off)),
            ]
        };
        if texts.len() > 1 && !effects[2].is_empty() {
            texts.push(format!("avoidable:   {} — without it no bit would change", effects[2].join("; ")));
        }
        self.told = Some(effects);
        let mut lines = Vec::new();
        for text in texts.into_iter().chain([format!("operator:    {}", scene.operator)]) {
            let options = textwrap::Options::new(118).subsequent_indent("                ");
            let text = format!("  {text}");
            lines.extend(textwrap::wrap(&text, options).into_iter().map(|line| Line::Text(line.into())));
        }
        lines.push(Line::Columns);
        lines
    }
}

impl Line<'_> {
    /// As text, with names as wide as `width`.
    fn set(&self, width: usize) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Columns => format!(
                "    {:<width$} {:>11} {:>12} {:>10} {:>11} {:>8} {:>10} {:>15} {:>10}",
                "scene",
                "nodes",
                "bonds",
                "bytes/node",
                "Δt in s",
                "Δt/limit",
                "steps",
                "node updates",
                "time in s"
            ),
            Self::Scene(scene, seconds) => {
                let [step, over_limit, steps, updates] = in_time(scene);
                let time = seconds.map_or("-".into(), |seconds| format!("{seconds:.3}"));
                format!(
                    "    {:<width$} {:>11} {:>12} {:>10.1} {step:>11} {over_limit:>8} {steps:>10} {updates:>15} {time:>10}",
                    cut(&scene.name, width),
                    scene.nodes,
                    scene.bonds,
                    scene.bytes_per_node,
                )
            }
        }
    }
}

/// Δt, Δt over its limit, steps and node updates; a body at rest has none of them.
fn in_time(scene: &Planned) -> [String; 4] {
    if is_at_rest(scene) {
        return ["at rest", "-", "-", "-"].map(str::to_owned);
    }
    [
        format!("{:.4e}", scene.time_step_s),
        format!("{:.4}", scene.time_step_over_limit),
        scene.steps.to_string(),
        scene.node_updates.to_string(),
    ]
}

/// Seconds that marching a scene takes; `None` where costs are unknown, and for a body at rest.
pub fn seconds(costs: Option<&Costs>, scene: &Planned) -> Option<f64> {
    if is_at_rest(scene) { None } else { costs?.of_march(scene) }
}

/// Whether a scene is found at rest instead of being marched.
pub fn is_at_rest(scene: &Planned) -> bool {
    scene.steps == 0
}

/// The text, its last character an ellipsis where it is longer than `width`.
fn cut(text: &str, width: usize) -> String {
    if text.chars().count() <= width {
        return text.to_owned();
    }
    text.chars().take(width.saturating_sub(1)).chain(['…']).collect()
}

/// Groups of scenes in the order in which each begins.
fn alike(scenes: &[Planned]) -> Vec<Alike<'_>> {
    let mut groups: Vec<Alike> = Vec::new();
    for scene in scenes {
        let same = |group: &&mut Alike| {
            group.first.effects_on == scene.effects_on
                && group.first.effects_off == scene.effects_off
                && group.first.avoidable == scene.avoidable
                && group.first.operator == scene.operator
        };
        match groups.iter_mut().find(same) {
            Some(group) => group.scenes.push(scene),
            None => groups.push(Alike { first: scene, scenes: vec![scene] }),
        }
    }
    groups
}

fn listed(effects: &[String]) -> String {
    if effects.is_empty() { "none".to_owned() } else { effects.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pd_verify::plan::Avoidable;
    use pd_verify::plan::work::Work;

    fn scene(number: usize, operator: &str) -> Planned {
        Planned {
            name: format!("m = {number}"),
            effects_on: vec!["bond forces".into()],
            effects_off: vec!["damage".into(), "contact".into()],
            avoidable: Vec::new(),
            operator: operator.into(),
            nodes: 1000,
            band_nodes: 0,
            bonds: 3000,
            bytes_per_node: 56.0,
            snapshot_bytes: 0,
            patch_bytes: 0,
            time_step_s: 1.25e-7,
            time_step_over_limit: 0.9,
            steps: 4000,
            node_updates: 4_000_000,
            bond_updates: 12_000_000,
            steps_per_cell: None,
            work: Work::default(),
            looks: Default::default(),
        }
    }

    #[test]
    fn scenes_alike_share_a_heading_and_all_are_told_or_counted() {
        let text = SceneLines::default().of_case(&[scene(1, "half"), scene(2, "full"), scene(3, "half")]);
        assert_eq!(text.matches("effects off: damage, contact").count(), 1, "{text}");
        assert_eq!(text.matches("effects as above\n  operator:    full").count(), 1, "{text}");
        for word in ["m = 1 ", "m = 2 ", "m = 3 ", "1.2500e-7", "0.9000", "4000000", "56.0"] {
            assert!(text.contains(word), "{word}: {text}");
        }
        assert!(!text.contains("more"), "{text}");
    }

    #[test]
    fn hundreds_of_scenes_do_not_flood_the_terminal() {
        let same: Vec<Planned> = (0..300).map(|number| scene(number, "half")).collect();
        let each: Vec<Planned> = (0..300).map(|number| scene(number, &format!("rule {number}"))).collect();
        for scenes in [same, each] {
            let text = SceneLines::default().of_case(&scenes);
            assert!(text.lines().count() <= MOST + 5, "{text}");
            let shown = text.matches("m = ").count();
            assert!(
                shown > 0 && text.contains(&format!("and {} more; --json has all", 300 - shown)),
                "{text}"
            );
        }
    }

    #[test]
    fn a_body_at_rest_has_no_time_step() {
        let at_rest = Planned {
            time_step_s: 0.0,
            time_step_over_limit: 0.0,
            steps: 0,
            node_updates: 0,
            bond_updates: 0,
            ..scene(1, "half")
        };
        let text = SceneLines::default().of_case(&[scene(2, "half"), at_rest]);
        let words: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
        let row = words.iter().find(|words| words.starts_with(&["m", "=", "1"])).unwrap();
        assert_eq!(row[3..], ["1000", "3000", "56.0", "at", "rest", "-", "-", "-", "-"], "{text}");
        let widths: Vec<usize> = text.lines().skip(3).map(|line| line.chars().count()).collect();
        assert!(widths.windows(2).all(|pair| pair[0] == pair[1]), "{text}");
    }

    #[test]
    fn what_could_be_left_out_is_told_with_its_reason() {
        let idle = Avoidable {
            key: "effect[1]".into(),
            effect: "traction".into(),
            because: "its stress is 0".into(),
        };
        let busy = Planned { avoidable: vec![idle], ..scene(2, "half") };
        let text = SceneLines::default().of_case(&[scene(1, "half"), busy]);
        assert!(text.contains("avoidable:   effect[1] (traction: its stress is 0)"), "{text}");
        assert_eq!((text.matches("avoidable").count(), text.matches("effects on").count()), (1, 2), "{text}");
    }

    #[test]
    fn no_effect_is_said_so() {
        let bare = Planned { effects_off: Vec::new(), ..scene(1, "half") };
        assert!(SceneLines::default().of_case(&[bare]).contains("effects off: none"));
    }
    #[test]
    fn effects_are_told_once_and_names_make_room() {
        let named = |name: String| Planned { name, ..scene(1, "half") };
        let mut lines = SceneLines::default();
        assert!(lines.of_case(&[named("a".into())]).contains("effects on:  bond forces"));
        let next = lines.of_case(&[named("a".repeat(45)), named("b".repeat(70))]);
        assert!(next.contains("effects as above") && !next.contains("effects on:"), "{next}");
        assert!(next.contains(&format!("{}…", "b".repeat(59))), "{next}");
        let widths: Vec<usize> = next.lines().skip(2).map(|line| line.chars().count()).collect();
        assert!(widths.windows(2).all(|pair| pair[0] == pair[1]), "{next}");
        let other = Planned { effects_off: Vec::new(), ..scene(1, "half") };
        assert!(lines.of_case(&[other]).contains("effects off: none"));
    }
}
