//! What a case of curves shows: its rows in the tables, and its figures.

use super::curve::Curve;
use super::curves::Curves;
use super::trace::Traced;
use crate::question::Place;
use pd_verify::dispersion::Wave;
use pd_verify::material::Body;
use pd_verify::report::plot::{Axis, Figure, Guide, Lines, Series};
use pd_verify::table::{Cell, Row, Table};
use std::sync::Arc;

/// What every table says of a curve, in the order of [`describe`].
const DESCRIPTION: [&str; 13] = [
    "curve",
    "dimension",
    "branch",
    "angle_deg",
    "scheme",
    "kernel",
    "p",
    "m",
    "dx_m",
    "horizon_m",
    "volume_rule",
    "calibrated",
    "courant",
];

fn describe(curve: &Curve, name: String) -> Vec<Cell> {
    let lattice = curve.lattice();
    vec![
        name.into(),
        curve.body.dimension().into(),
        curve.own_branch().name().into(),
        (curve.body != Body::Bar).then_some(curve.degrees).into(),
        curve.scheme().into(),
        curve.kernel().map(|kernel| kernel.name()).into(),
        curve.kernel().and_then(|kernel| kernel.p()).into(),
        lattice.map(|lattice| lattice.m).into(),
        curve.dx().into(),
        curve.horizon().into(),
        lattice.map(|lattice| lattice.volume_rule.name()).into(),
        lattice.map(|lattice| lattice.calibrated).into(),
        curve.courant.into(),
    ]
}

/// Frequencies, velocities, and the first wavenumbers beyond 1 % and 5 %.
pub fn tables(case: &Curves, traced: &[Traced], place: &Place) -> Vec<Table> {
    let table = |file, own: &[&'static str]| Table::new(file, &[&DESCRIPTION[..], own].concat());
    let mut frequencies = table("dispersion_curves.csv", &["k_per_m", "omega_over_c_per_m"]);
    let mut velocities = table(
        "dispersion_velocities.csv",
        &["k_per_m", "phase_speed_over_c", "group_velocity_over_c", "phase_speed_error_percent"],
    );
    let mut thresholds = table(
        "phase_error_thresholds.csv",
        &[
            "first_k_1_percent_per_m",
            "first_k_5_percent_per_m",
            "wavelength_1_percent_in_horizons",
            "wavelength_1_percent_in_dx",
        ],
    );
    for ((curve, label), traced) in case.curves.iter().zip(&case.labels).zip(traced) {
        let start: Arc<[Cell]> = describe(curve, format!("{}/{label}", place.case)).into();
        let row = |own: Vec<Cell>| Row::of_block(&start, own);
        for &(k, wave) in &traced.points {
            let phase = wave.map(|wave| wave.phase(k));
            let group = wave.map(|wave| wave.group);
            let error = phase.map(|phase| 100.0 * (phase - 1.0));
            frequencies.push(row(vec![k.into(), wave.map(|wave| wave.omega).into()]));
            velocities.push(row(vec![k.into(), phase.into(), group.into(), error.into()]));
        }
        let [one, five] = traced.first;
        let wavelength = one.filter(|&k| k > 0.0).map(|k| std::f64::consts::TAU / k);
        let in_horizons = wavelength.zip(curve.horizon()).map(|(length, horizon)| length / horizon);
        let in_dx = wavelength.zip(curve.dx()).map(|(length, dx)| length / dx);
        thresholds.push(row(vec![one.into(), five.into(), in_horizons.into(), in_dx.into()]));
    }
    vec![frequencies, velocities, thresholds]
}

const FREQUENCY_CAPTION: &str = "Frequency over wavenumber, and the error of the phase speed against the local \
    continuum. Curves of grids end at the edge of the Brillouin zone.";
const VELOCITY_CAPTION: &str = "Phase and group velocity over the wave speed of the local continuum.";

/// Frequency and phase error in one figure, phase and group velocity in another.
pub fn figures(case: &Curves, traced: &[Traced], place: &Place) -> Vec<Figure> {
    let drawn = |value: fn(f64, Wave) -> f64| -> Vec<Series> {
        let series = case.labels.iter().zip(traced).map(|(label, traced)| {
            let points =
                traced.points.iter().map(|&(k, wave)| (k, wave.map_or(f64::NAN, |wave| value(k, wave))));
            Series::line(label.clone(), points.collect())
        });
        series.collect()
    };
    let panel = |title: &str, y: Axis, series| {
        Lines::new(Axis::linear("wavenumber k (1/m)"), y, series).titled(title)
    };
    let points = || traced.iter().flat_map(|traced| &traced.points);
    let most = points().map(|point| point.0).fold(0.0, f64::max);
    let highest = points().filter_map(|point| point.1).map(|wave| wave.omega).fold(0.0, f64::max);
    let top = 1.15 * if highest > 0.0 { highest } else { most };
    let end = most.min(top);
    let mut frequency = vec![Series::reference("local (ω = ck)", vec![(0.0, 0.0), (end, end)])];
    frequency.extend(drawn(|_, wave| wave.omega));
    let local = |at| Guide::Horizontal { at, label: "local (ω = ck)".into() };
    let error = panel(
        "Error against the local continuum",
        Axis::linear("phase-speed error (%)"),
        drawn(|k, wave| 100.0 * (wave.phase(k) - 1.0)),
    );
    let phase = panel("Phase velocity", Axis::linear("phase velocity/c"), drawn(|k, wave| wave.phase(k)));
    let group = panel("Group velocity", Axis::linear("group velocity/c"), drawn(|_, wave| wave.group));
    let frequency = panel("Frequency", Axis::linear("ω/c (1/m)").range(0.0, top), frequency);
    let id = &place.case;
    vec![
        Figure::new(id.clone(), case.title.clone(), FREQUENCY_CAPTION, frequency)
            .panel(error.guide(Guide::Horizontal { at: 0.0, label: String::new() }))
            .columns(2),
        Figure::new(format!("{id}-velocity"), case.title.clone(), VELOCITY_CAPTION, phase.guide(local(1.0)))
            .panel(group.guide(local(1.0)))
            .columns(2),
    ]
}
