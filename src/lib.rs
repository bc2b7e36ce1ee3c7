//! Peridynamics, verified: what its waves and lattices do, computed so that it can be held against exact answers.
//!
//! # The model
//! Points within a horizon δ of each other pull on one another. Linearised and bond-based, per unit volume,
//!
//! ρ ü(x) = ∫ c(ξ) (ξ⊗ξ/|ξ|³) (u(x + ξ) − u(x)) dV + b,  c(ξ) = c₀ W(|ξ|/δ)
//!
//! (Silling 2000, J. Mech. Phys. Solids 48, 175); geometrically exact, a bond pulls with c s along its present direction,
//! s its stretch ([`forces`]). On a lattice of spacing Δx the integral is a sum over the bonds of a
//! family, each with the counted fraction β of its cell: weight w = c V β/|ξ|.
//!
//! | symbol | meaning | unit | where |
//! |---|---|---|---|
//! | ρ, E | density, Young's modulus | kg/m³, Pa | [`material`] |
//! | δ, Δx, m = δ/Δx | horizon, spacing, their ratio | m, m, 1 | [`lattice`] |
//! | W(s), p | kernel over s = \|ξ\|/δ and its narrowness | 1 | [`kernel`] |
//! | c₀ | micromodulus constant | N/m⁶ | [`micromodulus`] |
//! | β | counted fraction of a neighbour's cell | 1 | [`partial_volume`] |
//! | w | stiffness of a pair of bonds ±ξ, over C₁₁/Δx² | 1 | [`lattice`] |
//! | α, β (of α + β cos 4θ) | calibration of the lattice | 1 | [`lattice`] |
//! | u, d | displacement, its increment over a step | m | [`march`] |
//! | Δt | time step | s | [`plan`] |
//! | k, ω | wavenumber, angular frequency | 1/m, 1/s | [`dispersion`] |
//! | K_I, K_II | stress intensity factors | Pa√m | [`stress_intensity`] |
//! | v, c_d, c_s | speed of waves in a bar, dilatational, shear | m/s | [`material`] |
//!
//! All quantities are SI; dispersion is computed in units of the spacing (or the horizon) and the wave's own speed.
//!
//! # A bar in twenty lines
//! A bar held at the left and stretched is let go: how far is the strain at its middle from the exact square wave, half a
//! period later?
//! ```
//! use pd_verify::constraints::{Edge, Edges};
//! use pd_verify::kernel::Kernel;
//! use pd_verify::lattice::Lattice;
//! use pd_verify::material::{Body, Material};
//! use pd_verify::partial_volume::VolumeRule;
//! use pd_verify::record::run;
//! use pd_verify::scene::{Initial, Probe, Scene, Shape, StepRule, Time, Watch};
//!
//! let steel = Material { youngs_modulus: 200e9, density: 7850.0 };
//! let lattice = Lattice { kernel: Kernel::Gaussian { p: 2.0 }, m: 3.0, volume_rule: VolumeRule::Linear, calibrated: true };
//! let time = Time { duration: 0.4e-3, step: StepRule::OfLimit(0.5) };
//! let scene = Scene {
//!     edges: Edges([[Edge::MirrorOdd, Edge::MirrorEven]]),
//!     displacement: vec![Initial { component: 0, amplitude: 1e-3, shape: Shape::Linear { along: 0 } }],
//!     probes: vec![Probe { name: "middle".into(), watch: Watch::Strain { at: 0.5 }, every: 1 }],
//!     ..Scene::bare(steel, Body::Bar, lattice, [400], 1.0 / 400.0, time)
//! };
//! let record = run(&scene)?;
//! let strain = record.trace("middle").expect("a probe of that name").column(0);
//! assert!((strain.last().unwrap() / -1e-3 - 1.0).abs() < 0.1); // −ε₀, with ripples behind the front
//! # Ok::<(), pd_verify::record::Failure>(())
//! ```
//! [`dispersion`] says beforehand how such waves travel, and how large a step they bear:
//! ```
//! # use pd_verify::dispersion::{bar::BarDispersion, leapfrog, timestep};
//! # use pd_verify::kernel::Kernel;
//! # use pd_verify::lattice::{Lattice, Stencil};
//! # use pd_verify::partial_volume::VolumeRule;
//! # let kernel = Kernel::Gaussian { p: 2.0 };
//! # let lattice = Lattice { kernel, m: 3.0, volume_rule: VolumeRule::Linear, calibrated: true };
//! let stencil = Stencil::<1>::new(lattice)?;
//! let limit = timestep::bar(&stencil).sharp; // vΔt/Δx
//! let theta = 2.0 * std::f64::consts::PI / 10.0; // kΔx of ten nodes to the wave
//! let wave = BarDispersion::new(&stencil).wave(theta);
//! let marched = leapfrog::wave(wave, 0.9 * limit, None).expect("below the limit");
//! assert_eq!(format!("{:.4}", wave.phase(theta)), "0.9645"); // 3.5 % too slow in exact time,
//! assert_eq!(format!("{:.4}", marched.phase(theta)), "0.9842"); // 1.6 % by leapfrog at 0.9 of its limit
//! # Ok::<(), pd_verify::lattice::Unusable>(())
//! ```
//!
//! # Judging
//! A [`claim`] states a quantity, a bound and the reason for the bound before anything is computed; [`verdict`] holds
//! evidence against it; [`report`] turns the result into tables, figures and pages. Exact answers live in a crate of
//! their own, `pd-verify-reference`, which cannot see this one, and which this one does not use.

pub mod breaking;
pub mod claim;
pub mod compare;
pub mod connectivity;
pub mod constraints;
pub mod dispersion;
pub mod exact;
pub mod family;
pub mod fastest;
pub mod field;
pub mod forces;
pub mod grid;
pub mod kernel;
pub mod lattice;
pub mod ledger;
pub mod march;
pub mod material;
pub mod micromodulus;
pub mod model;
pub mod obstacles;
pub mod partial_volume;
pub mod plan;
pub mod quadrature;
pub mod record;
pub mod report;
pub mod scene;
pub mod simd;
pub mod statics;
pub mod stress_intensity;
pub mod table;
pub mod verdict;
