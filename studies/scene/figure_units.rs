//! Units in which the ticks of a figure are plain numbers, and values that are nothing but rounding.

use super::balances::asked_for;
use pd_verify::record::{Column, Record, Trace};

/// A unit by its name and its size in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    pub name: &'static str,
    size: f64,
}

const SECONDS: [Unit; 4] = [
    Unit { name: "s", size: 1.0 },
    Unit { name: "ms", size: 1e-3 },
    Unit { name: "µs", size: 1e-6 },
    Unit { name: "ns", size: 1e-9 },
];

const METRES: [Unit; 4] = [
    Unit { name: "m", size: 1.0 },
    Unit { name: "mm", size: 1e-3 },
    Unit { name: "µm", size: 1e-6 },
    Unit { name: "nm", size: 1e-9 },
];

/// Below this share of what else moves, a displacement is rounding; so is a strain of this size.
const ROUNDING: f64 = 1e-12;

impl Unit {
    /// The unit for times up to `longest` in s.
    pub fn of_time(longest: f64) -> Self {
        fitting(&SECONDS, longest)
    }

    /// The unit for displacements up to `largest` in m.
    pub fn of_displacement(largest: f64) -> Self {
        fitting(&METRES, largest)
    }

    /// An SI value in this unit.
    pub fn of(self, si: f64) -> f64 {
        si / self.size
    }
}

/// The largest unit of which there is at least a half; the first where nothing is to be shown.
fn fitting(units: &[Unit; 4], largest: f64) -> Unit {
    let fits = units.iter().find(|unit| largest >= 0.5 * unit.size);
    *fits.unwrap_or(if largest > 0.0 { &units[3] } else { &units[0] })
}

/// The largest finite size in the columns that `of` chooses.
pub fn largest(trace: &Trace, of: impl Fn(&Column) -> bool) -> f64 {
    let chosen: Vec<usize> = (0..trace.columns.len()).filter(|&index| of(&trace.columns[index])).collect();
    let values = trace.rows.iter().flat_map(|row| chosen.iter().map(|&index| row[index].abs()));
    values.filter(|value| value.is_finite()).fold(0.0, f64::max)
}

/// The largest displacement that the probes of a study saw.
pub fn largest_displacement(record: &Record) -> f64 {
    let own = record.traces.iter().filter(|trace| asked_for(&trace.probe));
    own.map(|trace| largest(trace, |column| column.unit == "m")).fold(0.0, f64::max)
}

/// Whether all that was seen of a quantity is rounding, beside the largest displacement of its scene.
pub fn is_rounding(trace: &Trace, quantity: &str, displacement: f64) -> bool {
    let most = largest(trace, |column| column.quantity == quantity);
    match trace.columns.iter().find(|column| column.quantity == quantity).map(|column| column.unit) {
        Some("m") => most < ROUNDING * displacement,
        Some("1") => most < ROUNDING,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_plain_numbers() {
        for (longest, name) in
            [(2.0, "s"), (2.5e-3, "ms"), (8e-4, "ms"), (2e-4, "µs"), (3e-8, "ns"), (0.0, "s")]
        {
            assert_eq!(Unit::of_time(longest).name, name, "{longest}");
        }
        assert_eq!(Unit::of_displacement(1e-4).name, "µm");
        assert_eq!(Unit::of_displacement(1e-12).name, "nm");
        assert_eq!(Unit::of_time(1e-3).of(2e-3), 2.0);
    }
}
