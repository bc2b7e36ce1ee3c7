//! A pulse sent along a chain towards a joint, and what comes back.
//!
//! ü = L u in units Δx = v = 1, marched by leapfrog u(t + Δt) = 2u(t) − u(t − Δt) + C² L u(t), C = vΔt/Δx, from the
//! right-going pulse u(x, t) = exp(−a(x − x₀ − t)²) sampled at t = 0 and t = −Δt. The echo is the difference from
//! the same march with no joint, so neither the pulse's own dispersion nor its start is mistaken for it. In doubles.

/// Neighbour distance and weight of each pair.
type Stencil = [(usize, f64)];

/// Displacements now and one step before.
struct March {
    before: Vec<f64>,
    now: Vec<f64>,
}

/// Peak of the echo over the peak sent; `sharpness` is aΔx². See [`crate::scattering::pulse_reflection`].
/// The chain reaches four distances to either side of the joint, so nothing returns from its ends.
pub(crate) fn reflection(left: &Stencil, right: &Stencil, sharpness: f64, courant: f64) -> f64 {
    let distance = (9.0 / sharpness.sqrt()).ceil();
    let joint = 4 * distance as usize;
    let near = joint - distance as usize / 2;
    let centre = joint as f64 - distance;
    let mut joined = March::start(2 * joint, centre, sharpness, courant);
    let mut plain = March::start(2 * joint, centre, sharpness, courant);
    let sent = joined.now.iter().fold(0.0_f64, |peak, u| peak.max(u.abs()));
    let mut echo = 0.0_f64;
    for _ in 0..(2.25 * distance / courant).round() as usize {
        joined.step(courant, |i| if i < joint { left } else { right });
        plain.step(courant, |_| left);
        let difference = joined.now.iter().zip(&plain.now).take(near).map(|(one, other)| (one - other).abs());
        echo = difference.fold(echo, f64::max);
    }
    echo / sent
}

impl March {
    fn start(count: usize, centre: f64, sharpness: f64, courant: f64) -> Self {
        let pulse =
            |t: f64| (0..count).map(|i| libm::exp(-sharpness * (i as f64 - centre - t).powi(2))).collect();
        Self { before: pulse(-courant), now: pulse(0.0) }
    }

    fn step<'a>(&mut self, courant: f64, stencil: impl Fn(usize) -> &'a Stencil) {
        let pulls = (0..self.now.len()).map(|i| courant * courant * pull(&self.now, i, stencil(i)));
        let next = pulls.enumerate().map(|(i, pull)| 2.0 * self.now[i] - self.before[i] + pull).collect();
        self.before = std::mem::replace(&mut self.now, next);
    }
}

/// Σ w(u_{i+r} − 2u_i + u_{i−r}), 0 beyond the ends.
fn pull(u: &[f64], i: usize, stencil: &Stencil) -> f64 {
    let value = |j: Option<usize>| j.and_then(|j| u.get(j)).copied().unwrap_or(0.0);
    stencil
        .iter()
        .map(|(r, weight)| weight * (value(Some(i + r)) + value(i.checked_sub(*r)) - 2.0 * u[i]))
        .sum()
}
