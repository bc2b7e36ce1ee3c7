//! How much of a node's square cell lies inside the horizon's circle.
//!
//! Area of [i − ½, i + ½] × [j − ½, j + ½] ∩ {x² + y² ≤ m²} = ∫ |[j − ½, j + ½] ∩ [−h, h]| dx, h = √(m² − x²): the
//! chord inside the cell, integrated over x = m sin φ panel by panel between the places where the chord's
//! ends meet the cell's edges, so that the integrand is smooth in every panel. Error below 1e-28.

use crate::double_double::Dd;
use crate::quadrature;

/// Area of the unit cell around node (i, j) inside the disc of radius m around node (0, 0).
pub fn area_in_disc(i: i32, j: i32, m: f64) -> f64 {
    area(i, j, m).to_f64()
}

/// The same with 28 digits.
pub(crate) fn area(i: i32, j: i32, m: f64) -> Dd {
    let (column, row) = (f64::from(i.abs()), f64::from(j.abs()));
    let square = Dd::from(m).squared();
    let far_corner = (column + 0.5).powi(2) + (row + 0.5).powi(2);
    let near_point = (column - 0.5).max(0.0).powi(2) + (row - 0.5).max(0.0).powi(2);
    if Dd::from(far_corner) <= square {
        return Dd::ONE;
    }
    if Dd::from(near_point) >= square {
        return Dd::ZERO;
    }
    let (bottom, top) = (Dd::from(row - 0.5), Dd::from(row + 0.5));
    let angles = panel_angles(column, row, m);
    let chord = |half: Dd| {
        let upper = if half < top { half } else { top };
        let lower = if -half > bottom { -half } else { bottom };
        if upper > lower { upper - lower } else { Dd::ZERO }
    };
    let integrate = |start: Dd, end: Dd| -> Dd {
        quadrature::panel(start, end).map(|(angle, weight)| weight * slice(m, angle, chord)).sum()
    };
    angles.windows(2).map(|ends| integrate(ends[0], ends[1])).sum()
}

/// The integrand over φ: chord(m cos φ) · m cos φ.
fn slice(m: f64, angle: Dd, chord: impl Fn(Dd) -> Dd) -> Dd {
    let half = angle.cos() * m;
    chord(half) * half
}

/// The angles φ = asin(x/m), in order, of the cell's ends and of the kinks between them.
fn panel_angles(column: f64, row: f64, m: f64) -> Vec<Dd> {
    let radius = Dd::from(m);
    let clip = |x: f64| Dd::from(x.clamp(-m, m));
    let (left, right) = (clip(column - 0.5), clip(column + 0.5));
    let mut places = vec![left, right];
    for edge in [row - 0.5, row + 0.5].map(Dd::from) {
        let square = (radius - edge) * (radius + edge);
        if square.hi > 0.0 {
            let kink = square.sqrt();
            places.extend([kink, -kink].into_iter().filter(|x| *x > left && *x < right));
        }
    }
    places.sort_by(|a, b| a.partial_cmp(b).expect("cells and radii are numbers"));
    places.into_iter().map(|x| x.atan2(((radius - x) * (radius + x)).sqrt())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::double_double::PI;

    #[test]
    fn the_cells_fill_the_disc() {
        for m in [1.0, 1.3, 2.0_f64.sqrt(), 2.5, 3.0, 3.015, 4.7] {
            let reach = m as i32 + 1;
            let cells = (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| (i, j)));
            let total: Dd = cells.map(|(i, j)| area(i, j, m)).sum();
            let error = (total / (PI * m * m) - Dd::ONE).to_f64();
            assert!(
                error.abs() < 1e-15 * f64::EPSILON.sqrt(),
                "m = {m}: the sum misses the disc by {error:e}"
            );
        }
    }

    #[test]
    fn special_cells() {
        assert_eq!(area_in_disc(1, 1, 3.0), 1.0);
        assert_eq!(area_in_disc(4, 0, 3.5), 0.0, "touching from outside is not inside");
        assert_eq!(area_in_disc(3, 1, 2.0), 0.0);
        assert_eq!(area_in_disc(0, 0, 0.25), 0.25_f64.powi(2) * std::f64::consts::PI);
        let quarter = area_in_disc(0, 0, 0.6);
        assert!(quarter > 0.9 && quarter < 1.0, "{quarter}");
        assert_eq!(area_in_disc(-3, 1, 3.0), area_in_disc(1, 3, 3.0));
    }

    // Row of the m = 3 family from the antiderivative x/2 √(9 − x²) + 9/2 asin(x/3), mpmath at 60 digits.
    #[test]
    fn the_cell_on_the_axis() {
        assert!((area_in_disc(3, 0, 3.0) - AXIS_CELL).abs() < 1e-16);
    }

    const AXIS_CELL: f64 = 0.486052658752108;
}
