//! Numbers that the author of a study expects a probe to see: claims that a CI can gate on.

use super::probes::{ProbeAsked, WatchName, did_you_mean, looks, quantities};
use crate::question::{Claiming, Place, claim, value_of};
use crate::rounded::rounded;
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::plan::Plan;
use pd_verify::record::{Record, Trace};
use pd_verify::scene::{Positive, Wrong};
use pd_verify::verdict::Evidence;
use schemars::JsonSchema;
use serde::Deserialize;

/// An expectation as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExpectAsked {
    /// Of the claim: lower-case letters, digits, `-` and `_`. Default: `expect_1`, `expect_2`, …
    pub name: Option<String>,
    /// Name of one of the case's probes.
    pub probe: String,
    /// A quantity that the probe sees, as in `probes.csv`.
    pub quantity: String,
    /// Of a line: the place along it; the nearest node is taken, never one that a hole has removed.
    pub at_m: Option<f64>,
    /// Linear between two looks.
    pub at_s: f64,
    /// In the unit of the quantity.
    pub value: f64,
    /// Largest |seen − value|, in the same unit.
    pub tolerance: Positive,
    /// Where the tolerance comes from.
    pub basis: Basis,
    /// Why the value and its tolerance are what they are, in a sentence.
    pub because: String,
    /// Where the value comes from. Default: the author of the study.
    pub source: Option<String>,
}

/// Names of the claims that every march has; no expectation can have them.
pub const OWN_CLAIMS: [&str; 4] = ["finite", "energy_balance", "operators_agree", "momentum"];

/// An expectation, checked.
#[derive(Debug, Clone)]
pub struct Expect {
    /// Of its claim.
    pub name: String,
    pub asked: ExpectAsked,
    /// Of a line.
    along: usize,
}

impl ExpectAsked {
    /// The expectation at `index` of its case, or why no probe can meet it.
    pub fn check(
        &self,
        index: usize,
        before: &[Expect],
        probes: &[ProbeAsked],
        plans: &[&Plan],
        dimension: usize,
    ) -> Result<Expect, Wrong> {
        let name = self.check_name(index, before)?;
        let Some(probe) = probes.iter().find(|probe| probe.name == self.probe) else {
            let names = probes.iter().map(|probe| probe.name.as_str());
            let message = format!("no probe is called \"{}\"", self.probe);
            return Err(Wrong::new("probe", message, did_you_mean(&self.probe, names)));
        };
        if probe.watches == WatchName::Patch {
            let message = format!("the patch \"{}\" is seen at many places", self.probe);
            return Err(Wrong::new("probe", message, "expect something of a point or a line there"));
        }
        let seen = quantities(probe.watches, dimension);
        if !seen.contains(&self.quantity.as_str()) {
            let message = format!("the probe \"{}\" does not see \"{}\"", self.probe, self.quantity);
            return Err(Wrong::new("quantity", message, did_you_mean(&self.quantity, seen.iter().copied())));
        }
        match (probe.watches == WatchName::Line, self.at_m) {
            (true, None) => return Err(Wrong::new("", "a line is seen at many places", "add at_m")),
            (false, Some(_)) => {
                return Err(Wrong::new("at_m", "at_m says nothing about this probe", "leave it out"));
            }
            _ => {}
        }
        for plan in plans {
            let (first, last, _) = looks(probe.watches, probe.every(plan.steps), plan);
            let slack = 1e-9 * plan.time_step_s;
            if !(first - slack..=last + slack).contains(&self.at_s) {
                let message = format!(
                    "the probe \"{}\" looks from {first} s to {last} s, not at {} s",
                    self.probe, self.at_s
                );
                let help = "move at_s between the two, take a smaller every_steps, or a longer duration_s";
                return Err(Wrong::new("at_s", message, help));
            }
        }
        if self.because.trim().len() < 10 {
            let help = "say in a sentence why the value and its tolerance are what they are";
            return Err(Wrong::new("because", "a claim without a reason is not judged", help));
        }
        Ok(Expect { name, asked: self.clone(), along: probe.axis() })
    }

    /// The name of the claim, which nothing else in the case has.
    fn check_name(&self, index: usize, before: &[Expect]) -> Result<String, Wrong> {
        let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_';
        let name = self.name.clone().unwrap_or_else(|| format!("expect_{}", index + 1));
        let taken = OWN_CLAIMS.contains(&name.as_str()) || before.iter().any(|other| other.name == name);
        if name.is_empty() || name.len() > 40 || !name.chars().all(plain) {
            let message = format!("\"{name}\" cannot name a claim");
            return Err(Wrong::new("name", message, "use lower-case letters, digits, - and _, at most 40"));
        }
        if taken {
            let message = format!("\"{name}\" is the name of another claim of this case");
            return Err(Wrong::new("name", message, "give each expectation its own name"));
        }
        Ok(name)
    }
}

impl Expect {
    /// What is claimed of one lattice or of the furthest of several.
    pub fn claim(&self, lattices: usize, place: &Place) -> Claim {
        let asked = &self.asked;
        let at = asked.at_m.map_or(String::new(), |at| format!(" at {at} m"));
        let furthest =
            if lattices > 1 { format!(", of {lattices} lattices the furthest") } else { String::new() };
        let quantity = format!(
            "{} seen by {}{at} at t = {:e} s{furthest}",
            asked.quantity.replace('_', " "),
            asked.probe,
            asked.at_s
        );
        let source = asked.source.clone().unwrap_or_else(|| "the author of the study".into());
        let claim = claim(place, &self.name, quantity)
            .within(ErrorKind::Absolute, asked.tolerance.0)
            .because(asked.basis, asked.because.clone())
            .source(source);
        Claim { unit: self.unit().into(), ..claim }
    }

    /// What was seen in the record that is furthest from what is expected; of several it is named.
    pub fn evidence(&self, records: &[&Record]) -> Evidence {
        let value = self.asked.value;
        let all: Option<Vec<f64>> = records.iter().map(|record| self.seen(record)).collect();
        let all = all.into_iter().flatten().zip(records);
        let away = |seen: &f64| (seen - value).abs();
        let Some((seen, record)) = all.max_by(|(a, _), (b, _)| away(a).total_cmp(&away(b))) else {
            return value_of(None, Some(value), "the probe saw nothing around that time");
        };
        let name = if records.len() > 1 { format!("{}: ", record.plan.name) } else { String::new() };
        let note = format!("{name}saw {}, expected {}", rounded(seen), rounded(value));
        value_of(Some(seen), Some(value), note)
    }

    /// What was seen; `None` where the probe saw nothing around that time.
    pub fn seen(&self, record: &Record) -> Option<f64> {
        let trace = record.trace(&self.asked.probe)?;
        let column = self.column(trace)?;
        let at = self.asked.at_s;
        let slack = 1e-9 * record.plan.time_step_s;
        let after = trace.times.partition_point(|&t| t < at - slack);
        let (t, value) = (*trace.times.get(after)?, trace.rows[after][column]);
        if (t - at).abs() <= slack {
            return Some(value);
        }
        let before = after.checked_sub(1)?;
        let (t0, value0) = (trace.times[before], trace.rows[before][column]);
        Some(value0 + (value - value0) * (at - t0) / (t - t0))
    }

    /// The unit of what was seen.
    pub fn unit(&self) -> &'static str {
        match self.asked.quantity.as_str() {
            "strain" => "1",
            quantity if quantity.starts_with("displacement") => "m",
            quantity if quantity.starts_with("momentum") => "N s",
            _ => "J",
        }
    }

    /// The column of the quantity; of a line the one nearest to the place.
    fn column(&self, trace: &Trace) -> Option<usize> {
        let columns = trace.columns.iter().enumerate();
        let mut named =
            columns.filter(|(_, column)| column.quantity == self.asked.quantity && !column.removed);
        let Some(place) = self.asked.at_m else { return named.next().map(|(index, _)| index) };
        let away =
            |at: &Option<Vec<f64>>| at.as_ref().map_or(f64::INFINITY, |at| (at[self.along] - place).abs());
        let nearest = named.min_by(|(_, a), (_, b)| away(&a.at).total_cmp(&away(&b.at)));
        nearest.map(|(index, _)| index)
    }
}
