//! Units in keys: SI is the form of record (`dx_m`); common others (`dx_mm`) are converted on reading.

/// Endings that are read, the SI ending they stand for, and the exact power of ten between them.
const ENDINGS: [(&str, &str, i32); 27] = [
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
    ("_km_s", "_m_s", 3),
    ("_mm_s", "_m_s", -3),
    ("_mm_us", "_m_s", 3),
    ("_m_ms", "_m_s", 3),
    ("_m_us", "_m_s", 6),
    ("_m_ns", "_m_s", 9),
    ("_g_cm3", "_kg_m3", 3),
    ("_kg_mm3", "_kg_m3", 9),
    ("_per_km", "_per_m", -3),
    ("_per_cm", "_per_m", 2),
    ("_per_mm", "_per_m", 3),
    ("_per_um", "_per_m", 6),
    ("_per_nm", "_per_m", 9),
    ("_per_ms", "_per_s", 3),
    ("_per_us", "_per_s", 6),
    ("_per_ns", "_per_s", 9),
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

/// The SI form of a name, and what its numbers are multiplied by and divided by: one of the two is 1.
pub fn to_si_factor(name: &str) -> (String, (f64, f64)) {
    let (si, Conversion { power }) = to_si(name);
    let ten = 10_f64.powi(power.abs());
    (si, if power < 0 { (1.0, ten) } else { (ten, 1.0) })
}

/// The other ways in which a key may be written: `dx_mm`, `dx_um`, … for `dx_m`.
pub fn other_units(key: &str) -> Vec<String> {
    let forms =
        ENDINGS.iter().filter_map(|(ending, si, _)| Some(format!("{}{ending}", key.strip_suffix(si)?)));
    forms.filter(|form| to_si(form).0 == key).collect()
}

/// The other units of a key as a message names them; what is written most comes first.
const NAMED: [(&str, &str); 7] = [
    ("_kg_m3", "_g_cm3"),
    ("_per_m", "_per_mm, _per_um, …"),
    ("_per_s", "_per_ms, _per_us, …"),
    ("_pa", "_mpa, _gpa, …"),
    ("_m_s", "_km_s, _mm_us, …"),
    ("_m", "_mm, _um, …"),
    ("_s", "_ms, _us, …"),
];

/// A key with what its ending may be instead: `dx_m (or _mm, _um, …)`.
pub fn with_units(key: &str) -> String {
    let named = NAMED.iter().find(|(si, _)| key.ends_with(si));
    match named {
        Some((_, others)) if !other_units(key).is_empty() => format!("{key} (or {others})"),
        _ => key.to_owned(),
    }
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
    fn what_messages_name_is_read() {
        assert_eq!(with_units("dx_m"), "dx_m (or _mm, _um, …)");
        assert_eq!(with_units("kernel"), "kernel");
        assert_eq!(with_units("density_n_m3"), "density_n_m3");
        for (si, others) in NAMED {
            for other in others.split(", ").filter(|other| *other != "…") {
                assert_eq!(to_si(&format!("x{other}")).0, format!("x{si}"));
            }
        }
    }

    #[test]
    fn rates_are_no_times() {
        assert_eq!(to_si("rate_per_ms"), ("rate_per_s".into(), Conversion { power: 3 }));
        assert!(other_units("rate_per_s").contains(&"rate_per_us".to_owned()));
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
