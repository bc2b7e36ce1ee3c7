//! A node's family on the uniform lattice: which neighbours it has and how much of each cell counts.

use crate::partial_volume::VolumeRule;

/// One neighbour: its place in spacings and the counted fraction of its cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Neighbour<const D: usize> {
    pub offset: [i32; D],
    /// In (0, 1].
    pub fraction: f64,
}

impl<const D: usize> Neighbour<D> {
    /// |ξ|/Δx.
    pub fn distance(&self) -> f64 {
        self.offset.iter().map(|&n| f64::from(n) * f64::from(n)).sum::<f64>().sqrt()
    }
}

/// The half of the family that stands for the pairs ±ξ: D = 1 to the right, D = 2 above or to the right in the row.
///
/// Ordered by row, then along x. A node belongs to the family when its fraction is positive, even beyond δ.
pub fn half_family<const D: usize>(m: f64, rule: VolumeRule) -> Vec<Neighbour<D>> {
    let reach = rule.reach(m);
    let rows = if D == 2 { 0..=reach } else { 0..=0 };
    let mut family = Vec::new();
    for row in rows {
        let first = if row == 0 { 1 } else { -reach };
        for column in first..=reach {
            let mut offset = [0; D];
            offset[0] = column;
            if let Some(y) = offset.get_mut(1) {
                *y = row;
            }
            let fraction = rule.fraction(offset, m);
            if fraction > 0.0 {
                family.push(Neighbour { offset, fraction });
            }
        }
    }
    family
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn families_have_the_known_sizes() {
        let plane = |m, rule| 2 * half_family::<2>(m, rule).len();
        assert_eq!(VolumeRule::ALL.map(|rule| plane(3.0, rule)), [28, 36, 44]);
        assert_eq!(plane(3.015, VolumeRule::Full), 28);
        assert_eq!(plane(1.0, VolumeRule::Full), 4);
        let bar = |m, rule| 2 * half_family::<1>(m, rule).len();
        assert_eq!(VolumeRule::ALL.map(|rule| bar(3.0, rule)), [6, 6, 6]);
        assert_eq!(VolumeRule::ALL.map(|rule| bar(3.6, rule)), [6, 8, 8]);
    }

    #[test]
    fn half_a_family_holds_each_pair_once() {
        let half = half_family::<2>(4.3, VolumeRule::ExactArea);
        for a in &half {
            assert!(half.iter().all(|b| a.offset != b.offset.map(|n| -n)));
        }
    }
}
