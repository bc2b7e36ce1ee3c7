//! Units in keys: SI is the form of record (`dx_m`); common others (`dx_mm`) are converted on reading.

/// Endings that are read, the SI ending they stand for, and the exact power of ten between them.
const ENDINGS: [(&str, &str, i32); 18] = [
    ("_kpa", "_pa", 3),
    ("_mpa", "_pa", 6),
    ("_gpa", "_pa", 9),
    ("_nm", "_m", -9),
    ("_um", "_m", -6),
    ("_mm", "_m", -3),
    ("_cm", "_m", -2),
    ("_km", "_m", 3),
    ("_ns", "_s", -9),
    ("_us", "_s", -6),
    ("_ms", "_s", -3),
    ("_g_cm3", "_kg_m3", 3),
    ("_kg_mm3", "_kg_m3", 9),
    ("_per_km", "_per_m", -3),
    ("_per_cm", "_per_m", 2),
    ("_per_mm", "_per_m", 3),
    ("_per_um", "_per_m", 6),
    ("_per_nm", "_per_m", 9),
];

/// How a key's numbers become SI.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Conversion {
    power: i32,
}

impl Conversion {
    /// Nothing to convert.
    pub const NONE: Self = Self { power: 0 };

    /// Times or over an exact power of ten: one rounding.
    pub fn apply(self, value: f64) -> f64 {
        let factor = 10_f64.powi(self.power.abs());
        if self.power < 0 { value / factor } else { value * factor }
    }
}

/// The SI form of a key, and what its numbers must be multiplied by.
pub fn to_si(key: &str) -> (String, Conversion) {
    let found = ENDINGS
        .iter()
        .filter_map(|&(ending, si, power)| key.strip_suffix(ending).map(|stem| (stem, ending, si, power)))
        .max_by_key(|(_, ending, ..)| ending.len());
    match found {
        Some((stem, _, si, power)) if !stem.is_empty() => (format!("{stem}{si}"), Conversion { power }),
        _ => (key.to_owned(), Conversion::NONE),
    }
}

/// The other ways in which a key may be written: `dx_mm`, `dx_um`, … for `dx_m`.
pub fn other_units(key: &str) -> Vec<String> {
    let forms =
        ENDINGS.iter().filter_map(|(ending, si, _)| Some(format!("{}{ending}", key.strip_suffix(si)?)));
    forms.filter(|form| to_si(form).0 == key).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_units_lead_back_to_the_key() {
        assert!(other_units("dx_m").contains(&"dx_mm".to_owned()));
        assert!(other_units("to_per_m").iter().all(|form| form.starts_with("to_per_")));
        assert!(other_units("density_kg_m3").contains(&"density_g_cm3".to_owned()));
        assert!(other_units("kernel").is_empty());
    }

    #[test]
    fn longest_ending_wins() {
        assert_eq!(to_si("to_per_mm"), ("to_per_m".into(), Conversion { power: 3 }));
        assert_eq!(to_si("dx_mm"), ("dx_m".into(), Conversion { power: -3 }));
        assert_eq!(to_si("density_g_cm3"), ("density_kg_m3".into(), Conversion { power: 3 }));
        assert_eq!(to_si("dx_m"), ("dx_m".into(), Conversion::NONE));
        assert_eq!(to_si("kernel"), ("kernel".into(), Conversion::NONE));
    }

    #[test]
    fn conversion_rounds_once() {
        assert_eq!(to_si("dx_mm").1.apply(2.0), 0.002);
        assert_eq!(to_si("youngs_modulus_gpa").1.apply(72.0), 72e9);
    }
}
