//! How long a cracked plate is still the infinite plane: when what its edges send back reaches the tip.
//!
//! A rectangle with a crack on its middle line, the tip at distance `ahead` from the right edge, loaded by a uniform
//! stress on the edges at ±`half_height` or on the crack's faces, at rest before t = 0. Nothing is faster than c_d, so
//! what is not in the infinite plane's answer comes along the shortest way at c_d from where and when it is made: from
//! the ends of a loaded edge (where it meets a free lateral edge) at t = 0, from the crack's other end, and from the
//! edges that the tip's own waves or the loading wave reach. K is that of [`crate::freund`] until then.

use crate::elastic::{Mode, Plane};

/// A rectangle with a crack on its middle line. Lengths in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrackedPlate {
    /// From the crack to either edge parallel to it.
    pub half_height: f64,
    /// From the tip to the lateral edge ahead of it.
    pub ahead: f64,
    /// What is behind the tip.
    pub behind: Behind,
    /// What holds the lateral edges.
    pub lateral: Lateral,
}

/// The other end of a crack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Behind {
    /// The crack runs through to the lateral edge.
    Mouth {
        /// Length of the crack in m.
        crack: f64,
    },
    /// Another tip.
    Tip {
        /// Length of the crack in m.
        crack: f64,
        /// From the other tip to the lateral edge behind it in m.
        beyond: f64,
    },
}

/// The two edges across the crack's line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lateral {
    /// No traction.
    Free,
    /// What lets the loading wave pass as in an infinite plane: rollers u_x = 0, σ_xy = 0 in mode I; u_y = 0, σ_xx = 0 in
    /// mode II.
    Guided,
}

/// Where the stress acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loading {
    /// On one edge along the crack, or on both at once: K is once or twice that of one wave.
    Edges,
    /// On the crack's two faces.
    Faces,
}

/// Something that the infinite plane does not know.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disturbance {
    /// What.
    pub what: &'static str,
    /// When it reaches the tip, in s after the load began.
    pub arrival_s: f64,
}

/// When a plate may be compared with the infinite plane, in s after the load began.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// From.
    pub from_s: f64,
    /// To.
    pub to_s: f64,
}

impl Window {
    /// Whether t in s is inside; never for NaN.
    pub fn contains(&self, t: f64) -> bool {
        self.from_s <= t && t <= self.to_s
    }
}

/// How long a comparison waits after the load has reached the crack, in parts of H/c: the singular field has to grow
/// beyond the nodes beside the tip. A convention; K itself is exact at once.
pub const SETTLING: f64 = 0.25;

impl CrackedPlate {
    /// When the load reaches the crack, in s: H/c for a wave from the edges, at once on the faces.
    pub fn loaded_at(&self, plane: &Plane, mode: Mode, loading: Loading) -> f64 {
        match loading {
            Loading::Edges => self.half_height / plane.wave_speed(mode),
            Loading::Faces => 0.0,
        }
    }

    /// What disturbs the tip, first come first. A plate that is not loaded in step on both edges, or whose edges are not
    /// equally far, knows more.
    pub fn disturbances(&self, plane: &Plane, mode: Mode, loading: Loading) -> Vec<Disturbance> {
        let c = plane.dilatational_speed();
        let loaded = self.loaded_at(plane, mode, loading);
        let (crack, to_left_edge, end) = match (self.behind, self.lateral) {
            (Behind::Tip { crack, beyond }, _) => (crack, crack + beyond, "waves of the crack's other tip"),
            (Behind::Mouth { crack }, Lateral::Free) => (crack, crack, "waves of the crack's mouth"),
            // Guided edges are mirrors: the crack goes on beyond, as far again.
            (Behind::Mouth { crack }, Lateral::Guided) => {
                (2.0 * crack, crack, "waves of the crack's mirrored tip")
            }
        };
        let corner = |across: f64| libm::hypot(across, self.half_height) / c;
        let mut found = vec![
            ("the tip's waves, back from an edge along the crack", loaded + 2.0 * self.half_height / c),
            ("the tip's waves, back from the edge ahead", loaded + 2.0 * self.ahead / c),
            (end, loaded + crack / c),
        ];
        if (self.lateral, loading) == (Lateral::Free, Loading::Edges) {
            found.push(("waves of the corners ahead", corner(self.ahead)));
            found.push(("waves of the corners behind", corner(to_left_edge)));
        }
        found.sort_by(|a, b| a.1.total_cmp(&b.1));
        found.into_iter().map(|(what, arrival_s)| Disturbance { what, arrival_s }).collect()
    }

    /// From [`SETTLING`] after the load's arrival until the first disturbance enters the disc of `radius` m about the
    /// tip (0: until it reaches the tip). None where that leaves nothing.
    ///
    /// Measured by finite elements for 10 m × 4 m, crack 5 m: free edges, K within 0.01 % of Freund's from 1.25 to 2.65
    /// H/c_d (corners: 2.693); rollers, K within 0.02 % to 3.5, displacements beside the tip to 3.0.
    pub fn window(&self, plane: &Plane, mode: Mode, loading: Loading, radius: f64) -> Option<Window> {
        let first = self.disturbances(plane, mode, loading).first()?.arrival_s;
        let from_s =
            self.loaded_at(plane, mode, loading) + SETTLING * self.half_height / plane.wave_speed(mode);
        let to_s = first - radius / plane.dilatational_speed();
        (radius >= 0.0 && from_s < to_s).then_some(Window { from_s, to_s })
    }
}
