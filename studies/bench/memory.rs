//! Whether a body fits the memory that is free.

use super::cases::Group;
use pd_verify::plan::Plan;

/// Bytes to make a body and to march it: what it holds, and half of that again while it is made.
pub fn needed(plan: &Plan) -> f64 {
    1.5 * plan.bytes_per_node * plan.nodes as f64
}

/// Bytes that are free, as Linux says; `None` where nothing is known.
pub fn available() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    free(&text)
}

fn free(meminfo: &str) -> Option<f64> {
    let line = meminfo.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kibibytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024.0 * kibibytes)
}

/// A group without the cases that do not fit beside the others, and a line for each of these. The first always stays.
pub fn fitting(group: &Group) -> (Group, Vec<String>) {
    let mut left = available().unwrap_or(f64::INFINITY);
    let (mut cases, mut notes) = (Vec::new(), Vec::new());
    for case in &group.cases {
        let needed = case.body.plan().map_or(0.0, |plan| needed(&plan));
        if needed > left && !cases.is_empty() {
            notes.push(format!("left out, {:.1} GB do not fit: {}, {}", needed / 1e9, group.name, case.name));
        } else {
            left -= needed;
            cases.push(case.clone());
        }
    }
    (Group { cases, ..*group }, notes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_free_is_read_and_what_is_unknown_is_not_zero() {
        assert_eq!(free("MemTotal:  9 kB\nMemAvailable:   24 kB\n"), Some(24.0 * 1024.0));
        assert_eq!(free("MemTotal:  9 kB\n"), None);
        assert_eq!(free("MemAvailable:  many\n"), None);
    }
}
