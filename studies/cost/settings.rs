//! Settings as written: kernels, m, volume rules, calibrations, spacings and time steps, every combination of them.

use super::runs::Run;
use crate::bar::names;
use crate::convergence::path::{Level, Refine, Sequence, Weights, WeightsAsked};
use crate::dispersion::sweep::check_sizes;
use crate::input::OneOrMany;
use crate::levels::refining;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::{Positive, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// Settings as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SettingsAsked {
    pub weights: WeightsAsked,
    /// δ/Δx.
    pub m: OneOrMany<Positive>,
    /// Falling, at least three.
    pub dx_m: Vec<Positive>,
    /// Time steps over the limit of the lattice, below 1.
    pub safety: OneOrMany<Positive>,
    /// In a bar: whether plain finite differences are run beside. Default `false`.
    pub finite_differences: Option<bool>,
}

/// One setting but for its spacing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    pub lattice: Lattice,
    /// Δt over the limit.
    pub safety: f64,
    /// Plain finite differences are the calibrated lattice of nearest neighbours.
    pub finite_differences: bool,
}

/// A setting refined, from coarse to fine.
pub struct Track {
    pub setting: Setting,
    pub runs: Vec<Box<dyn Run>>,
}

impl Setting {
    pub fn method(&self) -> &'static str {
        if self.finite_differences { "finite_differences" } else { "peridynamics" }
    }

    pub fn weights(&self) -> Weights {
        let Lattice { kernel, volume_rule, calibrated, .. } = self.lattice;
        Weights { kernel, volume_rule, calibrated }
    }

    /// As a refinement at fixed m.
    pub fn sequence(&self, spacings: &[f64]) -> Sequence {
        let level = |&spacing: &f64| Level { m: self.lattice.m, spacing };
        let levels = spacings.iter().map(level).collect();
        Sequence { refine: Refine::Delta, weights: self.weights(), levels }
    }

    /// Method, kernel and p: what figures tell apart.
    pub fn family(&self) -> String {
        if self.finite_differences { "finite differences".into() } else { self.lattice.kernel.to_string() }
    }

    /// In full, for captions.
    pub fn said(&self) -> String {
        let step = format!("Δt {} of the limit", self.safety);
        if self.finite_differences {
            return format!("finite differences, {step}");
        }
        let Lattice { kernel, m, volume_rule, calibrated } = self.lattice;
        let weights = if calibrated { "calibrated" } else { "as printed" };
        format!("{kernel}, m = {m}, {}, {weights}, {step}", volume_rule.name())
    }
}

impl SettingsAsked {
    /// Δx of all levels, from coarse to fine.
    pub fn spacings(&self) -> Result<Vec<f64>, Wrong> {
        refining("dx_m", &self.dx_m, |coarse, fine| coarse > fine)
    }

    /// Every combination.
    pub fn all(&self, body: Body) -> Result<Vec<Setting>, Wrong> {
        if let Some(safety) = self.safety.0.iter().find(|safety| safety.0 >= 1.0) {
            let message = format!("{} of the limit is no stable time step", safety.0);
            return Err(Wrong::new("safety", message, "give numbers below 1, for example [0.1, 0.5, 0.95]"));
        }
        let weights = self.weights.all().map_err(|wrong| wrong.inside("weights"))?;
        let mut lattices: Vec<(Lattice, bool)> = Vec::new();
        if self.finite_differences.unwrap_or(false) {
            if body != Body::Bar {
                let message = "plain finite differences are run in bars alone";
                return Err(Wrong::new("finite_differences", message, "leave it out, or take a bar"));
            }
            lattices.push((nearest_neighbours(), true));
        }
        for m in &self.m.0 {
            lattices.extend(weights.iter().map(|weights| (weights.lattice(m.0), false)));
        }
        check_sizes(body, &lattices.iter().map(|(lattice, _)| *lattice).collect::<Vec<_>>())?;
        let stepped = |safety: &Positive| {
            let safety = safety.0;
            lattices.iter().map(move |&(lattice, finite_differences)| Setting {
                lattice,
                safety,
                finite_differences,
            })
        };
        Ok(self.safety.0.iter().flat_map(stepped).collect())
    }
}

/// Whose weights, calibrated, are the second difference.
fn nearest_neighbours() -> Lattice {
    Lattice { kernel: Kernel::Constant, m: 1.0, volume_rule: VolumeRule::Full, calibrated: true }
}

/// Names of settings, saying what is not the same for all.
pub fn named(settings: &[Setting]) -> Vec<String> {
    let lattices: Vec<Lattice> = settings.iter().map(|setting| setting.lattice).collect();
    let steps = settings.iter().any(|setting| setting.safety != settings[0].safety);
    let name = |(setting, name): (&Setting, String)| {
        let name = if setting.finite_differences { "finite differences".to_owned() } else { name };
        if steps { format!("{name}, Δt {} of the limit", setting.safety) } else { name }
    };
    settings.iter().zip(names::names(&lattices)).map(name).collect()
}
