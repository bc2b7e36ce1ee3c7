//! Numbers with about 31 digits: an unevaluated sum of two doubles, and the functions the answers need.
//!
//! A [`Dd`] is hi + lo with |lo| ≤ ulp(hi)/2. Sums follow Knuth, products Dekker and Veltkamp (1971), the
//! error bounds Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic building blocks of
//! double-word arithmetic", ACM TOMS 44 (2017): a few times 2⁻¹⁰⁶ ≈ 1e-32 per operation. Sine, cosine and
//! exponential are Taylor series after reduction to |x| ≤ π/4 and |x| ≤ ln 2 / 2.

use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::LazyLock;

/// The sum hi + lo of two doubles that do not overlap.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Dd {
    /// The value rounded to a double.
    pub hi: f64,
    /// What rounding left over.
    pub lo: f64,
}

/// π.
pub const PI: Dd = Dd { hi: std::f64::consts::PI, lo: 1.2246467991473532e-16 };
/// Euler's constant γ.
pub const EULER: Dd = Dd { hi: 0.5772156649015329, lo: -4.942915152430645e-18 };
const LN_2: Dd = Dd { hi: std::f64::consts::LN_2, lo: 2.3190468138462996e-17 };
/// π/2 in four doubles, 212 bits: what is left of x − nπ/2 stays exact to 1e-32 for |x| up to 1e5 and beyond.
const HALF_PI: [f64; 4] =
    [std::f64::consts::FRAC_PI_2, 6.123233995736766e-17, -1.4973849048591698e-33, 5.562271104316826e-50];

/// 1/n! for n = 0 … 31.
static INVERSE_FACTORIALS: LazyLock<[Dd; 32]> = LazyLock::new(|| {
    let mut table = [Dd::ONE; 32];
    for n in 1..32 {
        table[n] = table[n - 1] / Dd::from(n as f64);
    }
    table
});

/// a + b and its rounding error, exactly.
#[inline]
fn two_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    let part = hi - a;
    Dd { hi, lo: (a - (hi - part)) + (b - part) }
}

/// The same where |a| ≥ |b|.
#[inline]
fn quick_two_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    Dd { hi, lo: b - (hi - a) }
}

/// The upper 26 bits of a double and the rest.
#[inline]
fn split(a: f64) -> (f64, f64) {
    let scaled = 134_217_729.0 * a;
    let upper = scaled - (scaled - a);
    (upper, a - upper)
}

/// a·b and its rounding error, exactly.
#[inline]
fn two_prod(a: f64, b: f64) -> Dd {
    let hi = a * b;
    let ((a_upper, a_lower), (b_upper, b_lower)) = (split(a), split(b));
    let lo = ((a_upper * b_upper - hi) + a_upper * b_lower + a_lower * b_upper) + a_lower * b_lower;
    Dd { hi, lo }
}

impl From<f64> for Dd {
    #[inline]
    fn from(value: f64) -> Self {
        Self { hi: value, lo: 0.0 }
    }
}

impl Add for Dd {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let upper = two_sum(self.hi, other.hi);
        let lower = two_sum(self.lo, other.lo);
        let sum = quick_two_sum(upper.hi, upper.lo + lower.hi);
        quick_two_sum(sum.hi, sum.lo + lower.lo)
    }
}

impl Neg for Dd {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for Dd {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Dd {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let product = two_prod(self.hi, other.hi);
        quick_two_sum(product.hi, product.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Mul<f64> for Dd {
    type Output = Self;
    #[inline]
    fn mul(self, other: f64) -> Self {
        self * Self::from(other)
    }
}

impl Div for Dd {
    type Output = Self;
    /// Long division in three steps.
    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        let rest = self - other * first;
        let second = rest.hi / other.hi;
        let rest = rest - other * second;
        let third = rest.hi / other.hi;
        let sum = quick_two_sum(first, second);
        sum + Self::from(third)
    }
}

impl std::iter::Sum for Dd {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::ZERO, |total, term| total + term)
    }
}

impl Dd {
    /// 0.
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };
    /// 1.
    pub const ONE: Self = Self { hi: 1.0, lo: 0.0 };

    /// The value rounded to a double.
    #[inline]
    pub fn to_f64(self) -> f64 {
        self.hi + self.lo
    }

    /// |x|.
    #[inline]
    pub fn abs(self) -> Self {
        if self.hi < 0.0 { -self } else { self }
    }

    /// x².
    #[inline]
    pub fn squared(self) -> Self {
        self * self
    }

    /// √x by one Newton step on the double's root; not a number below 0.
    pub fn sqrt(self) -> Self {
        if self.hi == 0.0 {
            return Self::ZERO;
        }
        let root = Self::from(self.hi.sqrt());
        let better = root + (self - root.squared()) / (root * 2.0);
        better + (self - better.squared()) / (better * 2.0)
    }

    /// eˣ; 0 where it would be below 1e-300.
    pub fn exp(self) -> Self {
        if self.hi < -690.0 {
            return Self::ZERO;
        }
        let turns = (self.hi / LN_2.hi).round();
        let rest = self - LN_2 * turns;
        let series = (0..28).rev().fold(Self::ZERO, |sum, n| sum * rest + INVERSE_FACTORIALS[n]);
        series * 2.0_f64.powi(turns as i32)
    }

    /// (sin x, cos x).
    pub fn sin_cos(self) -> (Self, Self) {
        let quarters = (self.hi / HALF_PI[0]).round();
        let rest = HALF_PI.iter().fold(self, |rest, part| rest - two_prod(quarters, *part));
        let square = -rest.squared();
        let sine =
            (0..15).rev().fold(Self::ZERO, |sum, n| sum * square + INVERSE_FACTORIALS[2 * n + 1]) * rest;
        let cosine = (0..15).rev().fold(Self::ZERO, |sum, n| sum * square + INVERSE_FACTORIALS[2 * n]);
        match (quarters as i64).rem_euclid(4) {
            0 => (sine, cosine),
            1 => (cosine, -sine),
            2 => (-sine, -cosine),
            _ => (-cosine, sine),
        }
    }

    /// sin x.
    pub fn sin(self) -> Self {
        self.sin_cos().0
    }

    /// cos x.
    pub fn cos(self) -> Self {
        self.sin_cos().1
    }

    /// The angle of the vector (x, self) against the x axis: two Newton steps on the double's answer.
    pub fn atan2(self, x: Self) -> Self {
        let length = (self.squared() + x.squared()).sqrt();
        (0..2).fold(Self::from(libm::atan2(self.hi, x.hi)), |angle, _| {
            let (sine, cosine) = angle.sin_cos();
            angle + (self * cosine - x * sine) / length
        })
    }

    /// asin x; not a number beyond ±1.
    pub fn asin(self) -> Self {
        self.atan2(((Self::ONE - self) * (Self::ONE + self)).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The digits of a decimal, read without rounding to a double first.
    fn decimal(text: &str) -> Dd {
        let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits = format!("{}{fraction}", whole.trim_start_matches('-'));
        let value =
            digits.bytes().fold(Dd::ZERO, |sum, digit| sum * 10.0 + Dd::from(f64::from(digit - b'0')));
        let places = exponent.parse::<i32>().unwrap() - fraction.len() as i32;
        let scale = (0..places.abs()).fold(Dd::ONE, |scale, _| scale * 10.0);
        let value = if places < 0 { value / scale } else { value * scale };
        if text.starts_with('-') { -value } else { value }
    }

    fn assert_digits(name: &str, found: Dd, digits: &str, tolerance: f64) {
        let error = ((found - decimal(digits)) / decimal(digits)).to_f64().abs();
        assert!(error < tolerance, "{name}: relative error {error:e}, expected {digits}, found {found:?}");
    }

    // Digits from mpmath 1.3 at 60 digits, 36 printed; the arguments are the exact doubles written here.
    #[test]
    fn sine_and_cosine_have_thirty_digits() {
        for (x, sine, cosine) in SINES {
            assert_digits(&format!("sin {x}"), Dd::from(x).sin(), sine, 2e-30);
            assert_digits(&format!("cos {x}"), Dd::from(x).cos(), cosine, 2e-30);
        }
    }

    #[test]
    fn exponential_has_thirty_digits() {
        for (x, digits) in EXPONENTIALS {
            assert_digits(&format!("exp {x}"), Dd::from(x).exp(), digits, 4e-30);
        }
    }

    #[test]
    fn root_quotient_and_angle_have_thirty_digits() {
        assert_digits("sqrt 2", Dd::from(2.0).sqrt(), ROOT_2, 1e-31);
        assert_digits("1/7", Dd::ONE / Dd::from(7.0), SEVENTH, 1e-31);
        assert_digits("asin 0.3", Dd::from(0.3).asin(), ASIN_03, 1e-30);
        assert_digits("atan2(0.7, -1.9)", Dd::from(0.7).atan2(Dd::from(-1.9)), ATAN_07_19, 1e-30);
        assert!(Dd::from(1.5).asin().to_f64().is_nan());
    }

    #[test]
    fn constants_have_thirty_digits() {
        assert_digits("pi", PI, PI_DIGITS, 1e-32);
        assert_digits("gamma", EULER, EULER_DIGITS, 1e-31);
        assert_digits("ln 2", LN_2, LN_2_DIGITS, 1e-31);
    }

    const SINES: [(f64, &str, &str); 10] = [
        (1e-09, "1.00000000000000006211492479111318972e-9", "0.999999999999999999499999999999999938"),
        (0.3, "0.295520206661339564498955080766944501", "0.955336489125606022923243604342087409"),
        (0.785, "0.706825181105365945736183798821291118", "0.707388269167199740930757278651983030"),
        (1.0, "0.841470984807896506652502321630299000", "0.540302305868139717400936607442976604"),
        (2.5, "0.598472144103956494051854702186162272", "-0.801143615546933714833502790467351664"),
        (-4.0, "0.756802495307928251372639094511829094", "-0.653643620863611914639168183097750381"),
        (22.0, "-0.00885130929040387592169025681577233246", "-0.999960826394637126454174739212693774"),
        (355.0, "-3.01443533594884492143302800086500996e-5", "-0.999999999545658980165935841692754081"),
        (1234.5, "0.145395650522936420825828273417164577", "-0.989373592132422007317793981784418613"),
        (99999.25, "0.707360059149844665738633837131031314", "-0.706853412469323978846303538678218987"),
    ];
    const EXPONENTIALS: [(f64, &str); 7] = [
        (-60.0, "8.75651076269652033848873280073916604e-27"),
        (-9.7, "6.12834950532221390577831634952269934e-5"),
        (-0.34, "0.711770322762609697695029898086561727"),
        (1e-12, "1.00000000000100000000000049997988665"),
        (0.1, "1.10517091807564763094663882345877966"),
        (1.0, "2.71828182845904523536028747135266250"),
        (20.3, "6.54904512153238504578139714824548051e+8"),
    ];
    const ROOT_2: &str = "1.41421356237309504880168872420969808";
    const SEVENTH: &str = "0.142857142857142857142857142857142857";
    const ASIN_03: &str = "0.304692654015397496333703340286564195";
    const ATAN_07_19: &str = "2.78860226576288277422324909537057788";
    const PI_DIGITS: &str = "3.14159265358979323846264338327950288";
    const EULER_DIGITS: &str = "0.577215664901532860606512090082402431";
    const LN_2_DIGITS: &str = "0.693147180559945309417232121458176568";
}
