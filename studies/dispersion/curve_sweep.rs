//! Sweeps of curves in study files: lists of parameters whose every combination is a curve.

use super::curve::{Curve, Medium};
use super::sweep::{check_count, check_usable, kernels};
use super::words::{BranchName, KernelName, SchemeName, VolumeRuleName};
use crate::input::{OneOrMany, one_or_many};
use pd_verify::dispersion::Branch;
use pd_verify::lattice::Lattice;
use pd_verify::material::{Body, Material};
use pd_verify::scene::{Positive, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::HashSet;

/// Every combination of these is a curve.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CurveSweep {
    pub scheme: OneOrMany<SchemeName>,
    pub kernel: Option<OneOrMany<KernelName>>,
    /// Narrowness of `gaussian` and `exponential` kernels.
    pub p: Option<OneOrMany<Positive>>,
    /// δ/Δx, at least 1. Two of `m`, `dx_m` and `horizon_m` fix a lattice.
    pub m: Option<OneOrMany<Positive>>,
    pub dx_m: Option<OneOrMany<Positive>>,
    pub horizon_m: Option<OneOrMany<Positive>>,
    pub volume_rule: Option<OneOrMany<VolumeRuleName>>,
    pub calibrated: Option<OneOrMany<bool>>,
    /// c_d Δt/Δx of leapfrog (vΔt/Δx in a bar).
    pub courant: Option<OneOrMany<Positive>>,
    /// Δt of leapfrog, instead of `courant`; needs the study's material.
    pub time_step_s: Option<OneOrMany<Positive>>,
    /// Default both, in the plane.
    pub branch: Option<OneOrMany<BranchName>>,
    /// Direction of travel from the x axis, default 0.
    pub angle_deg: Option<OneOrMany<f64>>,
}

/// A grid or a continuum: its horizon over spacing and its length.
#[derive(Clone, Copy)]
struct Size {
    m: Option<f64>,
    dx: Option<f64>,
    horizon: Option<f64>,
}

impl CurveSweep {
    /// All curves, every lattice checked for use.
    pub fn curves(&self, body: Body, material: Option<Material>) -> Result<Vec<Curve>, Wrong> {
        self.check_keys(body)?;
        let rays = self.rays(body);
        let mut all = Vec::new();
        for &scheme in &self.scheme.0 {
            for medium in self.media(scheme, body)? {
                for courant in self.courants(scheme, medium, body, material)? {
                    for &(branch, degrees) in &rays {
                        all.push(Curve { body, medium, courant, branch, degrees });
                    }
                }
            }
        }
        // The same curve asked for twice is drawn once.
        let mut seen = HashSet::new();
        all.retain(|curve| seen.insert(format!("{curve:?}")));
        Ok(all)
    }

    /// Refuses keys that no scheme of the sweep uses, and sizes beyond measure.
    fn check_keys(&self, body: Body) -> Result<(), Wrong> {
        let any = |f: fn(SchemeName) -> bool| self.scheme.0.iter().copied().any(f);
        let idle = [
            ("kernel", self.kernel.is_some() && !any(SchemeName::peridynamic)),
            ("p", self.p.is_some() && !any(SchemeName::peridynamic)),
            ("m", self.m.is_some() && !any(SchemeName::peridynamic)),
            ("horizon_m", self.horizon_m.is_some() && !any(SchemeName::peridynamic)),
            ("volume_rule", self.volume_rule.is_some() && !any(SchemeName::lattice)),
            ("calibrated", self.calibrated.is_some() && !any(SchemeName::lattice)),
            ("courant", self.courant.is_some() && !any(SchemeName::leapfrog)),
            ("time_step_s", self.time_step_s.is_some() && !any(SchemeName::leapfrog)),
            ("branch", self.branch.is_some() && body == Body::Bar),
            ("angle_deg", self.angle_deg.is_some() && body == Body::Bar),
        ];
        if let Some((key, _)) = idle.iter().find(|(_, idle)| *idle) {
            let message = format!("{key} means nothing for these schemes in this body");
            return Err(Wrong::new(*key, message, "leave it out, or name the scheme that uses it"));
        }
        if let Some(angle) = self.angle_deg.iter().flat_map(|list| &list.0).find(|angle| angle.abs() > 360.0)
        {
            return Err(Wrong::new(
                "angle_deg",
                format!("angle_deg = {angle} is not a direction"),
                "take -360 to 360",
            ));
        }
        let length = |n: Option<usize>| n.unwrap_or(1);
        check_count(&[
            self.scheme.0.len(),
            length(self.kernel.as_ref().map(|l| l.0.len())),
            length(self.p.as_ref().map(|l| l.0.len())),
            length(self.m.as_ref().map(|l| l.0.len())),
            length(self.dx_m.as_ref().map(|l| l.0.len())),
            length(self.horizon_m.as_ref().map(|l| l.0.len())),
            length(self.volume_rule.as_ref().map(|l| l.0.len())),
            length(self.calibrated.as_ref().map(|l| l.0.len())),
            length(self.courant.as_ref().map(|l| l.0.len())),
            length(self.time_step_s.as_ref().map(|l| l.0.len())),
            length(self.branch.as_ref().map(|l| l.0.len())),
            length(self.angle_deg.as_ref().map(|l| l.0.len())),
        ])
    }

    fn rays(&self, body: Body) -> Vec<(Branch, f64)> {
        if body == Body::Bar {
            return vec![(Branch::P, 0.0)];
        }
        let branches = self.branch.clone().map_or(vec![BranchName::P, BranchName::S], |list| list.0);
        let angles = self.angle_deg.clone().map_or(vec![0.0], |list| list.0);

        branches.iter().flat_map(|&name| angles.iter().map(move |&angle| (name.into(), angle))).collect()
    }

    fn media(&self, scheme: SchemeName, body: Body) -> Result<Vec<Medium>, Wrong> {
        let missing = |key: &str, help: &str| {
            Wrong::new("scheme", format!("scheme \"{}\" needs {key}", scheme.word()), help)
        };
        if !scheme.peridynamic() {
            let dx =
                self.dx_m.as_ref().ok_or_else(|| missing("dx_m", "add dx_m, for example dx_m = 0.002"))?;
            return Ok(dx.0.iter().map(|dx| Medium::FiniteDifferences { dx: dx.0 }).collect());
        }
        let names = self.kernel.as_ref();
        let names =
            names.ok_or_else(|| missing("kernel", "add kernel, for example kernel = \"constant\""))?;
        let kernels = kernels(names, self.p.as_ref())?;
        let sizes = self.sizes(scheme)?;
        if !scheme.lattice() {
            let horizons = sizes.iter().map(|size| size.horizon.expect("sizes() fixes the horizon"));
            let of = |kernel| horizons.clone().map(move |horizon| Medium::Continuum { kernel, horizon });
            return Ok(kernels.iter().copied().flat_map(of).collect());
        }
        let rules = self.volume_rule.as_ref();
        let rules = rules.ok_or_else(|| {
            missing("volume_rule", "add volume_rule = \"full\", \"linear\" or \"exact_area\"")
        })?;
        let calibrated = self.calibrated.clone().unwrap_or(one_or_many(false)).0;
        let mut all = Vec::new();
        for &kernel in &kernels {
            for size in &sizes {
                for &rule in &rules.0 {
                    for &calibrated in &calibrated {
                        let (m, dx) = (size.m.expect("sizes() fixes m"), size.dx.expect("sizes() fixes dx"));
                        all.push((Lattice { kernel, m, volume_rule: rule.into(), calibrated }, dx));
                    }
                }
            }
        }
        let lattices: Vec<Lattice> = all.iter().map(|(lattice, _)| *lattice).collect();
        check_usable(body, &lattices)?;
        Ok(all.into_iter().map(|(lattice, dx)| Medium::Lattice { lattice, dx }).collect())
    }

    /// Every combination of two of m, Δx and δ; a continuum needs only δ.
    fn sizes(&self, scheme: SchemeName) -> Result<Vec<Size>, Wrong> {
        let list =
            |l: &Option<OneOrMany<Positive>>| l.as_ref().map(|l| l.0.iter().map(|x| x.0).collect::<Vec<_>>());
        let pairs = |a: &[f64], b: &[f64]| -> Vec<(f64, f64)> {
            a.iter().flat_map(|&x| b.iter().map(move |&y| (x, y))).collect()
        };
        let size = |m, dx, horizon| Size { m: Some(m), dx: Some(dx), horizon: Some(horizon) };
        match (list(&self.m), list(&self.dx_m), list(&self.horizon_m)) {
            (Some(m), Some(dx), None) => {
                Ok(pairs(&m, &dx).iter().map(|&(m, dx)| size(m, dx, m * dx)).collect())
            }
            (Some(m), None, Some(d)) => Ok(pairs(&m, &d).iter().map(|&(m, d)| size(m, d / m, d)).collect()),
            (None, Some(dx), Some(d)) => {
                Ok(pairs(&dx, &d).iter().map(|&(dx, d)| size(snapped(d / dx), dx, d)).collect())
            }
            (Some(_), Some(_), Some(_)) => Err(Wrong::new(
                "horizon_m",
                "m, dx_m and horizon_m together say one thing twice",
                "leave one of the three out",
            )),
            (_, _, Some(d)) if !scheme.lattice() => {
                Ok(d.iter().map(|&d| Size { m: None, dx: None, horizon: Some(d) }).collect())
            }
            _ => Err(Wrong::new(
                "scheme",
                "the size of the horizon is not given",
                "give two of m, dx_m and horizon_m (a continuum needs horizon_m alone)",
            )),
        }
    }

    fn courants(
        &self,
        scheme: SchemeName,
        medium: Medium,
        body: Body,
        material: Option<Material>,
    ) -> Result<Vec<Option<f64>>, Wrong> {
        if !scheme.leapfrog() {
            return Ok(vec![None]);
        }
        let dx = match medium {
            Medium::Lattice { dx, .. } | Medium::FiniteDifferences { dx } => dx,
            Medium::Continuum { .. } => unreachable!("a continuum is not marched"),
        };
        match (&self.courant, &self.time_step_s, material) {
            (Some(list), None, _) => Ok(list.0.iter().map(|courant| Some(courant.0)).collect()),
            (None, Some(list), Some(material)) => {
                let speed = material.dilatational_speed(body);
                Ok(list.0.iter().map(|step| Some(speed * step.0 / dx)).collect())
            }
            (None, Some(_), None) => Err(Wrong::new(
                "time_step_s",
                "a time step in seconds needs the speed of the material",
                "add a [material] table with youngs_modulus_pa and density_kg_m3, or give courant",
            )),
            (Some(_), Some(_), _) => Err(Wrong::new(
                "time_step_s",
                "courant and time_step_s say one thing twice",
                "leave one of the two out",
            )),
            (None, None, _) => {
                Err(Wrong::new("scheme", "leapfrog needs a time step", "add courant or time_step_s"))
            }
        }
    }
}

/// δ/Δx, a whole number where it differs from one by rounding alone.
fn snapped(m: f64) -> f64 {
    if (m - m.round()).abs() <= 1e-12 * m { m.round() } else { m }
}
