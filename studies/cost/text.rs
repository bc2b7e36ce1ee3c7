//! Advice as text for a terminal, as a table, and as data.

use super::advice::{Advice, Asked, Bound, KERNELS, MS, OF_LIMIT, Setting};
use crate::rounded::rounded;
use pd_verify::lattice::Lattice;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::table::{Cell, Table};
use serde_json::{Value, json};

/// How many settings are printed.
pub const SHOWN: usize = 10;

const COLUMNS: [&str; 17] = [
    "rank",
    "kernel",
    "p",
    "m",
    "volume_rule",
    "calibrated",
    "dx_m",
    "horizon_m",
    "dt_s",
    "courant",
    "pairs",
    "nodes_per_wavelength",
    "error",
    "angle_deg",
    "branch",
    "node_updates_per_m2_s",
    "bond_updates_per_m2_s",
];

/// All settings, the cheapest first; those that come to the same have one rank.
pub fn table(advice: &Advice) -> Table {
    let mut table = Table::new("advice.csv", &COLUMNS);
    for (n, setting) in advice.settings.iter().enumerate() {
        for lattice in [&setting.lattice].into_iter().chain(&setting.alike) {
            table.push(row(n + 1, *lattice, setting, advice.asked.wavelength));
        }
    }
    table
}

fn row(rank: usize, lattice: Lattice, setting: &Setting, wavelength: f64) -> Vec<Cell> {
    vec![
        rank.into(),
        lattice.kernel.name().into(),
        lattice.kernel.p().map_or(Cell::from(""), Cell::from),
        lattice.m.into(),
        lattice.volume_rule.name().into(),
        lattice.calibrated.into(),
        setting.spacing.into(),
        (lattice.m * setting.spacing).into(),
        setting.time_step.into(),
        setting.courant.into(),
        setting.pairs.into(),
        (wavelength / setting.spacing).into(),
        setting.error.value.into(),
        setting.error.degrees.into(),
        setting.error.branch.name().into(),
        setting.node_updates.into(),
        setting.bond_updates.into(),
    ]
}

/// The question and the box that was searched.
fn head(advice: &Advice) -> String {
    let Asked { error, wavelength, speed, bound } = advice.asked;
    let kernels: Vec<String> = KERNELS.iter().map(ToString::to_string).collect();
    let ms: Vec<String> = MS.iter().map(ToString::to_string).collect();
    let rules = VolumeRule::ALL.map(VolumeRule::name);
    let bound = match bound {
        Bound::Free => String::new(),
        Bound::LeastM(least) => format!(", m at least {least}"),
        Bound::Horizon(horizon) => format!(", horizon {horizon} m"),
    };
    format!(
        "Waves of {wavelength} m and longer in a plate, phase speed wrong by at most {error}: the worst of all directions and\n\
         both branches, marched by leapfrog at {OF_LIMIT} of its limit, c_d = {speed} m/s{bound}.\n\
         Searched: {}; m = {}; volumes {}; calibrated or not.\n\
         {} of {} lattices carry long waves that well{}.\n",
        kernels.join(", "),
        ms.join(", "),
        rules.join(", "),
        advice.accurate,
        advice.searched,
        match advice.asked.bound {
            Bound::Free => String::new(),
            _ => format!(", {} of them within the bound", table(advice).rows.len()),
        }
    )
}

/// The question, the cheapest settings, and the cheapest without the bound.
pub fn text(advice: &Advice) -> String {
    let mut text = head(advice);
    let Some(first) = advice.settings.first() else {
        text += "None does what is asked.\n";
        return text + &beside(advice, None);
    };
    text += &format!(
        "\n{:>4} {:<18} {:>4} {:<11} {:<10} {:>9} {:>9} {:>9} {:>6} {:>7} {:>10} {:>12} {:>9} {:>6} {:>5}\n",
        "rank",
        "kernel",
        "m",
        "volumes",
        "calibrated",
        "dx m",
        "horizon m",
        "dt s",
        "pairs",
        "nodes/λ",
        "error",
        "worst",
        "bonds/m²s",
        "times",
        "alike"
    );
    for (n, setting) in advice.settings.iter().take(SHOWN).enumerate() {
        text += &line(n + 1, setting, advice, first);
    }
    text += "\nbonds/m²s: bond updates for each square metre and second of the plate; times: over the cheapest;\n\
             alike: how many other lattices come to the same weights (they are in advice.csv).\n";
    text + &beside(advice, Some(first))
}

fn line(rank: usize, setting: &Setting, advice: &Advice, first: &Setting) -> String {
    let lattice = setting.lattice;
    let worst = format!("{} at {}°", setting.error.branch.name(), setting.error.degrees);
    format!(
        "{rank:>4} {:<18} {:>4} {:<11} {:<10} {:>9} {:>9} {:>9} {:>6} {:>7.2} {:>10} {worst:>12} {:>9} {:>6.3} {:>5}\n",
        lattice.kernel.to_string(),
        lattice.m,
        lattice.volume_rule.name(),
        if lattice.calibrated { "yes" } else { "no" },
        rounded(setting.spacing),
        rounded(lattice.m * setting.spacing),
        rounded(setting.time_step),
        setting.pairs,
        advice.asked.wavelength / setting.spacing,
        rounded(setting.error.value),
        rounded(setting.bond_updates),
        setting.bond_updates / first.bond_updates,
        setting.alike.len(),
    )
}

/// What the bound costs.
fn beside(advice: &Advice, first: Option<&Setting>) -> String {
    let (Some(unbound), false) = (&advice.unbound, advice.asked.bound == Bound::Free) else {
        return String::new();
    };
    let lattice = unbound.lattice;
    let than = first.map_or(String::new(), |first| {
        format!(", {:.3} of the cost of the first above", unbound.bond_updates / first.bond_updates)
    });
    format!(
        "Without the bound: {}, m = {}, {}, {}, dx = {} m, {} bond updates for each m² and second{than}.\n",
        lattice.kernel,
        lattice.m,
        lattice.volume_rule.name(),
        if lattice.calibrated { "calibrated" } else { "as printed" },
        rounded(unbound.spacing),
        rounded(unbound.bond_updates),
    )
}

/// Everything as data.
pub fn json(advice: &Advice) -> Value {
    let Asked { error, wavelength, speed, bound } = advice.asked;
    let setting = |setting: &Setting| {
        json!({
            "kernel": setting.lattice.kernel.name(),
            "p": setting.lattice.kernel.p(),
            "m": setting.lattice.m,
            "volume_rule": setting.lattice.volume_rule.name(),
            "calibrated": setting.lattice.calibrated,
            "dx_m": setting.spacing,
            "horizon_m": setting.lattice.m * setting.spacing,
            "dt_s": setting.time_step,
            "courant": setting.courant,
            "pairs": setting.pairs,
            "error": setting.error.value,
            "angle_deg": setting.error.degrees,
            "branch": setting.error.branch.name(),
            "node_updates_per_m2_s": setting.node_updates,
            "bond_updates_per_m2_s": setting.bond_updates,
            "alike": setting.alike.len(),
        })
    };
    json!({
        "error": error,
        "wavelength_m": wavelength,
        "speed_m_s": speed,
        "min_m": match bound { Bound::LeastM(least) => Some(least), _ => None },
        "horizon_m": match bound { Bound::Horizon(horizon) => Some(horizon), _ => None },
        "of_limit": OF_LIMIT,
        "searched": {
            "kernels": KERNELS.map(|kernel| kernel.to_string()),
            "m": MS,
            "volume_rules": VolumeRule::ALL.map(VolumeRule::name),
            "lattices": advice.searched,
            "accurate": advice.accurate,
        },
        "settings": advice.settings.iter().take(SHOWN).map(setting).collect::<Vec<_>>(),
        "unbound": advice.unbound.as_ref().map(setting),
    })
}
