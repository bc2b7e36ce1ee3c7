//! Looks at a march for growth that no motion of the body explains, early and then now and then.
//!
//! A look is a proof where the law is linear: motion whose s² exceeds 1 ([`crate::march::Motion`]) is in modes that leapfrog
//! cannot carry at this Δt, whatever acts on the body. Only when it has grown far beyond what moved before is the march
//! given up, so that a step too long does no harm where it stirs nothing.

use super::{Diverged, Record, Snapshot, snapshot};
use crate::fastest::fastest_of_motion;
use crate::field::Field;
use crate::march::March;
use crate::scene::{Beyond, Scene, StepRule};

/// The first look, the doubling of the step between looks, and the most steps between two.
const FIRST: u64 = 4;
const MOST: u64 = 1000;

/// Above 1 by more than rounding and the search for the limit leave.
const MARGIN: f64 = 1e-9;

/// Kinetic energy over the largest of sound looks at which growth has shown: ten thousand times the velocities.
const GROWN: f64 = 1e8;

/// Name of the snapshot of the last sound look.
pub const LAST_SOUND: &str = "last-sound";

/// What was seen so far.
pub(super) struct Watching {
    looks: bool,
    /// The largest kinetic energy that was sound, or that of the first look.
    most: Option<f64>,
    sound_step: Option<u64>,
    sound: Option<Snapshot>,
    /// Displacements of the last sound look, where the law is not linear.
    at: Option<Field>,
}

impl Watching {
    pub fn new<const D: usize>(scene: &Scene<D>) -> Self {
        let studied =
            matches!(scene.time.step, StepRule::Given { beyond_limit: Beyond::UntilItOverflows, .. });
        Self { looks: !studied, most: None, sound_step: None, sound: None, at: None }
    }

    /// The next step at which to look, after one.
    pub fn next(&self, step: u64) -> u64 {
        let doubled = (step + 1).next_power_of_two().max(FIRST);
        if self.looks && doubled < MOST { doubled } else { (step / MOST + 1) * MOST }
    }

    /// Whether the march diverges, as far as can be seen now.
    pub fn diverges<const D: usize>(
        &mut self,
        scene: &Scene<D>,
        march: &mut March<'_, D>,
        last: u64,
    ) -> bool {
        let step = march.step();
        if !march.is_finite() {
            return true;
        }
        if !self.looks || step == 0 || (self.next(step - 1) != step && step != last) {
            return false;
        }
        let motion = march.motion();
        if motion.square <= 1.0 + MARGIN {
            self.most = Some(self.most.map_or(motion.kinetic, |most| most.max(motion.kinetic)));
            self.sound_step = Some(step);
            self.sound = (!scene.snapshots.is_empty()).then(|| snapshot::taken(scene, march, LAST_SOUND, 0));
            self.at = (!march.model().linear).then(|| march.displacement().to_vec().into());
            return false;
        }
        let most = *self.most.get_or_insert(motion.kinetic);
        motion.kinetic.is_nan() || motion.kinetic >= GROWN * most
    }

    /// What is known of a march that diverges; `record` is what was seen of it.
    pub fn given_up<const D: usize>(self, march: &March<'_, D>, record: Record) -> Diverged {
        let at = self.at.as_deref().unwrap_or(march.displacement());
        Diverged {
            step: march.step(),
            time: march.time(),
            own_limit: fastest_of_motion(march, at).ok().map(|mode| mode.stable_time_step()),
            sound_step: self.sound_step,
            sound: self.sound,
            record,
        }
    }
}
