//! The words of study files: bodies, kernels, volume rules, schemes, branches.

use pd_verify::dispersion::Branch;
use pd_verify::material::Body;
use pd_verify::partial_volume::VolumeRule;
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BodyName {
    Bar,
    PlaneStress,
    PlaneStrain,
}

impl From<BodyName> for Body {
    fn from(name: BodyName) -> Self {
        match name {
            BodyName::Bar => Self::Bar,
            BodyName::PlaneStress => Self::PlaneStress,
            BodyName::PlaneStrain => Self::PlaneStrain,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum KernelName {
    Constant,
    Gaussian,
    Exponential,
    Conical,
    Parabolic,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum VolumeRuleName {
    Full,
    Linear,
    ExactArea,
}

impl From<VolumeRuleName> for VolumeRule {
    fn from(name: VolumeRuleName) -> Self {
        match name {
            VolumeRuleName::Full => Self::Full,
            VolumeRuleName::Linear => Self::Linear,
            VolumeRuleName::ExactArea => Self::ExactArea,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SchemeName {
    Continuum,
    Lattice,
    LatticeLeapfrog,
    Fd,
    FdLeapfrog,
}

impl SchemeName {
    /// The word in study files.
    pub fn word(self) -> &'static str {
        match self {
            Self::Continuum => "continuum",
            Self::Lattice => "lattice",
            Self::LatticeLeapfrog => "lattice_leapfrog",
            Self::Fd => "fd",
            Self::FdLeapfrog => "fd_leapfrog",
        }
    }

    /// Whether it has a kernel and a horizon.
    pub fn peridynamic(self) -> bool {
        !matches!(self, Self::Fd | Self::FdLeapfrog)
    }

    /// Whether it has nodes with volumes.
    pub fn lattice(self) -> bool {
        matches!(self, Self::Lattice | Self::LatticeLeapfrog)
    }

    /// Whether it has a time step.
    pub fn leapfrog(self) -> bool {
        matches!(self, Self::LatticeLeapfrog | Self::FdLeapfrog)
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
pub enum BranchName {
    P,
    S,
}

impl From<BranchName> for Branch {
    fn from(name: BranchName) -> Self {
        match name {
            BranchName::P => Self::P,
            BranchName::S => Self::S,
        }
    }
}
