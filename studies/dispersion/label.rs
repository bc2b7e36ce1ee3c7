//! Names for curves that stand beside each other: what distinguishes them, short enough for a legend.

use super::curve::{Curve, Medium};
use pd_verify::material::Body;
use std::collections::HashSet;

/// What can be said of a curve, in the order in which it is said; empty where it does not apply.
struct Facets {
    medium: &'static str,
    kernel: String,
    m: String,
    spacing: String,
    horizon: String,
    volume_rule: &'static str,
    calibrated: &'static str,
    time: String,
    wave: String,
}

impl Facets {
    fn of(curve: &Curve) -> Self {
        let lattice = curve.lattice();
        let length = |name: &str, value: Option<f64>| {
            value.map_or(String::new(), |x| format!("{name} = {}", metres(x)))
        };
        let calibrated = |calibrated| if calibrated { "calibrated" } else { "as printed" };
        Self {
            medium: match curve.medium {
                Medium::Continuum { .. } => "continuum",
                Medium::Lattice { .. } => "",
                Medium::FiniteDifferences { .. } => "finite differences",
            },
            kernel: curve.kernel().map_or(String::new(), |kernel| kernel.to_string()),
            m: lattice.map_or(String::new(), |lattice| format!("m = {}", lattice.m)),
            spacing: length("Δx", curve.dx()),
            horizon: if lattice.is_some() { String::new() } else { length("δ", curve.horizon()) },
            volume_rule: lattice.map_or("", |lattice| lattice.volume_rule.name()),
            calibrated: lattice.map_or("", |lattice| calibrated(lattice.calibrated)),
            time: match (curve.courant, curve.medium) {
                (Some(courant), _) => format!("C = {}", trimmed(courant, 4)),
                (None, Medium::Continuum { .. }) => String::new(),
                (None, _) => "exact time".into(),
            },
            wave: match (curve.body, curve.medium) {
                (Body::Bar, _) => String::new(),
                (_, Medium::Continuum { .. }) => curve.branch.name().into(),
                _ => format!("{} at {}°", curve.branch.name(), trimmed(curve.degrees, 1)),
            },
        }
    }

    fn words(&self) -> [&str; 9] {
        [
            self.medium,
            &self.kernel,
            &self.m,
            &self.spacing,
            &self.horizon,
            self.volume_rule,
            self.calibrated,
            &self.time,
            &self.wave,
        ]
    }
}

const MEDIUM: usize = 0;
const KERNEL: usize = 1;
const M: usize = 2;
const SPACING: usize = 3;
const CALIBRATED: usize = 6;

/// A different name for each curve.
pub fn labels(curves: &[Curve]) -> Vec<String> {
    let facets: Vec<Facets> = curves.iter().map(Facets::of).collect();
    let shown = shown(curves, &facets);
    let mut labels: Vec<String> = facets.iter().map(|facets| label(facets, &shown)).collect();
    let mut seen = HashSet::new();
    for (index, label) in labels.iter_mut().enumerate() {
        if !seen.insert(label.clone()) {
            *label = format!("{label} ({})", index + 1);
        }
    }
    labels
}

/// A facet is shown where it takes two values or more; the medium also where only some curves have one.
fn shown(curves: &[Curve], facets: &[Facets]) -> [bool; 9] {
    let mut shown = std::array::from_fn(|n| {
        let mut values: Vec<&str> = facets.iter().map(|facets| facets.words()[n]).collect();
        values.retain(|value| n == MEDIUM || !value.is_empty());
        values.sort_unstable();
        values.dedup();
        values.len() > 1
    });
    // At a fixed horizon m says what Δx is.
    let same_horizon = curves.windows(2).all(|pair| match (pair[0].horizon(), pair[1].horizon()) {
        (Some(a), Some(b)) => (a - b).abs() <= 1e-9 * a,
        _ => false,
    });
    shown[SPACING] &= !(same_horizon && shown[M]);
    shown
}

fn label(facets: &Facets, shown: &[bool; 9]) -> String {
    let words = facets.words();
    let mut parts: Vec<&str> = words
        .iter()
        .zip(shown)
        .filter(|(word, shown)| !word.is_empty() && **shown)
        .map(|(word, _)| *word)
        .collect();
    // A lattice beside another medium needs a name of its own.
    let nameless =
        facets.medium.is_empty() && !(KERNEL..=CALIBRATED).any(|n| shown[n] && !words[n].is_empty());
    if parts.is_empty() || (nameless && shown[MEDIUM]) {
        let name = [MEDIUM, KERNEL, M].into_iter().map(|n| words[n]).filter(|word| !word.is_empty());
        parts = name.chain(parts).collect();
    }
    parts.join(", ")
}

fn trimmed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A length in the unit that reads best.
fn metres(length: f64) -> String {
    let (value, unit) = match length {
        x if x >= 1.0 => (x, "m"),
        x if x >= 1e-3 => (x * 1e3, "mm"),
        x if x >= 1e-6 => (x * 1e6, "µm"),
        x => (x * 1e9, "nm"),
    };
    format!("{} {unit}", trimmed(value, 4))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pd_verify::dispersion::Branch;
    use pd_verify::kernel::Kernel;
    use pd_verify::lattice::Lattice;
    use pd_verify::partial_volume::VolumeRule;

    fn lattice(m: f64, dx: f64) -> Curve {
        let lattice =
            Lattice { kernel: Kernel::Constant, m, volume_rule: VolumeRule::Full, calibrated: false };
        Curve {
            body: Body::Bar,
            medium: Medium::Lattice { lattice, dx },
            courant: None,
            branch: Branch::P,
            degrees: 0.0,
        }
    }

    #[test]
    fn only_what_differs_is_said() {
        assert_eq!(labels(&[lattice(2.0, 0.006), lattice(3.0, 0.004)]), ["m = 2", "m = 3"]);
        assert_eq!(labels(&[lattice(3.0, 0.002), lattice(3.0, 0.004)]), ["Δx = 2 mm", "Δx = 4 mm"]);
        assert_eq!(labels(&[lattice(3.0, 0.002)]), ["constant, m = 3"]);
        let differences = Curve { medium: Medium::FiniteDifferences { dx: 0.002 }, ..lattice(3.0, 0.002) };
        assert_eq!(labels(&[lattice(3.0, 0.002), differences]), ["constant, m = 3", "finite differences"]);
        let marched = Curve { courant: Some(0.5), ..lattice(3.0, 0.002) };
        assert_eq!(labels(&[lattice(3.0, 0.002), marched]), ["exact time", "C = 0.5"]);
    }

    #[test]
    fn no_two_curves_share_a_name() {
        let names = labels(&[lattice(3.0, 0.002), lattice(3.0, 0.002_000_000_01)]);
        assert_ne!(names[0], names[1]);
    }
}
