//! Dynamic stress intensity factors, read from the displacements of lattice nodes around the tip of a crack.
//!
//! The tip is the origin, the crack lies along −x midway between two rows of nodes, its upper face is y = 0⁺. K_I > 0 opens the
//! crack, K_II > 0 slides its upper face to +x; ahead of the tip σ_yy, σ_xy = K_I, K_II over √(2πx).
//!
//! Every extraction is a linear functional of displacement, acceleration and the (known) uniform stress on the faces. It is
//! prepared once for the nodes around a tip, a [`Reading`], and then costs a scalar product at every look:
//!
//! | file | what is read | source |
//! |---|---|---|
//! | [`two_point`] | the opening at nodes behind the tip, extrapolated to it | Chan, Tuba, Wilson 1970 |
//! | [`williams`] | eigenfunctions fitted to an annulus, with inertia | Williams 1957 |
//! | [`interaction_integral`] | a domain integral with inertia | Yau, Wang, Corten 1980; Shih et al. 1986 |
//! | [`stress_fit`] | stress by differences ahead of the tip | Wildman, Gazonas 2014 |
//! | [`running`] | the same as `williams` where the tip runs | Freund 1990, ch. 4 |
//! | [`spread`] | how much K depends on radii, terms and method | |

pub mod companion;
pub mod eigenfunction;
mod elastic;
pub mod fit;
mod functional;
pub mod gradient;
pub mod interaction_integral;
pub mod running;
mod sites;
pub mod spread;
pub mod stress_fit;
#[cfg(test)]
mod synthetic;
pub mod two_point;
mod unreadable;
pub mod williams;

pub use elastic::{Elastic, Faces};
pub use functional::{Functional, Reading};
pub use sites::{Annulus, Sites, Tip};
pub use unreadable::Unreadable;

/// Opening (I) or sliding (II).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Mode {
    I,
    II,
}

impl Mode {
    /// Both, in the order in which readings give them.
    pub const BOTH: [Self; 2] = [Self::I, Self::II];
}
