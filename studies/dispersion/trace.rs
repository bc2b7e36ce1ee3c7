//! Along one curve: the waves of the code under judgement, and how far they are from the reference's.

use super::curve::{Curve, Medium, Prepared};
use crate::subject::Subject;
use pd_verify::dispersion::plane::speed_ratio_squared;
use pd_verify::dispersion::{Branch, Wave};
use pd_verify::material::Body;
use pd_verify_reference::continuum::{BAR_LIMIT, PLANE_LIMIT};

/// What was found along one curve.
pub struct Traced {
    /// k in 1/m, and ω/c in 1/m with the group velocity over c; `None` where the scheme is unstable.
    pub points: Vec<(f64, Option<Wave>)>,
    /// Scaled errors of ω, and absolute ones of dω/dk over c, where the reference was asked.
    pub omega_errors: Vec<f64>,
    pub group_errors: Vec<f64>,
    /// First k whose phase error passes 1 % and 5 %, and how far the reference is from the threshold there.
    pub first: [Option<f64>; 2],
    pub first_errors: Vec<f64>,
    pub left_out: LeftOut,
}

/// Wavenumbers that were not judged, and why.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct LeftOut {
    pub beyond_reference: usize,
    /// Leapfrog so near its limit that rounding of C alone moves ω by more than the bound.
    pub at_limit: usize,
    /// P and S so near each other that rounding decides which is which.
    pub at_crossing: usize,
    pub unstable: usize,
}

impl std::ops::AddAssign for LeftOut {
    fn add_assign(&mut self, other: Self) {
        self.beyond_reference += other.beyond_reference;
        self.at_limit += other.at_limit;
        self.at_crossing += other.at_crossing;
        self.unstable += other.unstable;
    }
}

impl std::fmt::Display for LeftOut {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let reasons = [
            (self.beyond_reference, "beyond the reference's reach"),
            (self.at_limit, "at leapfrog's limit, where ω is ill-conditioned"),
            (self.at_crossing, "where P and S cross"),
            (self.unstable, "unstable: the time step is above the limit 2/ω"),
        ];
        for (count, reason) in reasons.iter().filter(|(count, _)| *count > 0) {
            write!(f, "; {count} left out {reason}")?;
        }
        Ok(())
    }
}

/// Wavenumbers at which the reference is asked, spread over each curve.
pub const JUDGED: usize = 16;
/// Phase errors whose first wavenumber is reported.
const THRESHOLDS: [f64; 2] = [0.01, 0.05];

/// Follows the curve over these wavenumbers.
pub fn trace(curve: &Curve, wavenumbers: Vec<f64>, subject: &dyn Subject) -> Option<Traced> {
    let prepared = curve.prepare(subject).ok()?;
    let points: Vec<_> = wavenumbers.into_iter().map(|k| (k, prepared.wave(k))).collect();
    let mut traced = Traced {
        omega_errors: Vec::new(),
        group_errors: Vec::new(),
        first: THRESHOLDS.map(|threshold| first_beyond(&prepared, curve, threshold)),
        first_errors: Vec::new(),
        left_out: LeftOut::default(),
        points: Vec::new(),
    };
    let stride = points.len().div_ceil(JUDGED).max(1);
    let last = points.len().saturating_sub(1);
    for (index, &(k, wave)) in points.iter().enumerate() {
        if k > 0.0 && (index % stride == stride - 1 || index == last) {
            traced.judge(curve, k, wave);
        }
    }
    for (first, threshold) in traced.first.into_iter().zip(THRESHOLDS) {
        let error = first.map_or_else(|| judge_none(curve, threshold), |k| judge_first(curve, k, threshold));
        traced.first_errors.extend(error);
    }
    traced.points = points;
    Some(traced)
}

impl Traced {
    fn judge(&mut self, curve: &Curve, k: f64, wave: Option<Wave>) {
        let Some(exact) = curve.reference(k) else {
            match wave {
                Some(_) if reaches(curve, k) => self.omega_errors.push(f64::INFINITY),
                Some(_) => self.left_out.beyond_reference += 1,
                None => self.left_out.unstable += 1,
            }
            return;
        };
        if rest(curve, exact) < AT_LIMIT {
            self.left_out.at_limit += 1;
            return;
        }
        let Some(wave) = wave else {
            self.omega_errors.push(f64::INFINITY);
            return;
        };
        self.omega_errors.push(scaled_error(curve, k, wave, exact));
        if crosses(curve, k) {
            self.left_out.at_crossing += 1;
        } else {
            self.group_errors.push((wave.group - exact.group).abs());
        }
    }
}

/// |Δω|/|ω| in the continuum, |Δω|/(|ω| + |k ∂ω/∂k|) on a grid.
fn scaled_error(curve: &Curve, k: f64, wave: Wave, exact: Wave) -> f64 {
    let grid = !matches!(curve.medium, Medium::Continuum { .. });
    let rounding_of_k = if grid { (k * exact.group).abs() } else { 0.0 };
    (wave.omega - exact.omega).abs() / (exact.omega.abs() + rounding_of_k)
}

/// Whether the reference answers here unless the scheme is unstable.
fn reaches(curve: &Curve, k: f64) -> bool {
    match (curve.medium, curve.body) {
        (Medium::Continuum { .. }, Body::Bar) => k * curve.unit() <= BAR_LIMIT,
        (Medium::Continuum { .. }, _) => k * curve.unit() <= PLANE_LIMIT,
        _ => true,
    }
}

/// 1 − (ΩΔt/2)² below which leapfrog's ω is not judged: ω moves by C ∂ω/∂C ~ ω/√rest times the rounding of C.
const AT_LIMIT: f64 = 1e-4;

/// cos²(ωΔt/2) = 1 − (ΩΔt/2)² of a wave of leapfrog; 1 in exact time, and where C = 1 is no special case.
fn rest(curve: &Curve, exact: Wave) -> f64 {
    match (curve.own_courant(), curve.medium, curve.body) {
        (None, _, _) | (_, Medium::FiniteDifferences { .. }, Body::Bar) => 1.0,
        (Some(courant), _, _) => libm::cos(0.5 * courant * exact.omega * curve.unit()).powi(2),
    }
}

/// Relative distance of the squares of P and S below which rounding mixes their polarisations.
const CROSSING: f64 = 1e-4;

fn crosses(curve: &Curve, k: f64) -> bool {
    if curve.body == Body::Bar || matches!(curve.medium, Medium::Continuum { .. }) {
        return false;
    }
    let square = |branch| {
        let wave = Curve { branch, courant: None, ..*curve }.reference(k)?;
        Some(wave.omega * wave.omega / speed_ratio_squared(branch))
    };
    match (square(Branch::P), square(Branch::S)) {
        (Some(p), Some(s)) => (p - s).abs() < CROSSING * p.max(s),
        _ => false,
    }
}

/// Steps of the search for the first crossing of a threshold.
pub const SEARCH: u32 = 512;

/// First k at which |phase error| passes the threshold; 0 where long waves are beyond it already.
fn first_beyond(prepared: &Prepared<'_>, curve: &Curve, threshold: f64) -> Option<f64> {
    let end = search_end(curve);
    let beyond = |k: f64| prepared.wave(k).is_some_and(|wave| (wave.phase(k) - 1.0).abs() > threshold);
    if beyond(1e-6 * end) {
        return Some(0.0);
    }
    let step = end / f64::from(SEARCH);
    let found = (1..=SEARCH).find(|&n| beyond(f64::from(n) * step))?;
    let (mut within, mut outside) = (f64::from(found - 1) * step, f64::from(found) * step);
    loop {
        let middle = 0.5 * (within + outside);
        if middle <= within || middle >= outside {
            return Some(outside);
        }
        if beyond(middle) { outside = middle } else { within = middle }
    }
}

/// The zone's edge of a grid; in the continuum far beyond any threshold.
fn search_end(curve: &Curve) -> f64 {
    let narrowness = curve.kernel().and_then(|kernel| kernel.p()).unwrap_or(1.0).max(1.0);
    curve.zone_edge().unwrap_or(10.0 * narrowness / curve.unit())
}

fn phase_error(curve: &Curve, k: f64) -> Option<f64> {
    curve.reference(k).map(|wave| (wave.phase(k) - 1.0).abs())
}

/// How far the reference is from the threshold at k; infinite where a smaller k passes it already.
fn judge_first(curve: &Curve, k: f64, threshold: f64) -> Option<f64> {
    if k == 0.0 {
        let long_wave = phase_error(curve, 1e-6 * search_end(curve))?;
        return Some(if long_wave > threshold { 0.0 } else { f64::INFINITY });
    }
    let mut before = (1..=8).map(|n| k * f64::from(n) / 8.2);
    let within = before.all(|k| phase_error(curve, k).is_none_or(|error| error <= threshold));
    if within { Some((phase_error(curve, k)? - threshold).abs()) } else { Some(f64::INFINITY) }
}

/// No crossing was found: 0 if the reference has none either at the wavenumbers asked.
fn judge_none(curve: &Curve, threshold: f64) -> Option<f64> {
    let end = search_end(curve);
    let errors = (1..=16).filter_map(|n| phase_error(curve, end * f64::from(n) / 16.0));
    let worst = errors.reduce(f64::max)?;
    Some((worst - threshold).max(0.0))
}
