//! Looks at a march for growth that no motion of the body explains, early and then now and then.
//!
//! A look is a proof where the law is linear: motion whose s² exceeds 1 ([`crate::march::Motion`]) is in modes that leapfrog
//! cannot carry at this Δt, whatever acts on the body. Only when it has grown far beyond what moved before is the march
//! given up, so that a step too long does no harm where it stirs nothing.

use super::{Diverged, Record, snapshot};
use crate::fastest::fastest_of_motion;
use crate::march::{Kept, March};
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

/// How many looks a march of so many steps takes, the last step among them.
pub fn looks_of_growth(steps: u64) -> u64 {
    let doubled = |power: &u64| *power <= steps;
    let early = std::iter::successors(Some(FIRST), |power| Some(2 * power).filter(|power| *power < MOST));
    let scheduled = steps.is_multiple_of(MOST) || (FIRST..MOST).contains(&steps) && steps.is_power_of_two();
    early.filter(doubled).count() as u64 + steps / MOST + u64::from(!scheduled)
}

/// What was seen so far.
pub(super) struct Watching {
    looks: bool,
    /// The largest kinetic energy that was sound, or that of the first look.
    most: Option<f64>,
    sound_step: Option<u64>,
    /// The march at that step, where more of it is asked than when it was.
    sound: Option<Kept>,
}

impl Watching {
    pub fn new<const D: usize>(scene: &Scene<D>) -> Self {
        let studied =
            matches!(scene.time.step, StepRule::Given { beyond_limit: Beyond::UntilItOverflows, .. });
        Self { looks: !studied, most: None, sound_step: None, sound: None }
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
            let asked = !scene.snapshots.is_empty() || !march.model().linear;
            self.sound = asked.then(|| march.keep());
            return false;
        }
        let most = *self.most.get_or_insert(motion.kinetic);
        motion.kinetic.is_nan() || motion.kinetic >= GROWN * most
    }

    /// What is known of a march that diverges; `record` is what was seen of it.
    pub fn given_up<const D: usize>(
        self,
        scene: &Scene<D>,
        mut march: March<'_, D>,
        record: Record,
    ) -> Diverged {
        let (step, time) = (march.step(), march.time());
        let strained = self.sound.as_ref().filter(|_| !march.model().linear).map(Kept::displacement);
        let fastest = fastest_of_motion(&march, strained.unwrap_or(march.displacement()));
        let own_limit = fastest.ok().map(|mode| mode.stable_time_step());
        let sound = self.sound.filter(|_| !scene.snapshots.is_empty()).map(|kept| {
            march.put_back(kept);
            snapshot::taken(scene, &march, LAST_SOUND, 0)
        });
        Diverged { step, time, own_limit, sound_step: self.sound_step, sound, record }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_are_counted_as_they_are_taken() {
        let watching = Watching { looks: true, most: None, sound_step: None, sound: None };
        for steps in [1, 3, 4, 5, 64, 511, 512, 513, 999, 1000, 1001, 1023, 1024, 2000, 12_345] {
            let taken = std::iter::successors(Some(0), |&step| {
                Some(watching.next(step).min(steps)).filter(|_| step < steps)
            });
            assert_eq!(looks_of_growth(steps), taken.count() as u64 - 1, "{steps}");
        }
    }
}
