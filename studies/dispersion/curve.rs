//! One dispersion curve: what carries the wave, and its ω(k) from the code under judgement and from the reference.

use crate::subject::Subject;
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::dispersion::finite_differences::QUARTER;
use pd_verify::dispersion::plane::{PlaneDispersion, direction, speed_ratio_squared};
use pd_verify::dispersion::{Branch, Wave};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Unusable};
use pd_verify::material::Body;
use pd_verify::partial_volume::VolumeRule;
use pd_verify_reference as reference;
use std::f64::consts::PI;

/// What the wave travels in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Medium {
    Continuum { kernel: Kernel, horizon: f64 },
    Lattice { lattice: Lattice, dx: f64 },
    FiniteDifferences { dx: f64 },
}

/// A curve ω(k); lengths in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curve {
    pub body: Body,
    pub medium: Medium,
    /// c_d Δt/Δx of leapfrog; `None` for exact time.
    pub courant: Option<f64>,
    pub branch: Branch,
    /// Direction of travel from the x axis; 0 in a bar.
    pub degrees: f64,
}

impl Curve {
    /// The word of the scheme in `dispersion_curves.csv`.
    pub fn scheme(&self) -> &'static str {
        match (self.medium, self.courant) {
            (Medium::Continuum { .. }, _) => "continuum",
            (Medium::Lattice { .. }, None) => "lattice",
            (Medium::Lattice { .. }, Some(_)) => "lattice_leapfrog",
            (Medium::FiniteDifferences { .. }, None) => "fd",
            (Medium::FiniteDifferences { .. }, Some(_)) => "fd_leapfrog",
        }
    }

    /// The kernel, where there is one.
    pub fn kernel(&self) -> Option<Kernel> {
        match self.medium {
            Medium::Continuum { kernel, .. } => Some(kernel),
            Medium::Lattice { lattice, .. } => Some(lattice.kernel),
            Medium::FiniteDifferences { .. } => None,
        }
    }

    /// The lattice, where there is one.
    pub fn lattice(&self) -> Option<Lattice> {
        match self.medium {
            Medium::Lattice { lattice, .. } => Some(lattice),
            Medium::Continuum { .. } | Medium::FiniteDifferences { .. } => None,
        }
    }

    /// Δx in m, where there is a grid.
    pub fn dx(&self) -> Option<f64> {
        match self.medium {
            Medium::Continuum { .. } => None,
            Medium::Lattice { dx, .. } | Medium::FiniteDifferences { dx } => Some(dx),
        }
    }

    /// δ in m, where there is one.
    pub fn horizon(&self) -> Option<f64> {
        match self.medium {
            Medium::Continuum { horizon, .. } => Some(horizon),
            Medium::Lattice { lattice, dx } => Some(lattice.m * dx),
            Medium::FiniteDifferences { .. } => None,
        }
    }

    /// The length that makes wavenumbers dimensionless: δ of a continuum, Δx of a grid.
    pub fn unit(&self) -> f64 {
        match self.medium {
            Medium::Continuum { horizon, .. } => horizon,
            Medium::Lattice { dx, .. } | Medium::FiniteDifferences { dx } => dx,
        }
    }

    /// k at the edge of the Brillouin zone along the direction of travel, in 1/m: beyond it a grid has no new wave.
    pub fn zone_edge(&self) -> Option<f64> {
        let steepest = match self.body {
            Body::Bar => 1.0,
            Body::PlaneStress | Body::PlaneStrain => {
                direction(self.degrees).iter().fold(0.0_f64, |most, n| most.max(n.abs()))
            }
        };
        self.dx().map(|dx| PI / (dx * steepest))
    }

    /// cΔt/Δx with the branch's own speed.
    pub fn own_courant(&self) -> Option<f64> {
        self.courant.map(|courant| courant / speed_ratio_squared(self.own_branch()).sqrt())
    }

    /// The branch; a bar has only P.
    pub fn own_branch(&self) -> Branch {
        if self.body == Body::Bar { Branch::P } else { self.branch }
    }

    /// Ready to be evaluated by `subject`.
    pub fn prepare<'a>(&self, subject: &'a dyn Subject) -> Result<Prepared<'a>, Unusable> {
        let relation = match (self.lattice(), self.body) {
            (None, _) => Relation::None,
            (Some(lattice), Body::Bar) => Relation::Bar(BarDispersion::new(&subject.bar_stencil(lattice)?)),
            (Some(lattice), _) => Relation::Plane(PlaneDispersion::new(&subject.plane_stencil(lattice)?)),
        };
        Ok(Prepared { curve: *self, subject, relation })
    }

    /// The reference's wave at k in 1/m: ω/c in 1/m and group velocity over c. `None` where the scheme is
    /// unstable or the reference does not reach.
    pub fn reference(&self, k: f64) -> Option<Wave> {
        let unit = self.unit();
        let x = k * unit;
        let radians = self.degrees.to_radians();
        let pick = |waves: [reference::Wave; 2]| waves[usize::from(self.own_branch() == Branch::S)];
        let branch = reference_branch(self.own_branch());
        let space = match (self.medium, self.body) {
            (Medium::Continuum { kernel, .. }, Body::Bar) => {
                reference::continuum::bar(reference_kernel(kernel), x)?
            }
            (Medium::Continuum { kernel, .. }, _) => {
                reference::continuum::plane(reference_kernel(kernel), branch, x)?
            }
            (Medium::Lattice { lattice, .. }, Body::Bar) => {
                reference::lattice::bar(reference_lattice(lattice), x)
            }
            (Medium::Lattice { lattice, .. }, _) => {
                pick(reference::lattice::plane(reference_lattice(lattice), x, radians))
            }
            (Medium::FiniteDifferences { .. }, Body::Bar) => {
                return reference::finite_differences::bar(x, self.courant).map(|wave| scaled(wave, unit));
            }
            (Medium::FiniteDifferences { .. }, _) => {
                let waves = reference::finite_differences::plane(x, radians, self.courant);
                return waves[usize::from(self.own_branch() == Branch::S)].map(|wave| scaled(wave, unit));
            }
        };
        match self.own_courant() {
            Some(courant) => reference::leapfrog::wave(space, courant).map(|wave| scaled(wave, unit)),
            None => Some(scaled(space, unit)),
        }
    }
}

fn scaled(wave: reference::Wave, unit: f64) -> Wave {
    Wave { omega: wave.omega / unit, group: wave.slope }
}

enum Relation {
    None,
    Bar(BarDispersion),
    Plane(PlaneDispersion),
}

/// A curve with its weights made.
pub struct Prepared<'a> {
    curve: Curve,
    subject: &'a dyn Subject,
    relation: Relation,
}

impl Prepared<'_> {
    /// ω/c in 1/m and group velocity over c at k in 1/m; `None` where the scheme is unstable.
    pub fn wave(&self, k: f64) -> Option<Wave> {
        let curve = &self.curve;
        let x = k * curve.unit();
        let (subject, branch, degrees) = (self.subject, curve.own_branch(), curve.degrees);
        let bar = curve.body == Body::Bar;
        let space = match (&self.relation, curve.medium) {
            (Relation::Bar(relation), _) => subject.bar_wave(relation, x),
            (Relation::Plane(relation), _) => subject.plane_wave(relation, x, degrees, branch),
            (Relation::None, Medium::Continuum { kernel, .. }) if bar => subject.continuum_bar(kernel, x),
            (Relation::None, Medium::Continuum { kernel, .. }) => subject.continuum_plane(kernel, branch, x),
            (Relation::None, _) if bar => {
                return subject.finite_differences_bar(x, curve.courant).map(|wave| self.dimensional(wave));
            }
            (Relation::None, _) => subject.finite_differences_plane(x, degrees, branch, QUARTER),
        };
        match curve.own_courant() {
            Some(courant) => subject.leapfrog(space, courant).map(|wave| self.dimensional(wave)),
            None => Some(self.dimensional(space)),
        }
    }

    fn dimensional(&self, wave: Wave) -> Wave {
        Wave { omega: wave.omega / self.curve.unit(), group: wave.group }
    }
}

/// The same kernel in the reference's words.
pub fn reference_kernel(kernel: Kernel) -> reference::Kernel {
    match kernel {
        Kernel::Constant => reference::Kernel::Constant,
        Kernel::Gaussian { p } => reference::Kernel::Gaussian { p },
        Kernel::Exponential { p } => reference::Kernel::Exponential { p },
        Kernel::Conical => reference::Kernel::Conical,
        Kernel::Parabolic => reference::Kernel::Parabolic,
    }
}

/// The same lattice in the reference's words.
pub fn reference_lattice(lattice: Lattice) -> reference::Lattice {
    let (kernel, rule) = (reference_kernel(lattice.kernel), reference_rule(lattice.volume_rule));
    reference::Lattice { kernel, m: lattice.m, rule, calibrated: lattice.calibrated }
}

/// The same volume rule in the reference's words.
pub fn reference_rule(rule: VolumeRule) -> reference::VolumeRule {
    match rule {
        VolumeRule::Full => reference::VolumeRule::Full,
        VolumeRule::Linear => reference::VolumeRule::Linear,
        VolumeRule::ExactArea => reference::VolumeRule::ExactArea,
    }
}

fn reference_branch(branch: Branch) -> reference::Branch {
    match branch {
        Branch::P => reference::Branch::P,
        Branch::S => reference::Branch::S,
    }
}
