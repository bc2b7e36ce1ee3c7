//! How a case refines: δ → 0 at fixed m, m → ∞ at fixed δ, or both along a path; and the weights that it refines with.

use crate::dispersion::m_convergence;
use crate::dispersion::sweep::{check_count, check_marched, check_sizes, kernels};
use crate::dispersion::words::{KernelName, VolumeRuleName};
use crate::input::{OneOrMany, one_or_many};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::scene::{Positive, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// What goes where in a refinement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Refine {
    /// δ → 0 at fixed m, towards the local solution.
    Delta,
    /// m → ∞ at fixed δ, towards the nonlocal solution.
    M,
    /// δ → 0 and m → ∞ together, towards the local solution.
    DeltaM,
}

impl Refine {
    /// In `convergence.csv`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Delta => "delta",
            Self::M => "m",
            Self::DeltaM => "delta_m",
        }
    }
}

/// A refinement as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PathAsked {
    pub refine: Refine,
    /// δ/Δx. Of `delta`: one for each refinement; else growing, one for each level.
    pub m: OneOrMany<Positive>,
    /// Of `delta` and `delta_m`: falling, one for each level.
    pub dx_m: Option<Vec<Positive>>,
    /// Of `m`: δ.
    pub horizon_m: Option<Positive>,
}

/// Weights as written: every combination is refined.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WeightsAsked {
    pub kernel: OneOrMany<KernelName>,
    /// Narrowness of `gaussian` and `exponential` kernels.
    pub p: Option<OneOrMany<Positive>>,
    pub volume_rule: OneOrMany<VolumeRuleName>,
    /// Whether the weights are scaled to return the intended moduli. Default `false`.
    pub calibrated: Option<OneOrMany<bool>>,
}

/// How bonds are weighed, whatever m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights {
    pub kernel: Kernel,
    pub volume_rule: VolumeRule,
    pub calibrated: bool,
}

/// One level: m and Δx in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    pub m: f64,
    pub spacing: f64,
}

/// Weights along a path.
#[derive(Debug, Clone, PartialEq)]
pub struct Sequence {
    pub refine: Refine,
    pub weights: Weights,
    /// From coarse to fine.
    pub levels: Vec<Level>,
}

impl Sequence {
    /// The lattice of a level.
    pub fn lattice(&self, level: Level) -> Lattice {
        self.weights.lattice(level.m)
    }

    /// What the error is ordered by: δ in m, or 1/m.
    pub fn step(&self, level: Level) -> f64 {
        match self.refine {
            Refine::M => 1.0 / level.m,
            Refine::Delta | Refine::DeltaM => level.m * level.spacing,
        }
    }

    /// δ in m where it is fixed.
    pub fn horizon(&self) -> Option<f64> {
        let level = self.levels.first()?;
        (self.refine == Refine::M).then_some(level.m * level.spacing)
    }

    pub fn finest(&self) -> Level {
        self.levels[self.levels.len() - 1]
    }
}

impl Weights {
    /// The lattice with m = δ/Δx.
    pub fn lattice(self, m: f64) -> Lattice {
        let Self { kernel, volume_rule, calibrated } = self;
        Lattice { kernel, m, volume_rule, calibrated }
    }

    /// In the name of a claim.
    pub fn slug(self) -> String {
        let weights = if self.calibrated { "calibrated" } else { "printed" };
        format!("{}_{}_{weights}", m_convergence::slug(self.kernel), self.volume_rule.name())
    }
}

impl WeightsAsked {
    /// Every combination.
    pub fn all(&self) -> Result<Vec<Weights>, Wrong> {
        let kernels = kernels(&self.kernel, self.p.as_ref())?;
        let calibrated = self.calibrated.clone().unwrap_or(one_or_many(false)).0;
        check_count(&[kernels.len(), self.volume_rule.0.len(), calibrated.len()])?;
        let mut all = Vec::new();
        for &kernel in &kernels {
            for &rule in &self.volume_rule.0 {
                for &calibrated in &calibrated {
                    all.push(Weights { kernel, volume_rule: rule.into(), calibrated });
                }
            }
        }
        Ok(all)
    }
}

impl PathAsked {
    /// Levels of each refinement, from coarse to fine.
    fn levels(&self) -> Result<Vec<Vec<Level>>, Wrong> {
        let keys = [
            ("dx_m", self.dx_m.is_some(), self.refine != Refine::M),
            ("horizon_m", self.horizon_m.is_some(), self.refine == Refine::M),
        ];
        for (key, given, needed) in keys {
            if given != needed {
                let word = self.refine.word();
                let (message, help) = match needed {
                    true => (format!("a refinement of {word} needs {key}"), format!("add {key}")),
                    false => {
                        (format!("{key} says nothing about a refinement of {word}"), "leave it out".into())
                    }
                };
                return Err(Wrong::new(if needed { "" } else { key }, message, help));
            }
        }
        let m: Vec<f64> = self.m.0.iter().map(|m| m.0).collect();
        let spacings = || -> Result<Vec<f64>, Wrong> {
            let written = self.dx_m.as_deref().unwrap_or_default();
            crate::levels::refining("dx_m", written, |coarse, fine| coarse > fine)
        };
        let growing = || crate::levels::refining("m", &self.m.0, |coarse, fine| coarse < fine);
        let pair = |(m, spacing)| Level { m, spacing };
        match self.refine {
            Refine::Delta => {
                let spacings = spacings()?;
                check_count(&[m.len(), spacings.len()])?;
                Ok(m.iter().map(|&m| spacings.iter().map(|&dx| pair((m, dx))).collect()).collect())
            }
            Refine::M => {
                let horizon = self.horizon_m.map_or(f64::NAN, |horizon| horizon.0);
                Ok(vec![growing()?.into_iter().map(|m| pair((m, horizon / m))).collect()])
            }
            Refine::DeltaM => {
                let (m, spacings) = (growing()?, spacings()?);
                let levels: Vec<Level> = m.iter().copied().zip(spacings.iter().copied()).map(pair).collect();
                let falling =
                    levels.windows(2).all(|two| two[0].m * two[0].spacing > two[1].m * two[1].spacing);
                if m.len() != spacings.len() || !falling {
                    let message = "a path needs an m for each dx_m, and a horizon m dx that falls";
                    return Err(Wrong::new(
                        "m",
                        message,
                        "for example m = [3, 6, 12], dx_m = [0.04, 0.01, 0.0025]",
                    ));
                }
                Ok(vec![levels])
            }
        }
    }

    /// Every refinement of these weights, none with more bonds than are made.
    pub fn sequences(&self, body: Body, weights: &WeightsAsked) -> Result<Vec<Sequence>, Wrong> {
        let levels = self.levels().map_err(|wrong| wrong.inside("path"))?;
        let weights = weights.all().map_err(|wrong| wrong.inside("weights"))?;
        check_count(&[weights.len(), levels.len(), levels.first().map_or(0, Vec::len)])?;
        let of = |weights: &Weights| {
            let (refine, weights) = (self.refine, *weights);
            levels
                .iter()
                .map(move |levels| Sequence { refine, weights, levels: levels.clone() })
                .collect::<Vec<_>>()
        };
        let sequences: Vec<Sequence> = weights.iter().flat_map(of).collect();
        let finest: Vec<Lattice> = sequences.iter().map(|one| one.lattice(one.finest())).collect();
        let most = sequences.iter().map(|one| one.levels.len()).max().unwrap_or(0);
        check_marched(body, &finest, most).map_err(|wrong| wrong.inside("path"))?;
        let each = sequences.iter().flat_map(|one| one.levels.iter().map(|level| one.lattice(*level)));
        check_sizes(body, &each.collect::<Vec<_>>()).map_err(|wrong| wrong.inside("path"))?;
        Ok(sequences)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(text: &str) -> Result<Vec<Vec<Level>>, String> {
        toml::from_str::<PathAsked>(text).unwrap().levels().map_err(|wrong| wrong.message)
    }

    #[test]
    fn a_path_is_a_list_of_levels() {
        let delta = asked("refine = 'delta'\nm = [3, 5]\ndx_m = [0.4, 0.2, 0.1]").unwrap();
        assert_eq!((delta.len(), delta[1][2]), (2, Level { m: 5.0, spacing: 0.1 }));
        let m = asked("refine = 'm'\nm = [2, 4, 8]\nhorizon_m = 0.8").unwrap();
        assert_eq!(m[0][1], Level { m: 4.0, spacing: 0.2 });
        let both = asked("refine = 'delta_m'\nm = [2, 4, 8]\ndx_m = [0.4, 0.1, 0.025]").unwrap();
        assert_eq!(both[0][2], Level { m: 8.0, spacing: 0.025 });
    }

    #[test]
    fn what_is_no_path_is_refused() {
        for text in [
            "refine = 'delta'\nm = 3\ndx_m = [0.4, 0.2]",
            "refine = 'delta'\nm = 3",
            "refine = 'm'\nm = [2, 4, 8]",
            "refine = 'm'\nm = [2, 4, 3]\nhorizon_m = 1",
            "refine = 'm'\nm = [2, 4, 8]\nhorizon_m = 1\ndx_m = [3, 2, 1]",
            "refine = 'delta_m'\nm = [2, 4]\ndx_m = [0.4, 0.1, 0.025]",
            "refine = 'delta_m'\nm = [2, 4, 8]\ndx_m = [0.4, 0.2, 0.1]",
        ] {
            assert!(asked(text).is_err(), "{text}");
        }
    }
}
