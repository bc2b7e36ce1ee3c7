//! Sweeps of lattices in study files: lists of parameters whose every combination is a lattice, and what is refused.

use super::words::{KernelName, VolumeRuleName};
use crate::input::{OneOrMany, one_or_many};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil, Unusable};
use pd_verify::material::Body;
use pd_verify::scene::{Positive, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::HashSet;

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

/// Quadrature takes a panel for each width of the kernel.
const MAX_P: f64 = 100.0;

impl LatticeSweep {
    /// All lattices, usable or not.
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

    /// All lattices, refused as a whole if any cannot be used in the body.
    pub fn usable(&self, body: Body) -> Result<Vec<Lattice>, Wrong> {
        let lattices = self.lattices()?;
        check_usable(body, &lattices)?;
        Ok(lattices)
    }
}

/// A case that marches more bodies is a slip of the pen.
const MAX_MARCHES: usize = 10_000;

/// Visits of bonds by which the limits on Δt may be searched for, before anything is marched: seconds.
const MAX_SEARCHED: f64 = 5e8;

impl LatticeSweep {
    /// The same for bodies that are marched, so many of each lattice.
    pub fn marched(&self, body: Body, each: usize) -> Result<Vec<Lattice>, Wrong> {
        let lattices = self.lattices()?;
        check_marched(body, &lattices, each)?;
        check_usable(body, &lattices)?;
        Ok(lattices)
    }
}

/// Refuses more marches than are run, and lattices whose limits on Δt take long to find; so many marches of each.
pub fn check_marched(body: Body, lattices: &[Lattice], each: usize) -> Result<(), Wrong> {
    let marches = lattices.len().saturating_mul(each);
    if marches > MAX_MARCHES {
        let message = format!("{marches} bodies are asked for, at most {MAX_MARCHES} are marched by a case");
        return Err(Wrong::new("", message, "shorten its lists, or split the case"));
    }
    check_sizes(body, lattices)?;
    // Eight samples to the shortest harmonic, along each axis; in the plane a lattice is searched once for all spacings.
    let search = |lattice: &Lattice| match body {
        Body::Bar => 8.0 * (lattice.m + 1.0).powi(2) * each as f64,
        Body::PlaneStress | Body::PlaneStrain => 51.0 * (lattice.m.min(20.0) + 1.0).powi(4),
    };
    let visits: f64 = lattices.iter().map(search).sum();
    if visits <= MAX_SEARCHED {
        return Ok(());
    }
    let message = format!(
        "the largest time steps of {marches} bodies would be sought by {visits:.1e} visits of bonds, at most {MAX_SEARCHED:.0e} are made"
    );
    Err(Wrong::new("m", message, "take fewer lattices, or a smaller m"))
}

/// Each value once, in the order of first appearance.
pub fn distinct<T: PartialEq>(values: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut seen = Vec::new();
    for value in values {
        if !seen.contains(&value) {
            seen.push(value);
        }
    }
    seen
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
    if let Some(Positive(p)) = p.and_then(|p| p.0.iter().find(|p| p.0 > MAX_P)) {
        let message = format!("p = {p} is narrower than is run, at most {MAX_P}");
        return Err(Wrong::new("p", message, "take a smaller p; kernels that narrow see no neighbour"));
    }
    let mut all: Vec<Kernel> = Vec::new();
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
    let mut seen = HashSet::new();
    all.retain(|kernel| seen.insert((kernel.name(), kernel.p().map(f64::to_bits))));
    Ok(all)
}

/// Refuses a product of lists that is beyond measure.
pub fn check_count(lengths: &[usize]) -> Result<(), Wrong> {
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
fn check_m(body: Body, m: f64) -> Result<(), Wrong> {
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

/// Pairs of bonds in a family, to within a shell.
pub fn family_size(body: Body, lattice: Lattice) -> u64 {
    let reach = lattice.m + 1.0;
    let pairs = if body == Body::Bar { reach } else { 1.6 * reach * reach };
    pairs as u64
}

/// Bonds that a study may have in all its lattices together.
const MAX_BONDS: u64 = 50_000_000;

/// Refuses lattices that are too large, one by one or together, before any weight is made.
pub fn check_sizes(body: Body, lattices: &[Lattice]) -> Result<(), Wrong> {
    lattices.iter().try_for_each(|lattice| check_m(body, lattice.m))?;
    let bonds = lattices.iter().fold(0_u64, |sum, &lattice| sum.saturating_add(family_size(body, lattice)));
    if bonds <= MAX_BONDS {
        return Ok(());
    }
    let message = format!(
        "{} lattices with {bonds} pairs of bonds are asked for, at most {MAX_BONDS} are made",
        lattices.len()
    );
    Err(Wrong::new("m", message, "smaller m, or shorter lists"))
}

/// Refuses the first lattice that cannot be used in a body.
pub fn check_usable(body: Body, lattices: &[Lattice]) -> Result<(), Wrong> {
    check_sizes(body, lattices)?;
    match lattices.iter().find_map(|&lattice| unusable(body, lattice)) {
        None => Ok(()),
        Some(reason) => Err(Wrong::new("m", reason.to_string(), reason.cure())),
    }
}
