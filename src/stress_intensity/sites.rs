//! Where things are around a tip: nodes, horizon, crack, and annuli that a reading may use.

use super::Unreadable;

/// Nodes of a lattice around a tip at the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sites {
    /// Nodes along x and y. Fields over them go row by row along x: node (i, j) is number i + `nodes[0]` j.
    pub nodes: [usize; 2],
    /// Δx in m.
    pub spacing: f64,
    /// Place of node (0, 0), in m from the tip.
    pub first: [f64; 2],
}

impl Sites {
    /// Number of nodes.
    pub fn count(&self) -> usize {
        self.nodes[0] * self.nodes[1]
    }

    /// Place of a node, in m from the tip.
    pub fn place(&self, node: usize) -> [f64; 2] {
        let step = [node % self.nodes[0], node / self.nodes[0]];
        [0, 1].map(|axis| self.first[axis] + self.spacing * step[axis] as f64)
    }

    /// The row just above the crack; the row below it is the one before.
    pub fn upper_row(&self) -> usize {
        (-self.first[1] / self.spacing).ceil().max(0.0) as usize
    }

    /// The crack must pass midway between two rows, and behind and ahead of the tip there must be nodes.
    fn check(&self) -> Result<(), Unreadable> {
        let finite = self.first.iter().all(|x| x.is_finite()) && self.spacing.is_finite();
        if self.count() == 0 || !finite || self.spacing <= 0.0 || self.reach() <= 0.0 {
            return Err(Unreadable::NoPatch { first: self.first, nodes: self.nodes });
        }
        let upper = self.first[1] + self.spacing * self.upper_row() as f64;
        if (upper / self.spacing - 0.5).abs() > MIDWAY {
            return Err(Unreadable::NotBetweenRows { above: upper / self.spacing });
        }
        Ok(())
    }

    /// Radius of the largest circle around the tip that the outermost nodes hold, in m.
    pub fn reach(&self) -> f64 {
        let last = self.place(self.count().saturating_sub(1));
        let reach = [0, 1].map(|axis| (-self.first[axis]).min(last[axis]));
        reach[0].min(reach[1])
    }
}

/// How far from midway the crack may pass between rows, in spacings: rounding of coordinates.
const MIDWAY: f64 = 1e-6;

/// A tip: the nodes around it, the horizon, and how long the crack is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tip {
    pub sites: Sites,
    /// δ in m; 0 for a local body.
    pub horizon: f64,
    /// From the tip to the crack's other end, in m.
    pub crack: f64,
}

impl Tip {
    /// Refuses nodes among which no crack fits.
    pub fn check(&self) -> Result<(), Unreadable> {
        self.sites.check()
    }

    /// Refuses an annulus in the nonlocal zone of the tip, past the crack's other end, or past the nodes.
    pub fn check_annulus(&self, annulus: Annulus) -> Result<(), Unreadable> {
        self.check()?;
        let Annulus { inner, outer } = annulus;
        if !(inner > 0.0 && outer > inner && outer.is_finite()) {
            return Err(Unreadable::NoAnnulus { inner, outer });
        }
        if inner < 2.0 * self.horizon * (1.0 - MIDWAY) {
            return Err(Unreadable::InsideHorizon { inner, horizon: self.horizon });
        }
        if outer > self.crack * (1.0 + MIDWAY) {
            return Err(Unreadable::BeyondCrack { outer, crack: self.crack });
        }
        let reach = self.sites.reach();
        if outer > reach * (1.0 + MIDWAY) {
            return Err(Unreadable::BeyondPatch { outer, reach });
        }
        Ok(())
    }
}

/// r between two radii around the tip, in m, both included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Annulus {
    pub inner: f64,
    pub outer: f64,
}

impl Annulus {
    /// Its nodes, in the order of the sites, that keep a distance in m to the crack's faces.
    pub fn nodes(&self, sites: &Sites, clear_of_faces: f64) -> Vec<usize> {
        let inside = |&node: &usize| {
            let [x, y] = sites.place(node);
            let r = libm::hypot(x, y);
            r >= self.inner && r <= self.outer && (x > 0.0 || y.abs() >= clear_of_faces)
        };
        (0..sites.count()).filter(inside).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tip() -> Tip {
        let sites = Sites { nodes: [8, 6], spacing: 0.5, first: [-2.25, -1.25] };
        Tip { sites, horizon: 0.25, crack: 1.0 }
    }

    #[test]
    fn nodes_are_counted_row_by_row_and_the_crack_passes_below_the_upper_row() {
        let Tip { sites, .. } = tip();
        assert_eq!((sites.place(0), sites.place(9)), ([-2.25, -1.25], [-1.75, -0.75]));
        assert_eq!((sites.upper_row(), sites.place(8 * sites.upper_row())[1]), (3, 0.25));
        assert_eq!(sites.reach(), 1.25);
        // Ring of radius 0.25√2 .. 0.8: the four nodes at (±0.25, ±0.25) and eight at (±0.75, ±0.25) and turned.
        let ring = Annulus { inner: 0.3, outer: 0.8 };
        assert_eq!(ring.nodes(&sites, 0.0).len(), 12);
        assert_eq!(ring.nodes(&sites, 0.3).len(), 12 - 4);
    }

    #[test]
    fn annuli_that_see_something_else_are_refused() {
        let tip = tip();
        let refused = |inner, outer| tip.check_annulus(Annulus { inner, outer }).unwrap_err();
        assert_eq!(tip.check_annulus(Annulus { inner: 0.5, outer: 1.0 }), Ok(()));
        assert!(matches!(refused(0.4, 1.0), Unreadable::InsideHorizon { .. }));
        assert!(matches!(refused(0.5, 1.1), Unreadable::BeyondCrack { .. }));
        assert!(matches!(refused(0.5, 0.5), Unreadable::NoAnnulus { .. }));
        assert!(matches!(refused(f64::NAN, 0.5), Unreadable::NoAnnulus { .. }));
        let long = Tip { crack: 9.0, ..tip };
        let past = long.check_annulus(Annulus { inner: 0.5, outer: 1.5 });
        assert!(matches!(past, Err(Unreadable::BeyondPatch { .. })));
    }

    #[test]
    fn a_crack_through_nodes_and_a_tip_outside_the_nodes_are_refused() {
        let mut tip = tip();
        tip.sites.first[1] = -1.0;
        assert!(matches!(tip.check(), Err(Unreadable::NotBetweenRows { .. })));
        tip.sites.first = [0.25, -1.25];
        assert!(matches!(tip.check(), Err(Unreadable::NoPatch { .. })));
        tip.sites.first = [f64::NAN, -1.25];
        assert!(matches!(tip.check(), Err(Unreadable::NoPatch { .. })));
        tip.sites = Sites { nodes: [0, 6], spacing: 0.5, first: [-2.25, -1.25] };
        assert!(matches!(tip.check(), Err(Unreadable::NoPatch { .. })));
    }
}
