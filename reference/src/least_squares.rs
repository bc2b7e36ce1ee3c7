//! Linear least squares by Householder's reflections, columns scaled to unit length.

/// The factors x for which Σ x_j column_j is nearest to `wanted`. Columns of one length, at least as long as they are
/// many and linearly independent; NaN where they are not.
pub(crate) fn solve(mut columns: Vec<Vec<f64>>, mut wanted: Vec<f64>) -> Vec<f64> {
    let scales: Vec<f64> = columns.iter().map(|column| norm(column)).collect();
    for (column, scale) in columns.iter_mut().zip(&scales) {
        column.iter_mut().for_each(|value| *value /= scale);
    }
    let count = columns.len();
    let mut diagonal = vec![0.0; count];
    for k in 0..count {
        let mut axis = columns[k][k..].to_vec();
        diagonal[k] = -norm(&axis).copysign(axis[0]);
        axis[0] -= diagonal[k];
        let square = dot(&axis, &axis);
        for column in columns[k + 1..].iter_mut().chain([&mut wanted]) {
            reflect(&mut column[k..], &axis, square);
        }
    }
    for k in (0..count).rev() {
        let known: f64 = (k + 1..count).map(|j| columns[j][k] * wanted[j]).sum();
        wanted[k] = (wanted[k] - known) / diagonal[k];
    }
    wanted.iter().zip(&scales).map(|(value, scale)| value / scale).collect()
}

fn reflect(values: &mut [f64], axis: &[f64], square: f64) {
    let factor = 2.0 * dot(values, axis) / square;
    values.iter_mut().zip(axis).for_each(|(value, along)| *value -= factor * along);
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_through_four_points_by_hand() {
        // Normal equations: 4a + 6b = 12, 6a + 14b = 25: a = 0.9, b = 1.4.
        let columns = vec![vec![1.0; 4], vec![0.0, 1.0, 2.0, 3.0]];
        let found = solve(columns, vec![1.0, 3.0, 2.0, 6.0]);
        assert!((found[0] - 0.9).abs() < 1e-14 && (found[1] - 1.4).abs() < 1e-14, "{found:?}");
    }
}
