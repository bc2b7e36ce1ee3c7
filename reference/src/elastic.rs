//! An isotropic elastic plane with a crack in it: moduli, wave speeds, the two modes.
//!
//! Plane strain with Poisson's ratio ν' and plane stress with ν are the same equations with the same µ when
//! κ = 3 − 4ν' = (3 − ν)/(1 + ν), that is ν' = ν/(1 + ν). All else follows from µ, ν' and ρ:
//! c_d² = µ(κ + 1)/(ρ(κ − 1)) = 2µ(1 − ν')/(ρ(1 − 2ν')), c_s² = µ/ρ, E' = 8µ/(κ + 1) = 2µ/(1 − ν')
//! (E/(1 − ν²) in plane strain, E in plane stress), G = (K_I² + K_II²)/E'.

/// How a crack is loaded: opened, or slid in its plane. The tip is at the origin, the crack along the negative x axis,
/// its upper face at y = 0+.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Opening: σ_yy = K_I/√(2πx) ahead of the tip.
    One,
    /// Sliding: σ_xy = K_II/√(2πx) ahead of the tip; K_II > 0 when the upper face slides to +x relative to the lower.
    Two,
}

/// An isotropic elastic plane. Moduli in Pa, density in kg/m³ (or any one system of units).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// µ.
    pub shear_modulus: f64,
    /// ν', of plane strain: a plane-stress body's ν/(1 + ν).
    pub poisson_ratio: f64,
    /// ρ.
    pub density: f64,
}

impl Plane {
    /// A body in plane strain, from Young's modulus E in Pa, Poisson's ratio −1 < ν < ½ and the density in kg/m³.
    pub fn plane_strain(young: f64, poisson_ratio: f64, density: f64) -> Self {
        Self { shear_modulus: young / (2.0 * (1.0 + poisson_ratio)), poisson_ratio, density }
    }

    /// A thin plate in plane stress, from the same three (−1 < ν ≤ ½).
    pub fn plane_stress(young: f64, poisson_ratio: f64, density: f64) -> Self {
        let equivalent = poisson_ratio / (1.0 + poisson_ratio);
        Self { shear_modulus: young / (2.0 * (1.0 + poisson_ratio)), poisson_ratio: equivalent, density }
    }

    /// κ = 3 − 4ν', Kolosov's constant.
    pub fn kolosov(&self) -> f64 {
        3.0 - 4.0 * self.poisson_ratio
    }

    /// E' = 2µ/(1 − ν') in Pa: what a crack's energy release rate divides K² by.
    pub fn effective_modulus(&self) -> f64 {
        2.0 * self.shear_modulus / (1.0 - self.poisson_ratio)
    }

    /// (c_s/c_d)² = (1 − 2ν')/(2(1 − ν')).
    pub fn speed_ratio_squared(&self) -> f64 {
        (1.0 - 2.0 * self.poisson_ratio) / (2.0 * (1.0 - self.poisson_ratio))
    }

    /// c_s in m/s.
    pub fn shear_speed(&self) -> f64 {
        (self.shear_modulus / self.density).sqrt()
    }

    /// c_d in m/s, NaN at ν' ≥ ½.
    pub fn dilatational_speed(&self) -> f64 {
        if self.poisson_ratio < 0.5 {
            self.shear_speed() / self.speed_ratio_squared().sqrt()
        } else {
            f64::NAN
        }
    }

    /// The speed of the plane wave that carries a mode's stress: c_d in mode I, c_s in mode II, m/s.
    pub fn wave_speed(&self, mode: Mode) -> f64 {
        match mode {
            Mode::One => self.dilatational_speed(),
            Mode::Two => self.shear_speed(),
        }
    }

    /// c_R in m/s: the zero of (2 − x)² − 4√(1 − x)√(1 − k²x), x = (c_R/c_s)², k = c_s/c_d, in 0 < x < 1. Squared and
    /// divided by x it is x³ − 8x² + (24 − 16k²)x − 16(1 − k²), −16(1 − k²) at 0 and 1 at 1, with one zero between
    /// (Achenbach, Wave Propagation in Elastic Solids (1973), 5.11). To rounding.
    pub fn rayleigh_speed(&self) -> f64 {
        let square = self.speed_ratio_squared();
        let below = |x: f64| ((x - 8.0) * x + 24.0 - 16.0 * square) * x < 16.0 * (1.0 - square);
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            (low, high) = if below(middle) { (middle, high) } else { (low, middle) };
        }
        self.shear_speed() * (0.5_f64 * (low + high)).sqrt()
    }
}
