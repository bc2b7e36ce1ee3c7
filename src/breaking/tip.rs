//! When the tip of a running notch reaches a bond.

use crate::scene::{Notch, Running, SLACK};

/// A notch that grows, or an image of one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tip {
    /// From the notch's beginning to where the tip will stop.
    way: Notch,
    /// Whether the tip goes from the end of `way` to its beginning, as that of a mirror image does.
    turned: bool,
    /// How far along the way it stands at first, in m.
    first: f64,
    running: Running,
}

impl Tip {
    pub fn new(notch: &Notch, running: Running) -> Self {
        let way = Notch { from: notch.from, to: running.end(notch) };
        Self { way, turned: false, first: notch.length(), running }
    }

    pub fn mirrored(self, axis: usize, about: f64) -> Self {
        Self { way: self.way.mirrored(axis, about), turned: !self.turned, ..self }
    }

    pub fn moved(self, axis: usize, by: f64) -> Self {
        Self { way: self.way.moved(axis, by), ..self }
    }

    /// When it cuts the bond from a to b, in s; `None` where it never does. What touches the tip is cut, as by a notch
    /// that stands: a tip that has come to a crossing within rounding has passed it.
    pub fn time(&self, a: [f64; 2], b: [f64; 2], spacing: f64) -> Option<f64> {
        let (slack, length) = (SLACK * spacing, self.way.length());
        let along = self.way.crossing(a, b, spacing)?;
        if !(-slack..=length + slack).contains(&along) {
            return None;
        }
        let far = if self.turned { length - along } else { along };
        Some(self.running.start + (far - slack - self.first).max(0.0) / self.running.speed)
    }

    /// Whether a node at a place is within reach of its way, in m.
    pub fn is_near(&self, x: [f64; 2], reach: f64) -> bool {
        (0..2).all(|axis| {
            let (a, b) = (self.way.from[axis], self.way.to[axis]);
            (a.min(b) - reach..=a.max(b) + reach).contains(&x[axis])
        })
    }
}
