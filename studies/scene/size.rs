//! How many cells a body has: the spacing must divide its size, and a refusal names the nearest ones that do.

use pd_verify::scene::Wrong;

/// How far size/dx may be from a whole number, relative.
const SLACK: f64 = 1e-9;

/// Spacings tried on each side of the one that does not fit.
const TRIED: usize = 10_000;

/// Cells along each axis and their size in m, which differs from `dx` by rounding only.
pub fn cells<const D: usize>(size: [f64; D], dx: f64) -> Result<([usize; D], f64), Wrong> {
    let count = (size[0] / dx).round().max(1.0);
    if (0..D).all(|axis| divides(size[axis], dx)) {
        let nodes = size.map(|length| (length / dx).round() as usize);
        return Ok((nodes, size[0] / count));
    }
    let fits =
        |count: f64| (1..D).all(|axis| divides(size[axis], size[0] / count)).then_some(size[0] / count);
    let start = (size[0] / dx).floor();
    let larger = (0..TRIED).map(|n| start - n as f64).take_while(|count| *count >= 1.0).find_map(fits);
    let smaller = (1..TRIED).map(|n| start + n as f64).find_map(fits);
    let near: Vec<String> = [smaller, larger].into_iter().flatten().map(|dx| dx.to_string()).collect();
    let given = size.map(|length| length.to_string()).join(" m by ");
    let message = format!("dx_m = {dx} does not divide the body of {given} m into whole cells");
    let help = match near.is_empty() {
        true => "change size_m or dx_m until all of size_m/dx_m are whole numbers".to_owned(),
        false => format!("the nearest that do: dx_m = {}", near.join(" or ")),
    };
    Err(Wrong::new("dx_m", message, help))
}

fn divides(size: f64, dx: f64) -> bool {
    let count = size / dx;
    count.round() >= 1.0 && (count - count.round()).abs() <= SLACK * count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spacing_divides_or_its_neighbours_are_named() {
        assert_eq!(cells([1.0], 0.00125).unwrap().0, [800]);
        assert_eq!(cells([0.3, 0.1], 0.1).unwrap().0, [3, 1]);
        assert_eq!(
            cells([1.0], 0.3).unwrap_err().help,
            "the nearest that do: dx_m = 0.25 or 0.3333333333333333"
        );
        // Thirds of 0.4 do not divide 0.3; quarters and halves... only tenths of both do.
        let help = cells([0.4, 0.3], 0.09).unwrap_err().help;
        assert_eq!(help, "the nearest that do: dx_m = 0.05 or 0.1");
        assert_eq!(cells([1.0], 7.0).unwrap_err().help, "the nearest that do: dx_m = 1");
    }
}
