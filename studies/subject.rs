//! The code under judgement: this library, or in sabotage tests the library with one ingredient made wrong.
//!
//! Studies ask a [`Subject`] for every number they judge, so that a wrong ingredient can be put in its place and
//! the verdict watched. Each default is the library's own function and nothing else.

use nalgebra::Complex;
use pd_verify::breaking::Broken;
use pd_verify::dispersion::bar::BarDispersion;
use pd_verify::dispersion::joint::{self, Chain};
use pd_verify::dispersion::plane::PlaneDispersion;
use pd_verify::dispersion::timestep::{self, TimeStep};
use pd_verify::dispersion::{Branch, Wave, continuum, finite_differences, leapfrog};
use pd_verify::fastest::{Fastest, fastest};
use pd_verify::field::Window;
use pd_verify::forces::{Class, Now};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Lattice, Stencil, Unusable};
use pd_verify::material::Body;
use pd_verify::micromodulus;
use pd_verify::model::Model;
use pd_verify::plan::time::Costs;
use pd_verify::record::{self, Failure, Record};
use pd_verify::scene::Scene;
use pd_verify::statics;
use pd_verify::stress_intensity::running::Running;
use pd_verify::stress_intensity::{Elastic, Faces, Reading, Tip, Unreadable};
use pd_verify_reference::released_bar::ReleasedBar;

/// What studies ask of a peridynamics code.
pub trait Subject: Sync {
    /// c₀ in N/m⁶.
    fn micromodulus(
        &self,
        body: Body,
        kernel: Kernel,
        youngs_modulus: f64,
        section: f64,
        horizon: f64,
    ) -> f64 {
        micromodulus::constant(body, kernel, youngs_modulus, section, horizon)
    }

    /// A wave of the continuous bar at kδ.
    fn continuum_bar(&self, kernel: Kernel, k_horizon: f64) -> Wave {
        continuum::bar(kernel, k_horizon).0
    }

    /// A wave of the continuous plate at kδ.
    fn continuum_plane(&self, kernel: Kernel, branch: Branch, k_horizon: f64) -> Wave {
        continuum::plane(kernel, branch, k_horizon).0
    }

    /// The weights of a bar's lattice.
    fn bar_stencil(&self, lattice: Lattice) -> Result<Stencil<1>, Unusable> {
        Stencil::new(lattice)
    }

    /// The weights of a plate's lattice.
    fn plane_stencil(&self, lattice: Lattice) -> Result<Stencil<2>, Unusable> {
        Stencil::new(lattice)
    }

    /// A wave on a bar's lattice at kΔx.
    fn bar_wave(&self, relation: &BarDispersion, k_dx: f64) -> Wave {
        relation.wave(k_dx)
    }

    /// A wave on a plate's lattice at |k|Δx.
    fn plane_wave(&self, relation: &PlaneDispersion, k_dx: f64, degrees: f64, branch: Branch) -> Wave {
        relation.wave(k_dx, degrees, branch)
    }

    /// (ωΔx/v)² of a bar's lattice at kΔx.
    fn bar_square(&self, relation: &BarDispersion, k_dx: f64) -> f64 {
        relation.square(k_dx)
    }

    /// The larger and the smaller (ωΔx/c_d)² of a plate's lattice at the vector kΔx.
    fn plane_squares(&self, relation: &PlaneDispersion, k_dx: [f64; 2]) -> [f64; 2] {
        relation.matrix(k_dx).eigen().0
    }

    /// A wave of the bar by finite differences, with exact time or leapfrog.
    fn finite_differences_bar(&self, k_dx: f64, courant: Option<f64>) -> Option<Wave> {
        match courant {
            Some(courant) => leapfrog::finite_differences_bar(k_dx, courant),
            None => Some(finite_differences::bar(k_dx)),
        }
    }

    /// A wave of the plate by finite differences, in exact time; `mixed` is the factor of the mixed derivative.
    fn finite_differences_plane(&self, k_dx: f64, degrees: f64, branch: Branch, mixed: f64) -> Wave {
        finite_differences::plane(k_dx, degrees, branch, mixed)
    }

    /// What leapfrog makes of a wave at cΔt/Δx.
    fn leapfrog(&self, wave: Wave, courant: f64) -> Option<Wave> {
        leapfrog::wave(wave, courant, None)
    }

    /// Time-step limits of a bar.
    fn bar_time_step(&self, stencil: &Stencil<1>) -> TimeStep {
        timestep::bar(stencil)
    }

    /// Time-step limits of a plate.
    fn plane_time_step(&self, stencil: &Stencil<2>) -> TimeStep {
        timestep::plane(stencil)
    }

    /// The published coefficient of a joint: impedances at equal k.
    fn published_reflection(&self, left: &Chain, right: &Chain, theta: f64) -> f64 {
        joint::impedances_at_equal_wavenumber(left, right, theta)
    }

    /// The same with impedances at equal ω; `None` where the right chain carries no such wave.
    fn reflection_at_equal_frequency(&self, left: &Chain, right: &Chain, theta: f64) -> Option<f64> {
        joint::impedances_at_equal_frequency(left, right, theta)
    }

    /// Marches a bar and returns what its probes saw.
    fn march_bar(&self, scene: &Scene<1>) -> Result<Record, Failure> {
        record::run(scene)
    }

    /// Marches a plate and returns what its probes saw.
    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        record::run(scene)
    }

    /// The fastest mode of a bar that its displacement at t = 0 contains.
    fn fastest_bar(&self, scene: &Scene<1>) -> Result<Fastest<1>, String> {
        fastest(scene).map_err(|none| none.to_string())
    }

    /// The fastest mode of a plate that its displacement at t = 0 contains.
    fn fastest_plate(&self, scene: &Scene<2>) -> Result<Fastest<2>, String> {
        fastest(scene).map_err(|none| none.to_string())
    }

    /// Displacements in m of a bar's nodes at rest under the loads of t = 0.
    fn rest_bar(&self, scene: &Scene<1>) -> Result<Vec<f64>, String> {
        Ok(rest(scene)?.into_iter().map(|[u]| u).collect())
    }

    /// Displacements in m of a plate's nodes at rest under the loads of t = 0, row by row.
    fn rest_plate(&self, scene: &Scene<2>) -> Result<Vec<[f64; 2]>, String> {
        rest(scene)
    }

    /// Force density in N/m³ of the bonds alone on a plate's nodes at the displacement of t = 0, row by row.
    fn bond_force_plate(&self, scene: &Scene<2>) -> Result<Vec<[f64; 2]>, String> {
        bond_force(scene)
    }

    /// K_I and K_II in Pa√m, read from the nodes around a tip whose faces bear a uniform stress.
    fn stress_intensity(
        &self,
        reading: &Reading,
        displacement: &[[f64; 2]],
        acceleration: &[[f64; 2]],
        faces: Faces,
    ) -> [f64; 2] {
        reading.at_loaded(displacement, acceleration, faces)
    }

    /// How K of a running tip is read at one look.
    fn running_reading(&self, fit: &Running, tip: &Tip, elastic: &Elastic) -> Result<Reading, Unreadable> {
        fit.reading(tip, elastic)
    }

    /// The published Fourier series of a released bar's displacement.
    fn released_series(&self, bar: &ReleasedBar, x: f64, t: f64, terms: usize) -> f64 {
        bar.fourier_displacement(x, t, terms)
    }

    /// What nodes cost on this machine, where marches are to be timed.
    fn costs(&self) -> Option<&Costs> {
        None
    }

    /// What a joint sends back of the left chain's wave.
    fn reflection(&self, left: &Chain, right: &Chain, theta: f64) -> Option<Complex<f64>> {
        joint::exact(left, right, theta)
    }
}

/// Displacements of the nodes at rest.
fn rest<const D: usize>(scene: &Scene<D>) -> Result<Vec<[f64; D]>, String> {
    let model = Model::new(scene).map_err(|wrong| wrong.message)?;
    let most = 100 * scene.nodes.iter().sum::<usize>().max(1000);
    let rest = statics::rest(&model, 1e-14, most).map_err(|none| none.to_string())?;
    Ok(nodes(&model, &rest.displacement))
}

/// Force density of the bonds at the displacement of t = 0.
fn bond_force<const D: usize>(scene: &Scene<D>) -> Result<Vec<[f64; D]>, String> {
    let model = Model::new(scene).map_err(|wrong| wrong.message)?;
    let mut displacement = model.grid.field();
    for field in &scene.displacement {
        for node in model.grid.each() {
            let place = model.grid.place(node) + field.component * model.grid.stride();
            displacement[place] += field.at(model.grid.position(node));
        }
    }
    model.fill_ghosts(&mut displacement);
    let now = Now {
        displacement: Window::from(&displacement),
        increment: Window::NONE,
        time: 0.0,
        time_step: f64::NAN,
        broken: Broken::none(),
    };
    let mut force = model.grid.field();
    model.add_forces(model.of_class(Class::Internal), &now, &mut force);
    Ok(nodes(&model, &force))
}

/// A field of a model at its nodes, row by row.
fn nodes<const D: usize>(model: &Model<D>, field: &[f64]) -> Vec<[f64; D]> {
    let at = |node| {
        let place = model.grid.place(node);
        std::array::from_fn(|axis| field[place + axis * model.grid.stride()])
    };
    model.grid.each().map(at).collect()
}

/// This library as it is.
pub struct PdVerify;

impl Subject for PdVerify {}

/// The same, whose marches are timed.
pub struct Timed(pub Costs);

impl Subject for Timed {
    fn costs(&self) -> Option<&Costs> {
        Some(&self.0)
    }
}
