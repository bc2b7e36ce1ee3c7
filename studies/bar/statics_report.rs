//! Tables and figures of bars at rest: recovered moduli by m and by δ, the strain near an end, and which correction is best.

use super::names::{LATTICE, lattice_cells};
use super::statics::{Bulk, Rested, Statics};
use crate::dispersion::sweep::distinct;
use crate::levels;
use crate::question::Place;
use pd_verify::forces::surface::Correction;
use pd_verify::kernel::Kernel;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::report::plot::{Axis, Dash, Figure, Guide, Lines, Marker, Series};
use pd_verify::table::{Cell, Table};

/// Horizons from the end that the strain is shown for.
const SHOWN: f64 = 3.0;
/// Curves that one panel can show, for three corrections each.
const KERNELS: usize = 2;

pub fn tables(statics: &Statics, rested: &[Rested], place: &Place) -> Vec<Table> {
    let own = [
        "correction",
        "horizon_m",
        "layer_cells",
        "recovered_modulus_over_e",
        "middle_modulus_over_e",
        "lattice_modulus_over_e",
        "local_modulus",
        "softness",
        "pairwise_order",
        "error_against_reference",
    ];
    let mut moduli = Table::new("bar_statics.csv", &[&["case"][..], &LATTICE, &own].concat());
    for (index, bulk) in statics.lattices.iter().enumerate() {
        for &correction in &statics.corrections {
            let errors = statics.softnesses(rested, index, correction);
            for (level, one) in statics.levels(rested, index, correction).enumerate() {
                let start: [Cell; 1] = [place.case.clone().into()];
                let own: [Cell; 10] = [
                    correction.name().into(),
                    errors[level].0.into(),
                    statics.bar.layer.into(),
                    one.recovered.into(),
                    one.middle.into(),
                    bulk.modulus.into(),
                    one.local.into(),
                    one.softness(bulk).into(),
                    levels::pairwise(&errors, level).into(),
                    one.far.into(),
                ];
                let lattice = lattice_cells(Some((bulk.lattice, one.spacing)));
                moduli.push(start.into_iter().chain(lattice).chain(own).collect::<Vec<_>>());
            }
        }
    }
    let own = ["correction", "x_m", "strain_over_bulk"];
    let mut strains = Table::new("bar_static_strain.csv", &[&["case"][..], &LATTICE, &own].concat());
    for (bulk, one) in shown(statics, rested) {
        for (x, strain) in profile(bulk, one) {
            let start: [Cell; 1] = [place.case.clone().into()];
            let own: [Cell; 3] = [one.correction.name().into(), (x * one.spacing).into(), strain.into()];
            let lattice = lattice_cells(Some((bulk.lattice, one.spacing)));
            strains.push(start.into_iter().chain(lattice).chain(own).collect::<Vec<_>>());
        }
    }
    vec![moduli, strains]
}

/// The bars whose strain is shown: of the first lattice of each kernel with the largest m, at the finest Δx.
fn shown<'a>(statics: &'a Statics, rested: &'a [Rested]) -> impl Iterator<Item = (&'a Bulk, &'a Rested)> {
    let most = statics.lattices.iter().map(|bulk| bulk.lattice.m).fold(0.0, f64::max);
    let finest = statics.spacings[statics.spacings.len() - 1];
    let first = |kernel: Kernel| {
        statics.lattices.iter().position(|bulk| bulk.lattice.kernel == kernel && bulk.lattice.m == most)
    };
    let chosen: Vec<usize> = kernels(statics).into_iter().filter_map(first).collect();
    let bars = rested.iter().filter(move |one| one.spacing == finest && chosen.contains(&one.bulk));
    bars.map(|one| (&statics.lattices[one.bulk], one))
}

fn kernels(statics: &Statics) -> Vec<Kernel> {
    distinct(statics.lattices.iter().map(|bulk| bulk.lattice.kernel))
}

/// (x/Δx, strain over that inside) on the cell faces near the left end.
fn profile(bulk: &Bulk, one: &Rested) -> Vec<(f64, f64)> {
    let faces = one.displacements.windows(2).zip(1..);
    let near = faces.take_while(|(_, face)| f64::from(*face) <= SHOWN * bulk.lattice.m);
    near.map(|(u, face)| (f64::from(face), bulk.modulus * (u[1] - u[0]))).collect()
}

pub fn figures(statics: &Statics, rested: &[Rested], place: &Place) -> Vec<Figure> {
    vec![by_m(statics, rested, place), by_horizon(statics, rested, place), strains(statics, rested, place)]
}

/// The dashes of a correction and the marker with it: the same in every figure.
fn look(series: Series, correction: Correction) -> Series {
    match correction {
        Correction::None => series.dash(Dash::Solid).marker(Marker::Circle),
        Correction::Energy => series.dash(Dash::Dashed).marker(Marker::Square),
        Correction::Volume => series.dash(Dash::Dotted).marker(Marker::Triangle),
    }
}

/// What a correction is called in a legend.
fn called(correction: Correction) -> &'static str {
    match correction {
        Correction::None => "no correction",
        Correction::Energy => "energy",
        Correction::Volume => "volume",
    }
}

/// Recovered over bulk modulus at the coarsest Δx, a panel for each volume rule.
fn by_m(statics: &Statics, rested: &[Rested], place: &Place) -> Figure {
    let spacing = statics.spacings[0];
    let point = |one: &Rested| {
        let bulk = &statics.lattices[one.bulk];
        (bulk.lattice.m, one.recovered / (bulk.modulus * one.local))
    };
    let caption = format!(
        "Modulus that the ends' displacements show over that of the lattice inside, {:.0} cells, both ends free. {}",
        statics.bar.length / spacing,
        best(statics, rested)
    );
    let mut figure = Figure::new(place.case.clone(), statics.title.clone(), caption, Lines::default());
    figure.panels.clear();
    for rule in rules(statics) {
        let mut series = Vec::new();
        for (slot, kernel) in kernels(statics).into_iter().take(KERNELS).enumerate() {
            for &correction in &statics.corrections {
                let mine = rested.iter().filter(|one| {
                    let of = statics.lattices[one.bulk].lattice;
                    one.correction == correction
                        && one.spacing == spacing
                        && of.kernel == kernel
                        && of.volume_rule == rule
                });
                let name = format!("{kernel}, {}", called(correction));
                series.push(look(Series::both(name, mine.map(point).collect()).slot(slot), correction));
            }
        }
        let panel = Lines::new(Axis::linear("m = δ/Δx"), Axis::linear("E recovered / E inside"), series)
            .titled(format!("{} volumes", rule.name().replace('_', " ")))
            .guide(Guide::Horizontal { at: 1.0, label: "inside".into() });
        figure = figure.panel(panel);
    }
    figure
}

fn rules(statics: &Statics) -> Vec<VolumeRule> {
    distinct(statics.lattices.iter().map(|bulk| bulk.lattice.volume_rule))
}

/// Softness over δ for the first lattice of each kernel with the largest m, a panel for each volume rule.
fn by_horizon(statics: &Statics, rested: &[Rested], place: &Place) -> Figure {
    let most = statics.lattices.iter().map(|bulk| bulk.lattice.m).fold(0.0, f64::max);
    let caption = format!(
        "Softness of the ends, how much further they move apart than in a local bar, over the horizon at m = {most}. {}",
        best(statics, rested)
    );
    let title = format!("{}: surface effect", statics.title);
    let mut figure = Figure::new(format!("{}-horizon", place.case), title, caption, Lines::default());
    figure.panels.clear();
    for rule in rules(statics) {
        let mut series = Vec::new();
        for (slot, kernel) in kernels(statics).into_iter().take(KERNELS).enumerate() {
            let found = statics.lattices.iter().position(|bulk| {
                let of = bulk.lattice;
                of.m == most && of.kernel == kernel && of.volume_rule == rule
            });
            let Some(index) = found else { continue };
            for &correction in &statics.corrections {
                let name = format!("{kernel}, {}", called(correction));
                let errors = statics.softnesses(rested, index, correction);
                series.push(look(Series::both(name, errors).slot(slot), correction));
            }
        }
        let panel =
            Lines::new(Axis::log("δ (m)"), Axis::log("softness |E inside / E recovered − 1|"), series)
                .titled(format!("{} volumes", rule.name().replace('_', " ")))
                .guide(Guide::Slope { order: 1.0, label: "order 1".into() });
        figure = figure.panel(panel);
    }
    figure
}

/// Strain near the left end, a panel for each kernel.
fn strains(statics: &Statics, rested: &[Rested], place: &Place) -> Figure {
    let title = format!("{}: strain at an end", statics.title);
    let caption = format!(
        "Strain near a free end over that inside, by correction, at Δx = {} m.",
        statics.spacings[statics.spacings.len() - 1]
    );
    let mut figure = Figure::new(format!("{}-strain", place.case), title, caption, Lines::default());
    figure.panels.clear();
    for (slot, kernel) in kernels(statics).into_iter().take(KERNELS).enumerate() {
        let mine = shown(statics, rested).filter(|(bulk, _)| bulk.lattice.kernel == kernel);
        let mut name = String::new();
        let series = mine.map(|(bulk, one)| {
            name = bulk.lattice.to_string();
            let points = profile(bulk, one).into_iter().map(|(x, strain)| (x / bulk.lattice.m, strain));
            look(Series::both(called(one.correction), points.collect()).slot(slot), one.correction)
        });
        let series = series.collect();
        let panel = Lines::new(Axis::linear("x / δ"), Axis::linear("strain / strain inside"), series)
            .titled(name)
            .guide(Guide::Horizontal { at: 1.0, label: "inside".into() });
        figure = figure.panel(panel);
    }
    figure
}

/// Which correction leaves the smallest softness at the coarsest Δx: counted over lattices.
fn best(statics: &Statics, rested: &[Rested]) -> String {
    let errors = |correction: Correction| -> Vec<f64> {
        let mine =
            rested.iter().filter(|one| one.correction == correction && one.spacing == statics.spacings[0]);
        mine.map(|one| one.softness(&statics.lattices[one.bulk]).abs()).collect()
    };
    let all: Vec<(Correction, Vec<f64>)> =
        statics.corrections.iter().map(|&correction| (correction, errors(correction))).collect();
    let wins = |errors: &[f64]| {
        let won = |&lattice: &usize| all.iter().all(|(_, others)| errors[lattice] <= others[lattice]);
        (0..statics.lattices.len()).filter(won).count()
    };
    let mut ranked: Vec<(Correction, usize, f64)> = all
        .iter()
        .map(|(correction, errors)| (*correction, wins(errors), errors.iter().copied().fold(0.0, f64::max)))
        .collect();
    ranked.sort_by(|a, b| b.1.cmp(&a.1).then(a.2.total_cmp(&b.2)));
    let said = ranked.iter().map(|(correction, wins, worst)| {
        format!("{} for {wins} (at worst {:.2} %)", called(*correction), 100.0 * worst)
    });
    let said: Vec<String> = said.collect();
    let spread = match statics.bar.layer {
        1 => String::new(),
        layer => format!(" Loads reach over {layer} cells; what a local bar shows under them is taken out."),
    };
    format!("Of {} lattices, the smallest softness: {}.{spread}", statics.lattices.len(), said.join(", "))
}
