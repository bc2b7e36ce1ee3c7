//! When the whole body is to be seen: displacement and velocity of every node at chosen times.

use super::{Scene, Wrong};

/// Snapshots under one name.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshots {
    /// Unique in its scene.
    pub name: String,
    /// In s, rising; each is taken at the nearest step.
    pub times: Vec<f64>,
}

/// What one run may hold in snapshots: more is a slip of the pen.
const MAX_BYTES: u64 = 4 << 30;

impl Snapshots {
    /// The steps at which they are taken, of a march of `last` steps of length Δt in s.
    pub fn steps(&self, time_step: f64, last: u64) -> impl Iterator<Item = u64> + '_ {
        self.times.iter().map(move |time| ((time / time_step).round() as u64).min(last))
    }

    fn check(&self, duration: f64, time_step: f64, last: u64) -> Result<(), Wrong> {
        let refuse = |message: String, help: &str| Err(Wrong::new("at_s", message, help));
        if self.times.is_empty() {
            return refuse("a snapshot needs a time".into(), "give one time or more");
        }
        // A time meant to be the end must not miss it by rounding.
        let within = |time: f64| time >= 0.0 && time <= duration * (1.0 + 1e-12);
        if let Some(time) = self.times.iter().find(|time| !within(**time)) {
            let message = format!("there is nothing to see at {time} s: the run goes from 0 to {duration} s");
            return refuse(message, "take a time within the duration, or a longer duration");
        }
        if let Some(late) = self.times.windows(2).find(|pair| pair[0] >= pair[1]) {
            let message = format!("the times are out of order: {} s stands before {} s", late[0], late[1]);
            return refuse(message, "give each time once, the earliest first");
        }
        let steps: Vec<u64> = self.steps(time_step, last).collect();
        if let Some(n) = steps.windows(2).position(|pair| pair[0] == pair[1]) {
            let message = format!(
                "{} s and {} s fall on the same step of {time_step:.4e} s",
                self.times[n],
                self.times[n + 1]
            );
            return refuse(message, "take times that are a step or more apart");
        }
        Ok(())
    }
}

/// Bytes that the snapshots of a scene will hold, checked against its steps of length Δt in s.
pub(crate) fn bytes<const D: usize>(scene: &Scene<D>, time_step: f64, last: u64) -> Result<u64, Wrong> {
    let node = (2 * D * size_of::<f64>()) as u64;
    let one = scene.nodes.iter().fold(node, |bytes, &nodes| bytes.saturating_mul(nodes as u64));
    let mut total = 0_u64;
    for (index, snapshots) in scene.snapshots.iter().enumerate() {
        let path = format!("snapshot[{index}]");
        snapshots.check(scene.time.duration, time_step, last).map_err(|wrong| wrong.inside(&path))?;
        if scene.snapshots[..index].iter().any(|other| other.name == snapshots.name) {
            let message = format!("two snapshots are called \"{}\"", snapshots.name);
            return Err(Wrong::new(format!("{path}.name"), message, "give each its own name"));
        }
        total = total.saturating_add(one.saturating_mul(snapshots.times.len() as u64));
        if total > MAX_BYTES {
            let message = format!(
                "the snapshots would hold {:.1} GiB, at most {} GiB are held",
                total as f64 / (1_u64 << 30) as f64,
                MAX_BYTES >> 30
            );
            let help = "take fewer times, a larger spacing, or a probe along a line";
            return Err(Wrong::new(format!("{path}.at_s"), message, help));
        }
    }
    Ok(total)
}
