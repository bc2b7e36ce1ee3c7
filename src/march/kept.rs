//! The state of a march at a step, to which it can be put back.

use super::March;
use crate::breaking::Broken;
use crate::field::Field;

/// A step, what belongs to it, and nothing of what was seen.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept {
    step: u64,
    displacement: Field,
    increment: Field,
    broken: Broken,
}

impl Kept {
    /// u at that step in m.
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }
}

impl<const D: usize> March<'_, D> {
    /// What to come back to.
    pub fn keep(&self) -> Kept {
        Kept {
            step: self.step,
            displacement: self.displacement.clone(),
            increment: self.increment.clone(),
            broken: self.broken.clone(),
        }
    }

    /// Comes back to it.
    pub fn put_back(&mut self, kept: Kept) {
        self.step = kept.step;
        self.other.copy_from_slice(&kept.displacement);
        self.displacement = kept.displacement;
        self.increment = kept.increment;
        self.broken = kept.broken;
    }
}
