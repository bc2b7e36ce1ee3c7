//! Predicted against measured: bodies of other sizes, families and mixtures than those from which the costs were taken.

use super::bodies::{bar, body_force, cut_from_below, cut_from_left, damping, hole, plate, traction};
use super::cases::{Case, Group, plain};
use super::measure::{Failure, Measured, Pace, Pools, measure};
use super::rates::median;
use pd_verify::constraints::Edges;
use pd_verify::forces::surface::Correction;
use pd_verify::plan::time::Costs;
use pd_verify::scene::{Operator, Scene};
use serde::Serialize;

/// One body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Forecast {
    pub name: String,
    pub predicted_seconds_per_step: Option<f64>,
    pub measured_seconds_per_step: f64,
    /// Predicted over measured.
    pub ratio: Option<f64>,
    /// The same, both over what they are for the plate of reference: how busy the machine is does not count.
    pub ratio_beside_reference: Option<f64>,
}

/// The plate of reference, and bodies of which none is a case of the suite.
fn bodies() -> Group {
    let free = Edges::<2>::default();
    let cases = vec![
        Case::new("1024², m = 3", plain()),
        Case::new("90 × 70, m = 3", plate([90, 70], 3.0)),
        Case::new("384², m = 5", plate([384; 2], 5.0)),
        Case::new("1500 × 300, m = 2", plate([1500, 300], 2.0)),
        Case::new("2900², m = 3", plate([2900; 2], 3.0)),
        Case::new(
            "600², free, notch along x, m = 4",
            Scene { edges: free, ..cut_from_left(plate([600; 2], 4.0)) },
        ),
        Case::new(
            "500 × 700, free, notch along y",
            Scene { edges: free, ..cut_from_below(plate([500, 700], 3.0)) },
        ),
        Case::new("768², free, hole", Scene { edges: free, ..hole(plate([768; 2], 3.0)) }),
        Case::new(
            "300², free, surface correction",
            Scene { edges: free, surface: Correction::Energy, ..plate([300; 2], 3.0) },
        ),
        Case::new(
            "700², free, damping, traction",
            Scene { edges: free, effects: vec![damping(), traction()], ..plate([700; 2], 3.0) },
        ),
        Case::new("250², bonds, m = 4", Scene { operator: Operator::Bonds, ..plate([250; 2], 4.0) }),
        Case::new("bar of 2000, m = 4", Scene { edges: Edges::default(), ..bar(2000, 4.0) }),
        Case::new(
            "bar of 3·10⁵, m = 3, body force",
            Scene { effects: vec![body_force()], ..bar(300_000, 3.0) },
        ),
    ];
    Group { name: "predicted", cases }
}

/// Marches each and holds it against what the costs say.
pub fn forecasts(
    costs: &Costs,
    pools: &Pools,
    pace: Pace,
    stop: &dyn Fn() -> bool,
) -> Result<Vec<Forecast>, Failure> {
    let measured = measure(&bodies(), pools, pace, stop)?;
    Ok(measured.iter().map(|one| of(costs, one, &measured[0])).collect())
}

fn of(costs: &Costs, measured: &Measured, reference: &Measured) -> Forecast {
    let (predicted, of_reference) = (costs.of_step(&measured.plan.work), costs.of_step(&reference.plan.work));
    let seconds = 1.0 / median(&measured.rates);
    Forecast {
        name: measured.case.name.clone(),
        predicted_seconds_per_step: predicted,
        measured_seconds_per_step: seconds,
        ratio: predicted.map(|predicted| predicted / seconds),
        ratio_beside_reference: predicted
            .zip(of_reference)
            .map(|(predicted, of_reference)| predicted / of_reference * median(&measured.ratios)),
    }
}
