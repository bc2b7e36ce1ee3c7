//! Starts and loads that jump, in a bar held at the left and without strain across the right end, with the exact answer.

use crate::dispersion::curve::reference_lattice;
use pd_verify::constraints::{Edge, Edges};
use pd_verify::forces::ForceField;
use pd_verify::lattice::Lattice;
use pd_verify::scene::{History, Initial, Scene, Shape};
use pd_verify_reference::lattice_modes::LatticeModes;
use std::f64::consts::PI;
use std::sync::Arc;

/// What jumps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Jump {
    /// A displacement of one height in the middle third, let go.
    SquareWave,
    /// Two such blocks whose halves meet.
    Pulses,
    /// A load on the last tenth, put on at once.
    StepLoad,
    /// The same load with another sign in every step.
    Alternating,
}

/// Largest displacement of a start, in spacings, and of E/Δx² a load.
const SMALL: f64 = 1e-6;

impl Jump {
    pub const ALL: [Self; 4] = [Self::SquareWave, Self::Pulses, Self::StepLoad, Self::Alternating];

    pub fn name(self) -> &'static str {
        match self {
            Self::SquareWave => "square wave",
            Self::Pulses => "colliding pulses",
            Self::StepLoad => "step load",
            Self::Alternating => "load of alternating sign",
        }
    }

    /// Jumps of its start; a load has none there.
    pub fn jumps(self) -> usize {
        match self {
            Self::SquareWave => 2,
            Self::Pulses => 4,
            Self::StepLoad | Self::Alternating => 0,
        }
    }

    /// How far, over the length, its fronts go before the first of them reaches an end.
    fn way(self) -> f64 {
        match self {
            Self::SquareWave => 1.0 / 3.0,
            Self::Pulses => 0.2,
            Self::StepLoad | Self::Alternating => 0.0,
        }
    }

    /// Height of the start in m; of the load in N/m³ over E/Δx² and m.
    pub fn height(self, scene: &Scene<1>) -> f64 {
        SMALL * scene.spacing
    }

    /// 1 where the start or the load is, 0 elsewhere, at node j of `nodes`.
    fn shape(self, j: usize, nodes: usize) -> f64 {
        let x = (j as f64 + 0.5) / nodes as f64;
        let within =
            |ranges: &[[f64; 2]]| f64::from(ranges.iter().any(|[from, to]| (*from..*to).contains(&x)));
        match self {
            Self::SquareWave => within(&[[1.0 / 3.0, 2.0 / 3.0]]),
            Self::Pulses => within(&[[0.2, 0.3], [0.7, 0.8]]),
            Self::StepLoad | Self::Alternating => within(&[[0.9, 1.0]]),
        }
    }

    /// The bar that starts so, or is loaded so for so many steps of `time_step`.
    pub fn on(self, bar: &Scene<1>, time_step: f64, steps: u64) -> Scene<1> {
        let fields = waves(bar, |j| self.height(bar) * self.shape(j, bar.nodes[0]));
        let edges = Edges([[Edge::MirrorOdd, Edge::MirrorEven]]);
        let plain = Scene { edges, displacement: Vec::new(), ..bar.clone() };
        let loaded = |history| {
            let unit = bar.material.youngs_modulus / (bar.spacing * bar.spacing);
            let fields =
                fields.iter().map(|field| Initial { amplitude: unit * field.amplitude, ..field.clone() });
            Scene {
                effects: vec![Arc::new(ForceField { fields: fields.collect(), history })],
                ..plain.clone()
            }
        };
        match self {
            Self::SquareWave | Self::Pulses => Scene { displacement: fields, ..plain },
            Self::StepLoad => loaded(History::Step { start: 0.0 }),
            Self::Alternating => {
                let at = |n: u64| (n as f64 * time_step, if n.is_multiple_of(2) { 1.0 } else { -1.0 });
                loaded(History::Table { points: (0..=steps).map(at).collect() })
            }
        }
    }

    /// The exact motion of leapfrog at vΔt/Δx = `courant`; `None` where it is unstable.
    pub fn exact(self, lattice: Lattice, nodes: usize, courant: f64) -> Option<Exact> {
        let (of, shape) = (reference_lattice(lattice), |j| self.shape(j, nodes));
        let modes = match self {
            Self::SquareWave | Self::Pulses => LatticeModes::of_displacement(of, nodes, Some(courant), shape),
            Self::StepLoad => LatticeModes::of_steady_load(of, nodes, Some(courant), shape),
            Self::Alternating => LatticeModes::of_alternating_load(of, nodes, courant, shape),
        }?;
        let per_step = courant * pd_verify_reference::lattice::bar_modulus(of).sqrt();
        let free = (self.way() * nodes as f64 / per_step) as u64;
        Some(Exact { jump: self, start: modes.displacements(0.0), modes, courant, free })
    }
}

/// An exact motion, over the height.
pub struct Exact {
    jump: Jump,
    start: Vec<f64>,
    modes: LatticeModes,
    courant: f64,
    /// Steps until the first front reaches an end.
    pub free: u64,
}

impl Exact {
    /// Displacements of all nodes at a step.
    pub fn at(&self, step: u64) -> Vec<f64> {
        let moved = self.modes.displacements(step as f64 * self.courant);
        let sign = if step.is_multiple_of(2) { 1.0 } else { -1.0 };
        let pairs = self.start.iter().zip(moved);
        match self.jump {
            Jump::SquareWave | Jump::Pulses => pairs.map(|(_, moved)| moved).collect(),
            Jump::StepLoad => pairs.map(|(start, moved)| start - moved).collect(),
            Jump::Alternating => pairs.map(|(start, moved)| sign * start - moved).collect(),
        }
    }

    /// What no norm exceeds: every mode goes as cos nθ.
    pub fn bound(&self) -> f64 {
        self.times() * self.start.iter().map(|u| u * u).sum::<f64>().sqrt()
    }

    /// What no displacement exceeds, for the same reason.
    pub fn most(&self) -> f64 {
        self.times() * self.modes.most()
    }

    /// Under a load a motion goes about where the load holds the bar.
    fn times(&self) -> f64 {
        if self.jump.jumps() > 0 { 1.0 } else { 2.0 }
    }
}

/// Values at the nodes as the sum of as many waves sin κ(j + ½), κ = (2n + 1)π/2N.
fn waves(bar: &Scene<1>, value: impl Fn(usize) -> f64) -> Vec<Initial<1>> {
    let nodes = bar.nodes[0];
    let angle = |n: usize| (2 * n + 1) as f64 * PI / (2 * nodes) as f64;
    let wave = |n: usize| {
        let sines = (0..nodes).map(|j| libm::sin(angle(n) * (j as f64 + 0.5)) * value(j));
        let shape = Shape::Wave { wavenumber: [angle(n) / bar.spacing], phase: -0.5 * PI };
        Initial { component: 0, amplitude: 2.0 / nodes as f64 * sines.sum::<f64>(), shape }
    };
    (0..nodes).map(wave).collect()
}
