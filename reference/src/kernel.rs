//! How strongly two points of a family pull, as a function of their distance.
//!
//! W(s), s = |ξ|/δ; the micromodulus is c(ξ) = c₀W. Beyond the horizon the formula is continued and clipped at 0.

use crate::double_double::Dd;
use crate::quadrature;

/// The shape W(s) of the micromodulus, s = |ξ|/δ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kernel {
    /// W = 1.
    Constant,
    /// W = exp(−(p s)²).
    Gaussian {
        /// Narrowness: the kernel has fallen to 1/e at s = 1/p.
        p: f64,
    },
    /// W = exp(−p s).
    Exponential {
        /// Narrowness: the kernel has fallen to 1/e at s = 1/p.
        p: f64,
    },
    /// W = 1 − s.
    Conical,
    /// W = 1 − s².
    Parabolic,
}

impl Kernel {
    /// W(s), 0 where the formula is negative.
    pub(crate) fn weight(self, s: Dd) -> Dd {
        let value = match self {
            Self::Constant => Dd::ONE,
            Self::Gaussian { p } => (-(s * p).squared()).exp(),
            Self::Exponential { p } => (-(s * p)).exp(),
            Self::Conical => Dd::ONE - s,
            Self::Parabolic => Dd::ONE - s.squared(),
        };
        if value.hi < 0.0 { Dd::ZERO } else { value }
    }

    /// ∫₀¹ W(s) sⁿ ds.
    pub(crate) fn moment(self, n: usize) -> Dd {
        let power = |s: Dd| (0..n).fold(Dd::ONE, |product, _| product * s);
        quadrature::panels(self.panels(0.0)).map(|(s, weight)| weight * self.weight(s) * power(s)).sum()
    }

    /// Panels of 32 Gauss nodes that resolve W(s) cos(phase·s) on (0, 1) to 1e-32: 16 radians and, of the
    /// kernel's own argument p s, 2 units to a panel.
    pub(crate) fn panels(self, phase: f64) -> usize {
        let narrowness = match self {
            Self::Gaussian { p } | Self::Exponential { p } => p.abs(),
            _ => 0.0,
        };
        (phase.abs() / 16.0 + narrowness / 2.0).ceil() as usize + 1
    }
}
