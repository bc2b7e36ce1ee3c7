//! Sweeps in study files: lists of parameters whose every combination is a curve or a lattice.

use super::curve::{Curve, Medium};
use super::words::{BranchName, KernelName, SchemeName, VolumeRuleName};
use crate::input::{OneOrMany, Positive, one_or_many};
use pd_verify::dispersion::Branch;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil, Unusable};
use pd_verify::material::{Body, Material};
use schemars::JsonSchema;
use serde::Deserialize;

/// What is wrong with a part of a case: the key, the message, the cure.
#[derive(Debug, Clone, PartialEq)]
pub struct Wrong {
    pub key: String,
    pub message: String,
    pub help: String,
}

impl Wrong {
    pub fn new(key: impl Into<String>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { key: key.into(), message: message.into(), help: help.into() }
    }

    /// The same, further inside.
    pub fn inside(self, outer: &str) -> Self {
        Self { key: format!("{outer}.{}", self.key), ..self }
    }
}

/// Every combination of these is a lattice. `p` goes with `gaussian` and `exponential`.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LatticeSweep {
    pub kernel: OneOrMany<KernelName>,
    /// Narrowness of `gaussian` and `exponential` kernels.
    pub p: Option<OneOrMany<Positive>>,
    /// δ/Δx, at least 1.
    pub m: OneOrMany<Positive>,
    pub volume_rule: OneOrMany<VolumeRuleName>,
    /// Whether the weights are scaled to return the intended moduli. Default `false`.
    pub calibrated: Option<OneOrMany<bool>>,
}

/// No case is larger than this; what asks for more is a slip of the pen.
pub const MAX_CURVES: u64 = 100_000;

impl LatticeSweep {
    /// All lattices, each checked for use in `body`; `refused` keeps those that are not usable instead.
    pub fn lattices(&self) -> Result<Vec<Lattice>, Wrong> {
        let kernels = kernels(&self.kernel, self.p.as_ref())?;
        let calibrated = self.calibrated.clone().unwrap_or(one_or_many(false)).0;
        let count = [kernels.len(), self.m.0.len(), self.volume_rule.0.len(), calibrated.len()];
        check_count(&count)?;
        let mut all = Vec::new();
        for &kernel in &kernels {
            for &Positive(m) in &self.m.0 {
                for &rule in &self.volume_rule.0 {
                    for &calibrated in &calibrated {
                        all.push(Lattice { kernel, m, volume_rule: rule.into(), calibrated });
                    }
                }
            }
        }
        Ok(all)
    }
}

/// The kernels named, each narrow one with every p.
pub fn kernels(names: &OneOrMany<KernelName>, p: Option<&OneOrMany<Positive>>) -> Result<Vec<Kernel>, Wrong> {
    let narrow = |name| matches!(name, KernelName::Gaussian | KernelName::Exponential);
    if let Some(p) = p
        && !names.0.iter().copied().any(narrow)
    {
        let message = format!("p = {} has no kernel to narrow", p.0[0].0);
        return Err(Wrong::new(
            "p",
            message,
            "p goes with the kernels gaussian and exponential; leave it out",
        ));
    }
    let mut all = Vec::new();
    for &name in &names.0 {
        let many = |make: fn(f64) -> Kernel| match p {
            Some(p) => Ok(p.0.iter().map(|p| make(p.0)).collect()),
            None => {
                let name = make(1.0).name();
                Err(Wrong::new("kernel", format!("kernel \"{name}\" needs p"), "add p, for example p = 2"))
            }
        };
        match name {
            KernelName::Constant => all.push(Kernel::Constant),
            KernelName::Conical => all.push(Kernel::Conical),
            KernelName::Parabolic => all.push(Kernel::Parabolic),
            KernelName::Gaussian => all.extend::<Vec<_>>(many(|p| Kernel::Gaussian { p })?),
            KernelName::Exponential => all.extend::<Vec<_>>(many(|p| Kernel::Exponential { p })?),
        }
    }
    Ok(all)
}

fn check_count(lengths: &[usize]) -> Result<(), Wrong> {
    let count = lengths.iter().fold(1_u64, |product, &length| product.saturating_mul(length as u64));
    if count <= MAX_CURVES {
        return Ok(());
    }
    let message = format!("this sweep asks for {count} combinations, at most {MAX_CURVES} are run");
    Err(Wrong::new("", message, "shorten its lists or split it into several studies"))
}

/// Says why a lattice cannot be used in a body; `None` when it can.
pub fn unusable(body: Body, lattice: Lattice) -> Option<Unusable> {
    match body {
        Body::Bar => Stencil::<1>::new(lattice).err(),
        Body::PlaneStress | Body::PlaneStrain => Stencil::<2>::new(lattice).err(),
    }
}

/// The largest m that is run: a bar has 2m neighbours, a plate about πm².
pub fn check_m(body: Body, m: f64) -> Result<(), Wrong> {
    let most = if body == Body::Bar { 10_000.0 } else { 200.0 };
    if m <= most {
        return Ok(());
    }
    Err(Wrong::new(
        "m",
        format!("m = {m} is more than the {most} that are run"),
        "take a smaller m, or the continuum",
    ))
}

fn check_lattice(body: Body, lattice: Lattice) -> Result<(), Wrong> {
    check_m(body, lattice.m)?;
    match unusable(body, lattice) {
        None => Ok(()),
        Some(reason) => Err(Wrong::new("m", reason.to_string(), reason.cure())),
    }
}

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
        all.dedup();
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
        let branch = |name| if name == BranchName::P { Branch::P } else { Branch::S };
        branches.iter().flat_map(|&name| angles.iter().map(move |&angle| (branch(name), angle))).collect()
    }

    fn media(&self, scheme: SchemeName, body: Body) -> Result<Vec<Medium>, Wrong> {
        let missing = |key: &str, help: &str| {
            let scheme = format!("{scheme:?}").to_lowercase();
            Wrong::new("scheme", format!("scheme \"{scheme}\" needs {key}"), help)
        };
        if !scheme.peridynamic() {
            let dx =
                self.dx_m.as_ref().ok_or_else(|| missing("dx_m", "add dx_m, for example dx_m = 0.002"))?;
            return Ok(dx.0.iter().map(|dx| Medium::FiniteDifferences { dx: dx.0 }).collect());
        }
        let names = self
            .kernel
            .as_ref()
            .ok_or_else(|| missing("kernel", "add kernel, for example kernel = \"constant\""))?;
        let kernels = kernels(names, self.p.as_ref())?;
        let sizes = self.sizes(scheme)?;
        if !scheme.lattice() {
            let horizons = sizes.iter().map(|size| size.horizon.expect("sizes() fixes the horizon"));
            let all = kernels.iter().flat_map(|&kernel| {
                horizons.clone().map(move |horizon| Medium::Continuum { kernel, horizon })
            });
            return Ok(all.collect());
        }
        let rules = self.volume_rule.as_ref().ok_or_else(|| {
            missing("volume_rule", "add volume_rule = \"full\", \"linear\" or \"exact_area\"")
        })?;
        let calibrated = self.calibrated.clone().unwrap_or(one_or_many(false)).0;
        let mut all = Vec::new();
        for &kernel in &kernels {
            for size in &sizes {
                for &rule in &rules.0 {
                    for &calibrated in &calibrated {
                        let (m, dx) = (size.m.expect("sizes() fixes m"), size.dx.expect("sizes() fixes dx"));
                        let lattice = Lattice { kernel, m, volume_rule: rule.into(), calibrated };
                        check_lattice(body, lattice)?;
                        all.push(Medium::Lattice { lattice, dx });
                    }
                }
            }
        }
        Ok(all)
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
