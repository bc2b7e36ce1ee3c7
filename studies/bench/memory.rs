//! Whether a body fits the memory that is free.

use super::cases::Group;
use crate::{afford, machine};

/// A group without the cases that do not fit beside the others, and a line for each of these. The first always stays.
pub fn fitting(group: &Group) -> (Group, Vec<String>) {
    let mut left = machine::room().bytes;
    let (mut cases, mut notes) = (Vec::new(), Vec::new());
    for case in &group.cases {
        let needed = case.body.plan().map_or(0.0, |plan| afford::needed(&plan));
        if needed > left && !cases.is_empty() {
            notes.push(format!("left out, {:.1} GB do not fit: {}, {}", needed / 1e9, group.name, case.name));
        } else {
            left -= needed;
            cases.push(case.clone());
        }
    }
    (Group { cases, ..*group }, notes)
}
