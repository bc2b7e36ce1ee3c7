//! The wrong ingredients of bars, one each: in the scene that is marched, or in what is seen of it.

use crate::subject::Subject;
use pd_verify::constraints::Edge;
use pd_verify::forces::Damping;
use pd_verify::model::Model;
use pd_verify::record::{self, Failure, Record, Trace};
use pd_verify::scene::{Positive, Scene, StepRule, Watch};
use pd_verify::statics;
use pd_verify_reference::released_bar::ReleasedBar;
use std::sync::Arc;

/// All of them, by name.
pub fn all() -> Vec<(&'static str, Box<dyn Subject + Send>)> {
    let scene = |change: fn(&mut Scene<1>)| -> Box<dyn Subject + Send> { Box::new(OtherScene(change)) };
    let seen = |change: fn(&mut Trace)| -> Box<dyn Subject + Send> { Box::new(SeenWrong(change)) };
    vec![
        ("the held end slides", scene(|scene| scene.edges.0[0][0] = Edge::MirrorEven)),
        ("the free end is held", scene(|scene| scene.edges.0[0][1] = Edge::MirrorOdd)),
        ("calibration is forgotten", scene(|scene| scene.lattice.calibrated = false)),
        ("calibration is always on", scene(|scene| scene.lattice.calibrated = true)),
        ("steps are a hundred-thousandth too long", scene(longer_steps)),
        ("damping that nobody asked for", scene(damped)),
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
