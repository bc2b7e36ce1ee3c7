//! The wrong ingredients of bars, one each: in the scene that is marched, or in what is seen of it.

use crate::subject::Subject;
use pd_verify::constraints::Edge;
use pd_verify::forces::surface::Correction;
use pd_verify::forces::{BodyForce, Damping};
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::record::{self, Failure, Record, Trace};
use pd_verify::scene::{Axis, HistoryAsked, Initial, Positive, Scene, Shape, StepRule, Watch};
use pd_verify::statics;
use pd_verify_reference::released_bar::ReleasedBar;
use std::sync::Arc;

/// All of them, by name.
pub fn all() -> Vec<(&'static str, Box<dyn Subject + Send>)> {
    let scene = |change: fn(&mut Scene<1>)| -> Box<dyn Subject + Send> { Box::new(OtherScene(change)) };
    let seen = |change: fn(&mut Trace)| -> Box<dyn Subject + Send> { Box::new(SeenWrong(change)) };
    vec![
        (
            "the held end slides",
            scene(|scene| replace(&mut scene.edges.0[0][0], Edge::MirrorOdd, Edge::MirrorEven)),
        ),
        (
            "the free end is held",
            scene(|scene| replace(&mut scene.edges.0[0][1], Edge::MirrorEven, Edge::MirrorOdd)),
        ),
        ("calibration is forgotten", scene(|scene| scene.lattice.calibrated = false)),
        ("calibration is always on", scene(|scene| scene.lattice.calibrated = true)),
        ("steps are a hundred-thousandth too long", scene(longer_steps)),
        ("damping that nobody asked for", scene(damped)),
        ("a body force that nobody asked for", scene(heavy)),
        ("the modulus is one per cent off", scene(|scene| scene.material.youngs_modulus *= 0.99)),
        ("the end of the horizon counts half", scene(|scene| scene.lattice.volume_rule = VolumeRule::Linear)),
        ("the surface correction is ignored", scene(|scene| scene.surface = Correction::None)),
        ("the pulse starts half a cell aside", scene(pulse_aside)),
        ("the start is bent by a millionth", scene(bent)),
        ("the strain is read two cells to the left", scene(read_aside)),
        ("clocks are a millionth fast", seen(|trace| trace.times.iter_mut().for_each(|t| *t *= 1.0 + 1e-6))),
        ("strains are a tenth too large", seen(|trace| strains(trace, |strain| 1.1 * strain))),
        ("strains are shifted", seen(|trace| strains(trace, |strain| strain + 1e-4))),
        ("the printed series is taken at another place", Box::new(SeriesAside)),
    ]
}

/// Marches another scene than the one asked for.
struct OtherScene(fn(&mut Scene<1>));

impl OtherScene {
    fn changed(&self, scene: &Scene<1>) -> Scene<1> {
        let mut other = scene.clone();
        (self.0)(&mut other);
        other
    }
}

impl Subject for OtherScene {
    fn march_bar(&self, scene: &Scene<1>) -> Result<Record, Failure> {
        record::run(&self.changed(scene))
    }

    fn rest_bar(&self, scene: &Scene<1>) -> Result<Vec<f64>, String> {
        let model = Model::new(&self.changed(scene)).map_err(|wrong| wrong.message)?;
        let rest = statics::rest(&model, 1e-14, 100 * model.grid.count()).map_err(|none| none.to_string())?;
        Ok(model.grid.each().map(|node| rest.displacement[model.grid.place(node)]).collect())
    }
}

fn longer_steps(scene: &mut Scene<1>) {
    if let StepRule::Given { seconds, .. } = &mut scene.time.step {
        *seconds *= 1.0 + 1e-5;
    }
}

fn damped(scene: &mut Scene<1>) {
    scene.effects.push(Arc::new(Damping { rate_per_s: Positive(3e3) }));
}

/// Where an edge is of a kind, makes it another.
fn replace(edge: &mut Edge, from: Edge, to: Edge) {
    if *edge == from {
        *edge = to;
    }
}

/// A body force of the size of gravity.
fn heavy(scene: &mut Scene<1>) {
    let gravity =
        BodyForce { axis: Axis::X, density_n_m3: 7.7e4, region: None, history: HistoryAsked::step() };
    scene.effects.push(Arc::new(gravity));
}

/// A pulse half a cell to the right: wrong by the first order in Δx.
fn pulse_aside(scene: &mut Scene<1>) {
    for initial in &mut scene.displacement {
        if let Shape::Gaussian { centre, .. } = &mut initial.shape {
            centre[0] += 0.5 * scene.spacing;
        }
    }
}

/// A wave of a millionth on top of what the bar starts from.
fn bent(scene: &mut Scene<1>) {
    let wave = |initial: &Initial<1>| {
        let shape = Shape::Wave { wavenumber: [20.0], phase: 0.0 };
        Initial { component: 0, amplitude: 1e-6 * initial.amplitude, shape }
    };
    let waves: Vec<Initial<1>> = scene.displacement.iter().map(wave).collect();
    scene.displacement.extend(waves);
}

fn read_aside(scene: &mut Scene<1>) {
    for probe in &mut scene.probes {
        if let Watch::Strain { at } = &mut probe.watch {
            *at -= 2.0 * scene.spacing;
        }
    }
}

/// Sees something else than what was marched.
struct SeenWrong(fn(&mut Trace));

impl Subject for SeenWrong {
    fn march_bar(&self, scene: &Scene<1>) -> Result<Record, Failure> {
        let mut record = record::run(scene)?;
        record.traces.iter_mut().for_each(self.0);
        Ok(record)
    }
}

fn strains(trace: &mut Trace, wrong: impl Fn(f64) -> f64) {
    if trace.columns.iter().all(|column| column.quantity == "strain") {
        trace.rows.iter_mut().flatten().for_each(|strain| *strain = wrong(*strain));
    }
}

struct SeriesAside;

impl Subject for SeriesAside {
    fn released_series(&self, bar: &ReleasedBar, x: f64, t: f64, terms: usize) -> f64 {
        bar.fourier_displacement(0.9 * x, t, terms)
    }
}
