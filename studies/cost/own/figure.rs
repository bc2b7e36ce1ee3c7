//! Error against seconds: the levels that were marched, what was predicted, and the answer.

use super::search::{Found, Goal};
use pd_verify::report::plot::{Axis, Figure, Guide, Lines, Series};

/// The work–precision plot; `None` where no error is known.
pub fn figure(found: &Found, name: &str) -> Option<Figure> {
    let estimate = found.estimate.as_ref().ok()?;
    let marched: Vec<(f64, f64)> =
        found.levels.iter().zip(estimate.errors()).map(|(level, error)| (level.seconds, error)).collect();
    let mut series = vec![Series::both("levels", marched)];
    if let Some(chosen) = &found.chosen {
        series.push(Series::markers("answer, predicted", vec![(chosen.predicted, chosen.error)]));
        let outcome = chosen.outcome.as_ref();
        let point = outcome.and_then(|outcome| Some((outcome.seconds, *outcome.error.as_ref().ok()?)));
        series.extend(point.map(|point| Series::markers("answer, marched", vec![point])));
    }
    let lines = Lines::new(Axis::log("seconds"), Axis::log("error"), series);
    let lines = match found.goal {
        Goal::Error(error) => lines.guide(Guide::Horizontal { at: error, label: "asked for".into() }),
        Goal::Budget(seconds) => lines.guide(Guide::Vertical { at: seconds, label: "budget".into() }),
    };
    let caption = format!(
        "{name}: the worst of what its probes see, root mean square over time, over its largest size; errors as \
         the differences of levels tell them."
    );
    Some(Figure::new("error_by_seconds", "What accuracy costs", caption, lines))
}
