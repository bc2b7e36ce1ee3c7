//! How a bond's stiffness falls off with its length: the kernel W(s), s = |ξ|/δ, and its moments.
//!
//! The micromodulus is c(ξ) = c₀ W(ξ/δ). The moments Mₙ = ∫₀¹ sⁿ W(s) ds set c₀ by energy equivalence
//! (Silling & Askari 2005, Comput. Struct. 83, 1526; see [`crate::micromodulus`]).

/// The shape of the micromodulus over the horizon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kernel {
    /// W = 1.
    Constant,
    /// W = exp(−(p s)²); the constant kernel as p → 0.
    Gaussian { p: f64 },
    /// W = exp(−p s); the constant kernel as p → 0.
    Exponential { p: f64 },
    /// W = 1 − s.
    Conical,
    /// W = 1 − s².
    Parabolic,
}

impl Kernel {
    /// W at s = |ξ|/δ ≥ 0, continued beyond the horizon by the same formula and clipped at 0.
    pub fn weight(self, s: f64) -> f64 {
        match self {
            Self::Constant => 1.0,
            Self::Gaussian { p } => libm::exp(-(p * s) * (p * s)),
            Self::Exponential { p } => libm::exp(-p * s),
            Self::Conical => (1.0 - s).max(0.0),
            Self::Parabolic => ((1.0 - s) * (1.0 + s)).max(0.0),
        }
    }

    /// Mₙ = ∫₀¹ sⁿ W(s) ds in closed form, to a few units in the last place for every p ≥ 0.
    pub fn moment(self, n: u32) -> f64 {
        let order = f64::from(n);
        match self {
            Self::Constant => 1.0 / (order + 1.0),
            Self::Gaussian { p } if p < 2.0 => gaussian_moment_by_series(n, p * p),
            Self::Gaussian { p } => gaussian_moment_by_parts(n, p),
            Self::Exponential { p } if p < 4.0 => exponential_moment_by_series(n, p),
            Self::Exponential { p } => exponential_moment_by_parts(n, p),
            Self::Conical => 1.0 / ((order + 1.0) * (order + 2.0)),
            Self::Parabolic => 2.0 / ((order + 1.0) * (order + 3.0)),
        }
    }

    /// The narrowness p, where the kernel has one.
    pub fn p(self) -> Option<f64> {
        match self {
            Self::Gaussian { p } | Self::Exponential { p } => Some(p),
            Self::Constant | Self::Conical | Self::Parabolic => None,
        }
    }

    /// The word used in study files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Gaussian { .. } => "gaussian",
            Self::Exponential { .. } => "exponential",
            Self::Conical => "conical",
            Self::Parabolic => "parabolic",
        }
    }
}

impl std::fmt::Display for Kernel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.p() {
            Some(p) => write!(f, "{} p = {p}", self.name()),
            None => f.write_str(self.name()),
        }
    }
}

/// e^(−a) Σ (2a)ᵏ / ((n+1)(n+3)…(n+1+2k)), a = p²: every term is positive, so nothing cancels as p → 0.
fn gaussian_moment_by_series(n: u32, a: f64) -> f64 {
    let mut term = 1.0 / (f64::from(n) + 1.0);
    let mut sum = term;
    let mut denominator = f64::from(n) + 3.0;
    while term > 1e-17 * sum {
        term *= 2.0 * a / denominator;
        sum += term;
        denominator += 2.0;
    }
    libm::exp(-a) * sum
}

/// Mₙ = ((n−1) Mₙ₋₂ − e^(−p²)) / (2p²): stable where p² is not small.
fn gaussian_moment_by_parts(n: u32, p: f64) -> f64 {
    let a = p * p;
    match n {
        0 => 0.5 * std::f64::consts::PI.sqrt() * libm::erf(p) / p,
        1 => -libm::expm1(-a) / (2.0 * a),
        _ => (f64::from(n - 1) * gaussian_moment_by_parts(n - 2, p) - libm::exp(-a)) / (2.0 * a),
    }
}

/// e^(−p) Σ pᵏ / ((n+1)(n+2)…(n+1+k)): every term is positive.
fn exponential_moment_by_series(n: u32, p: f64) -> f64 {
    let mut term = 1.0 / (f64::from(n) + 1.0);
    let mut sum = term;
    let mut denominator = f64::from(n) + 2.0;
    while term > 1e-17 * sum {
        term *= p / denominator;
        sum += term;
        denominator += 1.0;
    }
    libm::exp(-p) * sum
}

/// Mₙ = (n Mₙ₋₁ − e^(−p)) / p: stable where p is not small.
fn exponential_moment_by_parts(n: u32, p: f64) -> f64 {
    match n {
        0 => -libm::expm1(-p) / p,
        _ => (f64::from(n) * exponential_moment_by_parts(n - 1, p) - libm::exp(-p)) / p,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quadrature;
    use approx::assert_relative_eq;

    #[test]
    fn closed_moments_agree_with_quadrature() {
        let kernels = [1e-9, 0.3, 1.0, 1.9999, 2.0, 3.999, 4.0, 7.3, 30.0]
            .into_iter()
            .flat_map(|p| [Kernel::Gaussian { p }, Kernel::Exponential { p }])
            .chain([Kernel::Constant, Kernel::Conical, Kernel::Parabolic]);
        for kernel in kernels {
            for n in 0..4 {
                let panels = 8 + kernel.p().unwrap_or(0.0) as usize;
                let integral =
                    quadrature::composite(0.0, 1.0, panels, |s| s.powi(n as i32) * kernel.weight(s));
                assert_relative_eq!(kernel.moment(n), integral.value, max_relative = 4e-15);
            }
        }
    }

    #[test]
    fn wide_limit_is_the_constant_kernel() {
        for n in 0..4 {
            assert_eq!(Kernel::Gaussian { p: 1e-12 }.moment(n), Kernel::Constant.moment(n));
            assert_eq!(Kernel::Exponential { p: 0.0 }.moment(n), Kernel::Constant.moment(n));
        }
    }
}
