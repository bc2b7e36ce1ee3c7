//! What a case marches in time, scene by scene, as lines of `pd-verify plan`.

use crate::question::Planned;

/// More lines than this about one case are not read by anybody.
const MOST: usize = 20;

/// Scenes in which the same effects act through the same operator.
struct Alike<'a> {
    first: &'a Planned,
    scenes: Vec<&'a Planned>,
}

/// The scenes of a case, those alike under one heading; what does not fit is counted.
pub fn scene_lines(scenes: &[Planned]) -> String {
    let mut lines = Vec::new();
    let mut shown = 0;
    for alike in alike(scenes) {
        if lines.len() >= MOST {
            break;
        }
        lines.extend(heading(alike.first));
        for scene in alike.scenes {
            // Every heading has at least one scene below it.
            if lines.len() >= MOST && scene != alike.first {
                break;
            }
            lines.push(line(scene));
            shown += 1;
        }
    }
    let more = scenes.len() - shown;
    if more > 0 {
        lines.push(format!("  and {more} more; --json has all"));
    }
    lines.join("\n") + "\n"
}

/// Groups of scenes in the order in which each begins.
fn alike(scenes: &[Planned]) -> Vec<Alike<'_>> {
    let mut groups: Vec<Alike> = Vec::new();
    for scene in scenes {
        let same = |group: &&mut Alike| {
            group.first.effects_on == scene.effects_on
                && group.first.effects_off == scene.effects_off
                && group.first.operator == scene.operator
        };
        match groups.iter_mut().find(same) {
            Some(group) => group.scenes.push(scene),
            None => groups.push(Alike { first: scene, scenes: vec![scene] }),
        }
    }
    groups
}

fn heading(scene: &Planned) -> Vec<String> {
    let mut lines = Vec::new();
    for (name, text) in [
        ("effects on: ", listed(&scene.effects_on)),
        ("effects off:", listed(&scene.effects_off)),
        ("operator:   ", scene.operator.clone()),
    ] {
        let options = textwrap::Options::new(118).subsequent_indent("                ");
        lines.extend(textwrap::wrap(&format!("  {name} {text}"), options).into_iter().map(String::from));
    }
    lines.push(format!(
        "    {:<30} {:>11} {:>12} {:>10} {:>11} {:>8} {:>10} {:>15}",
        "scene", "nodes", "bonds", "bytes/node", "Δt in s", "Δt/limit", "steps", "node updates"
    ));
    lines
}

fn listed(effects: &[String]) -> String {
    if effects.is_empty() { "none".to_owned() } else { effects.join(", ") }
}

fn line(scene: &Planned) -> String {
    format!(
        "    {:<30} {:>11} {:>12} {:>10.1} {:>11.4e} {:>8.4} {:>10} {:>15}",
        scene.name,
        scene.nodes,
        scene.bonds,
        scene.bytes_per_node,
        scene.time_step_s,
        scene.time_step_over_limit,
        scene.steps,
        scene.node_updates
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(number: usize, operator: &str) -> Planned {
        Planned {
            name: format!("m = {number}"),
            effects_on: vec!["bond forces".into()],
            effects_off: vec!["damage".into(), "contact".into()],
            operator: operator.into(),
            nodes: 1000,
            bonds: 3000,
            bytes_per_node: 56.0,
            time_step_s: 1.25e-7,
            time_step_over_limit: 0.9,
            steps: 4000,
            node_updates: 4_000_000,
            bond_updates: 12_000_000,
        }
    }

    #[test]
    fn scenes_alike_share_a_heading_and_all_are_told_or_counted() {
        let text = scene_lines(&[scene(1, "half"), scene(2, "full"), scene(3, "half")]);
        assert_eq!(text.matches("effects off: damage, contact").count(), 2, "{text}");
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
            let text = scene_lines(&scenes);
            assert!(text.lines().count() <= MOST + 5, "{text}");
            let shown = text.matches("m = ").count();
            assert!(
                shown > 0 && text.contains(&format!("and {} more; --json has all", 300 - shown)),
                "{text}"
            );
        }
    }

    #[test]
    fn no_effect_is_said_so() {
        let bare = Planned { effects_off: Vec::new(), ..scene(1, "half") };
        assert!(scene_lines(&[bare]).contains("effects off: none"));
    }
}
