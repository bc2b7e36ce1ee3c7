//! What carries a wave: the stiffness that local elasticity, the nonlocal continuum or a lattice sets against it.
//!
//! A wave u = a cos(k·x) calls up the acceleration −c² M(k) u, c = √(C11/ρ) (in a bar √(E/ρ), M a number):
//! local elasticity with C12 = C66 = C11/3: M = (|k|² I + 2 k kᵀ)/3;
//! with other moduli of a square lattice: M_xx = C11 kx² + C66 ky², M_xy = (C12 + C66) kx ky over the intended C11;
//! nonlocal continuum: M = ω_P² k̂k̂ᵀ + ω_S² (I − k̂k̂ᵀ) over c², both from [`continuum::plane`];
//! lattice: M = Σ_r w_r n⊗n (1 − cos k·rΔx)/Δx², see [`lattice`]. Its eigenvalues are ω²/c². Summed in double-double.

use std::collections::BTreeMap;

use crate::bonds::Lattice;
use crate::continuum;
use crate::double_double::Dd;
use crate::kernel::Kernel;
use crate::lattice::{self, Moduli, Symmetric};

/// What carries a wave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Medium {
    /// Local elasticity with the intended moduli.
    Local,
    /// Local elasticity with the long-wave moduli of a lattice over the intended ones; a bar takes `c11` for E.
    Moduli(Moduli),
    /// The nonlocal continuum; the horizon in the length that waves are measured in.
    Nonlocal {
        /// Shape of the micromodulus.
        kernel: Kernel,
        /// δ.
        horizon: f64,
    },
    /// A square lattice (or bar).
    Lattice {
        /// The family and its weights.
        lattice: Lattice,
        /// Δx.
        spacing: f64,
    },
}

/// ω/c, c = √(C11/ρ), and the unit displacement of a plane wave.
pub type PlaneWave = (f64, [f64; 2]);

impl Medium {
    /// ω²/c² of the bar wave `k`, in 1/length². None beyond the continuum's range ([`continuum::BAR_LIMIT`]) and
    /// where the lattice cannot be calibrated.
    pub fn bar_square(&self, k: f64) -> Option<f64> {
        self.bar_squares(&[k])?.pop()
    }

    /// [`Self::bar_square`] of many waves, the family found once; None where one of them is.
    pub fn bar_squares(&self, waves: &[f64]) -> Option<Vec<f64>> {
        let bonds = match self {
            Self::Lattice { lattice, .. } => lattice::bar_bonds(lattice),
            _ => Vec::new(),
        };
        let square = |k: f64| match self {
            Self::Local => Some(k * k),
            Self::Moduli(moduli) => Some(moduli.c11 * k * k),
            Self::Nonlocal { .. } if k == 0.0 => Some(0.0),
            Self::Nonlocal { kernel, horizon } => {
                Some((continuum::bar(*kernel, k.abs() * horizon)?.omega / horizon).powi(2))
            }
            Self::Lattice { spacing, .. } => {
                let half = Dd::from(k) * *spacing * 0.5;
                let sum: Dd = bonds.iter().map(|b| b.weight * (half * b.offset).sin().squared() * 4.0).sum();
                Some((sum / Dd::from(*spacing).squared()).to_f64())
            }
        };
        waves.iter().map(|&k| square(k).filter(|square| square.is_finite())).collect()
    }

    /// M(k): (xx, xy, yy) in 1/length². None beyond the continuum's range ([`continuum::PLANE_LIMIT`]) and where
    /// the lattice cannot be calibrated.
    pub fn plane_matrix(&self, k: [f64; 2]) -> Option<[f64; 3]> {
        self.plane_matrices(&[k])?.pop()
    }

    /// [`Self::plane_matrix`] of many waves, the family found once and each length of wave asked of the nonlocal
    /// continuum once (about a millisecond each); None where one of them is.
    pub fn plane_matrices(&self, waves: &[[f64; 2]]) -> Option<Vec<[f64; 3]>> {
        let rounded = |m: Symmetric| [m.xx, m.xy, m.yy].map(Dd::to_f64);
        Some(self.symmetric(waves)?.into_iter().map(rounded).collect())
    }

    /// The two waves along `k`, each ω/c and its unit displacement, c = √(C11/ρ) for both: first P, the one whose
    /// displacement is nearer to k (at a tie the faster), then S. At k = 0 the axes. None as in
    /// [`Self::plane_matrix`] and where a calibrated lattice is unstable (ω² < 0).
    pub fn plane_waves(&self, k: [f64; 2]) -> Option<[PlaneWave; 2]> {
        self.many_plane_waves(&[k])?.pop()
    }

    /// [`Self::plane_waves`] of many waves; None where one of them is.
    pub fn many_plane_waves(&self, waves: &[[f64; 2]]) -> Option<Vec<[PlaneWave; 2]>> {
        let pairs = self.symmetric(waves)?.into_iter().zip(waves).map(|(matrix, &k)| eigen(&matrix, k));
        pairs.map(|pair| pair.iter().all(|(omega, _)| omega.is_finite()).then_some(pair)).collect()
    }

    fn symmetric(&self, waves: &[[f64; 2]]) -> Option<Vec<Symmetric>> {
        let matrices: Vec<Symmetric> = match self {
            Self::Local => waves.iter().map(|&k| moduli(k, Dd::ONE, Dd::ONE, Dd::ONE)).collect(),
            Self::Moduli(m) => {
                let of = |&k| moduli(k, Dd::from(m.c11), Dd::from(m.c12), Dd::from(m.c66));
                waves.iter().map(of).collect()
            }
            Self::Nonlocal { kernel, horizon } => nonlocal(*kernel, *horizon, waves)?,
            Self::Lattice { lattice, spacing } => {
                let bonds = half_family(lattice);
                waves.iter().map(|&k| sum_over(&bonds, *spacing, k)).collect()
            }
        };
        matrices.iter().all(|m| (m.xx + m.yy + m.xy).to_f64().is_finite()).then_some(matrices)
    }
}

/// The waves of a matrix, P first.
fn eigen(matrix: &Symmetric, k: [f64; 2]) -> [PlaneWave; 2] {
    let length = (Dd::from(k[0]).squared() + Dd::from(k[1]).squared()).sqrt();
    let towards = if length == Dd::ZERO { [Dd::ONE, Dd::ZERO] } else { k.map(|k| Dd::from(k) / length) };
    let rounded =
        |(square, displacement, _): (Dd, [Dd; 2], Dd)| (square.sqrt().to_f64(), displacement.map(Dd::to_f64));
    matrix.branches(towards).map(rounded)
}

/// The angle that a wave turns in one step of central differences, 2 asin(ωΔt/2), from ω/c and cΔt. None above the
/// limit ωΔt = 2.
pub fn leapfrog_turn(omega_over_c: f64, c_dt: f64) -> Option<f64> {
    let half = Dd::from(omega_over_c) * c_dt * 0.5;
    (half.abs() <= Dd::ONE).then(|| (half.asin() * 2.0).to_f64())
}

/// The matrix of local elasticity, each modulus over its intended value.
fn moduli(k: [f64; 2], c11: Dd, c12: Dd, c66: Dd) -> Symmetric {
    let [x, y] = k.map(Dd::from);
    let third = Dd::ONE / Dd::from(3.0);
    Symmetric {
        xx: c11 * x.squared() + c66 * third * y.squared(),
        xy: (c12 + c66) * third * x * y,
        yy: c66 * third * x.squared() + c11 * y.squared(),
    }
}

fn nonlocal(kernel: Kernel, horizon: f64, waves: &[[f64; 2]]) -> Option<Vec<Symmetric>> {
    let mut known: BTreeMap<u64, [Dd; 2]> = BTreeMap::new();
    waves
        .iter()
        .map(|&[x, y]| {
            let square = x * x + y * y;
            if square == 0.0 {
                return Some(Symmetric::default());
            }
            let speeds =
                known.get(&square.to_bits()).copied().or_else(|| speeds_squared(kernel, horizon, square));
            let [p, s] = *known.entry(square.to_bits()).or_insert(speeds?);
            let [x, y] = [x, y].map(Dd::from);
            Some(Symmetric {
                xx: p * x.squared() + s * y.squared(),
                xy: (p - s) * x * y,
                yy: s * x.squared() + p * y.squared(),
            })
        })
        .collect()
}

/// (ω/ck)² of P and S, c = √(C11/ρ) for both, at |k|² = `square`.
fn speeds_squared(kernel: Kernel, horizon: f64, square: f64) -> Option<[Dd; 2]> {
    let z = square.sqrt() * horizon;
    let [p, s] = continuum::plane_pair(kernel, z)?;
    let speed = |omega: f64| (Dd::from(omega) / Dd::from(z)).squared();
    Some([speed(p.omega), speed(s.omega) / Dd::from(3.0)])
}

/// Two bonds ±r: the place, and 4 w n⊗n.
struct Pair {
    x: f64,
    y: f64,
    weight: Symmetric,
}

fn half_family(lattice: &Lattice) -> Vec<Pair> {
    let bonds = lattice::plane_bonds(lattice);
    let half = bonds.into_iter().filter(|(bond, _)| bond.y > 0.0 || (bond.y == 0.0 && bond.x > 0.0));
    half.map(|(bond, weight)| {
        let share = weight * 4.0 / Dd::from(bond.x * bond.x + bond.y * bond.y);
        let weight = Symmetric {
            xx: share * (bond.x * bond.x),
            xy: share * (bond.x * bond.y),
            yy: share * (bond.y * bond.y),
        };
        Pair { x: bond.x, y: bond.y, weight }
    })
    .collect()
}

/// Σ 4 w n⊗n sin²(k·rΔx/2)/Δx² over the pairs.
fn sum_over(pairs: &[Pair], spacing: f64, k: [f64; 2]) -> Symmetric {
    let [x, y] = k.map(|k| Dd::from(k) * spacing * 0.5);
    let over = Dd::ONE / Dd::from(spacing).squared();
    pairs.iter().fold(Symmetric::default(), |sum, pair| {
        let square = (x * pair.x + y * pair.y).sin().squared() * over;
        Symmetric {
            xx: sum.xx + pair.weight.xx * square,
            xy: sum.xy + pair.weight.xy * square,
            yy: sum.yy + pair.weight.yy * square,
        }
    })
}
