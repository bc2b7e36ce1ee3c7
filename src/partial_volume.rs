//! How much of a neighbour's cell counts: the partial-volume rules at the edge of the horizon.
//!
//! Lengths are in units of the spacing Δx, so the horizon is m and a cell has side 1.

/// The rule by which a cell cut by the horizon is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum VolumeRule {
    /// Whole cells of the nodes with |ξ| ≤ δ.
    Full,
    /// Fraction falling linearly from 1 at δ − Δx/2 to 0 at δ + Δx/2 along the bond.
    Linear,
    /// The exact measure of cell ∩ horizon.
    ExactArea,
}

/// |ξ| = δ counts as inside when the two differ by rounding alone, so that δ/Δx = 0.3/0.1 still reaches 3Δx.
const TIE: f64 = 1e-12;

impl VolumeRule {
    /// All three.
    pub const ALL: [Self; 3] = [Self::Full, Self::Linear, Self::ExactArea];

    /// The word used in study files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Linear => "linear",
            Self::ExactArea => "exact_area",
        }
    }

    /// Counted fraction of the cell at `offset`, for a horizon of m spacings. In 0..=1.
    pub fn fraction<const D: usize>(self, offset: [i32; D], m: f64) -> f64 {
        let squared: f64 = offset.iter().map(|&n| f64::from(n) * f64::from(n)).sum();
        match self {
            Self::Full => f64::from(squared <= m * m * (1.0 + 2.0 * TIE)),
            Self::Linear => (m + 0.5 - squared.sqrt()).clamp(0.0, 1.0),
            Self::ExactArea => match offset[..] {
                [i] => (m + 0.5 - f64::from(i.abs())).clamp(0.0, 1.0),
                [i, j] => cell_in_disc(i, j, m),
                _ => unreachable!("bodies have one or two dimensions"),
            },
        }
    }

    /// The largest offset along an axis that can have a positive fraction.
    pub fn reach(self, m: f64) -> i32 {
        match self {
            Self::Full => (m * (1.0 + TIE)).floor() as i32,
            Self::Linear | Self::ExactArea => (m + 0.5).ceil() as i32 - 1,
        }
    }
}

/// Area of the unit cell around (i, j) inside the disc of radius m around the origin.
///
/// Green's theorem over the boundary of the intersection: each side of the cell contributes the triangle of its
/// part inside the disc and the circular sectors of its parts outside. (i, j) and (j, i) have the same bits.
pub fn cell_in_disc(i: i32, j: i32, m: f64) -> f64 {
    let (x, y) = (f64::from(i.abs().max(j.abs())), f64::from(i.abs().min(j.abs())));
    if (x + 0.5).hypot(y + 0.5) <= m {
        return 1.0;
    }
    if (x - 0.5).max(0.0).hypot((y - 0.5).max(0.0)) >= m {
        return 0.0;
    }
    let corners = [(x - 0.5, y - 0.5), (x + 0.5, y - 0.5), (x + 0.5, y + 0.5), (x - 0.5, y + 0.5)];
    let area: f64 = (0..4).map(|side| under_side(corners[side], corners[(side + 1) % 4], m)).sum();
    area.clamp(0.0, 1.0)
}

type Point = (f64, f64);

fn cross(a: Point, b: Point) -> f64 {
    a.0 * b.1 - a.1 * b.0
}

fn dot(a: Point, b: Point) -> f64 {
    a.0 * b.0 + a.1 * b.1
}

/// Signed area of (triangle origin–a–b) ∩ (disc of radius m).
fn under_side(a: Point, b: Point, m: f64) -> f64 {
    let direction = (b.0 - a.0, b.1 - a.1);
    let length_squared = dot(direction, direction);
    let closest = -dot(a, direction) / length_squared;
    let distance = cross(a, direction) / length_squared.sqrt();
    let half_chord = ((m - distance.abs()) * (m + distance.abs())).max(0.0).sqrt() / length_squared.sqrt();
    let enter = (closest - half_chord).clamp(0.0, 1.0);
    let leave = (closest + half_chord).clamp(0.0, 1.0);
    let at = |t: f64| (a.0 + t * direction.0, a.1 + t * direction.1);
    sector(a, at(enter), m) + 0.5 * cross(at(enter), at(leave)) + sector(at(leave), b, m)
}

fn sector(a: Point, b: Point, m: f64) -> f64 {
    0.5 * m * m * libm::atan2(cross(a, b), dot(a, b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;
    use std::f64::consts::PI;

    #[test]
    fn fractions_of_all_cells_fill_the_disc() {
        for m in [0.3, 1.0, 1.5, 3.0, 3.015, 7.3, 30.0] {
            let reach = VolumeRule::ExactArea.reach(m);
            let area: f64 =
                (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| cell_in_disc(i, j, m))).sum();
            assert_abs_diff_eq!(area, PI * m * m, epsilon = 1e-13 * PI * m * m);
        }
    }

    #[test]
    fn a_side_that_misses_the_disc_counts_as_a_sector() {
        // A disc inside the cell of the origin, and a quarter disc seen from a corner by symmetry of four cells.
        assert_abs_diff_eq!(cell_in_disc(0, 0, 0.4), PI * 0.16, epsilon = 1e-15);
        // Cap of the disc of radius 1 beyond x = 1/2 within |y| ≤ 1/2, by elementary integration.
        let cap = |y: f64| 0.5 * (y * (1.0 - y * y).sqrt() + y.asin());
        assert_abs_diff_eq!(cell_in_disc(1, 0, 1.0), 2.0 * cap(0.5) - 0.5, epsilon = 1e-15);
    }

    #[test]
    fn a_horizon_that_should_be_three_spacings_reaches_the_third_node() {
        assert_eq!(VolumeRule::Full.fraction([3], 0.3 / 0.1), 1.0);
        assert_eq!(VolumeRule::Full.reach(0.3 / 0.1), 3);
        assert_eq!(VolumeRule::Full.fraction([3], 2.999), 0.0);
    }
}
