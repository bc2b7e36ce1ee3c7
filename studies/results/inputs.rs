//! What the results of a case depend on, as one hash: the case as resolved, the program, the instruction set.

use super::hex;
use crate::manifest::Manifest;
use crate::study::Study;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::io::Read;

/// The program and the machine's part in the results, as text. Threads have none; profiles choose cases, not results.
pub fn code(manifest: &Manifest) -> String {
    let clean = manifest.git_commit.is_some() && manifest.git_modified == Some(false);
    // Of other sources the commit says nothing.
    let binary = if clean { None } else { Some(binary()) };
    json!([
        manifest.version,
        manifest.reference_version,
        manifest.git_commit,
        manifest.rustc,
        manifest.target,
        manifest.instruction_set,
        binary,
    ])
    .to_string()
}

/// SHA-256 of the program's own file; without it nothing is known to be the same, so that every process differs.
fn binary() -> String {
    let hashed = std::env::current_exe().and_then(std::fs::File::open).and_then(|mut file| {
        let (mut hash, mut piece) = (Sha256::new(), vec![0; 1 << 16]);
        loop {
            match file.read(&mut piece)? {
                0 => return Ok(hex(&hash.finalize())),
                count => hash.update(&piece[..count]),
            }
        }
    });
    hashed.unwrap_or_else(|_| format!("process {}", std::process::id()))
}

/// The hash of each case by its id. What stands above the cases belongs to all of them.
pub fn of_cases(study: &Study, code: &str) -> HashMap<String, String> {
    let mut head = study.document.whole();
    if let Value::Object(table) = &mut head {
        table.shift_remove("case");
    }
    let mut above = Sha256::new();
    above.update(code);
    above.update([0]);
    above.update(head.to_string());
    above.update([0]);
    let hash = |value: &Value| {
        let mut hash = above.clone();
        hash.update(value.to_string());
        Some((value["id"].as_str()?.to_owned(), hex(&hash.finalize())))
    };
    let written = study.document.get("case").and_then(Value::as_array);
    written.into_iter().flatten().filter_map(hash).collect()
}
