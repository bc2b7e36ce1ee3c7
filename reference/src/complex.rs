//! Complex numbers, as far as potentials of plane elasticity and waves in a chain need them.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// re + i im.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Complex {
    pub re: f64,
    pub im: f64,
}

impl Complex {
    pub const I: Self = Self { re: 0.0, im: 1.0 };

    pub fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }

    pub fn conj(self) -> Self {
        Self { re: self.re, im: -self.im }
    }

    /// e^{i angle}.
    pub fn turned(angle: f64) -> Self {
        let (im, re) = libm::sincos(angle);
        Self { re, im }
    }

    /// |z|.
    pub fn size(self) -> f64 {
        libm::hypot(self.re, self.im)
    }

    /// z^{n/2}, cut along the negative real axis; the sign of a zero imaginary part says on which side of it z is.
    pub fn half_power(self, n: i32) -> Self {
        let (r, angle) = (self.size(), libm::atan2(self.im, self.re));
        let (sin, cos) = libm::sincos(0.5 * f64::from(n) * angle);
        let length = if n.rem_euclid(2) == 0 {
            libm::pow(r, f64::from(n / 2))
        } else {
            libm::pow(r, f64::from(n.div_euclid(2))) * r.sqrt()
        };
        Self { re: length * cos, im: length * sin }
    }
}

impl Add for Complex {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { re: self.re + other.re, im: self.im + other.im }
    }
}

impl Sub for Complex {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { re: self.re - other.re, im: self.im - other.im }
    }
}

impl Neg for Complex {
    type Output = Self;
    fn neg(self) -> Self {
        Self { re: -self.re, im: -self.im }
    }
}

impl Mul for Complex {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { re: self.re * other.re - self.im * other.im, im: self.re * other.im + self.im * other.re }
    }
}

impl Mul<f64> for Complex {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self { re: self.re * factor, im: self.im * factor }
    }
}

impl Div for Complex {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let (top, square) = (self * other.conj(), other.re * other.re + other.im * other.im);
        Self { re: top.re / square, im: top.im / square }
    }
}
