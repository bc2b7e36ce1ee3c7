//! Whether rows cover what is judged: they reach both ends, are enough, and leave no gap.

use crate::rounded::rounded;

/// Fewer rows in the window say nothing.
const FEWEST: usize = 10;
/// What of the window may be without rows at its ends, and between two rows.
const END: f64 = 0.02;
const GAP: f64 = 0.1;

/// What is missing of growing rows in a window, and what that may come from; `name` and `unit` are those of the column.
pub fn covers(rows: &[f64], (from, to): (f64, f64), name: &str, unit: &str) -> Result<(), String> {
    let said = match (lacks(rows, (from, to), 1.0), rows.first(), rows.last()) {
        (None, ..) => return Ok(()),
        (Some(lack), Some(first), Some(last)) => format!(
            "{lack}: {name} goes from {} {unit} to {} {unit}, and {} {unit} to {} {unit} is judged",
            rounded(*first),
            rounded(*last),
            rounded(from),
            rounded(to)
        ),
        _ => return Err("there are no rows".into()),
    };
    let factors = [(1e-6, "10⁻⁶"), (1e-3, "10⁻³"), (1e3, "10³"), (1e6, "10⁶")];
    let fits = factors.iter().find(|(factor, _)| lacks(rows, (from, to), *factor).is_none());
    let cause = fits.map_or(String::new(), |(_, factor)| {
        format!("; times {factor} it would: was another unit than {unit} written? --unit {name}=UNIT says so")
    });
    Err(said + &cause)
}

fn lacks(rows: &[f64], (from, to): (f64, f64), factor: f64) -> Option<&'static str> {
    let width = to - from;
    let inside: Vec<f64> =
        rows.iter().map(|row| row * factor).filter(|row| (from..=to).contains(row)).collect();
    // Rows just outside count: a window may begin between two.
    let before = rows.iter().any(|row| row * factor <= from + END * width);
    let after = rows.iter().any(|row| row * factor >= to - END * width);
    if !before || !after {
        return Some("the window is not reached");
    }
    if inside.len() < FEWEST {
        return Some("there are fewer than ten rows in the window");
    }
    let ends = [from].into_iter().chain(inside.iter().copied()).chain([to]).collect::<Vec<_>>();
    ends.windows(2)
        .any(|pair| pair[1] - pair[0] > GAP * width)
        .then_some("rows are more than a tenth of the window apart")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_said_and_another_unit_suspected() {
        let rows =
            |count: usize, to: f64| (0..=count).map(|n| to * n as f64 / count as f64).collect::<Vec<f64>>();
        let of = |rows: &[f64]| covers(rows, (1.0, 2.0), "t_s", "s");
        assert_eq!(of(&rows(40, 2.0)), Ok(()));
        assert!(of(&rows(40, 1.5)).unwrap_err().starts_with("the window is not reached"));
        assert!(of(&rows(8, 2.0)).unwrap_err().contains("fewer than ten"));
        assert!(of(&rows(40, 2000.0)).unwrap_err().contains("fewer than ten"));
        assert!(of(&rows(400, 2e6)).unwrap_err().contains("times 10⁻⁶"));
        let mut gap = rows(40, 2.0);
        gap.retain(|row| !(1.2..1.6).contains(row));
        assert!(of(&gap).unwrap_err().contains("a tenth"));
        assert!(of(&[]).is_err());
    }
}
