//! Whatever chance writes with the schema's keys is refused with a place or planned with numbers; nothing panics.

use super::chance::Chance;
use super::exercise::{Became, exercise};
use proptest::prelude::*;
use serde_json::Value;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Studies that came as far as a plan.
static PLANNED: AtomicUsize = AtomicUsize::new(0);

fn tried(study: &Value) {
    let text = toml::to_string(study).expect("tables, lists and plain values are TOML");
    if let Became::Planned { .. } = exercise(text.as_bytes()) {
        PLANNED.fetch_add(1, Ordering::Relaxed);
    }
}

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config(400))]

    #[test]
    fn any_study_of_the_schemas_keys_is_refused_or_planned(seed in any::<u64>()) {
        tried(&Chance(seed).study_of_the_schema());
    }

    #[test]
    fn any_text_that_was_a_study_is_refused_or_planned(seed in any::<u64>()) {
        exercise(Chance(seed).mutated().as_bytes());
    }
}

#[test]
fn shipped_cases_with_other_values_are_refused_or_planned() {
    proptest!(config(250), |(seed in any::<u64>())| tried(&Chance(seed).shipped_case()));
    let planned = PLANNED.load(Ordering::Relaxed);
    assert!(planned > 20, "{planned} studies came as far as a plan: the check would be empty");
}
